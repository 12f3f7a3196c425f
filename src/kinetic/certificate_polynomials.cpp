// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/certificate_polynomials.h"

#include <algorithm>
#include <vector>

#include "certificate_formulas.h"
#include "kinetri/base/check.h"

namespace kinetri {
namespace {

// A polynomial with dyadic coefficients: the numerator divided by the denominator.
struct Fraction {
  Polynomial numerator;
  Integer denominator;
};

Fraction fraction(const Rational& constant, const Rational& slope) {
  using boost::multiprecision::denominator;
  using boost::multiprecision::numerator;
  // Both are powers of two.
  const Integer common = std::max(denominator(constant), denominator(slope));
  return {Polynomial(std::vector<Integer>{numerator(constant) * (common / denominator(constant)),
                                          numerator(slope) * (common / denominator(slope))}),
          common};
}

// The radius of a point as constant + slope * t.
struct Radius {
  Rational constant = 0;
  Rational slope = 0;
};

template <class Point>
Radius radius(const Point& p) {
  if constexpr (HasWeight<typename Point::Motion>) {
    if (p.has_motion()) {
      const Rational growth = to_rational(p.motion().growth);
      return {to_rational(p.motion().radius) - growth * to_rational(p.motion().epoch), growth};
    }
  }
  return {};
}

}  // namespace

template <class Point>
Polynomial x_difference(const Point& p, const Point& q) {
  const auto [a, b] = common_trajectories<2, typename Point::Motion>({&p, &q});
  return x_difference_of(a, b);
}

template <class Point>
Polynomial y_difference(const Point& p, const Point& q) {
  const auto [a, b] = common_trajectories<2, typename Point::Motion>({&p, &q});
  return y_difference_of(a, b);
}

template <class Point>
Polynomial orientation_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return orientation_of(a, b, c);
}

template <class Point>
Polynomial in_circle_polynomial(const Point& p, const Point& q, const Point& r, const Point& s) {
  const auto [a, b, c, d] = common_trajectories<4, typename Point::Motion>({&p, &q, &r, &s});
  return in_circle_of(a, b, c, d);
}

template <class Point>
Polynomial distance_difference(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return distance_difference_of(a, b, c);
}

template <class Point>
Polynomial weight_difference(const Point& p, const Point& q) {
  const auto [a, b] = common_trajectories<2, typename Point::Motion>({&p, &q});
  return weight_difference_of(a, b);
}

template <class Point>
Polynomial power_distance_difference(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return power_distance_difference_of(a, b, c);
}

template <class Point>
Polynomial segment_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return segment_of(a, b, c);
}

template <class Point>
Polynomial scalar_product_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return scalar_product_of(a, b, c);
}

template <class Point>
Polynomial contact_polynomial(const Point& p, const Point& q, double diameter) {
  const Vector<Polynomial> v = difference(p.trajectory(), q.trajectory());
  const Radius of_p = radius(p);
  const Radius of_q = radius(q);
  const auto [reach, denominator] =
      fraction(to_rational(diameter) + of_p.constant + of_q.constant, of_p.slope + of_q.slope);
  return squared_length(v) * Integer(denominator * denominator) - v.w * v.w * (reach * reach);
}

template <class Point>
Polynomial distance_comparison_polynomial(const Point& p, const Point& q, const Point& r,
                                          const Point& s) {
  const Vector<Polynomial> v = difference(p.trajectory(), q.trajectory());
  const Vector<Polynomial> u = difference(r.trajectory(), s.trajectory());
  return squared_length(u) * (v.w * v.w) - squared_length(v) * (u.w * u.w);
}

template <class Point>
Polynomial wall_polynomial(const Point& p, const Wall_2& wall) {
  const Trajectory_2 path = p.trajectory();
  const Radius rim = wall.rim ? radius(p) : Radius();
  const Rational clearance = to_rational(wall.clearance) + rim.constant;
  const Rational position = to_rational(wall.position);
  const auto [bound, denominator] = wall.is_upper() ? fraction(position - clearance, -rim.slope)
                                                    : fraction(position + clearance, rim.slope);
  const Polynomial inward = (wall.is_vertical() ? path.x : path.y) * denominator - path.w * bound;
  return times(wall.is_upper() ? -inward : inward, path.w);
}

namespace {

// The center of the circle through the point a, a + u and a + v, of which the squared distances
// from a, or their powers, are given, times the squares of the denominators.
Trajectory_2 circle_center(const Trajectory_2& a, const Vector<Polynomial>& u,
                           const Vector<Polynomial>& v, const Polynomial& square_of_u,
                           const Polynomial& square_of_v) {
  // center - a = (v.y |u|^2 - u.y |v|^2, u.x |v|^2 - v.x |u|^2) / (2 cross(u, v)) with u and v
  // divided by their denominators; here everything is multiplied by (u.w v.w)^2.
  const Polynomial uu = times(square_of_u, v.w);
  const Polynomial vv = times(square_of_v, u.w);
  const Polynomial denominator = times(times(cross(u, v), u.w), v.w) * Integer(2);
  KINETRI_PRECONDITION(!denominator.is_zero(),
                       "three points that stay collinear have no circumcenter");
  return {times(a.x, denominator) + times(v.y * uu - u.y * vv, a.w),
          times(a.y, denominator) + times(u.x * vv - v.x * uu, a.w), times(a.w, denominator)};
}

}  // namespace

template <class Point>
Trajectory_2 circumcenter_trajectory(const Point& p, const Point& q, const Point& r) {
  const Trajectory_2 a = p.trajectory();
  const Vector<Polynomial> u = difference(q.trajectory(), a);
  const Vector<Polynomial> v = difference(r.trajectory(), a);
  return circle_center(a, u, v, squared_length(u), squared_length(v));
}

template <class Point>
Trajectory_2 weighted_circumcenter_trajectory(const Point& p, const Point& q, const Point& r) {
  const Trajectory_2 a = p.trajectory();
  const Vector<Polynomial> u = difference(q.trajectory(), a);
  const Vector<Polynomial> v = difference(r.trajectory(), a);
  return circle_center(a, u, v, lift(u), lift(v));
}

#define KINETRI_INSTANTIATE(Point)                                                             \
  template Polynomial x_difference(const Point&, const Point&);                                \
  template Polynomial y_difference(const Point&, const Point&);                                \
  template Polynomial orientation_polynomial(const Point&, const Point&, const Point&);        \
  template Polynomial in_circle_polynomial(const Point&, const Point&, const Point&,           \
                                           const Point&);                                      \
  template Polynomial distance_difference(const Point&, const Point&, const Point&);           \
  template Polynomial scalar_product_polynomial(const Point&, const Point&, const Point&);     \
  template Polynomial contact_polynomial(const Point&, const Point&, double);                  \
  template Polynomial distance_comparison_polynomial(const Point&, const Point&, const Point&, \
                                                     const Point&);                            \
  template Polynomial wall_polynomial(const Point&, const Wall_2&);                            \
  template Polynomial weight_difference(const Point&, const Point&);                           \
  template Polynomial power_distance_difference(const Point&, const Point&, const Point&);     \
  template Polynomial segment_polynomial(const Point&, const Point&, const Point&);            \
  template Trajectory_2 circumcenter_trajectory(const Point&, const Point&, const Point&);     \
  template Trajectory_2 weighted_circumcenter_trajectory(const Point&, const Point&, const Point&)
KINETRI_INSTANTIATE(Moving_point_2);
KINETRI_INSTANTIATE(Basic_moving_point_2<Polynomial_motion_2>);
KINETRI_INSTANTIATE(Basic_moving_point_2<Disc_motion_2>);
KINETRI_INSTANTIATE(Basic_moving_point_2<Polynomial_disc_motion_2>);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
