// SPDX-License-Identifier: GPL-3.0-or-later
//
// The value of a polynomial at an algebraic number, as an algebraic number.
#ifndef KINETRI_SRC_ALGEBRA_VALUE_AT_H
#define KINETRI_SRC_ALGEBRA_VALUE_AT_H

#include <span>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

/// The value of sum of coefficients[i] t^i, exactly. Cost: one evaluation where `t` is known to be
/// rational; else, with the degree n of the polynomial of `t`, n products of n x n matrices of
/// rational numbers, and the isolation of the real roots of a polynomial of degree n.
Algebraic_number value_at(std::span<const Rational> coefficients, const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_VALUE_AT_H
