// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random tracks for tests of observers.
#ifndef KINETRI_TEST_SUPPORT_RANDOM_WALKS_H
#define KINETRI_TEST_SUPPORT_RANDOM_WALKS_H

#include <cstddef>
#include <random>
#include <vector>

#include "kinetri/simulation/tracks.h"

namespace kinetri::test {

using Tracks = std::vector<std::vector<Observation_2>>;

/// Random walks on a grid, with pauses, gaps and meetings. Multiples of `fraction`, different for
/// each walk, make trajectories distinct; if it is 0, some are the same for a while. All
/// coordinates are shifted by `origin`.
inline Tracks random_walks(std::size_t number, unsigned seed, double origin = 0,
                           double fraction = 0x1p-10) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, 12);
  std::uniform_int_distribution<int> step(-2, 2);
  std::uniform_int_distribution<int> time(0, 6);
  Tracks tracks(number);
  for (std::size_t i = 0; i < number; ++i) {
    double t = time(random);
    Vector_2 here = {origin + place(random), origin + place(random)};
    for (int k = 0; k < 6; ++k) {
      tracks[i].push_back({t, here});
      t += 1 + time(random) / 3;
      here = {here.x + step(random) + fraction * static_cast<double>(i), here.y + step(random)};
    }
  }
  return tracks;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_RANDOM_WALKS_H
