// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences in closed form against Euclid's algorithm, for every case of their degrees, and
// the failures that counts on the stack find against those of general algebraic numbers.
#include "algebra/static_sturm_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "algebra/count_failure.h"
#include "algebra/sturm_counter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/base/error.h"
#include "support/random_polynomials.h"

namespace kinetri::static_sturm_sequence_test {
namespace {

using test::Random;
using Wide = Stack_integer<64>;

// ---- integers ----

Integer random_integer(Random& random) {
  if (random.integer(0, 9) == 0) return random.integer(-2, 2);
  const Integer x = random.big_integer(static_cast<unsigned>(random.integer(1, 700)));
  // Runs of ones and zeros, at the bounds of words too.
  if (random.coin()) return x;
  const Integer one = 1;
  const auto bits = static_cast<unsigned>(random.integer(0, 6) * 64 + random.integer(-1, 1) + 1);
  return (one << bits) + random.integer(-1, 1);
}

TEST(Stack_integer, computes_as_gmp_does) {
  Random random(1);
  const unsigned long rounds = test::cases(20000ul);
  for (unsigned long round = 0; round < rounds; ++round) {
    const Integer x = random_integer(random);
    const Integer y = random_integer(random);
    const Wide a(x);
    const Wide b(y);
    const auto shift = static_cast<unsigned long>(random.integer(0, 200));
    ASSERT_EQ(Integer(a), x);
    ASSERT_EQ(Integer(a + b), x + y) << x << ' ' << y;
    ASSERT_EQ(Integer(a - b), x - y) << x << ' ' << y;
    ASSERT_EQ(Integer(a * b), x * y) << x << ' ' << y;
    ASSERT_EQ(Integer(-a), -x) << x;
    ASSERT_EQ(Integer(a << shift), x << shift) << x << ' ' << shift;
    Wide c = a;
    c += c;
    ASSERT_EQ(Integer(c), x * 2) << x;
    const Wide& itself = c;
    c -= itself;
    ASSERT_TRUE(c.is_zero()) << x;
    ASSERT_EQ(sign(a), sign(x));
    ASSERT_EQ(a.bit_length(), bit_length(x));
    long exponent = 0;
    const double m = a.approximation(exponent);
    const Rational error = scaled_by_power_of_two(to_rational(m), exponent) - Rational(x);
    ASSERT_LE(boost::multiprecision::abs(error),
              scaled_by_power_of_two(boost::multiprecision::abs(Rational(x)), -51))
        << x;
  }
  EXPECT_EQ(Integer(Wide(std::numeric_limits<long>::min())), std::numeric_limits<long>::min());
  EXPECT_EQ(Integer(Wide(0)), 0);
}

TEST(Stack_integer, that_is_too_wide_is_told) {
  using Small = Stack_integer<2>;
  const Small x(Integer(1) << 100);
  EXPECT_THROW(x * x, Internal_error);
  EXPECT_THROW(x << 28, Internal_error);
  EXPECT_EQ(Integer(x << 27), Integer(1) << 127);
  const Small most((Integer(1) << 128) - 1);
  EXPECT_THROW(most + Small(1), Internal_error);
  EXPECT_THROW(Small(Integer(1) << 128), Internal_error);
}

// ---- sequences ----

// Euclid's algorithm with the sign of each remainder changed; primitive terms.
std::vector<Polynomial> signed_remainders(const Polynomial& f) {
  std::vector<Polynomial> terms = {primitive_part(f)};
  Polynomial next = primitive_part(derivative(f));
  while (!next.is_zero()) {
    terms.push_back(next);
    next = primitive_part(-positive_pseudo_remainder(terms[terms.size() - 2], next));
  }
  return terms;
}

template <class Number>
void expect_terms(const Polynomial& f) {
  const Static_sturm_sequence<Number> sequence{Static_polynomial<Number>(f)};
  const std::vector<Polynomial> expected = signed_remainders(f);
  ASSERT_EQ(sequence.terms().size(), expected.size()) << f;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(primitive_part(to_polynomial(sequence.terms()[i])), expected[i]) << f << ", " << i;
  }
  ASSERT_EQ(sequence.is_square_free(), expected.back().degree() == 0) << f;
}

void expect_terms_of_all_kinds(const Polynomial& f) {
  expect_terms<Integer>(f);
  expect_terms<Wide>(f);
}

// Each gap of the remainders is among these: no quadratic term, no linear one, no leading one.
TEST(Static_sturm_sequence, is_that_of_euclid_for_all_small_coefficients) {
  std::size_t gaps = 0;
  const int most = 3;
  for (int code = 1; code < 7 * 7 * 7 * 7 * 7; ++code) {
    std::vector<Integer> c;
    for (int rest = code, i = 0; i < 5; ++i, rest /= 7) c.emplace_back(rest % 7 - most);
    const Polynomial f(c);
    if (f.is_zero()) continue;
    expect_terms<Integer>(f);
    if (code % 7 == 0) expect_terms<Wide>(f);
    if (testing::Test::HasFatalFailure()) return;
    const std::vector<Polynomial> terms = signed_remainders(f);
    for (std::size_t i = 1; i < terms.size(); ++i) {
      gaps += terms[i].degree() < terms[i - 1].degree() - 1 ? 1u : 0u;
    }
  }
  EXPECT_GT(gaps, 400u);
}

TEST(Static_sturm_sequence, is_that_of_euclid_for_wide_coefficients) {
  Random random(2);
  for (unsigned long round = 0; round < test::cases(2000ul); ++round) {
    std::vector<Integer> c;
    const long degree = random.integer(0, 4);
    const auto bits = static_cast<unsigned>(random.integer(1, 500));
    for (long i = 0; i <= degree; ++i) c.push_back(random.big_integer(bits));
    if (Polynomial(c).is_zero()) continue;
    expect_terms_of_all_kinds(Polynomial(c));
    if (testing::Test::HasFatalFailure()) return;
  }
}

// All multiplicities of at most four roots, real and complex, of either leading sign.
TEST(Static_sturm_sequence, has_the_multiple_roots_in_its_last_term) {
  Random random(3);
  const std::vector<std::vector<int>> patterns = {
      {1}, {2}, {1, 1}, {3}, {2, 1}, {4}, {3, 1}, {2, 2}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1, 1}};
  // Apart, whatever the denominators.
  const std::vector<long> far = {0, 1'000, 1'000'000, 1'000'000'000};
  for (unsigned long round = 0; round < test::cases(200ul); ++round) {
    for (const std::vector<int>& pattern : patterns) {
      Polynomial f{random.coin() ? 1 : -1};
      Polynomial repeated{1};
      int degree = 0;
      for (std::size_t k = 0; k < pattern.size(); ++k) {
        const Polynomial factor{k == 0 ? random.integer(-4, 4) : far[k] + random.integer(-4, 4),
                                random.integer(1, 3)};
        for (int i = 0; i < pattern[k]; ++i) f = f * factor;
        for (int i = 1; i < pattern[k]; ++i) repeated = repeated * factor;
        degree += pattern[k];
      }
      if (degree <= 2 && random.coin()) f = f * Polynomial{random.integer(1, 5), 0, 1};
      expect_terms_of_all_kinds(f);
      if (testing::Test::HasFatalFailure()) return;
      const Static_sturm_sequence<Wide> sequence{Static_polynomial<Wide>(f)};
      const Polynomial last = primitive_part(to_polynomial(sequence.last()));
      EXPECT_TRUE(equal_up_to_sign(last, primitive_part(repeated))) << f;
      EXPECT_EQ(sequence.changes_at_minus_infinity() - sequence.changes_at_plus_infinity(),
                static_cast<int>(pattern.size()))
          << f;
    }
  }
}

// ---- counts of any degree ----

// In intervals of numbers: with coefficients whose exponents lie far apart, roots that lie
// together, gaps of the remainders, and where terms vanish.
TEST(Sturm_counter, counts_as_the_exact_sequence_does) {
  Random random(7);
  for (unsigned long round = 0; round < test::cases(300ul); ++round) {
    std::vector<Integer> c;
    const long degree = random.integer(1, 12);
    const bool is_even = random.integer(0, 9) == 0;
    const auto spread = static_cast<long>(random.integer(0, 2) * 200);
    for (long i = 0; i <= degree; ++i) {
      c.push_back(is_even && i % 2 != 0
                      ? Integer(0)
                      : random.big_integer(40) << static_cast<unsigned>(random.integer(0, spread)));
    }
    Polynomial f(c);
    if (f.is_zero()) continue;
    if (random.coin()) {  // two roots more, that lie together
      const Integer scale = Integer(1) << static_cast<unsigned>(random.integer(1, 90));
      const Integer place = random.big_integer(80);
      f = f * Polynomial{-place, scale} * Polynomial{-place - 1, scale};
    }
    f = square_free_part(f);
    const Sturm_sequence expected(f);
    Sturm_counter counter(f);
    ASSERT_EQ(counter.changes_at_minus_infinity(), expected.sign_changes_at_minus_infinity()) << f;
    ASSERT_EQ(counter.changes_at_plus_infinity(), expected.sign_changes_at_plus_infinity()) << f;
    std::vector<Rational> places = {0, random.any_rational(), random.any_rational()};
    for (const Real_root& root : real_roots(f)) {
      const Rational_interval around = root.value.isolating_interval();
      places.insert(places.end(), {around.lower, around.upper});
    }
    for (const Rational& t : places) {
      ASSERT_EQ(counter.changes_at(t), expected.sign_changes_at(t)) << f << " at " << t;
    }
  }
}

// ---- failures ----

// The answer is that of general algebraic numbers; returns whether there was one.
bool expect_failure(const Polynomial& p, const Algebraic_number& t, bool vanishes) {
  const Counted_failure found = count_failure(Narrow_polynomial(p), t.interval(), vanishes);
  const std::optional<Algebraic_number> expected = failure_time(p, t);
  switch (found.kind) {
    case Counted_failure::Kind::unknown:
      return false;
    case Counted_failure::Kind::never_fails:
      EXPECT_FALSE(expected) << p << " from " << t;
      return true;
    case Counted_failure::Kind::at_once:
      EXPECT_TRUE(expected && *expected == t) << p << " from " << t;
      return true;
    case Counted_failure::Kind::fails:
      break;
  }
  const auto [lower, upper] = found.bounds;
  const bool is_right = expected && *expected > t && *expected > lower && *expected < upper &&
                        t.interval().upper <= lower;
  EXPECT_TRUE(is_right) << p << " from " << t << ": " << lower << ", " << upper;
  if (is_right) {
    // The one root there, of odd multiplicity: the precondition of a number of this interval.
    const Algebraic_number root(odd_part(p), to_rational(lower), to_rational(upper));
    EXPECT_EQ(root, *expected) << p;
  }
  return true;
}

TEST(Count_failure, is_the_first_one_of_random_polynomials) {
  Random random(4);
  unsigned long decided = 0;
  const unsigned long rounds = test::cases(3000ul);
  for (unsigned long round = 0; round < rounds; ++round) {
    std::vector<Integer> c;
    const long degree = random.integer(0, 4);
    const auto bits = static_cast<unsigned>(random.integer(1, 300));
    for (long i = 0; i <= degree; ++i) {
      c.push_back(random.big_integer(bits) << static_cast<unsigned>(random.integer(0, 30)));
    }
    const Polynomial p(c);
    if (p.is_zero()) continue;
    const double from = std::ldexp(static_cast<double>(random.integer(-1000, 1000)),
                                   static_cast<int>(random.integer(-12, 0)));
    decided += expect_failure(p, from, false) ? 1u : 0u;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(decided, rounds * 8 / 10);
}

// From a root of its own on, as after a flip, and from roots of others: known by intervals.
TEST(Count_failure, goes_on_from_roots) {
  Random random(5);
  unsigned long decided = 0;
  unsigned long asked = 0;
  const unsigned long rounds = test::cases(1000ul);
  for (unsigned long round = 0; round < rounds; ++round) {
    std::vector<Integer> c;
    const auto bits = static_cast<unsigned>(random.integer(3, 200));
    for (int i = 0; i <= 4; ++i) c.push_back(random.big_integer_not_zero(bits));
    const Polynomial p(c);
    const Polynomial other = p + Polynomial{random.integer(-1, 1)};
    for (const Real_root& root : real_roots(p)) {
      root.value.refine_to_bits(53);
      for (const Polynomial& next : {p, -p}) {
        decided += expect_failure(next, root.value, true) ? 1u : 0u;
        ++asked;
      }
      if (!other.is_zero()) expect_failure(other, root.value, other == p);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(decided, asked * 9 / 10);
}

// Roots close to one another: some between neighboring numbers of binary64, which it leaves to
// others, and multiple ones.
TEST(Count_failure, does_not_guess_among_roots_that_are_close) {
  Random random(6);
  unsigned long decided = 0;
  unsigned long unknown = 0;
  for (unsigned long round = 0; round < test::cases(2000ul); ++round) {
    const Integer scale = Integer(1) << static_cast<unsigned>(random.integer(2, 70));
    const Integer place = random.big_integer(static_cast<unsigned>(random.integer(1, 70)));
    Polynomial p{random.coin() ? 1 : -1};
    for (long k = random.integer(1, 4); k > 0; --k) {
      p = p * Polynomial{-(place + random.integer(-3, 3)), scale};
    }
    const double from = random.coin() ? 0.0 : to_double(Rational(place, scale));
    (expect_failure(p, from, false) ? decided : unknown) += 1;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(decided, 500u);
  EXPECT_GT(unknown, 100u);
}

// The guess in binary64 sees no root where there are two, or one where there are three.
TEST(Count_failure, is_not_misled_by_the_guess) {
  const Integer scale = Integer(1) << 70;
  for (long place = 1; place < 200; ++place) {
    // A root at place / 8 and so many parts, or at a whole number.
    const auto near = [&](long parts) {
      return Polynomial{-(place * scale + 8 * parts), 8 * scale};
    };
    const auto far = [](long whole) { return Polynomial{-whole, 1}; };
    const std::vector<Polynomial> all = {
        -(near(1) * near(-1) * far(100)), near(1) * near(-1) * far(100) * far(200),
        -(near(1) * near(0) * near(-1)), near(1) * near(0) * near(-1) * far(100)};
    for (const Polynomial& p : all) {
      ASSERT_NE(sign(p[0]), CGAL::ZERO);
      for (const double from : {0.0, -1.0, static_cast<double>(place) / 16}) {
        expect_failure(p, from, false);
      }
    }
  }
}

// Of (d t - m)^k r(t) at m / d and beside it, where r has no root: the sign of r, and its turns.
TEST(Count_sign, at_a_rational_root_is_that_of_the_other_factor) {
  Random random(7);
  for (unsigned long round = 0; round < test::cases(2000ul); ++round) {
    const auto bits = static_cast<unsigned>(random.integer(1, 150));
    const Integer m = random.big_integer(bits);
    const Integer d = random.integer(1, 50);
    const Rational t(m, d);
    const long k = random.integer(0, 4);
    Polynomial p{1};
    for (long i = 0; i < k; ++i) p = p * Polynomial{-m, d};
    std::vector<Integer> c = {random.big_integer_not_zero(40)};
    for (long i = k; i < 4; ++i) c.push_back(random.big_integer(40));
    const Polynomial r(c);
    const Sign of_r = r.sign_at(t);
    if (of_r == CGAL::ZERO) continue;
    const Narrow_polynomial narrow(p * r);
    EXPECT_EQ(count_sign(narrow, t, CGAL::ZERO), k == 0 ? of_r : CGAL::ZERO) << round;
    EXPECT_EQ(count_sign(narrow, t, CGAL::POSITIVE), of_r) << round;
    EXPECT_EQ(count_sign(narrow, t, CGAL::NEGATIVE), k % 2 == 0 ? of_r : -of_r) << round;
  }
  const Narrow_polynomial narrow(Polynomial{1, 2, 3, 4, 5});
  EXPECT_EQ(count_sign(narrow, Rational(1, Integer(1) << 1200), CGAL::ZERO), std::nullopt);
  EXPECT_EQ(count_sign(Narrow_polynomial(), Rational(1, 3), CGAL::POSITIVE), CGAL::ZERO);
}

// Up to the bound of what has room, and beyond: no integer is wider than it may be.
TEST(Count_sign, at_a_rational_time_leaves_what_is_too_wide) {
  int known = 0;
  int unknown = 0;
  const Integer one = 1;
  for (unsigned bits = 700; bits < 800; ++bits) {
    for (const unsigned coefficient_bits : {900U, 960U, 1000U, 1023U}) {
      const Integer x = (one << coefficient_bits) - 1;
      const Integer m = (one << bits) - 1;
      const Narrow_polynomial p(Polynomial{-x, x, x, -x, x});
      (count_sign(p, Rational(m, m - 2), CGAL::POSITIVE) ? known : unknown) += 1;
    }
  }
  EXPECT_GT(known, 100);
  EXPECT_GT(unknown, 100);
}

TEST(Count_failure, leaves_what_is_too_wide) {
  const Integer wide = Integer(1) << 1000;
  const Polynomial p{-wide, 3, 5, 7, wide};
  EXPECT_EQ(count_failure(Narrow_polynomial(p), {0, 0}, false).kind,
            Counted_failure::Kind::unknown);
  const Polynomial q{-1, 3, 5, 7, 9};
  EXPECT_EQ(count_failure(Narrow_polynomial(q), {0x1p-1070, 0x1p-1070}, false).kind,
            Counted_failure::Kind::unknown);
  EXPECT_EQ(count_failure(Narrow_polynomial(q), {0x1p1000, 0x1p1000}, false).kind,
            Counted_failure::Kind::unknown);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(count_failure(Narrow_polynomial(q), {0, infinity}, false).kind,
            Counted_failure::Kind::unknown);
}

}  // namespace
}  // namespace kinetri::static_sturm_sequence_test
