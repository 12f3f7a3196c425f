// SPDX-License-Identifier: GPL-3.0-or-later
//
// Signs of polynomials at algebraic numbers, and just before and after them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "support/known_numbers.h"

namespace kinetri::sign_at_test {
namespace {

using test::add_to;
using test::Known_polynomial;
using test::Known_root;
using test::make_specimen;
using test::Random;
using test::some_values;
using test::Specimen;
using test::Value;

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
  for (unsigned long seed = 0; seed < test::cases(1200ul); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Value& v = random.pick(values);
    const Specimen t = make_specimen(v, values, random);
    Known_polynomial p(random.big_integer_not_zero(6));
    for (long i = random.integer(0, 2); i > 0; --i) {
      const Value& other = random.pick(values);
      add_to(p, other, static_cast<int>(random.integer(1, 3)));
    }
    if (random.coin()) add_to(p, v, static_cast<int>(random.integer(1, 4)));
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

}  // namespace
}  // namespace kinetri::sign_at_test
