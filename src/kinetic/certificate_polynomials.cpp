// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/certificate_polynomials.h"

#include "kinetri/base/check.h"

namespace kinetri {
namespace {

// The vector from one point to another, in homogeneous coordinates.
struct Vector {
  Polynomial x;
  Polynomial y;
  Polynomial w;
};

bool is_one(const Polynomial& w) {
  return w.degree() == 0 && w[0] == 1;
}

// Products with a denominator: denominators are 1 for linear motion, and then cost nothing.
Polynomial times(const Polynomial& a, const Polynomial& w) {
  return is_one(w) ? a : a * w;
}

Vector difference(const Trajectory_2& to, const Trajectory_2& from) {
  return {times(to.x, from.w) - times(from.x, to.w), times(to.y, from.w) - times(from.y, to.w),
          times(to.w, from.w)};
}

Polynomial cross(const Vector& a, const Vector& b) {
  return a.x * b.y - a.y * b.x;
}
Polynomial dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y;
}
Polynomial squared_length(const Vector& a) {
  return dot(a, a);
}

}  // namespace

template <class Point>
Polynomial x_difference(const Point& p, const Point& q) {
  const auto [a, b] = common_trajectories<2, typename Point::Motion>({&p, &q});
  const Vector v = difference(a, b);
  return times(v.x, v.w);
}

template <class Point>
Polynomial y_difference(const Point& p, const Point& q) {
  const auto [a, b] = common_trajectories<2, typename Point::Motion>({&p, &q});
  const Vector v = difference(a, b);
  return times(v.y, v.w);
}

template <class Point>
Polynomial orientation_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  const Vector u = difference(b, a);
  const Vector v = difference(c, a);
  return times(times(cross(u, v), u.w), v.w);
}

template <class Point>
Polynomial in_circle_polynomial(const Point& p, const Point& q, const Point& r, const Point& s) {
  const auto [a, b, c, d] = common_trajectories<4, typename Point::Motion>({&p, &q, &r, &s});
  const Vector u = difference(a, d);
  const Vector v = difference(b, d);
  const Vector w = difference(c, d);
  // With row i times w_i^2 (a positive factor) the columns are x w, y w and x^2 + y^2, so that each
  // cofactor carries the product of its two denominators.
  return squared_length(u) * times(times(cross(v, w), v.w), w.w) +
         squared_length(v) * times(times(cross(w, u), w.w), u.w) +
         squared_length(w) * times(times(cross(u, v), u.w), v.w);
}

template <class Point>
Polynomial distance_difference(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  // |q-p|^2 / (wq wp)^2 - |r-p|^2 / (wr wp)^2, times the positive (wp wq wr)^2.
  const Polynomial to_q = squared_length(difference(b, a));
  const Polynomial to_r = squared_length(difference(c, a));
  return times(times(to_q, c.w), c.w) - times(times(to_r, b.w), b.w);
}

template <class Point>
Polynomial scalar_product_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  const Vector u = difference(a, b);
  const Vector v = difference(c, b);
  return times(times(dot(u, v), u.w), v.w);
}

template <class Point>
Polynomial contact_polynomial(const Point& p, const Point& q, double diameter) {
  const Vector v = difference(p.trajectory(), q.trajectory());
  const Rational d = to_rational(diameter);
  const Integer numerator = boost::multiprecision::numerator(d);
  const Integer denominator = boost::multiprecision::denominator(d);
  return squared_length(v) * Integer(denominator * denominator) -
         v.w * v.w * Integer(numerator * numerator);
}

template <class Point>
Polynomial wall_polynomial(const Point& p, const Wall_2& wall) {
  const Trajectory_2 path = p.trajectory();
  const Rational clearance = to_rational(wall.clearance);
  const Rational bound = to_rational(wall.position) + (wall.is_upper() ? -clearance : clearance);
  const Integer numerator = boost::multiprecision::numerator(bound);
  const Integer denominator = boost::multiprecision::denominator(bound);
  const Polynomial inward =
      (wall.is_vertical() ? path.x : path.y) * denominator - path.w * numerator;
  return times(wall.is_upper() ? -inward : inward, path.w);
}

template <class Point>
Trajectory_2 circumcenter_trajectory(const Point& p, const Point& q, const Point& r) {
  const Trajectory_2 a = p.trajectory();
  const Vector u = difference(q.trajectory(), a);
  const Vector v = difference(r.trajectory(), a);
  // center - p = (v.y |u|^2 - u.y |v|^2, u.x |v|^2 - v.x |u|^2) / (2 cross(u, v)) with u and v
  // divided by their denominators; here everything is multiplied by (u.w v.w)^2.
  const Polynomial uu = times(squared_length(u), v.w);
  const Polynomial vv = times(squared_length(v), u.w);
  const Polynomial denominator = times(times(cross(u, v), u.w), v.w) * Integer(2);
  KINETRI_PRECONDITION(!denominator.is_zero(),
                       "three points that stay collinear have no circumcenter");
  return {times(a.x, denominator) + times(v.y * uu - u.y * vv, a.w),
          times(a.y, denominator) + times(u.x * vv - v.x * uu, a.w), times(a.w, denominator)};
}

#define KINETRI_INSTANTIATE(Point)                                                         \
  template Polynomial x_difference(const Point&, const Point&);                            \
  template Polynomial y_difference(const Point&, const Point&);                            \
  template Polynomial orientation_polynomial(const Point&, const Point&, const Point&);    \
  template Polynomial in_circle_polynomial(const Point&, const Point&, const Point&,       \
                                           const Point&);                                  \
  template Polynomial distance_difference(const Point&, const Point&, const Point&);       \
  template Polynomial scalar_product_polynomial(const Point&, const Point&, const Point&); \
  template Polynomial contact_polynomial(const Point&, const Point&, double);              \
  template Polynomial wall_polynomial(const Point&, const Wall_2&);                        \
  template Trajectory_2 circumcenter_trajectory(const Point&, const Point&, const Point&)
KINETRI_INSTANTIATE(Moving_point_2);
KINETRI_INSTANTIATE(Basic_moving_point_2<Polynomial_motion_2>);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
