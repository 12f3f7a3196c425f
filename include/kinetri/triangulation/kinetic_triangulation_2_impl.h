// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_triangulation_2. Include this, and audit_impl.h for its audits, only if
// you instantiate the class for your own kinetic traits class; it is compiled into the library for
// the library's own traits. Traits that are derived from these, without other points or predicates,
// share the parts that know no certificates. For others CGAL inserts the points one by one.
#ifndef KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H
#define KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H

#include <cmath>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/triangulation/kinetic_triangulation_2.h"

namespace kinetri {

namespace detail {

/// As Kinetic_triangulation_2::audit. audit_impl.h defines it.
template <class Traits>
Audit_report audit(const Kinetic_core<Traits>& core, Audit_level level);

}  // namespace detail

// ---- construction ----

template <KineticTraits_2 Traits>
Kinetic_triangulation_2<Traits>::Kinetic_triangulation_2(const std::vector<Motion>& motions,
                                                         const Time& start, const Traits& traits,
                                                         Coincident_points coincident)
    : core_(traits, start) {
  if (coincident == Coincident_points::refuse) core_.topology.refuse_twins();
  KINETRI_PRECONDITION(motions.size() < no_point, detail::too_many_points);
  std::vector<Point_2> points;
  points.reserve(motions.size());
  for (const Motion& motion : motions) {
    KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(points.size()));
    points.emplace_back(motion, static_cast<Point_id>(points.size()));
  }
  core_.start_with(points, points.size());
}

template <KineticTraits_2 Traits>
Kinetic_triangulation_2<Traits>::Kinetic_triangulation_2(Restoration /*restores*/,
                                                         const Snapshot& snapshot,
                                                         const Traits& traits,
                                                         Coincident_points coincident)
    : core_(traits, snapshot.time.detached()) {
  if (coincident == Coincident_points::refuse) core_.topology.refuse_twins();
  if (snapshot.motions.size() >= no_point) {
    throw Snapshot_error(std::string("the snapshot has ") + detail::too_many_points);
  }
  std::vector<Point_2> points;
  for (std::size_t id = 0; id < snapshot.motions.size(); ++id) {
    const std::optional<Motion>& motion = snapshot.motions[id];
    if (!motion) continue;
    if (!is_finite(*motion)) throw Snapshot_error(detail::not_finite_problem(id));
    points.emplace_back(*motion, static_cast<Point_id>(id));
  }
  core_.schedule.certificate_counters() = snapshot.certificates;
  try {
    core_.start_with(points, snapshot.motions.size());
  } catch (const Coincident_trajectories_error& error) {
    throw Snapshot_error("the snapshot's points " + std::to_string(error.first()) + " and " +
                         std::to_string(error.second()) + " have the same trajectory");
  }
  core_.counters = snapshot.counters;
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(!core_.reporter.is_in_event() && !core_.loop.has_points_set_aside(),
                       "a snapshot within an event; take it when advance_to or step has returned");
  Snapshot result;
  result.time = current_time().detached();
  result.counters = core_.counters;
  result.certificates = core_.schedule.certificate_counters();
  result.motions.reserve(core_.topology.vertices().size());
  for (Point_id id = 0; id < next_id(); ++id) {
    result.motions.push_back(contains(id) ? std::optional(motion(id)) : std::nullopt);
  }
  return result;
}

// ---- the present ----

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::vertex(Point_id id) const -> Vertex_handle {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  return core_.topology.vertex(core_.topology.shown(id));
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_triangulation_2<Traits>::coincident_points(Point_id id) const {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  const Point_id shown = core_.topology.shown(id);
  std::vector<Point_id> result = core_.topology.twins().hidden_by(shown);
  if (id != shown) {
    std::erase(result, id);
    result.insert(result.begin(), shown);
  }
  return result;
}

template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::is_hidden(Point_id id) const {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  return !core_.topology.has_vertex(id) || core_.topology.is_hidden(id);
}

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::point(Point_id id) const -> const Point_2& {
  KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
  return core_.topology.point(id);
}

template <KineticTraits_2 Traits>
std::vector<Edge_ids> Kinetic_triangulation_2<Traits>::finite_edge_ids() const {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    std::vector<Edge_ids> result;
    for (const Periodic_edge& edge : core_.topology.finite_edges()) result.push_back(edge.ids);
    return result;
  } else {
    return core_.topology.finite_edges();
  }
}

template <KineticTraits_2 Traits>
std::vector<Periodic_edge> Kinetic_triangulation_2<Traits>::periodic_edges() const requires
    PeriodicKineticTraits_2<Traits> {
  // clang before 16 instantiates this for other traits as well, in an explicit instantiation.
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    return core_.topology.finite_edges();
  } else {
    return {};
  }
}

// ---- time ----

template <KineticTraits_2 Traits>
auto Kinetic_triangulation_2<Traits>::next_event_time() -> std::optional<Time> {
  const detail::Flag_while changing = core_.reporter.start_change();
  if (!core_.schedule.settle(nullptr)) return std::nullopt;
  return core_.schedule.queue().time(core_.schedule.queue().top());
}

template <KineticTraits_2 Traits>
bool Kinetic_triangulation_2<Traits>::has_event_before(const Time& time) const {
  return core_.schedule.has_failure_before(time);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step() {
  const detail::Flag_while changing = core_.reporter.start_change();
  core_.join_parts();
  return core_.loop.step(nullptr);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::step(const Time& until) {
  const detail::Flag_while changing = core_.reporter.start_change();
  core_.join_parts();
  return core_.loop.step(&until);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::advance_to(const Time& time) {
  return advance_to(time, nullptr);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::advance_to(const Time& time,
                                                        const std::function<bool()>& may_go_on) {
  const detail::Flag_while changing = core_.reporter.start_change();
  KINETRI_PRECONDITION(
      time >= current_time(),
      "the time to advance to is in the past; take the present one or a later one, "
      "or call reverse first");
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    traits().box().require_area(current_time(), time);
  }
  return core_.advance_to(time, may_go_on);
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::reverse() {
  const detail::Flag_while changing = core_.reporter.start_change();
  const std::uint64_t before = core_.counters.number_of_events();
  core_.loop.reverse();
  return static_cast<std::size_t>(core_.counters.number_of_events() - before);
}

// ---- changes of points ----

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  const Change change = {id, motion};
  apply(Event_kind::trajectory, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::erase(Point_id id) {
  const Change change = {id, std::nullopt};
  apply(Event_kind::erase, id, std::nullopt, {&change, 1});
}

template <KineticTraits_2 Traits>
Changed_edges Kinetic_triangulation_2<Traits>::apply(Event_kind kind,
                                                     std::optional<Point_id> point_a,
                                                     std::optional<Point_id> point_b,
                                                     std::span<const Change> changes) {
  const detail::Flag_while changing = core_.reporter.start_change();
  for (const auto& [id, motion] : changes) {
    KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
    KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  }
  Event event;
  event.kind = kind;
  event.point_a = point_a;
  event.point_b = point_b;
  return core_.changes.perform({&event, 1}, changes);
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::insert(const Motion& motion) {
  return insert(std::span(&motion, 1));
}

template <KineticTraits_2 Traits>
Point_id Kinetic_triangulation_2<Traits>::insert(std::span<const Motion> motions) {
  const detail::Flag_while changing = core_.reporter.start_change();
  const Point_id first = next_id();
  std::vector<Change> changes;
  changes.reserve(motions.size());
  for (const Motion& motion : motions) {
    const auto id = static_cast<Point_id>(first + changes.size());
    KINETRI_PRECONDITION(is_finite(motion), detail::not_finite_problem(id));
    changes.push_back({id, motion});
  }
  core_.topology.give_ids(motions.size());
  try {
    core_.changes.change_all(Event_kind::insert, std::move(changes));
  } catch (const Error&) {  // of coincident points, or of one far from a periodic box
    if (!core_.reporter.is_in_event()) core_.topology.take_back_ids(first);
    throw;
  }
  return first;
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_motions(std::span<const Point_id> ids,
                                                  std::span<const Motion> motions) {
  const detail::Flag_while changing = core_.reporter.start_change();
  KINETRI_PRECONDITION(ids.size() == motions.size(), std::to_string(ids.size()) + " ids and " +
                                                         std::to_string(motions.size()) +
                                                         " motions; expected a motion for each id");
  std::vector<Change> changes;
  changes.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    KINETRI_PRECONDITION(is_finite(motions[i]), detail::not_finite_problem(ids[i]));
    changes.push_back({ids[i], motions[i]});
  }
  core_.changes.change_all(Event_kind::trajectory, std::move(changes));
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_velocities(std::span<const Point_id> ids,
                                                     std::span<const Vector_2> velocities) requires
    MotionWithVelocity_2<typename Traits::Motion> {
  detail::check_vectors(ids, velocities, "velocity", "velocities");
  const double now = current_time().to_double();
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    motions.push_back(with_velocity_at(motion(ids[i]), velocities[i], now));
  }
  set_motions(ids, motions);
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::set_positions(std::span<const Point_id> ids,
                                                    std::span<const Vector_2> positions) requires
    MotionWithPosition_2<typename Traits::Motion> {
  const detail::Flag_while changing = core_.reporter.start_change();
  detail::check_vectors(ids, positions, "position", "positions");
  std::vector<Change> changes;
  changes.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    changes.push_back({ids[i], at_rest_in(core_.topology.point(ids[i]).motion(), positions[i])});
  }
  core_.changes.change_all(Event_kind::trajectory, std::move(changes));
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_triangulation_2<Traits>::ids_of(
    std::span<const Vector_2> positions) const {
  KINETRI_PRECONDITION(positions.size() == number_of_points(),
                       std::to_string(number_of_points()) + " points and " +
                           std::to_string(positions.size()) +
                           " positions; expected a position for each point");
  std::vector<Point_id> ids;
  ids.reserve(positions.size());
  for (Point_id id = 0; id < next_id(); ++id) {
    if (contains(id)) ids.push_back(id);
  }
  return ids;
}

template <KineticTraits_2 Traits>
std::size_t Kinetic_triangulation_2<Traits>::advance_through(std::span<const Point_id> ids,
                                                             std::span<const Vector_2> positions,
                                                             double duration) requires
    MotionWithVelocity_2<typename Traits::Motion> && MotionWithPosition_2<typename Traits::Motion> {
  detail::check_vectors(ids, positions, "position", "positions");
  const double now = current_time().to_double();
  const double end = now + duration;
  KINETRI_PRECONDITION(std::isfinite(end) && Time(end) > current_time(),
                       "a duration of " + std::to_string(duration) + " from time " +
                           std::to_string(now) +
                           "; expected one that ends later, at a finite time");
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    traits().box().require_area(current_time(), Time(end));
  }
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(contains(ids[i]), detail::unknown_id_problem(ids[i]));
    const Vector_2 here = with_velocity_at(motion(ids[i]), {}, now).position;
    const Vector_2 velocity = {(positions[i].x - here.x) / (end - now),
                               (positions[i].y - here.y) / (end - now)};
    motions.push_back(with_velocity_at(at_rest_in(motion(ids[i]), here), velocity, now));
  }
  set_motions(ids, motions);
  const std::size_t events = advance_to(Time(end));
  set_positions(ids, positions);
  return events;
}

template <KineticTraits_2 Traits>
void Kinetic_triangulation_2<Traits>::erase(std::span<const Point_id> ids) {
  const detail::Flag_while changing = core_.reporter.start_change();
  std::vector<Change> changes;
  changes.reserve(ids.size());
  for (const Point_id id : ids) {
    KINETRI_PRECONDITION(contains(id), detail::unknown_id_problem(id));
    changes.push_back({id, std::nullopt});
  }
  core_.changes.change_all(Event_kind::erase, std::move(changes));
}

template <KineticTraits_2 Traits>
Audit_report Kinetic_triangulation_2<Traits>::audit(Audit_level level) const {
  return detail::audit<Traits>(core_, level);
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_IMPL_H
