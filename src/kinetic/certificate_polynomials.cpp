// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/certificate_polynomials.h"

#include "certificate_formulas.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "length.h"
#include "scaled_coordinates.h"

namespace kinetri {
namespace {

// The motion of a point; for a constructed point, one without a radius.
template <class Point>
typename Point::Motion motion_or_none(const Point& p) {
  return p.has_motion() ? p.motion() : typename Point::Motion();
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
  return in_circle_of(Lifting::paraboloid, a, b, c, d);
}

template <class Point>
Polynomial perturbed_in_circle_polynomial(const Point& p, const Point& q, const Point& r,
                                          const Point& s) {
  const auto [a, b, c, d] = common_trajectories<4, typename Point::Motion>({&p, &q, &r, &s});
  return perturbed([](const auto&... all) { return in_circle_of(all...); })(a, b, c, d);
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
  return segment_of(Lifting::paraboloid, a, b, c);
}

template <class Point>
Polynomial perturbed_segment_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return perturbed([](const auto&... all) { return segment_of(all...); })(a, b, c);
}

template <class Point>
Polynomial scalar_product_polynomial(const Point& p, const Point& q, const Point& r) {
  const auto [a, b, c] = common_trajectories<3, typename Point::Motion>({&p, &q, &r});
  return scalar_product_of(a, b, c);
}

template <class Point>
Polynomial contact_polynomial(const Point& p, const Point& q, double diameter) {
  const Length reach = touching_distance(motion_or_none(p), motion_or_none(q), diameter);
  return contact_of(p.trajectory(), q.trajectory(), scaled_alone(reach));
}

template <class Point>
Polynomial distance_comparison_polynomial(const Point& p, const Point& q, const Point& r,
                                          const Point& s) {
  const auto [a, b, c, d] = common_trajectories<4, typename Point::Motion>({&p, &q, &r, &s});
  return distance_comparison_of(a, b, c, d);
}

template <class Point>
Polynomial wall_polynomial(const Point& p, const Wall_2& wall) {
  return wall_of(wall, p.trajectory(), scaled_alone(bound_of(wall, motion_or_none(p))));
}

namespace {

// The center of the circle through a, a + u and a + v. The squared distances of u and v from a, or
// their powers, are given, times the squares of the denominators.
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
  return circle_center(a, u, v, lift(u, Lifting::paraboloid), lift(v, Lifting::paraboloid));
}

#define KINETRI_INSTANTIATE(Point)                                                             \
  template Polynomial x_difference(const Point&, const Point&);                                \
  template Polynomial y_difference(const Point&, const Point&);                                \
  template Polynomial orientation_polynomial(const Point&, const Point&, const Point&);        \
  template Polynomial in_circle_polynomial(const Point&, const Point&, const Point&,           \
                                           const Point&);                                      \
  template Polynomial perturbed_in_circle_polynomial(const Point&, const Point&, const Point&, \
                                                     const Point&);                            \
  template Polynomial distance_difference(const Point&, const Point&, const Point&);           \
  template Polynomial scalar_product_polynomial(const Point&, const Point&, const Point&);     \
  template Polynomial contact_polynomial(const Point&, const Point&, double);                  \
  template Polynomial distance_comparison_polynomial(const Point&, const Point&, const Point&, \
                                                     const Point&);                            \
  template Polynomial wall_polynomial(const Point&, const Wall_2&);                            \
  template Polynomial weight_difference(const Point&, const Point&);                           \
  template Polynomial power_distance_difference(const Point&, const Point&, const Point&);     \
  template Polynomial segment_polynomial(const Point&, const Point&, const Point&);            \
  template Polynomial perturbed_segment_polynomial(const Point&, const Point&, const Point&);  \
  template Trajectory_2 circumcenter_trajectory(const Point&, const Point&, const Point&);     \
  template Trajectory_2 weighted_circumcenter_trajectory(const Point&, const Point&, const Point&)
KINETRI_INSTANTIATE(Moving_point_2);
KINETRI_INSTANTIATE(Moving_image_2);
KINETRI_INSTANTIATE(Moving_image_disc_2);
KINETRI_INSTANTIATE(Basic_moving_point_2<Polynomial_motion_2>);
KINETRI_INSTANTIATE(Basic_moving_point_2<Disc_motion_2>);
KINETRI_INSTANTIATE(Basic_moving_point_2<Polynomial_disc_motion_2>);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
