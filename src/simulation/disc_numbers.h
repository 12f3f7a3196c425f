// SPDX-License-Identifier: GPL-3.0-or-later
//
// The growth and the mass of a disc.
#ifndef KINETRI_SRC_SIMULATION_DISC_NUMBERS_H
#define KINETRI_SRC_SIMULATION_DISC_NUMBERS_H

#include <cmath>
#include <string>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/algebra/number_types.h"
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

/// The time at which the radius is 0, exactly. Precondition: the growth is not 0.
template <HasWeight Motion>
Algebraic_number zero_of_radius(const Motion& disc) {
  return Algebraic_number(
      Rational(to_rational(disc.epoch) - to_rational(disc.radius) / to_rational(disc.growth)));
}

/// The error of a mass; empty if it is valid.
inline std::string mass_problem(Point_id id, double mass) {
  if (mass > 0 && std::isfinite(mass)) return {};
  return "the mass of point " + std::to_string(id) + " is not positive and finite";
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_DISC_NUMBERS_H
