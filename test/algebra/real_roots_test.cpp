// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real roots, the first root after a time and failure times, of polynomials with chosen roots.
#include "kinetri/algebra/real_roots.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/random_polynomials.h"

namespace kinetri::real_roots_test {
namespace {

using test::are_the_roots;
using test::Known_polynomial;
using test::Known_root;
using test::Random;

Rational two_to(long exponent) {
  return scaled_by_power_of_two(1, exponent);
}

// What an algebraic number promises of its isolating interval, checked by Sturm's theorem.
testing::AssertionResult is_isolated(const Algebraic_number& number) {
  if (number.is_known_rational()) return testing::AssertionSuccess();
  const int count =
      Sturm_sequence(number.polynomial())
          .count(Interval_end{number.lower(), true}, Interval_end{number.upper(), true});
  if (count == 1) return testing::AssertionSuccess();
  return testing::AssertionFailure() << count << " roots in the isolating interval of " << number;
}

// --- All roots
// ------------------------------------------------------------------------------------

TEST(Real_roots, of_a_polynomial_built_from_roots_are_those_in_order) {
  for (unsigned long seed = 0; seed < test::cases(1500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Known_polynomial p = test::random_known_polynomial(random, 12, 4);
    const std::vector<Real_root> roots = real_roots(p.polynomial());
    ASSERT_TRUE(are_the_roots(roots, p.roots())) << p.polynomial();
    for (const Real_root& root : roots) ASSERT_TRUE(is_isolated(root.value));
  }
}

TEST(Real_roots, of_huge_and_tiny_magnitude_are_found) {
  for (unsigned long seed = 0; seed < test::cases(20ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p(random.big_integer_not_zero(400));
    for (long i = random.integer(1, 4); i > 0; --i) {
      const Rational a = random.dyadic(50, -1100, 1000);
      const int multiplicity = static_cast<int>(random.integer(1, 2));
      if (random.coin()) {
        p.add_rational(a, multiplicity);
      } else {
        p.add_irrational_pair(random.coin() ? a : Rational(0), a * a * 3 + two_to(-2000) * 2,
                              multiplicity);
      }
    }
    p.add_rational(0, static_cast<int>(random.integer(1, 2)));
    p.add_rootless(0, random.dyadic(50, -1100, 1000), 1);
    ASSERT_TRUE(are_the_roots(real_roots(p.polynomial()), p.roots())) << p.polynomial();
  }
}

// Coefficients whose exponents span the range of products of binary64 numbers.
TEST(Real_roots, of_random_coefficients_are_as_many_as_a_sturm_sequence_counts) {
  for (unsigned long seed = 0; seed < test::cases(200ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Rational> coefficients;
    for (long i = random.integer(1, 9); i >= 0; --i) {
      coefficients.push_back(random.integer(0, 5) == 0 ? Rational(0)
                                                       : random.dyadic(53, -600, 600));
    }
    const Polynomial p = primitive_polynomial(coefficients);
    if (p.degree() < 1) continue;
    const Sturm_sequence sequence(p);
    const std::vector<Real_root> roots = real_roots(p);
    ASSERT_EQ(static_cast<int>(roots.size()),
              sequence.sign_changes_at_minus_infinity() - sequence.sign_changes_at_plus_infinity())
        << p;
    for (std::size_t i = 0; i < roots.size(); ++i) {
      ASSERT_TRUE(is_isolated(roots[i].value));
      ASSERT_TRUE(roots[i].value.is_root_of(p));
      if (i > 0) {
        ASSERT_LT(roots[i - 1].value, roots[i].value);
      }
      const auto next = first_root_after(p, roots[i].value);
      ASSERT_EQ(next.has_value(), i + 1 < roots.size());
      if (next) {
        ASSERT_EQ(next->value, roots[i + 1].value);
      }
    }
  }
}

TEST(Real_roots, that_are_very_close_are_told) {
  for (unsigned long seed = 0; seed < test::cases(60ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p;
    const Rational a = random.any_rational();
    for (int i = 0; i < 4; ++i) {
      const Rational near = a + two_to(-random.integer(180, 220)) * random.integer(-3, 3);
      const int multiplicity = static_cast<int>(random.integer(1, 2));
      if (random.coin()) {
        p.add_rational(near, multiplicity);
      } else {
        p.add_irrational_pair(near, 2, multiplicity);
      }
    }
    ASSERT_TRUE(are_the_roots(real_roots(p.polynomial()), p.roots())) << p.polynomial();
  }
}

TEST(Real_roots, at_powers_of_two_and_on_the_bound_of_the_roots_are_found) {
  for (const long exponent : {-3L, -1L, 0L, 1L, 2L, 7L}) {
    for (const int degree : {1, 2, 3, 4, 5}) {
      // t^degree - 2^(exponent degree)
      std::vector<Rational> c(static_cast<std::size_t>(degree) + 1);
      c.front() = -two_to(exponent * degree);
      c.back() = 1;
      const std::vector<Real_root> roots = real_roots(primitive_polynomial(c));
      ASSERT_EQ(roots.size(), degree % 2 == 0 ? 2U : 1U);
      ASSERT_EQ(compare(roots.back().value, two_to(exponent)), CGAL::EQUAL);
    }
  }
}

TEST(Real_roots, of_constants_are_none_and_of_zero_refused) {
  EXPECT_TRUE(real_roots(Polynomial{-3}).empty());
  EXPECT_TRUE(real_roots(Polynomial{1, 0, 1}).empty());
  EXPECT_PRECONDITION_ERROR(real_roots(Polynomial()),
                            "every number is a root of the zero polynomial");
}

// --- The first root after a time
// --------------------------------------------------------------------

// Times that matter to `p`: its roots under disguise, numbers beside them, rationals and
// irrationals.
struct Time {
  Algebraic_number number;
  Known_root truth;
};

std::vector<Time> interesting_times(const Known_polynomial& p, Random& random) {
  Known_polynomial others;
  others.add_rational(random.any_rational(), 1);
  others.add_rational(-1000, 1);
  others.add_rational(to_rational(1e6), 1);
  others.add_irrational_pair(random.any_rational(), test::random_non_square(random), 1);
  std::vector<Known_root> truths = others.roots();
  for (const Known_root& root : p.roots()) {
    truths.push_back(root);
    // Closer to the root than the isolating interval of either.
    Known_polynomial beside;
    const Rational small = two_to(-random.integer(20, 300));
    if (root.rational) {
      beside.add_rational(*root.rational + (random.coin() ? small : Rational(-small)), 1);
    } else {
      beside.add_rational(test::rounded(root.value, 200), 1);
    }
    truths.push_back(beside.roots().front());
  }

  std::vector<Time> result;
  for (const Known_root& truth : truths) {
    if (truth.rational && random.coin()) {
      result.push_back({Algebraic_number(*truth.rational), truth});
      continue;
    }
    // The polynomial of the time: the minimal one, one with other roots, or that of p itself.
    if (p.has_root(truth.value) && random.coin()) {
      for (const Real_root& root : real_roots(square_free_part(p.polynomial()))) {
        if (test::is_the_number(root.value, truth)) result.push_back({root.value, truth});
      }
      continue;
    }
    Known_polynomial disguise;
    if (truth.rational) {
      disguise.add_rational(*truth.rational, 1);
    } else {
      const Polynomial& m = truth.minimal;
      const Rational a = -Rational(m[1], m[2]) / 2;
      disguise.add_irrational_pair(a, a * a - Rational(m[0], m[2]), 1);
    }
    if (truth.rational || random.coin()) {
      disguise.add_irrational_pair(random.integer(-3, 3), test::random_non_square(random), 1);
    }
    result.push_back({test::isolated_root(disguise, truth, random), truth});
  }
  return result;
}

// Two roots close together beside a number with few digits, at which intervals end.
TEST(First_root_after, of_a_cluster_beside_the_end_of_an_interval_is_found) {
  for (const Rational& end : {Rational(0), Rational(1, 4), Rational(3), Rational(-5)}) {
    for (long k = 4; k < 120; ++k) {
      const Rational first = end - two_to(-k);
      const Rational second = first + two_to(-k - 40);
      Known_polynomial p;
      p.add_rational(first, 1);
      p.add_rational(second, 1);
      p.add_rational(end + 7, 1);
      const Algebraic_number before(Rational(end - 1));
      const auto one = first_root_after(p.polynomial(), before);
      ASSERT_TRUE(one);
      EXPECT_EQ(one->value, Algebraic_number(first));
      const auto two = first_root_after(p.polynomial(), one->value);
      ASSERT_TRUE(two);
      EXPECT_EQ(two->value, Algebraic_number(second));
      const auto three = first_root_after(p.polynomial(), two->value);
      ASSERT_TRUE(three);
      EXPECT_EQ(three->value, Algebraic_number(Rational(end + 7)));
    }
  }
}

TEST(First_root_after, a_time_is_the_next_root_by_construction) {
  for (unsigned long seed = 0; seed < test::cases(400ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Known_polynomial p = test::random_known_polynomial(random, 8, 4);
    for (const Time& t : interesting_times(p, random)) {
      const Known_root* expected = nullptr;
      for (const Known_root& root : p.roots()) {
        if (expected == nullptr && root.value > t.truth.value) expected = &root;
      }
      const std::optional<Real_root> found = first_root_after(p.polynomial(), t.number);
      ASSERT_EQ(found.has_value(), expected != nullptr) << p.polynomial() << " after " << t.number;
      if (!found) continue;
      ASSERT_TRUE(test::is_the_number(found->value, *expected));
      ASSERT_EQ(found->multiplicity, expected->multiplicity);
      ASSERT_TRUE(is_isolated(found->value));
    }
  }
}

TEST(First_root_after, many_roots_of_all_sizes_visits_them_in_turn) {
  for (unsigned long seed = 0; seed < test::cases(15ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p;
    for (int i = 0; i < 5; ++i) p.add_rational(random.dyadic(40, -700, 600), 1);
    p.add_irrational_pair(0, two_to(-600) * 2, 2);
    std::vector<Real_root> found;
    Algebraic_number t(-two_to(800));
    while (const std::optional<Real_root> next = first_root_after(p.polynomial(), t)) {
      found.push_back(*next);
      t = next->value;
    }
    ASSERT_TRUE(are_the_roots(found, p.roots()));
  }
}

TEST(First_root_after, zero_polynomial_is_refused) {
  EXPECT_PRECONDITION_ERROR(first_root_after(Polynomial(), Algebraic_number()),
                            "every number is a root of the zero polynomial");
}

// --- Failure times
// ----------------------------------------------------------------------------------

TEST(Failure_time, is_the_infimum_of_the_times_of_negative_values) {
  std::array<unsigned long, 3> outcomes = {};
  for (unsigned long seed = 0; seed < test::cases(300ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p = test::random_known_polynomial(random, 8, 4);
    for (const Time& t : interesting_times(p, random)) {
      // Mostly the certificate holds just after t, as it does in use.
      Sign after = p.polynomial().sign_at_plus_infinity();
      for (const Known_root& root : p.roots()) {
        if (root.value > t.truth.value && root.multiplicity % 2 != 0) after = -after;
      }
      if (after == CGAL::NEGATIVE && random.integer(0, 4) != 0) {
        p.negate();
        after = CGAL::POSITIVE;
      }
      const Known_root* expected = nullptr;
      for (const Known_root& root : p.roots()) {
        if (expected == nullptr && root.value > t.truth.value && root.multiplicity % 2 != 0) {
          expected = &root;
        }
      }
      if (after == CGAL::NEGATIVE) expected = &t.truth;

      const std::optional<Algebraic_number> found = failure_time(p.polynomial(), t.number);
      ASSERT_EQ(found.has_value(), expected != nullptr) << p.polynomial() << " after " << t.number;
      ++outcomes[after == CGAL::NEGATIVE ? 0U : found ? 1U : 2U];
      if (!found) continue;
      ASSERT_TRUE(test::is_the_number(*found, *expected)) << p.polynomial() << "; " << t.number;
      ASSERT_TRUE(is_isolated(*found));
      ASSERT_EQ(compare(*found, t.number), after == CGAL::NEGATIVE ? CGAL::EQUAL : CGAL::LARGER);
      ASSERT_TRUE(after == CGAL::NEGATIVE || found->lower() >= t.number.lower());
      // The definition: no negative value between, negative just after.
      ASSERT_EQ(sign_just_after(p.polynomial(), *found), CGAL::NEGATIVE);
      if (after == CGAL::NEGATIVE) continue;
      ASSERT_NE(p.polynomial().sign_at(simplest_between(t.number, *found)), CGAL::NEGATIVE);
      ASSERT_EQ(sign_just_before(p.polynomial(), *found), CGAL::POSITIVE);
    }
  }
  for (const unsigned long count : outcomes) EXPECT_GT(count, 100U) << "a case is hardly tested";
}

TEST(Failure_time, of_zero_and_of_constants) {
  EXPECT_EQ(failure_time(Polynomial(), Algebraic_number(3.0)), std::nullopt);
  EXPECT_EQ(failure_time(Polynomial{2}, Algebraic_number(3.0)), std::nullopt);
  EXPECT_EQ(failure_time(Polynomial{-2}, Algebraic_number(3.0)), Algebraic_number(3.0));
}

TEST(Failure_time, a_touch_is_no_failure) {
  const Polynomial touch = Polynomial{1, -2, 1};  // (t - 1)^2
  EXPECT_EQ(failure_time(touch, Algebraic_number(0.0)), std::nullopt);
  EXPECT_EQ(failure_time(touch, Algebraic_number(1.0)), std::nullopt);
  EXPECT_EQ(failure_time(touch * Polynomial{3, -1}, Algebraic_number(0.0)), Algebraic_number(3.0));
  EXPECT_EQ(failure_time(Polynomial{-2, 0, 1} * Polynomial{-2, 0, 1}, Algebraic_number(0.0)),
            std::nullopt);
}

TEST(Failure_time, a_triple_root_is_a_failure) {
  const Polynomial triple = Polynomial{1, -1} * Polynomial{1, -1} * Polynomial{1, -1};
  EXPECT_EQ(failure_time(triple, Algebraic_number(0.0)), Algebraic_number(1.0));
  EXPECT_EQ(failure_time(-triple, Algebraic_number(1.0)), std::nullopt);
  EXPECT_EQ(failure_time(triple, Algebraic_number(1.0)), Algebraic_number(1.0));
}

TEST(Failure_time, at_a_double_root_from_above_is_the_root_itself) {
  const Polynomial p = -(Polynomial{1, -2, 1});
  EXPECT_EQ(failure_time(p, Algebraic_number(1.0)), Algebraic_number(1.0));
  EXPECT_EQ(failure_time(p, Algebraic_number(0.5)), Algebraic_number(0.5));
}

TEST(Failure_time, after_a_flip_is_the_next_root_of_minus_the_polynomial) {
  // Roots -sqrt(7), -sqrt(2), sqrt(2), sqrt(7): the certificate changes hands at each.
  Polynomial p = Polynomial{-2, 0, 1} * Polynomial{-7, 0, 1};
  std::optional<Algebraic_number> t = Algebraic_number(-10.0);
  int flips = 0;
  while ((t = failure_time(p, *t)).has_value()) {
    p = -p;
    ++flips;
  }
  EXPECT_EQ(flips, 4);
}

TEST(Failure_time, a_root_inside_the_isolating_interval_of_the_time_is_not_overlooked) {
  // The time is a root of p and of another polynomial; the next root of p is closer to it than the
  // ends of its interval, for all that the sign of p at the time makes it shrink.
  for (const long distance : {3L, 30L, 60L, 200L}) {
    for (const bool irrational : {false, true}) {
      SCOPED_TRACE(std::to_string(distance) + (irrational ? ", irrational" : ", rational"));
      Random random(static_cast<std::uint64_t>(distance));
      Known_polynomial p;
      Known_polynomial of_time;
      if (irrational) {
        p.add_irrational_pair(0, 2, 1);
        p.add_irrational_pair(two_to(-distance), 2, 1);
        of_time.add_irrational_pair(0, 2, 1);
      } else {
        p.add_irrational_pair(-3, 2, 1);
        p.add_rational(Rational(1, 3), 1);
        p.add_rational(Rational(1, 3) + two_to(-distance), 1);
        of_time.add_rational(Rational(1, 3), 1);
      }
      of_time.add_irrational_pair(0, 5, 1);
      const Known_root& first = p.roots()[p.roots().size() - 2];
      const Known_root& second = p.roots().back();
      const auto time = [&] { return test::isolated_root(of_time, first, random); };
      const std::optional<Real_root> root = first_root_after(p.polynomial(), time());
      ASSERT_TRUE(root.has_value());
      EXPECT_TRUE(test::is_the_number(root->value, second));
      // Negative between the two: at once; minus that: at the second.
      const Algebraic_number t = time();
      EXPECT_EQ(failure_time(p.polynomial(), t), t);
      const std::optional<Algebraic_number> failure = failure_time(-p.polynomial(), time());
      ASSERT_TRUE(failure.has_value());
      EXPECT_TRUE(test::is_the_number(*failure, second));
    }
  }
}

TEST(Failure_time, may_be_asked_for_with_the_polynomial_of_the_time_itself) {
  const Polynomial p = Polynomial{-2, 0, 1} * Polynomial{-7, 0, 1};
  const Algebraic_number t(p, 1, 2);
  // The argument is a reference into the number, whose polynomial may be replaced on the way.
  const std::optional<Algebraic_number> next = failure_time(t.polynomial(), t);
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(*next, t);
  const std::optional<Real_root> root = first_root_after(t.polynomial(), t);
  ASSERT_TRUE(root.has_value());
  EXPECT_TRUE(root->value.is_root_of(Polynomial{-7, 0, 1}));
}

// Without real roots. From here the two least coefficients bound the distance of a positive root
// from below by more than all three bound it from above.
TEST(First_root_after, of_a_polynomial_whose_bounds_leave_no_room_is_none) {
  const Polynomial p{Integer("2992678467142049159753394402503356108514749585614803627953466632192"),
                     Integer("2391823319658990923777299229518100981239141166499198492999529005056"),
                     Integer("503178294214298907662325845051828803811504768542346502778904379392")};
  EXPECT_FALSE(first_root_after(p, Algebraic_number(-2.3791792580324331)));
}

}  // namespace
}  // namespace kinetri::real_roots_test
