// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conversions between rationals and binary64. All of them use one exact division of |x| by a power
// of two, the distance between the binary64 numbers around |x|, and so depend on no rounding mode.
#include "kinetri/algebra/number_types.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kinetri/impl/base/check.h"

namespace kinetri {
namespace {

constexpr int mantissa_bits = std::numeric_limits<double>::digits;
constexpr long least_unit = std::numeric_limits<double>::min_exponent - mantissa_bits;  // -1074
constexpr long overflow_exponent = std::numeric_limits<double>::max_exponent;           // 1024

// What is left of |x| beyond the binary64 number below it, in halves of the distance to the next.
enum class Excess { none, below_half, half, above_half };

// |x| is between steps * 2^unit and (steps + 1) * 2^unit; both are binary64 numbers, unless |x| is
// at least 2^1024 (`overflows`).
struct Magnitude {
  std::uint64_t steps = 0;
  long unit = 0;
  Excess excess = Excess::none;
  bool overflows = false;
};

bool is_power_of_two(mpz_srcptr positive) {
  return mpz_scan1(positive, 0) + 1 == mpz_sizeinbase(positive, 2);
}

// floor(n / 2^shift) and what it drops.
Excess shift_right(mpz_ptr quotient, mpz_srcptr n, mp_bitcnt_t shift) {
  mpz_tdiv_q_2exp(quotient, n, shift);
  const mp_bitcnt_t lowest = mpz_scan1(n, 0);
  if (lowest >= shift) return Excess::none;
  if (lowest == shift - 1) return Excess::half;
  return mpz_tstbit(n, shift - 1) != 0 ? Excess::above_half : Excess::below_half;
}

// floor(n / (d * 2^unit)) and what it drops.
Excess divide(mpz_ptr quotient, mpz_srcptr n, mpz_srcptr d, long unit) {
  Integer numerator;
  mpz_ptr num = numerator.backend().data();
  if (is_power_of_two(d)) {
    const long shift = unit + static_cast<long>(mpz_scan1(d, 0));
    if (shift > 0) return shift_right(quotient, n, static_cast<mp_bitcnt_t>(shift));
    mpz_mul_2exp(quotient, n, static_cast<mp_bitcnt_t>(-shift));
    return Excess::none;
  }
  Integer denominator;
  Integer remainder;
  mpz_ptr den = denominator.backend().data();
  mpz_mul_2exp(num, n, static_cast<mp_bitcnt_t>(std::max(-unit, 0L)));
  mpz_mul_2exp(den, d, static_cast<mp_bitcnt_t>(std::max(unit, 0L)));
  mpz_tdiv_qr(quotient, remainder.backend().data(), num, den);
  if (remainder.is_zero()) return Excess::none;
  remainder <<= 1;
  const int order = remainder.compare(denominator);
  return order < 0 ? Excess::below_half : order == 0 ? Excess::half : Excess::above_half;
}

// The excess after the last bit of the quotient has been dropped as well.
Excess with_dropped_bit(bool bit, Excess rest) {
  if (rest == Excess::none) return bit ? Excess::half : Excess::none;
  return bit ? Excess::above_half : Excess::below_half;
}

// Precondition: x is not zero.
Magnitude magnitude(const Rational& x) {
  Integer n;
  mpz_abs(n.backend().data(), mpq_numref(x.backend().data()));
  mpz_srcptr d = mpq_denref(x.backend().data());

  // 2^(exponent - 1) < |x| < 2^(exponent + 1), hence the quotient below has 53 or 54 bits, or fewer
  // if the numbers are subnormal.
  const long exponent = static_cast<long>(mpz_sizeinbase(n.backend().data(), 2)) -
                        static_cast<long>(mpz_sizeinbase(d, 2));
  Magnitude result;
  if (exponent > overflow_exponent) {
    result.overflows = true;
    return result;
  }
  result.unit = std::max(exponent - mantissa_bits, least_unit);
  Integer quotient;
  result.excess = divide(quotient.backend().data(), n.backend().data(), d, result.unit);
  // Not mpz_get_ui, whose `unsigned long` may have 32 bits.
  mpz_export(&result.steps, nullptr, -1, sizeof result.steps, 0, 0, quotient.backend().data());
  if ((result.steps >> mantissa_bits) != 0) {
    result.excess = with_dropped_bit((result.steps & 1) != 0, result.excess);
    result.steps >>= 1;
    ++result.unit;
  }
  result.overflows = result.unit > overflow_exponent - mantissa_bits;
  return result;
}

double scaled(std::uint64_t steps, long unit) {
  return std::ldexp(static_cast<double>(steps), static_cast<int>(unit));
}

}  // namespace

Sign sign(const Integer& x) {
  return static_cast<Sign>(x.sign());
}

Sign sign(const Rational& x) {
  return static_cast<Sign>(x.sign());
}

Rational to_rational(double x) {
  KINETRI_PRECONDITION(std::isfinite(x), "only a finite number is a rational number");
  Rational result;
  mpq_set_d(result.backend().data(), x);
  return result;
}

Double_interval to_interval(const Rational& x) {
  if (x.is_zero()) return {0.0, 0.0};
  const Magnitude m = magnitude(x);
  double below = std::numeric_limits<double>::max();
  double above = std::numeric_limits<double>::infinity();
  if (!m.overflows) {
    below = scaled(m.steps, m.unit);
    above = m.excess == Excess::none ? below : scaled(m.steps + 1, m.unit);
  }
  if (x.sign() > 0) return {below, above};
  return {-above, 0.0 - below};  // 0, never -0
}

double to_double(const Rational& x) {
  if (x.is_zero()) return 0.0;
  const Magnitude m = magnitude(x);
  double result = std::numeric_limits<double>::infinity();
  if (!m.overflows) {
    const bool up =
        m.excess == Excess::above_half || (m.excess == Excess::half && (m.steps & 1) != 0);
    result = scaled(m.steps + (up ? 1 : 0), m.unit);
  }
  return x.sign() > 0 ? result : -result;
}

Rational scaled_by_power_of_two(const Rational& x, long exponent) {
  Rational result;
  if (exponent >= 0) {
    mpq_mul_2exp(result.backend().data(), x.backend().data(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.backend().data(), x.backend().data(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

}  // namespace kinetri
