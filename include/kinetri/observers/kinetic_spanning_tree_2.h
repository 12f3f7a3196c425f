// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Euclidean minimum spanning tree of moving points, over time, in the plane and in periodic
// boxes.
#ifndef KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H
#define KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H

#include <memory>
#include <optional>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// A change of a spanning tree at one time. Both lists are sorted; they are equally long unless
/// points are inserted or erased. `Edge` is Edge_ids, in a periodic box Periodic_edge.
template <class Edge>
struct Basic_spanning_tree_change {
  Algebraic_number time;      ///< exact
  std::vector<Edge> removed;  ///< edges of the tree just before the time and not just after it
  std::vector<Edge> added;    ///< edges of the tree just after the time and not just before it
};
/// In the plane.
using Spanning_tree_change = Basic_spanning_tree_change<Edge_ids>;

/// The longest edge of the tree, from a time on.
template <class Edge>
struct Basic_longest_edge {
  Algebraic_number time;     ///< exact
  std::optional<Edge> edge;  ///< none if there are fewer than two points
  double length = 0;         ///< at that time, rounded to nearest, ties to even
};
/// In the plane.
using Longest_edge = Basic_longest_edge<Edge_ids>;

/// The range at which all points are connected, at a time: the length of the longest edge of the
/// tree.
template <class Edge>
struct Basic_connecting_range {
  Algebraic_number range;  ///< exact
  Edge edge = {};          ///< the longest edge
  Algebraic_number time;   ///< exact
};
/// In the plane.
using Connecting_range = Basic_connecting_range<Edge_ids>;

namespace detail {
template <SimulationKineticTraits_2 Traits>
class Spanning_tree;
}  // namespace detail

/// An observer that maintains the Euclidean minimum spanning tree, with every change at its exact
/// time, and its longest edge: the range at which everything is connected.
///
/// Lengths are compared exactly, just after the time; edges of equal length throughout some time
/// are in the order of their ids. So the tree is unique. It is a subset of the triangulation's
/// edges (docs/MATH.md, section 15). All changes at one time are one change, unless this object is
/// called in between. Answers are for just after the current time.
///
/// In a periodic box the tree joins the points modulo the lattice: its edges are those of images,
/// Periodic_edge, never of a point and its own image, and two points are connected if one is
/// connected with any image of the other. Edges of equal length throughout some time are in the
/// order of ids, then of offsets against the positions as given. An offset of 2^31 or more, of
/// images that far from one another, is a Periodic_box_error of the call that advances time.
///
/// Each edge outside of the tree has a certificate: a cycle of which it is the longest edge. Cost:
/// for each edge whose certificate fails, certificates of the edges of triangles at it, or of those
/// on its path in the tree. A change of the longest edge costs O(n) certificates. Memory: O(n times
/// the length of a path in the tree + changes).
///
/// Kinetic spanning trees: J. Basch, L. J. Guibas, L. Zhang, Proximity problems on moving points,
/// 13th Symposium on Computational Geometry, 1997; P. K. Agarwal, D. Eppstein, L. J. Guibas, M. R.
/// Henzinger, Parametric and kinetic minimum spanning trees, 39th Symposium on Foundations of
/// Computer Science, 1998; Z. Rahmati, A. Zarei, Kinetic Euclidean minimum spanning tree in the
/// plane, Journal of Discrete Algorithms 16, 2012.
template <SimulationKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Kinetic_spanning_tree_2 {
  static_assert(!HasWeight<typename Traits::Motion>, "of points, or discs of one radius");

 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;          ///< what is observed
  using Edge = detail::Edge_name<Traits>;                         ///< Edge_ids or Periodic_edge
  using Spanning_tree_change = Basic_spanning_tree_change<Edge>;  ///< of such edges
  using Longest_edge = Basic_longest_edge<Edge>;                  ///< the same
  using Connecting_range = Basic_connecting_range<Edge>;          ///< the same

  /// @{
  /// Observes from the current time on. What is observed must outlive this object.
  explicit Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation);
  explicit Kinetic_spanning_tree_2(Triangulation& triangulation);
  /// @}
  ~Kinetic_spanning_tree_2();

  /// The edges of the tree just after the current time, sorted.
  std::vector<Edge> edges();
  /// Whether the tree has that edge just after the current time.
  bool is_edge(const Edge& edge);
  /// All changes so far, in their order. The reference is valid until this object is used again
  /// after the triangulation has advanced.
  const std::vector<Spanning_tree_change>& changes();

  /// The longest edge at the start, and whenever it changes. Cost: the rounding of each length.
  std::vector<Longest_edge> longest_edges();

  /// The range at which all points are connected at the current time; none of fewer than two
  /// points.
  std::optional<Connecting_range> connecting_range();
  /// @{
  /// The least and the greatest such range from the start up to the current time, each at its first
  /// time. At a time of changes, the current one too, the ranges just before and just after it
  /// count. All points are connected at some time if the range is at least the former, and at all
  /// times if it is at least the latter. None if there never were two points. Cost: interval
  /// arithmetic for each change of the longest edge or its motion, and exact arithmetic for the
  /// candidates that remain.
  std::optional<Connecting_range> least_connecting_range();
  std::optional<Connecting_range> greatest_connecting_range();
  /// @}

 private:
  std::unique_ptr<detail::Spanning_tree<Traits>> tree_;
};

extern template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
extern template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;
extern template class Kinetic_spanning_tree_2<Periodic_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H
