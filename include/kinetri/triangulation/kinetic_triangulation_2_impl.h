// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2 but for its audits. Include this, and
// audit_impl.h, only where you instantiate the class for your own kinetic traits class; it is
// compiled into the library for both kinds of motion.
#ifndef KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H
#define KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H

#include <algorithm>
#include <chrono>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/hidden_points.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// ---- construction ----

template <KineticTraits_2 Traits>
Kinetic_triangulation_2<Traits>::Kinetic_triangulation_2(const std::vector<Motion>& motions,
                                                         const Time& start, const Traits& traits)
    : traits_(traits), current_time_(start), clock_({start, Time_side::after}) {
  KINETRI_PRECONDITION(motions.size() < no_point, detail::too_many_points);
  std::vector<Point_2> points;
  points.reserve(motions.size());
  for (const Motion& motion : motions) {
    KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(points.size()));
    points.emplace_back(motion, static_cast<Point_id>(points.size()));
  }
  vertices_.resize(points.size());
  start_with(points);
}

// Makes the triangulation of the points and its queue.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::start_with(std::span<const Point_2> points) {
  number_of_points_ = points.size();
  const auto started = std::chrono::steady_clock::now();
  if constexpr (is_weighted) weights_are_equal_ = have_equal_weights(points);
  triangulation_ = build(points, current_time_, traits_.instantaneous_traits(clock_));
  index_vertices();
  const auto built = std::chrono::steady_clock::now();
  schedule_all();
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds_ = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::index_vertices() {
  auto& vertices = triangulation_.tds().vertices();
  for (Vertex_handle v = vertices.begin(); v != vertices.end(); ++v) {
    if (!triangulation_.is_infinite(v)) vertices_[v->point().id()] = v;
  }
}

// Whether the weights of all points are equal at all times.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::have_equal_weights(std::span<const Point_2> points) {
  if constexpr (is_weighted) {
    return std::ranges::all_of(points, [&](const Point_2& point) {
      return kinetri::have_equal_weights(points.front().motion(), point.motion());
    });
  }
  return true;
}

// ---- calls within calls ----

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::check_may_change() const {
  KINETRI_PRECONDITION(!is_changing_,
                       "a change of the triangulation within an event, or while another change is "
                       "made; make it when advance_to, step or the other change has returned");
  KINETRI_PRECONDITION(!is_in_event_,
                       "an observer has thrown, and left the triangulation within an event; make "
                       "another one, or restore a snapshot");
}

// ---- the present ----

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::vertex(Point_id id) const -> Vertex_handle {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  return vertices_[id];
}

template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::is_hidden(Point_id id) const {
  const Vertex_handle v = vertex(id);
  if constexpr (is_weighted) return v->is_hidden();
  return false;
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::number_of_hidden_points() const {
  if constexpr (is_weighted) return triangulation_.number_of_hidden_vertices();
  return 0;
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::motion(Point_id id) const -> const Motion& {
  return vertex(id)->point().motion();
}

template <KineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_triangulation_2<Traits>::finite_edge_ids() const {
  std::vector<Edge_ids> result;
  for (const Edge& edge : triangulation_.finite_edges()) result.push_back(ids_of(edge));
  std::ranges::sort(result);
  return result;
}

}  // namespace kinetri

#include "kinetri/impl/triangulation/certificates_impl.h"
#include "kinetri/impl/triangulation/changes_impl.h"
#include "kinetri/impl/triangulation/events_impl.h"
#include "kinetri/impl/triangulation/rebuild_impl.h"
#include "kinetri/impl/triangulation/scheduling_impl.h"
#include "kinetri/impl/triangulation/snapshot_impl.h"
#include "kinetri/impl/triangulation/start_impl.h"
#include "kinetri/impl/triangulation/vertices_impl.h"

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H
