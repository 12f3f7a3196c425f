// SPDX-License-Identifier: GPL-3.0-or-later
//
// What names an edge, and a neighbor of a point: so that the observers of edges are the same code
// for the plane and for a periodic box.
#ifndef KINETRI_IMPL_OBSERVERS_NEIGHBOR_NAMES_H
#define KINETRI_IMPL_OBSERVERS_NEIGHBOR_NAMES_H

#include <array>
#include <type_traits>
#include <utility>

#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/kinetic/kinetic_traits_2.h"

namespace kinetri::detail {

/// What names an edge, or any pair of points: their ids; in a periodic box, where pairs are of
/// images, with the offset.
template <class Traits>
using Edge_name = std::conditional_t<PeriodicKineticTraits_2<Traits>, Periodic_edge, Edge_ids>;

/// What names a neighbor of a point: its id; in a periodic box the image, as seen from the position
/// of the point as given.
template <class Traits>
using Neighbor_name = std::conditional_t<PeriodicKineticTraits_2<Traits>, Periodic_image, Point_id>;

/// @{
/// The two ends of an edge, each with the other one as seen from there.
inline std::array<std::pair<Point_id, Point_id>, 2> ends_of(const Edge_ids& edge) {
  return {{{edge[0], edge[1]}, {edge[1], edge[0]}}};
}
inline std::array<std::pair<Point_id, Periodic_image>, 2> ends_of(const Periodic_edge& edge) {
  const auto& [ids, offset] = edge;
  return {{{ids[0], {ids[1], offset}}, {ids[1], {ids[0], {-offset.x, -offset.y}}}}};
}
/// @}

/// Names no neighbor.
template <class Traits>
constexpr Neighbor_name<Traits> no_neighbor() {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    return {};
  } else {
    return no_point;
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_NEIGHBOR_NAMES_H
