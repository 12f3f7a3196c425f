// SPDX-License-Identifier: GPL-3.0-or-later
//
// The start of the certificate that two points remain in range.
#ifndef KINETRI_SRC_OBSERVERS_LATER_TIME_IN_RANGE_H
#define KINETRI_SRC_OBSERVERS_LATER_TIME_IN_RANGE_H

#include <cmath>
#include <concepts>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/image_motion_2.h"

namespace kinetri::detail {

/// A time until which two points that are in range at `from` remain so: `from` or later. Near the
/// time at which they come in range a filter cannot decide when they separate. In linear motion
/// their gap is convex, so they are in range until any later time at which they are; such a time is
/// likely that of about their least distance, which an exact predicate checks.
template <class Traits, class Point>
double later_time_in_range(const Traits& traits, const Point& p, const Point& q, double range,
                           double from) {
  using Center = Center_motion_of<typename Point::Motion>;
  if constexpr (std::same_as<Center, Linear_motion_2> || std::same_as<Center, Image_motion_2>) {
    const Vector_2 place_p = rounded_place(p.motion(), from);
    const Vector_2 place_q = rounded_place(q.motion(), from);
    const Vector_2 velocity_p = rounded_velocity(p.motion(), from);
    const Vector_2 velocity_q = rounded_velocity(q.motion(), from);
    const Vector_2 d = {place_q.x - place_p.x, place_q.y - place_p.y};
    const Vector_2 v = {velocity_q.x - velocity_p.x, velocity_q.y - velocity_p.y};
    const double least = from - (d.x * v.x + d.y * v.y) / (v.x * v.x + v.y * v.y);
    if (std::isfinite(least) && least > from &&
        traits.do_touch(p, q, range, Algebraic_number(least))) {
      return least;
    }
  }
  return from;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_LATER_TIME_IN_RANGE_H
