// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of points: what is read is exactly what is written there, and everything else is an error
// that says where.
#include "kinetri/io/points_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"
#include "support/temporary_directory.h"

namespace kinetri {
namespace {

using test::Temporary_directory;
using test::write_file;

Points_file read(const std::string& text) {
  std::istringstream in(text);
  return read_points(in, "p.csv");
}

// The message of the error that `text` causes; empty if it is read.
std::string error_of(const std::string& text) {
  try {
    read(text);
    return "";
  } catch (const Input_error& error) {
    return error.what();
  }
}

double number(const std::string& text) {
  const Parsed_number parsed = parse_number(text);
  EXPECT_TRUE(parsed.problem.empty()) << text << " " << parsed.problem;
  return parsed.value;
}

// ---- numbers ----

TEST(Parse_number, reads_decimal_numbers) {
  EXPECT_EQ(number("0"), 0);
  EXPECT_EQ(number("12"), 12);
  EXPECT_EQ(number("+12"), 12);
  EXPECT_EQ(number("-1.5"), -1.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("1e3"), 1000);
  EXPECT_EQ(number("1E+3"), 1000);
  EXPECT_EQ(number("2.5e-1"), 0.25);
  EXPECT_EQ(number("00012"), 12);
}

TEST(Parse_number, reads_hexadecimal_numbers) {
  EXPECT_EQ(number("0x1.8p3"), 12);
  EXPECT_EQ(number("-0x1.8p3"), -12);
  EXPECT_EQ(number("+0X1.8P+3"), 12);
  EXPECT_EQ(number("0x10"), 16);
  EXPECT_EQ(number("0x.8"), 0.5);
  EXPECT_EQ(number("0xAbC.dEfp-4"), 0xABC.DEFp-4);
}

TEST(Parse_number, keeps_the_sign_of_zero) {
  EXPECT_FALSE(std::signbit(number("0.0")));
  EXPECT_TRUE(std::signbit(number("-0.0")));
  EXPECT_TRUE(std::signbit(number("-0x0p0")));
  EXPECT_EQ(number("0e999999999999"), 0);
}

TEST(Parse_number, reaches_the_ends_of_the_range) {
  EXPECT_EQ(number("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number("0x1.fffffffffffffp1023"), std::numeric_limits<double>::max());
  EXPECT_EQ(number("2.2250738585072014e-308"), std::numeric_limits<double>::min());
  EXPECT_EQ(number("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x1p-1074"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x1.23p-1060"), 0x1.23p-1060);
  // Just above half of the smallest number; exactly half, and below, would be 0.
  EXPECT_EQ(number("2.4703282292062328e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x.80000001p-1074"), std::numeric_limits<double>::denorm_min());
}

TEST(Parse_number, rejects_numbers_out_of_range) {
  for (const char* text :
       {"1e309", "-1e309", "1.8e308", "1e99999999999999999999", "0x1p1024", "-0x1p5000", "1e-400",
        "-1e-324", "1e-99999999999999999999", "0x1p-1080", "0x.0000001p-1060",
        "2.4703282292062327e-324", "0x.8p-1074", "0x1p-99999999999"}) {
    EXPECT_NE(parse_number(text).problem.find("is out of the range of binary64"), std::string::npos)
        << text << " gives " << parse_number(text).value << " " << parse_number(text).problem;
  }
}

TEST(Parse_number, rejects_numbers_that_are_not_finite) {
  for (const char* text : {"nan", "NaN", "-nan", "nan(1)", "inf", "-inf", "+Infinity", "INF"}) {
    EXPECT_EQ(parse_number(text).problem, "is not finite; expected a finite number") << text;
  }
}

TEST(Parse_number, rejects_other_text) {
  for (const char* text :
       {"",      "abc", "1x",   "1 ",   " 1",   "1,5",   "--1",      "+-1",   "-+1",
        "++1",   "0x",  "0x-1", "0x+1", "-0x",  "1e",    "1e+",      "0x1p",  ".",
        "-",     "+",   "-.",   "e5",   "1..5", "1.2.3", "0x.p1",    "1_000", "1'000",
        "0x0x1", "1f",  "0b1",  "infx", "nanx", "1e5e5", "0x1.8p3 x"}) {
    EXPECT_NE(parse_number(text).problem.find("is not a number"), std::string::npos) << text;
  }
  EXPECT_FALSE(parse_number(std::string("1\0", 2)).problem.empty());
  EXPECT_FALSE(parse_number("\xEF\xBB\xBF"
                            "1")
                   .problem.empty());
}

// The C library rounds correctly.
TEST(Parse_number, agrees_with_the_c_library) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    char text[64];
    // Few digits, enough digits, more digits than fit; and halfway cases in hexadecimal.
    for (const char* format : {"%.3g", "%.17g", "%.25g", "%a", "%.0f", "%.6a"}) {
      if (std::string(format) == "%.0f" && std::abs(value) > 1e40) continue;
      std::snprintf(text, sizeof text, format, value);
      const double expected = std::strtod(text, nullptr);
      if (!std::isfinite(expected) || expected == 0) continue;
      ASSERT_EQ(number(text), expected) << text;
    }
    std::snprintf(text, sizeof text, "0x%llx.%03llxp%d", static_cast<unsigned long long>(random()),
                  static_cast<unsigned long long>(random() % 4096),
                  static_cast<int>(random() % 2000) - 1100);
    const double expected = std::strtod(text, nullptr);
    if (!std::isfinite(expected) || expected == 0) continue;
    ASSERT_EQ(number(text), expected) << text;
  }
}

// ---- files that are right ----

TEST(Read_points, reads_rows_in_order) {
  const Points_file file = read("x,y,vx,vy\n1,2,3,4\n-5,0.5,0x1p-3,1e2\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{-5, 0.5}, {0.125, 100}, 0}));
  EXPECT_TRUE(file.radii.empty());
  EXPECT_EQ(file.lines, (std::vector<std::size_t>{2, 3}));
}

TEST(Read_points, takes_columns_in_any_order) {
  const Points_file file = read("vy,radius,x,vx,y\n4,9,1,3,2\n");
  ASSERT_EQ(file.motions.size(), 1U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.radii, std::vector<double>{9});
}

TEST(Read_points, reads_higher_derivatives) {
  const Points_file bent =
      read("x,y,vx,vy,jy,jx,ax,radius,ay\n1,2,3,4,8,7,5,0.5,6\n0,0,0,0,0,0,0,1,0\n");
  EXPECT_TRUE(bent.is_polynomial);
  EXPECT_TRUE(bent.motions.empty());
  ASSERT_EQ(bent.polynomial_motions.size(), 2U);
  EXPECT_EQ(bent.polynomial_motions[0], (Polynomial_motion_2{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 0}));
  EXPECT_EQ(bent.radii, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(bent.number_of_points(), 2U);
  EXPECT_EQ(read("x,y,vx,vy,ax,ay\n1,2,3,4,5,6\n").polynomial_motions[0],
            (Polynomial_motion_2{{1, 2}, {3, 4}, {5, 6}, {}, 0}));
  EXPECT_EQ(read("x,y,vx,vy,jx,jy\n1,2,3,4,5,6\n").polynomial_motions[0],
            (Polynomial_motion_2{{1, 2}, {3, 4}, {}, {5, 6}, 0}));
  EXPECT_FALSE(read("x,y,vx,vy\n1,2,3,4\n").is_polynomial);
  EXPECT_EQ(read("x,y,vx,vy,ax,ay\n1,2,3,4,5,6\n1,2,3,4,5,7\n").number_of_points(), 2U);
  EXPECT_EQ(error_of("x,y,vx,vy,ax,ay\n1,2,3,4,5,6\n\n1,2,3,4,5,6\n"),
            "p.csv:4: the point has the same place and derivatives as the one in line 2; expected "
            "points that differ in one of them: remove one or change its motion");
}

TEST(Read_points, skips_blank_lines_and_comments) {
  const Points_file file =
      read("# before, the header\n\n  \t\nx,y,vx,vy\n#1,2,3,4\n\n5,6,7,8\n   \n#\n1,2,3,4\n\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.lines, (std::vector<std::size_t>{7, 10}));
  EXPECT_EQ(file.motions[1].position.x, 1);
}

TEST(Read_points, tolerates_blanks_byte_order_mark_and_carriage_returns) {
  const Points_file file = read("\xEF\xBB\xBF x ,y\t, vx,vy \r\n 1 ,\t2, 3 ,4\r\n\r\n#\r\n5,6,7,8");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{5, 6}, {7, 8}, 0}));
}

// ---- files of other programs ----

TEST(Read_points, reads_what_r_writes) {
  // write.csv: names and row names in quotation marks; the latter have no name.
  const Points_file file =
      read("\"\",\"x\",\"y\",\"vx\",\"vy\"\n\"1\",1,2,3,4\n\"2\",5,6,7,1e-04\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{5, 6}, {7, 1e-4}, 0}));
  EXPECT_EQ(file.ignored_columns, std::vector<std::string>{"''"});
  EXPECT_TRUE(file.labels.empty());
}

TEST(Read_points, reads_what_pandas_writes) {
  // to_csv: an index without a name, and all columns of the frame.
  const Points_file file =
      read(",id,x,y,vx,vy,kind\n0,ada,1.0,2.0,3.0,4.0,\"walks, runs\"\n1,ben,5.0,6.0,7.0,8.0,\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.labels, (std::vector<std::string>{"ada", "ben"}));
  EXPECT_EQ(file.ignored_columns, (std::vector<std::string>{"''", "'kind'"}));
}

TEST(Read_points, reads_what_spreadsheets_write) {
  const Points_file file = read(
      "\xEF\xBB\xBFName;X;Y;VX;VY;Radius\r\n\"a;b\";\"1.5\"; 2 "
      ";3;4;0.5\r\n\"\"\"q\"\"\";5;6;7;8;1\r\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1.5, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.radii, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(file.ignored_columns, std::vector<std::string>{"'Name'"});
}

TEST(Read_points, keeps_the_column_id_as_labels) {
  const Points_file file =
      read("x,y,vx,vy,ID\n1,2,3,4,\"Ada, \"\"the\"\" first\"\n5,6,7,8, 7 \n1,2,0,0,7.0\n");
  EXPECT_EQ(file.labels, (std::vector<std::string>{"Ada, \"the\" first", "7", "7.0"}));
  EXPECT_TRUE(file.ignored_columns.empty());
  EXPECT_TRUE(read("x,y,vx,vy,id\n").labels.empty());
}

TEST(Read_points, names_of_ignored_columns_are_printable) {
  EXPECT_EQ(read("x,y,vx,vy,a\x1b[2J\n").ignored_columns,
            std::vector<std::string>{R"('a\x1b[2J')"});
}

TEST(Read_points, header_alone_means_no_points) {
  EXPECT_TRUE(read("x,y,vx,vy\n").motions.empty());
  EXPECT_TRUE(read("x,y,vx,vy").motions.empty());
  EXPECT_TRUE(read("# nothing yet\nx,y,vx,vy,radius\n\n").motions.empty());
}

TEST(Read_points, same_place_or_same_velocity_alone_is_allowed) {
  EXPECT_EQ(read("x,y,vx,vy\n1,2,3,4\n1,2,3,5\n1,2,0,4\n0,2,3,4\n1,0,3,4\n").motions.size(), 5U);
}

TEST(Read_points, subnormal_numbers_are_kept) {
  EXPECT_EQ(read("x,y,vx,vy\n5e-324,0,0,0\n").motions[0].position.x,
            std::numeric_limits<double>::denorm_min());
}

// More than one buffer of the reader, with lines of every length across its ends.
TEST(Read_points, reads_many_rows_of_varying_length) {
  std::ostringstream text;
  text << "x,y,vx,vy\n";
  constexpr std::size_t rows = 150'000;
  for (std::size_t i = 0; i < rows; ++i)
    text << i << std::string(i % 23, ' ') << ",-1,0," << 2 * i << '\n';
  ASSERT_GT(text.str().size(), std::size_t{3} << 20U);
  const Points_file file = read(text.str());
  ASSERT_EQ(file.motions.size(), rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto x = static_cast<double>(i);
    ASSERT_EQ(file.motions[i], (Linear_motion_2{{x, -1}, {0, 2 * x}, 0}));
    ASSERT_EQ(file.lines[i], i + 2);
  }
}

// A stream that gives one byte at a time.
class Trickle : public std::streambuf {
 public:
  explicit Trickle(std::string text) : text_(std::move(text)) {}

 protected:
  int_type underflow() override {
    if (next_ == text_.size()) return traits_type::eof();
    setg(&text_[next_], &text_[next_], &text_[next_] + 1);
    ++next_;
    return traits_type::to_int_type(*gptr());
  }

 private:
  std::string text_;
  std::size_t next_ = 0;
};

TEST(Read_points, reads_from_a_stream_that_gives_little_at_a_time) {
  Trickle buffer("x,y,vx,vy\r\n1,2,3,4\r\n5,6,7,8");
  std::istream in(&buffer);
  EXPECT_EQ(read_points(in, "p.csv").motions.size(), 2U);
}

// ---- files that are wrong ----

struct Bad_file {
  const char* text;
  const char* message;
};

class Bad_points_file : public testing::TestWithParam<Bad_file> {};

TEST_P(Bad_points_file, gives_line_problem_and_expectation) {
  EXPECT_EQ(error_of(GetParam().text), GetParam().message);
}

constexpr const char* number_expected =
    "expected a decimal or hexadecimal floating point number such as -1.5, 2e-3 or 0x1.8p3";

INSTANTIATE_TEST_SUITE_P(
    Header, Bad_points_file,
    testing::Values(
        Bad_file{
            "",
            "p.csv:1: the file is empty; expected a header line with the columns x,y,vx,vy and "
            "optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{
            "\n# only a comment\n",
            "p.csv:1: the file is empty; expected a header line with the columns x,y,vx,vy and "
            "optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,vx\n1,2,3\n",
                 "p.csv:1: the column vy is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"# c\nx,y,vx,x,vy\n",
                 "p.csv:2: the column x is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"# c\nx,y,vx,X,vy\n",
                 "p.csv:2: the column x is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"ID,x,y,vx,vy,id\n",
                 "p.csv:1: the column id is named twice; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"x;y;vx\n",
                 "p.csv:1: the column vy is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        // A comma in the header: then semicolons separate nothing.
        Bad_file{"x;y;vx,vy\n",
                 "p.csv:1: the column x is missing; expected a header line with the columns "
                 "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,\"vx,vy\n",
                 "p.csv:1: a quotation mark is not closed: '\"vx,vy'; expected a second one on the "
                 "same line"},
        Bad_file{"x;y;vx;vy;1.5\n",
                 "p.csv:1: unknown column '1.5'; expected a header line with the columns x,y,vx,vy "
                 "and optionally radius, ax,ay, jx,jy, in any order"},
        Bad_file{"x,y,vx,vy,ax\n",
                 "p.csv:1: the column ay is missing; expected both ax and ay, or neither"},
        Bad_file{"x,y,vx,vy,ax,ay,jy\n",
                 "p.csv:1: the column jx is missing; expected both jx and jy, or neither"},
        Bad_file{"1,2,3,4\n",
                 "p.csv:1: unknown column '1'; expected a header line with the columns x,y,vx,vy "
                 "and optionally radius, ax,ay, jx,jy, in any order"}));

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
                 "p.csv:2: the radius -0.5 is negative; expected at least 0"}));

TEST(Read_points, text_that_is_no_number_is_quoted) {
  EXPECT_EQ(
      error_of("x,y,vx,vy\n1,2,3 m/s,4\n"),
      std::string("p.csv:2: the column vx is '3 m/s', which is not a number; ") + number_expected);
  EXPECT_EQ(
      error_of("x,y,vx,vy\n1,2,3,4\"\n"),
      std::string("p.csv:2: the column vy is '4\"', which is not a number; ") + number_expected);
}

TEST(Read_points, quoted_text_is_printable_and_short) {
  EXPECT_NE(error_of(std::string("x,y,vx,vy\n1,2,3,4\0\x1b[2J\n", 22)).find(R"('4\x00\x1b[2J')"),
            std::string::npos);
  const std::string wide = std::string(39, 'a') + "\xC3\xA4\xC3\xA4";
  EXPECT_NE(error_of("x,y,vx,vy\n" + wide + ",2,3,4\n").find("'" + std::string(39, 'a') + "...'"),
            std::string::npos);
  EXPECT_LT(error_of("x,y,vx,vy\n" + std::string(100'000, '7') + "x,2,3,4\n").size(), 250U);
}

TEST(Read_points, overlong_line_is_an_error) {
  const std::string digits(std::size_t{1} << 20U, '1');
  EXPECT_EQ(error_of("x,y,vx,vy\n1,2,3,4\n" + digits + digits + digits),
            "p.csv:3: the line is longer than 1048576 bytes; expected one point a line");
  EXPECT_EQ(error_of("x,y,vx,vy\n#" + digits + "\n"),
            "p.csv:2: the line is longer than 1048576 bytes; expected one point a line");
  const std::string blanks((std::size_t{1} << 20U) - 7, ' ');
  EXPECT_EQ(error_of("x,y,vx,vy\n1,2,3," + blanks + "4\n"), "");
}

TEST(Read_points, binary_input_is_an_error) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string noise;
    for (int k = 0; k < 200; ++k) noise += static_cast<char>(random());
    EXPECT_NE(error_of(noise), "");
    EXPECT_NE(error_of("x,y,vx,vy\n" + noise), "");
  }
}

TEST(Read_points, equal_points_name_both_lines) {
  EXPECT_EQ(error_of("x,y,vx,vy\n1,2,3,4\n\n5,6,7,8\n1.0,2,0x3,4e0\n"),
            "p.csv:5: the point has the same place and velocity as the one in line 2; expected "
            "points that differ in one of them: remove one or change its motion");
  EXPECT_NE(error_of("x,y,vx,vy\n0,0,-0,0\n1,1,1,1\n-0,-0,0,-0.0\n")
                .find("p.csv:4: the point has the same place and velocity as the one in line 2"),
            std::string::npos);
}

TEST(Read_points, of_several_equal_points_the_first_repetition_is_named) {
  EXPECT_NE(error_of("x,y,vx,vy\n9,9,9,9\n1,1,1,1\n2,2,2,2\n2,2,2,2\n1,1,1,1\n9,9,9,9\n2,2,2,2\n")
                .find("p.csv:5: the point has the same place and velocity as the one in line 4"),
            std::string::npos);
}

TEST(Read_points, equal_radii_do_not_make_points_differ) {
  EXPECT_NE(error_of("x,y,vx,vy,radius\n1,2,3,4,5\n1,2,3,4,6\n"), "");
}

// Quadratic behavior would take minutes.
TEST(Read_points, many_points_with_equal_coordinates_are_read_quickly) {
  std::ostringstream text;
  text << "x,y,vx,vy\n";
  for (int i = 0; i < 200'000; ++i) text << "1,2,3," << i << '\n';
  EXPECT_EQ(read(text.str()).motions.size(), 200'000U);
}

// A stream that breaks after its first line.
class Failing_buffer : public std::streambuf {
 protected:
  int_type underflow() override {
    if (first_) {
      first_ = false;
      setg(text_, text_, text_ + sizeof text_ - 1);
      return traits_type::to_int_type(*gptr());
    }
    throw std::runtime_error("the disk is gone");
  }

 private:
  bool first_ = true;
  char text_[11] = "x,y,vx,vy\n";
};

TEST(Read_points, stream_that_fails_is_an_error_and_not_the_end) {
  Failing_buffer buffer;
  std::istream in(&buffer);
  try {
    read_points(in, "p.csv");
    FAIL() << "no error";
  } catch (const Input_error& error) {
    EXPECT_STREQ(error.what(), "p.csv:1: reading failed; expected a readable file of points");
  }
}

// ---- paths ----

TEST(Read_points_file, reads_a_file) {
  const Temporary_directory directory;
  write_file(directory.file("p.csv"), "x,y,vx,vy\n1,2,3,4\n");
  EXPECT_EQ(read_points_file(directory.file("p.csv")).motions.size(), 1U);
}

TEST(Read_points_file, bad_paths_are_named) {
  const Temporary_directory directory;
  const auto message = [](const std::string& path) {
    try {
      read_points_file(path);
    } catch (const Input_error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message(directory.path()),
            directory.path().string() + ": is a directory; expected a file of points");
  EXPECT_EQ(
      message(directory.file("missing.csv")),
      directory.file("missing.csv") +
          ": cannot be opened: No such file or directory; expected a readable file of points");
  EXPECT_NE(message(""), "no error");
  if (::geteuid() == 0) return;  // who may read everything
  write_file(directory.file("secret.csv"), "x,y,vx,vy\n");
  std::filesystem::permissions(directory.file("secret.csv"), std::filesystem::perms::none);
  EXPECT_NE(message(directory.file("secret.csv")).find("Permission denied"), std::string::npos);
}

// ---- writing ----

TEST(Write_points, writes_the_shortest_numbers) {
  std::ostringstream out;
  const std::vector<Linear_motion_2> motions = {{{0.1, -2}, {1e-5, 1e300}, 0}, {{0, -0.0}, {}, 0}};
  write_points(out, motions);
  EXPECT_EQ(out.str(), "x,y,vx,vy\n0.1,-2,1e-05,1e+300\n0,-0,0,0\n");
}

TEST(Write_points, read_gives_the_same_numbers_back) {
  std::mt19937_64 random(11);
  const auto any = [&random] {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  std::vector<Linear_motion_2> motions;
  std::vector<double> radii;
  for (int i = 0; i < 5000; ++i) {
    motions.push_back({{any(), any()}, {any(), any()}, 0});
    radii.push_back(std::abs(any()));
  }
  std::ostringstream out;
  write_points(out, motions, radii);
  const Points_file file = read(out.str());
  EXPECT_EQ(file.motions, motions);
  EXPECT_EQ(file.radii, radii);
}

TEST(Write_points, writes_higher_derivatives) {
  const std::vector<Polynomial_motion_2> motions = {{{1, 2}, {3, 4}, {-0.0, 0.1}, {1e-300, 8}, 0},
                                                    {}};
  std::ostringstream out;
  write_points(out, motions);
  EXPECT_EQ(out.str(), "x,y,vx,vy,ax,ay,jx,jy\n1,2,3,4,-0,0.1,1e-300,8\n0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(read(out.str()).polynomial_motions, motions);
}

TEST(Write_points, what_the_format_cannot_hold_throws) {
  std::ostringstream out;
  EXPECT_PRECONDITION_ERROR(
      write_points(out, std::vector<Linear_motion_2>{{{0, 0}, {0, 0}, 1}}),
      "a motion has a number that is not finite, or begins at another time than 0");
  EXPECT_PRECONDITION_ERROR(
      write_points(out, std::vector<Linear_motion_2>{{{INFINITY, 0}, {0, 0}, 0}}),
      "a motion has a number that is not finite, or begins at another time than 0");
  EXPECT_PRECONDITION_ERROR(
      write_points(out, std::vector<Linear_motion_2>(2), std::vector<double>(1)),
      "there are not as many radii as points; expected one for each, or none");
}

}  // namespace
}  // namespace kinetri
