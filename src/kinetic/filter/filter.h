// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of all certificates and predicates: says what is certain, or that it
// does not know. It never guesses: every statement is covered by an error bound. `Motion` is
// Linear_motion_2 (docs/MATH.md, sections 7 and 8) or Polynomial_motion_2 (section 9); points of
// polynomial motion that are all linear are left to the filter of linear motion. Where weights or
// radii matter it may also be Disc_motion_2 or Polynomial_disc_motion_2; what is about centres
// alone is in disc_filter.h.
#ifndef KINETRI_SRC_KINETIC_FILTER_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_FILTER_H

#include <array>
#include <cstddef>
#include <span>

#include "filter_result.h"
#include "kinetri/algebra/sign.h"
#include "kinetri/impl/kinetic/flip_neighborhood.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The in-circle certificate (s is not inside the circle through p, q, r) after a time in `after`:
/// the result is about the times after `after.upper`, or after the time itself where the
/// certificate `vanishes_at` it. In that case the root there, simple and with the certificate
/// positive just after it, is the caller's word (as it is after a flip), and is divided out. Cost:
/// some hundred floating-point operations for linear motion and about a thousand for polynomial,
/// and as many again where a failure is bracketed. `p`, `q`, `r`, `s` in any order that has the
/// same sign.
template <class Motion>
Filter_result filter_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                               const Double_interval& after, bool vanishes_at);

/// The same for the orientation certificate (p, q, r make a left turn).
template <class Motion>
Filter_result filter_orientation(const Motion& p, const Motion& q, const Motion& r,
                                 const Double_interval& after, bool vanishes_at);

/// Two in-circle certificates, each as filter_in_circle does it where nothing is known of its value
/// at the time, at less cost than two calls; but both results may be unknown where that
/// of one alone is.
template <class Motion>
std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<Motion>, 2>& certificates,
                                               const Double_interval& after);

/// The five certificates after a flip at a time in `after`, at which that of the edge itself, the
/// last one, vanishes. As five calls of filter_in_circle, at less than half of their cost; but
/// where the points are of very different sizes more of the results are unknown.
template <class Motion>
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Motion>& around,
                                               const Double_interval& after);

/// @{
/// The sign of a polynomial of certificate_polynomials.h (x_difference, y_difference,
/// orientation_polynomial, in_circle_polynomial, scalar_product_polynomial, distance_difference)
/// throughout the times in `interval`, where it is certain; zero says that nothing is known.
template <class Motion>
Sign certain_x_order(const Motion& p, const Motion& q, const Double_interval& interval);
template <class Motion>
Sign certain_y_order(const Motion& p, const Motion& q, const Double_interval& interval);
template <class Motion>
Sign certain_orientation(const Motion& p, const Motion& q, const Motion& r,
                         const Double_interval& interval);
template <class Motion>
Sign certain_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                       const Double_interval& interval);
template <class Motion>
Sign certain_scalar_product(const Motion& p, const Motion& q, const Motion& r,
                            const Double_interval& interval);
template <class Motion>
Sign certain_distance_order(const Motion& p, const Motion& q, const Motion& r,
                            const Double_interval& interval);
/// @}

/// @{
/// The same for power_distance_difference and weight_difference of discs.
template <class Disc>
Sign certain_power_distance_order(const Disc& p, const Disc& q, const Disc& r,
                                  const Double_interval& interval);
template <class Disc>
Sign certain_weight_order(const Disc& p, const Disc& q, const Double_interval& interval);
/// @}

/// The most points that certainly_surrounded takes.
inline constexpr std::size_t most_around = 16;

/// Whether p and each two successive points of `around`, the last and the first included, certainly
/// make a left turn throughout `interval`. False says nothing. Precondition: there are at most
/// `most_around`.
bool certainly_surrounded(const Linear_motion_2& p, std::span<const Linear_motion_2* const> around,
                          const Double_interval& interval);

/// Whether p and q are certainly not in one place at any time in `interval`. False says nothing.
template <class Motion>
bool certainly_apart(const Motion& p, const Motion& q, const Double_interval& interval);

/// Whether and when p and q, after a time in `after`, come as near as `diameter` (discs: and their
/// radii) while they approach: a result in the form of filter_in_circle's. The end of `after`
/// itself is never in the bounds of a failure. Cost for linear motion: some fifty floating-point
/// operations, and as many again for a bracket. Precondition: the diameter is finite and not
/// negative.
template <class Motion>
Filter_result filter_contact(const Motion& p, const Motion& q, double diameter,
                             const Double_interval& after);

/// Whether and when p reaches the wall while it moves outward. Cost for linear motion: ten
/// operations.
template <class Motion>
Filter_result filter_wall_contact(const Motion& p, const Wall_2& wall,
                                  const Double_interval& after);

/// @{
/// The certificates of distances of ContactKineticTraits_2 after a time in `after`: a result in the
/// form of filter_in_circle's, with `vanishes_at` as there. Touches count: where `filter_apart`
/// says that it never fails, or does not fail yet, the two are certainly farther apart than `range`
/// at the time and all the while; if it `vanishes_at` the time, then after it. Cost for linear
/// motion: some fifty floating-point operations, and as many again for a bracket; and nothing is
/// left for later. Precondition: the range is finite and not negative.
template <class Motion>
Filter_result filter_apart(const Motion& p, const Motion& q, double range,
                           const Double_interval& after, bool vanishes_at);
template <class Motion>
Filter_result filter_near(const Motion& p, const Motion& q, double range,
                          const Double_interval& after, bool vanishes_at);
template <class Motion>
Filter_result filter_closer(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                            const Double_interval& after, bool vanishes_at);
/// @}

/// The sign of distance_comparison_polynomial throughout `interval`, where it is certain; zero says
/// that nothing is known.
template <class Motion>
Sign certain_distance_comparison(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                                 const Double_interval& interval);

/// The sign of the derivative of contact_polynomial of p and q with the diameter 0 throughout
/// `interval`, where it is certain; zero says that nothing is known.
template <class Motion>
Sign certain_distance_slope(const Motion& p, const Motion& q, const Double_interval& interval);

/// The sign of contact_polynomial throughout `interval`, where it is certain; zero says that
/// nothing is known.
template <class Motion>
Sign certain_gap(const Motion& p, const Motion& q, double diameter,
                 const Double_interval& interval);

/// Whether p is certainly on the inner side of the wall throughout `interval`.
template <class Motion>
bool certainly_inside(const Motion& p, const Wall_2& wall, const Double_interval& interval);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_FILTER_H
