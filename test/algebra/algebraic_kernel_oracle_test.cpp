// SPDX-License-Identifier: GPL-3.0-or-later
//
// Root counts, multiplicities, isolating intervals and order against CGAL's algebraic kernel, which
// isolates by Descartes' rule and shares no code with Kinetri. Slow to compile, hence a file of its
// own.
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpz.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "support/random_polynomials.h"

namespace kinetri::algebraic_kernel_oracle_test {
namespace {

using test::Random;

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Root_with_multiplicity = std::pair<Kernel::Algebraic_real_1, Kernel::Multiplicity_type>;

CGAL::Gmpz to_cgal(const Integer& x) {
  return CGAL::Gmpz(x.backend().data());
}

Kernel::Bound to_cgal(const Rational& x) {
  return Kernel::Bound(to_cgal(numerator(x)), to_cgal(denominator(x)));
}

Kernel::Polynomial_1 to_cgal(const Polynomial& p) {
  std::vector<CGAL::Gmpz> c;
  for (const Integer& x : p.coefficients()) c.push_back(to_cgal(x));
  return Kernel::Polynomial_1(c.begin(), c.end());
}

// Small coefficients, which often have multiple and common roots; large ones; and products.
Polynomial random_polynomial_of_some_kind(Random& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return random.polynomial(static_cast<int>(random.integer(1, 6)), 2);
    case 1:
      return random.polynomial(static_cast<int>(random.integer(1, 4)), 200);
    case 2: {
      const Polynomial repeated = random.polynomial(static_cast<int>(random.integer(1, 2)), 3);
      return repeated * repeated * random.polynomial(static_cast<int>(random.integer(0, 2)), 3);
    }
    default:
      return random.polynomial(static_cast<int>(random.integer(1, 5)), 20);
  }
}

TEST(Algebraic_kernel_oracle, roots_of_random_polynomials_agree) {
  const Kernel kernel;
  const auto solve = kernel.solve_1_object();
  const auto compare_cgal = kernel.compare_1_object();
  std::vector<Real_root> previous;
  std::vector<Root_with_multiplicity> previous_cgal;
  unsigned long equal_pairs = 0;
  for (unsigned long seed = 0; seed < test::cases(5000ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polynomial p = random_polynomial_of_some_kind(random);
    std::vector<Root_with_multiplicity> expected;
    solve(to_cgal(p), std::back_inserter(expected));

    const auto count = static_cast<int>(expected.size());
    ASSERT_EQ(Sturm_sequence(p).count(), count) << p;
    const std::vector<Real_root> found = real_roots(p);
    ASSERT_EQ(static_cast<int>(found.size()), count) << p;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Algebraic_number& root = found[i].value;
      ASSERT_EQ(found[i].multiplicity, expected[i].second) << p;
      if (root.is_known_rational()) {
        ASSERT_EQ(compare_cgal(expected[i].first, to_cgal(root.rational())), CGAL::EQUAL) << p;
      } else {
        ASSERT_EQ(compare_cgal(expected[i].first, to_cgal(root.lower())), CGAL::LARGER) << p;
        ASSERT_EQ(compare_cgal(expected[i].first, to_cgal(root.upper())), CGAL::SMALLER) << p;
      }
    }
    // The order of two roots of different polynomials.
    if (!found.empty() && !previous.empty()) {
      const auto i = static_cast<std::size_t>(random.bits() % found.size());
      const auto j = static_cast<std::size_t>(random.bits() % previous.size());
      const Comparison_result order = compare(found[i].value, previous[j].value);
      ASSERT_EQ(order, compare_cgal(expected[i].first, previous_cgal[j].first))
          << found[i].value << "; " << previous[j].value;
      if (order == CGAL::EQUAL) ++equal_pairs;
    }
    previous = found;
    previous_cgal = expected;
  }
  EXPECT_GT(equal_pairs, 20U) << "equal roots of different polynomials are hardly tested";
}

}  // namespace
}  // namespace kinetri::algebraic_kernel_oracle_test
