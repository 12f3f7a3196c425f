// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dense random packings of discs in a box, with walls or periodic: discs that move, collide and
// grow up to a given area fraction.
#ifndef KINETRI_SIMULATION_PACKING_H
#define KINETRI_SIMULATION_PACKING_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/box_2.h"

namespace kinetri {

/// The parameters of a packing.
struct Packing_options {
  std::size_t points = 1000;  ///< number of discs
  /// The area fraction that the discs cover, greater than 0. What can be reached depends on the
  /// sizes, and on the box if there are few discs: a thousand discs have reached 0.82 if they are
  /// equal, and 0.8 with the ratio 1.4.
  double share = 0.8;
  /// The radius of every second disc, those of odd ids, over that of the others: from 1 to 1000.
  double size_ratio = 1;
  std::uint64_t seed = 1;  ///< of the random positions and velocities
  /// The side of the square box; by default 10 sqrt(points), as in other scenarios.
  std::optional<double> side = std::nullopt;
  double speed = 5;  ///< bound of the velocity components of the result, as in other scenarios
  bool is_periodic = false;  ///< whether the box is periodic, without walls
};

/// A packing.
struct Packing {
  /// The square [0, side] x [0, side]: walls; or a periodic box with the vectors (side, 0) and
  /// (0, side).
  Box_2 box;
  std::vector<Disc_motion_2> discs;  ///< at time 0, with random velocities; they do not grow
};

/// The area fraction cannot be reached, or not in reasonable time: the discs are jammed.
class Packing_error : public Error {
 public:
  using Error::Error;
};

/// Makes a packing: points at random positions grow to discs, at rates proportional to their final
/// sizes, and collide elastically with each other and, with their boundary circles, with the box.
/// No two discs of the result overlap, and each is inside the box: proved exactly, over all pairs.
/// In a periodic box their centers are in the box, and no two images overlap, of two discs or of
/// one. The same options give the same numbers on every platform. Throws Packing_error. Cost: some
/// hundred collisions for each disc.
///
/// Source: B. Lubachevsky, F. Stillinger, Geometric properties of random disk packings, Journal of
/// Statistical Physics 60, 1990. Preconditions: at least one point and fewer than 2^32 - 1; the
/// share is greater than 0 and less than 1; the ratio is in its range; side and speed as for
/// make_scenario.
Packing make_packing(const Packing_options& options);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_PACKING_H
