// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algebraic numbers: how they are made, refined, negated and copied.
#include "kinetri/algebra/algebraic_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "support/known_numbers.h"
#include "support/precondition_error.h"

namespace kinetri::algebraic_number_test {
namespace {

using test::make_specimen;
using test::Random;
using test::some_values;
using test::Specimen;
using test::two_to;
using test::Value;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- construction ----

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

// ---- refinement ----

TEST(Algebraic_number, refinement_shrinks_the_interval_around_the_number_as_far_as_asked) {
  const std::vector<Value> values = some_values();
  for (unsigned long seed = 0; seed < test::cases(400ul); ++seed) {
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

// ---- negation, copies ----

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
}  // namespace kinetri::algebraic_number_test
