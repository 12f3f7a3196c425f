// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/polynomial_motion_2.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/moving_point_2.h"

namespace kinetri {
namespace {

// The exact coefficients of a coordinate in t - epoch.
std::array<Rational, 4> by_powers(const Polynomial_motion_2& m, double Vector_2::*axis) {
  return {to_rational(m.position.*axis), to_rational(m.velocity.*axis),
          to_rational(m.acceleration.*axis) / 2, to_rational(m.jerk.*axis) / 6};
}

// The coefficients with the origin `elapsed` later.
std::array<Rational, 4> later(const std::array<Rational, 4>& c, const Rational& elapsed) {
  return {Rational(c[0] + elapsed * (c[1] + elapsed * (c[2] + elapsed * c[3]))),
          Rational(c[1] + elapsed * (2 * c[2] + 3 * elapsed * c[3])),
          Rational(c[2] + 3 * elapsed * c[3]), c[3]};
}

Vector_2 rounded(const Rational& x, const Rational& y) {
  return {to_double(x), to_double(y)};
}

}  // namespace

Polynomial_motion_2 polynomial_motion(const Linear_motion_2& motion) {
  return {motion.position, motion.velocity, {}, {}, motion.epoch};
}

bool is_finite(const Polynomial_motion_2& motion) {
  const auto finite = [](const Vector_2& v) { return std::isfinite(v.x) && std::isfinite(v.y); };
  return finite(motion.position) && finite(motion.velocity) && finite(motion.acceleration) &&
         finite(motion.jerk) && std::isfinite(motion.epoch);
}

bool same_trajectory(const Polynomial_motion_2& a, const Polynomial_motion_2& b) {
  if (a.jerk != b.jerk) return false;
  const Trajectory_2 path_a = trajectory(a);
  const Trajectory_2 path_b = trajectory(b);
  return path_a.x * path_b.w == path_b.x * path_a.w && path_a.y * path_b.w == path_b.y * path_a.w;
}

Vector_2 rounded_place(const Polynomial_motion_2& motion, double t) {
  const double s = t - motion.epoch;
  const auto place = [&](double Vector_2::*axis) {
    return motion.position.*axis + s * (motion.velocity.*axis + s * (motion.acceleration.*axis / 2 +
                                                                     s * (motion.jerk.*axis / 6)));
  };
  return {place(&Vector_2::x), place(&Vector_2::y)};
}

// The position has at most fifteen rounding errors, each at most two unit roundoffs of the terms in
// any rounding mode.
double place_error(const Polynomial_motion_2& motion, double t, const Double_interval& times) {
  const auto sum = [](const Vector_2& v) { return std::abs(v.x) + std::abs(v.y); };
  const double s = std::abs(t - motion.epoch);
  const double width = times.upper - times.lower;
  const double terms =
      sum(motion.position) +
      s * (sum(motion.velocity) + s * (sum(motion.acceleration) / 2 + s * (sum(motion.jerk) / 6)));
  const double r = s + width;  // the greatest time from the epoch, up to rounding
  const double speed =
      sum(motion.velocity) + r * (sum(motion.acceleration) + r * (sum(motion.jerk) / 2));
  return 0x1p-47 * terms + 2 * speed * width + std::numeric_limits<double>::min();
}

Vector_2 rounded_velocity(const Polynomial_motion_2& motion, double t) {
  const double s = t - motion.epoch;
  const auto velocity = [&](double Vector_2::*axis) {
    return motion.velocity.*axis + s * (motion.acceleration.*axis + s * (motion.jerk.*axis / 2));
  };
  return {velocity(&Vector_2::x), velocity(&Vector_2::y)};
}

Polynomial_motion_2 with_velocity_at(const Polynomial_motion_2& motion, const Vector_2& velocity,
                                     double t) {
  const Rational elapsed = to_rational(t) - to_rational(motion.epoch);
  const auto x = later(by_powers(motion, &Vector_2::x), elapsed);
  const auto y = later(by_powers(motion, &Vector_2::y), elapsed);
  return {rounded(x[0], y[0]), velocity, rounded(2 * x[2], 2 * y[2]), motion.jerk, t};
}

Polynomial_motion_2 clamped_inside(const Polynomial_motion_2& motion, const Wall_2& wall,
                                   const Double_interval& times) {
  const auto axis = wall.is_vertical() ? &Vector_2::x : &Vector_2::y;
  const double place = motion.position.*axis;
  const double farthest =
      std::max(std::abs(times.lower - motion.epoch), std::abs(times.upper - motion.epoch));
  // The distance moved, and that from the wall at the epoch. The error bounds are generous, since
  // most points are far from the wall.
  const double moved =
      farthest *
      (std::abs(motion.velocity.*axis) +
       farthest * (std::abs(motion.acceleration.*axis) + farthest * std::abs(motion.jerk.*axis)));
  const double inside =
      (wall.is_upper() ? wall.position - place : place - wall.position) - wall.clearance;
  const double terms = std::abs(wall.position) + wall.clearance + std::abs(place);
  if (inside > 2 * moved + 0x1p-40 * terms + std::numeric_limits<double>::min()) return motion;

  // The least Bernstein coefficient of the distance from the wall over `times` is a lower bound for
  // it.
  auto c = later(by_powers(motion, axis), to_rational(times.lower) - to_rational(motion.epoch));
  const Rational clearance = to_rational(wall.clearance);
  c[0] -= to_rational(wall.position) + (wall.is_upper() ? -clearance : clearance);
  Rational power = 1;
  for (Rational& coefficient : c) {
    coefficient *= power;
    if (wall.is_upper()) coefficient = -coefficient;
    power *= to_rational(times.upper) - to_rational(times.lower);
  }
  const Rational least =
      std::min({c[0], Rational(c[0] + c[1] / 3), Rational(c[0] + (2 * c[1] + c[2]) / 3),
                Rational(c[0] + c[1] + c[2] + c[3])});
  if (least >= 0) return motion;
  const Rational wanted = to_rational(place) + (wall.is_upper() ? least : Rational(-least));
  Polynomial_motion_2 result = motion;
  result.position.*axis = wall.is_upper() ? to_interval(wanted).lower : to_interval(wanted).upper;
  return result;
}

Polynomial_motion_2 mirrored(const Polynomial_motion_2& motion) {
  return {motion.position,
          {-motion.velocity.x, -motion.velocity.y},
          motion.acceleration,
          {-motion.jerk.x, -motion.jerk.y},
          -motion.epoch};
}

}  // namespace kinetri
