// SPDX-License-Identifier: GPL-3.0-or-later
//
// The values of certificates of linear motion at one time, in twice the precision of binary64: for
// rounding a failure time to the nearest binary64 number without making its polynomial. The sign is
// right; zero says that it is not certain (docs/MATH.md, section 7).
#ifndef KINETRI_SRC_KINETIC_PRECISE_FILTER_H
#define KINETRI_SRC_KINETIC_PRECISE_FILTER_H

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The value of a positive multiple of in_circle_polynomial, orientation_polynomial and
/// contact_polynomial at the time
/// high + low, where |low| is at most half a unit in the last place of `high`.
double precise_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Linear_motion_2& s, double high,
                         double low);
double precise_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                           const Linear_motion_2& r, double high, double low);
double precise_contact(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                       double high, double low);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_PRECISE_FILTER_H
