// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first failure of a certificate by Sturm counts in integers on the stack: the exact stage for
// polynomials of degree 4 at most, as of linear motion.
#ifndef KINETRI_SRC_ALGEBRA_COUNT_FAILURE_H
#define KINETRI_SRC_ALGEBRA_COUNT_FAILURE_H

#include <cstdint>
#include <optional>

#include "kinetri/algebra/number_types.h"
#include "kinetri/impl/algebra/sign.h"
#include "kinetri/impl/base/double_interval.h"
#include "stack_integer.h"
#include "static_polynomial.h"

namespace kinetri {

/// A polynomial whose coefficients have at most 1024 binary digits.
using Narrow_polynomial = Static_polynomial<Stack_integer<16>>;

/// The result for the certificate p >= 0 from a time on.
struct Counted_failure {
  enum class Kind : std::uint8_t {
    unknown,      ///< p has a multiple root, or more roots near the time than binary64 numbers
                  ///< separate, or its numbers are too wide: general algebraic numbers are needed
    never_fails,  ///< p is positive just after the time, and has no root after it
    at_once,      ///< p is negative just after the time
    fails,        ///< p is positive just after the time and up to bounds.lower; it has exactly one
                  ///< root between the bounds, a simple one, and is no root there
  };
  Kind kind = Kind::unknown;    ///< how much is known
  Double_interval bounds = {};  ///< of `fails`
};

/// The first failure after a time t, of which only is known that it is within `now` and, if
/// `vanishes`, that p vanishes at t. Every answer but `unknown` is exact: a floating-point root
/// finder proposes an interval, and Sturm counts certify it. Precondition: p is not zero. Cost: the
/// sequence, one Taylor expansion, two evaluations of p, and one or two of the sequence, without
/// allocation.
Counted_failure count_failure(const Narrow_polynomial& p, const Double_interval& now,
                              bool vanishes);

/// The sign of p at a time t within `now`, or just before it, or after it, if `side` is negative or
/// positive. None if p may vanish near a time that is not a binary64 number, or the numbers are too
/// wide. Exact. Cost: one Taylor expansion.
std::optional<Sign> count_sign(const Narrow_polynomial& p, const Double_interval& now, Sign side);

/// The same at a rational time t. None only if the numbers are too wide.
std::optional<Sign> count_sign(const Narrow_polynomial& p, const Rational& t, Sign side);

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_COUNT_FAILURE_H
