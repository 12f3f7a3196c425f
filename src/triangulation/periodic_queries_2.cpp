// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/periodic_queries_2.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "triangulation/nearest_points.h"
#include "triangulation/position_query.h"
#include "triangulation/torus_topology.h"
#include "triangulation/voronoi_ring.h"
#include "triangulation/voronoi_sides.h"

namespace kinetri {
namespace {

using Traits = Periodic_kinetic_traits_2;
using At_time = detail::Triangulation_at_time<Traits>;
using Balls = detail::Ball_positions<Traits>;
using Vertex = At_time::Vertex;

// The vectors from a vertex to the corners of its cell, rounded to nearest, counterclockwise.
std::vector<Vector_2> rounded_corners(const Balls& balls, const Vertex& v) {
  const At_time& at = balls.at();
  const auto here = balls.position(v);
  const auto rounded_corner = [&](const Balls::Neighbor& a, const Balls::Neighbor& b,
                                  const std::optional<detail::Ball_2>& center) {
    if (center) {
      if (const auto known = detail::rounded(*center)) return *known;
    }
    return at.rounded_position(
        At_time::vector(at.point(v).trajectory(), at.center(v, a.vertex, b.vertex)));
  };
  // If all triangles certainly turn left, the corners are the centers of their circles, some of
  // which may be equal.
  std::vector<Balls::Neighbor> ring;
  at.for_each_neighbor(v, [&](const Vertex& u) { ring.push_back(balls.neighbor(here, u)); });
  std::vector<Vector_2> result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Balls::Neighbor& next = ring[i + 1 < ring.size() ? i + 1 : 0];
    const auto center = detail::circumcenter(ring[i], next);
    if (!center) break;
    result.push_back(rounded_corner(ring[i], next, center));
  }
  if (result.size() == ring.size()) return result;
  return detail::Voronoi_sides<Traits>(at, v).corners([&](const Vertex& a, const Vertex& b) {
    const auto first = balls.neighbor(here, a);
    const auto second = balls.neighbor(here, b);
    return rounded_corner(first, second, detail::circumcenter(first, second));
  });
}

// Of a polygon around the origin: the triangles between the origin and its sides.
double area(const std::vector<Vector_2>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector_2& p = polygon[i];
    const Vector_2& q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    constexpr double greatest = 1e150;
    KINETRI_PRECONDITION(std::abs(p.x) < greatest && std::abs(p.y) < greatest,
                         "a Voronoi cell is so large that its area may not be a binary64 number; "
                         "give lattice vectors below 1e150");
    sum += p.x * (q.y - p.y) - p.y * (q.x - p.x);
  }
  return sum / 2;
}

template <class Position, class Center>
Periodic_voronoi_cell_2<Position> cell(const At_time& at, const Vertex& v, Center center_at) {
  const detail::Voronoi_sides<Traits> sides(at, v);
  Periodic_voronoi_cell_2<Position> result;
  for (const Vertex& u : sides.across()) result.neighbors.push_back(At_time::name(u));
  result.vertices = sides.corners(center_at);
  return result;
}

}  // namespace

Periodic_queries_2::Periodic_queries_2(const Triangulation& triangulation, const Time& time)
    : changes_(triangulation.counters().number_of_events()) {
  KINETRI_PRECONDITION(time >= triangulation.current_time(),
                       "a query about the past; query a time before the triangulation advances "
                       "beyond it");
  triangulation.traits().box().require_area(triangulation.current_time(), time);
  KINETRI_PRECONDITION(!triangulation.has_event_before(time),
                       "a query about a time after the next event; call advance_to for that time "
                       "first");
  at_ = std::make_shared<const At_time>(
      std::make_unique<detail::Queried<Traits, Traits>>(triangulation), time);
}

auto Periodic_queries_2::time() const -> const Time& {
  return at().time();
}

void Periodic_queries_2::check_is_current() const {
  KINETRI_PRECONDITION(at().kinetic().counters().number_of_events() == changes_,
                       "the triangulation has changed since these queries were made; make new ones "
                       "after an event");
}

// The check of Kinetic_triangulation_2.
void Periodic_queries_2::check_point(Point_id id) const {
  check_is_current();
  at().kinetic().vertex(id);
}

std::optional<Periodic_image> Periodic_queries_2::nearest_vertex(const Vector_2& place) const {
  check_is_current();
  const auto nearest = detail::Position_query<Traits>(at(), place).all_nearest();
  if (nearest.empty()) return std::nullopt;
  return At_time::name(*std::ranges::min_element(nearest, {}, At_time::name));
}

Periodic_location_2 Periodic_queries_2::locate(const Vector_2& place) const {
  check_is_current();
  return detail::Position_query<Traits>(at(), place).location();
}

std::vector<Periodic_image> Periodic_queries_2::neighbors(Point_id id) const {
  check_point(id);
  const Vertex v = at().vertex({id, {}});
  if (At_time::id(v) != id) return {At_time::name(v)};
  std::vector<Periodic_image> result;
  at().for_each_neighbor(v, [&](const Vertex& u) { result.push_back(At_time::name(u)); });
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  const std::vector<Periodic_image> hidden = at().names_hidden_by(v);
  result.insert(result.end(), hidden.begin(), hidden.end());
  return result;
}

// ---- Voronoi cells ----

Periodic_voronoi_cell_2<Exact_position_2> Periodic_queries_2::voronoi_cell(Point_id id) const {
  check_point(id);
  time().tight_interval();  // so that a binary64 number is known to be one
  KINETRI_PRECONDITION(time().is_known_rational(),
                       "at a time that is not known to be rational a Voronoi vertex has no exact "
                       "coordinates; call rounded_voronoi_cell");
  const Rational t = time().rational();
  const Vertex v = at().vertex({id, {}});
  return cell<Exact_position_2>(at(), v, [&](const Vertex& a, const Vertex& b) {
    const Trajectory_2 path = at().center(v, a, b);
    const Rational w = path.w(t);
    return Exact_position_2{path.x(t) / w, path.y(t) / w};
  });
}

Periodic_voronoi_cell_2<Vector_2> Periodic_queries_2::rounded_voronoi_cell(Point_id id) const {
  check_point(id);
  const Vertex v = at().vertex({id, {}});
  const Balls balls(at());
  const auto here = balls.position(v);
  return cell<Vector_2>(at(), v, [&](const Vertex& u, const Vertex& w) {
    const auto a = balls.neighbor(here, u);
    const auto b = balls.neighbor(here, w);
    return balls.rounded_center(v, here, a, b, detail::circumcenter(a, b));
  });
}

std::vector<double> Periodic_queries_2::rounded_voronoi_areas() const {
  check_is_current();
  const Balls balls(at());
  const detail::Nearest_points<Traits> points(at());
  std::vector<double> result(at().kinetic().next_id(), 0.0);
  for (const auto handle : at().triangulation().finite_vertex_handles()) {
    const Vertex v = {handle, {}};
    const Point_id id = At_time::id(v);
    if (points.smallest_name_at(v).id != id) continue;
    const std::vector<Point_id>& hidden = at().hidden_by(id);
    result[id] = area(rounded_corners(balls, v)) / static_cast<double>(1 + hidden.size());
    for (const Point_id twin : hidden) result[twin] = result[id];
  }
  return result;
}

// ---- distances and positions ----

Periodic_image Periodic_queries_2::nearest_neighbor(Point_id id) const {
  check_point(id);
  const Vertex v = at().vertex({id, {}});
  const detail::Nearest_points<Traits> points(at());
  return At_time::id(v) == id ? *points.nearest_to(v) : points.smallest_name_at(v);
}

std::vector<Periodic_image> Periodic_queries_2::nearest_neighbors() const {
  check_is_current();
  const auto& kinetic = at().kinetic();
  std::vector<Periodic_image> result(kinetic.next_id());
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) result[id] = nearest_neighbor(id);
  }
  return result;
}

std::vector<Periodic_image> Periodic_queries_2::nearest_neighbors(std::size_t k) const {
  check_is_current();
  KINETRI_PRECONDITION(k <= no_point, "k is " + std::to_string(k) + "; expected less than 2^32");
  return detail::Nearest_points<Traits>(at()).nearest_to_each(k);
}

std::optional<Periodic_edge> Periodic_queries_2::closest_pair() const {
  check_is_current();
  return detail::Nearest_points<Traits>(at()).closest_pair();
}

std::vector<double> Periodic_queries_2::rounded_positions(bool are_wrapped) const {
  check_is_current();
  const Balls balls(at());
  const auto& kinetic = at().kinetic();
  std::vector<double> result(2 * std::size_t{kinetic.next_id()},
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    Vertex v = at().vertex({id, {}});
    if (are_wrapped) {
      const auto box = detail::whole_vectors(at().predicates(), Moving_point_2(), at().point(v));
      v.offset = detail::sum(v.offset, detail::reversed(box));
    }
    const Vector_2 position = balls.rounded_position(v);
    result[2 * std::size_t{id}] = position.x;
    result[2 * std::size_t{id} + 1] = position.y;
  }
  return result;
}

}  // namespace kinetri
