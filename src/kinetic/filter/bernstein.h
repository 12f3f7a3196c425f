// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials over [0, 1] whose values are known up to an error: Bernstein coefficients, roots, and
// intervals in which they are certainly positive.
#ifndef KINETRI_SRC_KINETIC_FILTER_BERNSTEIN_H
#define KINETRI_SRC_KINETIC_FILTER_BERNSTEIN_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "error_bounds.h"

namespace kinetri {

template <std::size_t N>
using Coefficients = std::array<double, N + 1>;

// ---- arithmetic ----

// For one polynomial, or for several if a Number is a vector of numbers.
template <class A, class B, std::size_t M, std::size_t N>
auto operator*(const std::array<A, M>& a, const std::array<B, N>& b) {
  using Number = decltype(A() * B());
  std::array<Number, M + N - 1> result = {};
  for (std::size_t i = 0; i < M; ++i) {
    for (std::size_t j = 0; j < N; ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}
template <class Number, std::size_t M>
std::array<Number, M> operator+(std::array<Number, M> a, const std::array<Number, M>& b) {
  for (std::size_t i = 0; i < M; ++i) a[i] += b[i];
  return a;
}
template <class Number, std::size_t M>
std::array<Number, M> operator-(std::array<Number, M> a, const std::array<Number, M>& b) {
  for (std::size_t i = 0; i < M; ++i) a[i] -= b[i];
  return a;
}

template <std::size_t M>
std::array<double, M> negated(std::array<double, M> c) {
  for (double& x : c) x = -x;
  return c;
}

template <std::size_t M>
std::array<double, M - 1> slope_of(const std::array<double, M>& c) {
  std::array<double, M - 1> result;
  for (std::size_t i = 1; i < M; ++i) result[i - 1] = static_cast<double>(i) * c[i];
  return result;
}

// ---- Bernstein form ----

template <std::size_t M>
inline double least(const std::array<double, M>& c) {
  double result = c[0];
  for (std::size_t i = 1; i < M; ++i) result = std::min(result, c[i]);
  return result;
}

// The Bernstein coefficients over [0, 1]; of several polynomials if a Number is a vector.
template <class Number>
std::array<Number, 5> bernstein(const std::array<Number, 5>& c) {
  const Number c1 = c[1] * 0.25;
  const Number c2 = c[2] * (1.0 / 6);
  const Number c3 = c[3] * 0.25;
  const Number b1 = c[0] + c1;
  const Number b2 = b1 + c1 + c2;
  const Number b3 = c[0] + 3 * c1 + 3 * c2 + c3;
  const Number b4 = c[0] + c[1] + c[2] + c[3] + c[4];
  return {c[0], b1, b2, b3, b4};
}
inline Coefficients<3> bernstein(const Coefficients<3>& c) {
  const double c1 = c[1] * (1.0 / 3);
  const double c2 = c[2] * (1.0 / 3);
  const double b1 = c[0] + c1;
  const double b2 = b1 + c1 + c2;
  return {c[0], b1, b2, c[0] + c[1] + c[2] + c[3]};
}
inline Coefficients<2> bernstein(const Coefficients<2>& c) {
  return {c[0], c[0] + 0.5 * c[1], c[0] + c[1] + c[2]};
}
inline Coefficients<1> bernstein(const Coefficients<1>& c) {
  return {c[0], c[0] + c[1]};
}

// The same for any degree: b_i = sum over k of c_k C(i, k) / C(degree, k).
template <class Number, std::size_t M>
std::array<Number, M> bernstein(const std::array<Number, M>& c) {
  constexpr auto shares = [] {
    std::array<std::array<double, M>, M> binomial = {};
    for (std::size_t i = 0; i < M; ++i) {
      binomial[i][0] = 1;
      for (std::size_t k = 1; k <= i; ++k) {
        binomial[i][k] = binomial[i - 1][k - 1] + (k < i ? binomial[i - 1][k] : 0);
      }
    }
    auto result = binomial;
    for (auto& row : result) {
      for (std::size_t k = 0; k < M; ++k) row[k] /= binomial[M - 1][k];
    }
    return result;
  }();
  std::array<Number, M> result;
  for (std::size_t i = 0; i < M; ++i) {
    result[i] = c[0];
    for (std::size_t k = 1; k <= i; ++k) result[i] += shares[i][k] * c[k];
  }
  return result;
}

// Even and odd powers separately, which takes half the time of Horner's rule.
template <std::size_t M>
double value(const std::array<double, M>& c, double w) {
  static_assert(M >= 2);
  const double w2 = w * w;
  double with_last = c[M - 1];
  double other = c[M - 2];
  for (std::size_t i = M - 2; i-- > 0;) {
    const double next = with_last * w2 + c[i];
    with_last = other;
    other = next;
  }
  return other + w * with_last;
}

template <std::size_t M>
double slope(const std::array<double, M>& c, double w) {
  double result = static_cast<double>(M - 1) * c[M - 1];
  for (std::size_t i = M - 1; i-- > 1;) result = result * w + static_cast<double>(i) * c[i];
  return result;
}

// De Casteljau's algorithm at one half: `b` becomes the left half, the right half is returned.
template <std::size_t M>
std::array<double, M> split(std::array<double, M>& b) {
  std::array<double, M> right;
  for (std::size_t i = 0; i < M; ++i) {
    right[M - 1 - i] = b[M - 1];
    for (std::size_t j = M - 1; j > i; --j) b[j] = 0.5 * (b[j - 1] + b[j]);
  }
  return right;
}

// Narrows [lower, upper], in which the polynomial has one root and changes from positive to
// negative: Newton's method from `w`, safeguarded by bisection. Returns false if the signs at the
// ends of the new bracket are not certain.
template <std::size_t M>
bool bracket_root(const std::array<double, M>& c, double error, double w, double& lower,
                  double& upper) {
  double low = lower;
  double high = upper;
  double per_slope = 1 / slope(c, w);
  for (int i = 0; i < 12; ++i) {
    const double v = value(c, w);
    if (std::abs(v) <= error) break;
    (v > 0 ? low : high) = w;
    double next = w - v * per_slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    // The error after a step is proportional to its square.
    const double squared_step = (next - w) * (next - w);
    w = next;
    if (16 * squared_step <= error * std::abs(per_slope)) break;
    per_slope = 1 / slope(c, w);
  }
  // Values near a simple root are about linear, so they are certain at this distance.
  double distance = std::max(3 * error * std::abs(per_slope), 4 * unit_roundoff * w);
  for (int i = 0; i < 6; ++i, distance *= 4) {
    const double left = std::max(w - distance, lower);
    const double right = std::min(w + distance, upper);
    if (value(c, left) > error && value(c, right) < -error) {
      lower = left;
      upper = right;
      return true;
    }
  }
  return false;
}

// The w up to which a polynomial, given by Bernstein coefficients with errors up to `error`, is
// certainly positive: its graph lies above the lower convex hull of the points (i / degree, b[i] -
// error). Zero if it may be negative at 0.
template <std::size_t M>
double positive_share(const std::array<double, M>& b, double error) {
  constexpr auto reciprocals = [] {
    std::array<double, M> result = {};
    for (std::size_t k = 1; k < M; ++k) result[k] = 1 / static_cast<double>(k);
    return result;
  }();
  if (least(b) > error) return 1;
  std::size_t i = 0;
  while (b[i] > error) {
    std::size_t next = i + 1;
    double least = b[next] - b[i];
    for (std::size_t k = i + 2; k < M; ++k) {
      const double rise = (b[k] - b[i]) * reciprocals[k - i];
      if (rise < least) {
        least = rise;
        next = k;
      }
    }
    if (!(b[next] > error)) {
      // Rounded down by far more than the errors of these operations.
      const double crossing = static_cast<double>(i) + (b[i] - error) / -least;
      return crossing / static_cast<double>(M - 1) * (1 - 0x1p-40);
    }
    i = next;
  }
  return 0;
}

// If the signs of the coefficients are certain and change once, the number before the change, else
// zero.
template <std::size_t M>
std::size_t before_only_change(const std::array<double, M>& b, double error) {
  std::size_t i = 0;
  while (i < M && b[i] > error) ++i;
  for (std::size_t k = i; k < M; ++k) {
    if (!(b[k] < -error)) return 0;
  }
  return i < M ? i : 0;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_BERNSTEIN_H
