// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances of two points in linear motion, rounded without exact arithmetic; none if the rounding
// is not certain (docs/MATH.md, section 8). Cost: some hundred floating-point operations.
#ifndef KINETRI_SRC_KINETIC_FILTER_LEAST_DISTANCE_H
#define KINETRI_SRC_KINETIC_FILTER_LEAST_DISTANCE_H

#include <optional>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The time of the least distance, strictly between the bounds.
std::optional<Rounding> rounded_time_of_least_distance(const Linear_motion_2& p,
                                                       const Linear_motion_2& q);
/// The binary64 number nearest to the distance at that time.
std::optional<double> rounded_least_distance(const Linear_motion_2& p, const Linear_motion_2& q);
/// The binary64 number nearest to the distance at `time`.
std::optional<double> rounded_distance_at(const Linear_motion_2& p, const Linear_motion_2& q,
                                          double time);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_LEAST_DISTANCE_H
