// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences in binary64 against exact ones, of polynomials anywhere within the error, in all
// rounding modes; and that they decide what Bernstein coefficients leave open.
#include "kinetic/filter/approximate_sturm_sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "kinetic/filter/first_failure.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "support/filter_results.h"
#include "support/random_polynomials.h"

namespace kinetri::approximate_sturm_sequence_test {
namespace {

using test::Random;

double random_double(Random& random) {
  const double x = std::ldexp(static_cast<double>(random.integer(-(1L << 52), 1L << 52)), -52);
  return random.integer(0, 3) == 0 ? std::ldexp(x, static_cast<int>(random.integer(-40, 0))) : x;
}

// A number that is within `error` of `value`, often as far as that.
Rational within(Random& random, double value, double error) {
  const Rational share =
      random.coin() ? Rational(random.coin() ? 1 : -1) : Rational(random.integer(-16, 16), 16);
  return to_rational(value) + share * to_rational(error);
}

::testing::AssertionResult contains(const Approximate_number& a, const Rational& exact) {
  const Rational distance = boost::multiprecision::abs(Rational(to_rational(a.value) - exact));
  if (distance <= to_rational(a.error)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a.value << " with " << a.error << " is not " << exact;
}

TEST(Approximate_number, contains_the_exact_number_in_every_rounding_mode) {
  Random random(41);
  const unsigned long rounds = test::cases(20000ul);
  for (unsigned long round = 0; round < rounds; ++round) {
    const auto error_of = [&](double value) {
      return std::abs(std::ldexp(value, -static_cast<int>(random.integer(1, 60))));
    };
    const double x = random_double(random);
    const double y = random_double(random);
    const Approximate_number a = {x, error_of(x)};
    const Approximate_number b = {y, error_of(y)};
    const Rational exact_a = within(random, a.value, a.error);
    const Rational exact_b = within(random, b.value, b.error);
    const auto factor = static_cast<int>(random.integer(-99, 99));
    const auto results = test::in_mode(test::rounding_mode(static_cast<int>(round)), [&] {
      return std::array{a + b, a - b, a * b, a * factor, a * b - b * factor};
    });
    ASSERT_TRUE(contains(results[0], exact_a + exact_b));
    ASSERT_TRUE(contains(results[1], exact_a - exact_b));
    ASSERT_TRUE(contains(results[2], exact_a * exact_b));
    ASSERT_TRUE(contains(results[3], exact_a * factor));
    ASSERT_TRUE(contains(results[4], exact_a * exact_b - exact_b * factor));
    const Sign sign = certain_sign(results[1]);
    if (sign != CGAL::ZERO) {
      ASSERT_EQ(exact_a < exact_b, sign == CGAL::NEGATIVE);
    }
  }
}

// Coefficients of a polynomial of degree M - 1: any; or with roots in one place, nearly; or with
// a leading coefficient, or others, near zero.
template <std::size_t M>
std::array<double, M> random_coefficients(Random& random) {
  std::array<double, M> c = {};
  if (random.coin()) {
    for (double& x : c) x = random_double(random);
    if (random.integer(0, 3) == 0) {
      c[static_cast<std::size_t>(random.integer(0, M - 1))] *= 0x1p-30;
    }
    return c;
  }
  c[0] = random_double(random);
  const double root = random_double(random);
  for (std::size_t degree = 0; degree + 1 < M; ++degree) {
    const double other =
        random.coin() ? root + 0x1p-20 * random_double(random) : 4 * random_double(random);
    for (std::size_t i = degree + 2; i-- > 0;) c[i] = (i > 0 ? c[i - 1] : 0) - other * c[i];
  }
  return c;
}

// The polynomial with these coefficients, times the least common denominator.
Polynomial times_denominator(const std::vector<Rational>& coefficients) {
  Integer denominator = 1;
  for (const Rational& x : coefficients) {
    denominator = boost::multiprecision::lcm(denominator, boost::multiprecision::denominator(x));
  }
  std::vector<Integer> result;
  for (const Rational& x : coefficients) {
    result.push_back(boost::multiprecision::numerator(Rational(x * denominator)));
  }
  return Polynomial(std::move(result));
}

template <std::size_t M>
void expect_exact_changes(unsigned seed) {
  Random random(seed);
  const unsigned long rounds = test::cases(6000ul);
  unsigned long known = 0;
  for (unsigned long round = 0; round < rounds; ++round) {
    const std::array<double, M> c = random_coefficients<M>(random);
    double size = 0;
    for (const double x : c) size = std::max(size, std::abs(x));
    const double error = std::ldexp(size, -static_cast<int>(random.integer(20, 60)));
    const double w = std::ldexp(static_cast<double>(random.integer(1, 1 << 20)), -20);
    struct Counts {
      bool is_certain;
      std::optional<int> at_zero;
      std::optional<int> at_w;
      int at_infinity;
    };
    const auto counts = test::in_mode(test::rounding_mode(static_cast<int>(round)), [&] {
      const Approximate_sturm_sequence<M> sequence(c, error);
      if (!sequence.is_certain()) return Counts{};
      return Counts{true, sequence.changes_at_zero(), sequence.changes_at(w),
                    sequence.changes_at_infinity()};
    });
    if (!counts.is_certain) continue;
    std::vector<Rational> coefficients;
    for (const double x : c) coefficients.push_back(within(random, x, error));
    const Sturm_sequence exact(times_denominator(coefficients));
    if (counts.at_zero) {
      ASSERT_EQ(*counts.at_zero - counts.at_infinity,
                exact.count(Interval_end{0, false}, std::nullopt));
    }
    if (counts.at_w) {
      ASSERT_EQ(*counts.at_w - counts.at_infinity,
                exact.count(Interval_end{to_rational(w), false}, std::nullopt));
      ++known;
    }
  }
  EXPECT_GT(known, rounds / 3);
}

TEST(Approximate_sturm_sequence, counts_the_roots_of_every_polynomial_within_the_error) {
  expect_exact_changes<3>(42);
  expect_exact_changes<4>(43);
  expect_exact_changes<5>(44);
}

// (w - a)^2 + g with a small g of either sign, times a quadratic polynomial that is positive: with
// two roots close together, or none. Halving would go on until the halves are as small as that.
TEST(First_failure, is_decided_near_touches) {
  Random random(45);
  const unsigned long rounds = test::cases(2000ul);
  const double error = 0x1p-46;
  unsigned long decided = 0;
  unsigned long failures = 0;
  for (unsigned long round = 0; round < rounds; ++round) {
    const double a = 0.01 + 0.16 * std::abs(random_double(random));
    const double gap = (random.coin() ? 1e-7 : -1e-7) * (1 + std::abs(random_double(random)));
    const double b = random_double(random);
    const double d = b * b + 0.1 + std::abs(random_double(random));
    // (w^2 - 2 a w + e) (w^2 - 2 b w + d)
    const double e = a * a + gap;
    const std::array<double, 5> c = {e * d, -2 * (a * d + b * e), d + 4 * a * b + e, -2 * (a + b),
                                     1};
    const Filter_result result = test::in_mode(test::rounding_mode(static_cast<int>(round)), [&] {
      return first_failure(c, bernstein(c), error);
    });
    std::vector<Rational> coefficients;
    for (const double x : c) coefficients.push_back(within(random, x, error / 5));
    const Polynomial p = times_denominator(coefficients);
    if (result.kind == Filter_result::Kind::holds) {
      // Within the window only.
      const auto root = first_root_after(p, Rational(0));
      if (root) {
        ASSERT_GT(root->value, Algebraic_number(result.bounds.upper));
      }
    } else {
      test::expect_true(result, p, Algebraic_number(0));
    }
    if (testing::Test::HasFatalFailure()) return;
    decided += result.kind != Filter_result::Kind::unknown ? 1 : 0;
    failures += result.kind == Filter_result::Kind::fails ? 1 : 0;
  }
  EXPECT_GT(decided, rounds * 98 / 100);
  EXPECT_GT(failures, rounds / 3);
}

}  // namespace
}  // namespace kinetri::approximate_sturm_sequence_test
