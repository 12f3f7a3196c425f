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
template <DistanceKineticTraits_2 Traits>
class Component_tracker final : private Edge_follower<Traits> {
 public:
  using typename Edge_follower<Traits>::Edge_name;
  using typename Edge_follower<Traits>::Image_2;
  using typename Edge_follower<Traits>::Neighbor;
  using typename Edge_follower<Traits>::Point_2;
  using typename Edge_follower<Traits>::Time;
  using Edge_follower<Traits>::is_periodic;
  using Connectivity = Basic_dynamic_connectivity<Edge_name>;

  /// Observes a triangulation or a simulation.
  template <class Observed>
  Component_tracker(Observed& observed, double range)
      : Edge_follower<Traits>(observed), range_(range) {
    KINETRI_PRECONDITION(range >= 0 && std::isfinite(range), "a range is at least 0 and finite");
    const auto& graph = this->graph();
    const std::vector<Edge_name> edges = graph.edges();
    const Time& time = now();
    for (Point_id id = 0; id < graph.next_id(); ++id) {
      if (graph.contains(id)) connectivity_.add_point(id);
    }
    for (const Edge_name& edge : edges) {
      if (is_in_range(edge, time)) connectivity_.add_edge(edge);
    }
    report(Kind::start, time);
    for (const Edge_name& edge : edges) schedule(edge, time);
  }

  double range() const { return range_; }
  const std::vector<Component_event>& events() {
    look();
    return events_;
  }
  const Connectivity& connectivity() {
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
    Edge_name edge = {};
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
    Neighbor other;  // the second end
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

  void before_change(std::span<const Edge_name> removed,
                     std::span<const Changed_point> points) override {
    for (const Edge_name& edge : removed) queue_.erase(forget(edge));
    for (const Edge_name& edge : edges_of(points)) queue_.erase(forget(edge));
  }

  // First merges, then splits: at the time itself all links exist.
  void change(const Time& time, std::span<const Edge_name> removed,
              std::span<const Edge_name> added, std::span<const Changed_point> points) override {
    for (const auto& point : points) {
      if (connectivity_.contains(point.id)) continue;
      connectivity_.add_point(point.id);
      report(Kind::insert, time, Edge_ids{point.id, no_point});
    }
    std::vector<Edge_name> changed = edges_of(points);
    changed.insert(changed.end(), added.begin(), added.end());
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    std::vector<Edge_name> ended(removed.begin(), removed.end());
    for (const Edge_name& edge : changed) {
      if (is_in_range(edge, time)) {
        link(edge, time);
      } else {
        ended.push_back(edge);
      }
    }
    // Links that exist at this time only.
    if constexpr (!is_periodic) {
      departures_.change(time, points, this->graph(), range_, 0,
                         [&](const auto& gone, const auto& come) {
                           if (!connectivity_.contains(gone.id())) return;
                           if (!this->traits().do_touch(gone, come, range_, time)) return;
                           ended.push_back(edge_ids(gone.id(), come.id()));
                           link(ended.back(), time);
                         });
    }
    std::ranges::sort(ended);
    for (const Edge_name& edge : ended) cut(edge, time);
    for (const auto& point : points) {
      if (this->graph().contains(point.id)) continue;
      connectivity_.remove_point(point.id);
      report(Kind::erase, time, Edge_ids{point.id, no_point});
    }
    for (const Edge_name& edge : changed) schedule(edge, time);
    execute_until(time, Due::all);
  }

  bool is_in_range(const Edge_name& edge, const Time& time) const {
    return this->traits().do_touch(this->first_end(edge), this->second_end(edge), range_, time);
  }

  // ---- the queue ----

  Time failure_time(const Entry& entry) const {
    return this->traits().contact_failure(this->first_end(entry.edge), this->second_end(entry.edge),
                                          range_, entry.bounds);
  }
  bool precedes(const Entry& a, const Entry& b) const {
    return std::tie(a.kind, a.edge) < std::tie(b.kind, b.edge);
  }

  // Schedules the next change of an edge. Precondition: it has no entry; it is linked if and only
  // if its ends are within the range at `time`.
  void schedule(const Edge_name& edge, const Time& time) {
    const Image_2& p = this->first_end(edge);
    const Image_2& q = this->second_end(edge);
    if (connectivity_.is_edge(edge)) {
      push(edge, Entry_kind::end, this->traits().near_certificate(p, q, range_, time));
    } else {
      push(edge, Entry_kind::begin, this->traits().apart_certificate(p, q, range_, time));
    }
  }

  void push(const Edge_name& edge, Entry_kind kind, Certificate certificate) {
    Entry entry;
    entry.edge = edge;
    entry.kind = kind;
    const Queue_handle event = queue_.push(entry, std::move(certificate));
    if (event == no_event) return;
    const auto [id, other] = ends_of(edge)[0];
    if (id >= scheduled_.size()) scheduled_.resize(this->graph().next_id());
    scheduled_[id].push_back({other, event});
  }

  // Returns the entry of an edge; no_event if it has none.
  Queue_handle forget(const Edge_name& edge) {
    const auto [id, other] = ends_of(edge)[0];
    if (id >= scheduled_.size()) return no_event;
    auto& scheduled = scheduled_[id];
    const auto found = std::ranges::find(scheduled, other, &Scheduled_edge::other);
    if (found == scheduled.end()) return no_event;
    const Queue_handle event = found->event;
    *found = scheduled.back();
    scheduled.pop_back();
    return event;
  }

  void execute(const Entry& entry, const Time& time) {
    const Image_2& p = this->first_end(entry.edge);
    const Image_2& q = this->second_end(entry.edge);
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

  std::vector<Edge_name> edges_of(const auto& points) const {
    std::vector<Edge_name> edges;
    for (const auto& point : points) {
      if (!this->graph().contains(point.id)) continue;
      for (const Neighbor& other : this->graph().neighbors(point.id)) {
        edges.push_back(pair_of(point.id, other));
      }
    }
    return edges;
  }

  // What an event tells of the components of two points.
  struct Ends {
    std::array<std::size_t, 2> sizes = {0, 0};
    std::array<int, 2> directions = {0, 0};
  };

  Ends ends_at(const Edge_name& edge) const {
    const auto [a, b] = ids_of(edge);
    return {{connectivity_.size_of(a), connectivity_.size_of(b)},
            {connectivity_.wrapping_directions(a), connectivity_.wrapping_directions(b)}};
  }

  void link(const Edge_name& edge, const Time& time) {
    if (connectivity_.is_edge(edge)) return;
    const Ends ends = ends_at(edge);
    if (connectivity_.add_edge(edge)) report_link(Kind::merge, time, edge, ends);
    report_wrapping(time, edge, std::ranges::max(ends.directions));
  }

  void cut(const Edge_name& edge, const Time& time) {
    if (!connectivity_.is_edge(edge)) return;
    const int before = connectivity_.wrapping_directions(ids_of(edge)[0]);
    if (connectivity_.remove_edge(edge)) {
      report_link(Kind::split, time, edge, ends_at(edge));
    } else {
      report_wrapping(time, edge, before);
    }
  }

  // The ends of a link that has begun or ended are in one component, for which `before` directions
  // are known.
  void report_wrapping(const Time& time, const Edge_name& edge, int before) {
    const Point_id id = ids_of(edge)[0];
    const int after = connectivity_.wrapping_directions(id);
    if (before == after) return;
    report_link(before < after ? Kind::wrap : Kind::unwrap, time, edge,
                {{connectivity_.size_of(id), 0}, {before, after}});
  }

  void report_link(Kind kind, const Time& time, const Edge_name& link, const Ends& ends) {
    report(kind, time, ids_of(link), ends, offset_of(link));
  }
  void report(Kind kind, const Time& time, const Edge_ids& points = {no_point, no_point},
              const Ends& ends = {}, const Lattice_offset_2& offset = {}) {
    events_.push_back({time, kind, points, ends.sizes, connectivity_.number_of_components(),
                       connectivity_.largest(), offset, ends.directions,
                       connectivity_.number_of_wrapping_components()});
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
  Connectivity connectivity_;
  std::vector<Component_event> events_;
  std::vector<Watched_pair> watched_;
  Queue queue_{*this};
  std::vector<std::vector<Scheduled_edge>> scheduled_;  // by the smaller id
  Departures<Point_2> departures_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_COMPONENT_TRACKER_H
