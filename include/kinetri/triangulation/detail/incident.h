// SPDX-License-Identifier: GPL-3.0-or-later
//
// The walks around a vertex of a CGAL triangulation, in counterclockwise order.
#ifndef KINETRI_TRIANGULATION_DETAIL_INCIDENT_H
#define KINETRI_TRIANGULATION_DETAIL_INCIDENT_H

#include "kinetri/base/cxx20.h"

namespace kinetri::detail {

/// Calls `function` with the handle of each face at `v`, infinite ones too. The function must not
/// change the faces at `v`. Precondition: the dimension is 2.
template <class Triangulation, class Function>
void for_each_face_at(const Triangulation& triangulation, typename Triangulation::Vertex_handle v,
                      Function function) {
  auto face = triangulation.incident_faces(v);
  const auto first = face;
  do {
    function(typename Triangulation::Face_handle(face));
  } while (++face != first);
}

/// Calls `function` with the handle of each finite neighbor of `v`. Does nothing where there is
/// only one point.
template <class Triangulation, class Function>
void for_each_neighbor(const Triangulation& triangulation, typename Triangulation::Vertex_handle v,
                       Function function) {
  using Face_handle = typename Triangulation::Face_handle;
  if (triangulation.dimension() < 1) return;
  if (triangulation.dimension() == 2) {
    const Face_handle first = v->face();
    Face_handle face = first;
    do {
      // Without branches, which nothing could predict.
      const int at = (face->vertex(1) == v ? 1 : 0) + (face->vertex(2) == v ? 2 : 0);
      const auto neighbor = face->vertex(Triangulation::ccw(at));
      if (!triangulation.is_infinite(neighbor)) function(neighbor);
      face = face->neighbor(Triangulation::ccw(at));
    } while (face != first);
    return;
  }
  auto neighbor = triangulation.incident_vertices(v);
  const auto first = neighbor;
  do {
    if (!triangulation.is_infinite(neighbor)) {
      function(typename Triangulation::Vertex_handle(neighbor));
    }
  } while (++neighbor != first);
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_INCIDENT_H
