// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the topology of a kinetic triangulation of a torus has of its own. In the plane nothing
// calls these functions, but a source that is compiled with both kinds of traits instantiates them.
#ifndef KINETRI_SRC_TRIANGULATION_TORUS_TOPOLOGY_H
#define KINETRI_SRC_TRIANGULATION_TORUS_TOPOLOGY_H

#include "kinetri/impl/triangulation/topology_impl.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::locate_on_torus(const Point_2& point,
                                                          Face_handle start) const -> Location {
  if constexpr (is_periodic) {
    if (start == Face_handle()) start = *triangulation_.finite_face_handles().begin();
    const double time = clock_.instant().time.to_double();
    const Wrapping wrapping(triangulation_.geom_traits().box(), time);
    const Lattice_offset_2 nearest =
        wrapping.nearest(rounded_place(point.motion(), time),
                         rounded_place(start->vertex(0)->point().motion(), time), point.id());
    return {triangulation_.locate(point, start, nearest)};
  }
  return {};
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::vertex_near_on_torus(const Point_2& point,
                                                               double time) const -> Vertex_handle {
  if constexpr (is_periodic) {
    const Wrapping in_box(triangulation_.geom_traits().box(), time);
    return nearest_of_some(point, [&](const Point_2& p) {
      return in_box.place_of_image(rounded_place(p.motion(), time));
    });
  }
  return {};
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TORUS_TOPOLOGY_H
