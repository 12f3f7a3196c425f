// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest neighbor of each point, over a run.
//
// A point q that is nearest to p is alone in the disc about p through q, and so in the smaller disc
// whose diameter is pq: the two have an edge, in every Delaunay triangulation. So a point has one
// entry in a queue: the first time at which another neighbor becomes nearer than the present
// nearest one.
#ifndef KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H
#define KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/observers/edge_follower.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// Another point becomes the nearest neighbor of a point.
struct Nearest_neighbor_change {
  Algebraic_number time;       ///< exact
  Point_id id = no_point;      ///< the point that has another nearest neighbor from then on
  Point_id before = no_point;  ///< its nearest neighbor just before; none at the start, where the
                               ///< point comes, and where it was the only point
  Point_id after = no_point;   ///< just after; none where the point leaves, or becomes the only one
};

namespace detail {
template <ContactKineticTraits_2 Traits>
class Nearest_tracker;
}  // namespace detail

/// An observer that knows the nearest neighbor of each point at every time of a run.
///
/// *The nearest neighbor* is the one whose distance is least just after the time, exactly. Of
/// points that are equally near just after it, and so until a motion changes, it is the one with
/// the smallest id. A tie at one moment is no change if the order after it is that before it.
/// Kinetic_queries_2::nearest_neighbor is about the time itself: there a tie of a moment counts.
///
/// Cost: one or two certificates for each edge that is added, and for each change, turn and lost
/// candidate as many as the point has neighbors. Memory: O(n), and the list of changes.
///
/// Of points with weights, the edges of a regular triangulation do not tell which centres or rims
/// are nearest to each other (docs/MATH.md, section 10); so there is no such observer of these.
template <ContactKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
class Nearest_neighbors final : private Edge_follower<Traits> {
 public:
  using Time = Algebraic_number;                                          ///< of changes
  using Triangulation = Kinetic_triangulation_2<Traits>;                  ///< what is observed
  using On_change = std::function<void(const Nearest_neighbor_change&)>;  ///< what is told

  /// @{
  /// Observes from the current time on. The first changes are those of the start: each point that
  /// is not alone gets its nearest neighbor. Changes are given to `on_change`, which must
  /// neither change the triangulation nor look at it, since time may have gone on, where there is
  /// such a function; else they are kept for changes().
  explicit Nearest_neighbors(Simulation_2<Traits>& simulation, On_change on_change = {});
  explicit Nearest_neighbors(Triangulation& triangulation, On_change on_change = {});
  /// @}

  /// The nearest neighbor of the point just after the current time; none if there is no other
  /// point. Precondition: the triangulation contains the point.
  std::optional<Point_id> nearest_neighbor(Point_id id);

  /// That of each point, by id; no_point where there is none. next_id() ids.
  const std::vector<Point_id>& nearest_neighbors();

  /// All changes so far, in the exact order of time, then by id. What happens at one time is one
  /// change: from just before it to just after it. (If this function is called at that time, and
  /// points are changed afterwards at the same time, these are changes of their own.) Empty if the
  /// changes go to a function.
  const std::vector<Nearest_neighbor_change>& changes();

 private:
  using Base = Edge_follower<Traits>;
  using typename Base::Changed_point;

  void start(On_change on_change);
  void advance(const Time& time) override;
  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override;

  // Not shared, but of a type that is incomplete here.
  std::shared_ptr<detail::Nearest_tracker<Traits>> tracker_;
};

extern template class Nearest_neighbors<Linear_kinetic_traits_2>;
extern template class Nearest_neighbors<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H
