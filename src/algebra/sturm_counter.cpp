// SPDX-License-Identifier: GPL-3.0-or-later
#include "sturm_counter.h"

#include <mpfr.h>

#include <array>
#include <utility>
#include <vector>

#include "gmp_access.h"
#include "static_polynomial.h"

namespace kinetri {
namespace detail {

inline constexpr mpfr_prec_t first_precision = 191;
inline constexpr mpfr_prec_t most_precision = 4096;

// An interval [low, high] with the given precision that contains a number.
class Enclosed {
 public:
  explicit Enclosed(mpfr_prec_t precision) {
    mpfr_init2(low_, precision);
    mpfr_init2(high_, precision);
  }
  Enclosed(Enclosed&& other) noexcept : Enclosed(MPFR_PREC_MIN) { swap(other); }
  Enclosed& operator=(Enclosed&& other) noexcept {
    swap(other);
    return *this;
  }
  Enclosed(const Enclosed&) = delete;
  Enclosed& operator=(const Enclosed&) = delete;
  ~Enclosed() {
    mpfr_clear(low_);
    mpfr_clear(high_);
  }

  void set(const Integer& x) {
    mpfr_set_z(low_, raw(x), MPFR_RNDD);
    mpfr_set_z(high_, raw(x), MPFR_RNDU);
  }
  void set(const Rational& x) {
    mpfr_set_q(low_, x.backend().data(), MPFR_RNDD);
    mpfr_set_q(high_, x.backend().data(), MPFR_RNDU);
  }
  void set(const Enclosed& x) {
    mpfr_set(low_, x.low_, MPFR_RNDD);
    mpfr_set(high_, x.high_, MPFR_RNDU);
  }
  void negate() {
    mpfr_neg(low_, low_, MPFR_RNDN);
    mpfr_neg(high_, high_, MPFR_RNDN);
    mpfr_swap(low_, high_);
  }
  void add(const Enclosed& x) {
    mpfr_add(low_, low_, x.low_, MPFR_RNDD);
    mpfr_add(high_, high_, x.high_, MPFR_RNDU);
  }
  // Precondition: `x` and this are different objects.
  void subtract(const Enclosed& x) {
    mpfr_sub(low_, low_, x.high_, MPFR_RNDD);
    mpfr_sub(high_, high_, x.low_, MPFR_RNDU);
  }
  // Precondition: a and b are other objects than this one.
  void set_product(const Enclosed& a, const Enclosed& b) {
    const Enclosed* x = &a;
    const Enclosed* y = &b;
    if (x->is_mixed()) std::swap(x, y);
    if (x->is_mixed()) return set_product_of_mixed(*x, *y);
    // The signs decide which bounds of x and y are multiplied.
    const bool is_positive = mpfr_sgn(x->low_) >= 0;
    const auto& of_low = is_positive ? y->low_ : y->high_;
    const auto& of_high = is_positive ? y->high_ : y->low_;
    mpfr_mul(low_, mpfr_sgn(of_low) < 0 ? x->high_ : x->low_, of_low, MPFR_RNDD);
    mpfr_mul(high_, mpfr_sgn(of_high) < 0 ? x->low_ : x->high_, of_high, MPFR_RNDU);
  }
  // Precondition: the sign of x is certain, and not zero.
  void set_quotient(const Enclosed& one, const Enclosed& x) {
    mpfr_div(low_, one.low_, x.high_, MPFR_RNDD);
    mpfr_div(high_, one.high_, x.low_, MPFR_RNDU);
  }
  // None if it is not certain; zero only for [0, 0].
  std::optional<Sign> sign() const {
    if (mpfr_sgn(low_) > 0) return CGAL::POSITIVE;
    if (mpfr_sgn(high_) < 0) return CGAL::NEGATIVE;
    if (mpfr_zero_p(low_) != 0 && mpfr_zero_p(high_) != 0) return CGAL::ZERO;
    return std::nullopt;
  }

 private:
  bool is_mixed() const { return mpfr_sgn(low_) < 0 && mpfr_sgn(high_) > 0; }
  void swap(Enclosed& other) noexcept {
    mpfr_swap(low_, other.low_);
    mpfr_swap(high_, other.high_);
  }
  void set_product_of_mixed(const Enclosed& x, const Enclosed& y) {
    Enclosed other(mpfr_get_prec(low_));
    mpfr_mul(low_, x.low_, y.high_, MPFR_RNDD);
    mpfr_mul(other.low_, x.high_, y.low_, MPFR_RNDD);
    mpfr_min(low_, low_, other.low_, MPFR_RNDD);
    mpfr_mul(high_, x.low_, y.low_, MPFR_RNDU);
    mpfr_mul(other.high_, x.high_, y.high_, MPFR_RNDU);
    mpfr_max(high_, high_, other.high_, MPFR_RNDU);
  }

  mpfr_t low_;   // NOLINT(modernize-avoid-c-arrays): MPFR's type
  mpfr_t high_;  // NOLINT(modernize-avoid-c-arrays)
};

using Enclosed_polynomial = std::vector<Enclosed>;  // by ascending power

}  // namespace detail

// The signed remainders of f and f', in intervals.
class Interval_sturm_sequence {
  using Enclosed = detail::Enclosed;
  using Enclosed_polynomial = detail::Enclosed_polynomial;

 public:
  Interval_sturm_sequence(const Polynomial& f, mpfr_prec_t precision)
      : precision_(precision), first_(f), second_(derivative(f)) {
    terms_.push_back(enclosed(first_));
    terms_.push_back(enclosed(second_));
    while (terms_.back().size() > 1 && terms_.back().back().sign().value_or(CGAL::ZERO) != 0) {
      terms_.push_back(next_term());
    }
    // False if a leading coefficient may be zero.
    is_certain_ = terms_.back().back().sign().value_or(CGAL::ZERO) != 0;
  }

  mpfr_prec_t precision() const { return precision_; }

  std::optional<int> changes_at(const Rational& t) const {
    Enclosed place(precision_);
    place.set(t);
    Enclosed value(precision_);
    Enclosed product(precision_);
    return changes([&](std::size_t k) -> std::optional<Sign> {
      if (k == 0) return first_.sign_at(t);
      if (k == 1) return second_.sign_at(t);
      const Enclosed_polynomial& term = terms_[k];
      value.set(term.back());
      for (std::size_t i = term.size() - 1; i-- > 0;) {
        product.set_product(value, place);
        product.add(term[i]);
        std::swap(product, value);
      }
      return value.sign();
    });
  }
  std::optional<int> changes_at_infinity(bool is_positive) const {
    return changes([&](std::size_t k) -> std::optional<Sign> {
      const auto s = terms_[k].back().sign();
      return s && !is_positive && terms_[k].size() % 2 == 0 ? -*s : s;
    });
  }

 private:
  Enclosed_polynomial enclosed(const Polynomial& p) const {
    Enclosed_polynomial result;
    for (const Integer& c : p.coefficients()) result.emplace_back(precision_).set(c);
    return result;
  }

  // Minus the remainder of the last term but one divided by the last one, whose degree is less
  // by 1.
  Enclosed_polynomial next_term() const {
    const Enclosed_polynomial& divisor = terms_.back();
    Enclosed_polynomial rest;
    for (const Enclosed& c : terms_[terms_.size() - 2]) rest.emplace_back(precision_).set(c);
    Enclosed quotient(precision_);
    Enclosed product(precision_);
    for (int step = 0; step < 2; ++step) {
      quotient.set_product(rest.back(), inverse_of(divisor.back()));
      rest.pop_back();
      const std::size_t shift = rest.size() + 1 - divisor.size();
      for (std::size_t i = 0; i + 1 < divisor.size(); ++i) {
        product.set_product(quotient, divisor[i]);
        rest[i + shift].subtract(product);
      }
    }
    for (Enclosed& c : rest) c.negate();
    return rest;
  }
  Enclosed inverse_of(const Enclosed& x) const {
    Enclosed one(precision_);
    one.set(Integer(1));
    Enclosed result(precision_);
    result.set_quotient(one, x);
    return result;
  }

  template <class Sign_of>
  std::optional<int> changes(const Sign_of& sign_of) const {
    if (!is_certain_) return std::nullopt;
    int result = 0;
    Sign previous = CGAL::ZERO;
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      const std::optional<Sign> present = sign_of(k);
      if (!present) return std::nullopt;
      if (*present == CGAL::ZERO) continue;
      if (*present == -previous) ++result;
      previous = *present;
    }
    return result;
  }

  mpfr_prec_t precision_;
  Polynomial first_;
  Polynomial second_;
  std::vector<Enclosed_polynomial> terms_;
  bool is_certain_ = false;
};

Sturm_counter::Sturm_counter(const Polynomial& f) : f_(f) {
  if (f.degree() <= Static_polynomial<Integer>::most) {
    exact_.emplace(f);
  } else {
    intervals_ = std::make_unique<Interval_sturm_sequence>(f, detail::first_precision);
  }
}

Sturm_counter::~Sturm_counter() = default;

template <class Certain, class Exact>
int Sturm_counter::changes(const Certain& certain, const Exact& exact) {
  while (intervals_ != nullptr) {
    if (const std::optional<int> result = certain(*intervals_)) return *result;
    const mpfr_prec_t next = 2 * intervals_->precision();
    intervals_ = next > detail::most_precision
                     ? nullptr
                     : std::make_unique<Interval_sturm_sequence>(f_, next);
  }
  if (!exact_) exact_.emplace(f_);
  return exact(*exact_);
}

int Sturm_counter::changes_at(const Rational& t) {
  return changes([&](const Interval_sturm_sequence& s) { return s.changes_at(t); },
                 [&](const Sturm_sequence& s) { return s.sign_changes_at(t); });
}

int Sturm_counter::changes_at_plus_infinity() {
  return changes([](const Interval_sturm_sequence& s) { return s.changes_at_infinity(true); },
                 [](const Sturm_sequence& s) { return s.sign_changes_at_plus_infinity(); });
}

int Sturm_counter::changes_at_minus_infinity() {
  return changes([](const Interval_sturm_sequence& s) { return s.changes_at_infinity(false); },
                 [](const Sturm_sequence& s) { return s.sign_changes_at_minus_infinity(); });
}

}  // namespace kinetri
