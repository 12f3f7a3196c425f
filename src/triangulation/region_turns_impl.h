// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: turns, that is changes of motions at contacts.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_TURNS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_TURNS_IMPL_H

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

// ---- the parts of the queue of turns ----

// As gather_due, for turns. A window ends before the first change that is no contact.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::gather_due_turns(Lane& lane, double end) {
  Turn_part& part = turns_.queue().part(lane.number);
  const Time last(end);
  const auto exact = [&]() -> const Time& { return last; };
  while (!part.empty() && part.is_due(part.top(), {end, end}, exact)) {
    const Turn_entry entry = part.top();
    if (turns_.is_recheck(entry)) {
      part.pop();
      recheck_turn(lane, entry);
      continue;
    }
    turns_.queue().move_first(lane.number, due_part(lane.number));
    if (!turns_.is_contact(entry)) return std::min(end, entry.bounds.lower);
  }
  return end;
}

// Has certificates checked again until the first turn that a node may execute is known. Returns
// whether it is due.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::settle_turns(Lane& lane, const Time& last) {
  Turn_part& part = *lane.turn_part;
  const auto exact = [&]() -> const Time& { return last; };
  while (!part.empty() && part.is_due(part.top(), last.interval(), exact)) {
    if (!turns_.is_recheck(part.top())) return true;
    const Turn_entry entry = part.pop();
    recheck_turn(lane, entry);
  }
  return false;
}

// Whether the first turn of a node is before the first entry of its edges, if that is due.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_turn_first(Lane& lane, bool is_flip_due) {
  if (!is_flip_due) return true;
  const Entry& flip = lane.part->top();
  const Turn_entry& turn = lane.turn_part->top();
  if (turn.bounds.upper < flip.bounds.lower) return true;
  if (turn.bounds.lower > flip.bounds.upper) return false;
  return lane.turn_part->time(turn) < lane.part->time(flip);
}

// Leaves the first turn of a node to the node above.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::leave_turn(Lane& lane) {
  stall(lane, lane.turn_part->top());
  turns_.queue().move_first(lane.is_region() ? lane.number : due_part(lane.number),
                            deferred_part(lane.number));
}

// Notes that a turn waits for a node above. This saves undoing, and decides nothing.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::stall(Lane& lane, const Turn_entry& entry) {
  for (const Point_id id : turns_.points(entry)) {
    if (id == no_point) continue;
    stalls_[id] = std::min(stalls_[id], entry.bounds.lower);
    lane.stalled.push_back(id);
  }
}

template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_stalled(Point_id id, const Double_interval& bounds) const {
  return id < stalls_.size() && stalls_[id] <= bounds.upper;
}

// Schedules a turn, or when its certificate is checked again.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::put_turn(const Lane& lane, Turn_entry entry, Certificate&& known) {
  if (known.kind == Certificate::Kind::never_fails) return;
  entry.bounds = known.bounds;
  entry.time = Time_pool::none;
  entry.is_event = known.kind == Certificate::Kind::fails;
  const std::size_t to = lane.is_region()                   ? lane.number
                         : entry.bounds.lower <= due_until_ ? due_part(lane.number)
                                                            : turns_.part_of(entry);
  auto& part = turns_.queue().part(to);
  const Queue_handle handle =
      known.failure ? part.push(entry, std::move(*known.failure)) : part.emplace(entry);
  turns_.note(entry, turns_.queue().named(to, handle));
}

// Takes an entry out of the queue.
template <class Traits, class Turns>
auto Region_run<Traits, Turns>::take_turn_entry(Queue_handle handle) -> Turn_entry {
  const Turn_entry entry = turns_.queue().erase(handle);
  turns_.forget(entry);
  return entry;
}

// Takes the entries of points out of the queue, and calls `function` with each.
template <class Traits, class Turns>
template <class Function>
void Region_run<Traits, Turns>::take_turn_entries(Lane& lane, Points points,
                                                  const Function& function) {
  std::vector<Queue_handle>& handles = lane.buffers.handles;
  for (const Point_id id : points) {
    handles.clear();
    turns_.for_each_handle(id, [&](Queue_handle handle) { handles.push_back(handle); });
    for (const Queue_handle handle : handles) function(take_turn_entry(handle));
  }
}

// Certifies a contact anew whose entry, which says when, has left its part.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::recheck_turn(Lane& lane, const Turn_entry& entry) {
  turns_.forget(entry);
  auto [again, known] = turns_.certificate(entry, Time(entry.bounds.lower), lane.turn_certificates);
  put_turn(lane, again, std::move(known));
}

// ---- before a turn, or a flip ----

// Whether all neighbors of a point are in the node, so that it is not at the hull.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::owns_star(const Lane& lane, Point_id id) const {
  if (!owns(lane, id)) return false;
  bool result = true;
  for_each_face_at(triangulation_, topology_.vertex(id), [&](Face_handle face, int i) {
    result = result && owns(lane, face->vertex(Triangulation::ccw(i))->point().id());
  });
  return result;
}

// Whether an entry of a turn waits, in another part than `own`, that is not later.
template <class Traits, class Turns>
template <class Exact>
inline bool Region_run<Traits, Turns>::waits_before(Queue_handle turn, const Turn_part* own,
                                                    const Double_interval& bounds,
                                                    const Exact& exact) {
  const auto& turns = turns_.queue();
  if (turn == no_event || turn < turns.named(lanes_.size(), 0)) return false;
  const Turn_part& part = turns.part(turns.part_of_handle(turn));
  if (&part == own) return false;
  const Turn_entry& other = turns[turn];
  if (other.bounds.lower > bounds.upper) return false;
  return other.bounds.upper < bounds.lower || part.time_of(other) <= exact();
}

// Whether two discs that have touched in this window still do, and have to keep their edge.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::do_ends_meet(const Two_sided_edge& edge, Moment& moment) {
  if (!turns_.keep_edges()) return false;
  const auto [a, b] = Topology<Traits>::ids_of(edge.here);
  return a != no_point && b != no_point && (log_.has_turned(a) || log_.has_turned(b)) &&
         turns_.do_meet(a, b, log_.time(moment));
}

// Whether a turn that waits is before a flip and near it: of the edge's pair, or else of one of the
// four points.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_pair_blocked(Lane& lane, const Two_sided_edge& edge,
                                                const Entry& entry) {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  for (int k = 0; k < 3; ++k) {
    if (is_stalled(face->vertex(k)->point().id(), entry.bounds)) return true;
  }
  if (is_stalled(neighbor->vertex(j)->point().id(), entry.bounds)) return true;
  if (!turns_.has_pairs()) return false;
  const auto exact = [&]() -> const Time& { return lane.part->time(lane.part->top()); };
  return waits_before(turns_.handle(Topology<Traits>::ids_of(edge.here)), lane.turn_part,
                      entry.bounds, exact);
}

// Whether an entry in the surroundings of a turn waits and is not later than the turn, which is the
// first of the lane's part.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_turn_blocked(Lane& lane, Points points, Moment& moment) {
  const auto exact = [&]() -> const Time& { return log_.time(moment); };
  const auto is_blocked = [&](Face_handle face) {
    return waits_before(face, lane.part, moment.bounds, exact);
  };
  bool result = false;
  for (const Point_id id : points) {
    for_each_face_at(triangulation_, topology_.vertex(id), [&](Face_handle face, int i) {
      const Point_id neighbor = face->vertex(Triangulation::ccw(i))->point().id();
      result = result || is_blocked(face) || is_blocked(face->neighbor(i)) ||
               (std::ranges::find(points, neighbor) == points.end() &&
                is_stalled(neighbor, moment.bounds));
    });
    turns_.for_each_handle(id, [&](Queue_handle handle) {
      result = result || waits_before(handle, lane.turn_part, moment.bounds, exact);
    });
  }
  return result;
}

// Undoes what is later than the moment in the surroundings of points.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::undo_later_around(Lane& lane, Points points, Moment& moment) {
  const auto find_later = [&] {
    Stamp later = 0;
    const auto look_at = [&](Face_handle face) {
      if (later == 0 && log_.is_later(face->stamp(), moment)) later = face->stamp();
    };
    for (const Point_id id : points) {
      for_each_face_at(triangulation_, topology_.vertex(id), [&](Face_handle face, int i) {
        look_at(face);
        look_at(face->neighbor(i));
      });
    }
    return later;
  };
  // Others may be around them then.
  for (Stamp later = find_later(); later != 0; later = find_later()) undo(lane, later);
}

// ---- a turn ----

// Executes the first turn of a node, or leaves it to the node above. The root cuts the window where
// that is for the plain loop; returns false then.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::execute_turn(Lane& lane) {
  const Turn_entry entry = lane.turn_part->top();
  const Time& time = lane.turn_part->time(lane.turn_part->top());
  Moment moment = {{}, time.interval(), time};
  if (turns_.is_contact(entry) && lane.log->flips.size() < lane.capacity &&
      turn(lane, entry, moment)) {
    return true;
  }
  if (!is_root(lane)) {
    leave_turn(lane);
    return true;
  }
  cut_ = *moment.exact;
  return false;
}

// Executes a turn, the first one of the node. Returns false, with the triangulation as it was,
// where a node above is to do it.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::turn(Lane& lane, const Turn_entry& entry, Moment& moment) {
  auto made = std::make_unique<Turn>();
  made->points = turns_.points(entry);
  const Points points = Points(made->points).first(made->points[1] == no_point ? 1 : 2);
  if (std::ranges::any_of(points, [this](Point_id id) { return topology_.is_hidden(id); })) {
    return false;
  }
  if (!is_root(lane)) {
    for (const Point_id id : points) {
      if (!owns_star(lane, id)) return false;
    }
    if (is_turn_blocked(lane, points, moment)) return false;
  }
  if (!lane.is_region()) undo_later_around(lane, points, moment);
  if (do_faces_hide_points(points)) return false;
  const auto changes = turns_.changes(entry, *moment.exact);
  if (changes.empty()) return false;
  Turn& turn = *made;
  try {
    if (set_points(turn, changes, moment) &&
        certify_turn(lane, turn, turn.turned_points(), moment)) {
      record_turn(lane, entry, std::move(made), moment);
      return true;
    }
  } catch (...) {
    log_.set_motions(turn, false);
    throw;
  }
  log_.set_motions(turn, false);
  return false;
}

template <class Traits, class Turns>
bool Region_run<Traits, Turns>::do_faces_hide_points(Points points) const {
  if (topology_.number_of_hidden_points() == 0) return false;
  bool result = false;
  for_each_face_around(points, [&](Face_handle face) { result = result || hides_points(face); });
  return result;
}

// Whether weights that were the same at all times no longer are when a point gets another motion.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::ends_equal_weights(const Point_2& before,
                                                   const Point_2& after) const {
  if constexpr (Types::is_weighted) {
    return topology_.are_weights_equal() && !have_equal_weights(before.motion(), after.motion());
  }
  return false;
}

// Gives points their new motions, if their triangles stay embedded.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::set_points(Turn& turn, std::span<const Change> changes,
                                           Moment& moment) {
  using Instantaneous = typename Types::Instantaneous_traits;
  std::optional<Instantaneous> instant;
  const auto is_left_turn = [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
    if (!instant) {
      instant.emplace(
          certification_.traits().instantaneous_traits({*moment.exact, Time_side::after}));
    }
    return instant->orientation_2_object()(a->point(), b->point(), c->point()) == CGAL::LEFT_TURN;
  };
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const Point_id id = changes[k].point;
    const Vertex_handle v = topology_.vertex(id);
    turn.turned[k] = id;
    turn.before[k] = v->point();
    v->set_point(Point_2(*changes[k].motion, id));
    turn.after[k] = v->point();
    if (ends_equal_weights(turn.before[k], turn.after[k]) ||
        !certification_.is_embedded_around(v, moment.bounds, is_left_turn)) {
      return false;
    }
  }
  return true;
}

// Makes the certificates of points that have turned, in the lane's buffers. Returns false if one
// fails at once, or if discs overlap that have not just touched.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::certify_turn(Lane& lane, const Turn& turn, Points turned,
                                             Moment& moment) {
  Buffers& made = lane.buffers;
  made.edge_certificates.clear();
  made.turn_certificates.clear();
  const Time& now = *moment.exact;
  bool fails_now = false;
  const auto look_at = [&](const Certificate& known) {
    fails_now = fails_now || fails_at(known, moment);
  };
  certification_.certify(edges_around(lane, turned), now, Certificate_state::any, lane.certificates,
                         [&](const Two_sided_edge& edge, Entry_kind kind, Certificate&& known) {
                           look_at(known);
                           made.edge_certificates.emplace_back(edge, kind, std::move(known));
                         });
  if (fails_now ||
      !turns_.certify(turn.points, turned, now, lane.turn_certificates, made.turn_certificates)) {
    return false;
  }
  for (const auto& [entry, known] : made.turn_certificates) look_at(known);
  return !fails_now;
}

// Executes a turn whose certificates have been made.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::record_turn(Lane& lane, const Turn_entry& entry,
                                            std::unique_ptr<Turn>&& made, const Moment& moment) {
  Turn* const turn = made.get();
  const Points turned = turn->turned_points();
  const Stamp number = log_.add_turn(*lane.log, std::move(made), moment, turns_.event_kind(entry));
  std::size_t faces = 0;
  for_each_face_around(turned, [&](Face_handle /*face*/) { ++faces; });
  turn->faces.reserve(faces);
  for_each_face_around(turned, [&](Face_handle face) {
    turn->faces.push_back({face, face->stamp()});
    face->set_stamp(number);
  });
  // The entries leave the queue while the motions that they speak of are there: those that stay are
  // compared.
  log_.set_motions(*turn, false);
  take_turn_entries(lane, turned, [&](const Turn_entry& taken) {
    if (!turns_.are_same(taken, entry)) lane.discarded_turns.count(taken);
  });
  for (const auto& [edge, kind, known] : lane.buffers.edge_certificates) {
    discard(lane, edge.here.first->event(edge.here.second));
  }
  log_.set_motions(*turn, true);
  for (auto& [edge, kind, known] : lane.buffers.edge_certificates) {
    put(lane, edge, kind, std::move(known));
  }
  for (auto& [turn_entry, known] : lane.buffers.turn_certificates) {
    put_turn(lane, turn_entry, std::move(known));
  }
  log_.note_turn(*turn, number);
  for (const Point_id id : turn->points) {
    if (id != no_point) stalls_[id] = std::numeric_limits<double>::infinity();
  }
}

// Calls `function` with each face at the points, which are one or two.
template <class Traits, class Turns>
template <class Function>
void Region_run<Traits, Turns>::for_each_face_around(Points points,
                                                     const Function& function) const {
  const Vertex_handle first = topology_.vertex(points.front());
  for_each_face_at(triangulation_, first, [&](Face_handle face) { function(face); });
  if (points.size() == 1) return;
  for_each_face_at(triangulation_, topology_.vertex(points.back()), [&](Face_handle face) {
    if (!face->has_vertex(first)) function(face);
  });
}

// The edges of the faces at the points, each once, in a buffer of the lane.
template <class Traits, class Turns>
auto Region_run<Traits, Turns>::edges_around(Lane& lane, Points points) const
    -> std::span<const Two_sided_edge> {
  std::vector<Two_sided_edge>& result = lane.buffers.edges;
  result.clear();
  const Vertex_handle first = topology_.vertex(points.front());
  const auto add = [&](Vertex_handle v, const auto& is_known) {
    for_each_face_at(triangulation_, v, [&](Face_handle face, int at) {
      for (const int i : {at, Triangulation::cw(at)}) {
        const Two_sided_edge edge = topology_.two_sided(Edge(face, i));
        if (!is_known(edge)) result.push_back(edge);
      }
    });
  };
  add(first, [](const Two_sided_edge&) { return false; });
  if (points.size() == 2) {
    // Those of a face at the first point have been added.
    add(topology_.vertex(points.back()), [&](const Two_sided_edge& edge) {
      return edge.here.first->has_vertex(first) || edge.there.first->has_vertex(first);
    });
  }
  return result;
}

// Undoes a turn that is the last one of its faces.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::undo_turn(Lane& lane, Flip& flip, const Time& now) {
  const Turn& turn = *flip.turn;
  const Points points = turn.turned_points();
  const std::span<const Two_sided_edge> edges = edges_around(lane, points);
  for (const Two_sided_edge& edge : edges) {
    const Queue_handle handle = edge.here.first->event(edge.here.second);
    if (handle != no_event) queue().erase(handle);
  }
  take_turn_entries(lane, points, [](const Turn_entry&) {});
  log_.roll_back(flip);
  log_.forget_turn(turn);
  certify_again(lane, edges);
  turns_.for_each_contact(points, now, lane.turn_certificates,
                          [&](const Turn_entry& entry, Certificate&& known) {
                            put_turn(lane, entry, std::move(known));
                          });
}

// ---- a flip, and the contacts of its edges ----

// Schedules the contact of the edge that a flip has added, in place of the one removed.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::follow_flip(Lane& lane, const Flip& flip, Moment& moment) {
  if (!turns_.has_pairs()) return;
  const auto& [right, left, corner, opposite] = flip.corners;
  if (right != no_point && left != no_point) {
    const Queue_handle handle = turns_.handle(edge_ids(right, left));
    if (handle != no_event) lane.discarded_turns.count(take_turn_entry(handle));
  }
  if (corner == no_point || opposite == no_point) return;
  const Turn_entry pair = turns_.pair(edge_ids(corner, opposite));
  // A little before the flip, the two do not touch: else they would have been watched.
  auto [entry, known] = turns_.certificate(pair, Time(moment.bounds.lower), lane.turn_certificates);
  if (known.may_vanish ||
      (known.kind != Certificate::Kind::never_fails && known.bounds.lower <= moment.bounds.upper)) {
    known = turns_.certificate(pair, log_.time(moment), lane.turn_certificates).second;
  }
  put_turn(lane, entry, std::move(known));
}

// The other way round, for a flip that is undone, at the time `now`. A contact at that time is seen
// from that time on.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::unfollow_flip(Lane& lane, const Flip& flip, const Time& now) {
  if (!turns_.has_pairs()) return;
  const auto& [right, left, corner, opposite] = flip.corners;
  if (corner != no_point && opposite != no_point) {
    const Queue_handle handle = turns_.handle(edge_ids(corner, opposite));
    if (handle != no_event) take_turn_entry(handle);
  }
  if (right == no_point || left == no_point) return;
  auto [entry, known] =
      turns_.certificate(turns_.pair(edge_ids(right, left)), now, lane.turn_certificates);
  put_turn(lane, entry, std::move(known));
}

// What observers are told of a turn, but for its number and time.
template <class Traits, class Turns>
Event Region_run<Traits, Turns>::turn_event(const Key& key) {
  Event event;
  event.kind = key.kind;
  if constexpr (has_turns) {
    const auto& [a, b] = log_.flip(key).turn->points;
    event.point_a = a;
    if (b != no_point) event.point_b = b;
  }
  return event;
}

// Notes what the turns of a window leave to the plain loop, and forgets the turns.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::settle_turns_of_window() {
  for (const Key& key : log_.order()) {
    if (Log::is_turn(key)) turns_.end_turn(log_.flip(key).turn->points);
  }
  log_.end_turns();
  for (Lane& lane : lanes_) {
    for (const Point_id id : lane.stalled) stalls_[id] = std::numeric_limits<double>::infinity();
    lane.stalled.clear();
    turns_.count(std::exchange(lane.turn_certificates, {}));
    turns_.count(std::exchange(lane.discarded_turns, {}));
  }
  turns_.end_window();
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_TURNS_IMPL_H
