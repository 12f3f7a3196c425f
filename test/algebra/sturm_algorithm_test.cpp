// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 of the paper for cubics and quartics, on every pattern of multiplicities.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "support/precondition_error.h"
#include "support/random_polynomials.h"

namespace kinetri::sturm_algorithm_test {
namespace {

using test::are_the_roots;
using test::Known_polynomial;
using test::Random;

// The multiplicities of the real roots in order, as `2 1`.
std::string pattern(const std::vector<Real_root>& roots) {
  std::string result;
  for (const Real_root& root : roots) {
    result += (result.empty() ? "" : " ") + std::to_string(root.multiplicity);
  }
  return result;
}

// All ways to make up `degree` from rational roots, irrational pairs and complex pairs with
// multiplicities, tried at random, with the patterns counted.
Known_polynomial random_pattern(Random& random, int degree) {
  Known_polynomial p(random.big_integer_not_zero(10));
  while (p.degree() < degree) {
    const int room = degree - p.degree();
    const long kind = random.integer(0, 2);
    const int most = kind == 0 ? room : room / 2;
    if (most == 0) continue;
    const int multiplicity = static_cast<int>(random.integer(1, most));
    const Rational a = random.coin() ? Rational(random.integer(-2, 2)) : random.any_rational();
    if (kind == 0) p.add_rational(a, multiplicity);
    if (kind == 1) p.add_irrational_pair(a, test::random_non_square(random), multiplicity);
    if (kind == 2) p.add_rootless(a, random.rational(6), multiplicity);
  }
  return p;
}

using Algorithm = std::function<std::vector<Real_root>(const Polynomial&)>;

// Each pattern that there is must come up.
void check_patterns(int degree, unsigned long cases, const Algorithm& solve,
                    const std::vector<std::string>& patterns) {
  std::map<std::string, unsigned long> counts;
  for (unsigned long seed = 0; seed < test::cases(cases); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Known_polynomial p = random_pattern(random, degree);
    const std::vector<Real_root> roots = solve(p.polynomial());
    ASSERT_TRUE(are_the_roots(roots, p.roots())) << p.polynomial();
    ASSERT_EQ(pattern(solve(-p.polynomial())), pattern(roots)) << p.polynomial();
    ++counts[pattern(roots)];
  }
  for (const std::string& expected : patterns) EXPECT_GT(counts[expected], 0U) << expected;
  EXPECT_EQ(counts.size(), patterns.size());
}

TEST(Sturm3, finds_the_roots_of_every_pattern_of_multiplicities) {
  check_patterns(3, 1000, sturm3, {"1", "3", "1 2", "2 1", "1 1 1"});
}

TEST(Sturm4, finds_the_roots_of_every_pattern_of_multiplicities) {
  check_patterns(4, 2000, sturm4,
                 {"", "2", "4", "1 1", "1 3", "3 1", "2 2", "1 1 2", "1 2 1", "2 1 1", "1 1 1 1"});
}

TEST(Sturm3, has_a_triple_root_where_the_last_term_is_a_square) {
  const std::vector<Real_root> roots = sturm3(Polynomial{-8, 12, -6, 1});
  ASSERT_EQ(pattern(roots), "3");
  EXPECT_EQ(roots[0].value, Algebraic_number(2.0));
}

TEST(Sturm3, has_a_double_and_a_simple_root_where_the_last_term_is_linear) {
  // (3 t - 1)^2 (t + 5): both are rational.
  const std::vector<Real_root> roots = sturm3(Polynomial{5, -29, 39, 9});
  ASSERT_EQ(pattern(roots), "1 2");
  EXPECT_EQ(roots[0].value, Algebraic_number(-5.0));
  EXPECT_EQ(roots[1].value, Algebraic_number(Rational(1, 3)));
}

TEST(Sturm4, has_irrational_double_roots_where_the_last_term_is_quadratic) {
  const std::vector<Real_root> real = sturm4(Polynomial{4, 0, -4, 0, 1});
  ASSERT_EQ(real.size(), 2U);
  EXPECT_EQ(real[0].multiplicity, 2);
  EXPECT_EQ(real[1].multiplicity, 2);
  EXPECT_EQ(real[1].value, Algebraic_number(Polynomial{-2, 0, 1}, 1, 2));
  EXPECT_TRUE(sturm4(Polynomial{1, 0, 2, 0, 1}).empty());
  const std::vector<Real_root> triple = sturm4(Polynomial{0, 1} * Polynomial{-1, 3, -3, 1});
  ASSERT_EQ(triple.size(), 2U);
  EXPECT_EQ(triple[0].multiplicity, 1);
  EXPECT_EQ(triple[1].multiplicity, 3);
}

TEST(Sturm3, and_sturm4_refuse_other_degrees) {
  const auto message = [](const std::string& begin, const std::string& degree) {
    return begin + "; this one has degree " + degree +
           ": call real_roots, which solves those of any degree";
  };
  const std::string cubics = "sturm3 solves polynomials of degree 3";
  const std::string quartics = "sturm4 solves polynomials of degree 4";
  EXPECT_PRECONDITION_ERROR(sturm3(Polynomial()), message(cubics, "-1"));
  EXPECT_PRECONDITION_ERROR(sturm3(Polynomial{1, 2, 3}), message(cubics, "2"));
  EXPECT_PRECONDITION_ERROR(sturm3(Polynomial{1, 2, 3, 4, 5}), message(cubics, "4"));
  EXPECT_PRECONDITION_ERROR(sturm4(Polynomial{1, 2, 3, 4}), message(quartics, "3"));
  EXPECT_PRECONDITION_ERROR(sturm4(Polynomial{1, 2, 3, 4, 0}), message(quartics, "3"));
}

}  // namespace
}  // namespace kinetri::sturm_algorithm_test
