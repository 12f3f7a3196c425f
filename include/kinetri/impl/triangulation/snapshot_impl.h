// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: how its state is taken out and put back.
#ifndef KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H

#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(!is_in_event_ && !rebuilt_edges_ && points_set_aside_.empty(),
                       "a snapshot within an event; take it when advance_to or step has returned");
  Snapshot result;
  result.time = current_time().detached();
  result.counters = counters_;
  result.certificates = certificate_counters_;
  result.motions.reserve(vertices_.size());
  for (const Vertex_handle v : vertices_) {
    const bool is_there = v != Vertex_handle();
    result.motions.push_back(is_there ? std::optional(v->point().motion()) : std::nullopt);
  }
  return result;
}

template <KineticTraits_2 Traits>
Kinetic_triangulation_2<Traits>::Kinetic_triangulation_2(Restoration /*restores*/,
                                                         const Snapshot& snapshot,
                                                         const Traits& traits)
    : traits_(traits),
      current_time_(snapshot.time.detached()),
      clock_({current_time_, Time_side::after}),
      certificate_counters_(snapshot.certificates) {
  if (snapshot.motions.size() >= no_point) {
    throw Snapshot_error(std::string("the snapshot has ") + detail::too_many_points);
  }
  std::vector<Point_2> points;
  for (std::size_t id = 0; id < snapshot.motions.size(); ++id) {
    const std::optional<Motion>& motion = snapshot.motions[id];
    if (!motion) continue;
    if (!is_finite(*motion)) throw Snapshot_error(detail::not_finite_problem(id));
    points.emplace_back(*motion, static_cast<Point_id>(id));
  }
  vertices_.resize(snapshot.motions.size());
  try {
    start_with(points);
  } catch (const Coincident_trajectories_error& error) {
    throw Snapshot_error("the snapshot's points " + std::to_string(error.first()) + " and " +
                         std::to_string(error.second()) + " have the same trajectory");
  }
  counters_ = snapshot.counters;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_SNAPSHOT_IMPL_H
