// SPDX-License-Identifier: GPL-3.0-or-later
//
// Signs of predicates of positions that are known up to an error, if they are certain.
#ifndef KINETRI_SRC_KINETIC_CERTAIN_SIGNS_H
#define KINETRI_SRC_KINETIC_CERTAIN_SIGNS_H

#include <algorithm>
#include <array>
#include <cmath>

#include "kinetri/impl/algebra/sign.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

namespace detail {

inline Vector_2 difference(const Vector_2& to, const Vector_2& from) {
  return {to.x - from.x, to.y - from.y};
}
inline double size_of(const Vector_2& v) {
  return std::max(std::abs(v.x), std::abs(v.y));
}
inline double square(const Vector_2& v) {
  return v.x * v.x + v.y * v.y;
}
inline double cross(const Vector_2& v, const Vector_2& w) {
  return v.x * w.y - v.y * w.x;
}

// Powers of sizes out of this range might under- or overflow.
inline Sign certain_sign(double value, double error, double size) {
  if (!(size > 0x1p-200 && size < 0x1p200)) return CGAL::ZERO;
  if (value > error) return CGAL::POSITIVE;
  if (value < -error) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

/// @{
/// The sign of a predicate of positions of which each coordinate has at most the given error, if it
/// is certain, else ZERO. docs/MATH.md, section 7, has the bounds.
inline Sign certain_orientation(const Vector_2& p, const Vector_2& q, const Vector_2& r,
                                double error) {
  const Vector_2 a = difference(q, p);
  const Vector_2 b = difference(r, p);
  const double size = std::max(size_of(a), size_of(b));
  return certain_sign(cross(a, b), 16 * size * (error + 0x1p-52 * size), size);
}
inline Sign certain_side_of_oriented_circle(const Vector_2& p, const Vector_2& q, const Vector_2& r,
                                            const Vector_2& s, double error) {
  const Vector_2 a = difference(p, s);
  const Vector_2 b = difference(q, s);
  const Vector_2 c = difference(r, s);
  const double size = std::max(std::max(size_of(a), size_of(b)), size_of(c));
  const double determinant =
      square(a) * cross(b, c) - square(b) * cross(a, c) + square(c) * cross(a, b);
  return certain_sign(determinant, 400 * (size * size * size) * (error + 0x1p-52 * size), size);
}
/// @}

// The weights of four points, each with at most the given error.
struct Weights_of_four {
  std::array<double, 4> weights;
  double error;
};

// The same for the power circle.
inline Sign certain_side_of_oriented_circle(const Vector_2& p, const Vector_2& q, const Vector_2& r,
                                            const Vector_2& s, double error,
                                            const Weights_of_four& of) {
  const Vector_2 a = difference(p, s);
  const Vector_2 b = difference(q, s);
  const Vector_2 c = difference(r, s);
  const double of_a = of.weights[0] - of.weights[3];
  const double of_b = of.weights[1] - of.weights[3];
  const double of_c = of.weights[2] - of.weights[3];
  const double size = std::max(std::max(size_of(a), size_of(b)), size_of(c));
  const double weight = std::abs(of_a) + std::abs(of_b) + std::abs(of_c);
  const double determinant = (square(a) - of_a) * cross(b, c) - (square(b) - of_b) * cross(a, c) +
                             (square(c) - of_c) * cross(a, b);
  return certain_sign(determinant,
                      400 * (size * size * size) * (error + 0x1p-52 * size) +
                          64 * (weight * size) * (error + 0x1p-50 * size) +
                          128 * (size * size) * of.error,
                      size);
}

}  // namespace detail

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_CERTAIN_SIGNS_H
