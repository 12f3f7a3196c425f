// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials with integer coefficients, their real roots, and times that are such roots. Lemmas 1
// to 3 of README.md.
#ifndef KINETRI_VERIFY_ROOTS_H
#define KINETRI_VERIFY_ROOTS_H

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
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
  if (m == 0 || exponent >= 0) return {m << static_cast<unsigned long>(std::max(exponent, 0)), 0};
  const auto e = static_cast<unsigned long>(-exponent);
  const unsigned long zeros = std::min(e, mpz_scan1(m.get_mpz_t(), 0));
  return {m >> zeros, e - zeros};
}

// The order of two numbers, or of two times: negative, 0 or positive.
inline int compare(const Dyadic& a, const Dyadic& b) {
  if (a.e == b.e) return sgn(a.m - b.m);
  return a.e < b.e ? sgn((a.m << (b.e - a.e)) - b.m) : sgn(a.m - (b.m << (a.e - b.e)));
}

inline Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  const unsigned long e = std::max(a.e, b.e);
  return {(a.m << (e - a.e)) + (b.m << (e - b.e)), e};
}

inline Dyadic middle(const Dyadic& a, const Dyadic& b) {
  const Dyadic sum = a + b;
  return {sum.m, sum.e + 1};
}

// The coefficient of t^i is p[i]; the last one is not 0, and the zero polynomial has none.
using Polynomial = std::vector<Integer>;

inline Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

inline Polynomial operator-(Polynomial p) {
  for (Integer& c : p) mpz_neg(c.get_mpz_t(), c.get_mpz_t());
  return p;
}

inline Polynomial operator+(Polynomial p, const Polynomial& q) {
  p.resize(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < q.size(); ++i) p[i] += q[i];
  return trimmed(std::move(p));
}

inline Polynomial operator-(Polynomial p, const Polynomial& q) {
  p.resize(std::max(p.size(), q.size()));
  for (std::size_t i = 0; i < q.size(); ++i) p[i] -= q[i];
  return trimmed(std::move(p));
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
    while (p.size() >= q.size()) {  // a multiple of p minus a multiple of q
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

// A square-free polynomial with the roots of p, which is not 0: p over the greatest common divisor
// of p and its derivative. By Gauss's lemma its coefficients are integers.
inline Polynomial square_free_part(Polynomial p) {
  const Polynomial q = greatest_common_divisor(p, derivative(p));
  p = primitive_part(std::move(p));
  Polynomial result(p.size() + 1 - q.size());
  for (std::size_t i = result.size(); i-- > 0;) {
    result[i] = p[i + q.size() - 1] / q.back();
    for (std::size_t j = 0; j < q.size(); ++j) p[i + j] -= result[i] * q[j];
  }
  return result;
}

inline Dyadic value(const Polynomial& p, const Dyadic& t) {
  Dyadic result;
  for (std::size_t i = p.size(); i-- > 0;) {
    result.m = result.m * t.m + (p[i] << result.e);
    if (i > 0) result.e += t.e;
  }
  return result;
}

inline int sign_at(const Polynomial& p, const Dyadic& t) {
  return sgn(value(p, t).m);
}

// The Bernstein coefficients of p over [l, u], up to positive factors, in reverse order.
inline Polynomial bernstein(const Polynomial& p, const Dyadic& l, const Dyadic& u) {
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
  return c;
}

// What follows from the signs of the Bernstein coefficients of p over [l, u], l < u (Lemma 1).
struct Signs {
  int first = 0, last = 0;  // of p at l and at u
  int changes = 0;
  int inside = 0;  // of p in (l, u), if it is known to be the same everywhere there

  Signs(const Polynomial& p, const Dyadic& l, const Dyadic& u) {
    const Polynomial c = bernstein(p, l, u);
    for (std::size_t i = c.size(); i-- > 0;) {
      last = sgn(c[i]);
      if (i + 1 == c.size()) first = last;
      if (last * inside < 0) ++changes;
      if (last != 0) inside = last;
    }
    if (changes > 0) inside = 0;
  }
};

// The number lo, if f is empty, and hi is lo; otherwise the only root of f in the open interval. It
// is simple, and f is not 0 at the ends.
struct Time {
  Polynomial f;
  Dyadic lo, hi;
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

// Whether p has the root t of f, which is the only one in [lo, hi] (Lemma 3).
inline bool has_root(const Polynomial& p, const Polynomial& f, const Dyadic& lo, const Dyadic& hi) {
  const Polynomial g = p == f || p == -f ? f : greatest_common_divisor(p, f);
  return g.size() > 1 && sign_at(g, lo) * sign_at(g, hi) < 0;
}

// The order of two times (Lemma 3). Intervals are narrowed, but restored if the times are equal:
// else each such comparison would add digits.
inline int compare(Time& a, Time& b) {
  constexpr int patience = 8;  // refining is mostly faster than a greatest common divisor
  std::vector<Dyadic> before;
  for (int round = 0;; ++round) {
    if (a.f.empty() && b.f.empty()) return compare(a.lo, b.lo);
    if (compare(a.hi, b.lo) <= 0) return -1;
    if (compare(b.hi, a.lo) <= 0) return 1;
    if (a.f.empty() || b.f.empty()) {
      Time& root = a.f.empty() ? b : a;
      if (sign_at(root.f, (a.f.empty() ? a : b).lo) == 0) return 0;
      refine(root);
      continue;
    }
    if (round == (a.f == b.f || a.f == -b.f ? 0 : patience)) {
      const Dyadic& lo = compare(a.lo, b.lo) < 0 ? b.lo : a.lo;
      const Dyadic& hi = compare(a.hi, b.hi) < 0 ? a.hi : b.hi;
      if (has_root(a.f, b.f, lo, hi)) {
        if (!before.empty())
          std::tie(a.lo, a.hi, b.lo, b.hi) = std::tie(before[0], before[1], before[2], before[3]);
        return 0;
      }
    }
    if (before.empty()) before = {a.lo, a.hi, b.lo, b.hi};
    refine(a);
    if (!b.f.empty()) refine(b);
  }
}

// The sign of p at t.
inline int sign_at(const Polynomial& p, Time& t) {
  for (bool is_first = true;; is_first = false) {
    if (p.empty()) return 0;
    if (t.f.empty()) return sign_at(p, t.lo);
    const int sign = Signs(p, t.lo, t.hi).inside;
    if (sign != 0) return sign;
    if (is_first && has_root(p, t.f, t.lo, t.hi)) return 0;
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

// Whether p changes its sign at its root t: whether the multiplicity is odd.
inline bool changes_sign(Polynomial p, Time& t) {
  bool is_odd = false;
  for (; !p.empty() && sign_at(p, t) == 0; p = derivative(p)) is_odd = !is_odd;
  return is_odd;
}

// Appends the roots of q, which is square-free, in the open interval, in order (Lemma 2).
inline void append_roots(const Polynomial& q, const Dyadic& lo, const Dyadic& hi,
                         std::vector<Time>& roots) {
  const Signs signs(q, lo, hi);
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

// The roots of p in the closed interval, each one once, in order.
inline std::vector<Time> roots_in(const Polynomial& p, const Dyadic& lo, const Dyadic& hi) {
  if (p.size() < 2) return {};
  const Signs signs(p, lo, hi);
  if (signs.first * signs.last != 0) {
    if (signs.changes == 0) return {};
    if (signs.changes == 1) return {{p, lo, hi}};
  }
  const Polynomial q = square_free_part(p);
  std::vector<Time> roots;
  if (signs.first == 0) roots.push_back(exactly(lo));
  if (compare(lo, hi) == 0) return roots;
  append_roots(q, lo, hi, roots);
  if (signs.last == 0) roots.push_back(exactly(hi));
  return roots;
}

// An approximation for messages only.
inline double approximate(const Dyadic& t) {
  return mpq_class(t.m, Integer(1) << t.e).get_d();
}

inline std::string text(const Polynomial& p) {
  std::string result;
  for (std::size_t i = 0; i < p.size(); ++i) {
    result += (i > 0 ? " + " : "") + p[i].get_str() + " t^" + std::to_string(i);
  }
  return result;
}

}  // namespace verify

#endif  // KINETRI_VERIFY_ROOTS_H
