// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate polynomials of discs at rational times against CGAL's static predicates on
// weighted points, and against the definitions.
#include <gtest/gtest.h>

#include <array>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/discs.h"
#include "support/on_failure.h"

namespace kinetri::disc_polynomials_test {
namespace {

using test::disc_at;
using test::Disc_source;
using test::radius_at;
using test::Static_disc;
using test::Static_point;
using test::weight_at;

template <class Disc>
class Disc_polynomials : public testing::Test {};
using Discs = testing::Types<Disc_motion_2, Polynomial_disc_motion_2>;
TYPED_TEST_SUITE(Disc_polynomials, Discs);

TYPED_TEST(Disc_polynomials, at_rational_times_have_the_signs_of_the_static_predicates) {
  using Point = Basic_moving_point_2<TypeParam>;
  constexpr unsigned seed = 20261122;
  SCOPED_TRACE(seed);
  Disc_source source(seed);
  const test::Static_kernel kernel;
  const auto power_side = kernel.power_side_of_oriented_power_circle_2_object();
  int zeros = 0;
  for (int flavor = 0; flavor < Disc_source::flavors; ++flavor) {
    for (int i = 0; i < test::cases(flavor == 1 ? 2000 : 500); ++i) {
      std::array<TypeParam, 4> m;
      std::array<Point, 4> p;
      std::array<Static_disc, 4> s;
      const Rational t = source.time(flavor);
      for (std::size_t k = 0; k < 4; ++k) {
        m[k] = source.next<TypeParam>(flavor);
        p[k] = Point(m[k]);
        s[k] = disc_at(m[k], t);
      }
      const test::On_failure trace([&] { return test::describe_discs(m) + "t = " + t.str(); });
      const Sign in_circle = in_circle_polynomial(p[0], p[1], p[2], p[3]).sign_at(t);
      ASSERT_EQ(in_circle, power_side(s[0], s[1], s[2], s[3]));
      if (in_circle == CGAL::ZERO) ++zeros;
      ASSERT_EQ(orientation_polynomial(p[0], p[1], p[2]).sign_at(t),
                CGAL::orientation(s[0].point(), s[1].point(), s[2].point()));
      ASSERT_EQ(distance_difference(p[0], p[1], p[2]).sign_at(t),
                CGAL::compare_distance_to_point(s[0].point(), s[1].point(), s[2].point()));
      ASSERT_EQ(power_distance_difference(p[0], p[1], p[2]).sign_at(t),
                kernel.compare_power_distance_2_object()(s[0].point(), s[1], s[2]));
      ASSERT_EQ(weight_difference(p[0], p[1]).sign_at(t),
                CGAL::compare(s[0].weight(), s[1].weight()));
      const Rational reach = to_rational(0.75) + radius_at(m[0], t) + radius_at(m[1], t);
      ASSERT_EQ(contact_polynomial(p[0], p[1], 0.75).sign_at(t),
                CGAL::compare(CGAL::squared_distance(s[0].point(), s[1].point()), reach * reach));
      for (const auto side :
           {Wall_2::Side::left, Wall_2::Side::right, Wall_2::Side::bottom, Wall_2::Side::top}) {
        for (const bool rim : {false, true}) {
          const Wall_2 wall = {side, 0.5, 0.25, rim};
          const Rational place = wall.is_vertical() ? s[0].x() : s[0].y();
          const Rational distance = wall.is_upper() ? Rational(to_rational(0.5) - place)
                                                    : Rational(place - to_rational(0.5));
          const Rational kept = to_rational(0.25) + (rim ? radius_at(m[0], t) : Rational(0));
          ASSERT_EQ(wall_polynomial(p[0], wall).sign_at(t), CGAL::compare(distance, kept));
        }
      }
    }
  }
  EXPECT_GT(zeros, 3) << "the degenerate flavor is not degenerate";
}

TYPED_TEST(Disc_polynomials, of_collinear_discs_have_the_signs_of_the_static_predicate) {
  using Point = Basic_moving_point_2<TypeParam>;
  constexpr unsigned seed = 3;
  SCOPED_TRACE(seed);
  Disc_source source(seed);
  const auto power_side = test::Static_kernel().power_side_of_oriented_power_circle_2_object();
  std::array<int, 3> signs = {};
  for (int i = 0; i < test::cases(3000); ++i) {
    const int flavor = i % 2 == 0 ? 1 : i % Disc_source::flavors;
    std::array<TypeParam, 3> m;
    std::array<Point, 3> p;
    std::array<Static_disc, 3> s;
    const Rational t = source.time(flavor);
    for (std::size_t k = 0; k < 3; ++k) {
      m[k] = source.next<TypeParam>(flavor);
      // On a vertical line, or on another one.
      const auto on_line = [&](Vector_2& v) {
        if (i % 3 == 0)
          v.x = 0;
        else
          v.y = 2 * v.x;
      };
      on_line(m[k].position);
      on_line(m[k].velocity);
      if constexpr (requires { m[k].jerk; }) {
        on_line(m[k].acceleration);
        on_line(m[k].jerk);
      }
      p[k] = Point(m[k]);
      s[k] = disc_at(m[k], t);
    }
    if (s[0].point() == s[2].point()) continue;
    const test::On_failure trace([&] { return test::describe_discs(m) + "t = " + t.str(); });
    const Sign sign = segment_polynomial(p[0], p[1], p[2]).sign_at(t);
    ASSERT_EQ(sign, power_side(s[0], s[2], s[1]));
    ++signs[static_cast<std::size_t>(sign + 1)];
  }
  EXPECT_GT(signs[0], 50);
  EXPECT_GT(signs[1], 0);
  EXPECT_GT(signs[2], 50);
}

TYPED_TEST(Disc_polynomials, of_weighted_circumcenters_have_the_signs_of_the_static_predicates) {
  using Point = Basic_moving_point_2<TypeParam>;
  constexpr unsigned seed = 8;
  SCOPED_TRACE(seed);
  Disc_source source(seed);
  const test::Static_kernel kernel;
  const auto power_side = kernel.power_side_of_oriented_power_circle_2_object();
  for (int i = 0; i < 60; ++i) {
    const int flavor = i % 2 == 0 ? 0 : 4;
    std::array<TypeParam, 5> m;
    std::array<Point, 5> p;
    std::array<Static_disc, 5> s;
    const Rational t = source.time(flavor);
    for (std::size_t k = 0; k < 5; ++k) {
      m[k] = source.next<TypeParam>(flavor);
      p[k] = Point(m[k]);
      s[k] = disc_at(m[k], t);
    }
    const Point center(weighted_circumcenter_trajectory(p[0], p[1], p[2]));
    const Static_point expected =
        kernel.construct_weighted_circumcenter_2_object()(s[0], s[1], s[2]);
    ASSERT_EQ(center.position(t).x, expected.x());
    ASSERT_EQ(center.position(t).y, expected.y());
    EXPECT_EQ(power_distance_difference(center, p[0], p[2]).sign_at(t), CGAL::EQUAL);
    ASSERT_EQ(power_distance_difference(center, p[0], p[3]).sign_at(t),
              kernel.compare_power_distance_2_object()(expected, s[0], s[3]));
    ASSERT_EQ(
        power_distance_difference(p[3], center, p[4]).sign_at(t),
        kernel.compare_power_distance_2_object()(s[3].point(), Static_disc(expected, 0), s[4]));
    ASSERT_EQ(in_circle_polynomial(p[3], center, p[4], p[1]).sign_at(t),
              power_side(s[3], Static_disc(expected, 0), s[4], s[1]));
    ASSERT_EQ(weight_difference(p[3], center).sign_at(t), CGAL::sign(s[3].weight()));
    const Point bare(circumcenter_trajectory(p[0], p[1], p[2]));
    const Static_point bare_expected = CGAL::circumcenter(s[0].point(), s[1].point(), s[2].point());
    ASSERT_EQ(bare.position(t).x, bare_expected.x());
    ASSERT_EQ(bare.position(t).y, bare_expected.y());
  }
}

TEST(Disc_polynomials, of_equal_radii_are_those_of_points) {
  Disc_source source(4);
  std::array<Disc_motion_2, 4> m;
  std::array<Moving_disc_2, 4> p;
  std::array<Moving_point_2, 4> q;
  for (std::size_t k = 0; k < 4; ++k) {
    m[k] = source.next<Disc_motion_2>(5);
    p[k] = Moving_disc_2(m[k]);
    q[k] = Moving_point_2(center(m[k]));
  }
  EXPECT_EQ(primitive_part(in_circle_polynomial(p[0], p[1], p[2], p[3])),
            primitive_part(in_circle_polynomial(q[0], q[1], q[2], q[3])));
  EXPECT_EQ(primitive_part(contact_polynomial(p[0], p[1], 0)),
            primitive_part(contact_polynomial(q[0], q[1], 2 * m[0].radius)));
}

TEST(Disc_polynomials, of_growing_discs_on_straight_lines_have_the_degrees_of_points) {
  Disc_source source(6);
  std::array<Moving_disc_2, 4> p;
  for (Moving_disc_2& point : p) {
    Disc_motion_2 disc = source.next<Disc_motion_2>(0);
    disc.growth = disc.velocity.x / 3;
    point = Moving_disc_2(disc);
  }
  EXPECT_EQ(in_circle_polynomial(p[0], p[1], p[2], p[3]).degree(), 4);
  EXPECT_EQ(contact_polynomial(p[0], p[1], 0).degree(), 2);
  EXPECT_EQ(weight_difference(p[0], p[1]).degree(), 2);
}

}  // namespace
}  // namespace kinetri::disc_polynomials_test
