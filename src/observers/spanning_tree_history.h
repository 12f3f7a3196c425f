// SPDX-License-Identifier: GPL-3.0-or-later
//
// The changes of a spanning tree, and its longest edge over time.
#ifndef KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H
#define KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/observers/kinetic_spanning_tree_2.h"
#include "observers/connecting_range.h"

namespace kinetri::detail {

/// Invariant: all changes are recorded except those counted since the last record(), which are at
/// one time; the longest edges are in the order of time.
template <class Point_2>
class Spanning_tree_history {
 public:
  using Time = Algebraic_number;

  /// A time during which one edge was the longest, with one motion.
  struct Longest_piece {
    Time since;
    std::optional<Edge_ids> edge = std::nullopt;
    Point_2 p = Point_2();
    Point_2 q = Point_2();
  };

  /// The edge has entered the tree (1) or left it (-1).
  void count(const Edge_ids& ids, int change) { changed_[ids] += change; }
  /// Discards the counts: they are the state at the start.
  void forget_counts() { changed_.clear(); }

  /// Records the counts as the change at longest.since, and the longest edge from then on.
  void record(Longest_piece longest) {
    Spanning_tree_change change = {longest.since, {}, {}};
    for (const auto& [ids, number] : std::exchange(changed_, {})) {
      if (number < 0) change.removed.push_back(ids);
      if (number > 0) change.added.push_back(ids);
    }
    if (!change.removed.empty() || !change.added.empty()) changes_.push_back(std::move(change));
    const bool is_known = !longest_.empty() && longest_.back().edge == longest.edge &&
                          longest_.back().p.motion() == longest.p.motion() &&
                          longest_.back().q.motion() == longest.q.motion();
    if (!is_known) longest_.push_back(std::move(longest));
  }

  const std::vector<Spanning_tree_change>& changes() const { return changes_; }
  std::vector<Longest_edge> longest_edges() const {
    std::vector<Longest_edge> result;
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
  std::optional<Connecting_range> connecting_range(const Time& now) const {
    const auto& [since, edge, p, q] = longest_.back();
    if (!edge) return std::nullopt;
    return Connecting_range{length_at(detail::squared_distance(p, q), now), *edge, now};
  }
  /// The greatest or the least one up to the present time.
  std::optional<Connecting_range> extreme_range(bool greatest, const Time& now) const {
    std::vector<Length_piece> pieces;
    for (std::size_t i = 0; i < longest_.size(); ++i) {
      const auto& [since, edge, p, q] = longest_[i];
      if (!edge) continue;
      const Time& until = i + 1 < longest_.size() ? longest_[i + 1].since : now;
      pieces.push_back({since, until, *edge, detail::squared_distance(p, q)});
    }
    return extreme_length(pieces, greatest);
  }

 private:
  std::map<Edge_ids, int> changed_;  // entries to the tree minus removals
  std::vector<Spanning_tree_change> changes_;
  std::vector<Longest_piece> longest_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_SPANNING_TREE_HISTORY_H
