// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of tracks: every row is found in the tracks or counted, in whatever order the rows stand,
// and everything that is no such file is an error that says where.
#include "kinetri/io/tracks_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/temporary_directory.h"

namespace kinetri {
namespace {

using test::Temporary_directory;
using test::write_file;

Tracks_file read(const std::string& text, Tracks_format format, double fps) {
  std::istringstream in(text);
  return read_tracks(in, "t.csv", format, fps);
}

// fps has no meaning for rows, and so even this one is no mistake.
Tracks_file rows(const std::string& text) {
  return read(text, Tracks_format::rows, 0);
}

Tracks_file frames(const std::string& text, double fps = 25) {
  return read(text, Tracks_format::frames, fps);
}

// A file of tracks as text that is easy to compare: "a: 0 (1, 2) line 2, ...; b: ...".
std::string shown(const Tracks_file& file) {
  std::ostringstream out;
  for (const Track& track : file.tracks) {
    out << (&track == &file.tracks.front() ? "" : "; ") << track.id << ":";
    for (const Track_observation& o : track.observations) {
      out << " " << o.time << " (" << o.place.x << ", " << o.place.y << ") line " << o.line;
    }
  }
  return out.str();
}

// The message of the error that the call causes; empty if it causes none.
template <class Function>
std::string error_of(Function function) {
  try {
    function();
    return "";
  } catch (const Input_error& error) {
    return error.what();
  }
}
std::string rows_error(const std::string& text) {
  return error_of([&] { rows(text); });
}
std::string frames_error(const std::string& text, double fps = 25) {
  return error_of([&] { frames(text, fps); });
}

// The promises that hold for every file: the order of tracks and observations, and the sum.
void expect_well_formed(const Tracks_file& file) {
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

// ---- signs that the columns of frames and ids are exchanged ----

constexpr const char* exchange =
    "; expected frame, id, x and y in this order: exchange the first two columns, for example with "
    "awk '{ print $2, $1, $3, $4 }'";
constexpr const char* or_confirm =
    ", or, if this is their order, add the line '# frame id x y' above the rows";

TEST(Read_tracks_frames, refuses_a_comment_that_names_another_order) {
  for (const auto& [comment, names] :
       {std::pair{"# id frame x y", "id frame x y"}, std::pair{"#ID\tFR\tX\tY\tZ", "id fr x y"},
        std::pair{"# PersID Frame X Y Z", "persid frame x y"},
        std::pair{"# columns: ped_id, frame_number, x/m, y/m", "pedid framenumber x y"},
        std::pair{"# id frame x [in m] y [in m] z [in m]", "id frame x y"},
        std::pair{"# frame x y id", "frame x y id"}, std::pair{"# frame id y x", "frame id y x"}}) {
    EXPECT_EQ(frames_error("# recorded in 2011\n" + std::string(comment) + "\n1 0 1 2\n"),
              "t.csv:2: the comment names the columns '" + std::string(names) + "'" + exchange);
  }
  // Also below a row, and where another comment has named the right order.
  EXPECT_NE(frames_error("1 0 1 2\n# id frame x y\n"), "");
  EXPECT_NE(frames_error("# frame id x y\n# id frame x y\n1 0 1 2\n"), "");
}

TEST(Read_tracks_frames, comments_that_name_no_other_order_are_skipped) {
  for (const char* comment :
       {"# frame id x y", "# Frame PersID X Y", "#frame\tped_id\tx/m\ty/m", "# the id of a frame",
        "# frame: x y", "# x y", "# framerate", "# the framerate is unknown", "#", "# id frame"}) {
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n"), "") << comment;
  }
}

TEST(Read_tracks_frames, refuses_a_frame_rate_unless_the_order_is_confirmed) {
  for (const char* comment : {"# framerate: 16", "#framerate: 16.00 fps", "# Frame rate = 16",
                              "# frame_rate 16", "# fps: 16"}) {
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n", 16),
              std::string("t.csv:1: the comment gives a frame rate, as in files whose columns are "
                          "id, frame, x and y") +
                  exchange + or_confirm)
        << comment;
    EXPECT_EQ(frames_error(std::string(comment) + "\n1 0 1 2\n", 25),
              "t.csv:1: the comment gives 16 frames a second, but the file is read with 25; "
              "expected the same rate")
        << comment;
    EXPECT_EQ(frames_error(std::string(comment) + "\n# frame id x y\n1 0 1 2\n", 16), "");
    EXPECT_EQ(frames_error("# frame id x y\n" + std::string(comment) + "\n1 0 1 2\n", 16), "");
    EXPECT_NE(frames_error("# frame id x y\n" + std::string(comment) + "\n1 0 1 2\n", 25), "");
  }
}

TEST(Read_tracks_frames, refuses_ids_that_never_repeat) {
  // One person, in the order id, frame, x, y.
  const std::string one_person = "1 100 0 0\n1 101 0.1 0\n1 102 0.2 0\n";
  EXPECT_EQ(frames_error(one_person),
            std::string("t.csv: none of the 3 ids is in two frames, as if the first two columns "
                        "were exchanged") +
                exchange + or_confirm);
  EXPECT_EQ(frames("# frame id x y\n" + one_person).tracks.size(), 3U);
  // Ids that are no numbers are no frames, nor are those of several frames.
  EXPECT_EQ(frames_error("1 a 0 0\n1 b 0.1 0\n1 c 0.2 0\n"), "");
  EXPECT_EQ(frames_error("1 1.5 0 0\n1 2.5 0.1 0\n1 3.5 0.2 0\n"), "");
  EXPECT_EQ(frames_error("1 7 0 0\n2 8 0.1 0\n3 9 0.2 0\n"), "");
  EXPECT_EQ(frames_error(one_person + "2 100 5 5\n"), "");
}

// Persons that walk one beside the other, 2 apart, 0.1 in a frame.
std::string walk(bool id_first, double step) {
  std::ostringstream out;
  for (int person = 1; person <= 5; ++person) {
    for (int frame = 0; frame < 10; ++frame) {
      out << (id_first ? person : frame) << ' ' << (id_first ? frame : person) << ' '
          << step * frame << ' ' << 2 * person << '\n';
    }
  }
  return out.str();
}

TEST(Read_tracks_frames, refuses_places_that_make_sense_only_in_the_other_order) {
  EXPECT_EQ(frames_error(walk(true, 0.125)),
            std::string("t.csv: successive rows of one id are 2 apart on average, but those of one "
                        "frame only 0.125, as if the first two columns were exchanged") +
                exchange + or_confirm);
  EXPECT_EQ(frames("# frame id x y\n" + walk(true, 0.125)).tracks.size(), 10U);
  EXPECT_EQ(frames(walk(false, 0.125)).tracks.size(), 5U);
  // Where the steps are as long as the distances nothing can be noticed.
  EXPECT_EQ(frames_error(walk(true, 1)), "");
  EXPECT_EQ(frames_error(walk(false, 3)), "");
}

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
            "expected one");
  EXPECT_EQ(frames_error("20\t7.0\t1\t2\n10\t7.0\t1\t2\n10\t7.0\t3\t2\n"),
            "t.csv:3: id '7.0' is at two places at t = 0.4: at (3, 2), and at (1, 2) in line 2; "
            "expected one");
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

TEST(Read_tracks, quoted_ids_are_printable_and_short) {
  EXPECT_NE(rows_error("t,id,x,y\n0,\x1b[2J,0,0\n0,\x1b[2J,1,0\n").find(R"(id '\x1b[2J' is)"),
            std::string::npos);
  const std::string id(100'000, 'a');
  EXPECT_NE(frames_error("0 " + id + " 0 0\n0 " + id + " 1 0\n")
                .find("id '" + std::string(40, 'a') + "...' is"),
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

// ---- files that are wrong ----

struct Bad_tracks {
  const char* text;
  const char* message;
};

class Bad_tracks_rows : public testing::TestWithParam<Bad_tracks> {};
class Bad_tracks_frames : public testing::TestWithParam<Bad_tracks> {};

TEST_P(Bad_tracks_rows, give_line_problem_and_expectation) {
  EXPECT_EQ(rows_error(GetParam().text), GetParam().message);
}

TEST_P(Bad_tracks_frames, give_line_problem_and_expectation) {
  EXPECT_EQ(frames_error(GetParam().text), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Header, Bad_tracks_rows,
    testing::Values(
        Bad_tracks{"",
                   "t.csv:1: the file is empty; expected a header line with the columns t,id,x,y, "
                   "in any order"},
        Bad_tracks{"\n# only a comment\n",
                   "t.csv:1: the file is empty; expected a header line with the columns t,id,x,y, "
                   "in any order"},
        Bad_tracks{"t,id,x\n0,a,1\n",
                   "t.csv:1: the column y is missing; expected a header line with the columns "
                   "t,id,x,y, in any order"},
        Bad_tracks{"x,y,t\n",
                   "t.csv:1: the column id is missing; expected a header line with the columns "
                   "t,id,x,y, in any order"},
        Bad_tracks{"# c\nt,id,x,t,y\n",
                   "t.csv:2: the column t is named twice; expected a header line with the columns "
                   "t,id,x,y, in any order"},
        Bad_tracks{"t,id,x,y,vx\n",
                   "t.csv:1: unknown column 'vx'; expected a header line with the columns "
                   "t,id,x,y, in any order"},
        Bad_tracks{"0,a,1,2\n",
                   "t.csv:1: unknown column '0'; expected a header line with the columns "
                   "t,id,x,y, in any order"}));

INSTANTIATE_TEST_SUITE_P(
    Rows, Bad_tracks_rows,
    testing::Values(
        Bad_tracks{"t,id,x,y\n0,a,1\n",
                   "t.csv:2: the row has 3 fields; expected 4, one for each column of the header"},
        Bad_tracks{"t,id,x,y\n0\n",
                   "t.csv:2: the row has 1 field; expected 4, one for each column of the header"},
        Bad_tracks{"t,id,x,y\n0,a,1,2,\n",
                   "t.csv:2: the row has 5 fields; expected 4, one for each column of the header"},
        Bad_tracks{"t,id,x,y\n\n0,a,,2\n", "t.csv:3: the column x is empty; expected a number"},
        Bad_tracks{"t,id,x,y\n0, ,1,2\n", "t.csv:2: the column id is empty; expected any text"},
        Bad_tracks{"t,id,x,y\n0,a,1,2 m\n",
                   "t.csv:2: the column y is '2 m', which is not a number; expected a decimal or "
                   "hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3"},
        Bad_tracks{"t,id,x,y\nnan,a,1,2\n",
                   "t.csv:2: the column t is 'nan', which is not finite; expected a finite number"},
        Bad_tracks{"t,id,x,y\n0,a,1,2\n1,a,-inf,2\n",
                   "t.csv:3: the column x is '-inf', which is not finite; expected a finite "
                   "number"},
        Bad_tracks{"t,id,x,y\n1e999,a,1,2\n",
                   "t.csv:2: the column t is '1e999', which is out of the range of binary64; "
                   "expected 0, or a magnitude from 4.9e-324 to 1.8e308"}));

INSTANTIATE_TEST_SUITE_P(
    Rows, Bad_tracks_frames,
    testing::Values(
        Bad_tracks{"frame id x y\n",
                   "t.csv:1: the column frame is 'frame', which is not a number; expected a "
                   "decimal or hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3"},
        Bad_tracks{"0 a 1 2\n0 a 1\n",
                   "t.csv:2: the row has 3 fields; expected 4, frame, id, x and y, separated by "
                   "tabs or blanks"},
        Bad_tracks{"\n7\n",
                   "t.csv:2: the row has 1 field; expected 4, frame, id, x and y, separated by "
                   "tabs or blanks"},
        Bad_tracks{"0 a man 1 2\n",
                   "t.csv:1: the column x is 'man', which is not a number; expected a decimal or "
                   "hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3"},
        Bad_tracks{"0 a 1 2 x\n",
                   "t.csv:1: the row has 5 fields; expected 4, frame, id, x and y, separated by "
                   "tabs or blanks"},
        Bad_tracks{"inf a 1 2\n",
                   "t.csv:1: the column frame is 'inf', which is not finite; expected a finite "
                   "number"},
        Bad_tracks{"0 a 1 nan\n",
                   "t.csv:1: the column y is 'nan', which is not finite; expected a finite number"},
        Bad_tracks{"0 a 1e-999 1\n",
                   "t.csv:1: the column x is '1e-999', which is out of the range of binary64; "
                   "expected 0, or a magnitude from 4.9e-324 to 1.8e308"},
        Bad_tracks{"0 a 1 2\n5e-324 a 1 2\n",
                   "t.csv:2: the time of the frame 5e-324 at 25 frames a second is out of the "
                   "range of binary64; expected 0, or a magnitude from 4.9e-324 to 1.8e308"}));

TEST(Read_tracks, times_too_large_are_errors) {
  EXPECT_EQ(frames_error("-1e308 a 1 2\n", 0.5),
            "t.csv:1: the time of the frame -1e+308 at 0.5 frames a second is out of the range of "
            "binary64; expected 0, or a magnitude from 4.9e-324 to 1.8e308");
  EXPECT_EQ(frames_error("-1e308 a 1 2\n", 1), "");
}

TEST(Read_tracks, overlong_line_is_an_error) {
  const std::string blanks(std::size_t{1} << 20U, ' ');
  EXPECT_EQ(rows_error("t,id,x,y\n0,a,1,2\n" + blanks + blanks + "\n"),
            "t.csv:3: the line is longer than 1048576 bytes; expected one observation a line");
  EXPECT_EQ(frames_error("0 a 1 2" + blanks),
            "t.csv:1: the line is longer than 1048576 bytes; expected one observation a line");
  EXPECT_EQ(frames_error("0 a 1 2" + blanks.substr(7)), "");
}

TEST(Read_tracks, binary_input_is_an_error) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string noise;
    for (int k = 0; k < 200; ++k) noise += static_cast<char>(random());
    EXPECT_NE(rows_error(noise), "");
    EXPECT_NE(rows_error("t,id,x,y\n" + noise), "");
    EXPECT_NE(frames_error(noise), "");
  }
}

// A stream that breaks after its first line.
class Breaking_buffer : public std::streambuf {
 public:
  explicit Breaking_buffer(std::string text) : text_(std::move(text)) {}

 protected:
  int_type underflow() override {
    if (!first_) throw std::runtime_error("the disk is gone");
    first_ = false;
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(*gptr());
  }

 private:
  bool first_ = true;
  std::string text_;
};

TEST(Read_tracks, stream_that_fails_is_an_error_and_not_the_end) {
  for (const auto& [text, format] :
       {std::pair{"t,id,x,y\n", Tracks_format::rows}, {"0 a 1 2\n", Tracks_format::frames}}) {
    Breaking_buffer buffer(text);
    std::istream in(&buffer);
    std::string message;
    try {
      read_tracks(in, "t.csv", format, 25);
    } catch (const Input_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "t.csv:1: reading failed; expected a readable file of tracks");
  }
}

TEST(Read_tracks, stream_that_has_failed_before_is_not_an_empty_file) {
  std::ifstream in;
  in.setstate(std::ios::failbit);
  EXPECT_EQ(error_of([&] { read_tracks(in, "t.csv", Tracks_format::frames, 25); }),
            "t.csv:1: reading failed; expected a readable file of tracks");
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

TEST(Read_tracks_file, dash_is_standard_input) {
  std::istringstream text("oops\n");
  std::streambuf* const before = std::cin.rdbuf(text.rdbuf());
  const std::string message = error_of([] { read_tracks_file("-", Tracks_format::frames, 25); });
  std::cin.rdbuf(before);
  std::cin.clear();
  EXPECT_EQ(message.substr(0, message.find(';')),
            "standard input:1: the column frame is 'oops', which is not a number");
}

TEST(Read_tracks_file, bad_paths_are_named) {
  const Temporary_directory directory;
  const auto message = [](const std::string& path) {
    return error_of([&path] { read_tracks_file(path, Tracks_format::frames, 25); });
  };
  EXPECT_EQ(message(directory.path()),
            directory.path().string() + ": is a directory; expected a file of tracks");
  EXPECT_EQ(
      message(directory.file("missing.txt")),
      directory.file("missing.txt") +
          ": cannot be opened: No such file or directory; expected a readable file of tracks");
  EXPECT_NE(message(""), "");
  if (::geteuid() == 0) return;  // who may read everything
  write_file(directory.file("secret.txt"), "");
  std::filesystem::permissions(directory.file("secret.txt"), std::filesystem::perms::none);
  EXPECT_NE(message(directory.file("secret.txt")).find("Permission denied"), std::string::npos);
}

// ---- recorded data ----

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
}  // namespace kinetri
