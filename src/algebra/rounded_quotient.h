// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rounding of what is computed from an algebraic number: coordinates at an irrational time.
#ifndef KINETRI_SRC_ALGEBRA_ROUNDED_QUOTIENT_H
#define KINETRI_SRC_ALGEBRA_ROUNDED_QUOTIENT_H

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// The binary64 number nearest to p(t) / q(t), ties to even; infinite if IEEE 754 rounding gives
/// that. Does not depend on how far `t` was refined. Precondition: q(t) is not zero. Cost: one
/// evaluation if `t` is known to be rational; else some refinements of `t`, and an exact sign
/// if the quotient is too near to the middle of two binary64 numbers.
double rounded_quotient(const Polynomial& p, const Polynomial& q, const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_ROUNDED_QUOTIENT_H
