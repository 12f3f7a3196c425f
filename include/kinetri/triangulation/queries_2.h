// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about moving points at one time: the current time, or any time up to the next event,
// without advancing the triangulation.
//
// The answers hold for the positions at exactly that time, even if these are degenerate: coinciding
// points, flat triangles, cocircular points. The search uses the triangulation just beside the time
// (just after the current time, just before a later one), where it is properly embedded. What it
// finds there is, at the time itself, an answer or connected with an answer by edges; the decision
// is made for the time itself (docs/MATH.md, section 10).
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
/// any other point. `Position` is Exact_position_2, or Vector_2 for rounded coordinates. Coinciding
/// points have the same cell.
template <class Position>
struct Voronoi_cell_2 {
  /// The neighbor across each side, counterclockwise; for coinciding points the smallest id. All
  /// sides have positive length. A bounded cell begins with a nearest point, an unbounded cell with
  /// the side that comes from infinity.
  std::vector<Point_id> neighbors = {};
  /// vertices[i] is the end of side i and the start of the next side. Before rounding no two are
  /// equal. A bounded cell has as many vertices as sides, an unbounded cell has one fewer. Without
  /// vertices each side is a whole bisector, and the cell is a half plane (one side), a strip (two
  /// sides), or the plane (no side).
  std::vector<Position> vertices = {};
  /// For an unbounded cell with sides: the directions in which the first and the last side go to
  /// infinity, each as long as the vector from the point to the neighbor across that side.
  std::optional<std::array<Position, 2>> rays = std::nullopt;

  /// Whether the cell is bounded. Cells of points on the boundary of the convex hull are unbounded.
  bool is_bounded() const { return !rays && !neighbors.empty(); }
};

/// Queries at one time. A small object: it holds a reference to the triangulation and a time. Use
/// it only while the triangulation does not change, and not in an observer. Several threads may ask
/// one object, or objects of one triangulation, at once.
///
/// A query position is two binary64 numbers, taken exactly. The functions throw Precondition_error
/// if a position is not finite, if no point has a given id, or if an event has happened since this
/// object was constructed.
///
/// A walk through the triangulation takes expected O(sqrt(n)) predicates, O(n) in the worst case;
/// it does not start near the query position.
template <KineticTraits_2 Traits = Linear_kinetic_traits_2>
class Kinetic_queries_2 {
 public:
  using Time = Algebraic_number;             ///< of events
  using Point_2 = typename Traits::Point_2;  ///< of the traits

  /// Queries at the current time.
  explicit Kinetic_queries_2(const Kinetic_delaunay_triangulation_2<Traits>& triangulation)
      : Kinetic_queries_2(triangulation, triangulation.current_time()) {}

  /// Queries at `time`. If it is the time of the next event, the answers hold for the triangulation
  /// before the event. Precondition: `time` is neither before triangulation.current_time() nor
  /// after the next event (checked exactly, see has_event_before). Walls and collisions of a
  /// Simulation_2 are not events of its triangulation: after the next contact the answers still
  /// assume the current motions.
  Kinetic_queries_2(const Kinetic_delaunay_triangulation_2<Traits>& triangulation,
                    const Time& time);

  /// The time of the queries.
  const Time& time() const { return time_; }

  /// The point nearest to the position; of equally near points the smallest id; none if there are
  /// no points. Cost: a walk, and the degrees of the equally near points.
  std::optional<Point_id> nearest_vertex(const Vector_2& place) const;

  /// The triangle, edge or point at the position. If flat triangles overlap there, an edge without
  /// points between its ends. Cost: a walk, and the number of faces that contain the position; for
  /// a position outside the hull on the line of a hull edge also the number of hull edges.
  Location_2 locate(const Vector_2& place) const;

  /// The points with an edge to `point`, counterclockwise: for an inner point the smallest id
  /// first, for a hull point from one hull neighbor to the other. If all points are collinear at
  /// all times, in ascending order. At a degenerate time other Delaunay triangulations exist, with
  /// other edges; voronoi_cell gives the neighbors that all of them have. Cost: O(degree).
  std::vector<Point_id> neighbors(Point_id point) const;

  /// The exact Voronoi cell of the point `id`. Precondition: the time is known to be rational
  /// (Algebraic_number::is_known_rational); a binary64 number is. Cost: for degree d, O(d log d)
  /// predicates, and one exact evaluation per vertex.
  Voronoi_cell_2<Exact_position_2> voronoi_cell(Point_id id) const;

  /// The Voronoi cell at any time. Its sides are decided exactly; each coordinate is rounded to the
  /// nearest binary64 number, ties to even. Cost: as voronoi_cell; at an irrational time also some
  /// refinements per coordinate.
  Voronoi_cell_2<Vector_2> rounded_voronoi_cell(Point_id id) const;

  /// The pair of points nearest to each other; of several such pairs the first in the order of
  /// Edge_ids; none for fewer than two points. Cost: O(n) floating-point operations, and exact
  /// comparisons of the edges that these cannot distinguish from the shortest.
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
