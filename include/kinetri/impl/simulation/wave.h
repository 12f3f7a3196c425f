// SPDX-License-Identifier: GPL-3.0-or-later
//
// The 2.5D wave of the paper that Kinetri starts from (Computation of Topologic Events in Kinetic
// Delaunay Triangulation using Sturm Sequences of Polynomials, section 6.3): one row of a lattice
// moves, collides with the next row, and passes its velocity on, so that a crest runs across the
// box and back.
#ifndef KINETRI_IMPL_SIMULATION_WAVE_H
#define KINETRI_IMPL_SIMULATION_WAVE_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/simulation_options.h"

namespace kinetri {

/// The lattice, and the motion of its first row. Lengths are in the unit of the coordinates.
struct Wave_setting {
  std::size_t columns = 30;  ///< number of columns of the lattice
  std::size_t rows = 30;     ///< number of rows of the lattice
  double spacing = 10;       ///< distance of neighbors in the lattice
  double speed = 10;         ///< of the moving row
  double diameter = 0.1;     ///< of the points, which exchange velocities when they touch
  /// The diameter of every second point, as the fields of a chessboard alternate, over that of the
  /// others: 1 or more.
  double size_ratio = 1;
  double jitter = 0;       ///< greatest offset of a point in y; with 0 the lattice is exact
  std::uint64_t seed = 1;  ///< of the offsets

  /// Whether there are points of two sizes.
  bool has_sizes() const { return size_ratio != 1; }
  /// The diameter of the greatest point.
  double greatest_diameter() const { return diameter * size_ratio; }
  /// The width of the box, which extends the lattice by half a spacing on each side.
  double width() const { return static_cast<double>(columns) * spacing; }
  /// The height of the box, which extends the lattice by half a spacing on each side.
  double height() const { return static_cast<double>(rows) * spacing; }
};

/// The points, row by row upward. The first row moves upward, all others rest. Preconditions:
/// columns and rows > 0, with fewer than 2^32 - 1 points; spacing, speed and diameter from 1e-100
/// to 1e100; the size ratio at least 1; the greatest diameter less than the spacing; the jitter in
/// that range or 0, and less than half of the gap between two such discs that are neighbors in a
/// column.
std::vector<Linear_motion_2> wave_motions(const Wave_setting& setting);

/// The same points with their radii. Preconditions as for wave_motions.
std::vector<Disc_motion_2> wave_discs(const Wave_setting& setting);

/// The options of the wave: a reflecting box, and discs that exchange velocities. They are for
/// wave_discs if there are points of two sizes, and else for wave_motions. Preconditions as for
/// wave_motions.
Simulation_options wave_options(const Wave_setting& setting);

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_WAVE_H
