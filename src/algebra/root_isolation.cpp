// SPDX-License-Identifier: GPL-3.0-or-later
#include "root_isolation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "dyadic.h"
#include "gmp_access.h"

namespace kinetri {
namespace {

using Integers = std::vector<Integer>;  // by ascending power

// 2^(exponent - 1) < |x| < 2^(exponent + 1). Precondition: x is not zero.
long exponent_of(const Rational& x) {
  return bit_length(mpq_numref(x.backend().data())) - bit_length(mpq_denref(x.backend().data()));
}

long floor_quotient(long a, long b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

// The greatest k of which x is a multiple of 2^k. Precondition: x is dyadic and not zero.
long order_at_two(const Rational& x) {
  return static_cast<long>(mpz_scan1(mpq_numref(x.backend().data()), 0)) -
         static_cast<long>(mpz_scan1(mpq_denref(x.backend().data()), 0));
}

// p(t) becomes p(m + t).
void shift(Integers& p, const Integer& m) {
  const bool by_one = m == 1;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    for (std::size_t j = p.size() - 1; j-- > i;) {
      if (by_one) {
        mpz_add(raw(p[j]), raw(p[j]), raw(p[j + 1]));
      } else {
        mpz_addmul(raw(p[j]), raw(m), raw(p[j + 1]));
      }
    }
  }
}

// p(t) becomes d^n p(t / d).
void divide_argument(Integers& p, const Integer& d) {
  Integer power = 1;
  for (std::size_t i = p.size() - 1; i-- > 0;) {
    power *= d;
    p[i] *= power;
  }
}

// p(t) becomes p(w t).
void multiply_argument(Integers& p, const Integer& w) {
  Integer power = 1;
  for (std::size_t i = 1; i < p.size(); ++i) {
    power *= w;
    p[i] *= power;
  }
}

// p(t) becomes 2^(n e) p(t / 2^e), or p(t / 2^e) if e is negative.
void divide_argument_by_power_of_two(Integers& p, long e) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto shift = e >= 0 ? static_cast<unsigned long>(e) * (p.size() - 1 - i)
                              : static_cast<unsigned long>(-e) * i;
    p[i] <<= shift;
  }
}

// The number of sign changes in the sequence, zeros ignored.
int sign_variations(const Integers& c) {
  int variations = 0;
  int previous = 0;
  for (const Integer& x : c) {
    const int present = x.sign();
    if (present == 0) continue;
    if (present == -previous) ++variations;
    previous = present;
  }
  return variations;
}

// The coefficients of (1 + t)^n p((lower + upper t) / (1 + t)), up to a positive factor: its
// positive roots are those of p in the open interval. The first coefficient and the last one are
// the values of p at the ends. Precondition: the ends are dyadic.
Integers mapped_to_interval(const Polynomial& p, const Rational& lower, const Rational& upper) {
  // Over 2^e the ends are integers.
  long e = std::numeric_limits<long>::min();
  if (!lower.is_zero()) e = -order_at_two(lower);
  if (!upper.is_zero()) e = std::max(e, -order_at_two(upper));
  const Integer a = scaled_floor(lower, e);
  const Integer b = scaled_floor(upper, e);

  Integers c(p.coefficients().begin(), p.coefficients().end());
  divide_argument_by_power_of_two(c, e);
  shift(c, a);
  multiply_argument(c, b - a);
  std::ranges::reverse(c);
  shift(c, 1);
  std::ranges::reverse(c);
  return c;
}

// All roots are strictly between -2^k and 2^k.
// Source: M. Fujiwara, Tohoku Math. J. 10 (1916): |t| <= 2 max |c_i / c_n|^(1 / (n - i)).
long root_bound_exponent(const Integers& p) {
  const auto n = static_cast<long>(p.size()) - 1;
  const long lead = bit_length(p.back());
  long bound = std::numeric_limits<long>::min();
  for (long i = 0; i < n; ++i) {
    const Integer& c = p[static_cast<std::size_t>(i)];
    if (c.is_zero()) continue;
    // |c_i / c_n| < 2^(difference of the bit lengths + 1)
    bound = std::max(bound, floor_quotient(bit_length(c) - lead + 1, n - i) + 2);
  }
  return bound;
}

// k with 2^k <= every positive root. At a positive root t the terms of the sign opposite to c_0
// outweigh c_0, so one of these m terms has |c_i| t^i >= |c_0| / m.
// Precondition: c_0 is not zero, and there is a coefficient of the opposite sign.
long least_positive_root_exponent(const Integers& c) {
  const int sign_constant = c.front().sign();
  const long opposite_terms =
      std::ranges::count_if(c, [&](const Integer& x) { return x.sign() == -sign_constant; });
  const long log_terms = bit_length(Integer(opposite_terms));
  long result = std::numeric_limits<long>::max();
  for (std::size_t i = 1; i < c.size(); ++i) {
    if (c[i].sign() != -sign_constant) continue;
    const long exponent = bit_length(c.front()) - 1 - bit_length(c[i]) - log_terms;
    result = std::min(result, floor_quotient(exponent, static_cast<long>(i)));
  }
  return result;
}

class Search {
 public:
  Search(const Polynomial& q, const Rational& from) : q_(q), from_(from) {
    // d^n q((m + y) / d), where from = m / d: its positive roots are the distances of the roots
    // beyond `from`, times d.
    const Integer d = denominator(from);
    Integers shifted(q.coefficients().begin(), q.coefficients().end());
    divide_argument(shifted, d);
    shift(shifted, numerator(from));
    // Without a root at `from` itself, of which there is at most one.
    if (shifted.front().is_zero()) shifted.erase(shifted.begin());
    variations_ = sign_variations(shifted);
    if (variations_ == 0) return;
    least_exponent_ = least_positive_root_exponent(shifted) - bit_length(d);
    greatest_exponent_ = root_bound_exponent(shifted) - bit_length(d) + 1;
  }

  std::vector<Algebraic_number> roots(std::size_t most) {
    // Contradicting bounds: there is no root.
    if (variations_ == 0 || least_exponent_ > greatest_exponent_) return {};
    if (q_.degree() == 1) return {linear_root(q_)};
    // Two successive ones are the ends of an open interval to be searched, from the back on.
    std::vector<Rational> ends = {point(greatest_exponent_), point(least_exponent_ - 2)};
    if (variations_ == 1) return {only_root(ends[1], ends[0])};

    std::vector<Algebraic_number> found;
    int previous_variations = 0;
    unsigned long k = least_k;
    while (ends.size() > 1 && found.size() < most) {
      const Rational lower = ends.back();
      const Rational upper = ends[ends.size() - 2];
      const Integers c = mapped_to_interval(q_, lower, upper);
      const int variations = sign_variations(c);
      // An end that is a root itself isolates nothing.
      if (variations == 0 || (variations == 1 && !c.front().is_zero() && !c.back().is_zero())) {
        if (variations == 1) found.push_back(only_root(lower, upper));
        if (c.back().is_zero() && found.size() < most) found.emplace_back(upper);
        ends.pop_back();
        k = least_k;
        continue;
      }
      if (variations == previous_variations && span(lower, upper) <= 3) {
        if (const auto cluster = cluster_within(lower, upper, c, variations, k)) {
          ends.pop_back();
          if (cluster->upper != upper) ends.push_back(cluster->upper);
          ends.push_back(cluster->lower);
          k *= 2;
          continue;
        }
        k = std::max(k / 2, least_k);
      }
      previous_variations = variations;
      ends.insert(ends.end() - 1, between(lower, upper));
    }
    return found;
  }

 private:
  // From afar a cluster of v roots is like one root of multiplicity v, at the position -v p / p' by
  // Newton's method from the lower end. Returns the parts around that position, of 2^k parts of the
  // interval, if they have all its variations: then the rest has no root. `c` are the coefficients
  // of the polynomial mapped to the interval.
  std::optional<Rational_interval> cluster_within(const Rational& lower, const Rational& upper,
                                                  const Integers& c, int variations,
                                                  unsigned long k) const {
    Integer value = variations * c[0];
    Integer slope = q_.degree() * c[0] - c[1];
    // It is only a guess: k + 32 leading bits are enough.
    const long excess = bit_length(slope) - static_cast<long>(k) - 32;
    if (excess > 0) {
      value >>= static_cast<unsigned long>(excess);
      slope >>= static_cast<unsigned long>(excess);
    }
    if (slope.is_zero()) return std::nullopt;
    const Integer part = (value << k) / slope;
    if (part.sign() < 0 || bit_length(part) > static_cast<long>(k)) return std::nullopt;

    const Rational width = scaled_by_power_of_two(upper - lower, -static_cast<long>(k));
    const Rational_interval cluster = {
        std::max<Rational>(lower, lower + Rational(part - 1) * width),
        std::min<Rational>(upper, lower + Rational(part + 2) * width)};
    if (sign_variations(mapped_to_interval(q_, cluster.lower, cluster.upper)) != variations) {
      return std::nullopt;
    }
    return cluster;
  }

  // The only root between the ends, which are not roots.
  Algebraic_number only_root(Rational lower, Rational upper) const {
    const Sign sign_lower = q_.sign_at(lower);
    while (span(lower, upper) > 3) {
      Rational middle = between(lower, upper);
      const Sign sign_middle = q_.sign_at(middle);
      if (sign_middle == CGAL::ZERO) return middle;
      (sign_middle == sign_lower ? lower : upper) = std::move(middle);
    }
    return {q_, lower, upper};
  }

  // A point at a distance from 2^k to 1.25 * 2^k. It has few digits, unless `from` is much larger
  // than the distance.
  Rational point(long k) const {
    const Rational target = scaled_by_power_of_two(from_ + scaled_by_power_of_two(1, k), 2 - k);
    Integer multiple;
    mpz_cdiv_q(raw(multiple), mpq_numref(target.backend().data()),
               mpq_denref(target.backend().data()));
    return scaled_by_power_of_two(multiple, k - 2);
  }

  // The difference of the exponents of the distances from `from`.
  long span(const Rational& lower, const Rational& upper) const {
    return exponent_of(upper - from_) - exponent_of(lower - from_);
  }

  // A point strictly between: its distance from `from` has the middle exponent, so that roots of
  // any size cost the same, or it is the midpoint.
  Rational between(const Rational& lower, const Rational& upper) const {
    const long first = exponent_of(lower - from_);
    const long last = exponent_of(upper - from_);
    if (last - first > 3) return point(floor_quotient(first + last, 2));
    return (lower + upper) / 2;
  }

  static constexpr unsigned long least_k = 4;

  const Polynomial& q_;
  const Rational& from_;
  int variations_ = 0;
  long least_exponent_ = 0;     // no root is nearer than 2^k
  long greatest_exponent_ = 0;  // all roots are nearer than 2^k
};

}  // namespace

std::vector<Algebraic_number> roots_beyond(const Polynomial& q, const Rational& from,
                                           std::size_t most) {
  return Search(q, from).roots(most);
}

}  // namespace kinetri
