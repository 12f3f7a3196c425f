// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_2_IMPL_H
#define KINETRI_SRC_SIMULATION_SIMULATION_2_IMPL_H

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/disc_numbers.h"
#include "simulation/simulation_auditor.h"
#include "simulation/simulation_core_impl.h"

namespace kinetri {

namespace detail {

// Links of points that coincide have no offsets. So in a periodic box discs with a response may not
// coincide, unless they need no links.
template <class Traits>
Coincident_points coincident_for(Coincident_points given, bool needs_links) {
  return PeriodicKineticTraits_2<Traits> && needs_links ? Coincident_points::refuse : given;
}

}  // namespace detail

// ---- construction ----

template <SimulationKineticTraits_2 Traits>
Simulation_2<Traits>::Simulation_2(const std::vector<Motion>& motions,
                                   const Simulation_options& options, const Time& start,
                                   const Traits& traits)
    : core_(std::make_unique<detail::Simulation_core<Traits>>(traits, options, [&] {
        return Triangulation(
            motions, start, traits,
            detail::coincident_for<Traits>(
                options.coincident,
                options.response != nullptr && !detail::is_let_images_overlap(options.response)));
      })) {
  KINETRI_PRECONDITION(core_->setup.problem().empty(), core_->setup.problem());
  KINETRI_PRECONDITION(options.masses.empty() || options.masses.size() == motions.size(),
                       "masses, but not one for each point");
  for (Point_id id = 0; id < motions.size(); ++id) {
    core_->setup.check_place(core_->geometry.point(id), current_time());
  }
  core_->check_own_images();
  core_->start();
  if (options.refuses_overlaps) core_->loop.refuse_overlaps();
  core_->schedule_all();
}

template <SimulationKineticTraits_2 Traits>
Simulation_2<Traits>::~Simulation_2() = default;

// ---- the present ----

template <SimulationKineticTraits_2 Traits>
auto Simulation_2<Traits>::triangulation() const -> const Triangulation& {
  return core_->triangulation;
}

template <SimulationKineticTraits_2 Traits>
const Simulation_options& Simulation_2<Traits>::options() const {
  return core_->setup.options();
}

template <SimulationKineticTraits_2 Traits>
double Simulation_2<Traits>::mass(Point_id id) const {
  return core_->setup.mass(id);
}

// ---- snapshots ----

template <SimulationKineticTraits_2 Traits>
auto Simulation_2<Traits>::snapshot() const -> Snapshot {
  KINETRI_PRECONDITION(
      !core_->loop.is_within_instant(),
      "a snapshot within an instant; take it when advance_to or step has returned");
  using detail::Contact_kind;
  Snapshot result;
  result.triangulation = core_->triangulation.snapshot();
  result.options = options();
  result.options.response = nullptr;
  result.has_response = core_->setup.has_response();
  result.counters = core_->counters;
  result.certificates = core_->schedule.certificate_counters();
  for (Point_id a = 0; a < core_->records.size(); ++a) {
    for (const auto& overlap : core_->records.overlaps(a)) {
      if (overlap.passes && detail::is_first(a, overlap.disc)) {
        result.in_contact.push_back(detail::pair_from(a, overlap.disc));
      }
    }
  }
  std::ranges::sort(result.in_contact);
  const auto& queue = core_->schedule.queue();
  using Entry = typename detail::Simulation_types<Traits>::Entry;
  std::vector<Entry> changes;
  queue.for_each([&](const Entry& entry) {
    if (is_change(entry.kind)) changes.push_back(entry);
  });
  std::ranges::sort(changes, {}, &Entry::point_b);
  for (const Entry& change : changes) {
    result.scheduled.push_back({queue.time_of(change).detached(),
                                change.kind == Contact_kind::erase    ? Event_kind::erase
                                : change.kind == Contact_kind::insert ? Event_kind::insert
                                                                      : Event_kind::trajectory,
                                change.point_a, core_->schedule.motion_of(change)});
  }
  return result;
}

template <SimulationKineticTraits_2 Traits>
Simulation_2<Traits>::Simulation_2(Restoration /*restores*/, const Snapshot& snapshot,
                                   Collision_response response, const Traits& traits)
    : core_(std::make_unique<detail::Simulation_core<Traits>>(traits, snapshot.options, [&] {
        return Triangulation::restore(
            snapshot.triangulation, traits,
            detail::coincident_for<Traits>(snapshot.options.coincident, snapshot.has_response));
      })) {
  KINETRI_PRECONDITION(
      !snapshot.has_response == !response,
      "a response where the snapshot's simulation had none, or none where it had one; pass one "
      "if and only if has_response is set");
  core_->setup.set_response(std::move(response));
  if (const std::string problem = core_->setup.problem(); !problem.empty()) {
    throw Snapshot_error("the snapshot's options cannot be used: " + problem);
  }
  if (options().masses.size() > triangulation().next_id()) {
    throw Snapshot_error("the snapshot has more masses than point ids");
  }
  core_->schedule.certificate_counters() = snapshot.certificates;
  core_->counters = snapshot.counters;
  core_->counters.queue = {};
  restore_contacts(snapshot);
  restore_changes(snapshot);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::restore_contacts(const Snapshot& snapshot) {
  if (core_->setup.has_response()) {
    try {
      core_->check_own_images();
    } catch (const Own_image_error& error) {
      throw Snapshot_error(std::string("the snapshot cannot be used: ") + error.what());
    }
  }
  core_->start();
  for (std::size_t i = 0; i < snapshot.in_contact.size(); ++i) {
    const typename Snapshot::Pair& pair = snapshot.in_contact[i];
    const auto [a, b] = detail::ids_of(pair);
    const auto other = detail::second_of(pair);
    if (!core_->setup.has_response() || a >= b || !triangulation().contains(a) ||
        !triangulation().contains(b) || (i > 0 && !(snapshot.in_contact[i - 1] < pair))) {
      throw Snapshot_error("the snapshot has points " + std::to_string(a) + " and " +
                           std::to_string(b) +
                           " in contact; expected two points that are there, once, and a response");
    }
    core_->records.start_overlap(a, other, core_->geometry.is_edge(pair));
    core_->records.mark_passing(a, other, true);
  }
  for (const Point_id id : core_->geometry.present_points()) {
    const auto refuse = [&](const Error& error) {
      throw Snapshot_error(std::string("the snapshot cannot be used: ") + error.what());
    };
    try {
      core_->setup.check_place(core_->geometry.point(id), current_time());
    } catch (const Outside_box_error& error) {
      refuse(error);
    } catch (const Negative_radius_error& error) {
      refuse(error);
    }
  }
  core_->schedule_all();
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::restore_changes(const Snapshot& snapshot) {
  using detail::Contact_kind;
  std::vector<bool> is_inserted(triangulation().next_id());
  for (const auto& [time, kind, id, motion] : snapshot.scheduled) {
    const bool is_insert = kind == Event_kind::insert;
    const bool is_erase = kind == Event_kind::erase;
    if ((!is_insert && !is_erase && kind != Event_kind::trajectory) ||
        motion.has_value() == is_erase || (motion && !is_finite(*motion)) ||
        id >= triangulation().next_id() || time < current_time() ||
        (is_insert && (triangulation().contains(id) || is_inserted[id]))) {
      throw Snapshot_error(
          "the snapshot has a scheduled change of point " + std::to_string(id) +
          " that cannot be made; expected an insertion, a new motion or an erasure of a point that "
          "has an id, not in the past");
    }
    if (is_insert) is_inserted[id] = true;
    schedule(time.detached(),
             is_insert  ? Contact_kind::insert
             : is_erase ? Contact_kind::erase
                        : Contact_kind::trajectory,
             id, motion);
  }
}

// ---- calls within calls ----

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::check_may_change() const {
  KINETRI_PRECONDITION(!is_changing_,
                       "a change of the simulation within an event, or while another change is "
                       "made; make it when advance_to, step or the other change has returned, or "
                       "schedule it");
  check_is_whole();
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::check_is_whole() const {
  KINETRI_PRECONDITION(!core_->loop.is_within_contact() || is_changing_,
                       "an error has left the simulation within a contact; make another one, or "
                       "restore a snapshot");
  if (!is_changing_) core_->kinetic().reporter.check_may_change();
}

// ---- time ----

template <SimulationKineticTraits_2 Traits>
auto Simulation_2<Traits>::next_event_time() -> std::optional<Time> {
  const detail::Flag_while changing = start_change();
  std::optional<Time> result = core_->triangulation.next_event_time();
  core_->schedule.settle();
  auto& queue = core_->schedule.queue();
  if (queue.empty()) return result;
  const Time first = queue.time(queue.top());
  if (!result || first < *result) result = first;
  return result;
}

template <SimulationKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::step() {
  const detail::Flag_while changing = start_change();
  return core_->step(nullptr);
}

template <SimulationKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::step(const Time& until) {
  const detail::Flag_while changing = start_change();
  return core_->step(&until);
}

template <SimulationKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::advance_to(const Time& time,
                                             const std::function<bool()>& may_go_on) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(
      time >= current_time(),
      "the time to advance to is in the past; take the present one or a later one");
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    // With a response discs meet their own images before the box has no area.
    if (!core_->setup.has_response()) {
      triangulation().traits().box().require_area(current_time(), time);
    }
  }
  return core_->advance_to(time, may_go_on);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::set_threads(std::size_t most) {
  core_->threads = most;
  core_->triangulation.set_threads(most);
}

// ---- changes, now ----

template <SimulationKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::insert(const Motion& motion, double mass) {
  const detail::Flag_while changing = start_change();
  const Point_id id = triangulation().next_id();
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  core_->setup.set_mass(id, mass);  // observers of the insertion may ask for it
  try {
    core_->loop.insert(motion, std::nullopt);
  } catch (...) {
    if (triangulation().next_id() == id) core_->setup.forget_masses_from(id);
    throw;
  }
  return id;
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  set_motions({&id, 1}, {&motion, 1});
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::set_motions(std::span<const Point_id> ids,
                                       std::span<const Motion> motions) {
  const detail::Flag_while changing = start_change();
  core_->loop.set_motions(ids, motions);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::set_velocities(std::span<const Point_id> ids,
                                          std::span<const Vector_2> velocities) {
  const detail::Flag_while changing = start_change();
  detail::check_vectors(ids, velocities, "velocity", "velocities");
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(triangulation().contains(ids[i]), detail::unknown_id_problem(ids[i]));
    motions.push_back(core_->outcomes.with_velocity(ids[i], velocities[i], current_time()));
  }
  core_->loop.set_motions(ids, motions);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::erase(Point_id id) {
  const detail::Flag_while changing = start_change();
  core_->loop.erase(id);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::set_mass(Point_id id, double mass) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(triangulation().contains(id), detail::unknown_id_problem(id));
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  core_->setup.set_mass(id, mass);
}

// ---- changes, scheduled ----

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule(const Time& time, detail::Contact_kind kind, Point_id id,
                                    const std::optional<Motion>& motion) {
  check_is_whole();
  KINETRI_PRECONDITION(time >= current_time(),
                       "a change in the past; take the present time or a later one");
  KINETRI_PRECONDITION(id < triangulation().next_id(),
                       "no point has the id " + std::to_string(id) +
                           "; take one that insert or schedule_insert gave");
  KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  core_->schedule.schedule_change(time, kind, id, motion);
}

template <SimulationKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::schedule_insert(const Time& time, const Motion& motion,
                                               double mass) {
  const Point_id id = triangulation().next_id();
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  check_is_whole();
  core_->kinetic().topology.give_ids(1);
  schedule(time, detail::Contact_kind::insert, id, motion);
  core_->setup.set_mass(id, mass);
  return id;
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_motion(const Time& time, Point_id id, const Motion& motion) {
  schedule(time, detail::Contact_kind::trajectory, id, motion);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_erase(const Time& time, Point_id id) {
  schedule(time, detail::Contact_kind::erase, id, std::nullopt);
}

// ---- watching ----

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::add_observer(Observer& observer) {
  check_may_change();
  core_->triangulation.add_observer(observer);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::remove_observer(Observer& observer) {
  core_->triangulation.remove_observer(observer);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::add_overlap_observer(Overlap_observer& observer) {
  check_may_change();
  core_->loop.overlap_observers().add(observer);
}

template <SimulationKineticTraits_2 Traits>
void Simulation_2<Traits>::remove_overlap_observer(Overlap_observer& observer) {
  core_->loop.overlap_observers().remove(observer);
}

template <SimulationKineticTraits_2 Traits>
std::size_t Simulation_2<Traits>::queue_size() const noexcept {
  return core_->schedule.queue().size();
}

template <SimulationKineticTraits_2 Traits>
std::uint64_t Simulation_2<Traits>::number_of_passes() const noexcept {
  return core_->loop.number_of_passes();
}

template <SimulationKineticTraits_2 Traits>
std::vector<Point_id> Simulation_2<Traits>::overlapping_discs(Point_id id) const {
  KINETRI_PRECONDITION(core_->setup.has_response(),
                       "overlaps are followed only with a response; log_contact changes nothing");
  KINETRI_PRECONDITION(triangulation().contains(id), detail::unknown_id_problem(id));
  std::vector<Point_id> result;
  for (const auto& disc : core_->overlapping_discs(id)) result.push_back(detail::id_of(disc));
  return result;
}

template <SimulationKineticTraits_2 Traits>
Contact_counters Simulation_2<Traits>::contact_counters() const {
  Contact_counters result = core_->counters;
  result.queue = core_->schedule.queue().counters();
  return result;
}

template <SimulationKineticTraits_2 Traits>
Certificate_counters Simulation_2<Traits>::certificate_counters() const {
  Certificate_counters result = triangulation().certificate_counters();
  return result += core_->schedule.certificate_counters();
}

template <SimulationKineticTraits_2 Traits>
Audit_report Simulation_2<Traits>::audit(Audit_level level) const {
  return typename detail::Simulation_types<Traits>::Simulation_auditor(*core_).run(level);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_2_IMPL_H
