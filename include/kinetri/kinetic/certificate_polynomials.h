// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric predicates of moving points as polynomials in time: the sign of the polynomial at t
// is the value of the predicate at t. The certificates, whose failure times are roots of these
// polynomials, and the predicates at an instant share these formulas.
//
// With motions of degree d (linear: 1, polynomial: at most 3) the degrees are: x or y difference d,
// orientation 2d, distance difference 2d, in-circle 4d. For constructed points they are higher:
// denominators are multiplied in such that the sign stays right; if one vanishes, the sign is 0.
// Cost: tens of products of small polynomials with exact integer coefficients.
//
// `Point` is Basic_moving_point_2 of one of the motions.
#ifndef KINETRI_KINETIC_CERTIFICATE_POLYNOMIALS_H
#define KINETRI_KINETIC_CERTIFICATE_POLYNOMIALS_H

#include "kinetri/algebra/polynomial.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// Sign of x(p) - x(q).
template <class Point>
Polynomial x_difference(const Point& p, const Point& q);

/// Sign of y(p) - y(q).
template <class Point>
Polynomial y_difference(const Point& p, const Point& q);

/// Positive if p, q, r make a left turn; zero if they are collinear.
///
///     | qx-px  qy-py |
///     | rx-px  ry-py |
template <class Point>
Polynomial orientation_polynomial(const Point& p, const Point& q, const Point& r);

/// Positive if s lies inside the circle through p, q, r and these make a left turn, negative
/// if it lies outside; both reversed if they make a right turn. Zero if the four are
/// cocircular or all collinear. With the differences d = (point - s):
///
///     | dpx  dpy  dpx^2 + dpy^2 - dpw |
///     | dqx  dqy  dqx^2 + dqy^2 - dqw |
///     | drx  dry  drx^2 + dry^2 - drw |
///
/// dpw is the weight of p minus that of s, which is zero for points without weights. For weighted
/// points the circle is the power circle of p, q, r, which is orthogonal to the three, and s lies
/// inside if its power product with that circle is negative: the sign of CGAL's
/// power_side_of_oriented_power_circle_2.
///
/// Source: L. Guibas, J. Stolfi, Primitives for the manipulation of general subdivisions and the
/// computation of Voronoi diagrams, ACM Transactions on Graphics 4(2), 1985, section 8.
template <class Point>
Polynomial in_circle_polynomial(const Point& p, const Point& q, const Point& r, const Point& s);

/// The polynomial that decides whether s is inside the circle, with the sign of
/// in_circle_polynomial: that one, unless it vanishes at all times, as it does while the four stay
/// cocircular. Then points are lifted a little more, by infinitely small numbers e1 times x y, e2
/// times x^2 and e3 times y^2, where e1 is far greater than e2 and e2 than e3: the lifted column is
/// dx dy or, if the determinant vanishes again, dx^2 or dy^2. It is zero only if all four points
/// are collinear at all times, or two of them are the same. docs/MATH.md, section 4.
template <class Point>
Polynomial perturbed_in_circle_polynomial(const Point& p, const Point& q, const Point& r,
                                          const Point& s);

/// Sign of |p-q|^2 - |p-r|^2: positive if q is farther from p than r is.
template <class Point>
Polynomial distance_difference(const Point& p, const Point& q, const Point& r);

/// Sign of the weight of p minus that of q.
template <class Point>
Polynomial weight_difference(const Point& p, const Point& q);

/// Sign of the power of p to q minus the power of p to r, that is of (|p-q|^2 - weight of q) -
/// (|p-r|^2 - weight of r). The weight of p is not used.
template <class Point>
Polynomial power_distance_difference(const Point& p, const Point& q, const Point& r);

/// Positive if q, lifted by x^2 + y^2 - weight, is below the lifted line through p and r; so p and
/// r hide a point q between them if it is negative. The sign of CGAL's
/// power_side_of_oriented_power_circle_2(p, r, q). Precondition: p, q, r are collinear, and p and r
/// are apart. Degree 4d.
template <class Point>
Polynomial segment_polynomial(const Point& p, const Point& q, const Point& r);

/// The same, lifted a little more if segment_polynomial vanishes at all times, as in
/// perturbed_in_circle_polynomial. Of three different points on a line it is not zero.
template <class Point>
Polynomial perturbed_segment_polynomial(const Point& p, const Point& q, const Point& r);

/// The scalar product of p - q and r - q. If p, q, r are collinear, it is negative if and only if q
/// lies strictly between p and r.
template <class Point>
Polynomial scalar_product_polynomial(const Point& p, const Point& q, const Point& r);

/// Sign of |p-q|^2 - (diameter + radius of p + radius of q)^2: positive if the two are apart: for
/// points without radii, the discs of that diameter about them; for discs p and q, their boundaries
/// by more than `diameter`. Degree 2d. Precondition: the diameter is finite, and the sum in
/// brackets is not negative.
template <class Point>
Polynomial contact_polynomial(const Point& p, const Point& q, double diameter);

/// Sign of |r-s|^2 - |p-q|^2: positive if r and s are farther apart than p and q; radii and
/// weights do not count. Degree 2d.
template <class Point>
Polynomial distance_comparison_polynomial(const Point& p, const Point& q, const Point& r,
                                          const Point& s);

/// Sign of the distance from p (or, if `wall.rim_touches`, from the boundary circle of the disc p)
/// to the exact bound of the wall: positive inside, zero at the bound. Precondition: the numbers of
/// the wall are finite.
template <class Point>
Polynomial wall_polynomial(const Point& p, const Wall_2& wall);

/// The trajectory of the center of the circle through p, q, r; weights do not count. Precondition:
/// p, q, r are not collinear at all times.
template <class Point>
Trajectory_2 circumcenter_trajectory(const Point& p, const Point& q, const Point& r);

/// The trajectory of the position that has the same power to p, q and r; it has the weight zero.
/// Precondition: p, q, r are not collinear at all times.
template <class Point>
Trajectory_2 weighted_circumcenter_trajectory(const Point& p, const Point& q, const Point& r);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_CERTIFICATE_POLYNOMIALS_H
