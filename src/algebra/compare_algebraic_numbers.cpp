// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of algebraic numbers.
#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>

#include "dyadic.h"
#include "gmp_access.h"
#include "kinetri/algebra/algebraic_number.h"
#include "representation.h"

namespace kinetri {
namespace {

Comparison_result comparison(int order) {
  return static_cast<Comparison_result>(order < 0 ? -1 : order > 0 ? 1 : 0);
}

// More correct bits than a binary64 number has: two numbers that agree to so many are either equal,
// which the gcd of their polynomials tells, or exceptionally close.
constexpr long bits_before_gcd = 60;

// The order of two dyadic numbers x / 2^e and y / 2^f.
int compare_dyadic(const Integer& x, unsigned long e, const Integer& y, unsigned long f) {
  if (e == f) return x.compare(y);
  return e < f ? Integer(x << (f - e)).compare(y) : x.compare(Integer(y << (e - f)));
}

// The order of numbers in intervals that do not overlap; nothing where they do.
std::optional<Comparison_result> order_of_disjoint(const Double_interval& x,
                                                   const Double_interval& y) {
  if (x.upper < y.lower) return CGAL::SMALLER;
  if (x.lower > y.upper) return CGAL::LARGER;
  return std::nullopt;
}

// The same of open intervals.
std::optional<Comparison_result> order_of_disjoint(const Isolation& s, const Isolation& t) {
  if (compare_dyadic(s.b, s.e, t.a, t.e) <= 0) return CGAL::SMALLER;
  if (compare_dyadic(s.a, s.e, t.b, t.e) >= 0) return CGAL::LARGER;
  return std::nullopt;
}

}  // namespace

// The order of the number and m. An m inside the isolation becomes an end of it, if it can.
Comparison_result Root_source::Representation::compare_with(const Rational& m) {
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
  if (changes_sign_over_intersection(x.own_polynomial, x, y)) return CGAL::EQUAL;
  return comparison(x.lower_end().compare(y.lower_end()));
}

// Whether two numbers in overlapping intervals are equal. A root of the gcd of their polynomials in
// the intersection is a root of both, so it is both numbers; the ends are not roots of it, each
// being an end of an isolating interval. Equal numbers get that gcd as their polynomial, to be
// compared without a gcd from then on.
bool Root_source::Representation::are_equal(Representation& x, Representation& y) {
  const Polynomial common = gcd(x.own_polynomial, y.own_polynomial);
  if (common.degree() == 0 || !changes_sign_over_intersection(common, x, y)) return false;
  x.use_factor(common);
  y.use_factor(common);
  return true;
}

Comparison_result Root_source::Representation::compare(Representation& x, Representation& y) {
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

Comparison_result compare(const Algebraic_number& a, const Rational& b) {
  if (a.is_binary64()) return comparison(a.binary64_value().compare(b));
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
  Access x(*a.source_, a.representation(), std::defer_lock);
  Access y(*b.source_, b.representation(), std::defer_lock);
  std::lock(x, y);
  const Comparison_result order = Representation::compare(*x, *y);
  // Of many simultaneous events each is compared with several others: once is enough.
  if (order == CGAL::EQUAL) Root_source::share_identity(*a.source_, *b.source_);
  return order;
}

// Gives both sources, which belong to equal numbers, one identity. Identities are not used again,
// so that each stands for one value, and a source may have another identity of its value at any
// time.
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

}  // namespace kinetri
