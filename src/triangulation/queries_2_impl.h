// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2.
#ifndef KINETRI_SRC_TRIANGULATION_QUERIES_2_IMPL_H
#define KINETRI_SRC_TRIANGULATION_QUERIES_2_IMPL_H

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/nearest_points.h"
#include "triangulation/position_query.h"
#include "triangulation/voronoi_areas.h"
#include "triangulation/voronoi_ring.h"
#include "triangulation/voronoi_sides.h"

namespace kinetri {

template <KineticTraits_2 Traits>
Kinetic_queries_2<Traits>::Kinetic_queries_2(Queried kinetic, const Time& time)
    : at_(std::make_shared<const At_time>(std::move(kinetic), time)),
      changes_(number_of_changes()) {
  KINETRI_PRECONDITION(time >= at().kinetic().current_time(),
                       "a query about the past; query a time before the triangulation advances "
                       "beyond it");
  KINETRI_PRECONDITION(!at().kinetic().has_event_before(time),
                       "a query about a time after the next event; call advance_to for that time "
                       "first");
}

template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::time() const -> const Time& {
  return at().time();
}

// The triangle that hides a point changes without an event.
template <KineticTraits_2 Traits>
std::uint64_t Kinetic_queries_2<Traits>::number_of_changes() const {
  const Triangulation_counters& counters = at().kinetic().counters();
  return counters.number_of_events() + (at().is_weighted ? counters.instants : 0);
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
  return at().kinetic().vertex(id);
}

template <KineticTraits_2 Traits>
std::optional<Point_id> Kinetic_queries_2<Traits>::nearest_vertex(const Vector_2& place) const {
  check_is_current();
  const auto nearest = detail::Position_query<Traits>(at(), place).all_nearest();
  if (nearest.empty()) return std::nullopt;
  return at().id(*std::ranges::min_element(nearest, {}, at().id));
}

template <KineticTraits_2 Traits>
Location_2 Kinetic_queries_2<Traits>::locate(const Vector_2& place) const {
  check_is_current();
  return detail::Position_query<Traits>(at(), place).location();
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::neighbors(Point_id point) const {
  const Vertex_handle v = vertex(point);
  if (at().id(v) != point) return {at().id(v)};
  std::vector<Point_id> result = triangulation_neighbors(v);
  const std::vector<Point_id>& hidden = at().hidden_by(point);
  result.insert(result.end(), hidden.begin(), hidden.end());
  return result;
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::triangulation_neighbors(Vertex_handle v) const {
  std::vector<Point_id> result;
  if (at().kinetic().is_hidden(at().id(v))) return result;
  if (at().triangulation().dimension() < 2) {
    at().for_each_neighbor(v, [&](Vertex_handle u) { result.push_back(at().id(u)); });
    std::ranges::sort(result);
    return result;
  }
  // The infinite vertex has the id no_point.
  auto neighbor = at().triangulation().incident_vertices(v);
  const auto start = neighbor;
  do {
    result.push_back(at().id(neighbor));
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

// ---- Voronoi cells ----

template <KineticTraits_2 Traits>
Voronoi_cell_2<Exact_position_2> Kinetic_queries_2<Traits>::voronoi_cell(Point_id id) const {
  const Vertex_handle v = vertex(id);
  time().tight_interval();  // so that a binary64 number is known to be one
  KINETRI_PRECONDITION(time().is_known_rational(),
                       "at a time that is not known to be rational a Voronoi vertex has no exact "
                       "coordinates; call rounded_voronoi_cell");
  const Rational t = time().rational();
  const auto position = [&](const Trajectory_2& path) {
    const Rational w = path.w(t);
    return Exact_position_2{path.x(t) / w, path.y(t) / w};
  };
  return detail::Voronoi_sides<Traits>(at(), v).template cell<Exact_position_2>(
      [&](Vertex_handle a, Vertex_handle b) { return position(at().center(v, a, b)); }, position);
}

template <KineticTraits_2 Traits>
Voronoi_cell_2<Vector_2> Kinetic_queries_2<Traits>::rounded_voronoi_cell(Point_id id) const {
  const Vertex_handle v = vertex(id);
  const detail::Ball_positions<Traits> balls(at());
  if (!at().is_weighted && at().triangulation().dimension() == 2) {
    if (auto result = detail::Voronoi_ring<Traits>(balls, v).cell()) return *std::move(result);
  }
  const detail::Ball_2 here = balls.position(v);
  const auto center_at = [&](Vertex_handle u, Vertex_handle w) {
    if constexpr (WeightedKineticTraits_2<Traits>)
      return at().rounded_position(at().center(v, u, w));
    const auto a = balls.neighbor(here, u);
    const auto b = balls.neighbor(here, w);
    return balls.rounded_center(v, here, a, b, detail::circumcenter(a, b));
  };
  return detail::Voronoi_sides<Traits>(at(), v).template cell<Vector_2>(
      center_at, [&](const Trajectory_2& ray) { return at().rounded_position(ray); });
}

template <KineticTraits_2 Traits>
std::vector<double> Kinetic_queries_2<Traits>::rounded_voronoi_areas(
    std::span<const Vector_2> polygon) const {
  check_is_current();
  detail::check_polygon(polygon);
  return detail::Voronoi_areas<Traits>(at()).within(polygon);
}

// ---- distances and positions ----

template <KineticTraits_2 Traits>
std::optional<Point_id> Kinetic_queries_2<Traits>::nearest_neighbor(Point_id id) const requires
    HasNearestNeighbors<Traits> {
  const Vertex_handle v = vertex(id);
  const detail::Nearest_points<Traits> points(at());
  return at().id(v) == id ? points.nearest_to(v) : points.smallest_name_at(v);
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::nearest_neighbors() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  const detail::Nearest_points<Traits> points(at());
  std::vector<Point_id> result(at().kinetic().next_id(), no_point);
  for (const Vertex_handle v : at().triangulation().finite_vertex_handles()) {
    if (const auto nearest = points.nearest_to(v)) result[at().id(v)] = *nearest;
    const std::vector<Point_id>& hidden = at().hidden_by(at().id(v));
    if (hidden.empty()) continue;
    const Point_id least = points.smallest_name_at(v);
    for (const Point_id id : hidden) result[id] = least;
  }
  return result;
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::nearest_neighbors(std::size_t k) const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  KINETRI_PRECONDITION(k <= no_point, "k is " + std::to_string(k) + "; expected less than 2^32");
  return detail::Nearest_points<Traits>(at()).nearest_to_each(k);
}

template <KineticTraits_2 Traits>
std::optional<Edge_ids> Kinetic_queries_2<Traits>::closest_pair() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  return detail::Nearest_points<Traits>(at()).closest_pair();
}

template <KineticTraits_2 Traits>
std::vector<double> Kinetic_queries_2<Traits>::rounded_positions() const {
  check_is_current();
  const detail::Ball_positions<Traits> balls(at());
  const auto& kinetic = at().kinetic();
  std::vector<double> result(2 * std::size_t{kinetic.next_id()},
                             std::numeric_limits<double>::quiet_NaN());
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    const Vector_2 position = balls.rounded_position(kinetic.vertex(id));
    result[2 * std::size_t{id}] = position.x;
    result[2 * std::size_t{id} + 1] = position.y;
  }
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_TRIANGULATION_QUERIES_2_IMPL_H
