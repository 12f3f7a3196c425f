// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm counts of polynomials whose roots are known by construction. The
// intervals end at roots, simple and multiple, and next to them, since that is where counts go
// wrong.
#include "kinetri/algebra/sturm_sequence.h"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/random_polynomials.h"

namespace kinetri::sturm_sequence_test {
namespace {

using test::Known_polynomial;
using test::Known_root;
using test::Random;

using End = std::optional<Interval_end>;

bool is_inside(const Known_root& root, const End& lower, const End& upper) {
  if (lower) {
    const int order = mpfr_cmp_q(root.value.backend().data(), lower->value.backend().data());
    const bool equal = root.rational && *root.rational == lower->value;
    if (equal ? !lower->included : order < 0) return false;
  }
  if (upper) {
    const int order = mpfr_cmp_q(root.value.backend().data(), upper->value.backend().data());
    const bool equal = root.rational && *root.rational == upper->value;
    if (equal ? !upper->included : order > 0) return false;
  }
  return true;
}

int count_by_construction(const Known_polynomial& p, const End& lower, const End& upper) {
  int count = 0;
  for (const Known_root& root : p.roots()) count += is_inside(root, lower, upper) ? 1 : 0;
  return count;
}

// Ends worth trying: the rational roots, close neighbors of all, and anything.
std::vector<Rational> interesting_points(const Known_polynomial& p, Random& random) {
  std::vector<Rational> result = {random.any_rational(), random.any_rational(), Rational(0)};
  for (const Known_root& root : p.roots()) {
    if (root.rational) result.push_back(*root.rational);
    const Rational near = root.rational ? *root.rational : test::rounded(root.value, 250);
    result.push_back(near + scaled_by_power_of_two(1, -random.integer(1, 200)));
    result.push_back(near - scaled_by_power_of_two(1, -random.integer(1, 200)));
  }
  return result;
}

std::string describe(const Polynomial& p, const End& lower, const End& upper) {
  std::ostringstream out;
  out << p << " on " << (lower && lower->included ? '[' : '(')
      << (lower ? lower->value.str() : "-inf") << ", " << (upper ? upper->value.str() : "inf")
      << (upper && upper->included ? ']' : ')');
  return out.str();
}

// Every combination of ends at the points, or `pairs` random pairs, with all inclusions.
template <class Check>
void for_intervals(const std::vector<Rational>& points, Random& random, int pairs,
                   const Check& check) {
  check(std::nullopt, std::nullopt);
  for (int i = 0; i < pairs; ++i) {
    Rational a = random.pick(points);
    Rational b = random.integer(0, 9) == 0 ? a : random.pick(points);
    if (b < a) std::swap(a, b);
    for (const bool first : {false, true}) {
      check(Interval_end{a, first}, std::nullopt);
      check(std::nullopt, Interval_end{b, first});
      for (const bool last : {false, true}) check(Interval_end{a, first}, Interval_end{b, last});
    }
  }
}

// --- Counting
// -------------------------------------------------------------------------------------

TEST(Sturm_count, of_a_polynomial_built_from_roots_is_their_number_in_every_interval) {
  for (unsigned long seed = 0; seed < test::cases(800ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Known_polynomial p = test::random_known_polynomial(random, 10, 4);
    const Sturm_sequence sequence(p.polynomial());
    for_intervals(interesting_points(p, random), random, 8,
                  [&](const End& lower, const End& upper) {
                    ASSERT_EQ(sequence.count(lower, upper), count_by_construction(p, lower, upper))
                        << describe(p.polynomial(), lower, upper);
                  });
  }
}

TEST(Sturm_count, is_right_for_coefficients_of_huge_and_tiny_magnitude) {
  for (unsigned long seed = 0; seed < test::cases(300ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p(random.big_integer_not_zero(500));
    // 2^-500 is about 1e-150.
    for (long i = random.integer(1, 4); i > 0; --i) {
      p.add_rational(random.dyadic(50, -550, 450), static_cast<int>(random.integer(1, 2)));
    }
    p.add_rootless(random.dyadic(50, -550, 450), random.dyadic(50, -550, 450), 1);
    const Sturm_sequence sequence(p.polynomial());
    for_intervals(interesting_points(p, random), random, 4,
                  [&](const End& lower, const End& upper) {
                    ASSERT_EQ(sequence.count(lower, upper), count_by_construction(p, lower, upper))
                        << describe(p.polynomial(), lower, upper);
                  });
  }
}

TEST(Sturm_count, at_a_double_root_does_not_lose_it) {
  // All the undivided terms vanish at 1, so that V(1) of the undivided sequence is 0.
  const Sturm_sequence sequence(Polynomial{1, -2, 1} * Polynomial{-3, 1});
  EXPECT_EQ(sequence.count(), 2);
  EXPECT_EQ(sequence.count(Interval_end{1, true}, Interval_end{2, true}), 1);
  EXPECT_EQ(sequence.count(Interval_end{1, false}, Interval_end{2, true}), 0);
  EXPECT_EQ(sequence.count(Interval_end{0, true}, Interval_end{1, true}), 1);
  EXPECT_EQ(sequence.count(Interval_end{0, true}, Interval_end{1, false}), 0);
  EXPECT_EQ(sequence.count(Interval_end{1, true}, Interval_end{3, true}), 2);
  EXPECT_EQ(sequence.count(Interval_end{1, false}, Interval_end{3, false}), 0);
  EXPECT_EQ(sequence.count(Interval_end{1, true}, std::nullopt), 2);
  EXPECT_EQ(sequence.count(std::nullopt, Interval_end{1, false}), 0);
}

TEST(Sturm_count, of_a_point_is_one_at_a_root_and_an_empty_interval_has_none) {
  const Sturm_sequence sequence(Polynomial{-1, 0, 1});
  EXPECT_EQ(sequence.count(Interval_end{1, true}, Interval_end{1, true}), 1);
  EXPECT_EQ(sequence.count(Interval_end{1, true}, Interval_end{1, false}), 0);
  EXPECT_EQ(sequence.count(Interval_end{1, false}, Interval_end{1, true}), 0);
  EXPECT_EQ(sequence.count(Interval_end{1, false}, Interval_end{1, false}), 0);
  EXPECT_EQ(sequence.count(Interval_end{0, true}, Interval_end{0, true}), 0);
}

TEST(Sturm_count, of_constants_and_lines_is_right) {
  EXPECT_EQ(Sturm_sequence(Polynomial{5}).count(), 0);
  EXPECT_EQ(Sturm_sequence(Polynomial{-5}).count(Interval_end{0, true}, Interval_end{1, true}), 0);
  EXPECT_EQ(Sturm_sequence(Polynomial{5, -2}).count(), 1);
  EXPECT_EQ(Sturm_sequence(Polynomial{5, -2}).count(Interval_end{Rational(5, 2), false}), 0);
  EXPECT_EQ(Sturm_sequence(Polynomial{5, -2}).count(Interval_end{Rational(5, 2), true}), 1);
}

TEST(Sturm_count, of_powers_of_irrational_or_complex_pairs_counts_distinct_real_roots) {
  Polynomial real{1};
  Polynomial complex{1};
  for (int power = 1; power <= 4; ++power) {
    real = real * Polynomial{-2, 0, 1};
    complex = complex * Polynomial{1, 0, 1};
    EXPECT_EQ(Sturm_sequence(real).count(), 2) << power;
    EXPECT_EQ(Sturm_sequence(real).count(Interval_end{0, true}, std::nullopt), 1) << power;
    EXPECT_EQ(Sturm_sequence(complex).count(), 0) << power;
    EXPECT_EQ(Sturm_sequence(real * complex).count(), 2) << power;
  }
}

TEST(Sturm_sequence, preconditions_are_checked) {
  EXPECT_PRECONDITION_ERROR(Sturm_sequence{Polynomial()},
                            "the zero polynomial has no Sturm sequence");
  const Sturm_sequence sequence(Polynomial{-1, 0, 1});
  EXPECT_PRECONDITION_ERROR(sequence.count(Interval_end{1, true}, Interval_end{0, true}),
                            "the ends of the interval are not in order");
}

// --- Terms
// ------------------------------------------------------------------------------------------

TEST(Sturm_sequence, terms_are_primitive_negated_remainders_that_end_with_the_gcd) {
  for (unsigned long seed = 0; seed < test::cases(500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial f = random.coin()
                             ? random.polynomial(static_cast<int>(random.integer(0, 8)), 60)
                             : test::random_known_polynomial(random, 8, 4).polynomial();
    const Sturm_sequence sequence(f);
    const std::span<const Polynomial> terms = sequence.terms();
    ASSERT_EQ(terms.front(), primitive_part(f));
    if (f.degree() >= 1) {
      ASSERT_EQ(terms[1], primitive_part(derivative(f)));
    }
    for (const Polynomial& term : terms) {
      ASSERT_FALSE(term.is_zero());
      ASSERT_EQ(content(term), Integer(1));
      ASSERT_TRUE(positive_pseudo_remainder(term, terms.back()).is_zero());
    }
    for (std::size_t i = 2; i < terms.size(); ++i) {
      ASSERT_EQ(terms[i], primitive_part(-positive_pseudo_remainder(terms[i - 2], terms[i - 1])));
    }
    const Polynomial common = gcd(f, derivative(f));
    ASSERT_TRUE(terms.back() == common || terms.back() == -common);
  }
}

TEST(Sturm_sequence, sign_changes_ignore_zeros_and_positive_factors) {
  // t^3 - t, 3 t^2 - 1, 2 t, 1 up to positive factors.
  const Sturm_sequence sequence(Polynomial{0, -7, 0, 7});
  EXPECT_EQ(sequence.sign_changes_at_minus_infinity(), 3);
  EXPECT_EQ(sequence.sign_changes_at_plus_infinity(), 0);
  EXPECT_EQ(sequence.sign_changes_at(-1), 2);  // 0 + - +
  EXPECT_EQ(sequence.sign_changes_at(0), 1);   // 0 - 0 +
  EXPECT_EQ(sequence.sign_changes_at(1), 0);   // 0 + + +
}

}  // namespace
}  // namespace kinetri::sturm_sequence_test
