// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials: arithmetic by evaluation, division against a plain division over the rationals, gcd
// and multiplicities by construction.
#include "kinetri/algebra/polynomial.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/random_polynomials.h"

namespace kinetri::polynomial_test {
namespace {

using test::Random;

// The prime modulo which gcd looks for a quick proof of coprimality.
const Integer modulus("4294967291");

Sign sign_of(const Rational& x) {
  return x < 0 ? CGAL::NEGATIVE : x > 0 ? CGAL::POSITIVE : CGAL::ZERO;
}

// The value by powers, unlike Horner's rule.
Rational value_by_powers(const Polynomial& p, const Rational& t) {
  Rational result = 0;
  Rational power = 1;
  for (const Integer& c : p.coefficients()) {
    result += Rational(c) * power;
    power *= t;
  }
  return result;
}

// Schoolbook division over the rationals: the remainder.
std::vector<Rational> rational_remainder(const Polynomial& a, const Polynomial& b) {
  std::vector<Rational> r(a.coefficients().begin(), a.coefficients().end());
  const auto n = static_cast<std::size_t>(b.degree());
  while (r.size() > n) {
    const Rational q = r.back() / Rational(b.leading_coefficient());
    for (std::size_t i = 0; i <= n; ++i) {
      r[r.size() - 1 - n + i] -= q * Rational(b[static_cast<int>(i)]);
    }
    r.pop_back();
  }
  return r;
}

// --- Representation -----------------------------------------------------------------------------

TEST(Polynomial, zeros_at_the_high_end_are_dropped) {
  EXPECT_EQ((Polynomial{1, 2, 0, 0}), (Polynomial{1, 2}));
  EXPECT_EQ((Polynomial{1, 2, 0, 0}).degree(), 1);
  EXPECT_TRUE((Polynomial{0, 0}).is_zero());
  EXPECT_EQ((Polynomial{0, 0}).degree(), -1);
  EXPECT_EQ(Polynomial(std::vector<Integer>{5, 0}).degree(), 0);
  EXPECT_EQ(Polynomial().degree(), -1);
}

TEST(Polynomial, sums_that_cancel_lose_their_degree) {
  const Polynomial p{1, 2, 3};
  EXPECT_EQ(p - p, Polynomial());
  EXPECT_EQ((p + Polynomial{0, 0, -3}), (Polynomial{1, 2}));
  EXPECT_EQ((p - Polynomial{0, 2, 3}), (Polynomial{1}));
  EXPECT_EQ(p * Integer(0), Polynomial());
  EXPECT_EQ(p * Polynomial(), Polynomial());
}

TEST(Polynomial, printing_is_readable) {
  const auto text = [](const Polynomial& p) {
    std::ostringstream out;
    out << p;
    return out.str();
  };
  EXPECT_EQ(text({}), "0");
  EXPECT_EQ(text({5, -1, 3}), "3*t^2 - t + 5");
  EXPECT_EQ(text({0, 0, 0, -1}), "-t^3");
  EXPECT_EQ(text({-1}), "-1");
  EXPECT_EQ(text({1, 1}), "t + 1");
  EXPECT_EQ(text({-2, 0, -7}), "-7*t^2 - 2");
}

// --- Values and signs
// -----------------------------------------------------------------------------

TEST(Polynomial, value_and_sign_of_a_random_polynomial_agree_with_powers) {
  for (unsigned long seed = 0; seed < test::cases(3000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial p = random.polynomial(static_cast<int>(random.integer(0, 8)), 100);
    for (int i = 0; i < 3; ++i) {
      const Rational t = random.any_rational();
      const Rational value = value_by_powers(p, t);
      ASSERT_EQ(p(t), value);
      ASSERT_EQ(p.sign_at(t), sign_of(value));
    }
  }
}

TEST(Polynomial, sign_at_a_root_is_zero_for_every_kind_of_denominator) {
  for (const Rational& root : {Rational(0), Rational(7), Rational(-7), Rational(5, 8),
                               Rational(-3, 1024), Rational(2, 3), Rational(-10, 7)}) {
    const Polynomial p = test::linear_factor(root) * Polynomial{3, 1, 4, 1, 5};
    EXPECT_EQ(p.sign_at(root), CGAL::ZERO) << root.str();
    EXPECT_EQ(p(root), Rational(0)) << root.str();
    EXPECT_EQ(p.sign_at(root + Rational(1, 1000000)), sign_of(p(root + Rational(1, 1000000))));
  }
}

TEST(Polynomial, value_and_sign_of_zero_and_constants) {
  EXPECT_EQ(Polynomial()(Rational(3, 4)), Rational(0));
  EXPECT_EQ(Polynomial().sign_at(Rational(3, 4)), CGAL::ZERO);
  EXPECT_EQ((Polynomial{-4})(Rational(3, 4)), Rational(-4));
  EXPECT_EQ((Polynomial{-4}).sign_at(Rational(3, 4)), CGAL::NEGATIVE);
}

TEST(Polynomial, sign_at_infinity_is_the_sign_far_out) {
  for (unsigned long seed = 0; seed < test::cases(500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial p = random.polynomial(static_cast<int>(random.integer(0, 6)), 40);
    const Rational far = scaled_by_power_of_two(1, 60);
    ASSERT_EQ(p.sign_at_plus_infinity(), p.sign_at(far));
    ASSERT_EQ(p.sign_at_minus_infinity(), p.sign_at(-far));
  }
  EXPECT_EQ(Polynomial().sign_at_plus_infinity(), CGAL::ZERO);
  EXPECT_EQ(Polynomial().sign_at_minus_infinity(), CGAL::ZERO);
}

TEST(Polynomial, sign_on_an_interval_holds_at_every_point_of_it) {
  unsigned long decided = 0;
  const unsigned long cases = test::cases(5000ul);
  for (unsigned long seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial p = random.polynomial(static_cast<int>(random.integer(0, 6)), 30);
    // Intervals of either sign, and ones with zero inside or as an end.
    const Rational lower = random.coin() ? random.any_rational() : Rational(random.integer(-2, 1));
    const Rational width = scaled_by_power_of_two(1, random.integer(-12, 1));
    const std::optional<Sign> s = p.sign_on(lower, lower + width);
    if (!s) continue;
    ++decided;
    for (int i = 0; i <= 16; ++i) {
      const Rational t = lower + width * Rational(i, 16);
      ASSERT_EQ(p.sign_at(t), *s) << p << " at " << t.str();
    }
  }
  EXPECT_GT(decided, cases / 4) << "the test tests nothing";
}

TEST(Polynomial, sign_on_a_shrinking_interval_decides_unless_it_is_a_root) {
  const Polynomial p = test::quadratic_factor(1, 2) * test::linear_factor(Rational(-5, 3));
  for (const Rational& t :
       {Rational(1), Rational(0), Rational(-4), Rational(5, 2), Rational(-5, 3)}) {
    const Sign at_point = p.sign_at(t);
    const std::optional<Sign> decided = p.sign_on(t, t);
    if (at_point == CGAL::ZERO) {
      EXPECT_EQ(decided, std::nullopt);
      continue;
    }
    EXPECT_EQ(decided, at_point);
    const Rational tiny = scaled_by_power_of_two(1, -40);
    EXPECT_EQ(p.sign_on(t - tiny, t + tiny), at_point) << t.str();
  }
  EXPECT_EQ(p.sign_on(2, 3), std::nullopt);  // 1 + sqrt(2) is inside
  EXPECT_EQ(Polynomial().sign_on(0, 1), CGAL::ZERO);
  EXPECT_EQ((Polynomial{-3}).sign_on(0, 1), CGAL::NEGATIVE);
  EXPECT_PRECONDITION_ERROR(p.sign_on(1, 0), "the ends of the interval are not in order");
}

// --- Arithmetic
// -----------------------------------------------------------------------------------

TEST(Polynomial, arithmetic_agrees_with_arithmetic_of_values) {
  for (unsigned long seed = 0; seed < test::cases(1000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial p = random.polynomial(static_cast<int>(random.integer(0, 6)), 80);
    const Polynomial q = random.polynomial(static_cast<int>(random.integer(0, 6)), 80);
    const Integer factor = random.big_integer(70);
    const Rational t = random.any_rational();
    ASSERT_EQ((p + q)(t), p(t) + q(t));
    ASSERT_EQ((p - q)(t), p(t) - q(t));
    ASSERT_EQ((p * q)(t), p(t) * q(t));
    ASSERT_EQ((p * factor)(t), p(t) * Rational(factor));
    ASSERT_EQ((-p)(t), -p(t));
    ASSERT_EQ(derivative(p * q), derivative(p) * q + p * derivative(q));
  }
}

TEST(Polynomial, arithmetic_with_itself_or_its_own_coefficient_is_right) {
  Polynomial p{2, 3, 5};
  p *= p[0];
  EXPECT_EQ(p, (Polynomial{4, 6, 10}));
  const Polynomial& itself = p;
  p += itself;
  EXPECT_EQ(p, (Polynomial{8, 12, 20}));
  p -= itself;
  EXPECT_TRUE(p.is_zero());
}

TEST(Polynomial, derivative_of_powers_and_constants) {
  EXPECT_EQ(derivative(Polynomial()), Polynomial());
  EXPECT_EQ(derivative(Polynomial{7}), Polynomial());
  EXPECT_EQ(derivative(Polynomial{7, 5, 3, 1}), (Polynomial{5, 6, 3}));
}

// --- Content
// --------------------------------------------------------------------------------------

TEST(Polynomial, content_is_the_positive_gcd_of_the_coefficients) {
  EXPECT_EQ(content(Polynomial()), Integer(0));
  EXPECT_EQ(content(Polynomial{-6}), Integer(6));
  EXPECT_EQ(content(Polynomial{-6, 0, -9}), Integer(3));
  EXPECT_EQ(content(Polynomial{2, 3}), Integer(1));
  EXPECT_EQ(primitive_part(Polynomial()), Polynomial());
  EXPECT_EQ(primitive_part(Polynomial{-6, 0, -9}), (Polynomial{-2, 0, -3}));
  EXPECT_EQ(primitive_part(Polynomial{-6}), (Polynomial{-1}));
}

TEST(Polynomial, primitive_polynomial_is_a_positive_multiple) {
  EXPECT_EQ(primitive_polynomial(std::vector<Rational>{Rational(1, 2), Rational(-3, 4)}),
            (Polynomial{2, -3}));
  EXPECT_EQ(primitive_polynomial(std::vector<Rational>{6, 0, Rational(-9), 0}),
            (Polynomial{2, 0, -3}));
  EXPECT_EQ(primitive_polynomial(std::vector<Rational>{}), Polynomial());
  EXPECT_EQ(primitive_polynomial(std::vector<Rational>{0, 0}), Polynomial());
  for (unsigned long seed = 0; seed < test::cases(500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Rational> c;
    for (long i = random.integer(0, 4); i >= 0; --i) c.push_back(random.any_rational());
    const Polynomial p = primitive_polynomial(c);
    if (p.is_zero()) continue;
    ASSERT_EQ(content(p), Integer(1));
    const auto top = static_cast<std::size_t>(p.degree());
    const Rational ratio = c[top] / Rational(p.leading_coefficient());
    ASSERT_GT(ratio, 0);
    for (std::size_t i = 0; i <= top; ++i) {
      ASSERT_EQ(Rational(p[static_cast<int>(i)]) * ratio, c[i]);
    }
  }
}

// --- Division
// -------------------------------------------------------------------------------------

TEST(Polynomial, pseudo_remainder_is_a_positive_multiple_of_the_remainder) {
  for (unsigned long seed = 0; seed < test::cases(3000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto bits = static_cast<unsigned>(random.integer(1, 60));
    const Polynomial a = random.polynomial(static_cast<int>(random.integer(0, 7)), bits);
    const Polynomial b = random.polynomial(static_cast<int>(random.integer(0, 5)), bits);
    const Polynomial remainder = positive_pseudo_remainder(a, b);
    ASSERT_LT(remainder.degree(), std::max(b.degree(), 1));
    ASSERT_EQ(primitive_part(remainder), primitive_polynomial(rational_remainder(a, b)));
  }
}

TEST(Polynomial, pseudo_remainder_with_zero_is_zero_or_refused) {
  EXPECT_EQ(positive_pseudo_remainder(Polynomial(), Polynomial{1, 1}), Polynomial());
  EXPECT_PRECONDITION_ERROR(positive_pseudo_remainder(Polynomial{1}, Polynomial()),
                            "the divisor is zero");
}

TEST(Polynomial, exact_quotient_undoes_a_product) {
  for (unsigned long seed = 0; seed < test::cases(1000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial q = random.polynomial(static_cast<int>(random.integer(0, 6)), 90);
    const Polynomial b =
        primitive_part(random.polynomial(static_cast<int>(random.integer(0, 6)), 90));
    ASSERT_EQ(exact_quotient(q * b, b), q);
  }
  EXPECT_EQ(exact_quotient(Polynomial(), Polynomial{1, 1}), Polynomial());
}

TEST(Polynomial, exact_quotient_by_a_non_divisor_is_refused) {
  EXPECT_PRECONDITION_ERROR(exact_quotient(Polynomial{1, 0, 1}, Polynomial{1, 1}),
                            "the divisor leaves a remainder");
  EXPECT_PRECONDITION_ERROR(exact_quotient(Polynomial{1, 1}, Polynomial{1, 0, 1}),
                            "the divisor leaves a remainder");
  EXPECT_PRECONDITION_ERROR(exact_quotient(Polynomial{1, 1}, Polynomial()), "the divisor is zero");
}

// --- gcd
// ------------------------------------------------------------------------------------------

// Factors that are coprime to one another: t - i, t^2 - p and t^2 + p for primes p, and big ones.
std::vector<Polynomial> coprime_factors() {
  std::vector<Polynomial> result;
  for (long i = -4; i <= 4; ++i) result.push_back(test::linear_factor(Rational(2 * i + 1, 3)));
  for (const long p : {2L, 3L, 5L, 7L}) {
    result.push_back(Polynomial{-p, 0, 1});
    result.push_back(Polynomial{p, 0, 1});
  }
  result.push_back(Polynomial{Integer("123456789012345678901234567891"), 1});
  result.push_back(Polynomial{1, modulus});
  result.push_back(Polynomial{1, 0, modulus * 2});
  return result;
}

TEST(Polynomial, gcd_of_products_is_the_product_of_the_common_factors) {
  const std::vector<Polynomial> factors = coprime_factors();
  for (unsigned long seed = 0; seed < test::cases(1500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Polynomial a{random.big_integer_not_zero(20)};
    Polynomial b{random.big_integer_not_zero(20)};
    Polynomial common{1};
    for (const Polynomial& f : factors) {
      if (random.integer(0, 2) != 0) continue;
      const long in_a = random.integer(0, 2);
      const long in_b = random.integer(0, 2);
      for (long i = 0; i < in_a; ++i) a = a * f;
      for (long i = 0; i < in_b; ++i) b = b * f;
      for (long i = 0; i < std::min(in_a, in_b); ++i) common = common * f;
    }
    ASSERT_EQ(gcd(a, b), common) << a << " and " << b;
  }
}

TEST(Polynomial, gcd_with_zero_is_the_primitive_part_with_positive_lead) {
  EXPECT_EQ(gcd(Polynomial(), Polynomial()), Polynomial());
  EXPECT_EQ(gcd(Polynomial{4, -6}, Polynomial()), (Polynomial{-2, 3}));
  EXPECT_EQ(gcd(Polynomial(), Polynomial{4, -6}), (Polynomial{-2, 3}));
  EXPECT_EQ(gcd(Polynomial(), Polynomial{-6}), (Polynomial{1}));
}

TEST(Polynomial, gcd_with_a_constant_is_one) {
  EXPECT_EQ(gcd(Polynomial{12}, Polynomial{18}), (Polynomial{1}));
  EXPECT_EQ(gcd(Polynomial{12}, Polynomial{0, 18}), (Polynomial{1}));
}

TEST(Polynomial, gcd_is_not_misled_by_the_modulus) {
  // Equal modulo the prime, coprime over the integers.
  EXPECT_EQ(gcd(Polynomial{1, 1}, Polynomial{modulus + 1, 1}), (Polynomial{1}));
  // The common factor is a constant modulo the prime: only the leading coefficients tell.
  const Polynomial common{1, modulus};
  EXPECT_EQ(gcd(common * Polynomial{-3, 1}, common * Polynomial{-5, 1}), common);
  // One polynomial vanishes modulo the prime but for its constant term, or altogether.
  EXPECT_EQ(gcd(common, Polynomial{-5, 1}), (Polynomial{1}));
  EXPECT_EQ(gcd(Polynomial{-5, 1} * modulus, Polynomial{-5, 1}), (Polynomial{-5, 1}));
  EXPECT_EQ(gcd(Polynomial{modulus, 0, modulus, 1}, Polynomial{0, 1}), (Polynomial{1}));
}

// --- Multiplicities ---------------------------------------------------------------------------

TEST(Polynomial, square_free_decomposition_gives_the_multiplicities_of_the_construction) {
  const std::vector<Polynomial> factors = coprime_factors();
  for (unsigned long seed = 0; seed < test::cases(300ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Integer constant = random.big_integer_not_zero(20);
    Polynomial p{constant};
    Polynomial simple{constant < 0 ? -1 : 1};
    Polynomial odd = simple;
    std::map<int, Polynomial> expected;
    for (const Polynomial& f : factors) {
      if (random.integer(0, 3) != 0) continue;
      const int multiplicity = static_cast<int>(random.integer(1, 5));
      for (int i = 0; i < multiplicity; ++i) p = p * f;
      simple = simple * f;
      if (multiplicity % 2 != 0) odd = odd * f;
      const auto [place, is_new] = expected.try_emplace(multiplicity, f);
      if (!is_new) place->second = place->second * f;
    }
    const std::vector<Square_free_factor> found = square_free_decomposition(p);
    ASSERT_EQ(found.size(), expected.size());
    auto next = expected.begin();
    for (const Square_free_factor& f : found) {
      ASSERT_EQ(f.multiplicity, next->first);
      ASSERT_EQ(f.factor, next->second);
      ++next;
    }
    ASSERT_EQ(square_free_part(p), simple);
    ASSERT_EQ(odd_part(p), odd);
  }
}

TEST(Polynomial, odd_part_has_the_sign_of_the_polynomial_where_that_is_not_zero) {
  for (unsigned long seed = 0; seed < test::cases(500ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const test::Known_polynomial known = test::random_known_polynomial(random, 10, 4);
    const Polynomial odd = odd_part(known.polynomial());
    for (int i = 0; i < 10; ++i) {
      const Rational t = random.any_rational();
      const Sign s = known.polynomial().sign_at(t);
      if (s != CGAL::ZERO) {
        ASSERT_EQ(odd.sign_at(t), s);
      }
    }
  }
}

TEST(Polynomial, multiplicities_of_constants_are_none) {
  EXPECT_TRUE(square_free_decomposition(Polynomial{-6}).empty());
  EXPECT_EQ(square_free_part(Polynomial{-6}), (Polynomial{-1}));
  EXPECT_EQ(odd_part(Polynomial{-6}), (Polynomial{-1}));
}

TEST(Polynomial, multiplicities_of_zero_are_refused) {
  EXPECT_PRECONDITION_ERROR(square_free_part(Polynomial()),
                            "every number is a root of the zero polynomial");
  EXPECT_PRECONDITION_ERROR(square_free_decomposition(Polynomial()),
                            "every number is a root of the zero polynomial");
  EXPECT_PRECONDITION_ERROR(odd_part(Polynomial()), "the zero polynomial has no sign");
}

}  // namespace
}  // namespace kinetri::polynomial_test
