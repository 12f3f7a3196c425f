// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/box_extent.h"

#include <algorithm>
#include <cmath>

#include "kinetri/impl/kinetic/drawn_box_2.h"

namespace kinetri::app {
namespace {

constexpr int times = 32;  // at which the box is looked at, besides the first

}  // namespace

Box_2 extent_of_box(const Periodic_box_2& box, double from, double until, std::size_t points) {
  Box_2 result;  // has the origin, which is a corner
  for (int i = 0; i <= times; ++i) {
    const double share = static_cast<double>(i) / times;
    const Drawn_box_2 drawn(box, (1 - share) * from + share * until);
    for (const auto& [x, y] : drawn.corners()) {
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      result = {std::min(result.xmin, x), std::min(result.ymin, y), std::max(result.xmax, x),
                std::max(result.ymax, y)};
    }
  }
  const double side = std::max(result.xmax - result.xmin, result.ymax - result.ymin);
  const double room = side / std::max(std::sqrt(static_cast<double>(points)), 2.0);
  return {result.xmin - room, result.ymin - room, result.xmax + room, result.ymax + room};
}

}  // namespace kinetri::app
