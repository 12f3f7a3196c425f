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

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/point_problems.h"
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
  number_of_points_ = points.size();
  const auto started = std::chrono::steady_clock::now();
  triangulation_ = build(points, start, traits_.instantaneous_traits(clock_));
  index_vertices();
  const auto built = std::chrono::steady_clock::now();
  schedule_all();
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds_ = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::index_vertices() {
  for (const Vertex_handle v : triangulation_.finite_vertex_handles()) {
    vertices_[v->point().id()] = v;
  }
}

// ---- the present ----

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::vertex(Point_id id) const -> Vertex_handle {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  return vertices_[id];
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

#include "kinetri/triangulation/detail/certificates_impl.h"
#include "kinetri/triangulation/detail/changes_impl.h"
#include "kinetri/triangulation/detail/events_impl.h"
#include "kinetri/triangulation/detail/rebuild_impl.h"
#include "kinetri/triangulation/detail/scheduling_impl.h"
#include "kinetri/triangulation/detail/snapshot_impl.h"
#include "kinetri/triangulation/detail/start_impl.h"
#include "kinetri/triangulation/detail/vertices_impl.h"

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H
