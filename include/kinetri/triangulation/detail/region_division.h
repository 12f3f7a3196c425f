// SPDX-License-Identifier: GPL-3.0-or-later
//
// The division of vertices among regions, which a triangulation keeps between two runs by regions.
#ifndef KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_H
#define KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "kinetri/base/ids.h"

namespace kinetri::detail {

/// Which region a vertex belongs to, and how far a run by regions has come. See detail/regions.h.
struct Region_division {
  /// The number of no region: that of the infinite vertex, and of points that came after the
  /// division.
  static constexpr std::uint16_t no_region = std::numeric_limits<std::uint16_t>::max();

  std::size_t regions = 0;            ///< how many there are
  std::vector<std::uint16_t> owners;  ///< by point id, the region that owns the vertex
  /// Of each region, then of the rest: how many flips have been numbered since the division.
  std::vector<std::size_t> flips;
  double events = 0;        ///< of windows since the division
  double window_width = 0;  ///< of the next window

  /// The region that owns a vertex. The infinite vertex has the id no_point.
  std::uint16_t owner(Point_id id) const { return id < owners.size() ? owners[id] : no_region; }
};

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_REGION_DIVISION_H
