// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a triangulation in terms of point ids, found by their sides.
#ifndef KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
#define KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H

#include <array>
#include <cstddef>
#include <vector>

#include "kinetri/base/ids.h"

namespace kinetri {

/// The corners of a triangle, counterclockwise.
using Triangle_ids = std::array<Point_id, 3>;

/// The corners in the same cyclic order, the least id first.
constexpr Triangle_ids triangle_ids(Point_id a, Point_id b, Point_id c) {
  if (a < b && a < c) return {a, b, c};
  return b < c ? Triangle_ids{b, c, a} : Triangle_ids{c, a, b};
}

namespace detail {

// Each directed edge pq of a triangle pqr, counterclockwise, has the apex r.
class Triangle_map {
 public:
  // The apex of the triangle to the left of pq; no_point if there is no triangle.
  Point_id apex(Point_id p, Point_id q) const;
  // Precondition: there is no triangle to the left of any of its sides.
  void insert(const Triangle_ids& corners);
  // Precondition: the triangle is there.
  void erase(const Triangle_ids& corners);

 private:
  struct Side {
    Point_id end = no_point;
    Point_id apex = no_point;
  };

  std::vector<std::vector<Side>> sides_;  // by their first end
};

}  // namespace detail
}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
