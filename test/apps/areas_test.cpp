// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options --areas and --mean-areas from outside.
#include <string>

#include "apps/program_test.h"
#include "support/text.h"

namespace kinetri::areas_test {
namespace {

using test::Arguments;
using test::count;
using test::Outcome;

class Areas : public test::Program_test {
 protected:
  void SetUp() override {
    write("square.wkt", "GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0)))\n");
    // The line between the two goes from x = 1 to x = 2 in two units of time.
    write("p.csv", "x,y,vx,vy\n0.5,2,0,0\n1.5,2,1,0\n");
  }

  std::string areas(const std::string& file, Arguments more) const {
    more.insert(more.begin(), {file == "p.csv" ? "simulate" : "tracks", file, "--quiet"});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }
};

constexpr const char* header = "t,id,area,density\n";
constexpr const char* with_labels = "t,id,area,density,label\n";

TEST_F(Areas, are_those_of_each_frame) {
  EXPECT_EQ(
      areas("p.csv", {"--until", "2", "--areas", "-", "--walkable", "square.wkt", "--fps", "1"}),
      std::string(header) +
          "0,0,4,0.25\n0,1,12,0.08333333333333333\n1,0,6,0.16666666666666666\n1,1,10,0.1\n"
          "2,0,8,0.125\n2,1,8,0.125\n");
}

TEST_F(Areas, are_a_hundred_and_one_frames_without_a_rate) {
  areas("p.csv", {"--until", "2", "--areas", "a.csv", "--walkable", "square.wkt"});
  EXPECT_EQ(count(read("a.csv"), "\n"), 203U);
}

TEST_F(Areas, of_points_outside_are_zero_without_a_density) {
  EXPECT_EQ(areas("p.csv", {"--until", "4", "--from", "4", "--areas", "-", "--walkable",
                            "square.wkt", "--cutoff", "1e9"}),
            std::string(header) + "4,0,12,0.08333333333333333\n4,1,0,\n");
}

TEST_F(Areas, within_a_distance_need_no_walls) {
  const std::string rows =
      areas("p.csv", {"--until", "0", "--areas", "-", "--cutoff", "0.5", "--fps", "1"});
  EXPECT_EQ(rows.rfind(std::string(header) + "0,0,0.785398163397448", 0), 0U) << rows;
}

// Frames of the file are frames of the table. b comes at frame 2 and leaves at frame 4: just after
// the time of that frame it is not there.
TEST_F(Areas, of_tracks_of_frames_are_at_these_frames) {
  const std::string tracks = "# frame id x y\n7 a 1 2\n13 a 1 2\n9 b 3 2\n11 b 3 2\n";
  write("t.txt", tracks);
  const Arguments options = {"--format", "frames", "--fps",      "30",
                             "--areas",  "-",      "--walkable", "square.wkt"};
  EXPECT_EQ(areas("t.txt", options),
            std::string(with_labels) + "0.23333333333333334,0,16,0.0625,a\n" +
                "0.26666666666666666,0,16,0.0625,a\n" + "0.3,0,8,0.125,a\n0.3,1,8,0.125,b\n" +
                "0.3333333333333333,0,8,0.125,a\n0.3333333333333333,1,8,0.125,b\n" +
                "0.36666666666666664,0,16,0.0625,a\n" + "0.4,0,16,0.0625,a\n");
  Arguments more = options;
  more.insert(more.end(), {"--frames-per-time", "10", "--from", "0.25"});
  EXPECT_EQ(areas("t.txt", more),
            std::string(with_labels) + "0.25,0,16,0.0625,a\n0.35,0,8,0.125,a\n0.35,1,8,0.125,b\n");
}

TEST_F(Areas, have_means_over_the_stay_of_each_point) {
  areas("p.csv", {"--until", "2", "--mean-areas", "m.csv", "--walkable", "square.wkt"});
  const std::string rows = read("m.csv");
  const std::string first = "id,from,until,area,error\n0,0,2,";
  ASSERT_EQ(rows.rfind(first, 0), 0U) << rows;
  EXPECT_NEAR(std::stod(rows.substr(first.size())), 6, 1e-9);
  const std::size_t second = rows.find("\n1,0,2,");
  ASSERT_NE(second, std::string::npos) << rows;
  EXPECT_NEAR(std::stod(rows.substr(second + 7)), 10, 1e-9);
}

TEST_F(Areas, of_points_with_labels_have_them) {
  write("p.csv", "x,y,vx,vy,id\n0.5,2,0,0,left\n1.5,2,1,0,\"right, moving\"\n");
  EXPECT_EQ(
      areas("p.csv", {"--until", "0", "--areas", "-", "--walkable", "square.wkt", "--fps", "1"}),
      std::string(with_labels) + "0,0,4,0.25,left\n0,1,12,0.08333333333333333,\"right, moving\"\n");
  areas("p.csv", {"--until", "1", "--mean-areas", "m.csv", "--walkable", "square.wkt"});
  const std::string means = read("m.csv");
  EXPECT_EQ(means.rfind("id,from,until,area,error,label\n0,0,1,", 0), 0U) << means;
  EXPECT_NE(means.find(",left\n1,0,1,"), std::string::npos) << means;
  EXPECT_NE(means.find(",\"right, moving\"\n"), std::string::npos) << means;
}

// As the rows of one long run, from the time of the checkpoint on.
TEST_F(Areas, go_on_after_a_checkpoint) {
  run({"simulate", "p.csv", "--until", "1", "--checkpoint", "state", "--quiet"});
  const Outcome outcome = run({"resume", "state", "--until", "2", "--areas", "-", "--mean-areas",
                               "m.csv", "--walkable", "square.wkt", "--fps", "1", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, std::string(header) +
                             "1,0,6,0.16666666666666666\n1,1,10,0.1\n2,0,8,0.125\n2,1,8,0.125\n");
  const std::string first = "id,from,until,area,error\n0,1,2,";
  ASSERT_EQ(read("m.csv").rfind(first, 0), 0U) << read("m.csv");
  EXPECT_NEAR(std::stod(read("m.csv").substr(first.size())), 7, 1e-9);
}

TEST_F(Areas, need_walls_or_a_distance) {
  write("t.csv", "t,id,x,y\n0,a,1,1\n1,a,2,2\n");
  for (const Arguments& command :
       {Arguments{"simulate", "p.csv", "--until", "1"}, Arguments{"tracks", "t.csv"}}) {
    for (const std::string option : {"--areas", "--mean-areas"}) {
      Arguments arguments = command;
      arguments.insert(arguments.end(), {option, "a.csv"});
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_NE(outcome.err.find(option + ": cells of points on the convex hull are unbounded; "
                                          "expected --walkable FILE, or --cutoff R"),
                std::string::npos)
          << outcome.err;
      EXPECT_FALSE(exists("a.csv"));
    }
  }
}

TEST_F(Areas, do_not_take_the_place_of_the_walkable_area) {
  const Outcome outcome = run(
      {"simulate", "p.csv", "--until", "1", "--areas", "square.wkt", "--walkable", "square.wkt"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--areas: square.wkt is the input; expected another file"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace kinetri::areas_test
