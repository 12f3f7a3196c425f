// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: changes of points, now and scheduled.
#ifndef KINETRI_IMPL_SIMULATION_CHANGES_IMPL_H
#define KINETRI_IMPL_SIMULATION_CHANGES_IMPL_H

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/simulation/disc_numbers.h"
#include "kinetri/impl/triangulation/plain_loop.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule(const Time& time, Entry_kind kind, Point_id id,
                                    const std::optional<Motion>& motion) {
  check_is_whole();
  KINETRI_PRECONDITION(time >= current_time(),
                       "a change in the past; take the present time or a later one");
  KINETRI_PRECONDITION(id < triangulation_.next_id(),
                       "no point has the id " + std::to_string(id) +
                           "; take one that insert or schedule_insert gave");
  KINETRI_PRECONDITION(!motion || is_finite(*motion), detail::not_finite_problem(id));
  Entry entry;
  entry.point_a = id;
  entry.point_b = scheduled_++;
  entry.kind = kind;
  entry.is_event = true;
  push_change(time, entry, motion);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::push_change(const Time& time, Entry entry,
                                       const std::optional<Motion>& motion) {
  entry.bounds = time.interval();
  scheduled_changes_[entry.point_b] = {motion, queue_.push(entry, time)};
  ++scheduled_entries_;
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::take_scheduled_motion(const Entry& change) -> std::optional<Motion> {
  const auto node = scheduled_changes_.extract(change.point_b);
  return node ? node.mapped().motion : std::nullopt;
}

template <ContactKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::schedule_insert(const Time& time, const Motion& motion,
                                               double mass) {
  const Point_id id = triangulation_.next_id();
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  check_is_whole();
  detail::Plain_loop<Triangulation>::give_id(triangulation_);
  schedule(time, Entry_kind::insert, id, motion);
  keep_mass(id, mass);
  return id;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_motion(const Time& time, Point_id id, const Motion& motion) {
  schedule(time, Entry_kind::trajectory, id, motion);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::schedule_erase(const Time& time, Point_id id) {
  schedule(time, Entry_kind::erase, id, std::nullopt);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::execute_change(const Due_change& change) {
  const Point_id id = change.entry.point_a;
  if (change.entry.kind == Entry_kind::erase) {
    take_away(id);
  } else if (change.entry.kind == Entry_kind::insert) {
    insert_checked(*change.motion, id, [&] { triangulation_.insert(*change.motion, id); });
  } else if (triangulation_.contains(id)) {  // else it has left while the change was postponed
    turn({&id, 1}, {&*change.motion, 1});
  }
}

// Inserts a point, unless the options do not allow it.
template <ContactKineticTraits_2 Traits>
template <class Insert>
void Simulation_2<Traits>::insert_checked(const Motion& motion, Point_id id, Insert insert) {
  const Point_2 p(motion, id);
  check_place(p);
  if (options_.refuses_overlaps) refuse_overlaps_of(p);
  change({&id, 1}, insert);
}

// Makes a change. Returns false if another point has the trajectory that the change leads to.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::try_change(const Due_change& change) {
  try {
    execute_change(change);
    return true;
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
}

template <ContactKineticTraits_2 Traits>
Point_id Simulation_2<Traits>::insert(const Motion& motion, double mass) {
  const detail::Flag_while changing = start_change();
  const Point_id id = triangulation_.next_id();
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  insert_checked(motion, id, [&] { triangulation_.insert(motion); });
  keep_mass(id, mass);
  return id;
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::set_motion(Point_id id, const Motion& motion) {
  set_motions({&id, 1}, {&motion, 1});
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::set_motions(std::span<const Point_id> ids,
                                       std::span<const Motion> motions) {
  const detail::Flag_while changing = start_change();
  turn(ids, motions);
}

// What set_motions does, also within an instant.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::turn(std::span<const Point_id> ids, std::span<const Motion> motions) {
  for (std::size_t i = 0; i < std::min(ids.size(), motions.size()); ++i) {
    check_place(Point_2(motions[i], ids[i]));
  }
  std::vector<Point_id> points;
  for (const Point_id id : ids) {
    KINETRI_PRECONDITION(triangulation_.contains(id), detail::unknown_id_problem(id));
    points.push_back(id);
  }
  std::ranges::sort(points);
  change(points, [&] { triangulation_.set_motions(ids, motions); });
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::set_velocities(std::span<const Point_id> ids,
                                          std::span<const Vector_2> velocities) {
  const detail::Flag_while changing = start_change();
  detail::check_velocities(ids, velocities);
  std::vector<Motion> motions;
  motions.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    KINETRI_PRECONDITION(triangulation_.contains(ids[i]), detail::unknown_id_problem(ids[i]));
    motions.push_back(with_velocity(ids[i], velocities[i], current_time()));
  }
  turn(ids, motions);
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::erase(Point_id id) {
  const detail::Flag_while changing = start_change();
  take_away(id);
}

// What erase does, also within an instant.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::take_away(Point_id id) {
  change({&id, 1}, [&] { triangulation_.erase(id); });
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::set_mass(Point_id id, double mass) {
  const detail::Flag_while changing = start_change();
  KINETRI_PRECONDITION(triangulation_.contains(id), detail::unknown_id_problem(id));
  KINETRI_PRECONDITION(detail::mass_problem(id, mass).empty(), detail::mass_problem(id, mass));
  keep_mass(id, mass);
}

// Points beyond the end of the masses have the mass 1.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::keep_mass(Point_id id, double mass) {
  if (mass == this->mass(id)) return;
  if (id >= options_.masses.size()) options_.masses.resize(id + 1, 1.0);
  options_.masses[id] = mass;
}

// Takes the changes of motions out of the queue that can be made together with the first one, which
// has been taken out.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::pop_turns(const Entry& first) -> std::vector<Due_change> {
  std::vector<Due_change> result = {{first, take_scheduled_motion(first)}};
  const auto is_next = [&] {
    settle();
    return !queue_.empty() && queue_.top().kind == Entry_kind::trajectory &&
           queue_.top().point_a != result.back().entry.point_a &&
           queue_.time(queue_.top()) <= current_time();
  };
  while (is_next()) {
    const Entry next = pop();
    result.push_back({next, take_scheduled_motion(next)});
  }
  return result;
}

// Makes the changes of motions together. Returns false, and does nothing, if that is not possible.
template <ContactKineticTraits_2 Traits>
bool Simulation_2<Traits>::try_turns(std::span<const Due_change> turns) {
  std::vector<Point_id> ids;
  std::vector<Motion> motions;
  for (const auto& [entry, motion] : turns) {
    ids.push_back(entry.point_a);
    motions.push_back(*motion);
  }
  try {
    turn(ids, motions);
    return true;
  } catch (const Outside_box_error&) {
    return false;
  } catch (const Negative_radius_error&) {
    return false;
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_CHANGES_IMPL_H
