// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of all certificates of polynomial motion: the functions of
// linear_filter.h and contact_filter.h, with the same contracts. Points that are all linear are
// left to those. Cost: about a thousand floating-point operations for in-circle (docs/MATH.md,
// section 9).
#ifndef KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_FILTER_H

#include "filter_result.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The function of this name for linear motion (linear_filter.h), for polynomial motion.
Filter_result filter_in_circle(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                               const Polynomial_motion_2& r, const Polynomial_motion_2& s,
                               const Double_interval& after, bool vanishes_at);
/// The function of this name for linear motion (linear_filter.h), for polynomial motion.
Filter_result filter_orientation(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                                 const Polynomial_motion_2& r, const Double_interval& after,
                                 bool vanishes_at);

/// @{
/// The sign of a polynomial of certificate_polynomials.h throughout the times in `interval`, where
/// it is certain; zero says that nothing is known.
Sign certain_x_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval);
Sign certain_y_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval);
Sign certain_orientation(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                         const Polynomial_motion_2& r, const Double_interval& interval);
Sign certain_in_circle(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                       const Polynomial_motion_2& r, const Polynomial_motion_2& s,
                       const Double_interval& interval);
Sign certain_scalar_product(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Polynomial_motion_2& r, const Double_interval& interval);
Sign certain_distance_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Polynomial_motion_2& r, const Double_interval& interval);
/// @}

/// Whether p and q are certainly not in one place at any time in `interval`. False says nothing.
bool certainly_apart(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval);

/// @{
/// As the functions of the same names for linear motion (contact_filter.h).
Filter_result filter_contact(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                             double diameter, const Double_interval& after);
Filter_result filter_wall_contact(const Polynomial_motion_2& p, const Wall_2& wall,
                                  const Double_interval& after);
/// @}

/// @{
/// As the functions of the same names for linear motion (contact_filter.h).
Sign certain_distance_slope(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Double_interval& interval);
Sign certain_gap(const Polynomial_motion_2& p, const Polynomial_motion_2& q, double diameter,
                 const Double_interval& interval);
/// @}

/// Whether p is certainly on the inner side of the wall throughout `interval`.
bool certainly_inside(const Polynomial_motion_2& p, const Wall_2& wall,
                      const Double_interval& interval);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_FILTER_H
