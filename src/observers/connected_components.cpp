// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/connected_components.h"

#include <cmath>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "observers/component_tracker.h"

namespace kinetri {

std::string_view name(Component_event_kind kind) {
  constexpr std::array<std::string_view, component_event_kinds> names = {"start", "merge", "split",
                                                                         "insert", "erase"};
  return names[static_cast<std::size_t>(kind)];
}

template <ContactKineticTraits_2 Traits>
Connected_components<Traits>::Connected_components(Simulation_2<Traits>& simulation, double range)
    : Edge_follower<Traits>(simulation), range_(range) {
  start();
}

template <ContactKineticTraits_2 Traits>
Connected_components<Traits>::Connected_components(Triangulation& triangulation, double range)
    : Edge_follower<Traits>(triangulation), range_(range) {
  start();
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::start() {
  KINETRI_PRECONDITION(range_ >= 0 && std::isfinite(range_), "a range is at least 0 and finite");
  tracker_ = std::make_shared<Tracker>(this->graph(), this->traits(), range_, now(),
                                       this->graph().edges());
}

template <ContactKineticTraits_2 Traits>
auto Connected_components<Traits>::now() const -> const Time& {
  return this->triangulation().current_time();
}

// Advances to just after the current time.
template <ContactKineticTraits_2 Traits>
auto Connected_components<Traits>::present() -> const Tracker& {
  this->update();
  tracker_->execute_until(now(), Tracker::Due::all);
  return *tracker_;
}

// ---- called by the base ----

// Links that end at `time` are not cut yet: without the edges just after it, a component might seem
// to split.
template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::advance(const Time& time) {
  tracker_->execute_until(time, Tracker::Due::begins);
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::before_change(std::span<const Edge_ids> removed,
                                                 std::span<const Changed_point> points) {
  tracker_->before_change(removed, points);
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::change(const Time& time, std::span<const Edge_ids> removed,
                                          std::span<const Edge_ids> added,
                                          std::span<const Changed_point> points) {
  tracker_->change(time, removed, added, points);
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
const std::vector<Component_event>& Connected_components<Traits>::events() {
  return present().events();
}

template <ContactKineticTraits_2 Traits>
bool Connected_components<Traits>::contains(Point_id id) {
  return present().connectivity().contains(id);
}

template <ContactKineticTraits_2 Traits>
auto Connected_components<Traits>::component(Point_id id) -> Component {
  return present().connectivity().component(id);
}

template <ContactKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::size_of(Point_id id) {
  return present().connectivity().size_of(id);
}

template <ContactKineticTraits_2 Traits>
bool Connected_components<Traits>::are_connected(Point_id a, Point_id b) {
  return present().connectivity().are_connected(a, b);
}

template <ContactKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::number_of_components() {
  return present().connectivity().number_of_components();
}

template <ContactKineticTraits_2 Traits>
std::size_t Connected_components<Traits>::largest() {
  return present().connectivity().largest();
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::watch(const Edge_ids& points) {
  KINETRI_PRECONDITION(points[0] != points[1], "a point is always connected with itself");
  this->update();  // links that end now still exist
  tracker_->watch(edge_ids(points[0], points[1]), now());
}

template <ContactKineticTraits_2 Traits>
std::vector<Time_interval> Connected_components<Traits>::connected_intervals(
    const Edge_ids& points) {
  auto result = present().connected_intervals(edge_ids(points[0], points[1]), now());
  KINETRI_PRECONDITION(result.has_value(), "the pair is not watched");
  return *std::move(result);
}

template class Connected_components<Linear_kinetic_traits_2>;
template class Connected_components<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
