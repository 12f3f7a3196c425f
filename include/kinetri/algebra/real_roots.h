// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real roots of polynomials as algebraic numbers: all of them, the first one after a given time,
// and the first time at which a polynomial that must not be negative becomes so.
//
// Every function isolates by Sturm's theorem (sturm_sequence.h) and bisection. The functions that
// look for the first root after a time try Descartes' rule of signs first, which suffices if there
// is no root or one.
//
// Results are exact. Cost, with the degree d: O(d^2) integer operations for the Sturm sequence and
// for each bisection; the number of bisections is about the number of bits that separate the roots.
#ifndef KINETRI_ALGEBRA_REAL_ROOTS_H
#define KINETRI_ALGEBRA_REAL_ROOTS_H

#include <optional>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// A real root of a polynomial.
struct Real_root {
  Algebraic_number value;  ///< the root, exact
  int multiplicity = 0;    ///< as a root of the polynomial; at least 1
};

/// The distinct real roots of `p` in ascending order; none if there are none. Precondition: `p` is
/// not zero.
std::vector<Real_root> real_roots(const Polynomial& p);

/// The least root of `p` greater than `t`, with its multiplicity; none if there is none.
/// Precondition: `p` is not zero.
std::optional<Real_root> first_root_after(const Polynomial& p, const Algebraic_number& t);

/// The *failure time* of the certificate `p >= 0` from `t` on: inf { s > t : p(s) < 0 }.
///
/// Cases: none if `p` is never negative after `t` (the zero polynomial included); `t` itself if `p`
/// is negative just after `t`; otherwise the least root of odd multiplicity after `t`. A root of
/// even multiplicity is a touch and not a failure.
std::optional<Algebraic_number> failure_time(const Polynomial& p, const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_REAL_ROOTS_H
