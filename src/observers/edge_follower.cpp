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
auto Neighbor_graph<Traits>::edges() const -> std::vector<Edge_name> {
  std::vector<Edge_name> result;
  for (Point_id id = 0; id < next_id(); ++id) {
    for (const Neighbor& other : nodes_[id].neighbors) {
      if (detail::is_first(id, other)) result.push_back(detail::pair_of(id, other));
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
void Neighbor_graph<Traits>::add(const Edge_name& edge) {
  for (const auto& [id, other] : detail::ends_of(edge)) nodes_[id].neighbors.push_back(other);
}

template <class Traits>
void Neighbor_graph<Traits>::remove(const Edge_name& edge) {
  for (const auto& [id, other] : detail::ends_of(edge)) {
    auto& neighbors = nodes_[id].neighbors;
    *std::ranges::find(neighbors, other) = neighbors.back();
    neighbors.pop_back();
  }
}

// ---- the follower ----

template <DistanceKineticTraits_2 Traits>
Edge_follower<Traits>::~Edge_follower() {
  stop_observing_();
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::start() {
  instant_ = triangulation_->current_time();
  graph_.nodes_.resize(triangulation_->next_id());
  for (Point_id id = 0; id < triangulation_->next_id(); ++id) {
    if (!triangulation_->contains(id)) continue;
    graph_.set_point(id, triangulation_->point(id));
    if (const auto link = present_link(id)) graph_.links_.emplace(id, *link);
  }
  if constexpr (is_periodic) {
    for (const Edge_name& edge : triangulation_->periodic_edges()) graph_.add(edge);
  } else {
    for (const Edge_name& edge : triangulation_->finite_edge_ids()) graph_.add(edge);
  }
  for (const auto& [id, link] : graph_.links_) graph_.add(link);
}

// The link of a point with the one that hides it and has the same motion now, if it exists.
template <DistanceKineticTraits_2 Traits>
auto Edge_follower<Traits>::present_link(Point_id id) const -> std::optional<Edge_name> {
  if (!triangulation_->contains(id)) return std::nullopt;
  const Point_2& shown = triangulation_->vertex(id)->point();
  if (shown.id() == id) return std::nullopt;
  if constexpr (is_periodic) {
    // The same at all times.
    const auto at = traits().instantaneous_traits(Instant{instant_, Time_side::at});
    const Point_2& hidden = triangulation_->point(id);
    return Edge_name{{shown.id(), id},
                     detail::whole_vectors(at, hidden, at.image(shown, Lattice_offset_2()))};
  } else {
    return Edge_name{shown.id(), id};
  }
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::update() {
  begin_instant(triangulation_->current_time());
  finish_instant();
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::begin_instant(const Time& time) {
  if (instant_ == time) return;
  finish_instant();
  advance(time);
  instant_ = time;
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::finish_instant() {
  if (!edge_events_.empty() || !point_events_.empty() || !hiding_events_.empty()) {
    finish_changes();
  }
  if (rebuilt_edges_.empty()) return;
  std::ranges::sort(rebuilt_edges_);
  rebuilt_edges_.erase(std::unique(rebuilt_edges_.begin(), rebuilt_edges_.end()),
                       rebuilt_edges_.end());
  change_triangles(rebuilt_edges_);
  rebuilt_edges_.clear();
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::finish_changes() {
  sum_up_hiding();
  sum_up_edges();
  sum_up_points();
  before_change(removed_, points_);
  for (const Edge_name& edge : removed_) graph_.remove(edge);
  for (const Changed_point& changed : points_) {
    const auto last = std::ranges::lower_bound(point_events_, changed.id, {}, first_of);
    graph_.set_point(changed.id, last->second);
  }
  for (const auto& [id, link] : hiding_events_) {
    graph_.links_.erase(id);
    if (link) graph_.links_.emplace(id, *link);
  }
  for (const Edge_name& edge : added_) graph_.add(edge);
  hiding_events_.clear();
  edge_events_.clear();
  point_events_.clear();
  change(instant_, removed_, added_, points_);
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::sum_up_edges() {
  removed_.clear();
  added_.clear();
  std::ranges::sort(edge_events_);
  for (auto event = edge_events_.begin(); event != edge_events_.end();) {
    const Edge_name edge = event->first;
    int sum = 0;
    for (; event != edge_events_.end() && event->first == edge; ++event) sum += event->second;
    if (sum < 0) removed_.push_back(edge);
    if (sum > 0) added_.push_back(edge);
  }
}

// The links of coincident points.
template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::sum_up_hiding() {
  keep_last(hiding_events_);
  for (const auto& [id, link] : hiding_events_) {
    if (const auto before = graph_.link(id)) edge_events_.emplace_back(*before, -1);
    if (link) edge_events_.emplace_back(*link, 1);
  }
}

template <DistanceKineticTraits_2 Traits>
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

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::before_event(const Event& event) {
  begin_instant(event.time);
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::after_event(const Event& event) {
  const auto note = [this](const Edge_ids& ids, [[maybe_unused]] const Lattice_offset_2& offset,
                           int change) {
    if constexpr (is_periodic) {
      edge_events_.emplace_back(Edge_name{ids, offset}, change);
    } else {
      edge_events_.emplace_back(ids, change);
    }
  };
  if (event.removed) note(*event.removed, event.removed_offset, -1);
  if (event.added) note(*event.added, event.added_offset, 1);
  if (event.kind == Event_kind::hide || event.kind == Event_kind::reveal) return;
  for (const std::optional<Point_id>& id : {event.point_a, event.point_b}) {
    if (!id) continue;
    if constexpr (is_periodic) {
      // If it still coincides with others, perhaps at other images of them.
      if (triangulation_->contains(*id)) {
        std::vector<Point_id> coincident = triangulation_->coincident_points(*id);
        if (!coincident.empty()) coincident.push_back(*id);
        for (const Point_id other : coincident) {
          hiding_events_.emplace_back(other, present_link(other));
        }
      }
    }
    point_events_.emplace_back(*id, triangulation_->contains(*id)
                                        ? std::optional(triangulation_->point(*id))
                                        : std::nullopt);
  }
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::after_rebuild(const Time& time, std::span<const Edge_ids> edges) {
  begin_instant(time);
  rebuilt_edges_.insert(rebuilt_edges_.end(), edges.begin(), edges.end());
}

template <DistanceKineticTraits_2 Traits>
void Edge_follower<Traits>::after_hiding(const Time& time, std::span<const Point_id> points) {
  begin_instant(time);
  for (const Point_id id : points) {
    const auto link = present_link(id);
    if (link || graph_.link(id) || !hiding_events_.empty()) hiding_events_.emplace_back(id, link);
  }
}

#define KINETRI_INSTANTIATE(Traits)      \
  template class Neighbor_graph<Traits>; \
  template class Edge_follower<Traits>
KINETRI_INSTANTIATE(Linear_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_kinetic_traits_2);
KINETRI_INSTANTIATE(Disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Polynomial_disc_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_kinetic_traits_2);
KINETRI_INSTANTIATE(Periodic_disc_kinetic_traits_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
