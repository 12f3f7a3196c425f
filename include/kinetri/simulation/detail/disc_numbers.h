// SPDX-License-Identifier: GPL-3.0-or-later
//
// The growth and the mass of a disc, whether its motion has a radius or not.
#ifndef KINETRI_SIMULATION_DETAIL_DISC_NUMBERS_H
#define KINETRI_SIMULATION_DETAIL_DISC_NUMBERS_H

#include <cmath>
#include <string>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/disc_motion_2.h"

namespace kinetri::detail {

/// The growth of the radius; 0 for a point.
template <class Motion>
double growth_of([[maybe_unused]] const Motion& motion) {
  if constexpr (HasWeight<Motion>) {
    return motion.growth;
  } else {
    return 0;
  }
}

/// What is wrong with a mass; empty if nothing is.
inline std::string mass_problem(Point_id id, double mass) {
  if (mass > 0 && std::isfinite(mass)) return {};
  return "the mass of point " + std::to_string(id) + " is not positive and finite";
}

}  // namespace kinetri::detail

#endif  // KINETRI_SIMULATION_DETAIL_DISC_NUMBERS_H
