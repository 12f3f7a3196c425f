// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first time at which a polynomial becomes negative, in doubles without error bounds: the root
// finder of the uncertified kinetic Delaunay triangulation.
//
// The coefficients c_k of a polynomial p in t, divided by binomial(N, k), are the Bernstein
// coefficients of (1 - u)^N p(u / (1 - u)). So de Casteljau's algorithm subdivides the half line t
// > 0; a piece whose coefficients change sign once has exactly one root (Descartes' rule).
#ifndef KINETRI_BENCH_FIRST_FAILURE_H
#define KINETRI_BENCH_FIRST_FAILURE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace kinetri::bench {

inline constexpr double never = std::numeric_limits<double>::infinity();

template <std::size_t N>
using Coefficients = std::array<double, N + 1>;

template <std::size_t N>
inline constexpr Coefficients<N> binomials = {};
template <>
inline constexpr Coefficients<1> binomials<1> = {1, 1};
template <>
inline constexpr Coefficients<2> binomials<2> = {1, 2, 1};
template <>
inline constexpr Coefficients<3> binomials<3> = {1, 3, 3, 1};
template <>
inline constexpr Coefficients<4> binomials<4> = {1, 4, 6, 4, 1};

template <std::size_t M>
int sign_changes(const std::array<double, M>& c) {
  int changes = 0;
  bool positive = true;  // c[0] is
  for (std::size_t i = 1; i < M; ++i) {
    // A zero continues the sign before it.
    const bool changed = positive ? c[i] < 0 : c[i] > 0;
    changes += changed;
    positive ^= changed;
  }
  return changes;
}

/// The only positive root of a polynomial with c[0] > 0 and one sign change, by Newton's method
/// from `x`. To the right of the root the polynomial decreases and is concave, so steps from there
/// do not pass the root.
template <std::size_t M>
double only_root(const std::array<double, M>& c, double x) {
  for (int i = 0; i < 60; ++i) {
    double value = c[M - 1];
    double slope = 0;
    for (std::size_t k = M - 1; k-- > 0;) {
      slope = slope * x + value;
      value = value * x + c[k];
    }
    const double next = slope < 0 ? std::min(x - value / slope, 8 * x) : 4 * x;
    const double step = std::abs(next - x);
    x = next;
    if (step <= 1e-8 * x) break;  // the error is now of the order of step^2
  }
  return x;
}

/// de Casteljau's algorithm at one half: `b` becomes the left half, the right half is returned.
template <std::size_t M>
std::array<double, M> split(std::array<double, M>& b) {
  std::array<double, M> right;
  for (std::size_t i = 0; i < M; ++i) {
    right[M - 1 - i] = b[M - 1];
    for (std::size_t j = M - 1; j > i; --j) b[j] = 0.5 * (b[j - 1] + b[j]);
  }
  return right;
}

/// The root in [0, 1] of Bernstein coefficients with one sign change, the first one positive.
template <std::size_t M>
double only_root_in_piece(std::array<double, M> b) {
  const double guess = std::clamp(b[0] / -b[M - 1], 1e-3, 1e3);
  for (std::size_t k = 0; k < M; ++k) b[k] *= binomials<M - 1>[k];
  const double x = only_root(b, guess);
  return x / (1 + x);
}

/// The first root in [0, 1] of Bernstein coefficients, the first one positive; `never` if there is
/// none.
template <std::size_t M>
double first_root_in_piece(std::array<double, M> b) {
  struct Piece {
    std::array<double, M> b;
    double lower;
    double width;
  };
  constexpr double least_width = 1e-9;  // below it, 0, 1 or 2 roots are not distinguished
  std::array<Piece, 64> stack;
  std::size_t size = 0;
  double lower = 0;
  double width = 1;
  for (;;) {
    const int changes = sign_changes(b);
    if (changes == 1) return lower + width * only_root_in_piece(b);
    if (changes > 1 && width > least_width) {
      width *= 0.5;
      stack[size++] = {split(b), lower + width, width};
      continue;
    }
    if (size == 0) return never;
    const Piece& next = stack[--size];
    b = next.b;
    lower = next.lower;
    width = next.width;
    // A root between two pieces.
    if (!(b[0] > 0)) return lower;
  }
}

/// The Bernstein coefficients over [0, width] of a polynomial.
inline std::array<double, 5> bernstein(std::array<double, 5> c, double width) {
  const double w2 = width * width;
  c[1] *= width;
  c[2] *= w2;
  c[3] *= w2 * width;
  c[4] *= w2 * w2;
  const double c1 = c[1] * 0.25;
  const double c2 = c[2] * (1.0 / 6);
  const double c3 = c[3] * 0.25;
  const double b1 = c[0] + c1;
  return {c[0], b1, b1 + c1 + c2, c[0] + 3 * (c1 + c2) + c3, c[0] + c[1] + c[2] + c[3] + c[4]};
}
inline std::array<double, 4> bernstein(std::array<double, 4> c, double width) {
  const double w2 = width * width;
  c[1] *= width;
  c[2] *= w2;
  c[3] *= w2 * width;
  const double c1 = c[1] * (1.0 / 3);
  const double c2 = c[2] * (1.0 / 3);
  const double b1 = c[0] + c1;
  return {c[0], b1, b1 + c1 + c2, c[0] + c[1] + c[2] + c[3]};
}
inline std::array<double, 3> bernstein(std::array<double, 3> c, double width) {
  c[1] *= width;
  c[2] *= width * width;
  return {c[0], c[0] + 0.5 * c[1], c[0] + c[1] + c[2]};
}
inline std::array<double, 2> bernstein(std::array<double, 2> c, double width) {
  return {c[0], c[0] + c[1] * width};
}

/// The first t > 0 at which the polynomial with c[0] > 0 becomes negative; `never` if there is
/// none. `scale` is a typical root. Adds one to `solves` unless all coefficients are positive or
/// zero.
template <std::size_t M>
double first_failure(const std::array<double, M>& c, double scale, std::uint64_t& solves) {
  const int changes = sign_changes(c);
  if (changes == 0) return never;
  ++solves;
  if (changes == 1) return only_root(c, scale);
  std::array<double, M> b;
  double power = 1;
  for (std::size_t k = 0; k < M; ++k, power *= scale) b[k] = c[k] * power / binomials<M - 1>[k];
  const double u = first_root_in_piece(b);
  return u < 1 ? scale * u / (1 - u) : never;
}

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_FIRST_FAILURE_H
