// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recorded tracks as a simulation: points that come, go from observation to observation along
// straight lines, and leave.
#ifndef KINETRI_SIMULATION_TRACKS_H
#define KINETRI_SIMULATION_TRACKS_H

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// Something was seen at a place.
struct Observation_2 {
  double time = 0;  ///< when
  Vector_2 place;   ///< where
};

/// What is made of the tracks.
struct Tracks_options {
  double from = -std::numeric_limits<double>::infinity();  ///< nothing before this time
  double until = std::numeric_limits<double>::infinity();  ///< nothing after it
  /// Where nothing has been seen for longer than this, the thing was away.
  double longest_gap = std::numeric_limits<double>::infinity();
};

/// A part of a track during which the thing was there: one point of the simulation.
struct Stay {
  std::size_t track = 0;  ///< its index among the tracks
  std::size_t first = 0;  ///< of the observations, the one at which it appears
  std::size_t last = 0;   ///< and the one at which it leaves; greater than `first`

  friend bool operator==(const Stay&, const Stay&) = default;
};

/// The stays of the tracks, in the order of the ids that their points get: by the time at which
/// they begin, but not before options.from, then by track. A single observation, without another
/// one near enough in time, is no stay: it has no path. Nor is what ends at options.from or before,
/// or begins at options.until or later. Precondition: the observations of each track have finite
/// numbers and strictly ascending times. Cost: O(n log n).
std::vector<Stay> stays_of(std::span<const std::vector<Observation_2>> tracks,
                           const Tracks_options& options);

/// The motion of a track from its observation `i` to the next one: at the place of the former at
/// its time, exactly; the velocity is rounded, so that the place of the next one is reached up to
/// rounding, and taken exactly when the point turns there. Precondition: both are there.
Linear_motion_2 motion_after(const std::vector<Observation_2>& track, std::size_t i);

/// A simulation at the time `start` in which each stay's point appears at its first observation
/// (event `insert`; points that are there at `start` are there from the beginning), turns at each
/// (event `trajectory`) and leaves at its last one (event `erase`). The point's id is the index of
/// the stay. All changes are scheduled. Precondition: `stays` is stays_of these tracks, with
/// options.from = start; the velocities are finite.
///
/// Throws what the constructor of Simulation_2 does; while time runs, Coincident_trajectories_error
/// where two things go the same way between two observations.
std::unique_ptr<Simulation_2<>> simulate_tracks(std::span<const std::vector<Observation_2>> tracks,
                                                std::span<const Stay> stays, double start,
                                                const Simulation_options& options = {},
                                                const Linear_kinetic_traits_2& traits = {});

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_TRACKS_H
