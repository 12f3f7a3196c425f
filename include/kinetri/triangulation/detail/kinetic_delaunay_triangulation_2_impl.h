// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2 but for its audits. Include this, and
// audit_impl.h, only where the class is instantiated for a kinetic traits class of one's own; it is
// compiled into the library for Linear_kinetic_traits_2.
#ifndef KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H

#include <algorithm>
#include <chrono>
#include <iterator>
#include <tuple>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

// ---- construction ----

template <KineticTraits_2 Traits>
Kinetic_delaunay_triangulation_2<Traits>::Kinetic_delaunay_triangulation_2(
    const std::vector<Motion>& motions, const Time& start, const Traits& traits)
    : traits_(traits), current_time_(start) {
  KINETRI_PRECONDITION(motions.size() < no_point, "too many points");
  std::vector<Point_2> points;
  points.reserve(motions.size());
  for (const Motion& motion : motions) {
    KINETRI_PRECONDITION(is_finite(motion), "a motion has a number that is not finite");
    points.emplace_back(motion, static_cast<Point_id>(points.size()));
  }
  vertices_.resize(points.size());
  const auto started = std::chrono::steady_clock::now();
  triangulation_ = build(points, start);
  index_vertices();
  const auto built = std::chrono::steady_clock::now();
  schedule_all();
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds_ = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::build(std::span<const Point_2> points,
                                                     const Time& time) const -> Triangulation {
  Triangulation result(traits_.instantaneous_traits({time, Side::after}));
  result.insert(points.begin(), points.end());
  if (result.number_of_vertices() == points.size()) return result;
  // CGAL keeps one vertex for points in one place. Points in one place just after a time are in one
  // place for ever.
  for (const Point_2& point : points) {
    const Point_id kept = result.nearest_vertex(point)->point().id();
    if (kept != point.id()) {
      throw Coincident_trajectories_error(std::min(kept, point.id()), std::max(kept, point.id()));
    }
  }
  throw Internal_error("a vertex is missing, but every point has one");
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::index_vertices() {
  for (const Vertex_handle v : triangulation_.finite_vertex_handles()) {
    vertices_[v->point().id()] = v;
  }
}

// ---- the present ----

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::vertex(Point_id id) const -> Vertex_handle {
  KINETRI_PRECONDITION(id < vertices_.size(), "no point has this id");
  return vertices_[id];
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::motion(Point_id id) const -> const Motion& {
  return vertex(id)->point().motion();
}

template <KineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_delaunay_triangulation_2<Traits>::finite_edge_ids() const {
  std::vector<Edge_ids> result;
  for (const Edge& edge : triangulation_.finite_edges()) result.push_back(ids_of(edge));
  std::ranges::sort(result);
  return result;
}

// ---- certificates ----

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::two_sided(const Edge& edge) const -> Two_sided_edge {
  if (triangulation_.dimension() < 2) return {edge, edge};
  return {edge, triangulation_.mirror_edge(edge)};
}

// Previous hull vertex, the edge's own, and the next one, counterclockwise around the hull, for an
// edge to the infinite vertex. In a face that lists (infinite, b, a) counterclockwise the hull
// runs from a to b.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::hull_turn(const Two_sided_edge& infinite_edge) const
    -> std::array<Vertex_handle, 3> {
  const auto& [face, i] = infinite_edge.here;
  const Vertex_handle here = face->vertex(i);
  const Vertex_handle there = infinite_edge.there.first->vertex(infinite_edge.there.second);
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(right)) return {here, left, there};
  return {there, right, here};
}

// The infinite vertex has the id no_point.
template <KineticTraits_2 Traits>
Edge_ids Kinetic_delaunay_triangulation_2<Traits>::ids_of(const Edge& edge) {
  return edge_ids(edge.first->vertex(Triangulation::cw(edge.second))->point().id(),
                  edge.first->vertex(Triangulation::ccw(edge.second))->point().id());
}

// Precondition: dimension 2.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::certificate(const Two_sided_edge& edge) const
    -> Certificate {
  const auto& [face, i] = edge.here;
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(left) || triangulation_.is_infinite(right)) {
    const auto [previous, here, next] = hull_turn(edge);
    return {Entry_kind::hull_remove, {&previous->point(), &here->point(), &next->point()}};
  }
  const Vertex_handle apex = face->vertex(i);
  const Vertex_handle opposite = edge.there.first->vertex(edge.there.second);
  if (triangulation_.is_infinite(apex)) {
    return {Entry_kind::hull_insert, {&left->point(), &right->point(), &opposite->point()}};
  }
  if (triangulation_.is_infinite(opposite)) {
    return {Entry_kind::hull_insert, {&right->point(), &left->point(), &apex->point()}};
  }
  return {Entry_kind::flip, {&right->point(), &left->point(), &apex->point(), &opposite->point()}};
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::outlook(const Certificate& certificate,
                                                       const Time& after, Certificate_state state,
                                                       const Traits& traits,
                                                       Certificate_counters& counters) const
    -> Outlook<Time> {
  const auto& [p, q, r, s] = certificate.points;
  return certificate.kind == Entry_kind::flip
             ? traits.in_circle_outlook(*p, *q, *r, *s, after, state, counters)
             : traits.orientation_outlook(*p, *q, *r, after, state, counters);
}

// The earlier of the edge's two certificates: that it belongs to the triangulation, and that its
// ends are apart. Points that come together share edges just before, so that watching edges finds
// every coincidence. While an in-circle or orientation certificate is certainly positive, no two of
// its points coincide.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::next_entry(const Two_sided_edge& edge,
                                                          const Time& after,
                                                          Certificate_state state,
                                                          const Traits& traits,
                                                          Certificate_counters& counters) const
    -> std::optional<Entry> {
  const auto& [face, i] = edge.here;
  std::optional<Entry> result;
  if (triangulation_.dimension() == 2) {
    const Certificate topological = certificate(edge);
    Outlook<Time> next = outlook(topological, after, state, traits, counters);
    using Kind = typename Outlook<Time>::Kind;
    if (next.kind != Kind::holds_for_ever) {
      result = Entry{next.bounds, face, Time_pool::none, static_cast<std::uint8_t>(i),
                     next.kind == Kind::fails ? topological.kind : Entry_kind::look_again};
      if (next.failure) result->time = times_.keep(std::move(*next.failure));
    }
    if (next.kind == Kind::holds || topological.kind == Entry_kind::hull_remove) return result;
  } else if (triangulation_.is_infinite(edge.here)) {
    return std::nullopt;
  }
  const Point_2& a = face->vertex(Triangulation::cw(i))->point();
  const Point_2& b = face->vertex(Triangulation::ccw(i))->point();
  std::optional<Time> meeting = traits.coincidence_time(a, b, after, counters);
  if (meeting && (!result || *meeting <= time(*result))) {
    if (result) times_.release(result->time);
    const Double_interval bounds = meeting->interval();
    result = Entry{bounds, face, times_.keep(std::move(*meeting)), static_cast<std::uint8_t>(i),
                   Entry_kind::coincidence};
  }
  return result;
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::time(const Entry& entry) const -> const Time& {
  if (entry.time != Time_pool::none) return times_[entry.time];
  if (entry.kind == Entry_kind::look_again) {
    entry.time = times_.keep(Time(entry.bounds.lower));
    return times_[entry.time];
  }
  const Certificate failed = certificate(two_sided(entry.edge()));
  const auto& [p, q, r, s] = failed.points;
  entry.time = times_.keep(failed.kind == Entry_kind::flip
                               ? traits_.in_circle_failure(*p, *q, *r, *s, entry.bounds)
                               : traits_.orientation_failure(*p, *q, *r, entry.bounds));
  return times_[entry.time];
}

// ---- scheduling ----

template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::Earlier::operator()(const Entry& a,
                                                                   const Entry& b) const {
  const auto order = triangulation->time(a) <=> triangulation->time(b);
  if (order != 0) return order < 0;
  if (a.kind != b.kind) return a.kind < b.kind;
  return ids_of(a.edge()) < ids_of(b.edge());
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::set_event(const Two_sided_edge& edge,
                                                         Queue_handle handle) {
  edge.here.first->set_event(edge.here.second, handle);
  edge.there.first->set_event(edge.there.second, handle);
}

// Pushes the entry of the edge's certificate from `after` on. Precondition: the edge has none.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                        const Time& after,
                                                        Certificate_state state) {
  std::optional<Entry> entry = next_entry(edge, after, state, traits_, certificate_counters_);
  set_event(edge, entry ? queue_.push(std::move(*entry)) : no_event);
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_all() {
  if (triangulation_.dimension() < 1) return;
  for (const Edge& edge : triangulation_.all_edges()) schedule(two_sided(edge), current_time_);
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::unschedule(const Two_sided_edge& edge) {
  const Queue_handle handle = edge.here.first->event(edge.here.second);
  if (handle == no_event) return;
  times_.release(queue_[handle].time);
  queue_.erase(handle);
}

// ---- time ----

// Looks at certificates again until the first entry of the queue is a failure, or is later than
// `until`. Returns whether it is a failure at or before `until`.
template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::settle(const std::optional<Time>& until) {
  const auto is_due = [&](const Entry& entry) {
    if (!until || entry.bounds.upper < until->interval().lower) return true;
    if (entry.bounds.lower > until->interval().upper) return false;
    return time(entry) <= *until;
  };
  while (!queue_.empty() && is_due(queue_.top())) {
    if (queue_.top().kind != Entry_kind::look_again) return true;
    const Entry entry = queue_.pop();
    times_.release(entry.time);
    ++counters_.looks_again;
    schedule(two_sided(entry.edge()), Time(entry.bounds.lower));
  }
  return false;
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::next_event_time() -> std::optional<Time> {
  if (!settle(std::nullopt)) return std::nullopt;
  return time(queue_.top());
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_delaunay_triangulation_2<Traits>::step() {
  return settle(std::nullopt) ? run_instant() : 0;
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_delaunay_triangulation_2<Traits>::advance_to(const Time& time) {
  KINETRI_PRECONDITION(time >= current_time_, "time only advances");
  std::size_t events = 0;
  while (settle(time)) events += run_instant();
  current_time_ = time;
  triangulation_.geom_traits().set_instant({current_time_, Side::after});
  return events;
}

// Executes every event of the time t that is first in the queue. Each flip makes the triangulation
// more nearly Delaunay just after t, and an edge that a flip leaves violated just after t has its
// event at t itself; so the state is Delaunay just after t when no event at t is left. docs/MATH.md
// has the argument, and why it ends.
template <KineticTraits_2 Traits>
std::size_t Kinetic_delaunay_triangulation_2<Traits>::run_instant() {
  const std::uint64_t before = counters_.number_of_events();
  current_time_ = time(queue_.top());
  triangulation_.geom_traits().set_instant({current_time_, Side::after});
  do {
    const Entry event = queue_.pop();
    times_.release(event.time);
    execute(two_sided(event.edge()), event.kind);
  } while (settle(current_time_));
  const std::uint64_t executed = counters_.number_of_events() - before;
  ++counters_.instants;
  counters_.largest_instant = std::max(counters_.largest_instant, executed);
  return static_cast<std::size_t>(executed);
}

// ---- events ----

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::execute(const Two_sided_edge& edge,
                                                       Entry_kind kind) {
  switch (kind) {
    case Entry_kind::flip:
      return flip_edge(edge, Event_kind::flip);
    case Entry_kind::hull_insert:
      if (!can_insert_into_hull(edge)) return rebuild();
      return flip_edge(edge, Event_kind::hull_insert);
    case Entry_kind::hull_remove:
      return flip_edge(edge, Event_kind::hull_remove);
    case Entry_kind::coincidence:
      return rebuild();
    case Entry_kind::look_again:
      break;
  }
  KINETRI_ASSERT(false, "an event is a failure");
}

// Whether the triangle at a hull edge, flat at this time, can be taken away: its apex lies between
// the ends of the edge, and is no hull vertex yet. Otherwise several hull triangles went flat
// together, possibly all of the triangulation.
template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::can_insert_into_hull(
    const Two_sided_edge& hull_edge) const {
  const auto& [face, i] =
      triangulation_.is_infinite(hull_edge.here.first) ? hull_edge.there : hull_edge.here;
  const Vertex_handle apex = face->vertex(i);
  if (triangulation_.is_edge(apex, triangulation_.infinite_vertex())) return false;
  const auto now = traits_.instantaneous_traits({current_time_, Side::at});
  return now.collinear_are_strictly_ordered_along_line_2_object()(
      face->vertex(Triangulation::cw(i))->point(), apex->point(),
      face->vertex(Triangulation::ccw(i))->point());
}

// Reports `event` to the observers around `change`, which makes it happen.
template <KineticTraits_2 Traits>
template <class Change>
void Kinetic_delaunay_triangulation_2<Traits>::report(Event<Time> event, Change change) {
  event.number = counters_.number_of_events();
  for (Observer* observer : observers_) observer->before_event(event);
  change();
  ++counters_.events[static_cast<std::size_t>(event.kind)];
  for (Observer* observer : observers_) observer->after_event(event);
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
void Kinetic_delaunay_triangulation_2<Traits>::flip_edge(const Two_sided_edge& edge,
                                                         Event_kind kind) {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  const auto finite_ids = [](Vertex_handle a, Vertex_handle b) -> std::optional<Edge_ids> {
    const Edge_ids ids = edge_ids(a->point().id(), b->point().id());
    if (ids[1] == no_point) return std::nullopt;
    return ids;
  };

  Event<Time> event;
  event.kind = kind;
  event.time = current_time_;
  event.removed =
      finite_ids(face->vertex(Triangulation::cw(i)), face->vertex(Triangulation::ccw(i)));
  event.added = finite_ids(face->vertex(i), neighbor->vertex(j));
  report(std::move(event), [&] {
    const std::array<Two_sided_edge, 4> before = {two_sided(Edge(face, Triangulation::cw(i))),
                                                  two_sided(Edge(face, Triangulation::ccw(i))),
                                                  two_sided(Edge(neighbor, Triangulation::cw(j))),
                                                  two_sided(Edge(neighbor, Triangulation::ccw(j)))};
    for (const Two_sided_edge& outer : before) unschedule(outer);
    triangulation_.tds().flip(face, i);
    schedule(two_sided(Edge(face, face->index(neighbor))), current_time_,
             Certificate_state::vanishes);
    // From outside, where the flip has changed nothing, they are found again.
    for (const Two_sided_edge& outer : before) schedule(two_sided(outer.there), current_time_);
  });
}

// Reconstructs the triangulation just after the present time and reports the difference. Right at
// any instant, however degenerate.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::rebuild() {
  const std::vector<Edge_ids> before = finite_edge_ids();
  std::vector<Point_2> points;
  points.reserve(vertices_.size());
  for (const Vertex_handle v : vertices_) points.push_back(v->point());
  queue_.clear();
  times_.clear();
  ++counters_.rebuilds;

  Triangulation rebuilt = build(points, current_time_);
  std::vector<Edge_ids> after;
  for (const Edge& edge : rebuilt.finite_edges()) {
    after.push_back(edge_ids(edge.first->vertex(Triangulation::cw(edge.second))->point().id(),
                             edge.first->vertex(Triangulation::ccw(edge.second))->point().id()));
  }
  std::ranges::sort(after);

  std::vector<Edge_ids> removed;
  std::vector<Edge_ids> added;
  std::ranges::set_difference(before, after, std::back_inserter(removed));
  std::ranges::set_difference(after, before, std::back_inserter(added));

  Event<Time> change;
  change.kind = Event_kind::rebuild;
  change.time = current_time_;
  for (const Edge_ids& edge : removed) {
    change.removed = edge;
    report(change, [] {});
  }
  triangulation_.swap(rebuilt);
  index_vertices();
  schedule_all();
  change.removed.reset();
  for (const Edge_ids& edge : added) {
    change.added = edge;
    report(change, [] {});
  }
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
