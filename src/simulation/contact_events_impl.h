// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Contact_events.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_EVENTS_IMPL_H
#define KINETRI_SRC_SIMULATION_CONTACT_EVENTS_IMPL_H

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/incident.h"
#include "simulation/contact_events.h"
#include "simulation/watched_contacts_impl.h"
#include "triangulation/edge_events_impl.h"

namespace kinetri::detail {

// ---- entries ----

template <class Traits>
void Contact_events<Traits>::take_up(std::span<const Process> processes) {
  states_.resize(processes.size());
  for (const Process& process : processes) of(process).part = &queue().part(process.from);
}

template <class Traits>
void Contact_events<Traits>::recheck(Process& process, std::span<const Entry> entries) {
  for (const Entry& entry : entries) {
    records_.forget_event(entry.subject());
    auto [again, known] =
        watch_.certificate(entry, Time(entry.bounds.lower), of(process).certificates);
    put(process, again, std::move(known));
  }
}

template <class Traits>
void Contact_events<Traits>::note_blocked(Process& process, const Entry& entry) {
  for (const Point_id id : Watch::points(entry)) {
    if (id == no_point) continue;
    blocked_from_[id] = std::min(blocked_from_[id], entry.bounds.lower);
    of(process).blocked.push_back(id);
  }
}

// Schedules a contact, or the next check of its certificate.
template <class Traits>
void Contact_events<Traits>::put(const Process& process, Entry entry, Certificate&& known) {
  if (known.kind == Certificate::Kind::never_fails) return;
  entry.bounds = known.bounds;
  entry.time = Time_pool::none;
  entry.is_event = known.kind == Certificate::Kind::fails;
  const std::size_t to = entry.bounds.lower <= process.due_until
                             ? process.from
                             : schedule_.policy().part_of(entry.subject());
  Part& part = queue().part(to);
  const Queue_handle handle =
      known.failure ? part.push(entry, std::move(*known.failure)) : part.emplace(entry);
  records_.add_event(entry.subject(), queue().named(to, handle));
}

// Takes an entry out of the queue.
template <class Traits>
auto Contact_events<Traits>::take(Queue_handle handle) -> Entry {
  const Entry entry = queue().erase(handle);
  records_.forget_event(entry.subject());
  return entry;
}

// Takes the entries of points out of the queue, and calls `function` with each.
template <class Traits>
template <class Function>
void Contact_events<Traits>::take_all(Process& process, Points points, const Function& function) {
  std::vector<Queue_handle>& handles = of(process).handles;
  for (const Point_id id : points) {
    handles.clear();
    watch_.for_each_handle(id, [&](Queue_handle handle) { handles.push_back(handle); });
    for (const Queue_handle handle : handles) function(take(handle));
  }
}

// ---- before a contact, or a flip ----

// The exact time is computed once, by the queue.
template <class Traits>
auto Contact_events<Traits>::candidate(Process& process, const Entry& entry) -> Candidate {
  const Time& time = part(process).time(part(process).top());
  Candidate result = {entry, {{}, time.interval(), time}, std::make_unique<Velocity_change>()};
  result.change->points = Watch::points(entry);
  if constexpr (Types::is_periodic) result.change->offset = entry.offset;
  return result;
}

template <class Traits>
bool Contact_events<Traits>::may_execute(Process& process, Candidate& candidate) {
  const Points points = candidate.points();
  if (std::ranges::any_of(points, [this](Point_id id) { return topology_.is_hidden(id); }) ||
      !std::ranges::all_of(points, [this](Point_id id) { return has_each_face_once(id); })) {
    return false;
  }
  const auto is_owned = [&](Point_id id) { return edges_.owns_star(process, id); };
  return process.is_root ||
         (std::ranges::all_of(points, is_owned) && !is_blocked(process, candidate));
}

// Whether the faces at a point are different, and so are their edges: in a periodic box with few
// points the point may be twice in a face, or on both sides of an edge.
template <class Traits>
bool Contact_events<Traits>::has_each_face_once(Point_id id) const {
  bool result = true;
  if constexpr (Types::is_periodic) {
    const Vertex_handle v = topology_.vertex(id);
    for_each_face_at(topology_.triangulation(), v, [&](Face_handle face, int i) {
      result =
          result && face->vertex(Triangulation::ccw(i)) != v && !face->neighbor(i)->has_vertex(v);
    });
  }
  return result;
}

template <class Traits>
template <class Function>
void Contact_events<Traits>::for_each_surrounding_face(const Candidate& candidate,
                                                       const Function& function) const {
  for (const Point_id id : candidate.points()) {
    for_each_face_at(topology_.triangulation(), topology_.vertex(id), [&](Face_handle face, int i) {
      function(face);
      function(face->neighbor(i));
    });
  }
}

// Whether a deferred entry in the surroundings of a contact is not later than it.
template <class Traits>
bool Contact_events<Traits>::is_blocked(Process& process, const Candidate& candidate) {
  const Points points = candidate.points();
  const Moment& moment = candidate.moment;
  const auto exact = [&]() -> const Time& { return *moment.exact; };
  bool result = false;
  for_each_surrounding_face(candidate, [&](Face_handle face) {
    result = result || edges_.waits_before(face, process, moment.bounds, exact);
  });
  for (const Point_id id : points) {
    if (result) return true;
    for_each_face_at(topology_.triangulation(), topology_.vertex(id), [&](Face_handle face, int i) {
      const Point_id neighbor = face->vertex(Triangulation::ccw(i))->point().id();
      result =
          result || (!Watch::is_one(points, neighbor) && is_point_blocked(neighbor, moment.bounds));
    });
    watch_.for_each_handle(id, [&](Queue_handle handle) {
      result = result || waits_before(handle, process, moment.bounds, exact);
    });
  }
  return result;
}

// Whether the entry of a handle, if any, is deferred and not later than the bounds.
template <class Traits>
template <class Exact>
inline bool Contact_events<Traits>::waits_before(Queue_handle handle, const Process& process,
                                                 const Double_interval& bounds,
                                                 const Exact& exact) {
  return handle != no_event && handle >= queue().named(states_.size(), 0) &&
         detail::waits_before(queue(), handle, of(process).part, bounds, exact);
}

template <class Traits>
bool Contact_events<Traits>::blocks(const Process& process, const typename Edges::Candidate& flip) {
  const Double_interval& bounds = flip.entry.bounds;
  const auto& [face, i] = flip.edge.here;
  const auto& [neighbor, j] = flip.edge.there;
  for (int k = 0; k < 3; ++k) {
    if (is_point_blocked(face->vertex(k)->point().id(), bounds)) return true;
  }
  if (is_point_blocked(neighbor->vertex(j)->point().id(), bounds)) return true;
  if (!watch_.has_pairs()) return false;
  const auto exact = [&]() -> const Time& { return process.edges->time(process.edges->top()); };
  return waits_before(records_.pair_event(topology_.name_of(flip.edge.here)), process, bounds,
                      exact);
}

template <class Traits>
bool Contact_events<Traits>::keeps(const Edge_with_mirror& edge, Moment& moment) {
  if (!watch_.keep_edges()) return false;
  const Pair pair = topology_.name_of(edge.here);
  const auto [a, b] = detail::ids_of(pair);
  return a != no_point && b != no_point && (log_.has_changed(a) || log_.has_changed(b)) &&
         watch_.do_meet(pair, log_.time(moment));
}

// ---- a contact ----

template <class Traits>
bool Contact_events<Traits>::execute(Process& process, Candidate& candidate) {
  Moment& moment = candidate.moment;
  if (topology_.number_of_hidden_vertices() > 0) {
    bool hide_points = false;
    for_each_face_around(candidate.points(), [&](Face_handle face) {
      hide_points = hide_points || Edges::hides_points(face);
    });
    if (hide_points) return false;
  }
  const auto changes = watch_.changes(candidate.entry, *moment.exact);
  if (changes.empty()) return false;
  const Velocity_change& change = *candidate.change;  // remains valid in the log
  try {
    if (set_points(*candidate.change, changes, moment) &&
        certify(process, candidate.entry, change.changed_points(), moment)) {
      record(process, std::move(candidate));
      return true;
    }
  } catch (const Periodic_box_error&) {
    // A sum of offsets is too great. The sequential loop need not add these, or throws it again.
  } catch (...) {
    log_.set_motions(change, false);
    throw;
  }
  log_.set_motions(change, false);
  return false;
}

// Gives points their new motions. Returns false if their triangles do not stay embedded, or if
// weights are no longer equal at all times.
template <class Traits>
bool Contact_events<Traits>::set_points(Velocity_change& change, std::span<const Change> changes,
                                        Moment& moment) {
  using Instantaneous = typename Types::Instantaneous_traits;
  std::optional<Instantaneous> instant;
  const auto is_left_turn = [&](const auto& p, const auto& q, const auto& r) {
    if (!instant) {
      instant.emplace(
          certification_.traits().instantaneous_traits({*moment.exact, Time_side::after}));
    }
    return instant->orientation_2_object()(p, q, r) == CGAL::LEFT_TURN;
  };
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const Point_id id = changes[k].point;
    const Vertex_handle v = topology_.vertex(id);
    change.changed[k] = id;
    change.before[k] = v->point();
    v->set_point(Point_2(*changes[k].motion, id));
    change.after[k] = v->point();
    if constexpr (Types::is_weighted) {
      if (topology_.are_weights_equal() &&
          !have_equal_weights(change.before[k].motion(), change.after[k].motion())) {
        return false;
      }
    }
    if (!certification_.is_embedded_around(v, moment.bounds, is_left_turn)) return false;
  }
  return true;
}

// Computes the certificates of changed points, in the vectors of the process. Returns false if one
// fails at once, or if discs overlap that have not just touched.
template <class Traits>
bool Contact_events<Traits>::certify(Process& process, const Entry& contact, Points changed,
                                     const Moment& moment) {
  State& state = of(process);
  state.edge_certificates.clear();
  state.contact_certificates.clear();
  bool fails_now = false;
  const auto look_at = [&](const Certificate& known) {
    fails_now = fails_now || (known.kind == Certificate::Kind::fails &&
                              known.bounds.lower <= moment.bounds.upper);
  };
  certification_.certify(edges_around(state, changed), *moment.exact, Certificate_state::any,
                         process.certificates,
                         [&](const Edge_with_mirror& edge, Entry_kind kind, Certificate&& known) {
                           look_at(known);
                           state.edge_certificates.emplace_back(edge, kind, std::move(known));
                         });
  if (fails_now || !watch_.certify(contact, changed, *moment.exact, state.certificates,
                                   state.contact_certificates))
    return false;
  for (const auto& [entry, known] : state.contact_certificates) look_at(known);
  return !fails_now;
}

// Executes a contact whose certificates have been computed.
template <class Traits>
void Contact_events<Traits>::record(Process& process, Candidate&& candidate) {
  State& state = of(process);
  const Entry& entry = candidate.entry;
  Velocity_change& change = *candidate.change;
  const Points changed = change.changed_points();
  const auto number =
      log_.add_change(*process.log, std::move(candidate.change), candidate.moment,
                      entry.kind == Contact_kind::wall ? Event_kind::wall : Event_kind::collision);
  std::size_t faces = 0;
  for_each_face_around(changed, [&](Face_handle /*face*/) { ++faces; });
  change.faces.reserve(faces);
  for_each_face_around(changed, [&](Face_handle face) {
    change.faces.push_back({face, face->version()});
    face->set_version(number);
  });
  // Entries leave the queue before the motions change: the others are compared by the old motions.
  log_.set_motions(change, false);
  take_all(process, changed, [&](const Entry& taken) {
    const bool is_executed = taken.kind == entry.kind && taken.pair() == entry.pair();
    if (!is_executed) state.count_discarded(taken);
  });
  for (const auto& [edge, kind, known] : state.edge_certificates) {
    edges_.discard(process, edge.here.first->event(edge.here.second));
  }
  log_.set_motions(change, true);
  for (auto& [edge, kind, known] : state.edge_certificates) {
    edges_.put(process, edge, kind, std::move(known));
  }
  for (auto& [about, known] : state.contact_certificates) put(process, about, std::move(known));
  log_.note_change(change, number);
  for (const Point_id id : change.points) {
    if (id != no_point) blocked_from_[id] = never;
  }
}

// Calls `function` with each face at the points, which are one or two.
template <class Traits>
template <class Function>
void Contact_events<Traits>::for_each_face_around(Points points, const Function& function) const {
  const Triangulation& triangulation = topology_.triangulation();
  const Vertex_handle first = topology_.vertex(points.front());
  for_each_face_at(triangulation, first, [&](Face_handle face) { function(face); });
  if (points.size() == 1) return;
  for_each_face_at(triangulation, topology_.vertex(points.back()), [&](Face_handle face) {
    if (!face->has_vertex(first)) function(face);
  });
}

// The edges of the faces at the points, each once.
template <class Traits>
auto Contact_events<Traits>::edges_around(State& state, Points points) const
    -> std::span<const Edge_with_mirror> {
  std::vector<Edge_with_mirror>& result = state.edges;
  result.clear();
  const Vertex_handle first = topology_.vertex(points.front());
  const auto add = [&](Vertex_handle v, const auto& is_known) {
    for_each_face_at(topology_.triangulation(), v, [&](Face_handle face, int at) {
      for (const int i : {at, Triangulation::cw(at)}) {
        const Edge_with_mirror edge = topology_.with_mirror(typename Types::Edge(face, i));
        if (!is_known(edge)) result.push_back(edge);
      }
    });
  };
  add(first, [](const Edge_with_mirror&) { return false; });
  if (points.size() == 2) {
    add(topology_.vertex(points.back()), [&](const Edge_with_mirror& edge) {
      return edge.here.first->has_vertex(first) || edge.there.first->has_vertex(first);
    });
  }
  return result;
}

template <class Traits>
void Contact_events<Traits>::roll_back(Process& process, Record& record, const Time& now) {
  State& state = of(process);
  const Velocity_change& change = *record.change;
  const Points points = change.changed_points();
  const std::span<const Edge_with_mirror> edges = edges_around(state, points);
  for (const Edge_with_mirror& edge : edges) {
    const Queue_handle handle = edge.here.first->event(edge.here.second);
    if (handle != no_event) edges_.queue().erase(handle);
  }
  take_all(process, points, [](const Entry&) {});
  log_.roll_back(record);
  log_.forget_change(change);
  edges_.certify_again(process, edges);
  watch_.for_each_contact(
      points, now, state.certificates,
      [&](const Entry& entry, Certificate&& known) { put(process, entry, std::move(known)); });
}

// ---- the contacts of edges that are flipped ----

template <class Traits>
void Contact_events<Traits>::follow_flip(Process& process, const Record& flip, Moment& moment) {
  if (!watch_.has_pairs()) return;
  State& state = of(process);
  const auto& [removed, added] = Log::flipped_edges(flip);
  if (is_finite(removed)) {
    const Queue_handle handle = records_.pair_event(removed);
    if (handle != no_event) state.count_discarded(take(handle));
  }
  if (!is_finite(added)) return;
  const Entry about = Watch::entry_of(added);
  // Just before the flip the two do not touch: else they would have been watched.
  auto [entry, known] = watch_.certificate(about, Time(moment.bounds.lower), state.certificates);
  if (known.may_be_zero ||
      (known.kind != Certificate::Kind::never_fails && known.bounds.lower <= moment.bounds.upper)) {
    known = watch_.certificate(about, log_.time(moment), state.certificates).second;
  }
  put(process, entry, std::move(known));
}

template <class Traits>
void Contact_events<Traits>::unfollow_flip(Process& process, const Record& flip, const Time& now) {
  if (!watch_.has_pairs()) return;
  const auto& [removed, added] = Log::flipped_edges(flip);
  if (is_finite(added)) {
    const Queue_handle handle = records_.pair_event(added);
    if (handle != no_event) take(handle);
  }
  if (!is_finite(removed)) return;
  auto [entry, known] = watch_.certificate(Watch::entry_of(removed), now, of(process).certificates);
  put(process, entry, std::move(known));
}

// ---- windows ----

template <class Traits>
void Contact_events<Traits>::make_room() {
  log_.make_room(topology_.vertices().size());
  blocked_from_.resize(topology_.vertices().size(), never);
}

template <class Traits>
Event Contact_events<Traits>::event(const typename Log::Key& key) {
  Event event;
  event.kind = key.kind;
  const Velocity_change& change = *log_.record(key).change;
  const auto& [a, b] = change.points;
  event.point_a = a;
  if (b != no_point) event.point_b = b;
  event.added_offset = change.offset;
  return event;
}

template <class Traits>
void Contact_events<Traits>::count(std::uint64_t contacts) {
  core_.counters.instants += contacts;
  core_.counters.most_at_one_time =
      std::max<std::uint64_t>(core_.counters.most_at_one_time, contacts > 0 ? 1 : 0);
}

template <class Traits>
void Contact_events<Traits>::end_window() {
  for (const auto& key : log_.order()) {
    if (key.kind != Event_kind::collision) continue;
    const Velocity_change& change = *log_.record(key).change;
    const auto& [a, b] = change.points;
    if constexpr (Types::is_periodic) {
      watch_.end_contact({{a, b}, change.offset});
    } else {
      watch_.end_contact({a, b});
    }
  }
  log_.forget_changes();
  for (State& state : states_) {
    for (const Point_id id : state.blocked) blocked_from_[id] = never;
    state.blocked.clear();
    schedule_.certificate_counters() += std::exchange(state.certificates, {});
    core_.counters.discarded_walls += std::exchange(state.discarded_walls, 0);
    core_.counters.discarded_collisions += std::exchange(state.discarded_collisions, 0);
  }
  watch_.end_window();
}

template <class Traits>
void Contact_events<Traits>::start_anew() {
  states_.clear();
  std::ranges::fill(blocked_from_, never);
  watch_.start_anew();
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_EVENTS_IMPL_H
