// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_certificates.h"

#include <limits>
#include <memory>
#include <utility>

#include "kinetri/algebra/real_roots.h"

namespace kinetri {
namespace {

using Time = Algebraic_number;

// The certificate that certainly never fails.
Certificate certain_for_ever(bool is_root_solved) {
  return {Certificate::Kind::never_fails,
          {},
          nullptr,
          false,
          Certificate::Means::exact,
          is_root_solved};
}

Certificate exact_failure_within(const Double_interval& bounds) {
  return {Certificate::Kind::fails, bounds, nullptr, false, Certificate::Means::exact, true};
}

Certificate exact_failure_at(const Time& t, bool is_root_solved) {
  return {Certificate::Kind::fails,  t.interval(),  std::make_unique<Time>(t), true,
          Certificate::Means::exact, is_root_solved};
}

// The first time from t on at which the distance is not positive and decreases.
std::optional<Time> contact_time(const Polynomial& distance, const Time& t) {
  if (sign_at(distance, t) == CGAL::POSITIVE) return failure_time(distance, t);
  const std::optional<Time> fall = failure_time(derivative(distance), t);
  if (!fall || sign_at(distance, *fall) != CGAL::POSITIVE) return fall;
  return failure_time(distance, *fall);
}

}  // namespace

Certificate exact_certificate(std::optional<Time> failure, bool is_root_solved) {
  using Kind = Certificate::Kind;
  constexpr auto exact = Certificate::Means::exact;
  constexpr bool may_be_zero = true;
  if (!failure) return {Kind::never_fails, {}, nullptr, may_be_zero, exact, is_root_solved};
  // After the event the filter starts from this time's interval, and decides nothing if that is
  // wide.
  failure->refine_to_bits(std::numeric_limits<double>::digits);
  const Double_interval bounds = failure->interval();
  return {Kind::fails, bounds, std::make_unique<Time>(std::move(*failure)),
          may_be_zero, exact,  is_root_solved};
}

Certificate exact_certificate(const Polynomial& p, const Time& t) {
  return exact_certificate(failure_time(p, t), p.degree() > 0);
}

Certificate exact_root_certificate(const Polynomial& p, const Time& t) {
  std::optional<Real_root> root = first_root_after(p, t);
  return exact_certificate(root ? std::optional(std::move(root->value)) : std::nullopt,
                           p.degree() > 0);
}

std::optional<Certificate> counted_certificate(const Narrow_polynomial& p, const Time& t,
                                               Certificate_state state) {
  if (p.is_zero()) return exact_certificate(std::nullopt, false);
  const bool is_root_solved = p.degree() > 0;
  const Counted_failure failure =
      count_failure(p, t.interval(), state == Certificate_state::vanishes);
  switch (failure.kind) {
    case Counted_failure::Kind::fails:
      return exact_failure_within(failure.bounds);
    case Counted_failure::Kind::never_fails:
      return certain_for_ever(is_root_solved);
    case Counted_failure::Kind::at_once:
      return exact_failure_at(t, is_root_solved);
    case Counted_failure::Kind::unknown:
      break;
  }
  return std::nullopt;
}

std::optional<Certificate> counted_certificate_with_time(const Narrow_polynomial& p,
                                                         const Time& t) {
  auto result = counted_certificate(p, t, Certificate_state::any);
  if (result && result->kind == Certificate::Kind::fails && !result->failure) {
    result->failure = std::make_unique<Time>(to_polynomial(p), to_rational(result->bounds.lower),
                                             to_rational(result->bounds.upper));
  }
  return result;
}

Certificate exact_touch_certificate(const Polynomial& p, const Time& t) {
  const bool is_root_solved = p.degree() > 0;
  if (sign_just_after(p, t) == CGAL::NEGATIVE) return exact_certificate(t, is_root_solved);
  if (p.is_zero()) return exact_certificate(std::nullopt, is_root_solved);
  return exact_root_certificate(p, t);
}

Certificate exact_apart_certificate(const Polynomial& p, const Time& t) {
  if (sign_at(p, t) != CGAL::POSITIVE) return exact_failure_at(t, false);
  return exact_root_certificate(p, t);
}

std::optional<Certificate> counted_apart_certificate(const Narrow_polynomial& p, const Time& t) {
  const std::optional<Sign> now = count_sign(p, t.interval(), CGAL::ZERO);
  if (!now) return std::nullopt;
  if (*now != CGAL::POSITIVE) return exact_failure_at(t, false);
  return counted_certificate(p, t, Certificate_state::any);
}

Certificate exact_contact_certificate(const Polynomial& p, const Time& t) {
  std::optional<Time> contact = contact_time(p, t);
  if (contact && *contact == t) return exact_failure_at(t, false);
  const bool is_root_solved = contact.has_value();
  return exact_certificate(std::move(contact), is_root_solved);
}

std::optional<Certificate> counted_contact_certificate(const Narrow_polynomial& p, const Time& t) {
  using Kind = Counted_failure::Kind;
  if (p.degree() < 1) {
    const bool is_positive = !p.is_zero() && sign(p[0]) == CGAL::POSITIVE;
    return is_positive ? certain_for_ever(false) : exact_certificate(std::nullopt, false);
  }
  const Double_interval now = t.interval();
  const Counted_failure failure = count_failure(p, now, false);
  if (failure.kind == Kind::fails) return exact_failure_within(failure.bounds);
  if (failure.kind == Kind::never_fails) return certain_for_ever(false);
  // They touch or overlap, or nearly so. If the distance never decreases, there is no contact.
  const Kind slope = count_failure(derivative(p), now, false).kind;
  if (slope == Kind::never_fails) return exact_certificate(std::nullopt, false);
  if (slope == Kind::at_once && failure.kind == Kind::at_once) return exact_failure_at(t, false);
  return std::nullopt;
}

std::optional<Time> coincidence_time(const Polynomial& x, const Polynomial& y,
                                     const Polynomial& weight, const Time& t) {
  if (x.degree() > 1 || y.degree() > 1 || (x.degree() < 1 && y.degree() < 1)) {
    const Polynomial common = gcd(gcd(x, y), weight);
    if (common.degree() < 1) return std::nullopt;
    std::optional<Real_root> root = first_root_after(common, t);
    return root ? std::optional(std::move(root->value)) : std::nullopt;
  }
  // For linear polynomials: the root of one that is not constant, if the others vanish there.
  const Polynomial& moving = x.degree() == 1 ? x : y;
  const Polynomial& other = x.degree() == 1 ? y : x;
  const Rational root(-moving[0], moving[1]);
  if (other.sign_at(root) != CGAL::ZERO || weight.sign_at(root) != CGAL::ZERO ||
      compare(t, root) != CGAL::SMALLER) {
    return std::nullopt;
  }
  return Time(root);
}

}  // namespace kinetri
