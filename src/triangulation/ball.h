// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ball arithmetic: a real number is enclosed by a midpoint, which is an unevaluated sum of two
// binary64 numbers, and a radius. About 100 bits are enough for most decisions and correct
// rounding; if the radius is too large, the caller uses exact arithmetic. Sources: T. Dekker, A
// floating-point technique for extending the available precision, Numerische Mathematik 18, 1971;
// F. Johansson, Arb: efficient arbitrary-precision midpoint-radius interval arithmetic, IEEE
// Transactions on Computers 66, 2017. docs/MATH.md, section 10, derives the constants.
#ifndef KINETRI_SRC_TRIANGULATION_BALL_H
#define KINETRI_SRC_TRIANGULATION_BALL_H

#include <cfenv>
#include <cmath>
#include <limits>
#include <optional>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri::detail {

/// Contains a real number: its distance from high + low is at most `radius`, up to factors near 1
/// from the rounding of radii. Therefore decisions use twice the radius. |low| is at most half a
/// unit in the last place of `high`. A member that is not finite means unknown. Right only if
/// rounding is to nearest, which ball_of checks.
struct Ball {
  double high = 0;
  double low = 0;
  double radius = 0;

  Ball() = default;
  explicit Ball(double value) : high(value) {}
  Ball(double high_part, double low_part, double r) : high(high_part), low(low_part), radius(r) {}

  /// Contains every number.
  static Ball unknown() { return {0, 0, std::numeric_limits<double>::infinity()}; }

  /// Whether the number is certainly greater than zero.
  bool is_positive() const { return high + low > 2 * radius; }
  /// Whether it is certainly not zero.
  bool is_nonzero() const { return std::abs(high + low) > 2 * radius; }
  /// Whether it is certainly zero.
  bool is_zero() const { return high == 0 && low == 0 && radius == 0; }

  /// The number rounded to nearest, ties to even, if that is certain (the test of A. Ziv, Fast
  /// evaluation of elementary mathematical functions with correctly rounded last bit, ACM
  /// Transactions on Mathematical Software 17, 1991). Zero has no sign.
  std::optional<double> rounded() const {
    const double reach = radius == 0 ? 0 : 2 * radius + 0x1p-105 * std::abs(high);
    const double lower = high + (low - reach);
    const double upper = high + (low + reach);
    if (lower != upper || !std::isfinite(lower)) return std::nullopt;
    return lower + 0.0;
  }
};

namespace ball {

inline constexpr double tiny = std::numeric_limits<double>::min();

// high + low is a + b exactly; in the second form if |a| >= |b| or a is zero.
KINETRI_ALWAYS_INLINE void exact_sum(double a, double b, double& high, double& low) {
  high = a + b;
  const double b_there = high - a;
  low = (a - (high - b_there)) + (b - b_there);
}
KINETRI_ALWAYS_INLINE void fast_exact_sum(double a, double b, double& high, double& low) {
  high = a + b;
  low = b - (high - a);
}

// The rest a b - product, exact except for underflow, without a fused multiply-add, which not every
// processor has. NaN if a factor is 2^996 or more.
KINETRI_ALWAYS_INLINE double rest_of_product(double a, double b, double product) {
  constexpr double splitter = 0x1p27 + 1;
  const double a_far = splitter * a;
  const double b_far = splitter * b;
  const double a_high = a_far - (a_far - a);
  const double b_high = b_far - (b_far - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

}  // namespace ball

KINETRI_ALWAYS_INLINE Ball operator-(const Ball& a) {
  return {-a.high, -a.low, a.radius};
}

/// Exact for two binary64 numbers.
KINETRI_ALWAYS_INLINE Ball operator+(const Ball& a, const Ball& b) {
  double sum = 0;
  double rest = 0;
  ball::exact_sum(a.high, b.high, sum, rest);
  const double low = a.low + b.low;
  Ball result;
  ball::exact_sum(sum, rest + low, result.high, result.low);
  result.radius = a.radius + b.radius;
  if (a.low != 0 || b.low != 0) {
    result.radius += 0x1p-102 * (std::abs(a.high) + std::abs(b.high));
  }
  return result;
}
KINETRI_ALWAYS_INLINE Ball operator-(const Ball& a, const Ball& b) {
  return a + -b;
}

/// Exact for two binary64 numbers, except for underflow.
KINETRI_ALWAYS_INLINE Ball operator*(const Ball& a, const Ball& b) {
  const double product = a.high * b.high;
  const double rest = ball::rest_of_product(a.high, b.high, product);
  const double low = a.high * b.low + a.low * b.high;
  const double size = std::abs(product);
  Ball result;
  ball::fast_exact_sum(product, rest + low, result.high, result.low);
  result.radius = std::abs(a.high) * b.radius + std::abs(b.high) * a.radius + a.radius * b.radius;
  if (a.low != 0 || b.low != 0) result.radius += 0x1p-101 * size;
  const bool may_underflow = size < 0x1p-900 && a.high != 0 && b.high != 0;
  if (may_underflow || a.radius != 0 || b.radius != 0) result.radius += ball::tiny;
  return result;
}

/// Unknown if the relative radius of the divisor is 2^-20 or more.
KINETRI_ALWAYS_INLINE Ball operator/(const Ball& a, const Ball& b) {
  const double size = std::abs(b.high);
  if (!(b.radius < 0x1p-20 * size)) return Ball::unknown();
  const double quotient = a.high / b.high;
  const Ball rest = a - Ball(quotient) * b;
  const double correction = rest.high / b.high;
  Ball result;
  ball::exact_sum(quotient, correction, result.high, result.low);
  result.radius =
      (rest.radius + std::abs(rest.high) * (0x1p-50 + b.radius / size)) / size + ball::tiny;
  return result;
}

/// Times two, exactly.
inline Ball twice(const Ball& a) {
  return {2 * a.high, 2 * a.low, 2 * a.radius};
}

/// Contains the number, which is refined to some 128 bits unless it is a binary64 number. Unknown
/// if this thread does not round to nearest.
inline Ball ball_of(const Algebraic_number& number) {
  if (std::fegetround() != FE_TONEAREST) return Ball::unknown();
  const Double_interval interval = number.interval();
  if (interval.lower == interval.upper) return Ball(interval.lower);
  number.refine_to_bits(128);
  const auto [lower, upper] = number.isolating_interval();
  const double high = to_double(lower);
  if (!std::isfinite(high)) return Ball::unknown();
  const double low = to_double(lower - to_rational(high));
  const Rational rest = upper - to_rational(high) - to_rational(low);
  const Rational rest_below = to_rational(high) + to_rational(low) - lower;
  return {high, low, to_interval(rest > rest_below ? rest : rest_below).upper};
}

/// Whether `high` is off by at most about half a unit in its last place.
inline bool is_known_well(const Ball& a) {
  return a.radius <= 0x1p-60 * std::abs(a.high);
}

struct Ball_2 {
  Ball x;
  Ball y;
};

/// Contains the position at the time that `t` contains.
inline Ball_2 ball_place(const Linear_motion_2& motion, const Ball& t) {
  const Ball elapsed = t - Ball(motion.epoch);
  const auto place = [&](double position, double velocity) {
    return velocity == 0 ? Ball(position) : Ball(position) + Ball(velocity) * elapsed;
  };
  return {place(motion.position.x, motion.velocity.x), place(motion.position.y, motion.velocity.y)};
}
inline Ball_2 ball_place(const Polynomial_motion_2& motion, const Ball& t) {
  const Ball elapsed = t - Ball(motion.epoch);
  const auto place = [&](double Vector_2::*axis) {
    Ball sum;
    if (motion.jerk.*axis != 0) sum = Ball(motion.jerk.*axis) / Ball(6) * elapsed;
    if (motion.acceleration.*axis != 0) sum = sum + Ball(motion.acceleration.*axis) * Ball(0.5);
    if (!sum.is_zero()) sum = sum * elapsed;
    sum = sum + Ball(motion.velocity.*axis);
    return sum.is_zero() ? Ball(motion.position.*axis)
                         : Ball(motion.position.*axis) + sum * elapsed;
  };
  return {place(&Vector_2::x), place(&Vector_2::y)};
}
inline Ball_2 ball_place(const Image_motion_2& image, const Ball& t) {
  Ball_2 place = ball_place(image.motion, t);
  const auto add = [&](double times, const Linear_motion_2& vector) {
    const Ball_2 there = ball_place(vector, t);
    place = {place.x + Ball(times) * there.x, place.y + Ball(times) * there.y};
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return place;
}
/// Unknown for other motions.
template <class Motion>
Ball_2 ball_place(const Motion& /*motion*/, const Ball& /*t*/) {
  return {Ball::unknown(), Ball::unknown()};
}

/// Contains the weight of a disc at the time that `t` contains.
template <class CenterMotion>
Ball ball_weight(const Basic_disc_motion_2<CenterMotion>& disc, const Ball& t) {
  const Ball radius = disc.growth == 0
                          ? Ball(disc.radius)
                          : Ball(disc.radius) + Ball(disc.growth) * (t - Ball(epoch_of(disc)));
  return radius * radius + Ball(disc.weight);
}
/// Unknown for other motions.
template <class Motion>
Ball ball_weight(const Motion& /*motion*/, const Ball& /*t*/) {
  return Ball::unknown();
}

/// A position whose coordinates are off by at most `error` each.
struct Approximate_place {
  Vector_2 place;
  double error = std::numeric_limits<double>::infinity();
};

/// The position at a time of which `t` is a rounding, by at most half a unit in the last place.
inline Approximate_place approximate_place(const Linear_motion_2& motion, double t) {
  const auto& [position, velocity, epoch] = motion;
  const double size =
      std::abs(position.x) + std::abs(position.y) +
      (std::abs(t) + std::abs(t - epoch)) * (std::abs(velocity.x) + std::abs(velocity.y));
  return {rounded_place(motion, t), 0x1p-49 * size + ball::tiny};
}
inline Approximate_place approximate_place(const Polynomial_motion_2& motion, double t) {
  const auto size = [](const Vector_2& v) { return std::abs(v.x) + std::abs(v.y); };
  const double span = std::abs(t) + std::abs(t - motion.epoch);
  const double sizes = size(motion.position) +
                       span * (size(motion.velocity) +
                               span * (size(motion.acceleration) + span * size(motion.jerk)));
  return {rounded_place(motion, t), 0x1p-47 * sizes + ball::tiny};
}
// The errors of the three places have room for the product and the two sums, as in place_error.
inline Approximate_place approximate_place(const Image_motion_2& image, double t) {
  Approximate_place result = approximate_place(image.motion, t);
  const auto add = [&](double times, const Linear_motion_2& vector) {
    const auto [there, error] = approximate_place(vector, t);
    result.place.x += times * there.x;
    result.place.y += times * there.y;
    result.error += std::abs(times) * error;
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return result;
}
/// Unknown for other motions.
template <class Motion>
Approximate_place approximate_place(const Motion& /*motion*/, double /*t*/) {
  return {};
}

/// Whether the two positions are certainly farther apart than `distance`, in x or in y.
inline bool are_apart(const Approximate_place& a, const Approximate_place& b, double distance = 0) {
  const double errors = 2 * (a.error + b.error);
  return std::abs(a.place.x - b.place.x) > distance + errors ||
         std::abs(a.place.y - b.place.y) > distance + errors;
}

KINETRI_ALWAYS_INLINE Ball_2 operator-(const Ball_2& a, const Ball_2& b) {
  return {a.x - b.x, a.y - b.y};
}

KINETRI_ALWAYS_INLINE Ball squared_length(const Ball_2& d) {
  return d.x * d.x + d.y * d.y;
}

/// Not less than the length of a vector with that squared length.
inline double length_bound(const Ball& squared_length) {
  return std::sqrt(squared_length.high + 4 * squared_length.radius) * (1 + 0x1p-50);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_BALL_H
