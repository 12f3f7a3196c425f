// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rationals and the grids of the multiples of a power of two.
#ifndef KINETRI_SRC_ALGEBRA_DYADIC_H
#define KINETRI_SRC_ALGEBRA_DYADIC_H

#include <cstddef>
#include <optional>
#include <span>

#include "gmp_access.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

inline Integer numerator(const Rational& x) {
  return boost::multiprecision::numerator(x);
}
inline Integer denominator(const Rational& x) {
  return boost::multiprecision::denominator(x);
}

inline Rational dyadic(const Integer& numerator, unsigned long exponent) {
  Rational result(numerator);
  mpq_div_2exp(result.backend().data(), result.backend().data(), exponent);
  return result;
}

/// e if the denominator is 2^e; none for other rationals.
inline std::optional<unsigned long> dyadic_exponent(const Rational& x) {
  mpz_srcptr d = mpq_denref(x.backend().data());
  const mp_bitcnt_t shift = mpz_scan1(d, 0);
  if (shift + 1 != mpz_sizeinbase(d, 2)) return std::nullopt;
  return shift;
}

/// floor(x 2^exponent).
inline Integer scaled_floor(const Rational& x, long exponent) {
  const Rational scaled = scaled_by_power_of_two(x, exponent);
  Integer result;
  mpz_fdiv_q(raw(result), mpq_numref(scaled.backend().data()), mpq_denref(scaled.backend().data()));
  return result;
}

/// ceil(x 2^exponent).
inline Integer scaled_ceil(const Rational& x, long exponent) {
  const Rational scaled = scaled_by_power_of_two(x, exponent);
  Integer result;
  mpz_cdiv_q(raw(result), mpq_numref(scaled.backend().data()), mpq_denref(scaled.backend().data()));
  return result;
}

/// 2^(e n) p(x / 2^e), where n is the degree.
inline Integer scaled_value(const Polynomial& p, const Integer& x, unsigned long e) {
  const std::span<const Integer> c = p.coefficients();
  Integer result = c.back();
  Integer term;
  for (std::size_t i = c.size() - 1; i-- > 0;) {
    mpz_mul(raw(result), raw(result), raw(x));
    mpz_mul_2exp(raw(term), raw(c[i]), e * (c.size() - 1 - i));
    mpz_add(raw(result), raw(result), raw(term));
  }
  return result;
}

inline Rational linear_root(const Polynomial& p) {
  return Rational(Integer(-p[0]), p[1]);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_DYADIC_H
