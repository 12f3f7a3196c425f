// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_BENCH_BENCH_DISCS_H
#define KINETRI_BENCH_BENCH_DISCS_H

#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/simulation/box_2.h"
#include "measurements.h"

namespace kinetri::bench {

/// Discs in a box, with the areas as masses.
struct Bench_discs {
  std::vector<Linear_motion_2> motions;
  std::vector<double> radii;  ///< of each disc
  Box_2 box;                  ///< of the centers
};

/// Equal discs on the lattice of the setup, in the square of the lattice's cells. They cover the
/// area fraction of the setup.
Bench_discs equal_discs(const Setup& setup);

/// Discs in the same square with the same velocities, from the largest to the smallest, with the
/// setup's ratio between these, at random places where they overlap no other. The reciprocals of
/// their radii are evenly spaced: if the ratio is 100, a hundredth of the discs has more than half
/// of the greatest radius and covers half of the area, and half of the discs have less than twice
/// the least radius. Throws std::runtime_error if there is no free area left.
Bench_discs discs_of_different_sizes(const Setup& setup);

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_BENCH_DISCS_H
