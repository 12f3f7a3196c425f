// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2: the run of time, and the events.
#ifndef KINETRI_IMPL_TRIANGULATION_EVENTS_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_EVENTS_IMPL_H

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/region_runs.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

// ---- time ----

// Has certificates checked again until the first entry of the queue is a failure, or is later than
// `until`, if that is given. Returns whether it is a failure, at or before `until`.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::settle(const Time* until) {
  if (until == nullptr) return settle_while([](const Entry& /*entry*/) { return true; });
  const auto exact = [until]() -> const Time& { return *until; };
  return settle_while(
      [&](const Entry& entry) { return queue_.is_due(entry, until->interval(), exact); });
}

// The same until the present time.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::settle_now() {
  const auto exact = [this]() -> const Time& { return current_time(); };
  return settle_while(
      [&](const Entry& entry) { return queue_.is_due(entry, current_bounds(), exact); });
}

template <KineticTraits_2 Traits>
template <class Is_due>
inline bool Kinetic_triangulation_2<Traits>::settle_while(const Is_due& is_due) {
  return queue_.settle(is_due, [this](std::span<const Entry> entries) { recheck(entries); });
}

// Certifies the edges of entries anew, from the time of the first entry on, at which the
// certificates of the others hold as well: two together cost less than one by one.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::recheck(std::span<const Entry> entries) {
  counters_.rechecks += entries.size();
  std::array<Two_sided_edge, 2> edges;
  std::size_t number = 0;
  const Time after(entries.front().bounds.lower);
  for (const Entry& entry : entries) {
    if constexpr (is_weighted) {
      if (entry.is_hidden()) {
        hidden_points().schedule(entry.hidden, after);
        continue;
      }
    }
    edges[number++] = two_sided(entry.edge());
  }
  schedule(std::span(edges).first(number), after);
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::next_event_time() -> std::optional<Time> {
  const detail::Flag_while changing = start_change();
  if (!settle(nullptr)) return std::nullopt;
  return queue_.time(queue_.top());
}

template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::has_event_before(const Time& time) const {
  if (queue_.empty() || queue_.time_of(queue_.top()) >= time) return false;
  if (queue_.top().kind != Entry_kind::recheck) return true;
  bool result = false;
  queue_.for_each([&](const Entry& entry) { result = result || fails_before(entry, time); });
  return result;
}

// Whether the failure of the entry's certificate is before `time`. Checks certificates again, as
// `settle` does, but keeps nothing of what it finds.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::fails_before(const Entry& entry, const Time& time) const {
  if (entry.bounds.lower > time.interval().upper) return false;
  if (entry.kind != Entry_kind::recheck) return queue_.time_of(entry) < time;
  Time checked(entry.bounds.lower);
  while (checked < time) {
    const auto [points, next] = certificate_of(entry, checked, traits_);
    if (next.kind == Certificate::Kind::never_fails) return false;
    if (next.kind == Certificate::Kind::fails) {
      return (next.failure ? *next.failure : failure_time(points, next.bounds)) < time;
    }
    checked = Time(next.bounds.lower);
  }
  return false;
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step() {
  return step_until(nullptr);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step(const Time& until) {
  return step_until(&until);
}

// Points may meet, and part, without an event.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step_until(const Time* until) {
  const detail::Flag_while changing = start_change();
  join_parts();
  return step_in_parts(until);
}

// The same where the queue may stay in parts.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step_in_parts(const Time* until) {
  std::size_t events = 0;
  while (events == 0 && settle(until)) {
    events = run_instant();
    show_current_time();
  }
  return events;
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::advance_to(const Time& time) {
  return advance_to(time, nullptr);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::advance_to(const Time& time,
                                                        const std::function<bool()>& may_go_on) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(
      time >= current_time(),
      "the time to advance to is in the past; take the present one or a later one, "
      "or call reverse first");
  if constexpr (detail::has_region_runs<Traits>) {
    if (detail::may_pay_by_regions(number_of_points_, threads_)) {
      return detail::Region_runs<Kinetic_triangulation_2>::advance_to(*this, time, may_go_on);
    }
  }
  join_parts();
  return run_to(time, may_go_on);
}

// Ends what runs by regions have left divided, so that single events cost what they should.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::join_parts() {
  if constexpr (detail::has_region_runs<Traits>) {
    if (queue_.is_divided()) detail::Region_runs<Kinetic_triangulation_2>::join(*this);
  }
}

// The plain loop: event by event.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::run_to(const Time& time,
                                                    const std::function<bool()>& may_go_on) {
  std::size_t events = 0;
  bool goes_on = true;
  while (goes_on && settle(&time)) {
    goes_on = may_go_on == nullptr || may_go_on();
    if (goes_on) events += run_instant();
  }
  if (goes_on) set_current_time(time);
  show_current_time();
  return events;
}

// Sets the instant of the predicates that the triangulation gives out. Events do so where somebody
// looks on or a predicate is needed: it costs a copy of the time.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::show_current_time() {
  clock_.set({current_time(), Time_side::after});
}

// Executes every event of the time t that is first in the queue. Each flip makes the triangulation
// more nearly Delaunay just after t, and an edge that a flip leaves violated just after t has its
// event at t itself; so the state is Delaunay just after t when no event at t is left. docs/MATH.md
// has the argument, and why it ends.
template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::run_instant() {
  events_in_instant_ = 0;
  hull_is_flat_ = false;
  if (queue_.top().kind == Entry_kind::coincidence) {
    set_current_time(queue_.time(queue_.top()));
    show_current_time();
    set_coincident_points_aside();
  } else {
    set_current_time(queue_.top());
    if (!observers_.empty()) show_current_time();
    execute(queue_.pop());
  }
  execute_due_events();
  put_points_back();
  report_rebuild();
  report_hiding();
  ++counters_.instants;
  if (events_in_instant_ > 1) ++counters_.batches;
  if (hull_is_flat_) ++counters_.flat_hulls;
  counters_.largest_instant = std::max(counters_.largest_instant, events_in_instant_);
  return static_cast<std::size_t>(events_in_instant_);
}

// ---- events ----

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::execute_due_events() {
  do {
    while (settle_now()) execute(queue_.pop());
  } while (retry_postponed());
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::execute(const Entry& event) {
  KINETRI_ASSERT(event.kind >= Entry_kind::hull_insert,
                 "an event is a failure, and coincident points have been set aside");
  if constexpr (is_weighted) {
    if (event.is_hidden()) return hidden_points().execute(event);
  }
  const Two_sided_edge edge = two_sided(event.edge());
  if (event.kind == Entry_kind::hull_insert) {
    if (may_hide_a_turn(edge)) return rebuild();
    if (!event.changes_sign && is_touch(hull_triangle(edge).first)) {
      if (do_corners_meet(hull_triangle(edge).first)) return rebuild();
      return schedule({&edge, 1}, current_time());
    }
    hull_is_flat_ = true;
    if constexpr (is_weighted) {
      const Vertex_handle hidden =
          weights_are_equal_ ? Vertex_handle() : hidden_points().hidden_hull_vertex(edge);
      if (hidden != Vertex_handle()) {
        set_event(edge, no_event);
        return hidden_points().hide(hidden);
      }
    }
    if (are_all_collinear(edge) || !can_insert_into_hull(edge)) return rebuild();
  }
  if constexpr (is_weighted) {
    if (event.kind == Entry_kind::flip && !weights_are_equal_) {
      if (event.changes_sign) return flip_or_hide(edge);
      const auto after = traits_.instantaneous_traits({current_time(), Time_side::after});
      const auto& [p, q, r, s] = certificate_points(edge).points;
      const auto side = after.power_side_of_oriented_power_circle_2_object();
      if (side(*p, *q, *r, *s) == CGAL::ON_POSITIVE_SIDE) return flip_or_hide(edge);
      // A touch. A triangle whose corners, lifted, are on one line now may turn over.
      if (!is_touch(edge.here.first) || !is_touch(edge.there.first)) return rebuild();
      return schedule({&edge, 1}, current_time());
    }
  }
  flip_edge(edge, event_kind(event.kind));
}

// Flips an edge if that leaves the triangulation embedded, or hides a vertex of degree 3. Otherwise
// another event of the present time has to come first.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::flip_or_hide(const Two_sided_edge& edge) {
  if constexpr (is_weighted) {
    bool can_be_flipped = false;
    const Vertex_handle hidden = hidden_points().hidden_end(edge, can_be_flipped);
    if (can_be_flipped) return flip_edge(edge, Event_kind::flip);
    set_event(edge, no_event);
    if (hidden != Vertex_handle()) return hidden_points().hide(hidden);
    postponed_.push_back(ids_of(edge.here));
  }
}

// When no event is due: schedules the postponed edges again if something has happened since, and
// reconstructs the triangulation otherwise. Returns whether there were any.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::retry_postponed() {
  if (postponed_.empty()) return false;
  const bool is_stuck = changes_ == changes_before_retry_;
  changes_before_retry_ = changes_;
  if (is_stuck) {
    rebuild();
    return true;
  }
  for (const auto& [a, b] : std::exchange(postponed_, {})) {
    Edge edge;
    if (!contains(a) || !contains(b) || is_hidden(a) || is_hidden(b) ||
        !triangulation_.is_edge(vertices_[a], vertices_[b], edge.first, edge.second) ||
        edge.first->event(edge.second) != no_event) {
      continue;
    }
    const Two_sided_edge both = two_sided(edge);
    schedule({&both, 1}, current_time());
  }
  return true;
}

// The finite triangle at a hull edge, seen from that edge.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::hull_triangle(const Two_sided_edge& hull_edge) const
    -> const Edge& {
  return triangulation_.is_infinite(hull_edge.here.first) ? hull_edge.there : hull_edge.here;
}

// Whether a triangle, flat at this time, makes a left turn just after it.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::is_touch(Face_handle face) const {
  const auto after = traits_.instantaneous_traits({current_time(), Time_side::after});
  return after.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      face->vertex(2)->point()) == CGAL::LEFT_TURN;
}

// Whether two corners of a triangle, whose weights may differ, are in one place at this time. They
// may exchange their order along a side of the hull on which all their neighbors are, so that no
// orientation changes its sign.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::do_corners_meet(Face_handle face) const {
  if (weights_are_equal_) return false;  // they have been set aside
  const auto now = traits_.instantaneous_traits({current_time(), Time_side::at});
  const auto meet = [&](int i, int j) {
    const Point_2& p = face->vertex(i)->point();
    const Point_2& q = face->vertex(j)->point();
    return now.compare_x_2_object()(p, q) == CGAL::EQUAL &&
           now.compare_y_2_object()(p, q) == CGAL::EQUAL;
  };
  return meet(0, 1) || meet(1, 2) || meet(2, 0);
}

// Whether the triangle at a hull edge and one beside it are flat at this time and one of the two
// does not turn over: then others may turn over behind it that no hull edge tells of.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::may_hide_a_turn(const Two_sided_edge& hull_edge) const {
  const auto now = traits_.instantaneous_traits({current_time(), Time_side::at});
  const auto& [face, i] = hull_triangle(hull_edge);
  for (const int j : {Triangulation::cw(i), Triangulation::ccw(i)}) {
    const Face_handle beside = face->neighbor(j);
    if (!triangulation_.is_infinite(beside) &&
        now.orientation_2_object()(beside->vertex(0)->point(), beside->vertex(1)->point(),
                                   beside->vertex(2)->point()) == CGAL::COLLINEAR &&
        (is_touch(face) || is_touch(beside))) {
      return true;
    }
  }
  return false;
}

// Whether all points lie on the line of a hull edge, whose triangle is flat at this time. Usually
// the first one that is looked at does not.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::are_all_collinear(const Two_sided_edge& hull_edge) const {
  const Face_handle face = hull_triangle(hull_edge).first;
  const auto now = traits_.instantaneous_traits({current_time(), Time_side::at});
  return std::ranges::all_of(triangulation_.finite_vertex_handles(), [&](Vertex_handle v) {
    return face->has_vertex(v) ||
           now.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      v->point()) == CGAL::COLLINEAR;
  });
}

// Whether the triangle at a hull edge, flat at this time, can be taken away: its apex lies between
// the ends of the edge, and is no hull vertex yet. Otherwise several hull triangles went flat
// together, possibly all of the triangulation.
template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::can_insert_into_hull(const Two_sided_edge& hull_edge) const {
  const auto& [face, i] = hull_triangle(hull_edge);
  const Vertex_handle apex = face->vertex(i);
  if (triangulation_.is_edge(apex, triangulation_.infinite_vertex())) return false;
  const auto now = traits_.instantaneous_traits({current_time(), Time_side::at});
  return now.collinear_are_strictly_ordered_along_line_2_object()(
      face->vertex(Triangulation::cw(i))->point(), apex->point(),
      face->vertex(Triangulation::ccw(i))->point());
}

// Reports `event`, now, to the observers around `change_edges`, which makes it happen. While edges
// are noted they are only noted.
template <KineticTraits_2 Traits>
template <class Change_edges>
void Kinetic_triangulation_2<Traits>::report(Event event, Change_edges change_edges) {
  if (rebuilt_edges_) {
    if (event.removed) rebuilt_edges_->note(*event.removed, -1);
    if (event.added) rebuilt_edges_->note(*event.added, 1);
    return change_edges();
  }
  event.number = counters_.number_of_events();
  if (!observers_.empty()) event.time = current_time();
  is_in_event_ = true;
  observers_.call([&](Observer& observer) { observer.before_event(event); });
  change_edges();
  count_event(event.kind);
  observers_.call([&](Observer& observer) { observer.after_event(event); });
  is_in_event_ = false;
}

// Flips an edge, finite or infinite, whose event has been taken from the queue:
//
//         c                  c
//       / | \              /   \           The four outer edges keep their place but get a new
//      a  |  b    ==>     a --- b          opposite vertex, and the diagonal is new: five
//       \ | /              \   /           certificates are made anew.
//         d                  d
//
// The outer edges' entries leave the queue first, while the corners that they speak of are there.
template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::flip_edge(const Two_sided_edge& edge, Event_kind kind) {
  const Face_handle face = edge.here.first;
  const int i = edge.here.second;
  const Face_handle neighbor = edge.there.first;
  const int j = edge.there.second;
  // Counterclockwise from the corner a of the face.
  const std::array<Two_sided_edge, 4> before = {two_sided(Edge(face, Triangulation::cw(i))),
                                                two_sided(Edge(neighbor, Triangulation::ccw(j))),
                                                two_sided(Edge(neighbor, Triangulation::cw(j))),
                                                two_sided(Edge(face, Triangulation::ccw(i)))};
  for (const auto& [here, there] : before) {
    detail::prefetch(there.first->vertex(there.second));
    queue_.prefetch(there.first->event(there.second));
  }
  ++changes_;
  std::array<Face_handle, 2> faces = {face, neighbor};
  if constexpr (is_weighted) {
    // A hidden point on the new edge is in both faces: which one comes first must not depend on the
    // side of the edge that its entry names.
    if (!is_chosen_side(edge.here)) std::swap(faces[0], faces[1]);
  }
  const auto flip = [&] {
    for (const Two_sided_edge& outer : before) unschedule(outer);
    std::vector<Vertex_handle> hidden;
    if constexpr (is_weighted) hidden = hidden_points().take(faces);
    triangulation_.tds().flip(face, i);
    schedule_after_flip({Edge(face, Triangulation::ccw(i)), Edge(neighbor, Triangulation::ccw(j))},
                        {{{before[0].there, Edge(face, Triangulation::cw(i))},
                          {before[1].there, Edge(face, i)},
                          {before[2].there, Edge(neighbor, Triangulation::cw(j))},
                          {before[3].there, Edge(neighbor, j)}}});
    if constexpr (is_weighted) hidden_points().put(hidden, faces);
  };
  if (rebuilt_edges_ || !observers_.empty()) {
    const auto [removed, added] = flipped_edges(edge);
    report(flip_event(kind, removed, added), flip);
  } else {
    flip();
    count_event(kind);
  }
}

// Takes the points out that the faces at an edge hide.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::take_hidden_at(const Edge& edge)
    -> std::vector<Vertex_handle> {
  if constexpr (is_weighted) {
    const std::array<Face_handle, 2> faces = {edge.first, edge.first->neighbor(edge.second)};
    return hidden_points().take(faces);
  }
  return {};
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::count_event(Event_kind kind) {
  ++counters_.events[static_cast<std::size_t>(kind)];
  ++events_in_instant_;
}

// What observers are told of a flip, but for its number and time.
template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::flip_event(Event_kind kind, const Edge_ids& removed,
                                                 const Edge_ids& added) -> Event {
  Event event;
  event.kind = kind;
  for (const auto& [ids, edge] : {std::pair(removed, &event.removed), {added, &event.added}}) {
    // The other end of an infinite edge, whose greater id is that of the infinite vertex.
    if (ids[1] == no_point) {
      event.apex = ids[0];
    } else {
      *edge = ids;
    }
  }
  return event;
}

// The edge that a flip removes and the one that it adds. The infinite vertex has the id no_point.
template <KineticTraits_2 Traits>
inline std::pair<Edge_ids, Edge_ids> Kinetic_triangulation_2<Traits>::flipped_edges(
    const Two_sided_edge& edge) {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  return {ids_of(edge.here),
          edge_ids(face->vertex(i)->point().id(), neighbor->vertex(j)->point().id())};
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_EVENTS_IMPL_H
