// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/connected_components.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "observers/later_time_in_range.h"

namespace kinetri {

std::string_view name(Component_event_kind kind) {
  constexpr std::array<std::string_view, component_event_kinds> names = {"start", "merge", "split",
                                                                         "insert", "erase"};
  return names[static_cast<std::size_t>(kind)];
}

namespace {

void sort_unique(std::vector<Edge_ids>& edges) {
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

// ---- the queue ----

template <ContactKineticTraits_2 Traits>
auto Connected_components<Traits>::failure_time(const Entry& entry) const -> Time {
  const auto& graph = this->graph();
  return this->traits().contact_failure(graph.point(entry.edge[0]), graph.point(entry.edge[1]),
                                        range_, entry.bounds);
}

template <ContactKineticTraits_2 Traits>
bool Connected_components<Traits>::precedes(const Entry& a, const Entry& b) const {
  return std::tie(a.kind, a.edge) < std::tie(b.kind, b.edge);
}

// Schedules the next change of an edge. Precondition: it has no entry; it is linked if and only if
// its ends are within the range at `time`.
template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::schedule(const Edge_ids& edge, const Time& time) {
  const auto& p = this->graph().point(edge[0]);
  const auto& q = this->graph().point(edge[1]);
  if (is_linked(edge)) {
    push(edge, Entry_kind::end, this->traits().near_certificate(p, q, range_, time));
  } else {
    push(edge, Entry_kind::begin, this->traits().apart_certificate(p, q, range_, time));
  }
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::push(const Edge_ids& edge, Entry_kind kind,
                                        Certificate certificate) {
  Entry entry;
  entry.edge = edge;
  entry.kind = kind;
  const Queue_handle event = queue_.push(entry, std::move(certificate));
  if (event == no_event) return;
  if (edge[0] >= scheduled_.size()) scheduled_.resize(this->graph().next_id());
  scheduled_[edge[0]].push_back({edge[1], event});
}

// Returns the entry of an edge; no_event if it has none.
template <ContactKineticTraits_2 Traits>
Queue_handle Connected_components<Traits>::forget(const Edge_ids& edge) {
  if (edge[0] >= scheduled_.size()) return no_event;
  auto& scheduled = scheduled_[edge[0]];
  const auto found = std::ranges::find(scheduled, edge[1], &Scheduled_edge::other);
  if (found == scheduled.end()) return no_event;
  const Queue_handle event = found->event;
  *found = scheduled.back();
  scheduled.pop_back();
  return event;
}

// ---- time ----

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
  const Time& time = this->triangulation().current_time();
  const auto& graph = this->graph();
  const auto edges = this->triangulation().finite_edge_ids();
  for (Point_id id = 0; id < graph.next_id(); ++id) {
    if (graph.contains(id)) connectivity_.add_point(id);
  }
  for (const Edge_ids& edge : edges) {
    if (this->traits().do_touch(graph.point(edge[0]), graph.point(edge[1]), range_, time)) {
      connectivity_.add_edge(edge);
    }
  }
  report(Kind::start, time);
  for (const Edge_ids& edge : edges) schedule(edge, time);
}

// Brings everything to just after the current time.
template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::look() {
  this->update();
  execute_until(this->triangulation().current_time(), Due::all);
}

// The links that end at `time` wait: the edges just after it are not known yet, without which a
// component would seem to split that does not.
template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::advance(const Time& time) {
  execute_until(time, Due::begins);
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::execute_until(const Time& time, Due due) {
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

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::execute(const Entry& entry, const Time& time) {
  const auto& p = this->graph().point(entry.edge[0]);
  const auto& q = this->graph().point(entry.edge[1]);
  if (entry.kind == Entry_kind::end) {
    cut(entry.edge, time);
    push(entry.edge, Entry_kind::begin, this->traits().next_apart_certificate(p, q, range_, time));
    return;
  }
  link(entry.edge, time);
  // At `time` itself no filter could decide when it ends.
  schedule(entry.edge, entry.changes_sign ? Time(detail::later_time_in_range(
                                                this->traits(), p, q, range_, entry.bounds.upper))
                                          : time);
}

// ---- changes ----

template <ContactKineticTraits_2 Traits>
std::vector<Edge_ids> Connected_components<Traits>::edges_of(
    std::span<const Changed_point> points) const {
  std::vector<Edge_ids> edges;
  for (const Changed_point& point : points) {
    if (!this->graph().contains(point.id)) continue;
    for (const Point_id other : this->graph().neighbors(point.id)) {
      edges.push_back(edge_ids(point.id, other));
    }
  }
  return edges;
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::before_change(std::span<const Edge_ids> removed,
                                                 std::span<const Changed_point> points) {
  for (const Edge_ids& edge : removed) queue_.erase(forget(edge));
  for (const Edge_ids& edge : edges_of(points)) queue_.erase(forget(edge));
}

// First all that joins, then all that splits, since at the time itself there is both.
template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::change(const Time& time, std::span<const Edge_ids> removed,
                                          std::span<const Edge_ids> added,
                                          std::span<const Changed_point> points) {
  const auto& graph = this->graph();
  for (const Changed_point& point : points) {
    if (connectivity_.contains(point.id)) continue;
    connectivity_.add_point(point.id);
    report(Kind::insert, time, {point.id, no_point});
  }
  std::vector<Edge_ids> changed = edges_of(points);
  changed.insert(changed.end(), added.begin(), added.end());
  sort_unique(changed);
  std::vector<Edge_ids> ended(removed.begin(), removed.end());
  for (const Edge_ids& edge : changed) {
    if (this->traits().do_touch(graph.point(edge[0]), graph.point(edge[1]), range_, time)) {
      link(edge, time);
    } else {
      ended.push_back(edge);
    }
  }
  // For a moment.
  departures_.change(time, points, graph, range_, 0, [&](const auto& gone, const auto& come) {
    if (!connectivity_.contains(gone.id())) return;
    if (!this->traits().do_touch(gone, come, range_, time)) return;
    ended.push_back(edge_ids(gone.id(), come.id()));
    link(ended.back(), time);
  });
  std::ranges::sort(ended);
  for (const Edge_ids& edge : ended) cut(edge, time);
  for (const Changed_point& point : points) {
    if (graph.contains(point.id)) continue;
    connectivity_.remove_point(point.id);
    report(Kind::erase, time, {point.id, no_point});
  }
  for (const Edge_ids& edge : changed) schedule(edge, time);
  execute_until(time, Due::all);
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::link(const Edge_ids& edge, const Time& time) {
  if (is_linked(edge)) return;
  const std::array<std::size_t, 2> sizes = {connectivity_.size_of(edge[0]),
                                            connectivity_.size_of(edge[1])};
  if (connectivity_.add_edge(edge)) report(Kind::merge, time, edge, sizes);
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::cut(const Edge_ids& edge, const Time& time) {
  if (!is_linked(edge) || !connectivity_.remove_edge(edge)) return;
  report(Kind::split, time, edge, {connectivity_.size_of(edge[0]), connectivity_.size_of(edge[1])});
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::report(Kind kind, const Time& time, const Edge_ids& points,
                                          const std::array<std::size_t, 2>& sizes) {
  events_.push_back(
      {time, kind, points, sizes, connectivity_.number_of_components(), connectivity_.largest()});
  look_at_watched(time);
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
const std::vector<Component_event>& Connected_components<Traits>::events() {
  look();
  return events_;
}

template <ContactKineticTraits_2 Traits>
const Dynamic_connectivity& Connected_components<Traits>::components() {
  look();
  return connectivity_;
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::watch(const Edge_ids& points) {
  KINETRI_PRECONDITION(points[0] != points[1], "a point is always connected with itself");
  this->update();  // Links that end now are still there.
  const Edge_ids pair = edge_ids(points[0], points[1]);
  if (std::ranges::find(watched_, pair, &Watched_pair::points) != watched_.end()) return;
  watched_.push_back({pair});
  look_at_watched(this->triangulation().current_time());
}

template <ContactKineticTraits_2 Traits>
std::vector<Time_interval> Connected_components<Traits>::connected_intervals(
    const Edge_ids& points) {
  look();
  const auto watched =
      std::ranges::find(watched_, edge_ids(points[0], points[1]), &Watched_pair::points);
  KINETRI_PRECONDITION(watched != watched_.end(), "the pair is not watched");
  std::vector<Time_interval> result = watched->intervals;
  if (watched->since) result.push_back({*watched->since, this->triangulation().current_time()});
  return result;
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::look_at_watched(const Time& time) {
  for (auto& [points, since, intervals] : watched_) {
    const bool is_connected = connectivity_.are_connected(points[0], points[1]);
    if (is_connected == since.has_value()) continue;
    if (!is_connected) {
      intervals.push_back({*std::exchange(since, std::nullopt), time});
    } else if (!intervals.empty() && intervals.back().end == time) {
      since = intervals.back().begin;  // changes of one time, one after the other
      intervals.pop_back();
    } else {
      since = time;
    }
  }
}

template class Connected_components<Linear_kinetic_traits_2>;
template class Connected_components<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
