// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest neighbor of each point, over a run.
//
// Let q be nearest to p. No other point is inside the disc about p through q, nor in the smaller
// disc with the diameter pq, so pq is an edge of every Delaunay triangulation. Each point has one
// entry in a queue: the first time at which another neighbor becomes nearer than the nearest one.
#ifndef KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H
#define KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// Another point becomes the nearest neighbor of a point.
struct Nearest_neighbor_change {
  Algebraic_number time;       ///< exact
  Point_id id = no_point;      ///< the point that has another nearest neighbor from then on
  Point_id before = no_point;  ///< its nearest neighbor just before, or no_point
  Point_id after = no_point;   ///< that just after, or no_point
  /// @{
  /// In a periodic box, the offset of its image: Periodic_image. Else zero.
  Lattice_offset_2 before_offset = {};
  Lattice_offset_2 after_offset = {};
  /// @}
};

namespace detail {
template <DistanceKineticTraits_2 Traits>
class Nearest_tracker;
}  // namespace detail

/// An observer that maintains the nearest neighbor of each point.
///
/// *The nearest neighbor* is the one whose distance is least just after the time, exactly; of
/// points that are equally near then, and so until a motion changes, the one with the smallest id.
/// A tie at a single time is not a change if the order after it is that before it.
/// (Kinetic_queries_2::nearest_neighbor is about the time itself: there such a tie counts.)
///
/// Cost: one or two certificates for each added edge; for each change of a nearest neighbor or
/// motion, and each removed edge to the next candidate, as many as the point has neighbors. Memory:
/// O(n), and the list of changes.
///
/// In a periodic box it is the nearest image, of another point or of the point itself, as in
/// Periodic_queries_2: so a point alone has one. Of equally near images it is the smallest
/// Periodic_image; two own images at opposite offsets are always equally near.
///
/// There is no such observer of points with weights: the nearest center or boundary circle need not
/// be a neighbor in the regular triangulation (docs/MATH.md, section 10).
template <DistanceKineticTraits_2 Traits>
requires HasNearestNeighbors<Traits>
class Nearest_neighbors {
 public:
  using Time = Algebraic_number;                                          ///< of changes
  using Triangulation = Kinetic_triangulation_2<Traits>;                  ///< what is observed
  using On_change = std::function<void(const Nearest_neighbor_change&)>;  ///< called at changes
  using Neighbor = detail::Neighbor_name<Traits>;  ///< Point_id; in a box Periodic_image

  /// @{
  /// Observes from the current time on. The first changes are those of the start: each point that
  /// is not alone gets its nearest neighbor. Changes are passed to `on_change` or, if that is
  /// empty, kept for changes(). `on_change` may be called late: it must neither change nor read the
  /// triangulation.
  explicit Nearest_neighbors(Simulation_2<Traits>& simulation, On_change on_change = {});
  explicit Nearest_neighbors(Triangulation& triangulation, On_change on_change = {});
  /// @}
  ~Nearest_neighbors();

  /// The nearest neighbor of the point just after the current time; none if there is no other
  /// point. Precondition: the triangulation contains the point.
  std::optional<Neighbor> nearest_neighbor(Point_id id);

  /// That of each point, by id; no_point, or an image with that id, if there is none. Its size is
  /// next_id().
  const std::vector<Neighbor>& nearest_neighbors();

  /// All changes so far, in the exact order of time, then by id. All changes of a point at one time
  /// are one change. (Changes made after a call of this function at that time are separate.) Empty
  /// if there is a function `on_change`.
  const std::vector<Nearest_neighbor_change>& changes();

 private:
  std::unique_ptr<detail::Nearest_tracker<Traits>> tracker_;
};

/// The traits follow from the simulation.
template <ContactKineticTraits_2 Traits, class... On_change>
explicit Nearest_neighbors(Simulation_2<Traits>&, On_change...) -> Nearest_neighbors<Traits>;

extern template class Nearest_neighbors<Linear_kinetic_traits_2>;
extern template class Nearest_neighbors<Polynomial_kinetic_traits_2>;
extern template class Nearest_neighbors<Periodic_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_NEAREST_NEIGHBORS_H
