// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri tracks` from outside: what becomes of observations, messages, and real tracks.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::tracks_command_test {
namespace {

using test::Arguments;
using test::Outcome;

class Tracks : public test::Program_test {
 protected:
  Outcome tracks(const std::string& text, Arguments more = {}) const {
    write("t.csv", text);
    more.insert(more.begin(), {"tracks", "t.csv"});
    return run(more);
  }
};

// Three that stay, and one that comes, turns, rests and goes.
constexpr const char* one_visitor =
    "t,id,x,y\n"
    "0,a,0,0\n0,b,9,0\n0,c,0,9\n"
    "1,visitor,1,1\n2,visitor,3,1\n4,visitor,3,1\n5,visitor,1,4\n"
    "10,a,0,0\n10,b,9,0\n10,c,0,9\n";

TEST_F(Tracks, come_turn_and_go) {
  const Outcome outcome =
      tracks(one_visitor, {"--events", "events.csv", "--ids", "ids.csv", "--edges", "edges.csv",
                           "--initial-edges", "initial.csv", "--stats", "stats.json", "--audit",
                           "events", "--until", "9"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read("ids.csv"), "point,id,first,last\n0,a,0,10\n1,b,0,10\n2,c,0,10\n3,visitor,1,5\n");
  EXPECT_EQ(read("initial.csv"), "a,b\n0,1\n0,2\n1,2\n");
  EXPECT_EQ(read("edges.csv"), "a,b\n0,1\n0,2\n1,2\n");
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["points"], 4);
  EXPECT_EQ(stats["from"], 0);
  EXPECT_EQ(stats["until"], 9);
  EXPECT_EQ(stats["events"]["insert"], 1);
  EXPECT_EQ(stats["events"]["trajectory"], 2);
  EXPECT_EQ(stats["events"]["erase"], 1);
  EXPECT_EQ(stats["audits"]["failed"], 0);
  const std::string events = read("events.csv");
  EXPECT_NE(events.find("0,insert,1,1,1,,,,,3,,0\n"), std::string::npos) << events;
  EXPECT_NE(events.find(",erase,5,5,5,,,,,3,,"), std::string::npos) << events;
  EXPECT_NE(outcome.err.find("10 observations of 4 ids, 4 stays"), std::string::npos)
      << outcome.err;
}

TEST_F(Tracks, end_at_the_last_observation) {
  const Outcome outcome = tracks(one_visitor, {"--stats", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(stats["until"], 10);
  EXPECT_EQ(stats["events"]["erase"], 4);
}

TEST_F(Tracks, may_be_cut_by_time_and_by_gaps) {
  const Outcome outcome = tracks(
      one_visitor, {"--from", "1.5", "--until", "4.5", "--max-gap", "1", "--ids", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  // The others are seen only at the two ends, which is too far apart.
  EXPECT_EQ(outcome.out, "point,id,first,last\n0,visitor,1,2\n1,visitor,4,5\n");
}

TEST_F(Tracks, tell_what_was_left_out) {
  const Outcome outcome = tracks("t,id,x,y\n2,a,1,0\n1,a,0,0\n1,a,0,0\n5,once,3,3\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 row left out, being a copy of another"), std::string::npos);
  EXPECT_NE(outcome.err.find("1 row out of the order of time"), std::string::npos);
  EXPECT_NE(outcome.err.find("1 id left out, having one observation"), std::string::npos)
      << outcome.err;
}

TEST_F(Tracks, that_are_empty_are_a_run_of_nothing) {
  const Outcome outcome = tracks("t,id,x,y\n", {"--edges", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "a,b\n");
}

TEST_F(Tracks, print_the_closest_approaches) {
  const Outcome outcome = tracks(
      "t,id,x,y\n0,left,0,0\n10,left,10,0\n0,right,10,3\n10,right,-10,3\n0,far,0,90\n10,far,0,90\n",
      {"--closest", "2", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("id_a,id_b,time,time_lo,time_hi,distance\n"
                              "left,right,3.3333333333333335,3.333333333333333,"
                              "3.3333333333333335,3\n",
                              0),
            0u)
      << outcome.out;
}

// Two that are together for one moment count as such in all answers that are about distances, and
// in none that is about edges.
TEST_F(Tracks, tell_the_same_of_things_that_are_together_for_one_moment) {
  const std::string data = "t,id,x,y\n0,a,0,0\n2,a,0,0\n2,b,0,1\n5,b,0,1\n0,c,9,0\n5,c,9,0\n";
  const auto answer = [&](const Arguments& options) {
    const Outcome outcome = tracks(data, options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_EQ(answer({"--closest", "1", "--quiet"}),
            "id_a,id_b,time,time_lo,time_hi,distance\na,b,2,2,2,1\n");
  EXPECT_EQ(answer({"--encounters", "-", "--range", "1", "--quiet"}),
            "a,b,begin_lo,begin_hi,end_lo,end_hi,closest_lo,closest_hi,distance,label_a,label_b\n"
            "0,2,2,2,2,2,2,2,1,a,b\n");
  EXPECT_EQ(answer({"--connected", "-", "--range", "1", "--between", "a,b", "--quiet"}),
            "a,b,begin_lo,begin_hi,end_lo,end_hi\na,b,2,2,2,2\n");
  EXPECT_NE(answer({"--components", "-", "--range", "1", "--quiet"}).find("2,2,merge,0,2"),
            std::string::npos);
  EXPECT_EQ(answer({"--neighbors", "-", "--quiet"}).find("\n0,2,"), std::string::npos);
  EXPECT_EQ(answer({"--nearest", "-", "--quiet"}).find("2,2,0,1,2\n"), std::string::npos);
}

// The centers of a and b are nearer to each other, the rims of c and d are.
TEST_F(Tracks, print_the_closest_approaches_of_discs_with_their_gaps) {
  const std::string discs =
      "t,id,x,y,radius\n0,a,0,0,1\n8,a,4,0,1\n0,b,10,0,2\n8,b,10,0,2\n"
      "0,c,0,90,3\n8,c,4,90,3\n0,d,12,90,6\n8,d,12,90,6\n";
  const Outcome outcome = tracks(discs, {"--collisions", "log", "--closest", "2", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "id_a,id_b,time,time_lo,time_hi,distance,gap\n"
            "c,d,8,8,8,8,-1\n"
            "a,b,8,8,8,6,3\n");
  // Where nothing touches a disc, distances are those of points.
  const Outcome points = tracks(discs, {"--closest", "1", "--quiet"});
  EXPECT_EQ(points.out, "id_a,id_b,time,time_lo,time_hi,distance\na,b,8,8,8,6\n");
}

TEST_F(Tracks, log_contacts_of_discs) {
  const Outcome outcome =
      tracks("t,id,x,y\n0,a,0,0\n10,a,10,0\n0,b,8,0\n10,b,8,0\n",
             {"--collisions", "log", "--radius", "1", "--events", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("collision,6,6,6,,,,,0,1,"), std::string::npos) << outcome.out;
}

TEST_F(Tracks, are_recognized_by_their_content) {
  const Outcome outcome = tracks(
      "# framerate: 4\n# id frame x/cm y/cm z/cm\n7 0 0 0 170\n7 4 100 0 170\n8 0 0 900 "
      "160\n8 4 100 900 160\n",
      {"--ids", "-", "--stats", "stats.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "point,id,first,last\n0,7,0,1\n1,8,0,1\n");
  for (const char* remark : {"format ids", "4 frames a second, as the file says",
                             "places are in meters; the file has centimeters"}) {
    EXPECT_NE(outcome.err.find(remark), std::string::npos) << outcome.err;
  }
}

TEST_F(Tracks, of_a_table_have_columns_with_names) {
  const Outcome outcome = tracks(
      "when;who;E;N\n2024-05-01T12:00:00Z;\"Ada, Ben\";0;0\n2024-05-01T12:00:02.5Z;\"Ada, "
      "Ben\";3;4\n",
      {"--columns", "t=when,id=who,x=E,y=N", "--ids", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "point,id,first,last\n0,\"Ada, Ben\",0,2.5\n");
  EXPECT_NE(outcome.err.find("t = 0 is 2024-05-01T12:00:00Z, the earliest date"), std::string::npos)
      << outcome.err;
}

// ---- real tracks ----

class Crowd : public Tracks, public testing::WithParamInterface<const char*> {};

TEST_P(Crowd, runs_whole_audited) {
  const std::filesystem::path data =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam();
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not there";
  const Outcome outcome =
      run({"tracks", data.string(), "--format", "frames", "--fps", "25", "--audit", "end",
           "--closest", "3", "--stats", "stats.json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_EQ(stats["events"]["erase"], stats["points"]);
  EXPECT_GT(stats["events"]["flip"], 500);
  EXPECT_EQ(stats["audits"]["failed"], 0);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4);
}

TEST_P(Crowd, is_recognized) {
  const std::filesystem::path data =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / GetParam();
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is not there";
  const Outcome outcome =
      run({"tracks", data.string(), "--fps", "25", "--closest", "3", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, run({"tracks", data.string(), "--format", "frames", "--fps", "25",
                              "--closest", "3", "--quiet"})
                             .out);
}

INSTANTIATE_TEST_SUITE_P(Files, Crowd, testing::Values("students003.txt", "biwi_eth.txt"));

}  // namespace
}  // namespace kinetri::tracks_command_test
