// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of the contact certificates of linear motion: that two discs do not
// touch, and that a point does not reach a wall. It says what is certain, or that it does not know
// (docs/MATH.md, section 8).
#ifndef KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_H

#include "kinetri/kinetic/wall_2.h"
#include "linear_filter.h"

namespace kinetri {

/// Whether and when p and q, after a time in `after`, come as near as `diameter` while they
/// approach: a result in the form of filter_in_circle's. The end of `after` itself is never in the
/// bounds of a failure. Cost: some fifty floating-point operations, and as many again for a
/// bracket. Precondition: the diameter is finite and not negative.
Filter_result filter_contact(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                             const Double_interval& after);

/// Whether and when p reaches the wall while it moves outward. Cost: ten operations.
Filter_result filter_wall_contact(const Linear_motion_2& p, const Wall_2& wall,
                                  const Double_interval& after);

/// The sign of the derivative of the squared distance of p and q throughout `interval`, where it is
/// certain; zero says that nothing is known.
Sign certain_distance_slope(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Double_interval& interval);

/// The sign of the squared distance of p and q minus the square of `diameter` throughout
/// `interval`, where it is certain; zero says that nothing is known.
Sign certain_gap(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                 const Double_interval& interval);

/// Whether p is certainly on the inner side of the wall throughout `interval`.
bool certainly_inside(const Linear_motion_2& p, const Wall_2& wall,
                      const Double_interval& interval);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_H
