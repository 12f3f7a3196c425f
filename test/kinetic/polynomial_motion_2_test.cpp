// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/polynomial_motion_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "support/motions.h"

namespace kinetri::polynomial_motion_2_test {
namespace {

using Point = Basic_moving_point_2<Polynomial_motion_2>;

TEST(Polynomial_motion_2, is_exactly_where_it_says) {
  std::vector<Polynomial_motion_2> motions = test::random_polynomial_motions(20, 10, 3, 7);
  motions.push_back({{0.1, -0.3}, {1e-200, 1e200}, {1e-300, 7}, {0.1, 1e100}, 1e10});
  motions.push_back({{5e-324, 1e308}, {0, -0.0}, {5e-324, 0}, {0, 5e-324}, -3});
  motions.push_back({});
  for (const Polynomial_motion_2& m : motions) {
    for (const Rational& t : {Rational(0), Rational(-7, 3), to_rational(1e30)}) {
      const Exact_position_2 place = Point(m).position(t);
      const test::Static_point expected = test::place_at(m, t);
      EXPECT_EQ(place.x, expected.x());
      EXPECT_EQ(place.y, expected.y());
    }
  }
}

TEST(Polynomial_motion_2, with_another_epoch_is_the_same_trajectory_only_exactly) {
  const Polynomial_motion_2 m{{1, 2}, {3, -1}, {2, 4}, {6, 0}, 0};
  // At 2: x = 1 + 6 + 4 + 8, y = 2 - 2 + 8; and the derivatives.
  const Polynomial_motion_2 later{{19, 8}, {19, 7}, {14, 4}, {6, 0}, 2};
  EXPECT_TRUE(same_trajectory(m, later));
  Polynomial_motion_2 other = later;
  other.epoch = 2.0000000000000004;
  EXPECT_FALSE(same_trajectory(m, other));
  other = later;
  other.acceleration.y = std::nextafter(4, 5);
  EXPECT_FALSE(same_trajectory(m, other));
  other = later;
  other.jerk.y = 5e-324;
  EXPECT_FALSE(same_trajectory(m, other));
  EXPECT_TRUE(same_trajectory(polynomial_motion({{1, 2}, {0.5, -0.25}, 0}),
                              polynomial_motion({{3, 1}, {0.5, -0.25}, 4})));
}

TEST(Polynomial_motion_2, with_a_number_that_is_not_finite_is_not_finite) {
  const double inf = std::numeric_limits<double>::infinity();
  Polynomial_motion_2 m{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9};
  EXPECT_TRUE(is_finite(m));
  for (double* number : {&m.position.x, &m.position.y, &m.velocity.x, &m.velocity.y,
                         &m.acceleration.x, &m.acceleration.y, &m.jerk.x, &m.jerk.y, &m.epoch}) {
    const double before = std::exchange(*number, -inf);
    EXPECT_FALSE(is_finite(m));
    *number = before;
  }
}

TEST(Polynomial_motion_2, turns_at_its_place_rounded_to_nearest_and_keeps_its_higher_derivatives) {
  for (const Polynomial_motion_2& m : test::random_polynomial_motions(300, 10, 3, 8)) {
    const double t = m.position.x - 5;
    const Polynomial_motion_2 result = with_velocity_at(m, {-1, 2}, t);
    const test::Static_point place = test::place_at(m, to_rational(t));
    EXPECT_EQ(result.position, (Vector_2{to_double(place.x()), to_double(place.y())}));
    EXPECT_EQ(result.velocity, (Vector_2{-1, 2}));
    const Rational elapsed = to_rational(t) - to_rational(m.epoch);
    EXPECT_EQ(result.acceleration.x,
              to_double(to_rational(m.acceleration.x) + to_rational(m.jerk.x) * elapsed));
    EXPECT_EQ(result.acceleration.y,
              to_double(to_rational(m.acceleration.y) + to_rational(m.jerk.y) * elapsed));
    EXPECT_EQ(result.jerk, m.jerk);
    EXPECT_EQ(result.epoch, t);
  }
}

TEST(Polynomial_motion_2, is_kept_inside_of_a_wall) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> small(-4, 4);
  int changed = 0;
  for (int i = 0; i < test::cases(5000); ++i) {
    const double unit = i % 2 == 0 ? 1 : 0x1p-52;
    const auto tenths = [&] { return Vector_2{0.1 * small(random), 0.3 * small(random)}; };
    Polynomial_motion_2 m;
    m.position = {3 + small(random) * unit, -2 + small(random) * unit};
    m.velocity = tenths();
    m.acceleration = tenths();
    m.jerk = tenths();
    m.epoch = 1 + small(random) * unit;
    const auto side = static_cast<Wall_2::Side>(i % 4);
    const Wall_2 wall = {side, side < Wall_2::Side::bottom ? 3.0 : -2.0, i % 3 == 0 ? 0.1 : 0};
    const Double_interval times = {1, i % 5 == 0 ? 1.5 : 1 + 0x1p-52};
    const auto is_inside = [&](const Polynomial_motion_2& motion, double t) {
      return wall_polynomial(Point(motion), wall).sign_at(to_rational(t)) != CGAL::NEGATIVE;
    };
    const Polynomial_motion_2 kept = clamped_inside(m, wall, times);
    for (int k = 0; k <= 16; ++k) {
      const double t = times.lower + (times.upper - times.lower) * k / 16;
      ASSERT_TRUE(is_inside(kept, t));
    }
    ASSERT_EQ(kept.velocity, m.velocity);
    ASSERT_EQ(kept.acceleration, m.acceleration);
    ASSERT_EQ(kept.jerk, m.jerk);
    ASSERT_EQ(kept.epoch, m.epoch);
    if (kept == m) continue;
    ++changed;
    // Only the coordinate of the wall, inward; and where the time is hardly an interval, not where
    // the point is inside by far.
    const double moved =
        wall.is_vertical() ? kept.position.x - m.position.x : kept.position.y - m.position.y;
    ASSERT_GT(wall.is_upper() ? -moved : moved, 0);
    if (times.upper < 1.5) {
      Polynomial_motion_2 farther = m;
      (wall.is_vertical() ? farther.position.x : farther.position.y) +=
          wall.is_upper() ? 0x1p-40 : -0x1p-40;
      ASSERT_FALSE(is_inside(farther, times.lower) && is_inside(farther, times.upper));
    }
  }
  EXPECT_GT(changed, 1000);
}

TEST(Polynomial_motion_2, mirrored_is_where_it_was) {
  for (const Polynomial_motion_2& m : test::random_polynomial_motions(20, 10, 3, 9)) {
    const Rational t(7, 3);
    EXPECT_EQ(test::place_at(mirrored(m), t), test::place_at(m, -t));
    EXPECT_EQ(mirrored(mirrored(m)), m);
  }
  const Linear_motion_2 line{{1, 2}, {3, -4}, 5};
  EXPECT_EQ(test::place_at(mirrored(line), Rational(1, 3)), test::place_at(line, Rational(-1, 3)));
}

}  // namespace
}  // namespace kinetri::polynomial_motion_2_test
