// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: areas of Voronoi cells within a polygon.
#ifndef KINETRI_TRIANGULATION_DETAIL_VORONOI_AREAS_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_VORONOI_AREAS_IMPL_H

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "kinetri/algebra/rounded_quotient.h"
#include "kinetri/triangulation/detail/clipped_polygon.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

// By id, each coordinate at least as well known as its rounded value is; zero where there is no
// point.
template <KineticTraits_2 Traits>
std::vector<detail::Ball_2> Kinetic_queries_2<Traits>::ball_places() const {
  const detail::Ball t = detail::ball_of(time_);
  std::vector<detail::Ball_2> result(kinetic_.next_id());
  const auto of_rounded = [](double x) { return detail::Ball(x, 0, 0x1p-53 * std::abs(x)); };
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    detail::Ball_2& place = result[id(v)];
    place = ball_place(v, t);
    if (is_known_well(place.x) && is_known_well(place.y)) continue;
    const Vector_2 rounded = rounded_position(v->point().trajectory());
    place = {of_rounded(rounded.x), of_rounded(rounded.y)};
  }
  return result;
}

// The vector from `v` to `u` times a power of two with which it is neither huge nor tiny.
// Precondition: the two do not coincide.
template <KineticTraits_2 Traits>
Vector_2 Kinetic_queries_2<Traits>::scaled_vector(Vertex_handle v, Vertex_handle u) const {
  const Trajectory_2 here = v->point().trajectory();
  const Trajectory_2 there = u->point().trajectory();
  Polynomial x = there.x * here.w - here.x * there.w;
  Polynomial y = there.y * here.w - here.y * there.w;
  Polynomial w = here.w * there.w;
  constexpr double huge = 0x1p500;
  const Integer factor = Integer(1) << 600;
  for (;;) {
    const Vector_2 vector = rounded_position({x, y, w});
    const double size = std::max(std::abs(vector.x), std::abs(vector.y));
    if (size >= 1 / huge && size <= huge) return vector;
    if (size > huge) {
      w = w * factor;
    } else {
      x = x * factor;
      y = y * factor;
    }
  }
}

// The positions as near to `v` as to `u`, or nearer, from the origin on; none if the two coincide.
// The same line for both.
template <KineticTraits_2 Traits>
std::optional<detail::Half_plane> Kinetic_queries_2<Traits>::nearer_half_plane(
    Vertex_handle v, Vertex_handle u, const std::vector<detail::Ball_2>& places,
    const Vector_2& origin) const {
  const detail::Ball_2& here = places[id(v)];
  const detail::Ball_2& there = places[id(u)];
  const detail::Ball_2 ball = there - here;
  Vector_2 vector = {ball.x.high, ball.y.high};
  const double size = std::max(std::abs(vector.x), std::abs(vector.y));
  const bool is_known = std::max(ball.x.radius, ball.y.radius) <= 0x1p-60 * size &&
                        size >= 0x1p-500 && size <= 0x1p500;
  if (!is_known) {
    if (coincide(v->point(), u->point())) return std::nullopt;
    vector = scaled_vector(v, u);
  }
  const double length = std::sqrt(vector.x * vector.x + vector.y * vector.y);
  const Vector_2 normal = {vector.x / length, vector.y / length};
  // Halves, so that no sum is too large.
  const Vector_2 middle = {
      here.x.high / 2 + there.x.high / 2 - origin.x + (here.x.low + there.x.low) / 2,
      here.y.high / 2 + there.y.high / 2 - origin.y + (here.y.low + there.y.low) / 2};
  return detail::Half_plane{normal, normal.x * middle.x + normal.y * middle.y};
}

// The cell of a point is the intersection of the half planes of its neighbors, or, where points
// coincide, of those of all points there.
template <KineticTraits_2 Traits>
std::vector<double> Kinetic_queries_2<Traits>::rounded_voronoi_areas(
    std::span<const Vector_2> polygon) const {
  check_is_current();
  detail::check_polygon(polygon);
  const Vector_2 origin = polygon.front();
  std::vector<Vector_2> region;
  for (const Vector_2& v : polygon) region.push_back({v.x - origin.x, v.y - origin.y});
  const std::vector<detail::Ball_2> places = ball_places();
  std::vector<double> result(kinetic_.next_id(), 0.0);
  detail::Clipped_polygon cell;
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    cell.assign(region);
    bool is_alone = true;
    const auto clip = [&](Vertex_handle u) {
      if (cell.is_empty()) return;
      if (const auto nearer = nearer_half_plane(v, u, places, origin)) {
        cell.clip(*nearer);
      } else {
        is_alone = false;
      }
    };
    for_each_neighbor(v, clip);
    if (!is_alone) {
      const std::vector<Point_id> there = all_at(v);
      if (there.front() != id(v)) continue;
      for (const Point_id other : there) for_each_neighbor(kinetic_.vertex(other), clip);
    }
    result[id(v)] = std::abs(cell.signed_area());
  }
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_VORONOI_AREAS_IMPL_H
