// SPDX-License-Identifier: GPL-3.0-or-later
//
// The in-circle certificate of linear motions as a polynomial in w: of one certificate, or of two
// in the lanes of a Pair.
#ifndef KINETRI_SRC_KINETIC_FILTER_IN_CIRCLE_COEFFICIENTS_H
#define KINETRI_SRC_KINETIC_FILTER_IN_CIRCLE_COEFFICIENTS_H

#include <array>

#include "coordinate_pair.h"

namespace kinetri {

template <class Number>
using Quadratic = std::array<Number, 3>;
template <class Number>
using Quartic = std::array<Number, 5>;

// The difference of a point and the corner, with its lift: the squared length, less the weight if
// points have weights.
template <class Number>
struct Lifted {
  Number x, y;
  Number slope_x, slope_y;
  Quadratic<Number> lift = {x * x + y * y, 2 * (x * slope_x + y * slope_y),
                            slope_x* slope_x + slope_y* slope_y};
};

inline Lifted<double> lifted(const Difference& d) {
  return {d.place[0], d.place[1], d.slope[0], d.slope[1]};
}
inline Lifted<Pair> lifted(const Difference& a, const Difference& b) {
  return {firsts(a.place, b.place), seconds(a.place, b.place), firsts(a.slope, b.slope),
          seconds(a.slope, b.slope)};
}

template <class A, class B>
auto vector_product(const Lifted<A>& a, const Lifted<B>& b) {
  using Number = decltype(A() * B());
  return Quadratic<Number>{
      a.x * b.y - a.y * b.x,
      (a.x * b.slope_y - a.y * b.slope_x) + (a.slope_x * b.y - a.slope_y * b.x),
      a.slope_x * b.slope_y - a.slope_y * b.slope_x};
}

// Two points that make a left turn around the corner, and their cross product.
template <class Lifted_point>
struct Triangle {
  Lifted_point u;
  Lifted_point v;
  decltype(vector_product(u, v)) uv = vector_product(u, v);
};
template <class Lifted_point>
Triangle(Lifted_point, Lifted_point) -> Triangle<Lifted_point>;

// Minus the in-circle determinant of the triangle and s.
template <class Corner, class Number>
Quartic<Number> in_circle_coefficients(const Triangle<Lifted<Corner>>& t, const Lifted<Number>& s) {
  const Quadratic<Number> vs = vector_product(t.v, s);
  const Quadratic<Number> us = vector_product(t.u, s);
  const Quadratic<Corner>& uv = t.uv;
  const Quadratic<Corner>& u = t.u.lift;
  const Quadratic<Corner>& v = t.v.lift;
  const Quadratic<Number>& l = s.lift;
  return {
      u[0] * vs[0] - v[0] * us[0] + uv[0] * l[0],
      (u[0] * vs[1] + u[1] * vs[0]) - (v[0] * us[1] + v[1] * us[0]) + (uv[1] * l[0] + uv[0] * l[1]),
      (u[0] * vs[2] + u[1] * vs[1] + u[2] * vs[0]) - (v[0] * us[2] + v[1] * us[1] + v[2] * us[0]) +
          (uv[2] * l[0] + uv[1] * l[1] + uv[0] * l[2]),
      (u[1] * vs[2] + u[2] * vs[1]) - (v[1] * us[2] + v[2] * us[1]) + (uv[2] * l[1] + uv[1] * l[2]),
      u[2] * vs[2] - v[2] * us[2] + uv[2] * l[2]};
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_IN_CIRCLE_COEFFICIENTS_H
