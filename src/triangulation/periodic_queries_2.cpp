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

template <class Traits>
using At_time_of = detail::Triangulation_at_time<Traits>;
template <class Traits>
using Vertex_of = typename At_time_of<Traits>::Vertex;

// The vectors from a vertex to the corners of its cell, rounded to nearest, counterclockwise; of a
// power cell from the first corner.
template <class Traits>
std::vector<Vector_2> rounded_corners(const detail::Ball_positions<Traits>& balls,
                                      const Vertex_of<Traits>& v) {
  using At_time = At_time_of<Traits>;
  using Vertex = typename At_time::Vertex;
  using Neighbor = typename detail::Ball_positions<Traits>::Neighbor;
  const At_time& at = balls.at();
  if constexpr (At_time::is_weighted) {
    auto result =
        detail::Voronoi_sides<Traits>(at, v).corners([&](const Vertex& a, const Vertex& b) {
          return at.rounded_position(At_time::vector(at.point(v).trajectory(), at.center(v, a, b)));
        });
    if (result.empty()) return result;
    const Vector_2 first = result.front();
    for (Vector_2& corner : result) corner = {corner.x - first.x, corner.y - first.y};
    return result;
  }
  const auto here = balls.position(v);
  const auto rounded_corner = [&](const Neighbor& a, const Neighbor& b,
                                  const std::optional<detail::Ball_2>& center) {
    if (center) {
      if (const auto known = detail::rounded(*center)) return *known;
    }
    return at.rounded_position(
        At_time::vector(at.point(v).trajectory(), at.center(v, a.vertex, b.vertex)));
  };
  // If all triangles certainly turn left, the corners are the centers of their circles, some of
  // which may be equal.
  std::vector<Neighbor> ring;
  at.for_each_neighbor(v, [&](const Vertex& u) { ring.push_back(balls.neighbor(here, u)); });
  std::vector<Vector_2> result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Neighbor& next = ring[i + 1 < ring.size() ? i + 1 : 0];
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

template <class Position, class Traits, class Center>
Periodic_voronoi_cell_2<Position> cell(const At_time_of<Traits>& at, const Vertex_of<Traits>& v,
                                       Center center_at) {
  const detail::Voronoi_sides<Traits> sides(at, v);
  Periodic_voronoi_cell_2<Position> result;
  for (const auto& u : sides.across()) result.neighbors.push_back(at.name(u));
  result.vertices = sides.corners(center_at);
  result.is_empty = sides.is_empty();
  return result;
}

// The image nearest to a point.
template <class Traits>
Periodic_image nearest_image(const At_time_of<Traits>& at,
                             const detail::Nearest_points<Traits>& points, Point_id id) {
  const auto v = at.vertex({id, {}});
  return at.id(v) == id ? *points.nearest_to(v) : points.smallest_name_at(v);
}

}  // namespace

template <PeriodicKineticTraits_2 Traits>
Periodic_queries_2<Traits>::Periodic_queries_2(const Triangulation& triangulation,
                                               const Time& time) {
  KINETRI_PRECONDITION(time >= triangulation.current_time(),
                       "a query about the past; query a time before the triangulation advances "
                       "beyond it");
  triangulation.traits().box().require_area(triangulation.current_time(), time);
  KINETRI_PRECONDITION(!triangulation.has_event_before(time),
                       "a query about a time after the next event; call advance_to for that time "
                       "first");
  at_ = std::make_shared<const At_time>(
      std::make_unique<detail::Queried<Traits, Traits>>(triangulation), time);
  changes_ = number_of_changes();
}

template <PeriodicKineticTraits_2 Traits>
auto Periodic_queries_2<Traits>::time() const -> const Time& {
  return at().time();
}

// The triangle that hides a point changes without an event.
template <PeriodicKineticTraits_2 Traits>
std::uint64_t Periodic_queries_2<Traits>::number_of_changes() const {
  const Triangulation_counters& counters = at().kinetic().counters();
  return counters.number_of_events() + (At_time::is_weighted ? counters.instants : 0);
}

template <PeriodicKineticTraits_2 Traits>
void Periodic_queries_2<Traits>::check_is_current() const {
  KINETRI_PRECONDITION(number_of_changes() == changes_,
                       "the triangulation has changed since these queries were made; make new ones "
                       "after an event");
}

// The check of Kinetic_triangulation_2.
template <PeriodicKineticTraits_2 Traits>
void Periodic_queries_2<Traits>::check_point(Point_id id) const {
  check_is_current();
  at().kinetic().vertex(id);
}

template <PeriodicKineticTraits_2 Traits>
std::optional<Periodic_image> Periodic_queries_2<Traits>::nearest_vertex(
    const Vector_2& place) const {
  check_is_current();
  const auto nearest = detail::Position_query<Traits>(at(), place).all_nearest();
  if (nearest.empty()) return std::nullopt;
  return At_time::name(*std::ranges::min_element(nearest, {}, At_time::name));
}

template <PeriodicKineticTraits_2 Traits>
Periodic_location_2 Periodic_queries_2<Traits>::locate(const Vector_2& place) const {
  check_is_current();
  return detail::Position_query<Traits>(at(), place).location();
}

template <PeriodicKineticTraits_2 Traits>
std::vector<Periodic_image> Periodic_queries_2<Traits>::neighbors(Point_id id) const {
  check_point(id);
  const auto v = at().vertex({id, {}});
  if (At_time::id(v) != id) return {At_time::name(v)};
  std::vector<Periodic_image> result;
  if (at().is_hidden(v)) return at().names_hidden_by(v);
  at().for_each_neighbor(v, [&](const auto& u) { result.push_back(At_time::name(u)); });
  std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  const std::vector<Periodic_image> hidden = at().names_hidden_by(v);
  result.insert(result.end(), hidden.begin(), hidden.end());
  return result;
}

// ---- Voronoi cells ----

template <PeriodicKineticTraits_2 Traits>
Periodic_voronoi_cell_2<Exact_position_2> Periodic_queries_2<Traits>::voronoi_cell(
    Point_id id) const {
  check_point(id);
  time().tight_interval();  // so that a binary64 number is known to be one
  KINETRI_PRECONDITION(time().is_known_rational(),
                       "at a time that is not known to be rational a Voronoi vertex has no exact "
                       "coordinates; call rounded_voronoi_cell");
  const Rational t = time().rational();
  const auto v = at().vertex({id, {}});
  return cell<Exact_position_2, Traits>(at(), v, [&](const auto& a, const auto& b) {
    const Trajectory_2 path = at().center(v, a, b);
    const Rational w = path.w(t);
    return Exact_position_2{path.x(t) / w, path.y(t) / w};
  });
}

template <PeriodicKineticTraits_2 Traits>
Periodic_voronoi_cell_2<Vector_2> Periodic_queries_2<Traits>::rounded_voronoi_cell(
    Point_id id) const {
  check_point(id);
  const auto v = at().vertex({id, {}});
  const detail::Ball_positions<Traits> balls(at());
  const auto here = balls.position(v);
  return cell<Vector_2, Traits>(at(), v, [&](const auto& u, const auto& w) {
    if constexpr (At_time::is_weighted) return at().rounded_position(at().center(v, u, w));
    const auto a = balls.neighbor(here, u);
    const auto b = balls.neighbor(here, w);
    return balls.rounded_center(v, here, a, b, detail::circumcenter(a, b));
  });
}

template <PeriodicKineticTraits_2 Traits>
std::vector<double> Periodic_queries_2<Traits>::rounded_voronoi_areas() const {
  check_is_current();
  const detail::Ball_positions<Traits> balls(at());
  const detail::Nearest_points<Traits> points(at());
  std::vector<double> result(at().kinetic().next_id(), 0.0);
  std::vector<bool> is_done(result.size(), false);
  for (const auto handle : at().triangulation().finite_vertex_handles()) {
    const typename At_time::Vertex v = {handle, {}};
    // With weights it may be hidden by a triangle.
    const Point_id id = points.smallest_name_at(v).id;
    if (is_done[id]) continue;
    is_done[id] = true;
    const std::vector<Point_id>& hidden = at().hidden_by(id);
    result[id] = area(rounded_corners(balls, v)) / static_cast<double>(1 + hidden.size());
    for (const Point_id twin : hidden) result[twin] = result[id];
  }
  return result;
}

// ---- distances and positions ----

template <PeriodicKineticTraits_2 Traits>
Periodic_image Periodic_queries_2<Traits>::nearest_neighbor(Point_id id) const requires
    HasNearestNeighbors<Traits> {
  check_point(id);
  return nearest_image(at(), detail::Nearest_points<Traits>(at()), id);
}

template <PeriodicKineticTraits_2 Traits>
std::vector<Periodic_image> Periodic_queries_2<Traits>::nearest_neighbors() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  const auto& kinetic = at().kinetic();
  const detail::Nearest_points<Traits> points(at());
  std::vector<Periodic_image> result(kinetic.next_id());
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) result[id] = nearest_image(at(), points, id);
  }
  return result;
}

template <PeriodicKineticTraits_2 Traits>
std::vector<Periodic_image> Periodic_queries_2<Traits>::nearest_neighbors(
    std::size_t k) const requires HasNearestNeighbors<Traits> {
  check_is_current();
  KINETRI_PRECONDITION(k <= no_point, "k is " + std::to_string(k) + "; expected less than 2^32");
  return detail::Nearest_points<Traits>(at()).nearest_to_each(k);
}

template <PeriodicKineticTraits_2 Traits>
std::optional<Periodic_edge> Periodic_queries_2<Traits>::closest_pair() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  return detail::Nearest_points<Traits>(at()).closest_pair();
}

template <PeriodicKineticTraits_2 Traits>
std::vector<double> Periodic_queries_2<Traits>::rounded_positions(bool are_wrapped) const {
  check_is_current();
  const detail::Ball_positions<Traits> balls(at());
  const auto& kinetic = at().kinetic();
  std::vector<double> result(2 * std::size_t{kinetic.next_id()},
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    auto v = at().vertex({id, {}});
    if (are_wrapped) {
      const auto box =
          detail::whole_vectors(at().predicates(), typename At_time::Point_2(), at().point(v));
      v.offset = detail::sum(v.offset, detail::reversed(box));
    }
    const Vector_2 position = balls.rounded_position(v);
    result[2 * std::size_t{id}] = position.x;
    result[2 * std::size_t{id} + 1] = position.y;
  }
  return result;
}

template class Periodic_queries_2<Periodic_kinetic_traits_2>;
template class Periodic_queries_2<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri
