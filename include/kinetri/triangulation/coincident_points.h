// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happens to points that coincide for a while.
#ifndef KINETRI_TRIANGULATION_COINCIDENT_POINTS_H
#define KINETRI_TRIANGULATION_COINCIDENT_POINTS_H

#include <cstdint>

#include "kinetri/base/platform.h"

namespace kinetri {

/// What happens to points with the same trajectory and, if they have weights, the same weight, from
/// some time on.
enum class Coincident_points : std::uint8_t {
  hide,    ///< the one with the least id hides the others
  refuse,  ///< Coincident_trajectories_error
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_COINCIDENT_POINTS_H
