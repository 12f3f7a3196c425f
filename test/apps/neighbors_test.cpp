// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables of neighbors, of exchanges and of nearest neighbors, from outside.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::neighbors_test {
namespace {

using test::Arguments;
using test::Outcome;

class Neighbors : public test::Program_test {
 protected:
  // The first line, then the others.
  std::vector<std::string> lines(const std::string& name) const {
    std::istringstream text(read(name));
    std::vector<std::string> result;
    for (std::string line; std::getline(text, line);) result.push_back(line);
    return result;
  }
};

TEST_F(Neighbors, have_lives_and_exchanges) {
  write("p.csv", test::one_flip);
  const Outcome outcome = run({"simulate", "p.csv", "--until", "3", "--neighbors", "n.csv",
                               "--exchanges", "e.csv", "--nearest", "-", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(lines("n.csv"),
            (std::vector<std::string>{"a,b,begin_lo,begin_hi,end_lo,end_hi,begins_by,ends_by,short",
                                      "0,1,0,0,3,3,run,run,", "0,2,0,0,3,3,run,run,",
                                      "0,3,0,0,1,1,run,exchange,", "1,3,0,0,3,3,run,run,",
                                      "2,3,0,0,3,3,run,run,", "1,2,1,1,3,3,exchange,run,"}));
  EXPECT_EQ(lines("e.csv"),
            (std::vector<std::string>{
                "id,from_lo,from_hi,until_lo,until_hi,gained,lost,short,rate",
                "0,0,0,3,3,0,1,,0.3333333333333333", "1,0,0,3,3,1,0,,0.3333333333333333",
                "2,0,0,3,3,1,0,,0.3333333333333333", "3,0,0,3,3,0,1,,0.3333333333333333"}));
  // Points 1 and 2 are equally near to 3 at all times. At t = 1 it is as far from them as 0 is.
  EXPECT_EQ(outcome.out,
            "time_lo,time_hi,id,before,after\n0,0,0,,1\n0,0,1,,3\n0,0,2,,3\n0,0,3,,1\n"
            "1,1,1,3,0\n1,1,2,3,0\n");
}

// The ridge of 1 and 2 grows from nothing at t = 1.
TEST_F(Neighbors, with_a_short_ridge_are_told_apart) {
  write("p.csv", test::one_flip);
  const Outcome outcome = run({"simulate", "p.csv", "--until", "1.25", "--neighbors", "n.csv",
                               "--exchanges", "e.csv", "--ridge", "2", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lives = lines("n.csv");
  ASSERT_EQ(lives.size(), 7u);
  EXPECT_EQ(lives[3], "0,3,0,0,1,1,run,exchange,1");
  EXPECT_EQ(lives[1], "0,1,0,0,1.25,1.25,run,run,0");
  EXPECT_EQ(lives[6], "1,2,1,1,1.25,1.25,exchange,run,1");
  EXPECT_EQ(lines("e.csv")[1], "0,0,0,1.25,1.25,0,1,1,0");
}

TEST_F(Neighbors, of_tracks_come_and_go_with_their_points) {
  write("t.csv",
        "t,id,x,y\n"
        "0,a,0,0\n0,b,9,0\n0,c,0,9\n"
        "1,visitor,1,1\n2,visitor,3,1\n4,visitor,3,1\n5,visitor,1,4\n"
        "10,a,0,0\n10,b,9,0\n10,c,0,9\n");
  const Outcome outcome = run({"tracks", "t.csv", "--neighbors", "-", "--nearest", "nearest.csv",
                               "--exchanges", "e.csv", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\n0,3,1,1,5,5,point,point,,a,visitor\n"), std::string::npos)
      << outcome.out;
  const auto nearest = lines("nearest.csv");
  for (const char* row :
       {"time_lo,time_hi,id,before,after,label,label_before,label_after", "1,1,0,1,3,a,b,visitor",
        "1,1,3,,0,visitor,,a", "5,5,3,0,,visitor,a,", "5,5,0,3,1,a,visitor,b"}) {
    EXPECT_NE(std::ranges::find(nearest, row), nearest.end()) << row << '\n' << read("nearest.csv");
  }
  EXPECT_EQ(lines("e.csv")[0], "id,from_lo,from_hi,until_lo,until_hi,gained,lost,short,rate,label");
  EXPECT_EQ(lines("e.csv")[4], "3,1,1,5,5,0,0,,0,visitor");
}

TEST_F(Neighbors, of_a_continued_run_begin_at_its_start) {
  write("p.csv", test::one_flip);
  ASSERT_EQ(run({"simulate", "p.csv", "--until", "0.5", "--checkpoint", "c", "--quiet"}).exit_code,
            0);
  const Outcome outcome =
      run({"resume", "c", "--until", "2", "--neighbors", "-", "--ridge", "1e-9", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\n0,3,0.5,0.5,1,1,run,exchange,0\n"), std::string::npos)
      << outcome.out;
}

TEST_F(Neighbors, that_are_nearest_are_refused_for_discs_of_different_sizes) {
  write("d.csv", "x,y,vx,vy,radius\n0,0,0,0,1\n9,0,0,0,2\n");
  const Outcome outcome =
      run({"simulate", "d.csv", "--until", "1", "--collisions", "log", "--nearest", "n.csv"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--nearest: nearest discs need not be neighbors"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(exists("n.csv"));
}

}  // namespace
}  // namespace kinetri::neighbors_test
