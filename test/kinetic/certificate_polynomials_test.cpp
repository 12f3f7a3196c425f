// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificate polynomials at rational times against CGAL's static predicates on the exact places.
#include "kinetri/kinetic/certificate_polynomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/motions.h"
#include "support/on_failure.h"
#include "support/precondition_error.h"

namespace kinetri::certificate_polynomials_test {
namespace {

using test::place_at;
using test::Static_point;

// Motions of every flavor that matters: ordinary, tiny integers (degenerate), wild magnitudes, and
// far-away epochs.
class Motion_source {
 public:
  explicit Motion_source(unsigned seed) : random_(seed) {}

  Linear_motion_2 next(int flavor) {
    switch (flavor) {
      case 0:
        return {{real(), real()}, {real(), real()}, 0};
      case 1:
        return {{small(), small()}, {small(), small()}, 0};
      case 2:
        return {{wild(), wild()}, {wild(), wild()}, wild()};
      default:
        return {{real(), real()}, {real(), real()}, 1e6 * real()};
    }
  }
  Rational time(int flavor) {
    if (flavor == 1) return Rational(integer_(random_), 2);
    return to_rational(real()) + Rational(integer_(random_), 3);
  }

 private:
  double real() { return real_(random_); }
  double small() { return integer_(random_); }
  double wild() { return std::ldexp(real_(random_), 60 * integer_(random_)); }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> real_{-10, 10};
  std::uniform_int_distribution<int> integer_{-3, 3};
};

constexpr int flavors = 4;
constexpr int cases_per_flavor = 2000;

TEST(Certificate_polynomials, at_rational_times_have_the_signs_of_the_static_predicates) {
  constexpr unsigned seed = 20261120;
  SCOPED_TRACE(seed);
  Motion_source source(seed);
  int zeros = 0;
  for (int flavor = 0; flavor < flavors; ++flavor) {
    for (int i = 0; i < test::cases(cases_per_flavor); ++i) {
      std::array<Linear_motion_2, 4> m;
      for (auto& motion : m) motion = source.next(flavor);
      const Rational t = source.time(flavor);
      const Moving_point_2 p(m[0]);
      const Moving_point_2 q(m[1]);
      const Moving_point_2 r(m[2]);
      const Moving_point_2 s(m[3]);
      const Static_point sp = place_at(m[0], t);
      const Static_point sq = place_at(m[1], t);
      const Static_point sr = place_at(m[2], t);
      const Static_point ss = place_at(m[3], t);
      const std::vector<Linear_motion_2> motions(m.begin(), m.end());
      const test::On_failure trace([&] { return test::describe(motions) + "t = " + t.str(); });

      ASSERT_EQ(x_difference(p, q).sign_at(t), CGAL::compare_x(sp, sq));
      ASSERT_EQ(y_difference(p, q).sign_at(t), CGAL::compare_y(sp, sq));
      ASSERT_EQ(orientation_polynomial(p, q, r).sign_at(t), CGAL::orientation(sp, sq, sr));
      ASSERT_EQ(distance_difference(p, q, r).sign_at(t),
                CGAL::compare_distance_to_point(sp, sq, sr));
      ASSERT_EQ(scalar_product_polynomial(p, q, r).sign_at(t), CGAL::sign((sp - sq) * (sr - sq)));
      const auto in_circle = in_circle_polynomial(p, q, r, s).sign_at(t);
      // CGAL's predicate is the sign of the same determinant, also for a right turn.
      ASSERT_EQ(in_circle, CGAL::side_of_oriented_circle(sp, sq, sr, ss));
      if (in_circle == CGAL::ZERO) ++zeros;
    }
  }
  EXPECT_GT(zeros, 50) << "the degenerate flavor is not degenerate";
}

TEST(Certificate_polynomials, of_linear_motion_have_the_degrees_of_the_literature) {
  Motion_source source(7);
  const Moving_point_2 p(source.next(0));
  const Moving_point_2 q(source.next(0));
  const Moving_point_2 r(source.next(0));
  const Moving_point_2 s(source.next(0));
  EXPECT_EQ(x_difference(p, q).degree(), 1);
  EXPECT_EQ(orientation_polynomial(p, q, r).degree(), 2);
  EXPECT_EQ(distance_difference(p, q, r).degree(), 2);
  EXPECT_EQ(in_circle_polynomial(p, q, r, s).degree(), 4);
}

TEST(Certificate_polynomials, in_circle_of_lattice_velocities_drops_its_degree) {
  // The coefficient of t^4 is the in-circle determinant of the velocities, which are cocircular
  // here.
  const Moving_point_2 p(Linear_motion_2{{0.5, 0.25}, {0, 0}, 0});
  const Moving_point_2 q(Linear_motion_2{{4, 1}, {1, 0}, 0});
  const Moving_point_2 r(Linear_motion_2{{5, 6}, {1, 1}, 0});
  const Moving_point_2 s(Linear_motion_2{{-1, 7}, {0, 1}, 0});
  EXPECT_EQ(in_circle_polynomial(p, q, r, s).degree(), 3);
}

TEST(Certificate_polynomials, of_a_rigid_translation_of_a_square_vanish_identically) {
  const Vector_2 v{0.1, -0.7};
  const Moving_point_2 p(Linear_motion_2{{0, 0}, v, 0});
  const Moving_point_2 q(Linear_motion_2{{1, 0}, v, 0});
  const Moving_point_2 r(Linear_motion_2{{1, 1}, v, 0});
  const Moving_point_2 s(Linear_motion_2{{0, 1}, v, 0});
  EXPECT_TRUE(in_circle_polynomial(p, q, r, s).is_zero());
  EXPECT_EQ(orientation_polynomial(p, q, r).degree(), 0);
}

TEST(Certificate_polynomials, of_points_that_stay_collinear_have_no_circumcenter) {
  const Vector_2 v = {1, 2};
  const Moving_point_2 p(Linear_motion_2{{0, 0}, v, 0});
  const Moving_point_2 q(Linear_motion_2{{1, 1}, v, 0});
  const Moving_point_2 r(Linear_motion_2{{3, 3}, v, 0});
  EXPECT_PRECONDITION_ERROR(circumcenter_trajectory(p, q, r),
                            "three points that stay collinear have no circumcenter");
  // At t = 2 two of them meet.
  const Moving_point_2 passing(Linear_motion_2{{0, 2}, {1, 1}, 0});
  const Moving_point_2 center(circumcenter_trajectory(p, q, passing));
  EXPECT_PRECONDITION_ERROR(center.position(2), "the point is nowhere at this time");
  EXPECT_PRECONDITION_ERROR(Moving_point_2(Trajectory_2()),
                            "a trajectory whose denominator is zero");
}

TEST(Certificate_polynomials, of_circumcenters_have_the_signs_of_the_static_predicates) {
  constexpr unsigned seed = 5;
  SCOPED_TRACE(seed);
  Motion_source source(seed);
  for (int i = 0; i < 200; ++i) {
    std::array<Linear_motion_2, 5> m;
    for (auto& motion : m) motion = source.next(i % 2 == 0 ? 0 : 3);
    const Rational t = source.time(0);
    std::array<Moving_point_2, 5> p;
    std::array<Static_point, 5> s;
    for (std::size_t k = 0; k < 5; ++k) {
      p[k] = Moving_point_2(m[k]);
      s[k] = place_at(m[k], t);
    }
    const Moving_point_2 center(circumcenter_trajectory(p[0], p[1], p[2]));
    const Static_point expected = CGAL::circumcenter(s[0], s[1], s[2]);
    const Exact_position_2 place = center.position(t);
    ASSERT_EQ(place.x, expected.x());
    ASSERT_EQ(place.y, expected.y());
    ASSERT_EQ(x_difference(center, p[3]).sign_at(t), CGAL::compare_x(expected, s[3]));
    ASSERT_EQ(orientation_polynomial(p[3], center, p[4]).sign_at(t),
              CGAL::orientation(s[3], expected, s[4]));
    ASSERT_EQ(in_circle_polynomial(center, p[2], p[3], p[4]).sign_at(t),
              CGAL::side_of_oriented_circle(expected, s[2], s[3], s[4]));
    ASSERT_EQ(distance_difference(p[0], center, p[3]).sign_at(t),
              CGAL::compare_distance_to_point(s[0], expected, s[3]));
    ASSERT_EQ(distance_difference(center, p[0], p[1]).sign_at(t), CGAL::EQUAL);
    const Moving_point_2 nested(circumcenter_trajectory(center, p[3], p[4]));
    const Static_point nested_expected = CGAL::circumcenter(expected, s[3], s[4]);
    ASSERT_EQ(nested.position(t).x, nested_expected.x());
    ASSERT_EQ(nested.position(t).y, nested_expected.y());
  }
}

}  // namespace
}  // namespace kinetri::certificate_polynomials_test
