// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/algebra/algebraic_number.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "binary64_ordinal.h"
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

// The order of numbers in disjoint intervals; none if they overlap.
std::optional<Comparison_result> order_of_disjoint(const Double_interval& x,
                                                   const Double_interval& y) {
  if (x.upper < y.lower) return CGAL::SMALLER;
  if (x.lower > y.upper) return CGAL::LARGER;
  return std::nullopt;
}

}  // namespace

void detail::Shared_bounds::narrow(const Double_interval& interval) {
  double seen = lower_.load(std::memory_order_relaxed);
  while (seen < interval.lower &&
         !lower_.compare_exchange_weak(seen, interval.lower, std::memory_order_release)) {
  }
  seen = upper_.load(std::memory_order_relaxed);
  while (seen > interval.upper &&
         !upper_.compare_exchange_weak(seen, interval.upper, std::memory_order_release)) {
  }
}

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
detail::Root_representation& Algebraic_number::representation() const {
  // The bounds first: if they come from a representation, it is visible below. Otherwise they
  // strictly bracket the number, even if they were read at different times.
  const Double_interval bracket = interval();
  Representation* present = source_->representation_.load(std::memory_order_acquire);
  if (present != nullptr) return *present;
  auto made = std::make_unique<Representation>(
      odd_part(source_->polynomial()), to_rational(bracket.lower), to_rational(bracket.upper));
  // If several threads have made one, the first wins.
  if (!source_->representation_.compare_exchange_strong(
          present, made.get(), std::memory_order_acq_rel, std::memory_order_acquire)) {
    return *present;
  }
  return *made.release();
}

detail::Root_access Algebraic_number::access() const {
  return {source_->bounds_, representation()};
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

void Algebraic_number::refine() const {
  if (is_binary64()) return;
  const Access r = access();
  if (!r->is_rational()) r->halve();
}

void Algebraic_number::refine_to_bits(unsigned bits) const {
  if (!is_binary64()) access()->refine_to_bits(static_cast<long>(bits));
}

void Algebraic_number::refine_to(const Rational& width) const {
  KINETRI_PRECONDITION(width.sign() > 0,
                       "an irrational number has no interval of width 0; ask for a greater one");
  if (!is_binary64()) access()->refine_to(width);
}

std::ostream& operator<<(std::ostream& out, const Algebraic_number& a) {
  if (a.is_known_rational()) return out << a.rational().str();
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "root of " << a.polynomial() << " in (" << a.interval().lower << ", " << a.interval().upper
      << ')';
  out.precision(precision);
  return out;
}

// --- Order --------------------------------------------------------------------------------------

Comparison_result compare(const Algebraic_number& a, const Rational& b) {
  if (a.is_binary64()) return detail::comparison(a.binary64_value().compare(b));
  return a.access()->compare_with(b);
}

Comparison_result compare(const Algebraic_number& a, const Algebraic_number& b) {
  if (a.bounds_.upper < b.bounds_.lower) return CGAL::SMALLER;
  if (a.bounds_.lower > b.bounds_.upper) return CGAL::LARGER;
  if (a.source_ == b.source_) return CGAL::EQUAL;  // also for two binary64 numbers that overlap
  if (const auto order = order_of_disjoint(a.interval(), b.interval())) return *order;
  if (a.is_binary64()) return CGAL::opposite(compare(b, a.binary64_value()));
  if (b.is_binary64()) return compare(a, b.binary64_value());
  return Algebraic_number::compare_exactly(a, b);
}

// Precondition: neither is a binary64 number, and they have different sources.
Comparison_result Algebraic_number::compare_exactly(const Algebraic_number& a,
                                                    const Algebraic_number& b) {
  const std::uint64_t identity = a.source_->identity_.load(std::memory_order_relaxed);
  if (identity != 0 && identity == b.source_->identity_.load(std::memory_order_relaxed)) {
    return CGAL::EQUAL;
  }
  a.narrow_by_source();
  b.narrow_by_source();
  if (const auto order = order_of_disjoint(a.interval(), b.interval())) return *order;
  Access x(a.source_->bounds_, a.representation(), std::defer_lock);
  Access y(b.source_->bounds_, b.representation(), std::defer_lock);
  std::lock(x, y);
  const Comparison_result order = Representation::compare(*x, *y);
  // Simultaneous events are compared several times; the identity makes the next comparison fast.
  if (order == CGAL::EQUAL) Root_source::share_identity(*a.source_, *b.source_);
  return order;
}

// Gives the sources of equal numbers one identity. Identities are not reused, so each belongs to
// one value; a value may have several.
void Root_source::share_identity(Root_source& a, Root_source& b) {
  static std::atomic<std::uint64_t> last = 0;
  std::uint64_t identity = a.identity_.load(std::memory_order_relaxed);
  if (identity == 0) identity = b.identity_.load(std::memory_order_relaxed);
  if (identity == 0) identity = last.fetch_add(1, std::memory_order_relaxed) + 1;
  a.identity_.store(identity, std::memory_order_relaxed);
  b.identity_.store(identity, std::memory_order_relaxed);
}

std::strong_ordering operator<=>(const Algebraic_number& a, const Algebraic_number& b) {
  return static_cast<int>(compare(a, b)) <=> 0;
}

bool operator==(const Algebraic_number& a, const Algebraic_number& b) {
  return compare(a, b) == CGAL::EQUAL;
}

// --- Rounding -----------------------------------------------------------------------------------

// If the polynomial of a number has not been made and its source knows the rounding, makes the
// bounds of the rounding the interval of the number.
void Algebraic_number::narrow_by_source() const {
  const Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) != nullptr) return;
  if (ordinal(present.lower) + 1 == ordinal(present.upper)) return;
  if (const std::optional<Rounding> rounding = source_->rounded(present)) {
    source_->bounds_.narrow(rounding->bounds);
  }
}

// The tight interval of a number whose polynomial has not been made, if its source knows enough
// signs. Linear interpolation of the values finds it: in so small an interval the polynomial is
// nearly linear.
std::optional<Double_interval> Algebraic_number::tighten_by_source() const {
  narrow_by_source();
  Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) != nullptr) return std::nullopt;
  std::int64_t below = ordinal(present.lower);
  std::int64_t above = ordinal(present.upper);
  if (below + 1 == above) return present;
  double value_below = source_->certain_value_at(present.lower, 0);
  double value_above = source_->certain_value_at(present.upper, 0);
  if (value_below == 0 || value_above == 0) return std::nullopt;
  for (int i = 0; below + 1 != above; ++i) {
    std::int64_t middle = std::midpoint(below, above);  // their difference may overflow
    if (i < 4) {
      const double share = value_below / (value_below - value_above);
      const double guess =
          from_ordinal(below) + share * (from_ordinal(above) - from_ordinal(below));
      // On alternating sides of the guess, so that both ends come near.
      middle = std::clamp(ordinal(guess) + i % 2, below + 1, above - 1);
    }
    const double value = source_->certain_value_at(from_ordinal(middle), 0);
    if (value == 0) return std::nullopt;
    if ((value > 0) == (value_below > 0)) {
      below = middle;
      value_below = value;
    } else {
      above = middle;
      value_above = value;
    }
    present = {from_ordinal(below), from_ordinal(above)};
    source_->bounds_.narrow(present);
  }
  return present;
}

Double_interval Algebraic_number::tight_interval() const {
  if (is_binary64()) return bounds_;
  if (const std::optional<Double_interval> tight = tighten_by_source()) return *tight;
  return access()->tight_interval();
}

double Algebraic_number::to_double() const {
  if (is_binary64()) return bounds_.lower;
  const Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) == nullptr) {
    if (const std::optional<Rounding> rounding = source_->rounded(present)) {
      source_->bounds_.narrow(rounding->bounds);
      return rounding->nearest;
    }
  }
  const Double_interval tight = tight_interval();
  if (source_->representation_.load(std::memory_order_acquire) == nullptr) {
    const double half = 0.5 * (tight.upper - tight.lower);
    const double value = source_->certain_value_at(tight.lower, half);
    const double value_below = source_->certain_value_at(tight.lower, 0);
    // Halfway between subnormal numbers there is no binary64 number.
    if (value != 0 && value_below != 0 && tight.lower + 2 * half == tight.upper && half > 0) {
      return (value > 0) == (value_below > 0) ? tight.upper : tight.lower;
    }
  }
  // The midpoint; IEEE 754 rounds as if infinity were 2^1024.
  const auto end = [](double x) {
    if (std::isfinite(x)) return to_rational(x);
    return scaled_by_power_of_two(x > 0 ? 1 : -1, std::numeric_limits<double>::max_exponent);
  };
  const Rational halfway = (end(tight.lower) + end(tight.upper)) / 2;
  const Comparison_result order = compare(*this, halfway);
  if (order == CGAL::EQUAL) return kinetri::to_double(halfway);
  return order == CGAL::SMALLER ? tight.lower : tight.upper;
}

// --- Signs --------------------------------------------------------------------------------------

bool Algebraic_number::is_root_of(const Polynomial& p) const {
  if (is_binary64()) return p.is_zero() || p.sign_at(binary64_value()) == CGAL::ZERO;
  return access()->is_root_of(p);
}

Sign sign_at(const Polynomial& p, const Algebraic_number& t) {
  if (p.degree() <= 0) return p.sign_at(0);
  if (t.is_binary64()) return p.sign_at(t.binary64_value());
  return t.access()->sign_of(p);
}

// The sign just after the number, or just before it if `side` is negative.
Sign Algebraic_number::sign_beside(const Polynomial& p, Sign side) const {
  if (!is_binary64()) {
    if (const auto s = access()->sign_of_own_polynomial_beside(p, side)) return *s;
  }
  Polynomial q = p;
  for (Sign factor = CGAL::POSITIVE; !q.is_zero(); factor = factor * side) {
    const Sign s = sign_at(q, *this);
    if (s != CGAL::ZERO) return s * factor;
    q = derivative(q);
  }
  return CGAL::ZERO;
}

Sign sign_just_before(const Polynomial& p, const Algebraic_number& t) {
  return t.sign_beside(p, CGAL::NEGATIVE);
}

Sign sign_just_after(const Polynomial& p, const Algebraic_number& t) {
  return t.sign_beside(p, CGAL::POSITIVE);
}

}  // namespace kinetri
