// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a triangulation in terms of point ids, found by their sides.
#ifndef KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
#define KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H

#include <array>
#include <concepts>
#include <cstddef>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/triangulation/edge_changes.h"

namespace kinetri::detail {

// ---- corners: points in the plane, images of points in a periodic box ----

// The corner as the image of a point with that offset sees it; in the plane the corner.
constexpr Point_id seen_from(const Lattice_offset_2& /*offset*/, Point_id corner) {
  return corner;
}
constexpr Periodic_image seen_from(const Lattice_offset_2& offset, const Periodic_image& corner) {
  return {corner.id, offset_between(offset, corner.offset)};
}

constexpr Lattice_offset_2 offset_of(Point_id /*corner*/) {
  return {};
}
constexpr Lattice_offset_2 offset_of(const Periodic_image& corner) {
  return corner.offset;
}

// The corners of a triangle, with offsets against the first one.
constexpr std::array<Periodic_image, 3> images_of(const Periodic_triangle& triangle) {
  const auto& [corners, offsets] = triangle;
  return {Periodic_image{corners[0], {}}, {corners[1], offsets[0]}, {corners[2], offsets[1]}};
}

// The edge between two images.
constexpr Periodic_edge edge_between(const Periodic_image& p, const Periodic_image& q) {
  return periodic_edge(p.id, q.id, offset_between(p.offset, q.offset));
}

// Each directed edge pq of a triangle pqr, counterclockwise, has the apex r. In a periodic box
// corners are images, and what is said of them holds for all images of their triangle.
template <class Corner>
requires std::same_as<Corner, Point_id> || std::same_as<Corner, Periodic_image>
class Triangle_map {
 public:
  using Corners = std::array<Corner, 3>;

  struct Side {
    Corner end;
    Corner apex;
  };

  // The apex of the triangle to the left of pq; its id is no_point if there is no triangle.
  Corner apex(const Corner& p, const Corner& q) const;
  // The directed edges that begin at the point itself.
  const std::vector<Side>& sides(Point_id p) const;
  // Precondition: there is no triangle to the left of any of its sides.
  void insert(const Corners& corners);
  // Precondition: the triangle is there.
  void erase(const Corners& corners);

 private:
  std::vector<std::vector<Side>> sides_;  // by their first end
};

extern template class Triangle_map<Point_id>;
extern template class Triangle_map<Periodic_image>;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_SIMULATION_TRIANGLE_MAP_H
