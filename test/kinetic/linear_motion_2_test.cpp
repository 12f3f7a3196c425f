// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_motion_2.h"

#include <gtest/gtest.h>

#include <limits>

#include "kinetri/kinetic/moving_point_2.h"
#include "support/motions.h"

namespace kinetri {
namespace {

TEST(Linear_motion_2, with_another_epoch_is_the_same_trajectory_only_exactly) {
  const Linear_motion_2 m{{1, 2}, {0.5, -0.25}, 0};
  EXPECT_TRUE(same_trajectory(m, {{3, 1}, {0.5, -0.25}, 4}));
  EXPECT_FALSE(same_trajectory(m, {{3, 1}, {0.5, -0.25}, 4.000000000000001}));
  EXPECT_FALSE(same_trajectory(m, {{1, 2}, {0.5, 0.25}, 0}));
  // 0.1 * 3 is not 0.3 in binary64, and 3 * fl(0.1) is not fl(0.3) exactly either.
  EXPECT_FALSE(same_trajectory({{0, 0}, {0.1, 0}, 0}, {{0.3, 0}, {0.1, 0}, 3}));
  EXPECT_TRUE(same_trajectory({{0.0, 1}, {1, 1}, 0}, {{-0.0, 1}, {1, 1}, 0}));
}

TEST(Linear_motion_2, with_a_number_that_is_not_finite_is_not_finite) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_finite({{1, 2}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite({{inf, 2}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite({{1, nan}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite({{1, 2}, {-inf, 4}, 5}));
  EXPECT_FALSE(is_finite({{1, 2}, {3, nan}, 5}));
  EXPECT_FALSE(is_finite({{1, 2}, {3, 4}, inf}));
}

TEST(Moving_point_2, is_exactly_where_its_motion_says) {
  const std::vector<Linear_motion_2> motions = {
      {{0.1, -0.3}, {1e-200, 1e200}, 1e10}, {{5e-324, 1e308}, {0, -0.0}, -3}, {{0, 0}, {0, 0}, 0}};
  for (const Linear_motion_2& m : motions) {
    for (const Rational& t : {Rational(0), Rational(-7, 3), to_rational(1e300)}) {
      const Exact_position_2 place = Moving_point_2(m).position(t);
      const test::Static_point expected = test::place_at(m, t);
      EXPECT_EQ(place.x, expected.x());
      EXPECT_EQ(place.y, expected.y());
    }
  }
}

}  // namespace
}  // namespace kinetri
