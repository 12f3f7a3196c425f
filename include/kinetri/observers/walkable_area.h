// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area in which points may be: a polygon with holes, or several.
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
/// disjoint. Rings may touch each other, and themselves, in single positions. Copies are cheap,
/// since they share their contents; several threads may use them at once.
class Walkable_area {
 public:
  /// Reads a POLYGON, a MULTIPOLYGON, or a GEOMETRYCOLLECTION of these, or of such collections, as
  /// Well-Known Text (OpenGIS Simple Features Access, part 1, section 7) of two coordinates. A ring
  /// ends with its first position, and may have either orientation; repeated successive positions
  /// count once.
  ///
  /// Throws Input_error, with `name` for the file, the line, and the column or the number of the
  /// polygon and the ring, if the text is something else or continues after the end; if a
  /// coordinate is not finite or beyond 1e150; if a ring has fewer than three positions, or is not
  /// closed; if edges cross or share more than a position; or if, considering all rings, a hole is
  /// outside of the polygons, or polygons or holes overlap. All of that is decided exactly. Cost:
  /// O(m log m) for m positions.
  static Walkable_area from_wkt(std::string_view text, const std::string& name = "WKT");

  /// One polygon without holes, its vertices in either orientation; the first is not repeated at
  /// the end. Throws Precondition_error for the same reasons.
  explicit Walkable_area(std::span<const Vector_2> polygon);

  /// The area. Its error is at most 2^-50 times the number of vertices times the area of the
  /// extent.
  double area() const;

  /// The least box that contains it.
  Box_2 extent() const;

  /// The number of polygons.
  std::size_t number_of_polygons() const;

  /// Whether the position is inside or on a wall, exactly. Cost: a search in a tree.
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
