// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recorded tracks of pedestrians, which are not in the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>

#include "kinetri/io/tracks_file.h"
#include "support/temporary_directory.h"
#include "support/tracks_text.h"

namespace kinetri::recorded_tracks_test {
namespace {

using test::expect_well_formed;
using test::frames_error;

struct Recording {
  const char* file;
  std::size_t rows;
  std::size_t tracks;
};

class Recorded_tracks : public testing::TestWithParam<Recording> {};

TEST_P(Recorded_tracks, are_read_whole) {
  const std::filesystem::path path =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam().file;
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
  }
  const Tracks_file file = read_tracks_file(path, Tracks_format::frames, 25);
  expect_well_formed(file);
  EXPECT_EQ(file.observations, GetParam().rows);
  EXPECT_EQ(file.tracks.size(), GetParam().tracks);
  EXPECT_EQ(file.doubled_rows, 0U);
  EXPECT_EQ(file.rows_out_of_order, 0U);
  const std::string text = test::read_file(path);
  EXPECT_EQ(file.observations,
            static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')));
}

// The same rows in the form `id frame x y`.
TEST_P(Recorded_tracks, are_refused_with_exchanged_columns) {
  const std::filesystem::path path =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam().file;
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
  }
  std::istringstream in(test::read_file(path));
  std::ostringstream exchanged;
  for (std::string frame, id, x, y; in >> frame >> id >> x >> y;) {
    exchanged << id << '\t' << frame << '\t' << x << '\t' << y << '\n';
  }
  EXPECT_NE(frames_error(exchanged.str()).find("as if the first two columns were exchanged"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Crowd, Recorded_tracks,
                         testing::Values(Recording{"students003.txt", 17953, 434},
                                         Recording{"biwi_eth.txt", 5492, 360}),
                         [](const auto& test) {
                           const std::string file = test.param.file;
                           return file.substr(0, file.find_first_of("_0."));
                         });

}  // namespace
}  // namespace kinetri::recorded_tracks_test
