// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/edge_follower.h"

#include <utility>

namespace kinetri {
namespace {

constexpr auto first_of = [](const auto& pair) { return pair.first; };

// Keeps the last event of each point, and sorts them.
template <class Event>
void keep_last(std::vector<std::pair<Point_id, Event>>& events) {
  std::ranges::reverse(events);
  std::ranges::stable_sort(events, {}, first_of);
  const auto same_point = [](const auto& a, const auto& b) { return a.first == b.first; };
  events.erase(std::unique(events.begin(), events.end(), same_point), events.end());
}

}  // namespace

// ---- the graph ----

template <class Traits>
std::vector<Edge_ids> Neighbor_graph<Traits>::edges() const {
  std::vector<Edge_ids> result;
  for (Point_id id = 0; id < next_id(); ++id) {
    for (const Point_id other : nodes_[id].neighbors) {
      if (id < other) result.push_back({id, other});
    }
  }
  std::ranges::sort(result);
  return result;
}

template <class Traits>
void Neighbor_graph<Traits>::set_point(Point_id id, const std::optional<Point_2>& point) {
  if (id >= nodes_.size()) nodes_.resize(std::size_t{id} + 1);
  nodes_[id].point = point;
}

template <class Traits>
void Neighbor_graph<Traits>::add(const Edge_ids& edge) {
  nodes_[edge[0]].neighbors.push_back(edge[1]);
  nodes_[edge[1]].neighbors.push_back(edge[0]);
}

template <class Traits>
void Neighbor_graph<Traits>::remove(const Edge_ids& edge) {
  const auto remove_from = [this](Point_id id, Point_id other) {
    auto& neighbors = nodes_[id].neighbors;
    *std::ranges::find(neighbors, other) = neighbors.back();
    neighbors.pop_back();
  };
  remove_from(edge[0], edge[1]);
  remove_from(edge[1], edge[0]);
}

// ---- the follower ----

template <ContactKineticTraits_2 Traits>
Edge_follower<Traits>::Edge_follower(Simulation_2<Traits>& simulation)
    : triangulation_(&simulation.triangulation()),
      stop_observing_([this, &simulation] { simulation.remove_observer(*this); }) {
  start();
  simulation.add_observer(*this);
}

template <ContactKineticTraits_2 Traits>
Edge_follower<Traits>::Edge_follower(Triangulation& triangulation)
    : triangulation_(&triangulation),
      stop_observing_([this, &triangulation] { triangulation.remove_observer(*this); }) {
  start();
  triangulation.add_observer(*this);
}

template <ContactKineticTraits_2 Traits>
Edge_follower<Traits>::~Edge_follower() {
  stop_observing_();
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::start() {
  instant_ = triangulation_->current_time();
  graph_.nodes_.resize(triangulation_->next_id());
  for (Point_id id = 0; id < triangulation_->next_id(); ++id) {
    if (!triangulation_->contains(id)) continue;
    graph_.set_point(id, triangulation_->point(id));
    if (const auto shown = hidden_by(id)) graph_.hidden_by_.emplace(id, *shown);
  }
  for (const Edge_ids& edge : triangulation_->finite_edge_ids()) graph_.add(edge);
  for (const auto& [id, shown] : graph_.hidden_by_) graph_.add({shown, id});
}

// The point that hides a point with the same motion now, if it exists.
template <ContactKineticTraits_2 Traits>
std::optional<Point_id> Edge_follower<Traits>::hidden_by(Point_id id) const {
  if (!triangulation_->contains(id)) return std::nullopt;
  const Point_id shown = triangulation_->vertex(id)->point().id();
  return shown == id ? std::nullopt : std::optional(shown);
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::update() {
  begin_instant(triangulation_->current_time());
  finish_instant();
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::begin_instant(const Time& time) {
  if (instant_ == time) return;
  finish_instant();
  advance(time);
  instant_ = time;
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::finish_instant() {
  if (!edge_events_.empty() || !point_events_.empty() || !hiding_events_.empty()) {
    finish_changes();
  }
  if (rebuilt_edges_.empty()) return;
  std::ranges::sort(rebuilt_edges_);
  const auto again = std::ranges::unique(rebuilt_edges_);
  rebuilt_edges_.erase(again.begin(), again.end());
  change_triangles(rebuilt_edges_);
  rebuilt_edges_.clear();
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::finish_changes() {
  sum_up_hiding();
  sum_up_edges();
  sum_up_points();
  before_change(removed_, points_);
  for (const Edge_ids& edge : removed_) graph_.remove(edge);
  for (const Changed_point& changed : points_) {
    const auto last = std::ranges::lower_bound(point_events_, changed.id, {}, first_of);
    graph_.set_point(changed.id, last->second);
  }
  for (const auto& [id, shown] : hiding_events_) {
    graph_.hidden_by_.erase(id);
    if (shown) graph_.hidden_by_.emplace(id, *shown);
  }
  for (const Edge_ids& edge : added_) graph_.add(edge);
  hiding_events_.clear();
  edge_events_.clear();
  point_events_.clear();
  change(instant_, removed_, added_, points_);
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::sum_up_edges() {
  removed_.clear();
  added_.clear();
  std::ranges::sort(edge_events_);
  for (auto event = edge_events_.begin(); event != edge_events_.end();) {
    const Edge_ids edge = event->first;
    int sum = 0;
    for (; event != edge_events_.end() && event->first == edge; ++event) sum += event->second;
    if (sum < 0) removed_.push_back(edge);
    if (sum > 0) added_.push_back(edge);
  }
}

// The edges of coincident points with the points that hide them.
template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::sum_up_hiding() {
  keep_last(hiding_events_);
  for (const auto& [id, shown] : hiding_events_) {
    if (const auto before = graph_.hidden_by(id)) {
      edge_events_.emplace_back(Edge_ids{*before, id}, -1);
    }
    if (shown) edge_events_.emplace_back(Edge_ids{*shown, id}, 1);
  }
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::sum_up_points() {
  points_.clear();
  keep_last(point_events_);
  for (const auto& [id, point] : point_events_) {
    const auto before = graph_.contains(id) ? std::optional(graph_.point(id)) : std::nullopt;
    if (!before && !point) continue;  // it has been inserted and erased
    if (before && point && before->motion() == point->motion()) continue;
    points_.push_back({id, before});
  }
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::before_event(const Event& event) {
  begin_instant(event.time);
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::after_event(const Event& event) {
  if (event.removed) edge_events_.emplace_back(*event.removed, -1);
  if (event.added) edge_events_.emplace_back(*event.added, 1);
  if (event.kind == Event_kind::hide || event.kind == Event_kind::reveal) return;
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (!id) continue;
    point_events_.emplace_back(*id, triangulation_->contains(*id)
                                        ? std::optional(triangulation_->point(*id))
                                        : std::nullopt);
  }
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::after_rebuild(const Time& time, std::span<const Edge_ids> edges) {
  begin_instant(time);
  rebuilt_edges_.insert(rebuilt_edges_.end(), edges.begin(), edges.end());
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::after_hiding(const Time& time, std::span<const Point_id> points) {
  begin_instant(time);
  for (const Point_id id : points) {
    const auto shown = hidden_by(id);
    if (shown || graph_.hidden_by(id) || !hiding_events_.empty()) {
      hiding_events_.emplace_back(id, shown);
    }
  }
}

#define KINETRI_INSTANTIATE(Traits)      \
  template class Neighbor_graph<Traits>; \
  template class Edge_follower<Traits>
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
