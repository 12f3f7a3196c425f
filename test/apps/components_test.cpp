// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program answers about connectivity.
#include <gtest/gtest.h>

#include <string>

#include "apps/program_test.h"

namespace kinetri::components_test {
namespace {

using test::Outcome;

class Components : public test::Program_test {};

constexpr const char* passing = "x,y,vx,vy\n0,0,0,0\n-5,3,1,0\n0,20,0,0\n";

TEST_F(Components, are_written_with_each_merge_and_split) {
  write("points.csv", passing);
  const Outcome touch = run(
      {"simulate", "points.csv", "--until", "20", "--components", "-", "--range", "3", "--quiet"});
  EXPECT_EQ(touch.exit_code, 0) << touch.err;
  EXPECT_EQ(touch.out,
            "time_lo,time_hi,kind,a,b,components,largest\n"
            "0,0,start,,,3,1\n"
            "5,5,merge,0,1,2,2\n"
            "5,5,split,0,1,3,1\n");
  const Outcome early = run({"simulate", "points.csv", "--until", "8", "--components", "-",
                             "--range", "5", "--checkpoint", "state", "--quiet"});
  EXPECT_EQ(early.out,
            "time_lo,time_hi,kind,a,b,components,largest\n"
            "0,0,start,,,3,1\n"
            "1,1,merge,0,1,2,2\n");
  const Outcome late =
      run({"resume", "state", "--until", "20", "--components", "-", "--range", "5", "--quiet"});
  EXPECT_EQ(late.out,
            "time_lo,time_hi,kind,a,b,components,largest\n"
            "8,8,start,,,2,2\n"
            "9,9,split,0,1,3,1\n");
}

TEST_F(Components, of_tracks_have_points_that_come_and_go) {
  write("tracks.csv", "t,id,x,y\n0,a,0,0\n9,a,0,0\n2,b,1,0\n4,b,1,0\n3,c,50,0\n9,c,50,0\n");
  const Outcome outcome =
      run({"tracks", "tracks.csv", "--components", "-", "--range", "2", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "time_lo,time_hi,kind,a,b,components,largest,label_a,label_b\n"
            "0,0,start,,,1,1,,\n"
            "2,2,insert,1,,2,1,b,\n"
            "2,2,merge,0,1,1,2,a,b\n"
            "3,3,insert,2,,2,2,c,\n"
            "4,4,split,0,1,3,1,a,b\n"
            "4,4,erase,1,,2,1,b,\n"
            "9,9,erase,0,,1,1,a,\n"
            "9,9,erase,2,,0,0,c,\n");
}

// The table of --connected has the names that it was asked for.
TEST_F(Components, of_points_with_labels_have_them) {
  write("points.csv", "x,y,vx,vy,id\n0,0,0,0,oak\n-5,3,1,0,fly\n0,20,0,0,elm\n");
  const Outcome outcome =
      run({"simulate", "points.csv", "--until", "6", "--components", "c.csv", "--spanning-tree",
           "s.csv", "--connected", "-", "--between", "0,1", "--range", "3", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read("c.csv"),
            "time_lo,time_hi,kind,a,b,components,largest,label_a,label_b\n"
            "0,0,start,,,3,1,,\n"
            "5,5,merge,0,1,2,2,oak,fly\n"
            "5,5,split,0,1,3,1,oak,fly\n");
  EXPECT_EQ(read("s.csv").substr(0, 75),
            "time_lo,time_hi,kind,a,b,length,label_a,label_b\n0,0,start,0,1,,oak,fly\n0,0,");
  EXPECT_EQ(outcome.out, "a,b,begin_lo,begin_hi,end_lo,end_hi\n0,1,5,5,5,5\n");
}

// At 5 - sqrt(12) and 5 + sqrt(12) the lengths of all three edges are 4.
TEST_F(Components, have_a_spanning_tree) {
  write("points.csv", "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n2,5,0,-1\n");
  const Outcome outcome =
      run({"simulate", "points.csv", "--until", "10", "--spanning-tree", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "time_lo,time_hi,kind,a,b,length\n"
            "0,0,start,0,1,\n"
            "0,0,start,0,2,\n"
            "0,0,longest,0,2,5.385164807134504\n"
            "1.5358983848622454,1.5358983848622456,remove,0,1,\n"
            "1.5358983848622454,1.5358983848622456,add,1,2,\n"
            "1.5358983848622454,1.5358983848622456,longest,1,2,4\n"
            "8.464101615137753,8.464101615137755,remove,1,2,\n"
            "8.464101615137753,8.464101615137755,add,0,1,\n"
            "8.464101615137753,8.464101615137755,longest,0,2,4\n"
            "5,5,least,1,2,2\n"
            "0,0,greatest,0,2,5.385164807134504\n");
}

// Point 2 links the other two from t = 2 to t = 8.
TEST_F(Components, tell_when_two_points_are_connected) {
  write("points.csv", "x,y,vx,vy\n0,0,0,0\n8,0,0,0\n4,-5,0,1\n");
  const Outcome outcome =
      run({"simulate", "points.csv", "--until", "10", "--connected", "-", "--between", "1,0",
           "--range", "5", "--between", "0,2", "--checkpoint", "state", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,begin_lo,begin_hi,end_lo,end_hi\n"
            "1,0,2,2,8,8\n"
            "0,2,2,2,8,8\n");
  run({"simulate", "points.csv", "--until", "4", "--checkpoint", "state", "--quiet"});
  const Outcome late = run({"resume", "state", "--until", "6", "--connected", "-", "--between",
                            "0,1", "--range", "5", "--quiet"});
  EXPECT_EQ(late.out, "a,b,begin_lo,begin_hi,end_lo,end_hi\n0,1,4,4,6,6\n") << late.err;
}

// `b` leaves at t = 4, and comes back at t = 6 as another point. It is never there with `d`.
TEST_F(Components, of_tracks_are_asked_by_label) {
  write("tracks.csv",
        "time;who;x;y\n0;\"a; or A\";0;0\n2;\"a; or A\";0;0\n4;\"a; or A\";0;0\n"
        "6;\"a; or A\";0;0\n8;\"a; or A\";0;0\n2;b;1;0\n4;b;1;0\n6;b;1;0\n7;b;9;0\n"
        "9;d;1;1\n10;d;1;1\n");
  const auto connected = [&](const test::Arguments& more) {
    test::Arguments arguments = {"tracks",    "tracks.csv",  "--columns", "t=time,id=who,x=x,y=y",
                                 "--max-gap", "2",           "--range",   "5",
                                 "--quiet",   "--connected", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  const std::string header = "a,b,begin_lo,begin_hi,end_lo,end_hi\n";
  const Outcome one = connected({"--between", "a; or A,b"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, header + "a; or A,b,2,2,6.5,6.5\n");
  const Outcome two = connected({"--max-gap", "1", "--between", "b,a; or A"});
  EXPECT_EQ(two.exit_code, 2) << two.out;
  const Outcome other = connected({"--between", "b,d", "--between", "\"b\", a; or A "});
  EXPECT_EQ(other.out, header + "b,a; or A,2,2,6.5,6.5\n") << other.err;
}

TEST_F(Components, of_tracks_with_gaps_are_those_of_all_stays) {
  write("tracks.csv",
        "t,id,x,y\n0,a,0,0\n1,a,0,0\n2,a,0,0\n3,a,0,0\n4,a,0,0\n5,a,0,0\n6,a,0,0\n"
        "1,b,1,0\n2,b,1,0\n4,b,1,0\n5,b,1,0\n9,c,1,0\n9.5,c,1,0\n");
  const Outcome outcome = run({"tracks", "tracks.csv", "--max-gap", "1.5", "--connected", "-",
                               "--between", "b,a", "--between", "c,a", "--range", "1", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "a,b,begin_lo,begin_hi,end_lo,end_hi\n"
            "b,a,1,1,2,2\n"
            "b,a,4,4,5,5\n");
}

TEST_F(Components, are_asked_for_by_pairs_that_there_are) {
  write("points.csv", passing);
  const auto expect_error = [&](const test::Arguments& more, const std::string& message) {
    test::Arguments arguments = {"simulate", "points.csv", "--until", "1", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("c.csv"));
  };
  expect_error({"--connected", "c.csv", "--between", "0,1"},
               "--connected: needs --range R; expected both");
  expect_error({"--connected", "c.csv", "--range", "1"},
               "--connected: needs --between A,B; expected both");
  expect_error({"--between", "0,1"}, "--between: no option uses it; expected --connected as well");
  const auto expect_bad = [&](const std::string& between, const std::string& message) {
    expect_error({"--connected", "c.csv", "--range", "1", "--between", between}, message);
  };
  expect_bad("0,3",
             "--between: there is no point '3' in points.csv; expected the number of a point");
  expect_bad("0,-1", "--between: there is no point '-1' in points.csv");
  expect_bad("99999999999999,1", "--between: there is no point '99999999999999' in points.csv");
  expect_bad("1,01", "--between: '1' and '01' are the same; expected two that differ");
  expect_bad("1", "--between: '1' is not a pair; expected two names separated by a comma");
  expect_bad("0,1,2", "--between: '0,1,2' is not a pair");
  expect_bad("0,", "--between: '0,' is not a pair");
  expect_bad("\"0,1", "--between: a quotation mark is not closed");
}

TEST_F(Components, need_a_range_and_points) {
  write("points.csv", passing);
  const Outcome no_range =
      run({"simulate", "points.csv", "--until", "1", "--components", "-", "--quiet"});
  EXPECT_EQ(no_range.exit_code, 2);
  EXPECT_NE(no_range.err.find("--components: needs --range R; expected both"), std::string::npos)
      << no_range.err;
  const Outcome discs = run({"simulate", "points.csv", "--until", "1", "--radius", "0.5",
                             "--collisions", "log", "--components", "c.csv", "--range", "1"});
  EXPECT_EQ(discs.exit_code, 2);
  EXPECT_NE(discs.err.find("--components: distances between discs are not supported"),
            std::string::npos)
      << discs.err;
  EXPECT_FALSE(exists("c.csv"));
}

}  // namespace
}  // namespace kinetri::components_test
