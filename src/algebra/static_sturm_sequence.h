// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sturm sequences of polynomials of degree 4 at most, in closed form.
#ifndef KINETRI_SRC_ALGEBRA_STATIC_STURM_SEQUENCE_H
#define KINETRI_SRC_ALGEBRA_STATIC_STURM_SEQUENCE_H

#include <array>
#include <cstddef>
#include <span>

#include "kinetri/impl/algebra/sign.h"
#include "kinetri/impl/base/check.h"
#include "static_polynomial.h"
#include "sturm_terms.h"

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
/// sturm_terms.h has the closed forms, up to the sign of the leading coefficient. A term ends the
/// sequence if the next one is zero. If the coefficient P of the quadratic term of a quartic is
/// zero and Q is not, that term is linear, and the next one is -f'(-R / Q).
///
/// Cost: at most 20 multiplications, no division. Source: S. Basu, R. Pollack, M.-F. Roy,
/// Algorithms in Real Algebraic Geometry, sections 2.2 and 4.1 (signed remainders, subresultants);
/// I. Z. Emiris, E. P. Tsigaridas, Comparing real algebraic numbers of small degree, ESA 2004
/// (invariants).
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
    const Sturm_terms_of_cubic<Number> terms(f);
    add_signed(f[3], {terms.q, terms.p * 2});
    // If p is zero, that is a constant, or zero.
    if (!terms.p.is_zero()) add_signed(f[3], {terms.s0(f)});
  }

  void add_terms_of_quartic() {
    const Term& f = terms_[0];
    const Sturm_terms_of_quartic<Number> terms(f);
    add_signed(f[4], {terms.r, terms.q, terms.p});
    if (terms.p.is_zero()) {
      if (!terms.q.is_zero()) add_value_of_derivative(terms.q, terms.r);
      return;
    }
    const auto last = terms.last(f);
    add_signed(f[4], {last.at_zero, last.slope});
    if (!last.slope.is_zero()) add_signed(f[4], {last.s0()});
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
