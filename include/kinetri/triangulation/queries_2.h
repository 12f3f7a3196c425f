// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about moving points at one time: now, or at any time up to the next event, without the
// triangulation being advanced.
//
// The answers are about the places of the points at exactly that time, also where these are
// degenerate: points that coincide, triangles that are flat, cocircular points. The triangulation
// only leads to them. It is embedded properly just beside the time (just after the present one,
// just before a later one), so the search runs there; what is found there is, at the time itself,
// among the answers or connected with them by edges, and is decided there (docs/MATH.md,
// section 10).
#ifndef KINETRI_TRIANGULATION_QUERIES_2_H
#define KINETRI_TRIANGULATION_QUERIES_2_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// Where a place is.
struct Location_2 {
  /// What is at a place.
  enum class Kind : std::uint8_t {
    vertex,               ///< at a point
    edge,                 ///< on an edge, strictly between its ends
    face,                 ///< strictly inside a triangle
    outside_convex_hull,  ///< none of these
  };
  Kind kind = Kind::outside_convex_hull;  ///< what is at this one
  /// The point, the smallest of those that coincide there; the ends of the edge in ascending order;
  /// the corners of the triangle counterclockwise, the smallest first; or nothing.
  std::vector<Point_id> points = {};

  friend bool operator==(const Location_2&, const Location_2&) = default;
};

/// The places that are as near to a point as to any other one: a convex region, bounded by sides.
///
/// `Position` is Exact_position_2 or, rounded, Vector_2. Points that coincide have the same cell.
template <class Position>
struct Voronoi_cell_2 {
  /// The point across each side, counterclockwise; of points that coincide the smallest id. All
  /// sides are longer than zero. A bounded cell begins with a nearest point, an unbounded one with
  /// the side that comes from infinity.
  std::vector<Point_id> neighbors = {};
  /// vertices[i] is where side i ends and the next one begins; no two are equal, before rounding.
  /// Of a bounded cell there are as many as sides, of an unbounded one fewer by one. If there is no
  /// vertex, each side is the whole bisector, and the cell a half plane (one side), a strip (two
  /// sides), or the plane (none).
  std::vector<Position> vertices = {};
  /// Of an unbounded cell with sides, the directions in which the first side and the last one go to
  /// infinity. Their lengths are those of the vectors to the neighbors.
  std::optional<std::array<Position, 2>> rays = std::nullopt;

  /// Whether the cell is bounded. That of a point on the boundary of the convex hull is not.
  bool is_bounded() const { return !rays && !neighbors.empty(); }
};

/// Queries at one time. Light: holds a reference, a time, and no copies of points. To be used as
/// long as the triangulation does not change, and from the thread that advances it; not by an
/// observer while an event is reported.
///
/// A place is two binary64 numbers and means exactly that place. A function that is given one
/// throws Precondition_error if they are not finite; one that is given an id, if no point has it;
/// all of them, if there has been an event since this object was made.
///
/// The walks through the triangulation take expected O(sqrt(n)) predicates from a vertex that has
/// nothing to do with the place, O(n) at worst.
template <KineticTraits_2 Traits = Linear_kinetic_traits_2>
class Kinetic_queries_2 {
 public:
  using Time = typename Traits::Time;        ///< of the traits
  using Point_2 = typename Traits::Point_2;  ///< of the traits

  /// At the present time.
  explicit Kinetic_queries_2(const Kinetic_delaunay_triangulation_2<Traits>& triangulation)
      : Kinetic_queries_2(triangulation, triangulation.current_time()) {}

  /// At `time`, which may be that of the next event: it is then that of its approach, and what the
  /// event changes is not changed yet. Precondition: `time` is neither before
  /// triangulation.current_time() nor after the next event (checked exactly, see has_event_before).
  /// The walls and collisions of a Simulation_2 are no events of its triangulation: beyond the next
  /// one the answers are about the motions as they are now.
  Kinetic_queries_2(const Kinetic_delaunay_triangulation_2<Traits>& triangulation,
                    const Time& time);

  /// The time of the queries.
  const Time& time() const { return time_; }

  /// The point nearest to the place, the smallest id of equally near ones; none if there is no
  /// point. Cost: a walk, and the degrees of the equally near points.
  std::optional<Point_id> nearest_vertex(const Vector_2& place) const;

  /// The triangle, edge or point at the place. Where flat triangles lie upon one another, an edge
  /// without points between its ends. Cost: a walk, and what is degenerate at the place; beside a
  /// hull edge whose line contains the place, the number of hull edges.
  Location_2 locate(const Vector_2& place) const;

  /// The points with an edge to `point`, counterclockwise: of an inner point the smallest id
  /// first, of a hull point from one hull neighbor to the other. Where all points are collinear for
  /// ever, in ascending order. These are the edges of the triangulation, which at a degenerate time
  /// are not the only ones possible; for those that are, see voronoi_cell. Cost: the degree.
  std::vector<Point_id> neighbors(Point_id point) const;

  /// The Voronoi cell of the point `id`. Exact; a precondition is that the time is a binary64
  /// number, or known to be rational (Algebraic_number::is_known_rational). Cost, with the degree
  /// d: O(d log d) predicates, and an exact evaluation for each vertex.
  Voronoi_cell_2<Exact_position_2> voronoi_cell(Point_id id) const;

  /// The same at any time, decided exactly too; each coordinate is then rounded to the nearest
  /// binary64 number, ties to even. Cost: at an irrational time some refinements a coordinate.
  Voronoi_cell_2<Vector_2> rounded_voronoi_cell(Point_id id) const;

  /// The two points that are nearest to each other, of several such pairs the first in the order of
  /// Edge_ids; none of fewer than two points. Cost: O(n) floating-point operations, and exact
  /// comparisons of the edges that these do not tell from the shortest.
  std::optional<Edge_ids> closest_pair() const;

 private:
  using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
  using Topology = typename Kinetic::Triangulation;
  using Vertex_handle = typename Kinetic::Vertex_handle;
  using Face_handle = typename Kinetic::Face_handle;
  using Instantaneous_traits = typename Kinetic::Instantaneous_traits;

  /// The points across the sides of a Voronoi cell, counterclockwise.
  struct Sides {
    std::vector<Vertex_handle> across;
    bool is_bounded = false;
  };
  class Lengths;

  const Topology& topology() const { return kinetic_.triangulation(); }
  void check_is_current() const;
  Vertex_handle vertex(Point_id id) const;
  static Point_2 resting_point(const Vector_2& place);
  static Point_id id(Vertex_handle v) { return v->point().id(); }

  template <class Function>
  void for_each_neighbor(Vertex_handle v, Function function) const;
  template <class Belongs>
  std::vector<Vertex_handle> connected(Vertex_handle v, Belongs belongs) const;
  std::vector<Point_id> all_at(Vertex_handle v) const;
  std::vector<Vertex_handle> all_nearest(const Point_2& query) const;

  // At the time itself.
  bool coincide(const Point_2& p, const Point_2& q) const;
  bool is_strictly_between(const Point_2& p, const Point_2& q, const Point_2& r) const;
  Comparison_result compare_distance(const Point_2& p, const Point_2& q, const Point_2& r) const;

  // Location.
  Face_handle find_face(const Point_2& query) const;
  Face_handle find_face_at_hull(const Point_2& query, Face_handle infinite_face) const;
  std::vector<Face_handle> faces_at(const Point_2& query, Face_handle face) const;
  bool is_on_closed_edge(const Point_2& query, Face_handle face, int i) const;
  Location_2 location_in(const std::vector<Face_handle>& faces, const Point_2& query) const;
  Location_2 location_on_line(const Point_2& query) const;
  bool is_shorter(const std::array<Vertex_handle, 2>& e, const std::array<Vertex_handle, 2>& f,
                  const Point_2& query) const;

  // Voronoi cells.
  Sides sides(Vertex_handle v) const;
  std::vector<Vertex_handle> by_direction(Vertex_handle v) const;
  bool is_left_turn(Vertex_handle p, Vertex_handle q, Vertex_handle r) const;
  template <class Position, class Evaluate>
  Voronoi_cell_2<Position> cell(Vertex_handle v, Evaluate evaluate) const;

  const Kinetic& kinetic_;
  Time time_;
  std::uint64_t number_of_events_;  // of the triangulation, when this object was made
  Instantaneous_traits at_;         // the time
  Instantaneous_traits beside_;     // the side of it at which the triangulation is Delaunay
};

extern template class Kinetic_queries_2<Linear_kinetic_traits_2>;
extern template class Kinetic_queries_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_QUERIES_2_H
