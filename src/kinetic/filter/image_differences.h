// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences of images of points in a periodic box over a window: linear, as those of points.
// docs/MATH.md, section 18, derives the errors.
#ifndef KINETRI_SRC_KINETIC_FILTER_IMAGE_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_IMAGE_DIFFERENCES_H

#include <cmath>
#include <cstdint>

#include "coordinate_pair.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "linear_differences.h"

namespace kinetri {

template <>
struct Slope_terms_type<Image_motion_2> {
  using type = Pair;
};

// How often each lattice vector is in p - q; exact, since offsets have 32 bits.
struct Offset_difference {
  Offset_difference(const Image_motion_2& p, const Image_motion_2& q)
      : first(static_cast<double>(std::int64_t{p.offset.x} - q.offset.x)),
        second(static_cast<double>(std::int64_t{p.offset.y} - q.offset.y)) {}

  bool is_zero() const { return first == 0 && second == 0; }

  double first;
  double second;
};

// difference(), if the offsets differ. The difference of the points alone is first.
inline Difference difference_across_border(const Difference& alone, const Offset_difference& offset,
                                           const Periodic_box_2& box, double origin, Pair& terms,
                                           Pair& slope_terms) {
  const Linear_motion_2& a = box.first();
  const Linear_motion_2& b = box.second();
  const Pair moved_a = pair(a.velocity) * (origin - a.epoch);
  const Pair moved_b = pair(b.velocity) * (origin - b.epoch);
  const Pair shift =
      offset.first * (pair(a.position) + moved_a) + offset.second * (pair(b.position) + moved_b);
  const Pair shift_slope = offset.first * pair(a.velocity) + offset.second * pair(b.velocity);
  terms += std::abs(offset.first) * (absolute(pair(a.position)) + absolute(moved_a)) +
           std::abs(offset.second) * (absolute(pair(b.position)) + absolute(moved_b));
  slope_terms += absolute(alone.slope) + std::abs(offset.first) * absolute(pair(a.velocity)) +
                 std::abs(offset.second) * absolute(pair(b.velocity));
  return {alone.place + shift, alone.slope + shift_slope};
}

// The difference p - q at the origin, which depends on the difference of the offsets alone. If
// that is zero, it is the difference of the points, and the box is not needed.
inline Difference difference(const Image_motion_2& p, const Image_motion_2& q, double origin,
                             Pair& terms, Pair& slope_terms) {
  const Difference alone = difference(p.motion, q.motion, origin, terms);
  const Offset_difference offset(p, q);
  if (offset.is_zero()) return alone;
  return difference_across_border(alone, offset, p.box != nullptr ? *p.box : *q.box, origin, terms,
                                  slope_terms);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_IMAGE_DIFFERENCES_H
