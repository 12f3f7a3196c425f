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

#include "kinetri/kinetic/rounded_places.h"
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

// The indices at which origin + index * step may be in [lower, upper]. May name more; never fewer:
// the computed index is off by the roundings of the quotient and of the places.
inline Index_range indices_between(double lower, double upper, double origin, double step,
                                   std::size_t count) {
  double from = (lower - origin) / step;
  double to = (upper - origin) / step;
  if (from > to) std::swap(from, to);
  const double size = std::abs(origin) + std::max(std::abs(lower), std::abs(upper));
  const double slack = 1 + 0x1p-48 * (size / std::abs(step) + static_cast<double>(count));
  const double n = static_cast<double>(count);
  const double first = std::clamp(std::floor(from - slack), 0.0, n);
  const double last = std::clamp(std::floor(to + slack) + 1, 0.0, n);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

// The positions of a grid, and the triangle of each.
template <class Traits>
class Raster {
 public:
  using Face_handle = typename Present<Traits>::Face_handle;

  // Keeps a reference to `present`, in which all places are rounded.
  Raster(const Present<Traits>& present, const Grid_2& grid)
      : present_(present), grid_(grid), triangle_(grid.rows * grid.columns, no_triangle) {
    if (present_.topology().dimension() < 2) return;
    std::vector<std::pair<std::array<Point_id, 3>, Face_handle>> in_order;
    for (const Face_handle face : present_.topology().finite_face_handles()) {
      in_order.emplace_back(Present<Traits>::ids(face), face);
    }
    std::ranges::sort(
        in_order, {}, [](const auto& entry) -> const auto& { return entry.first; });
    for (const auto& entry : in_order) faces_.push_back(entry.second);
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      if (present_.has_area(faces_[i])) fill(i);
    }
  }

  // Calls function(position, place, triangle) for each position that has a triangle; positions are
  // numbered row by row.
  template <class Function>
  void for_each_triangle(Function function) const {
    for_each_found([&](std::size_t position, const Vector_2& place, std::uint32_t index) {
      function(position, place, faces_[index]);
    });
  }

  // Calls function(position, weights) for each position that has a triangle; its corners begin with
  // the least id.
  template <class Function>
  void for_each_corner_weights(Function function) const {
    std::uint32_t known = no_triangle;
    Corner_weights result;
    std::array<Vector_2, 3> places;
    for_each_found([&](std::size_t position, const Vector_2& place, std::uint32_t index) {
      if (index != known) {
        known = index;
        const Face_handle face = faces_[index];
        const int first = index_of_least(face);
        for (int i = 0; i < 3; ++i) {
          const auto corner = face->vertex((first + i) % 3);
          result.corners[static_cast<std::size_t>(i)] = Present<Traits>::id(corner);
          places[static_cast<std::size_t>(i)] = present_.place(corner);
        }
      }
      result.weights = barycentric_weights(places, place);
      function(position, result);
    });
  }

 private:
  // The order of corners within faces must not matter.
  static int index_of_least(Face_handle face) {
    int result = 0;
    for (int i = 1; i < 3; ++i) {
      if (Present<Traits>::id(face->vertex(i)) < Present<Traits>::id(face->vertex(result))) {
        result = i;
      }
    }
    return result;
  }

  template <class Function>
  void for_each_found(Function function) const {
    std::size_t position = 0;
    for (std::size_t row = 0; row < grid_.rows; ++row) {
      for (std::size_t column = 0; column < grid_.columns; ++column, ++position) {
        const std::uint32_t index = triangle_[position];
        if (index != no_triangle) function(position, grid_.place(column, row), index);
      }
    }
  }

  // The triangles come in ascending order of ids, so that the first one that contains a position
  // is the position's.
  void fill(std::uint32_t index) {
    const Face_handle face = faces_[index];
    const std::array<Vector_2, 3> p = {present_.place(face->vertex(0)),
                                       present_.place(face->vertex(1)),
                                       present_.place(face->vertex(2))};
    const double e = present_.error();
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const Index_range rows =
        indices_between(low - 2 * e, high + 2 * e, grid_.origin.y, grid_.step.y, grid_.rows);
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      // Those in the triangle follow one another: the positions of a row are on one line, in the
      // order of the columns, rounded as they are.
      Index_range columns = columns_in(p, grid_.place(0, row).y);
      const auto is_in = [&](std::size_t column) {
        return present_.contains(face, grid_.place(column, row));
      };
      while (columns.first < columns.last && !is_in(columns.first)) ++columns.first;
      while (columns.first < columns.last && !is_in(columns.last - 1)) --columns.last;
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        std::uint32_t& found = triangle_[row * grid_.columns + column];
        if (found == no_triangle) found = index;
      }
    }
  }

  // The columns that may be in the triangle with rounded corners p, at height y. An edge pq meets
  // it at p + s (q - p), and s is off by at most 8 e / |q.y - p.y| where each coordinate and
  // difference is off by at most e: by six roundings and errors of that size.
  Index_range columns_in(const std::array<Vector_2, 3>& p, double y) const {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector_2& a = p[i];
      const Vector_2& b = p[(i + 1) % 3];
      const double size = std::max(std::max(size_of(a), size_of(b)), std::abs(y));
      const double e = present_.error() + 0x1p-50 * size;
      if (y < std::min(a.y, b.y) - e || y > std::max(a.y, b.y) + e) continue;
      const double height = std::abs(b.y - a.y);
      if (height <= 8 * e) {
        left = std::min(left, std::min(a.x, b.x) - 4 * e);
        right = std::max(right, std::max(a.x, b.x) + 4 * e);
      } else {
        const double width = b.x - a.x;
        const double x = a.x + (y - a.y) / (b.y - a.y) * width;
        const double slack = std::abs(width) * (8 * e / height) + 4 * e;
        left = std::min(left, x - slack);
        right = std::max(right, x + slack);
      }
    }
    if (left > right) return {};
    return indices_between(left, right, grid_.origin.x, grid_.step.x, grid_.columns);
  }

  const Present<Traits>& present_;
  const Grid_2& grid_;
  std::vector<Face_handle> faces_;
  std::vector<std::uint32_t> triangle_;  // by position; an index of faces_
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_FIELD_RASTER_H
