// SPDX-License-Identifier: GPL-3.0-or-later
#include "algebra/rounded_quotient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri::rounded_quotient_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Algebraic_number square_root(int radicand) {
  return {Polynomial({Integer(-radicand), Integer(0), Integer(1)}), Rational(0),
          Rational(radicand)};
}

// n / d as a root of a polynomial of which nothing shows that it is rational: (d t - n) (t^2 + 1).
Algebraic_number disguised(const Integer& n, const Integer& d) {
  const Rational value(n, d);
  return {Polynomial{-n, d} * Polynomial{1, 0, 1}, Rational(value - 1), Rational(value + 1)};
}

TEST(Rounded_quotient, at_a_rational_number_is_that_of_the_values) {
  const Polynomial p{1, 2, 3};
  const Polynomial q{-7, 5};
  EXPECT_EQ(rounded_quotient(p, q, Rational(1, 3)), to_double(Rational(2) / Rational(-16, 3)));
  EXPECT_EQ(rounded_quotient(p, q, 2.0), 17.0 / 3.0);
}

TEST(Rounded_quotient, of_a_zero_is_zero_and_by_a_zero_is_refused) {
  EXPECT_EQ(rounded_quotient(Polynomial{-2, 0, 1}, Polynomial{1, 1}, square_root(2)), 0.0);
  EXPECT_EQ(rounded_quotient(Polynomial(), Polynomial{1}, square_root(2)), 0.0);
  EXPECT_PRECONDITION_ERROR(rounded_quotient(Polynomial{1}, Polynomial{-2, 0, 1}, square_root(2)),
                            "a quotient whose denominator vanishes");
}

// The square root of an integer is rounded correctly by IEEE 754.
TEST(Rounded_quotient, of_a_square_root_is_the_correctly_rounded_one) {
  for (const int radicand : {2, 3, 5, 6, 7, 10, 99, 123457}) {
    const Algebraic_number root = square_root(radicand);
    EXPECT_EQ(rounded_quotient(Polynomial{0, 1}, Polynomial{1}, root), std::sqrt(radicand));
    EXPECT_EQ(rounded_quotient(Polynomial{0, -1}, Polynomial{1}, root), -std::sqrt(radicand));
    EXPECT_EQ(rounded_quotient(Polynomial{0, -1}, Polynomial{-2}, root), std::sqrt(radicand) / 2);
    EXPECT_EQ(rounded_quotient(Polynomial{radicand}, Polynomial{0, 1}, root), std::sqrt(radicand));
  }
}

// A quotient that is exactly a binary64 number, or exactly between two, is on the border of every
// interval around it, however narrow.
TEST(Rounded_quotient, on_the_middle_of_two_numbers_goes_to_the_even_one) {
  const Integer unit = Integer(1) << 52;
  const Algebraic_number root = square_root(2);
  for (const int odd : {1, 3, 5, 7}) {
    // (1 + odd / 2^53), as (2^53 + odd) t^2 / (2^53 t^2) at the root of 2.
    const Integer halves = 2 * unit + odd;
    const double expected = to_double(Rational(halves, Integer(2 * unit)));
    EXPECT_EQ(rounded_quotient(Polynomial{0, 0, halves}, Polynomial{0, 0, Integer(2 * unit)}, root),
              expected);
    EXPECT_EQ(rounded_quotient(Polynomial{Integer(2 * halves)}, Polynomial{0, 0, Integer(2 * unit)},
                               root),
              expected);
    EXPECT_EQ(rounded_quotient(Polynomial{Integer(-2 * halves)},
                               Polynomial{0, 0, Integer(2 * unit)}, root),
              -expected);
  }
  EXPECT_EQ(rounded_quotient(Polynomial{6}, Polynomial{0, 0, 1}, root), 3.0);
}

// Just above or below the middle: 2^200 times nearer than the intervals begin with.
TEST(Rounded_quotient, near_the_middle_is_decided_exactly) {
  const Integer unit = Integer(1) << 53;
  const Integer large = Integer(1) << 260;
  const Algebraic_number root = square_root(2);
  for (const int side : {-1, 1}) {
    // ((2^53 + 1) 2^260 t^2 + side t) / (2^53 2^260 t^2)
    const Polynomial p{0, side, Integer((unit + 1) * large)};
    const Polynomial q{0, 0, Integer(unit * large)};
    EXPECT_EQ(rounded_quotient(p, q, root), side < 0 ? 1.0 : std::nextafter(1.0, 2.0));
    EXPECT_EQ(rounded_quotient(-p, q, root), side < 0 ? -1.0 : std::nextafter(-1.0, -2.0));
    EXPECT_EQ(rounded_quotient(p, -q, root), side < 0 ? -1.0 : std::nextafter(-1.0, -2.0));
  }
}

TEST(Rounded_quotient, beyond_the_largest_number_is_infinite) {
  const Algebraic_number root = square_root(2);
  const Integer bound = (Integer(1) << 1024) - (Integer(1) << 970);  // rounds up, to even
  const Integer small = Integer(1) << 20;
  const auto rounded = [&](const Integer& numerator) {
    return rounded_quotient(Polynomial{0, 0, numerator}, Polynomial{0, 0, 1}, root);
  };
  EXPECT_EQ(rounded(bound), infinity);
  EXPECT_EQ(rounded(-bound), -infinity);
  EXPECT_EQ(rounded(bound - small), std::numeric_limits<double>::max());
  EXPECT_EQ(rounded(small - bound), -std::numeric_limits<double>::max());
  EXPECT_EQ(rounded_quotient(Polynomial{1}, Polynomial{0, Integer(1) << 1080}, root), 0.0);
}

TEST(Rounded_quotient, does_not_depend_on_what_is_known_of_the_number) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> small(-50, 50);
  for (int i = 0; i < 300; ++i) {
    const Polynomial p{small(random), small(random), small(random), small(random)};
    const Polynomial q{small(random), small(random), small(random)};
    const int n = small(random);
    const int d = 1 + std::abs(small(random));
    const Rational value(n, d);
    if (value == 0 || q(value) == 0) continue;
    const double expected = to_double(p(value) / q(value));
    EXPECT_EQ(rounded_quotient(p, q, disguised(n, d)), expected);
    const Algebraic_number refined = disguised(n, d);
    refined.refine_to_bits(300);
    EXPECT_EQ(rounded_quotient(p, q, refined), expected);
  }
}

}  // namespace
}  // namespace kinetri::rounded_quotient_test
