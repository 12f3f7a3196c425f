// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates of failures, of polynomials with chosen roots: what they claim is checked by counts
// of roots, on touches, on roots between neighboring binary64 numbers, and on failures at once.
#include "kinetri/algebra/failure_certificate.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "support/precondition_error.h"

namespace kinetri::failure_certificate_test {
namespace {

Polynomial power(const Polynomial& p, int exponent) {
  Polynomial result = {1};
  for (int i = 0; i < exponent; ++i) result = result * p;
  return result;
}

// t - numerator / denominator, times the denominator.
Polynomial root_at(const Integer& numerator, const Integer& denominator = 1) {
  return Polynomial{-numerator, denominator};
}

int roots_between(const Polynomial& p, const Rational& lower, const Rational& upper) {
  if (lower == upper) return p.sign_at(lower) == CGAL::ZERO ? 1 : 0;
  return Sturm_sequence(p).count(Interval_end{lower, false}, Interval_end{upper, true});
}

void expect_proof(const Failure_certificate& c, const Polynomial& p) {
  EXPECT_EQ(c.polynomial, primitive_part(p));
  EXPECT_LE(c.from, c.lower);
  EXPECT_LE(c.lower, c.upper);
  EXPECT_EQ(roots_between(p, c.lower, c.upper), 1);
  if (c.from < c.lower) {
    EXPECT_EQ(roots_between(p, c.from, c.upper), 1 + static_cast<int>(c.touches.size()));
  }
  Rational end = c.from;
  for (const auto& [lower, upper] : c.touches) {
    EXPECT_LE(end, lower);
    EXPECT_LE(upper, c.lower);
    EXPECT_EQ(roots_between(p, lower, upper), 1);
    end = upper;
  }
  const Sturm_sequence sequence(p);
  const std::vector<Rational> places = {c.from, c.lower, c.upper};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(c.signs[i].size(), sequence.terms().size());
    for (std::size_t k = 0; k < c.signs[i].size(); ++k) {
      EXPECT_EQ(c.signs[i][k], sequence.terms()[k].sign_at(places[i]));
    }
  }
}

TEST(Failure_certificate, of_a_root_that_is_a_binary64_number_is_that_number) {
  const Polynomial p = -root_at(3);
  const auto c = certify_failure(p * Integer(6), 1, 3);
  ASSERT_TRUE(c);
  expect_proof(*c, p);
  EXPECT_EQ(c->from, 1);
  EXPECT_EQ(c->lower, 3);
  EXPECT_EQ(c->upper, 3);
  EXPECT_EQ(c->multiplicity, 1);
}

TEST(Failure_certificate, of_an_irrational_root_has_its_neighbors) {
  const Polynomial p = {2, 0, -1};
  const Algebraic_number root = real_roots(p).back().value;
  const auto c = certify_failure(p, 0, root);
  ASSERT_TRUE(c);
  expect_proof(*c, p);
  EXPECT_EQ(c->lower, to_rational(root.tight_interval().lower));
  EXPECT_EQ(c->upper, to_rational(root.tight_interval().upper));
}

TEST(Failure_certificate, names_touches_and_multiplicities) {
  const Polynomial p = -(power(root_at(1), 2) * power(root_at(7, 3), 4) * power(root_at(5), 3));
  const auto c = certify_failure(p, 0, 5);
  ASSERT_TRUE(c);
  expect_proof(*c, p);
  EXPECT_EQ(c->touches.size(), 2U);
  EXPECT_EQ(c->multiplicity, 3);
}

TEST(Failure_certificate, of_roots_between_neighboring_binary64_numbers_is_finer) {
  // 1 + 2^-60 is a touch, 1 + 2^-59 the failure, 1 + 3 2^-60 another root.
  const Integer one = Integer(1) << 60;
  const Polynomial p = -(power(root_at(one + 1, one), 2) * root_at(one + 2, one) *
                         root_at(one + 3, one) * root_at(one + 4, one));
  const Algebraic_number failure(Rational(one + 2, one));
  for (const Algebraic_number& start : {Algebraic_number(0.0), Algebraic_number(1.0)}) {
    const auto c = certify_failure(p, start, failure);
    ASSERT_TRUE(c);
    expect_proof(*c, p);
    EXPECT_EQ(c->touches.size(), 1U);
    EXPECT_LE(c->upper - c->lower, Rational(1, one));
  }
}

TEST(Failure_certificate, begins_after_a_root_at_the_start) {
  for (const int multiplicity : {1, 2, 3}) {
    const Polynomial q = power(root_at(1), multiplicity) * root_at(2);
    const Polynomial p = -q;
    const auto c = certify_failure(p, 1, 2);
    ASSERT_TRUE(c);
    expect_proof(*c, p);
    EXPECT_GT(c->from, 1);
    EXPECT_LT(c->from, 2);
  }
}

TEST(Failure_certificate, at_the_start_itself_has_one_root) {
  const Polynomial even = -power(Polynomial{-2, 0, 1}, 2);
  const auto c =
      certify_failure(even, real_roots(even).back().value, real_roots(even).back().value);
  ASSERT_TRUE(c);
  expect_proof(*c, even);
  EXPECT_EQ(c->from, c->lower);
  EXPECT_LT(c->lower, c->upper);
  EXPECT_EQ(c->multiplicity, 2);
  const auto at_binary64 = certify_failure(-root_at(4), 4, 4);
  ASSERT_TRUE(at_binary64);
  EXPECT_EQ(at_binary64->from, 4);
  EXPECT_EQ(at_binary64->upper, 4);
}

TEST(Failure_certificate, depends_on_no_refinement) {
  const Polynomial p = {2, 0, -1};
  const Algebraic_number refined = real_roots(p).back().value;
  refined.refine_to_bits(500);
  const auto a = certify_failure(p, 0, refined);
  const auto b = certify_failure(p, 0, real_roots(p).back().value);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->lower, b->lower);
  EXPECT_EQ(a->upper, b->upper);
  EXPECT_EQ(a->signs, b->signs);
}

TEST(Failure_certificate, is_none_where_nothing_fails) {
  EXPECT_FALSE(certify_failure(Polynomial(), 0, 1));
  EXPECT_FALSE(certify_failure(Polynomial{-1}, 0, 1));
  EXPECT_FALSE(certify_failure(-root_at(2), 0, 1));            // no root
  EXPECT_FALSE(certify_failure(root_at(1), 0, 1));             // it rises
  EXPECT_FALSE(certify_failure(power(root_at(1), 2), 0, 1));   // it touches
  EXPECT_FALSE(certify_failure(-power(root_at(1), 2), 0, 1));  // it is negative before
  EXPECT_FALSE(certify_failure(-(root_at(1) * root_at(2) * root_at(3)), 0, 3));  // and here
  EXPECT_FALSE(certify_failure(power(root_at(1), 2), 1, 1));  // not negative after
}

TEST(Failure_certificate, refuses_a_failure_before_the_start) {
  EXPECT_PRECONDITION_ERROR(certify_failure(-root_at(1), 2, 1),
                            "a polynomial that fails before the time from which it must not be "
                            "negative; take a failure at that time or later");
}

}  // namespace
}  // namespace kinetri::failure_certificate_test
