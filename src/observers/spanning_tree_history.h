// SPDX-License-Identifier: GPL-3.0-or-later
//
// The changes of a spanning tree, and its longest edge over time.
#ifndef KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H
#define KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/observers/kinetic_spanning_tree_2.h"
#include "observers/connecting_range.h"

namespace kinetri::detail {

/// @{
/// Whether the ends of one edge have the same motion.
template <class Motion>
bool are_same(const Motion& a, const Motion& b) {
  return a == b;
}
inline bool are_same(const Image_motion_2& a, const Image_motion_2& b) {
  return a.motion == b.motion && a.offset == b.offset;
}
/// @}

/// Invariant: all changes are recorded except those counted since the last record(), which are at
/// one time; the longest edges are in the order of time. `End` is an end of an edge with its
/// motion.
template <class Edge, class End>
class Spanning_tree_history {
 public:
  using Time = Algebraic_number;
  using Change = Basic_spanning_tree_change<Edge>;
  using Range = Basic_connecting_range<Edge>;

  /// A time during which one edge was the longest, with one motion.
  struct Longest_piece {
    Time since;
    std::optional<Edge> edge = std::nullopt;
    End p = End();
    End q = End();
  };

  /// The edge has entered the tree (1) or left it (-1).
  void count(const Edge& edge, int change) { changed_[edge] += change; }
  /// Discards the counts: they are the state at the start.
  void forget_counts() { changed_.clear(); }

  /// Records the counts as the change at longest.since, and the longest edge from then on.
  void record(Longest_piece longest) {
    Change change = {longest.since, {}, {}};
    for (const auto& [edge, number] : std::exchange(changed_, {})) {
      if (number < 0) change.removed.push_back(edge);
      if (number > 0) change.added.push_back(edge);
    }
    if (!change.removed.empty() || !change.added.empty()) changes_.push_back(std::move(change));
    const bool is_known = !longest_.empty() && longest_.back().edge == longest.edge &&
                          are_same(longest_.back().p.motion(), longest.p.motion()) &&
                          are_same(longest_.back().q.motion(), longest.q.motion());
    if (!is_known) longest_.push_back(std::move(longest));
  }

  const std::vector<Change>& changes() const { return changes_; }
  std::vector<Basic_longest_edge<Edge>> longest_edges() const {
    std::vector<Basic_longest_edge<Edge>> result;
    for (const Longest_piece& piece : longest_) {
      if (!result.empty() && result.back().time == piece.since) result.pop_back();
      if (!result.empty() && result.back().edge == piece.edge) continue;
      result.push_back({piece.since, piece.edge});
      if (!piece.edge) continue;
      result.back().length =
          length_at(detail::squared_distance(piece.p, piece.q), piece.since).to_double();
    }
    return result;
  }

  /// At the present time.
  std::optional<Range> connecting_range(const Time& now) const {
    const auto& [since, edge, p, q] = longest_.back();
    if (!edge) return std::nullopt;
    return Range{length_at(detail::squared_distance(p, q), now), *edge, now};
  }
  /// The greatest or the least one up to the present time.
  std::optional<Range> extreme_range(bool greatest, const Time& now) const {
    std::vector<Length_piece> pieces;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < longest_.size(); ++i) {
      const auto& [since, edge, p, q] = longest_[i];
      if (!edge) continue;
      const Time& until = i + 1 < longest_.size() ? longest_[i + 1].since : now;
      pieces.push_back({since, until, detail::squared_distance(p, q)});
      edges.push_back(*edge);
    }
    const std::optional<Extreme_length> extreme = extreme_length(pieces, greatest);
    if (!extreme) return std::nullopt;
    return Range{extreme->length, edges[extreme->piece], extreme->time};
  }

 private:
  std::map<Edge, int> changed_;  // entries to the tree minus removals
  std::vector<Change> changes_;
  std::vector<Longest_piece> longest_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H
