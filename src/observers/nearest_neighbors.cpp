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
  const auto is_due = [&](const Entry& entry) {
    return queue_.is_due(entry, time.interval(), [&]() -> const Time& { return time; });
  };
  const auto recheck = [this](std::span<const Entry> entries) {
    for (const Entry& entry : entries) handles_[entry.id] = no_event;
    for (const Entry& entry : entries) look_again(entry.id, Time(entry.bounds.lower));
  };
  while (queue_.settle(is_due, recheck)) {
    const Time now = queue_.time(queue_.top());
    const Entry entry = queue_.pop();
    handles_[entry.id] = no_event;
    look_again(entry.id, now);
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
  std::optional<Failure> first;
  for (const Point_id other : neighbors) {
    if (other == nearest) continue;
    std::optional<Failure> next = failure(id, nearest, other, time);
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
  std::optional<Failure> next = failure(id, nearest, other, time);
  if (!next) return;
  if (handles_[id] != no_event) {
    const Entry& known = queue_[handles_[id]];
    const auto& bounds = next->entry.bounds;
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
                                        const Time& time) const -> std::optional<Failure> {
  const auto& graph = this->graph();
  const auto& p = graph.point(id);
  const Certificate certificate =
      this->traits().closer_certificate(p, graph.point(nearest), p, graph.point(rival), time);
  if (certificate.kind == Certificate::Kind::never_fails) return std::nullopt;
  Failure result;
  result.entry.bounds = certificate.bounds;
  result.entry.id = id;
  result.entry.nearest = nearest;
  result.entry.rival = rival;
  result.entry.is_recheck = certificate.kind == Certificate::Kind::holds;
  if (certificate.failure) result.time = *certificate.failure;
  return result;
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
auto Nearest_neighbors<Traits>::time_of(const Failure& failure) const -> Time {
  return failure.time ? *failure.time : policy_.entry_time(failure.entry);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
bool Nearest_neighbors<Traits>::is_before(const Failure& a, const Failure& b) const {
  if (a.entry.bounds.upper < b.entry.bounds.lower) return true;
  if (b.entry.bounds.upper < a.entry.bounds.lower) return false;
  return time_of(a) < time_of(b);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::push(Failure failure) {
  handles_[failure.entry.id] = failure.time ? queue_.push(failure.entry, std::move(*failure.time))
                                            : queue_.emplace(failure.entry);
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
void Nearest_neighbors<Traits>::unschedule(Point_id id) {
  if (id >= handles_.size() || handles_[id] == no_event) return;  // it may be yet to come
  queue_.erase(std::exchange(handles_[id], no_event));
}

template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits> Algebraic_number
Nearest_neighbors<Traits>::Queue_policy::entry_time(const Entry& entry)
const {
  if (entry.is_recheck) return Time(entry.bounds.lower);
  const auto& graph = observer.graph();
  const auto& p = graph.point(entry.id);
  return observer.traits().closer_failure(p, graph.point(entry.nearest), p,
                                          graph.point(entry.rival), entry.bounds);
}

template class Nearest_neighbors<Linear_kinetic_traits_2>;
template class Nearest_neighbors<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
