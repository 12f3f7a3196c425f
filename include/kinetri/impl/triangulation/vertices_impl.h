// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: how a vertex leaves the triangulation and comes
// back, with the certificates around it.
#ifndef KINETRI_IMPL_TRIANGULATION_VERTICES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_VERTICES_IMPL_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// The nearest of some points, about as many as the third root of all, in doubles, if there is a way
// to round places. The walk from there passes about as many triangles. [Muecke, Saias and Zhu 1996]
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::vertex_near(const Point_2& point) const -> Vertex_handle {
  KINETRI_PRECONDITION(number_of_points_ > 0, "there is no point, and so none is near");
  Vertex_handle nearest;
  if constexpr (HasRoundedPlace<Motion>) {
    const double time = current_time().to_double();
    const Vector_2 place = rounded_place(point.motion(), time);
    const auto tries = static_cast<std::size_t>(2 * std::cbrt(number_of_points_));
    const std::size_t step = std::max<std::size_t>(1, vertices_.size() / tries);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t id = point.id() % step; id < vertices_.size(); id += step) {
      const Vertex_handle v = vertices_[id];
      if (v == Vertex_handle()) continue;
      const Vector_2 there = rounded_place(v->point().motion(), time);
      const double dx = there.x - place.x;
      const double dy = there.y - place.y;
      const double distance = dx * dx + dy * dy;
      if (!(distance < least)) continue;
      least = distance;
      nearest = v;
    }
  }
  return nearest != Vertex_handle() ? nearest : *triangulation_.finite_vertex_handles().begin();
}

// Takes the vertex out of the triangulation, which stays Delaunay at the instant of its traits. The
// vertex itself stays, without faces. What it has hidden is hidden by others then, or revealed.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::take_out(Vertex_handle v) {
  ++changes_;
  std::vector<Vertex_handle> hidden;
  if constexpr (is_weighted) {
    if (v->is_hidden()) {
      hidden_points().unschedule(v);
      triangulation_.take_from_face(v);
      rebuilt_points_.push_back({v->point().id(), false});
      moved_hidden_.push_back(v->point().id());
      return triangulation_.show(v);
    }
    detail::for_each_face_at(triangulation_, v, [&](Face_handle face) {
      hidden_points().unschedule_in(face);
      hidden.insert(hidden.end(), face->vertex_list().begin(), face->vertex_list().end());
    });
  }
  unschedule_around(v);
  std::vector<Face_handle> faces;
  const std::vector<Two_sided_edge> edges = remove_from_faces(v, faces);
  if constexpr (is_weighted) {
    for (const Vertex_handle h : hidden) {
      if (!h->is_hidden()) rebuilt_points_.push_back({h->point().id(), false});
      moved_hidden_.push_back(h->point().id());
    }
  }
  schedule(edges, current_time());
  if constexpr (is_weighted) {
    for (const Face_handle face : faces) hidden_points().schedule_in(face);
    // At a vertex, a point may be in any face of the vertex, also beyond the link.
    for (const Vertex_handle h : hidden) {
      if (h->is_hidden() && h->event() == no_event) hidden_points().schedule(h, current_time());
    }
  }
}

// Takes an inner or a hull vertex out of its faces, and notes the edges that go and come. The
// vertex stays: CGAL removes another one in its place. Returns the edges around the hole and those
// in it, which have the handle `listed` until they are scheduled; `faces` gets the faces in it.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::remove_from_faces(Vertex_handle v,
                                                        std::vector<Face_handle>& faces)
    -> std::vector<Two_sided_edge> {
  std::vector<Edge> link;  // as the faces beyond it see it, which stay
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face) {
    link.push_back(two_sided(Edge(face, face->index(v))).there);
  });
  note_edges_at(v, -1);
  const Vertex_handle stand_in = triangulation_.tds().create_vertex();
  stand_in->set_point(v->point());
  replace_in_faces(v, stand_in);
  if constexpr (is_weighted) {
    if (weights_are_equal_) {
      triangulation_.as_delaunay([&](auto& delaunay) { delaunay.remove(stand_in); });
    } else {
      triangulation_.remove(stand_in);
    }
  } else {
    triangulation_.remove(stand_in);
  }
  return list_inside(link, faces);
}

// The edges of a polygon and those inside it, which are new and are noted; `faces` gets the faces
// inside it. An edge that has been found is marked by the handle `listed` until it is scheduled.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::list_inside(std::span<const Edge> polygon,
                                                  std::vector<Face_handle>& faces)
    -> std::vector<Two_sided_edge> {
  constexpr Queue_handle listed = no_event - 1;
  std::vector<Face_handle> beyond;
  for (const Edge& edge : polygon) beyond.push_back(edge.first);
  std::ranges::sort(beyond);
  std::vector<Two_sided_edge> edges;
  faces = {two_sided(polygon.front()).there.first};
  for (std::size_t next = 0; next < faces.size(); ++next) {
    const Face_handle face = faces[next];
    for (int i = 0; i < 3; ++i) {
      if (face->event(i) == listed) continue;
      const Two_sided_edge edge = edges.emplace_back(two_sided(Edge(face, i)));
      set_event(edge, listed);
      if (std::ranges::binary_search(beyond, edge.there.first)) continue;
      faces.push_back(edge.there.first);
      if (!triangulation_.is_infinite(edge.here)) rebuilt_edges_->note(ids_of(edge.here), 1);
    }
  }
  return edges;
}

// Puts a vertex without faces in at its place: it splits the triangle or edge that it is in. Inside
// the hull edges are flipped as in a static triangulation, before any certificate is made; what
// violates its certificate at the hull has its event at the present time.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::put_in(Vertex_handle v, const Location& location,
                                             Certificate_state state) {
  const auto& [face, locus, i] = location;
  KINETRI_ASSERT(locus != Triangulation::VERTEX, "the point is in the place of no other");
  const bool is_on_edge = locus == Triangulation::EDGE;
  const bool is_inside = !triangulation_.is_infinite(face) &&
                         !(is_on_edge && triangulation_.is_infinite(face->neighbor(i)));
  ++changes_;
  std::vector<Vertex_handle> hidden;
  if constexpr (is_weighted) hidden = hidden_points().take({&face, 1});
  unschedule_face(face);
  if (is_on_edge) {
    const std::vector<Vertex_handle> more = take_hidden_at(Edge(face, i));
    hidden.insert(hidden.end(), more.begin(), more.end());
    unschedule_face(face->neighbor(i));
    rebuilt_edges_->note(ids_of(Edge(face, i)), -1);
  }
  const Vertex_handle created = is_on_edge ? triangulation_.tds().insert_in_edge(face, i)
                                           : triangulation_.tds().insert_in_face(face);
  replace_in_faces(created, v);
  triangulation_.tds().delete_vertex(created);
  note_edges_at(v, 1);
  if (is_inside && weights_are_equal_) flip_link(v);
  schedule_around(v, state);
  if constexpr (is_weighted) {
    std::vector<Face_handle> around;
    detail::for_each_face_at(triangulation_, v, [&](Face_handle f) { around.push_back(f); });
    hidden_points().put(hidden, around);
  }
}

// Flips the edges opposite `v`, which is new and whose edges have no events, until the
// triangulation is Delaunay at the instant of its traits; it was so without `v`. [Lawson 1977]
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::flip_link(Vertex_handle v) {
  const auto side = triangulation_.geom_traits().side_of_oriented_circle_2_object();
  std::vector<Edge> link;
  detail::for_each_face_at(triangulation_, v,
                           [&](Face_handle face) { link.emplace_back(face, face->index(v)); });
  while (!link.empty()) {
    const auto [face, i] = link.back();
    link.pop_back();
    const Face_handle beyond = face->neighbor(i);
    if (triangulation_.is_infinite(beyond)) continue;
    if (side(beyond->vertex(0)->point(), beyond->vertex(1)->point(), beyond->vertex(2)->point(),
             v->point()) != CGAL::ON_POSITIVE_SIDE) {
      continue;
    }
    unschedule_face(beyond);
    rebuilt_edges_->note(ids_of(Edge(face, i)), -1);
    triangulation_.tds().flip(face, i);
    rebuilt_edges_->note(ids_of(Edge(face, Triangulation::ccw(i))), 1);
    link.emplace_back(face, face->index(v));
    link.emplace_back(beyond, beyond->index(v));
  }
}

// Gives the faces at `old` the vertex `replacement`, which has none.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::replace_in_faces(Vertex_handle old,
                                                       Vertex_handle replacement) {
  std::vector<Face_handle> faces;
  detail::for_each_face_at(triangulation_, old, [&](Face_handle f) { faces.push_back(f); });
  for (const Face_handle f : faces) f->set_vertex(f->index(old), replacement);
  replacement->set_face(faces.front());
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::unschedule_face(Face_handle face) {
  for (int i = 0; i < 3; ++i) {
    const Two_sided_edge edge = two_sided(Edge(face, i));
    unschedule(edge);
    set_event(edge, no_event);
  }
}

// The certificates that speak of `v` are those of the edges of its faces.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::unschedule_around(Vertex_handle v) {
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face) { unschedule_face(face); });
}

// The same, and adds those edges to `edges` that are not among them yet, which are marked by the
// handle `listed` until they are scheduled. Counts what is discarded.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::unschedule_around(Vertex_handle v,
                                                        std::vector<Two_sided_edge>& edges,
                                                        Triangulation_counters& counters) {
  constexpr Queue_handle listed = no_event - 1;
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face, int at) {
    for (const int i : {at, Triangulation::cw(at)}) {
      if (face->event(i) == listed) continue;
      // Written in its place: the processor waits when it copies what has just been written.
      const Face_handle neighbor = face->neighbor(i);
      const int right = detail::index_in(neighbor, face->vertex(Triangulation::ccw(i)));
      Two_sided_edge& edge = edges.emplace_back();
      edge.here.first = face;
      edge.here.second = i;
      edge.there.first = neighbor;
      edge.there.second = Triangulation::ccw(right);
      unschedule(edge, counters);
      set_event(edge, listed);
    }
  });
}

// Schedules those edges of the faces at `v` that have no event. Two neighboring faces share an edge
// at `v`, which is that of the first of them; the certificates of these are in the given state.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::schedule_around(Vertex_handle v, Certificate_state state) {
  std::vector<Two_sided_edge> at_vertex;
  std::vector<Two_sided_edge> opposite;
  detail::for_each_face_at(triangulation_, v, [&](Face_handle face) {
    const int at = face->index(v);
    const int left = Triangulation::cw(at);
    if (face->event(at) == no_event) opposite.push_back(two_sided(Edge(face, at)));
    if (face->event(left) == no_event) at_vertex.push_back(two_sided(Edge(face, left)));
  });
  if (state == Certificate_state::any) {
    opposite.insert(opposite.end(), at_vertex.begin(), at_vertex.end());
  } else {
    schedule(at_vertex, current_time(), state);
  }
  schedule(opposite, current_time());
}

// Notes the finite edges at `v` as added (1) or removed (-1).
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::note_edges_at(Vertex_handle v, int change) {
  detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
    rebuilt_edges_->note(edge_ids(v->point().id(), u->point().id()), change);
  });
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_VERTICES_IMPL_H
