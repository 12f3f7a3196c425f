// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ball arithmetic against exact arithmetic: each result contains the exact one, is exact where
// nothing is rounded, and is rounded correctly where it says so.
#include "triangulation/ball.h"

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/motions.h"

namespace kinetri::ball_test {
namespace {

using detail::Ball;

Rational midpoint(const Ball& b) {
  return to_rational(b.high) + to_rational(b.low);
}

bool contains(const Ball& b, const Rational& x) {
  if (!std::isfinite(b.high) || !std::isfinite(b.low) || !std::isfinite(b.radius)) return true;
  const Rational off = x - midpoint(b);
  // The factor is for the rounding of radii.
  return CGAL::abs(off) <= to_rational(b.radius) * to_rational(1 + 0x1p-15);
}

// A ball, and a number in it.
struct Known {
  Ball ball;
  Rational value;
};

class Balls : public testing::Test {
 protected:
  // Exponents of all sizes in some seeds, few in others, so that sums cancel.
  Known any() {
    const double high = number();
    const int choice = static_cast<int>(random() % 4);
    if (choice == 0) return {Ball(high), to_rational(high)};
    const double low = high * std::ldexp(unit(random), -54);
    if (choice == 1) return {{high, low, 0}, to_rational(high) + to_rational(low)};
    const double radius =
        std::abs(high) * std::ldexp(1 + unit(random) / 2, choice == 2 ? -104 : -40);
    return {{high, low, radius},
            to_rational(high) + to_rational(low) + to_rational(radius) * to_rational(unit(random))};
  }

  double number() {
    const int exponents = seed % 4 == 0 ? 600 : seed % 4 == 1 ? 60 : 2;
    std::uniform_int_distribution<int> exponent(-exponents, exponents);
    const double x = seed % 4 == 3 ? std::nearbyint(8 * unit(random)) : unit(random);
    return std::ldexp(x, seed % 4 == 3 ? 0 : exponent(random));
  }

  unsigned seed = 0;
  std::mt19937_64 random;
  std::uniform_real_distribution<double> unit{-1, 1};
};

TEST_F(Balls, contain_the_exact_results_of_operations) {
  int tight = 0;
  for (seed = 0; seed < test::cases(400u); ++seed) {
    SCOPED_TRACE(seed);
    random.seed(seed);
    for (int i = 0; i < 50; ++i) {
      const Known a = any();
      const Known b = any();
      ASSERT_TRUE(contains(a.ball, a.value) && contains(b.ball, b.value));
      ASSERT_TRUE(contains(a.ball + b.ball, a.value + b.value));
      ASSERT_TRUE(contains(a.ball - b.ball, a.value - b.value));
      const Ball product = a.ball * b.ball;
      ASSERT_TRUE(contains(product, a.value * b.value));
      if (product.radius < 0x1p-98 * std::abs(product.high)) ++tight;
      ASSERT_TRUE(contains(twice(a.ball), 2 * a.value));
      if (b.value != 0) {
        ASSERT_TRUE(contains(a.ball / b.ball, a.value / b.value));
      }
      for (const Ball& r : {a.ball + b.ball, product, a.ball / b.ball}) {
        ASSERT_FALSE(std::abs(r.low) > 0x1p-53 * std::abs(r.high)) << r.high << ' ' << r.low;
      }
    }
  }
  EXPECT_GT(tight, 1000);
}

TEST_F(Balls, say_only_what_is_certain) {
  std::array<int, 4> certain = {};
  for (seed = 0; seed < test::cases(400u); ++seed) {
    SCOPED_TRACE(seed);
    random.seed(seed);
    for (int i = 0; i < 50; ++i) {
      Known a = any();
      if (i % 2 == 0) {
        const Known b = any();
        a = {a.ball - b.ball, a.value - b.value};
      }
      if (a.ball.is_positive()) {
        ++certain[0];
        ASSERT_GT(a.value, 0);
      }
      if (a.ball.is_nonzero()) {
        ++certain[1];
        ASSERT_NE(a.value, 0);
      }
      if (a.ball.is_zero()) {
        ++certain[2];
        ASSERT_EQ(a.value, 0);
      }
      if (const auto rounded = a.ball.rounded()) {
        ++certain[3];
        ASSERT_EQ(*rounded, to_double(a.value));
      }
    }
  }
  for (const int n : certain) EXPECT_GT(n, 100);
}

TEST(Ball, of_small_integers_is_exact) {
  const Ball a(3);
  const Ball b(-7);
  for (const Ball& r : {a + b + Ball(4), a * b + Ball(21), (a - b) - Ball(10)}) {
    EXPECT_TRUE(r.is_zero());
  }
  EXPECT_FALSE((Ball(0.1) * Ball(0.1) - Ball(0.1 * 0.1)).is_zero());
}

// A number that is all but in the middle of two binary64 numbers, and one in the middle.
TEST(Ball, near_the_middle_of_two_numbers_is_not_rounded) {
  EXPECT_EQ(Ball(1, 0x1p-53, 0x1p-120).rounded(), std::nullopt);
  EXPECT_EQ(Ball(1, 0x1p-53, 0).rounded(), 1.0);
  EXPECT_EQ(Ball(1, 0x1p-53 + 0x1p-100, 0x1p-104).rounded(), 1 + 0x1p-52);
  EXPECT_EQ(Ball(0, 0, 0x1p-300).rounded(), std::nullopt);
  EXPECT_FALSE(std::signbit(*Ball(-0.0).rounded()));
}

TEST(Ball, of_what_is_not_finite_says_nothing) {
  constexpr double huge = 1e300;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Ball& r : {Ball(huge) * Ball(huge), Ball(infinity) - Ball(infinity), Ball::unknown(),
                        Ball::unknown() * Ball(0), Ball(1) / Ball(0), Ball(1e308) + Ball(1e308)}) {
    EXPECT_FALSE(r.is_positive() || r.is_nonzero() || r.is_zero());
    EXPECT_EQ(r.rounded(), std::nullopt);
  }
}

TEST(Ball, of_a_time_contains_it) {
  for (const double t : {0.0, 0.1, -1e300}) {
    EXPECT_TRUE((detail::ball_of(Algebraic_number(t)) - Ball(t)).is_zero());
  }
  const Rational third(1, 3);
  const Rational near_one = 1 + Rational(Integer(1), Integer(1) << 2000);
  for (const Rational& t : {third, near_one}) {
    const Ball b = detail::ball_of(Algebraic_number(t));
    EXPECT_TRUE(contains(b, t));
    EXPECT_GT(b.radius, 0);
    EXPECT_LT(b.radius, 1e-30);
  }
  // The square root of 2: between the squares of the ends.
  const Algebraic_number root(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  const Ball b = detail::ball_of(root);
  const Rational reach = 2 * to_rational(b.radius);
  EXPECT_LT((midpoint(b) - reach) * (midpoint(b) - reach), 2);
  EXPECT_GT((midpoint(b) + reach) * (midpoint(b) + reach), 2);
  EXPECT_LT(b.radius, 1e-30);
  std::fesetround(FE_UPWARD);
  const Ball elsewhere = detail::ball_of(Algebraic_number(0.5));
  std::fesetround(FE_TONEAREST);
  EXPECT_FALSE(elsewhere.is_nonzero());
}

// Each coordinate of a motion: of both kinds, of any size, some of them zero.
TEST(Ball, of_a_place_contains_it) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto number = [&](int spread) {
    std::uniform_int_distribution<int> exponent(-spread / 2, spread / 2);
    return random() % 4 == 0 ? 0 : std::ldexp(unit(random), exponent(random));
  };
  for (int i = 0; i < test::cases(2000); ++i) {
    SCOPED_TRACE(i);
    const int spread = i % 2 == 0 ? 4 : 200;
    const auto vector = [&] { return Vector_2{number(spread), number(spread)}; };
    const double epoch = number(4);
    const Rational t = i % 3 == 0 ? Rational(to_rational(number(4)) / 3) : to_rational(number(4));
    const Ball time = detail::ball_of(Algebraic_number(t));
    const double rounded_time = to_double(t);
    const auto check = [&](const auto& motion) {
      const auto place = test::place_at(motion, t);
      const auto ball = detail::ball_place(motion, time);
      ASSERT_TRUE(contains(ball.x, place.x()) && contains(ball.y, place.y()));
      const auto near = detail::approximate_place(motion, rounded_time);
      const Rational error = to_rational(near.error);
      ASSERT_LE(CGAL::abs(place.x() - to_rational(near.place.x)), error);
      ASSERT_LE(CGAL::abs(place.y() - to_rational(near.place.y)), error);
    };
    const Linear_motion_2 linear = {vector(), vector(), epoch};
    ASSERT_NO_FATAL_FAILURE(check(linear));
    ASSERT_NO_FATAL_FAILURE(
        check(Polynomial_motion_2{vector(), vector(), vector(), vector(), epoch}));
    EXPECT_TRUE(std::isinf(detail::ball_place(0, time).x.radius));
  }
}

}  // namespace
}  // namespace kinetri::ball_test
