// SPDX-License-Identifier: GPL-3.0-or-later
//
// The discs that are measured: where they are at time 0, how they move, and how large they are.
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
  std::vector<double> radii;  ///< one for each
  Box_2 box;                  ///< of the centres
};

/// Discs of one size on the lattice of the setup, in the square that the lattice's cells fill, of
/// which they cover the share of the setup.
Bench_discs equal_discs(const Setup& setup);

/// Discs in the same square with the same velocities, from the largest to the smallest, with the
/// setup's ratio between these, at random places where they overlap no other. The reciprocals of
/// their radii are evenly spaced: so a hundredth of the discs has more than half of the greatest
/// radius where the ratio is 100, and covers half of the area; half of the discs have less than
/// twice the least radius. Throws std::runtime_error where there is no room.
Bench_discs discs_of_different_sizes(const Setup& setup);

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_BENCH_DISCS_H
