// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of tracks: every row is found in the tracks or counted, in whatever order the rows stand.
// What is no such file: tracks_file_errors_test.cpp.
#include "kinetri/io/tracks_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "support/precondition_error.h"
#include "support/temporary_directory.h"
#include "support/tracks_text.h"
#include "support/wrong_input.h"

namespace kinetri::tracks_file_test {
namespace {

using test::expect_well_formed;
using test::frames;
using test::frames_error;
using test::rows;
using test::rows_error;
using test::shown;
using test::Temporary_directory;
using test::write_file;

// ---- the format of rows ----

TEST(Read_tracks_rows, gathers_the_rows_of_each_id) {
  const Tracks_file file = rows("t,id,x,y\n0,a,1,2\n0,b,-3,0.5\n0.5,a,0x1p-3,1e2\n");
  EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 0.5 (0.125, 100) line 4; b: 0 (-3, 0.5) line 3");
  EXPECT_EQ(file.observations, 3U);
  EXPECT_EQ(file.doubled_rows, 0U);
  EXPECT_EQ(file.rows_out_of_order, 0U);
}

TEST(Read_tracks_rows, takes_columns_in_any_order) {
  EXPECT_EQ(shown(rows("y,x,id,t\n4,3,a,1\n")), "a: 1 (3, 4) line 2");
  EXPECT_EQ(shown(rows("id,t,y,x\na,1,4,3\n")), "a: 1 (3, 4) line 2");
}

TEST(Read_tracks_rows, reads_radii) {
  const Tracks_file file = rows("radius,t,id,x,y\n0.5,1,a,1,2\n0x1p1,0,b,-3,0.5\n.5,0,a,0,0\n");
  EXPECT_TRUE(file.has_radii);
  ASSERT_EQ(file.tracks.size(), 2U);
  EXPECT_EQ(file.tracks[0].id, "b");
  EXPECT_EQ(file.tracks[0].radius, 2);
  EXPECT_EQ(file.tracks[1].radius, 0.5);
  EXPECT_EQ(file.tracks[1].observations.size(), 2U);
  const Tracks_file without = rows("t,id,x,y\n1,a,1,2\n");
  EXPECT_FALSE(without.has_radii);
  EXPECT_EQ(without.tracks[0].radius, 0);
  EXPECT_FALSE(frames("10 a 0 0\n").has_radii);
}

TEST(Read_tracks_rows, skips_blank_lines_and_comments) {
  EXPECT_EQ(shown(rows("# before\n\n \t\nt,id,x,y\n#0,a,0,0\n\n0,a,1,2\n  \n1,a,1,2\n\n")),
            "a: 0 (1, 2) line 7 1 (1, 2) line 9");
}

TEST(Read_tracks_rows, tolerates_blanks_byte_order_mark_and_carriage_returns) {
  EXPECT_EQ(shown(rows("\xEF\xBB\xBF t ,id\t, x,y \r\n 0 ,\ta , 1 ,2\r\n\r\n#\r\n1,a,3,4")),
            "a: 0 (1, 2) line 2 1 (3, 4) line 5");
}

TEST(Read_tracks_rows, id_is_any_text_without_commas) {
  EXPECT_EQ(shown(rows("t,id,x,y\n0, a man ,1,2\n1,a man,1,3\n2,\"q\",0,0\n3,\xC3\xA4#,0,0\n")),
            "a man: 0 (1, 2) line 2 1 (1, 3) line 3; \"q\": 2 (0, 0) line 4; "
            "\xC3\xA4#: 3 (0, 0) line 5");
}

TEST(Read_tracks_rows, ids_are_texts_and_not_numbers) {
  EXPECT_EQ(rows("t,id,x,y\n0,1,1,2\n0,1.0,1,2\n0,01,1,2\n0,+1,1,2\n").tracks.size(), 4U);
  EXPECT_EQ(rows("t,id,x,y\n0,a,1,2\n0,A,1,2\n").tracks.size(), 2U);
}

TEST(Read_tracks_rows, header_alone_means_no_tracks) {
  for (const char* text : {"t,id,x,y\n", "t,id,x,y", "# nothing yet\nid,x,y,t\n\n#\n"}) {
    const Tracks_file file = rows(text);
    EXPECT_TRUE(file.tracks.empty());
    EXPECT_EQ(file.observations, 0U);
  }
}

// ---- the format of frames ----

TEST(Read_tracks_frames, time_is_frame_by_frames_a_second) {
  EXPECT_EQ(shown(frames("780\t1.0\t8.46\t3.59\n800\t1.0\t9.5\t3.75\n")),
            "1.0: 31.2 (8.46, 3.59) line 1 32 (9.5, 3.75) line 2");
  EXPECT_EQ(shown(frames("0.0 7 1 2\n-5e0 7 1 2\n2.5 7 1 2\n", 2)),
            "7: -2.5 (1, 2) line 2 0 (1, 2) line 1 1.25 (1, 2) line 3");
}

TEST(Read_tracks_frames, time_is_rounded_to_nearest) {
  const Tracks_file file = frames("1 a 0 0\n10 a 0 0\n", 29.97);
  EXPECT_EQ(file.tracks[0].observations[0].time, 1 / 29.97);
  EXPECT_EQ(frames("10 a 0 0\n").tracks[0].observations[0].time, 0.4);
  // Multiplying by 1 / 25 would give 0.12000000000000001.
  EXPECT_EQ(frames("3 a 0 0\n").tracks[0].observations[0].time, 0.12);
}

TEST(Read_tracks_frames, fields_are_separated_by_tabs_or_blanks) {
  EXPECT_EQ(shown(frames("  0\ta 1   2\t\n\t25 \t a,b\t3 \t4")),
            "a: 0 (1, 2) line 1; a,b: 1 (3, 4) line 2");
}

TEST(Read_tracks_frames, skips_blank_lines_and_comments) {
  EXPECT_EQ(
      shown(frames("\xEF\xBB\xBF# seen from above\r\n\r\n0 a 1 2\r\n \t\r\n#0 a 5 5\r\n25 a 1 2")),
      "a: 0 (1, 2) line 3 1 (1, 2) line 6");
  EXPECT_EQ(shown(frames("\xEF\xBB\xBF"
                         "0 a 1 2\n")),
            "a: 0 (1, 2) line 1");
}

TEST(Read_tracks_frames, ids_are_texts_and_not_numbers) {
  EXPECT_EQ(shown(frames("0 1 1 2\n0 1.0 1 2\n")), "1: 0 (1, 2) line 1; 1.0: 0 (1, 2) line 2");
}

TEST(Read_tracks_frames, empty_file_means_no_tracks) {
  for (const char* text : {"", "\n", "# nothing\n\n"}) {
    EXPECT_TRUE(frames(text).tracks.empty());
    EXPECT_EQ(frames(text).observations, 0U);
  }
}

TEST(Read_tracks_frames, frames_a_second_must_be_positive_and_finite) {
  for (const double fps : {0.0, -25.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_PRECONDITION_ERROR(frames("0 a 1 2\n", fps),
                              "the number of frames a second is not a finite number greater than 0")
        << fps;
  }
  EXPECT_EQ(frames("0 a 1 2\n", std::numeric_limits<double>::denorm_min()).observations, 1U);
}

TEST(Read_tracks_frames, frames_too_close_for_their_times_are_at_one_time) {
  // Of two neighbors in [1.5, 2) the thirds may be the same number.
  const char* const first = "0x1.8000000000001p0";
  const char* const second = "0x1.8000000000002p0";
  ASSERT_EQ(0x1.8000000000001p0 / 3, 0x1.8000000000002p0 / 3);
  const auto text = [&](const char* place) {
    return std::string(first) + " a 1 2\n" + second + " a " + place + "\n";
  };
  EXPECT_EQ(frames(text("1 2"), 3).doubled_rows, 1U);
  EXPECT_NE(frames_error(text("1 3"), 3).find("t.csv:2: id 'a' is at two places"),
            std::string::npos);
}

// ---- order and repetition, the same in both formats ----

TEST(Read_tracks, sorts_by_time_and_counts_rows_out_of_order) {
  const Tracks_file file =
      rows("t,id,x,y\n3,a,0,0\n1,a,0,0\n9,b,0,0\n2,a,0,0\n4,a,0,0\n-1,a,0,0\n10,b,0,0\n");
  EXPECT_EQ(shown(file),
            "a: -1 (0, 0) line 7 1 (0, 0) line 3 2 (0, 0) line 5 3 (0, 0) line 2 4 (0, 0) line 6; "
            "b: 9 (0, 0) line 4 10 (0, 0) line 8");
  // Lines 3 and 7: that of line 5 is not earlier than that of line 3, the one before it.
  EXPECT_EQ(file.rows_out_of_order, 2U);
  EXPECT_EQ(frames("50 a 0 0\n25 a 0 0\n").rows_out_of_order, 1U);
}

TEST(Read_tracks, other_ids_between_are_not_out_of_order) {
  EXPECT_EQ(rows("t,id,x,y\n5,a,0,0\n1,b,0,0\n6,a,0,0\n2,b,0,0\n").rows_out_of_order, 0U);
}

TEST(Read_tracks, tracks_are_sorted_by_first_time_then_line) {
  EXPECT_EQ(shown(rows("t,id,x,y\n5,e,0,0\n1,d,0,0\n1,b,0,0\n7,c,0,0\n1,c,0,0\n0,e,0,0\n")),
            "e: 0 (0, 0) line 7 5 (0, 0) line 2; d: 1 (0, 0) line 3; b: 1 (0, 0) line 4; "
            "c: 1 (0, 0) line 6 7 (0, 0) line 5");
}

TEST(Read_tracks, repeated_rows_are_dropped_and_counted) {
  const Tracks_file file =
      rows("t,id,x,y\n0,a,1,2\n0,a,1,2\n0,b,1,2\n1,a,1,2\n0.0,a,1e0,2\n1,a,1.0,2\n0,a,1,2\n");
  EXPECT_EQ(shown(file), "a: 0 (1, 2) line 2 1 (1, 2) line 5; b: 0 (1, 2) line 4");
  EXPECT_EQ(file.doubled_rows, 4U);
  EXPECT_EQ(file.observations, 3U);
  // Lines 6 and 8, though they are doubled.
  EXPECT_EQ(file.rows_out_of_order, 2U);
  EXPECT_EQ(frames("0 a 1 2\n0.0 a 1.0 2\n").doubled_rows, 1U);
}

TEST(Read_tracks, zeros_of_both_signs_are_the_same) {
  const Tracks_file file = rows("t,id,x,y\n0,a,0,-0\n-0,a,-0,0\n");
  EXPECT_EQ(file.doubled_rows, 1U);
  EXPECT_EQ(file.rows_out_of_order, 0U);
  ASSERT_EQ(file.tracks[0].observations.size(), 1U);
  EXPECT_FALSE(std::signbit(file.tracks[0].observations[0].time));
  EXPECT_TRUE(std::signbit(file.tracks[0].observations[0].place.y));
}

TEST(Read_tracks, two_places_at_one_time_name_both_lines) {
  EXPECT_EQ(rows_error("t,id,x,y\n0.4,x,1,2\n0.4,z,1,2\n\n0.4,x,1,2.5\n"),
            "t.csv:5: id 'x' is at two places at t = 0.4: at (1, 2.5), and at (1, 2) in line 2; "
            "expected one, or --duplicates first, last or mean, which says what to take");
  EXPECT_EQ(frames_error("20\t7.0\t1\t2\n10\t7.0\t1\t2\n10\t7.0\t3\t2\n"),
            "t.csv:3: id '7.0' is at two places at t = 0.4: at (3, 2), and at (1, 2) in line 2; "
            "expected one, or --duplicates first, last or mean, which says what to take");
}

TEST(Read_tracks, of_several_ids_at_two_places_the_first_in_the_file_is_named) {
  EXPECT_NE(rows_error("t,id,x,y\n9,a,0,0\n5,b,0,0\n1,c,0,0\n5,b,0,0\n5,b,0,1\n9,a,1,0\n1,c,2,0\n")
                .find("t.csv:6: id 'b' is at two places at t = 5: at (0, 1), and at (0, 0) in "
                      "line 3;"),
            std::string::npos);
  EXPECT_NE(rows_error("t,id,x,y\n1,a,0,0\n2,a,0,0\n2,a,1,0\n1,a,1,0\n").find("t.csv:4: id 'a'"),
            std::string::npos);
  EXPECT_NE(rows_error("t,id,x,y\n2,a,0,0\n1,a,0,0\n2,a,1,0\n1,a,1,0\n").find("t.csv:4: id 'a'"),
            std::string::npos);
}

// What is the same however the rows stand.
using Places = std::map<std::pair<std::string, double>, std::pair<double, double>>;
Places places_of(const Tracks_file& file) {
  Places result;
  for (const Track& track : file.tracks) {
    for (const Track_observation& o : track.observations) {
      result[{track.id, o.time}] = {o.place.x, o.place.y};
    }
  }
  return result;
}

TEST(Read_tracks, shuffled_rows_give_the_same_tracks) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&random](std::uint32_t n) { return static_cast<int>(random() % n); };
    Places expected;
    std::vector<std::string> lines;
    std::map<std::string, double> last;  // in the file as it is written at first
    std::size_t out_of_order = 0;
    for (int i = below(120); i > 0; --i) {
      const std::string id = "id" + std::to_string(below(8));
      const int frame = below(20);
      const double x = below(3);
      const double y = below(3);
      const auto place = expected.try_emplace({id, frame / 4.0}, x, y).first->second;
      lines.push_back(std::to_string(frame) + " " + id + " " + std::to_string(place.first) + " " +
                      std::to_string(place.second) + "\n");
      const auto before = last.find(id);
      if (before != last.end() && frame < before->second) ++out_of_order;
      last[id] = frame;
    }
    std::size_t counted = 0;
    for (int round = 0; round < 4; ++round) {
      std::string text;
      for (const std::string& line : lines) text += line;
      const Tracks_file file = frames(text, 4);
      expect_well_formed(file);
      EXPECT_EQ(places_of(file), expected);
      EXPECT_EQ(file.observations, expected.size());
      EXPECT_EQ(file.doubled_rows, lines.size() - expected.size());
      for (const Track& track : file.tracks) {
        for (const Track_observation& o : track.observations) {
          // The line is one that says so, and the first of those.
          const auto line = lines.begin() + static_cast<std::ptrdiff_t>(o.line - 1);
          EXPECT_EQ(std::find(lines.begin(), lines.end(), *line), line);
          EXPECT_EQ(line->substr(0, line->find(' ')), std::to_string(std::lround(o.time * 4)));
        }
      }
      if (round == 0) {
        EXPECT_EQ(file.rows_out_of_order, out_of_order);
      }
      counted += file.rows_out_of_order;
      std::shuffle(lines.begin(), lines.end(), random);
    }
    if (lines.size() > 60) {
      EXPECT_GT(counted, 0U);
    }
  }
}

// Quadratic behavior would take minutes.
TEST(Read_tracks, many_rows_in_the_wrong_order_are_read_quickly) {
  std::string text;
  constexpr int count = 60'000;
  for (int i = count; i > 0; --i) {
    text += std::to_string(i) + " a 0 0\n0 id" + std::to_string(i) + " 0 0\n";
  }
  const Tracks_file file = frames(text);
  EXPECT_EQ(file.tracks.size(), std::size_t{count} + 1);
  EXPECT_EQ(file.rows_out_of_order, std::size_t{count} - 1);
  expect_well_formed(file);
}

// ---- paths ----

TEST(Read_tracks_file, reads_a_file_of_either_format) {
  const Temporary_directory directory;
  write_file(directory.file("t.csv"), "t,id,x,y\n0,a,1,2\n");
  write_file(directory.file("t.txt"), "25\ta\t1\t2\n");
  EXPECT_EQ(shown(read_tracks_file(directory.file("t.csv"), Tracks_format::rows, 25)),
            "a: 0 (1, 2) line 2");
  EXPECT_EQ(shown(read_tracks_file(directory.file("t.txt"), Tracks_format::frames, 25)),
            "a: 1 (1, 2) line 1");
}

TEST(Read_tracks_file, options_may_be_empty) {
  const Temporary_directory directory;
  write_file(directory.file("t.csv"), "t,id,x,y\n0,a,1,2\n");
  write_file(directory.file("t.txt"), "# fps: 25\n# id frame x y\na\t25\t1\t2\n");
  EXPECT_EQ(shown(read_tracks_file(directory.file("t.csv"), {})), "a: 0 (1, 2) line 2");
  EXPECT_EQ(shown(read_tracks_file(directory.file("t.txt"), {})), "a: 1 (1, 2) line 3");
  EXPECT_EQ(shown(read_tracks_file(directory.file("t.txt"), Tracks_format::ids)),
            "a: 1 (1, 2) line 3");
}

TEST(Read_tracks_file, dash_is_standard_input) {
  std::istringstream text("oops\n");
  std::streambuf* const before = std::cin.rdbuf(text.rdbuf());
  const std::string message =
      test::message_of<Input_error>([] { read_tracks_file("-", Tracks_format::frames, 25); });
  std::cin.rdbuf(before);
  std::cin.clear();
  EXPECT_EQ(message.substr(0, message.find(';')),
            "standard input:1: the column frame is 'oops', which is not a number");
}

TEST(Read_tracks_file, bad_paths_are_named) {
  test::expect_bad_paths_are_named(
      "tracks", [](const std::string& path) { read_tracks_file(path, Tracks_format::frames, 25); });
}

}  // namespace
}  // namespace kinetri::tracks_file_test
