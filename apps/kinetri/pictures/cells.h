// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Voronoi or power cells of the points of a recording at a time, from its edges and triangles:
// as on the page (viewer/cells.js). In binary64; an area errs by some units in the last place of
// the squared distance from the point to the corners of its cell.
#ifndef KINETRI_APPS_CELLS_H
#define KINETRI_APPS_CELLS_H

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "kinetri/impl/simulation/playback.h"
#include "kinetri/simulation/box_2.h"
#include "pictures/places.h"

namespace kinetri::app {

struct Cell {
  std::vector<Vector_2> corners;  ///< counterclockwise; none if unbounded, or of a hidden point
  /// NaN if the cell is unbounded or empty. Points that coincide for a while share it equally.
  double area = std::numeric_limits<double>::quiet_NaN();
  /// Number of neighbors. That of a point that coincides with the one that is shown is this one.
  std::size_t degree = 0;
};

/// The cells of all points by id, clipped to the box if there is one. `places` are those of the
/// playback's time.
std::vector<Cell> cells(const Playback& playback, const Places& places,
                        const std::optional<Box_2>& box);

/// The position of equal power to three points; not finite if they are collinear. Without weights
/// it is the circumcenter.
Vector_2 power_center(const Recorded_place& a, const Recorded_place& b, const Recorded_place& c);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CELLS_H
