// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: one flip, and how it is undone.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_FLIPS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_FLIPS_IMPL_H

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

template <class Traits, class Turns>
auto Region_run<Traits, Turns>::moment_of(const Entry& entry, const Two_sided_edge& edge,
                                          const Part& part) const -> Moment {
  Moment result{certification_.points(edge), entry.bounds, std::nullopt};
  if (entry.time != Time_pool::none) result.exact = part.time_of(entry);
  return result;
}

// ---- before a flip ----

// Whether all four vertices are in the node, of whose entries this is one.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_owned(const Lane& lane, const Two_sided_edge& edge) const {
  // So the ends of the edge are in the node.
  const auto owns_corner = [&](const Edge& side) {
    return owns(lane, side.first->vertex(side.second)->point().id());
  };
  return owns_corner(edge.here) && owns_corner(edge.there);
}

// Whether another entry in the surroundings waits and is not later than this one, which is the
// first of the lane's part. (Entries of that part come after this one, those of nodes' parts after
// the window. What waits there was deferred by this node, or is due in a node above.)
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_blocked(Lane& lane, const Entry& entry,
                                           const Two_sided_edge& edge) {
  const auto exact = [&]() -> const Time& { return lane.part->time(lane.part->top()); };
  const auto is_face_blocked = [&](Face_handle face) {
    return waits_before(face, lane.part, entry.bounds, exact);
  };
  for (const Edge& side : {edge.here, edge.there}) {
    const auto& [face, i] = side;
    if (is_face_blocked(face) || is_face_blocked(face->neighbor(Triangulation::cw(i))) ||
        is_face_blocked(face->neighbor(Triangulation::ccw(i)))) {
      return true;
    }
  }
  if constexpr (has_turns) return is_pair_blocked(lane, edge, entry);
  return false;
}

// Whether an entry at an edge of a face waits, in another part than `own`, that is not later than
// what has these bounds, and the time exact().
template <class Traits, class Turns>
template <class Exact>
inline bool Region_run<Traits, Turns>::waits_before(Face_handle face, const Part* own,
                                                    const Double_interval& bounds,
                                                    const Exact& exact) {
  const Queue_handle first_stall = queue().named(lanes_.size(), 0);
  const auto is_stall = [&](Queue_handle handle) {
    return static_cast<Queue_handle>(handle - first_stall) < no_event - first_stall;
  };
  if (!is_stall(face->event(0)) && !is_stall(face->event(1)) && !is_stall(face->event(2))) {
    return false;
  }
  const auto waits = [&](Queue_handle handle) {
    if (!is_stall(handle)) return false;
    const Part& part = queue().part(queue().part_of_handle(handle));
    if (&part == own) return false;
    const Entry& other = queue()[handle];
    if (other.bounds.lower > bounds.upper) return false;
    return other.bounds.upper < bounds.lower || part.time_of(other) <= exact();
  };
  return waits(face->event(0)) || waits(face->event(1)) || waits(face->event(2));
}

// Whether the plain loop flips the edge of an entry that is no coincidence, and does nothing else:
// of points with weights some are hidden instead, and of the flat triangles at the hull some only
// touch it, and some take a reconstruction; see Decisions.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_flip(const Entry& entry, const Two_sided_edge& edge,
                                        Moment& moment) {
  if (hides_points(edge.here.first) || hides_points(edge.there.first)) return false;
  if constexpr (has_turns) {
    if (do_ends_meet(edge, moment)) return false;
  }
  if (entry.kind == Entry_kind::flip) {
    const bool may_touch =
        Types::is_weighted && !topology_.are_weights_equal() && !entry.changes_sign;
    return !may_touch && is_convex(edge, moment);
  }
  const auto now = [&]() -> const Time& { return log_.time(moment); };
  return Decisions<Traits>(certification_).decide(entry, edge, moment.bounds, now).action ==
         Action::flip;
}

template <class Traits, class Turns>
bool Region_run<Traits, Turns>::hides_points(Face_handle face) {
  if constexpr (Types::is_weighted) return !face->vertex_list().empty();
  return false;
}

// Whether the quadrilateral of an edge is certainly strictly convex just before and just after its
// in-circle certificate fails. Without weights it always is.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_convex(const Two_sided_edge& edge, const Moment& moment) const {
  if constexpr (Types::is_weighted) {
    if (topology_.are_weights_equal()) return true;
    const auto is_left_turn = [&](const Point_2& p, const Point_2& q, const Point_2& r) {
      return certification_.traits().certain_turn(p, q, r, moment.bounds) == CGAL::LEFT_TURN;
    };
    const auto& [face, i] = edge.here;
    const Point_2& p = face->vertex(Triangulation::cw(i))->point();
    const Point_2& q = face->vertex(Triangulation::ccw(i))->point();
    const Point_2& r = face->vertex(i)->point();
    const Point_2& s = edge.there.first->vertex(edge.there.second)->point();
    return is_left_turn(s, p, r) && is_left_turn(r, q, s);
  }
  return true;
}

// Undoes the flips in the surroundings of an edge that are later than the moment.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::undo_later(Lane& lane, const Two_sided_edge& edge, Moment& moment) {
  for (const Edge& side : {edge.here, edge.there}) {
    const auto& [face, i] = side;
    KINETRI_ASSERT(!log_.is_later(face->stamp(), moment),
                   "a flip at a face whose edge has an entry before it");
    for (const int k : {Triangulation::cw(i), Triangulation::ccw(i)}) {
      // Another face may be beside it then.
      while (log_.is_later(face->neighbor(k)->stamp(), moment)) {
        undo(lane, face->neighbor(k)->stamp());
      }
    }
  }
}

// ---- a flip ----

// Schedules an edge: a union of regions does it in the part that it executes, or where the entry
// belongs between two windows.
template <class Traits, class Turns>
KINETRI_ALWAYS_INLINE void Region_run<Traits, Turns>::put(const Lane& lane,
                                                          const Two_sided_edge& edge,
                                                          Entry_kind kind, Certificate&& known) {
  if (known.kind == Certificate::Kind::never_fails) return topology_.set_event(edge, no_event);
  Part* part = lane.part;
  Queue_handle first_handle = lane.first_handle;
  if (!lane.is_region() && !(known.bounds.lower <= due_until_)) {
    const std::size_t home = schedule_.policy().part_of({edge.here});
    part = &queue().part(home);
    first_handle = queue().named(home, 0);
  }
  const Queue_handle handle = known.failure == nullptr ? part->emplace(edge.here, kind, known)
                                                       : part->push(Entry(edge.here, kind, known),
                                                                    std::move(*known.failure));
  topology_.set_event(edge, first_handle | handle);
}

// Flips an edge whose entry has been taken from its part, as Updates::flip does, and keeps what
// undoes it.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::execute(Lane& lane, const Entry& entry, const Two_sided_edge& edge,
                                        Moment& moment) {
  Outer_edges outer = topology_.outer_edges(edge);
  for (const auto& [here, there] : outer) {
    detail::prefetch(there.first->vertex(there.second));
    queue().prefetch(there.first->event(there.second));
  }
  Flip& f = log_.start_flip(*lane.log, edge);
  for (const auto& [here, there] : outer) discard(lane, here.first->event(here.second));
  // Nothing throws from here to the flip.
  const Stamp number = log_.add_key(*lane.log, moment.bounds, event_kind_of(entry.kind));
  f.face->set_stamp(number);
  f.neighbor->set_stamp(number);
  const Two_sided_edge added = topology_.flip(edge, outer);
  const auto now = [&]() -> const Time& { return log_.time(moment); };
  const auto put_entry = [&](const Two_sided_edge& e, Entry_kind kind, Certificate&& known) {
    put(lane, e, kind, std::move(known));
  };
  const Double_interval bounds = moment.exact ? moment.exact->interval() : moment.bounds;
  certification_.certify_after_flip(added, outer, bounds, now, lane.certificates, put_entry);
  if constexpr (has_turns) follow_flip(lane, f, moment);
  if (entry.kind != Entry_kind::flip) log_.time(moment);
  if (moment.exact) f.exact = std::make_unique<Time>(std::move(*moment.exact));
}

// Takes the entry of an edge out of the queue, if there is one.
template <class Traits, class Turns>
inline void Region_run<Traits, Turns>::discard(Lane& lane, Queue_handle handle) {
  if (handle == no_event) return;
  const Entry_kind kind = queue().erase(handle).kind;
  if (kind != Entry_kind::recheck) {
    ++lane.counters.discarded[static_cast<std::size_t>(event_kind_of(kind))];
  }
}

// Undoes a flip: first those that were executed after it and conflict with it.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::undo(Lane& lane, Stamp number) {
  // The last flip at a face or beside it.
  const auto last_at = [&](Face_handle face) {
    Stamp last = 0;
    for (const Face_handle f : {face, face->neighbor(0), face->neighbor(1), face->neighbor(2)}) {
      if (log_.is_of_window(f->stamp())) last = std::max(last, f->stamp());
    }
    return last;
  };
  std::vector<Stamp> waiting = {number};  // each for the one after it
  while (!waiting.empty()) {
    const Flip& f = log_.flip(waiting.back());
    Stamp last = 0;
    log_.for_each_written_face(f, [&](Face_handle face) { last = std::max(last, last_at(face)); });
    if (last > waiting.back()) {
      waiting.push_back(last);
    } else {
      undo_last(lane, waiting.back());
      waiting.pop_back();
    }
  }
}

// Undoes a flip that no other one after it conflicts with. Then the surroundings are what they were
// just before it.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::undo_last(Lane& lane, Stamp number) {
  const Key& flipped = log_.key(number);
  Flip& f = log_.flip(flipped);
  ++lane.undone;
  log_.node_of(number).has_undone = true;
  log_.for_each_written_face(f, [&](Face_handle face) {
    KINETRI_ASSERT(face->stamp() == number, "the last flip of its faces");
  });
  if constexpr (has_turns) {
    const Time& now = log_.time(flipped);  // made from motions of then
    if (f.turn) return undo_turn(lane, f, now);
    unfollow_flip(lane, f, now);
  }
  const auto erase = [&](Face_handle face, int k) {
    if (face->event(k) != no_event) queue().erase(face->event(k));
  };
  const int i = f.i;
  const int j = f.j;
  for (int k = 0; k < 3; ++k) erase(f.face, k);
  erase(f.neighbor, j);
  erase(f.neighbor, Triangulation::cw(j));
  log_.roll_back(f);
  const Two_sided_edge edge = {Edge(f.face, i), Edge(f.neighbor, j)};
  const Outer_edges outer = topology_.outer_edges(edge);
  certify_again(lane, std::array{edge, outer[0], outer[1], outer[2], outer[3]});
}

// Schedules edges whose quadrilaterals are there again: what fails first after a quadrilateral was
// born does so whenever one looks. From a later time on one would not see what fails at that time.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::certify_again(Lane& lane, std::span<const Two_sided_edge> edges) {
  for (const Two_sided_edge& edge : edges) {
    certification_.certify({&edge, 1}, birth(edge), Certificate_state::any, lane.certificates,
                           [&](const Two_sided_edge& e, Entry_kind kind, Certificate&& known) {
                             put(lane, e, kind, std::move(known));
                           });
  }
}

// When a quadrilateral was born, or the present time, at which the window begins, if that is later.
template <class Traits, class Turns>
auto Region_run<Traits, Turns>::birth(const Two_sided_edge& edge) -> const Time& {
  const Time* result = &schedule_.current_time();
  for (const Face_handle face : {edge.here.first, edge.there.first}) {
    if (!log_.is_of_window(face->stamp())) continue;
    const Time& last = log_.time(log_.key(face->stamp()));
    if (last > *result) result = &last;
  }
  return *result;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_FLIPS_IMPL_H
