// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: erasures, that is turns after which points are no longer there.
//
// The root executes them, since CGAL's containers know one thread. CGAL fills the hole that a point
// leaves with some of the faces that were at it, and frees the others. No other event of a window
// takes or frees a face. So the free faces are in the order of the plain loop, and in that of
// before where the last erasure is undone first. The vertex stays, without faces, until observers
// are told, who may ask for its motion before.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_ERASURES_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_ERASURES_IMPL_H

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

// Executes a turn of the root that erases points. Returns false, with the triangulation as it was,
// where that is for the plain loop: at the hull, and where a certificate fails at once.
template <class Kinetic, class Turns>
bool Region_run<Kinetic, Turns>::erase(Lane& lane, const Turn_entry& entry,
                                       std::span<const Change> changes,
                                       std::unique_ptr<Turn>&& made, Moment& moment) {
  Turn& turn = *made;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    turn.turned[k] = changes[k].point;
    turn.before[k] = turn.after[k] = kinetic_.vertices_[changes[k].point]->point();
  }
  const Points points = turned(turn);
  bool is_at_hull = false;
  for_each_face_around(points, [&](Face_handle face) {
    is_at_hull = is_at_hull || kinetic_.triangulation_.is_infinite(face);
  });
  if (is_at_hull) return false;
  undo_later_at_neighbors(lane, points, moment);
  turn.hole = std::make_unique<Hole>();
  remember(*turn.hole, points);
  const Stamp number = add_record(lane, entry, std::move(made), moment);
  for (const Face_before& before : turn.hole->faces) before.face->set_stamp(number);
  for_each_edge_of(turn.hole->faces, number, [&](const Two_sided_edge& edge) {
    discard(lane, edge.here.first->event(edge.here.second));
    kinetic_.set_event(edge, no_event);
  });
  take_turn_entries(lane, points, [&](const Turn_entry& taken) {
    if (!turns_.are_same(taken, entry)) lane.discarded_turns.count(taken);
  });
  note_turn(turn, number);
  turn.hole->edges = make_hole(points, moment);
  find_written_faces(turn, number);
  if (certify_hole(lane, turn, number, moment)) return true;
  undo_last(lane, number);
  return false;
}

// Undoes what is later than the moment and has set the face that CGAL keeps at a neighbor of the
// points: CGAL keeps another one there when they leave.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::undo_later_at_neighbors(Lane& lane, Points points,
                                                         Moment& moment) {
  std::vector<Vertex_handle> vertices;
  for_each_face_around(points, [&](Face_handle face) {
    for (int i = 0; i < 3; ++i) vertices.push_back(face->vertex(i));
  });
  for (const Vertex_handle v : vertices) {
    while (is_later(v->face()->stamp(), moment)) undo(lane, v->face()->stamp());
  }
}

// Notes the faces at the points, and what is to be put back where the points come back.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::remember(Hole& hole, Points points) const {
  hole.number_of_faces = kinetic_.triangulation_.tds().faces().size();
  for_each_face_around(points, [&](Face_handle face) {
    hole.faces.push_back({face,
                          {face->vertex(0), face->vertex(1), face->vertex(2)},
                          {face->neighbor(0), face->neighbor(1), face->neighbor(2)},
                          face->stamp()});
  });
  for (const Face_before& before : hole.faces) {
    for (int i = 0; i < 3; ++i) {
      const Edge beyond = kinetic_.two_sided(Edge(before.face, i)).there;
      if (!is_among(hole.faces, beyond.first)) hole.link.push_back({beyond, before.face});
      const Vertex_handle v = before.face->vertex(i);
      hole.vertices.emplace_back(v, v->face());
    }
  }
}

// Takes the points out of their faces, one after the other, at the instant after the moment.
// Returns the edges that have changed.
template <class Kinetic, class Turns>
auto Region_run<Kinetic, Turns>::make_hole(Points points, Moment& moment)
    -> std::vector<Edge_changes::Change> {
  kinetic_.rebuilt_edges_.emplace();
  const auto take_out = [&] {
    kinetic_.show_current_time();
    std::vector<Face_handle> faces;
    for (const Point_id id : points) {
      // None has an entry yet: the next point may take some of them away.
      for (const Two_sided_edge& edge : kinetic_.remove_from_faces(kinetic_.vertices_[id], faces)) {
        kinetic_.set_event(edge, no_event);
      }
    }
    return kinetic_.rebuilt_edges_->take();
  };
  try {
    auto result = at(time(moment), take_out);
    kinetic_.rebuilt_edges_.reset();
    kinetic_.show_current_time();
    return result;
  } catch (...) {
    kinetic_.rebuilt_edges_.reset();
    kinetic_.show_current_time();
    throw;
  }
}

// Stamps the faces that fill the hole.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::find_written_faces(Turn& turn, Stamp number) {
  const Hole& hole = *turn.hole;
  const auto add = [&](Face_handle face) {
    const auto before = std::ranges::find(hole.faces, face, &Face_before::face);
    KINETRI_ASSERT(before != hole.faces.end(), "CGAL fills a hole with faces that it has freed");
    turn.faces.push_back({face, before->stamp});
    face->set_stamp(number);
  };
  const auto is_beyond = [&](Face_handle face) {
    const auto is_its_edge = [&](const Link& link) { return link.beyond.first == face; };
    return std::ranges::any_of(hole.link, is_its_edge);
  };
  add(kinetic_.two_sided(hole.link.front().beyond).there.first);
  for (std::size_t k = 0; k < turn.faces.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      const Face_handle face = turn.faces[k].face->neighbor(i);
      if (!is_beyond(face) && !is_among(turn.faces, face)) add(face);
    }
  }
}

// Calls `function` once with each edge of faces, which have this stamp, and no others have it.
template <class Kinetic, class Turns>
template <class Faces, class Function>
void Region_run<Kinetic, Turns>::for_each_edge_of(const Faces& faces, Stamp number,
                                                  const Function& function) const {
  for (const auto& known : faces) {
    const Face_handle face = known.face;
    for (int i = 0; i < 3; ++i) {
      const Face_handle beside = face->neighbor(i);
      if (beside->stamp() != number || face < beside) function(kinetic_.two_sided(Edge(face, i)));
    }
  }
}

// Schedules the edges around and in the hole, and the contacts of those that are new. Returns false
// if a certificate fails at once, or if discs meet.
template <class Kinetic, class Turns>
bool Region_run<Kinetic, Turns>::certify_hole(Lane& lane, const Turn& turn, Stamp number,
                                              Moment& moment) {
  const Time& now = time(moment);
  bool may_stay = true;
  const auto look_at = [&](const Certificate& known) {
    may_stay = may_stay && !fails_at(known, moment);
  };
  std::vector<Two_sided_edge>& edges = lane.buffers.edges;
  edges.clear();
  for_each_edge_of(turn.faces, number, [&](const Two_sided_edge& edge) { edges.push_back(edge); });
  kinetic_.certify(edges, now, Certificate_state::any, kinetic_.traits_, lane.certificates,
                   [&](const Two_sided_edge& edge, Entry_kind kind, Certificate&& known) {
                     look_at(known);
                     put(lane, edge, kind, std::move(known));
                   });
  for (const auto& [edge, net] : turn.hole->edges) {
    if (net <= 0) continue;
    auto [entry, known] = turns_.certificate(turns_.pair(edge), now, lane.turn_certificates);
    look_at(known);
    may_stay = may_stay && !(known.may_vanish && turns_.do_meet(edge[0], edge[1], now));
    put_turn(lane, entry, std::move(known));
  }
  return may_stay;
}

// Takes the entries out of the queue that have come with an erasure.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::leave_hole(const Turn& turn) {
  const Stamp number = turn.faces.front().face->stamp();
  for_each_edge_of(turn.faces, number, [&](const Two_sided_edge& edge) {
    const Queue_handle handle = edge.here.first->event(edge.here.second);
    if (handle != no_event) queue().erase(handle);
  });
  for (const auto& [edge, net] : turn.hole->edges) {
    const Queue_handle handle = net > 0 ? turns_.handle(edge) : no_event;
    if (handle != no_event) take_turn_entry(handle);
  }
}

// Makes the faces what they were before an erasure, also one that has been made in part. Takes no
// memory: CGAL gives the faces that it has freed last.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::close_hole(const Hole& hole) {
  auto& tds = kinetic_.triangulation_.tds();
  while (tds.faces().size() < hole.number_of_faces) tds.create_face();
  for (const Face_before& before : hole.faces) {
    const auto& [a, b, c] = before.vertices;
    before.face->set_vertices(a, b, c);
    before.face->set_neighbors(before.neighbors[0], before.neighbors[1], before.neighbors[2]);
    before.face->set_stamp(before.stamp);
  }
  for (const auto& [beyond, face] : hole.link) beyond.first->set_neighbor(beyond.second, face);
  for (const auto& [vertex, face] : hole.vertices) vertex->set_face(face);
}

// Deletes the vertices of points that a turn has erased, if it has and they are still there.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::delete_vertices(const Turn& turn) {
  if (turn.hole == nullptr) return;
  for (const Point_id id : turned(turn)) kinetic_.set_point({id, std::nullopt});
}

// Tells observers of the edges that a turn has changed, as each change of points does: an erasure
// has some, which are events too, the first of this number.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::report_edges(std::span<const Edge_changes::Change> edges,
                                              std::uint64_t number) {
  for (const int change : {-1, 1}) {
    for (const auto& [edge, net] : edges) {
      if (net != change) continue;
      Event event;
      event.kind = Event_kind::rebuild;
      (change < 0 ? event.removed : event.added) = edge;
      tell(event, number++, [] {});
    }
  }
  std::vector<Edge_ids> touched;
  for (const auto& [edge, net] : edges) touched.push_back(edge);
  kinetic_.observers_.call([&](Event_observer& observer) {
    if (is_told(observer)) observer.after_rebuild(kinetic_.current_time(), touched);
  });
}

// Counts the event of a key, and those of the edges that it has changed if it is an erasure.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::count(const Key& key) {
  kinetic_.count_event(key.kind);
  if constexpr (has_turns) {
    if (!is_turn(key) || flip(key).turn->hole == nullptr) return;
    for (const auto& [edge, net] : flip(key).turn->hole->edges) {
      if (net != 0) kinetic_.count_event(Event_kind::rebuild);
    }
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_ERASURES_IMPL_H
