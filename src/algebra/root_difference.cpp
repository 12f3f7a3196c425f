// SPDX-License-Identifier: GPL-3.0-or-later
//
// The multiplication by a polynomial in the ring of polynomials modulo m, where m is the polynomial
// of t, has the value of that polynomial at t as an eigenvalue. The number x = sqrt(s(t)) - r(t) is
// a root of (x + r(t))^2 - s(t). So with the multiplications R and S by r and s, which commute, x
// is a root of the determinant of (x + R)^2 - S, which is the characteristic polynomial of the
// block matrix [0, 1; S - R^2, -2 R]. Comparisons of x with numbers between the roots of that
// polynomial, by signs of polynomials at t, decide which root x is.
#include "algebra/root_difference.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/algebra/real_roots.h"

namespace kinetri {
namespace {

using Coefficients = std::vector<Rational>;
template <class Number>
using Matrix = std::vector<std::vector<Number>>;  // rows

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
Matrix<Rational> multiplication_by(std::span<const Rational> q, const Polynomial& m) {
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
  Matrix<Rational> result;
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back(row);
    row = times_t(row, monic);
  }
  return result;
}

template <class Number>
Matrix<Number> product(const Matrix<Number>& a, const Matrix<Number>& b) {
  const std::size_t n = a.size();
  Matrix<Number> result(n, std::vector<Number>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

Matrix<Rational> block_matrix(const Matrix<Rational>& s, const Matrix<Rational>& r) {
  const std::size_t n = s.size();
  const Matrix<Rational> squared_r = product(r, r);
  Matrix<Rational> result(2 * n, Coefficients(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    result[i][n + i] = 1;
    for (std::size_t j = 0; j < n; ++j) {
      result[n + i][j] = s[i][j] - squared_r[i][j];
      result[n + i][n + j] = -2 * r[i][j];
    }
  }
  return result;
}

// A positive multiple of the characteristic polynomial, by the algorithm of Faddeev and LeVerrier:
// M_1 = A, c_k = -trace(M_k) / k, and M_(k+1) = A (M_k + c_k I); c_k is the coefficient of the
// power n - k. It is for d A, where d is the common denominator, so that all numbers are integers.
Polynomial characteristic_polynomial(const Matrix<Rational>& matrix) {
  const std::size_t n = matrix.size();
  Integer d = 1;
  for (const auto& row : matrix) {
    for (const Rational& number : row) d = lcm(d, denominator(number));
  }
  Matrix<Integer> a(n, std::vector<Integer>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) a[i][j] = numerator(Rational(matrix[i][j] * d));
  }
  std::vector<Integer> coefficients(n + 1);
  coefficients[n] = 1;
  Matrix<Integer> m = a;
  for (std::size_t k = 1; k <= n; ++k) {
    Integer trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += m[i][i];
    const Integer c = -trace / static_cast<unsigned>(k);
    coefficients[n - k] = c;
    if (k == n) break;
    for (std::size_t i = 0; i < n; ++i) m[i][i] += c;
    m = product(a, m);
  }
  // Its value at d x, whose roots are those of the matrix.
  Integer power = 1;
  for (Integer& coefficient : coefficients) {
    coefficient *= power;
    power *= d;
  }
  return primitive_part(Polynomial(std::move(coefficients)));
}

// A polynomial of which t is a root.
Polynomial polynomial_of(const Algebraic_number& t) {
  if (!t.is_known_rational()) return t.polynomial();
  const std::array<Rational, 2> difference = {-t.rational(), 1};
  return primitive_polynomial(difference);
}

// Whether sqrt(s(t)) - r(t) > x, where the two are not equal.
bool is_root_difference_greater(std::span<const Rational> s, std::span<const Rational> r,
                                const Algebraic_number& t, const Rational& x) {
  Coefficients sum(r.begin(), r.end());  // x + r
  if (sum.empty()) sum.resize(1);
  sum[0] += x;
  if (sign_at(primitive_polynomial(sum), t) == CGAL::NEGATIVE) return true;
  Coefficients excess(std::max(s.size(), 2 * sum.size() - 1));  // s - (x + r)^2
  std::ranges::copy(s, excess.begin());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (std::size_t j = 0; j < sum.size(); ++j) excess[i + j] -= sum[i] * sum[j];
  }
  return sign_at(primitive_polynomial(excess), t) == CGAL::POSITIVE;
}

}  // namespace

Algebraic_number root_difference_at(std::span<const Rational> s, std::span<const Rational> r,
                                    const Algebraic_number& t) {
  const Polynomial m = polynomial_of(t);
  const std::vector<Real_root> roots = real_roots(
      characteristic_polynomial(block_matrix(multiplication_by(s, m), multiplication_by(r, m))));
  std::size_t i = roots.size() - 1;
  while (i > 0 && !is_root_difference_greater(
                      s, r, t, simplest_between(roots[i - 1].value, roots[i].value))) {
    --i;
  }
  return roots[i].value;
}

}  // namespace kinetri
