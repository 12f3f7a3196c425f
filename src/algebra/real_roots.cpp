// SPDX-License-Identifier: GPL-3.0-or-later
//
// Isolation of real roots. Sturm counts decide how many roots an interval holds; intervals are
// halved, by exponent where they span several powers of two, so that roots of any size cost alike.
#include "kinetri/algebra/real_roots.h"

#include <algorithm>
#include <utility>

#include "dyadic.h"
#include "gmp_access.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/base/check.h"

namespace kinetri {
namespace {

// 2^(exponent - 1) < |x| < 2^(exponent + 1). Precondition: x is not zero.
long exponent_of(const Rational& x) {
  return bit_length(mpq_numref(x.backend().data())) - bit_length(mpq_denref(x.backend().data()));
}

Rational power_of_two(long exponent) {
  return scaled_by_power_of_two(1, exponent);
}

long floor_quotient(long a, long b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

// --- All roots of a square-free polynomial ------------------------------------------------------

// All roots are strictly between -2^k and 2^k.
// Source: M. Fujiwara, Tohoku Math. J. 10 (1916): |t| <= 2 max |c_i / c_n|^(1 / (n - i)).
long root_bound_exponent(const Polynomial& p) {
  const long n = p.degree();
  const long lead = bit_length(p.leading_coefficient());
  long bound = 0;
  bool found = false;
  for (long i = 0; i < n; ++i) {
    const Integer& c = p[static_cast<int>(i)];
    if (c.is_zero()) continue;
    // |c_i / c_n| < 2^(difference of the bit lengths + 1)
    const long exponent = floor_quotient(bit_length(c) - lead + 1, n - i) + 2;
    bound = found ? std::max(bound, exponent) : exponent;
    found = true;
  }
  return bound;
}

// No root but zero is between -2^k and 2^k, these included: the bound above for the reciprocals.
long least_root_exponent(const Polynomial& p) {
  std::vector<Integer> reversed(p.coefficients().rbegin(), p.coefficients().rend());
  return -root_bound_exponent(Polynomial(std::move(reversed)));
}

class Isolator {
 public:
  // Precondition: the first term of the sequence is square-free.
  explicit Isolator(const Sturm_sequence& sequence)
      : sequence_(sequence),
        polynomial_(sequence.terms().front()),
        least_exponent_(least_root_exponent(polynomial_)) {}

  std::vector<Algebraic_number> roots() {
    const Rational bound = power_of_two(root_bound_exponent(polynomial_));
    isolate(-bound, sequence_.sign_changes_at_minus_infinity(), bound,
            sequence_.sign_changes_at_plus_infinity());
    return std::move(roots_);
  }

 private:
  // The roots in (lower, upper], where the numbers of sign changes are known.
  void isolate(const Rational& lower, int changes_lower, const Rational& upper, int changes_upper) {
    const int count = changes_lower - changes_upper;
    if (count == 0) return;
    if (count == 1) {
      if (polynomial_.sign_at(upper) == CGAL::ZERO) {
        roots_.emplace_back(upper);
        return;
      }
      // A lower end that is a root itself, found in the interval to the left, isolates nothing.
      if (polynomial_.sign_at(lower) != CGAL::ZERO) {
        roots_.emplace_back(polynomial_, lower, upper);
        return;
      }
    }
    const Rational middle = between(lower, upper);
    const int changes_middle = sequence_.sign_changes_at(middle);
    isolate(lower, changes_lower, middle, changes_middle);
    isolate(middle, changes_middle, upper, changes_upper);
  }

  // Zero, or of the same sign as the ends and then with an exponent, or a value, halfway.
  Rational between(const Rational& lower, const Rational& upper) const {
    if (lower.sign() < 0 && upper.sign() > 0) return 0;
    if (lower.is_zero()) return power_of_two(least_exponent_);
    if (upper.is_zero()) return -power_of_two(least_exponent_);
    const long first = exponent_of(lower);
    const long last = exponent_of(upper);
    if (std::abs(last - first) > 2) {
      const Rational magnitude = power_of_two(floor_quotient(first + last, 2));
      return lower.sign() > 0 ? magnitude : -magnitude;
    }
    return (lower + upper) / 2;
  }

  const Sturm_sequence& sequence_;
  const Polynomial& polynomial_;
  long least_exponent_;
  std::vector<Algebraic_number> roots_;
};

std::vector<Algebraic_number> simple_roots(const Polynomial& square_free) {
  if (square_free.degree() < 1) return {};
  if (square_free.degree() == 1) return {linear_root(square_free)};
  return Isolator(Sturm_sequence(square_free)).roots();
}

void append(std::vector<Real_root>& result, const std::vector<Algebraic_number>& roots,
            int multiplicity) {
  for (const Algebraic_number& root : roots) result.push_back({root, multiplicity});
}

void sort_by_value(std::vector<Real_root>& roots) {
  std::sort(roots.begin(), roots.end(), [](const Real_root& a, const Real_root& b) {
    return compare(a.value, b.value) == CGAL::SMALLER;
  });
}

// --- The first root after a number --------------------------------------------------------------

// A point `from` that is not a root of the square-free polynomial q, and the roots of q after it.
class Roots_beyond {
 public:
  Roots_beyond(const Polynomial& q, const Rational& from) : q_(q), from_(from) {
    const std::vector<Integer> shifted = shifted_polynomial();
    const int variations = count_variations(shifted);
    if (variations == 0) return;
    least_exponent_ = least_positive_root_exponent(shifted);
    // By Descartes' rule of signs one variation means one root, which a sign then finds; more mean
    // that many roots or fewer, which Sturm's theorem counts.
    if (variations == 1) {
      count_ = 1;
      return;
    }
    sequence_.emplace(q);
    changes_from_ = sequence_->sign_changes_at(from);
    count_ = changes_from_ - sequence_->sign_changes_at_plus_infinity();
  }

  std::optional<Algebraic_number> first() const {
    if (count_ == 0) return std::nullopt;
    if (q_.degree() == 1) return linear_root(q_);

    // Points at growing distances from `from`, until there is a root before one.
    Rational lower = from_;
    long distance = least_exponent_;
    Rational upper = point(distance);
    int count = roots_up_to(upper);
    for (long tries = 1; count == 0; ++tries) {
      lower = std::move(upper);
      distance += tries <= 8 ? 1 : tries;
      upper = point(distance);
      count = roots_up_to(upper);
    }
    // Invariant: no root in (from, lower], at least one in (lower, upper].
    while (count > 1) {
      Rational middle = between(lower, upper);
      const int count_middle = roots_up_to(middle);
      if (count_middle == 0) {
        lower = std::move(middle);
      } else {
        upper = std::move(middle);
        count = count_middle;
      }
    }
    if (q_.sign_at(upper) == CGAL::ZERO) return Algebraic_number(upper);
    return Algebraic_number(q_, lower, upper);
  }

 private:
  // The coefficients of d^n q((m + y) / d), where from = m / d: its positive roots are the
  // distances of the roots beyond `from`, times d.
  std::vector<Integer> shifted_polynomial() const {
    const mpz_srcptr m = mpq_numref(from_.backend().data());
    const mpz_srcptr d = mpq_denref(from_.backend().data());
    std::vector<Integer> c(q_.coefficients().begin(), q_.coefficients().end());
    const std::size_t n = c.size() - 1;
    if (mpz_cmp_ui(d, 1) != 0) {
      Integer power = 1;
      for (std::size_t i = n; i-- > 0;) {
        mpz_mul(raw(power), raw(power), d);
        c[i] *= power;
      }
    }
    if (mpz_sgn(m) == 0) return c;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = n; j-- > i;) mpz_addmul(raw(c[j]), m, raw(c[j + 1]));
    }
    return c;
  }

  static int count_variations(const std::vector<Integer>& c) {
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

  // Where to begin the search: k with 2^k <= distance of every root beyond `from`. Only the speed
  // depends on it. At a positive root y of the shifted polynomial the terms of the sign opposite to
  // c_0 outweigh c_0, so one of these m terms has |c_i| y^i >= |c_0| / m.
  long least_positive_root_exponent(const std::vector<Integer>& c) const {
    const int sign_constant = c.front().sign();
    const long opposite_terms = std::count_if(
        c.begin(), c.end(), [&](const Integer& x) { return x.sign() == -sign_constant; });
    const long log_terms = bit_length(Integer(opposite_terms));
    long result = std::numeric_limits<long>::max();
    for (std::size_t i = 1; i < c.size(); ++i) {
      if (c[i].sign() != -sign_constant) continue;
      const long exponent = bit_length(c.front()) - 1 - bit_length(c[i]) - log_terms;
      result = std::min(result, floor_quotient(exponent, static_cast<long>(i)));
    }
    return result - bit_length(mpq_denref(from_.backend().data()));
  }

  // A point at a distance from 2^k to 1.25 * 2^k. It has few digits, unless `from` is much larger
  // than the distance.
  Rational point(long k) const {
    const Rational target = scaled_by_power_of_two(from_ + power_of_two(k), 2 - k);
    Integer multiple;
    mpz_cdiv_q(raw(multiple), mpq_numref(target.backend().data()),
               mpq_denref(target.backend().data()));
    return scaled_by_power_of_two(multiple, k - 2);
  }

  // A point strictly between, by distance from `from`.
  Rational between(const Rational& lower, const Rational& upper) const {
    const Rational near = lower - from_;
    if (!near.is_zero()) {
      const long first = exponent_of(near);
      const long last = exponent_of(upper - from_);
      if (last - first > 3) return point(floor_quotient(first + last, 2));
    }
    return (lower + upper) / 2;
  }

  // The number of roots in (from, x].
  int roots_up_to(const Rational& x) const {
    if (sequence_) return changes_from_ - sequence_->sign_changes_at(x);
    return q_.sign_at(x) == -q_.sign_at_plus_infinity() ? 0 : 1;
  }

  const Polynomial& q_;
  const Rational from_;
  std::optional<Sturm_sequence> sequence_;
  int changes_from_ = 0;
  int count_ = 0;
  long least_exponent_ = 0;
};

// The least root of the square-free polynomial q greater than t.
std::optional<Algebraic_number> first_simple_root_after(const Polynomial& q,
                                                        const Algebraic_number& t) {
  if (q.degree() < 1) return std::nullopt;
  Rational_interval around = t.isolating_interval();
  if (!around.is_point() && !equal_up_to_sign(q, t.polynomial())) {
    // Narrows the interval around t until q has no root there, or t alone: where q does not vanish,
    // or where it is monotone.
    const bool is_root = sign_at(q, t) == CGAL::ZERO;
    const Polynomial decisive = is_root ? derivative(q) : q;
    around = t.isolating_interval();
    while (!around.is_point() && !decisive.sign_on(around.lower, around.upper)) {
      t.refine();
      around = t.isolating_interval();
    }
  }
  if (!around.is_point()) return Roots_beyond(q, around.upper).first();

  const Rational& from = around.upper;
  if (q.sign_at(from) != CGAL::ZERO) return Roots_beyond(q, from).first();
  const Polynomial rest = exact_quotient(q, t.polynomial());
  if (rest.degree() < 1) return std::nullopt;
  return Roots_beyond(rest, from).first();
}

}  // namespace

std::vector<Real_root> real_roots(const Polynomial& p) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  std::vector<Real_root> result;
  const std::vector<Square_free_factor> factors = square_free_decomposition(p);
  for (const Square_free_factor& f : factors) {
    append(result, simple_roots(f.factor), f.multiplicity);
  }
  if (factors.size() > 1) sort_by_value(result);
  return result;
}

std::optional<Real_root> first_root_after(const Polynomial& p, const Algebraic_number& t) {
  KINETRI_PRECONDITION(!p.is_zero(), "every number is a root of the zero polynomial");
  const std::vector<Square_free_factor> factors = square_free_decomposition(p);
  Polynomial square_free{1};
  for (const Square_free_factor& f : factors) square_free = square_free * f.factor;
  const std::optional<Algebraic_number> root = first_simple_root_after(square_free, t);
  if (!root) return std::nullopt;
  for (const Square_free_factor& f : factors) {
    if (factors.size() == 1 || sign_at(f.factor, *root) == CGAL::ZERO) {
      return Real_root{*root, f.multiplicity};
    }
  }
  KINETRI_ASSERT(false, "a root of a polynomial is a root of one of its square-free factors");
  return std::nullopt;
}

std::optional<Algebraic_number> failure_time(const Polynomial& p, const Algebraic_number& t) {
  if (p.is_zero()) return std::nullopt;
  if (sign_just_after(p, t) == CGAL::NEGATIVE) return t;
  return first_simple_root_after(odd_part(p), t);
}

}  // namespace kinetri
