// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_spanning_tree_2: its edges, their proofs, the tree, and its longest edge.
#ifndef KINETRI_SRC_OBSERVERS_SPANNING_TREE_PROOFS_IMPL_H
#define KINETRI_SRC_OBSERVERS_SPANNING_TREE_PROOFS_IMPL_H

#include <algorithm>
#include <array>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/observers/kinetic_spanning_tree_2.h"

namespace kinetri {

// ---- edges ----

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::find(const Edge_ids& ids) const -> Index {
  if (ids[0] >= ends_.size()) return no_edge;
  const auto& ends = ends_[ids[0]];
  const auto found = std::ranges::find(ends, ids[1], &Greater_end::id);
  return found == ends.end() ? no_edge : found->edge;
}

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::insert(const Edge_ids& ids) -> Index {
  if (free_edges_.empty()) {
    free_edges_.push_back(static_cast<Index>(edges_.size()));
    edges_.emplace_back();
  }
  const Index edge = free_edges_.back();
  free_edges_.pop_back();
  edges_[edge].ids = ids;
  ends_[ids[0]].push_back({ids[1], edge});
  return edge;
}

// Precondition: it is not in the tree, supports no edge, and is not scheduled.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::erase(Index edge) {
  auto& ends = ends_[edges_[edge].ids[0]];
  *std::ranges::find(ends, edge, &Greater_end::edge) = ends.back();
  ends.pop_back();
  edges_[edge] = {};
  free_edges_.push_back(edge);
}

// For what may be wrong: an order to begin with.
template <ContactKineticTraits_2 Traits>
double Kinetic_spanning_tree_2<Traits>::rounded_square_length(Index edge) const {
  const double time = now_.interval().lower;
  const Vector_2 p = rounded_place(end(edge, 0).motion(), time);
  const Vector_2 q = rounded_place(end(edge, 1).motion(), time);
  return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
}

// ---- comparisons, and the queue ----

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::closer(Index near, Index far) const -> Closer {
  Certificate certificate =
      this->traits().closer_certificate(end(near, 0), end(near, 1), end(far, 0), end(far, 1), now_);
  if (certificate.kind == Certificate::Kind::fails) {
    const bool fails_now = certificate.bounds.lower <= now_.interval().upper &&
                           time_of(certificate, near, far) == now_;
    if (fails_now) return {};
  } else if (certificate.may_vanish && edges_[near].ids > edges_[far].ids &&
             distance_comparison_polynomial(end(near, 0), end(near, 1), end(far, 0), end(far, 1))
                 .is_zero()) {
    return {};
  }
  return {true, std::move(certificate)};
}

template <ContactKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::is_longer(Index a, Index b) const {
  return closer(b, a).holds;
}

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::time_of(const Certificate& certificate, Index near,
                                              Index far) const -> Time {
  if (certificate.kind == Certificate::Kind::holds) return Time(certificate.bounds.lower);
  if (certificate.failure) return *certificate.failure;
  return this->traits().closer_failure(end(near, 0), end(near, 1), end(far, 0), end(far, 1),
                                       certificate.bounds);
}

template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::failure_time(const Entry& entry) const -> Time {
  return this->traits().closer_failure(end(entry.near, 0), end(entry.near, 1), end(entry.far, 0),
                                       end(entry.far, 1), entry.bounds);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::schedule(Index owner, Index near, Index far,
                                               Certificate certificate) {
  Entry entry;
  entry.owner = owner;
  entry.near = near;
  entry.far = far;
  edges_[owner].event = queue_.push(entry, std::move(certificate));
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::unschedule(Index owner) {
  queue_.erase(std::exchange(edges_[owner].event, no_event));
}

// ---- proofs ----

// An edge that is not in the tree has lost its proof.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::suspect(Index edge) {
  if (edges_[edge].is_suspect) return;
  withdraw_support(edge);
  unschedule(edge);
  edges_[edge].is_suspect = true;
  suspects_.push_back(edge);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::suspect_dependents(Index edge) {
  const std::vector<Index> dependents = edges_[edge].dependents;
  for (const Index dependent : dependents) suspect(dependent);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::withdraw_support(Index edge) {
  for (const Index other : std::exchange(edges_[edge].supports, {})) {
    auto& dependents = edges_[other].dependents;
    *std::ranges::find(dependents, edge) = dependents.back();
    dependents.pop_back();
  }
}

// The order does not matter: there is one minimum spanning tree. Each edge that is examined gets a
// proof or comes into the tree, mostly for a longer one, which is suspected then.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::examine_suspects() {
  for (std::size_t i = 0; i < suspects_.size(); ++i) {
    const Index edge = suspects_[i];
    if (!std::exchange(edges_[edge].is_suspect, false)) continue;
    if (!find_triangle(edge)) find_path(edge);
  }
  suspects_.clear();
}

// Looks for a triangle of which the edge is the longest one. It need not be one of the
// triangulation.
template <ContactKineticTraits_2 Traits>
bool Kinetic_spanning_tree_2<Traits>::find_triangle(Index edge) {
  const auto [a, b] = edges_[edge].ids;
  for (const Point_id corner : this->graph().neighbors(a)) {
    const Index to_b = find(edge_ids(corner, b));
    if (to_b == no_edge) continue;
    const Index to_a = find(edge_ids(corner, a));
    Closer first = closer(to_a, edge);
    if (!first.holds) continue;
    Closer second = closer(to_b, edge);
    if (!second.holds) continue;
    std::vector<Certificate> certificates;
    certificates.push_back(std::move(first.certificate));
    certificates.push_back(std::move(second.certificate));
    support(edge, {to_a, to_b}, std::move(certificates));
    return true;
  }
  return false;
}

// The edge comes into the tree if it joins two parts of it, or if the longest edge of the path
// between its ends is longer; else the path supports it.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::find_path(Index edge) {
  std::optional<std::vector<Index>> found = path(edges_[edge].ids[0], edges_[edge].ids[1]);
  if (!found) {
    add_to_tree(edge);
    return;
  }
  std::vector<Certificate> certificates;
  Index longest = no_edge;
  for (const Index other : *found) {
    Closer comparison = closer(other, edge);
    if (comparison.holds) {
      certificates.push_back(std::move(comparison.certificate));
    } else if (longest == no_edge || is_longer(other, longest)) {
      longest = other;
    }
  }
  if (longest == no_edge) {
    support(edge, std::move(*found), std::move(certificates));
    return;
  }
  remove_from_tree(longest);
  add_to_tree(edge);
  suspect(longest);
}

// Schedules the first failure of the certificates, which are those that the supports are shorter. A
// path stays a proof when an edge of it leaves the tree: it is one in the triangulation.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::support(Index edge, std::vector<Index> supports,
                                              std::vector<Certificate> certificates) {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    edges_[supports[i]].dependents.push_back(edge);
    const Certificate& certificate = certificates[i];
    if (certificate.kind == Certificate::Kind::never_fails) continue;
    const auto is_earlier = [&] {
      if (!first) return true;
      const Certificate& earliest = certificates[*first];
      if (certificate.bounds.upper < earliest.bounds.lower) return true;
      if (certificate.bounds.lower > earliest.bounds.upper) return false;
      return time_of(certificate, supports[i], edge) < time_of(earliest, supports[*first], edge);
    };
    if (is_earlier()) first = i;
  }
  if (first) schedule(edge, supports[*first], edge, std::move(certificates[*first]));
  edges_[edge].supports = std::move(supports);
}

// ---- the forest ----

// The edges between two points; none if they are in different trees. Climbs from both in step.
// Cost: O(the distance from the farther of the two to where they meet).
template <ContactKineticTraits_2 Traits>
auto Kinetic_spanning_tree_2<Traits>::path(Point_id a, Point_id b)
    -> std::optional<std::vector<Index>> {
  std::array<Point_id, 2> at = {a, b};
  const std::array<std::uint64_t, 2> numbers = {++searches_, ++searches_};
  for (std::size_t i = 0; i < 2; ++i) nodes_[at[i]].seen = numbers[i];
  Point_id meeting = no_point;
  for (std::size_t i = 0; meeting == no_point; i = 1 - i) {
    const Point_id parent = nodes_[at[i]].parent;
    if (parent == no_point) {
      if (nodes_[at[1 - i]].parent == no_point) return std::nullopt;
      continue;
    }
    at[i] = parent;
    if (nodes_[parent].seen == numbers[1 - i]) meeting = parent;
    nodes_[parent].seen = numbers[i];
  }
  std::vector<Index> result;
  for (const Point_id end : {a, b}) {
    for (Point_id id = end; id != meeting; id = nodes_[id].parent) {
      result.push_back(nodes_[id].edge);
    }
  }
  return result;
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::make_root(Point_id id) {
  Node above;
  while (id != no_point) {
    const Node node = nodes_[id];
    nodes_[id].parent = above.parent;
    nodes_[id].edge = above.edge;
    above.parent = id;
    above.edge = node.edge;
    id = node.parent;
  }
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::add_to_tree(Index edge) {
  const auto [a, b] = edges_[edge].ids;
  make_root(a);
  nodes_[a].parent = b;
  nodes_[a].edge = edge;
  edges_[edge].is_in_tree = true;
  ++changed_[edges_[edge].ids];
  new_in_tree_.push_back(edge);
}

template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::remove_from_tree(Index edge) {
  const auto [a, b] = edges_[edge].ids;
  Node& child = nodes_[nodes_[a].edge == edge ? a : b];
  KINETRI_ASSERT(child.edge == edge, "an edge of the tree leads to a parent");
  child.parent = no_point;
  child.edge = no_edge;
  edges_[edge].is_in_tree = false;
  --changed_[edges_[edge].ids];
  unschedule(edge);
  if (edge == longest_) longest_ = no_edge;
}

// ---- the longest edge ----

// Compares the edges that have come into the tree with the longest one, or all, if that has gone.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::find_longest() {
  const std::vector<Index> added = std::exchange(new_in_tree_, {});
  if (longest_ == no_edge) {
    compare_all_with_longest();
    return;
  }
  for (const Index edge : added) {
    if (!edges_[edge].is_in_tree || edge == longest_) continue;
    unschedule(edge);
    Closer comparison = closer(edge, longest_);
    if (!comparison.holds) {
      longest_ = edge;
      compare_all_with_longest();
      return;
    }
    schedule(edge, edge, longest_, std::move(comparison.certificate));
  }
}

// Begins with longest_, or if there is none, with an edge that seems to be it, and goes on to each
// edge that is longer.
template <ContactKineticTraits_2 Traits>
void Kinetic_spanning_tree_2<Traits>::compare_all_with_longest() {
  std::vector<Index> tree;
  for (Index edge = 0; edge < edges_.size(); ++edge) {
    if (!edges_[edge].is_in_tree) continue;
    tree.push_back(edge);
    unschedule(edge);
  }
  if (tree.empty()) return;
  if (longest_ == no_edge) {
    longest_ = *std::ranges::max_element(
        tree, {}, [this](Index edge) { return rounded_square_length(edge); });
  }
  std::vector<std::pair<Index, Certificate>> certificates;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i] == longest_) continue;
    Closer comparison = closer(tree[i], longest_);
    if (comparison.holds) {
      certificates.emplace_back(tree[i], std::move(comparison.certificate));
      continue;
    }
    longest_ = tree[i];
    certificates.clear();
    i = static_cast<std::size_t>(-1);  // all again
  }
  for (auto& [edge, certificate] : certificates) {
    schedule(edge, edge, longest_, std::move(certificate));
  }
}

}  // namespace kinetri

#endif  // KINETRI_SRC_OBSERVERS_SPANNING_TREE_PROOFS_IMPL_H
