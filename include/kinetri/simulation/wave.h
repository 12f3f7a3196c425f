// SPDX-License-Identifier: GPL-3.0-or-later
//
// The 2.5D wave of the paper that Kinetri starts from (Computation of Topologic Events in Kinetic
// Delaunay Triangulation using Sturm Sequences of Polynomials, section 6.3): one row of a lattice
// moves, hits the next one, and gives it its velocity, so that a crest runs across the area and
// back.
#ifndef KINETRI_SIMULATION_WAVE_H
#define KINETRI_SIMULATION_WAVE_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/simulation/simulation_options.h"

namespace kinetri {

/// The lattice and its first row's motion. Lengths are in the unit of the coordinates.
struct Wave_setting {
  std::size_t columns = 30;  ///< of the lattice
  std::size_t rows = 30;     ///< of the lattice
  double spacing = 10;       ///< of neighbors in the lattice
  double speed = 10;         ///< of the row that moves
  double diameter = 0.1;     ///< of the points, which exchange their velocities when they touch
  double jitter = 0;         ///< the largest offset of a point in y; 0: the lattice is exact
  std::uint64_t seed = 1;    ///< of the offsets

  /// The width of the box: half of the spacing beyond the lattice on each side.
  double width() const { return static_cast<double>(columns) * spacing; }
  /// The height of the box, likewise.
  double height() const { return static_cast<double>(rows) * spacing; }
};

/// The points, row by row from y = 0 up; those of the first row go up, all others rest.
/// Preconditions: there are columns, rows, and fewer than 2^32 - 1 points; spacing and speed from
/// 1e-100 to 1e100, the diameter too and less than the spacing; the jitter in that range or 0, and
/// less than half of what is left between two points of a column.
std::vector<Linear_motion_2> wave_motions(const Wave_setting& setting);

/// The box that reflects the points, and their discs. Preconditions as above.
Simulation_options wave_options(const Wave_setting& setting);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_WAVE_H
