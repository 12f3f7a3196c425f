// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2. Include this only where the class is instantiated for a kinetic
// traits class of your own, whose points have trajectories (as Moving_point_2 has) and whose times
// are algebraic numbers; it is compiled into the library for both kinds of motion.
#ifndef KINETRI_TRIANGULATION_QUERIES_2_IMPL_H
#define KINETRI_TRIANGULATION_QUERIES_2_IMPL_H

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
Kinetic_queries_2<Traits>::Kinetic_queries_2(const Kinetic_triangulation_2<Traits>& triangulation,
                                             const Time& time)
    : kinetic_(triangulation),
      time_(time),
      changes_(number_of_changes()),
      at_(triangulation.traits().instantaneous_traits({time, Time_side::at})),
      beside_(triangulation.traits().instantaneous_traits(
          {time, time == triangulation.current_time() ? Time_side::after : Time_side::before})) {
  KINETRI_PRECONDITION(time >= triangulation.current_time(),
                       "a query about the past; query a time before the triangulation advances "
                       "beyond it");
  KINETRI_PRECONDITION(!triangulation.has_event_before(time),
                       "a query about a time after the next event; call advance_to for that time "
                       "first");
}

// ---- helpers ----

// Hidden points go from triangle to triangle without events.
template <KineticTraits_2 Traits>
std::uint64_t Kinetic_queries_2<Traits>::number_of_changes() const {
  const Triangulation_counters& counters = kinetic_.counters();
  return counters.number_of_events() + (is_weighted ? counters.instants : 0);
}

template <KineticTraits_2 Traits>
void Kinetic_queries_2<Traits>::check_is_current() const {
  KINETRI_PRECONDITION(number_of_changes() == changes_,
                       "the triangulation has changed since these queries were made; make new ones "
                       "after an event");
}

template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::vertex(Point_id id) const -> Vertex_handle {
  check_is_current();
  return kinetic_.vertex(id);
}

template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::resting_point(const Vector_2& place) -> Point_2 {
  typename Traits::Motion motion{};
  motion.position = place;
  KINETRI_PRECONDITION(is_finite(motion), "a place has a coordinate that is not finite");
  return Point_2(motion, no_point);
}

template <KineticTraits_2 Traits>
template <class Function>
void Kinetic_queries_2<Traits>::for_each_neighbor(Vertex_handle v, Function function) const {
  if (topology().dimension() < 1) return;
  auto neighbor = topology().incident_vertices(v);
  const auto first = neighbor;
  do {
    if (!topology().is_infinite(neighbor)) function(Vertex_handle(neighbor));
  } while (++neighbor != first);
}

// The vertices that belong to the set of `v` and are connected with it by edges within the set.
template <KineticTraits_2 Traits>
template <class Belongs>
auto Kinetic_queries_2<Traits>::connected(Vertex_handle v, Belongs belongs) const
    -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result = {v};
  std::unordered_set<Point_id> seen = {id(v)};
  for (std::size_t i = 0; i < result.size(); ++i) {
    for_each_neighbor(result[i], [&](Vertex_handle u) {
      if (seen.insert(id(u)).second && belongs(u)) result.push_back(u);
    });
  }
  return result;
}

// Calls `function` with each hidden vertex of the faces at `v`; below dimension 2 with all.
template <KineticTraits_2 Traits>
template <class Function>
void Kinetic_queries_2<Traits>::for_each_hidden_near(Vertex_handle v, Function function) const {
  if constexpr (is_weighted) {
    if (topology().number_of_hidden_vertices() == 0) return;
    if (topology().dimension() == 2) {
      return detail::for_each_face_at(topology(), v, [&](Face_handle face) {
        for (const Vertex_handle h : face->vertex_list()) function(h);
      });
    }
    for (auto h = topology().hidden_vertices_begin(); h != topology().hidden_vertices_end(); ++h) {
      function(Vertex_handle(h));
    }
  }
}

// The same as `connected`, and the hidden vertices of the set that belong to a face at one of
// those. A vertex may come several times.
template <KineticTraits_2 Traits>
template <class Belongs>
auto Kinetic_queries_2<Traits>::connected_or_hidden(Vertex_handle v, Belongs belongs) const
    -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result = connected(v, belongs);
  const std::size_t visible = result.size();
  for (std::size_t i = 0; i < visible; ++i) {
    for_each_hidden_near(result[i], [&](Vertex_handle h) {
      if (belongs(h)) result.push_back(h);
    });
  }
  return result;
}

// A vertex that is not hidden, and probably near the place. Precondition: there is a point.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::visible_near(const Point_2& place) const -> Vertex_handle {
  const Vertex_handle v = detail::Core_access::core(kinetic_).topology.vertex_near(
      place, kinetic_.current_time().to_double());
  if constexpr (is_weighted) {
    if (v->is_hidden()) {
      return topology().dimension() < 1 ? topology().finite_vertex() : v->face()->vertex(0);
    }
  }
  return v;
}

template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::coincide(const Point_2& p, const Point_2& q) const {
  return at_.compare_x_2_object()(p, q) == CGAL::EQUAL &&
         at_.compare_y_2_object()(p, q) == CGAL::EQUAL;
}

// Whether the two have one place and, with weights, one weight.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::are_alike(const Point_2& p, const Point_2& q) const {
  if (!coincide(p, q)) return false;
  if constexpr (is_weighted) {
    return at_.power_side_of_oriented_power_circle_2_object()(p, q) == CGAL::ON_ORIENTED_BOUNDARY;
  }
  return true;
}

// Whether p has less weight than q. Precondition: the two coincide.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_lighter(const Point_2& p, const Point_2& q) const {
  if constexpr (is_weighted) {
    return at_.power_side_of_oriented_power_circle_2_object()(p, q) == CGAL::ON_POSITIVE_SIDE;
  }
  return false;
}

template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_strictly_between(const Point_2& p, const Point_2& q,
                                                    const Point_2& r) const {
  return at_.orientation_2_object()(p, q, r) == CGAL::COLLINEAR &&
         at_.collinear_are_strictly_ordered_along_line_2_object()(p, q, r);
}

template <KineticTraits_2 Traits>
Comparison_result Kinetic_queries_2<Traits>::compare_distance(const Point_2& p, const Point_2& q,
                                                              const Point_2& r) const {
  return at_.compare_distance_2_object()(p, q, r);
}

// How the distance from p to q compares with that from p to r; with weights of these the power of
// the place of p to them.
template <KineticTraits_2 Traits>
Comparison_result Kinetic_queries_2<Traits>::compare_power(const Instantaneous_traits& instant,
                                                           const Point_2& p, const Point_2& q,
                                                           const Point_2& r) {
  if constexpr (is_weighted) {
    return instant.compare_power_distance_2_object()(p, q, r);
  } else {
    return instant.compare_distance_2_object()(p, q, r);
  }
}

// The ids of all points that are alike that of `v` at the time, which is one of them, in ascending
// order. Beside the time those with a cell are connected by edges, if the common cell has an area.
template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::all_at(Vertex_handle v) const {
  std::vector<Point_id> result;
  for (const Vertex_handle u :
       connected_or_hidden(v, [&](Vertex_handle w) { return are_alike(w->point(), v->point()); })) {
    result.push_back(id(u));
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// ---- the nearest point ----

// The points that are nearest to the query at the time, or of the least power. A vertex that is not
// nearest has a neighbor that is nearer, so going to nearer ones ends at the nearest one beside the
// time; by continuity that is a nearest one at the time. The others are in the same circle about
// the query, and the vertices in a circle are connected by edges. A hidden point that is nearest is
// in a face at one of them.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::all_nearest(const Point_2& query) const
    -> std::vector<Vertex_handle> {
  if (kinetic_.number_of_points() == 0) return {};
  Vertex_handle nearest = visible_near(query);
  for (Vertex_handle before; nearest != before;) {
    before = nearest;
    for_each_neighbor(before, [&](Vertex_handle u) {
      if (compare_power(beside_, query, u->point(), nearest->point()) == CGAL::SMALLER) nearest = u;
    });
  }
  return connected_or_hidden(nearest, [&](Vertex_handle u) {
    return compare_power(at_, query, u->point(), nearest->point()) == CGAL::EQUAL;
  });
}

template <KineticTraits_2 Traits>
std::optional<Point_id> Kinetic_queries_2<Traits>::nearest_vertex(const Vector_2& place) const {
  check_is_current();
  const std::vector<Vertex_handle> nearest = all_nearest(resting_point(place));
  if (nearest.empty()) return std::nullopt;
  return id(*std::ranges::min_element(nearest, {}, [](Vertex_handle v) { return id(v); }));
}

// ---- location ----

template <KineticTraits_2 Traits>
Location_2 Kinetic_queries_2<Traits>::locate(const Vector_2& place) const {
  check_is_current();
  const Point_2 query = resting_point(place);
  if (topology().dimension() < 2) return location_on_line(query);
  Face_handle face = find_face(query);
  if (topology().is_infinite(face)) face = find_face_at_hull(query, face);
  if (face == Face_handle()) return {};
  return location_in(faces_at(query, face), query);
}

// The finite face that contains the query beside the time, or an infinite one whose hull edge has
// the query strictly beyond it. Goes across any edge that has the query beyond it, which ends in a
// Delaunay triangulation.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::find_face(const Point_2& query) const -> Face_handle {
  const auto orientation = beside_.orientation_2_object();
  Face_handle face = visible_near(query)->face();
  if (topology().is_infinite(face))
    face = face->neighbor(face->index(topology().infinite_vertex()));
  Face_handle previous;
  while (!topology().is_infinite(face)) {
    int i = 0;
    while (i < 3 &&
           (face->neighbor(i) == previous ||
            orientation(face->vertex(Topology::ccw(i))->point(),
                        face->vertex(Topology::cw(i))->point(), query) != CGAL::RIGHT_TURN)) {
      ++i;
    }
    if (i == 3) return face;
    previous = std::exchange(face, face->neighbor(i));
  }
  return face;
}

// A query that is outside of the hull beside the time may be at the hull at the time: then no hull
// edge has it strictly beyond its line, and one of them contains it. That one's finite face; none
// if the query is outside.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::find_face_at_hull(const Point_2& query,
                                                  Face_handle infinite_face) const -> Face_handle {
  Face_handle face = infinite_face;
  Face_handle result;
  do {
    const int i = face->index(topology().infinite_vertex());
    // Seen from outside, so that the inner side is on the right.
    if (at_.orientation_2_object()(face->vertex(Topology::ccw(i))->point(),
                                   face->vertex(Topology::cw(i))->point(),
                                   query) == CGAL::LEFT_TURN) {
      return Face_handle();
    }
    if (result == Face_handle() && is_on_closed_edge(query, face, i)) result = face->neighbor(i);
    face = face->neighbor(Topology::ccw(i));
  } while (face != infinite_face);
  return result;
}

template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_on_closed_edge(const Point_2& query, Face_handle face,
                                                  int i) const {
  const Point_2& p = face->vertex(Topology::ccw(i))->point();
  const Point_2& q = face->vertex(Topology::cw(i))->point();
  return is_strictly_between(p, query, q) || coincide(p, query) || coincide(q, query);
}

// All finite faces that contain the query at the time, on their boundary or inside, when one of
// them is known. Beside the time they cover a small disc about the query within the hull, and so
// are connected across edges that contain it at the time.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::faces_at(const Point_2& query, Face_handle face) const
    -> std::vector<Face_handle> {
  std::vector<Face_handle> result = {face};
  std::unordered_set<Face_handle> seen = {face};
  for (std::size_t j = 0; j < result.size(); ++j) {
    const Face_handle here = result[j];
    for (int i = 0; i < 3; ++i) {
      const Face_handle there = here->neighbor(i);
      if (topology().is_infinite(there) || seen.contains(there)) continue;
      if (!is_on_closed_edge(query, here, i)) continue;
      seen.insert(there);
      result.push_back(there);
    }
  }
  return result;
}

// Precondition: `faces` are all those that contain the query at the time.
template <KineticTraits_2 Traits>
Location_2 Kinetic_queries_2<Traits>::location_in(const std::vector<Face_handle>& faces,
                                                  const Point_2& query) const {
  std::optional<Point_id> point;
  std::optional<std::array<Vertex_handle, 2>> edge;
  for (const Face_handle face : faces) {
    for (int i = 0; i < 3; ++i) {
      const Vertex_handle v = face->vertex(i);
      if (coincide(v->point(), query)) point = std::min(point.value_or(no_point), id(v));
      const Vertex_handle p = face->vertex(Topology::ccw(i));
      const Vertex_handle q = face->vertex(Topology::cw(i));
      if (!is_strictly_between(p->point(), query, q->point())) continue;
      const std::array<Vertex_handle, 2> candidate = {p, q};
      if (!edge || is_shorter(candidate, *edge, query)) edge = candidate;
    }
  }
  using Kind = Location_2::Kind;
  if (point) return {Kind::vertex, {*point}};
  if (edge) {
    const Edge_ids ids = edge_ids(id((*edge)[0]), id((*edge)[1]));
    return {Kind::edge, {ids[0], ids[1]}};
  }
  const Face_handle face = faces.front();
  std::vector<Point_id> ids = {id(face->vertex(0)), id(face->vertex(1)), id(face->vertex(2))};
  std::rotate(ids.begin(), std::ranges::min_element(ids), ids.end());
  return {Kind::face, std::move(ids)};
}

// Of edges that are strictly on both sides of the query, along one line, one without points between
// its ends is shorter than every other one at both ends, or has the same ends; then the ids decide.
// Between two others either may be called the shorter one.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_shorter(const std::array<Vertex_handle, 2>& e,
                                           const std::array<Vertex_handle, 2>& f,
                                           const Point_2& query) const {
  const bool is_reversed = is_strictly_between(e[0]->point(), query, f[0]->point());
  const Vertex_handle beside_first = f[is_reversed ? 1 : 0];
  const Vertex_handle beside_second = f[is_reversed ? 0 : 1];
  const auto first = compare_distance(query, e[0]->point(), beside_first->point());
  const auto second = compare_distance(query, e[1]->point(), beside_second->point());
  if (first == CGAL::SMALLER || second == CGAL::SMALLER) return true;
  return first == CGAL::EQUAL && second == CGAL::EQUAL &&
         edge_ids(id(e[0]), id(e[1])) < edge_ids(id(f[0]), id(f[1]));
}

// Without faces: all points are on a line, and the edges are between successive ones. Only one of
// them, or none, has the query strictly between its ends.
template <KineticTraits_2 Traits>
Location_2 Kinetic_queries_2<Traits>::location_on_line(const Point_2& query) const {
  std::optional<Point_id> point;
  std::optional<Edge_ids> edge;
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    if (coincide(v->point(), query)) point = std::min(point.value_or(no_point), id(v));
    for_each_neighbor(v, [&](Vertex_handle u) {
      if (!is_strictly_between(v->point(), query, u->point())) return;
      edge = edge_ids(id(u), id(v));
    });
  }
  using Kind = Location_2::Kind;
  if (point) return {Kind::vertex, {*point}};
  if (edge) return {Kind::edge, {(*edge)[0], (*edge)[1]}};
  return {};
}

// ---- neighbors ----

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::neighbors(Point_id point) const {
  const Vertex_handle v = vertex(point);
  std::vector<Point_id> result;
  if (kinetic_.is_hidden(point)) return result;
  if (topology().dimension() < 2) {
    for_each_neighbor(v, [&](Vertex_handle u) { result.push_back(id(u)); });
    std::ranges::sort(result);
    return result;
  }
  // The infinite vertex has the id no_point.
  auto neighbor = topology().incident_vertices(v);
  const auto start = neighbor;
  do {
    result.push_back(id(neighbor));
  } while (++neighbor != start);
  const auto infinite = std::ranges::find(result, no_point);
  if (infinite == result.end()) {
    std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  } else {
    std::rotate(result.begin(), infinite, result.end());
    result.erase(result.begin());
  }
  return result;
}

}  // namespace kinetri

#include "kinetri/impl/triangulation/ball_cell_impl.h"
#include "kinetri/impl/triangulation/nearest_neighbor_impl.h"
#include "kinetri/impl/triangulation/voronoi_areas_impl.h"
#include "kinetri/impl/triangulation/voronoi_cell_impl.h"
#include "kinetri/impl/triangulation/voronoi_sides_impl.h"

#endif  // KINETRI_TRIANGULATION_QUERIES_2_IMPL_H
