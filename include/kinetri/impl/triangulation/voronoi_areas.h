// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of Voronoi cells within a polygon.
#ifndef KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_H
#define KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/ball_positions.h"
#include "kinetri/impl/triangulation/clipped_polygon.h"

namespace kinetri::detail {

/// Invariant: the error of each coordinate is at most that of its rounding; zero if there is no
/// point.
template <KineticTraits_2 Traits>
class Voronoi_areas {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Vertex_handle = typename At_time::Vertex_handle;

  /// The triangulation must outlive this object.
  explicit Voronoi_areas(const At_time& at)
      : at_(at), balls_(at), positions_(at.kinetic().next_id()) {
    const auto of_rounded = [](double x) { return Ball(x, 0, 0x1p-53 * std::abs(x)); };
    for (const Vertex_handle v : at_.triangulation().finite_vertex_handles()) {
      Ball_2& position = positions_[at_.id(v)];
      position = balls_.position(v);
      if (is_known_well(position.x) && is_known_well(position.y)) continue;
      const Vector_2 rounded = at_.rounded_position(v->point().trajectory());
      position = {of_rounded(rounded.x), of_rounded(rounded.y)};
    }
  }

  /// By id. Precondition: check_polygon(polygon).
  // The cell of a vertex is the intersection of the half planes of its neighbors or, if vertices
  // are alike, of the neighbors of all of them; the points of the first vertex share it.
  std::vector<double> within(std::span<const Vector_2> polygon) const {
    const Vector_2 origin = polygon.front();
    std::vector<Vector_2> region;
    for (const Vector_2& v : polygon) region.push_back({v.x - origin.x, v.y - origin.y});
    std::vector<double> result(positions_.size(), 0.0);
    std::vector<bool> is_done(positions_.size(), false);
    Clipped_polygon cell;
    for (const Vertex_handle v : at_.triangulation().finite_vertex_handles()) {
      if (is_done[at_.id(v)]) continue;
      cell.assign(region);
      bool is_alone = true;
      const auto clip = [&](Vertex_handle u) {
        if (cell.is_empty()) return;
        if (const auto nearer = nearer_half_plane(v, u, origin)) {
          cell.clip(*nearer);
        } else {
          is_alone = false;
        }
      };
      at_.for_each_neighbor(v, clip);
      at_.for_each_hidden_near(
          v, [&](Vertex_handle h) { is_alone = is_alone && !at_.are_alike(h, v); });
      Point_id first = at_.id(v);
      if (!is_alone) {
        for (const Point_id other : at_.all_at(v)) {
          first = std::min(first, other);
          is_done[other] = true;
          if (at_.kinetic().is_hidden(other)) continue;
          at_.for_each_neighbor(at_.kinetic().vertex(other), clip);
        }
      }
      const std::vector<Point_id>& hidden = at_.hidden_by(first);
      result[first] = std::abs(cell.signed_area()) / static_cast<double>(1 + hidden.size());
      for (const Point_id id : hidden) result[id] = result[first];
    }
    return result;
  }

 private:
  struct Scaled_vector {
    Vector_2 vector;
    int exponent = 0;
  };

  // The vector from `v` to `u`, scaled by a power of two so that it is neither huge nor tiny, and
  // the exponent. Precondition: the two do not coincide.
  Scaled_vector scaled_vector(Vertex_handle v, Vertex_handle u) const {
    Trajectory_2 d = At_time::vector(v, u);
    constexpr double huge = 0x1p500;
    constexpr int step = 600;
    const Integer factor = Integer(1) << step;
    for (int exponent = 0;;) {
      const Vector_2 vector = at_.rounded_position(d);
      const double size = std::max(std::abs(vector.x), std::abs(vector.y));
      if (size >= 1 / huge && size <= huge) return {vector, exponent};
      if (size > huge) {
        d.w = d.w * factor;
        exponent -= step;
      } else {
        d.x = d.x * factor;
        d.y = d.y * factor;
        exponent += step;
      }
    }
  }

  // The weight of `v` minus that of `u`, correctly rounded or nearly so.
  double weight_difference(Vertex_handle v, Vertex_handle u) const {
    if constexpr (At_time::is_weighted) {
      const Ball known = balls_.weight(v) - balls_.weight(u);
      if (known.is_zero() || is_known_well(known)) return known.high;
      const Trajectory_2 here = v->point().trajectory();
      const Trajectory_2 there = u->point().trajectory();
      const Polynomial w = here.w * there.w;
      return rounded_quotient(here.weight * there.w * there.w - there.weight * here.w * here.w,
                              w * w, at_.time());
    }
    return 0;
  }

  // The positions, relative to the origin, that are at least as near to `v` as to `u`; with
  // weights, that have at most as much power. None if the two are alike. Both points have the same
  // line.
  std::optional<Half_plane> nearer_half_plane(Vertex_handle v, Vertex_handle u,
                                              const Vector_2& origin) const {
    const Ball_2& here = positions_[at_.id(v)];
    const Ball_2& there = positions_[at_.id(u)];
    const Ball_2 ball = there - here;
    Vector_2 vector = {ball.x.high, ball.y.high};
    int exponent = 0;  // of the power of two in the vector
    const double size = std::max(std::abs(vector.x), std::abs(vector.y));
    const bool is_known = std::max(ball.x.radius, ball.y.radius) <= 0x1p-60 * size &&
                          size >= 0x1p-500 && size <= 0x1p500;
    if (!is_known) {
      if (at_.coincide(v, u)) {
        if (at_.are_alike(v, u)) return std::nullopt;
        constexpr double everywhere = std::numeric_limits<double>::infinity();
        return Half_plane{{1, 0}, at_.is_lighter(v, u) ? -everywhere : everywhere};
      }
      const Scaled_vector scaled = scaled_vector(v, u);
      vector = scaled.vector;
      exponent = scaled.exponent;
    }
    const double length = std::sqrt(vector.x * vector.x + vector.y * vector.y);
    const Vector_2 normal = {vector.x / length, vector.y / length};
    // Halves, so that sums do not overflow.
    const Vector_2 middle = {
        here.x.high / 2 + there.x.high / 2 - origin.x + (here.x.low + there.x.low) / 2,
        here.y.high / 2 + there.y.high / 2 - origin.y + (here.y.low + there.y.low) / 2};
    const double beyond_middle = std::ldexp(weight_difference(v, u) / 2 / length, exponent);
    return Half_plane{normal, normal.x * middle.x + normal.y * middle.y + beyond_middle};
  }

  const At_time& at_;
  Ball_positions<Traits> balls_;
  std::vector<Ball_2> positions_;  // by id
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_VORONOI_AREAS_H
