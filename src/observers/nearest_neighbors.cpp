// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/nearest_neighbors.h"

#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "observers/nearest_tracker.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Simulation_2<Traits>& simulation, On_change on_change)
    : Base(simulation) {
  start(std::move(on_change));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Triangulation& triangulation, On_change on_change)
    : Base(triangulation) {
  start(std::move(on_change));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::start(On_change on_change) {
  tracker_ = std::make_shared<detail::Nearest_tracker<Traits>>(
      this->graph(), this->traits(), std::move(on_change), this->triangulation().current_time());
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> std::optional<Point_id>
Nearest_neighbors<Traits>::nearest_neighbor(Point_id id) {
  this->update();
  KINETRI_PRECONDITION(this->graph().contains(id),
                       "there is no point with the id " + std::to_string(id));
  const Point_id nearest = tracker_->nearest(id);
  return nearest == no_point ? std::nullopt : std::optional(nearest);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Point_id>& Nearest_neighbors<Traits>::nearest_neighbors() {
  this->update();
  return tracker_->all_nearest(this->triangulation().next_id());
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Nearest_neighbor_change>& Nearest_neighbors<Traits>::changes() {
  this->update();
  return tracker_->changes();
}

// ---- called by the base ----

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::advance(const Time& time) {
  tracker_->advance(time);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::before_change(std::span<const Edge_ids> removed,
                                              std::span<const Changed_point> points) {
  tracker_->before_change(removed, points);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::change(const Time& time, std::span<const Edge_ids> /*removed*/,
                                       std::span<const Edge_ids> added,
                                       std::span<const Changed_point> /*points*/) {
  tracker_->change(time, this->triangulation().next_id(), added);
}

template class Nearest_neighbors<Linear_kinetic_traits_2>;
template class Nearest_neighbors<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
