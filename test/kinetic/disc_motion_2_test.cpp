// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/disc_motion_2.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/discs.h"

namespace kinetri::disc_motion_2_test {
namespace {

using test::Disc_source;
using test::place_at;
using test::radius_at;
using test::weight_at;

Disc_motion_2 disc(const Linear_motion_2& motion, double radius, double growth = 0,
                   double weight = 0) {
  return {motion, radius, growth, weight};
}

template <class Disc>
class Disc_motions : public testing::Test {};
using Discs = testing::Types<Disc_motion_2, Polynomial_disc_motion_2>;
TYPED_TEST_SUITE(Disc_motions, Discs);

TYPED_TEST(Disc_motions, are_finite_where_all_numbers_are) {
  const double infinity = std::numeric_limits<double>::infinity();
  const TypeParam finite = {};
  EXPECT_TRUE(is_finite(finite));
  for (double TypeParam::*number : {&TypeParam::radius, &TypeParam::growth, &TypeParam::weight}) {
    TypeParam m = finite;
    m.*number = -infinity;
    EXPECT_FALSE(is_finite(m));
    m.*number = std::nan("");
    EXPECT_FALSE(is_finite(m));
  }
  TypeParam m = finite;
  m.velocity.y = infinity;
  EXPECT_FALSE(is_finite(m));
}

TEST(Disc_motion, has_the_trajectory_of_another_one_with_an_epoch_of_its_own) {
  const Disc_motion_2 a = disc({{1, 2}, {3, -1}, 0}, 0.5, 0.25);
  const Disc_motion_2 b = disc({{7, 0}, {3, -1}, 2}, 1, 0.25);
  EXPECT_TRUE(same_trajectory(a, b));
  EXPECT_TRUE(same_trajectory(polynomial_motion(a), polynomial_motion(b)));
  EXPECT_FALSE(same_trajectory(a, disc({{7, 0}, {3, -1}, 2}, 1.5, 0.25)));
  EXPECT_FALSE(same_trajectory(a, disc({{7, 0}, {3, -1}, 2}, 1, -0.25)));
  EXPECT_FALSE(same_trajectory(a, disc({{7, 0}, {3, -1}, 2}, 1, 0.25, 0x1p-1074)));
  EXPECT_FALSE(same_trajectory(a, disc({{7, 0.5}, {3, -1}, 2}, 1, 0.25)));
  // The weight 4 as that of a disc and as a number.
  EXPECT_TRUE(same_trajectory(disc({{1, 2}, {3, -1}, 0}, 2), disc({{1, 2}, {3, -1}, 0}, 0, 0, 4)));
}

TYPED_TEST(Disc_motions, are_rounded_within_the_bounds) {
  Disc_source source(12);
  for (int i = 0; i < test::cases(3000); ++i) {
    const int flavor = i % Disc_source::flavors;
    const auto m = source.next<TypeParam>(flavor);
    const double t = to_double(source.time(flavor));
    const Double_interval times = {t, t + (i % 2 == 0 ? 0 : std::ldexp(1 + std::abs(t), -i % 50))};
    const double error = weight_error(m, t, times);
    ASSERT_TRUE(error >= 0);
    for (const double time :
         {times.lower, times.upper, times.lower + (times.upper - times.lower) / 2}) {
      const Rational off = weight_at(m, to_rational(time)) - to_rational(rounded_weight(m, t));
      ASSERT_LE(abs(off), to_rational(error)) << test::describe_discs(std::array{m}) << t;
    }
  }
  EXPECT_FALSE(std::isfinite(weight_error(disc({}, 1e200), 0, {0, 0})));
}

// Two discs that touch at a time of which t is the nearest binary64 number.
TYPED_TEST(Disc_motions, that_grow_and_touch_do_not_overlap_after_they_have_been_continued) {
  Disc_source source(99);
  int count = 0;
  for (int i = 0; i < test::cases(3000); ++i) {
    auto p = source.next<TypeParam>(0);
    auto q = source.next<TypeParam>(0);
    p.weight = q.weight = 0;
    p.growth = std::abs(p.velocity.x) / 4 + 0x1p-30;
    q.growth = std::abs(q.velocity.y) / 4 + 0x1p-30;
    const double t = to_double(source.time(3));
    const double h = 0.5 * (std::nextafter(std::abs(t), 1e300) - std::abs(t));
    const auto new_p = with_velocity_at(p, {q.velocity.x, 3}, t);
    const auto new_q = with_velocity_at(q, {-1, p.velocity.y}, t);
    ASSERT_EQ(new_p.epoch, t);
    ASSERT_EQ(new_p.growth, p.growth);
    const auto rest_p = at_rest_at(p, t);
    ASSERT_TRUE(is_at_rest(rest_p));
    if (new_p.radius == 0 || new_q.radius == 0) continue;  // as small as the rounding
    ++count;
    // Not much is lost.
    const double size = 1 + std::abs(new_p.position.x) + std::abs(new_p.position.y) +
                        std::abs(p.radius) +
                        40 * (1 + std::abs(t)) * (1 + std::abs(t) * (1 + std::abs(t)));
    ASSERT_LT(abs(radius_at(p, to_rational(t)) - to_rational(new_p.radius)),
              to_rational(0x1p-44 * size));
    for (const int side : {-1, 0, 1}) {
      const Rational s = to_rational(t) + side * to_rational(h);
      // The new disc is in the old one: |center - new center| <= radius - new radius.
      const auto expect_inside = [&](const auto& inner, const auto& outer) {
        const Rational room = radius_at(outer, s) - radius_at(inner, s);
        ASSERT_GE(room, 0);
        ASSERT_LE(CGAL::squared_distance(place_at(center(inner), s), place_at(center(outer), s)),
                  room * room);
      };
      expect_inside(new_p, p);
      expect_inside(new_q, q);
      expect_inside(rest_p, p);
    }
  }
  EXPECT_GT(count, 1000);
}

TEST(Disc_motion, of_a_constant_radius_is_continued_with_that_radius) {
  const Disc_motion_2 m = disc({{0.1, 0.2}, {0.3, 0.7}, 0.9}, 0.1, 0, -0.3);
  const Disc_motion_2 later = with_velocity_at(m, {1, 2}, 7.3);
  EXPECT_EQ(later.radius, m.radius);
  EXPECT_EQ(later.weight, m.weight);
  EXPECT_EQ(center(later), with_velocity_at(center(m), {1, 2}, 7.3));
  EXPECT_EQ(at_rest_at(m, 7.3).radius, m.radius);
}

TEST(Disc_motion, that_shrinks_is_not_continued_with_a_negative_radius) {
  EXPECT_EQ(with_velocity_at(disc({}, 1, -1), {}, 1).radius, 0);
  EXPECT_EQ(with_velocity_at(disc({}, 1, -1), {}, 2).radius, 0);
}

TYPED_TEST(Disc_motions, are_clamped_to_the_inner_side_of_a_wall_for_rims) {
  Disc_source source(31);
  int moved = 0;
  for (int i = 0; i < test::cases(1000); ++i) {
    const auto m = source.next<TypeParam>(i % 2 == 0 ? 0 : 3);
    const double t = to_double(source.time(0));
    const Double_interval times = {t, i % 3 == 0 ? t : std::nextafter(t, 100.0)};
    const auto side = static_cast<Wall_2::Side>(i % 4);
    // Just at the rim, or far away.
    const auto there = rounded_place(m, t);
    const double r = rounded_radius(m, t);
    const double place =
        side == Wall_2::Side::left || side == Wall_2::Side::right ? there.x : there.y;
    const bool is_upper = side == Wall_2::Side::right || side == Wall_2::Side::top;
    Wall_2 wall = {side, is_upper ? place + r + 0.5 : place - r - 0.5, 0.5, true};
    if (i % 5 == 0) wall.position += is_upper ? 1 : -1;
    const auto result = clamped_inside(m, wall, times);
    EXPECT_EQ(result.radius, m.radius);
    EXPECT_EQ(result.velocity, m.velocity);
    const Basic_moving_point_2<TypeParam> p(result);
    const Polynomial inside = wall_polynomial(p, wall);
    for (const double time : {times.lower, times.upper}) {
      ASSERT_NE(inside.sign_at(to_rational(time)), CGAL::NEGATIVE);
    }
    if (result != m) {
      ++moved;
      // No more than needed, but for the rounding.
      const Basic_moving_point_2<TypeParam> before(m);
      const Polynomial was_inside = wall_polynomial(before, wall);
      constexpr bool is_linear = std::is_same_v<typename TypeParam::Center_motion, Linear_motion_2>;
      const bool was_outside = was_inside.sign_at(to_rational(times.lower)) == CGAL::NEGATIVE ||
                               was_inside.sign_at(to_rational(times.upper)) == CGAL::NEGATIVE;
      EXPECT_TRUE(was_outside || !is_linear);
      if (i % 2 == 0) {
        ASSERT_LT(std::hypot(result.position.x - m.position.x, result.position.y - m.position.y),
                  1e-6);
      }
    }
    // Without rims it is about the center.
    Wall_2 bare = wall;
    bare.rim_touches = false;
    const TypeParam about_center = clamped_inside(m, bare, times);
    ASSERT_EQ(center(about_center), clamped_inside(center(m), bare, times));
  }
  EXPECT_GT(moved, 100);
}

TYPED_TEST(Disc_motions, are_mirrored_in_time) {
  Disc_source source(5);
  for (int i = 0; i < 100; ++i) {
    const int flavor = i % Disc_source::flavors;
    const auto m = source.next<TypeParam>(flavor);
    const Rational t = source.time(flavor);
    EXPECT_EQ(place_at(center(mirrored(m)), t), place_at(center(m), -t));
    EXPECT_EQ(weight_at(mirrored(m), t), weight_at(m, -t));
    EXPECT_EQ(mirrored(mirrored(m)), m);
  }
}

TEST(Disc_motion, is_printed_with_radius_growth_and_weight) {
  std::ostringstream out;
  out << Moving_disc_2(disc({{1, 2}, {3, 4}, 5}, 6, 7, 8), 9);
  EXPECT_EQ(out.str(), "point 9 (1, 2) at time 5, velocity (3, 4), radius 6, growth 7, weight 8");
}

}  // namespace
}  // namespace kinetri::disc_motion_2_test
