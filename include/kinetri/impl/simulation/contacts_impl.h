// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: what a contact does to its points.
#ifndef KINETRI_IMPL_SIMULATION_CONTACTS_IMPL_H
#define KINETRI_IMPL_SIMULATION_CONTACTS_IMPL_H

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/simulation/disc_numbers.h"
#include "kinetri/impl/simulation/shortest_text.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

// Executes a contact that has left the queue, after so many at its time that have changed points.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::execute_contact(const Entry& contact, std::uint64_t& turning) {
  const std::vector<Change> changes = changes_of(contact, turning);
  if (contact.kind == Entry_kind::wall) {
    hit_wall(contact.point_a, changes);
  } else {
    collide(contact.point_a, contact.point_b, contact.is_edge, changes);
  }
}

// What a contact does to its points. A contact without end goes back to the queue, so that all is
// as it was before it.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::changes_of(const Entry& contact, std::uint64_t& turning)
    -> std::vector<Change> {
  try {
    const std::vector<Change> result =
        contact.kind == Entry_kind::wall
            ? std::vector<Change>{reflection(contact.point_a, contact.point_b, current_time())}
            : collision(contact.point_a, contact.point_b, current_time());
    if (!result.empty()) check_limit(contact, ++turning);
    return result;
  } catch (const Endless_contacts_error&) {
    note(contact.subject(), queue_.push(contact, current_time()));
    is_within_contact_ = false;
    throw;
  }
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::hit_wall(Point_id id, std::span<const Change> changes) {
  change({&id, 1}, [&] { triangulation_.apply(Event_kind::wall, id, std::nullopt, changes); });
}

// What a wall does to a point at the time `now`, at which they touch. Changes nothing.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::reflection(Point_id id, std::size_t wall, const Time& now) const
    -> Change {
  if (!traits_.has_approach_speed(point(id), walls_[wall], now)) {
    refuse_press(id,
                 "point " + std::to_string(id) + " accelerates toward the " +
                     std::string(name(walls_[wall].side)) + " wall",
                 "change the acceleration or the box, or end before that time", now);
  }
  const double time = now.to_double();
  const Motion& motion = triangulation_.motion(id);
  Vector_2 velocity = rounded_velocity(motion, time);
  double& component = walls_[wall].is_vertical() ? velocity.x : velocity.y;
  component = -component;
  if (walls_[wall].rim) {  // the rim parts from the wall as fast as it came
    component += (walls_[wall].is_upper() ? -2 : 2) * detail::growth_of(motion);
  }
  return {id, with_velocity(id, velocity, now)};
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::collide(Point_id a, Point_id b, bool is_edge,
                                   std::span<const Change> changes) {
  if (find_overlap({a, b}) != nullptr) mark_passing(a, b, false);  // they had separated
  const auto apply = [&] { triangulation_.apply(Event_kind::collision, a, b, changes); };
  if (changes.empty()) {  // they pass through each other
    ++passes_;
    let_pass(a, b, is_edge);
    apply();
    return schedule_pair({a, b}, is_edge, current_time());
  }
  const std::array<Point_id, 2> points = {a, b};
  change(points, apply);
}

// What the response does to two discs at the time `now`, at which they touch. Changes nothing.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::collision(Point_id a, Point_id b, const Time& now) const
    -> std::vector<Change> {
  const double time = now.to_double();
  const Motion& motion_a = triangulation_.motion(a);
  const Motion& motion_b = triangulation_.motion(b);
  const Vector_2 place_a = rounded_place(motion_a, time);
  const Vector_2 place_b = rounded_place(motion_b, time);
  // The motion with a velocity that is asked for mostly twice: by the response, and as its result.
  std::array<std::pair<Vector_2, std::optional<Motion>>, 2> known;
  const auto motion_with = [&](Point_id id, const Vector_2& velocity) -> const Motion& {
    auto& [known_velocity, motion] = known[id == a ? 0 : 1];
    if (!motion || known_velocity != velocity) {
      known_velocity = velocity;
      motion = with_velocity(id, velocity, now);
    }
    return *motion;
  };
  const auto would_approach = [&](const Vector_2& velocity_a, const Vector_2& velocity_b) {
    return traits_.do_approach(Point_2(motion_with(a, velocity_a), a),
                               Point_2(motion_with(b, velocity_b), b), now);
  };
  const bool is_pressed = !traits_.has_approach_speed(point(a), point(b), now);
  const Contact_response_2 response =
      options_.response({time,
                         a,
                         b,
                         {place_b.x - place_a.x, place_b.y - place_a.y},
                         rounded_velocity(motion_a, time),
                         rounded_velocity(motion_b, time),
                         mass(a),
                         mass(b),
                         detail::growth_of(motion_a),
                         detail::growth_of(motion_b),
                         is_pressed,
                         std::cref(would_approach)});

  // The motion that a point gets; none where it keeps its own.
  const auto new_motion = [&](Point_id id, bool stops,
                              const std::optional<Vector_2>& velocity) -> std::optional<Motion> {
    const Motion& motion = triangulation_.motion(id);
    if (stops) {
      if (is_at_rest(motion)) return std::nullopt;
      return usable(id, at_rest_at(motion, time), now);
    }
    if (!velocity || *velocity == rounded_velocity(motion, time)) return std::nullopt;
    return motion_with(id, *velocity);
  };
  const auto new_a = new_motion(a, response.stops_a, response.velocity_a);
  const auto new_b = new_motion(b, response.stops_b, response.velocity_b);
  if (is_pressed && response.is_motion_given() &&
      traits_.do_approach(Point_2(new_a.value_or(motion_a), a),
                          Point_2(new_b.value_or(motion_b), b), now)) {
    refuse_press(a,
                 "points " + std::to_string(a) + " and " + std::to_string(b) +
                     " accelerate toward each other",
                 "change the accelerations, end before that time, or take a response that stops or "
                 "removes points or lets them pass",
                 now);
  }
  std::vector<Change> changes;
  if (response.erases_a || new_a) {
    changes.push_back({a, response.erases_a ? std::nullopt : new_a});
  }
  if (response.erases_b || new_b) {
    changes.push_back({b, response.erases_b ? std::nullopt : new_b});
  }
  return changes;
}

// Has changes made of the points, which are sorted, with their contacts taken out before and
// scheduled after.
template <ContactKineticTraits_2 Traits>
template <class Make_changes>
void Simulation_2<Traits>::change(std::span<const Point_id> points, Make_changes make_changes) {
  for (const Point_id id : points) {
    end_passes(id);
    unschedule_single(id);
    unschedule_pairs(id);
  }
  const auto schedule_anew = [&] {
    if constexpr (has_radii) {
      for (const Point_id id : points) {
        if (options_.response && triangulation_.contains(id)) follow_links(id, current_time());
      }
    }
    changing_points_ = {};
    for (const Point_id id : points) {
      if (triangulation_.contains(id)) schedule_single(id, current_time());
    }
    schedule_pairs(points);
    overlap_observers_.call([&](Overlap_observer& observer) { observer.after_change(points); });
  };
  changing_points_ = points;
  try {
    make_changes();
  } catch (...) {  // nothing has changed
    schedule_anew();
    throw;
  }
  schedule_anew();
}

// The motion of a point after a contact at the time `now`, moved so that it is not outside of the
// box then. Throws where its numbers are too large.
template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::usable(Point_id id, Motion motion, const Time& now) const -> Motion {
  if (!is_finite(motion)) {
    throw Contact_overflow_error(
        id, "after its contact at t = " + detail::text(now) + " point " + std::to_string(id) +
                " has a place, velocity or acceleration beyond the range of binary64; expected "
                "smaller numbers, in other units perhaps");
  }
  if (!options_.box) return motion;
  for (const Wall_2& wall : walls_) {
    // Mostly it is far inside. Where it has to be moved, how far depends on the interval.
    if (clamped_inside(motion, wall, now.interval()) == motion) continue;
    motion = clamped_inside(motion, wall, now.tight_interval());
  }
  return motion;
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::with_velocity(Point_id id, const Vector_2& velocity,
                                         const Time& now) const -> Motion {
  return usable(id, with_velocity_at(triangulation_.motion(id), velocity, now.to_double()), now);
}

// `who` touches something, without a speed toward it, but with an acceleration toward it; `remedy`
// says what helps.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::refuse_press(Point_id id, const std::string& who,
                                        const std::string& remedy, const Time& now) const {
  throw Endless_contacts_error(
      id, who + " at t = " + detail::text(now) +
              ", in contact without any speed, so that no change of velocities separates them; "
              "expected contacts with a speed: " +
              remedy);
}

// Follows the edges of the triangulation, where there is a response. While points change, `change`
// schedules their contacts.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::after_event(const Event& event) {
  if (event.removed) leave_edge(*event.removed);
  if (event.added) follow_edge(*event.added, event.time);
}

// An edge has gone.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::leave_edge(const Edge_ids& edge) {
  const bool do_overlap = find_overlap(edge) != nullptr;
  if (do_overlap) amend_overlap(edge, [](Overlap& overlap) { overlap.is_edge = false; });
  if (const Queue_handle event = find_pair(edge); event != no_event) {
    if (is_overlapped(edge)) {
      queue_.amend(event, [](Entry& entry) { entry.is_edge = false; });
    } else {
      unschedule_pair(edge);
    }
  }
  if (do_overlap && !has_radii) {
    for_each_pair_over(edge, [this](const Edge_ids& pair) { unwatch(pair); });
  }
}

// An edge has come, at the time `after`.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::follow_edge(const Edge_ids& edge, const Time& after) {
  watch_unless_changing(edge, true, after);
  if (find_overlap(edge) == nullptr) return;
  amend_overlap(edge, [](Overlap& overlap) { overlap.is_edge = true; });
  if (!has_radii) {
    for_each_pair_over(edge,
                       [&](const Edge_ids& pair) { watch_unless_changing(pair, false, after); });
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_CONTACTS_IMPL_H
