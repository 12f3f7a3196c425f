// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/nearest_neighbors.h"

#include <algorithm>
#include <string>
#include <utility>

namespace kinetri {

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Simulation_2<Traits>& simulation, On_change on_change)
    : Base(simulation), on_change_(std::move(on_change)) {
  start();
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Nearest_neighbors<Traits>::Nearest_neighbors(
    Triangulation& triangulation, On_change on_change)
    : Base(triangulation), on_change_(std::move(on_change)) {
  start();
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::start() {
  const Time& now = this->triangulation().current_time();
  nearest_.assign(this->graph().next_id(), no_point);
  handles_.assign(nearest_.size(), no_event);
  for (Point_id id = 0; id < this->graph().next_id(); ++id) {
    if (this->graph().contains(id)) look_again(id, now);
  }
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> std::optional<Point_id>
Nearest_neighbors<Traits>::nearest_neighbor(Point_id id) {
  this->update();
  KINETRI_PRECONDITION(this->graph().contains(id),
                       "there is no point with the id " + std::to_string(id));
  return nearest_[id] == no_point ? std::nullopt : std::optional(nearest_[id]);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Point_id>& Nearest_neighbors<Traits>::nearest_neighbors() {
  this->update();
  nearest_.resize(this->triangulation().next_id(), no_point);
  return nearest_;
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
const std::vector<Nearest_neighbor_change>& Nearest_neighbors<Traits>::changes() {
  this->update();
  report();
  return changes_;
}

// ---- what happens ----

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::advance(const Time& time) {
  while (const auto due = queue_.take_due(time)) {
    handles_[due->entry.id] = no_event;
    look_again(due->entry.id, due->time);
  }
}

// Entries are about neighbors. So what is to be looked at again are the points that change and
// their neighbors, and who loses the neighbor that its entry is about.
template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::before_change(std::span<const Edge_ids> removed,
                                              std::span<const Changed_point> points) {
  again_.clear();
  for (const Changed_point& changed : points) {
    again_.push_back(changed.id);
    if (!changed.before) continue;
    const auto neighbors = this->graph().neighbors(changed.id);
    again_.insert(again_.end(), neighbors.begin(), neighbors.end());
  }
  for (const Edge_ids& edge : removed) {
    for (const auto& [id, other] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])}) {
      const bool is_rival = handles_[id] != no_event && queue_[handles_[id]].rival == other;
      if (is_rival || nearest_[id] == other) again_.push_back(id);
    }
  }
  std::ranges::sort(again_);
  again_.erase(std::unique(again_.begin(), again_.end()), again_.end());
  for (const Point_id id : again_) unschedule(id);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::change(const Time& time, std::span<const Edge_ids> /*removed*/,
                                       std::span<const Edge_ids> added,
                                       std::span<const Changed_point> /*points*/) {
  nearest_.resize(this->triangulation().next_id(), no_point);
  handles_.resize(nearest_.size(), no_event);
  for (const Point_id id : again_) {
    if (this->graph().contains(id)) {
      look_again(id, time);
    } else {
      set_nearest(id, no_point, time);
    }
  }
  for (const Edge_ids& edge : added) {
    for (const auto& [id, other] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])}) {
      if (!std::ranges::binary_search(again_, id)) look_at(id, other, time);
    }
  }
}

// ---- the nearest one ----

// Whether a is to be named rather than b.
template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
bool Nearest_neighbors<Traits>::is_nearer(Point_id id, Point_id a, Point_id b,
                                          const Instant& after) const {
  const auto& graph = this->graph();
  const auto instantaneous = this->traits().instantaneous_traits(after);
  const auto order =
      instantaneous.compare_distance_2_object()(graph.point(id), graph.point(a), graph.point(b));
  return order == CGAL::EQUAL ? a < b : order == CGAL::SMALLER;
}

// Finds the nearest neighbor of a point, and when it fails. Precondition: the point has no entry.
template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::look_again(Point_id id, const Time& time) {
  const auto neighbors = this->graph().neighbors(id);
  const Instant after = {time, Time_side::after};
  Point_id nearest = no_point;
  for (const Point_id other : neighbors) {
    if (nearest == no_point || is_nearer(id, other, nearest, after)) nearest = other;
  }
  set_nearest(id, nearest, time);
  std::optional<Next_failure> first;
  for (const Point_id other : neighbors) {
    if (other == nearest) continue;
    std::optional<Next_failure> next = failure(id, nearest, other, time);
    if (next && (!first || is_before(*next, *first))) first = std::move(next);
  }
  if (first) push(std::move(*first));
}

// A point has another neighbor.
template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::look_at(Point_id id, Point_id other, const Time& time) {
  const Point_id nearest = nearest_[id];
  if (nearest == no_point || is_nearer(id, other, nearest, {time, Time_side::after})) {
    unschedule(id);
    look_again(id, time);
    return;
  }
  std::optional<Next_failure> next = failure(id, nearest, other, time);
  if (!next) return;
  if (handles_[id] != no_event) {
    const Entry& known = queue_[handles_[id]];
    const auto& bounds = next->certificate.bounds;
    if (known.bounds.upper < bounds.lower) return;
    if (bounds.upper >= known.bounds.lower && time_of(*next) >= queue_.time(known)) return;
    unschedule(id);
  }
  push(std::move(*next));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::set_nearest(Point_id id, Point_id nearest, const Time& time) {
  if (nearest_[id] == nearest) return;
  if (changed_.empty() || changed_at_ != time) {
    report();
    changed_at_ = time;
  }
  changed_.emplace(id, nearest_[id]);
  nearest_[id] = nearest;
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::report() {
  for (const auto& [id, before] : std::exchange(changed_, {})) {
    if (before == nearest_[id]) continue;
    const Nearest_neighbor_change change = {changed_at_, id, before, nearest_[id]};
    if (on_change_) {
      on_change_(change);
    } else {
      changes_.push_back(change);
    }
  }
}

// ---- failures ----

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::failure(Point_id id, Point_id nearest, Point_id rival,
                                        const Time& time) const -> std::optional<Next_failure> {
  const auto& graph = this->graph();
  const auto& p = graph.point(id);
  Next_failure result;
  result.entry.id = id;
  result.entry.nearest = nearest;
  result.entry.rival = rival;
  result.certificate =
      this->traits().closer_certificate(p, graph.point(nearest), p, graph.point(rival), time);
  if (result.certificate.kind == Certificate::Kind::never_fails) return std::nullopt;
  return result;
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::time_of(const Next_failure& failure) const -> Time {
  const Certificate& certificate = failure.certificate;
  if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
  if (certificate.failure) return *certificate.failure;
  Entry entry = failure.entry;
  entry.bounds = certificate.bounds;
  return failure_time(entry);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
bool Nearest_neighbors<Traits>::is_before(const Next_failure& a, const Next_failure& b) const {
  if (a.certificate.bounds.upper < b.certificate.bounds.lower) return true;
  if (b.certificate.bounds.upper < a.certificate.bounds.lower) return false;
  return time_of(a) < time_of(b);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::push(Next_failure failure) {
  handles_[failure.entry.id] = queue_.push(failure.entry, std::move(failure.certificate));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::unschedule(Point_id id) {
  if (id >= handles_.size()) return;  // it may be yet to come
  queue_.erase(std::exchange(handles_[id], no_event));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::failure_time(const Entry& entry) const -> Time {
  const auto& graph = this->graph();
  const auto& p = graph.point(entry.id);
  return this->traits().closer_failure(p, graph.point(entry.nearest), p, graph.point(entry.rival),
                                       entry.bounds);
}

template class Nearest_neighbors<Linear_kinetic_traits_2>;
template class Nearest_neighbors<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
