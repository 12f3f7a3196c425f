// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries at a position at one time: the nearest points; the vertex, edge or face that contains it.
#ifndef KINETRI_SRC_TRIANGULATION_POSITION_QUERY_H
#define KINETRI_SRC_TRIANGULATION_POSITION_QUERY_H

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/triangulation/periodic_queries_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/triangulation_at_time.h"

namespace kinetri::detail {

/// The queries at one finite position.
template <KineticTraits_2 Traits>
class Position_query {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Triangulation = typename At_time::Triangulation;
  using Vertex = typename At_time::Vertex;
  using Face = typename At_time::Face;
  using Name = typename At_time::Name;
  using Point_2 = typename At_time::Point_2;
  using Location = std::conditional_t<At_time::is_periodic, Periodic_location_2, Location_2>;

  /// The triangulation must outlive this object.
  Position_query(const At_time& at, const Vector_2& position)
      : at_(at),
        triangulation_(at.triangulation()),
        point_(resting_point(position)),
        query_(at.place(point_)) {}

  /// The points that are nearest at the time, or have the least power.
  // A vertex that is not nearest has a nearer neighbor, so walking to nearer ones ends at the
  // nearest one beside the time; by continuity that is a nearest one at the time. The others are on
  // the same circle about the query, and edges connect the vertices in a circle. A hidden point
  // that is nearest is in a face at one of them.
  std::vector<Vertex> all_nearest() const {
    if (triangulation_.number_of_vertices() == 0) return {};
    Vertex nearest = at_.visible_near(point_);
    for (Vertex before; nearest != before;) {
      before = nearest;
      at_.for_each_neighbor(before, [&](Vertex u) {
        if (at_.compare_power_beside(query_, u, nearest) == CGAL::SMALLER) nearest = u;
      });
    }
    return at_.connected(
        nearest, [&](Vertex u) { return at_.compare_power(query_, u, nearest) == CGAL::EQUAL; });
  }

  /// The vertex, edge or face that contains the position at the time.
  Location location() const {
    if constexpr (At_time::is_periodic) {
      if (triangulation_.dimension() < 2) return {};
      return location_in(faces_at(find_face()));
    } else {
      if (triangulation_.dimension() < 2) return location_on_line();
      Face face = find_face();
      if (triangulation_.is_infinite(face)) face = find_face_at_hull(face);
      if (face == Face()) return {};
      return location_in(faces_at(face));
    }
  }

 private:
  using Kind = Location_2::Kind;

  static Point_2 resting_point(const Vector_2& position) {
    typename Traits::Motion motion{};
    motion.position = position;
    KINETRI_PRECONDITION(is_finite(motion), "a place has a coordinate that is not finite");
    return Point_2(motion, no_point);
  }

  // The finite face that contains the query beside the time, or an infinite one whose hull edge has
  // the query strictly beyond it. The walk crosses any edge that has the query beyond it; in a
  // Delaunay triangulation it ends.
  Face find_face() const {
    const auto orientation = at_.beside().orientation_2_object();
    Face face = at_.face_at(at_.visible_near(point_));
    if constexpr (!At_time::is_periodic) {
      if (triangulation_.is_infinite(face)) {
        face = face->neighbor(face->index(triangulation_.infinite_vertex()));
      }
    }
    Face previous = {};
    while (!at_.is_infinite(face)) {
      int i = 0;
      while (i < 3 && (at_.neighbor(face, i) == previous ||
                       orientation(at_.point(at_.corner(face, Triangulation::ccw(i))),
                                   at_.point(at_.corner(face, Triangulation::cw(i))),
                                   query_) != CGAL::RIGHT_TURN)) {
        ++i;
      }
      if (i == 3) return face;
      previous = std::exchange(face, at_.neighbor(face, i));
    }
    return face;
  }

  // A query that is outside the hull beside the time may be on the hull at the time: then it is
  // strictly beyond no hull edge, and on one of them. Returns the finite face of that edge; none if
  // the query is outside.
  Face find_face_at_hull(Face infinite_face) const {
    Face face = infinite_face;
    Face result;
    do {
      const int i = face->index(triangulation_.infinite_vertex());
      // As seen from outside: the inner side is on the right.
      if (at_.orientation(face->vertex(Triangulation::ccw(i)), face->vertex(Triangulation::cw(i)),
                          query_) == CGAL::LEFT_TURN) {
        return Face();
      }
      if (result == Face() && is_on_closed_edge(face, i)) result = face->neighbor(i);
      face = face->neighbor(Triangulation::ccw(i));
    } while (face != infinite_face);
    return result;
  }

  bool is_on_closed_edge(const Face& face, int i) const {
    const Vertex p = at_.corner(face, Triangulation::ccw(i));
    const Vertex q = at_.corner(face, Triangulation::cw(i));
    return at_.is_strictly_between(p, query_, q) || at_.coincide(p, query_) ||
           at_.coincide(q, query_);
  }

  // All finite faces that contain the query at the time, given one of them. Beside the time they
  // cover a small disc about the query within the hull, and so are connected across edges that
  // contain it at the time.
  std::vector<Face> faces_at(const Face& face) const {
    std::vector<Face> result = {face};
    std::set<Face> seen = {face};
    for (std::size_t j = 0; j < result.size(); ++j) {
      const Face here = result[j];
      for (int i = 0; i < 3; ++i) {
        const Face there = at_.neighbor(here, i);
        if (at_.is_infinite(there) || seen.contains(there)) continue;
        if (!is_on_closed_edge(here, i)) continue;
        seen.insert(there);
        result.push_back(there);
      }
    }
    return result;
  }

  // Precondition: `faces` are all those that contain the query at the time.
  Location location_in(const std::vector<Face>& faces) const {
    std::optional<Name> point;
    std::optional<std::array<Vertex, 2>> edge;
    for (const Face& face : faces) {
      for (int i = 0; i < 3; ++i) {
        const Vertex v = at_.corner(face, i);
        if (at_.coincide(v, query_)) point = std::min(point.value_or(at_.name(v)), at_.name(v));
        const Vertex p = at_.corner(face, Triangulation::ccw(i));
        const Vertex q = at_.corner(face, Triangulation::cw(i));
        if (!at_.is_strictly_between(p, query_, q)) continue;
        const std::array<Vertex, 2> candidate = {p, q};
        if (!edge || is_shorter(candidate, *edge)) edge = candidate;
      }
    }
    if (point) return {Kind::vertex, {*point}};
    if (edge) {
      const auto [first, second] = names_of(*edge);
      return {Kind::edge, {first, second}};
    }
    std::vector<Name> corners;
    for (int i = 0; i < 3; ++i) corners.push_back(at_.name(at_.corner(faces.front(), i)));
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    return {Kind::face, std::move(corners)};
  }

  // Compares edges along one line with the query strictly between their ends. An edge without
  // points between its ends is at both ends at most as far from the query as any other one; if all
  // are equal, the names decide. For two other edges the result does not matter.
  bool is_shorter(const std::array<Vertex, 2>& e, const std::array<Vertex, 2>& f) const {
    const bool is_reversed = at_.is_strictly_between(e[0], query_, f[0]);
    const auto first = at_.compare_distance(query_, e[0], f[is_reversed ? 1 : 0]);
    const auto second = at_.compare_distance(query_, e[1], f[is_reversed ? 0 : 1]);
    if (first == CGAL::SMALLER || second == CGAL::SMALLER) return true;
    return first == CGAL::EQUAL && second == CGAL::EQUAL && names_of(e) < names_of(f);
  }

  static std::array<Name, 2> names_of(const std::array<Vertex, 2>& edge) {
    const Name first = At_time::name(edge[0]);
    const Name second = At_time::name(edge[1]);
    return first < second ? std::array{first, second} : std::array{second, first};
  }

  // Without faces: all points are collinear, with edges between successive ones. At most one of
  // these has the query strictly between its ends.
  Location location_on_line() const {
    std::optional<Point_id> point;
    std::optional<std::array<Name, 2>> edge;
    for (const Vertex v : triangulation_.finite_vertex_handles()) {
      if (at_.coincide(v, query_)) point = std::min(point.value_or(no_point), at_.id(v));
      at_.for_each_neighbor(v, [&](Vertex u) {
        if (at_.is_strictly_between(v, query_, u)) edge = names_of({u, v});
      });
    }
    if (point) return {Kind::vertex, {*point}};
    if (edge) return {Kind::edge, {(*edge)[0], (*edge)[1]}};
    return {};
  }

  const At_time& at_;
  const Triangulation& triangulation_;
  Point_2 point_;
  typename At_time::Place query_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_POSITION_QUERY_H
