// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri generate` from outside.
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"
#include "kinetri/io/points_file.h"
#include "kinetri/simulation/packing.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::generate_command_test {
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

TEST_F(Generate, a_packing_is_the_librarys_exactly) {
  const Outcome outcome =
      generate({"packing", "--points", "12", "--share", "0.5", "--sizes", "2", "--seed", "7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream in(outcome.out);
  const Points_file found = read_points(in, "generated");
  const Packing expected = make_packing({.points = 12, .share = 0.5, .size_ratio = 2, .seed = 7});
  ASSERT_EQ(found.motions.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(found.motions[i], static_cast<const Linear_motion_2&>(expected.discs[i]));
    EXPECT_EQ(found.radii[i], expected.discs[i].radius);
  }
}

// The command that is printed runs, and names the output as the shell takes it.
TEST_F(Generate, a_packing_says_how_it_is_simulated_in_its_box) {
  struct Case {
    Arguments more;
    std::string command;
  };
  const std::string box = " --until 10 --box 0,0,16,16 --rim --collisions elastic --mass area\n";
  for (const auto& [more, command] : {
           Case{{"-o", "discs.csv"}, "kinetri simulate discs.csv" + box},
           Case{{"-o", "my discs.csv"}, "kinetri simulate 'my discs.csv'" + box},
           Case{{"-o", "Ada's"}, "kinetri simulate 'Ada'\\''s'" + box},
           Case{{}, "kinetri simulate -" + box},
       }) {
    Arguments arguments = {"packing", "--points", "12",     "--share", "0.6",
                           "--sizes", "2",        "--side", "16"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = generate(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "To simulate these discs in their box:\n  " + command);
  }
  const Outcome simulated =
      run({"simulate", "my discs.csv", "--until", "10", "--box", "0,0,16,16", "--rim",
           "--collisions", "elastic", "--mass", "area", "--audit", "end", "--quiet"});
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  const Outcome default_side = generate({"packing", "--points", "3", "--share", "0.1"});
  EXPECT_NE(default_side.err.find(" --box 0,0,17.32050807568877,17.32050807568877 "),
            std::string::npos)
      << default_side.err;
}

TEST_F(Generate, a_packing_in_a_periodic_box_is_simulated_in_that) {
  const Outcome outcome = generate({"packing", "--points", "12", "--share", "0.6", "--side", "16",
                                    "--periodic", "-o", "discs.csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err,
            "To simulate these discs in their box:\n  kinetri simulate discs.csv --until 10 "
            "--periodic 16,16 --collisions elastic --mass area\n");
  const Packing expected =
      make_packing({.points = 12, .share = 0.6, .side = 16, .is_periodic = true});
  const Points_file found = read_points_file(file("discs.csv"));
  ASSERT_EQ(found.motions.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(found.motions[i], static_cast<const Linear_motion_2&>(expected.discs[i]));
    EXPECT_EQ(found.radii[i], expected.discs[i].radius);
  }
  const Outcome simulated =
      run({"simulate", "discs.csv", "--until", "1", "--periodic", "16,16", "--collisions",
           "elastic", "--mass", "area", "--audit", "end", "--quiet"});
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
}

TEST_F(Generate, a_packing_may_grow_in_proportion_to_the_radii) {
  const Outcome outcome =
      generate({"packing", "--points", "13", "--share", "0.1", "--sizes", "2", "--growth", "0.25"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream in(outcome.out);
  const Points_file found = read_points(in, "generated");
  ASSERT_EQ(found.growths.size(), 13u);
  double sum = 0;
  for (std::size_t i = 0; i < 13; ++i) {
    sum += found.growths[i];
    EXPECT_NEAR(found.growths[i] / found.radii[i], found.growths[0] / found.radii[0], 1e-12);
  }
  EXPECT_NEAR(sum / 13, 0.25, 1e-12);
}

TEST_F(Generate, a_packing_that_cannot_be_is_an_error) {
  const Outcome jammed = generate({"packing", "--points", "1", "--share", "0.8"});
  EXPECT_EQ(jammed.exit_code, 2);
  EXPECT_NE(jammed.err.find("jammed"), std::string::npos) << jammed.err;
  EXPECT_EQ(generate({"packing", "--points", "0"}).exit_code, 2);
  EXPECT_EQ(generate({"packing", "--points", "2", "--share", "1"}).exit_code, 2);
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
}  // namespace kinetri::generate_command_test
