// SPDX-License-Identifier: GPL-3.0-or-later
//
// The proof that a polynomial fails first at a given time: signs of its Sturm sequence at a few
// dyadic numbers, which anyone can check with rational arithmetic.
#ifndef KINETRI_ALGEBRA_FAILURE_CERTIFICATE_H
#define KINETRI_ALGEBRA_FAILURE_CERTIFICATE_H

#include <array>
#include <optional>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// A proof that a polynomial p, which must not be negative from a time on, fails first at a later
/// time, a root of p. From `from` to `lower` all roots of p are touches: p is positive on both
/// sides. In (lower, upper] there is one root, and p is negative just after it. All numbers are
/// dyadic and depend only on p and the two times, not on how far these have been refined.
///
/// If p fails at the first time itself, `from` is `lower`, and the proof is that p has a root there
/// and is negative just after it.
struct Failure_certificate {
  Polynomial polynomial;  ///< p, primitive
  /// At or after the first time; p has no root after that time and up to `from`.
  Rational from;
  /// @{
  /// The failure is the only root of p in (lower, upper], or both are the failure. They are the
  /// bounds of its tight_interval(), or nearer if another root, or the first time, is between.
  Rational lower;
  Rational upper;
  /// @}
  /// The signs of Sturm_sequence(p).terms() at `from`, `lower` and `upper`. None of the three is a
  /// root of p other than the failure.
  std::array<std::vector<Sign>, 3> signs;
  /// Of the failure as a root of p: odd, unless p fails at the first time.
  int multiplicity = 0;
  /// For each touch in (from, lower], in ascending order, an interval as (lower, upper] is for the
  /// failure: the only root in it is the touch.
  std::vector<Rational_interval> touches;
};

/// The certificate that `p`, which must not be negative from `start` on, fails at `failure`. None
/// if `p` does not: if that time is not a root of `p`, or `p` is not negative just after it, or `p`
/// is negative earlier after `start`, or is the zero polynomial. Precondition: start <= failure.
/// Cost: that of real_roots, and as many comparisons as there are roots.
std::optional<Failure_certificate> certify_failure(const Polynomial& p,
                                                   const Algebraic_number& start,
                                                   const Algebraic_number& failure);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_FAILURE_CERTIFICATE_H
