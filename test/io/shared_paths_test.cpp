// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of several tracks share a path.
#include "kinetri/impl/io/shared_paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace kinetri::shared_paths_test {
namespace {

using Track_list = std::vector<std::vector<Observation_2>>;

Shared_paths paths_of(const Track_list& tracks, const std::vector<double>& radii = {},
                      double from = -INFINITY, double until = INFINITY) {
  return shared_paths(tracks, stays_of(tracks, {.from = from, .until = until}), radii, from, until);
}

using Stays = std::array<std::size_t, 2>;

TEST(Shared_paths, are_found_with_the_time_from_which_they_are_shared) {
  // The first two rest at (0, 0) from 2 to 4; the third passes there at 3.
  const Track_list tracks = {{{0, {-1, 0}}, {2, {0, 0}}, {5, {0, 0}}},
                             {{0, {0, 9}}, {1, {0, 0}}, {4, {0, 0}}, {6, {7, 7}}},
                             {{2, {-5, -5}}, {4, {5, 5}}}};
  const Shared_paths paths = paths_of(tracks);
  ASSERT_EQ(paths.first.size(), 1U);
  EXPECT_EQ(paths.first[0].stays, (Stays{0, 1}));
  EXPECT_EQ(paths.first[0].time, 2);
  EXPECT_TRUE(paths.are_all);
  // Within a part of the time, and of discs of two sizes.
  EXPECT_EQ(paths_of(tracks, {}, 3).first[0].time, 3);
  EXPECT_TRUE(paths_of(tracks, {}, 0, 2).first.empty());
  EXPECT_EQ(paths_of(tracks, {1, 1, 1}).first.size(), 1U);
  EXPECT_TRUE(paths_of(tracks, {1, 2, 1}).first.empty());
}

TEST(Shared_paths, are_decided_exactly) {
  const double next = std::nextafter(0.1, 1);
  EXPECT_TRUE(
      paths_of({{{0, {0, 0.1}}, {1, {1, 0.1}}}, {{0, {0, next}}, {1, {1, next}}}}).first.empty());
  EXPECT_EQ(
      paths_of({{{0, {0, 0.1}}, {1, {1, 0.1}}}, {{0.5, {0.5, 0.1}}, {2, {2, 0.1}}}}).first.size(),
      1U);
}

TEST(Shared_paths, of_many_ten_pairs_are_named) {
  Track_list tracks;
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < 2; ++k) tracks.push_back({{0, {9. * i, 0}}, {1, {9. * i, 0}}});
  }
  const Shared_paths paths = paths_of(tracks);
  EXPECT_EQ(paths.first.size(), 10U);
  EXPECT_FALSE(paths.are_all);
  EXPECT_TRUE(paths_of({}).first.empty());
}

}  // namespace
}  // namespace kinetri::shared_paths_test
