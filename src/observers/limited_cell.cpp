// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/limited_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "observers/polygon_and_disc.h"

namespace kinetri::detail {
namespace {

double dot(const Vector_2& v, const Vector_2& w) {
  return v.x * w.x + v.y * w.y;
}
double determinant(const Vector_2& v, const Vector_2& w) {
  return v.x * w.y - v.y * w.x;
}
double length(const Vector_2& v) {
  return std::sqrt(dot(v, v));
}
double largest(const Vector_2& v) {
  return std::max(std::abs(v.x), std::abs(v.y));
}
Vector_2 operator-(const Vector_2& v, const Vector_2& w) {
  return {v.x - w.x, v.y - w.y};
}
double beyond(const Half_plane& half_plane, const Vector_2& v) {
  return dot(half_plane.normal, v) - half_plane.bound;
}

double perimeter(std::span<const Vector_2> polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sum += length(polygon[i + 1 < polygon.size() ? i + 1 : 0] - polygon[i]);
  }
  return sum;
}

// The positions to the left of the line from `from` to `to`.
Half_plane to_the_left(const Vector_2& from, const Vector_2& to, const Vector_2& from_point,
                       const Vector_2& to_point) {
  const Vector_2 d = to - from;
  const double size = length(d);
  const Vector_2 normal = {d.y / size, -d.x / size};
  return {normal, dot(normal, largest(from_point) < largest(to_point) ? from_point : to_point)};
}

}  // namespace

Limited_cell::Limited_cell(const Cell_limits& limits, bool is_in_box) : limits_(limits) {
  limits.check(is_in_box);
  if (!limits.walkable) return;
  area_ = &limits.walkable->triangles();
  visited_.assign(area_->triangles().size(), 0);
}

Cell_area Limited_cell::measure(const Sides_of_cell& sides, const Ball_2& place,
                                const Exact_cell& exact) {
  place_ = place;
  result_ = {};
  ++number_;
  if (sides.is_empty) return result_;
  if (area_ != nullptr) {
    find_triangles_of_point(exact);
    if (open_.empty()) return result_;
  }
  if (!find_box()) return result_;
  cell_.assign(box_.corners());
  for (const Half_plane& half_plane : sides.half_planes) cell_.clip(half_plane);
  if (cell_.is_empty()) return result_;
  // A power cell need not contain its point.
  const bool has_point = std::ranges::all_of(
      sides.half_planes, [](const Half_plane& half_plane) { return half_plane.bound >= 0; });
  if (area_ == nullptr || (has_point && !is_wall_near(sides))) {
    add(cell_, sides, scale_);
  } else {
    add_connected(sides, has_point, exact);
  }
  return result_;
}

// Relative to the point.
Vector_2 Limited_cell::relative(const Vector_2& v) const {
  return {(v.x - place_.x.high) - place_.x.low, (v.y - place_.y.high) - place_.y.low};
}

// True on the line.
bool Limited_cell::is_left(const Vector_2& from, const Vector_2& to,
                           const Exact_cell& exact) const {
  const Vector_2 d = to - from;
  const Vector_2 v = relative(from);
  const double first = d.y * v.x;
  const double second = d.x * v.y;
  const double turn = first - second;
  const double error = 0x1p-49 * (std::abs(first) + std::abs(second)) +
                       2 * (std::abs(d.y) * place_.x.radius + std::abs(d.x) * place_.y.radius);
  if (std::abs(turn) > error && std::abs(turn) > 0x1p-900) return turn > 0;
  return exact.is_left(from, to);
}

// Finds the triangles that contain the point.
void Limited_cell::find_triangles_of_point(const Exact_cell& exact) {
  open_.clear();
  const auto reach = [](const Ball& x) {
    return 2 * x.radius + 0x1p-52 * std::abs(x.high) + std::numeric_limits<double>::min();
  };
  const Vector_2 margin = {reach(place_.x), reach(place_.y)};
  area_->for_each_triangle_near(
      {place_.x.high - margin.x, place_.y.high - margin.y, place_.x.high + margin.x,
       place_.y.high + margin.y},
      [&](std::size_t i) {
        const auto& [a, b, c] = area_->triangles()[i].corners;
        if (is_left(a, b, exact) && is_left(b, c, exact) && is_left(c, a, exact))
          open_.push_back(i);
      });
}

// Returns whether the box is not empty.
bool Limited_cell::find_box() {
  const double r = std::min(limits_.cutoff, reach_);
  box_ = {-r, -r, r, r};
  if (area_ != nullptr) {
    const Box_2& extent = area_->extent();
    const Vector_2 lower = relative({extent.xmin, extent.ymin});
    const Vector_2 upper = relative({extent.xmax, extent.ymax});
    box_ = {std::max(-r, lower.x), std::max(-r, lower.y), std::min(r, upper.x),
            std::min(r, upper.y)};
  }
  scale_ = std::max({-box_.xmin, -box_.ymin, box_.xmax, box_.ymax});
  return box_.xmin < box_.xmax && box_.ymin < box_.ymax;
}

// In the coordinates of the walls, slightly enlarged.
Box_2 Limited_cell::extent_of_cell() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box_2 box = {infinity, infinity, -infinity, -infinity};
  for (const Vector_2& v : cell_.vertices()) {
    box = {std::min(box.xmin, v.x), std::min(box.ymin, v.y), std::max(box.xmax, v.x),
           std::max(box.ymax, v.y)};
  }
  const double x = place_.x.high;
  const double y = place_.y.high;
  const double margin = 0x1p-45 * (scale_ + std::abs(x) + std::abs(y));
  return {x + box.xmin - margin, y + box.ymin - margin, x + box.xmax + margin,
          y + box.ymax + margin};
}

bool Limited_cell::is_wall_near(const Sides_of_cell& sides) const {
  return area_->is_any_wall_near(
      extent_of_cell(), [&](const Triangulated_area::Wall& wall) { return may_meet(wall, sides); });
}

// False only if the wall is certainly outside of the cell.
bool Limited_cell::may_meet(const Triangulated_area::Wall& wall, const Sides_of_cell& sides) const {
  const Vector_2 from = relative(wall[0]);
  const Vector_2 to = relative(wall[1]);
  const double margin =
      0x1p-40 * (std::max({scale_, largest(from), largest(to)}) + sides.displacement);
  for (const Half_plane& half_plane : sides.half_planes) {
    if (beyond(half_plane, from) > margin && beyond(half_plane, to) > margin) return false;
  }
  const Half_plane left = to_the_left(wall[0], wall[1], from, to);
  if (std::abs(left.bound) > limits_.cutoff + margin) return false;
  bool is_left_of_all = true;
  bool is_right_of_all = true;
  for (const Vector_2& v : cell_.vertices()) {
    const double distance = beyond(left, v);
    is_left_of_all = is_left_of_all && distance > margin;
    is_right_of_all = is_right_of_all && distance < -margin;
  }
  return !is_left_of_all && !is_right_of_all;
}

// The bound is derived in docs/MATH.md, section 13.
void Limited_cell::add(const Clipped_polygon& part, const Sides_of_cell& sides, double scale) {
  constexpr double u = 0x1p-53;
  if (part.is_empty()) return;
  const std::span<const Vector_2> polygon = part.vertices();
  const auto n = static_cast<double>(sides.half_planes.size() + 7);
  const double displacement =
      (80 + 18 * n) * u * scale + sides.displacement + place_.x.radius + place_.y.radius;
  result_.error += displacement * perimeter(polygon);
  const auto is_beyond = [&](const Vector_2& v) { return length(v) > limits_.cutoff; };
  if (std::ranges::any_of(polygon, is_beyond)) {
    result_.area += std::max(0.0, area_within_disc(polygon, limits_.cutoff));
    result_.error += 32 * u * limits_.cutoff * limits_.cutoff * static_cast<double>(polygon.size());
  } else {
    result_.area += std::max(0.0, part.signed_area());
  }
}

void Limited_cell::add_within(const Triangle& triangle, const Sides_of_cell& sides) {
  part_ = cell_;
  double scale = scale_;
  for (std::size_t i = 0; i < 3 && !part_.is_empty(); ++i) {
    const Vector_2& from = triangle.corners[i];
    const Vector_2& to = triangle.corners[(i + 1) % 3];
    const Vector_2 from_point = relative(from);
    scale = std::max(scale, largest(from_point));
    part_.clip(to_the_left(from, to, from_point, relative(to)));
  }
  add(part_, sides, scale);
}

bool Limited_cell::visit(std::size_t triangle) {
  return std::exchange(visited_[triangle], number_) != number_;
}

void Limited_cell::add_connected(const Sides_of_cell& sides, bool has_point,
                                 const Exact_cell& exact) {
  if (!has_point) {
    open_.clear();
    area_->for_each_triangle_near(extent_of_cell(), [&](std::size_t i) { open_.push_back(i); });
  }
  for (const std::size_t i : open_) visit(i);
  while (!open_.empty()) {
    const Triangle& triangle = area_->triangles()[open_.back()];
    open_.pop_back();
    add_within(triangle, sides);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = triangle.neighbors[i];
      if (next == Triangulated_area::wall || visited_[next] == number_) continue;
      if (!has_point ||
          !is_open(triangle.corners[(i + 1) % 3], triangle.corners[(i + 2) % 3], sides, exact)) {
        continue;
      }
      visit(next);
      open_.push_back(next);
    }
  }
}

// Whether the segment has a positive length in the cell and the disc.
bool Limited_cell::is_open(const Vector_2& from, const Vector_2& to, const Sides_of_cell& sides,
                           const Exact_cell& exact) const {
  const Vector_2 v = relative(from);
  const Vector_2 w = relative(to);
  const double margin =
      0x1p-44 * std::max({scale_, largest(v), largest(w)}) + 2 * sides.displacement;
  if (is_open(v, w, sides, margin)) return true;
  if (!is_open(v, w, sides, -margin)) return false;
  const std::optional<bool> decision = exact.is_open(from, to, limits_.cutoff);
  return decision ? *decision : is_open(v, w, sides, 0);
}

// The same of the cell and the disc without a margin at their boundaries.
bool Limited_cell::is_open(const Vector_2& from, const Vector_2& to, const Sides_of_cell& sides,
                           double margin) const {
  double begin = 0;
  double end = 1;
  for (const Half_plane& half_plane : sides.half_planes) {
    const double at_from = beyond(half_plane, from) + margin;
    const double at_to = beyond(half_plane, to) + margin;
    if (at_from >= 0 && at_to >= 0) return false;
    if (at_from > 0) begin = std::max(begin, at_from / (at_from - at_to));
    if (at_to > 0) end = std::min(end, at_from / (at_from - at_to));
  }
  if (std::isfinite(limits_.cutoff)) {
    const Vector_2 d = to - from;
    const double square = dot(d, d);
    const double nearest = -dot(from, d) / square;
    const double distance = determinant(from, d) / std::sqrt(square);
    const double r = limits_.cutoff - margin;
    if (std::abs(distance) >= r) return false;
    const double half_chord = std::sqrt((r - distance) * (r + distance) / square);
    begin = std::max(begin, nearest - half_chord);
    end = std::min(end, nearest + half_chord);
  }
  return begin < end;
}

}  // namespace kinetri::detail
