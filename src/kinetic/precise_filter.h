// SPDX-License-Identifier: GPL-3.0-or-later
//
// The signs of certificates of linear motion at one time, in twice the precision of binary64: for
// rounding a failure time to the nearest binary64 number without making its polynomial. Zero says
// that the sign is not certain (docs/MATH.md, section 7).
#ifndef KINETRI_SRC_KINETIC_PRECISE_FILTER_H
#define KINETRI_SRC_KINETIC_PRECISE_FILTER_H

#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The sign of in_circle_polynomial, orientation_polynomial and contact_polynomial at the time
/// high + low, where |low| is at most half a unit in the last place of `high`.
Sign precise_in_circle(const Linear_motion_2& p, const Linear_motion_2& q, const Linear_motion_2& r,
                       const Linear_motion_2& s, double high, double low);
Sign precise_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, double high, double low);
Sign precise_contact(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                     double high, double low);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_PRECISE_FILTER_H
