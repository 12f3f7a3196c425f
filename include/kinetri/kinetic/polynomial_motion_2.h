// SPDX-License-Identifier: GPL-3.0-or-later
//
// The trajectory of a point whose coordinates are polynomials of degree at most 3 in time.
#ifndef KINETRI_KINETIC_POLYNOMIAL_MOTION_2_H
#define KINETRI_KINETIC_POLYNOMIAL_MOTION_2_H

#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The trajectory
///
///     position + velocity * s + acceleration * s^2 / 2 + jerk * s^3 / 6,    s = t - epoch,
///
/// an exact polynomial over the rationals in t: the divisions are exact. All nine numbers are
/// finite (`is_finite`). Motions of different degrees may be mixed.
struct Polynomial_motion_2 {
  Vector_2 position;           ///< the position at the epoch
  Vector_2 velocity = {};      ///< its first derivative there
  Vector_2 acceleration = {};  ///< its second derivative there
  Vector_2 jerk = {};          ///< its third derivative
  double epoch = 0;            ///< the time at which the point is at `position`

  /// Equality of the representations; see `same_trajectory` for that of the trajectories.
  friend bool operator==(const Polynomial_motion_2&, const Polynomial_motion_2&) = default;
};

/// The same trajectory.
Polynomial_motion_2 polynomial_motion(const Linear_motion_2& motion);

// As for Linear_motion_2:

/// Whether all nine numbers are finite.
bool is_finite(const Polynomial_motion_2& motion);

/// Whether the two are at the same position at every time, exactly, whatever their epochs.
bool same_trajectory(const Polynomial_motion_2& a, const Polynomial_motion_2& b);

/// @{
/// The position and the velocity at time t, rounded, for output, not for decisions. The errors are
/// some units in the last place of the largest term of the formula.
Vector_2 rounded_place(const Polynomial_motion_2& motion, double t);
Vector_2 rounded_velocity(const Polynomial_motion_2& motion, double t);
/// @}

/// Bounds how far, in either coordinate, rounded_place(motion, t) is from the position at any of
/// the times. Not finite if numbers overflow. Precondition: t is one of the times.
double place_error(const Polynomial_motion_2& motion, double t, const Double_interval& times);

/// The motion with the epoch `t` and the given velocity that starts from the position of `motion`
/// at t, with the acceleration that it has there and its jerk; each coordinate of position and
/// acceleration rounded to the nearest binary64 number, ties to even. Coordinates that are too
/// large become infinite.
Polynomial_motion_2 with_velocity_at(const Polynomial_motion_2& motion, const Vector_2& velocity,
                                     double t);

/// The motion at rest, from its position at t on, rounded as with_velocity_at does.
inline Polynomial_motion_2 at_rest_at(const Polynomial_motion_2& motion, double t) {
  return {with_velocity_at(motion, {}, t).position, {}, {}, {}, t};
}

/// The motion at rest at a position.
inline Polynomial_motion_2 at_rest_in(const Polynomial_motion_2& motion, const Vector_2& place) {
  return {place, {}, {}, {}, motion.epoch};
}

/// Whether the position never changes.
inline bool is_at_rest(const Polynomial_motion_2& motion) {
  constexpr Vector_2 zero = {};
  return motion.velocity == zero && motion.acceleration == zero && motion.jerk == zero;
}

/// The motion itself if it is certainly on the inner side of the wall, or at its bound, at every
/// time in `times`; else with the position moved inward, by about as little as necessary.
/// Precondition: the bounds of `times` are finite.
Polynomial_motion_2 clamped_inside(const Polynomial_motion_2& motion, const Wall_2& wall,
                                   const Double_interval& times);

/// The motion at -t in place of t, exactly.
Polynomial_motion_2 mirrored(const Polynomial_motion_2& motion);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_POLYNOMIAL_MOTION_2_H
