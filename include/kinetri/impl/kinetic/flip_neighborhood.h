// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of the certificates that a flip makes.
#ifndef KINETRI_IMPL_KINETIC_FLIP_NEIGHBORHOOD_H
#define KINETRI_IMPL_KINETIC_FLIP_NEIGHBORHOOD_H

#include <array>
#include <cstddef>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The points of an in-circle certificate: the last one must not be inside the circle through the
/// others, which are a triangle.
template <class Point>
using Quadruple = std::array<const Point*, 4>;

/// The points around an edge that has just been flipped, all of them finite: the corners of its two
/// triangles, counterclockwise from one of its ends, so that the triangles are the corners 0, 1, 2
/// and 0, 2, 3; and of each outer edge, from the corner k to the next one, the point beyond it.
///
/// Five in-circle certificates are recomputed: number k < 4 is that of the outer edge k, number 4
/// that of the edge itself.
template <class Point>
struct Flip_neighborhood {
  static constexpr std::size_t certificates = 5;  ///< how many are recomputed

  std::array<const Point*, 4> corners;  ///< of the two triangles, counterclockwise
  std::array<const Point*, 4> beyond;   ///< across the outer edge from corners[k] to the next one

  /// The points of a certificate. Precondition: number < certificates.
  Quadruple<Point> certificate(std::size_t number) const {
    const auto& [a, right, b, left] = corners;
    if (number == 4) return {a, right, b, left};
    if (number < 2) return {a, right, b, beyond[number]};
    return {a, b, left, beyond[number]};
  }
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_KINETIC_FLIP_NEIGHBORHOOD_H
