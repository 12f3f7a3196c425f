// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri generate` from outside.
#include <algorithm>
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

TEST_F(Generate, EveryScenarioGivesTheLibrarysNumbersExactly) {
  for (const Scenario scenario : all_scenarios) {
    EXPECT_EQ(motions({std::string(name(scenario)), "--points", "50", "--seed", "9"}),
              make_scenario(scenario, {.points = 50, .seed = 9}));
  }
}

TEST_F(Generate, OptionsReachTheScenario) {
  EXPECT_EQ(motions({"uniform", "--points", "9", "--seed", "3", "--side", "0x1p4", "--speed", "0"}),
            make_scenario(Scenario::uniform, {.points = 9, .seed = 3, .side = 16, .speed = 0}));
  EXPECT_EQ(motions({"lattice-jitter", "--points", "9", "--spacing", "2", "--jitter", "0.5"}),
            make_scenario(Scenario::lattice_jitter, {.points = 9, .spacing = 2, .jitter = 0.5}));
  for (const Lattice_movers movers : all_lattice_movers) {
    EXPECT_EQ(motions({"lattice", "--points", "9", "--movers", std::string(name(movers))}),
              make_scenario(Scenario::lattice, {.points = 9, .movers = movers}));
  }
}

TEST_F(Generate, SeedDefaultsToOne) {
  EXPECT_EQ(motions({"uniform", "--points", "5"}),
            motions({"uniform", "--points", "5", "--seed", "1"}));
}

TEST_F(Generate, NoPointsIsAHeader) {
  EXPECT_EQ(generate({"uniform", "--points", "0"}).out, "x,y,vx,vy\n");
}

TEST_F(Generate, WritesAFile) {
  EXPECT_EQ(generate({"uniform", "--points", "3", "--output", "p.csv"}).exit_code, 0);
  EXPECT_EQ(read("p.csv"), generate({"uniform", "--points", "3"}).out);
  EXPECT_EQ(entries(), Entries{"p.csv"});
}

TEST_F(Generate, OutputThatCannotBeWrittenIsAnError) {
  const Outcome missing = generate({"uniform", "--points", "3", "--output", "missing/p.csv"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err.rfind("missing/p.csv: cannot be written:", 0), 0U) << missing.err;
  const Outcome full = generate({"uniform", "--points", "3"}, {.standard_output = "/dev/full"});
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_EQ(full.err, "standard output: writing failed: No space left on device\n");
}

struct Bad_usage {
  Arguments arguments;
  const char* message;
};

class GenerateBadUsage : public Generate, public testing::WithParamInterface<Bad_usage> {};

TEST_P(GenerateBadUsage, SaysWhatWasExpected) {
  const Outcome outcome = generate(GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--help' for what is possible.\n"), std::string::npos) << outcome.err;
}

std::vector<Bad_usage> bad_counts() {
  std::vector<Bad_usage> result;
  for (const char* count :
       {"-1", "many", "", "1.5", "1e3", "100000001", "99999999999999999999999", "0x10", " 5"}) {
    result.push_back({{"uniform", "--points", count},
                      "cannot be used; expected a whole number from 0 to 100000000"});
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(Counts, GenerateBadUsage, testing::ValuesIn(bad_counts()));

INSTANTIATE_TEST_SUITE_P(
    Others, GenerateBadUsage,
    testing::Values(
        Bad_usage{{},
                  "kinetri generate: nothing to do; expected uniform, gaussian, constant-speed, "
                  "one-mover, lattice or lattice-jitter"},
        Bad_usage{{"spiral"}, "kinetri generate: 'spiral' is unknown; expected uniform, gaussian"},
        Bad_usage{{"uniform"}, "kinetri generate uniform: --points is required"},
        Bad_usage{{"uniform", "--points", "5", "--seed", "-1"},
                  "--seed: '-1' cannot be used; expected a whole number from 0 to "
                  "18446744073709551615"},
        Bad_usage{{"uniform", "--points", "5", "--side", "0"},
                  "--side: 0 is out of range; expected a number from 1e-100 to 1e+100"},
        Bad_usage{{"uniform", "--points", "5", "--side", ""}, "--side: '' is not a number"},
        Bad_usage{{"uniform", "--points", "5", "--speed", "-1"},
                  "--speed: -1 is out of range; expected a number from 1e-100 to 1e+100, or 0"},
        Bad_usage{{"uniform", "--points", "5", "--speed", "nan"}, "--speed: 'nan' is not finite"},
        Bad_usage{{"uniform", "--points", "5", "--spacing", "1"}, "'--spacing' is unknown"},
        Bad_usage{{"lattice", "--points", "5", "--speed", "0.5"},
                  "--speed: 0.5 is out of range; expected a number from 1 to"},
        Bad_usage{{"lattice", "--points", "5", "--movers", "two"},
                  "--movers: 'two' is unknown; expected none, one, columns or all"}));

}  // namespace
}  // namespace kinetri
