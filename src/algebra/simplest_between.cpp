// SPDX-License-Identifier: GPL-3.0-or-later
#include "dyadic.h"
#include "gmp_access.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

// floor(|x| 2^e), exactly.
Integer scaled_magnitude_floor(const Algebraic_number& x, long e) {
  for (;;) {
    const Rational_interval present = x.isolating_interval();
    const bool negative = present.lower.sign() < 0;
    const Rational near_zero = boost::multiprecision::abs(negative ? present.upper : present.lower);
    const Rational far = boost::multiprecision::abs(negative ? present.lower : present.upper);
    const Integer least = scaled_floor(near_zero, e);
    const Integer greatest = scaled_floor(far, e);
    if (least == greatest) return least;
    if (greatest - least > 1) {
      x.refine();
      continue;
    }
    // One grid point is in the interval: compare.
    const Rational grid_point = scaled_by_power_of_two(greatest, -e);
    const Comparison_result order = compare(x, negative ? Rational(-grid_point) : grid_point);
    return order == (negative ? CGAL::LARGER : CGAL::SMALLER) ? least : greatest;
  }
}

}  // namespace

Rational simplest_between(const Algebraic_number& a, const Algebraic_number& b) {
  KINETRI_PRECONDITION(compare(a, b) == CGAL::SMALLER, "the interval is empty");
  const bool positive = compare(a, Rational(0)) != CGAL::SMALLER;
  if (!positive && compare(b, Rational(0)) == CGAL::LARGER) return 0;
  const Algebraic_number& near_zero = positive ? a : b;
  const Algebraic_number& far = positive ? b : a;

  // The candidate for an exponent e is the multiple of 2^-e next to the end nearer to zero. If it
  // is in the interval for one e, so is a candidate for each greater e.
  Rational candidate;
  const auto is_inside = [&](long e) {
    const Integer k = scaled_magnitude_floor(near_zero, e) + 1;
    candidate = scaled_by_power_of_two(positive ? k : Integer(-k), -e);
    return compare(far, candidate) == (positive ? CGAL::LARGER : CGAL::SMALLER);
  };

  // 2^-outside >= |far|, so nothing is inside for this exponent.
  const Rational bound = boost::multiprecision::abs(positive ? far.upper() : far.lower());
  long outside = bit_length(denominator(bound)) - bit_length(numerator(bound)) - 1;
  long inside = outside + 1;
  for (long step = 1; !is_inside(inside); step *= 2) {
    outside = inside;
    inside += step;
  }
  while (inside - outside > 1) {
    const long middle = outside + (inside - outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  is_inside(inside);
  return candidate;
}

}  // namespace kinetri
