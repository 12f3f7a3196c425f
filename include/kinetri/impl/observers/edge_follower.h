// SPDX-License-Identifier: GPL-3.0-or-later
//
// What observers of distances have in common: they follow the edges of a triangulation and the
// motions of its points, and have events of their own between those of the triangulation.
//
// One time t at which something happens to the triangulation, as the observer sees it:
//   1. `advance(t)`: the observer executes its own events at or before t. The graph is what it was
//      before t. It is still right at t itself, since edges are those of a Delaunay triangulation
//      in the limit, and motions are continuous up to t.
//   2. `before_change(...)`: the graph is still that. What depends on motions that change leaves
//      the observer's queue, which orders entries by these motions.
//   3. `change(...)`: the graph is what it is just after t, when all events of that time have
//      happened. What was removed and came back within t is no change.
// So the observer never sees a triangulation within an instant.
#ifndef KINETRI_IMPL_OBSERVERS_EDGE_FOLLOWER_H
#define KINETRI_IMPL_OBSERVERS_EDGE_FOLLOWER_H

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The points of a triangulation as they move from now on, and the finite edges between them. A
/// copy, which is brought up to date once for each instant.
template <class Traits>
class Neighbor_graph {
 public:
  using Point_2 = typename Traits::Point_2;  ///< of the traits

  /// Whether there is a point with the id. A hidden point is one, without neighbors.
  bool contains(Point_id id) const { return id < nodes_.size() && nodes_[id].point.has_value(); }
  /// The point, with its motion. Precondition: contains(id).
  const Point_2& point(Point_id id) const { return *nodes_[id].point; }
  /// The neighbors of a point, in no order. Precondition: contains(id).
  std::span<const Point_id> neighbors(Point_id id) const {
    const auto& result = nodes_[id].neighbors;
    return {result.data(), result.size()};
  }
  /// Whether the two have an edge. O(degree).
  bool is_edge(const Edge_ids& edge) const {
    return edge[0] < nodes_.size() &&
           std::ranges::find(neighbors(edge[0]), edge[1]) != neighbors(edge[0]).end();
  }
  /// More than any id so far.
  Point_id next_id() const { return static_cast<Point_id>(nodes_.size()); }
  /// Starts to load a point and its neighbors. Precondition: id < next_id().
  KINETRI_ALWAYS_INLINE void prefetch(Point_id id) const { detail::prefetch_object(nodes_[id]); }

 private:
  template <ContactKineticTraits_2>
  friend class Edge_follower;

  // Most points have six neighbors or so, which are kept beside the point: what an event is about
  // is far away in memory, each time.
  struct Node {
    std::optional<Point_2> point;
    boost::container::small_vector<Point_id, 8> neighbors;
  };

  void set_point(Point_id id, const std::optional<Point_2>& point);
  void add(const Edge_ids& edge);
  void remove(const Edge_ids& edge);

  std::vector<Node> nodes_;  // by id
};

/// The base of such observers. A class that derives from it reads the graph in its constructor, and
/// again when `advance`, `before_change` and `change` are called: these must ask nothing else of
/// the triangulation than its traits and next_id(), since a run by regions may be ahead of what
/// they are told (Event_observer::looks_at_triangulation). This base reads there only points that
/// an event names, and no event of such a run names one. The triangulation must outlive this
/// object, and must not be reversed meanwhile.
///
/// Cost: O(1) amortized for each edge that changes, and one exact comparison of times an event.
/// Memory: O(n).
template <ContactKineticTraits_2 Traits>
class Edge_follower : private Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed
  using Motion = typename Traits::Motion;                 ///< of the traits
  using Point_2 = typename Traits::Point_2;               ///< of the traits
  using Time = Algebraic_number;                          ///< of events

  Edge_follower(const Edge_follower&) = delete;
  Edge_follower& operator=(const Edge_follower&) = delete;

  /// Brings this object to the current time of the triangulation. Functions that give answers do
  /// so themselves. Precondition: not called by an observer within an event.
  void update();

 protected:
  /// A point that has changed in an instant.
  struct Changed_point {
    Point_id id;                    ///< of the point
    std::optional<Point_2> before;  ///< none if it has come
  };

  /// @{
  /// Observes from the current time on.
  explicit Edge_follower(Simulation_2<Traits>& simulation);
  /// The same of a triangulation.
  explicit Edge_follower(Triangulation& triangulation);
  /// @}
  ~Edge_follower() override;

  /// Executes the observer's own events at or before `time`, which is not before any earlier one.
  virtual void advance(const Time& time) = 0;

  /// change() is about to be called with these edges and points; the graph is as it was. Entries of
  /// a queue whose times follow from motions that change must go now: afterwards their exact times
  /// cannot be made any more.
  virtual void before_change(std::span<const Edge_ids> /*removed*/,
                             std::span<const Changed_point> /*points*/) {}

  /// Something has changed at `time`, up to which advance() has been called. The edges are sorted;
  /// `removed` were in the graph before and are not now, `added` are now and were not before. The
  /// points are sorted by id: they have other motions, have come or have gone (so that the graph
  /// does not contain them). A time may come more than once.
  virtual void change(const Time& time, std::span<const Edge_ids> removed,
                      std::span<const Edge_ids> added, std::span<const Changed_point> points) = 0;

  /// Triangles at these edges, which are sorted, may have changed although no edge has: points have
  /// met. Among them are edges that are not there. Called after change(), if that is called; an
  /// edge that it has told of need not be among them.
  virtual void change_triangles(std::span<const Edge_ids> /*edges*/) {}

  /// What is observed.
  const Triangulation& triangulation() const { return *triangulation_; }
  /// The points and edges, as of the last instant that has been told.
  const Neighbor_graph<Traits>& graph() const { return graph_; }
  /// Those of the triangulation.
  const Traits& traits() const { return triangulation_->traits(); }

 private:
  void start();
  void begin_instant(const Time& time);
  void finish_instant();
  void finish_changes();
  void sum_up_edges();
  void sum_up_points();
  bool looks_at_triangulation() const override { return false; }
  void before_event(const Event& event) override;
  void after_event(const Event& event) override;
  void after_rebuild(const Time& time, std::span<const Edge_ids> edges) override;

  const Triangulation* triangulation_;
  std::function<void()> stop_observing_;
  Neighbor_graph<Traits> graph_;
  Time instant_;  // advance() has been called up to here
  // What has happened since, at that time, one after the other: an edge has come (+1) or gone (-1);
  // a point has got a motion, or has gone.
  std::vector<std::pair<Edge_ids, int>> edge_events_;
  std::vector<std::pair<Point_id, std::optional<Point_2>>> point_events_;
  std::vector<Edge_ids> rebuilt_edges_;  // of after_rebuild
  // What it comes to, while change() is told. Members, so that an instant needs no memory.
  std::vector<Edge_ids> removed_;
  std::vector<Edge_ids> added_;
  std::vector<Changed_point> points_;
};

extern template class Neighbor_graph<Linear_kinetic_traits_2>;
extern template class Neighbor_graph<Polynomial_kinetic_traits_2>;
extern template class Neighbor_graph<Disc_kinetic_traits_2>;
extern template class Neighbor_graph<Polynomial_disc_kinetic_traits_2>;
extern template class Edge_follower<Linear_kinetic_traits_2>;
extern template class Edge_follower<Polynomial_kinetic_traits_2>;
extern template class Edge_follower<Disc_kinetic_traits_2>;
extern template class Edge_follower<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_IMPL_OBSERVERS_EDGE_FOLLOWER_H
