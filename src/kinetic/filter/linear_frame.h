// SPDX-License-Identifier: GPL-3.0-or-later
//
// The window of time over which the certificates of linear motions are looked at, and the errors
// of their polynomials there. The time is origin + w * window with 0 <= w <= 1. `size` bounds the
// difference of any two of the points in either coordinate, over the whole window; the errors are
// in units of 2^-53 * size^degree and are derived in docs/MATH.md, section 7. An overflow on the
// way shows in the sizes, which are out of range then.
#ifndef KINETRI_SRC_KINETIC_FILTER_LINEAR_FRAME_H
#define KINETRI_SRC_KINETIC_FILTER_LINEAR_FRAME_H

#include "coordinate_pair.h"
#include "differences.h"

namespace kinetri {

// The window is this share of the time in which the points would pass their distance from one
// another at their relative speed: long enough that most certificates are replaced before it ends.
inline constexpr double window_share = 0.5;

// The window, the sizes that belong to it, and the errors that follow from them.
struct Frame {
  double window = 0;
  double size = 0;
  double total = 0;

  Frame(const Magnitudes& m, double length) : window(length) {
    const double terms = sum(m.terms);
    const double moved = greatest(m.slope) * window;
    total = terms + moved;
    // The last term is more than the error of the extent.
    size = greatest(m.extent) + moved + 0x1p-49 * terms;
  }

  bool is_in_range() const {
    return size > least_size && total < greatest_size &&
           (window == 0 || kinetri::is_in_range(window));
  }
  double in_circle_error() const { return 2048 * unit_roundoff * (size * size) * (size * total); }
  double orientation_error() const { return 256 * unit_roundoff * (size * total); }
};

// The window for looking ahead. Precondition: the slope is in range.
inline double window_ahead(const Magnitudes& m) {
  return window_share * greatest(m.extent) / greatest(m.slope);
}

// The sum of the coefficients' magnitudes is at most this many times error.
inline constexpr double in_circle_norm = 12 / (2048 * unit_roundoff);
inline constexpr double orientation_norm = 4 / (256 * unit_roundoff);

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_LINEAR_FRAME_H
