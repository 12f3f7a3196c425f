// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program answers about connectivity.
#include <gtest/gtest.h>

#include <string>

#include "apps/program_test.h"

namespace kinetri {
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
            "time_lo,time_hi,kind,a,b,components,largest\n"
            "0,0,start,,,1,1\n"
            "2,2,insert,1,,2,1\n"
            "2,2,merge,0,1,1,2\n"
            "3,3,insert,2,,2,2\n"
            "4,4,split,0,1,3,1\n"
            "4,4,erase,1,,2,1\n"
            "9,9,erase,0,,1,1\n"
            "9,9,erase,2,,0,0\n");
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

TEST_F(Components, need_a_range_and_points) {
  write("points.csv", passing);
  const Outcome no_range =
      run({"simulate", "points.csv", "--until", "1", "--components", "-", "--quiet"});
  EXPECT_EQ(no_range.exit_code, 2);
  EXPECT_NE(no_range.err.find("--components: how far apart is near? expected --range R as well"),
            std::string::npos)
      << no_range.err;
  const Outcome discs = run({"simulate", "points.csv", "--until", "1", "--radius", "0.5",
                             "--collisions", "log", "--components", "c.csv", "--range", "1"});
  EXPECT_EQ(discs.exit_code, 2);
  EXPECT_NE(discs.err.find("--components: the points are discs"), std::string::npos) << discs.err;
  EXPECT_FALSE(exists("c.csv"));
}

}  // namespace
}  // namespace kinetri
