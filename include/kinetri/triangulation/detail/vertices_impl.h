// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2: how a vertex leaves the triangulation and comes
// back, with the certificates around it.
#ifndef KINETRI_TRIANGULATION_DETAIL_VERTICES_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_VERTICES_IMPL_H

#include <algorithm>
#include <vector>

#include "kinetri/triangulation/detail/incident.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

// Takes the vertex out of the triangulation, which stays Delaunay at the instant of its traits. The
// vertex itself stays, without faces: CGAL removes another one in its place.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::take_out(Vertex_handle v) {
  std::vector<Vertex_handle> around;
  detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) { around.push_back(u); });
  std::ranges::sort(around, {}, [](Vertex_handle u) { return u->point().id(); });

  unschedule_around(v);
  note_edges_at(v, -1);
  note_edges_among(around, -1);
  const Vertex_handle stand_in = triangulation_.tds().create_vertex();
  stand_in->set_point(v->point());
  replace_in_faces(v, stand_in);
  triangulation_.remove(stand_in);
  note_edges_among(around, 1);
  for (const Vertex_handle u : around) schedule_around(u);
}

// Puts a vertex without faces in at its place: it splits the triangle or edge that it is in, and
// what then violates its certificate has its event at the present time.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::put_in(Vertex_handle v, const Location& location) {
  const auto& [face, is_on_edge, i] = location;
  unschedule_face(face);
  if (is_on_edge) {
    unschedule_face(face->neighbor(i));
    --(*rebuilt_edges_)[ids_of(Edge(face, i))];
  }
  const Vertex_handle created = is_on_edge ? triangulation_.tds().insert_in_edge(face, i)
                                           : triangulation_.tds().insert_in_face(face);
  replace_in_faces(created, v);
  triangulation_.tds().delete_vertex(created);
  note_edges_at(v, 1);
  schedule_around(v);
}

// Gives the faces at `old` the vertex `replacement`, which has none.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::replace_in_faces(Vertex_handle old,
                                                                Vertex_handle replacement) {
  std::vector<Face_handle> faces;
  detail::for_each_face_at(triangulation_, old, [&](Face_handle f) { faces.push_back(f); });
  for (const Face_handle f : faces) f->set_vertex(f->index(old), replacement);
  replacement->set_face(faces.front());
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::unschedule_face(Face_handle face) {
  for (int i = 0; i < 3; ++i) {
    const Two_sided_edge edge = two_sided(Edge(face, i));
    unschedule(edge);
    set_event(edge, no_event);
  }
}

// The certificates that speak of `v` are those of the edges of its faces.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::unschedule_around(Vertex_handle v) {
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face) { unschedule_face(face); });
}

// Schedules those edges of the faces at `v` that have no event. Two neighboring faces share an edge
// at `v`, which is that of the first of them.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_around(Vertex_handle v) {
  std::vector<Two_sided_edge> edges;
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face) {
    const int at = face->index(v);
    for (const int i : {at, Triangulation::cw(at)}) {
      if (face->event(i) == no_event) edges.push_back(two_sided(Edge(face, i)));
    }
  });
  schedule(edges, current_time());
}

// Notes the finite edges at `v` as added (1) or removed (-1).
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::note_edges_at(Vertex_handle v, int change) {
  detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
    (*rebuilt_edges_)[edge_ids(v->point().id(), u->point().id())] += change;
  });
}

// Notes the edges that have both ends in `vertices`, which are sorted by id, as added or removed.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::note_edges_among(
    const std::vector<Vertex_handle>& vertices, int change) {
  const auto id = [](Vertex_handle v) { return v->point().id(); };
  for (const Vertex_handle v : vertices) {
    detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
      if (id(v) < id(u) && std::ranges::binary_search(vertices, id(u), {}, id)) {
        (*rebuilt_edges_)[edge_ids(id(v), id(u))] += change;
      }
    });
  }
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_VERTICES_IMPL_H
