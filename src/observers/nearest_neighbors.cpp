// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/nearest_neighbors.h"

#include <utility>

#include "observers/nearest_tracker.h"

namespace kinetri {

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Simulation_2<Traits>& simulation, On_change on_change)
    : tracker_(
          std::make_unique<detail::Nearest_tracker<Traits>>(simulation, std::move(on_change))) {}

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Triangulation& triangulation, On_change on_change)
    : tracker_(
          std::make_unique<detail::Nearest_tracker<Traits>>(triangulation, std::move(on_change))) {}

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::~Nearest_neighbors() = default;

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::nearest_neighbor(Point_id id) -> std::optional<Neighbor> {
  const Neighbor nearest = tracker_->nearest(id);
  return detail::id_of(nearest) == no_point ? std::nullopt : std::optional(nearest);
}

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::nearest_neighbors() -> const std::vector<Neighbor>& {
  return tracker_->all_nearest();
}

template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Nearest_neighbor_change>& Nearest_neighbors<Traits>::changes() {
  return tracker_->changes();
}

template class Nearest_neighbors<Linear_kinetic_traits_2>;
template class Nearest_neighbors<Polynomial_kinetic_traits_2>;
template class Nearest_neighbors<Periodic_kinetic_traits_2>;

}  // namespace kinetri
