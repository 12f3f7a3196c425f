// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algebraic numbers with known values of 6000 bits: a + sqrt(c), and rationals that are given as
// roots of polynomials.
#ifndef KINETRI_TEST_SUPPORT_KNOWN_NUMBERS_H
#define KINETRI_TEST_SUPPORT_KNOWN_NUMBERS_H

#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/error.h"
#include "support/random_polynomials.h"

namespace kinetri::test {

inline Rational two_to(long exponent) {
  return scaled_by_power_of_two(1, exponent);
}

/// A number and its known value.
struct Specimen {
  Algebraic_number number;
  Known_root truth;
};

/// The number a + sqrt(c); if c is zero, the rational a.
struct Value {
  Rational a;
  Rational c;
};

inline void add_to(Known_polynomial& p, const Value& v, int multiplicity = 1) {
  if (v.c.is_zero()) {
    p.add_rational(v.a, multiplicity);
  } else {
    p.add_irrational_pair(v.a, v.c, multiplicity);
  }
}

/// The root with the value `v`. Precondition: the polynomial has it.
inline Known_root root_at(const Known_polynomial& p, const Value& v) {
  const Big_float value = v.c.is_zero() ? oracle_value(v.a) : oracle_value(v.a, v.c, true);
  for (const Known_root& root : p.roots()) {
    if (root.value == value) return root;
  }
  throw Internal_error("the polynomial lacks the root that it was given");
}

/// The number `v` as a root of a random polynomial, or as a plain rational.
inline Specimen make_specimen(const Value& v, const std::vector<Value>& others, Random& random) {
  Known_polynomial p(random.coin() ? 1 : -3);
  add_to(p, v);
  const bool plain = v.c.is_zero() && random.integer(0, 2) == 0;
  if (!plain) {
    for (long i = random.integer(v.c.is_zero() ? 1 : 0, 2); i > 0; --i) {
      add_to(p, random.pick(others));
    }
    if (p.degree() == 1 || random.coin()) p.add_rootless(random.integer(-2, 2), 1, 1);
  }
  const Known_root root = root_at(p, v);
  return {plain ? Algebraic_number(v.a) : isolated_root(p, root, random), root};
}

/// Equal, distant and nearly equal numbers of either sign.
inline std::vector<Value> some_values() {
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

inline Comparison_result order_of(const Known_root& a, const Known_root& b) {
  const int order = mpfr_cmp(a.value.backend().data(), b.value.backend().data());
  return order < 0 ? CGAL::SMALLER : order > 0 ? CGAL::LARGER : CGAL::EQUAL;
}

/// The rational itself, or one so near that no binary64 number or tie is between.
inline Rational stand_in(const Known_root& truth) {
  return truth.rational ? *truth.rational : rounded(truth.value, 5000);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_KNOWN_NUMBERS_H
