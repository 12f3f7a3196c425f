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

/// Why a polynomial p that must not be negative from a time on fails at a later time, which is a
/// root of p: after `from` p has no roots up to `lower` but touches, at which it stays positive on
/// both sides; then the only root in (lower, upper], and p is negative just after it. All numbers
/// are dyadic, and depend on p and on the two times alone, not on how far these have been refined.
///
/// If p fails at the very time from which it must not be negative, `from` is `lower`, and what
/// is proved is that p has a root there and is negative just after it.
struct Failure_certificate {
  Polynomial polynomial;  ///< p, primitive
  /// At or after the first time, with no root of p after that time and up to `from`.
  Rational from;
  /// @{
  /// The failure is the only root of p in (lower, upper], or both are the failure. They are the
  /// bounds of its tight_interval(), or nearer if another root, or the first time, is between.
  Rational lower;
  Rational upper;
  /// @}
  /// The signs of Sturm_sequence(p).terms() at `from`, `lower` and `upper`. None of the three is a
  /// root of p, except if it is the failure.
  std::array<std::vector<Sign>, 3> signs;
  /// Of the failure as a root of p: odd, except if p fails at the very first time.
  int multiplicity = 0;
  /// For each touch in (from, lower], in ascending order, an interval as (lower, upper] is for the
  /// failure: the only root in it is the touch.
  std::vector<Rational_interval> touches;
};

/// The certificate that `p`, which must not be negative from `start` on, fails at `failure`. None
/// if it does not: that time is no root of `p`, or `p` is not negative just after it, or it is
/// negative before, after `start`; none for the zero polynomial. Precondition: start <= failure.
/// Cost: that of real_roots, and as many comparisons as there are roots.
std::optional<Failure_certificate> certify_failure(const Polynomial& p,
                                                   const Algebraic_number& start,
                                                   const Algebraic_number& failure);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_FAILURE_CERTIFICATE_H
