// SPDX-License-Identifier: GPL-3.0-or-later
#include "algebra/rounded_quotient.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

using Interval = Rational_interval;

bool contains_zero(const Interval& x) {
  return x.lower <= 0 && x.upper >= 0;
}

Interval hull(std::initializer_list<Rational> numbers) {
  return {std::min(numbers), std::max(numbers)};
}

// Contains the values of `p` on the interval `t`.
Interval values(const Polynomial& p, const Interval& t) {
  Interval sum{0, 0};
  for (int i = p.degree(); i >= 0; --i) {
    sum =
        hull({sum.lower * t.lower, sum.lower * t.upper, sum.upper * t.lower, sum.upper * t.upper});
    sum.lower += Rational(p[i]);
    sum.upper += Rational(p[i]);
  }
  return sum;
}

// The midpoint of two adjacent binary64 numbers; if one is infinite, the number from which on
// rounding gives infinity.
Rational middle(double lower, double upper) {
  if (std::isfinite(lower) && std::isfinite(upper)) {
    return (to_rational(lower) + to_rational(upper)) / 2;
  }
  constexpr double largest = std::numeric_limits<double>::max();
  const Rational half_step = (to_rational(largest) - to_rational(std::nextafter(largest, 0))) / 2;
  const Rational bound = to_rational(largest) + half_step;
  return std::isfinite(lower) ? bound : Rational(-bound);
}

// The rounded quotient if the interval `times` around `t` is narrow enough. Precondition: neither
// polynomial vanishes at `t`, which is between the ends of the interval.
std::optional<double> try_round(const Polynomial& p, const Polynomial& q, const Algebraic_number& t,
                                const Interval& times) {
  const Interval above = values(p, times);
  const Interval below = values(q, times);
  if (contains_zero(above) || contains_zero(below)) return std::nullopt;
  const Interval quotient = hull({above.lower / below.lower, above.lower / below.upper,
                                  above.upper / below.lower, above.upper / below.upper});
  const double lower = to_double(quotient.lower);
  const double upper = to_double(quotient.upper);
  if (lower == upper) return lower;
  if (std::nextafter(lower, upper) != upper) return std::nullopt;
  const Rational between = middle(lower, upper);
  const Polynomial excess = p * boost::multiprecision::denominator(between) -
                            q * boost::multiprecision::numerator(between);
  switch (sign_at(excess, t) * (sign(below.lower))) {
    case CGAL::NEGATIVE:
      return lower;
    case CGAL::POSITIVE:
      return upper;
    default:
      return to_double(between);
  }
}

}  // namespace

double rounded_quotient(const Polynomial& p, const Polynomial& q, const Algebraic_number& t) {
  KINETRI_PRECONDITION(sign_at(q, t) != CGAL::ZERO, "a quotient whose denominator vanishes");
  if (sign_at(p, t) == CGAL::ZERO) return 0;
  for (unsigned bits = 64;; bits *= 2) {
    t.refine_to_bits(bits);
    const Interval times = t.isolating_interval();
    if (times.is_point()) return to_double(p(times.lower) / q(times.lower));
    if (const auto rounded = try_round(p, q, t, times)) return *rounded;
  }
}

}  // namespace kinetri
