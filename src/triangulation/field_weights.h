// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights of points for interpolation at a position, in binary64 arithmetic, with a fixed order
// of operations. All weights are at least zero, and their sum is 1 up to rounding.
#ifndef KINETRI_TRIANGULATION_FIELD_WEIGHTS_H
#define KINETRI_TRIANGULATION_FIELD_WEIGHTS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "kinetic/rounded_places.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// As barycentric_weights, also if coordinates are extreme or rounded corners leave no area.
std::array<double, 3> barycentric_weights_of_any(const std::array<Vector_2, 3>& corners,
                                                 const Vector_2& place);

/// Barycentric coordinates of a position in a triangle, whose corners come counterclockwise. If the
/// rounded corners leave no area on any side of it, those of the nearest position on its longest
/// side.
KINETRI_ALWAYS_INLINE std::array<double, 3> barycentric_weights(
    const std::array<Vector_2, 3>& corners, const Vector_2& place) {
  std::array<Vector_2, 3> from;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = difference(corners[i], place);
    size = std::max(size, size_of(from[i]));
  }
  // Else a product may be too large or too small.
  if (!(size > 0x1p-300 && size < 0x1p300)) return barycentric_weights_of_any(corners, place);
  const double a = std::max(cross(from[1], from[2]), 0.0);
  const double b = std::max(cross(from[2], from[0]), 0.0);
  const double c = std::max(cross(from[0], from[1]), 0.0);
  const double sum = a + b + c;
  if (!(sum > 0)) return barycentric_weights_of_any(corners, place);
  return {a / sum, b / sum, c / sum};
}

/// Laplace coordinates of a position with respect to its natural neighbors, in counterclockwise
/// order. If the rounded neighbors leave no area between the position and a side of their polygon,
/// linear coordinates on that side. Preconditions: there are at least two neighbors and as many
/// weights; the position is not a neighbor; successive neighbors differ.
void laplace_weights(std::span<const Vector_2> neighbors, const Vector_2& place,
                     std::span<double> weights);

/// The weighted mean, clamped to the range of the values. Precondition: as many values as weights,
/// at least one.
inline double weighted_mean(std::span<const double> values, std::span<const double> weights) {
  double sum = 0;
  double least = values[0];
  double greatest = values[0];
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * values[i];
    least = std::min(least, values[i]);
    greatest = std::max(greatest, values[i]);
  }
  return std::clamp(sum, least, greatest);
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_FIELD_WEIGHTS_H
