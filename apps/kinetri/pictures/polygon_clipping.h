// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_APPS_POLYGON_CLIPPING_H
#define KINETRI_APPS_POLYGON_CLIPPING_H

#include <cstddef>
#include <vector>

namespace kinetri::app {

/// The part of a polygon, given by its corners in order, in which the linear function `depth` is
/// not negative (Sutherland and Hodgman, Reentrant polygon clipping, Communications of the ACM 17,
/// 1974). A `Place` has x and y.
template <class Place, class Depth>
std::vector<Place> part_inside(const std::vector<Place>& corners, const Depth& depth) {
  std::vector<Place> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place& from = corners[i];
    const Place& to = corners[(i + 1) % corners.size()];
    const double here = depth(from);
    const double there = depth(to);
    if (here >= 0) result.push_back(from);
    if ((here >= 0) != (there >= 0)) {
      const double share = here / (here - there);
      result.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
  }
  return result;
}

}  // namespace kinetri::app

#endif  // KINETRI_APPS_POLYGON_CLIPPING_H
