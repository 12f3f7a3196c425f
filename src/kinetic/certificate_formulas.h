// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formulas of certificates, in polynomials on the heap or of numbers on the stack.
#ifndef KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H
#define KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H

#include "algebra/static_polynomial.h"
#include "kinetri/algebra/polynomial.h"

namespace kinetri {

/// The vector from one point to another, in homogeneous coordinates, and by how much the weight of
/// the other is greater, times w^2.
template <class Poly>
struct Vector {
  Poly x;
  Poly y;
  Poly w;
  Poly weight;
};

/// @{
/// Products with a denominator. Denominators are 1 for linear motion, and then cost nothing; on the
/// stack they are always 1.
inline Polynomial times(const Polynomial& a, const Polynomial& w) {
  return w.degree() == 0 && w[0] == 1 ? a : a * w;
}
template <class Number>
const Static_polynomial<Number>& times(const Static_polynomial<Number>& a,
                                       const Static_polynomial<Number>& /*w*/) {
  return a;
}
/// @}

/// From `from` to `to`, points with members x, y, w and weight.
template <class Trajectory>
auto difference(const Trajectory& to, const Trajectory& from) {
  using Poly = std::remove_cvref_t<decltype(to.x)>;
  return Vector<Poly>{
      times(to.x, from.w) - times(from.x, to.w), times(to.y, from.w) - times(from.y, to.w),
      times(to.w, from.w),
      times(times(to.weight, from.w), from.w) - times(times(from.weight, to.w), to.w)};
}

template <class Poly>
Poly cross(const Vector<Poly>& a, const Vector<Poly>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Poly>
Poly dot(const Vector<Poly>& a, const Vector<Poly>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Poly>
Poly squared_length(const Vector<Poly>& a) {
  return dot(a, a);
}
/// The height of the end of the vector, lifted by x^2 + y^2 - weight, above the plane that touches
/// the lifted paraboloid over its beginning.
template <class Poly>
Poly lift(const Vector<Poly>& a) {
  return squared_length(a) - a.weight;
}

/// Positive if a, b, c make a left turn.
template <class Trajectory>
auto orientation_of(const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  const auto u = difference(b, a);
  const auto v = difference(c, a);
  using Poly = std::remove_cvref_t<decltype(u.x)>;
  return Poly(times(times(cross(u, v), u.w), v.w));
}

/// Positive if d is inside the circle through a, b, c, which make a left turn.
template <class Trajectory>
auto in_circle_of(const Trajectory& a, const Trajectory& b, const Trajectory& c,
                  const Trajectory& d) {
  const auto u = difference(a, d);
  const auto v = difference(b, d);
  const auto w = difference(c, d);
  // With row i times w_i^2 (a positive factor) the columns are x w, y w and x^2 + y^2, so that each
  // cofactor carries the product of its two denominators.
  return lift(u) * times(times(cross(v, w), v.w), w.w) +
         lift(v) * times(times(cross(w, u), w.w), u.w) +
         lift(w) * times(times(cross(u, v), u.w), v.w);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H
