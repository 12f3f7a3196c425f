// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/kinetic_spanning_tree_2.h"

#include <algorithm>
#include <utility>

#include "observers/connecting_range.h"
#include "observers/spanning_tree_proofs_impl.h"

namespace kinetri {

// ---- time ----

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation)
    : Edge_follower<Traits>(simulation) {
  start();
}

template <ContactKineticTraits_2 Traits>
Kinetic_spanning_tree_2<Traits>::Kinetic_spanning_tree_2(Triangulation& triangulation)
    : Edge_follower<Traits>(triangulation) {
  start();
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::start() {
  now_ = this->triangulation().current_time();
  nodes_.resize(this->graph().next_id());
  ends_.resize(this->graph().next_id());
  std::vector<std::pair<double, Index>> by_length;
  for (const Edge_ids& ids : this->triangulation().finite_edge_ids()) {
    const Index edge = insert(ids);
    by_length.emplace_back(rounded_square_length(edge), edge);
  }
  std::ranges::sort(by_length);
  for (const auto& [length, edge] : by_length) suspect(edge);
  examine_suspects();
  find_longest();
  changed_.clear();
  record();
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::look() {
  this->update();
  execute_until(this->triangulation().current_time());
  record();
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::advance(const Time& time) {
  execute_until(time);
  begin(time);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::begin(const Time& time) {
  if (time == now_) return;
  record();
  now_ = time;
}

// Notes what has changed at now_.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::record() {
  Spanning_tree_change change = {now_, {}, {}};
  for (const auto& [ids, number] : std::exchange(changed_, {})) {
    if (number < 0) change.removed.push_back(ids);
    if (number > 0) change.added.push_back(ids);
  }
  if (!change.removed.empty() || !change.added.empty()) changes_.push_back(std::move(change));

  Longest_piece piece = {now_, std::nullopt};
  if (longest_ != no_edge) piece = {now_, edges_[longest_].ids, end(longest_, 0), end(longest_, 1)};
  const bool is_known = !longest_pieces_.empty() && longest_pieces_.back().edge == piece.edge &&
                        longest_pieces_.back().p.motion() == piece.p.motion() &&
                        longest_pieces_.back().q.motion() == piece.q.motion();
  if (!is_known) longest_pieces_.push_back(std::move(piece));
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::execute_until(const Time& time) {
  while (const auto due = queue_.take_due(time)) {
    const Entry& entry = due->entry;
    begin(due->time);
    edges_[entry.owner].event = no_event;
    if (!edges_[entry.owner].is_in_tree) {
      suspect(entry.owner);
      examine_suspects();
    } else if (entry.is_recheck) {
      new_in_tree_.push_back(entry.owner);
    } else {
      longest_ = entry.owner;
      compare_all_with_longest();
    }
    find_longest();
  }
}

// ---- changes ----

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::before_change(std::span<const Edge_ids> removed,
                                                    std::span<const Changed_point> points) {
  std::vector<Edge_ids> affected(removed.begin(), removed.end());
  for (const Changed_point& point : points) {
    if (!this->graph().contains(point.id)) continue;
    for (const Point_id other : this->graph().neighbors(point.id)) {
      affected.push_back(edge_ids(point.id, other));
    }
  }
  std::ranges::sort(affected);
  affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  // Everything that goes by one of them leaves the queue before anything else.
  for (const Edge_ids& ids : affected) {
    const Index edge = find(ids);
    suspect_dependents(edge);
    if (edge != longest_) continue;
    for (Index other = 0; other < edges_.size(); ++other) {
      if (edges_[other].is_in_tree) unschedule(other);
    }
    longest_ = no_edge;
  }
  for (const Edge_ids& ids : affected) {
    const Index edge = find(ids);
    if (edges_[edge].is_in_tree) remove_from_tree(edge);
    suspect(edge);
    if (std::ranges::binary_search(removed, ids)) erase(edge);
  }
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::change(const Time& /*time*/,
                                             std::span<const Edge_ids> /*removed*/,
                                             std::span<const Edge_ids> added,
                                             std::span<const Changed_point> /*points*/) {
  nodes_.resize(this->graph().next_id());
  ends_.resize(this->graph().next_id());
  for (const Edge_ids& ids : added) suspect(insert(ids));
  examine_suspects();
  find_longest();
}

// ---- answers ----

template <ContactKineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_spanning_tree_2<Traits>::edges() {
  look();
  std::vector<Edge_ids> result;
  for (const Edge& edge : edges_) {
    if (edge.is_in_tree) result.push_back(edge.ids);
  }
  std::ranges::sort(result);
  return result;
}

template <ContactKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::is_edge(const Edge_ids& edge) {
  look();
  const Index found = find(edge);
  return found != no_edge && edges_[found].is_in_tree;
}

template <ContactKineticTraits_2 Traits>
const std::vector<Spanning_tree_change>& Kinetic_spanning_tree_2<Traits>::changes() {
  look();
  return changes_;
}

template <ContactKineticTraits_2 Traits>
std::optional<Edge_ids> Kinetic_spanning_tree_2<Traits>::longest_edge() {
  look();
  return longest_pieces_.back().edge;
}

template <ContactKineticTraits_2 Traits>
std::vector<Longest_edge> Kinetic_spanning_tree_2<Traits>::longest_edges() {
  look();
  std::vector<Longest_edge> result;
  for (const Longest_piece& piece : longest_pieces_) {
    if (!result.empty() && result.back().time == piece.since) result.pop_back();
    if (!result.empty() && result.back().edge == piece.edge) continue;
    result.push_back({piece.since, piece.edge});
    if (!piece.edge) continue;
    result.back().length =
        detail::length_at(detail::squared_distance(piece.p, piece.q), piece.since).to_double();
  }
  return result;
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::connecting_range() {
  look();
  const auto& [since, edge, p, q] = longest_pieces_.back();
  if (!edge) return std::nullopt;
  const Time& time = this->triangulation().current_time();
  return Connecting_range{detail::length_at(detail::squared_distance(p, q), time), *edge, time};
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::least_connecting_range() {
  return extreme_range(false);
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::greatest_connecting_range() {
  return extreme_range(true);
}

template <ContactKineticTraits_2 Traits>
std::optional<Connecting_range> Kinetic_spanning_tree_2<Traits>::extreme_range(bool greatest) {
  look();
  std::vector<detail::Length_piece> pieces;
  for (std::size_t i = 0; i < longest_pieces_.size(); ++i) {
    const auto& [since, edge, p, q] = longest_pieces_[i];
    if (!edge) continue;
    const Time& until = i + 1 < longest_pieces_.size() ? longest_pieces_[i + 1].since
                                                       : this->triangulation().current_time();
    pieces.push_back({since, until, *edge, detail::squared_distance(p, q)});
  }
  return detail::extreme_length(pieces, greatest);
}

template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri
