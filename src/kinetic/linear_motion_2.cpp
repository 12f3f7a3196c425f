// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_motion_2.h"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>

#include "kinetri/algebra/number_types.h"

namespace kinetri {
namespace {

// The coordinate at time 0.
Rational constant_term(double position, double velocity, double epoch) {
  return to_rational(position) - to_rational(velocity) * to_rational(epoch);
}

// p + v * (t - epoch), rounded correctly. In floating point with the exact error of each operation
// (T. Dekker, A floating-point technique for extending the available precision, Numerische
// Mathematik 18, 1971), and a bound for the rest; if the rounding is not certain then, in exact
// arithmetic (the test of A. Ziv, Fast evaluation of elementary mathematical functions with
// correctly rounded last bit, ACM Transactions on Mathematical Software 17, 1991).
double place_rounded_correctly(double p, double v, double epoch, double t) {
  const auto error_of_sum = [](double a, double b, double sum) {
    const double b_there = sum - a;
    return (a - (sum - b_there)) + (b - b_there);
  };
  const double elapsed = t - epoch;
  const double elapsed_rest = error_of_sum(t, -epoch, elapsed);
  const double moved = v * elapsed;
  const double moved_rest = std::fma(v, elapsed, -moved);
  const double place = p + moved;
  const double place_rest = error_of_sum(p, moved, place);
  const double late = v * elapsed_rest;
  const double rest = place_rest + moved_rest + late;
  const double error = 0x1p-49 * (std::abs(place_rest) + std::abs(moved_rest) + std::abs(late)) +
                       std::numeric_limits<double>::min();
  const double lower = place + (rest - error);
  const double upper = place + (rest + error);
  if (lower == upper && std::fegetround() == FE_TONEAREST) return lower;
  return to_double(to_rational(p) + to_rational(v) * (to_rational(t) - to_rational(epoch)));
}

}  // namespace

Linear_motion_2 with_velocity_at(const Linear_motion_2& motion, const Vector_2& velocity,
                                 double t) {
  const auto& [position, old_velocity, epoch] = motion;
  return {{place_rounded_correctly(position.x, old_velocity.x, epoch, t),
           place_rounded_correctly(position.y, old_velocity.y, epoch, t)},
          velocity,
          t};
}

Linear_motion_2 clamped_inside(const Linear_motion_2& motion, const Wall_2& wall,
                               const Double_interval& times) {
  const double place = wall.is_vertical() ? motion.position.x : motion.position.y;
  const double velocity = wall.is_vertical() ? motion.velocity.x : motion.velocity.y;
  // The distance moved during `times`, and that from the wall at the epoch. The error bounds are
  // generous, since most points are far from the wall.
  const double moved = std::abs(velocity) * (std::abs(times.lower - motion.epoch) +
                                             std::abs(times.upper - motion.epoch));
  const double inside =
      (wall.is_upper() ? wall.position - place : place - wall.position) - wall.clearance;
  const double terms = std::abs(wall.position) + wall.clearance + std::abs(place);
  if (inside > 2 * moved + 0x1p-40 * terms + std::numeric_limits<double>::min()) return motion;

  const Rational clearance = to_rational(wall.clearance);
  const Rational bound = to_rational(wall.position) + (wall.is_upper() ? -clearance : clearance);
  // The positions at the epoch from which it reaches the bound at either end of `times`.
  const auto required = [&](double time) {
    return Rational(bound -
                    to_rational(velocity) * (to_rational(time) - to_rational(motion.epoch)));
  };
  const Rational lower = required(times.lower);
  const Rational upper = required(times.upper);
  const double nearest = wall.is_upper() ? to_interval(std::min(lower, upper)).lower
                                         : to_interval(std::max(lower, upper)).upper;
  if (wall.is_upper() ? place <= nearest : place >= nearest) return motion;
  Linear_motion_2 result = motion;
  (wall.is_vertical() ? result.position.x : result.position.y) = nearest;
  return result;
}

bool is_finite(const Linear_motion_2& motion) {
  return std::isfinite(motion.position.x) && std::isfinite(motion.position.y) &&
         std::isfinite(motion.velocity.x) && std::isfinite(motion.velocity.y) &&
         std::isfinite(motion.epoch);
}

bool same_trajectory(const Linear_motion_2& a, const Linear_motion_2& b) {
  if (a.velocity != b.velocity) return false;
  if (a.epoch == b.epoch) return a.position == b.position;
  return constant_term(a.position.x, a.velocity.x, a.epoch) ==
             constant_term(b.position.x, b.velocity.x, b.epoch) &&
         constant_term(a.position.y, a.velocity.y, a.epoch) ==
             constant_term(b.position.y, b.velocity.y, b.epoch);
}

}  // namespace kinetri
