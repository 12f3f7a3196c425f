// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of the certificates of linear motion: says when a certificate certainly
// holds, or brackets its first failure, or says that it does not know. It never guesses: every
// statement is covered by an error bound (docs/MATH.md, section 7).
#ifndef KINETRI_SRC_KINETIC_FILTER_LINEAR_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_LINEAR_FILTER_H

#include <array>

#include "filter_result.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/flip_neighborhood.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The in-circle certificate (s is not inside the circle through p, q, r) after a time in `after`:
/// the result is about the times after `after.upper`, or after the time itself where the
/// certificate `vanishes_at` it. In that case the root there, simple and with the certificate
/// positive just after it, is the caller's word (as it is after a flip), and is divided out. Cost:
/// some hundred floating-point operations, and as many again where a failure is bracketed. `p`,
/// `q`, `r`, `s` in any order that has the same sign.
Filter_result filter_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                               const Linear_motion_2& r, const Linear_motion_2& s,
                               const Double_interval& after, bool vanishes_at);

/// The same for the orientation certificate (p, q, r make a left turn).
Filter_result filter_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                                 const Linear_motion_2& r, const Double_interval& after,
                                 bool vanishes_at);

/// Two in-circle certificates, each as filter_in_circle does it where nothing is known of its value
/// at the time, at less cost than two calls; but both results may be unknown where that
/// of one alone is.
std::array<Filter_result, 2> filter_in_circles(
    const std::array<Quadruple<Linear_motion_2>, 2>& certificates, const Double_interval& after);

/// The five certificates after a flip at a time in `after`, at which that of the edge itself, the
/// last one, vanishes. As five calls of filter_in_circle, at less than half of their cost; but
/// where the points are of very different sizes more of the results are unknown.
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Linear_motion_2>& around,
                                               const Double_interval& after);

/// @{
/// The sign of a polynomial of certificate_polynomials.h (x_difference, y_difference,
/// orientation_polynomial, in_circle_polynomial, scalar_product_polynomial, distance_difference)
/// throughout the times in `interval`, where it is certain; zero says that nothing is known.
Sign certain_x_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval);
Sign certain_y_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval);
Sign certain_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Double_interval& interval);
Sign certain_in_circle(const Linear_motion_2& p, const Linear_motion_2& q, const Linear_motion_2& r,
                       const Linear_motion_2& s, const Double_interval& interval);
Sign certain_scalar_product(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Linear_motion_2& r, const Double_interval& interval);
Sign certain_distance_order(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Linear_motion_2& r, const Double_interval& interval);
/// @}

/// Whether p and q are certainly not in one place at any time in `interval`. False says nothing.
/// (What is asked is whether they ever are.)
bool certainly_apart(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_LINEAR_FILTER_H
