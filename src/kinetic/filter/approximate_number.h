// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real numbers given by a binary64 approximation and an error bound.
#ifndef KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_NUMBER_H
#define KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_NUMBER_H

#include <cmath>

#include "error_bounds.h"
#include "kinetri/impl/algebra/sign.h"

namespace kinetri {

/// A number within `error` of `value`. Sums and products preserve this in every rounding mode and
/// with fused operations, barring under- and overflow: they add twice the unit roundoff for each
/// rounding of the value, and more for those of the error. (Running error analysis: N. Higham,
/// Accuracy and Stability of Numerical Algorithms, 2002, section 3.3.)
struct Approximate_number {
  double value;
  double error;

  friend Approximate_number operator+(const Approximate_number& a, const Approximate_number& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Approximate_number operator-(const Approximate_number& a, const Approximate_number& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend Approximate_number operator*(const Approximate_number& a, const Approximate_number& b) {
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + (std::abs(b.value) + b.error) * a.error);
  }
  friend Approximate_number operator*(const Approximate_number& a, int factor) {
    return rounded(a.value * factor, a.error * std::abs(factor));
  }

  /// The sign, or zero if it is not certain.
  friend Sign certain_sign(const Approximate_number& a) {
    if (a.value > a.error) return CGAL::POSITIVE;
    return a.value < -a.error ? CGAL::NEGATIVE : CGAL::ZERO;
  }

 private:
  static Approximate_number rounded(double value, double error) {
    return {value, error * (1 + 0x1p-49) + std::abs(value) * (4 * unit_roundoff)};
  }
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_APPROXIMATE_NUMBER_H
