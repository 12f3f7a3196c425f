// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Euclidean minimum spanning tree of moving points, over time.
//
// The invariant between events: each edge of the triangulation that is not in the tree has a proof,
// a cycle of which it is the longest edge. The rest of the cycle, the *support* of the edge, is
// either two other edges of a triangle, or a path that was in the tree when it was found. Then no
// such edge is in the minimum spanning tree, and the tree is that. A proof fails when an edge of
// the support becomes longer than its edge; the queue has the first such failure of each edge that
// is not in the tree, and for each edge of the tree but the longest one the time at which it
// becomes longer than that.
#ifndef KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H
#define KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/observers/edge_follower.h"
#include "kinetri/impl/observers/failure_queue.h"

namespace kinetri {

/// What changes in a spanning tree at one time. Both lists are sorted; they are equally long unless
/// points come or go.
struct Spanning_tree_change {
  Algebraic_number time;          ///< exact
  std::vector<Edge_ids> removed;  ///< edges of the tree just before the time and not just after it
  std::vector<Edge_ids> added;    ///< edges of the tree just after the time and not just before it
};

/// Which edge of the tree is the longest one, from a time on.
struct Longest_edge {
  Algebraic_number time;         ///< exact
  std::optional<Edge_ids> edge;  ///< none if there are fewer than two points
  double length = 0;             ///< at that time, rounded to nearest, ties to even
};

/// The range at which all points are connected, at a time: the length of the longest edge of the
/// tree.
struct Connecting_range {
  Algebraic_number range;                ///< exact
  Edge_ids edge = {no_point, no_point};  ///< the longest edge
  Algebraic_number time;                 ///< exact
};

/// An observer that keeps the Euclidean minimum spanning tree, with every change at its exact time,
/// and its longest edge: the range at which everything is connected.
///
/// Lengths are compared exactly, just after the time; edges that have the same length throughout
/// some time are in the order of their ids. So there is one tree. It is a subset of the
/// triangulation's edges (docs/MATH.md, section 15). The simultaneous changes of one time are one
/// change; of points that go and others that come at one time, the tree is that before and that
/// after it.
///
/// Cost: for each edge that loses its proof, certificates of the edges of triangles at it, or of
/// those on its path in the tree. A change of the longest edge costs O(n) certificates. Memory: O(n
/// times the length of a path in the tree), which is that of the proofs by paths, + changes.
///
/// Kinetic spanning trees: J. Basch, L. J. Guibas, L. Zhang, Proximity problems on moving points,
/// 13th Symposium on Computational Geometry, 1997; P. K. Agarwal, D. Eppstein, L. J. Guibas, M. R.
/// Henzinger, Parametric and kinetic minimum spanning trees, 39th Symposium on Foundations of
/// Computer Science, 1998; Z. Rahmati, A. Zarei, Kinetic Euclidean minimum spanning tree in the
/// plane, Journal of Discrete Algorithms 16, 2012.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Kinetic_spanning_tree_2 : public Edge_follower<Traits> {
  static_assert(!HasWeight<typename Traits::Motion>, "of points, or discs of one radius");

 public:
  using typename Edge_follower<Traits>::Triangulation;
  using typename Edge_follower<Traits>::Time;
  using typename Edge_follower<Traits>::Point_2;

  /// @{
  /// Observes from the current time on; the object must not outlive what it observes.
  explicit Kinetic_spanning_tree_2(Simulation_2<Traits>& simulation);
  explicit Kinetic_spanning_tree_2(Triangulation& triangulation);
  /// @}

  /// The edges of the tree just after the current time, sorted.
  std::vector<Edge_ids> edges();
  /// Whether the tree has that edge just after the current time.
  bool is_edge(const Edge_ids& edge);
  /// All changes so far, in their order. The reference is valid until this object is used again
  /// after the triangulation has gone on.
  const std::vector<Spanning_tree_change>& changes();

  /// The longest edge of the tree just after the current time; none of fewer than two points.
  std::optional<Edge_ids> longest_edge();
  /// The longest edge at the start, and whenever another one is the longest. Cost: for each, the
  /// rounding of its length.
  std::vector<Longest_edge> longest_edges();

  /// The range at which all points are connected at the current time; none of fewer than two
  /// points.
  std::optional<Connecting_range> connecting_range();
  /// @{
  /// The least and the greatest such range from the start up to the current time, each at the first
  /// time at which it is that: the first is where everything is connected once, the second is where
  /// everything stays connected. None if there never were two points. Cost: interval arithmetic
  /// for each change of the longest edge or its motion, and exact arithmetic for those that come
  /// into question.
  std::optional<Connecting_range> least_connecting_range();
  std::optional<Connecting_range> greatest_connecting_range();
  /// @}

 private:
  using typename Edge_follower<Traits>::Changed_point;
  using Index = std::uint32_t;  // of an edge
  static constexpr Index no_edge = std::numeric_limits<Index>::max();

  struct Edge {
    Edge_ids ids = {no_point, no_point};
    bool is_in_tree = false;
    bool is_suspect = false;        // it may belong into the tree
    std::vector<Index> supports;    // with it a cycle
    std::vector<Index> dependents;  // which this edge supports
    Queue_handle event = no_event;
  };

  // The time at which `near` becomes longer than `far`. It is the entry of `owner`, one of the two.
  struct Entry : detail::Failure {
    Index owner = no_edge;
    Index near = no_edge;
    Index far = no_edge;
  };
  friend class detail::Failure_queue<Entry, Kinetic_spanning_tree_2>;

  // A point in the rooted trees that make up the forest, while it is one.
  struct Node {
    Point_id parent = no_point;
    Index edge = no_edge;    // to the parent
    std::uint64_t seen = 0;  // the last search that has come by
  };

  // The other end of an edge, kept at the smaller one.
  struct Greater_end {
    Point_id id;
    Index edge;
  };

  // A time during which one edge was the longest, with one motion.
  struct Longest_piece {
    Time since;
    std::optional<Edge_ids> edge;
    Point_2 p = Point_2();
    Point_2 q = Point_2();
  };

  // Whether an edge is before another one just after now, and if so, the certificate.
  struct Closer {
    bool holds = false;
    Certificate certificate = {};
  };

  // Time.
  void start();
  void look();
  void advance(const Time& time) override;
  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override;
  void execute_until(const Time& time);
  void begin(const Time& time);
  void record();

  // Edges, by index.
  Index find(const Edge_ids& ids) const;
  Index insert(const Edge_ids& ids);
  void erase(Index edge);
  const Point_2& end(Index edge, std::size_t i) const {
    return this->graph().point(edges_[edge].ids[i]);
  }
  double rounded_square_length(Index edge) const;

  // Comparisons just after now, and the queue.
  Closer closer(Index near, Index far) const;
  bool is_longer(Index a, Index b) const;
  Time time_of(const Certificate& certificate, Index near, Index far) const;
  Time failure_time(const Entry& entry) const;
  bool precedes(const Entry& a, const Entry& b) const {
    return edges_[a.owner].ids < edges_[b.owner].ids;
  }
  void schedule(Index owner, Index near, Index far, Certificate certificate);
  void unschedule(Index owner);

  // Proofs.
  void suspect(Index edge);
  void suspect_dependents(Index edge);
  void withdraw_support(Index edge);
  void examine_suspects();
  void examine(Index edge);
  bool find_triangle(Index edge);
  void find_path(Index edge);
  void support(Index edge, std::vector<Index> supports, std::vector<Certificate> certificates);

  // The forest.
  std::optional<std::vector<Index>> path(Point_id a, Point_id b);
  void make_root(Point_id id);
  void add_to_tree(Index edge);
  void remove_from_tree(Index edge);

  // The longest edge.
  void find_longest();
  void compare_all_with_longest();
  std::optional<Connecting_range> extreme_range(bool greatest);

  Time now_;
  std::vector<Edge> edges_;
  std::vector<Index> free_edges_;
  std::vector<std::vector<Greater_end>> ends_;  // by the smaller id of an edge
  std::vector<Node> nodes_;
  std::uint64_t searches_ = 0;
  std::vector<Index> suspects_;
  std::vector<Index> new_in_tree_;  // not compared with the longest one yet
  Index longest_ = no_edge;

  // What has changed at now_: how often an edge has come into the tree less how often it has gone.
  std::map<Edge_ids, int> changed_;
  std::vector<Spanning_tree_change> changes_;
  std::vector<Longest_piece> longest_pieces_;

  detail::Failure_queue<Entry, Kinetic_spanning_tree_2> queue_{*this};
};

extern template class Kinetic_spanning_tree_2<Linear_kinetic_traits_2>;
extern template class Kinetic_spanning_tree_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_KINETIC_SPANNING_TREE_2_H
