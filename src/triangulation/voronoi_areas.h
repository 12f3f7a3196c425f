// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of Voronoi cells within a polygon.
#ifndef KINETRI_SRC_TRIANGULATION_VORONOI_AREAS_H
#define KINETRI_SRC_TRIANGULATION_VORONOI_AREAS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "triangulation/ball_positions.h"
#include "triangulation/clipped_polygon.h"

namespace kinetri::detail {

/// Invariant: the error of each coordinate is at most that of its rounding; zero if there is no
/// point.
template <KineticTraits_2 Traits>
class Voronoi_areas {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Vertex_handle = typename At_time::Vertex;

  /// The triangulation must outlive this object.
  explicit Voronoi_areas(const At_time& at)
      : at_(at), balls_(at), positions_(at.kinetic().next_id()) {
    const auto of_rounded = [](double x) { return Ball(x, 0, 0x1p-53 * std::abs(x)); };
    for (const Vertex_handle v : at_.triangulation().finite_vertex_handles()) {
      Ball_2& position = positions_[at_.id(v)];
      position = balls_.position(v);
      if (!is_known_well(position.x) || !is_known_well(position.y)) {
        const Vector_2 rounded = at_.rounded_position(v->point().trajectory());
        position = {of_rounded(rounded.x), of_rounded(rounded.y)};
      }
      are_binary64_ = are_binary64_ && is_binary64(position.x) && is_binary64(position.y);
    }
  }

  /// By id. Precondition: check_polygon(polygon).
  std::vector<double> within(std::span<const Vector_2> polygon) const {
    const Vector_2 origin = polygon.front();
    std::vector<Vector_2> region;
    for (const Vector_2& v : polygon) region.push_back({v.x - origin.x, v.y - origin.y});
    std::vector<double> result(positions_.size(), 0.0);
    const std::vector<bool> is_inner = add_inner_cells(region, origin, result);
    std::vector<bool> is_done(positions_.size(), false);
    Clipped_polygon cell;
    for (const Vertex_handle v : at_.triangulation().finite_vertex_handles()) {
      Point_id first = at_.id(v);
      if (is_done[first]) continue;
      if (!is_inner[first]) {
        cell.assign(region);
        first = clip_to_cell(v, origin, cell, is_done);
        result[first] = std::abs(cell.signed_area());
      }
      const std::vector<Point_id>& hidden = at_.hidden_by(first);
      result[first] /= static_cast<double>(1 + hidden.size());
      for (const Point_id id : hidden) result[id] = result[first];
    }
    return result;
  }

 private:
  struct Scaled_vector {
    Vector_2 vector;
    int exponent = 0;
  };

  static bool is_binary64(const Ball& a) { return a.low == 0 && a.radius == 0; }

  // The vector from one point to another, off by at most some half a unit in the last place of its
  // larger coordinate. None if that is not certain, or it is zero, huge or tiny.
  KINETRI_ALWAYS_INLINE std::optional<Vector_2> known_vector(Point_id from, Point_id to) const {
    constexpr double huge = 0x1p400;
    const Ball_2& here = positions_[from];
    const Ball_2& there = positions_[to];
    Vector_2 vector = {there.x.high - here.x.high, there.y.high - here.y.high};
    double radius = 0;
    if (!are_binary64_) {
      const Ball_2 ball = there - here;
      vector = {ball.x.high, ball.y.high};
      radius = std::max(ball.x.radius, ball.y.radius);
    }
    const double size = std::max(std::abs(vector.x), std::abs(vector.y));
    if (!(radius <= 0x1p-60 * size && size >= 1 / huge && size <= huge)) return std::nullopt;
    return vector;
  }

  // Adds the areas of cells in the region, without clipping. Returns which cells these are; none
  // with weights, or if the region is not convex. Each triangle adds to the areas of its corners
  // the quadrilateral between a corner, the middles of its edges and the center of the circle,
  // which is negative if it turns over. docs/MATH.md, section 13, bounds the errors.
  std::vector<bool> add_inner_cells(std::span<const Vector_2> region, const Vector_2& origin,
                                    std::vector<double>& areas) const {
    const auto& triangulation = at_.triangulation();
    std::vector<bool> is_inner(areas.size(), false);
    const std::vector<Half_plane> sides = sides_of_convex(region);
    if (At_time::is_weighted || triangulation.dimension() < 2 || sides.empty()) return is_inner;
    for (const Vertex_handle v : triangulation.finite_vertex_handles()) is_inner[at_.id(v)] = true;
    at_.for_each_neighbor(triangulation.infinite_vertex(),
                          [&](Vertex_handle v) { is_inner[at_.id(v)] = false; });
    for (const auto face : triangulation.finite_face_handles()) {
      const std::array ids = {at_.id(face->vertex(0)), at_.id(face->vertex(1)),
                              at_.id(face->vertex(2))};
      const auto parts = parts_of_cells(ids, origin, sides);
      for (std::size_t i = 0; i < 3; ++i) {
        if (parts) {
          areas[ids[i]] += (*parts)[i];
        } else {
          is_inner[ids[i]] = false;
        }
      }
    }
    for (std::size_t id = 0; id < areas.size(); ++id) {
      areas[id] = is_inner[id] ? std::max(areas[id], 0.0) : 0.0;
    }
    return is_inner;
  }

  // Of a triangle the quadrilaterals at its corners. None if the center of its circle may be on the
  // outer side of a half plane, or the triangle is nearly flat.
  std::optional<std::array<double, 3>> parts_of_cells(const std::array<Point_id, 3>& ids,
                                                      const Vector_2& origin,
                                                      std::span<const Half_plane> sides) const {
    const auto a = known_vector(ids[1], ids[2]);
    const auto b = known_vector(ids[2], ids[0]);
    const auto c = known_vector(ids[0], ids[1]);
    if (!a || !b || !c) return std::nullopt;
    const double aa = dot(*a, *a);
    const double bb = dot(*b, *b);
    const double cc = dot(*c, *c);
    const double longest = std::max({aa, bb, cc});
    // Twice the area, by the two shorter edges.
    const double cross = longest == aa   ? determinant(*b, *c)
                         : longest == bb ? determinant(*c, *a)
                                         : determinant(*a, *b);
    constexpr double flattest = 0x1p20;
    const double flatness = longest / cross;
    if (!(flatness >= 0 && flatness <= flattest)) return std::nullopt;
    // Cotangents of the angles opposite to the edges.
    const double cot_a = -dot(*b, *c) / cross;
    const double cot_b = -dot(*c, *a) / cross;
    const double cot_c = -dot(*a, *b) / cross;
    const Ball_2& first = positions_[ids[0]];
    const Vector_2 center = {first.x.high - origin.x + (c->x - cot_c * c->y) / 2,
                             first.y.high - origin.y + (c->y + cot_c * c->x) / 2};
    // The first factors are at least as long as the longest side.
    const double error = (std::abs(b->x) + std::abs(b->y) + std::abs(c->x) + std::abs(c->y)) *
                         flatness * flatness * 0x1p-48;
    for (const auto& [normal, bound] : sides) {
      if (!(dot(normal, center) + error <= bound)) return std::nullopt;
    }
    const double at_a = aa * cot_a / 8;
    const double at_b = bb * cot_b / 8;
    const double at_c = cc * cot_c / 8;
    return std::array{at_b + at_c, at_c + at_a, at_a + at_b};
  }

  static double dot(const Vector_2& v, const Vector_2& w) { return v.x * w.x + v.y * w.y; }
  static double determinant(const Vector_2& v, const Vector_2& w) { return v.x * w.y - v.y * w.x; }

  // The half planes whose intersection is the polygon; empty if it is not convex.
  static std::vector<Half_plane> sides_of_convex(std::span<const Vector_2> polygon) {
    const std::size_t n = polygon.size();
    const auto edge = [&](std::size_t i) {
      const Vector_2& v = polygon[i % n];
      const Vector_2& w = polygon[(i + 1) % n];
      return Vector_2{w.x - v.x, w.y - v.y};
    };
    bool turns_left = false;
    bool turns_right = false;
    for (std::size_t i = 0; i < n; ++i) {
      const double turn = determinant(edge(i), edge(i + 1));
      turns_left = turns_left || turn > 0;
      turns_right = turns_right || turn < 0;
    }
    std::vector<Half_plane> result;
    if (turns_left == turns_right) return result;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [x, y] = edge(i);
      const double length = (turns_left ? 1 : -1) * std::sqrt(x * x + y * y);
      const Vector_2 outward = {y / length, -x / length};
      result.push_back({outward, dot(outward, polygon[i])});
    }
    return result;
  }

  // Clips the polygon to the cell of `v`: the intersection of the half planes of its neighbors or,
  // if vertices are alike, of the neighbors of all of them, which are then done. Returns the first
  // of these, which has the cell.
  Point_id clip_to_cell(Vertex_handle v, const Vector_2& origin, Clipped_polygon& cell,
                        std::vector<bool>& is_done) const {
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
    at_.for_each_hidden_near(v,
                             [&](Vertex_handle h) { is_alone = is_alone && !at_.are_alike(h, v); });
    Point_id first = at_.id(v);
    if (is_alone) return first;
    for (const Point_id other : at_.all_at(v)) {
      first = std::min(first, other);
      is_done[other] = true;
      if (at_.kinetic().is_hidden(other)) continue;
      at_.for_each_neighbor(at_.kinetic().vertex(other), clip);
    }
    return first;
  }

  // The vector from `v` to `u`, scaled by a power of two so that it is neither huge nor tiny, and
  // the exponent. Precondition: the two do not coincide.
  Scaled_vector scaled_vector(Vertex_handle v, Vertex_handle u) const {
    Trajectory_2 d = at_.vector(v, u);
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
  // weights, whose power to `v` is at most that to `u`. None if the two have the same position and
  // weight. The half planes of v and of u have the same boundary line.
  std::optional<Half_plane> nearer_half_plane(Vertex_handle v, Vertex_handle u,
                                              const Vector_2& origin) const {
    const Ball_2& here = positions_[at_.id(v)];
    const Ball_2& there = positions_[at_.id(u)];
    Scaled_vector known;
    if (const auto vector = known_vector(at_.id(v), at_.id(u))) {
      known.vector = *vector;
    } else if (!at_.coincide(v, u)) {
      known = scaled_vector(v, u);
    } else {
      if (at_.are_alike(v, u)) return std::nullopt;
      constexpr double everywhere = std::numeric_limits<double>::infinity();
      return Half_plane{{1, 0}, at_.is_lighter(v, u) ? -everywhere : everywhere};
    }
    const auto& [vector, exponent] = known;
    const double length = std::sqrt(dot(vector, vector));
    const Vector_2 normal = {vector.x / length, vector.y / length};
    // Halves, so that sums do not overflow.
    const Vector_2 middle = {
        here.x.high / 2 + there.x.high / 2 - origin.x + (here.x.low + there.x.low) / 2,
        here.y.high / 2 + there.y.high / 2 - origin.y + (here.y.low + there.y.low) / 2};
    const double beyond_middle = std::ldexp(weight_difference(v, u) / 2 / length, exponent);
    return Half_plane{normal, dot(normal, middle) + beyond_middle};
  }

  const At_time& at_;
  Ball_positions<Traits> balls_;
  std::vector<Ball_2> positions_;  // by id
  bool are_binary64_ = true;       // all positions
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_VORONOI_AREAS_H
