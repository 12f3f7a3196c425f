// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_UPDATES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_UPDATES_IMPL_H

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/schedule_impl.h"
#include "kinetri/impl/triangulation/static_construction.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

// The entries of the outer edges leave the queue first, before their corners change.
template <class Traits>
void Kinetic_types<Traits>::Updates::flip(const Edge_with_mirror& edge, Event_kind kind) {
  auto outer = topology_.outer_edges(edge);
  for (const auto& [here, there] : outer) {
    prefetch(there.first->vertex(there.second));
    schedule_.queue().prefetch(there.first->event(there.second));
  }
  ++changes_;
  std::array<Face_handle, 2> faces = {edge.here.first, edge.there.first};
  if constexpr (is_weighted) {
    // A hidden point on the new edge is in both faces: their order must not depend on the side of
    // the edge that its entry has.
    if (!Topology::is_chosen_side(edge.here)) std::swap(faces[0], faces[1]);
  }
  const auto make = [&] {
    Schedule::forget_entry(edge);
    for (const Edge_with_mirror& side : outer) schedule_.unschedule(side);
    std::vector<Taken_point> hidden;
    if constexpr (is_weighted) hidden = take_hidden(faces);
    const Edge_with_mirror added = topology_.flip(edge, outer);
    if (reporter_.is_noting()) {  // several changes: polynomials need not vanish now
      schedule_.schedule({&added, 1}, schedule_.current_time());
      schedule_.schedule(outer, schedule_.current_time());
    } else {
      schedule_.schedule_after_flip(added, outer);
    }
    if constexpr (is_weighted) put_hidden(hidden, faces);
  };
  if (reporter_.has_listeners()) {
    reporter_.report(flip_event(kind, topology_.flipped_edges(edge)), make);
  } else {
    make();
    reporter_.count_event(kind);
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Updates::take_out(Vertex_handle v) {
  ++changes_;
  if constexpr (is_weighted) {
    if (v->is_hidden()) {
      take_out_hidden(v);
      return true;
    }
  }
  if constexpr (is_periodic) {
    return take_out_on_torus(v);
  } else {
    return take_out_in_plane(v);
  }
}

template <class Traits>
void Kinetic_types<Traits>::Updates::take_out_hidden(Vertex_handle v) {
  schedule_.unschedule_hidden(v);
  triangulation_.take_from_face(v);
  reporter_.note_hidden(v->point().id(), false);
  reporter_.note_moved_hidden(v->point().id());
  triangulation_.show(v);
}

// A point that is hidden in a face with three corners at the vertex is near no vertex that stays.
template <class Traits>
bool Kinetic_types<Traits>::Updates::take_out_on_torus(Vertex_handle v) {
  Face_journal journal(*this, v);
  bool is_out = true;
  if (topology_.are_weights_equal()) {
    is_out = triangulation_.remove_from_faces(v, journal);
  } else {
    if constexpr (is_weighted) {
      for_each_face_at(triangulation_, v, [&](Face_handle f) {
        const bool is_at_v = f->vertex(0) == v && f->vertex(1) == v && f->vertex(2) == v;
        is_out = is_out && (!is_at_v || f->vertex_list().empty());
      });
    }
    std::vector<Edge> edges;
    is_out = is_out && triangulation_.take_from_faces(v, edges, journal);
  }
  journal.schedule();
  return is_out;
}

template <class Traits>
void Kinetic_types<Traits>::Updates::put_in(Vertex_handle v, const Location& location,
                                            Certificate_state state) {
  if constexpr (is_periodic) {
    ++changes_;
    Face_journal journal(*this);
    triangulation_.insert_in_faces(v, location, journal);
    if (topology_.are_weights_equal()) {
      triangulation_.restore_delaunay(triangulation_.edges_opposite(v), journal);
    }
    journal.schedule(v, state);
  } else {
    put_in_in_plane(v, location, state);
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Updates::take_out_in_plane(Vertex_handle v) {
  std::vector<Vertex_handle> hidden;
  if constexpr (is_weighted) {
    for_each_face_at(triangulation_, v, [&](Face_handle face) {
      schedule_.unschedule_hidden_in(face);
      hidden.insert(hidden.end(), face->vertex_list().begin(), face->vertex_list().end());
    });
  }
  schedule_.unschedule_around(v);
  std::vector<Face_handle> faces;
  const std::vector<Edge_with_mirror> edges = topology_.remove_from_faces(v, faces, note());
  if constexpr (is_weighted) {
    for (const Vertex_handle h : hidden) {
      if (!h->is_hidden()) reporter_.note_hidden(h->point().id(), false);
      reporter_.note_moved_hidden(h->point().id());
    }
  }
  schedule_.schedule(edges, schedule_.current_time());
  if constexpr (is_weighted) {
    for (const Face_handle face : faces) schedule_.schedule_hidden_in(face);
    // A point at the position of a vertex may be in any face of that vertex, even beyond the link.
    for (const Vertex_handle h : hidden) {
      if (h->is_hidden() && h->event() == no_event) {
        schedule_.schedule_hidden(h, schedule_.current_time());
      }
    }
  }
  return true;
}

// Edges at the hull that are violated fail at the present time.
template <class Traits>
void Kinetic_types<Traits>::Updates::put_in_in_plane(Vertex_handle v, const Location& location,
                                                     Certificate_state state) {
  const auto& [face, locus, i] = location;
  const bool is_on_edge = locus == Triangulation::EDGE;
  const bool is_inside_hull = !triangulation_.is_infinite(face) &&
                              !(is_on_edge && triangulation_.is_infinite(face->neighbor(i)));
  ++changes_;
  std::vector<Taken_point> hidden;
  if constexpr (is_weighted) {
    hidden = take_hidden({&face, 1});
    if (is_on_edge) {
      const std::array beside = {face->neighbor(i)};
      const std::vector<Taken_point> more = take_hidden(beside);
      hidden.insert(hidden.end(), more.begin(), more.end());
    }
  }
  schedule_.unschedule_face(face);
  if (is_on_edge) {
    schedule_.unschedule_face(face->neighbor(i));
    note_edge(Edge(face, i), -1);
  }
  topology_.insert_in_faces(v, location);
  topology_.note_edges_at(v, 1, note());
  if (is_inside_hull && topology_.are_weights_equal()) flip_link(v);
  schedule_.schedule_around(v, state);
  if constexpr (is_weighted) {
    std::vector<Face_handle> around;
    for_each_face_at(triangulation_, v, [&](Face_handle f) { around.push_back(f); });
    put_hidden(hidden, around);
  }
}

// Flips the edges opposite the new vertex `v`, whose edges have no entries, until the triangulation
// is Delaunay at the instant of its traits, as it was without `v`. [Lawson 1977]
template <class Traits>
void Kinetic_types<Traits>::Updates::flip_link(Vertex_handle v) {
  const auto side = triangulation_.geom_traits().side_of_oriented_circle_2_object();
  std::vector<Edge> link;
  for_each_face_at(triangulation_, v, [&](Face_handle face, int i) { link.emplace_back(face, i); });
  while (!link.empty()) {
    const auto [face, i] = link.back();
    link.pop_back();
    const Face_handle beyond = face->neighbor(i);
    if (triangulation_.is_infinite(beyond)) continue;
    if (side(beyond->vertex(0)->point(), beyond->vertex(1)->point(), beyond->vertex(2)->point(),
             v->point()) != CGAL::ON_POSITIVE_SIDE) {
      continue;
    }
    schedule_.unschedule_face(beyond);
    note_edge(Edge(face, i), -1);
    triangulation_.tds().flip(face, i);
    note_edge(Edge(face, Triangulation::ccw(i)), 1);
    link.emplace_back(face, face->index(v));
    link.emplace_back(beyond, beyond->index(v));
  }
}

// ---- hidden points ----

template <class Traits>
void Kinetic_types<Traits>::Updates::reveal(Vertex_handle v, const Location& location,
                                            Certificate_state state) {
  ++changes_;
  reporter_.report_point(Event_kind::reveal, v->point().id(), [&] {
    triangulation_.show(v);
    reporter_.note_moved_hidden(v->point().id());
    put_in(v, location, state);
  });
}

template <class Traits>
void Kinetic_types<Traits>::Updates::hide(Vertex_handle v) {
  ++changes_;
  const bool was_noting = reporter_.is_noting();
  reporter_.report_point(Event_kind::hide, v->point().id(), [&] {
    const Location location = merge_faces(v);
    // Outside the hull its certificate has another sign.
    const bool is_inner = !triangulation_.is_infinite(location.face);
    hide_in(v, location);
    schedule_.schedule_hidden(v, schedule_.current_time(),
                              is_inner && !was_noting ? plane_condition : no_condition);
  });
}

// Makes one face of those at a vertex of degree 3; returns where that is in it.
template <class Traits>
auto Kinetic_types<Traits>::Updates::merge_faces(Vertex_handle v) -> Location {
  if constexpr (is_periodic) {
    const Face_handle face = v->face();
    const int stays = Triangulation::cw(face->index(v));
    const Lattice_offset_2 against = Triangulation::offset(face, stays, face->index(v));
    Face_journal journal(*this, v);
    std::vector<Edge> edges;
    triangulation_.take_from_faces(v, edges, journal);
    journal.schedule();
    return {Triangulation::location_near(v->point(), face, stays, against)};
  } else {
    std::vector<Face_handle> faces;
    for_each_face_at(triangulation_, v, [&](Face_handle face) { faces.push_back(face); });
    const std::vector<Taken_point> hidden = take_hidden(faces);
    for (const Face_handle face : faces) schedule_.unschedule_face(face);
    topology_.note_edges_at(v, -1, note());
    const auto [face, second, third] = topology_.remove_degree_3(v);
    triangulation_.tds().delete_face(second);
    triangulation_.tds().delete_face(third);
    const std::array<Edge_with_mirror, 3> edges = {topology_.with_mirror(Edge(face, 0)),
                                                   topology_.with_mirror(Edge(face, 1)),
                                                   topology_.with_mirror(Edge(face, 2))};
    schedule_.schedule(edges, schedule_.current_time());
    put_hidden(hidden, std::span(&face, 1));
    return {face};
  }
}

// Removes the hidden points from faces that are about to change, and unschedules them.
template <class Traits>
auto Kinetic_types<Traits>::Updates::take_hidden(std::span<const Face_handle> faces,
                                                 Vertex_handle leaving)
    -> std::vector<Taken_point> {
  for (const Face_handle face : faces) {
    if (!face->vertex_list().empty()) schedule_.unschedule_hidden_in(face);
  }
  return topology_.take_hidden(faces, leaving);
}

// Puts each of them into the face that contains it, or else into the first one (in a periodic box
// into another one), and schedules it.
template <class Traits>
void Kinetic_types<Traits>::Updates::put_hidden(std::span<const Taken_point> hidden,
                                                std::span<const Face_handle> faces) {
  if (hidden.empty()) return;
  if constexpr (is_periodic) show_current_time();
  for (const Taken_point& taken : hidden) {
    const Vertex_handle v = taken.vertex;
    if constexpr (is_periodic) {
      hide_in(v, topology_.location_of(taken));
    } else {
      const auto around = std::ranges::find_if(
          faces, [&](Face_handle face) { return is_inside(v->point(), {face}); });
      hide_in(v, {around == faces.end() ? faces.front() : *around});
    }
    schedule_.schedule_hidden(v, schedule_.current_time());
  }
}

template <class Traits>
bool Kinetic_types<Traits>::Updates::is_inside(const Point_2& point, const Location& location,
                                               bool strictly) const {
  const Face_handle face = location.face;
  if (triangulation_.is_infinite(face)) return false;
  const Decisions decisions(certification_);
  const auto now = [this]() -> const auto& {
    return schedule_.current_time();
  };
  for (int i = 0; i < 3; ++i) {
    const Sign side = decisions.turn(
        topology_.corner(face, Triangulation::ccw(i)), topology_.corner(face, Triangulation::cw(i)),
        topology_.point_at(location, point), schedule_.current_bounds(), now);
    if (side == CGAL::NEGATIVE || (strictly && side == CGAL::ZERO)) return false;
  }
  return true;
}

// ---- reconstruction ----

template <class Traits>
auto Kinetic_types<Traits>::Updates::build_now(std::span<const Point_2> points,
                                               std::vector<Edge_ids>& coincident) const
    -> Triangulation {
  const auto& now = schedule_.current_time();
  return Kinetic_types<Traits>::Static_construction::build(
      points, now, certification_.traits().instantaneous_traits({now, Time_side::after}),
      coincident);
}

template <class Traits>
template <class Change_vertices>
void Kinetic_types<Traits>::Updates::rebuild(const Change_vertices& change_vertices,
                                             std::optional<Triangulation> rebuilt) {
  reporter_.start_noting();
  const std::vector<Edge_name> before = topology_.finite_edges();
  show_current_time();
  schedule_.defer();
  change_vertices();
  const std::vector<Point_2> points = topology_.points();
  std::vector<Edge_ids> coincident;
  if (!rebuilt) rebuilt = build_now(points, coincident);
  KINETRI_ASSERT(coincident.empty(), "vertices have different trajectories");
  topology_.adopt(std::move(*rebuilt), [this](Point_id hidden, bool was_hidden, bool is_hidden) {
    if (was_hidden != is_hidden) reporter_.note_hidden(hidden, is_hidden);
    reporter_.note_moved_hidden(hidden);
  });
  topology_.set_weights_equal(Topology::have_equal_weights(points));
  events_before_construction_ = events();
  const std::vector<Edge_name> after = topology_.finite_edges();
  const auto note_all = [this](const std::vector<Edge_name>& edges, int change) {
    for (const Edge_name& edge : edges) reporter_.note(edge, change);
  };
  if (reporter_.has_observers()) {  // which are told of edges whose triangles may have changed
    note_all(before, -1);
    note_all(after, 1);
  } else {
    std::vector<Edge_name> changed;
    std::ranges::set_difference(before, after, std::back_inserter(changed));
    note_all(std::exchange(changed, {}), -1);
    std::ranges::set_difference(after, before, std::back_inserter(changed));
    note_all(changed, 1);
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_UPDATES_IMPL_H
