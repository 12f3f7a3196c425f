// SPDX-License-Identifier: GPL-3.0-or-later
//
// Identifiers that name things across layers and in files.
#ifndef KINETRI_BASE_IDS_H
#define KINETRI_BASE_IDS_H

#include <compare>
#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The number of a point: points of the input are numbered from 0, and points that are inserted get
/// the next numbers. Never reused.
using Point_id = std::uint32_t;

/// The id of points outside the input, such as query points and circumcenters, and of the infinite
/// vertex.
inline constexpr Point_id no_point = std::numeric_limits<Point_id>::max();

/// Which image of a point in a periodic box: how often each lattice vector is added to a position.
struct Lattice_offset_2 {
  std::int32_t x = 0;  ///< how often the first lattice vector
  std::int32_t y = 0;  ///< how often the second

  friend auto operator<=>(const Lattice_offset_2&, const Lattice_offset_2&) = default;
};

/// An image of a point in a periodic box: its position is that of the point plus `offset.x` times
/// the first and `offset.y` times the second lattice vector.
struct Periodic_image {
  Point_id id = no_point;        ///< the point
  Lattice_offset_2 offset = {};  ///< of the image against the position of the point as given

  friend auto operator<=>(const Periodic_image&, const Periodic_image&) = default;
};

}  // namespace kinetri

#endif  // KINETRI_BASE_IDS_H
