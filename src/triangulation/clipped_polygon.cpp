// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/clipped_polygon.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <cmath>
#include <string>
#include <vector>

#include "kinetri/impl/base/check.h"

namespace kinetri::detail {

void check_polygon(std::span<const Vector_2> polygon) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  KINETRI_PRECONDITION(polygon.size() >= 3, "a polygon with " + std::to_string(polygon.size()) +
                                                " vertices; expected three or more");
  constexpr double largest = 1e150;
  std::vector<Kernel::Point_2> points;
  points.reserve(polygon.size());
  for (const Vector_2& v : polygon) {
    KINETRI_PRECONDITION(std::abs(v.x) <= largest && std::abs(v.y) <= largest,
                         "vertex " + std::to_string(points.size()) +
                             " of the polygon has a coordinate that is not finite, or beyond "
                             "1e150; expected one whose square is finite");
    points.emplace_back(v.x, v.y);
  }
  KINETRI_PRECONDITION(CGAL::is_simple_2(points.begin(), points.end(), Kernel()),
                       "a polygon with edges that meet, or with a vertex that is named twice; "
                       "expected a simple one, without the first vertex again at the end");
}

}  // namespace kinetri::detail
