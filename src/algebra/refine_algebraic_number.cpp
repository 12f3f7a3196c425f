// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refinement of the isolating interval of an algebraic number.
#include <algorithm>
#include <limits>
#include <utility>

#include "dyadic.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/check.h"
#include "representation.h"

namespace kinetri {

// One step of quadratic interval refinement: the interval is divided into 2^k parts, k <= k_max,
// and the part in which the secant meets zero is tried. Where that is the right one, the next step
// has twice as many digits; else half as many. With k = 1 it is bisection.
void Root_source::Representation::quadratic_step(unsigned long k_max) {
  Isolation& s = *isolation;
  const Polynomial& p = own_polynomial;
  const auto degree = static_cast<unsigned long>(p.degree());
  const unsigned long k = std::max(std::min(s.k, k_max), 1UL);
  const Integer part = s.b - s.a;
  s.e += k;
  s.a <<= k;
  s.b <<= k;
  s.value_a <<= k * degree;
  s.value_b <<= k * degree;
  ends_are_current = false;
  bounds_are_published = false;

  // The position of the secant's zero in parts, rounded. It is only a guess: k + 32 leading bits of
  // the values will do.
  Integer size_a = boost::multiprecision::abs(s.value_a);
  Integer size_sum = size_a + boost::multiprecision::abs(s.value_b);
  const long excess = bit_length(size_sum) - static_cast<long>(k) - 32;
  if (excess > 0) {
    size_a >>= static_cast<unsigned long>(excess);
    size_sum >>= static_cast<unsigned long>(excess);
  }
  const Integer parts = Integer(1) << k;
  const Integer j = std::min<Integer>(((size_a << (k + 1)) + size_sum) / (size_sum << 1), parts);

  const Sign sign_a = sign(s.value_a);
  bool root_is_right = j.is_zero();
  if (!j.is_zero() && j != parts) {
    Integer x = s.a + j * part;
    Integer value = scaled_value(p, x, s.e);
    if (value.is_zero()) return become_rational(dyadic(x, s.e));
    root_is_right = sign(value) == sign_a;
    (root_is_right ? s.a : s.b) = std::move(x);
    (root_is_right ? s.value_a : s.value_b) = std::move(value);
  }
  if (s.b - s.a > part) {
    Integer x = root_is_right ? s.a + part : s.b - part;
    Integer value = scaled_value(p, x, s.e);
    if (value.is_zero()) return become_rational(dyadic(x, s.e));
    const bool is_lower = sign(value) == sign_a;
    (is_lower ? s.a : s.b) = std::move(x);
    (is_lower ? s.value_a : s.value_b) = std::move(value);
  }
  if (s.b - s.a == part) {
    s.k = std::max(s.k, 2 * k);
  } else {
    s.k = std::max(k / 2, 1UL);
  }
}

void Root_source::Representation::halve() {
  const Integer width = isolation->b - isolation->a;
  const unsigned long e = isolation->e;
  do {
    quadratic_step(std::numeric_limits<unsigned long>::max());
  } while (!is_rational() && ((isolation->b - isolation->a) << 1) > (width << (isolation->e - e)));
}

void Root_source::Representation::refine_to_bits(long bits) {
  while (!is_rational() && !isolation->is_narrower_than_bits(bits)) {
    const Integer& near_zero = isolation->a.sign() >= 0 ? isolation->a : isolation->b;
    // No more digits than are asked for, unless it is unknown yet how small the number is.
    const long missing = near_zero.is_zero() ? std::numeric_limits<long>::max()
                                             : bit_length(isolation->b - isolation->a) + bits -
                                                   bit_length(near_zero) + 1;
    quadratic_step(static_cast<unsigned long>(missing));
  }
}

void Root_source::Representation::refine_to(const Rational& width) {
  // 2^exponent <= width
  const long exponent = bit_length(numerator(width)) - bit_length(denominator(width)) - 1;
  while (!is_rational()) {
    const long present = bit_length(isolation->b - isolation->a) - static_cast<long>(isolation->e);
    if (present <= exponent) return;
    quadratic_step(static_cast<unsigned long>(present - exponent));
  }
}

void Algebraic_number::refine() const {
  if (is_binary64()) return;
  const Access r = access();
  if (!r->is_rational()) r->halve();
}

void Algebraic_number::refine_to_bits(unsigned bits) const {
  if (!is_binary64()) access()->refine_to_bits(static_cast<long>(bits));
}

void Algebraic_number::refine_to(const Rational& width) const {
  KINETRI_PRECONDITION(width.sign() > 0,
                       "an irrational number has no interval of width 0; ask for a greater one");
  if (!is_binary64()) access()->refine_to(width);
}

}  // namespace kinetri
