// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algebraic numbers: order, approximation, signs of polynomials at them. The numbers are a +
// sqrt(c) and rationals in disguise, so that 6000 bits of each are known, and equality by
// construction.
#include "kinetri/algebra/algebraic_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "../support/random_polynomials.h"
#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri {
namespace {

using test::Known_polynomial;
using test::Known_root;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

Rational two_to(long exponent) {
  return scaled_by_power_of_two(1, exponent);
}

// A number and what is known about it.
struct Specimen {
  Algebraic_number number;
  Known_root truth;
};

// The position of the root a + sqrt(c), or of the rational a where c is zero.
struct Value {
  Rational a;
  Rational c;
};

void add_to(Known_polynomial& p, const Value& v) {
  if (v.c.is_zero()) {
    p.add_rational(v.a, 1);
  } else {
    p.add_irrational_pair(v.a, v.c, 1);
  }
}

// The number `v` as a root of a random polynomial, or as a plain rational.
Specimen make_specimen(const Value& v, const std::vector<Value>& others, Random& random) {
  Known_polynomial p(random.coin() ? 1 : -3);
  add_to(p, v);
  const bool plain = v.c.is_zero() && random.integer(0, 2) == 0;
  if (!plain) {
    for (long i = random.integer(v.c.is_zero() ? 1 : 0, 2); i > 0; --i) {
      add_to(p, random.pick(others));
    }
    if (p.degree() == 1 || random.coin()) p.add_rootless(random.integer(-2, 2), 1, 1);
  }
  const test::Big_float value =
      v.c.is_zero() ? test::oracle_value(v.a) : test::oracle_value(v.a, v.c, true);
  for (const Known_root& root : p.roots()) {
    if (root.value != value) continue;
    if (plain) return {Algebraic_number(v.a), root};
    return {test::isolated_root(p, root, random), root};
  }
  throw Internal_error("the polynomial lacks the root that it was given");
}

// Equal, far and nearly equal numbers of either sign.
std::vector<Value> some_values() {
  std::vector<Value> result;
  const Rational tiny = two_to(-250);
  for (const Value& v :
       {Value{0, 0}, Value{Rational(1, 3), 0}, Value{to_rational(0.1), 0}, Value{1, 2},
        Value{-4, 3}, Value{0, 2}, Value{-3, 2}, Value{Rational(-22, 7), 0}, Value{5, 0}}) {
    result.push_back(v);
    result.push_back({v.a + tiny, v.c});
    if (!v.c.is_zero()) result.push_back({v.a, v.c * (1 + tiny)});
  }
  result.push_back({Rational(1, 10), 0});
  result.push_back({0, two_to(-400) * 5});
  return result;
}

Comparison_result order_of(const Known_root& a, const Known_root& b) {
  const int order = mpfr_cmp(a.value.backend().data(), b.value.backend().data());
  return order < 0 ? CGAL::SMALLER : order > 0 ? CGAL::LARGER : CGAL::EQUAL;
}

// --- Construction
// ---------------------------------------------------------------------------------

TEST(Algebraic_number, default_is_zero_and_rationals_are_known_as_such) {
  const Algebraic_number zero;
  EXPECT_TRUE(zero.is_known_rational());
  EXPECT_EQ(zero.rational(), Rational(0));
  EXPECT_EQ(zero.interval(), (Double_interval{0.0, 0.0}));

  const Algebraic_number third(Rational(1, 3));
  EXPECT_EQ(third.rational(), Rational(1, 3));
  EXPECT_EQ(third.lower(), Rational(1, 3));
  EXPECT_EQ(third.upper(), Rational(1, 3));
  EXPECT_EQ(third.polynomial(), (Polynomial{-1, 3}));
  EXPECT_EQ(third.interval(), to_interval(Rational(1, 3)));

  const Algebraic_number tenth(0.1);
  EXPECT_EQ(tenth.rational(), to_rational(0.1));
  EXPECT_EQ(tenth.interval(), (Double_interval{0.1, 0.1}));
}

TEST(Algebraic_number, root_of_a_line_is_known_to_be_rational) {
  const Algebraic_number root(Polynomial{-2, 6}, 0, 1);
  EXPECT_TRUE(root.is_known_rational());
  EXPECT_EQ(root.rational(), Rational(1, 3));
}

TEST(Algebraic_number, root_keeps_primitive_polynomial_and_isolating_interval) {
  const Algebraic_number root(Polynomial{-4, 0, 2}, Rational(4, 3), Rational(3, 2));
  EXPECT_FALSE(root.is_known_rational());
  EXPECT_EQ(root.polynomial(), (Polynomial{-2, 0, 1}));
  EXPECT_GE(root.lower(), Rational(4, 3));
  EXPECT_LE(root.upper(), Rational(3, 2));
  EXPECT_LT(root.lower() * root.lower(), 2);
  EXPECT_GT(root.upper() * root.upper(), 2);
  EXPECT_PRECONDITION_ERROR(root.rational(),
                            "the number is not known to be rational; ask is_known_rational first");
}

TEST(Algebraic_number, root_very_near_to_an_end_is_isolated_by_dyadic_ends) {
  // sqrt(2) is just above the lower end, then just below the upper one; neither end is dyadic.
  const Rational near = test::rounded(test::oracle_value(0, 2, true), 200);
  const Polynomial p{-2, 0, 1};
  const Rational below = near - two_to(-190) / 3;
  const Rational above = near + two_to(-190) / 3;
  for (const Algebraic_number& root :
       {Algebraic_number(p, below, 5), Algebraic_number(p, Rational(1, 3), above)}) {
    EXPECT_EQ(compare(root, below), CGAL::LARGER);
    EXPECT_EQ(compare(root, above), CGAL::SMALLER);
  }
}

TEST(Algebraic_number, root_at_zero_or_at_a_grid_point_is_found_to_be_rational) {
  const Algebraic_number zero(Polynomial{0, -5, -4, 1}, Rational(-1, 2), Rational(1, 3));
  EXPECT_TRUE(zero.is_known_rational());
  EXPECT_EQ(zero.rational(), Rational(0));
  const Algebraic_number one(Polynomial{-1, 0, 0, 1}, Rational(-1, 3), Rational(7, 3));
  one.refine_to(two_to(-500));
  EXPECT_EQ(one, Algebraic_number(1.0));
}

TEST(Algebraic_number, construction_preconditions_are_checked) {
  const Polynomial p{-2, 0, 1};
  EXPECT_PRECONDITION_ERROR(Algebraic_number(p, 2, 1), "the isolating interval is empty");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(p, 1, 1), "the isolating interval is empty");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(p, 2, 3),
                            "the polynomial does not change sign over the isolating interval");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(p, -2, 2),
                            "the polynomial does not change sign over the isolating interval");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(Polynomial{-1, 1}, 1, 2),
                            "the polynomial does not change sign over the isolating interval");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(Polynomial{-1, 1}, 0, 1),
                            "the polynomial does not change sign over the isolating interval");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(Polynomial{5}, 0, 1),
                            "a polynomial without roots has no root to isolate");
  EXPECT_PRECONDITION_ERROR(Algebraic_number(Polynomial(), 0, 1),
                            "a polynomial without roots has no root to isolate");
  EXPECT_PRECONDITION_ERROR(Algebraic_number{infinity}, "an infinity or a NaN is no number");
  EXPECT_PRECONDITION_ERROR(
      Algebraic_number(1.0).refine_to(0),
      "an irrational number has no interval of width 0; ask for a greater one");
}

TEST(Algebraic_number, prints_the_rational_or_the_polynomial_with_an_interval) {
  std::ostringstream out;
  out << Algebraic_number(Rational(-3, 4)) << "; " << Algebraic_number(Polynomial{-2, 0, 1}, 1, 2);
  EXPECT_EQ(out.str(), "-3/4; root of t^2 - 2 in (1, 2)");
}

// --- Refinement ---------------------------------------------------------------------------------

TEST(Algebraic_number, refinement_shrinks_the_interval_around_the_number_as_far_as_asked) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::scaled_count(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Specimen s = make_specimen(random.pick(values), values, random);
    for (int i = 0; i < 4; ++i) {
      const Rational lower = s.number.lower();
      const Rational upper = s.number.upper();
      const Rational width = two_to(-random.integer(0, 400)) * random.integer(1, 9);
      const auto bits = static_cast<unsigned>(random.integer(0, 400));
      const long kind = random.integer(0, 2);
      if (kind == 0) s.number.refine();
      if (kind == 1) s.number.refine_to(width);
      if (kind == 2) s.number.refine_to_bits(bits);
      ASSERT_TRUE(test::is_the_number(s.number, s.truth));
      ASSERT_GE(s.number.lower(), lower);
      ASSERT_LE(s.number.upper(), upper);
      const Rational now = s.number.upper() - s.number.lower();
      if (kind == 0) {
        ASSERT_LE(now * 2, upper - lower);
      }
      if (kind == 1) {
        ASSERT_LE(now, width);
      }
      if (kind == 2) {
        const Rational size = std::min<Rational>(abs(s.number.lower()), abs(s.number.upper()));
        ASSERT_LE(scaled_by_power_of_two(now, static_cast<long>(bits)), size);
      }
      ASSERT_LE(s.number.interval().lower, to_interval(s.number.lower()).upper);
      ASSERT_GE(s.number.interval().upper, to_interval(s.number.upper()).lower);
    }
  }
}

TEST(Algebraic_number, copies_share_their_refinement) {
  const Algebraic_number number(Polynomial{-2, 0, 1}, 1, 2);
  const Algebraic_number copy(number);  // NOLINT(performance-unnecessary-copy-initialization)
  copy.refine_to(two_to(-100));
  EXPECT_LE(number.upper() - number.lower(), two_to(-100));
  EXPECT_EQ(number, copy);
}

TEST(Algebraic_number, equal_numbers_get_the_common_factor_as_their_polynomial) {
  const Polynomial p = Polynomial{-2, 0, 1} * Polynomial{-3, 0, 1};
  const Algebraic_number number(p, Rational(4, 3), Rational(3, 2));
  EXPECT_EQ(number.polynomial(), p);
  EXPECT_EQ(number, Algebraic_number((Polynomial{-2, 0, 1} * Polynomial{-5, 0, 1}), 1, 2));
  // The common factor is what both are compared by from now on.
  EXPECT_EQ(number.polynomial(), (Polynomial{-2, 0, 1}));
}

// --- Order --------------------------------------------------------------------------------------

TEST(Algebraic_number, order_of_a_pool_with_equal_and_nearly_equal_numbers_is_the_true_one) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::scaled_count(60); ++seed) {
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
  for (unsigned long seed = 0; seed < test::scaled_count(20); ++seed) {
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
  for (unsigned long seed = 0; seed < test::scaled_count(600); ++seed) {
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

// --- Approximation
// --------------------------------------------------------------------------------

// Numbers of every magnitude a binary64 number has, and beyond; rationals are in disguise.
std::vector<Value> values_of_every_magnitude(Random& random) {
  std::vector<Value> result = {{0, 0},
                               {to_rational(smallest), 0},
                               {-to_rational(smallest), 0},
                               {to_rational(1e-310), 0},
                               {to_rational(1e-310) + two_to(-1075), 0},
                               {to_rational(std::numeric_limits<double>::min()), 0},
                               {to_rational(largest), 0},
                               {-to_rational(largest), 0},
                               {to_rational(largest) + two_to(970), 0},
                               {two_to(1024), 0},
                               {two_to(-1075), 0},
                               {two_to(-1075) * 3, 0},
                               {two_to(-1400) / 3, 0},
                               {1 + two_to(-53), 0},
                               {1 + two_to(-52), 0},
                               {1 + two_to(-53) * 3, 0},
                               {Rational(1, 3), 0}};
  for (const long exponent : {-1500L, -1080L, -1076L, -1075L, -1074L, -1070L, -1030L, -1000L, -100L,
                              0L, 100L, 1000L, 1022L, 1023L, 1024L, 1100L}) {
    result.push_back({0, two_to(2 * exponent) * test::random_non_square(random)});
  }
  for (int i = 0; i < 20; ++i) {
    const Rational a = random.dyadic(60, -1100, 960);
    result.push_back({a, 0});
    result.push_back({a, a * a * two_to(-random.integer(0, 300)) * 3 + two_to(-2500) * 2});
  }
  return result;
}

// A specimen whose polynomial has a few roots of similar magnitude.
Specimen make_scaled_specimen(const Value& v, Random& random) {
  Known_polynomial p(random.coin() ? 1 : -1);
  add_to(p, v);
  const Known_root truth = [&] {
    const test::Big_float value =
        v.c.is_zero() ? test::oracle_value(v.a) : test::oracle_value(v.a, v.c, true);
    for (const Known_root& root : p.roots()) {
      if (root.value == value) return root;
    }
    throw Internal_error("the polynomial lacks the root that it was given");
  }();
  const Rational size = test::rounded(truth.value, 20);
  const Rational scale = size.is_zero() ? Rational(1) : abs(size);
  p.add_irrational_pair(scale * random.integer(-5, 5), scale * scale * 7, 1);
  if (random.coin()) p.add_rational(-size * Rational(7, 3) + scale, 1);
  // The exponent in isolated_root is for distances below 1: scale the polynomial's roots apart.
  const Rational centre = truth.rational ? *truth.rational : test::rounded(truth.value, 4000);
  Rational distance = scale;
  for (const Known_root& other : p.roots()) {
    if (other.value == truth.value) continue;
    const Rational d = abs(test::rounded(other.value, 4000) - centre);
    if (d < distance) distance = d;
  }
  const Rational lower = centre - distance * Rational(random.integer(1, 8), 9);
  const Rational upper = centre + distance * Rational(random.integer(1, 8), 9);
  return {Algebraic_number(square_free_part(p.polynomial()), lower, upper), truth};
}

// The rational itself, or one that has no binary64 number, or tie, between it and the number.
Rational stand_in(const Known_root& truth) {
  return truth.rational ? *truth.rational : test::rounded(truth.value, 5000);
}

TEST(Algebraic_number, tight_interval_has_the_two_neighbours_or_the_number_itself) {
  for (unsigned long seed = 0; seed < test::scaled_count(25); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    for (const Value& v : values_of_every_magnitude(random)) {
      const Specimen s = make_scaled_specimen(v, random);
      // Not to depend on the state of refinement.
      const long bits = random.integer(-20, 70);
      if (bits > 0) s.number.refine_to_bits(static_cast<unsigned>(bits));
      const Rational from = s.number.lower();
      const Rational to = s.number.upper();
      const Polynomial p = s.number.polynomial();
      const Double_interval tight = s.number.tight_interval();
      ASSERT_EQ(tight, to_interval(stand_in(s.truth))) << s.number;
      ASSERT_EQ(s.number.tight_interval(), tight);
      s.number.refine_to_bits(80);
      ASSERT_EQ(s.number.tight_interval(), tight);

      // Without the oracle: a root at the only bound, or a change of sign between neighbours.
      if (tight.lower == tight.upper) {
        ASSERT_EQ(p.sign_at(to_rational(tight.lower)), CGAL::ZERO);
        continue;
      }
      ASSERT_EQ(std::nextafter(tight.lower, infinity), tight.upper);
      if (from == to) continue;
      Rational lower = from;
      Rational upper = to;
      if (std::isfinite(tight.lower)) lower = std::max(lower, to_rational(tight.lower));
      if (std::isfinite(tight.upper)) upper = std::min(upper, to_rational(tight.upper));
      ASSERT_NE(p.sign_at(lower), CGAL::ZERO);
      ASSERT_EQ(p.sign_at(lower), -p.sign_at(upper));
    }
  }
}

TEST(Algebraic_number, tight_interval_of_a_root_that_is_a_binary64_number_is_that_number) {
  // (t - x) (3 t^2 - t - 5) with x an end of no bisection grid that starts at thirds.
  for (const double x : {0.1, 1e-310, 3.0, -0.7, 1e300, smallest, largest, 1.0 + 0x1p-52}) {
    const Rational exact = to_rational(x);
    const Rational a = exact * Rational(2, 3);
    const Rational b = exact * Rational(4, 3);
    const Polynomial p = test::linear_factor(exact) * Polynomial{7, -1, 3};
    const Algebraic_number root(p, std::min(a, b), std::max(a, b));
    EXPECT_EQ(root.tight_interval(), (Double_interval{x, x}));
    EXPECT_TRUE(root.is_known_rational());
    EXPECT_EQ(root.to_double(), x);
  }
}

TEST(Algebraic_number, tight_interval_beyond_the_range_ends_at_infinity_or_at_the_smallest_number) {
  const auto root_of_two_times = [](long exponent) {
    const Rational c = two_to(2 * exponent) * 2;
    return Algebraic_number(test::quadratic_factor(0, c), 0, two_to(exponent + 2));
  };
  EXPECT_EQ(root_of_two_times(1100).tight_interval(), (Double_interval{largest, infinity}));
  EXPECT_EQ(root_of_two_times(1100).to_double(), infinity);
  EXPECT_EQ(root_of_two_times(-1500).tight_interval(), (Double_interval{0.0, smallest}));
  EXPECT_EQ(root_of_two_times(-1500).to_double(), 0.0);
  EXPECT_EQ(root_of_two_times(-1075).to_double(), smallest);
}

TEST(Algebraic_number, to_double_is_the_nearest_ties_to_even) {
  for (unsigned long seed = 0; seed < test::scaled_count(25); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed + 1000);
    for (const Value& v : values_of_every_magnitude(random)) {
      const Specimen s = make_scaled_specimen(v, random);
      ASSERT_EQ(s.number.to_double(), to_double(stand_in(s.truth))) << s.number;
      ASSERT_EQ(s.number.to_double(), to_double(stand_in(s.truth))) << s.number;
    }
  }
}

// --- Signs of polynomials
// -------------------------------------------------------------------------

// The sign at, or just before or after, the root by construction.
Sign sign_by_construction(const Known_polynomial& p, const Known_root& t, int side) {
  int s = p.polynomial().sign_at_plus_infinity();
  for (const Known_root& root : p.roots()) {
    if (root.value == t.value) {
      if (side == 0) return CGAL::ZERO;
      if (side < 0 && root.multiplicity % 2 != 0) s = -s;
    } else if (root.value > t.value && root.multiplicity % 2 != 0) {
      s = -s;
    }
  }
  return static_cast<Sign>(s);
}

TEST(Sign_at, an_algebraic_number_is_the_sign_by_construction) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::scaled_count(1200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Value& v = random.pick(values);
    const Specimen t = make_specimen(v, values, random);
    Known_polynomial p(random.big_integer_not_zero(6));
    for (long i = random.integer(0, 2); i > 0; --i) {
      const Value& other = random.pick(values);
      const int multiplicity = static_cast<int>(random.integer(1, 3));
      if (other.c.is_zero()) {
        p.add_rational(other.a, multiplicity);
      } else {
        p.add_irrational_pair(other.a, other.c, multiplicity);
      }
    }
    if (random.coin()) {
      const int multiplicity = static_cast<int>(random.integer(1, 4));
      if (v.c.is_zero()) {
        p.add_rational(v.a, multiplicity);
      } else {
        p.add_irrational_pair(v.a, v.c, multiplicity);
      }
    }
    if (random.integer(0, 3) == 0) p.add_rootless(1, 1, 1);

    const Sign expected = sign_by_construction(p, t.truth, 0);
    ASSERT_EQ(sign_at(p.polynomial(), t.number), expected) << p.polynomial() << "; " << t.number;
    ASSERT_EQ(t.number.is_root_of(p.polynomial()), expected == CGAL::ZERO);
    ASSERT_EQ(sign_just_before(p.polynomial(), t.number), sign_by_construction(p, t.truth, -1));
    ASSERT_EQ(sign_just_after(p.polynomial(), t.number), sign_by_construction(p, t.truth, 1));
    ASSERT_TRUE(test::is_the_number(t.number, t.truth));
  }
}

TEST(Sign_at, the_numbers_own_polynomial_is_zero_and_its_sides_differ) {
  const Polynomial p{-2, 0, 1};
  const Algebraic_number root(p, 1, 2);
  for (const Polynomial& q : {p, p * Integer(3)}) {
    EXPECT_EQ(sign_at(q, root), CGAL::ZERO);
    EXPECT_EQ(sign_just_before(q, root), CGAL::NEGATIVE);
    EXPECT_EQ(sign_just_after(q, root), CGAL::POSITIVE);
    EXPECT_EQ(sign_just_before(-q, root), CGAL::POSITIVE);
    EXPECT_EQ(sign_just_after(-q, root), CGAL::NEGATIVE);
  }
  EXPECT_EQ(sign_at(root.polynomial(), root), CGAL::ZERO);
}

TEST(Sign_at, zero_and_constant_polynomials_need_no_number) {
  for (const Algebraic_number& t :
       {Algebraic_number(2.5), Algebraic_number(Polynomial{-2, 0, 1}, 1, 2)}) {
    EXPECT_EQ(sign_at(Polynomial(), t), CGAL::ZERO);
    EXPECT_EQ(sign_just_before(Polynomial(), t), CGAL::ZERO);
    EXPECT_EQ(sign_just_after(Polynomial(), t), CGAL::ZERO);
    EXPECT_TRUE(t.is_root_of(Polynomial()));
    EXPECT_EQ(sign_at(Polynomial{-3}, t), CGAL::NEGATIVE);
    EXPECT_EQ(sign_just_before(Polynomial{-3}, t), CGAL::NEGATIVE);
    EXPECT_EQ(sign_just_after(Polynomial{-3}, t), CGAL::NEGATIVE);
    EXPECT_FALSE(t.is_root_of(Polynomial{-3}));
  }
}

// --- The simplest number between ----------------------------------------------------------------

// Tries every exponent from far too small on.
Rational simplest_by_trial(const Rational& a, const Rational& b) {
  if (a < 0 && b > 0) return 0;
  for (long e = -80;; ++e) {
    // The multiples of 2^-e next to the end nearer to zero, and their neighbours.
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
  for (unsigned long seed = 0; seed < test::scaled_count(500); ++seed) {
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

TEST(Algebraic_number, negative_is_mirrored_at_zero) {
  const Algebraic_number root(Polynomial{-2, 1, 0, 3}, Rational(0), Rational(1));
  const Algebraic_number negative = -root;
  EXPECT_LT(negative, Algebraic_number());
  EXPECT_EQ(-negative, root);
  // 3 t^3 + t - 2 at -t
  EXPECT_TRUE(negative.is_root_of(Polynomial{2, 1, 0, 3}));
  EXPECT_EQ(negative.to_double(), -root.to_double());
  EXPECT_EQ(negative.tight_interval(),
            (Double_interval{-root.tight_interval().upper, -root.tight_interval().lower}));
  EXPECT_EQ(-Algebraic_number(Rational(2, 3)), Algebraic_number(Rational(-2, 3)));
  EXPECT_EQ(-Algebraic_number(1.5), Algebraic_number(-1.5));
  EXPECT_FALSE(std::signbit((-Algebraic_number()).to_double())) << "zero has no sign";
}

TEST(Algebraic_number, detached_is_the_same_number_and_shares_nothing) {
  const Algebraic_number root(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  for (const Algebraic_number& number :
       {root, Algebraic_number(0.5), Algebraic_number(Rational(1, 3))}) {
    const Algebraic_number copy = number.detached();
    copy.refine_to(Rational(1, 1000000));
    EXPECT_EQ(copy, number.detached());
    EXPECT_EQ(copy, number);
  }
  const Algebraic_number copy = root.detached();
  copy.refine_to(Rational(1, 1000000));
  EXPECT_GT(root.detached().upper() - root.detached().lower(), copy.upper() - copy.lower());
}

}  // namespace
}  // namespace kinetri
