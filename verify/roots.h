// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials with integer coefficients, their real roots, and times that are such roots. Lemmas 1
// to 3 of README.md.
#ifndef KINETRI_VERIFY_ROOTS_H
#define KINETRI_VERIFY_ROOTS_H

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace verify {

using Integer = mpz_class;

// The number m / 2^e.
struct Dyadic {
  Integer m = 0;
  unsigned long e = 0;
};

inline Dyadic dyadic(double value) {
  int exponent = 0;
  Integer m(std::ldexp(std::frexp(value, &exponent), 53));  // an integer
  exponent -= 53;
  if (exponent >= 0) return {m << static_cast<unsigned long>(exponent), 0};
  return {m, static_cast<unsigned long>(-exponent)};
}

inline int compare(const Dyadic& a, const Dyadic& b) {
  if (a.e == b.e) return sgn(a.m - b.m);
  return a.e < b.e ? sgn((a.m << (b.e - a.e)) - b.m) : sgn(a.m - (b.m << (a.e - b.e)));
}

inline Dyadic middle(const Dyadic& a, const Dyadic& b) {
  const unsigned long e = std::max(a.e, b.e);
  return {(a.m << (e - a.e)) + (b.m << (e - b.e)), e + 1};
}

// The coefficient of t^i is p[i]; the last one is not 0, and the zero polynomial has none.
using Polynomial = std::vector<Integer>;

inline Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

inline Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  Polynomial sum(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < p.size(); ++i) sum[i] = p[i];
  for (std::size_t i = 0; i < q.size(); ++i) sum[i] += q[i];
  return trimmed(std::move(sum));
}

inline Polynomial operator-(Polynomial p) {
  for (Integer& c : p) c = -c;
  return p;
}

inline Polynomial operator-(const Polynomial& p, const Polynomial& q) {
  return p + -q;
}

inline Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial product(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) product[i + j] += p[i] * q[j];
  }
  return product;
}

inline Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(p[i] * static_cast<unsigned long>(i));
  return result;
}

inline Polynomial primitive_part(Polynomial p) {
  Integer content = 0;
  for (const Integer& c : p) content = gcd(content, c);
  if (content > 1) {
    for (Integer& c : p) c /= content;
  }
  return p;
}

inline Polynomial greatest_common_divisor(Polynomial p, Polynomial q) {
  p = primitive_part(std::move(p));
  q = primitive_part(std::move(q));
  if (p.size() < q.size()) std::swap(p, q);
  while (!q.empty()) {
    while (p.size() >= q.size()) {  // a multiple of p, less a multiple of q
      const Integer factor = p.back();
      const std::size_t shift = p.size() - q.size();
      for (Integer& c : p) c *= q.back();
      for (std::size_t i = 0; i < q.size(); ++i) p[i + shift] -= factor * q[i];
      p = trimmed(std::move(p));
    }
    std::swap(p, q);
    q = primitive_part(std::move(q));
  }
  return p;
}

// p / q, where q divides p and is primitive; so the quotient has integer coefficients (Gauss's
// lemma).
inline Polynomial quotient(Polynomial p, const Polynomial& q) {
  Polynomial result(p.size() + 1 - q.size());
  for (std::size_t i = result.size(); i-- > 0;) {
    result[i] = p[i + q.size() - 1] / q.back();
    for (std::size_t j = 0; j < q.size(); ++j) p[i + j] -= result[i] * q[j];
  }
  return result;
}

// A square-free polynomial with the roots of p.
inline Polynomial square_free_part(const Polynomial& p) {
  return quotient(primitive_part(p), greatest_common_divisor(p, derivative(p)));
}

// A square-free polynomial whose roots are the roots of odd multiplicity of p: D. Yun's
// decomposition (On square-free decomposition algorithms, SYMSAC 1976).
inline Polynomial odd_part(const Polynomial& p) {
  Polynomial repeated = greatest_common_divisor(p, derivative(p));
  Polynomial simple = quotient(primitive_part(p), repeated);  // each root once
  Polynomial result = {1};
  for (bool is_odd = true; simple.size() > 1; is_odd = !is_odd) {
    const Polynomial higher = greatest_common_divisor(simple, repeated);
    if (is_odd) result = result * quotient(simple, higher);
    repeated = quotient(repeated, higher);
    simple = higher;
  }
  return result;
}

inline int sign_at(const Polynomial& p, const Dyadic& t) {
  Integer value = 0;
  unsigned long e = 0;
  for (std::size_t i = p.size(); i-- > 0; e += t.e) value = value * t.m + (p[i] << e);
  return sgn(value);
}

// What the signs of the Bernstein coefficients of p over [l, u], l < u, tell (Lemma 1). The first
// and the last are those of p at l and at u.
struct Signs {
  int first = 0;
  int last = 0;
  bool has_positive = false;
  bool has_negative = false;
  int changes = 0;
  // The sign of p inside, if it is the same everywhere there, and otherwise 0.
  int inside() const { return has_negative == has_positive ? 0 : has_positive ? 1 : -1; }
};

inline Signs bernstein_signs(const Polynomial& p, const Dyadic& l, const Dyadic& u) {
  const unsigned long e = std::max(l.e, u.e);
  const Integer lower = l.m << (e - l.e);
  const Integer width = (u.m << (e - u.e)) - lower;
  const std::size_t n = p.size();
  Polynomial c = p;
  for (std::size_t i = 0; i < n; ++i) c[i] <<= e * (n - 1 - i);  // in t 2^e
  for (std::size_t i = 0; i + 1 < n; ++i) {                      // in t 2^e - lower
    for (std::size_t j = n - 1; j-- > i;) c[j] += lower * c[j + 1];
  }
  Integer power = 1;
  for (std::size_t i = 0; i < n; ++i, power *= width) c[i] *= power;
  // (1 + s)^(n - 1) c(s / (1 + s)): its coefficients are those of Bernstein, times binomials.
  std::reverse(c.begin(), c.end());
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = n - 1; j-- > i;) c[j] += c[j + 1];
  }
  Signs signs;
  int previous = 0;
  for (std::size_t i = n; i-- > 0;) {
    const int sign = sgn(c[i]);
    if (sign > 0) signs.has_positive = true;
    if (sign < 0) signs.has_negative = true;
    if (sign * previous < 0) ++signs.changes;
    if (sign != 0) previous = sign;
  }
  if (n > 0) {
    signs.first = sgn(c.back());
    signs.last = sgn(c.front());
  }
  return signs;
}

// The number lo, if both ends are equal; otherwise the only root of f in the open interval. There f
// is square-free, it is not 0 at the ends, and its signs there differ.
struct Time {
  Polynomial f;
  Dyadic lo, hi;
  bool is_dyadic() const { return f.empty(); }
};

inline Time exactly(const Dyadic& t) {
  return {{}, t, t};
}

// Halves the interval of a root.
inline void refine(Time& t) {
  Dyadic m = middle(t.lo, t.hi);
  const int sign = sign_at(t.f, m);
  if (sign == 0) {
    t = exactly(m);
  } else {
    (sign == sign_at(t.f, t.lo) ? t.lo : t.hi) = std::move(m);
  }
}

// Whether g, which divides the polynomial of t, has the root t.
inline bool has_root_in(const Polynomial& g, const Dyadic& lo, const Dyadic& hi) {
  return g.size() > 1 && sign_at(g, lo) * sign_at(g, hi) < 0;
}

// The exact order of two times (Lemma 3). Intervals are narrowed.
inline int compare(Time& a, Time& b) {
  for (bool is_first = true;; is_first = false) {
    if (a.is_dyadic() && b.is_dyadic()) return compare(a.lo, b.lo);
    if (compare(a.hi, b.lo) <= 0) return -1;
    if (compare(b.hi, a.lo) <= 0) return 1;
    if (a.is_dyadic() || b.is_dyadic()) {
      Time& root = a.is_dyadic() ? b : a;
      if (sign_at(root.f, (a.is_dyadic() ? a : b).lo) == 0) return 0;
      refine(root);
      continue;
    }
    const Dyadic& lo = compare(a.lo, b.lo) < 0 ? b.lo : a.lo;
    const Dyadic& hi = compare(a.hi, b.hi) < 0 ? a.hi : b.hi;
    if (is_first) {
      if (has_root_in(a.f == b.f ? a.f : greatest_common_divisor(a.f, b.f), lo, hi)) return 0;
    }
    refine(a);
    if (!b.is_dyadic()) refine(b);
  }
}

// The sign of p at t.
inline int sign_at(const Polynomial& p, Time& t) {
  for (bool is_first = true;; is_first = false) {
    if (p.empty()) return 0;
    if (t.is_dyadic()) return sign_at(p, t.lo);
    const int sign = bernstein_signs(p, t.lo, t.hi).inside();
    if (sign != 0) return sign;
    if (is_first && has_root_in(greatest_common_divisor(p, t.f), t.lo, t.hi)) return 0;
    refine(t);
  }
}

// The sign of p just after t: that of the first derivative that is not 0 at t.
inline int sign_just_after(Polynomial p, Time& t) {
  for (; !p.empty(); p = derivative(p)) {
    const int sign = sign_at(p, t);
    if (sign != 0) return sign;
  }
  return 0;
}

// Appends the roots of q, which is square-free, in the open interval, in order (Lemma 2).
inline void append_roots(const Polynomial& q, const Dyadic& lo, const Dyadic& hi,
                         std::vector<Time>& roots) {
  const Signs signs = bernstein_signs(q, lo, hi);
  if (signs.changes == 0) return;
  if (signs.changes == 1 && signs.first * signs.last != 0) {
    roots.push_back({q, lo, hi});
    return;
  }
  const Dyadic m = middle(lo, hi);
  append_roots(q, lo, m, roots);
  if (sign_at(q, m) == 0) roots.push_back(exactly(m));
  append_roots(q, m, hi, roots);
}

// The roots of q, which is square-free, in the closed interval, in order.
inline std::vector<Time> roots_in(const Polynomial& q, const Dyadic& lo, const Dyadic& hi) {
  std::vector<Time> roots;
  if (q.size() < 2) return roots;
  if (sign_at(q, lo) == 0) roots.push_back(exactly(lo));
  if (compare(lo, hi) < 0) {
    append_roots(q, lo, hi, roots);
    if (sign_at(q, hi) == 0) roots.push_back(exactly(hi));
  }
  return roots;
}

// The first root of odd multiplicity of p after `from` and before `until`, or at it if `with_end`.
inline std::optional<Time> first_failure(const Polynomial& p, Time& from, Time& until,
                                         bool with_end) {
  if (p.size() < 2 || compare(from.lo, until.hi) >= 0) return std::nullopt;
  const Signs signs = bernstein_signs(p, from.lo, until.hi);
  if (signs.inside() != 0 && !(with_end && signs.last == 0)) return std::nullopt;
  for (Time& root : roots_in(odd_part(p), from.lo, until.hi)) {
    if (compare(root, from) <= 0) continue;
    const int order = compare(root, until);
    if (order < 0 || (with_end && order == 0)) return root;
  }
  return std::nullopt;
}

// For messages only: nothing is decided by these numbers.
inline double approximate(const Dyadic& t) {
  return mpq_class(t.m, Integer(1) << t.e).get_d();
}

inline std::string text(const Polynomial& p) {
  std::string result;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i > 0) result += " + ";
    result += p[i].get_str() + " t^" + std::to_string(i);
  }
  return result.empty() ? "0" : result;
}

}  // namespace verify

#endif  // KINETRI_VERIFY_ROOTS_H
