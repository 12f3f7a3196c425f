// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box that points are kept in.
#ifndef KINETRI_SIMULATION_BOX_2_H
#define KINETRI_SIMULATION_BOX_2_H

#include <array>

#include "kinetri/kinetic/wall_2.h"

namespace kinetri {

/// The closed rectangle [xmin, xmax] x [ymin, ymax].
struct Box_2 {
  double xmin = 0;  ///< of the left wall
  double ymin = 0;  ///< of the bottom wall
  double xmax = 0;  ///< of the right wall
  double ymax = 0;  ///< of the top wall

  /// The four walls, each with the given clearance, in the order of Wall_2::Side.
  constexpr std::array<Wall_2, 4> walls(double clearance) const {
    return {
        Wall_2{Wall_2::Side::left, xmin, clearance}, Wall_2{Wall_2::Side::right, xmax, clearance},
        Wall_2{Wall_2::Side::bottom, ymin, clearance}, Wall_2{Wall_2::Side::top, ymax, clearance}};
  }

  friend bool operator==(const Box_2&, const Box_2&) = default;
};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_BOX_2_H
