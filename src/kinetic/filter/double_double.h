// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers of about 106 bits, as unevaluated sums of two binary64 numbers. With rounding to nearest,
// and barring under- and overflow, the relative error of a sum is at most 3 u^2 and that of a
// product 5 u^2, u = 2^-53. Source: M. Joldes, J.-M. Muller, V. Popescu, Tight and rigorous error
// bounds for basic building blocks of double-word arithmetic, ACM Transactions on Mathematical
// Software 44, 2017, algorithms 6 and 12.
#ifndef KINETRI_SRC_KINETIC_FILTER_DOUBLE_DOUBLE_H
#define KINETRI_SRC_KINETIC_FILTER_DOUBLE_DOUBLE_H

#include <cmath>

namespace kinetri {

struct Double_double {
  double high = 0;
  double low = 0;  // at most half a unit in the last place of `high`
};

/// a + b, exactly; the second form if |a| >= |b| or a is zero.
inline Double_double exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_there = sum - a;
  return {sum, (a - (sum - b_there)) + (b - b_there)};
}
inline Double_double fast_exact_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b, exactly.
inline Double_double exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline Double_double operator+(const Double_double& a, const Double_double& b) {
  const Double_double s = exact_sum(a.high, b.high);
  const Double_double t = exact_sum(a.low, b.low);
  const Double_double v = fast_exact_sum(s.high, s.low + t.high);
  return fast_exact_sum(v.high, t.low + v.low);
}

inline Double_double operator-(const Double_double& a) {
  return {-a.high, -a.low};
}
inline Double_double operator-(const Double_double& a, const Double_double& b) {
  return a + -b;
}

inline Double_double operator*(const Double_double& a, const Double_double& b) {
  const Double_double c = exact_product(a.high, b.high);
  const double rest = std::fma(a.low, b.high, std::fma(a.high, b.low, a.low * b.low));
  return fast_exact_sum(c.high, c.low + rest);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DOUBLE_DOUBLE_H
