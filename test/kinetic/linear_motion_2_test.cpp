// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_motion_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "support/certificates.h"
#include "support/motions.h"

namespace kinetri::linear_motion_2_test {
namespace {

TEST(Linear_motion_2, with_another_epoch_is_the_same_trajectory_only_exactly) {
  const Linear_motion_2 m{{1, 2}, {0.5, -0.25}, 0};
  EXPECT_TRUE(same_trajectory(m, {{3, 1}, {0.5, -0.25}, 4}));
  EXPECT_FALSE(same_trajectory(m, {{3, 1}, {0.5, -0.25}, 4.000000000000001}));
  EXPECT_FALSE(same_trajectory(m, {{1, 2}, {0.5, 0.25}, 0}));
  // 0.1 * 3 is not 0.3 in binary64, and 3 * fl(0.1) is not fl(0.3) exactly either.
  EXPECT_FALSE(same_trajectory(Linear_motion_2{{0, 0}, {0.1, 0}, 0}, {{0.3, 0}, {0.1, 0}, 3}));
  EXPECT_TRUE(same_trajectory(Linear_motion_2{{0.0, 1}, {1, 1}, 0}, {{-0.0, 1}, {1, 1}, 0}));
}

TEST(Linear_motion_2, with_a_number_that_is_not_finite_is_not_finite) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_finite(Linear_motion_2{{1, 2}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite(Linear_motion_2{{inf, 2}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite(Linear_motion_2{{1, nan}, {3, 4}, 5}));
  EXPECT_FALSE(is_finite(Linear_motion_2{{1, 2}, {-inf, 4}, 5}));
  EXPECT_FALSE(is_finite(Linear_motion_2{{1, 2}, {3, nan}, 5}));
  EXPECT_FALSE(is_finite(Linear_motion_2{{1, 2}, {3, 4}, inf}));
}

TEST(Linear_motion_2, turns_at_its_place_rounded_to_nearest) {
  for (int flavor = 0; flavor < test::Certificates::flavors; ++flavor) {
    SCOPED_TRACE(test::Certificates::name(flavor));
    test::Certificates source(31);
    for (int i = 0; i < test::cases(2000); ++i) {
      const Linear_motion_2 m = source.next(flavor)[0];
      const double t = source.time(flavor);
      const Linear_motion_2 result = with_velocity_at(m, {-1, 2}, t);
      const test::Static_point place = test::place_at(m, to_rational(t));
      ASSERT_EQ(result.position, (Vector_2{to_double(place.x()), to_double(place.y())}));
      ASSERT_EQ(result.velocity, (Vector_2{-1, 2}));
      ASSERT_EQ(result.epoch, t);
    }
  }
  // Halfway between two binary64 numbers, and next to that.
  EXPECT_EQ(with_velocity_at(Linear_motion_2{{1, 0}, {0x1p-53, 0}, 0}, {}, 1).position.x, 1);
  EXPECT_EQ(with_velocity_at(Linear_motion_2{{1, 0}, {0x1p-53, 0}, 0}, {}, 1 + 0x1p-52).position.x,
            1 + 0x1p-52);
  EXPECT_EQ(with_velocity_at(Linear_motion_2{{1 + 0x1p-52, 0}, {0x1p-53, 0}, 0}, {}, 1).position.x,
            1 + 0x1p-51);
}

TEST(Linear_motion_2, is_kept_inside_of_a_wall_by_the_least_change) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> small(-4, 4);
  int changed = 0;
  for (int i = 0; i < test::cases(20000); ++i) {
    const double unit = i % 2 == 0 ? 1 : 0x1p-52;
    const Linear_motion_2 m = {{3 + small(random) * unit, -2 + small(random) * unit},
                               {0.1 * small(random), 0.3 * small(random)},
                               1 + small(random) * unit};
    const auto side = static_cast<Wall_2::Side>(i % 4);
    const Wall_2 wall = {side, side < Wall_2::Side::bottom ? 3.0 : -2.0, i % 3 == 0 ? 0.1 : 0};
    const Double_interval times = {1, 1 + 0x1p-52};
    const auto is_inside = [&](const Linear_motion_2& motion) {
      const Polynomial inside = wall_polynomial(Moving_point_2(motion), wall);
      return inside.sign_at(to_rational(times.lower)) != CGAL::NEGATIVE &&
             inside.sign_at(to_rational(times.upper)) != CGAL::NEGATIVE;
    };
    const Linear_motion_2 kept = clamped_inside(m, wall, times);
    ASSERT_TRUE(is_inside(kept));
    ASSERT_EQ(kept.velocity, m.velocity);
    ASSERT_EQ(kept.epoch, m.epoch);
    if (is_inside(m)) {
      ASSERT_EQ(kept, m);
      continue;
    }
    ++changed;
    Linear_motion_2 less = kept;
    double& place = wall.is_vertical() ? less.position.x : less.position.y;
    place = std::nextafter(place, wall.is_upper() ? 100 : -100);
    ASSERT_FALSE(is_inside(less));
  }
  EXPECT_GT(changed, 1000);
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
}  // namespace kinetri::linear_motion_2_test
