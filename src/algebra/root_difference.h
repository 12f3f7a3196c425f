// SPDX-License-Identifier: GPL-3.0-or-later
//
// A square root minus a polynomial, at an algebraic number, as an algebraic number.
#ifndef KINETRI_SRC_ALGEBRA_ROOT_DIFFERENCE_H
#define KINETRI_SRC_ALGEBRA_ROOT_DIFFERENCE_H

#include <span>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri {

/// sqrt(s(t)) - r(t), exactly, where s(t) is the sum of s[i] t^i and r(t) that of r[i] t^i.
/// Precondition: s(t) >= 0. Cost: with the degree n of the polynomial of `t`, 1 if it is known
/// to be rational, 2n products of 2n x 2n matrices of rational numbers, and the isolation of the
/// real roots of a polynomial of degree 2n.
Algebraic_number root_difference_at(std::span<const Rational> s, std::span<const Rational> r,
                                    const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_ROOT_DIFFERENCE_H
