// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box that bounds a simulation.
#ifndef KINETRI_SIMULATION_BOX_2_H
#define KINETRI_SIMULATION_BOX_2_H

#include <array>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The closed rectangle [xmin, xmax] x [ymin, ymax], in the unit of the coordinates.
struct Box_2 {
  double xmin = 0;  ///< x of the left wall
  double ymin = 0;  ///< y of the bottom wall
  double xmax = 0;  ///< x of the right wall
  double ymax = 0;  ///< y of the top wall

  /// The four walls in the order of Wall_2::Side. Points stay at least `clearance` away from each.
  constexpr std::array<Wall_2, 4> walls(double clearance) const {
    return {
        Wall_2{Wall_2::Side::left, xmin, clearance}, Wall_2{Wall_2::Side::right, xmax, clearance},
        Wall_2{Wall_2::Side::bottom, ymin, clearance}, Wall_2{Wall_2::Side::top, ymax, clearance}};
  }

  /// The corners, counterclockwise from the lower left one on.
  constexpr std::array<Vector_2, 4> corners() const {
    return {Vector_2{xmin, ymin}, Vector_2{xmax, ymin}, Vector_2{xmax, ymax}, Vector_2{xmin, ymax}};
  }

  friend bool operator==(const Box_2&, const Box_2&) = default;
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_BOX_2_H
