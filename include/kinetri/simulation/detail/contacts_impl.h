// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: what a contact does to its points.
#ifndef KINETRI_SIMULATION_DETAIL_CONTACTS_IMPL_H
#define KINETRI_SIMULATION_DETAIL_CONTACTS_IMPL_H

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::hit_wall(Point_id id, std::size_t wall) {
  const double time = current_time().to_double();
  const Motion& motion = triangulation_.motion(id);
  Vector_2 velocity = rounded_velocity(motion, time);
  double& component = walls_[wall].is_vertical() ? velocity.x : velocity.y;
  component = -component;
  const typename Triangulation::Change reflected = {id,
                                                    clamped_with_velocity(motion, velocity, time)};
  change(Event_kind::wall, {&id, 1}, {&reflected, 1});
}

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::collide(Point_id a, Point_id b) {
  const double time = current_time().to_double();
  const Motion& motion_a = triangulation_.motion(a);
  const Motion& motion_b = triangulation_.motion(b);
  const Vector_2 place_a = rounded_place(motion_a, time);
  const Vector_2 place_b = rounded_place(motion_b, time);
  const auto would_approach = [&](const Vector_2& velocity_a, const Vector_2& velocity_b) {
    return traits_.do_approach(Point_2(clamped_with_velocity(motion_a, velocity_a, time), a),
                               Point_2(clamped_with_velocity(motion_b, velocity_b, time), b),
                               current_time());
  };
  const Contact_response_2 response =
      options_.response({time,
                         a,
                         b,
                         {place_b.x - place_a.x, place_b.y - place_a.y},
                         rounded_velocity(motion_a, time),
                         rounded_velocity(motion_b, time),
                         would_approach});

  std::array<typename Triangulation::Change, 2> changes;
  std::size_t number = 0;
  const auto add = [&](Point_id id, const Motion& motion, bool erases,
                       const std::optional<Vector_2>& velocity) {
    if (erases) {
      changes[number++] = {id, std::nullopt};
    } else if (velocity && *velocity != rounded_velocity(motion, time)) {
      changes[number++] = {id, clamped_with_velocity(motion, *velocity, time)};
    }
  };
  add(a, motion_a, response.erases_a, response.velocity_a);
  add(b, motion_b, response.erases_b, response.velocity_b);
  if (number == 0) {
    leave_in_contact(a, b);
    triangulation_.apply(Event_kind::collision, a, b, {});
    return schedule_pair(edge_ids(a, b), current_time());
  }
  const std::array<Point_id, 2> points = {a, b};
  change(Event_kind::collision, points, {changes.data(), number});
}

// Makes the changes of one contact, with the contacts of its points scheduled before and after.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::change(Event_kind kind, std::span<const Point_id> points,
                                  std::span<const typename Triangulation::Change> changes) {
  for (const Point_id id : points) unschedule_contacts(id);
  const auto second = points.size() > 1 ? std::optional(points[1]) : std::nullopt;
  const auto schedule_anew = [&] {
    for (const Point_id id : points) part_from_others(id);
    for (const Point_id id : points) {
      if (!triangulation_.contains(id)) {
        contacts_.erase(id);
        continue;
      }
      const Point_id first = points.front();
      schedule_contacts(id, id != first && triangulation_.contains(first) ? first : no_point);
    }
  };
  changing_points_ = points;
  try {
    triangulation_.apply(kind, points[0], second, changes);
  } catch (const Coincident_trajectories_error&) {
    changing_points_ = {};
    schedule_anew();
    throw;
  }
  changing_points_ = {};
  schedule_anew();
}

template <ContactKineticTraits_2 Traits>
auto Simulation_2<Traits>::clamped_with_velocity(const Motion& motion, const Vector_2& velocity,
                                                 double time) const -> Motion {
  Motion result = with_velocity_at(motion, velocity, time);
  if (!options_.box) return result;
  const Double_interval times = current_time().tight_interval();
  for (const Wall_2& wall : walls_) result = clamped_inside(result, wall, times);
  return result;
}

// Follows the edges of the triangulation. While points change, `change` schedules their contacts.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::after_event(const Event& event) {
  if (!options_.response) return;
  if (event.removed) unschedule_pair(*event.removed);
  if (!event.added) return;
  const bool is_scheduled_later = std::ranges::any_of(
      *event.added, [&](Point_id id) { return std::ranges::count(changing_points_, id) > 0; });
  if (!is_scheduled_later) schedule_pair(*event.added, event.time);
}

// ---- discs in contact ----

template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::leave_in_contact(Point_id a, Point_id b) {
  const auto add = [this](Point_id id, Point_id other) {
    std::vector<Point_id>& touching = contacts_[id].touching;
    if (std::ranges::find(touching, other) == touching.end()) touching.push_back(other);
  };
  add(a, b);
  add(b, a);
}

// Of a point that has a new motion, or none, those that it does not overlap now are no longer in
// contact with it. As long as two keep their motions, next_contact_certificate knows.
template <ContactKineticTraits_2 Traits>
void Simulation_2<Traits>::part_from_others(Point_id id) {
  const auto contacts = contacts_.find(id);
  if (contacts == contacts_.end()) return;
  std::erase_if(contacts->second.touching, [&](Point_id other) {
    if (triangulation_.contains(id) && triangulation_.contains(other) &&
        traits_.do_overlap(point(id), point(other), diameter_, current_time())) {
      return false;
    }
    std::erase(contacts_.at(other).touching, id);
    return true;
  });
}

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_DETAIL_CONTACTS_IMPL_H
