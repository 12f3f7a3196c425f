// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real roots of polynomials as algebraic numbers: all of them, the first one after a given time,
// and the first time at which a polynomial that must not be negative becomes so.
//
// The multiple roots are those of the last term of the Sturm sequence (sturm_sequence.h) up to
// degree 4, and those of gcd(p, p') beyond. Then bisection by Descartes' rule of signs isolates the
// roots, and Sturm counts verify that each interval has exactly one root and that no root is
// missing; otherwise Internal_error is thrown.
//
// Results are exact. Cost, with the degree d: O(d^2) integer operations for a Sturm sequence, for
// its evaluation at each end of an interval, and for each interval that is divided. The number of
// these hardly depends on the distances of the roots, since Newton's method approaches clusters.
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

/// The distinct real roots of `p` in ascending order. Precondition: `p` is not zero.
std::vector<Real_root> real_roots(const Polynomial& p);

/// @{
/// The real roots of a polynomial of degree 3, and of degree 4, as `real_roots` gives them:
/// Algorithm 1 (`Sturm3`) of T. Vomacka, Computation of topologic events in kinetic Delaunay
/// triangulation using Sturm sequences of polynomials, section 5.5, and its counterpart for
/// quartics. Its steps: as many distinct roots as V(-infinity) - V(infinity) of the Sturm sequence
/// (5.4); the multiple roots, which are those of the last term with multiplicities less by one
/// (5.4); the others, from the polynomial divided by the multiple ones.
///
/// The paper lists each root as often as its multiplicity says; here each is listed once, with its
/// multiplicity. A cubic has at least one root; a quartic may have none. A root of even
/// multiplicity is no event (4.4). Precondition: the degree of `p` is 3, or 4: the leading
/// coefficient is not zero.
std::vector<Real_root> sturm3(const Polynomial& p);
std::vector<Real_root> sturm4(const Polynomial& p);
/// @}

/// The least root of `p` greater than `t`, with its multiplicity, if there is one. Precondition:
/// `p` is not zero.
std::optional<Real_root> first_root_after(const Polynomial& p, const Algebraic_number& t);

/// The *failure time* of the certificate `p >= 0` from `t` on: inf { s > t : p(s) < 0 }.
///
/// Cases: none if `p` is never negative after `t` (the zero polynomial included); `t` itself if `p`
/// is negative just after `t`; otherwise the least root of odd multiplicity after `t`. A root of
/// even multiplicity is a touch and not a failure.
std::optional<Algebraic_number> failure_time(const Polynomial& p, const Algebraic_number& t);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_REAL_ROOTS_H
