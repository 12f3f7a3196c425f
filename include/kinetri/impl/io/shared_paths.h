// SPDX-License-Identifier: GPL-3.0-or-later
//
// Things that are at one place for some time: a rider and the bus, two who rest on one bench.
#ifndef KINETRI_IMPL_IO_SHARED_PATHS_H
#define KINETRI_IMPL_IO_SHARED_PATHS_H

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/simulation/tracks.h"

namespace kinetri {

/// Two stays are on one path from this time on, for a while.
struct Shared_path {
  std::array<std::size_t, 2> stays;  ///< the smaller number first
  double time = 0;                   ///< from which they are
};

/// Those of some stays that share a path, decided exactly.
struct Shared_paths {
  std::vector<Shared_path> first;      ///< of each pair the first, by time, at most ten
  bool are_all = true;                 ///< whether there are no more pairs
  std::vector<std::size_t> companion;  ///< of each track, the least that its group has
};

/// Which of the `stays` of `tracks` (see stays_of) share a path between `from` and `until`. Only
/// tracks of equal radii count as one group; `radii` is by track, or empty. Cost: O(n log n) for n
/// observations, and exact arithmetic where two things have one velocity.
Shared_paths shared_paths(std::span<const std::vector<Observation_2>> tracks,
                          std::span<const Stay> stays, std::span<const double> radii, double from,
                          double until);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_SHARED_PATHS_H
