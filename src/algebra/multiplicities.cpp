// SPDX-License-Identifier: GPL-3.0-or-later
//
// Square-free parts, and the multiplicities of roots: up to degree 4 the multiple roots are those
// of the last term of the Sturm sequence, beyond those of the gcd with the derivative.
#include <utility>

#include "kinetri/algebra/polynomial.h"
#include "kinetri/impl/base/check.h"
#include "static_sturm_sequence.h"

namespace kinetri {
namespace {

// The greatest common divisor of p and its derivative, primitive and with a positive leading
// coefficient: of degree 4 at most, the last term of the Sturm sequence in closed form.
Polynomial repeated_part(const Polynomial& p) {
  if (p.degree() > Static_polynomial<Integer>::most) return gcd(p, derivative(p));
  const Static_sturm_sequence<Integer> sequence{Static_polynomial<Integer>(p)};
  if (sequence.is_square_free()) return Polynomial{1};
  Polynomial last = primitive_part(to_polynomial(sequence.last()));
  return last.leading_coefficient().sign() < 0 ? -std::move(last) : last;
}

}  // namespace

Polynomial square_free_part(const Polynomial& p) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  const Polynomial primitive = primitive_part(p);
  const Polynomial repeated = repeated_part(primitive);
  return repeated.degree() <= 0 ? primitive : exact_quotient(primitive, repeated);
}

std::vector<Square_free_factor> square_free_decomposition(const Polynomial& p) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  Polynomial f = primitive_part(p);
  if (f.leading_coefficient().sign() < 0) f = -std::move(f);
  if (f.degree() == 0) return {};

  // Invariant at the head of step k: b is the product of f_j over j >= k, and c - b' is the sum of
  // (j - k) f_j' * (product of the others), up to one common factor. So gcd(b, c - b') = f_k.
  const Polynomial slope = derivative(f);
  const Polynomial repeated = repeated_part(f);
  Polynomial b = exact_quotient(f, repeated);
  Polynomial c = exact_quotient(slope, repeated);
  std::vector<Square_free_factor> result;
  for (int k = 1; b.degree() > 0; ++k) {
    const Polynomial d = c - derivative(b);
    Polynomial factor = gcd(b, d);
    b = exact_quotient(b, factor);
    c = exact_quotient(d, factor);
    if (factor.degree() > 0) result.push_back({std::move(factor), k});
  }
  return result;
}

Polynomial odd_part(const Polynomial& p) {
  KINETRI_PRECONDITION(!p.is_zero(), "the zero polynomial has no sign");
  const Polynomial primitive = primitive_part(p);
  // Usually the polynomial is square-free.
  if (repeated_part(primitive).degree() <= 0) return primitive;

  Polynomial result{p.leading_coefficient().sign()};
  for (const Square_free_factor& f : square_free_decomposition(primitive)) {
    if (f.multiplicity % 2 != 0) result = result * f.factor;
  }
  return result;
}

}  // namespace kinetri
