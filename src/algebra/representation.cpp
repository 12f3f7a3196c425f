// SPDX-License-Identifier: GPL-3.0-or-later
#include "representation.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "binary64_ordinal.h"
#include "dyadic.h"
#include "gmp_access.h"
#include "kinetri/impl/base/check.h"

namespace kinetri::detail {
namespace {

// More bits than a binary64 number has: two numbers that agree to so many are probably equal, which
// the gcd of their polynomials decides.
constexpr long bits_before_gcd = 60;

// The order of two dyadic numbers x / 2^e and y / 2^f.
int compare_dyadic(const Integer& x, unsigned long e, const Integer& y, unsigned long f) {
  if (e == f) return x.compare(y);
  return e < f ? Integer(x << (f - e)).compare(y) : x.compare(Integer(y << (e - f)));
}

// The order of numbers in disjoint open intervals; none if they overlap.
std::optional<Comparison_result> order_of_disjoint(const Isolation& s, const Isolation& t) {
  if (compare_dyadic(s.b, s.e, t.a, t.e) <= 0) return CGAL::SMALLER;
  if (compare_dyadic(s.a, s.e, t.b, t.e) >= 0) return CGAL::LARGER;
  return std::nullopt;
}

}  // namespace

bool Isolation::is_narrower_than_bits(long bits) const {
  const Integer& near_zero = a.sign() >= 0 ? a : b;
  return !near_zero.is_zero() && bit_length(b - a) + bits < bit_length(near_zero);
}

Root_access::~Root_access() {
  if (!lock_.owns_lock() || representation_.bounds_are_published) return;
  bounds_.narrow(representation_.double_interval());
  representation_.bounds_are_published = true;
}

void Root_representation::isolate(const Polynomial& p, const Rational& first,
                                  const Rational& last) {
  KINETRI_PRECONDITION(first < last, "the isolating interval is empty");
  KINETRI_PRECONDITION(p.degree() >= 1, "a polynomial without roots has no root to isolate");
  own_polynomial = primitive_part(p);

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

  // With zero as an end, not inside, each refinement gives more correct bits.
  if (isolation->a.sign() < 0 && isolation->b.sign() > 0) compare_with(0);
}

// Dyadic ends inside the given ones, on finer and finer grids until the root is between them.
void Root_representation::isolate_between_dyadic_ends(const Rational& first, const Rational& last) {
  const Rational width = last - first;
  long e = std::max(bit_length(denominator(width)) - bit_length(numerator(width)) + 2, 0L);
  for (;; e += 8) {
    const Integer a = scaled_ceil(first, e);
    const Integer b = scaled_floor(last, e);
    const Integer value_a = scaled_value(own_polynomial, a, static_cast<unsigned long>(e));
    const Integer value_b = scaled_value(own_polynomial, b, static_cast<unsigned long>(e));
    if (value_a.is_zero()) return become_rational(dyadic(a, static_cast<unsigned long>(e)));
    if (value_b.is_zero()) return become_rational(dyadic(b, static_cast<unsigned long>(e)));
    if (sign(value_a) == sign(value_b)) continue;
    isolation.emplace();
    return set_ends(a, b, static_cast<unsigned long>(e));
  }
}

const Polynomial& Root_representation::polynomial() {
  if (is_rational() && !linear_is_made) {
    own_polynomial = Polynomial{Integer(-numerator(lower)), denominator(lower)};
    linear_is_made = true;
  }
  return own_polynomial;
}

const Rational& Root_representation::lower_end() {
  if (!is_rational() && !ends_are_current) {
    lower = dyadic(isolation->a, isolation->e);
    upper = dyadic(isolation->b, isolation->e);
    ends_are_current = true;
  }
  return lower;
}

const Rational& Root_representation::upper_end() {
  lower_end();
  return is_rational() ? lower : upper;
}

Double_interval Root_representation::double_interval() {
  return {to_interval(lower_end()).lower, to_interval(upper_end()).upper};
}

void Root_representation::become_rational(Rational number) {
  isolation.reset();
  lower = std::move(number);
  bounds_are_published = false;
}

// Precondition: the polynomial has opposite signs, not zero, at the ends.
void Root_representation::set_ends(Integer a, Integer b, unsigned long e) {
  const mp_bitcnt_t common = std::min({mpz_scan1(raw(a), 0), mpz_scan1(raw(b), 0), e});
  isolation->a = a >> common;
  isolation->b = b >> common;
  isolation->e = e - common;
  isolation->value_a = scaled_value(own_polynomial, isolation->a, isolation->e);
  isolation->value_b = scaled_value(own_polynomial, isolation->b, isolation->e);
  ends_are_current = false;
  bounds_are_published = false;
}

// Makes the dyadic number m an end of the isolation. `side` is the sign of the polynomial at m.
void Root_representation::narrow_to(const Rational& m, Sign side) {
  Isolation& s = *isolation;
  const unsigned long e = *dyadic_exponent(m);
  const auto degree = static_cast<unsigned long>(own_polynomial.degree());
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
  value = scaled_value(own_polynomial, end, s.e);
  ends_are_current = false;
  bounds_are_published = false;
}

// Precondition: `factor` divides the polynomial and has the number as a root.
void Root_representation::use_factor(Polynomial factor) {
  if (factor.degree() == 1) return become_rational(linear_root(factor));
  if (factor.degree() == own_polynomial.degree()) return;
  own_polynomial = std::move(factor);
  set_ends(isolation->a, isolation->b, isolation->e);
}

// ---- refinement ----

// One step of quadratic interval refinement: the interval is divided into 2^k parts, k <= k_max,
// and the part in which the secant is zero is tested. If it contains the root, k doubles, else it
// is halved. With k = 1 it is bisection.
void Root_representation::quadratic_step(unsigned long k_max) {
  Isolation& s = *isolation;
  const Polynomial& p = own_polynomial;
  const auto degree = static_cast<unsigned long>(p.degree());
  const unsigned long k = std::max(std::min(s.k, k_max), 1UL);
  const Integer part = s.b - s.a;
  s.e += k;
  s.a <<= k;
  s.b <<= k;
  s.value_a <<= k * degree;
  s.value_b <<= k * degree;
  ends_are_current = false;
  bounds_are_published = false;

  // The zero of the secant in parts, rounded. It is only a guess: k + 32 leading bits are enough.
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

void Root_representation::halve() {
  const Integer width = isolation->b - isolation->a;
  const unsigned long e = isolation->e;
  do {
    quadratic_step(std::numeric_limits<unsigned long>::max());
  } while (!is_rational() && ((isolation->b - isolation->a) << 1) > (width << (isolation->e - e)));
}

void Root_representation::refine_to_bits(long bits) {
  while (!is_rational() && !isolation->is_narrower_than_bits(bits)) {
    const Integer& near_zero = isolation->a.sign() >= 0 ? isolation->a : isolation->b;
    // No more digits than required, unless the size of the number is still unknown.
    const long missing = near_zero.is_zero() ? std::numeric_limits<long>::max()
                                             : bit_length(isolation->b - isolation->a) + bits -
                                                   bit_length(near_zero) + 1;
    quadratic_step(static_cast<unsigned long>(missing));
  }
}

void Root_representation::refine_to(const Rational& width) {
  // 2^exponent <= width
  const long exponent = bit_length(numerator(width)) - bit_length(denominator(width)) - 1;
  while (!is_rational()) {
    const long present = bit_length(isolation->b - isolation->a) - static_cast<long>(isolation->e);
    if (present <= exponent) return;
    quadratic_step(static_cast<unsigned long>(present - exponent));
  }
}

Double_interval Root_representation::tight_interval() {
  while (!is_rational()) {
    const Double_interval present = double_interval();
    // The number is strictly between the ends of the isolation, so it can be a binary64 number only
    // if there is one strictly between these two.
    const std::int64_t first = ordinal(present.lower);
    const std::int64_t candidates = ordinal(present.upper) - first - 1;
    if (candidates == 0) return present;
    if (candidates <= 3) {
      compare_with(to_rational(from_ordinal(first + (candidates + 1) / 2)));
    } else {
      quadratic_step(std::numeric_limits<unsigned long>::max());
    }
  }
  return to_interval(lower);
}

// ---- order ----

// The order of the number and m. An m inside the isolation becomes an end of it, if it can.
Comparison_result Root_representation::compare_with(const Rational& m) {
  if (is_rational()) return comparison(lower.compare(m));
  if (m <= lower_end()) return CGAL::LARGER;
  if (m >= upper_end()) return CGAL::SMALLER;
  const Sign side = own_polynomial.sign_at(m);
  if (side == CGAL::ZERO) {
    become_rational(m);
    return CGAL::EQUAL;
  }
  const bool root_is_right = side == sign(isolation->value_a);
  if (dyadic_exponent(m)) narrow_to(m, side);
  return root_is_right ? CGAL::LARGER : CGAL::SMALLER;
}

// Whether p changes sign over the intersection of two overlapping isolating intervals. Each end of
// it is an end of one of them.
bool Root_representation::changes_sign_over_intersection(const Polynomial& p,
                                                         Root_representation& x,
                                                         Root_representation& y) {
  return p.sign_at(std::max(x.lower_end(), y.lower_end())) !=
         p.sign_at(std::min(x.upper_end(), y.upper_end()));
}

// The order of two roots of one polynomial in overlapping intervals. They are equal if it changes
// sign over the intersection, which then contains the only root of either interval. Otherwise
// neither interval contains the other, and each number is outside the intersection.
Comparison_result Root_representation::compare_roots_of_one_polynomial(Root_representation& x,
                                                                       Root_representation& y) {
  if (changes_sign_over_intersection(x.own_polynomial, x, y)) return CGAL::EQUAL;
  return comparison(x.lower_end().compare(y.lower_end()));
}

// Whether two numbers in overlapping intervals are equal. A root of the gcd of their polynomials in
// the intersection is a root of both, so it is both numbers; the ends are not roots of it, each
// being an end of an isolating interval. Equal numbers get that gcd as their polynomial, so that
// later comparisons need no gcd.
bool Root_representation::are_equal(Root_representation& x, Root_representation& y) {
  const Polynomial common = gcd(x.own_polynomial, y.own_polynomial);
  if (common.degree() == 0 || !changes_sign_over_intersection(common, x, y)) return false;
  x.use_factor(common);
  y.use_factor(common);
  return true;
}

Comparison_result Root_representation::compare(Root_representation& x, Root_representation& y) {
  bool known_different = false;
  while (!x.is_rational() && !y.is_rational()) {
    const Isolation& s = *x.isolation;
    const Isolation& t = *y.isolation;
    if (const std::optional<Comparison_result> order = order_of_disjoint(s, t)) return *order;

    if (!known_different && equal_up_to_sign(x.own_polynomial, y.own_polynomial)) {
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

// ---- signs ----

// The gcd has the number as a root if it changes sign over the isolating interval: as a divisor
// of polynomial() it has no other root there, and a simple one only.
bool Root_representation::is_root_of(const Polynomial& p) {
  if (p.is_zero()) return true;
  if (is_rational()) return p.sign_at(lower) == CGAL::ZERO;
  if (equal_up_to_sign(p, own_polynomial)) return true;
  Polynomial common = gcd(p, own_polynomial);
  if (common.degree() == 0) return false;
  if (common.sign_at(lower_end()) == common.sign_at(upper_end())) return false;
  use_factor(std::move(common));
  return true;
}

Sign Root_representation::sign_of(const Polynomial& p) {
  if (!is_rational() && equal_up_to_sign(p, own_polynomial)) return CGAL::ZERO;
  for (long bits = 0;; bits = bits == 0 ? 24 : 2 * bits) {
    if (bits != 0) refine_to_bits(bits);
    if (is_rational()) return p.sign_at(lower);
    if (const std::optional<Sign> s = p.sign_on(lower_end(), upper_end())) return *s;
    // Tested once, after 24 bits: by then nearly all nonzero signs have been found.
    if (bits == 24 && is_root_of(p)) return CGAL::ZERO;
  }
}

// If p has no other root up to the end of the isolating interval on that side, the sign at that end
// is the sign beside the number. This is so after a flip: p is minus the polynomial of the number.
std::optional<Sign> Root_representation::sign_of_own_polynomial_beside(const Polynomial& p,
                                                                       Sign side) {
  if (is_rational() || !equal_up_to_sign(p, own_polynomial)) return std::nullopt;
  return p.sign_at(side == CGAL::POSITIVE ? upper_end() : lower_end());
}

}  // namespace kinetri::detail
