// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Edge_events.
#ifndef KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_IMPL_H

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/incident.h"
#include "triangulation/edge_events.h"

namespace kinetri::detail {

// ---- entries ----

template <class Traits, bool has_contacts>
void Edge_events<Traits, has_contacts>::recheck(Process& process, std::span<const Entry> entries) {
  process.counters.rechecks += entries.size();
  const Entry& first = entries.front();
  if constexpr (Types::is_weighted) {
    // Only the root has these, and it settles entries one by one.
    if (first.is_hidden()) {
      return schedule_.schedule_hidden(first.hidden, Time(first.bounds.lower));
    }
  }
  std::array<Edge_with_mirror, 2> edges;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    edges[k] = topology_.with_mirror(entries[k].edge());
  }
  certify(process, std::span(edges).first(entries.size()), Time(first.bounds.lower));
}

template <class Traits, bool has_contacts>
void Edge_events<Traits, has_contacts>::certify(Process& process,
                                                std::span<const Edge_with_mirror> edges,
                                                const Time& after, Certificate_state state) {
  certification_.certify(edges, after, state, process.certificates,
                         Put_certificate{*this, process});
}

template <class Traits, bool has_contacts>
KINETRI_ALWAYS_INLINE void Edge_events<Traits, has_contacts>::put(const Process& process,
                                                                  const Edge_with_mirror& edge,
                                                                  Entry_kind kind,
                                                                  Certificate&& known) {
  if (known.kind == Certificate::Kind::never_fails) return topology_.set_event(edge, no_event);
  Part* part = process.edges;
  Queue_handle first_handle = process.first_handle;
  if (!(known.bounds.lower <= process.due_until)) {
    const std::size_t home = schedule_.policy().part_of({edge.here});
    part = &queue().part(home);
    first_handle = queue().named(home, 0);
  }
  const Queue_handle handle = known.failure == nullptr ? part->emplace(edge.here, kind, known)
                                                       : part->push(Entry(edge.here, kind, known),
                                                                    std::move(*known.failure));
  topology_.set_event(edge, first_handle | handle);
}

template <class Traits, bool has_contacts>
inline void Edge_events<Traits, has_contacts>::discard(Process& process, Queue_handle handle) {
  if (handle == no_event) return;
  const Entry_kind kind = queue().erase(handle).kind;
  if (kind != Entry_kind::recheck) {
    ++process.counters.discarded[static_cast<std::size_t>(event_kind_of(kind))];
  }
}

template <class Traits, bool has_contacts>
template <class Exact>
inline bool Edge_events<Traits, has_contacts>::waits_before(Face_handle face,
                                                            const Process& process,
                                                            const Double_interval& bounds,
                                                            const Exact& exact) {
  const Queue_handle first_of_window = queue().named(schedule_.division().nodes(), 0);
  const auto is_of_window = [&](Queue_handle handle) {
    return static_cast<Queue_handle>(handle - first_of_window) < no_event - first_of_window;
  };
  if (!is_of_window(face->event(0)) && !is_of_window(face->event(1)) &&
      !is_of_window(face->event(2))) {
    return false;
  }
  const auto waits = [&](Queue_handle handle) {
    return is_of_window(handle) &&
           detail::waits_before(queue(), handle, process.edges, bounds, exact);
  };
  return waits(face->event(0)) || waits(face->event(1)) || waits(face->event(2));
}

// ---- before a flip ----

template <class Traits, bool has_contacts>
auto Edge_events<Traits, has_contacts>::candidate(Process& process, const Entry& entry) const
    -> Candidate {
  const Edge_with_mirror edge = topology_.with_mirror(entry.edge());
  Candidate result = {entry, edge, {certification_.points(edge), entry.bounds, std::nullopt}};
  if (entry.time != Time_pool::none) result.moment.exact = process.edges->time_of(entry);
  return result;
}

// Both ends of the edge are in the node, since the entry is in its part.
template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::may_execute(const Process& process,
                                                    const Candidate& candidate) {
  if (process.is_root) return true;
  const auto owns_corner = [&](const Edge& side) {
    return schedule_.division().owns(process.number, process.level,
                                     side.first->vertex(side.second)->point().id());
  };
  const auto& [entry, edge, moment] = candidate;
  return entry.kind == Entry_kind::flip && owns_corner(edge.here) && owns_corner(edge.there) &&
         !is_blocked(process, candidate);
}

// Whether an entry in the surroundings was deferred by this node, or is due in a node above, and is
// not later. (Other entries are later: those of the process come after its first one, those outside
// of windows' parts after the window.)
template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::is_blocked(const Process& process,
                                                   const Candidate& candidate) {
  const auto exact = [&]() -> const Time& { return process.edges->time(process.edges->top()); };
  const auto is_face_blocked = [&](Face_handle face) {
    return waits_before(face, process, candidate.entry.bounds, exact);
  };
  for (const Edge& side : {candidate.edge.here, candidate.edge.there}) {
    const auto& [face, i] = side;
    if (is_face_blocked(face) || is_face_blocked(face->neighbor(Triangulation::cw(i))) ||
        is_face_blocked(face->neighbor(Triangulation::ccw(i)))) {
      return true;
    }
  }
  return false;
}

template <class Traits, bool has_contacts>
template <class Function>
void Edge_events<Traits, has_contacts>::for_each_surrounding_face(const Candidate& candidate,
                                                                  const Function& function) const {
  for (const Edge& side : {candidate.edge.here, candidate.edge.there}) {
    const auto& [face, i] = side;
    function(face->neighbor(Triangulation::cw(i)));
    function(face->neighbor(Triangulation::ccw(i)));
  }
}

template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::owns_star(const Process& process, Point_id id) const {
  const auto owns = [&](Point_id point) {
    return schedule_.division().owns(process.number, process.level, point);
  };
  bool result = owns(id);
  if (!result) return false;
  for_each_face_at(topology_.triangulation(), topology_.vertex(id), [&](Face_handle face, int i) {
    result = result && owns(face->vertex(Triangulation::ccw(i))->point().id());
  });
  return result;
}

// With weights a point may be hidden instead. A flat triangle at the hull may only touch, or may
// require a reconstruction (Decisions). In a periodic box two sides of a quadrilateral may be one
// edge, which a record cannot restore, and the offset of the other diagonal may be too great.
template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::is_flip(Candidate& candidate) const {
  auto& [entry, edge, moment] = candidate;
  if (hides_points(edge.here.first) || hides_points(edge.there.first)) return false;
  if constexpr (Types::is_periodic) {
    const auto is_own = [&edge = edge](const Edge_with_mirror& side) {
      return side.there.first == edge.here.first || side.there.first == edge.there.first;
    };
    if (std::ranges::any_of(topology_.outer_edges(edge), is_own) ||
        !Triangulation::offset_beyond(edge.here, edge.here.second)) {
      return false;
    }
  }
  if (entry.kind == Entry_kind::flip) {
    const bool may_touch =
        Types::is_weighted && !topology_.are_weights_equal() && !entry.changes_sign;
    return !may_touch && is_convex(candidate);
  }
  const auto now = [this, &moment = moment]() -> const Time& { return log_.time(moment); };
  return Decisions<Traits>(certification_).decide(entry, edge, moment.bounds, now).action ==
         Action::flip;
}

// Whether the quadrilateral of an edge is certainly strictly convex just before and just after its
// in-circle certificate fails. Without weights it is.
template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::is_convex(const Candidate& candidate) const {
  if constexpr (Types::is_weighted) {
    if (topology_.are_weights_equal()) return true;
    const auto is_left_turn = [&](const auto& p, const auto& q, const auto& r) {
      return certification_.traits().certain_turn(p, q, r, candidate.moment.bounds) ==
             CGAL::LEFT_TURN;
    };
    const auto [right, left, apex, opposite] = candidate.moment.points.quadruple();
    return is_left_turn(*opposite, *left, *apex) && is_left_turn(*apex, *right, *opposite);
  }
  return true;
}

// ---- a flip ----

template <class Traits, bool has_contacts>
auto Edge_events<Traits, has_contacts>::execute(Process& process, Candidate& candidate) -> Record& {
  auto& [entry, edge, moment] = candidate;
  process.edges->pop();
  auto outer = topology_.outer_edges(edge);
  for (const auto& [here, there] : outer) {
    prefetch(there.first->vertex(there.second));
    queue().prefetch(there.first->event(there.second));
  }
  Record& record = log_.start_flip(*process.log, edge);
  for (const auto& [here, there] : outer) discard(process, here.first->event(here.second));
  // Nothing throws from here to the flip.
  const auto number = log_.add_key(*process.log, moment.bounds, event_kind_of(entry.kind));
  record.face->set_version(number);
  record.neighbor->set_version(number);
  const Edge_with_mirror added = topology_.flip(edge, outer);
  const auto now = [this, &moment = moment]() -> const Time& { return log_.time(moment); };
  const Double_interval bounds = moment.exact ? moment.exact->interval() : moment.bounds;
  certification_.certify_after_flip(added, outer, bounds, now, process.certificates,
                                    Put_certificate{*this, process});
  return record;
}

template <class Traits, bool has_contacts>
void Edge_events<Traits, has_contacts>::keep_time(Record& record, Candidate& candidate) const {
  auto& [entry, edge, moment] = candidate;
  if (entry.kind != Entry_kind::flip) log_.time(moment);
  if (moment.exact) record.exact = std::make_unique<Time>(std::move(*moment.exact));
}

// Afterwards the surroundings are those just before the flip.
template <class Traits, bool has_contacts>
void Edge_events<Traits, has_contacts>::roll_back(Process& process, Record& record) {
  const auto erase = [this](Face_handle face, int k) {
    if (face->event(k) != no_event) queue().erase(face->event(k));
  };
  const int i = record.i;
  const int j = record.j;
  for (int k = 0; k < 3; ++k) erase(record.face, k);
  erase(record.neighbor, j);
  erase(record.neighbor, Triangulation::cw(j));
  log_.roll_back(record);
  const Edge_with_mirror edge = {Edge(record.face, i), Edge(record.neighbor, j)};
  const auto outer = topology_.outer_edges(edge);
  certify_again(process, std::array{edge, outer[0], outer[1], outer[2], outer[3]});
}

// The first failure after a quadrilateral was created does not depend on when it is computed; but
// one at a time t is not found from t on, so the computation starts at the creation.
template <class Traits, bool has_contacts>
void Edge_events<Traits, has_contacts>::certify_again(Process& process,
                                                      std::span<const Edge_with_mirror> edges) {
  for (const Edge_with_mirror& edge : edges) {
    const auto state =
        is_added_by_birth(edge) ? Certificate_state::vanishes : Certificate_state::any;
    certify(process, {&edge, 1}, birth(edge), state);
  }
}

// Whether the event that created the quadrilateral is a flip that has added the edge itself, so
// that its polynomial vanishes at the birth.
template <class Traits, bool has_contacts>
bool Edge_events<Traits, has_contacts>::is_added_by_birth(const Edge_with_mirror& edge) {
  const auto version = edge.here.first->version();
  if (version != edge.there.first->version() || !log_.is_of_window(version)) return false;
  if (log_.key(version).kind != Event_kind::flip) return false;
  const Record& flip = log_.record(version);
  const auto is_side = [&](const Edge& side) {
    return side == Edge(flip.face, Triangulation::ccw(flip.i)) ||
           side == Edge(flip.neighbor, Triangulation::ccw(flip.j));
  };
  return is_side(edge.here) && is_side(edge.there);
}

// When a quadrilateral was created, or the present time, which is the begin of the window, if that
// is later.
template <class Traits, bool has_contacts>
auto Edge_events<Traits, has_contacts>::birth(const Edge_with_mirror& edge) -> const Time& {
  const Time* result = &schedule_.current_time();
  for (const Face_handle face : {edge.here.first, edge.there.first}) {
    if (!log_.is_of_window(face->version())) continue;
    const Time& last = log_.time(log_.key(face->version()));
    if (last > *result) result = &last;
  }
  return *result;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_IMPL_H
