// SPDX-License-Identifier: GPL-3.0-or-later
//
// The binary64 numbers nearest to algebraic numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "support/known_numbers.h"

namespace kinetri::algebraic_number_approximation_test {
namespace {

using test::add_to;
using test::Known_polynomial;
using test::Known_root;
using test::Random;
using test::Specimen;
using test::stand_in;
using test::two_to;
using test::Value;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

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
  const Known_root truth = test::root_at(p, v);
  const Rational size = test::rounded(truth.value, 20);
  const Rational scale = size.is_zero() ? Rational(1) : abs(size);
  p.add_irrational_pair(scale * random.integer(-5, 5), scale * scale * 7, 1);
  if (random.coin()) p.add_rational(-size * Rational(7, 3) + scale, 1);
  // The exponent in isolated_root is for distances below 1: scale the polynomial's roots apart.
  const Rational center = truth.rational ? *truth.rational : test::rounded(truth.value, 4000);
  Rational distance = scale;
  for (const Known_root& other : p.roots()) {
    if (other.value == truth.value) continue;
    const Rational d = abs(test::rounded(other.value, 4000) - center);
    if (d < distance) distance = d;
  }
  const Rational lower = center - distance * Rational(random.integer(1, 8), 9);
  const Rational upper = center + distance * Rational(random.integer(1, 8), 9);
  return {Algebraic_number(square_free_part(p.polynomial()), lower, upper), truth};
}

TEST(Algebraic_number, tight_interval_has_the_two_neighbors_or_the_number_itself) {
  for (unsigned long seed = 0; seed < test::cases(25ul); ++seed) {
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

      // Without the oracle: a root at the only bound, or a change of sign between neighbors.
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
  for (unsigned long seed = 0; seed < test::cases(25ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed + 1000);
    for (const Value& v : values_of_every_magnitude(random)) {
      const Specimen s = make_scaled_specimen(v, random);
      ASSERT_EQ(s.number.to_double(), to_double(stand_in(s.truth))) << s.number;
      ASSERT_EQ(s.number.to_double(), to_double(stand_in(s.truth))) << s.number;
    }
  }
}

}  // namespace
}  // namespace kinetri::algebraic_number_approximation_test
