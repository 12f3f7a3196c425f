// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_delaunay_triangulation_2 but for its audits. Include this, and
// audit_impl.h, only where the class is instantiated for a kinetic traits class of one's own; it is
// compiled into the library for both kinds of motion.
#ifndef KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
#define KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/detail/parallel.h"
#include "kinetri/triangulation/detail/point_problems.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

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

template <KineticTraits_2 Traits>
inline auto Kinetic_delaunay_triangulation_2<Traits>::two_sided(const Edge& edge) const
    -> Two_sided_edge {
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
  std::optional<Time> meeting = meeting_time(edge, after, among, traits, counters);
  if (!meeting) return std::nullopt;
  return coincidence(std::move(*meeting));
}

// Likewise, where `next` is the outlook of the certificate that the edge belongs to the
// triangulation, whose failure is of the given kind. Points that come together share edges just
// before, so that watching edges finds every coincidence. While an in-circle or orientation
// certificate is positive, no two of its points coincide.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::prospect(const Two_sided_edge& edge, Entry_kind kind,
                                                        Outlook<Time>&& next, const Time& after,
                                                        const Traits& traits,
                                                        Certificate_counters& counters) const
    -> std::optional<Prospect> {
  using Kind = typename Outlook<Time>::Kind;
  if (next.kind == Kind::holds) return Prospect{Entry_kind::look_again, next.bounds, nullptr};
  if (next.kind == Kind::holds_for_ever && !next.may_vanish) return std::nullopt;
  std::optional<Prospect> failure;
  Double_interval among = {after.interval().lower, std::numeric_limits<double>::infinity()};
  if (next.kind == Kind::fails) {
    failure = Prospect{kind, next.bounds, std::move(next.failure)};
    among = {next.may_vanish ? among.lower : next.bounds.lower, next.bounds.upper};
  }
  if (kind == Entry_kind::hull_remove) return failure;
  std::optional<Time> meeting = meeting_time(edge, after, among, traits, counters);
  if (!meeting) return failure;
  return earlier(edge, std::move(failure), std::move(*meeting));
}

// The earlier one of a failure, if there is one, and of a meeting of the ends of the edge.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::earlier(const Two_sided_edge& edge,
                                                       std::optional<Prospect> failure,
                                                       Time meeting) const -> Prospect {
  if (failure && meeting > (failure->time ? *failure->time
                                          : make_time(edge, failure->kind, failure->bounds))) {
    return std::move(*failure);
  }
  return coincidence(std::move(meeting));
}

// The first time among those in `among` at which the ends of the edge coincide, if they do.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::meeting_time(const Two_sided_edge& edge,
                                                            const Time& after,
                                                            const Double_interval& among,
                                                            const Traits& traits,
                                                            Certificate_counters& counters) const
    -> std::optional<Time> {
  const auto& [face, i] = edge.here;
  return traits.coincidence_time(face->vertex(Triangulation::cw(i))->point(),
                                 face->vertex(Triangulation::ccw(i))->point(), after, among,
                                 counters);
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::coincidence(Time time) -> Prospect {
  const Double_interval bounds = time.interval();
  return {Entry_kind::coincidence, bounds, std::make_unique<Time>(std::move(time))};
}

// The exact time of a look or of a failure of the certificate, within bounds that the traits gave.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::make_time(const Two_sided_edge& edge,
                                                         Entry_kind kind,
                                                         const Double_interval& bounds) const
    -> Time {
  if (kind == Entry_kind::look_again) return Time(bounds.lower);
  return make_time(certificate(edge), bounds);
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::make_time(const Certificate& failed,
                                                         const Double_interval& bounds) const
    -> Time {
  const auto& [p, q, r, s] = failed.points;
  return failed.kind == Entry_kind::flip ? traits_.in_circle_failure(*p, *q, *r, *s, bounds)
                                         : traits_.orientation_failure(*p, *q, *r, bounds);
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::time(const Entry& entry) const -> const Time& {
  if (entry.time == Time_pool::none) {
    entry.time = times_.keep(make_time(two_sided(entry.edge()), entry.kind, entry.bounds));
  }
  return times_[entry.time];
}

// Makes the time of a failure the present one. It need not be made: mostly its bounds are enough,
// until the next event comes.
template <KineticTraits_2 Traits>
inline void Kinetic_delaunay_triangulation_2<Traits>::set_current_time(const Two_sided_edge& edge,
                                                                       const Entry& entry) {
  if (entry.time != Time_pool::none) return set_current_time(times_[entry.time]);
  unmade_time_ = {certificate(edge), entry.bounds};
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::set_current_time(Time time) {
  unmade_time_.reset();
  current_time_ = std::move(time);
}

template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::current_time() const -> const Time& {
  if (unmade_time_) {
    current_time_ = make_time(unmade_time_->first, unmade_time_->second);
    unmade_time_.reset();
  }
  return current_time_;
}

template <KineticTraits_2 Traits>
inline Double_interval Kinetic_delaunay_triangulation_2<Traits>::current_bounds() const {
  return unmade_time_ ? unmade_time_->second : current_time().interval();
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
inline auto Kinetic_delaunay_triangulation_2<Traits>::make_untimed_entry(const Edge& edge,
                                                                         const Prospect& prospect)
    -> Entry {
  const bool changes_sign = !prospect.time;
  return Entry(edge, prospect.kind, prospect.bounds, changes_sign);
}

template <KineticTraits_2 Traits>
inline auto Kinetic_delaunay_triangulation_2<Traits>::make_entry(const Edge& edge,
                                                                 Prospect prospect) -> Entry {
  Entry entry = make_untimed_entry(edge, prospect);
  if (prospect.time) entry.time = times_.keep(std::move(*prospect.time));
  return entry;
}

// Pushes the entry of the edge's certificate from `after` on. Precondition: the edge has none.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                        const Time& after,
                                                        Certificate_state state) {
  if (triangulation_.dimension() == 2) {
    const Certificate topological = certificate(edge);
    Outlook<Time> next = outlook(topological, after, state, traits_, certificate_counters_);
    return schedule(edge, topological.kind, std::move(next), after);
  }
  schedule(edge, prospect(edge, after, state, traits_, certificate_counters_));
}

// Likewise, where `next` is the outlook from `after` on and `kind` that of a failure.
template <KineticTraits_2 Traits>
inline void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                               Entry_kind kind,
                                                               Outlook<Time>&& next,
                                                               const Time& after) {
  if (schedule_at_once(edge, kind, next)) return;
  schedule(edge, prospect(edge, kind, std::move(next), after, traits_, certificate_counters_));
}

// Likewise, without the way through a prospect, where floating point has decided. Returns whether
// it has, as nearly always.
template <KineticTraits_2 Traits>
bool Kinetic_delaunay_triangulation_2<Traits>::schedule_at_once(const Two_sided_edge& edge,
                                                                Entry_kind kind,
                                                                const Outlook<Time>& next) {
  using Kind = typename Outlook<Time>::Kind;
  if (next.kind == Kind::holds) {
    set_event(edge, queue_.emplace(edge.here, Entry_kind::look_again, next.bounds));
    return true;
  }
  if (next.kind == Kind::holds_for_ever && !next.may_vanish) {
    set_event(edge, no_event);
    return true;
  }
  if (next.kind != Kind::fails || next.failure != nullptr || kind != Entry_kind::flip) return false;
  // The ends of the edge are apart up to bounds.lower.
  auto meeting =
      meeting_time(edge, Time(next.bounds.lower), next.bounds, traits_, certificate_counters_);
  if (meeting) {
    schedule(edge, earlier(edge, Prospect{kind, next.bounds, nullptr}, std::move(*meeting)));
  } else {
    set_event(edge, queue_.emplace(edge.here, kind, next.bounds, true));
  }
  return true;
}

template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule(const Two_sided_edge& edge,
                                                        std::optional<Prospect> next) {
  set_event(edge, next ? queue_.push(make_entry(edge.here, std::move(*next))) : no_event);
}

// Faces that have all edges, infinite ones too: in dimension 1, a face for each edge.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::faces() const -> std::vector<Face_handle> {
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
void Kinetic_delaunay_triangulation_2<Traits>::for_each_own_edge(Face_handle face,
                                                                 Function function) const {
  if (triangulation_.dimension() == 1) return function(Edge(face, 2));
  for (int i = 0; i < 3; ++i) {
    if (face < face->neighbor(i)) function(Edge(face, i));
  }
}

// The same edge, from the side that its ids choose: which face has it as its own is another one in
// each run, and certificates are rounded otherwise from the other side.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::chosen_side(const Two_sided_edge& edge)
    -> Two_sided_edge {
  const auto& [face, i] = edge.here;
  const bool is_here = face->vertex(Triangulation::cw(i))->point().id() <
                       face->vertex(Triangulation::ccw(i))->point().id();
  return is_here ? edge : Two_sided_edge{edge.there, edge.here};
}

// All edges, infinite ones too.
template <KineticTraits_2 Traits>
auto Kinetic_delaunay_triangulation_2<Traits>::edges() const -> std::vector<Edge> {
  std::vector<Edge> result;
  for (const Face_handle face : faces()) {
    for_each_own_edge(face, [&](const Edge& edge) { result.push_back(edge); });
  }
  return result;
}

// Schedules every edge; the queue is empty. Several threads do so, each for a block of faces, whose
// edges have the handles that follow those of the block before.
template <KineticTraits_2 Traits>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_all() {
  constexpr std::size_t faces_per_block = 2048;
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
    for (Block& block : blocks) {
      for (auto& [edge, prospect] : block.timed) {
        put(edge.first->event(edge.second), make_entry(edge, std::move(prospect)));
      }
      certificate_counters_ += block.counters;
    }
  });
}

// Puts the entries of the block's edges into the queue; in-circle certificates go two by two.
template <KineticTraits_2 Traits>
template <class Put>
void Kinetic_delaunay_triangulation_2<Traits>::schedule_block(Block& block, const Put& put) const {
  const auto finish = [&](const Two_sided_edge& edge, std::optional<Prospect> next) {
    const Queue_handle handle = next ? block.next_handle : no_event;
    ++block.next_handle;
    set_event(edge, handle);
    if (!next) return;
    if (next->time) {
      block.timed.emplace_back(edge.here, std::move(*next));
    } else {
      put(handle, make_untimed_entry(edge.here, *next));
    }
  };
  const auto finish_flip = [&](const Two_sided_edge& edge, Outlook<Time> outlook) {
    finish(edge, prospect(edge, Entry_kind::flip, std::move(outlook), block.after, traits_,
                          block.counters));
  };
  std::optional<std::pair<Two_sided_edge, Certificate>> waiting;
  for (std::size_t k = 0; k < block.faces.size(); ++k) {
    if (k + 6 < block.faces.size()) detail::prefetch(block.faces[k + 6]);
    if (k + 3 < block.faces.size()) detail::prefetch_around(block.faces[k + 3]);
    for_each_own_edge(block.faces[k], [&](const Edge& own) {
      const Two_sided_edge edge = chosen_side(two_sided(own));
      if (triangulation_.dimension() == 2) {
        const Certificate certificate = this->certificate(edge);
        if (certificate.kind == Entry_kind::flip) {
          if (!waiting) {
            waiting.emplace(edge, certificate);
            return;
          }
          auto outlooks = traits_.in_circle_outlooks({waiting->second.points, certificate.points},
                                                     block.after, block.counters);
          finish_flip(waiting->first, std::move(outlooks[0]));
          finish_flip(edge, std::move(outlooks[1]));
          waiting.reset();
          return;
        }
      }
      finish(edge, prospect(edge, block.after, Certificate_state::any, traits_, block.counters));
    });
  }
  if (waiting) {
    const Two_sided_edge& edge = waiting->first;
    finish(edge, prospect(edge, block.after, Certificate_state::any, traits_, block.counters));
  }
}

template <KineticTraits_2 Traits>
inline void Kinetic_delaunay_triangulation_2<Traits>::unschedule(const Two_sided_edge& edge) {
  const Queue_handle handle = edge.here.first->event(edge.here.second);
  if (handle == no_event) return;
  const Entry entry = queue_.erase(handle);
  times_.release(entry.time);
  if (entry.kind != Entry_kind::look_again) {
    ++counters_.discarded[static_cast<std::size_t>(event_kind(entry.kind))];
  }
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

#endif  // KINETRI_TRIANGULATION_KINETIC_DELAUNAY_TRIANGULATION_2_IMPL_H
