// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact number types of the library and their conversions from and to binary64. Each is a
// Boost.Multiprecision number over GMP, without expression templates, so that `auto` and the
// ternary operator give numbers.
#ifndef KINETRI_ALGEBRA_NUMBER_TYPES_H
#define KINETRI_ALGEBRA_NUMBER_TYPES_H

#include <boost/multiprecision/gmp.hpp>

#include "kinetri/impl/algebra/sign.h"
#include "kinetri/impl/base/double_interval.h"

namespace kinetri {

/// An integer of any size.
using Integer =
    boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
/// A fraction of two integers.
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                               boost::multiprecision::et_off>;

/// @{
/// The sign of `x`.
Sign sign(const Integer& x);
Sign sign(const Rational& x);
/// @}

/// The rational number that the binary64 number `x` is. Exact. Precondition: `x` is finite.
Rational to_rational(double x);

/// The tightest interval of binary64 numbers that contains `x`: both bounds are `x` if `x` is a
/// binary64 number, else they are its two neighbors (infinite beyond the largest finite one).
Double_interval to_interval(const Rational& x);

/// The binary64 number nearest to `x`, ties to even; infinite if IEEE 754 rounding gives that.
double to_double(const Rational& x);

/// `x` times two to the power `exponent`, exactly.
Rational scaled_by_power_of_two(const Rational& x, long exponent);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_NUMBER_TYPES_H
