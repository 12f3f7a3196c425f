// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sign changes of Sturm sequences, for polynomials of any degree, mostly without exact terms.
#ifndef KINETRI_SRC_ALGEBRA_STURM_COUNTER_H
#define KINETRI_SRC_ALGEBRA_STURM_COUNTER_H

#include <memory>
#include <optional>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/algebra/sturm_sequence.h"

namespace kinetri {

class Interval_sturm_sequence;

/// V of a square-free polynomial, exactly. Up to degree 4 the terms are exact, in closed form. For
/// higher degrees, whose terms have very long coefficients, the sequence is computed in interval
/// arithmetic with growing precision until the signs are certain; the exact terms are computed only
/// if 4096 bits are not enough.
class Sturm_counter {
 public:
  /// Precondition: f is square-free and not zero. It must outlive this object.
  explicit Sturm_counter(const Polynomial& f);
  ~Sturm_counter();
  Sturm_counter(const Sturm_counter&) = delete;
  Sturm_counter& operator=(const Sturm_counter&) = delete;

  /// The number of sign changes at t, zeros left out.
  int changes_at(const Rational& t);
  int changes_at_plus_infinity();   ///< V for all sufficiently large t
  int changes_at_minus_infinity();  ///< V for all sufficiently small t
  Sign sign_at(const Rational& t) const { return f_.sign_at(t); }

 private:
  template <class Certain, class Exact>
  int changes(const Certain& certain, const Exact& exact);

  const Polynomial& f_;
  std::unique_ptr<Interval_sturm_sequence> intervals_;  // null: exact terms are used
  std::optional<Sturm_sequence> exact_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_STURM_COUNTER_H
