// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks around a vertex of a triangulation, counterclockwise.
#ifndef KINETRI_IMPL_TRIANGULATION_INCIDENT_H
#define KINETRI_IMPL_TRIANGULATION_INCIDENT_H

#include <type_traits>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// The index of a vertex of a face, without branches, which would be mispredicted. Precondition: it
/// is at one corner only.
template <class Face_handle, class Vertex_handle>
int index_in(Face_handle face, Vertex_handle v) {
  return (face->vertex(1) == v ? 1 : 0) + (face->vertex(2) == v ? 2 : 0);
}

/// Whether faces store the index of each edge in the neighbor, since several of their corners may
/// be at one vertex (Periodic_face_base_2).
template <class Face_handle>
concept HasMirrors = requires(Face_handle face) {
  face->mirror(0);
};

/// Calls `function` with the handle of each face at `v`, infinite ones too, and the index of `v` in
/// the face. A face with several corners at `v` comes as often. The function must not change the
/// faces at `v`. Precondition: the dimension is 2.
template <class Triangulation, class Function>
void for_each_face_at(const Triangulation& /*triangulation*/,
                      typename Triangulation::Vertex_handle v, Function function) {
  using Face_handle = typename Triangulation::Face_handle;
  const auto visit = [&](Face_handle face, int i) {
    if constexpr (std::is_invocable_v<Function, Face_handle, int>) {
      function(face, i);
    } else {
      function(face);
    }
  };
  const Face_handle first = v->face();
  auto face = first;
  if constexpr (HasMirrors<Face_handle>) {
    const int first_index = first->index(v);
    int i = first_index;
    do {
      visit(face, i);
      const int mirror = face->mirror(Triangulation::ccw(i));
      face = face->neighbor(Triangulation::ccw(i));
      i = Triangulation::ccw(mirror);
    } while (face != first || i != first_index);
  } else {
    do {
      const int i = index_in(face, v);
      visit(face, i);
      face = face->neighbor(Triangulation::ccw(i));
    } while (face != first);
  }
}

/// Calls `function` with the handle of each finite neighbor of `v`.
template <class Triangulation, class Function>
void for_each_neighbor(const Triangulation& triangulation, typename Triangulation::Vertex_handle v,
                       Function function) {
  if (triangulation.dimension() < 1) return;
  const auto visit = [&](typename Triangulation::Vertex_handle neighbor) {
    if (!triangulation.is_infinite(neighbor)) function(neighbor);
  };
  if (triangulation.dimension() == 2) {
    return for_each_face_at(triangulation, v,
                            [&](auto face, int i) { visit(face->vertex(Triangulation::ccw(i))); });
  }
  auto neighbor = triangulation.incident_vertices(v);
  const auto first = neighbor;
  do {
    visit(neighbor);
  } while (++neighbor != first);
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_INCIDENT_H
