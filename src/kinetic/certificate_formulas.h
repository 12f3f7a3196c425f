// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formulas of certificates, for polynomials on the heap and for Static_polynomial.
#ifndef KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H
#define KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H

#include <cstdint>
#include <type_traits>

#include "algebra/static_polynomial.h"
#include "kinetri/algebra/polynomial.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The vector from one point to another in homogeneous coordinates, and the difference of their
/// weights times w^2.
template <class Poly>
struct Vector {
  Poly x;
  Poly y;
  Poly w;
  Poly weight;
};

/// @{ Products with a denominator. A denominator 1 costs nothing; on the stack all are 1.
inline Polynomial times(const Polynomial& a, const Polynomial& w) {
  return w.degree() == 0 && w[0] == 1 ? a : a * w;
}
template <class Number>
const Static_polynomial<Number>& times(const Static_polynomial<Number>& a,
                                       const Static_polynomial<Number>& /*w*/) {
  return a;
}
/// @}

/// The vector between points with members x, y, w and weight.
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

/// The quadratic form by which points are lifted.
enum class Lifting : std::uint8_t {
  paraboloid,  ///< x^2 + y^2 - weight
  xy,          ///< x y
  xx,          ///< x^2
  yy,          ///< y^2
};
/// The height of the lifted end of the vector above the tangent plane at its lifted beginning.
template <class Poly>
Poly lift(const Vector<Poly>& a, Lifting lifting) {
  switch (lifting) {
    case Lifting::xy:
      return a.x * a.y;
    case Lifting::xx:
      return a.x * a.x;
    case Lifting::yy:
      return a.y * a.y;
    default:
      return squared_length(a) - a.weight;
  }
}

/// Positive if a, b, c make a left turn.
template <class Trajectory>
auto orientation_of(const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  const auto u = difference(b, a);
  const auto v = difference(c, a);
  using Poly = std::remove_cvref_t<decltype(u.x)>;
  return Poly(times(times(cross(u, v), u.w), v.w));
}

/// Positive if lifted d is below the plane through lifted a, b, c, which make a left turn. With the
/// paraboloid: if d is inside their circle.
template <class Trajectory>
auto in_circle_of(Lifting lifting, const Trajectory& a, const Trajectory& b, const Trajectory& c,
                  const Trajectory& d) {
  const auto u = difference(a, d);
  const auto v = difference(b, d);
  const auto w = difference(c, d);
  // With row i times w_i^2 the columns are x w, y w and the lifted one. So each cofactor has the
  // product of its two denominators as a factor.
  return lift(u, lifting) * times(times(cross(v, w), v.w), w.w) +
         lift(v, lifting) * times(times(cross(w, u), w.w), u.w) +
         lift(w, lifting) * times(times(cross(u, v), u.w), v.w);
}

/// @{
/// Positive if the coordinate of a is greater than that of b.
template <class Trajectory>
auto x_difference_of(const Trajectory& a, const Trajectory& b) {
  const auto v = difference(a, b);
  return std::remove_cvref_t<decltype(v.x)>(times(v.x, v.w));
}
template <class Trajectory>
auto y_difference_of(const Trajectory& a, const Trajectory& b) {
  const auto v = difference(a, b);
  return std::remove_cvref_t<decltype(v.x)>(times(v.y, v.w));
}
/// @}

/// Positive if b is farther from a than c is.
template <class Trajectory>
auto distance_difference_of(const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  // |b-a|^2 / (wb wa)^2 - |c-a|^2 / (wc wa)^2, times the positive (wa wb wc)^2.
  const auto to_b = squared_length(difference(b, a));
  const auto to_c = squared_length(difference(c, a));
  return times(times(to_b, c.w), c.w) - times(times(to_c, b.w), b.w);
}

/// Positive if c and d are farther apart than a and b are.
template <class Trajectory>
auto distance_comparison_of(const Trajectory& a, const Trajectory& b, const Trajectory& c,
                            const Trajectory& d) {
  const auto u = difference(a, b);
  const auto v = difference(c, d);
  return times(times(squared_length(v), u.w), u.w) - times(times(squared_length(u), v.w), v.w);
}

/// Positive if the distance of a and b is greater than `reach`, a length value / w that is not
/// negative.
template <class Trajectory, class Reach>
auto contact_of(const Trajectory& a, const Trajectory& b, const Reach& reach) {
  const auto v = difference(a, b);
  return times(times(squared_length(v), reach.w), reach.w) -
         times(times(reach.value * reach.value, v.w), v.w);
}

/// Positive if a is inside of the wall's bound, a coordinate value / w with w > 0.
template <class Trajectory, class Bound>
auto wall_of(const Wall_2& wall, const Trajectory& a, const Bound& bound) {
  const auto& place = wall.is_vertical() ? a.x : a.y;
  using Poly = std::remove_cvref_t<decltype(place)>;
  const Poly above = times(times(place, bound.w) - times(bound.value, a.w), a.w);
  return wall.is_upper() ? -above : above;
}

/// Positive if the weight of a is greater than that of b.
template <class Trajectory>
auto weight_difference_of(const Trajectory& a, const Trajectory& b) {
  return times(times(a.weight, b.w), b.w) - times(times(b.weight, a.w), a.w);
}

/// Positive if the power of a to b is greater than that to c.
template <class Trajectory>
auto power_distance_difference_of(const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  // As distance_difference_of.
  const auto to_b = squared_length(difference(b, a)) - times(times(b.weight, a.w), a.w);
  const auto to_c = squared_length(difference(c, a)) - times(times(c.weight, a.w), a.w);
  return times(times(to_b, c.w), c.w) - times(times(to_c, b.w), b.w);
}

/// The scalar product of the vectors from b to a and to c.
template <class Trajectory>
auto scalar_product_of(const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  const auto u = difference(a, b);
  const auto v = difference(c, b);
  using Poly = std::remove_cvref_t<decltype(u.x)>;
  return Poly(times(times(dot(u, v), u.w), v.w));
}

/// With u = a - b and v = c - b: the determinant of the coordinates of u and v along the line and
/// of their lifts, times |u - v|, times (u.w v.w)^4.
template <class Trajectory>
auto segment_of(Lifting lifting, const Trajectory& a, const Trajectory& b, const Trajectory& c) {
  const auto u = difference(a, b);
  const auto v = difference(c, b);
  using Poly = std::remove_cvref_t<decltype(u.x)>;
  const Poly uu = times(squared_length(u), v.w);
  const Poly uv = dot(u, v);
  const Poly vv = times(squared_length(v), u.w);
  const Poly along_u = times(uu - times(uv, u.w), u.w);
  const Poly along_v = times(times(uv, v.w) - vv, v.w);
  return times(times(along_u * lift(v, lifting), u.w), v.w) -
         times(times(along_v * lift(u, lifting), u.w), v.w);
}

/// The formula with this lifting as its first argument.
template <class Formula>
constexpr auto lifted_by(Lifting lifting, const Formula& formula) {
  return [lifting, formula](const auto&... paths) { return formula(lifting, paths...); };
}

/// The symbolically perturbed formula: points are lifted by the sum of all liftings, each with a
/// positive factor that is infinitely small relative to the one before. Its value is the polynomial
/// of the first lifting for which this is not zero; docs/MATH.md, section 4, proves that there is
/// one. The last lifting is needed only with weights.
template <class Formula>
constexpr auto perturbed(const Formula& formula) {
  return [formula](const auto&... paths) {
    auto result = formula(Lifting::paraboloid, paths...);
    for (const Lifting next : {Lifting::xy, Lifting::xx, Lifting::yy}) {
      if (!result.is_zero()) break;
      result = formula(next, paths...);
    }
    return result;
  };
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_CERTIFICATE_FORMULAS_H
