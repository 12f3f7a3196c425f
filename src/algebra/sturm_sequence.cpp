// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/algebra/sturm_sequence.h"

#include <utility>

#include "kinetri/impl/base/check.h"
#include "static_sturm_sequence.h"

namespace kinetri {
namespace {

// The number of sign changes in a sequence, zeros ignored; `sign_of` gives the sign of a term.
template <class Sign_of>
int sign_changes(const std::vector<Polynomial>& terms, const Sign_of& sign_of) {
  int changes = 0;
  Sign previous = CGAL::ZERO;
  for (const Polynomial& term : terms) {
    const Sign present = sign_of(term);
    if (present == CGAL::ZERO) continue;
    if (previous != CGAL::ZERO && present != previous) ++changes;
    previous = present;
  }
  return changes;
}

}  // namespace

Sturm_sequence::Sturm_sequence(const Polynomial& f) {
  KINETRI_PRECONDITION(!f.is_zero(), "the zero polynomial has no Sturm sequence");
  if (f.degree() <= Static_polynomial<Integer>::most) {
    const Static_sturm_sequence<Integer> sequence{Static_polynomial<Integer>(f)};
    for (const auto& term : sequence.terms()) terms_.push_back(primitive_part(to_polynomial(term)));
  } else {
    divide(f);
  }
  const Polynomial& last = terms_.back();
  if (last.degree() == 0) return;
  quotients_.reserve(terms_.size());
  for (const Polynomial& term : terms_) quotients_.push_back(exact_quotient(term, last));
}

// Euclid's algorithm, with the sign of each remainder changed.
void Sturm_sequence::divide(const Polynomial& f) {
  terms_.push_back(primitive_part(f));
  Polynomial next = primitive_part(derivative(f));
  while (!next.is_zero()) {
    terms_.push_back(std::move(next));
    const Polynomial& divisor = terms_.back();
    if (divisor.degree() == 0) break;
    next = primitive_part(-positive_pseudo_remainder(terms_[terms_.size() - 2], divisor));
  }
}

const std::vector<Polynomial>& Sturm_sequence::counted() const {
  return quotients_.empty() ? terms_ : quotients_;
}

int Sturm_sequence::sign_changes_at(const Rational& t) const {
  return sign_changes(counted(), [&](const Polynomial& term) { return term.sign_at(t); });
}

int Sturm_sequence::sign_changes_at_minus_infinity() const {
  return sign_changes(terms_, [](const Polynomial& p) { return p.sign_at_minus_infinity(); });
}

int Sturm_sequence::sign_changes_at_plus_infinity() const {
  return sign_changes(terms_, [](const Polynomial& p) { return p.sign_at_plus_infinity(); });
}

bool Sturm_sequence::is_root(const Rational& t) const {
  return terms_.front().sign_at(t) == CGAL::ZERO;
}

int Sturm_sequence::count(const std::optional<Interval_end>& lower,
                          const std::optional<Interval_end>& upper) const {
  if (lower && upper) {
    KINETRI_PRECONDITION(lower->value <= upper->value, "the ends of the interval are not in order");
    if (lower->value == upper->value) {
      return lower->included && upper->included && is_root(lower->value) ? 1 : 0;
    }
  }
  int result = lower ? sign_changes_at(lower->value) : sign_changes_at_minus_infinity();
  result -= upper ? sign_changes_at(upper->value) : sign_changes_at_plus_infinity();

  // A root removes one sign change, at the root already: so the difference counts the roots in
  // (lower, upper].
  if (lower && lower->included && is_root(lower->value)) ++result;
  if (upper && !upper->included && is_root(upper->value)) --result;
  return result;
}

}  // namespace kinetri
