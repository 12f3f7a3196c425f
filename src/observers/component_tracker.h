// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implementation of Connected_components.
#ifndef KINETRI_SRC_OBSERVERS_COMPONENT_TRACKER_H
#define KINETRI_SRC_OBSERVERS_COMPONENT_TRACKER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/observers/connected_components.h"
#include "observers/departures.h"
#include "observers/dynamic_connectivity.h"
#include "observers/edge_follower.h"
#include "observers/failure_queue.h"
#include "observers/later_time_in_range.h"

namespace kinetri::detail {

/// Invariant, at the last reported time: the connectivity has the edges of the graph whose ends are
/// in range, except those still to be cut at that time; the queue has an entry for each edge whose
/// ends will come in or out of range.
template <ContactKineticTraits_2 Traits>
class Component_tracker final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Point_2;
  using typename Edge_follower<Traits>::Time;

  /// Observes a triangulation or a simulation.
  template <class Observed>
  Component_tracker(Observed& observed, double range)
      : Edge_follower<Traits>(observed), range_(range) {
    KINETRI_PRECONDITION(range >= 0 && std::isfinite(range), "a range is at least 0 and finite");
    const auto& graph = this->graph();
    const std::vector<Edge_ids> edges = graph.edges();
    const Time& time = now();
    for (Point_id id = 0; id < graph.next_id(); ++id) {
      if (graph.contains(id)) connectivity_.add_point(id);
    }
    for (const Edge_ids& edge : edges) {
      if (is_in_range(edge, time)) connectivity_.add_edge(edge);
    }
    report(Kind::start, time);
    for (const Edge_ids& edge : edges) schedule(edge, time);
  }

  double range() const { return range_; }
  const std::vector<Component_event>& events() {
    look();
    return events_;
  }
  const Dynamic_connectivity& connectivity() {
    look();
    return connectivity_;
  }

  /// As Connected_components::watch. The smaller id is first.
  void watch(const Edge_ids& pair) {
    this->update();  // links that end now still exist
    if (std::ranges::find(watched_, pair, &Watched_pair::points) != watched_.end()) return;
    watched_.push_back({pair});
    look_at_watched(now());
  }
  /// The times up to now of such a pair; none if it is not watched.
  std::optional<std::vector<Time_interval>> connected_intervals(const Edge_ids& pair) {
    look();
    const auto watched = std::ranges::find(watched_, pair, &Watched_pair::points);
    if (watched == watched_.end()) return std::nullopt;
    std::vector<Time_interval> result = watched->intervals;
    if (watched->since) result.push_back({*watched->since, now()});
    return result;
  }

 private:
  using typename Edge_follower<Traits>::Changed_point;
  using Kind = Component_event_kind;

  // In the order in which they are executed at one time.
  enum class Entry_kind : std::uint8_t { begin, end };

  // Which entries of the last time are due.
  enum class Due : std::uint8_t { begins, all };

  // The time at which a link begins or ends.
  struct Entry : Failure {
    Edge_ids edge = {no_point, no_point};
    Entry_kind kind = Entry_kind::begin;
  };
  using Queue = Failure_queue<Entry, Component_tracker>;
  friend Queue;

  struct Watched_pair {
    Edge_ids points;
    std::optional<Time> since = std::nullopt;  // if they are connected
    std::vector<Time_interval> intervals = {};
  };

  // An edge that has an entry.
  struct Scheduled_edge {
    Point_id other;  // the greater id
    Queue_handle event;
  };

  const Time& now() const { return this->triangulation().current_time(); }

  // Advances to just after the current time.
  void look() {
    this->update();
    execute_until(now(), Due::all);
  }

  void execute_until(const Time& time, Due due) {
    const auto waits = [due](const Entry& entry) {
      return due == Due::begins && entry.kind == Entry_kind::end;
    };
    while (const auto next = queue_.take_due(time, waits)) {
      forget(next->entry.edge);
      if (next->entry.is_recheck) {
        schedule(next->entry.edge, next->time);
      } else {
        execute(next->entry, next->time);
      }
    }
  }

  // ---- called by the base ----

  // Links that end at `time` are not cut yet: without the edges just after it, a component might
  // seem to split.
  void advance(const Time& time) override { execute_until(time, Due::begins); }

  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override {
    for (const Edge_ids& edge : removed) queue_.erase(forget(edge));
    for (const Edge_ids& edge : edges_of(points)) queue_.erase(forget(edge));
  }

  // First merges, then splits: at the time itself all links exist.
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override {
    for (const auto& point : points) {
      if (connectivity_.contains(point.id)) continue;
      connectivity_.add_point(point.id);
      report(Kind::insert, time, {point.id, no_point});
    }
    std::vector<Edge_ids> changed = edges_of(points);
    changed.insert(changed.end(), added.begin(), added.end());
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    std::vector<Edge_ids> ended(removed.begin(), removed.end());
    for (const Edge_ids& edge : changed) {
      if (is_in_range(edge, time)) {
        link(edge, time);
      } else {
        ended.push_back(edge);
      }
    }
    // Links that exist at this time only.
    departures_.change(time, points, this->graph(), range_, 0,
                       [&](const auto& gone, const auto& come) {
                         if (!connectivity_.contains(gone.id())) return;
                         if (!this->traits().do_touch(gone, come, range_, time)) return;
                         ended.push_back(edge_ids(gone.id(), come.id()));
                         link(ended.back(), time);
                       });
    std::ranges::sort(ended);
    for (const Edge_ids& edge : ended) cut(edge, time);
    for (const auto& point : points) {
      if (this->graph().contains(point.id)) continue;
      connectivity_.remove_point(point.id);
      report(Kind::erase, time, {point.id, no_point});
    }
    for (const Edge_ids& edge : changed) schedule(edge, time);
    execute_until(time, Due::all);
  }

  bool is_in_range(const Edge_ids& edge, const Time& time) const {
    return this->traits().do_touch(this->graph().point(edge[0]), this->graph().point(edge[1]),
                                   range_, time);
  }

  // ---- the queue ----

  Time failure_time(const Entry& entry) const {
    return this->traits().contact_failure(this->graph().point(entry.edge[0]),
                                          this->graph().point(entry.edge[1]), range_, entry.bounds);
  }
  bool precedes(const Entry& a, const Entry& b) const {
    return std::tie(a.kind, a.edge) < std::tie(b.kind, b.edge);
  }

  // Schedules the next change of an edge. Precondition: it has no entry; it is linked if and only
  // if its ends are within the range at `time`.
  void schedule(const Edge_ids& edge, const Time& time) {
    const Point_2& p = this->graph().point(edge[0]);
    const Point_2& q = this->graph().point(edge[1]);
    if (connectivity_.is_edge(edge)) {
      push(edge, Entry_kind::end, this->traits().near_certificate(p, q, range_, time));
    } else {
      push(edge, Entry_kind::begin, this->traits().apart_certificate(p, q, range_, time));
    }
  }

  void push(const Edge_ids& edge, Entry_kind kind, Certificate certificate) {
    Entry entry;
    entry.edge = edge;
    entry.kind = kind;
    const Queue_handle event = queue_.push(entry, std::move(certificate));
    if (event == no_event) return;
    if (edge[0] >= scheduled_.size()) scheduled_.resize(this->graph().next_id());
    scheduled_[edge[0]].push_back({edge[1], event});
  }

  // Returns the entry of an edge; no_event if it has none.
  Queue_handle forget(const Edge_ids& edge) {
    if (edge[0] >= scheduled_.size()) return no_event;
    auto& scheduled = scheduled_[edge[0]];
    const auto found = std::ranges::find(scheduled, edge[1], &Scheduled_edge::other);
    if (found == scheduled.end()) return no_event;
    const Queue_handle event = found->event;
    *found = scheduled.back();
    scheduled.pop_back();
    return event;
  }

  void execute(const Entry& entry, const Time& time) {
    const Point_2& p = this->graph().point(entry.edge[0]);
    const Point_2& q = this->graph().point(entry.edge[1]);
    if (entry.kind == Entry_kind::end) {
      cut(entry.edge, time);
      push(entry.edge, Entry_kind::begin,
           this->traits().next_apart_certificate(p, q, range_, time));
      return;
    }
    link(entry.edge, time);
    // A filter cannot decide the end from `time` on, when the certificate is 0.
    schedule(entry.edge, entry.changes_sign ? Time(later_time_in_range(this->traits(), p, q, range_,
                                                                       entry.bounds.upper))
                                            : time);
  }

  // ---- changes ----

  std::vector<Edge_ids> edges_of(const auto& points) const {
    std::vector<Edge_ids> edges;
    for (const auto& point : points) {
      if (!this->graph().contains(point.id)) continue;
      for (const Point_id other : this->graph().neighbors(point.id)) {
        edges.push_back(edge_ids(point.id, other));
      }
    }
    return edges;
  }

  void link(const Edge_ids& edge, const Time& time) {
    if (connectivity_.is_edge(edge)) return;
    const std::array<std::size_t, 2> sizes = sizes_at(edge);
    if (connectivity_.add_edge(edge)) report(Kind::merge, time, edge, sizes);
  }

  void cut(const Edge_ids& edge, const Time& time) {
    if (!connectivity_.is_edge(edge) || !connectivity_.remove_edge(edge)) return;
    report(Kind::split, time, edge, sizes_at(edge));
  }

  std::array<std::size_t, 2> sizes_at(const Edge_ids& edge) const {
    return {connectivity_.size_of(edge[0]), connectivity_.size_of(edge[1])};
  }

  void report(Kind kind, const Time& time, const Edge_ids& points = {no_point, no_point},
              const std::array<std::size_t, 2>& sizes = {0, 0}) {
    events_.push_back(
        {time, kind, points, sizes, connectivity_.number_of_components(), connectivity_.largest()});
    look_at_watched(time);
  }

  void look_at_watched(const Time& time) {
    for (auto& [points, since, intervals] : watched_) {
      const bool is_connected = connectivity_.are_connected(points[0], points[1]);
      if (is_connected == since.has_value()) continue;
      if (!is_connected) {
        intervals.push_back({*std::exchange(since, std::nullopt), time});
      } else if (!intervals.empty() && intervals.back().end == time) {
        since = intervals.back().begin;  // several changes at one time
        intervals.pop_back();
      } else {
        since = time;
      }
    }
  }

  double range_;
  Dynamic_connectivity connectivity_;
  std::vector<Component_event> events_;
  std::vector<Watched_pair> watched_;
  Queue queue_{*this};
  std::vector<std::vector<Scheduled_edge>> scheduled_;  // by the smaller id
  Departures<Point_2> departures_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_COMPONENT_TRACKER_H
