// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri generate` from outside.
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "kinetri/io/points_file.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri {
namespace {

using test::Arguments;
using test::Entries;
using test::Outcome;

class Generate : public test::Program_test {
 protected:
  Outcome generate(Arguments more, const test::Process_input& input = {}) const {
    more.insert(more.begin(), "generate");
    return run(more, input);
  }

  std::vector<Linear_motion_2> motions(const Arguments& more) const {
    const Outcome outcome = generate(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    std::istringstream in(outcome.out);
    return read_points(in, "generated").motions;
  }
};

TEST_F(Generate, every_scenario_gives_the_librarys_numbers_exactly) {
  for (const Scenario scenario : all_scenarios) {
    EXPECT_EQ(motions({std::string(name(scenario)), "--points", "50", "--seed", "9"}),
              make_scenario(scenario, {.points = 50, .seed = 9}));
  }
}

TEST_F(Generate, options_reach_the_scenario) {
  EXPECT_EQ(motions({"uniform", "--points", "9", "--seed", "3", "--side", "0x1p4", "--speed", "0"}),
            make_scenario(Scenario::uniform, {.points = 9, .seed = 3, .side = 16, .speed = 0}));
  EXPECT_EQ(motions({"lattice-jitter", "--points", "9", "--spacing", "2", "--jitter", "0.5"}),
            make_scenario(Scenario::lattice_jitter, {.points = 9, .spacing = 2, .jitter = 0.5}));
  for (const Lattice_movers movers : all_lattice_movers) {
    EXPECT_EQ(motions({"lattice", "--points", "9", "--movers", std::string(name(movers))}),
              make_scenario(Scenario::lattice, {.points = 9, .movers = movers}));
  }
}

TEST_F(Generate, seed_defaults_to_one) {
  EXPECT_EQ(motions({"uniform", "--points", "5"}),
            motions({"uniform", "--points", "5", "--seed", "1"}));
}

TEST_F(Generate, no_points_is_a_header) {
  EXPECT_EQ(generate({"uniform", "--points", "0"}).out, "x,y,vx,vy\n");
}

TEST_F(Generate, writes_a_file) {
  EXPECT_EQ(generate({"uniform", "--points", "3", "--output", "p.csv"}).exit_code, 0);
  EXPECT_EQ(read("p.csv"), generate({"uniform", "--points", "3"}).out);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

}  // namespace
}  // namespace kinetri
