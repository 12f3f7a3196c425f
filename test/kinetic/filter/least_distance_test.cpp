// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rounded distances, and the rounded time at which a distance is least, against rational numbers.
#include "kinetic/filter/least_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "kinetri/algebra/number_types.h"
#include "support/certificates.h"
#include "support/filter_results.h"
#include "support/motions.h"
#include "support/multiplier.h"

namespace kinetri::least_distance_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Rational middle(double x, double limit) {
  return (to_rational(x) + to_rational(std::nextafter(x, limit))) / 2;
}

// Whether `x`, which is not negative, is the binary64 number nearest to the root; no tie.
bool is_root_rounded(double x, const Rational& square) {
  const Rational above = middle(x, infinity);
  if (!(square < above * above)) return false;
  const Rational below = middle(x, -infinity);
  return x == 0 || below * below < square;
}

struct Counts {
  int all = 0;
  int times = 0;
  int least_distances = 0;
  int distances = 0;
};

void expect_right(const Linear_motion_2& p, const Linear_motion_2& q, double time, int mode,
                  Counts& counts) {
  const auto difference = [&](double Vector_2::*axis, const Rational& t) -> Rational {
    const auto coordinate = [&](const Linear_motion_2& m) -> Rational {
      return to_rational(m.position.*axis) +
             to_rational(m.velocity.*axis) * (t - to_rational(m.epoch));
    };
    return coordinate(p) - coordinate(q);
  };
  const auto square_at = [&](const Rational& t) -> Rational {
    const Rational x = difference(&Vector_2::x, t);
    const Rational y = difference(&Vector_2::y, t);
    return x * x + y * y;
  };
  if (const auto distance = test::in_mode(mode, [&] { return rounded_distance_at(p, q, time); })) {
    ++counts.distances;
    EXPECT_PRED2(is_root_rounded, *distance, square_at(to_rational(time)));
  }
  const Rational vx = to_rational(p.velocity.x) - to_rational(q.velocity.x);
  const Rational vy = to_rational(p.velocity.y) - to_rational(q.velocity.y);
  const Rational squared_speed = vx * vx + vy * vy;
  const auto rounding = test::in_mode(mode, [&] { return rounded_time_of_least_distance(p, q); });
  const auto least = test::in_mode(mode, [&] { return rounded_least_distance(p, q); });
  ++counts.all;
  if (squared_speed == 0) {
    EXPECT_FALSE(rounding);
    EXPECT_FALSE(least);
    return;
  }
  const Rational at_zero = difference(&Vector_2::x, 0) * vx + difference(&Vector_2::y, 0) * vy;
  const Rational exact = -at_zero / squared_speed;
  if (rounding) {
    ++counts.times;
    EXPECT_LT(middle(rounding->nearest, -infinity), exact);
    EXPECT_LT(exact, middle(rounding->nearest, infinity));
    EXPECT_LT(to_rational(rounding->bounds.lower), exact);
    EXPECT_LT(exact, to_rational(rounding->bounds.upper));
    EXPECT_TRUE(rounding->bounds.lower == rounding->nearest ||
                rounding->bounds.lower == std::nextafter(rounding->nearest, -infinity));
    EXPECT_TRUE(rounding->bounds.upper == rounding->nearest ||
                rounding->bounds.upper == std::nextafter(rounding->nearest, infinity));
  }
  if (least) {
    ++counts.least_distances;
    EXPECT_PRED2(is_root_rounded, *least, square_at(exact));
  }
}

class Least_distance : public testing::TestWithParam<int> {};

TEST_P(Least_distance, is_rounded_as_exact_arithmetic_rounds_it) {
  test::Certificates source(95);
  Counts counts;
  for (int i = 0; i < test::cases(2000); ++i) {
    const auto m = source.next(GetParam());
    const double time = source.time(GetParam());
    SCOPED_TRACE(testing::Message() << "case " << i);
    expect_right(m[0], m[1], time, test::rounding_mode(i), counts);
    if (HasFailure()) return;
  }
  if (GetParam() != 0) return;
  // In the other modes of rounding nothing is certain.
  EXPECT_GE(4 * counts.times, counts.all * 98 / 100);
  EXPECT_GE(4 * counts.least_distances, counts.all * 98 / 100);
  EXPECT_GE(4 * counts.distances, counts.all * 98 / 100);
}

INSTANTIATE_TEST_SUITE_P(Flavors, Least_distance, testing::Range(0, test::Certificates::flavors),
                         test::flavor_name);

TEST(Least_distance, of_numbers_that_binary64_has_is_found) {
  const Linear_motion_2 at_rest;
  const Linear_motion_2 passing = {{-10, 3}, {1, 0}, 0};
  EXPECT_EQ(rounded_least_distance(at_rest, passing), 3);
  EXPECT_EQ(rounded_distance_at(at_rest, passing, 6), 5);
  const auto rounding = rounded_time_of_least_distance(at_rest, passing);
  ASSERT_TRUE(rounding);
  EXPECT_EQ(rounding->nearest, 10);
  EXPECT_LT(rounding->bounds.lower, 10);
  EXPECT_GT(rounding->bounds.upper, 10);
}

TEST(Least_distance, of_points_that_meet_or_keep_their_distance_is_not_certain) {
  const Linear_motion_2 at_rest;
  EXPECT_EQ(rounded_least_distance(at_rest, {{-2, 4}, {1, -2}, 0}), std::nullopt);
  EXPECT_EQ(rounded_distance_at(at_rest, {{-2, 4}, {1, -2}, 0}, 2), std::nullopt);
  EXPECT_EQ(rounded_least_distance(at_rest, {{-2, 4}, {0, 0}, 0}), std::nullopt);
  EXPECT_EQ(rounded_time_of_least_distance(at_rest, {{-2, 4}, {0, 0}, 0}), std::nullopt);
}

}  // namespace
}  // namespace kinetri::least_distance_test
