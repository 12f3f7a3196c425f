// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials of degree 4 at most without allocation, as of points in linear motion.
#ifndef KINETRI_SRC_ALGEBRA_STATIC_POLYNOMIAL_H
#define KINETRI_SRC_ALGEBRA_STATIC_POLYNOMIAL_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "gmp_access.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/algebra/polynomial.h"
#include "kinetri/impl/algebra/sign.h"
#include "kinetri/impl/base/check.h"
#include "stack_integer.h"

namespace kinetri {

/// A polynomial with coefficients of type `Number`, Integer or a Stack_integer, by ascending power.
/// Invariant: the leading coefficient is not zero; the zero polynomial has degree -1.
template <class Number>
class Static_polynomial {
 public:
  static constexpr int most = 4;  ///< no degree is greater

  Static_polynomial() = default;  ///< the zero polynomial
  /// Coefficients by ascending power, five at most; zeros at the high end are dropped.
  Static_polynomial(std::initializer_list<Number> coefficients)
      : degree_(static_cast<int>(coefficients.size()) - 1) {
    std::ranges::copy(coefficients, c_.begin());
    drop_leading_zeros();
  }
  /// The first coefficients of an array, up to that of t^degree.
  Static_polynomial(const std::array<Number, most + 1>& coefficients, int degree)
      : degree_(degree) {
    std::copy_n(coefficients.begin(), degree + 1, c_.begin());
    drop_leading_zeros();
  }
  /// The same polynomial. Precondition: its degree is at most 4.
  explicit Static_polynomial(const Polynomial& p) : degree_(p.degree()) {
    for (int i = 0; i <= degree_; ++i) at(i) = Number(p[i]);
  }
  /// The same polynomial with coefficients of another type.
  template <class Other>
  explicit Static_polynomial(const Static_polynomial<Other>& p) : degree_(p.degree()) {
    for (int i = 0; i <= degree_; ++i) at(i) = Number(p[i]);
  }

  int degree() const { return degree_; }        ///< -1 for the zero polynomial
  bool is_zero() const { return degree_ < 0; }  ///< whether it is the zero polynomial
  /// The coefficient of t^i. Precondition: 0 <= i <= degree().
  const Number& operator[](int i) const { return c_[static_cast<std::size_t>(i)]; }
  /// The coefficient of the highest power. Precondition: not the zero polynomial.
  const Number& leading_coefficient() const { return (*this)[degree_]; }

  /// The greatest number of binary digits of a coefficient.
  long coefficient_bits() const {
    long result = 0;
    for (int i = 0; i <= degree_; ++i) result = std::max(result, bit_length((*this)[i]));
    return result;
  }

  friend Static_polynomial derivative(const Static_polynomial& p) {
    Static_polynomial result;
    result.degree_ = std::max(p.degree_ - 1, -1);
    for (int i = 0; i <= result.degree_; ++i) result.at(i) = p[i + 1] * Number(i + 1);
    return result;
  }
  friend Static_polynomial operator-(Static_polynomial p) {
    for (int i = 0; i <= p.degree_; ++i) p.at(i) = -std::move(p.at(i));
    return p;
  }
  friend Static_polynomial operator+(Static_polynomial a, const Static_polynomial& b) {
    a.make_degree(b.degree_);
    for (int i = 0; i <= b.degree_; ++i) a.at(i) += b[i];
    a.drop_leading_zeros();
    return a;
  }
  friend Static_polynomial operator-(Static_polynomial a, const Static_polynomial& b) {
    a.make_degree(b.degree_);
    for (int i = 0; i <= b.degree_; ++i) a.at(i) -= b[i];
    a.drop_leading_zeros();
    return a;
  }
  /// Precondition: the degree of the product is at most 4.
  friend Static_polynomial operator*(const Static_polynomial& a, const Static_polynomial& b) {
    Static_polynomial result;
    if (a.is_zero() || b.is_zero()) return result;
    result.degree_ = a.degree_ + b.degree_;
    KINETRI_ASSERT(result.degree_ <= most, "a product of polynomials has too high a degree");
    for (int k = 0; k <= result.degree_; ++k) {
      int i = std::max(0, k - b.degree_);
      result.at(k) = a[i] * b[k - i];
      for (++i; i <= std::min(k, a.degree_); ++i) result.at(k) += a[i] * b[k - i];
    }
    return result;
  }
  friend Static_polynomial operator*(const Static_polynomial& p, const Number& factor) {
    return p * Static_polynomial{factor};
  }

 private:
  Number& at(int i) { return c_[static_cast<std::size_t>(i)]; }
  void drop_leading_zeros() {
    while (degree_ >= 0 && (*this)[degree_].is_zero()) --degree_;
  }
  // Adds zeros up to that degree, if it is lower.
  void make_degree(int degree) {
    while (degree_ < degree) at(++degree_) = Number(0);
  }

  std::array<Number, most + 1> c_;
  int degree_ = -1;
};

/// The same polynomial on the heap.
template <class Number>
Polynomial to_polynomial(const Static_polynomial<Number>& p) {
  std::vector<Integer> coefficients;
  coefficients.reserve(static_cast<std::size_t>(p.degree() + 1));
  for (int i = 0; i <= p.degree(); ++i) coefficients.push_back(static_cast<Integer>(p[i]));
  return Polynomial(std::move(coefficients));
}

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_STATIC_POLYNOMIAL_H
