// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: areas of Voronoi cells within a polygon.
#ifndef KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_IMPL_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "kinetri/impl/algebra/rounded_quotient.h"
#include "kinetri/impl/triangulation/clipped_polygon.h"
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

// The vector from `v` to `u` times a power of two with which it is neither huge nor tiny, and the
// exponent of that. Precondition: the two do not coincide.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::scaled_vector(Vertex_handle v, Vertex_handle u) const
    -> Scaled_vector {
  const Trajectory_2 here = v->point().trajectory();
  const Trajectory_2 there = u->point().trajectory();
  Polynomial x = there.x * here.w - here.x * there.w;
  Polynomial y = there.y * here.w - here.y * there.w;
  Polynomial w = here.w * there.w;
  constexpr double huge = 0x1p500;
  constexpr int step = 600;
  const Integer factor = Integer(1) << step;
  for (int exponent = 0;;) {
    const Vector_2 vector = rounded_position({x, y, w});
    const double size = std::max(std::abs(vector.x), std::abs(vector.y));
    if (size >= 1 / huge && size <= huge) return {vector, exponent};
    if (size > huge) {
      w = w * factor;
      exponent -= step;
    } else {
      x = x * factor;
      y = y * factor;
      exponent += step;
    }
  }
}

// The weight of `v` minus that of `u`, correctly rounded or nearly so.
template <KineticTraits_2 Traits>
double Kinetic_queries_2<Traits>::weight_difference(Vertex_handle v, Vertex_handle u) const {
  if constexpr (is_weighted) {
    const detail::Ball t = detail::ball_of(time_);
    const detail::Ball known =
        detail::ball_weight(v->point().motion(), t) - detail::ball_weight(u->point().motion(), t);
    if (known.is_zero() || is_known_well(known)) return known.high;
    const Trajectory_2 here = v->point().trajectory();
    const Trajectory_2 there = u->point().trajectory();
    const Polynomial w = here.w * there.w;
    return rounded_quotient(here.weight * there.w * there.w - there.weight * here.w * here.w, w * w,
                            time_);
  }
  return 0;
}

// The positions as near to `v` as to `u`, or nearer, from the origin on; with weights, those with
// no more power. None if the two are alike. The same line for both.
template <KineticTraits_2 Traits>
std::optional<detail::Half_plane> Kinetic_queries_2<Traits>::nearer_half_plane(
    Vertex_handle v, Vertex_handle u, const std::vector<detail::Ball_2>& places,
    const Vector_2& origin) const {
  const detail::Ball_2& here = places[id(v)];
  const detail::Ball_2& there = places[id(u)];
  const detail::Ball_2 ball = there - here;
  Vector_2 vector = {ball.x.high, ball.y.high};
  int exponent = 0;  // of the power of two that the vector has been multiplied by
  const double size = std::max(std::abs(vector.x), std::abs(vector.y));
  const bool is_known = std::max(ball.x.radius, ball.y.radius) <= 0x1p-60 * size &&
                        size >= 0x1p-500 && size <= 0x1p500;
  if (!is_known) {
    if (coincide(v->point(), u->point())) {
      if (are_alike(v->point(), u->point())) return std::nullopt;
      constexpr double everywhere = std::numeric_limits<double>::infinity();
      return detail::Half_plane{{1, 0},
                                is_lighter(v->point(), u->point()) ? -everywhere : everywhere};
    }
    const Scaled_vector scaled = scaled_vector(v, u);
    vector = scaled.vector;
    exponent = scaled.exponent;
  }
  const double length = std::sqrt(vector.x * vector.x + vector.y * vector.y);
  const Vector_2 normal = {vector.x / length, vector.y / length};
  // Halves, so that no sum is too large.
  const Vector_2 middle = {
      here.x.high / 2 + there.x.high / 2 - origin.x + (here.x.low + there.x.low) / 2,
      here.y.high / 2 + there.y.high / 2 - origin.y + (here.y.low + there.y.low) / 2};
  const double beyond_middle = std::ldexp(weight_difference(v, u) / 2 / length, exponent);
  return detail::Half_plane{normal, normal.x * middle.x + normal.y * middle.y + beyond_middle};
}

// The cell of a point is the intersection of the half planes of its neighbors, or, where points are
// alike, of those of all points there. Where that has no area, the cell has none.
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
  std::vector<bool> is_done(kinetic_.next_id(), false);
  detail::Clipped_polygon cell;
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    if (is_done[id(v)]) continue;
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
    for_each_hidden_near(
        v, [&](Vertex_handle h) { is_alone = is_alone && !are_alike(h->point(), v->point()); });
    Point_id first = id(v);
    if (!is_alone) {
      for (const Point_id other : all_at(v)) {
        first = std::min(first, other);
        is_done[other] = true;
        if (!kinetic_.is_hidden(other)) for_each_neighbor(kinetic_.vertex(other), clip);
      }
    }
    result[first] = std::abs(cell.signed_area());
  }
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_IMPL_H
