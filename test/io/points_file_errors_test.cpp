// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are no files of points: the error says where.
#include <gtest/gtest.h>

#include <cstddef>
#include <istream>
#include <random>
#include <sstream>
#include <string>

#include "kinetri/io/points_file.h"
#include "support/points_text.h"
#include "support/wrong_input.h"

namespace kinetri::points_file_errors_test {
namespace {

using test::points_error;
using test::points_of;

struct Bad_file {
  const char* text;
  const char* message;
};

class Bad_points_file : public testing::TestWithParam<Bad_file> {};

TEST_P(Bad_points_file, gives_line_problem_and_expectation) {
  EXPECT_EQ(points_error(GetParam().text), GetParam().message);
}

constexpr const char* number_expected =
    "expected a decimal or hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3";

INSTANTIATE_TEST_SUITE_P(
    Header, Bad_points_file,
    testing::Values(
        Bad_file{
            "",
            "p.csv:1: the file is empty; expected a header line with the columns x,y,vx,vy and "
            "optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{
            "\n# only a comment\n",
            "p.csv:1: the file is empty; expected a header line with the columns x,y,vx,vy and "
            "optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,vx\n1,2,3\n",
                 "p.csv:1: the column vy is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"# c\nx,y,vx,x,vy\n",
                 "p.csv:2: the column x is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"# c\nx,y,vx,X,vy\n",
                 "p.csv:2: the column x is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"ID,x,y,vx,vy,id\n",
                 "p.csv:1: the column id is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"x;y;vx\n",
                 "p.csv:1: the column vy is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        // A comma in the header: then semicolons separate nothing.
        Bad_file{"x;y;vx,vy\n",
                 "p.csv:1: the column x is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,\"vx,vy\n",
                 "p.csv:1: a quotation mark is not closed: '\"vx,vy'; expected a second one on the "
                 "same line"},
        Bad_file{"x;y;vx;vy;1.5\n",
                 "p.csv:1: unknown column '1.5'; expected a header line with the columns x,y,vx,vy "
                 "and optionally radius, growth, mass, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,vx,vy,ax\n",
                 "p.csv:1: the column ay is missing; expected both ax and ay, or neither"},
        Bad_file{"x,y,vx,vy,ax,ay,jy\n",
                 "p.csv:1: the column jx is missing; expected both jx and jy, or neither"},
        Bad_file{"1,2,3,4\n",
                 "p.csv:1: unknown column '1'; expected a header line with the columns x,y,vx,vy "
                 "and optionally radius, growth, mass, ax,ay, jx,jy, in any order"}));

INSTANTIATE_TEST_SUITE_P(
    Rows, Bad_points_file,
    testing::Values(
        Bad_file{"x,y,vx,vy\n1,2,3\n",
                 "p.csv:2: the row has 3 fields; expected 4, one for each column of the header"},
        Bad_file{"x,y,vx,vy\n1\n",
                 "p.csv:2: the row has 1 field; expected 4, one for each column of the header"},
        Bad_file{"x,y,vx,vy\n1,2,3,4,5\n",
                 "p.csv:2: the row has 5 fields; expected 4, one for each column of the header"},
        Bad_file{"x,y,vx,vy\n1,2,3,4,\n",
                 "p.csv:2: the row has 5 fields; expected 4, one for each column of the header"},
        Bad_file{"x,y,vx,vy\n\n1,,3,4\n", "p.csv:3: the column y is empty; expected a number"},
        Bad_file{"vy,x,y,vx\n1,2,3, \n", "p.csv:2: the column vx is empty; expected a number"},
        Bad_file{"x,y,vx,vy\n1,2,3,nan\n",
                 "p.csv:2: the column vy is 'nan', which is not finite; expected a finite number"},
        Bad_file{"x,y,vx,vy\n-inf,2,3,4\n",
                 "p.csv:2: the column x is '-inf', which is not finite; expected a finite number"},
        Bad_file{
            "x,y,vx,vy\n1,1e999,3,4\n",
            "p.csv:2: the column y is '1e999', which is out of the range of binary64; expected "
            "0, or a magnitude from 4.9e-324 to 1.8e308"},
        Bad_file{"x,y,vx,vy\n1,2,1e-999,4\n",
                 "p.csv:2: the column vx is '1e-999', which is out of the range of binary64; "
                 "expected 0, or a magnitude from 4.9e-324 to 1.8e308"},
        Bad_file{"x;y;vx;vy\n1;2;3\n",
                 "p.csv:2: the row has 3 fields; expected 4, one for each column of the header"},
        Bad_file{"x;y;vx;vy\n1;2;3;4\n1;2,5;3;4\n",
                 "p.csv:3: the column y is '2,5', with a decimal comma; expected a decimal point, "
                 "as in 1.5"},
        Bad_file{"x;y;vx;vy\n1;2;\"3,5\";4\n",
                 "p.csv:2: the column vx is '3,5', with a decimal comma; expected a decimal point, "
                 "as in 1.5"},
        Bad_file{"x,y,vx,vy\n\"1\",\"2,3,4\n",
                 "p.csv:2: a quotation mark is not closed: '\"2,3,4'; expected a second one on the "
                 "same line"},
        Bad_file{"x,y,vx,vy\n1,\"2\"5,3,4\n",
                 "p.csv:2: something stands behind a quoted field: '5'; expected ',' or the end of "
                 "the line"},
        Bad_file{"x,y,vx,vy\n1,\"\",3,4\n", "p.csv:2: the column y is empty; expected a number"},
        Bad_file{"id,x,y,vx,vy\na,1,2,3,4\n ,1,2,3,5\n",
                 "p.csv:3: the column id is empty; expected any text"},
        Bad_file{
            "x,y,vx,vy,id\n1,2,3,4,a\n\n5,6,7,8,b\n1,2,3,5,\"a\"\n",
            "p.csv:5: the column id is 'a', as in line 2; expected ids that differ, or another "
            "name of the column (where points have several rows, they are tracks)"},
        Bad_file{"x,y,vx,vy,radius\n1,2,3,4,-0.5\n",
                 "p.csv:2: the radius -0.5 is negative; expected at least 0"},
        Bad_file{"x,y,vx,vy,radius\n1,2,3,4,inf\n",
                 "p.csv:2: the column radius is 'inf', which is not finite; expected a finite "
                 "number"},
        Bad_file{"growth,x,y,vx,vy\n-1,0,0,0,0\nnan,1,2,3,4\n",
                 "p.csv:3: the column growth is 'nan', which is not finite; expected a finite "
                 "number"},
        Bad_file{"x,y,vx,vy,mass\n1,2,3,4,-2\n",
                 "p.csv:2: the mass -2 is not positive; expected more than 0"},
        Bad_file{"x,y,vx,vy,mass\n1,2,3,4,5\n1,2,3,5,0\n",
                 "p.csv:3: the mass 0 is not positive; expected more than 0"},
        Bad_file{"x,y,vx,vy,mass\n1,2,3,4,inf\n",
                 "p.csv:2: the column mass is 'inf', which is not finite; expected a finite "
                 "number"},
        Bad_file{"x,y,vx,vy,mass\n1,2,3,4,\n",
                 "p.csv:2: the column mass is empty; expected a number"},
        Bad_file{"x,y,vx,vy,mass,Mass\n",
                 "p.csv:1: the column mass is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"}));

TEST(Read_points, text_that_is_no_number_is_quoted) {
  EXPECT_EQ(
      points_error("x,y,vx,vy\n1,2,3 m/s,4\n"),
      std::string("p.csv:2: the column vx is '3 m/s', which is not a number; ") + number_expected);
  EXPECT_EQ(
      points_error("x,y,vx,vy\n1,2,3,4\"\n"),
      std::string("p.csv:2: the column vy is '4\"', which is not a number; ") + number_expected);
}

TEST(Read_points, quoted_text_is_printable_and_short) {
  EXPECT_NE(
      points_error(std::string("x,y,vx,vy\n1,2,3,4\0\x1b[2J\n", 22)).find(R"('4\x00\x1b[2J')"),
      std::string::npos);
  const std::string wide = std::string(39, 'a') + "\xC3\xA4\xC3\xA4";
  EXPECT_NE(
      points_error("x,y,vx,vy\n" + wide + ",2,3,4\n").find("'" + std::string(39, 'a') + "...'"),
      std::string::npos);
  EXPECT_LT(points_error("x,y,vx,vy\n" + std::string(100'000, '7') + "x,2,3,4\n").size(), 250U);
}

TEST(Read_points, overlong_line_is_an_error) {
  const std::string digits(std::size_t{1} << 20U, '1');
  EXPECT_EQ(points_error("x,y,vx,vy\n1,2,3,4\n" + digits + digits + digits),
            "p.csv:3: the line is longer than 1048576 bytes; expected one point a line");
  EXPECT_EQ(points_error("x,y,vx,vy\n#" + digits + "\n"),
            "p.csv:2: the line is longer than 1048576 bytes; expected one point a line");
  const std::string blanks((std::size_t{1} << 20U) - 7, ' ');
  EXPECT_EQ(points_error("x,y,vx,vy\n1,2,3," + blanks + "4\n"), "");
}

TEST(Read_points, binary_input_is_an_error) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string noise;
    for (int k = 0; k < 200; ++k) noise += static_cast<char>(random());
    EXPECT_NE(points_error(noise), "");
    EXPECT_NE(points_error("x,y,vx,vy\n" + noise), "");
  }
}

// Quadratic behavior would take minutes.
TEST(Read_points, many_labels_are_compared_quickly) {
  std::ostringstream text;
  text << "id,x,y,vx,vy\n";
  for (int i = 0; i < 200'000; ++i) text << i << ",1,2,3,4\n";
  EXPECT_EQ(points_of(text.str()).motions.size(), 200'000U);
}

TEST(Read_points, stream_that_fails_is_an_error_and_not_the_end) {
  test::Breaking_buffer buffer("x,y,vx,vy\n");
  std::istream in(&buffer);
  EXPECT_EQ(test::message_of<Input_error>([&in] { read_points(in, "p.csv"); }),
            "p.csv:1: reading failed; expected a readable file of points");
}

}  // namespace
}  // namespace kinetri::points_file_errors_test
