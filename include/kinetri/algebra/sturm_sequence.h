// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences and the root counts that they give.
//
// Sources: C. Sturm, 1829; S. Basu, R. Pollack, M.-F. Roy, Algorithms in Real Algebraic Geometry,
// 2nd edition, section 2.2 (signed remainder sequences); T. Vomacka, Computation of
// topologic events in kinetic Delaunay triangulation using Sturm sequences of polynomials,
// section 5.
#ifndef KINETRI_ALGEBRA_STURM_SEQUENCE_H
#define KINETRI_ALGEBRA_STURM_SEQUENCE_H

#include <optional>
#include <span>
#include <vector>

#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// One end of an interval of the real line, and whether the interval contains it.
struct Interval_end {
  Rational value;         ///< where the interval ends
  bool included = false;  ///< whether it contains its end
};

/// The signed remainder sequence f_1 = f, f_2 = f', f_3 = -rem(f_1, f_2), ... of a polynomial f
/// that is not zero. Each term is known up to a positive factor only, and is kept primitive.
///
/// The sequence counts the distinct real roots of f. If f has multiple roots it is
/// a *generalized* Sturm sequence: every term is a multiple of the last one, f_m = gcd(f, f'),
/// whose roots are the multiple roots of f with multiplicity less one.
///
/// Cost, with the degree d: O(d^2) integer operations to make it, and as many to count at one end.
/// Up to degree 4 the terms have closed forms, of at most 20 multiplications (MATH.md, section 3).
class Sturm_sequence {
 public:
  /// The sequence of f and f'. Precondition: f is not zero.
  explicit Sturm_sequence(const Polynomial& f);

  /// The terms f_1, ..., f_m, none of them zero. f_m is the gcd of f_1 and f_2 up to a constant.
  std::span<const Polynomial> terms() const noexcept { return terms_; }

  /// The number V(t) of sign changes in the sequence at `t`, each term divided by the last one,
  /// zeros ignored. So the count is right even if `t` is a multiple root of f, at which all terms
  /// vanish.
  int sign_changes_at(const Rational& t) const;
  /// V for all sufficiently small t.
  int sign_changes_at_minus_infinity() const;
  /// V for all sufficiently large t.
  int sign_changes_at_plus_infinity() const;

  /// The number of distinct real roots of f in the interval between `lower` and `upper`; a missing
  /// end is infinite. Each end may be open or closed, and may be a root, simple or multiple. An
  /// interval whose ends are equal is a point if both are included, else empty. Precondition: lower
  /// <= upper.
  int count(const std::optional<Interval_end>& lower = std::nullopt,
            const std::optional<Interval_end>& upper = std::nullopt) const;

 private:
  void divide(const Polynomial& f);
  const std::vector<Polynomial>& counted() const;
  bool is_root(const Rational& t) const;

  std::vector<Polynomial> terms_;  // the generalized sequence
  // terms_ divided by the last one: the sequence that is counted. Empty if the last term is a
  // constant, since terms_ itself can be counted then.
  std::vector<Polynomial> quotients_;
};

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_STURM_SEQUENCE_H
