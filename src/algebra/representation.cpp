// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a representation is made, and how its parts depend on one another.
#include "representation.h"

#include <algorithm>
#include <utility>

#include "dyadic.h"
#include "kinetri/impl/base/check.h"

namespace kinetri {

bool Isolation::is_narrower_than_bits(long bits) const {
  const Integer& near_zero = a.sign() >= 0 ? a : b;
  return !near_zero.is_zero() && bit_length(b - a) + bits < bit_length(near_zero);
}

Root_source::Access::~Access() {
  if (!lock_.owns_lock() || representation_.bounds_are_published) return;
  source_.narrow(representation_.double_interval());
  representation_.bounds_are_published = true;
}

void Root_source::narrow(const Double_interval& interval) {
  double seen = lower_.load(std::memory_order_relaxed);
  while (seen < interval.lower &&
         !lower_.compare_exchange_weak(seen, interval.lower, std::memory_order_release)) {
  }
  seen = upper_.load(std::memory_order_relaxed);
  while (seen > interval.upper &&
         !upper_.compare_exchange_weak(seen, interval.upper, std::memory_order_release)) {
  }
}

void Root_source::Representation::isolate(const Polynomial& p, const Rational& first,
                                          const Rational& last) {
  KINETRI_PRECONDITION(first < last, "the isolating interval is empty");
  KINETRI_PRECONDITION(p.degree() >= 1, "a polynomial without roots has no root to isolate");
  own_polynomial = primitive_part(p);

  const std::optional<unsigned long> e_first = dyadic_exponent(first);
  const std::optional<unsigned long> e_last = dyadic_exponent(last);
  if (e_first && e_last) {
    isolation.emplace();
    const auto e = static_cast<long>(std::max(*e_first, *e_last));
    set_ends(scaled_floor(first, e), scaled_floor(last, e), static_cast<unsigned long>(e));
    KINETRI_PRECONDITION(sign(isolation->value_a) * sign(isolation->value_b) == CGAL::NEGATIVE,
                         "the polynomial does not change sign over the isolating interval");
  } else {
    KINETRI_PRECONDITION(p.sign_at(first) * p.sign_at(last) == CGAL::NEGATIVE,
                         "the polynomial does not change sign over the isolating interval");
    isolate_between_dyadic_ends(first, last);
    if (is_rational()) return;
  }
  if (p.degree() == 1) return become_rational(linear_root(p));

  // Zero as an end, instead of inside, makes the number of correct bits grow with each refinement.
  if (isolation->a.sign() < 0 && isolation->b.sign() > 0) compare_with(0);
}

// Dyadic ends inside the given ones, on finer and finer grids until the root is between them.
void Root_source::Representation::isolate_between_dyadic_ends(const Rational& first,
                                                              const Rational& last) {
  const Rational width = last - first;
  long e = std::max(bit_length(denominator(width)) - bit_length(numerator(width)) + 2, 0L);
  for (;; e += 8) {
    const Integer a = scaled_ceil(first, e);
    const Integer b = scaled_floor(last, e);
    const Integer value_a = scaled_value(own_polynomial, a, static_cast<unsigned long>(e));
    const Integer value_b = scaled_value(own_polynomial, b, static_cast<unsigned long>(e));
    if (value_a.is_zero()) return become_rational(dyadic(a, static_cast<unsigned long>(e)));
    if (value_b.is_zero()) return become_rational(dyadic(b, static_cast<unsigned long>(e)));
    if (sign(value_a) == sign(value_b)) continue;
    isolation.emplace();
    return set_ends(a, b, static_cast<unsigned long>(e));
  }
}

const Polynomial& Root_source::Representation::polynomial() {
  if (is_rational() && !linear_is_made) {
    own_polynomial = Polynomial{Integer(-numerator(lower)), denominator(lower)};
    linear_is_made = true;
  }
  return own_polynomial;
}

const Rational& Root_source::Representation::lower_end() {
  if (!is_rational() && !ends_are_current) {
    lower = dyadic(isolation->a, isolation->e);
    upper = dyadic(isolation->b, isolation->e);
    ends_are_current = true;
  }
  return lower;
}

const Rational& Root_source::Representation::upper_end() {
  lower_end();
  return is_rational() ? lower : upper;
}

Double_interval Root_source::Representation::double_interval() {
  return {to_interval(lower_end()).lower, to_interval(upper_end()).upper};
}

void Root_source::Representation::become_rational(Rational number) {
  isolation.reset();
  lower = std::move(number);
  bounds_are_published = false;
}

// Precondition: the polynomial has opposite signs, not zero, at the ends.
void Root_source::Representation::set_ends(Integer a, Integer b, unsigned long e) {
  const mp_bitcnt_t common = std::min({mpz_scan1(raw(a), 0), mpz_scan1(raw(b), 0), e});
  isolation->a = a >> common;
  isolation->b = b >> common;
  isolation->e = e - common;
  isolation->value_a = scaled_value(own_polynomial, isolation->a, isolation->e);
  isolation->value_b = scaled_value(own_polynomial, isolation->b, isolation->e);
  ends_are_current = false;
  bounds_are_published = false;
}

// Makes the dyadic number m an end of the isolation. `side` is the sign of the polynomial at m.
void Root_source::Representation::narrow_to(const Rational& m, Sign side) {
  Isolation& s = *isolation;
  const unsigned long e = *dyadic_exponent(m);
  const auto degree = static_cast<unsigned long>(own_polynomial.degree());
  if (e > s.e) {
    const unsigned long shift = e - s.e;
    s.a <<= shift;
    s.b <<= shift;
    s.value_a <<= shift * degree;
    s.value_b <<= shift * degree;
    s.e = e;
  }
  const bool is_lower = side == sign(s.value_a);
  Integer& end = is_lower ? s.a : s.b;
  Integer& value = is_lower ? s.value_a : s.value_b;
  end = numerator(m) << (s.e - e);
  value = scaled_value(own_polynomial, end, s.e);
  ends_are_current = false;
  bounds_are_published = false;
}

// Precondition: `factor` divides the polynomial and has the number as a root.
void Root_source::Representation::use_factor(Polynomial factor) {
  if (factor.degree() == 1) return become_rational(linear_root(factor));
  if (factor.degree() == own_polynomial.degree()) return;
  own_polynomial = std::move(factor);
  set_ends(isolation->a, isolation->b, isolation->e);
}

}  // namespace kinetri
