// SPDX-License-Identifier: GPL-3.0-or-later
#include "algebra/root_difference.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinetri/algebra/real_roots.h"

namespace kinetri::root_difference_test {
namespace {

using Coefficients = std::vector<Rational>;

TEST(Root_difference, at_rational_numbers_is_exact) {
  EXPECT_EQ(root_difference_at(Coefficients{25}, Coefficients{2}, 7.0), Algebraic_number(3.0));
  EXPECT_EQ(root_difference_at(Coefficients{25}, Coefficients{8}, 7.0), Algebraic_number(-3.0));
  EXPECT_EQ(root_difference_at(Coefficients{0, 0, 1}, Coefficients{}, -3.0), Algebraic_number(3.0));
  EXPECT_EQ(root_difference_at(Coefficients{}, Coefficients{0, 1}, Rational(2, 3)),
            Algebraic_number(Rational(-2, 3)));
  const auto roots = real_roots({-2, 0, 1});
  EXPECT_EQ(root_difference_at(Coefficients{1, 1}, Coefficients{}, 1.0), roots[1].value);
  // The root of 2 minus 5 is a root of (x + 5)^2 - 2.
  EXPECT_EQ(root_difference_at(Coefficients{1, 1}, Coefficients{3, 2}, 1.0),
            real_roots({23, 10, 1})[1].value);
}

TEST(Root_difference, at_square_roots_is_exact) {
  const auto roots = real_roots({-2, 0, 1});
  ASSERT_EQ(roots.size(), 2u);
  const Algebraic_number& t = roots[1].value;
  // (1 + t)^2 = 3 + 2 t.
  EXPECT_EQ(root_difference_at(Coefficients{3, 2}, Coefficients{0, 1}, t), Algebraic_number(1.0));
  EXPECT_EQ(root_difference_at(Coefficients{1, 2, 1}, Coefficients{1}, t), t);
  // At -t the root of 3 - 2 t is t - 1.
  EXPECT_EQ(root_difference_at(Coefficients{3, 2}, Coefficients{-1}, roots[0].value), t);
  EXPECT_EQ(root_difference_at(Coefficients{3, 2}, Coefficients{0, -1}, roots[0].value),
            Algebraic_number(-1.0));
  // Higher powers than the degree of the number's own polynomial.
  EXPECT_EQ(root_difference_at(Coefficients{0, 0, 0, 0, 1}, Coefficients{0, 0, 0, 0, 1}, t),
            Algebraic_number(-2.0));
}

TEST(Root_difference, at_numbers_of_degree_four_tells_equal_from_nearly_equal) {
  const auto roots = real_roots({1, -3, 0, -5, 1});
  ASSERT_EQ(roots.size(), 2u);
  const Rational little = scaled_by_power_of_two(1, -300);
  for (const Real_root& root : roots) {
    // t^4 = 5 t^3 + 3 t - 1 there.
    const auto difference =
        root_difference_at(Coefficients{0, 0, 0, 0, 1}, Coefficients{0, 1}, root.value);
    EXPECT_EQ(difference,
              root_difference_at(Coefficients{-1, 3, 0, 5}, Coefficients{0, 1}, root.value));
    EXPECT_LT(difference, root_difference_at(Coefficients{-1 + little, 3, 0, 5}, Coefficients{0, 1},
                                             root.value));
    EXPECT_GT(difference,
              root_difference_at(Coefficients{-1, 3, 0, 5}, Coefficients{little, 1}, root.value));
  }
}

// The polynomial of the number is square-free, and may be a product.
TEST(Root_difference, at_numbers_whose_polynomial_is_a_product_is_that_of_the_number) {
  const auto roots = real_roots(Polynomial{-2, 0, 1} * Polynomial{-3, 0, 1});
  ASSERT_EQ(roots.size(), 4u);
  const std::vector<double> squares = {3, 2, 2, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(root_difference_at(Coefficients{0, 0, 0, 0, 1}, Coefficients{1}, roots[i].value),
              Algebraic_number(squares[i] - 1));
  }
}

}  // namespace
}  // namespace kinetri::root_difference_test
