// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a triangulation in terms of point ids, found by their sides.
#ifndef KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
#define KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H

#include <cstddef>
#include <vector>

#include "kinetri/base/ids.h"

namespace kinetri::detail {

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

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
