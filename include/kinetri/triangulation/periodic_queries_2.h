// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about moving points in a periodic box at one time: the current time, or any time up to
// the next event, without advancing the triangulation.
//
// They are those of Kinetic_queries_2 about the infinite set of all images of the points, and
// decided exactly at the time in the same way: docs/MATH.md, sections 10 and 18. Results name
// images (Periodic_image): offsets are against the positions of the points as given at the time,
// which may be outside of the box.
//
// For points with weights, such as discs, the power replaces the distance: the power of a position
// to an image is the squared distance minus the weight of the point at the time.
//
// Points whose images coincide for a while (Coincident_points) are as many points: the one that
// hides the others has the least id of them. All have one cell, each about its own position.
#ifndef KINETRI_TRIANGULATION_PERIODIC_QUERIES_2_H
#define KINETRI_TRIANGULATION_PERIODIC_QUERIES_2_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// The result of a location query in a periodic box.
struct Periodic_location_2 {
  using Kind = Location_2::Kind;  ///< what the query position lies on
  /// `outside_convex_hull` if there are no points, and only then.
  Kind kind = Kind::outside_convex_hull;
  /// For `vertex` the image, the smallest of coinciding ones; for `edge` its ends in ascending
  /// order; for `face` its vertices counterclockwise, the smallest image first; otherwise empty.
  std::vector<Periodic_image> points = {};

  friend bool operator==(const Periodic_location_2&, const Periodic_location_2&) = default;
};

/// The Voronoi cell of a point in a periodic box: the convex region of all positions that are at
/// least as near to the point as to any other image, of it or of another point; of points with
/// weights the power cell, of all positions whose power to the point is at most that to any other
/// image. It is bounded. `Position` is Exact_position_2, or Vector_2 for rounded coordinates. A
/// point with which images of others coincide, with the same weight, has the cell that these have.
///
/// A Voronoi cell has an area. A power cell may be empty, and at some times it is a segment, with
/// two sides, or a single position, with one vertex and no side.
template <class Position>
struct Periodic_voronoi_cell_2 {
  /// The image across each side, counterclockwise from a nearest one on, of equally near ones the
  /// smallest; of coinciding images the smallest. All sides have positive length. With weights,
  /// several images may have the same radical axis with the point: then it is the farthest, whose
  /// cell has an area at the side.
  std::vector<Periodic_image> neighbors = {};
  /// vertices[i] is the end of side i and the start of the next side, around the position of the
  /// point as given. Before rounding no two are equal.
  std::vector<Position> vertices = {};
  /// Whether the cell is empty, as for a hidden point; only with weights. Then all other members
  /// are empty.
  bool is_empty = false;
};

/// Queries at one time. A small object: a reference to the triangulation and a time. Use it only
/// while the triangulation does not change, and not in an observer. Several threads may query one
/// object, or objects of one triangulation, at once.
///
/// A query position is two binary64 numbers, taken exactly. The functions throw Precondition_error
/// if a position is not finite, if no point has a given id, or if an event has happened since this
/// object was constructed (with weights also if another triangle hides a point since);
/// and Periodic_box_error if an image in the answer, or next to it, is 2^31
/// or more lattice vectors away from the position of its point, as near a query position that is so
/// far away.
///
/// A walk through the triangulation starts at a point near the query position: some 2 n^(1/3)
/// points and the position are moved into a parallelogram of two short lattice vectors, and the
/// nearest of these points is taken. The walk takes expected O(n^(1/3)) predicates for evenly
/// distributed points, O(n) in the worst case.
///
/// A point that a triangle hides beside the time has no edges: `locate` does not find it. Whether
/// its cell is empty at the time itself is decided for that time.
///
/// Compiled into the library for Periodic_kinetic_traits_2 and Periodic_disc_kinetic_traits_2.
template <PeriodicKineticTraits_2 Traits = Periodic_kinetic_traits_2>
class Periodic_queries_2 {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< that is queried
  using Time = Algebraic_number;                          ///< of events

  /// Queries at the current time.
  explicit Periodic_queries_2(const Triangulation& triangulation)
      : Periodic_queries_2(triangulation, triangulation.current_time()) {}

  /// Queries at `time`. If it is the time of the next event, the answers hold for the triangulation
  /// before the event. Precondition: `time` is neither before triangulation.current_time() nor
  /// after the next event (checked exactly, see has_event_before). Throws Periodic_box_error if the
  /// box loses its area up to `time`, included.
  Periodic_queries_2(const Triangulation& triangulation, const Time& time);

  /// The time of the queries.
  const Time& time() const;

  /// The image nearest to the position, or with weights of the least power there, also of a point
  /// that a triangle hides; of several such images the first one in the order of Periodic_image;
  /// none if there are no points. A point that a coincident one hides is never the answer, since
  /// that has a smaller id. Cost: a walk, and the degrees of those images.
  std::optional<Periodic_image> nearest_vertex(const Vector_2& place) const;

  /// The triangle, edge or image at the position. If flat triangles overlap there, since images
  /// coincide at the time: an edge without images between its ends. Cost: a walk, and the number of
  /// faces that contain the position.
  Periodic_location_2 locate(const Vector_2& place) const;

  /// The images with an edge to the point `id` at its position, own images included,
  /// counterclockwise, the smallest one first. None for a point that a triangle hides. At a
  /// degenerate time there are several Delaunay triangulations; voronoi_cell gives the neighbors
  /// that all of them have. Cost: O(degree).
  ///
  /// Then, in ascending order, the images that the point hides since they coincide with it for a
  /// while. The only neighbor of such a hidden point is the image that hides it.
  std::vector<Periodic_image> neighbors(Point_id id) const;

  /// The exact Voronoi cell of the point `id`. Precondition: the time is known to be rational
  /// (Algebraic_number::is_known_rational), as binary64 numbers are. Cost: for degree d, O(d log d)
  /// predicates, and one exact evaluation per vertex; with weights as in the plane
  /// (Kinetic_queries_2::voronoi_cell).
  Periodic_voronoi_cell_2<Exact_position_2> voronoi_cell(Point_id id) const;

  /// The Voronoi cell at any time. Its sides are decided exactly; each coordinate is rounded to the
  /// nearest binary64 number, ties to even. Cost: O(d log d) predicates, and exact arithmetic for
  /// coordinates too near to the middle of two binary64 numbers.
  Periodic_voronoi_cell_2<Vector_2> rounded_voronoi_cell(Point_id id) const;

  /// The area of each point's Voronoi cell (with weights: power cell), by id. Points whose images
  /// coincide for a while (coincident_points) share it equally. Of points whose images coincide
  /// only at the time, with equal weights, the smallest id has the area of the common cell, or
  /// shares it with those that coincide with it for a while; the others have 0, and so have points
  /// with empty cells and ids without points. If there is a point, the sum is the area of the box.
  /// The result has next_id() numbers.
  ///
  /// The sides of each cell are exact, the areas are rounded: the area of a cell with n sides and
  /// the perimeter l, of which no position is farther than r from the point, is off by at most
  /// (3 + n / 2) 2^-53 r l, with weights (8 + n / 2), or more if numbers are less than 1e-150.
  /// Nothing is added to that by positions far from the origin. Throws Precondition_error if a cell
  /// reaches 1e150 from its point. Cost: some hundred floating-point operations for each point;
  /// exact arithmetic, as in voronoi_cell, if triangles are flat or images coincide, and always
  /// with weights.
  std::vector<double> rounded_voronoi_areas() const;

  // Distances between points, without weights (Kinetic_queries_2).

  /// The image nearest to the point `id` at its position, of another point or of itself; of equally
  /// near ones the smallest. So a point alone has its own image: the nearest one. Coinciding
  /// images, hidden ones included, have the distance 0. Cost: O(degree) floating-point operations,
  /// and exact comparisons if these do not decide.
  Periodic_image nearest_neighbor(Point_id id) const requires HasNearestNeighbors<Traits>;

  /// The nearest_neighbor of each point, by id: next_id() images. The image has the id no_point if
  /// there is no point `id`.
  std::vector<Periodic_image> nearest_neighbors() const requires HasNearestNeighbors<Traits>;

  /// The k images nearest to each point, its own ones included but not the point itself, in the
  /// order of distance, then of Periodic_image: k * next_id() images. Those of the point `id` begin
  /// at k * id; they have the id no_point if there is no such point. Precondition: k is less than
  /// 2^32. Cost: as Kinetic_queries_2::nearest_neighbors(k), and for each image that is compared a
  /// search in a set of images.
  std::vector<Periodic_image> nearest_neighbors(std::size_t k) const requires
      HasNearestNeighbors<Traits>;

  /// The two images nearest to each other, of two points or of one, as the edge between them is
  /// named; of several such pairs the first in the order of Periodic_edge; none if there are no
  /// points. Cost: as Kinetic_queries_2::closest_pair.
  std::optional<Periodic_edge> closest_pair() const requires HasNearestNeighbors<Traits>;

  /// The positions of all points: x and y of the point `id` at 2 * id and 2 * id + 1, each rounded
  /// to the nearest binary64 number, ties to even; NaN at an id without a point. The result has 2 *
  /// next_id() numbers.
  ///
  /// They are the positions as given; if `are_wrapped`, those of the images in the box: the
  /// parallelogram of the lattice vectors at the time, from the origin on. Its two sides at the
  /// origin belong to it, the other two do not. Which image is in the box is exact, so that
  /// rounding may move it onto a side, or beyond one by half a unit in the last place. Cost: some
  /// floating-point operations for each point, and exact arithmetic if these do not decide.
  std::vector<double> rounded_positions(bool are_wrapped = false) const;

 private:
  using At_time = detail::Triangulation_at_time<Traits>;

  const At_time& at() const { return *at_; }
  std::uint64_t number_of_changes() const;
  void check_is_current() const;
  void check_point(Point_id id) const;

  std::shared_ptr<const At_time> at_;
  std::uint64_t changes_;  // of the triangulation, when this object was made
};

/// The traits follow from the triangulation.
template <PeriodicKineticTraits_2 Traits>
Periodic_queries_2(const Kinetic_triangulation_2<Traits>&) -> Periodic_queries_2<Traits>;
/// The same at a time.
template <PeriodicKineticTraits_2 Traits>
Periodic_queries_2(const Kinetic_triangulation_2<Traits>&, const Algebraic_number&)
    -> Periodic_queries_2<Traits>;

extern template class Periodic_queries_2<Periodic_kinetic_traits_2>;
extern template class Periodic_queries_2<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_PERIODIC_QUERIES_2_H
