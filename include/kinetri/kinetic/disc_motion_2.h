// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion of a disc: that of its center, and a radius that changes at a constant rate. More
// generally, of a moving point with a weight, as in regular triangulations and power diagrams; the
// weight of a disc is the square of its radius.
#ifndef KINETRI_KINETIC_DISC_MOTION_2_H
#define KINETRI_KINETIC_DISC_MOTION_2_H

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// A disc whose center has the motion `CenterMotion` and whose radius at time t is
///
///     radius + growth * (t - epoch),
///
/// an exact polynomial over the rationals in t. Its weight at time t is the square of that, plus
/// `weight`, which is 0 for a disc; a point with a given weight of either sign has radius and
/// growth 0 and that `weight`. The power of a position to it is the squared distance to the center
/// minus the weight. All numbers are finite (`is_finite`).
template <class CenterMotion>
struct Basic_disc_motion_2 : CenterMotion {
  using Center_motion = CenterMotion;  ///< of the center; it has the epoch

  double radius = 0;  ///< at the epoch
  double growth = 0;  ///< of the radius per unit of time
  double weight = 0;  ///< to be added to the square of the radius

  /// Equality of the representations; see `same_trajectory` for that of the discs.
  friend bool operator==(const Basic_disc_motion_2&, const Basic_disc_motion_2&) = default;
};

/// A disc whose center moves along a straight line with constant velocity.
using Disc_motion_2 = Basic_disc_motion_2<Linear_motion_2>;
/// A disc whose center accelerates.
using Polynomial_disc_motion_2 = Basic_disc_motion_2<Polynomial_motion_2>;

/// A motion of a point with a weight, such as a disc.
template <class Motion>
concept HasWeight = requires(const Motion& motion) {
  typename Motion::Center_motion;
  { motion.radius + motion.growth + motion.weight } -> std::same_as<double>;
};

/// The motion of the center of a disc; any other motion itself.
template <class Motion>
const auto& center(const Motion& motion) {
  if constexpr (HasWeight<Motion>) {
    return static_cast<const typename Motion::Center_motion&>(motion);
  } else {
    return motion;
  }
}

/// The type of `center(motion)`.
template <class Motion>
using Center_motion_of = std::remove_cvref_t<decltype(center(std::declval<const Motion&>()))>;

/// The epoch of a motion.
template <class Motion>
requires requires(const Motion& motion) {
  motion.epoch;
}
double epoch_of(const Motion& motion) {
  return motion.epoch;
}

/// The same disc, as one whose center may accelerate.
Polynomial_disc_motion_2 polynomial_motion(const Disc_motion_2& disc);

/// The same motion, as one that has all numbers: those that it does not have are 0.
template <class Motion>
Polynomial_disc_motion_2 general_motion(const Motion& motion) {
  if constexpr (std::is_same_v<Motion, Polynomial_motion_2>) {
    return {motion, 0, 0, 0};
  } else if constexpr (std::is_same_v<Motion, Linear_motion_2>) {
    return {polynomial_motion(motion), 0, 0, 0};
  } else if constexpr (std::is_same_v<Motion, Disc_motion_2>) {
    return polynomial_motion(motion);
  } else {
    return motion;
  }
}

// As for Linear_motion_2, where `Disc` is Disc_motion_2 or Polynomial_disc_motion_2. Functions of
// motions without radii, such as `rounded_place`, concern the center.

/// @{
/// Whether all numbers are finite.
bool is_finite(const Disc_motion_2& disc);
bool is_finite(const Polynomial_disc_motion_2& disc);
/// @}

/// @{
/// Whether the two have the same center and the same weight at every time, exactly.
bool same_trajectory(const Disc_motion_2& a, const Disc_motion_2& b);
bool same_trajectory(const Polynomial_disc_motion_2& a, const Polynomial_disc_motion_2& b);
/// @}

/// @{
/// Whether the two have the same weight at every time, exactly.
bool have_equal_weights(const Disc_motion_2& a, const Disc_motion_2& b);
bool have_equal_weights(const Polynomial_disc_motion_2& a, const Polynomial_disc_motion_2& b);
/// @}

/// The radius at time t, rounded, for output, not for decisions. The error is a few units in the
/// last place of the largest term of the formula.
template <class CenterMotion>
double rounded_radius(const Basic_disc_motion_2<CenterMotion>& disc, double t) {
  return disc.radius + disc.growth * (t - epoch_of(disc));
}

/// The weight at time t, rounded as rounded_radius is.
template <class CenterMotion>
double rounded_weight(const Basic_disc_motion_2<CenterMotion>& disc, double t) {
  const double radius = rounded_radius(disc, t);
  return radius * radius + disc.weight;
}

/// Bounds how far rounded_weight(disc, t) is from the weight at any of the times. Not finite if
/// numbers overflow. Precondition: t is one of the times.
template <class CenterMotion>
double weight_error(const Basic_disc_motion_2<CenterMotion>& disc, double t,
                    const Double_interval& times) {
  // The radius has three roundings, the weight two more, each of at most two unit roundoffs in any
  // rounding mode.
  const double radius = std::abs(rounded_radius(disc, t));
  const double change = std::abs(disc.growth) * std::abs(t - epoch_of(disc));
  const double radius_error = disc.growth == 0
                                  ? 0
                                  : 0x1p-49 * (std::abs(disc.radius) + change) +
                                        2 * std::abs(disc.growth) * (times.upper - times.lower) +
                                        std::numeric_limits<double>::min();
  return 2 * radius_error * (2 * radius + radius_error) +
         0x1p-50 * (radius * radius + std::abs(disc.weight)) + std::numeric_limits<double>::min();
}

/// @{
/// The disc with the epoch `t` and the given velocity that starts from the position of `disc` at t,
/// with its radius there and its growth; the position is rounded as for a point. A radius that does
/// not change is not rounded. One that does is rounded down, by at least the error of the position,
/// but not below zero: then the new disc is inside the old one at all times within half a unit in
/// the last place of t. So two growing discs that touch at such a time do not overlap when both
/// have new motions, unless one is as small as the rounding.
Disc_motion_2 with_velocity_at(const Disc_motion_2& disc, const Vector_2& velocity, double t);
Polynomial_disc_motion_2 with_velocity_at(const Polynomial_disc_motion_2& disc,
                                          const Vector_2& velocity, double t);
/// @}

/// The disc at rest, which does not grow, from its position at t on, rounded as with_velocity_at
/// does.
template <class CenterMotion>
Basic_disc_motion_2<CenterMotion> at_rest_at(const Basic_disc_motion_2<CenterMotion>& disc,
                                             double t) {
  const Basic_disc_motion_2<CenterMotion> there = with_velocity_at(disc, {}, t);
  CenterMotion center = {};
  center.position = there.position;
  center.epoch = t;
  return {center, there.radius, 0, there.weight};
}

/// The disc with its center at rest at a position, and with the same radius and weight at all
/// times.
template <class CenterMotion>
Basic_disc_motion_2<CenterMotion> at_rest_in(const Basic_disc_motion_2<CenterMotion>& disc,
                                             const Vector_2& place) {
  return {at_rest_in(static_cast<const CenterMotion&>(disc), place), disc.radius, disc.growth,
          disc.weight};
}

/// Whether neither the position nor the radius ever changes.
template <class CenterMotion>
bool is_at_rest(const Basic_disc_motion_2<CenterMotion>& disc) {
  return is_at_rest(static_cast<const CenterMotion&>(disc)) && disc.growth == 0;
}

/// @{
/// As for points, for the center or, if `wall.rim_touches`, for the boundary circle: changes the
/// position of the disc, by about as little as necessary, and not its radius.
Disc_motion_2 clamped_inside(const Disc_motion_2& disc, const Wall_2& wall,
                             const Double_interval& times);
Polynomial_disc_motion_2 clamped_inside(const Polynomial_disc_motion_2& disc, const Wall_2& wall,
                                        const Double_interval& times);
/// @}

/// The disc at -t in place of t, exactly.
template <class CenterMotion>
Basic_disc_motion_2<CenterMotion> mirrored(const Basic_disc_motion_2<CenterMotion>& disc) {
  return {mirrored(static_cast<const CenterMotion&>(disc)), disc.radius, -disc.growth, disc.weight};
}

}  // namespace kinetri

#endif  // KINETRI_KINETIC_DISC_MOTION_2_H
