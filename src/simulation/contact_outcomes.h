// SPDX-License-Identifier: GPL-3.0-or-later
//
// The effect of a contact on its points. All functions are const.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_OUTCOMES_H
#define KINETRI_SRC_SIMULATION_CONTACT_OUTCOMES_H

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "simulation/disc_geometry.h"

namespace kinetri::detail {

/// Motions after contacts. Thread-safe if the response is.
template <class Traits>
class Simulation_types<Traits>::Contact_outcomes {
 public:
  /// The geometry must outlive this object.
  explicit Contact_outcomes(const Disc_geometry& geometry)
      : geometry_(geometry), setup_(geometry.setup()) {}

  /// The changes of points by a contact at the time `now`; none if discs pass through each other.
  /// Throws Contact_error, and what the response throws.
  std::vector<Change> changes(const Contact_entry& contact, const Time& now) const {
    if constexpr (!is_periodic) {
      if (contact.kind == Contact_kind::wall) {
        return {reflection(contact.point_a, contact.point_b, now)};
      }
    }
    return collision(contact.point_a, contact.disc_b(), now);
  }

  /// The motion of a point with another velocity from the time `now` on, moved so that it is not
  /// outside of the box then. Throws Contact_overflow_error if its numbers are too large.
  Motion with_velocity(Point_id id, const Vector_2& velocity, const Time& now) const {
    return usable(id, with_velocity_at(geometry_.motion(id), velocity, now.to_double()), now);
  }

 private:
  Change reflection(Point_id id, std::size_t wall, const Time& now) const;
  std::vector<Change> collision(Point_id a, const Disc& other, const Time& now) const;
  Vector_2 relative_to_image(const Vector_2& velocity, const Disc& disc, double times) const;
  Motion usable(Point_id id, Motion motion, const Time& now) const;
  [[noreturn]] static void refuse_resting_contact(Point_id id, const std::string& who,
                                                  const std::string& remedy, const Time& now);

  const Disc_geometry& geometry_;
  const Simulation_setup& setup_;
};

template <class Traits>
auto Simulation_types<Traits>::Contact_outcomes::reflection(Point_id id, std::size_t wall,
                                                            const Time& now) const -> Change {
  if constexpr (is_periodic) {
    KINETRI_ASSERT(false, "there are no walls in a periodic box");
    return {id, geometry_.motion(id)};
  } else {
    const Wall_2& side = setup_.walls()[wall];
    if (!setup_.traits().has_approach_speed(geometry_.point(id), side, now)) {
      refuse_resting_contact(id,
                             "point " + std::to_string(id) + " accelerates toward the " +
                                 std::string(name(side.side)) + " wall",
                             "change the acceleration or the box, or end before that time", now);
    }
    const double time = now.to_double();
    const Motion& motion = geometry_.motion(id);
    Vector_2 velocity = rounded_velocity(motion, time);
    double& component = side.is_vertical() ? velocity.x : velocity.y;
    component = -component;
    if (side.rim_touches) {  // the boundary circle leaves the wall as fast as it approached
      component += (side.is_upper() ? -2 : 2) * growth_of(motion);
    }
    return {id, with_velocity(id, velocity, now)};
  }
}

// The velocity plus so many times that of an image against its point.
template <class Traits>
Vector_2 Simulation_types<Traits>::Contact_outcomes::relative_to_image(
    const Vector_2& velocity, [[maybe_unused]] const Disc& disc,
    [[maybe_unused]] double times) const {
  if constexpr (is_periodic) {
    const Vector_2& first = setup_.traits().box().first().velocity;
    const Vector_2& second = setup_.traits().box().second().velocity;
    const auto& [k, l] = disc.offset;
    return {velocity.x + times * (k * first.x + l * second.x),
            velocity.y + times * (k * first.y + l * second.y)};
  } else {
    return velocity;
  }
}

// The changes of two discs by the response. `other` is the second one, as the first one sees it:
// the response is told the place and the velocity of that image.
template <class Traits>
auto Simulation_types<Traits>::Contact_outcomes::collision(Point_id a, const Disc& other,
                                                           const Time& now) const
    -> std::vector<Change> {
  const Traits& traits = setup_.traits();
  const double time = now.to_double();
  const Point_id b = id_of(other);
  const Motion& motion_a = geometry_.motion(a);
  const Motion& motion_b = geometry_.motion(b);
  const Vector_2 place_a = rounded_place(motion_a, time);
  const Vector_2 place_b = rounded_place(geometry_.point_of(other).motion(), time);
  const Vector_2 velocity_a = rounded_velocity(motion_a, time);
  const Vector_2 velocity_b = relative_to_image(rounded_velocity(motion_b, time), other, 1);
  // A motion is mostly computed twice: for the response, and for its result.
  std::array<std::pair<Vector_2, std::optional<Motion>>, 2> known;
  const auto motion_with = [&](Point_id id, const Vector_2& velocity) -> const Motion& {
    auto& [known_velocity, motion] = known[id == a ? 0 : 1];
    if (!motion || known_velocity != velocity) {
      known_velocity = velocity;
      motion = with_velocity(id, id == a ? velocity : relative_to_image(velocity, other, -1), now);
    }
    return *motion;
  };
  const auto do_approach = [&](const Motion& of_a, const Motion& of_b) {
    return traits.do_approach(geometry_.point_of(Point_2(of_a, a), geometry_.itself(a)),
                              geometry_.point_of(Point_2(of_b, b), other), now);
  };
  const auto would_approach = [&](const Vector_2& after_a, const Vector_2& after_b) {
    return do_approach(motion_with(a, after_a), motion_with(b, after_b));
  };
  // Two discs without a radius are at one place: their squared gap has no slope at any speed.
  const auto has_radius = [this](Point_id id) {
    return !geometry_.is_seed(id) && !geometry_.is_without_area(id);
  };
  const bool is_pressed = (has_radius(a) || has_radius(b)) &&
                          !traits.has_approach_speed(geometry_.point_of(geometry_.itself(a)),
                                                     geometry_.point_of(other), now);
  const Contact_response_2 response =
      setup_.options().response({time,
                                 a,
                                 b,
                                 {place_b.x - place_a.x, place_b.y - place_a.y},
                                 velocity_a,
                                 velocity_b,
                                 setup_.mass(a),
                                 setup_.mass(b),
                                 growth_of(motion_a),
                                 growth_of(motion_b),
                                 is_pressed,
                                 std::cref(would_approach)});

  // The motion that a point gets; none if it keeps its own.
  const auto new_motion = [&](Point_id id, bool stops, const std::optional<Vector_2>& velocity,
                              const Vector_2& before) -> std::optional<Motion> {
    if (stops) {
      const Motion& motion = geometry_.motion(id);
      if (is_at_rest(motion)) return std::nullopt;
      return usable(id, at_rest_at(motion, time), now);
    }
    if (!velocity || *velocity == before) return std::nullopt;
    return motion_with(id, *velocity);
  };
  const auto new_a = new_motion(a, response.stops_a, response.velocity_a, velocity_a);
  const auto new_b = new_motion(b, response.stops_b, response.velocity_b, velocity_b);
  if (is_pressed && response.is_motion_given() &&
      do_approach(new_a.value_or(motion_a), new_b.value_or(motion_b))) {
    refuse_resting_contact(
        a,
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

// The motion of a point after a contact, moved so that it is not outside of the box.
template <class Traits>
auto Simulation_types<Traits>::Contact_outcomes::usable(Point_id id, Motion motion,
                                                        const Time& now) const -> Motion {
  if (!is_finite(motion)) {
    throw Contact_overflow_error(
        id, "after its contact at t = " + text(now) + " point " + std::to_string(id) +
                " has a place, velocity or acceleration beyond the range of binary64; expected "
                "smaller numbers, in other units perhaps");
  }
  if (!setup_.has_box()) return motion;  // nor in a periodic box
  for (const Wall_2& wall : setup_.walls()) {
    // Mostly the point is far inside. The distance to move depends on the interval of the time.
    if (clamped_inside(motion, wall, now.interval()) == motion) continue;
    motion = clamped_inside(motion, wall, now.tight_interval());
  }
  return motion;
}

// `who` is in resting contact: without a speed, but with an acceleration toward what it touches.
template <class Traits>
void Simulation_types<Traits>::Contact_outcomes::refuse_resting_contact(Point_id id,
                                                                        const std::string& who,
                                                                        const std::string& remedy,
                                                                        const Time& now) {
  throw Endless_contacts_error(
      id, who + " at t = " + text(now) +
              ", in contact without any speed, so that no change of velocities separates them; "
              "expected contacts with a speed: " +
              remedy);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_OUTCOMES_H
