// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real algebraic numbers. An isolating interval has dyadic ends over a common power of two, so that
// refinement and evaluation work on integers alone.
//
// Invariant of an isolation: a < b, the polynomial has opposite signs, not zero, at a / 2^e and
// b / 2^e, exactly one root between them, and zero is not strictly between them.
#include "kinetri/algebra/algebraic_number.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <forward_list>
#include <limits>
#include <numeric>
#include <optional>
#include <ostream>
#include <utility>

#include "gmp_access.h"
#include "kinetri/base/check.h"

namespace kinetri {
namespace {

Integer numerator(const Rational& x) {
  return boost::multiprecision::numerator(x);
}
Integer denominator(const Rational& x) {
  return boost::multiprecision::denominator(x);
}

Rational dyadic(const Integer& numerator, unsigned long exponent) {
  Rational result(numerator);
  mpq_div_2exp(result.backend().data(), result.backend().data(), exponent);
  return result;
}

// e where the denominator is 2^e; nothing for other rationals.
std::optional<unsigned long> dyadic_exponent(const Rational& x) {
  mpz_srcptr d = mpq_denref(x.backend().data());
  const mp_bitcnt_t shift = mpz_scan1(d, 0);
  if (shift + 1 != mpz_sizeinbase(d, 2)) return std::nullopt;
  return shift;
}

// floor(x 2^exponent) and ceil(x 2^exponent).
Integer scaled_floor(const Rational& x, long exponent) {
  const Rational scaled = scaled_by_power_of_two(x, exponent);
  Integer result;
  mpz_fdiv_q(raw(result), mpq_numref(scaled.backend().data()), mpq_denref(scaled.backend().data()));
  return result;
}

Integer scaled_ceil(const Rational& x, long exponent) {
  const Rational scaled = scaled_by_power_of_two(x, exponent);
  Integer result;
  mpz_cdiv_q(raw(result), mpq_numref(scaled.backend().data()), mpq_denref(scaled.backend().data()));
  return result;
}

// 2^(e n) p(x / 2^e), where n is the degree.
Integer scaled_value(const Polynomial& p, const Integer& x, unsigned long e) {
  const std::span<const Integer> c = p.coefficients();
  Integer result = c.back();
  Integer term;
  for (std::size_t i = c.size() - 1; i-- > 0;) {
    mpz_mul(raw(result), raw(result), raw(x));
    mpz_mul_2exp(raw(term), raw(c[i]), e * (c.size() - 1 - i));
    mpz_add(raw(result), raw(result), raw(term));
  }
  return result;
}

// The root of a polynomial of degree 1.
Rational linear_root(const Polynomial& p) {
  return Rational(Integer(-p[0]), p[1]);
}

Comparison_result comparison(int order) {
  return static_cast<Comparison_result>(order < 0 ? -1 : order > 0 ? 1 : 0);
}

// The position of a number among the binary64 numbers: neighbours differ by one, both zeros are 0.
std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

double from_ordinal(std::int64_t n) {
  return std::bit_cast<double>(n >= 0 ? n : std::numeric_limits<std::int64_t>::min() - n);
}

// More correct bits than a binary64 number has: two numbers that agree to so many are either equal,
// which the gcd of their polynomials tells, or exceptionally close.
constexpr long bits_before_gcd = 60;

// An isolating interval; see the top of this file.
struct Isolation {
  Integer a;
  Integer b;
  unsigned long e = 0;
  // 2^(e n) times the values of the polynomial, of degree n, at the ends.
  Integer value_a;
  Integer value_b;
  // The next quadratic step divides the interval into 2^k parts.
  unsigned long k = 2;

  bool is_narrower_than_bits(long bits) const {
    const Integer& near_zero = a.sign() >= 0 ? a : b;
    return !near_zero.is_zero() && bit_length(b - a) + bits < bit_length(near_zero);
  }
};

}  // namespace

// --- Representation ---------------------------------------------------------------------------

struct Root_source::Representation {
  explicit Representation(Rational number) : lower(std::move(number)) {}
  Representation(const Polynomial& p, const Rational& first, const Rational& last) {
    isolate(p, first, last);
  }

  bool is_rational() const { return !isolation; }
  const Polynomial& polynomial();
  const Rational& lower_end();
  const Rational& upper_end();
  const Double_interval& double_interval();

  void isolate(const Polynomial& p, const Rational& first, const Rational& last);
  void isolate_between_dyadic_ends(const Rational& first, const Rational& last);
  void become_rational(Rational number);
  void set_ends(Integer a, Integer b, unsigned long e);
  void narrow_to(const Rational& m, Sign side);
  Comparison_result compare_with(const Rational& m);
  void quadratic_step(unsigned long k_max);
  void halve();
  void refine_to_bits(long bits);
  bool is_root_of(const Polynomial& p);
  void use_factor(Polynomial factor);

  static bool changes_sign_over_intersection(const Polynomial& p, Representation& x,
                                             Representation& y);
  static Comparison_result compare(Representation& x, Representation& y);
  static Comparison_result compare_roots_of_one_polynomial(Representation& x, Representation& y);
  static bool are_equal(Representation& x, Representation& y);

  std::optional<Isolation> isolation;  // none where the number is known to be rational
  // The number itself where it is known to be rational; else the ends of the isolation, made when
  // they are asked for.
  Rational lower;
  Rational upper;
  bool ends_are_current = false;
  Double_interval interval;
  bool interval_is_current = false;
  // The newest first. The older ones stay, since references to them were given out.
  std::forward_list<Polynomial> polynomials;
  bool linear_is_made = false;
};

void Root_source::Representation::isolate(const Polynomial& p, const Rational& first,
                                          const Rational& last) {
  KINETRI_PRECONDITION(first < last, "the isolating interval is empty");
  KINETRI_PRECONDITION(p.degree() >= 1, "a polynomial without roots has no root to isolate");
  polynomials.push_front(primitive_part(p));

  const std::optional<unsigned long> e_first = dyadic_exponent(first);
  const std::optional<unsigned long> e_last = dyadic_exponent(last);
  if (e_first && e_last) {
    isolation.emplace();
    const auto e = static_cast<long>(std::max(*e_first, *e_last));
    set_ends(scaled_floor(first, e), scaled_floor(last, e), static_cast<unsigned long>(e));
    KINETRI_PRECONDITION(sign(isolation->value_a) * sign(isolation->value_b) == CGAL::NEGATIVE,
                         "the polynomial does not change sign over the isolating interval");
  } else {
    KINETRI_PRECONDITION(p.sign_at(first) * p.sign_at(last) == CGAL::NEGATIVE,
                         "the polynomial does not change sign over the isolating interval");
    isolate_between_dyadic_ends(first, last);
    if (is_rational()) return;
  }
  if (p.degree() == 1) return become_rational(linear_root(p));

  // Zero as an end, instead of inside, makes the number of correct bits grow with each refinement.
  if (isolation->a.sign() < 0 && isolation->b.sign() > 0) compare_with(0);
}

// Dyadic ends inside the given ones, on finer and finer grids until the root is between them.
void Root_source::Representation::isolate_between_dyadic_ends(const Rational& first,
                                                              const Rational& last) {
  const Rational width = last - first;
  long e = std::max(bit_length(denominator(width)) - bit_length(numerator(width)) + 2, 0L);
  for (;; e += 8) {
    const Integer a = scaled_ceil(first, e);
    const Integer b = scaled_floor(last, e);
    const Integer value_a = scaled_value(polynomials.front(), a, static_cast<unsigned long>(e));
    const Integer value_b = scaled_value(polynomials.front(), b, static_cast<unsigned long>(e));
    if (value_a.is_zero()) return become_rational(dyadic(a, static_cast<unsigned long>(e)));
    if (value_b.is_zero()) return become_rational(dyadic(b, static_cast<unsigned long>(e)));
    if (sign(value_a) == sign(value_b)) continue;
    isolation.emplace();
    return set_ends(a, b, static_cast<unsigned long>(e));
  }
}

const Polynomial& Root_source::Representation::polynomial() {
  if (is_rational() && !linear_is_made) {
    polynomials.push_front(Polynomial{Integer(-numerator(lower)), denominator(lower)});
    linear_is_made = true;
  }
  return polynomials.front();
}

const Rational& Root_source::Representation::lower_end() {
  if (!is_rational() && !ends_are_current) {
    lower = dyadic(isolation->a, isolation->e);
    upper = dyadic(isolation->b, isolation->e);
    ends_are_current = true;
  }
  return lower;
}

const Rational& Root_source::Representation::upper_end() {
  lower_end();
  return is_rational() ? lower : upper;
}

const Double_interval& Root_source::Representation::double_interval() {
  if (!interval_is_current) {
    interval = {to_interval(lower_end()).lower, to_interval(upper_end()).upper};
    interval_is_current = true;
  }
  return interval;
}

void Root_source::Representation::become_rational(Rational number) {
  isolation.reset();
  lower = std::move(number);
  interval_is_current = false;
}

// Precondition: the polynomial has opposite signs, not zero, at the ends.
void Root_source::Representation::set_ends(Integer a, Integer b, unsigned long e) {
  const mp_bitcnt_t common = std::min({mpz_scan1(raw(a), 0), mpz_scan1(raw(b), 0), e});
  isolation->a = a >> common;
  isolation->b = b >> common;
  isolation->e = e - common;
  isolation->value_a = scaled_value(polynomials.front(), isolation->a, isolation->e);
  isolation->value_b = scaled_value(polynomials.front(), isolation->b, isolation->e);
  ends_are_current = false;
  interval_is_current = false;
}

// Makes the dyadic number m an end of the isolation. `side` is the sign of the polynomial at m.
void Root_source::Representation::narrow_to(const Rational& m, Sign side) {
  Isolation& s = *isolation;
  const unsigned long e = *dyadic_exponent(m);
  const auto degree = static_cast<unsigned long>(polynomials.front().degree());
  if (e > s.e) {
    const unsigned long shift = e - s.e;
    s.a <<= shift;
    s.b <<= shift;
    s.value_a <<= shift * degree;
    s.value_b <<= shift * degree;
    s.e = e;
  }
  const bool is_lower = side == sign(s.value_a);
  Integer& end = is_lower ? s.a : s.b;
  Integer& value = is_lower ? s.value_a : s.value_b;
  end = numerator(m) << (s.e - e);
  value = scaled_value(polynomials.front(), end, s.e);
  ends_are_current = false;
  interval_is_current = false;
}

// The order of the number and m. An m inside the isolation becomes an end of it, if it can.
Comparison_result Root_source::Representation::compare_with(const Rational& m) {
  if (is_rational()) return comparison(lower.compare(m));
  if (m <= lower_end()) return CGAL::LARGER;
  if (m >= upper_end()) return CGAL::SMALLER;
  const Sign side = polynomials.front().sign_at(m);
  if (side == CGAL::ZERO) {
    become_rational(m);
    return CGAL::EQUAL;
  }
  const bool root_is_right = side == sign(isolation->value_a);
  if (dyadic_exponent(m)) narrow_to(m, side);
  return root_is_right ? CGAL::LARGER : CGAL::SMALLER;
}

// One step of quadratic interval refinement: the interval is divided into 2^k parts, k <= k_max,
// and the part in which the secant meets zero is tried. Where that is the right one, the next step
// has twice as many digits; else half as many. With k = 1 it is bisection.
void Root_source::Representation::quadratic_step(unsigned long k_max) {
  Isolation& s = *isolation;
  const Polynomial& p = polynomials.front();
  const auto degree = static_cast<unsigned long>(p.degree());
  const unsigned long k = std::max(std::min(s.k, k_max), 1UL);
  const Integer part = s.b - s.a;
  s.e += k;
  s.a <<= k;
  s.b <<= k;
  s.value_a <<= k * degree;
  s.value_b <<= k * degree;
  ends_are_current = false;
  interval_is_current = false;

  // The position of the secant's zero in parts, rounded. It is only a guess: k + 32 leading bits of
  // the values will do.
  Integer size_a = boost::multiprecision::abs(s.value_a);
  Integer size_sum = size_a + boost::multiprecision::abs(s.value_b);
  const long excess = bit_length(size_sum) - static_cast<long>(k) - 32;
  if (excess > 0) {
    size_a >>= static_cast<unsigned long>(excess);
    size_sum >>= static_cast<unsigned long>(excess);
  }
  const Integer parts = Integer(1) << k;
  const Integer j = std::min<Integer>(((size_a << (k + 1)) + size_sum) / (size_sum << 1), parts);

  const Sign sign_a = sign(s.value_a);
  bool root_is_right = j.is_zero();
  if (!j.is_zero() && j != parts) {
    Integer x = s.a + j * part;
    Integer value = scaled_value(p, x, s.e);
    if (value.is_zero()) return become_rational(dyadic(x, s.e));
    root_is_right = sign(value) == sign_a;
    (root_is_right ? s.a : s.b) = std::move(x);
    (root_is_right ? s.value_a : s.value_b) = std::move(value);
  }
  if (s.b - s.a > part) {
    Integer x = root_is_right ? s.a + part : s.b - part;
    Integer value = scaled_value(p, x, s.e);
    if (value.is_zero()) return become_rational(dyadic(x, s.e));
    const bool is_lower = sign(value) == sign_a;
    (is_lower ? s.a : s.b) = std::move(x);
    (is_lower ? s.value_a : s.value_b) = std::move(value);
  }
  if (s.b - s.a == part) {
    s.k = std::max(s.k, 2 * k);
  } else {
    s.k = std::max(k / 2, 1UL);
  }
}

void Root_source::Representation::halve() {
  const Integer width = isolation->b - isolation->a;
  const unsigned long e = isolation->e;
  do {
    quadratic_step(std::numeric_limits<unsigned long>::max());
  } while (!is_rational() && ((isolation->b - isolation->a) << 1) > (width << (isolation->e - e)));
}

void Root_source::Representation::refine_to_bits(long bits) {
  while (!is_rational() && !isolation->is_narrower_than_bits(bits)) {
    const Integer& near_zero = isolation->a.sign() >= 0 ? isolation->a : isolation->b;
    // No more digits than are asked for, unless it is unknown yet how small the number is.
    const long missing = near_zero.is_zero() ? std::numeric_limits<long>::max()
                                             : bit_length(isolation->b - isolation->a) + bits -
                                                   bit_length(near_zero) + 1;
    quadratic_step(static_cast<unsigned long>(missing));
  }
}

// The gcd has the number as a root where it changes sign over the isolating interval: as a divisor
// of polynomial() it has no other root there, and a simple one only.
bool Root_source::Representation::is_root_of(const Polynomial& p) {
  if (p.is_zero()) return true;
  if (is_rational()) return p.sign_at(lower) == CGAL::ZERO;
  if (equal_up_to_sign(p, polynomials.front())) return true;
  Polynomial common = gcd(p, polynomials.front());
  if (common.degree() == 0) return false;
  if (common.sign_at(lower_end()) == common.sign_at(upper_end())) return false;
  use_factor(std::move(common));
  return true;
}

// Precondition: `factor` divides the polynomial and has the number as a root.
void Root_source::Representation::use_factor(Polynomial factor) {
  if (factor.degree() == 1) return become_rational(linear_root(factor));
  if (factor.degree() == polynomials.front().degree()) return;
  polynomials.push_front(std::move(factor));
  set_ends(isolation->a, isolation->b, isolation->e);
}

// --- Construction and access ------------------------------------------------------------------

namespace {

constexpr Double_interval everything = {-std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::infinity()};

// The source of a number that has its representation from the start.
struct Known_root : Root_source {
  Polynomial polynomial() const override {
    KINETRI_ASSERT(false, "the representation is there");
    return {};
  }
};

}  // namespace

Root_source::Root_source() = default;
Root_source::~Root_source() = default;

double Root_source::certain_value_at(double /*high*/, double /*low*/) const {
  return 0;
}

Algebraic_number::Algebraic_number(const Rational& value)
    : interval_(everything), source_(std::make_shared<Known_root>()) {
  source_->representation_ = std::make_unique<Representation>(value);
}

Algebraic_number::Algebraic_number(const Polynomial& p, const Rational& lower,
                                   const Rational& upper)
    : interval_(everything), source_(std::make_shared<Known_root>()) {
  source_->representation_ = std::make_unique<Representation>(p, lower, upper);
}

Algebraic_number::Algebraic_number(std::shared_ptr<Root_source> source,
                                   const Double_interval& bracket)
    : interval_(bracket), source_(std::move(source)) {}

Root_source::Representation& Algebraic_number::representation() const {
  if (source_ == nullptr) {
    source_ = std::make_shared<Known_root>();
    source_->representation_ = std::make_unique<Representation>(to_rational(interval_.lower));
  } else if (source_->representation_ == nullptr) {
    source_->representation_ = std::make_unique<Representation>(odd_part(source_->polynomial()),
                                                                to_rational(interval_.lower),
                                                                to_rational(interval_.upper));
  }
  return *source_->representation_;
}

bool Algebraic_number::is_known_rational() const {
  return representation().is_rational();
}

const Rational& Algebraic_number::rational() const {
  KINETRI_PRECONDITION(is_known_rational(),
                       "the number is not known to be rational; ask is_known_rational first");
  return representation().lower;
}

const Polynomial& Algebraic_number::polynomial() const {
  return representation().polynomial();
}

const Rational& Algebraic_number::lower() const {
  return representation().lower_end();
}

const Rational& Algebraic_number::upper() const {
  return representation().upper_end();
}

Algebraic_number Algebraic_number::detached() const {
  if (source_ == nullptr) return *this;
  if (is_known_rational()) return rational();
  return {polynomial(), lower(), upper()};
}

Algebraic_number Algebraic_number::operator-() const {
  if (source_ == nullptr) return 0.0 - interval_.lower;  // zero has no sign
  if (is_known_rational()) return Rational(-rational());
  std::vector<Integer> coefficients(polynomial().coefficients().begin(),
                                    polynomial().coefficients().end());
  for (std::size_t i = 1; i < coefficients.size(); i += 2) coefficients[i] = -coefficients[i];
  return {Polynomial(std::move(coefficients)), Rational(-upper()), Rational(-lower())};
}

void Algebraic_number::follow_representation() const {
  interval_ = source_->representation_->double_interval();
}

bool Algebraic_number::is_root_of(const Polynomial& p) const {
  return representation().is_root_of(p);
}

// --- Refinement -------------------------------------------------------------------------------

void Algebraic_number::refine() const {
  if (!representation().is_rational()) representation().halve();
}

void Algebraic_number::refine_to_bits(unsigned bits) const {
  representation().refine_to_bits(static_cast<long>(bits));
}

void Algebraic_number::refine_to(const Rational& width) const {
  KINETRI_PRECONDITION(width.sign() > 0,
                       "an irrational number has no interval of width 0; ask for a greater one");
  Representation& r = representation();
  // 2^exponent <= width
  const long exponent = bit_length(numerator(width)) - bit_length(denominator(width)) - 1;
  while (!r.is_rational()) {
    const long present =
        bit_length(r.isolation->b - r.isolation->a) - static_cast<long>(r.isolation->e);
    if (present <= exponent) return;
    r.quadratic_step(static_cast<unsigned long>(present - exponent));
  }
}

// --- Approximation ----------------------------------------------------------------------------

// Narrows the interval of a number whose polynomial has not been made to two neighbors, by the
// signs that its source knows. Returns whether these were enough. The values there say where to
// look: within so small an interval they are all but on a line.
bool Algebraic_number::tighten_by_source() const {
  if (source_ == nullptr || source_->representation_ != nullptr) return false;
  std::int64_t below = ordinal(interval_.lower);
  std::int64_t above = ordinal(interval_.upper);
  if (below + 1 == above) return true;
  double value_below = source_->certain_value_at(interval_.lower, 0);
  double value_above = source_->certain_value_at(interval_.upper, 0);
  if (value_below == 0 || value_above == 0) return false;
  for (int i = 0; below + 1 != above; ++i) {
    std::int64_t middle = std::midpoint(below, above);  // their difference may overflow
    if (i < 4) {
      const double share = value_below / (value_below - value_above);
      const double guess =
          from_ordinal(below) + share * (from_ordinal(above) - from_ordinal(below));
      // Beside the guess, on either side in turn, so that both ends come near.
      middle = std::clamp(ordinal(guess) + i % 2, below + 1, above - 1);
    }
    const double value = source_->certain_value_at(from_ordinal(middle), 0);
    if (value == 0) return false;
    if ((value > 0) == (value_below > 0)) {
      below = middle;
      value_below = value;
    } else {
      above = middle;
      value_above = value;
    }
    interval_ = {from_ordinal(below), from_ordinal(above)};
  }
  return true;
}

Double_interval Algebraic_number::tight_interval() const {
  if (source_ == nullptr || tighten_by_source()) return interval_;
  Representation& r = representation();
  while (!r.is_rational()) {
    const double below = to_interval(lower()).lower;
    const double above = to_interval(upper()).upper;
    // The number is strictly between the ends of the isolation, so it can be a binary64 number only
    // if there is one strictly between these two.
    const std::int64_t first = ordinal(below);
    const std::int64_t candidates = ordinal(above) - first - 1;
    if (candidates == 0) return {below, above};
    if (candidates <= 3) {
      r.compare_with(to_rational(from_ordinal(first + (candidates + 1) / 2)));
    } else {
      r.quadratic_step(std::numeric_limits<unsigned long>::max());
    }
  }
  return to_interval(r.lower);
}

double Algebraic_number::to_double() const {
  const Double_interval tight = tight_interval();
  if (source_ == nullptr) return tight.lower;
  if (source_->representation_ == nullptr) {
    const double half = 0.5 * (tight.upper - tight.lower);
    const double value = source_->certain_value_at(tight.lower, half);
    const double value_below = source_->certain_value_at(tight.lower, 0);
    // Halfway between subnormal numbers there is no binary64 number.
    if (value != 0 && value_below != 0 && tight.lower + 2 * half == tight.upper && half > 0) {
      return (value > 0) == (value_below > 0) ? tight.upper : tight.lower;
    }
  }
  if (is_known_rational()) return kinetri::to_double(rational());
  // Halfway, also where the upper neighbour is infinite: IEEE 754 rounds as if it were 2^1024.
  const auto end = [](double x) {
    if (std::isfinite(x)) return to_rational(x);
    return scaled_by_power_of_two(x > 0 ? 1 : -1, std::numeric_limits<double>::max_exponent);
  };
  const Rational halfway = (end(tight.lower) + end(tight.upper)) / 2;
  const Comparison_result order = representation().compare_with(halfway);
  if (order == CGAL::EQUAL) return kinetri::to_double(rational());
  return order == CGAL::SMALLER ? tight.lower : tight.upper;
}

Big_float Algebraic_number::to_big_float(unsigned bits) const {
  KINETRI_PRECONDITION(bits >= 2, "the precision is less than 2 bits");
  Representation& r = representation();
  Big_float result;
  mpfr_set_prec(result.backend().data(), static_cast<mpfr_prec_t>(bits));

  // Between two neighbours of precision bits + 1 all numbers round alike.
  Big_float below;
  Big_float above;
  mpfr_set_prec(below.backend().data(), static_cast<mpfr_prec_t>(bits) + 1);
  mpfr_set_prec(above.backend().data(), static_cast<mpfr_prec_t>(bits) + 1);
  while (!r.is_rational()) {
    mpfr_set_q(below.backend().data(), lower().backend().data(), MPFR_RNDD);
    mpfr_set_q(above.backend().data(), upper().backend().data(), MPFR_RNDU);
    mpfr_nextabove(below.backend().data());
    if (mpfr_cmp(below.backend().data(), above.backend().data()) >= 0) {
      const Rational inside = (lower() + upper()) / 2;
      mpfr_set_q(result.backend().data(), inside.backend().data(), MPFR_RNDN);
      return result;
    }
    mpfr_nextbelow(above.backend().data());
    if (mpfr_cmp(below.backend().data(), above.backend().data()) == 0) {
      Rational candidate;
      mpfr_get_q(candidate.backend().data(), below.backend().data());
      r.compare_with(candidate);
    } else {
      r.quadratic_step(std::numeric_limits<unsigned long>::max());
    }
  }
  mpfr_set_q(result.backend().data(), r.lower.backend().data(), MPFR_RNDN);
  return result;
}

// --- Comparison -------------------------------------------------------------------------------

namespace {

// The order of two dyadic numbers x / 2^e and y / 2^f.
int compare_dyadic(const Integer& x, unsigned long e, const Integer& y, unsigned long f) {
  if (e == f) return x.compare(y);
  return e < f ? Integer(x << (f - e)).compare(y) : x.compare(Integer(y << (e - f)));
}

// The order of numbers in intervals that do not overlap; nothing where they do.
std::optional<Comparison_result> order_of_disjoint(const Isolation& s, const Isolation& t) {
  if (compare_dyadic(s.b, s.e, t.a, t.e) <= 0) return CGAL::SMALLER;
  if (compare_dyadic(s.a, s.e, t.b, t.e) >= 0) return CGAL::LARGER;
  return std::nullopt;
}

}  // namespace

// Whether p changes sign over the intersection of two overlapping isolating intervals. Each end of
// it is an end of one of them.
bool Root_source::Representation::changes_sign_over_intersection(const Polynomial& p,
                                                                 Representation& x,
                                                                 Representation& y) {
  return p.sign_at(std::max(x.lower_end(), y.lower_end())) !=
         p.sign_at(std::min(x.upper_end(), y.upper_end()));
}

// The order of two roots of one polynomial in overlapping intervals. They are equal where it
// changes sign over the intersection, which then holds the only root of either interval. Else each
// number is in the part of its interval that the other does not share, so neither interval contains
// the other.
Comparison_result Root_source::Representation::compare_roots_of_one_polynomial(Representation& x,
                                                                               Representation& y) {
  if (changes_sign_over_intersection(x.polynomials.front(), x, y)) return CGAL::EQUAL;
  return comparison(x.lower_end().compare(y.lower_end()));
}

// Whether two numbers in overlapping intervals are equal. A root of the gcd of their polynomials in
// the intersection is a root of both, so it is both numbers; the ends are not roots of it, each
// being an end of an isolating interval. Equal numbers get that gcd as their polynomial, to be
// compared without a gcd from then on.
bool Root_source::Representation::are_equal(Representation& x, Representation& y) {
  const Polynomial common = gcd(x.polynomials.front(), y.polynomials.front());
  if (common.degree() == 0 || !changes_sign_over_intersection(common, x, y)) return false;
  x.use_factor(common);
  y.use_factor(common);
  return true;
}

Comparison_result compare(const Algebraic_number& a, const Rational& b) {
  return a.representation().compare_with(b);
}

Comparison_result compare(const Algebraic_number& a, const Algebraic_number& b) {
  if (a.interval_.upper < b.interval_.lower) return CGAL::SMALLER;
  if (a.interval_.lower > b.interval_.upper) return CGAL::LARGER;
  if (a.source_ == b.source_) return CGAL::EQUAL;  // also for two binary64 numbers that overlap
  if (a.interval().upper < b.interval().lower) return CGAL::SMALLER;
  if (a.interval().lower > b.interval().upper) return CGAL::LARGER;
  const Comparison_result order =
      Algebraic_number::Representation::compare(a.representation(), b.representation());
  // Of many simultaneous events each is compared with several others: once is enough.
  if (order == CGAL::EQUAL) b.source_ = a.source_;
  return order;
}

Comparison_result Root_source::Representation::compare(Representation& x, Representation& y) {
  bool known_different = false;
  while (!x.is_rational() && !y.is_rational()) {
    const Isolation& s = *x.isolation;
    const Isolation& t = *y.isolation;
    if (const std::optional<Comparison_result> order = order_of_disjoint(s, t)) return *order;

    if (!known_different && equal_up_to_sign(x.polynomials.front(), y.polynomials.front())) {
      return compare_roots_of_one_polynomial(x, y);
    }
    if (!known_different && s.is_narrower_than_bits(bits_before_gcd) &&
        t.is_narrower_than_bits(bits_before_gcd)) {
      if (are_equal(x, y)) return CGAL::EQUAL;
      known_different = true;
    }
    const bool x_is_wider = compare_dyadic(s.b - s.a, s.e, t.b - t.a, t.e) >= 0;
    (x_is_wider ? x : y).quadratic_step(std::numeric_limits<unsigned long>::max());
  }
  if (y.is_rational()) return x.compare_with(y.lower);
  return CGAL::opposite(y.compare_with(x.lower));
}

std::strong_ordering operator<=>(const Algebraic_number& a, const Algebraic_number& b) {
  return static_cast<int>(compare(a, b)) <=> 0;
}

bool operator==(const Algebraic_number& a, const Algebraic_number& b) {
  return compare(a, b) == CGAL::EQUAL;
}

std::ostream& operator<<(std::ostream& out, const Algebraic_number& a) {
  if (a.is_known_rational()) return out << a.rational().str();
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "root of " << a.polynomial() << " in (" << a.interval().lower << ", " << a.interval().upper
      << ')';
  out.precision(precision);
  return out;
}

// --- Signs of polynomials ---------------------------------------------------------------------

Sign sign_at(const Polynomial& p, const Algebraic_number& t) {
  if (p.degree() <= 0) return p.sign_at(0);
  if (t.is_known_rational()) return p.sign_at(t.rational());
  if (equal_up_to_sign(p, t.polynomial())) return CGAL::ZERO;
  for (unsigned bits = 0;; bits = bits == 0 ? 24 : 2 * bits) {
    if (bits != 0) t.refine_to_bits(bits);
    if (t.is_known_rational()) return p.sign_at(t.rational());
    if (const std::optional<Sign> s = p.sign_on(t.lower(), t.upper())) return *s;
    // Tested once, between 24 bits and 48: nearly all that is not zero has been told by then.
    if (bits == 24 && t.is_root_of(p)) return CGAL::ZERO;
  }
}

namespace {

// The sign beside t, on the side towards which odd powers have the sign `odd`.
Sign sign_beside(const Polynomial& p, const Algebraic_number& t, Sign odd) {
  // The end of the isolating interval on that side is as good as beside t where p has no other root
  // up to it. So it is after a flip, where p is minus the polynomial that made t.
  if (!t.is_known_rational() && equal_up_to_sign(p, t.polynomial())) {
    return p.sign_at(odd == CGAL::POSITIVE ? t.upper() : t.lower());
  }
  Polynomial q = p;
  for (Sign factor = CGAL::POSITIVE; !q.is_zero(); factor = factor * odd) {
    const Sign s = sign_at(q, t);
    if (s != CGAL::ZERO) return s * factor;
    q = derivative(q);
  }
  return CGAL::ZERO;
}

}  // namespace

Sign sign_just_before(const Polynomial& p, const Algebraic_number& t) {
  return sign_beside(p, t, CGAL::NEGATIVE);
}

Sign sign_just_after(const Polynomial& p, const Algebraic_number& t) {
  return sign_beside(p, t, CGAL::POSITIVE);
}

// --- The simplest number between --------------------------------------------------------------

namespace {

// floor(|x| 2^e), exactly.
Integer scaled_magnitude_floor(const Algebraic_number& x, long e) {
  for (;;) {
    const bool negative = x.lower().sign() < 0;
    const Rational near_zero = boost::multiprecision::abs(negative ? x.upper() : x.lower());
    const Rational far = boost::multiprecision::abs(negative ? x.lower() : x.upper());
    const Integer least = scaled_floor(near_zero, e);
    const Integer greatest = scaled_floor(far, e);
    if (least == greatest) return least;
    if (greatest - least > 1) {
      x.refine();
      continue;
    }
    // One grid point in question: on which side of it is the number?
    const Rational grid_point = scaled_by_power_of_two(greatest, -e);
    const Comparison_result order = compare(x, negative ? Rational(-grid_point) : grid_point);
    return order == (negative ? CGAL::LARGER : CGAL::SMALLER) ? least : greatest;
  }
}

}  // namespace

Rational simplest_between(const Algebraic_number& a, const Algebraic_number& b) {
  KINETRI_PRECONDITION(compare(a, b) == CGAL::SMALLER, "the interval is empty");
  const bool positive = compare(a, Rational(0)) != CGAL::SMALLER;
  if (!positive && compare(b, Rational(0)) == CGAL::LARGER) return 0;
  const Algebraic_number& near_zero = positive ? a : b;
  const Algebraic_number& far = positive ? b : a;

  // The candidate for an exponent e is the multiple of 2^-e next to the end nearer to zero. If it
  // is in the interval for one e, so is a candidate for each greater e.
  Rational candidate;
  const auto is_inside = [&](long e) {
    const Integer k = scaled_magnitude_floor(near_zero, e) + 1;
    candidate = scaled_by_power_of_two(positive ? k : Integer(-k), -e);
    return compare(far, candidate) == (positive ? CGAL::LARGER : CGAL::SMALLER);
  };

  // 2^-outside >= |far|, so nothing is inside for this exponent.
  const Rational bound = boost::multiprecision::abs(positive ? far.upper() : far.lower());
  long outside = bit_length(denominator(bound)) - bit_length(numerator(bound)) - 1;
  long inside = outside + 1;
  for (long step = 1; !is_inside(inside); step *= 2) {
    outside = inside;
    inside += step;
  }
  while (inside - outside > 1) {
    const long middle = outside + (inside - outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  is_inside(inside);
  return candidate;
}

}  // namespace kinetri
