// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/triangle_map.h"

#include <algorithm>

#include "kinetri/impl/base/check.h"

namespace kinetri::detail {

Point_id Triangle_map::apex(Point_id p, Point_id q) const {
  if (p >= sides_.size()) return no_point;
  const auto side = std::ranges::find(sides_[p], q, &Side::end);
  return side == sides_[p].end() ? no_point : side->apex;
}

void Triangle_map::insert(const Triangle_ids& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point_id p = corners[k];
    const Point_id q = corners[(k + 1) % 3];
    KINETRI_ASSERT(apex(p, q) == no_point, "a side has one triangle to its left");
    if (p >= sides_.size()) sides_.resize(std::size_t{p} + 1);
    sides_[p].push_back({q, corners[(k + 2) % 3]});
  }
}

void Triangle_map::erase(const Triangle_ids& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    auto& sides = sides_[corners[k]];
    const auto side = std::ranges::find(sides, corners[(k + 1) % 3], &Side::end);
    KINETRI_ASSERT(side != sides.end() && side->apex == corners[(k + 2) % 3],
                   "a triangle that is erased is there");
    *side = sides.back();
    sides.pop_back();
  }
}

}  // namespace kinetri::detail
