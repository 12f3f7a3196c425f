// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: one flip, and how it is undone.
#ifndef KINETRI_TRIANGULATION_DETAIL_REGION_FLIPS_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_REGION_FLIPS_IMPL_H

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/regions.h"

namespace kinetri::detail {

template <class Kinetic>
auto Region_run<Kinetic>::moment_of(const Entry& entry, const Two_sided_edge& edge,
                                    const Part& part) const -> Moment {
  Moment result{kinetic_.certificate_points(edge), entry.bounds, std::nullopt};
  if (entry.time != Time_pool::none) result.exact = part.time_of(entry);
  return result;
}

template <class Kinetic>
auto Region_run<Kinetic>::time(Moment& moment) const -> const Time& {
  if (!moment.exact) moment.exact = kinetic_.failure_time(moment.points, moment.bounds);
  return *moment.exact;
}

// The order of two times: negative, zero or positive.
template <class Kinetic>
int Region_run<Kinetic>::compare(Moment& a, Moment& b) const {
  if (&a == &b) return 0;
  if (a.bounds.upper < b.bounds.lower) return -1;
  if (b.bounds.upper < a.bounds.lower) return 1;
  const auto order = time(a) <=> time(b);
  return order < 0 ? -1 : (order > 0 ? 1 : 0);
}

template <class Kinetic>
auto Region_run<Kinetic>::lane_of(Stamp stamp) const -> const Lane& {
  const std::size_t number = (stamp - 1) >> index_bits;
  return number < regions_ ? lanes_[number] : rest_;
}

// Stamps of windows before this one are left in the faces.
template <class Kinetic>
bool Region_run<Kinetic>::is_of_window(Stamp stamp) const {
  return stamp != 0 &&
         ((stamp - 1) & ((std::size_t{1} << index_bits) - 1)) >= lane_of(stamp).flips_before;
}

template <class Kinetic>
auto Region_run<Kinetic>::flip(Stamp stamp) -> Flip& {
  Lane& lane = const_cast<Lane&>(lane_of(stamp));
  return lane.flips[((stamp - 1) & ((std::size_t{1} << index_bits) - 1)) - lane.flips_before];
}

template <class Kinetic>
bool Region_run<Kinetic>::is_later(Stamp stamp, Moment& moment) {
  return is_of_window(stamp) && compare(flip(stamp).moment, moment) > 0;
}

// ---- before a flip ----

template <class Kinetic>
bool Region_run<Kinetic>::is_owned(const Two_sided_edge& edge, std::size_t region) const {
  const auto owns = [&](Vertex_handle v) {
    return !kinetic_.triangulation_.is_infinite(v) && kinetic_.owners_[v->point().id()] == region;
  };
  const auto& [face, i] = edge.here;
  return owns(face->vertex(i)) && owns(face->vertex(Triangulation::cw(i))) &&
         owns(face->vertex(Triangulation::ccw(i))) &&
         owns(edge.there.first->vertex(edge.there.second));
}

// Whether another entry in the surroundings is not later than this one, which is the first of its
// part. (No flip there is later: all are of this lane. Entries of the lane's part come after this
// one, and those of the shared part after the window.)
template <class Kinetic>
bool Region_run<Kinetic>::is_blocked(Lane& lane, const Entry& entry, const Two_sided_edge& edge) {
  Part& part = queue().part(lane.number);
  const auto blocks = [&](Queue_handle handle) {
    if (handle == no_event) return false;
    const std::size_t number = queue().part_of(handle);
    if (number == lane.number || number == shared_part()) return false;
    const Entry& other = queue()[handle];
    if (other.bounds.lower > entry.bounds.upper) return false;
    if (other.bounds.upper < entry.bounds.lower) return true;
    return queue().part(number).time_of(other) <= part.time(part.top());
  };
  const auto is_face_blocked = [&](Face_handle face) {
    return blocks(face->event(0)) || blocks(face->event(1)) || blocks(face->event(2));
  };
  for (const Edge& side : {edge.here, edge.there}) {
    const auto& [face, i] = side;
    if (is_face_blocked(face) || is_face_blocked(face->neighbor(Triangulation::cw(i))) ||
        is_face_blocked(face->neighbor(Triangulation::ccw(i)))) {
      return true;
    }
  }
  return false;
}

// Whether the plain loop flips the edge of an entry that is no coincidence: of the flat triangles
// at the hull some only touch it, and some take a reconstruction; see
// Kinetic_triangulation_2::execute.
template <class Kinetic>
bool Region_run<Kinetic>::is_flip(const Entry& entry, const Two_sided_edge& edge, Moment& moment) {
  if (entry.kind != Entry_kind::hull_insert) return true;
  const Time before = kinetic_.current_time();
  kinetic_.set_current_time(time(moment));
  const bool result =
      !kinetic_.may_hide_a_turn(edge) &&
      (entry.changes_sign || !kinetic_.is_touch(kinetic_.hull_triangle(edge).first)) &&
      !kinetic_.are_all_collinear(edge) && kinetic_.can_insert_into_hull(edge);
  kinetic_.set_current_time(before);
  return result;
}

// Undoes the flips in the surroundings of an edge that are later than the moment.
template <class Kinetic>
void Region_run<Kinetic>::undo_later(const Two_sided_edge& edge, Moment& moment) {
  for (const Edge& side : {edge.here, edge.there}) {
    const auto& [face, i] = side;
    KINETRI_ASSERT(!is_later(face->stamp(), moment),
                   "a flip at a face whose edge has an entry before it");
    for (const int k : {Triangulation::cw(i), Triangulation::ccw(i)}) {
      // Another face may be beside it then.
      while (is_later(face->neighbor(k)->stamp(), moment)) undo(face->neighbor(k)->stamp());
    }
  }
}

// ---- a flip ----

// Counterclockwise from the corner of the face: as in Kinetic_triangulation_2::flip_edge.
template <class Kinetic>
auto Region_run<Kinetic>::outer_edges(const Two_sided_edge& edge) const -> Outer_edges {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  return {kinetic_.two_sided(Edge(face, Triangulation::cw(i))),
          kinetic_.two_sided(Edge(neighbor, Triangulation::ccw(j))),
          kinetic_.two_sided(Edge(neighbor, Triangulation::cw(j))),
          kinetic_.two_sided(Edge(face, Triangulation::ccw(i)))};
}

// The part into which a lane puts an entry.
template <class Kinetic>
std::size_t Region_run<Kinetic>::part_for(const Lane& lane, const Entry& entry) const {
  if (lane.number < regions_) return lane.number;
  return entry.bounds.lower <= due_until_ ? due_part() : kinetic_.queue_policy_.part_of(entry);
}

// Puts the entry of an edge into the lane's part, or where it belongs, and its handle into the
// faces.
template <class Kinetic>
void Region_run<Kinetic>::put(const Lane& lane, const Two_sided_edge& edge, Entry_kind kind,
                              Certificate&& known) {
  if (known.kind == Certificate::Kind::never_fails) return kinetic_.set_event(edge, no_event);
  const Entry entry(edge.here, kind, known);
  const std::size_t to = part_for(lane, entry);
  const Queue_handle handle = known.failure == nullptr
                                  ? queue().part(to).emplace(entry)
                                  : queue().part(to).push(entry, std::move(*known.failure));
  kinetic_.set_event(edge, queue().named(to, handle));
}

// Flips an edge whose entry has been taken from its part, as flip_edge does, and keeps what undoes
// it.
template <class Kinetic>
void Region_run<Kinetic>::execute(Lane& lane, const Entry& entry, const Two_sided_edge& edge,
                                  Moment moment) {
  const auto [face, i] = edge.here;
  const auto [neighbor, j] = edge.there;
  const Outer_edges before = outer_edges(edge);
  for (const auto& [here, there] : before) {
    detail::prefetch(there.first->vertex(there.second));
    queue().prefetch(there.first->event(there.second));
  }
  Flip& f = lane.flips.emplace_back();
  f.kind = Kinetic::event_kind(entry.kind);
  std::tie(f.removed, f.added) = Kinetic::flipped_edges(edge);
  f.face = face;
  f.neighbor = neighbor;
  f.i = i;
  f.j = j;
  f.right_had_face = face->vertex(Triangulation::cw(i))->face() == face;
  f.left_had_neighbor = face->vertex(Triangulation::ccw(i))->face() == neighbor;
  f.entries[0] = entry;
  f.entries[0].time = Time_pool::none;
  f.has_entry[0] = true;
  if (moment.exact) f.exact_times.emplace_back(0, *moment.exact);
  for (std::size_t k = 1; k < 5; ++k) {
    const Edge& outer = before[k - 1].here;
    const Queue_handle handle = outer.first->event(outer.second);
    f.has_entry[k] = handle != no_event;
    if (handle == no_event) continue;
    const Entry& old = queue()[handle];
    if (old.time != Time_pool::none) {
      f.exact_times.emplace_back(k, queue().part(queue().part_of(handle)).time_of(old));
    }
    f.entries[k] = queue().erase(handle);
    if (f.entries[k].kind != Entry_kind::recheck) {
      ++lane.counters.discarded[static_cast<std::size_t>(Kinetic::event_kind(f.entries[k].kind))];
    }
  }
  f.previous = {face->stamp(), neighbor->stamp()};
  const std::size_t index = lane.flips.size() - 1;
  const double reached = index > 0 ? lane.keys.back().reached : moment.bounds.lower;
  lane.keys.push_back({moment.bounds, std::max(reached, moment.bounds.lower),
                       static_cast<std::uint32_t>(index), static_cast<std::uint16_t>(lane.number),
                       f.kind});
  const Stamp number = stamp(lane, index);
  face->set_stamp(number);
  neighbor->set_stamp(number);
  kinetic_.triangulation_.tds().flip(face, i);
  const Two_sided_edge added = {Edge(face, Triangulation::ccw(i)),
                                Edge(neighbor, Triangulation::ccw(j))};
  const Outer_edges outer = {{{before[0].there, Edge(face, Triangulation::cw(i))},
                              {before[1].there, Edge(face, i)},
                              {before[2].there, Edge(neighbor, Triangulation::cw(j))},
                              {before[3].there, Edge(neighbor, j)}}};
  f.moment = std::move(moment);
  const auto now = [&]() -> const Time& { return time(f.moment); };
  const auto put_entry = [&](const Two_sided_edge& e, Entry_kind kind, Certificate&& known) {
    put(lane, e, kind, std::move(known));
  };
  const Double_interval bounds = f.moment.exact ? f.moment.exact->interval() : f.moment.bounds;
  if (kinetic_.certify_after_flip(added, outer, bounds, now, lane.certificates, put_entry)) return;
  kinetic_.certify({&added, 1}, now(), Certificate_state::vanishes, kinetic_.traits_,
                   lane.certificates, put_entry);
  kinetic_.certify(outer, now(), Certificate_state::any, kinetic_.traits_, lane.certificates,
                   put_entry);
}

// Undoes a flip: first those that were executed after it and conflict with it.
template <class Kinetic>
void Region_run<Kinetic>::undo(Stamp number) {
  // The last flip at a face or beside it.
  const auto last_at = [&](Face_handle face) {
    Stamp last = 0;
    for (const Face_handle f : {face, face->neighbor(0), face->neighbor(1), face->neighbor(2)}) {
      if (is_of_window(f->stamp())) last = std::max(last, f->stamp());
    }
    return last;
  };
  std::vector<Stamp> waiting = {number};  // each for the one after it
  while (!waiting.empty()) {
    const Flip& f = flip(waiting.back());
    const Stamp last = std::max(last_at(f.face), last_at(f.neighbor));
    if (last > waiting.back()) {
      waiting.push_back(last);
    } else {
      undo_last(waiting.back());
      waiting.pop_back();
    }
  }
}

// Undoes a flip that no other one after it conflicts with. Then the surroundings are what they were
// just before it, and the entries of then are true again.
template <class Kinetic>
void Region_run<Kinetic>::undo_last(Stamp number) {
  Flip& f = flip(number);
  KINETRI_ASSERT(f.face->stamp() == number && f.neighbor->stamp() == number,
                 "the last flip of its faces");
  ++counters_.undone;
  f.is_undone = true;
  const_cast<Lane&>(lane_of(number)).has_undone = true;
  const auto erase = [&](Face_handle face, int k) {
    if (face->event(k) != no_event) queue().erase(face->event(k));
  };
  for (int k = 0; k < 3; ++k) erase(f.face, k);
  erase(f.neighbor, f.j);
  erase(f.neighbor, Triangulation::cw(f.j));
  // The flip in reverse. It has left neighbors around as CGAL's flip has them.
  const Vertex_handle right = f.neighbor->vertex(Triangulation::ccw(f.j));
  const Vertex_handle left = f.face->vertex(Triangulation::ccw(f.i));
  const Edge at_bottom = kinetic_.two_sided(Edge(f.face, f.i)).there;
  const Edge at_top = kinetic_.two_sided(Edge(f.neighbor, f.j)).there;
  auto& tds = kinetic_.triangulation_.tds();
  f.face->set_vertex(Triangulation::cw(f.i), right);
  f.neighbor->set_vertex(Triangulation::cw(f.j), left);
  tds.set_adjacency(f.face, f.i, f.neighbor, f.j);
  tds.set_adjacency(f.face, Triangulation::ccw(f.i), at_top.first, at_top.second);
  tds.set_adjacency(f.neighbor, Triangulation::ccw(f.j), at_bottom.first, at_bottom.second);
  if (f.right_had_face) right->set_face(f.face);
  if (f.left_had_neighbor) left->set_face(f.neighbor);
  f.face->set_stamp(f.previous[0]);
  f.neighbor->set_stamp(f.previous[1]);
  const Two_sided_edge edge = {Edge(f.face, f.i), Edge(f.neighbor, f.j)};
  const Outer_edges outer = outer_edges(edge);
  for (std::size_t k = 0; k < 5; ++k) {
    const Two_sided_edge& e = k == 0 ? edge : outer[k - 1];
    if (!f.has_entry[k]) {
      kinetic_.set_event(e, no_event);
      continue;
    }
    const auto exact = std::ranges::find(f.exact_times, k, &std::pair<std::size_t, Time>::first);
    const std::size_t to = part_for(rest_, f.entries[k]);
    const Queue_handle handle = exact == f.exact_times.end()
                                    ? queue().part(to).emplace(f.entries[k])
                                    : queue().part(to).push(f.entries[k], exact->second);
    kinetic_.set_event(e, queue().named(to, handle));
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_REGION_FLIPS_IMPL_H
