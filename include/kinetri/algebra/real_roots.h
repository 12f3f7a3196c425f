// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real roots of polynomials as algebraic numbers: all of them, the first one after a given time,
// and the first time at which a polynomial that must not be negative becomes so.
//
// Multiple roots are read off the last term of the Sturm sequence (sturm_sequence.h) up to degree
// 4, and off gcd(p, p') beyond. Descartes' rule of signs then proposes an interval for each root,
// and the counts of a Sturm sequence certify it: an interval that does not hold exactly one root,
// or a root that was left out, is an Internal_error.
//
// Results are exact. Cost, with the degree d: O(d^2) integer operations for a Sturm sequence, for
// its evaluation at each end of an interval, and for each interval that is divided; the number of
// divisions is about the number of bits that separate the roots.
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

/// @{
/// The real roots of a polynomial of degree 3, and of degree 4, as `real_roots` gives them:
/// Algorithm 1 (`Sturm3`) of T. Vomacka, Computation of topologic events in kinetic Delaunay
/// triangulation using Sturm sequences of polynomials, section 5.5, and its counterpart for
/// quartics. Its steps: as many distinct roots as V(-infinity) - V(infinity) of the Sturm sequence
/// (5.4); the multiple roots, which are those of the last term with multiplicities less by one
/// (5.4); the others, from the polynomial divided by the multiple ones.
///
/// The paper's sequence has each root as often as its multiplicity; here it stands once, with its
/// multiplicity: a cubic has multiplicities 3, 2 and 1, 1 and 2, or 1 up to three times, and at
/// least one root; a quartic may have none. A root of even multiplicity is no event (4.4).
/// Precondition: the degree of `p` is 3, or 4: the leading coefficient is not zero.
std::vector<Real_root> sturm3(const Polynomial& p);
std::vector<Real_root> sturm4(const Polynomial& p);
/// @}

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
