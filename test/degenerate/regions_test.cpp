// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every file of data/degenerate by regions, against the plain loop.
#include "triangulation/regions.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "kinetri/io/points_file.h"
#include "support/region_runs.h"

namespace kinetri::regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::options_of;

TEST(Regions, run_the_degenerate_corpus_as_the_loop_does) {
  Region_counters sum;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(KINETRI_DEGENERATE_FOLDER)) {
    if (entry.path().extension() != ".csv") continue;
    ++files;
    const auto motions = read_points_file(entry.path().string()).motions;
    for (const std::size_t regions : {1u, 2u, 5u, 16u}) {
      EXPECT_EQ(
          difference_from_loop(motions, {0.25, 1.0, 3.0, 40.0}, options_of(regions, 0.5), sum), "")
          << entry.path() << ", " << regions << " regions";
    }
  }
  EXPECT_GT(files, 50u);
  EXPECT_GT(sum.truncated_windows, 0u);
}

}  // namespace
}  // namespace kinetri::regions_test
