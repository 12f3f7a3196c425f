// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: Voronoi cells and positions rounded from ball arithmetic, and
// exactly where that does not decide.
#ifndef KINETRI_IMPL_TRIANGULATION_BALL_CELL_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_BALL_CELL_IMPL_H

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/impl/algebra/rounded_quotient.h"
#include "kinetri/impl/triangulation/ball.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/prefetch.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

namespace detail {

/// The vector from a point to the centre of the circle through it and two neighbors. None where the
/// turn from the first to the second is not certainly one to the left.
template <class Neighbor>
std::optional<Ball_2> circumcenter(const Neighbor& first, const Neighbor& second) {
  const auto& [vertex_a, a, squared_a] = first;
  const auto& [vertex_b, b, squared_b] = second;
  const Ball turn = a.x * b.y - a.y * b.x;
  if (!turn.is_positive()) return std::nullopt;
  const Ball factor = Ball(1) / twice(turn);
  return Ball_2{(squared_a * b.y - squared_b * a.y) * factor,
                (squared_b * a.x - squared_a * b.x) * factor};
}

/// Zero if and only if the three are on one circle through the point, or all four are collinear.
template <class Neighbor>
Ball in_circle(const Neighbor& a, const Neighbor& b, const Neighbor& c) {
  const auto turn = [](const Ball_2& p, const Ball_2& q) { return p.x * q.y - p.y * q.x; };
  return a.squared_distance * turn(b.vector, c.vector) +
         b.squared_distance * turn(c.vector, a.vector) +
         c.squared_distance * turn(a.vector, b.vector);
}

/// Both coordinates rounded, where that is certain.
inline std::optional<Vector_2> rounded(const Ball_2& place) {
  const auto x = place.x.rounded();
  const auto y = place.y.rounded();
  return x && y ? std::optional(Vector_2{*x, *y}) : std::nullopt;
}

}  // namespace detail

template <KineticTraits_2 Traits>
Vector_2 Kinetic_queries_2<Traits>::rounded_position(const Trajectory_2& path) const {
  return {rounded_quotient(path.x, path.w, time_), rounded_quotient(path.y, path.w, time_)};
}

template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::neighbor_at(const detail::Ball_2& here, Vertex_handle u,
                                            const detail::Ball& t) const -> Neighbor {
  const detail::Ball_2 vector = ball_place(u, t) - here;
  return {u, vector, squared_length(vector)};
}

// The centre of the circle through the places of `v`, which is `here`, and of two neighbors;
// `center` is the vector to it, if that is known.
template <KineticTraits_2 Traits>
Vector_2 Kinetic_queries_2<Traits>::rounded_center(
    Vertex_handle v, const detail::Ball_2& here, const Neighbor& a, const Neighbor& b,
    const std::optional<detail::Ball_2>& center) const {
  if (center) {
    if (const auto known = detail::rounded({here.x + center->x, here.y + center->y})) return *known;
  }
  return rounded_position(this->center(v, a.vertex, b.vertex));
}

// The finite neighbors of `v` counterclockwise, from infinity to infinity where `v` is on the hull.
// Returns whether it is not. Begins to load what will be looked at.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::find_ring(Vertex_handle v, std::vector<Ring_entry>& ring) const {
  std::optional<std::size_t> infinite;
  Face_handle previous;
  detail::for_each_face_at(topology(), v, [&](Face_handle face, int at_v) {
    const Vertex_handle u = face->vertex(Topology::ccw(at_v));
    const Face_handle beyond = face->neighbor(at_v);
    if (topology().is_infinite(u)) {
      infinite = ring.size();
    } else {
      ring.push_back({{u, {}, {}}, {}, previous, beyond, {}});
    }
    previous = beyond;
    detail::prefetch(u);
    detail::prefetch(beyond);
  });
  // Of the point that begins with the first face; infinity has no entry.
  if (infinite != 0) ring.front().before = previous;
  if (infinite) {
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(*infinite), ring.end());
  }
  return !infinite;
}

// Whether each point of the ring of `v` is certainly apart from its neighbors that are neither `v`
// nor next to it in the ring. Steps around all points of the ring at once, and in both directions,
// since each step waits for memory.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::are_alone(std::vector<Ring_entry>& ring,
                                          const detail::Ball& t) const {
  std::vector<std::pair<const Ring_entry*, Vertex_handle>> pairs;
  pairs.reserve(6 * ring.size());
  const auto step = [&](const Ring_entry& u, Face_handle& face, bool is_clockwise) {
    const int at_u = detail::index_in(face, u.neighbor.vertex);
    const int ccw = Topology::ccw(at_u);
    const int cw = Topology::cw(at_u);
    const Vertex_handle w = face->vertex(is_clockwise ? ccw : cw);
    face = face->neighbor(is_clockwise ? cw : ccw);
    detail::prefetch(w);
    detail::prefetch(face);
    if (!topology().is_infinite(w)) pairs.emplace_back(&u, w);
  };
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (Ring_entry& u : ring) {
      if (u.beyond == u.before) continue;
      step(u, u.beyond, true);
      if (u.beyond == u.before) continue;
      step(u, u.before, false);
      is_done = is_done && u.beyond == u.before;
    }
  }
  return std::ranges::all_of(pairs, [&](const auto& pair) {
    return detail::are_apart(pair.first->place, approximate_place(pair.second, t));
  });
}

// Whether the side between `b`'s two circumcenters, with the neighbors before and after it, has no
// length. Precondition: a and b, and b and c, certainly turn left around `v`.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::has_no_length(Vertex_handle v, const Ring_entry& a,
                                              const Ring_entry& b, const Ring_entry& c) const {
  if ((b.center.x - a.center.x).is_nonzero() || (b.center.y - a.center.y).is_nonzero())
    return false;
  if (detail::in_circle(a.neighbor, b.neighbor, c.neighbor).is_zero()) return true;
  return at_.side_of_oriented_circle_2_object()(
             v->point(), a.neighbor.vertex->point(), c.neighbor.vertex->point(),
             b.neighbor.vertex->point()) == CGAL::ON_ORIENTED_BOUNDARY;
}

// The cell of a point around which each triangle certainly turns left at the time, so that no two
// of these points coincide and no neighbors are in one direction, and whose neighbors certainly
// coincide with no other point. The sides are those of positive length; by continuity none is
// turned around. None where that is not certain.
template <KineticTraits_2 Traits>
std::optional<Voronoi_cell_2<Vector_2>> Kinetic_queries_2<Traits>::ball_cell(
    Vertex_handle v) const {
  if (is_weighted || topology().dimension() < 2) return std::nullopt;
  const detail::Ball t = detail::ball_of(time_);
  std::vector<Ring_entry> ring;
  ring.reserve(10);
  const bool is_bounded = find_ring(v, ring);
  const std::size_t n = ring.size();
  const detail::Ball_2 here = ball_place(v, t);
  std::size_t first = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vertex_handle u = ring[i].neighbor.vertex;
    ring[i].neighbor = neighbor_at(here, u, t);
    ring[i].place = approximate_place(u, t);
    if (!is_bounded || i == 0) continue;
    const auto order = compare_distance(v, ring[i].neighbor, ring[first].neighbor);
    if (order == CGAL::SMALLER ||
        (order == CGAL::EQUAL && id(u) < id(ring[first].neighbor.vertex))) {
      first = i;
    }
  }
  if (!are_alone(ring, t)) return std::nullopt;
  // The entry `i` after the first, where `i` is at most n.
  const auto at = [&](std::size_t i) -> Ring_entry& {
    const std::size_t k = first + i;
    return ring[k < n ? k : k - n];
  };
  for (std::size_t i = 0; i < (is_bounded ? n : n - 1); ++i) {
    const auto center = detail::circumcenter(at(i).neighbor, at(i + 1).neighbor);
    if (!center) return std::nullopt;
    at(i).center = *center;
  }

  Voronoi_cell_2<Vector_2> result;
  result.neighbors.reserve(n);
  result.vertices.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Ring_entry& u = at(i);
    // The nearest point has a side, and so has one that goes to infinity.
    const bool is_inner = i > 0 && (is_bounded || i + 1 < n);
    if (is_inner && has_no_length(v, at(i - 1), u, at(i + 1))) continue;
    result.neighbors.push_back(id(u.neighbor.vertex));
    if (!is_bounded && i + 1 == n) continue;
    result.vertices.push_back(rounded_center(v, here, u.neighbor, at(i + 1).neighbor, u.center));
  }
  if (is_bounded) return result;
  const auto turned = [&](const Neighbor& u, bool to_left) {
    const auto& [x, y] = u.vector;
    const auto vector = detail::rounded(to_left ? detail::Ball_2{-y, x} : detail::Ball_2{y, -x});
    return vector ? *vector : rounded_position(ray(v, u.vertex, to_left));
  };
  result.rays = {turned(at(0).neighbor, false), turned(at(n - 1).neighbor, true)};
  return result;
}

template <KineticTraits_2 Traits>
Voronoi_cell_2<Vector_2> Kinetic_queries_2<Traits>::rounded_voronoi_cell(Point_id id) const {
  const Vertex_handle v = vertex(id);
  if (auto result = ball_cell(v)) return *std::move(result);
  const detail::Ball t = detail::ball_of(time_);
  const detail::Ball_2 here = ball_place(v, t);
  const auto center_at = [&](Vertex_handle u, Vertex_handle w) {
    if constexpr (is_weighted) return rounded_position(center(v, u, w));
    const Neighbor a = neighbor_at(here, u, t);
    const Neighbor b = neighbor_at(here, w, t);
    return rounded_center(v, here, a, b, detail::circumcenter(a, b));
  };
  return cell<Vector_2>(v, center_at,
                        [&](const Trajectory_2& ray) { return rounded_position(ray); });
}

template <KineticTraits_2 Traits>
std::vector<double> Kinetic_queries_2<Traits>::rounded_positions() const {
  check_is_current();
  const detail::Ball t = detail::ball_of(time_);
  std::vector<double> result(2 * std::size_t{kinetic_.next_id()},
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
    if (!kinetic_.contains(id)) continue;
    const Vertex_handle v = kinetic_.vertex(id);
    const auto known = detail::rounded(ball_place(v, t));
    const Vector_2 place = known ? *known : rounded_position(v->point().trajectory());
    result[2 * std::size_t{id}] = place.x;
    result[2 * std::size_t{id} + 1] = place.y;
  }
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_BALL_CELL_IMPL_H
