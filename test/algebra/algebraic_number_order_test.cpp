// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of algebraic numbers, and the simplest number between two of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "support/known_numbers.h"
#include "support/precondition_error.h"

namespace kinetri::algebraic_number_order_test {
namespace {

using test::Known_polynomial;
using test::Known_root;
using test::make_specimen;
using test::order_of;
using test::Random;
using test::some_values;
using test::Specimen;
using test::stand_in;
using test::two_to;
using test::Value;

constexpr double smallest = std::numeric_limits<double>::denorm_min();

// ---- order ----

TEST(Algebraic_number, order_of_a_pool_with_equal_and_nearly_equal_numbers_is_the_true_one) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::cases(60ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Specimen> pool;
    for (int i = 0; i < 8; ++i) {
      // Several representations of each.
      const Value& v = random.pick(values);
      for (int j = 0; j < 3; ++j) pool.push_back(make_specimen(v, values, random));
    }
    for (int i = 0; i < 300; ++i) {
      const Specimen& a = random.pick(pool);
      const Specimen& b = random.pick(pool);
      const Comparison_result expected = order_of(a.truth, b.truth);
      ASSERT_EQ(compare(a.number, b.number), expected) << a.number << "; " << b.number;
      ASSERT_EQ(compare(b.number, a.number), CGAL::opposite(expected));
      ASSERT_EQ(a.number < b.number, expected == CGAL::SMALLER);
      ASSERT_EQ(a.number >= b.number, expected != CGAL::SMALLER);
      ASSERT_EQ(a.number == b.number, expected == CGAL::EQUAL);
      ASSERT_EQ(a.number <=> b.number, static_cast<int>(expected) <=> 0);
    }
    // What was learnt on the way must not have changed any number.
    for (const Specimen& s : pool) {
      ASSERT_TRUE(test::is_the_number(s.number, s.truth));
      ASSERT_EQ(content(s.number.polynomial()), Integer(1));
    }
  }
}

TEST(Algebraic_number, sorting_a_pool_is_total_and_transitive) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::cases(20ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Specimen> pool;
    for (int i = 0; i < 40; ++i) pool.push_back(make_specimen(random.pick(values), values, random));
    std::sort(pool.begin(), pool.end(),
              [](const Specimen& a, const Specimen& b) { return a.number < b.number; });
    for (std::size_t i = 0; i < pool.size(); ++i) {
      for (std::size_t j = i + 1; j < pool.size(); ++j) {
        ASSERT_NE(compare(pool[i].number, pool[j].number), CGAL::LARGER);
        ASSERT_EQ(compare(pool[i].number, pool[j].number), order_of(pool[i].truth, pool[j].truth));
      }
    }
  }
}

TEST(Algebraic_number, order_against_rationals_is_the_true_one) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::cases(600ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Specimen s = make_specimen(random.pick(values), values, random);
    const Rational near = test::rounded(s.truth.value, 300);
    std::vector<Rational> rationals = {
        random.any_rational(), near, near + two_to(-240), near - two_to(-240) / 3, s.number.lower(),
        s.number.upper(),      0};
    if (s.truth.rational) rationals.push_back(*s.truth.rational);
    for (int i = 0; i < 10; ++i) {
      const Rational r = random.pick(rationals);
      const int order = mpfr_cmp_q(s.truth.value.backend().data(), r.backend().data());
      const bool equal = s.truth.rational && *s.truth.rational == r;
      const Comparison_result expected = equal       ? CGAL::EQUAL
                                         : order < 0 ? CGAL::SMALLER
                                                     : CGAL::LARGER;
      ASSERT_EQ(compare(s.number, r), expected) << s.number << " and " << r.str();
      ASSERT_EQ(compare(Algebraic_number(r), s.number), CGAL::opposite(expected));
      ASSERT_TRUE(test::is_the_number(s.number, s.truth));
    }
  }
}

TEST(Algebraic_number, roots_of_one_polynomial_with_overlapping_intervals_are_ordered) {
  // Roots -sqrt(3), -sqrt(2), sqrt(2), sqrt(3), in intervals with dyadic ends, which are kept.
  const Polynomial p = Polynomial{-2, 0, 1} * Polynomial{-3, 0, 1};
  const auto root_two = [&] { return Algebraic_number(p, 1, Rational(13, 8)); };
  const auto root_three = [&] { return Algebraic_number(-p, Rational(3, 2), 2); };
  EXPECT_EQ(compare(root_two(), root_three()), CGAL::SMALLER);
  EXPECT_EQ(compare(root_three(), root_two()), CGAL::LARGER);
  // The same interval, one within the other, and two that overlap around the one root.
  EXPECT_EQ(compare(root_two(), root_two()), CGAL::EQUAL);
  EXPECT_EQ(compare(root_two(), Algebraic_number(p, Rational(5, 4), Rational(3, 2))), CGAL::EQUAL);
  EXPECT_EQ(compare(Algebraic_number(-p, Rational(5, 4), Rational(3, 2)), root_two()), CGAL::EQUAL);
  EXPECT_EQ(compare(root_two(), Algebraic_number(p, Rational(5, 4), Rational(27, 16))),
            CGAL::EQUAL);
  const auto minus_root_two = [&] { return Algebraic_number(p, Rational(-13, 8), -1); };
  const auto minus_root_three = [&] { return Algebraic_number(p, -2, Rational(-3, 2)); };
  EXPECT_EQ(compare(minus_root_two(), minus_root_three()), CGAL::LARGER);
  EXPECT_EQ(compare(minus_root_three(), minus_root_two()), CGAL::SMALLER);
}

// The root of 2^40 t^2 - n between 1 and 3, which knows its rounding, and counts the calls for its
// polynomial.
class Counted_square_root : public Root_source {
 public:
  Counted_square_root(std::int64_t n, int& polynomials) : n_(n), polynomials_(polynomials) {}
  Polynomial polynomial() const override {
    ++polynomials_;
    return Polynomial{-Integer(n_), 0, Integer(1) << 40};
  }
  std::optional<Rounding> rounded(const Double_interval& /*bracket*/) const override {
    const double square = std::ldexp(static_cast<double>(n_), -40);
    const double nearest = std::sqrt(square);
    const double excess = std::fma(nearest, nearest, -square);
    return Rounding{nearest,
                    {excess >= 0 ? std::nextafter(nearest, 0) : nearest,
                     excess <= 0 ? std::nextafter(nearest, 4) : nearest}};
  }

 private:
  std::int64_t n_;
  int& polynomials_;
};

// Where rounded numbers differ, no polynomial is made; where they do not, nothing is guessed.
TEST(Algebraic_number, order_of_numbers_that_sources_can_round_takes_no_polynomials) {
  constexpr std::int64_t two = std::int64_t{2} << 40;
  int polynomials = 0;
  const auto root = [&](std::int64_t n) {
    return Algebraic_number(std::make_shared<Counted_square_root>(n, polynomials), {1, 3});
  };
  const Algebraic_number a = root(two);
  for (const std::int64_t more : {1, 2, 1000, 1 << 30}) {
    EXPECT_LT(a, root(two + more)) << more;
    EXPECT_GT(a, root(two - more)) << more;
  }
  EXPECT_LT(root(two), root(two + 1));
  EXPECT_EQ(polynomials, 0);
  EXPECT_EQ(a, root(two));
  EXPECT_EQ(root(2 * two), root(2 * two));  // the number 2
  EXPECT_GT(polynomials, 0);
  EXPECT_LT(a, root(two + 1));
  EXPECT_EQ(a, Algebraic_number(Polynomial{-2, 0, 1}, 1, 2));
}

TEST(Algebraic_number, equal_roots_among_other_common_roots_are_told_from_them) {
  // The gcd of the two polynomials has four roots, two of them closer than 2^-200.
  Known_polynomial common;
  common.add_irrational_pair(0, 2, 1);
  common.add_irrational_pair(two_to(-220), 2, 1);
  for (unsigned long seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Known_polynomial p = common;
    Known_polynomial q = common;
    p.add_rational(Rational(17, 12), 1);
    q.add_irrational_pair(5, 7, 1);
    for (const Known_root& a : common.roots()) {
      for (const Known_root& b : common.roots()) {
        const Algebraic_number x = test::isolated_root(p, a, random);
        const Algebraic_number y = test::isolated_root(q, b, random);
        ASSERT_EQ(compare(x, y), order_of(a, b));
      }
    }
  }
}

// ---- the simplest number between ----

// Tries every exponent from far too small on.
Rational simplest_by_trial(const Rational& a, const Rational& b) {
  if (a < 0 && b > 0) return 0;
  for (long e = -80;; ++e) {
    // The multiples of 2^-e next to the end nearer to zero, and their neighbors.
    const Rational near = scaled_by_power_of_two(a >= 0 ? a : Rational(-b), e);
    const Rational far = scaled_by_power_of_two(a >= 0 ? b : Rational(-a), e);
    const Integer whole = numerator(near) / denominator(near);
    for (const Integer& k : {whole, Integer(whole + 1)}) {
      if (Rational(k) > near && Rational(k) < far) {
        const Rational result = scaled_by_power_of_two(k, -e);
        return a >= 0 ? result : Rational(-result);
      }
    }
  }
}

TEST(Simplest_between, known_intervals_give_known_numbers) {
  EXPECT_EQ(simplest_between(-1.0, 1.0), Rational(0));
  EXPECT_EQ(simplest_between(0.0, 1.0), Rational(1, 2));
  EXPECT_EQ(simplest_between(-1.0, 0.0), Rational(-1, 2));
  EXPECT_EQ(simplest_between(1.0, 2.0), Rational(3, 2));
  EXPECT_EQ(simplest_between(2.5, 3.5), Rational(3));
  EXPECT_EQ(simplest_between(5.0, 100.0), Rational(64));
  EXPECT_EQ(simplest_between(-100.0, -5.0), Rational(-64));
  EXPECT_EQ(simplest_between(33.0, 1000.0), Rational(512));
  EXPECT_EQ(simplest_between(1.0, 1.0 + 0x1p-52), 1 + two_to(-53));
  EXPECT_EQ(simplest_between(0.0, smallest), two_to(-1075));
  EXPECT_EQ(simplest_between(Rational(0), two_to(-3000)), two_to(-3001));
  const Algebraic_number root(Polynomial{-2, 0, 1}, 1, 2);
  EXPECT_EQ(simplest_between(root, 2.0), Rational(3, 2));
  EXPECT_EQ(simplest_between(1.0, root), Rational(5, 4));
}

TEST(Simplest_between, of_random_numbers_is_what_trial_finds_for_every_representation) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::cases(500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Value& v = random.pick(values);
    const Value& w = random.pick(values);
    Specimen a = make_specimen(v, values, random);
    Specimen b = make_specimen(w, values, random);
    if (a.truth.value == b.truth.value) continue;
    const bool swapped = a.truth.value > b.truth.value;
    if (swapped) std::swap(a, b);
    const Rational expected = simplest_by_trial(stand_in(a.truth), stand_in(b.truth));
    ASSERT_EQ(simplest_between(a.number, b.number), expected) << a.number << "; " << b.number;
    b.number.refine_to(two_to(-300));
    ASSERT_EQ(simplest_between(a.number, b.number), expected) << a.number << "; " << b.number;
    const Specimen again = make_specimen(swapped ? w : v, values, random);
    ASSERT_EQ(simplest_between(again.number, b.number), expected);
  }
}

TEST(Simplest_between, of_an_empty_interval_is_refused) {
  EXPECT_PRECONDITION_ERROR(simplest_between(1.0, 1.0), "the interval is empty");
  EXPECT_PRECONDITION_ERROR(simplest_between(2.0, 1.0), "the interval is empty");
}

}  // namespace
}  // namespace kinetri::algebraic_number_order_test
