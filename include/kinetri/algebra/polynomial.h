// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dense univariate polynomials with exact integer coefficients. Only roots and signs matter to
// Kinetri, so a polynomial over the rationals is represented by a positive multiple with integer
// coefficients (`primitive_polynomial`); each function that scales says which sign the factor has.
//
// Costs are numbers of integer operations, linear in the degree unless stated otherwise; the size
// of the integers is not counted. All results are exact.
#ifndef KINETRI_ALGEBRA_POLYNOMIAL_H
#define KINETRI_ALGEBRA_POLYNOMIAL_H

#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/algebra/number_types.h"

namespace kinetri {

/// A polynomial sum of c_i t^i. Invariant: the leading coefficient is not zero; the zero polynomial
/// has no coefficients and degree -1.
class Polynomial {
 public:
  /// The zero polynomial.
  Polynomial() = default;

  /// @{
  /// Coefficients by ascending power; zeros at the high end are dropped.
  explicit Polynomial(std::vector<Integer> coefficients);
  Polynomial(std::initializer_list<Integer> coefficients);
  /// @}

  /// The degree; -1 for the zero polynomial.
  int degree() const noexcept { return static_cast<int>(coefficients_.size()) - 1; }
  /// Whether it is the zero polynomial.
  bool is_zero() const noexcept { return coefficients_.empty(); }

  /// The coefficients by ascending power.
  std::span<const Integer> coefficients() const& noexcept { return coefficients_; }
  std::span<const Integer> coefficients() const&& = delete;  ///< they end with the polynomial
  /// The coefficient of t^i. Precondition: 0 <= i <= degree().
  const Integer& operator[](int i) const { return coefficients_[static_cast<std::size_t>(i)]; }
  /// The coefficient of the highest power. Precondition: not the zero polynomial.
  const Integer& leading_coefficient() const { return coefficients_.back(); }

  /// The value at `t`, exact, by Horner's rule: degree() multiplications and additions.
  Rational operator()(const Rational& t) const;
  /// The sign of the value at `t`; cheaper than the value, since no fraction is reduced.
  Sign sign_at(const Rational& t) const;
  /// The sign on the whole closed interval if interval arithmetic proves it constant, else none.
  /// Exact. For intervals that shrink to a point that is not a root it gives the sign from some
  /// width on. Precondition: lower <= upper. Cost: two times that of `sign_at`.
  std::optional<Sign> sign_on(const Rational& lower, const Rational& upper) const;
  /// The sign for all sufficiently large t.
  Sign sign_at_plus_infinity() const;
  /// The sign for all sufficiently small t: those below every root.
  Sign sign_at_minus_infinity() const;

  /// @{
  /// Exact sums, differences and products, without scaling. Cost: linear in the degrees; of a
  /// product of two polynomials as many multiplications as the product of their lengths.
  Polynomial& operator+=(const Polynomial& other);
  Polynomial& operator-=(const Polynomial& other);
  Polynomial& operator*=(const Integer& factor);

  friend Polynomial operator+(Polynomial a, const Polynomial& b) { return a += b; }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return a -= b; }
  friend Polynomial operator*(Polynomial a, const Integer& factor) { return a *= factor; }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  friend Polynomial operator-(Polynomial a);
  /// @}

  /// Equality of the coefficients, and so of the polynomials.
  friend bool operator==(const Polynomial& a, const Polynomial& b) = default;
  /// Human-readable, highest power first: `3*t^2 - t + 5`.
  friend std::ostream& operator<<(std::ostream& out, const Polynomial& p);

  friend Polynomial primitive_part(Polynomial p);

 private:
  void drop_leading_zeros();

  std::vector<Integer> coefficients_;
};

/// The primitive integer polynomial that is a positive multiple of sum of coefficients[i] t^i; the
/// zero polynomial if all are zero.
Polynomial primitive_polynomial(std::span<const Rational> coefficients);

/// The derivative with respect to t, exact and not scaled.
Polynomial derivative(const Polynomial& p);

/// The greatest common divisor of the coefficients, positive; 0 for the zero polynomial.
Integer content(const Polynomial& p);

/// `p` divided by its content: the same signs everywhere. The zero polynomial stays zero.
Polynomial primitive_part(Polynomial p);

/// A positive integer multiple of the remainder of `a` divided by `b` over the rationals.
/// Precondition: `b` is not zero. Cost: (deg a - deg b + 1) * deg b multiplications.
/// Source: Knuth, The Art of Computer Programming 2, section 4.6.1, algorithm R, with the sign of
/// the multiplier kept positive.
Polynomial positive_pseudo_remainder(const Polynomial& a, const Polynomial& b);

/// The quotient a / b. Precondition: `b` divides `a` over the rationals, and `b` is primitive (so
/// that, by Gauss's lemma, the quotient has integer coefficients).
Polynomial exact_quotient(const Polynomial& a, const Polynomial& b);

/// The primitive greatest common divisor with positive leading coefficient. gcd(0, 0) is 0;
/// gcd(p, 0) is the primitive part of p up to sign. Coprime polynomials, the usual case, are
/// recognized modulo a prime, which costs little. Cost otherwise: O(deg a * deg b).
Polynomial gcd(const Polynomial& a, const Polynomial& b);

/// The primitive polynomial with the same roots as `p`, each simple, and with the sign of `p`
/// to the right of the largest root. Precondition: `p` is not zero. Cost: a gcd and a division.
Polynomial square_free_part(const Polynomial& p);

/// A primitive square-free factor and the multiplicity with which its roots are roots of the whole.
struct Square_free_factor {
  Polynomial factor;     ///< its roots are simple
  int multiplicity = 0;  ///< at least 1
};

/// The factors f_k of positive degree and positive leading coefficient, by ascending multiplicity,
/// pairwise coprime, with p = constant * product of f_k^k; none for a constant. Precondition: `p`
/// is not zero. Cost: a gcd and two divisions for each multiplicity up to the largest. Source: D.
/// Y. Y. Yun, On square-free decomposition algorithms, SYMSAC 1976.
std::vector<Square_free_factor> square_free_decomposition(const Polynomial& p);

/// The square-free polynomial whose roots are the roots of odd multiplicity of `p` (where `p`
/// changes sign) and whose sign equals that of `p` wherever `p` is not zero.
/// Precondition: `p` is not zero. Cost: a gcd; if that is not constant, a decomposition.
Polynomial odd_part(const Polynomial& p);

}  // namespace kinetri

#endif  // KINETRI_ALGEBRA_POLYNOMIAL_H
