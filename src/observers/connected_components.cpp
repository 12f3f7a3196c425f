// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/connected_components.h"

#include <utility>

#include "kinetri/impl/base/check.h"
#include "observers/component_tracker.h"

namespace kinetri {

std::string_view name(Component_event_kind kind) {
  constexpr std::array<std::string_view, component_event_kinds> names = {
      "start", "merge", "split", "insert", "erase", "wrap", "unwrap"};
  return names[static_cast<std::size_t>(kind)];
}

template <DistanceKineticTraits_2 Traits>
Connected_components<Traits>::Connected_components(Simulation_2<Traits>& simulation, double range)
    : tracker_(std::make_unique<Tracker>(simulation, range)) {}

template <DistanceKineticTraits_2 Traits>
Connected_components<Traits>::Connected_components(Triangulation& triangulation, double range)
    : tracker_(std::make_unique<Tracker>(triangulation, range)) {}

template <DistanceKineticTraits_2 Traits>
Connected_components<Traits>::~Connected_components() = default;

template <DistanceKineticTraits_2 Traits>
double Connected_components<Traits>::range() const {
  return tracker_->range();
}

template <DistanceKineticTraits_2 Traits>
const std::vector<Component_event>& Connected_components<Traits>::events() {
  return tracker_->events();
}

template <DistanceKineticTraits_2 Traits>
bool Connected_components<Traits>::contains(Point_id id) {
  return tracker_->connectivity().contains(id);
}

template <DistanceKineticTraits_2 Traits>
auto Connected_components<Traits>::component(Point_id id) -> Component {
  return tracker_->connectivity().component(id);
}

template <DistanceKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::size_of(Point_id id) {
  return tracker_->connectivity().size_of(id);
}

template <DistanceKineticTraits_2 Traits>
bool Connected_components<Traits>::are_connected(Point_id a, Point_id b) {
  return tracker_->connectivity().are_connected(a, b);
}

template <DistanceKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::number_of_components() {
  return tracker_->connectivity().number_of_components();
}

template <DistanceKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::largest() {
  return tracker_->connectivity().largest();
}

template <DistanceKineticTraits_2 Traits>
int Connected_components<Traits>::wrapping_directions(Point_id id) {
  return tracker_->connectivity().wrapping_directions(id);
}

template <DistanceKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::number_of_wrapping_components() {
  return tracker_->connectivity().number_of_wrapping_components();
}

template <DistanceKineticTraits_2 Traits>
void Connected_components<Traits>::watch(const Edge_ids& points) {
  KINETRI_PRECONDITION(points[0] != points[1], "a point is always connected with itself");
  tracker_->watch(edge_ids(points[0], points[1]));
}

template <DistanceKineticTraits_2 Traits>
std::vector<Time_interval> Connected_components<Traits>::connected_intervals(
    const Edge_ids& points) {
  auto result = tracker_->connected_intervals(edge_ids(points[0], points[1]));
  KINETRI_PRECONDITION(result.has_value(), "the pair is not watched");
  return *std::move(result);
}

template class Connected_components<Linear_kinetic_traits_2>;
template class Connected_components<Polynomial_kinetic_traits_2>;
template class Connected_components<Periodic_kinetic_traits_2>;

}  // namespace kinetri
