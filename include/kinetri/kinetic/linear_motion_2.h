// SPDX-License-Identifier: GPL-3.0-or-later
//
// The trajectory of a point that moves along a straight line with constant velocity.
#ifndef KINETRI_KINETIC_LINEAR_MOTION_2_H
#define KINETRI_KINETIC_LINEAR_MOTION_2_H

#include <cmath>
#include <limits>

#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// Two binary64 components, each taken as exactly that number.
struct Vector_2 {
  double x = 0;  ///< to the right
  double y = 0;  ///< up

  friend bool operator==(const Vector_2&, const Vector_2&) = default;
};

/// The trajectory position + velocity * (t - epoch), an exact polynomial over the rationals in t.
/// All five numbers are finite (`is_finite`).
struct Linear_motion_2 {
  Vector_2 position;  ///< the position at the epoch
  Vector_2 velocity;  ///< displacement per unit of time
  double epoch = 0;   ///< the time at which the point is at `position`

  /// Equality of the representations; see `same_trajectory` for that of the trajectories.
  friend bool operator==(const Linear_motion_2&, const Linear_motion_2&) = default;
};

/// Whether all five numbers are finite.
bool is_finite(const Linear_motion_2& motion);

/// Whether the two are at the same position at every time, exactly, whatever their epochs.
bool same_trajectory(const Linear_motion_2& a, const Linear_motion_2& b);

/// The position at time t, rounded, for output, not for decisions. The error is a few units in the
/// last place of the largest term of the formula.
inline Vector_2 rounded_place(const Linear_motion_2& motion, double t) {
  const double elapsed = t - motion.epoch;
  return {motion.position.x + motion.velocity.x * elapsed,
          motion.position.y + motion.velocity.y * elapsed};
}

/// Bounds how far, in either coordinate, rounded_place(motion, t) is from the position at any of
/// the times. Not finite if numbers overflow. Precondition: t is one of the times.
inline double place_error(const Linear_motion_2& motion, double t, const Double_interval& times) {
  const auto& [position, velocity, epoch] = motion;
  const double speed = std::abs(velocity.x) + std::abs(velocity.y);
  const double terms = std::abs(position.x) + std::abs(position.y) + speed * std::abs(t - epoch);
  // Four roundings, each of at most two unit roundoffs of the terms in any rounding mode.
  return 0x1p-49 * terms + 2 * speed * (times.upper - times.lower) +
         std::numeric_limits<double>::min();
}

/// The velocity, exactly; it is the same at all times.
inline Vector_2 rounded_velocity(const Linear_motion_2& motion, double /*t*/) {
  return motion.velocity;
}

/// The motion with the epoch `t` and the given velocity that starts from the position of `motion`
/// at t, each coordinate of it rounded to the nearest binary64 number, ties to even. Coordinates
/// that are too large become infinite.
Linear_motion_2 with_velocity_at(const Linear_motion_2& motion, const Vector_2& velocity, double t);

/// The motion at rest, from its position at t on, rounded as with_velocity_at does.
inline Linear_motion_2 at_rest_at(const Linear_motion_2& motion, double t) {
  return with_velocity_at(motion, {}, t);
}

/// The motion at rest at a position.
inline Linear_motion_2 at_rest_in(const Linear_motion_2& motion, const Vector_2& place) {
  return {place, {}, motion.epoch};
}

/// Whether the position never changes.
inline bool is_at_rest(const Linear_motion_2& motion) {
  return motion.velocity == Vector_2();
}

/// The motion itself if it is on the inner side of the wall, or at its bound, at every time in
/// `times`; else the motion with the nearest position for which it is. Exact. Precondition: the
/// bounds of `times` are finite.
Linear_motion_2 clamped_inside(const Linear_motion_2& motion, const Wall_2& wall,
                               const Double_interval& times);

/// The motion at -t in place of t, exactly.
inline Linear_motion_2 mirrored(const Linear_motion_2& motion) {
  return {motion.position, {-motion.velocity.x, -motion.velocity.y}, -motion.epoch};
}

}  // namespace kinetri

#endif  // KINETRI_KINETIC_LINEAR_MOTION_2_H
