// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area in which points can be: a polygon with holes, or several.
#ifndef KINETRI_OBSERVERS_WALKABLE_AREA_H
#define KINETRI_OBSERVERS_WALKABLE_AREA_H

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "kinetri/simulation/box_2.h"

namespace kinetri {

namespace detail {

class Triangulated_area;

}  // namespace detail

/// A closed region of the plane with straight walls: polygons with holes, whose interiors are
/// disjoint. Rings may touch each other, and themselves, in single positions. A cheap value: copies
/// share what they hold, and several threads may use them at once.
class Walkable_area {
 public:
  /// Reads a POLYGON, a MULTIPOLYGON, or a GEOMETRYCOLLECTION of these, or of such collections, as
  /// Well-Known Text (OpenGIS Simple Features Access, part 1, section 7) of two coordinates. A ring
  /// ends with the position with which it begins, and may go in either direction; a position that
  /// is repeated at once counts once.
  ///
  /// Throws Input_error, with `name` for the file, the line, and the column or the number of the
  /// polygon and the ring, if the text is something else or goes on after the end; if a coordinate
  /// is not finite or beyond 1e150; if a ring has fewer than three positions, or is not closed; if
  /// edges cross each other or share more than a position; or if, all rings taken together, a hole
  /// is outside of the polygons, or polygons or holes overlap. All of that is decided exactly.
  /// Cost: O(m log m) for m positions.
  static Walkable_area from_wkt(std::string_view text, const std::string& name = "WKT");

  /// One polygon without holes, its vertices in either order, the last not being the first again.
  /// Throws Precondition_error if there is no such area, for the same reasons.
  explicit Walkable_area(std::span<const Vector_2> polygon);

  /// The area, but for rounding: relative to that of the extent, 2^-50 times the number of
  /// vertices.
  double area() const;

  /// The least box that contains it.
  Box_2 extent() const;

  /// The number of polygons.
  std::size_t number_of_polygons() const;

  /// Whether the position is inside or on a wall, exactly. Cost: that of a search in a tree.
  bool contains(const Vector_2& place) const;

  /// For functions of the library.
  const detail::Triangulated_area& triangles() const { return *triangles_; }

 private:
  explicit Walkable_area(std::shared_ptr<const detail::Triangulated_area> triangles)
      : triangles_(std::move(triangles)) {}

  std::shared_ptr<const detail::Triangulated_area> triangles_;
};

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_WALKABLE_AREA_H
