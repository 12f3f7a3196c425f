// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of all certificates and predicates: returns what an error bound proves,
// or "unknown". `Motion` is Linear_motion_2 (docs/MATH.md, sections 7 and 8) or Polynomial_motion_2
// (section 9); if all polynomial motions are linear, the filter of linear motion decides. If
// weights or radii matter, it may also be Disc_motion_2 or Polynomial_disc_motion_2; disc_filter.h
// has the questions about centers alone. It may be Image_motion_2 (section 18), but not with walls;
// or, if weights matter, Image_disc_motion_2, but not in contacts, walls and distances of two
// pairs.
#ifndef KINETRI_SRC_KINETIC_FILTER_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_FILTER_H

#include <array>
#include <cstddef>
#include <span>

#include "filter_result.h"
#include "kinetri/impl/algebra/sign.h"
#include "kinetri/impl/kinetic/flip_neighborhood.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The in-circle certificate (s is not inside the circle through p, q, r) after a time in `after`:
/// the result concerns the times after `after.upper`; if `vanishes_at`, those after the time
/// itself. In that case the caller asserts that the certificate has a simple root at the time and
/// is positive just after it, as after a flip; this root is divided out. Cost: some hundred
/// floating-point operations for linear motion and about a thousand for polynomial, and as many
/// again to bracket a failure. `p`, `q`, `r`, `s` may be in any order with the same sign.
template <class Motion>
Filter_result filter_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                               const Double_interval& after, bool vanishes_at);

/// The same for the orientation certificate (p, q, r make a left turn).
template <class Motion>
Filter_result filter_orientation(const Motion& p, const Motion& q, const Motion& r,
                                 const Double_interval& after, bool vanishes_at);

/// Two in-circle certificates, as two calls of filter_in_circle without `vanishes_at`, at less
/// cost; but if one result is unknown, both may be.
template <class Motion>
std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<Motion>, 2>& certificates,
                                               const Double_interval& after);

/// The five certificates after a flip at a time in `after`; the last one, of the new edge, is zero
/// at that time. As five calls of filter_in_circle, at less than half their cost; but if distances
/// differ much in size, more results are unknown.
template <class Motion>
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Motion>& around,
                                               const Double_interval& after);

/// @{ The sign of a polynomial of certificate_polynomials.h (x_difference, y_difference,
/// orientation_polynomial, in_circle_polynomial, scalar_product_polynomial, distance_difference)
/// throughout `interval`, if it is certain; zero if it is unknown.
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

/// Whether p and each two cyclically successive points of `around` certainly make a left turn
/// throughout `interval`. False proves nothing. Precondition: around.size() <= most_around.
/// `Motion` is Linear_motion_2 or Image_motion_2.
template <class Motion>
bool certainly_surrounded(const Motion& p, std::span<const Motion* const> around,
                          const Double_interval& interval);

/// Whether p and q certainly coincide at no time in `interval`. False proves nothing.
template <class Motion>
bool certainly_apart(const Motion& p, const Motion& q, const Double_interval& interval);

/// Whether and when, after a time in `after`, the distance of p and q, for discs the gap, is
/// `diameter` or less and decreases: a result as that of filter_in_circle. The bounds of a failure
/// never contain after.upper. Cost for linear motion: some fifty floating-point operations, and as
/// many again for a bracket. Precondition: the diameter is finite and not negative.
template <class Motion>
Filter_result filter_contact(const Motion& p, const Motion& q, double diameter,
                             const Double_interval& after);

/// Whether and when p reaches the wall while it moves outward. Cost for linear motion: ten
/// operations.
template <class Motion>
Filter_result filter_wall_contact(const Motion& p, const Wall_2& wall,
                                  const Double_interval& after);

/// @{ The certificates of distances of ContactKineticTraits_2 after a time in `after`: a result as
/// that of filter_in_circle, with `vanishes_at` as there. Touches count: if `filter_apart` returns
/// that the certificate never fails, or holds for some time, the two are certainly farther apart
/// than `range` from the time on; if `vanishes_at`, after the time. Cost for linear motion: some
/// fifty floating-point operations, and as many again for a bracket; the result is never `holds`.
/// Precondition: the range is finite and not negative.
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

/// The sign of distance_comparison_polynomial throughout `interval`, if it is certain; zero if it
/// is unknown.
template <class Motion>
Sign certain_distance_comparison(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                                 const Double_interval& interval);

/// The same for the derivative of contact_polynomial with the diameter 0.
template <class Motion>
Sign certain_distance_slope(const Motion& p, const Motion& q, const Double_interval& interval);

/// The same for contact_polynomial.
template <class Motion>
Sign certain_gap(const Motion& p, const Motion& q, double diameter,
                 const Double_interval& interval);

/// Whether p is certainly inside of the wall throughout `interval`.
template <class Motion>
bool certainly_inside(const Motion& p, const Wall_2& wall, const Double_interval& interval);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_FILTER_H
