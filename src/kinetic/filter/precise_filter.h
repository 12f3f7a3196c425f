// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of certificates at one time in twice the precision of binary64, to round a failure time to
// nearest without its polynomial. The sign is exact; zero means "unknown" (docs/MATH.md, sections 7
// and 9). `Motion` is Linear_motion_2, Polynomial_motion_2 or, except for orientations, a disc with
// such a center.
#ifndef KINETRI_SRC_KINETIC_FILTER_PRECISE_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_PRECISE_FILTER_H

#include <optional>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

/// The value of a positive multiple of in_circle_polynomial, orientation_polynomial,
/// contact_polynomial and distance_comparison_polynomial at the time high + low, where |low| is at
/// most half a unit in the last place of `high`. The last one takes centers of discs.
template <class Motion>
double precise_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                         double high, double low);
template <class Motion>
double precise_orientation(const Motion& p, const Motion& q, const Motion& r, double high,
                           double low);
template <class Motion>
double precise_contact(const Motion& p, const Motion& q, double diameter, double high, double low);
template <class Motion>
double precise_distance_comparison(const Motion& p, const Motion& q, const Motion& r,
                                   const Motion& s, double high, double low);

/// @{ The only root of contact_polynomial, in_circle_polynomial or distance_comparison_polynomial
/// in `bracket`, rounded; none if the rounding is not certain. Cost: about that of one value.
/// For contacts `Motion` is Linear_motion_2 or Disc_motion_2, for in-circle Linear_motion_2 or
/// Image_motion_2.
template <class Motion>
std::optional<Rounding> rounded_contact(const Motion& p, const Motion& q, double diameter,
                                        const Double_interval& bracket);
template <class Motion>
std::optional<Rounding> rounded_in_circle(const Motion& p, const Motion& q, const Motion& r,
                                          const Motion& s, const Double_interval& bracket);
std::optional<Rounding> rounded_distance_comparison(const Linear_motion_2& p,
                                                    const Linear_motion_2& q,
                                                    const Linear_motion_2& r,
                                                    const Linear_motion_2& s,
                                                    const Double_interval& bracket);
/// @}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_PRECISE_FILTER_H
