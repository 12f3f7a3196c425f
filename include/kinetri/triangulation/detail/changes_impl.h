// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2: changes of single points at the present time,
// and how a vertex leaves the triangulation and comes back. The edges that a change leaves violated
// have their events at the present time, and are flipped by these (docs/MATH.md, section 5).
#ifndef KINETRI_TRIANGULATION_DETAIL_CHANGES_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_CHANGES_IMPL_H

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/incident.h"
#include "kinetri/triangulation/detail/point_problems.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

// ---- changes ----

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  const Change change = {id, motion};
  apply(Event_kind::trajectory, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::erase(Point_id id) {
  const Change change = {id, std::nullopt};
  apply(Event_kind::erase, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::apply(Event_kind kind,
                                                     std::optional<Point_id> point_a,
                                                     std::optional<Point_id> point_b,
                                                     std::span<const Change> changes) {
  for (const auto& [id, motion] : changes) {
    KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
    KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  }
  const auto moved_point = [](const Change& change) {
    return Point_2(*change.motion, change.point);
  };
  const auto stays = [&](const Change& change) {
    return change.motion && stays_in_place(vertices_[change.point], moved_point(change));
  };
  // What is refused is refused before anything is reported.
  const bool first_stays = !changes.empty() && stays(changes.front());
  if (!first_stays && !changes.empty() && changes.front().motion) {
    check_is_distinct(moved_point(changes.front()), vertices_[changes.front().point]->face());
  }
  Event event;
  event.kind = kind;
  event.point_a = point_a;
  event.point_b = point_b;
  std::exception_ptr failure;
  perform(std::move(event), [&] {
    // Points that stay in the triangles around them are moved together. What takes a vertex out
    // needs a triangulation that is Delaunay.
    std::vector<Vertex_handle> moved;
    const auto restore = [&] {
      for (const Vertex_handle v : moved) schedule_around(v);
      moved.clear();
      execute_due_events();
    };
    try {
      for (const Change& change : changes) {
        const Vertex_handle v = vertices_[change.point];
        if (&change == &changes.front() ? first_stays : stays(change)) {
          unschedule_around(v);
          v->set_point(moved_point(change));
          moved.push_back(v);
          continue;
        }
        restore();
        change.motion ? relocate(v, moved_point(change)) : remove_point(v);
      }
    } catch (const Coincident_trajectories_error&) {
      failure = std::current_exception();
    }
    restore();
  });
  if (failure) std::rethrow_exception(failure);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_delaunay_triangulation_2<Traits>::reserve_id() {
  KINETRI_PRECONDITION(vertices_.size() + 1 < no_point, detail::too_many_points);
  vertices_.emplace_back();
  return static_cast<Point_id>(vertices_.size() - 1);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_delaunay_triangulation_2<Traits>::insert(const Motion& motion) {
  const Point_id id = reserve_id();
  try {
    insert(motion, id);
  } catch (const Error&) {
    vertices_.pop_back();
    throw;
  }
  return id;
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::insert(const Motion& motion, Point_id id) {
  KINETRI_PRECONDITION(id < vertices_.size() && !contains(id),
                       "the id " + std::to_string(id) +
                           " is not one that waits for its point; take one that reserve_id gives");
  KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(id));
  const Point_2 point(motion, id);
  std::optional<Location> location;
  if (triangulation_.dimension() == 2) {
    location = find_location(point, Face_handle());
  } else {
    check_is_distinct(point, Face_handle());
  }
  const Vertex_handle v = triangulation_.tds().create_vertex();
  v->set_point(point);
  Event event;
  event.kind = Event_kind::insert;
  event.point_a = id;
  perform(std::move(event), [&] {
    const auto add = [&] {
      vertices_[id] = v;
      ++number_of_points_;
    };
    if (!location) return rebuild(add);
    add();
    put_in(v, *location);
  });
}

// Reports `event` around `change_points` and the flips that this makes necessary, then the edges
// that have changed.
template <KineticTraits_2 Traits>
template <class Change_points>
void Kinetic_delaunay_triangulation_2<Traits>::perform(Event event, Change_points change_points) {
  report(std::move(event), [&] {
    rebuilt_edges_.emplace();
    change_points();
    execute_due_events();
  });
  report_rebuild();
}

// Whether the vertex, moved, still sees the triangles around it as they are, so that only
// certificates change.
template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::stays_in_place(Vertex_handle v,
                                                              const Point_2& moved) const {
  if (triangulation_.dimension() < 2) return false;
  const Point_2 before = v->point();
  v->set_point(moved);
  const bool result = is_embedded_around(v);
  v->set_point(before);
  return result;
}

// Moves a vertex, wherever that leads: takes it out and puts it in again.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::relocate(Vertex_handle v, const Point_2& moved) {
  check_is_distinct(moved, v->face());
  if (triangulation_.dimension() < 2 || triangulation_.test_dim_down(v)) {
    return rebuild([&] { v->set_point(moved); });
  }
  const Vertex_handle neighbor = v->face()->vertex(Triangulation::ccw(v->face()->index(v)));
  take_out(v);
  v->set_point(moved);
  put_in(v, find_location(moved, neighbor->face()));
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::remove_point(Vertex_handle v) {
  const auto forget = [&] {
    vertices_[v->point().id()] = Vertex_handle();
    --number_of_points_;
    triangulation_.tds().delete_vertex(v);
  };
  if (triangulation_.dimension() < 2 || triangulation_.test_dim_down(v)) return rebuild(forget);
  take_out(v);
  forget();
}

// Whether the triangles at `v` make left turns, and the hull is strictly convex at `v` and at its
// neighbors. Then `v`, which has moved, has left the triangulation properly embedded: the angles at
// an inner vertex add up to what they were, namely once around; a hull vertex sees its neighbors
// within less than half of that. Sufficient, not necessary.
template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::is_embedded_around(Vertex_handle v) const {
  const auto orientation = triangulation_.geom_traits().orientation_2_object();
  const auto is_left_turn = [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
    return orientation(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
  };
  Vertex_handle previous;  // hull neighbors, if v is on the hull
  Vertex_handle next;
  Vertex_handle before_previous;
  Vertex_handle after_next;
  auto face = triangulation_.incident_faces(v);
  const auto first = face;
  do {
    const int i = face->index(v);
    const Vertex_handle right = face->vertex(Triangulation::ccw(i));
    const Vertex_handle left = face->vertex(Triangulation::cw(i));
    const auto beyond = [&] { return triangulation_.tds().mirror_vertex(face, i); };
    if (triangulation_.is_infinite(left)) {
      previous = right;
      before_previous = beyond();
    } else if (triangulation_.is_infinite(right)) {
      next = left;
      after_next = beyond();
    } else if (!is_left_turn(v, right, left)) {
      return false;
    }
  } while (++face != first);
  if (previous == Vertex_handle()) return true;
  if (!is_left_turn(before_previous, previous, v) || !is_left_turn(v, next, after_next)) {
    return false;
  }
  bool is_embedded = true;
  detail::for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
    is_embedded = is_embedded && (u == next || is_left_turn(v, next, u)) &&
                  (u == previous || is_left_turn(v, u, previous));
  });
  return is_embedded;
}

// Throws if another point has the trajectory of `point`: is in one place with it just after now.
// Searched from `start`, or from anywhere.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::check_is_distinct(const Point_2& point,
                                                                 Face_handle start) const {
  if (triangulation_.dimension() == 2) {
    find_location(point, start);
    return;
  }
  const Instantaneous_traits& now = triangulation_.geom_traits();
  for (const Vertex_handle v : triangulation_.finite_vertex_handles()) {
    if (v->point().id() == point.id()) continue;
    if (now.compare_x_2_object()(v->point(), point) == CGAL::EQUAL &&
        now.compare_y_2_object()(v->point(), point) == CGAL::EQUAL) {
      throw Coincident_trajectories_error(std::min(v->point().id(), point.id()),
                                          std::max(v->point().id(), point.id()));
    }
  }
}

// Where the point stands just after now, searched from `start`, or from anywhere. Throws if that is
// the place of another point. Precondition: dimension 2.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::find_location(const Point_2& point,
                                                             Face_handle start) const -> Location {
  using Locus = typename Triangulation::Locate_type;
  Locus locus;
  int i = 0;
  const Face_handle face = triangulation_.locate(point, locus, i, start);
  if (locus == Triangulation::VERTEX && face->vertex(i)->point().id() != point.id()) {
    const Point_id other = face->vertex(i)->point().id();
    throw Coincident_trajectories_error(std::min(point.id(), other), std::max(point.id(), other));
  }
  return {face, locus == Triangulation::EDGE, i};
}

// ---- a vertex leaves and comes back ----

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

#endif  // KINETRI_TRIANGULATION_DETAIL_CHANGES_IMPL_H
