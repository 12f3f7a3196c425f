// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are no files of tracks: the error says where.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <istream>
#include <random>
#include <string>
#include <utility>

#include "kinetri/io/tracks_file.h"
#include "support/tracks_text.h"
#include "support/wrong_input.h"

namespace kinetri::tracks_file_errors_test {
namespace {

using test::Breaking_buffer;
using test::frames_error;
using test::message_of;
using test::rows_error;

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
                   "t.csv:1: the file is empty; expected a header line with the columns t,id,x,y "
                   "and optionally radius, in any order"},
        Bad_tracks{"\n# only a comment\n",
                   "t.csv:1: the file is empty; expected a header line with the columns t,id,x,y "
                   "and optionally radius, in any order"},
        Bad_tracks{"t,id,x\n0,a,1\n",
                   "t.csv:1: the column y is missing; expected a header line with the columns "
                   "t,id,x,y and optionally radius, in any order"},
        Bad_tracks{"x,y,t\n",
                   "t.csv:1: the column id is missing; expected a header line with the columns "
                   "t,id,x,y and optionally radius, in any order"},
        Bad_tracks{"# c\nt,id,x,t,y\n",
                   "t.csv:2: the column t is named twice; expected a header line with the columns "
                   "t,id,x,y and optionally radius, in any order"},
        Bad_tracks{"t,id,x,y,vx\n",
                   "t.csv:1: unknown column 'vx'; expected a header line with the columns "
                   "t,id,x,y and optionally radius, in any order"},
        Bad_tracks{"0,a,1,2\n",
                   "t.csv:1: unknown column '0'; expected a header line with the columns "
                   "t,id,x,y and optionally radius, in any order"}));

INSTANTIATE_TEST_SUITE_P(
    Rows, Bad_tracks_rows,
    testing::Values(
        Bad_tracks{"t,id,x,y\n0,a,1\n",
                   "t.csv:2: the row has 3 fields; expected 4, one for each column of the header"},
        Bad_tracks{"t,id,x,y\n0\n",
                   "t.csv:2: the row has 1 field; expected 4, one for each column of the header"},
        Bad_tracks{
            "t,id,x,y\n0,a,1,2,\n",
            "t.csv:2: the row has 5 fields; expected 4, one for each column of the header; if the "
            "first field is the name of a row, as R's write.table writes it, expected a name for "
            "it in the header, and --columns t=NAME,id=NAME,x=NAME,y=NAME"},
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
    Radii, Bad_tracks_rows,
    testing::Values(
        Bad_tracks{"t,id,x,y,radius\n0,a,1,2,-1\n",
                   "t.csv:2: the radius -1 is negative; expected at least 0"},
        Bad_tracks{"t,id,radius,x,y\n0,a,nan,1,2\n",
                   "t.csv:2: the column radius is 'nan', which is not finite; expected a finite "
                   "number"},
        Bad_tracks{"t,id,x,y,radius\n0,a,1,2,1\n0,b,2,2,2\n1,a,1,2,1\n1,b,2,2,1\n",
                   "t.csv:5: id 'b' has the radius 1, but 2 in line 3; expected one radius for "
                   "each id"},
        Bad_tracks{"t,id,x,y,radius,radius\n",
                   "t.csv:1: the column radius is named twice; expected a header line with the "
                   "columns t,id,x,y and optionally radius, in any order"}));

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
        Bad_tracks{"0 a 1 inf\n",
                   "t.csv:1: the column y is 'inf', which is not finite; expected a finite number"},
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

TEST(Read_tracks, stream_that_fails_is_an_error_and_not_the_end) {
  for (const auto& [text, format] :
       {std::pair{"t,id,x,y\n", Tracks_format::rows}, {"0 a 1 2\n", Tracks_format::frames}}) {
    Breaking_buffer buffer(text);
    std::istream in(&buffer);
    EXPECT_EQ(
        message_of<Input_error>([&, format = format] { read_tracks(in, "t.csv", format, 25); }),
        "t.csv:1: reading failed; expected a readable file of tracks");
  }
}

TEST(Read_tracks, stream_that_has_failed_before_is_not_an_empty_file) {
  std::ifstream in;
  in.setstate(std::ios::failbit);
  EXPECT_EQ(message_of<Input_error>([&] { read_tracks(in, "t.csv", Tracks_format::frames, 25); }),
            "t.csv:1: reading failed; expected a readable file of tracks");
}

TEST(Read_tracks, quoted_ids_are_printable_and_short) {
  EXPECT_NE(rows_error("t,id,x,y\n0,\x1b[2J,0,0\n0,\x1b[2J,1,0\n").find(R"(id '\x1b[2J' is)"),
            std::string::npos);
  const std::string id(100'000, 'a');
  EXPECT_NE(frames_error("0 " + id + " 0 0\n0 " + id + " 1 0\n")
                .find("id '" + std::string(40, 'a') + "...' is"),
            std::string::npos);
}

}  // namespace
}  // namespace kinetri::tracks_file_errors_test
