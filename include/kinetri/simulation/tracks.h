// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recorded tracks as a simulation: points that are inserted, move from observation to observation
// along straight lines, and are erased.
#ifndef KINETRI_SIMULATION_TRACKS_H
#define KINETRI_SIMULATION_TRACKS_H

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// One observation of a thing.
struct Observation_2 {
  double time = 0;  ///< the time of the observation
  Vector_2 place;   ///< the observed position
};

/// How tracks are divided into stays.
struct Tracks_options {
  double from = -std::numeric_limits<double>::infinity();  ///< ignore everything before this time
  double until = std::numeric_limits<double>::infinity();  ///< ignore everything after this time
  /// After a longer time without observations a new stay begins.
  double longest_gap = std::numeric_limits<double>::infinity();
};

/// A part of a track without long gaps: one point of the simulation.
struct Stay {
  std::size_t track = 0;  ///< index of the track
  std::size_t first = 0;  ///< index of the observation at which the point appears
  std::size_t last = 0;   ///< index of the observation at which it leaves; greater than `first`

  friend bool operator==(const Stay&, const Stay&) = default;
};

/// The stays of the tracks, in the order of the ids that their points will have: by start time, but
/// at least options.from, then by track. A single observation without another one near enough in
/// time is not a stay. Stays that end at or before options.from, or begin at or after
/// options.until, are omitted. Precondition: the observations of each track have finite numbers and
/// strictly increasing times. Cost: O(n log n) for n observations.
std::vector<Stay> stays_of(std::span<const std::vector<Observation_2>> tracks,
                           const Tracks_options& options);

/// The motion of a track from observation `i` to the next one. It is exactly at the observed
/// position at the time of observation `i`. The velocity is rounded, so the motion reaches the next
/// position up to rounding; the next motion begins there exactly. Precondition: observation i + 1
/// exists.
Linear_motion_2 motion_after(const std::vector<Observation_2>& track, std::size_t i);

/// A simulation at the time `start`. The point of each stay is inserted at its first observation
/// (event `insert`; stays that include `start` are present from the beginning), gets another motion
/// at each later one (event `trajectory`) and is erased at its last one (event `erase`). The id of
/// a point is the index of its stay. All changes are scheduled. Preconditions: `stays` is the
/// result of stays_of for these tracks, with options.from = start; the velocities are finite.
///
/// Throws the exceptions of the constructor of Simulation_2. Advancing the simulation throws
/// Coincident_trajectories_error if two things have the same trajectory between observations and
/// such points are refused.
std::unique_ptr<Simulation_2<>> simulate_tracks(std::span<const std::vector<Observation_2>> tracks,
                                                std::span<const Stay> stays, double start,
                                                const Simulation_options& options = {},
                                                const Linear_kinetic_traits_2& traits = {});

/// The same in the periodic box of the traits.
std::unique_ptr<Simulation_2<Periodic_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const Stay> stays, double start,
    const Simulation_options& options, const Periodic_kinetic_traits_2& traits);

/// The same of discs: radii[i] is the radius of the thing of track i, which is at least 0 and
/// finite. options.radius is 0.
std::unique_ptr<Simulation_2<Disc_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const double> radii,
    std::span<const Stay> stays, double start, const Simulation_options& options = {},
    const Disc_kinetic_traits_2& traits = {});

/// The same in the periodic box of the traits.
std::unique_ptr<Simulation_2<Periodic_disc_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const double> radii,
    std::span<const Stay> stays, double start, const Simulation_options& options,
    const Periodic_disc_kinetic_traits_2& traits);

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_TRACKS_H
