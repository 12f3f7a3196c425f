// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/walkable_area.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "observers/triangulated_area.h"
#include "observers/well_known_text.h"

namespace kinetri {

Walkable_area Walkable_area::from_wkt(std::string_view text, const std::string& name) {
  try {
    return Walkable_area(std::make_shared<const detail::Triangulated_area>(
        detail::read_well_known_text(text, name)));
  } catch (const detail::Invalid_area& error) {
    throw Input_error(name, 0, error.what);
  }
}

Walkable_area::Walkable_area(std::span<const Vector_2> polygon) {
  KINETRI_PRECONDITION(polygon.size() >= 3, "a polygon with " + std::to_string(polygon.size()) +
                                                " vertices; expected three or more");
  constexpr double largest = 1e150;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& [x, y] = polygon[i];
    KINETRI_PRECONDITION(std::abs(x) <= largest && std::abs(y) <= largest,
                         "vertex " + std::to_string(i) +
                             " of the polygon has a coordinate that is not finite, or beyond "
                             "1e150; expected one whose square is finite");
    KINETRI_PRECONDITION(polygon[(i + 1) % polygon.size()] != polygon[i],
                         "vertex " + std::to_string(i) +
                             " of the polygon is named twice; expected a simple one, without the "
                             "first vertex again at the end");
  }
  try {
    const detail::Ring ring(polygon.begin(), polygon.end());
    triangles_ = std::make_shared<const detail::Triangulated_area>(
        std::vector<detail::Rings_of_polygon>{{ring}});
  } catch (const detail::Invalid_area& error) {
    throw Precondition_error(error.what);
  }
}

double Walkable_area::area() const {
  return triangles_->area();
}

Box_2 Walkable_area::extent() const {
  return triangles_->extent();
}

std::size_t Walkable_area::number_of_polygons() const {
  return triangles_->number_of_polygons();
}

bool Walkable_area::contains(const Vector_2& place) const {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  KINETRI_PRECONDITION(std::isfinite(place.x) && std::isfinite(place.y),
                       "a place has a coordinate that is not finite");
  const auto point = [](const Vector_2& v) { return Kernel::Point_2(v.x, v.y); };
  bool result = false;
  triangles_->for_each_triangle_near({place.x, place.y, place.x, place.y}, [&](std::size_t i) {
    const auto& corners = triangles_->triangles()[i].corners;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_inside = is_inside && CGAL::orientation(point(corners[k]), point(corners[(k + 1) % 3]),
                                                 point(place)) != CGAL::RIGHT_TURN;
    }
    result = result || is_inside;
  });
  return result;
}

}  // namespace kinetri
