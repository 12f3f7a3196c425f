// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/nearest_neighbors.h"

#include <utility>

#include "observers/nearest_tracker.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Simulation_2<Traits>& simulation, On_change on_change)
    : tracker_(
          std::make_unique<detail::Nearest_tracker<Traits>>(simulation, std::move(on_change))) {}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Triangulation& triangulation, On_change on_change)
    : tracker_(
          std::make_unique<detail::Nearest_tracker<Traits>>(triangulation, std::move(on_change))) {}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::~Nearest_neighbors() = default;

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> std::optional<Point_id>
Nearest_neighbors<Traits>::nearest_neighbor(Point_id id) {
  const Point_id nearest = tracker_->nearest(id);
  return nearest == no_point ? std::nullopt : std::optional(nearest);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Point_id>& Nearest_neighbors<Traits>::nearest_neighbors() {
  return tracker_->all_nearest();
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Nearest_neighbor_change>& Nearest_neighbors<Traits>::changes() {
  return tracker_->changes();
}

template class Nearest_neighbors<Linear_kinetic_traits_2>;
template class Nearest_neighbors<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
