// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/connected_components.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <tuple>
#include <utility>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"

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

// The certificate that two points remain apart after `t`, just after which they are.
template <class Traits>
Certificate next_apart_certificate(const typename Traits::Point_2& p,
                                   const typename Traits::Point_2& q, double range,
                                   const Algebraic_number& t) {
  // On straight lines two that part never meet again: their distance is convex.
  if constexpr (std::same_as<typename Traits::Motion, Linear_motion_2>) return {};
  std::optional<Real_root> touch = first_root_after(contact_polynomial(p, q, range), t);
  if (!touch) return {};
  Certificate result;
  result.kind = Certificate::Kind::fails;
  result.bounds = touch->value.interval();
  result.failure = std::make_unique<Algebraic_number>(std::move(touch->value));
  result.means = Certificate::Means::exact;
  return result;
}

}  // namespace

// ---- the queue ----

template <ContactKineticTraits_2 Traits>
auto Connected_components<Traits>::Queue_policy::entry_time(const Entry& entry) const -> Time {
  if (!entry.is_event) return Time(entry.bounds.lower);
  const auto& graph = components.graph();
  return components.traits().contact_failure(graph.point(entry.edge[0]), graph.point(entry.edge[1]),
                                             components.range_, entry.bounds);
}

template <ContactKineticTraits_2 Traits>
bool Connected_components<Traits>::Queue_policy::precedes(const Entry& a, const Entry& b) const {
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
  if (certificate.kind == Certificate::Kind::never_fails) return;
  Entry entry;
  entry.bounds = certificate.bounds;
  entry.edge = edge;
  entry.kind = kind;
  entry.is_event = certificate.kind == Certificate::Kind::fails;
  entry.is_crossing = entry.is_event && !certificate.failure;
  const Queue_handle event = certificate.failure
                                 ? queue_.push(entry, std::move(*certificate.failure))
                                 : queue_.emplace(entry);
  if (edge[0] >= scheduled_.size()) scheduled_.resize(this->graph().next_id());
  scheduled_[edge[0]].push_back({edge[1], event});
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::unschedule(const Edge_ids& edge) {
  const Queue_handle event = forget(edge);
  if (event != no_event) queue_.erase(event);
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
  const Double_interval bounds = time.interval();
  const auto is_due = [&](const Entry& entry) {
    return queue_.is_due(entry, bounds, [&]() -> const Time& { return time; });
  };
  const auto recheck = [this](std::span<const Entry> entries) {
    for (const Entry& entry : entries) {
      forget(entry.edge);
      schedule(entry.edge, Time(entry.bounds.lower));
    }
  };
  while (queue_.settle(is_due, recheck)) {
    const Time now = queue_.time(queue_.top());
    if (due == Due::begins && queue_.top().kind == Entry_kind::end && now == time) return;
    execute(queue_.pop(), now);
  }
}

template <ContactKineticTraits_2 Traits>
void Connected_components<Traits>::execute(const Entry& entry, const Time& time) {
  forget(entry.edge);
  if (entry.kind == Entry_kind::begin) {
    link(entry.edge, time);
    // From where the edge is shorter than the range: at `time` itself no filter could decide.
    schedule(entry.edge, entry.is_crossing ? Time(entry.bounds.upper) : time);
    return;
  }
  cut(entry.edge, time);
  push(entry.edge, Entry_kind::begin,
       next_apart_certificate<Traits>(this->graph().point(entry.edge[0]),
                                      this->graph().point(entry.edge[1]), range_, time));
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
  for (const Edge_ids& edge : removed) unschedule(edge);
  for (const Edge_ids& edge : edges_of(points)) unschedule(edge);
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
