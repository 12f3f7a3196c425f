// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about moving points at one time: the current time, or any time up to the next event,
// without advancing the triangulation.
//
// The answers hold at exactly that time, even if points coincide, triangles are flat or points are
// cocircular. The search uses the triangulation just after the current time, or just before a later
// time, when it is embedded. Edges connect what it finds there with the answer, and predicates at
// the time itself decide (docs/MATH.md, section 10).
//
// For points with weights, such as discs, the power replaces the distance: the power of a position
// to a point is the squared distance minus the weight of the point at the time.
//
// Points that coincide for a while (Coincident_points) are as many points: the one that hides the
// others has the least id of them. All have one cell.
#ifndef KINETRI_TRIANGULATION_QUERIES_2_H
#define KINETRI_TRIANGULATION_QUERIES_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/triangulation/queried_triangulation.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

namespace detail {
template <KineticTraits_2 Traits>
class Triangulation_at_time;
}  // namespace detail

/// The result of a location query.
struct Location_2 {
  /// What the query position lies on.
  enum class Kind : std::uint8_t {
    vertex,               ///< on a point
    edge,                 ///< on an edge, strictly between its ends
    face,                 ///< strictly inside a triangle
    outside_convex_hull,  ///< on none of these
  };
  Kind kind = Kind::outside_convex_hull;  ///< what the query position lies on
  /// For `vertex` the point, the smallest id of coinciding points; for `edge` its ends in ascending
  /// order; for `face` its vertices counterclockwise, the smallest id first; otherwise empty.
  std::vector<Point_id> points = {};

  friend bool operator==(const Location_2&, const Location_2&) = default;
};

/// A Voronoi cell: the convex region of all positions that are at least as near to a point as to
/// any other point; of points with weights the power cell, of all positions whose power to the
/// point is at most that to any other point. `Position` is Exact_position_2, or Vector_2 for
/// rounded coordinates. Coinciding points have the same cell, if their weights are equal.
///
/// A power cell may be empty, and at some times it has no area. A cell that is a segment, a ray or
/// a line has two sides: the same one, from left and from right. A cell that is a single position
/// has one vertex and no side.
template <class Position>
struct Voronoi_cell_2 {
  /// The neighbor across each side, counterclockwise; for coinciding points the smallest id. All
  /// sides have positive length. A bounded cell begins with a nearest one of these neighbors, of
  /// equally near ones the smallest id; an unbounded cell with the side that comes from infinity.
  /// With weights, several points may have the same radical axis with the point: then it is the
  /// farthest, whose cell has an area at the side.
  std::vector<Point_id> neighbors = {};
  /// vertices[i] is the end of side i and the start of the next side. Before rounding no two are
  /// equal. A bounded cell has as many vertices as sides, an unbounded cell has one fewer. Without
  /// vertices each side is a whole bisector, and the cell is a half plane (one side), a strip or a
  /// line (two sides), the plane (no side), or empty.
  std::vector<Position> vertices = {};
  /// For an unbounded cell with sides: the directions in which the first and the last side go to
  /// infinity, each as long as the vector from the point to the neighbor across that side.
  std::optional<std::array<Position, 2>> rays = std::nullopt;
  /// Whether the cell is empty, as for a hidden point; only with weights. Then all other members
  /// are empty.
  bool is_empty = false;

  /// Whether the cell is bounded, or empty. Cells of points on the boundary of the convex hull are
  /// unbounded.
  bool is_bounded() const { return !rays && (is_empty || !vertices.empty()); }
};

/// Traits of points without weights: the nearest neighbor of each point, and the closest pair, have
/// an edge, unlike in a regular triangulation.
template <class Traits>
concept HasNearestNeighbors = !WeightedKineticTraits_2<Traits>;

/// Queries at one time. A small object: a reference to the triangulation and a time. Use it only
/// while the triangulation does not change, and not in an observer. Several threads may query one
/// object, or objects of one triangulation, at once.
///
/// A query position is two binary64 numbers, taken exactly. The functions throw Precondition_error
/// if a position is not finite, if no point has a given id, or if an event has happened since this
/// object was constructed. (With weights also if another triangle hides a point since;
/// next_event_time() includes the times of that.)
///
/// A point that a triangle hides beside the time has no edges: `locate` does not find it. Whether
/// its cell is empty at the time itself is decided for that time.
///
/// A walk through the triangulation starts at a vertex near the query position, the nearest of some
/// 2 n^(1/3) points at the current time. It takes expected O(n^(1/3)) predicates for evenly
/// distributed points, O(n) in the worst case.
///
/// Compiled into the library for its own four traits; for traits that are derived from one of them,
/// without other points or predicates, `Kinetic_queries_2(triangulation)` has those of the base.
/// (For other traits CGAL's queries answer for the current time, see
/// Kinetic_triangulation_2::triangulation.)
template <KineticTraits_2 Traits = Linear_kinetic_traits_2>
class Kinetic_queries_2 {
 public:
  using Time = Algebraic_number;             ///< of events
  using Point_2 = typename Traits::Point_2;  ///< of the traits

  /// Queries at the current time.
  template <detail::HasTriangulationOf<Traits> Own>
  explicit Kinetic_queries_2(const Kinetic_triangulation_2<Own>& triangulation)
      : Kinetic_queries_2(triangulation, triangulation.current_time()) {}

  /// Queries at `time`. If it is the time of the next event, the answers hold for the triangulation
  /// before the event. Precondition: `time` is neither before triangulation.current_time() nor
  /// after the next event (checked exactly, see has_event_before). The contacts of a Simulation_2
  /// do not count: after the next contact the answers still assume the current motions.
  template <detail::HasTriangulationOf<Traits> Own>
  Kinetic_queries_2(const Kinetic_triangulation_2<Own>& triangulation, const Time& time)
      : Kinetic_queries_2(std::make_unique<detail::Queried<Own, Traits>>(triangulation), time) {}

  /// The time of the queries.
  const Time& time() const;

  /// The point nearest to the position, or with weights of the least power there; of several such
  /// points the smallest id, hidden ones included; none if there are no points. Cost: a walk, and
  /// the degrees of those points.
  std::optional<Point_id> nearest_vertex(const Vector_2& place) const;

  /// The triangle, edge or point at the position. If flat triangles overlap there: an edge without
  /// points between its ends. Cost: a walk, and the number of faces that contain the position; for
  /// a position outside the hull on the line of a hull edge also the number of hull edges. O(n) if
  /// all points are collinear at all times.
  Location_2 locate(const Vector_2& place) const;

  /// The points with an edge to `point`, counterclockwise: for an inner point the smallest id
  /// first, for a hull point from one hull neighbor to the other. If all points are collinear at
  /// all times, in ascending order. None for a point that a triangle hides. At a degenerate time
  /// there are several Delaunay triangulations; voronoi_cell gives the neighbors that all of them
  /// have. Cost: O(degree).
  ///
  /// Then, in ascending order, the points that `point` hides since they coincide with it for a
  /// while. The only neighbor of such a hidden point is the point that hides it.
  std::vector<Point_id> neighbors(Point_id point) const;

  /// The exact Voronoi cell of the point `id`. Precondition: the time is known to be rational
  /// (Algebraic_number::is_known_rational), as binary64 numbers are. Cost: for degree d, O(d log d)
  /// predicates, and one exact evaluation per vertex; with weights O(d^2) predicates if the point
  /// is not inside its own cell, and d counts the edges of all points that bound a cell without
  /// area. A hidden point costs O(1) predicates, except at times at which it appears or disappears.
  Voronoi_cell_2<Exact_position_2> voronoi_cell(Point_id id) const;

  /// The Voronoi cell at any time. Its sides are decided exactly; each coordinate is rounded to the
  /// nearest binary64 number, ties to even. Cost: O(d) floating-point operations, a microsecond or
  /// two; exact arithmetic, as in voronoi_cell, if triangles are flat or points coincide, for
  /// coordinates too near to the middle of two binary64 numbers, and always with weights.
  Voronoi_cell_2<Vector_2> rounded_voronoi_cell(Point_id id) const;

  /// The area of each point's Voronoi cell (with weights: power cell) within a polygon, by id: of
  /// the region of the polygon in which nearest_vertex is that point. Points that coincide for a
  /// while (coincident_points) share it equally. Of points with equal weights that coincide only at
  /// the time, the smallest id has the area of the common cell, or shares it with those that
  /// coincide with it for a while; the others have 0, and so have points with empty cells and ids
  /// without points. If there is a point, the sum is the area of the polygon. The result has
  /// next_id() numbers.
  ///
  /// `polygon` has its vertices in either order, each once; it need not be convex, and points may
  /// be outside. For a box: Box_2::corners. The neighbors of each cell are exact, the areas are
  /// rounded: each side of a cell is off by some units in the last place of the largest coordinate
  /// of the polygon and the point, and the area by as much times the length of the sides, even for
  /// nearly flat triangles. Throws Precondition_error if the polygon is not simple, has fewer than
  /// three vertices, or a coordinate that is not finite or beyond 1e150.
  ///
  /// Cost: O(m log m) for m vertices, to check the polygon; for each point, m floating-point
  /// operations for each of its first sides, some hundred in all if m is small. Without weights,
  /// the cells in a convex polygon cost O(m) floating-point operations for each triangle.
  std::vector<double> rounded_voronoi_areas(std::span<const Vector_2> polygon) const;

  // Distances between points, without weights: in a regular triangulation neither the nearest
  // centers nor the nearest boundaries need have an edge (docs/MATH.md, section 10). Coinciding
  // points, hidden ones included, have the distance 0.

  /// The point nearest to the point `id`, other than that; of equally near points the smallest id;
  /// none if there is no other point. Cost: O(degree) floating-point operations, and exact
  /// comparisons if these do not decide.
  std::optional<Point_id> nearest_neighbor(Point_id id) const requires HasNearestNeighbors<Traits>;

  /// The nearest_neighbor of each point, by id; no_point if there is none. next_id() ids.
  std::vector<Point_id> nearest_neighbors() const requires HasNearestNeighbors<Traits>;

  /// The k points nearest to each point, other than that, in the order of distance, then of id.
  /// Those of the point `id` are the k ids from k * id on; no_point if there are no more points, or
  /// no point `id`. k * next_id() ids. Precondition: k is less than 2^32. Cost: for each point O(d
  /// log d) comparisons of distances, as those of nearest_neighbor, if the k points have d
  /// neighbors together; and as much for each point that is exactly as far away as the last of the
  /// k. Points that coincide for a while are searched for once, together.
  std::vector<Point_id> nearest_neighbors(std::size_t k) const requires HasNearestNeighbors<Traits>;

  /// The pair of points nearest to each other; of several such pairs the first in the order of
  /// Edge_ids; none for fewer than two points. Cost: O(n) floating-point operations, and exact
  /// comparisons of the edges that these cannot distinguish from the shortest.
  std::optional<Edge_ids> closest_pair() const requires HasNearestNeighbors<Traits>;

  /// The positions of all points: x and y of the point `id` at 2 * id and 2 * id + 1, each rounded
  /// to the nearest binary64 number, ties to even; NaN at an id without a point. The result has 2 *
  /// next_id() numbers. Cost: some floating-point operations for each point, and exact arithmetic
  /// for coordinates too near to the middle of two binary64 numbers.
  std::vector<double> rounded_positions() const;

 private:
  using Vertex_handle = typename Kinetic_triangulation_2<Traits>::Vertex_handle;
  using Queried = std::unique_ptr<const detail::Queried_triangulation<Traits>>;
  using At_time = detail::Triangulation_at_time<Traits>;

  Kinetic_queries_2(Queried kinetic, const Time& time);

  const At_time& at() const { return *at_; }
  std::uint64_t number_of_changes() const;
  void check_is_current() const;
  Vertex_handle vertex(Point_id id) const;
  std::vector<Point_id> triangulation_neighbors(Vertex_handle v) const;

  std::shared_ptr<const At_time> at_;
  std::uint64_t changes_;  // of the triangulation, when this object was made
};

/// Traits that are derived from those of the library have the queries of these.
template <KineticTraits_2 Own>
Kinetic_queries_2(const Kinetic_triangulation_2<Own>&)
    -> Kinetic_queries_2<detail::Library_traits<Own>>;
/// The same at a time.
template <KineticTraits_2 Own>
Kinetic_queries_2(const Kinetic_triangulation_2<Own>&, const Algebraic_number&)
    -> Kinetic_queries_2<detail::Library_traits<Own>>;

extern template class Kinetic_queries_2<Linear_kinetic_traits_2>;
extern template class Kinetic_queries_2<Polynomial_kinetic_traits_2>;
extern template class Kinetic_queries_2<Disc_kinetic_traits_2>;
extern template class Kinetic_queries_2<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_QUERIES_2_H
