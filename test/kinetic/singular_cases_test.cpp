// SPDX-License-Identifier: GPL-3.0-or-later
//
// The singular cases of the paper, section 4.4: motions whose certificate has a multiple root, or
// is zero for all time; what Algorithm 1 and the failure time say of them.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "support/precondition_error.h"

namespace kinetri::singular_cases_test {
namespace {

// The certificate of the edge between the first two points, to the left of which the third one is:
// the edge is Delaunay while it is positive.
Polynomial certificate(const std::vector<Linear_motion_2>& motions) {
  std::vector<Moving_point_2> points;
  for (const Linear_motion_2& motion : motions) points.emplace_back(motion);
  return -in_circle_polynomial(points[0], points[1], points[2], points[3]);
}

TEST(Singular_cases, a_tangential_touch_is_a_double_root_and_no_event) {
  // The fourth point moves on a tangent of the unit circle.
  const Polynomial p =
      certificate({{{0, 1}, {0, 0}}, {{0, -1}, {0, 0}}, {{1, 0}, {0, 0}}, {{-1, -2}, {0, 1}}});
  const std::vector<Real_root> roots = real_roots(p);
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_EQ(roots[0].value, Algebraic_number(2.0));
  EXPECT_EQ(roots[0].multiplicity, 2);
  EXPECT_EQ(failure_time(p, Algebraic_number(0.0)), std::nullopt);
  EXPECT_EQ(failure_time(p, Algebraic_number(2.0)), std::nullopt);
  // The other diagonal is never Delaunay but at the touch.
  EXPECT_EQ(failure_time(-p, Algebraic_number(2.0)), Algebraic_number(2.0));
}

TEST(Singular_cases, a_touch_before_a_failure_is_passed_over) {
  const Polynomial p = certificate(
      {{{0, 1}, {0, 0}}, {{0, -1}, {0, 0}}, {{1.5, 0}, {-0.5, 0}}, {{-0.5, 1}, {-0.5, -1}}});
  const std::vector<Real_root> roots = sturm3(p);
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_EQ(roots[0].value, Algebraic_number(1.0));
  EXPECT_EQ(roots[0].multiplicity, 2);
  EXPECT_EQ(roots[1].value, Algebraic_number(2.0));
  EXPECT_EQ(roots[1].multiplicity, 1);
  EXPECT_EQ(failure_time(p, Algebraic_number(0.0)), Algebraic_number(2.0));
}

TEST(Singular_cases, points_that_stay_cocircular_have_the_zero_polynomial_and_no_event) {
  // The circle grows about the origin.
  const Polynomial p =
      certificate({{{0, 1}, {0, 1}}, {{0, -1}, {0, -1}}, {{1, 0}, {1, 0}}, {{-1, 0}, {-1, 0}}});
  EXPECT_TRUE(p.is_zero());
  EXPECT_EQ(failure_time(p, Algebraic_number(0.0)), std::nullopt);
  EXPECT_PRECONDITION_ERROR(Sturm_sequence{p}, "the zero polynomial has no Sturm sequence");
}

TEST(Singular_cases, a_triple_root_is_an_event) {
  const Polynomial p =
      certificate({{{1, 1}, {-1, 0}}, {{0, -1}, {0, 0}}, {{1, -1}, {0, 1}}, {{-1, 0}, {0, 0}}});
  const std::vector<Real_root> roots = sturm3(p);
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_EQ(roots[0].value, Algebraic_number(1.0));
  EXPECT_EQ(roots[0].multiplicity, 3);
  EXPECT_EQ(failure_time(p, Algebraic_number(0.0)), Algebraic_number(1.0));
  EXPECT_EQ(failure_time(-p, Algebraic_number(1.0)), std::nullopt);
}

TEST(Singular_cases, a_triple_root_beside_a_simple_one_is_an_event) {
  const Polynomial p =
      certificate({{{1, 1}, {-1, 0}}, {{0, 0}, {0, -1}}, {{0, -1}, {1, 1}}, {{-1, 0}, {0, 0}}});
  const std::vector<Real_root> roots = sturm4(p);
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_EQ(roots[0].value, Algebraic_number(-1.0));
  EXPECT_EQ(roots[0].multiplicity, 1);
  EXPECT_EQ(roots[1].value, Algebraic_number(1.0));
  EXPECT_EQ(roots[1].multiplicity, 3);
  EXPECT_EQ(failure_time(p, Algebraic_number(0.0)), Algebraic_number(1.0));
}

}  // namespace
}  // namespace kinetri::singular_cases_test
