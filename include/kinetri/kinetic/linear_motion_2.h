// SPDX-License-Identifier: GPL-3.0-or-later
//
// The trajectory of a point that moves along a straight line with constant velocity.
#ifndef KINETRI_KINETIC_LINEAR_MOTION_2_H
#define KINETRI_KINETIC_LINEAR_MOTION_2_H

namespace kinetri {

/// Two binary64 components, each taken as exactly that number.
struct Vector_2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Vector_2&, const Vector_2&) = default;
};

/// The trajectory position + velocity * (t - epoch), an exact polynomial over the rationals in t.
/// All five numbers are finite; whoever takes a motion from a user checks that (`is_finite`).
struct Linear_motion_2 {
  Vector_2 position;  ///< the place at the epoch
  Vector_2 velocity;  ///< displacement per unit of time
  double epoch = 0;

  /// Equality of the representations; see `same_trajectory` for that of the trajectories.
  friend bool operator==(const Linear_motion_2&, const Linear_motion_2&) = default;
};

/// Whether all five numbers are finite.
bool is_finite(const Linear_motion_2& motion);

/// Whether the two are at the same place at every time, exactly, whatever their epochs.
bool same_trajectory(const Linear_motion_2& a, const Linear_motion_2& b);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_LINEAR_MOTION_2_H
