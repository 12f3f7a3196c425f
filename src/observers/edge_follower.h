// SPDX-License-Identifier: GPL-3.0-or-later
//
// The base of observers of distances, which follow edges and motions, and have their own events
// between those of the triangulation.
//
// The calls for one time t with events of the triangulation:
//   1. `advance(t)`: the observer executes its own events at or before t. The graph is that before
//   t; it is still right at t, as the limit of Delaunay triangulations.
//   2. `before_change(...)`: the graph is still that. Entries that depend on changed motions leave
//   the observer's queue, which orders entries by these motions.
//   3. `change(...)`: the graph is that just after t, after all events of that time. What was
//   removed and added again at t is not a change.
#ifndef KINETRI_SRC_OBSERVERS_EDGE_FOLLOWER_H
#define KINETRI_SRC_OBSERVERS_EDGE_FOLLOWER_H

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/simulation/simulation_2.h"
#include "triangulation/image_names.h"
#include "triangulation/whole_vectors.h"

namespace kinetri {
namespace detail {

/// What is observed: the triangulation, or that of a simulation.
template <class Traits>
const Kinetic_triangulation_2<Traits>& triangulation_of(
    const Kinetic_triangulation_2<Traits>& triangulation) {
  return triangulation;
}
template <class Traits>
const Kinetic_triangulation_2<Traits>& triangulation_of(const Simulation_2<Traits>& simulation) {
  return simulation.triangulation();
}

/// Prefetches all cache lines of an object.
template <class Object>
KINETRI_ALWAYS_INLINE void prefetch_object(const Object& object) {
  constexpr std::size_t line = 64;
  const auto* const begin = reinterpret_cast<const std::byte*>(&object);
  for (std::size_t i = 0; i < sizeof(Object); i += line) prefetch_address(begin + i);
  prefetch_address(begin + sizeof(Object) - 1);
}

}  // namespace detail

/// A copy of the moving points and finite edges of a triangulation, updated once for each instant.
/// A point that coincides with others for a while has an edge, its *link*, with the one that hides
/// it (docs/MATH.md, section 4); in a periodic box, with the image of that one at its position.
template <class Traits>
class Neighbor_graph {
 public:
  using Point_2 = typename Traits::Point_2;        ///< of the traits
  using Edge_name = detail::Edge_name<Traits>;     ///< of an edge
  using Neighbor = detail::Neighbor_name<Traits>;  ///< what names a neighbor of a point

  /// Whether there is a point with the id. Points that triangles hide have no neighbors.
  bool contains(Point_id id) const { return id < nodes_.size() && nodes_[id].point.has_value(); }
  /// The point, with its motion. Precondition: contains(id).
  const Point_2& point(Point_id id) const { return *nodes_[id].point; }
  /// The neighbors of a point, in no order; in a periodic box as often as there are edges, own
  /// images too. Precondition: contains(id).
  std::span<const Neighbor> neighbors(Point_id id) const {
    const auto& result = nodes_[id].neighbors;
    return {result.data(), result.size()};
  }
  /// Whether there is that edge. O(degree).
  bool is_edge(const Edge_name& edge) const {
    const auto [id, other] = detail::ends_of(edge)[0];
    return id < nodes_.size() && std::ranges::find(neighbors(id), other) != neighbors(id).end();
  }
  /// All edges, sorted. O(n log n).
  std::vector<Edge_name> edges() const;
  /// The link of a point with the one that hides it, its first end; none if it has a vertex of its
  /// own.
  std::optional<Edge_name> link(Point_id id) const {
    const auto found = links_.find(id);
    return found == links_.end() ? std::nullopt : std::optional(found->second);
  }
  /// More than any id so far.
  Point_id next_id() const { return static_cast<Point_id>(nodes_.size()); }
  /// Starts to load a point and its neighbors. Precondition: id < next_id().
  KINETRI_ALWAYS_INLINE void prefetch(Point_id id) const { detail::prefetch_object(nodes_[id]); }

 private:
  template <DistanceKineticTraits_2>
  friend class Edge_follower;

  // Most points have about six neighbors, which are stored beside the point, to avoid cache misses.
  struct Node {
    std::optional<Point_2> point;
    boost::container::small_vector<Neighbor, 8> neighbors;
  };

  void set_point(Point_id id, const std::optional<Point_2>& point);
  void add(const Edge_name& edge);
  void remove(const Edge_name& edge);

  std::vector<Node> nodes_;              // by id
  std::map<Point_id, Edge_name> links_;  // of coincident points, by the hidden one
};

/// The base of such observers. Derived classes read the graph in their constructors and in
/// `advance`, `before_change` and `change`. These may use no other functions of the triangulation
/// than traits() and next_id(), since events on several threads are reported late
/// (Event_observer::looks_at_triangulation). The base reads only the motions of points that an
/// event names, which are current then. The triangulation must outlive this object, and must not be
/// reversed meanwhile.
///
/// Cost: O(1) amortized for each edge that changes, and one exact comparison of times for each
/// event. Memory: O(n).
template <DistanceKineticTraits_2 Traits>
class Edge_follower : private Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed
  using Motion = typename Traits::Motion;                 ///< of the traits
  using Point_2 = typename Traits::Point_2;               ///< of the traits
  using Image_2 = Certified_point_2<Traits>;              ///< in the plane: the point
  using Edge_name = detail::Edge_name<Traits>;            ///< of an edge, or of any pair
  using Neighbor = detail::Neighbor_name<Traits>;         ///< of a neighbor of a point
  using Time = Algebraic_number;                          ///< of events

  /// Whether points are in a periodic box.
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;

  Edge_follower(const Edge_follower&) = delete;
  Edge_follower& operator=(const Edge_follower&) = delete;

  /// Advances this object to the current time of the triangulation, as functions that return
  /// answers do. Precondition: not called by an observer within an event.
  void update();

 protected:
  /// A point that has changed in an instant.
  struct Changed_point {
    Point_id id;                    ///< of the point
    std::optional<Point_2> before;  ///< none if it has been inserted
  };

  /// Observes a triangulation, or that of a simulation, from the current time on.
  template <class Observed>
  explicit Edge_follower(Observed& observed)
      : triangulation_(&detail::triangulation_of(observed)),
        stop_observing_([this, &observed] { observed.remove_observer(*this); }) {
    start();
    observed.add_observer(*this);
  }
  ~Edge_follower() override;

  /// Executes the observer's own events at or before `time`. Times ascend.
  virtual void advance(const Time& time) = 0;

  /// change() is about to be called with these edges and points; the graph is that before. Entries
  /// of a queue that depend on changed motions must be removed now, since their exact times cannot
  /// be computed afterwards.
  virtual void before_change(std::span<const Edge_name> /*removed*/,
                             std::span<const Changed_point> /*points*/) {}

  /// Edges or points have changed at `time`, up to which advance() has been called. `removed` and
  /// `added` are sorted. The points are sorted by id: they have other motions, or have been
  /// inserted or erased (the graph does not contain them). May be called more than once for a time.
  virtual void change(const Time& time, std::span<const Edge_name> removed,
                      std::span<const Edge_name> added, std::span<const Changed_point> points) = 0;

  /// Triangles at these edges, which are sorted, may have changed although no edge has: points have
  /// met. Some of the edges may not exist. Called after change(), if that is called; edges that it
  /// has reported need not be among them. In a periodic box each pair of ends comes once.
  virtual void change_triangles(std::span<const Edge_ids> /*edges*/) {}

  /// What is observed.
  const Triangulation& triangulation() const { return *triangulation_; }
  /// The points and edges at the last reported instant.
  const Neighbor_graph<Traits>& graph() const { return graph_; }
  /// Those of the triangulation.
  const Traits& traits() const { return triangulation_->traits(); }

  /// @{
  /// What certificates are about: the image of the neighbor of a point, and the two ends of a pair
  /// or an edge. In the plane a reference to the point. Precondition: graph() contains it.
  decltype(auto) image(const Neighbor& neighbor) const {
    if constexpr (is_periodic) {
      return traits().image(graph_.point(neighbor.id), neighbor.offset);
    } else {
      return graph_.point(neighbor);
    }
  }
  decltype(auto) first_end(const Edge_name& pair) const { return itself(detail::ids_of(pair)[0]); }
  decltype(auto) second_end(const Edge_name& pair) const {
    return image(detail::ends_of(pair)[0].second);
  }
  decltype(auto) itself(Point_id id) const {
    if constexpr (is_periodic) {
      return image({id, {}});
    } else {
      return image(id);
    }
  }
  /// @}

 private:
  void start();
  void begin_instant(const Time& time);
  void finish_instant();
  void finish_changes();
  std::optional<Edge_name> present_link(Point_id id) const;
  void sum_up_hiding();
  void sum_up_edges();
  void sum_up_points();
  bool looks_at_triangulation() const override { return false; }
  void before_event(const Event& event) override;
  void after_event(const Event& event) override;
  void after_rebuild(const Time& time, std::span<const Edge_ids> edges) override;
  void after_hiding(const Time& time, std::span<const Point_id> points) override;

  const Triangulation* triangulation_;
  std::function<void()> stop_observing_;
  Neighbor_graph<Traits> graph_;
  Time instant_;  // advance() has been called up to here
  // The changes at that time, in order: an edge has been added (+1) or removed (-1); a point has
  // got a motion, or has been erased; a coincident point has another link, or none.
  std::vector<std::pair<Edge_name, int>> edge_events_;
  std::vector<std::pair<Point_id, std::optional<Point_2>>> point_events_;
  std::vector<std::pair<Point_id, std::optional<Edge_name>>> hiding_events_;
  std::vector<Edge_ids> rebuilt_edges_;  // of after_rebuild
  // The arguments of change(). Members, to reuse their memory.
  std::vector<Edge_name> removed_;
  std::vector<Edge_name> added_;
  std::vector<Changed_point> points_;
};

extern template class Neighbor_graph<Linear_kinetic_traits_2>;
extern template class Neighbor_graph<Polynomial_kinetic_traits_2>;
extern template class Neighbor_graph<Disc_kinetic_traits_2>;
extern template class Neighbor_graph<Polynomial_disc_kinetic_traits_2>;
extern template class Neighbor_graph<Periodic_kinetic_traits_2>;
extern template class Neighbor_graph<Periodic_disc_kinetic_traits_2>;
extern template class Edge_follower<Linear_kinetic_traits_2>;
extern template class Edge_follower<Polynomial_kinetic_traits_2>;
extern template class Edge_follower<Disc_kinetic_traits_2>;
extern template class Edge_follower<Polynomial_disc_kinetic_traits_2>;
extern template class Edge_follower<Periodic_kinetic_traits_2>;
extern template class Edge_follower<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SRC_OBSERVERS_EDGE_FOLLOWER_H
