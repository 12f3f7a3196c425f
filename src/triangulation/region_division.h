// SPDX-License-Identifier: GPL-3.0-or-later
//
// The division of vertices among regions, which a triangulation keeps between two runs by regions.
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

/// The numbers of flips, which stamps are: each node has some of its own, greater ones than the
/// nodes before it.
class Flip_numbers {
 public:
  /// Of no nodes.
  Flip_numbers() = default;
  /// Of nodes that share 2^bits numbers, less one. Preconditions: at most 256 nodes; each has at
  /// least 2 in 4096 of the sum of all shares; 12 <= bits <= 24.
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

/// Which region a vertex belongs to, and how far a run by regions has come. See region_runs.h.
///
/// Regions are the leaves of a binary tree. Its nodes are numbered level by level: the regions,
/// then the unions of two regions each, then those of two such unions; the root, of all points, is
/// last. Where there is one region, the root is another node above it.
struct Region_division {
  /// The number of no region: that of the infinite vertex, and of points that came after the
  /// division.
  static constexpr std::uint16_t no_region = std::numeric_limits<std::uint16_t>::max();

  std::size_t regions = 0;            ///< how many there are: a power of two, or 0
  std::vector<std::uint16_t> owners;  ///< by point id, the region that owns the vertex
  /// Of each node: how many flips have been numbered since stamps were cleared.
  std::vector<std::size_t> flips;
  Flip_numbers numbers;     ///< of the nodes
  double events = 0;        ///< of windows since the division
  double window_width = 0;  ///< of the next window

  bool runs_windows = false;      ///< whether windows are next, or else the loop
  double loop_begin = 0;          ///< since when the loop has run, if it has not run windows
  std::uint64_t loop_events = 0;  ///< of the loop since then
  Region_effort effort;           ///< whether windows pay

  /// Forgets the regions, but not what is known of the run.
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
  /// How many parts a queue has, as docs/PARALLEL.md says: one for each node, then these two kinds.
  std::size_t parts() const { return 3 * nodes() - 1 - regions; }
  /// The part of what a node, which is not the root, has deferred.
  std::size_t deferred_part(std::size_t node) const { return nodes() + node; }
  /// The part of what a union of regions has to execute in a window.
  std::size_t due_part(std::size_t node) const { return 2 * nodes() - 1 + node - regions; }
  /// The first node of a level; regions are the level 0.
  std::size_t first_node(unsigned level) const { return 2 * regions - ((2 * regions) >> level); }
  /// The level of a node.
  unsigned level(std::size_t node) const {
    return static_cast<unsigned>(std::bit_width(regions)) -
           static_cast<unsigned>(std::bit_width(2 * regions - 1 - node));
  }
  /// The node above one that is not the root.
  std::size_t above(std::size_t node) const {
    const unsigned l = level(node);
    return first_node(l + 1) + (node - first_node(l)) / 2;
  }
  /// For how great a share of the events of a window a node has room, in relation to other nodes:
  /// each level shares the same among its nodes, but regions four times that, as they have most.
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
