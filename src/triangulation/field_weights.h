// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights with which values at points make the values at a position, in binary64 arithmetic:
// additions, multiplications, divisions and powers of two, in a fixed order. All weights are at
// least zero, and their sum is 1 up to rounding.
#ifndef KINETRI_TRIANGULATION_FIELD_WEIGHTS_H
#define KINETRI_TRIANGULATION_FIELD_WEIGHTS_H

#include <array>
#include <span>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// Barycentric coordinates of a position in a triangle, whose corners come counterclockwise. If the
/// rounded corners leave no area on any side of it, those of the nearest position on its longest
/// side.
std::array<double, 3> barycentric_weights(const std::array<Vector_2, 3>& corners,
                                          const Vector_2& place);

/// Laplace coordinates of a position, which is none of the neighbors, with regard to its natural
/// neighbors, which come counterclockwise; no two successive ones are equal. If the rounded
/// neighbors leave no area between the position and a side of their polygon, linear coordinates on
/// that side. As many weights as neighbors. Precondition: there are at least two.
void laplace_weights(std::span<const Vector_2> neighbors, const Vector_2& place,
                     std::span<double> weights);

/// The mean with the weights, moved between the least and the greatest of the values.
/// Precondition: as many values as weights, at least one.
double weighted_mean(std::span<const double> values, std::span<const double> weights);

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_FIELD_WEIGHTS_H
