// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of points: what is read is exactly what is written there. What is no such file:
// points_file_errors_test.cpp.
#include "kinetri/io/points_file.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "support/points_text.h"
#include "support/precondition_error.h"
#include "support/temporary_directory.h"
#include "support/wrong_input.h"

namespace kinetri::points_file_test {
namespace {

using test::points_of;
using test::Temporary_directory;
using test::write_file;

// ---- files that are right ----

TEST(Read_points, reads_rows_in_order) {
  const Points_file file = points_of("x,y,vx,vy\n1,2,3,4\n-5,0.5,0x1p-3,1e2\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{-5, 0.5}, {0.125, 100}, 0}));
  EXPECT_TRUE(file.radii.empty());
  EXPECT_EQ(file.lines, (std::vector<std::size_t>{2, 3}));
}

TEST(Read_points, takes_columns_in_any_order) {
  const Points_file file = points_of("vy,radius,x,vx,y\n4,9,1,3,2\n");
  ASSERT_EQ(file.motions.size(), 1U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.radii, std::vector<double>{9});
}

TEST(Read_points, reads_discs) {
  const Points_file file =
      points_of("x,mass,y,Growth,vx,vy,radius\n1,1e-3,2,-0.5,3,4,9\n5,7,6,0.25,7,8,0\n");
  EXPECT_EQ(file.radii, (std::vector<double>{9, 0}));
  EXPECT_EQ(file.growths, (std::vector<double>{-0.5, 0.25}));
  EXPECT_EQ(file.masses, (std::vector<double>{1e-3, 7}));
  EXPECT_TRUE(file.ignored_columns.empty());
  const Points_file grown = points_of("x,y,vx,vy,jx,jy,growth\n1,2,3,4,5,6,7\n");
  EXPECT_TRUE(grown.is_polynomial);
  EXPECT_EQ(grown.growths, std::vector<double>{7});
  EXPECT_TRUE(grown.radii.empty());
  EXPECT_TRUE(grown.masses.empty());
}

TEST(Read_points, reads_higher_derivatives) {
  const Points_file bent =
      points_of("x,y,vx,vy,jy,jx,ax,radius,ay\n1,2,3,4,8,7,5,0.5,6\n0,0,0,0,0,0,0,1,0\n");
  EXPECT_TRUE(bent.is_polynomial);
  EXPECT_TRUE(bent.motions.empty());
  ASSERT_EQ(bent.polynomial_motions.size(), 2U);
  EXPECT_EQ(bent.polynomial_motions[0], (Polynomial_motion_2{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 0}));
  EXPECT_EQ(bent.radii, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(bent.number_of_points(), 2U);
  EXPECT_EQ(points_of("x,y,vx,vy,ax,ay\n1,2,3,4,5,6\n").polynomial_motions[0],
            (Polynomial_motion_2{{1, 2}, {3, 4}, {5, 6}, {}, 0}));
  EXPECT_EQ(points_of("x,y,vx,vy,jx,jy\n1,2,3,4,5,6\n").polynomial_motions[0],
            (Polynomial_motion_2{{1, 2}, {3, 4}, {}, {5, 6}, 0}));
  EXPECT_FALSE(points_of("x,y,vx,vy\n1,2,3,4\n").is_polynomial);
  EXPECT_EQ(points_of("x,y,vx,vy,ax,ay\n1,2,3,4,5,6\n1,2,3,4,5,7\n").number_of_points(), 2U);
}

TEST(Read_points, takes_equal_points) {
  EXPECT_EQ(points_of("x,y,vx,vy\n1,2,3,4\n5,6,7,8\n1,2,3,4\n").number_of_points(), 3U);
  EXPECT_EQ(points_of("x,y,vx,vy,ax,ay,radius\n1,2,3,4,5,6,7\n1,2,3,4,5,6,7\n").radii,
            (std::vector<double>{7, 7}));
}

TEST(Read_points, skips_blank_lines_and_comments) {
  const Points_file file = points_of(
      "# before, the header\n\n  \t\nx,y,vx,vy\n#1,2,3,4\n\n5,6,7,8\n   \n#\n1,2,3,4\n\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.lines, (std::vector<std::size_t>{7, 10}));
  EXPECT_EQ(file.motions[1].position.x, 1);
}

TEST(Read_points, tolerates_blanks_byte_order_mark_and_carriage_returns) {
  const Points_file file =
      points_of("\xEF\xBB\xBF x ,y\t, vx,vy \r\n 1 ,\t2, 3 ,4\r\n\r\n#\r\n5,6,7,8");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{5, 6}, {7, 8}, 0}));
}

// ---- files of other programs ----

TEST(Read_points, reads_what_r_writes) {
  // write.csv: names and row names in quotation marks; the latter have no name.
  const Points_file file =
      points_of("\"\",\"x\",\"y\",\"vx\",\"vy\"\n\"1\",1,2,3,4\n\"2\",5,6,7,1e-04\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[1], (Linear_motion_2{{5, 6}, {7, 1e-4}, 0}));
  EXPECT_EQ(file.ignored_columns, std::vector<std::string>{"''"});
  EXPECT_TRUE(file.labels.empty());
}

TEST(Read_points, reads_what_pandas_writes) {
  // to_csv: an index without a name, and all columns of the frame.
  const Points_file file = points_of(
      ",id,x,y,vx,vy,kind\n0,ada,1.0,2.0,3.0,4.0,\"walks, runs\"\n1,ben,5.0,6.0,7.0,8.0,\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.labels, (std::vector<std::string>{"ada", "ben"}));
  EXPECT_EQ(file.ignored_columns, (std::vector<std::string>{"''", "'kind'"}));
}

TEST(Read_points, reads_what_spreadsheets_write) {
  const Points_file file = points_of(
      "\xEF\xBB\xBFName;X;Y;VX;VY;Radius\r\n\"a;b\";\"1.5\"; 2 "
      ";3;4;0.5\r\n\"\"\"q\"\"\";5;6;7;8;1\r\n");
  ASSERT_EQ(file.motions.size(), 2U);
  EXPECT_EQ(file.motions[0], (Linear_motion_2{{1.5, 2}, {3, 4}, 0}));
  EXPECT_EQ(file.radii, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(file.ignored_columns, std::vector<std::string>{"'Name'"});
}

TEST(Read_points, keeps_the_column_id_as_labels) {
  const Points_file file =
      points_of("x,y,vx,vy,ID\n1,2,3,4,\"Ada, \"\"the\"\" first\"\n5,6,7,8, 7 \n1,2,0,0,7.0\n");
  EXPECT_EQ(file.labels, (std::vector<std::string>{"Ada, \"the\" first", "7", "7.0"}));
  EXPECT_TRUE(file.ignored_columns.empty());
  EXPECT_TRUE(points_of("x,y,vx,vy,id\n").labels.empty());
}

TEST(Read_points, names_of_ignored_columns_are_printable) {
  EXPECT_EQ(points_of("x,y,vx,vy,a\x1b[2J\n").ignored_columns,
            std::vector<std::string>{R"('a\x1b[2J')"});
}

TEST(Read_points, header_alone_means_no_points) {
  EXPECT_TRUE(points_of("x,y,vx,vy\n").motions.empty());
  EXPECT_TRUE(points_of("x,y,vx,vy").motions.empty());
  EXPECT_TRUE(points_of("# nothing yet\nx,y,vx,vy,radius\n\n").motions.empty());
}

TEST(Read_points, same_place_or_same_velocity_alone_is_allowed) {
  EXPECT_EQ(points_of("x,y,vx,vy\n1,2,3,4\n1,2,3,5\n1,2,0,4\n0,2,3,4\n1,0,3,4\n").motions.size(),
            5U);
}

TEST(Read_points, subnormal_numbers_are_kept) {
  EXPECT_EQ(points_of("x,y,vx,vy\n5e-324,0,0,0\n").motions[0].position.x,
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
  const Points_file file = points_of(text.str());
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

// ---- paths ----

TEST(Read_points_file, reads_a_file) {
  const Temporary_directory directory;
  write_file(directory.file("p.csv"), "x,y,vx,vy\n1,2,3,4\n");
  EXPECT_EQ(read_points_file(directory.file("p.csv")).motions.size(), 1U);
}

TEST(Read_points_file, bad_paths_are_named) {
  test::expect_bad_paths_are_named("points",
                                   [](const std::string& path) { read_points_file(path); });
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
  std::vector<double> growths;
  std::vector<double> masses;
  for (int i = 0; i < 5000; ++i) {
    motions.push_back({{any(), any()}, {any(), any()}, 0});
    radii.push_back(std::abs(any()));
    growths.push_back(any());
    masses.push_back(std::abs(any()));
  }
  std::ostringstream out;
  write_points(out, motions, radii, growths, masses);
  const Points_file file = points_of(out.str());
  EXPECT_EQ(file.motions, motions);
  EXPECT_EQ(file.radii, radii);
  EXPECT_EQ(file.growths, growths);
  EXPECT_EQ(file.masses, masses);
}

TEST(Write_points, writes_higher_derivatives) {
  const std::vector<Polynomial_motion_2> motions = {{{1, 2}, {3, 4}, {-0.0, 0.1}, {1e-300, 8}, 0},
                                                    {}};
  std::ostringstream out;
  write_points(out, motions);
  EXPECT_EQ(out.str(), "x,y,vx,vy,ax,ay,jx,jy\n1,2,3,4,-0,0.1,1e-300,8\n0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(points_of(out.str()).polynomial_motions, motions);
}

TEST(Write_points, writes_the_columns_that_are_given) {
  const std::vector<Linear_motion_2> motions = {{{1, 2}, {3, 4}, 0}};
  const std::vector<double> numbers = {0.5};
  std::ostringstream growing;
  write_points(growing, motions, {}, numbers);
  EXPECT_EQ(growing.str(), "x,y,vx,vy,growth\n1,2,3,4,0.5\n");
  std::ostringstream heavy;
  write_points(heavy, std::vector<Polynomial_motion_2>(1), numbers, {}, numbers);
  EXPECT_EQ(heavy.str(), "x,y,vx,vy,ax,ay,jx,jy,radius,mass\n0,0,0,0,0,0,0,0,0.5,0.5\n");
}

TEST(Write_points, what_the_format_cannot_hold_throws) {
  std::ostringstream out;
  EXPECT_PRECONDITION_ERROR(
      write_points(out, std::vector<Linear_motion_2>{{{0, 0}, {0, 0}, 1}}),
      "a motion has a number that is not finite, or begins at another time than 0");
  EXPECT_PRECONDITION_ERROR(
      write_points(out, std::vector<Linear_motion_2>{{{INFINITY, 0}, {0, 0}, 0}}),
      "a motion has a number that is not finite, or begins at another time than 0");
  const std::vector<double> one(1);
  const std::vector<double> none;
  using Columns = std::array<std::vector<double>, 3>;
  for (const Columns& columns :
       {Columns{one, none, none}, Columns{none, one, none}, Columns{none, none, one}}) {
    EXPECT_PRECONDITION_ERROR(
        write_points(out, std::vector<Linear_motion_2>(2), columns[0], columns[1], columns[2]),
        "a column has not as many numbers as there are points; expected one for each, or none");
  }
}

}  // namespace
}  // namespace kinetri::points_file_test
