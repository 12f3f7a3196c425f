// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2 but for its audits. Include this, and
// audit_impl.h, only where the class is instantiated for a kinetic traits class of one's own; it is
// compiled into the library for both kinds of motion.
#ifndef KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H

#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/point_problems.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

namespace detail {

// oneTBB has a task begin after it is made, and what follows begin after the tasks. These say it
// once more to ThreadSanitizer, which does not see into oneTBB's library. They are global, since a
// task may read nothing before.
inline std::atomic<unsigned> tasks_made = 0;
inline std::atomic<unsigned> tasks_done = 0;

}  // namespace detail

// ---- construction ----

template <KineticTraits_2 Traits>
Kinetic_delaunay_triangulation_2<Traits>::Kinetic_delaunay_triangulation_2(
    const std::vector<Motion>& motions, const Time& start, const Traits& traits)
    : traits_(traits), current_time_(start) {
  KINETRI_PRECONDITION(motions.size() < no_point, detail::too_many_points);
  std::vector<Point_2> points;
  points.reserve(motions.size());
  for (const Motion& motion : motions) {
    KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(points.size()));
    points.emplace_back(motion, static_cast<Point_id>(points.size()));
  }
  vertices_.resize(points.size());
  number_of_points_ = points.size();
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
  KINETRI_ASSERT(false, "every point has a vertex");
  return result;
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
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
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

// Handles are passed in memory, so that a call would cost more than what it does.
template <KineticTraits_2 Traits>
[[gnu::always_inline]] inline auto Kinetic_delaunay_triangulation_2<Traits>::two_sided(
    const Edge& edge) const -> Two_sided_edge {
  if (triangulation_.dimension() < 2) return {edge, edge};
  // Without branches, which nothing could predict.
  const auto& [face, i] = edge;
  const Face_handle neighbor = face->neighbor(i);
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  const int right_there =
      (neighbor->vertex(1) == right ? 1 : 0) + (neighbor->vertex(2) == right ? 2 : 0);
  return {edge, Edge(neighbor, Triangulation::ccw(right_there))};
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
  if (certificate.kind == Entry_kind::flip) {
    return traits.in_circle_outlook(*p, *q, *r, *s, after, state, counters);
  }
  if (certificate.kind == Entry_kind::hull_insert) {
    return traits.flatness_outlook(*p, *q, *r, after, state, counters);
  }
  return traits.orientation_outlook(*p, *q, *r, after, state, counters);
}

// The earlier of the edge's two certificates: that it belongs to the triangulation, and that its
// ends are apart.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::prospect(const Two_sided_edge& edge,
                                                        const Time& after, Certificate_state state,
                                                        const Traits& traits,
                                                        Certificate_counters& counters) const
    -> std::optional<Prospect> {
  if (triangulation_.dimension() == 2) {
    const Certificate topological = certificate(edge);
    return prospect(edge, topological.kind, outlook(topological, after, state, traits, counters),
                    after, traits, counters);
  }
  if (triangulation_.is_infinite(edge.here)) return std::nullopt;
  const Double_interval among = {after.interval().lower, std::numeric_limits<double>::infinity()};
  return meeting(edge, after, among, traits, counters);
}

// Likewise, where `next` is the outlook of the certificate that the edge belongs to the
// triangulation, whose failure is of the given kind. Points that come together share edges just
// before, so that watching edges finds every coincidence. While an in-circle or orientation
// certificate is positive, no two of its points coincide.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::prospect(const Two_sided_edge& edge, Entry_kind kind,
                                                        Outlook<Time> next, const Time& after,
                                                        const Traits& traits,
                                                        Certificate_counters& counters) const
    -> std::optional<Prospect> {
  using Kind = typename Outlook<Time>::Kind;
  if (next.kind == Kind::holds) return Prospect{Entry_kind::look_again, next.bounds, nullptr};
  if (next.kind == Kind::holds_for_ever && !next.may_vanish) return std::nullopt;
  std::optional<Prospect> result;
  Double_interval among = {after.interval().lower, std::numeric_limits<double>::infinity()};
  if (next.kind == Kind::fails) {
    result = Prospect{kind, next.bounds, std::move(next.failure)};
    among = {next.may_vanish ? among.lower : next.bounds.lower, next.bounds.upper};
  }
  if (kind == Entry_kind::hull_remove) return result;
  std::optional<Prospect> meeting = this->meeting(edge, after, among, traits, counters);
  if (!meeting) return result;
  if (result && *meeting->time > (result->time ? *result->time
                                               : make_time(edge, result->kind, result->bounds))) {
    return result;
  }
  return meeting;
}

// The first time among those in `among` at which the ends of the edge coincide, if they do.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::meeting(const Two_sided_edge& edge,
                                                       const Time& after,
                                                       const Double_interval& among,
                                                       const Traits& traits,
                                                       Certificate_counters& counters) const
    -> std::optional<Prospect> {
  const auto& [face, i] = edge.here;
  std::optional<Time> time =
      traits.coincidence_time(face->vertex(Triangulation::cw(i))->point(),
                              face->vertex(Triangulation::ccw(i))->point(), after, among, counters);
  if (!time) return std::nullopt;
  const Double_interval bounds = time->interval();
  return Prospect{Entry_kind::coincidence, bounds, std::make_unique<Time>(std::move(*time))};
}

// The exact time of a look or of a failure of the certificate, within bounds that the traits gave.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::make_time(const Two_sided_edge& edge,
                                                         Entry_kind kind,
                                                         const Double_interval& bounds) const
    -> Time {
  if (kind == Entry_kind::look_again) return Time(bounds.lower);
  const auto& [p, q, r, s] = certificate(edge).points;
  return kind == Entry_kind::flip ? traits_.in_circle_failure(*p, *q, *r, *s, bounds)
                                  : traits_.orientation_failure(*p, *q, *r, bounds);
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::time(const Entry& entry) const -> const Time& {
  if (entry.time == Time_pool::none) {
    entry.time = times_.keep(make_time(two_sided(entry.edge()), entry.kind, entry.bounds));
  }
  return times_[entry.time];
}

// Likewise, for an entry that is taken from the queue before its time is asked for again.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::take_time(const Entry& entry) const -> Time {
  if (entry.time != Time_pool::none) return times_[entry.time];
  return make_time(two_sided(entry.edge()), entry.kind, entry.bounds);
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

template <KineticTraits_2 Traits>
inline auto Kinetic_delaunay_triangulation_2<Traits>::make_entry(const Edge& edge,
                                                                 Prospect prospect) -> Entry {
  const bool changes_sign = !prospect.time;
  const auto time = prospect.time ? times_.keep(std::move(*prospect.time)) : Time_pool::none;
  return {prospect.bounds, edge.first,  time, static_cast<std::uint8_t>(edge.second),
          prospect.kind,   changes_sign};
}

// Pushes the entry of the edge's certificate from `after` on. Precondition: the edge has none.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                        const Time& after,
                                                        Certificate_state state) {
  schedule(edge, prospect(edge, after, state, traits_, certificate_counters_));
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                        std::optional<Prospect> next) {
  set_event(edge, next ? queue_.push(make_entry(edge.here, std::move(*next))) : no_event);
}

// All edges, infinite ones too, each from the side that its ids choose. CGAL's iterator chooses by
// address, which is another one in each run, and certificates are rounded otherwise from the other
// side.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::edges() const -> std::vector<Edge> {
  std::vector<Edge> result;
  if (triangulation_.dimension() < 1) return result;
  if (triangulation_.dimension() == 1) {
    for (const Edge& edge : triangulation_.all_edges()) result.push_back(edge);
    return result;
  }
  result.reserve(3 * (number_of_points_ + 1));
  for (const Face_handle face : triangulation_.all_face_handles()) {
    for (int i = 0; i < 3; ++i) {
      if (face->vertex(Triangulation::cw(i))->point().id() <
          face->vertex(Triangulation::ccw(i))->point().id()) {
        result.emplace_back(face, i);
      }
    }
  }
  return result;
}

// Schedules every edge; the queue is empty. The prospects of a block of
// edges are found by several threads; only the queue is filled by one.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_all() {
  constexpr std::size_t edges_per_task = 4096;
  struct Task {
    std::span<const Edge> edges;
    Time after;  // exact numbers are not shared by threads
    std::vector<std::optional<Prospect>> prospects;
    Certificate_counters counters;
  };
  const std::vector<Edge> all = edges();
  std::vector<Entry> entries;
  entries.reserve(all.size());
  std::vector<Task> tasks(2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  for (std::size_t first = 0; first < all.size();) {
    for (Task& task : tasks) {
      task.edges = std::span(all).subspan(first, std::min(edges_per_task, all.size() - first));
      task.after = current_time_.detached();
      first += task.edges.size();
    }
    const auto work = [this](Task& task) {
      for (std::size_t i = 0; i < task.edges.size(); ++i) {
        if (i + 12 < task.edges.size()) detail::prefetch(task.edges[i + 12].first);
        if (i + 6 < task.edges.size()) detail::prefetch_around(task.edges[i + 6].first);
        task.prospects.push_back(prospect(two_sided(task.edges[i]), task.after,
                                          Certificate_state::any, traits_, task.counters));
      }
    };
    if (all.size() <= edges_per_task) {
      work(tasks.front());
    } else {
      const auto ordered_work = [&work](Task& task) {
        detail::tasks_made.load(std::memory_order_acquire);
        work(task);
        detail::tasks_done.fetch_add(1, std::memory_order_release);
      };
      detail::tasks_made.fetch_add(1, std::memory_order_release);
      tbb::parallel_for_each(tasks, ordered_work);
      detail::tasks_done.load(std::memory_order_acquire);
    }
    for (Task& task : tasks) {
      for (std::size_t i = 0; i < task.edges.size(); ++i) {
        Queue_handle event = no_event;
        if (task.prospects[i]) {
          event = static_cast<Queue_handle>(entries.size());
          entries.push_back(make_entry(task.edges[i], std::move(*task.prospects[i])));
        }
        set_event(two_sided(task.edges[i]), event);
      }
      task.prospects.clear();
      certificate_counters_ += std::exchange(task.counters, {});
    }
  }
  queue_.assign(entries, all.size());
}

template <KineticTraits_2 Traits>
inline void Kinetic_delaunay_triangulation_2<Traits>::unschedule(const Two_sided_edge& edge) {
  const Queue_handle handle = edge.here.first->event(edge.here.second);
  if (handle == no_event) return;
  const Entry& entry = queue_[handle];
  times_.release(entry.time);
  if (entry.kind != Entry_kind::look_again) {
    ++counters_.discarded[static_cast<std::size_t>(event_kind(entry.kind))];
  }
  queue_.erase(handle);
}

template <KineticTraits_2 Traits>
Event_kind Kinetic_delaunay_triangulation_2<Traits>::event_kind(Entry_kind failure) {
  switch (failure) {
    case Entry_kind::flip:
      return Event_kind::flip;
    case Entry_kind::hull_insert:
      return Event_kind::hull_insert;
    case Entry_kind::hull_remove:
      return Event_kind::hull_remove;
    default:
      return Event_kind::rebuild;
  }
}

}  // namespace kinetri

#include "kinetri/triangulation/detail/changes_impl.h"
#include "kinetri/triangulation/detail/events_impl.h"
#include "kinetri/triangulation/detail/rebuild_impl.h"
#include "kinetri/triangulation/detail/snapshot_impl.h"

#endif  // KINETRI_TRIANGULATION_DETAIL_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
