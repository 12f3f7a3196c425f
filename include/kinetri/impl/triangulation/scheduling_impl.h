// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: the queue's entries, and the present time.
#ifndef KINETRI_IMPL_TRIANGULATION_SCHEDULING_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_SCHEDULING_IMPL_H

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// ---- the queue ----

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::Queue_policy::entry_time(const Entry& entry) const -> Time {
  if (entry.kind == Entry_kind::recheck) return Time(entry.bounds.lower);
  KINETRI_ASSERT(entry.kind != Entry_kind::coincidence, "the time of a coincidence is kept");
  return triangulation.failure_time(triangulation.certificate_points(entry), entry.bounds);
}

template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::Queue_policy::precedes(const Entry& a, const Entry& b) const {
  if (a.kind != b.kind) return a.kind < b.kind;
  if constexpr (is_weighted) {
    // Entries of one kind are about the same, but for those to check again.
    if (a.is_hidden() != b.is_hidden()) return b.is_hidden();
    if (a.is_hidden()) return a.hidden->point().id() < b.hidden->point().id();
  }
  return ids_of(a.edge()) < ids_of(b.edge());
}

// What is around the first entry's own face has been asked for when it came near.
template <KineticTraits_2 Traits>
inline void Kinetic_triangulation_2<Traits>::Queue_policy::prefetch_first(
    const Entry& entry) const {
  if (triangulation.triangulation_.dimension() < 2 || entry.is_hidden()) return;
  detail::prefetch_around(entry.face->neighbor(entry.index));
}

// That of the lowest node that both ends of the edge are in; of the root for a hidden point.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::Queue_policy::part_of(const Subject& subject) const {
  if (subject.is_hidden()) return triangulation.division_.nodes() - 1;
  const auto& [face, i] = subject.edge;
  return triangulation.division_.node_of(face->vertex(Triangulation::cw(i))->point().id(),
                                         face->vertex(Triangulation::ccw(i))->point().id());
}

template <KineticTraits_2 Traits>
Queue_handle Kinetic_triangulation_2<Traits>::Queue_policy::handle(const Subject& subject) const {
  if constexpr (is_weighted) {
    if (subject.is_hidden()) return subject.hidden->event();
  }
  return subject.edge.first->event(subject.edge.second);
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::Queue_policy::set_handle(const Subject& subject,
                                                               Queue_handle handle) const {
  if constexpr (is_weighted) {
    if (subject.is_hidden()) return subject.hidden->set_event(handle);
  }
  set_event(triangulation.two_sided(subject.edge), handle);
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_event(const Two_sided_edge& edge, Queue_handle handle) {
  edge.here.first->set_event(edge.here.second, handle);
  edge.there.first->set_event(edge.there.second, handle);
}

// Puts the failure of an edge's certificate, which is of the given kind, into the queue, or the
// time to check it again. Returns no_event if it never fails. Mostly the entry is made in its
// place.
template <KineticTraits_2 Traits>
KINETRI_ALWAYS_INLINE Queue_handle Kinetic_triangulation_2<Traits>::push(
    const Edge& edge, Entry_kind kind, Certificate&& certificate) {
  if (certificate.kind == Certificate::Kind::never_fails) return no_event;
  if (certificate.failure == nullptr) return queue_.emplace(edge, kind, certificate);
  return queue_.push(Entry(edge, kind, certificate), std::move(*certificate.failure));
}

// Puts the entries of the edges' certificates from `after` on into the queue. Precondition: the
// edges have none.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::schedule(std::span<const Two_sided_edge> edges,
                                               const Time& after, Certificate_state state) {
  certify(edges, after, state, traits_, certificate_counters_,
          [this](const Two_sided_edge& edge, Entry_kind kind, Certificate&& certificate) {
            set_event(edge, push(edge.here, kind, std::move(certificate)));
          });
}

// Certifies an edge that has just been flipped, and the outer edges of its quadrilateral, seen from
// outside: counterclockwise, the first two are those of the face at the edge. The time of the flip
// is within `bounds`; `now` is a function that returns it, which is called only where that is
// needed. Calls put(edge, kind, certificate) for each of them; does nothing and returns false where
// the five are not certified together: a point is infinite, or the traits make no batches.
template <KineticTraits_2 Traits>
template <class Now, class Put>
inline bool Kinetic_triangulation_2<Traits>::certify_after_flip(
    const Two_sided_edge& edge, const std::array<Two_sided_edge, 4>& outer,
    const Double_interval& bounds, const Now& now, Certificate_counters& counters,
    const Put& put) const {
  if constexpr (BatchKineticTraits_2<Traits>) {
    const auto& [face, i] = edge.here;
    const auto& [neighbor, j] = edge.there;
    KINETRI_ASSERT(face->neighbor(i) == neighbor && neighbor->neighbor(j) == face,
                   "CGAL's flip turns the edge in its faces by one index");
    const std::array<Vertex_handle, 4> corners = {
        face->vertex(Triangulation::cw(i)), face->vertex(i), face->vertex(Triangulation::ccw(i)),
        neighbor->vertex(j)};
    bool are_finite = true;
    Flip_neighborhood<Point_2> around;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vertex_handle beyond = outer[k].here.first->vertex(outer[k].here.second);
      around.corners[k] = &corners[k]->point();
      around.beyond[k] = &beyond->point();
      are_finite = are_finite && !triangulation_.is_infinite(corners[k]) &&
                   !triangulation_.is_infinite(beyond);
    }
    if (!are_finite) return false;
    auto certificates = traits_.certificates_after_flip(around, bounds);
    for (std::size_t k = 0; k < certificates.size(); ++k) {
      const Two_sided_edge& e = k < 4 ? outer[k] : edge;
      Certificate& known = certificates[k];
      if (known.kind == Certificate::Kind::unknown) {
        known = certificate({Entry_kind::flip, around.certificate(k)}, now(),
                            k < 4 ? Certificate_state::any : Certificate_state::vanishes, traits_);
      }
      counters.count(known);
      const Entry_kind kind = first_failure(e, Entry_kind::flip, known, now, traits_, counters);
      put(e, kind, std::move(known));
    }
    return true;
  }
  return false;
}

// Schedules an edge that has just been flipped, and the outer edges of its quadrilateral, as
// certify_after_flip has them.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::schedule_after_flip(
    const Two_sided_edge& edge, const std::array<Two_sided_edge, 4>& outer) {
  const auto put = [this](const Two_sided_edge& e, Entry_kind kind, Certificate&& known) {
    set_event(e, push(e.here, kind, std::move(known)));
  };
  const auto now = [this]() -> const Time& { return current_time(); };
  if (!rebuilt_edges_ &&
      certify_after_flip(edge, outer, current_bounds(), now, certificate_counters_, put)) {
    return;
  }
  schedule({&edge, 1}, current_time(),
           rebuilt_edges_ ? Certificate_state::any : Certificate_state::vanishes);
  schedule(outer, current_time());
}

// Faces that have all edges, infinite ones too: in dimension 1, a face for each edge.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::faces() const -> std::vector<Face_handle> {
  std::vector<Face_handle> result;
  if (triangulation_.dimension() < 1) return result;
  if (triangulation_.dimension() == 1) {
    for (const Edge& edge : triangulation_.all_edges()) result.push_back(edge.first);
    return result;
  }
  result.reserve(2 * number_of_points_);
  for (const Face_handle face : triangulation_.all_face_handles()) result.push_back(face);
  return result;
}

// Calls `function` with each edge that is the face's own: every edge is that of one of its faces.
template <KineticTraits_2 Traits>
template <class Function>
void Kinetic_triangulation_2<Traits>::for_each_own_edge(Face_handle face, Function function) const {
  if (triangulation_.dimension() == 1) return function(Edge(face, 2));
  for (int i = 0; i < 3; ++i) {
    if (face < face->neighbor(i)) function(Edge(face, i));
  }
}

// Whether the ids of an edge choose this side of it, and so not the other. Addresses, by which an
// edge is that of one of its faces, are others in each run.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::is_chosen_side(const Edge& edge) {
  const auto& [face, i] = edge;
  return face->vertex(Triangulation::cw(i))->point().id() <
         face->vertex(Triangulation::ccw(i))->point().id();
}

// The same edge, from the side that its ids choose: certificates are rounded otherwise from the
// other side.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::chosen_side(const Two_sided_edge& edge) -> Two_sided_edge {
  return is_chosen_side(edge.here) ? edge : Two_sided_edge{edge.there, edge.here};
}

// All edges, infinite ones too.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::edges() const -> std::vector<Edge> {
  std::vector<Edge> result;
  for (const Face_handle face : faces()) {
    for_each_own_edge(face, [&](const Edge& edge) { result.push_back(edge); });
  }
  return result;
}

// Schedules every edge; the queue is empty. Several threads do so, each for a block of faces, whose
// edges have the handles that follow those of the block before.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::schedule_all() {
  constexpr std::size_t faces_per_block = 512;
  const std::vector<Face_handle> all = faces();
  std::vector<Block> blocks;
  Queue_handle size = 0;
  for (std::size_t first = 0; first < all.size(); first += faces_per_block) {
    const std::size_t count = std::min(faces_per_block, all.size() - first);
    Block& block = blocks.emplace_back();
    block.faces = std::span(all).subspan(first, count);
    block.after = current_time().detached();
    block.next_handle = size;
    for (const Face_handle face : block.faces) {
      for_each_own_edge(face, [&](const Edge&) { ++size; });
    }
  }
  queue_.assign(size, [&](const auto& put) {
    detail::for_each_in_parallel(blocks, [&](Block& block) { schedule_block(block, put); });
    for (const Block& block : blocks) certificate_counters_ += block.counters;
  });
  if constexpr (is_weighted) {
    for (const Vertex_handle v : triangulation_.hidden_vertex_handles()) {
      hidden_points().schedule(v, current_time());
    }
  }
}

// Puts the entries of the block's edges into the queue.
template <KineticTraits_2 Traits>
template <class Put>
void Kinetic_triangulation_2<Traits>::schedule_block(Block& block, const Put& put) const {
  const auto put_entry = [&](const Two_sided_edge& edge, Entry_kind kind,
                             Certificate&& certificate) {
    const bool may_fail = certificate.kind != Certificate::Kind::never_fails;
    const Queue_handle handle = may_fail ? block.next_handle : no_event;
    ++block.next_handle;
    set_event(edge, handle);
    if (!may_fail) return;
    const Entry entry(edge.here, kind, certificate);  // before its time is moved out
    put(handle, entry, std::move(certificate.failure));
  };
  // Some faces at a time, whose memory is asked for in time.
  constexpr std::size_t edges_at_once = 64;
  std::vector<Two_sided_edge> edges;
  edges.reserve(edges_at_once + 3);
  const auto certify_edges = [&] {
    certify(edges, block.after, Certificate_state::any, traits_, block.counters, put_entry);
    edges.clear();
  };
  for (std::size_t k = 0; k < block.faces.size(); ++k) {
    if (k + 6 < block.faces.size()) detail::prefetch(block.faces[k + 6]);
    if (k + 3 < block.faces.size()) detail::prefetch_around(block.faces[k + 3]);
    for_each_own_edge(block.faces[k],
                      [&](const Edge& own) { edges.push_back(chosen_side(two_sided(own))); });
    if (edges.size() >= edges_at_once) certify_edges();
  }
  certify_edges();
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::unschedule(const Two_sided_edge& edge,
                                                 Triangulation_counters& counters) {
  const Queue_handle handle = edge.here.first->event(edge.here.second);
  if (handle == no_event) return;
  const Entry entry = queue_.erase(handle);
  if (entry.kind != Entry_kind::recheck) {
    ++counters.discarded[static_cast<std::size_t>(event_kind(entry.kind))];
  }
}

template <KineticTraits_2 Traits>
Event_kind Kinetic_triangulation_2<Traits>::event_kind(Entry_kind failure) {
  switch (failure) {
    case Entry_kind::flip:
      return Event_kind::flip;
    case Entry_kind::hull_insert:
      return Event_kind::hull_insert;
    case Entry_kind::hull_remove:
      return Event_kind::hull_remove;
    case Entry_kind::hidden:
      return Event_kind::reveal;
    default:
      return Event_kind::rebuild;
  }
}

// ---- the present time ----

// Makes the time of a failure the present one. It need not be made: mostly its bounds are enough,
// until the next event comes.
template <KineticTraits_2 Traits>
inline void Kinetic_triangulation_2<Traits>::set_current_time(const Entry& entry) {
  if (entry.time != detail::Time_pool::none) return set_current_time(queue_.time_of(entry));
  pending_time_ = {certificate_points(entry), entry.bounds};
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_current_time(Time time) {
  pending_time_.reset();
  current_time_ = std::move(time);
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::current_time() const -> const Time& {
  if (pending_time_) {
    current_time_ = failure_time(pending_time_->first, pending_time_->second);
    pending_time_.reset();
  }
  return current_time_;
}

template <KineticTraits_2 Traits>
inline Double_interval Kinetic_triangulation_2<Traits>::current_bounds() const {
  return pending_time_ ? pending_time_->second : current_time().interval();
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_SCHEDULING_IMPL_H
