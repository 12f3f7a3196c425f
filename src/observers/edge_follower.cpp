// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/edge_follower.h"

#include <utility>

namespace kinetri {

// ---- the graph ----

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
    std::vector<Point_id>& neighbors = nodes_[id].neighbors;
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
    if (triangulation_->contains(id)) graph_.set_point(id, triangulation_->vertex(id)->point());
  }
  for (const Edge_ids& edge : triangulation_->finite_edge_ids()) graph_.add(edge);
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
  if (changed_edges_.empty() && changed_points_.empty()) return;
  std::vector<Edge_ids> removed;
  std::vector<Edge_ids> added;
  for (const auto& [edge, change] : std::exchange(changed_edges_, {})) {
    if (change < 0) removed.push_back(edge);
    if (change > 0) added.push_back(edge);
  }
  std::vector<Changed_point> points;
  const auto changed_points = std::exchange(changed_points_, {});
  for (const auto& [id, point] : changed_points) {
    const auto before = graph_.contains(id) ? std::optional(graph_.point(id)) : std::nullopt;
    if (!before && !point) continue;  // it has come and gone
    if (before && point && before->motion() == point->motion()) continue;
    points.push_back({id, before});
  }
  before_change(removed, points);
  for (const Edge_ids& edge : removed) graph_.remove(edge);
  for (const Changed_point& changed : points) {
    graph_.set_point(changed.id, changed_points.at(changed.id));
  }
  for (const Edge_ids& edge : added) graph_.add(edge);
  change(instant_, removed, added, points);
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::before_event(const Event& event) {
  begin_instant(event.time);
}

template <ContactKineticTraits_2 Traits>
void Edge_follower<Traits>::after_event(const Event& event) {
  if (event.removed) --changed_edges_[*event.removed];
  if (event.added) ++changed_edges_[*event.added];
  if (event.kind == Event_kind::hide || event.kind == Event_kind::reveal) return;
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (!id) continue;
    changed_points_[*id] = triangulation_->contains(*id)
                               ? std::optional(triangulation_->vertex(*id)->point())
                               : std::nullopt;
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
