// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of a grid, and the triangle of each.
#ifndef KINETRI_SRC_TRIANGULATION_FIELD_RASTER_H
#define KINETRI_SRC_TRIANGULATION_FIELD_RASTER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "kinetic/rounded_places.h"
#include "kinetri/triangulation/field_2.h"
#include "triangulation/field_present.h"
#include "triangulation/field_weights.h"

namespace kinetri::detail {

inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

// Indices from `first` up to, not including, `last`.
struct Index_range {
  std::size_t first = 0;
  std::size_t last = 0;
};

// The indices whose positions on an axis may be in an interval, and those that certainly are.
struct Indices_between {
  Index_range possible;
  Index_range certain;
};

// Positions on an axis: origin + index * step for indices below `count`, rounded as by
// Grid_2::place.
class Grid_axis {
 public:
  Grid_axis(double origin, double step, std::size_t count)
      : origin_(origin), step_(step), count_(count) {}

  // The indices whose positions may be in [lower, upper], and those whose positions are certainly
  // in [inner_lower, inner_upper]. The error of a computed index, from rounding the quotient and
  // the positions, is less than 2^-51 (size / |step| + count).
  Indices_between between(double lower, double upper, double inner_lower,
                          double inner_upper) const {
    const double size = std::abs(origin_) + std::max(std::abs(lower), std::abs(upper));
    const double slack = 0x1p-48 * (size / std::abs(step_) + static_cast<double>(count_));
    // Otherwise indices say nothing, or a difference could be infinite minus infinite.
    if (!(slack < 1)) return {{0, count_}, {}};
    return {range(lower, upper, slack), range(inner_lower, inner_upper, -slack)};
  }

 private:
  Index_range range(double lower, double upper, double slack) const {
    double from = (lower - origin_) / step_;
    double to = (upper - origin_) / step_;
    if (step_ < 0) std::swap(from, to);
    from = std::max(from - slack, 0.0);
    to = std::min(to + slack, static_cast<double>(count_) - 1);
    if (!(from <= to)) return {};
    // Both are in [0, count - 1], so truncation rounds down.
    const auto first = static_cast<std::int64_t>(from);
    const bool is_whole = static_cast<double>(first) == from;
    return {static_cast<std::size_t>(is_whole ? first : first + 1),
            static_cast<std::size_t>(static_cast<std::int64_t>(to)) + 1};
  }

  double origin_;
  double step_;
  std::size_t count_;
};

// The positions of a grid, and the triangle of each.
template <class Traits>
class Raster {
 public:
  using Face_handle = typename Present<Traits>::Face_handle;

  // Keeps references to both. Precondition: present.round_all() was called.
  Raster(const Present<Traits>& present, const Grid_2& grid)
      : present_(present),
        grid_(grid),
        columns_(grid.origin.x, grid.step.x, grid.columns),
        rows_(grid.origin.y, grid.step.y, grid.rows),
        triangle_(grid.rows * grid.columns, no_triangle) {
    if (present_.topology().dimension() < 2) return;
    for (const Face_handle face : present_.topology().finite_face_handles()) {
      if (!present_.has_area(face)) continue;
      faces_.push_back(face);
      fill(static_cast<std::uint32_t>(faces_.size() - 1));
    }
  }

  // Calls function(triangle, row, columns) for each run of columns of a row that are in one
  // triangle, from left to right.
  template <class Function>
  void for_each_run(Function function) const {
    for (std::size_t row = 0; row < grid_.rows; ++row) {
      const std::uint32_t* const triangles = &triangle_[row * grid_.columns];
      for (std::size_t first = 0, last = 0; first < grid_.columns; first = last) {
        while (last < grid_.columns && triangles[last] == triangles[first]) ++last;
        if (triangles[first] != no_triangle) {
          function(faces_[triangles[first]], row, Index_range{first, last});
        }
      }
    }
  }

  // Calls function(position, place, triangle) for each position that has a triangle; positions are
  // numbered row by row.
  template <class Function>
  void for_each_triangle(Function function) const {
    for_each_run([&](Face_handle face, std::size_t row, const Index_range& columns) {
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        function(row * grid_.columns + column, grid_.place(column, row), face);
      }
    });
  }

  // For each such run, calls on_triangle(corners), the least id first, and then function(position,
  // weights) for its positions.
  template <class On_triangle, class Function>
  void for_each_corner_weights(On_triangle on_triangle, Function function) const {
    for_each_run([&](Face_handle face, std::size_t row, const Index_range& columns) {
      std::array<Point_id, 3> corners;
      std::array<Vector_2, 3> places;
      const int first = index_of_least(face);
      for (int i = 0; i < 3; ++i) {
        const auto corner = face->vertex((first + i) % 3);
        corners[static_cast<std::size_t>(i)] = Present<Traits>::id(corner);
        places[static_cast<std::size_t>(i)] = present_.place(corner);
      }
      on_triangle(corners);
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        function(row * grid_.columns + column,
                 barycentric_weights(places, grid_.place(column, row)));
      }
    });
  }

 private:
  // The result must not depend on the order of corners in a face.
  static int index_of_least(Face_handle face) {
    int result = 0;
    for (int i = 1; i < 3; ++i) {
      if (Present<Traits>::id(face->vertex(i)) < Present<Traits>::id(face->vertex(result))) {
        result = i;
      }
    }
    return result;
  }

  // A side of a triangle, to be intersected with rows.
  struct Side {
    Vector_2 begin;
    double low = 0;  // the least and greatest y of its ends
    double high = 0;
    double slope = 0;  // dx / dy
    double slack = 0;  // of x at a row
    bool is_flat = false;
    double left = 0;  // the ends of a flat one
    double right = 0;
  };

  // Marks the positions in the triangle. A position on the boundary of several belongs to the
  // triangle with the least ids.
  void fill(std::uint32_t index) {
    const Face_handle face = faces_[index];
    const std::array<Vector_2, 3> p = {present_.place(face->vertex(0)),
                                       present_.place(face->vertex(1)),
                                       present_.place(face->vertex(2))};
    // The error of each coordinate and difference.
    const double e =
        present_.error() + 0x1p-50 * std::max({size_of(p[0]), size_of(p[1]), size_of(p[2])});
    const std::array<Side, 3> sides = {side(p[0], p[1], e), side(p[1], p[2], e),
                                       side(p[2], p[0], e)};
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const Index_range rows = rows_.between(low - 2 * e, high + 2 * e, low, high).possible;
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      // The positions in the triangle are consecutive: even rounded, those of a row are on one line
      // in the order of the columns.
      auto [columns, certain] = columns_in(sides, grid_.place(0, row).y, e);
      const auto is_in = [&, certain = certain](std::size_t column) {
        return (column >= certain.first && column < certain.last) ||
               present_.contains(face, grid_.place(column, row));
      };
      while (columns.first < columns.last && !is_in(columns.first)) ++columns.first;
      while (columns.first < columns.last && !is_in(columns.last - 1)) --columns.last;
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        std::uint32_t& found = triangle_[row * grid_.columns + column];
        if (found == no_triangle ||
            Present<Traits>::ids(face) < Present<Traits>::ids(faces_[found])) {
          found = index;
        }
      }
    }
  }

  // A side ab meets height y at x = a.x + (y - a.y) (b.x - a.x) / (b.y - a.y). If each coordinate
  // and difference is off by at most e, and the quotient of differences is at most 1.25, x is off
  // by at most 4 e |b.x - a.x| / |b.y - a.y| + 4 e, roundings included; the slack is twice the
  // first.
  static Side side(const Vector_2& a, const Vector_2& b, double e) {
    const double height = std::abs(b.y - a.y);
    const double width = std::abs(b.x - a.x);
    if (height <= 8 * e) {
      return {a,    std::min(a.y, b.y),         std::max(a.y, b.y),        0, 0,
              true, std::min(a.x, b.x) - 4 * e, std::max(a.x, b.x) + 4 * e};
    }
    return {a,
            std::min(a.y, b.y),
            std::max(a.y, b.y),
            (b.x - a.x) / (b.y - a.y),
            width * (8 * e / height) + 4 * e,
            false,
            0,
            0};
  }

  // The columns that may be in the triangle at height y, and those that certainly are, if the row
  // certainly crosses two sides and no corner.
  Indices_between columns_in(const std::array<Side, 3>& sides, double y, double e) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    double left = infinite;
    double right = -infinite;
    double inner_left = infinite;
    double inner_right = -infinite;
    bool is_certain = true;
    for (const Side& s : sides) {
      if (y < s.low - e || y > s.high + e) continue;
      if (s.is_flat) {
        is_certain = false;
        left = std::min(left, s.left);
        right = std::max(right, s.right);
        continue;
      }
      if (y < s.low + e || y > s.high - e) is_certain = false;
      const double x = s.begin.x + (y - s.begin.y) * s.slope;
      left = std::min(left, x - s.slack);
      right = std::max(right, x + s.slack);
      inner_left = std::min(inner_left, x + s.slack);
      inner_right = std::max(inner_right, x - s.slack);
    }
    if (left > right) return {};
    if (!is_certain) return columns_.between(left, right, infinite, -infinite);
    return columns_.between(left, right, inner_left, inner_right);
  }

  const Present<Traits>& present_;
  const Grid_2& grid_;
  Grid_axis columns_;
  Grid_axis rows_;
  std::vector<Face_handle> faces_;
  std::vector<std::uint32_t> triangle_;  // by position; an index of faces_
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_FIELD_RASTER_H
