// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversions between rationals and binary64, checked by exact comparison with the neighbors.
#include "kinetri/algebra/number_types.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/random_polynomials.h"

namespace kinetri::number_types_test {
namespace {

using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest_normal = std::numeric_limits<double>::min();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

double next_up(double x) {
  return std::nextafter(x, infinity);
}
double next_down(double x) {
  return std::nextafter(x, -infinity);
}

// A finite binary64 number with any exponent, subnormals included.
double random_double(Random& random) {
  for (;;) {
    const double x = std::bit_cast<double>(random.bits());
    if (std::isfinite(x)) return x;
  }
}

// Rationals with magnitudes from far below the smallest binary64 number to far above the largest.
Rational random_rational_of_any_size(Random& random) {
  const Rational x = random.rational(static_cast<unsigned>(random.integer(1, 200)));
  return scaled_by_power_of_two(x, random.integer(-1150, 1100));
}

TEST(Number_types, sign_is_that_of_the_number) {
  EXPECT_EQ(sign(Integer(-7)), CGAL::NEGATIVE);
  EXPECT_EQ(sign(Integer(0)), CGAL::ZERO);
  EXPECT_EQ(sign(Integer(3)), CGAL::POSITIVE);
  EXPECT_EQ(sign(Rational(-1, 1000)), CGAL::NEGATIVE);
  EXPECT_EQ(sign(Rational(0)), CGAL::ZERO);
  EXPECT_EQ(sign(Rational(1, 1000)), CGAL::POSITIVE);
}

TEST(Number_types, to_rational_of_known_numbers_is_exact) {
  EXPECT_EQ(to_rational(0.0), Rational(0));
  EXPECT_EQ(to_rational(-0.0), Rational(0));
  EXPECT_EQ(to_rational(-2.5), Rational(-5, 2));
  EXPECT_EQ(to_rational(0.1), Rational(Integer("3602879701896397"), Integer("36028797018963968")));
  EXPECT_EQ(to_rational(smallest), scaled_by_power_of_two(1, -1074));
  EXPECT_EQ(to_rational(smallest_normal), scaled_by_power_of_two(1, -1022));
  EXPECT_EQ(to_rational(largest), scaled_by_power_of_two(1, 1024) - scaled_by_power_of_two(1, 971));
}

TEST(Number_types, to_rational_of_infinity_or_nan_is_refused) {
  EXPECT_PRECONDITION_ERROR(to_rational(infinity), "only a finite number is a rational number");
  EXPECT_PRECONDITION_ERROR(to_rational(-infinity), "only a finite number is a rational number");
  EXPECT_PRECONDITION_ERROR(to_rational(std::numeric_limits<double>::quiet_NaN()),
                            "only a finite number is a rational number");
}

TEST(Number_types, every_binary64_number_survives_the_round_trip) {
  std::vector<double> numbers = {0.0,      1.0,       -1.0,
                                 smallest, -smallest, smallest_normal,
                                 largest,  -largest,  next_down(smallest_normal)};
  Random random(1);
  for (unsigned long i = 0; i < test::cases(20000ul); ++i) {
    numbers.push_back(random_double(random));
  }
  for (const double x : numbers) {
    const Rational exact = to_rational(x);
    ASSERT_EQ(to_double(exact), x);
    ASSERT_EQ(to_interval(exact), (Double_interval{x, x}));
  }
}

TEST(Number_types, to_interval_gives_the_neighbors_of_a_random_rational) {
  for (unsigned long seed = 0; seed < test::cases(20000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Rational x = random_rational_of_any_size(random);
    const Double_interval interval = to_interval(x);
    if (interval.lower == interval.upper) {
      ASSERT_EQ(to_rational(interval.lower), x);
      continue;
    }
    ASSERT_EQ(next_up(interval.lower), interval.upper);
    if (std::isfinite(interval.lower)) {
      ASSERT_LT(to_rational(interval.lower), x);
    }
    if (std::isfinite(interval.upper)) {
      ASSERT_GT(to_rational(interval.upper), x);
    }
  }
}

TEST(Number_types, to_interval_beyond_the_range_ends_at_infinity_or_at_the_smallest_number) {
  const Rational huge = scaled_by_power_of_two(1, 1024);
  EXPECT_EQ(to_interval(huge), (Double_interval{largest, infinity}));
  EXPECT_EQ(to_interval(-huge), (Double_interval{-infinity, -largest}));
  EXPECT_EQ(to_interval(huge * huge / 3), (Double_interval{largest, infinity}));
  EXPECT_EQ(to_interval(to_rational(largest) + Rational(1, 3)),
            (Double_interval{largest, infinity}));
  const Rational tiny = scaled_by_power_of_two(Rational(1, 3), -1074);
  EXPECT_EQ(to_interval(tiny), (Double_interval{0.0, smallest}));
  EXPECT_EQ(to_interval(-tiny), (Double_interval{-smallest, 0.0}));
  EXPECT_EQ(to_interval(scaled_by_power_of_two(1, -5000)), (Double_interval{0.0, smallest}));
}

TEST(Number_types, to_interval_has_no_negative_zero) {
  const Double_interval interval = to_interval(scaled_by_power_of_two(-1, -5000));
  EXPECT_EQ(interval.upper, 0.0);
  EXPECT_FALSE(std::signbit(interval.upper));
}

TEST(Number_types, to_double_of_a_random_rational_is_the_nearer_neighbor) {
  for (unsigned long seed = 0; seed < test::cases(20000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Rational x = random_rational_of_any_size(random);
    const Double_interval interval = to_interval(x);
    const double nearest = to_double(x);
    if (!std::isfinite(interval.lower) || !std::isfinite(interval.upper)) {
      if (abs(x) >= scaled_by_power_of_two(1, 1024)) {
        ASSERT_TRUE(std::isinf(nearest));
      }
      continue;
    }
    const Rational to_lower = x - to_rational(interval.lower);
    const Rational to_upper = to_rational(interval.upper) - x;
    if (to_lower < to_upper) {
      ASSERT_EQ(nearest, interval.lower);
    }
    if (to_lower > to_upper) {
      ASSERT_EQ(nearest, interval.upper);
    }
  }
}

TEST(Number_types, to_double_of_a_tie_is_the_even_neighbor) {
  Random random(3);
  for (unsigned long i = 0; i < test::cases(20000ul); ++i) {
    // All of the range, with as many subnormals as others.
    const double x = i % 2 == 0 ? random_double(random)
                                : std::bit_cast<double>(random.bits() & ((1ULL << 53) - 1));
    const double y = next_up(x);
    if (!std::isfinite(y)) continue;
    const bool x_is_even = (std::bit_cast<std::uint64_t>(x) & 1) == 0;
    const Rational tie = (to_rational(x) + to_rational(y)) / 2;
    ASSERT_EQ(to_double(tie), x_is_even ? x : y) << x;
    const Rational a_little = scaled_by_power_of_two(1, -1200);
    ASSERT_EQ(to_double(tie - a_little), x);
    ASSERT_EQ(to_double(tie + a_little), y);
    ASSERT_EQ(to_double(-tie), x_is_even ? -x : -y) << x;
  }
}

TEST(Number_types, to_double_near_overflow_follows_ieee754) {
  const Rational halfway = scaled_by_power_of_two(1, 1024) - scaled_by_power_of_two(1, 970);
  EXPECT_EQ(to_double(halfway), infinity);
  EXPECT_EQ(to_double(-halfway), -infinity);
  EXPECT_EQ(to_double(halfway - Rational(1, 1000)), largest);
  EXPECT_EQ(to_double(scaled_by_power_of_two(1, 1024)), infinity);
  EXPECT_EQ(to_double(scaled_by_power_of_two(-1, 5000)), -infinity);
}

TEST(Number_types, to_double_below_the_smallest_number_rounds_to_zero_or_to_it) {
  EXPECT_EQ(to_double(scaled_by_power_of_two(1, -1075)), 0.0);
  EXPECT_EQ(to_double(scaled_by_power_of_two(3, -1076)), smallest);
  EXPECT_EQ(to_double(scaled_by_power_of_two(3, -1075)), 2 * smallest);
  EXPECT_EQ(to_double(scaled_by_power_of_two(1, -9000)), 0.0);
}

TEST(Number_types, scaled_by_power_of_two_is_exact_both_ways) {
  EXPECT_EQ(scaled_by_power_of_two(Rational(3, 8), 5), Rational(12));
  EXPECT_EQ(scaled_by_power_of_two(Rational(12), -5), Rational(3, 8));
  EXPECT_EQ(scaled_by_power_of_two(Rational(-7, 3), 0), Rational(-7, 3));
  EXPECT_EQ(scaled_by_power_of_two(Rational(0), 100), Rational(0));
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Rational x = random.rational(100);
    const long exponent = random.integer(-300, 300);
    ASSERT_EQ(scaled_by_power_of_two(scaled_by_power_of_two(x, exponent), -exponent), x);
  }
}

}  // namespace
}  // namespace kinetri::number_types_test
