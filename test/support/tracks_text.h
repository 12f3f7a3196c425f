// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of tracks that are given as text.
#ifndef KINETRI_TEST_SUPPORT_TRACKS_TEXT_H
#define KINETRI_TEST_SUPPORT_TRACKS_TEXT_H

#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <string>

#include "kinetri/base/error.h"
#include "kinetri/io/tracks_file.h"
#include "support/message_of.h"

namespace kinetri::test {

inline Tracks_file tracks_of(const std::string& text, Tracks_format format, double fps) {
  std::istringstream in(text);
  return read_tracks(in, "t.csv", format, fps);
}

inline Tracks_file read_options(const std::string& text, const Tracks_file_options& options) {
  std::istringstream in(text);
  return read_tracks(in, "t.csv", options);
}

/// fps has no meaning for rows, so 0 is allowed.
inline Tracks_file rows(const std::string& text) {
  return tracks_of(text, Tracks_format::rows, 0);
}

inline Tracks_file frames(const std::string& text, double fps = 25) {
  return tracks_of(text, Tracks_format::frames, fps);
}

/// A file of tracks as text for comparison: "a: 0 (1, 2) line 2 ...; b: ...".
inline std::string shown(const Tracks_file& file) {
  std::ostringstream out;
  for (const Track& track : file.tracks) {
    out << (&track == &file.tracks.front() ? "" : "; ") << track.id << ":";
    for (const Track_observation& o : track.observations) {
      out << " " << o.time << " (" << o.place.x << ", " << o.place.y << ") line " << o.line;
    }
  }
  return out.str();
}

inline bool has_piece(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

inline std::string rows_error(const std::string& text) {
  return message_of<Input_error>([&] { rows(text); });
}
inline std::string read_options_error(const std::string& text, const Tracks_file_options& options) {
  return message_of<Input_error>([&] { read_options(text, options); });
}
inline std::string frames_error(const std::string& text, double fps = 25) {
  return message_of<Input_error>([&] { frames(text, fps); });
}

/// Checks the order of tracks and observations, and the number of observations.
inline void expect_well_formed(const Tracks_file& file) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    const Track& track = file.tracks[i];
    ASSERT_FALSE(track.id.empty());
    ASSERT_FALSE(track.observations.empty());
    for (std::size_t k = 1; k < track.observations.size(); ++k) {
      ASSERT_LT(track.observations[k - 1].time, track.observations[k].time) << track.id;
    }
    sum += track.observations.size();
    if (i == 0) continue;
    const Track_observation& before = file.tracks[i - 1].observations.front();
    const Track_observation& first = track.observations.front();
    ASSERT_TRUE(before.time < first.time ||
                (before.time == first.time && before.line < first.line));
  }
  EXPECT_EQ(file.observations, sum);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TRACKS_TEXT_H
