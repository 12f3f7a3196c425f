// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implementation of Nearest_neighbors.
#ifndef KINETRI_SRC_OBSERVERS_NEAREST_TRACKER_H
#define KINETRI_SRC_OBSERVERS_NEAREST_TRACKER_H

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/observers/nearest_neighbors.h"
#include "observers/edge_follower.h"
#include "observers/failure_queue.h"

namespace kinetri::detail {

/// Invariant, at the last reported time: each point has its nearest neighbor, and an entry in the
/// queue with the first time at which another neighbor becomes nearer, if one does.
template <DistanceKineticTraits_2 Traits>
class Nearest_tracker final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Neighbor;
  using typename Edge_follower<Traits>::Time;
  using Change = Nearest_neighbor_change;
  using On_change = std::function<void(const Change&)>;

  /// Observes a triangulation or a simulation. Changes are stored if `on_change` is empty.
  template <class Observed>
  Nearest_tracker(Observed& observed, On_change on_change)
      : Edge_follower<Traits>(observed),
        on_change_(std::move(on_change)),
        nearest_(this->graph().next_id(), no_neighbor<Traits>()),
        handles_(nearest_.size(), no_event) {
    for (Point_id id = 0; id < this->graph().next_id(); ++id) {
      if (this->graph().contains(id)) look_again(id, this->triangulation().current_time());
    }
  }

  Neighbor nearest(Point_id id) {
    this->update();
    KINETRI_PRECONDITION(this->graph().contains(id),
                         "there is no point with the id " + std::to_string(id));
    return nearest_[id];
  }
  const std::vector<Neighbor>& all_nearest() {
    this->update();
    nearest_.resize(this->triangulation().next_id(), no_neighbor<Traits>());
    return nearest_;
  }
  const std::vector<Change>& changes() {
    this->update();
    report();
    return changes_;
  }

 private:
  using typename Edge_follower<Traits>::Changed_point;

  // The first failure of the nearest neighbor of a point.
  struct Entry : Failure {
    Point_id id = no_point;
    Neighbor nearest = {};
    Neighbor rival = {};  // becomes nearer than `nearest`
  };
  using Queue = Failure_queue<Entry, Nearest_tracker>;
  friend Queue;

  // An entry that is not in the queue yet, with its certificate.
  struct Next_failure {
    Entry entry;
    Certificate certificate;
  };

  // ---- called by the base ----

  void advance(const Time& time) override {
    while (const auto due = queue_.take_due(time)) {
      handles_[due->entry.id] = no_event;
      look_again(due->entry.id, due->time);
    }
  }

  // To be updated: changed points and their neighbors, and points that lose the neighbor of their
  // entry or their nearest one.
  void before_change(std::span<const Edge_name> removed,
                     std::span<const Changed_point> points) override {
    again_.clear();
    for (const auto& changed : points) {
      again_.push_back(changed.id);
      if (!changed.before) continue;
      for (const Neighbor& other : this->graph().neighbors(changed.id)) {
        again_.push_back(id_of(other));
      }
    }
    for (const Edge_name& edge : removed) {
      for (const auto& [id, other] : ends_of(edge)) {
        const bool is_rival = handles_[id] != no_event && queue_[handles_[id]].rival == other;
        if (is_rival || nearest_[id] == other) again_.push_back(id);
      }
    }
    std::ranges::sort(again_);
    again_.erase(std::unique(again_.begin(), again_.end()), again_.end());
    for (const Point_id id : again_) unschedule(id);
  }

  void change(const Time& time, std::span<const Edge_name> /*removed*/,
              std::span<const Edge_name> added,
              std::span<const Changed_point> /*points*/) override {
    nearest_.resize(this->triangulation().next_id(), no_neighbor<Traits>());
    handles_.resize(nearest_.size(), no_event);
    for (const Point_id id : again_) {
      if (this->graph().contains(id)) {
        look_again(id, time);
      } else {
        set_nearest(id, no_neighbor<Traits>(), time);
      }
    }
    for (const Edge_name& edge : added) {
      for (const auto& [id, other] : ends_of(edge)) {
        if (!std::ranges::binary_search(again_, id)) look_at(id, other, time);
      }
    }
  }

  // ---- the nearest one ----

  // Whether a is nearer than b, or equally near with the smaller name.
  bool is_nearer(Point_id id, const Neighbor& a, const Neighbor& b, const Instant& after) const {
    const auto instantaneous = this->traits().instantaneous_traits(after);
    const auto order =
        instantaneous.compare_distance_2_object()(this->itself(id), this->image(a), this->image(b));
    return order == CGAL::EQUAL ? a < b : order == CGAL::SMALLER;
  }

  // Finds the nearest neighbor of a point, and its first failure. Precondition: the point has no
  // entry.
  void look_again(Point_id id, const Time& time) {
    const auto neighbors = this->graph().neighbors(id);
    const Instant after = {time, Time_side::after};
    Neighbor nearest = no_neighbor<Traits>();
    for (const Neighbor& other : neighbors) {
      if (id_of(nearest) == no_point || is_nearer(id, other, nearest, after)) nearest = other;
    }
    set_nearest(id, nearest, time);
    std::optional<Next_failure> first;
    for (const Neighbor& other : neighbors) {
      if (other == nearest) continue;
      std::optional<Next_failure> next = failure(id, nearest, other, time);
      if (next && (!first || is_before(*next, *first))) first = std::move(next);
    }
    if (first) push(std::move(*first));
  }

  // A point has got a further neighbor.
  void look_at(Point_id id, const Neighbor& other, const Time& time) {
    const Neighbor nearest = nearest_[id];
    if (id_of(nearest) == no_point || is_nearer(id, other, nearest, {time, Time_side::after})) {
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

  void set_nearest(Point_id id, const Neighbor& nearest, const Time& time) {
    if (nearest_[id] == nearest) return;
    if (changed_.empty() || changed_at_ != time) {
      report();
      changed_at_ = time;
    }
    changed_.emplace(id, nearest_[id]);
    nearest_[id] = nearest;
  }

  void report() {
    for (const auto& [id, before] : std::exchange(changed_, {})) {
      if (before == nearest_[id]) continue;
      Change change = {changed_at_, id, id_of(before), id_of(nearest_[id])};
      if constexpr (Edge_follower<Traits>::is_periodic) {
        change.before_offset = before.offset;
        change.after_offset = nearest_[id].offset;
      }
      if (on_change_) {
        on_change_(change);
      } else {
        changes_.push_back(change);
      }
    }
  }

  // ---- failures ----

  std::optional<Next_failure> failure(Point_id id, const Neighbor& nearest, const Neighbor& rival,
                                      const Time& time) const {
    const auto& p = this->itself(id);
    Next_failure result;
    result.entry.id = id;
    result.entry.nearest = nearest;
    result.entry.rival = rival;
    result.certificate =
        this->traits().closer_certificate(p, this->image(nearest), p, this->image(rival), time);
    if (result.certificate.kind == Certificate::Kind::never_fails) return std::nullopt;
    return result;
  }

  Time time_of(const Next_failure& failure) const {
    const Certificate& certificate = failure.certificate;
    if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
    if (certificate.failure) return *certificate.failure;
    Entry entry = failure.entry;
    entry.bounds = certificate.bounds;
    return failure_time(entry);
  }

  bool is_before(const Next_failure& a, const Next_failure& b) const {
    if (a.certificate.bounds.upper < b.certificate.bounds.lower) return true;
    if (b.certificate.bounds.upper < a.certificate.bounds.lower) return false;
    return time_of(a) < time_of(b);
  }

  void push(Next_failure failure) {
    handles_[failure.entry.id] = queue_.push(failure.entry, std::move(failure.certificate));
  }

  void unschedule(Point_id id) {
    if (id >= handles_.size()) return;  // it may not exist yet
    queue_.erase(std::exchange(handles_[id], no_event));
  }

  Time failure_time(const Entry& entry) const {
    const auto& p = this->itself(entry.id);
    return this->traits().closer_failure(p, this->image(entry.nearest), p, this->image(entry.rival),
                                         entry.bounds);
  }
  bool precedes(const Entry& a, const Entry& b) const { return a.id < b.id; }

  On_change on_change_;
  std::vector<Neighbor> nearest_;
  std::vector<Queue_handle> handles_;  // by id; no_event of none
  std::vector<Change> changes_;
  // The unreported changes at `changed_at_`: the nearest neighbors before.
  std::map<Point_id, Neighbor> changed_;
  Time changed_at_;
  std::vector<Point_id> again_;  // to be updated in the present change; sorted
  Queue queue_{*this};
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_NEAREST_TRACKER_H
