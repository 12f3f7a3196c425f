// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the vertices are divided among regions. A triangulation keeps the division between two runs.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_DIVISION_H
#define KINETRI_SRC_TRIANGULATION_REGION_DIVISION_H

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "triangulation/region_effort.h"

namespace kinetri::detail {

/// The versions of faces are numbers of events. Each node has a range of them, above those of the
/// nodes before it.
class Flip_numbers {
 public:
  /// For no nodes.
  Flip_numbers() = default;
  /// Divides 2^bits - 1 numbers among nodes in proportion to the shares. Preconditions: at most 256
  /// nodes; each share is at least 2/4096 of their sum; 12 <= bits <= 24.
  Flip_numbers(std::span<const double> shares, unsigned bits) : block_bits_(bits - table_bits) {
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (const double share : shares) {
      first_.push_back(static_cast<std::uint32_t>(node_.size() << block_bits_));
      node_.insert(node_.end(), static_cast<std::size_t>((1 << table_bits) * share / sum),
                   static_cast<std::uint8_t>(first_.size() - 1));
    }
    first_.push_back(static_cast<std::uint32_t>((node_.size() << block_bits_) - 1));
  }

  /// The first number of a node.
  std::uint32_t first(std::size_t node) const { return first_[node]; }
  /// How many numbers a node has.
  std::size_t size(std::size_t node) const { return first_[node + 1] - first_[node]; }
  /// The node of a number.
  std::size_t node(std::uint32_t number) const { return node_[number >> block_bits_]; }

 private:
  static constexpr unsigned table_bits = 12;

  unsigned block_bits_ = 0;           // of how many numbers a block is
  std::vector<std::uint32_t> first_;  // by node, and the end
  std::vector<std::uint8_t> node_;    // by block
};

/// The region of each vertex, and the state of a run (region_runs.h).
///
/// Regions are the leaves of a binary tree. Its nodes are numbered level by level: the regions,
/// then the unions of two regions each, then those of two such unions; the root, of all points, is
/// last. If there is one region, the root is a second node above it.
struct Region_division {
  /// For the infinite vertex, and for points that were inserted after the division.
  static constexpr std::uint16_t no_region = std::numeric_limits<std::uint16_t>::max();

  std::size_t regions = 0;            ///< their number: a power of two, or 0
  std::vector<std::uint16_t> owners;  ///< by point id, the region that owns the vertex
  /// By node: the number of events since versions were cleared.
  std::vector<std::size_t> flips;
  Flip_numbers numbers;     ///< of events, by node
  double events = 0;        ///< of all windows since the division
  double window_width = 0;  ///< of the next window

  bool runs_windows = false;  ///< whether windows execute the next events, not the sequential loop
  double loop_begin = 0;      ///< since when the sequential loop has run, if windows do not
  std::uint64_t loop_events = 0;  ///< of the loop since then
  Region_effort effort;           ///< decides whether windows pay

  /// Removes the regions; keeps the state of the run.
  void clear() {
    Region_division cleared;
    cleared.window_width = window_width;
    cleared.runs_windows = runs_windows;
    cleared.loop_begin = loop_begin;
    cleared.loop_events = loop_events;
    cleared.effort = effort;
    *this = std::move(cleared);
  }

  /// The region that owns a vertex. The infinite vertex has the id no_point.
  std::uint16_t owner(Point_id id) const { return id < owners.size() ? owners[id] : no_region; }

  /// Whether a node of this level owns a vertex.
  bool owns(std::size_t node, unsigned level, Point_id id) const {
    return std::size_t{owner(id)} >> level == node - first_node(level);
  }
  /// How many nodes the tree has.
  std::size_t nodes() const { return std::max<std::size_t>(2 * regions - 1, 2); }
  /// How many parts a queue has: one for each node, then the two kinds below (docs/PARALLEL.md).
  std::size_t parts() const { return 3 * nodes() - 1 - regions; }
  /// The part for entries that a node other than the root has deferred.
  std::size_t deferred_part(std::size_t node) const { return nodes() + node; }
  /// The part for entries of a union that are due in a window.
  std::size_t due_part(std::size_t node) const { return 2 * nodes() - 1 + node - regions; }
  /// The first node of a level; regions are the level 0.
  std::size_t first_node(unsigned level) const { return 2 * regions - ((2 * regions) >> level); }
  /// The level of a node.
  unsigned level(std::size_t node) const {
    return static_cast<unsigned>(std::bit_width(regions)) -
           static_cast<unsigned>(std::bit_width(2 * regions - 1 - node));
  }
  /// The node above. Precondition: the node is not the root.
  std::size_t above(std::size_t node) const {
    const unsigned l = level(node);
    return first_node(l + 1) + (node - first_node(l)) / 2;
  }
  /// The capacity of a node relative to other nodes: each level has the same sum, but the regions
  /// four times that, since they execute most events.
  double share(std::size_t node) const {
    const auto nodes = static_cast<double>(std::max<std::size_t>(regions >> level(node), 1));
    return (level(node) == 0 ? 4 : 1) / nodes;
  }
  /// The lowest node that two vertices are in: the root if one of them is in no region.
  std::size_t node_of(Point_id a, Point_id b) const {
    const unsigned p = owner(a);
    const unsigned q = owner(b);
    if (p == no_region || q == no_region) return nodes() - 1;
    const auto level = static_cast<unsigned>(std::bit_width(p ^ q));
    return first_node(level) + (p >> level);
  }
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_DIVISION_H
