// SPDX-License-Identifier: GPL-3.0-or-later
#include "algebra/value_at.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinetri/algebra/real_roots.h"

namespace kinetri {
namespace {

using Coefficients = std::vector<Rational>;

TEST(Value_at, rational_numbers_is_rational) {
  const Algebraic_number value = value_at(Coefficients{1, 2, Rational(1, 3)}, Rational(3, 2));
  ASSERT_TRUE(value.is_known_rational());
  EXPECT_EQ(value.rational(), Rational(19, 4));
  EXPECT_EQ(value_at(Coefficients(), 5.0), Algebraic_number(0.0));
}

TEST(Value_at, square_roots_is_exact) {
  const auto roots = real_roots({-2, 0, 1});
  ASSERT_EQ(roots.size(), 2u);
  const Algebraic_number& root = roots[1].value;
  EXPECT_EQ(value_at(Coefficients{0, 1}, root), root);
  EXPECT_EQ(value_at(Coefficients{5, 0, 1}, root), Algebraic_number(7.0));
  EXPECT_EQ(value_at(Coefficients{7}, root), Algebraic_number(7.0));
  // (1 + r)^2 = 3 + 2 r, a root of y^2 - 6 y + 1.
  const auto values = real_roots({1, -6, 1});
  EXPECT_EQ(value_at(Coefficients{1, 2, 1}, root), values[1].value);
  EXPECT_EQ(value_at(Coefficients{1, 2, 1}, roots[0].value), values[0].value);
  // Higher powers than the degree of the number's own polynomial.
  EXPECT_EQ(value_at(Coefficients{0, 0, 0, 0, 0, 0, 1}, root), Algebraic_number(8.0));
}

TEST(Value_at, numbers_of_degree_four_tells_equal_from_nearly_equal) {
  const Polynomial p = {1, -3, 0, -5, 1};
  const auto roots = real_roots(p);
  ASSERT_EQ(roots.size(), 2u);
  const Rational little = scaled_by_power_of_two(1, -300);
  for (const Real_root& root : roots) {
    // t^4 = 5 t^3 + 3 t - 1 there.
    const Algebraic_number power = value_at(Coefficients{0, 0, 0, 0, 1}, root.value);
    EXPECT_EQ(power, value_at(Coefficients{-1, 3, 0, 5}, root.value));
    EXPECT_LT(power, value_at(Coefficients{-1 + little, 3, 0, 5}, root.value));
    EXPECT_GT(power, value_at(Coefficients{-1 - little, 3, 0, 5}, root.value));
  }
}

// The polynomial of the number is square-free, and may be a product.
TEST(Value_at, numbers_whose_polynomial_is_a_product_is_that_of_the_number) {
  const Polynomial p = Polynomial{-2, 0, 1} * Polynomial{-3, 0, 1};
  const auto roots = real_roots(p);
  ASSERT_EQ(roots.size(), 4u);
  const std::vector<double> squares = {3, 2, 2, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(value_at(Coefficients{0, 0, 1}, roots[i].value), Algebraic_number(squares[i]));
  }
}

}  // namespace
}  // namespace kinetri
