// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences of polynomial motions over a window, and their products, as linear_differences.h for
// linear motion.
#ifndef KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "bernstein.h"
#include "coordinate_pair.h"
#include "error_bounds.h"
#include "in_circle_coefficients.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

// The difference of two motions of degree K: for each power of time, the coefficients of both
// coordinates.
template <std::size_t K>
using Powers = std::array<Pair, K + 1>;

inline std::size_t degree(const Polynomial_motion_2& m) {
  constexpr Vector_2 zero = {};
  return m.jerk != zero ? 3 : m.acceleration != zero ? 2 : 1;
}

// Whether the difference of two motions may change with time. Decided by the given numbers: a
// computed velocity of zero may be a small one, rounded.
inline bool may_move(const Polynomial_motion_2& p, const Polynomial_motion_2& q) {
  return p.velocity != q.velocity || p.acceleration != q.acceleration || p.jerk != q.jerk ||
         (p.epoch != q.epoch && degree(p) > 1);
}

template <std::size_t K>
Powers<K> absolute(Powers<K> c) {
  for (Pair& x : c) x = absolute(x);
  return c;
}

// Coefficients in t - epoch. Precondition: the motion has degree at most K.
template <std::size_t K>
Powers<K> by_powers(const Polynomial_motion_2& m) {
  static_assert(K == 2 || K == 3);
  if constexpr (K == 2) {
    return {pair(m.position), pair(m.velocity), 0.5 * pair(m.acceleration)};
  } else {
    return {pair(m.position), pair(m.velocity), 0.5 * pair(m.acceleration), pair(m.jerk) / 6};
  }
}

// The coefficients with the origin `elapsed` later.
inline Powers<2> later(const Powers<2>& c, double elapsed) {
  const Pair c2 = elapsed * c[2];
  return {c[0] + elapsed * (c[1] + c2), c[1] + 2 * c2, c[2]};
}
inline Powers<3> later(const Powers<3>& c, double elapsed) {
  const Pair c3 = elapsed * c[3];
  return {c[0] + elapsed * (c[1] + elapsed * (c[2] + c3)), c[1] + elapsed * (2 * c[2] + 3 * c3),
          c[2] + 3 * c3, c[3]};
}

// The differences of motions of degree at most K.
template <std::size_t N, std::size_t K = 3>
class Polynomial_differences : public Error_bounds {
 public:
  // docs/MATH.md, section 9.
  static constexpr double in_circle_units = 8192;
  static constexpr double product_units = 512;
  static constexpr double coordinate_units = 128;

  Polynomial_differences(const std::array<const Polynomial_motion_2*, N>& from,
                         const Polynomial_motion_2& to, double origin) {
    for (std::size_t i = 0; i < N; ++i) {
      differences_[i] = difference(*from[i], to, origin);
      may_move_ = may_move_ || may_move(*from[i], to);
    }
  }

  // As of Linear_differences; at least the time in which the points would pass `share` of
  // `least_extent`.
  std::optional<double> window_ahead(double share, double least_extent = 0) const {
    if (!may_move_) return std::nullopt;
    Powers<K> extents = {};
    for (const Powers<K>& d : differences_) {
      for (std::size_t k = 0; k <= K; ++k) extents[k] = greater(absolute(d[k]), extents[k]);
    }
    std::array<double, K + 1> extent;
    for (std::size_t k = 0; k <= K; ++k) extent[k] = greatest(extents[k]);
    extent[0] = std::max(extent[0], least_extent);
    // With acceleration, the distance passed in the time h is at most extent[1] h + extent[2] h^2.
    double speed =
        0.5 * (extent[1] + std::sqrt(extent[1] * extent[1] + 4 * share * extent[2] * extent[0]));
    if constexpr (K == 3) speed += std::cbrt(extent[3] * (extent[0] * extent[0]));
    // With a speed of zero the window is not finite, and once scaled the sizes are out of range.
    return share * extent[0] / speed;
  }

  void scale(double window) {
    double power = 1;
    for (std::size_t k = 0; k <= K; ++k) {
      terms_[k] *= power;
      for (Powers<K>& d : differences_) d[k] *= power;
      power *= window;
    }
    const double total = sum(sum_of(terms_));
    Pair size = {};
    for (const Powers<K>& d : differences_) size = greater(sum_of(absolute<K>(d)), size);
    // Otherwise powers of the window may have underflowed.
    const bool is_exact = window == 0 || kinetri::is_in_range(window);
    // The last term is more than the error of the coefficients.
    set_sizes(greatest(size) + 0x1p-48 * total,
              is_exact ? total : std::numeric_limits<double>::infinity());
  }

  const Powers<K>& operator[](std::size_t i) const { return differences_[i]; }

 private:
  static Pair sum_of(const Powers<K>& c) {
    if constexpr (K == 2) return c[0] + (c[1] + c[2]);
    if constexpr (K == 3) return (c[0] + c[1]) + (c[2] + c[3]);
  }

  // Adds the magnitudes of all numbers that the coefficients are computed from to `terms_`.
  Powers<K> difference(const Polynomial_motion_2& p, const Polynomial_motion_2& q, double origin) {
    const Powers<K> from = by_powers<K>(p);
    const Powers<K> to = by_powers<K>(q);
    if (p.epoch == q.epoch) {
      // Subtracted first, so that the common part of the coordinates is not in the error.
      const Powers<K> difference = from - to;
      add_terms(difference, std::abs(origin - p.epoch));
      return later(difference, origin - p.epoch);
    }
    add_terms(from, std::abs(origin - p.epoch));
    add_terms(to, std::abs(origin - q.epoch));
    return later(from, origin - p.epoch) - later(to, origin - q.epoch);
  }

  void add_terms(const Powers<K>& c, double elapsed) {
    Powers<K> terms = absolute<K>(c);
    // Times the unit roundoff this is the error of a coefficient by underflow, here or in `later`.
    for (Pair& x : terms) x += 0x1p-1021;
    terms_ = terms_ + later(terms, elapsed);
  }

  std::array<Powers<K>, N> differences_;
  Powers<K> terms_ = {};  // the sums of all numbers that the coefficients were computed from
  bool may_move_ = false;
};

template <std::size_t M>
std::array<double, M> coordinate(const std::array<Pair, M>& d, int axis) {
  std::array<double, M> result;
  for (std::size_t k = 0; k < M; ++k) result[k] = d[k][axis];
  return result;
}

template <std::size_t M>
auto cross(const std::array<Pair, M>& a, const std::array<Pair, M>& b) {
  return coordinate(a, 0) * coordinate(b, 1) - coordinate(a, 1) * coordinate(b, 0);
}

template <std::size_t M>
auto dot(const std::array<Pair, M>& a, const std::array<Pair, M>& b) {
  return coordinate(a, 0) * coordinate(b, 0) + coordinate(a, 1) * coordinate(b, 1);
}

// A difference, or two in the lanes of a Pair, with its height when it is lifted, as Lifted has it.
template <std::size_t M, class Number>
struct Lifted_polynomial {
  std::array<Number, M> x, y;
  std::array<Number, 2 * M - 1> lift = x * x + y * y;
};

template <std::size_t M>
Lifted_polynomial<M, double> lifted(const std::array<Pair, M>& d) {
  return {coordinate(d, 0), coordinate(d, 1)};
}
template <std::size_t M>
Lifted_polynomial<M, Pair> lifted(const std::array<Pair, M>& a, const std::array<Pair, M>& b) {
  std::array<Pair, M> x;
  std::array<Pair, M> y;
  for (std::size_t k = 0; k < M; ++k) {
    x[k] = firsts(a[k], b[k]);
    y[k] = seconds(a[k], b[k]);
  }
  return {x, y};
}

template <std::size_t M, class A, class B>
auto vector_product(const Lifted_polynomial<M, A>& a, const Lifted_polynomial<M, B>& b) {
  return a.x * b.y - a.y * b.x;
}

// Minus the in-circle determinant of the triangle and s.
template <std::size_t M, class Corner, class Number>
auto in_circle_coefficients(const Triangle<Lifted_polynomial<M, Corner>>& t,
                            const Lifted_polynomial<M, Number>& s) {
  return t.u.lift * vector_product(t.v, s) - t.v.lift * vector_product(t.u, s) + t.uv * s.lift;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H
