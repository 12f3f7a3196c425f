// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons as Well-Known Text. The reader of Boost.Geometry is not used, since it reads missing
// coordinates as 0.
#ifndef KINETRI_SRC_OBSERVERS_WELL_KNOWN_TEXT_H
#define KINETRI_SRC_OBSERVERS_WELL_KNOWN_TEXT_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// A closed line, its vertices in either orientation; the first is not repeated at the end.
using Ring = std::vector<Vector_2>;

/// The outer ring, and those of the holes.
using Rings_of_polygon = std::vector<Ring>;

/// The polygons of the text; no ring is empty. Throws Input_error as Walkable_area::from_wkt,
/// except for conflicts between rings.
std::vector<Rings_of_polygon> read_well_known_text(std::string_view text, const std::string& name);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_WELL_KNOWN_TEXT_H
