// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the plane that pictures of a periodic box show, as on the page (viewer/extents.js).
#ifndef KINETRI_APPS_BOX_EXTENT_H
#define KINETRI_APPS_BOX_EXTENT_H

#include <cstddef>

#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/box_2.h"

namespace kinetri::app {

/// The bounding box of the box as it is drawn (Drawn_box_2) at times from `from` to `until`, and
/// beside it as much as the distance of that many points, half of its greater side at most: so much
/// is seen of edges that leave the box.
Box_2 extent_of_box(const Periodic_box_2& box, double from, double until, std::size_t points);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_BOX_EXTENT_H
