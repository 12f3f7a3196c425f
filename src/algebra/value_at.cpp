// SPDX-License-Identifier: GPL-3.0-or-later
//
// The value q(t) is an eigenvalue of the multiplication by q in the ring of polynomials modulo m,
// where m is the polynomial of t. So it is a real root of the characteristic polynomial of that
// multiplication; an enclosure of q(t), made narrower by refining t, tells which one.
#include "algebra/value_at.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/algebra/real_roots.h"

namespace kinetri {
namespace {

using Coefficients = std::vector<Rational>;
using Matrix = std::vector<Coefficients>;  // rows

Rational horner(std::span<const Rational> coefficients, const Rational& t) {
  Rational sum = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * t + coefficients[i];
  return sum;
}

// t times the element of the ring. `monic` are the coefficients of m / (leading coefficient), but
// for the leading one.
Coefficients times_t(const Coefficients& element, const Coefficients& monic) {
  const std::size_t n = monic.size();
  Coefficients result(n);
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = (i > 0 ? element[i - 1] : Rational(0)) - element[n - 1] * monic[i];
  }
  return result;
}

// Row i is q t^i in the basis 1, t, ..., t^(n-1).
Matrix multiplication_by(std::span<const Rational> q, const Polynomial& m) {
  const auto n = static_cast<std::size_t>(m.degree());
  Coefficients monic(n);
  for (std::size_t i = 0; i < n; ++i) {
    monic[i] = Rational(m[static_cast<int>(i)], m.leading_coefficient());
  }
  Coefficients row(n);
  for (std::size_t i = q.size(); i-- > 0;) {  // Horner's rule
    row = times_t(row, monic);
    row[0] += q[i];
  }
  Matrix result;
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back(row);
    row = times_t(row, monic);
  }
  return result;
}

Matrix product(const Matrix& a, const Matrix& b) {
  const std::size_t n = a.size();
  Matrix result(n, Coefficients(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

// By the algorithm of Faddeev and LeVerrier: M_1 = A, c_k = -trace(M_k) / k, and
// M_(k+1) = A (M_k + c_k I); c_k is the coefficient of the power n - k.
Polynomial characteristic_polynomial(const Matrix& a) {
  const std::size_t n = a.size();
  Coefficients coefficients(n + 1);
  coefficients[n] = 1;
  Matrix m = a;
  for (std::size_t k = 1; k <= n; ++k) {
    Rational trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += m[i][i];
    const Rational c = -trace / static_cast<unsigned>(k);
    coefficients[n - k] = c;
    if (k == n) break;
    for (std::size_t i = 0; i < n; ++i) m[i][i] += c;
    m = product(a, m);
  }
  return primitive_polynomial(coefficients);
}

// Bounds of the values between `lower` and `upper`, by Horner's rule.
std::pair<Rational, Rational> bounds(std::span<const Rational> coefficients, const Rational& lower,
                                     const Rational& upper) {
  std::pair<Rational, Rational> sum;
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    const auto [least, greatest] =
        std::minmax({Rational(sum.first * lower), Rational(sum.first * upper),
                     Rational(sum.second * lower), Rational(sum.second * upper)});
    sum = {least + coefficients[i], greatest + coefficients[i]};
  }
  return sum;
}

}  // namespace

Algebraic_number value_at(std::span<const Rational> coefficients, const Algebraic_number& t) {
  if (t.is_known_rational()) return horner(coefficients, t.rational());
  const Polynomial of_value =
      characteristic_polynomial(multiplication_by(coefficients, t.polynomial()));
  const std::vector<Real_root> roots = real_roots(of_value);
  for (;;) {
    if (t.is_known_rational()) return horner(coefficients, t.rational());
    const auto [lower, upper] = bounds(coefficients, t.lower(), t.upper());
    const auto first = std::ranges::find_if(
        roots, [&](const Real_root& root) { return compare(root.value, lower) != CGAL::SMALLER; });
    const auto last = std::find_if(first, roots.end(), [&](const Real_root& root) {
      return compare(root.value, upper) == CGAL::LARGER;
    });
    if (last - first == 1) return first->value;
    t.refine();
  }
}

}  // namespace kinetri
