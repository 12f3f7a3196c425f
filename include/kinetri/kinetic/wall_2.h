// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wall: an axis-parallel line on one side of which points are kept.
#ifndef KINETRI_KINETIC_WALL_2_H
#define KINETRI_KINETIC_WALL_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// Points are kept at `clearance` or more from the line, on the inner side of it: to the right of a
/// left wall, and so on. The exact bound is position + clearance, or position - clearance,
/// unrounded. If `rim_touches` is true, the radius of a disc at the time is added to the clearance,
/// so that the bound moves if the disc grows.
struct Wall_2 {
  /// Which side of the plane the wall closes.
  enum class Side : std::uint8_t {
    left,    ///< points are at greater x
    right,   ///< points are at smaller x
    bottom,  ///< points are at greater y
    top,     ///< points are at smaller y
  };

  Side side = Side::left;    ///< the side of the points on which the wall is
  double position = 0;       ///< of the line: its x, or its y
  double clearance = 0;      ///< at least 0; for example, a radius that all discs have
  bool rim_touches = false;  ///< whether boundary circles touch the wall, not centers

  /// Whether the wall bounds x.
  constexpr bool is_vertical() const { return side == Side::left || side == Side::right; }
  /// Whether the wall bounds its coordinate from above.
  constexpr bool is_upper() const { return side == Side::right || side == Side::top; }

  friend bool operator==(const Wall_2&, const Wall_2&) = default;
};

/// The side in words: "left", "right", "lower" or "upper".
constexpr std::string_view name(Wall_2::Side side) {
  constexpr std::array<std::string_view, 4> names = {"left", "right", "lower", "upper"};
  return names[static_cast<std::size_t>(side)];
}

}  // namespace kinetri

#endif  // KINETRI_KINETIC_WALL_2_H
