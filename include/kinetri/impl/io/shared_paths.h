// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks that share a path for some time, such as those of a bus and a passenger.
#ifndef KINETRI_IMPL_IO_SHARED_PATHS_H
#define KINETRI_IMPL_IO_SHARED_PATHS_H

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/simulation/tracks.h"

namespace kinetri {

/// Two stays that share a path from this time on.
struct Shared_path {
  std::array<std::size_t, 2> stays;  ///< the smaller number first
  double time = 0;                   ///< its begin
};

/// The stays that share a path, decided exactly.
struct Shared_paths {
  std::vector<Shared_path> first;  ///< the first of each pair, by time; at most ten
  bool are_all = true;             ///< whether there are no more pairs
};

/// The `stays` of `tracks` (see stays_of) that share a path between `from` and `until`, and have
/// equal radii; `radii` is by track, or empty. Cost: O(n log n) for n observations,
/// and exact arithmetic for pairs of equal velocities.
Shared_paths shared_paths(std::span<const std::vector<Observation_2>> tracks,
                          std::span<const Stay> stays, std::span<const double> radii, double from,
                          double until);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_SHARED_PATHS_H
