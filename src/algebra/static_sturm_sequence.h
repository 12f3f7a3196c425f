// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences of polynomials of degree 4 at most, in closed form.
#ifndef KINETRI_SRC_ALGEBRA_STATIC_STURM_SEQUENCE_H
#define KINETRI_SRC_ALGEBRA_STATIC_STURM_SEQUENCE_H

#include <array>
#include <cstddef>
#include <span>

#include "kinetri/algebra/sign.h"
#include "kinetri/base/check.h"
#include "static_polynomial.h"

namespace kinetri {

/// A dyadic number numerator / 2^exponent.
template <class Number>
struct Dyadic_point {
  Number numerator;            ///< any integer
  unsigned long exponent = 0;  ///< if it is least, the point has the fewest digits
};

/// 2^(e n) times the value of p at t = m / 2^e, where n is the degree of p. Precondition: p is not
/// the zero polynomial. Cost: n multiplications, shifts and additions.
template <class Number>
Number scaled_value(const Static_polynomial<Number>& p, const Dyadic_point<Number>& t) {
  Number result = p.leading_coefficient();
  for (int i = p.degree() - 1, k = 1; i >= 0; --i, ++k) {
    result = result * t.numerator;
    result += p[i] << (t.exponent * static_cast<unsigned long>(k));
  }
  return result;
}

/// The signed remainder sequence of f and f', each term up to a positive factor. If f has multiple
/// roots, the last term has them, with multiplicities less by one, and no other roots; else it is a
/// constant.
///
/// With f = a t^4 + b t^3 + c t^2 + d t + e and
///     P = 3 b^2 - 8 a c     Q = 2 b c - 12 a d     R = b d - 16 a e
///     I = 12 a e - 3 b d + c^2     J = c (72 a e + 9 b d - 2 c^2) - 27 (a d^2 + e b^2)
///     S2 = P t^2 + Q t + R     S1 = 2 (P I + 2 a J) t + (I Q + b J)     S0 = 4 I^3 - J^2
/// these are identities: -rem(f, f') = S2 / (16 a), -rem(f', S2) = (16 a / (3 P^2)) S1, and, if S1
/// has degree 1, -rem(S2, S1) = (P^2 / (12 (P I + 2 a J)^2)) S0 (see MATH.md, section 3). So the
/// sign of a is all that is to be added to these terms, and a term ends the sequence if the next
/// one is zero. If P = 0 and Q is not, S2 is linear and the next term is -f'(-R / Q).
///
/// Cost: 17 multiplications and no division. Source: S. Basu, R. Pollack, M.-F. Roy, Algorithms in
/// Real Algebraic Geometry, sections 2.2 and 4.1 (signed remainders, subresultants); I. Z. Emiris,
/// E. P. Tsigaridas, Comparing real algebraic numbers of small degree, ESA 2004 (invariants).
template <class Number>
class Static_sturm_sequence {
 public:
  using Term = Static_polynomial<Number>;  ///< a term of the sequence

  /// The number of binary digits in which the sequence of such a polynomial can be computed.
  static long bits_needed(int degree, long coefficient_bits) {
    // The last terms have degrees 6, 4 and 2 in the coefficients, and small factors; of a quartic
    // without P the last one has degree 7.
    constexpr std::array<long, 5> powers = {1, 1, 2, 4, 7};
    return powers[static_cast<std::size_t>(degree)] * coefficient_bits + 24;
  }

  /// The sequence. Precondition: f is not zero.
  explicit Static_sturm_sequence(const Term& f) {
    add(f);
    if (f.degree() < 1) return;
    add(derivative(f));
    switch (f.degree()) {
      case 2:
        add_signed(f[2], {f[1] * f[1] - f[2] * f[0] * 4});
        break;
      case 3:
        add_terms_of_cubic();
        break;
      case 4:
        add_terms_of_quartic();
        break;
      default:
        break;
    }
  }

  /// The terms, none of which is zero.
  std::span<const Term> terms() const { return std::span(terms_).first(size_); }
  /// The last one: a constant if f has no multiple root.
  const Term& last() const { return terms_[size_ - 1]; }
  /// Whether f has no multiple root.
  bool is_square_free() const { return last().degree() == 0; }

  /// The number of sign changes if `sign_of` gives the signs of the terms; zeros are left out.
  template <class Sign_of>
  int changes(const Sign_of& sign_of) const {
    int result = 0;
    Sign previous = CGAL::ZERO;
    for (const Term& term : terms()) {
      const Sign present = sign_of(term);
      if (present == CGAL::ZERO) continue;
      if (present == -previous) ++result;
      previous = present;
    }
    return result;
  }
  int changes_at_plus_infinity() const {
    return changes([](const Term& term) { return sign(term.leading_coefficient()); });
  }
  int changes_at_minus_infinity() const {
    return changes([](const Term& term) {
      const Sign s = sign(term.leading_coefficient());
      return term.degree() % 2 == 0 ? s : -s;
    });
  }
  /// V(t), the number of sign changes at t. Precondition: t is no multiple root of f.
  int changes_at(const Dyadic_point<Number>& t) const {
    return changes([&](const Term& term) { return sign(scaled_value(term, t)); });
  }

 private:
  void add(const Term& term) {
    if (!term.is_zero()) terms_[size_++] = term;
  }
  // The term, with the sign of `lead`.
  void add_signed(const Number& lead, const Term& term) {
    add(sign(lead) == CGAL::NEGATIVE ? -term : term);
  }

  void add_terms_of_cubic() {
    const Term& f = terms_[0];
    const Number &b = f[3], &c = f[2], &d = f[1], &e = f[0];
    const Number p = c * c - b * d * 3;
    const Number q = c * d - b * e * 9;
    add_signed(b, {q, p * 2});
    // If p is zero, that is a constant, or zero.
    if (!p.is_zero()) add_signed(b, {p * (d * d - c * e * 3) * 4 - q * q});
  }

  void add_terms_of_quartic() {
    const Term& f = terms_[0];
    const Number &a = f[4], &b = f[3], &c = f[2], &d = f[1], &e = f[0];
    const Number ae = a * e;
    const Number bd = b * d;
    const Number p = b * b * 3 - a * c * 8;
    const Number q = b * c * 2 - a * d * 12;
    const Number r = bd - ae * 16;
    add_signed(a, {r, q, p});
    if (p.is_zero()) {
      if (!q.is_zero()) add_value_of_derivative(q, r);
      return;
    }
    const Number cc = c * c;
    const Number i = ae * 12 - bd * 3 + cc;
    const Number j = c * (ae * 72 + bd * 9 - cc * 2) - (a * d * d + e * b * b) * 27;
    const Number slope = (p * i + a * j * 2) * 2;
    add_signed(a, {i * q + b * j, slope});
    if (!slope.is_zero()) add_signed(a, {i * i * i * 4 - j * j});
  }

  // -f'(-r / q) times |q|^3.
  void add_value_of_derivative(const Number& q, const Number& r) {
    const Term& slope = terms_[1];
    const Number value =
        slope[3] * r * r * r - slope[2] * r * r * q + slope[1] * r * q * q - slope[0] * q * q * q;
    add_signed(q, {value});
  }

  std::array<Term, 5> terms_;
  std::size_t size_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_ALGEBRA_STATIC_STURM_SEQUENCE_H
