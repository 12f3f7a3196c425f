// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_SCHEDULE_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_SCHEDULE_IMPL_H

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/certification_impl.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/impl/triangulation/schedule.h"

namespace kinetri::detail {

// ---- the policy of the queue ----

template <class Traits>
auto Kinetic_types<Traits>::Schedule::Policy::entry_time(const Entry& entry) const -> Time {
  if (entry.kind == Entry_kind::recheck) return Time(entry.bounds.lower);
  KINETRI_ASSERT(entry.kind != Entry_kind::coincidence, "the time of a coincidence is kept");
  return schedule_.certification_.failure_time(schedule_.points(entry), entry.bounds);
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::Policy::precedes(const Entry& a, const Entry& b) const {
  if (a.kind != b.kind) return a.kind < b.kind;
  if constexpr (is_weighted) {
    // Only entries of the kind `recheck` have both kinds of subject.
    if (a.is_hidden() != b.is_hidden()) return b.is_hidden();
    if (a.is_hidden()) return a.hidden->point().id() < b.hidden->point().id();
  }
  return Topology::name_of(a.edge()) < Topology::name_of(b.edge());
}

// The surroundings of the face of the entry have been prefetched before.
template <class Traits>
inline void Kinetic_types<Traits>::Schedule::Policy::prefetch_first(const Entry& entry) const {
  if (schedule_.topology_.triangulation().dimension() < 2 || entry.is_hidden()) return;
  prefetch_around(entry.face->neighbor(entry.index));
}

// That of the lowest node with both ends of the edge; of the root for a hidden point.
template <class Traits>
inline std::size_t Kinetic_types<Traits>::Schedule::Policy::part_of(const Subject& subject) const {
  const Region_division& division = schedule_.division();
  if (subject.is_hidden()) return node_of(division, no_point, no_point);
  const auto& [face, i] = subject.edge;
  return node_of(division, face->vertex(Triangulation::cw(i))->point().id(),
                 face->vertex(Triangulation::ccw(i))->point().id());
}

template <class Traits>
inline Queue_handle Kinetic_types<Traits>::Schedule::Policy::handle(const Subject& subject) const {
  if constexpr (is_weighted) {
    if (subject.is_hidden()) return subject.hidden->event();
  }
  return subject.edge.first->event(subject.edge.second);
}

template <class Traits>
inline void Kinetic_types<Traits>::Schedule::Policy::set_handle(const Subject& subject,
                                                                Queue_handle handle) const {
  if constexpr (is_weighted) {
    if (subject.is_hidden()) return subject.hidden->set_event(handle);
  }
  Topology::set_event(schedule_.topology_.with_mirror(subject.edge), handle);
}

template <class Traits>
auto Kinetic_types<Traits>::Schedule::points(const Entry& entry) const -> Certificate_points {
  if constexpr (is_weighted) {
    if (entry.is_hidden()) return certification_.hidden_points(entry.hidden, entry.index);
  }
  return certification_.points(topology_.with_mirror(entry.edge()));
}

// ---- the present time ----

template <class Traits>
inline auto Kinetic_types<Traits>::Schedule::current_time() const -> const Time& {
  if (pending_time_) {
    current_time_ = certification_.failure_time(pending_time_->first, pending_time_->second);
    pending_time_.reset();
  }
  return current_time_;
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::settle(const Time* until) {
  schedule_deferred();
  if (end_ && (until == nullptr || *until > *end_)) until = &*end_;
  if (until == nullptr) return settle_while([](const Entry& /*entry*/) { return true; });
  const auto exact = [until]() -> const Time& { return *until; };
  const bool is_due = settle_while(
      [&](const Entry& entry) { return queue_.is_due(entry, until->interval(), exact); });
  return is_due && (!end_ || queue_.time_of(queue_.top()) < *end_);
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::settle_now() {
  schedule_deferred();
  const auto exact = [this]() -> const Time& { return current_time(); };
  return settle_while(
      [&](const Entry& entry) { return queue_.is_due(entry, current_bounds(), exact); });
}

// Certifies the edges of entries anew, from the time of the first entry on, at which the other
// certificates hold as well: two together cost less.
template <class Traits>
void Kinetic_types<Traits>::Schedule::recheck(std::span<const Entry> entries) {
  counters_.rechecks += entries.size();
  std::array<Edge_with_mirror, 2> edges;
  std::size_t number = 0;
  const Time after(entries.front().bounds.lower);
  for (const Entry& entry : entries) {
    if constexpr (is_weighted) {
      if (entry.is_hidden()) {
        schedule_hidden(entry.hidden, after);
        continue;
      }
    }
    edges[number] = topology_.with_mirror(entry.edge());
    forget_entry(edges[number++]);
  }
  schedule(std::span(edges).first(number), after);
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::has_failure_before(const Time& latest) const {
  const Time& time = end_ ? std::min(latest, *end_) : latest;
  if (time <= current_time()) return false;
  if (is_deferred_) return has_deferred_failure_before(time);
  if (queue_.empty() || queue_.time_of(queue_.top()) >= time) return false;
  if (queue_.top().kind != Entry_kind::recheck) return true;
  bool result = false;
  queue_.for_each([&](const Entry& entry) { result = result || fails_before(entry, time); });
  return result;
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::fails_before(const Entry& entry, const Time& time) const {
  if (entry.bounds.lower > time.interval().upper) return false;
  if (entry.kind != Entry_kind::recheck) return queue_.time_of(entry) < time;
  return fails_before(entry, Time(entry.bounds.lower), time);
}

template <class Traits>
bool Kinetic_types<Traits>::Schedule::has_deferred_failure_before(const Time& time) const {
  using Kept = typename Entry::Kept;  // by default of a recheck
  bool result = false;
  for (const Face_handle face : topology_.faces()) {
    topology_.for_each_own_edge(face, [&](const Edge& edge) {
      result = result || fails_before(Entry(Subject{edge}, {}, Kept()), current_time(), time);
    });
    if constexpr (is_weighted) {
      for (const Vertex_handle v : face->vertex_list()) {
        result = result ||
                 fails_before(Entry(Subject{Edge(face, 0), v}, {}, Kept()), current_time(), time);
      }
    }
  }
  return result;
}

// Of the subject of an entry whose certificate holds until the time `checked`.
template <class Traits>
bool Kinetic_types<Traits>::Schedule::fails_before(const Entry& recheck, Time checked,
                                                   const Time& time) const {
  while (checked < time) {
    const auto [about, next] = certificate_of(recheck, checked);
    if (next.kind == Certificate::Kind::never_fails) return false;
    if (next.kind == Certificate::Kind::fails) {
      return (next.failure ? *next.failure : certification_.failure_time(about, next.bounds)) <
             time;
    }
    checked = Time(next.bounds.lower);
  }
  return false;
}

// The certificate of the subject of an entry, with the points of the condition that fails.
template <class Traits>
auto Kinetic_types<Traits>::Schedule::certificate_of(const Entry& entry, const Time& after) const
    -> std::pair<Certificate_points, Certificate> {
  const bool have_points = topology_.triangulation().dimension() == 2;
  if constexpr (is_weighted) {
    if (entry.is_hidden()) {
      Certificate_counters unused;
      auto [index, known] = certification_.hidden_certificate(entry.hidden, after, unused);
      return {
          have_points ? certification_.hidden_points(entry.hidden, index) : Certificate_points(),
          std::move(known)};
    }
  }
  const Edge_with_mirror edge = topology_.with_mirror(entry.edge());
  Certificate known = certification_.certificate_of(edge, after).second;
  return {have_points ? certification_.points(edge) : Certificate_points(), std::move(known)};
}

// ---- edges ----

// Puts the failure of the certificate of an edge, or the time to recheck it, into the queue.
// Usually constructs the entry in the queue.
template <class Traits>
KINETRI_ALWAYS_INLINE void Kinetic_types<Traits>::Schedule::put(const Edge_with_mirror& edge,
                                                                Entry_kind kind,
                                                                Certificate&& certificate) {
  if constexpr (is_periodic) {
    // Two outer edges of a quadrilateral may be one, which has its entry then.
    if (edge.here.first->event(edge.here.second) < Topology::listed) return;
  }
  if (certificate.kind == Certificate::Kind::never_fails)
    return Topology::set_event(edge, no_event);
  Topology::set_event(edge, certificate.failure == nullptr
                                ? queue_.emplace(edge.here, kind, certificate)
                                : queue_.push(Entry(edge.here, kind, certificate),
                                              std::move(*certificate.failure)));
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule(std::span<const Edge_with_mirror> edges,
                                               const Time& after, Certificate_state state) {
  certification_.certify(edges, after, state, certificate_counters_, Put_certificate{*this});
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule_after_flip(const Edge_with_mirror& edge,
                                                          const Outer_edges& outer) {
  const auto now = [this]() -> const Time& { return current_time(); };
  certification_.certify_after_flip(edge, outer, current_bounds(), now, certificate_counters_,
                                    Put_certificate{*this});
}

template <class Traits>
KINETRI_ALWAYS_INLINE void Kinetic_types<Traits>::Schedule::unschedule(
    const Edge_with_mirror& edge, Triangulation_counters& counters) {
  const Queue_handle handle = edge.here.first->event(edge.here.second);
  if (handle == no_event) return;
  const Entry_kind kind = queue_.erase(handle).kind;
  forget_entry(edge);
  if (kind != Entry_kind::recheck) {
    ++counters.discarded[static_cast<std::size_t>(event_kind_of(kind))];
  }
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::unschedule_face(Face_handle face) {
  for (int i = 0; i < 3; ++i) {
    const Edge_with_mirror edge = topology_.with_mirror(Edge(face, i));
    unschedule(edge);
    Topology::set_event(edge, no_event);
  }
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::unschedule_around(Vertex_handle v) {
  for_each_face_at(topology_.triangulation(), v, [&](Face_handle face) { unschedule_face(face); });
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::unschedule_around(Vertex_handle v,
                                                        std::vector<Edge_with_mirror>& edges,
                                                        Triangulation_counters& counters) {
  for_each_face_at(topology_.triangulation(), v, [&](Face_handle face, int at) {
    for (const int i : {at, Triangulation::cw(at)}) {
      if (face->event(i) == Topology::listed) continue;
      // Constructed in place: copying what has just been written would stall the processor.
      Edge_with_mirror& edge = edges.emplace_back();
      edge.here.first = face;
      edge.here.second = i;
      edge.there.first = face->neighbor(i);
      edge.there.second = topology_.mirror_index(face, i);
      unschedule(edge, counters);
      Topology::set_event(edge, Topology::listed);
    }
  });
}

// Of two faces that share an edge at `v`, the first one adds it.
template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule_around(Vertex_handle v, Certificate_state state) {
  std::vector<Edge_with_mirror> at_vertex;
  std::vector<Edge_with_mirror> opposite;
  for_each_face_at(topology_.triangulation(), v, [&](Face_handle face, int at) {
    const int left = Triangulation::cw(at);
    if (face->event(at) == no_event) opposite.push_back(topology_.with_mirror(Edge(face, at)));
    if (face->event(left) == no_event) at_vertex.push_back(topology_.with_mirror(Edge(face, left)));
  });
  if (state == Certificate_state::any) {
    opposite.insert(opposite.end(), at_vertex.begin(), at_vertex.end());
  } else {
    schedule(at_vertex, current_time(), state);
  }
  schedule(opposite, current_time());
}

// Threads take blocks of faces; the edges of a block have the handles after those of the block
// before.
template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule_all() {
  is_deferred_ = false;
  constexpr std::size_t faces_per_block = 512;
  const std::vector<Face_handle> all = topology_.faces();
  std::vector<Block> blocks;
  Queue_handle size = 0;
  for (std::size_t first = 0; first < all.size(); first += faces_per_block) {
    const std::size_t count = std::min(faces_per_block, all.size() - first);
    Block& block = blocks.emplace_back();
    block.faces = std::span(all).subspan(first, count);
    block.after = current_time().detached();
    block.next_handle = size;
    for (const Face_handle face : block.faces) {
      topology_.for_each_own_edge(face, [&](const Edge&) { ++size; });
    }
  }
  queue_.assign(size, [&](const auto& put_entry) {
    for_each_in_parallel(blocks, [&](Block& block) { schedule_block(block, put_entry); });
    for (const Block& block : blocks) certificate_counters_ += block.counters;
  });
  if constexpr (is_weighted) {
    for (const Vertex_handle v : topology_.triangulation().hidden_vertex_handles()) {
      schedule_hidden(v, current_time());
    }
  }
}

// Puts the entries of the block's edges into the queue.
template <class Traits>
template <class Put>
void Kinetic_types<Traits>::Schedule::schedule_block(Block& block, const Put& put_entry) const {
  const auto put_edge = [&](const Edge_with_mirror& edge, Entry_kind kind,
                            Certificate&& certificate) {
    const bool may_fail = certificate.kind != Certificate::Kind::never_fails;
    const Queue_handle handle = may_fail ? block.next_handle : no_event;
    ++block.next_handle;
    Topology::set_event(edge, handle);
    if (!may_fail) return;
    const Entry entry(edge.here, kind, certificate);  // before its time is moved out
    put_entry(handle, entry, std::move(certificate.failure));
  };
  // Some faces at a time, with prefetching.
  constexpr std::size_t edges_at_once = 64;
  std::vector<Edge_with_mirror> edges;
  edges.reserve(edges_at_once + 3);
  const auto certify_edges = [&] {
    certification_.certify(edges, block.after, Certificate_state::any, block.counters, put_edge);
    edges.clear();
  };
  for (std::size_t k = 0; k < block.faces.size(); ++k) {
    if (k + 6 < block.faces.size()) prefetch(block.faces[k + 6]);
    if (k + 3 < block.faces.size()) prefetch_around(block.faces[k + 3]);
    topology_.for_each_own_edge(block.faces[k], [&](const Edge& own) {
      edges.push_back(Topology::chosen_side(topology_.with_mirror(own)));
    });
    if (edges.size() >= edges_at_once) certify_edges();
  }
  certify_edges();
}

// ---- hidden points ----

template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule_hidden(Vertex_handle v, const Time& after,
                                                      std::uint8_t vanishing) {
  auto [index, known] =
      certification_.hidden_certificate(v, after, certificate_counters_, vanishing);
  if (known.kind == Certificate::Kind::never_fails) return v->set_event(no_event);
  Entry entry(Edge(v->face(), index), Entry_kind::hidden, known);
  entry.hidden = v;
  v->set_event(known.failure == nullptr ? queue_.emplace(entry)
                                        : queue_.push(entry, std::move(*known.failure)));
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::schedule_hidden_in(Face_handle face) {
  for (const Vertex_handle v : face->vertex_list()) {
    if (v->event() == no_event) schedule_hidden(v, current_time());
  }
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::unschedule_hidden(Vertex_handle v) {
  if (v->event() == no_event) return;
  const Entry entry = queue_.erase(v->event());
  v->set_event(no_event);
  if (entry.kind == Entry_kind::hidden && entry.index == plane_condition) {
    ++counters_.discarded[static_cast<std::size_t>(Event_kind::reveal)];
  }
}

template <class Traits>
void Kinetic_types<Traits>::Schedule::unschedule_hidden_in(Face_handle face) {
  for (const Vertex_handle v : face->vertex_list()) unschedule_hidden(v);
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_SCHEDULE_IMPL_H
