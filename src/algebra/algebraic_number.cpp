// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algebraic numbers: how they are made, what is known of them, how they are printed.
#include "kinetri/algebra/algebraic_number.h"

#include <limits>
#include <ostream>
#include <utility>
#include <vector>

#include "dyadic.h"
#include "kinetri/impl/base/check.h"
#include "representation.h"

namespace kinetri {

// --- Construction -------------------------------------------------------------------------------

namespace {

// The source of a number that has its representation from the start.
struct Known_root : Root_source {
  Polynomial polynomial() const override {
    KINETRI_ASSERT(false, "the representation is there");
    return {};
  }
};

}  // namespace

Root_source::Root_source() = default;
Root_source::~Root_source() {
  delete representation_.load(std::memory_order_acquire);
}

double Root_source::certain_value_at(double /*high*/, double /*low*/) const {
  return 0;
}

std::optional<Rounding> Root_source::rounded(const Double_interval& /*bracket*/) const {
  return std::nullopt;
}

Algebraic_number::Algebraic_number(const Rational& value) : bounds_(to_interval(value)) {
  if (bounds_.lower != bounds_.upper) adopt(std::make_unique<Representation>(value));
}

Algebraic_number::Algebraic_number(const Polynomial& p, const Rational& lower,
                                   const Rational& upper) {
  adopt(std::make_unique<Representation>(p, lower, upper));
  bounds_ = source_->representation_.load(std::memory_order_relaxed)->double_interval();
}

Algebraic_number::Algebraic_number(std::shared_ptr<Root_source> source,
                                   const Double_interval& bracket)
    : bounds_(bracket), source_(std::move(source)) {}

// Gives the number, which has no source yet, a source that has the representation.
void Algebraic_number::adopt(std::unique_ptr<Representation> representation) {
  source_ = std::make_shared<Known_root>();
  source_->representation_.store(representation.release(), std::memory_order_release);
}

Algebraic_number Algebraic_number::detached() const {
  if (is_binary64()) return *this;
  if (is_known_rational()) return rational();
  const Access r = access();
  if (r->is_rational()) return r->lower;
  return {r->polynomial(), r->lower_end(), r->upper_end()};
}

Algebraic_number Algebraic_number::operator-() const {
  if (is_binary64()) return 0.0 - bounds_.lower;  // zero has no sign
  const Access r = access();
  if (r->is_rational()) return Rational(-r->lower);
  const std::span<const Integer> own = r->own_polynomial.coefficients();
  std::vector<Integer> coefficients(own.begin(), own.end());
  for (std::size_t i = 1; i < coefficients.size(); i += 2) coefficients[i] = -coefficients[i];
  return {Polynomial(std::move(coefficients)), Rational(-r->upper_end()),
          Rational(-r->lower_end())};
}

// --- Access -------------------------------------------------------------------------------------

// The representation, made if it has not been. Precondition: this is no binary64 number.
Root_source::Representation& Algebraic_number::representation() const {
  // The bounds first: if they come from a representation, it is seen next. Those that come from
  // nothing else bracket the number strictly, however old each of them is.
  const Double_interval bracket = interval();
  Representation* present = source_->representation_.load(std::memory_order_acquire);
  if (present != nullptr) return *present;
  auto made = std::make_unique<Representation>(
      odd_part(source_->polynomial()), to_rational(bracket.lower), to_rational(bracket.upper));
  // Of several threads that have made one the first wins.
  if (!source_->representation_.compare_exchange_strong(
          present, made.get(), std::memory_order_acq_rel, std::memory_order_acquire)) {
    return *present;
  }
  return *made.release();
}

Root_source::Access Algebraic_number::access() const {
  return {*source_, representation()};
}

bool Algebraic_number::is_known_rational() const {
  return is_binary64() || access()->is_rational();
}

Rational Algebraic_number::rational() const {
  KINETRI_PRECONDITION(is_known_rational(),
                       "the number is not known to be rational; ask is_known_rational first");
  return is_binary64() ? binary64_value() : access()->lower;
}

Polynomial Algebraic_number::polynomial() const {
  if (!is_binary64()) return access()->polynomial();
  const Rational value = binary64_value();
  return Polynomial{Integer(-numerator(value)), denominator(value)};
}

Rational_interval Algebraic_number::isolating_interval() const {
  if (is_binary64()) return {binary64_value(), binary64_value()};
  const Access r = access();
  return {r->lower_end(), r->upper_end()};
}

std::ostream& operator<<(std::ostream& out, const Algebraic_number& a) {
  if (a.is_known_rational()) return out << a.rational().str();
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "root of " << a.polynomial() << " in (" << a.interval().lower << ", " << a.interval().upper
      << ')';
  out.precision(precision);
  return out;
}

}  // namespace kinetri
