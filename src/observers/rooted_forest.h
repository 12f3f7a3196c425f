// SPDX-License-Identifier: GPL-3.0-or-later
//
// A dynamic forest of points.
#ifndef KINETRI_SRC_OBSERVERS_ROOTED_FOREST_H
#define KINETRI_SRC_OBSERVERS_ROOTED_FOREST_H

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/base/check.h"

namespace kinetri::detail {

/// A forest whose edges have indices. Invariant: each point has a parent and the edge to it, or is
/// the root of its tree.
class Rooted_forest {
 public:
  using Index = std::uint32_t;  ///< of an edge
  static constexpr Index no_edge = std::numeric_limits<Index>::max();

  /// Resizes to the points with ids below `next_id`. New points have no edges.
  void resize(Point_id next_id) { nodes_.resize(next_id); }

  /// The edges of the path between two points; none if they are in different trees. Climbs from
  /// both alternately. Cost: O(the greater distance of the two to their common ancestor).
  std::optional<std::vector<Index>> path(Point_id a, Point_id b) {
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

  /// Adds an edge. Precondition: its ends are in different trees. Cost: O(the depth of the first).
  void add(Index edge, const Edge_ids& ends) {
    make_root(ends[0]);
    nodes_[ends[0]].parent = ends[1];
    nodes_[ends[0]].edge = edge;
  }

  /// Removes an edge.
  void remove(Index edge, const Edge_ids& ends) {
    Node& child = nodes_[ends[nodes_[ends[0]].edge == edge ? 0 : 1]];
    KINETRI_ASSERT(child.edge == edge, "an edge of the tree leads to a parent");
    child.parent = no_point;
    child.edge = no_edge;
  }

 private:
  struct Node {
    Point_id parent = no_point;
    Index edge = no_edge;    // to the parent
    std::uint64_t seen = 0;  // the last search that has visited it
  };

  void make_root(Point_id id) {
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

  std::vector<Node> nodes_;
  std::uint64_t searches_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_ROOTED_FOREST_H
