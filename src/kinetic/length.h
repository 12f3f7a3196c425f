// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths with which certificates compare distances: at these, discs touch each other or a wall.
#ifndef KINETRI_SRC_KINETIC_LENGTH_H
#define KINETRI_SRC_KINETIC_LENGTH_H

#include <array>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The exact sum of terms, each linear in time: a length or a coordinate.
struct Length {
  /// value + rate * (t - epoch).
  struct Term {
    double value = 0;
    double rate = 0;
    double epoch = 0;
  };
  std::array<Term, 3> terms = {};  ///< unused ones are zero
};

/// The radius of a disc; zero for a point without one.
template <class Motion>
Length::Term radius_of(const Motion& motion) {
  if constexpr (HasWeight<Motion>) return {motion.radius, motion.growth, epoch_of(motion)};
  return {};
}

/// The distance of the centers of two discs with the gap `diameter`. If it is 0, they touch.
template <class Motion>
Length touching_distance(const Motion& p, const Motion& q, double diameter) {
  return {{{{diameter, 0, 0}, radius_of(p), radius_of(q)}}};
}

/// The exact bound of a wall for the point, or for the center of the disc.
template <class Motion>
Length bound_of(const Wall_2& wall, const Motion& motion) {
  const double inward = wall.is_upper() ? -1 : 1;
  const Length::Term rim = wall.rim_touches ? radius_of(motion) : Length::Term();
  return {{{{wall.position, 0, 0},
            {inward * wall.clearance, 0, 0},
            {inward * rim.value, inward * rim.rate, rim.epoch}}}};
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_LENGTH_H
