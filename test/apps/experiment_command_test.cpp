// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri experiment` from outside: tables, plots, and bad usage.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "apps/program_test.h"

namespace kinetri::experiment_command_test {
namespace {

using test::Arguments;
using test::Outcome;

class Experiment : public test::Program_test {
 protected:
  Outcome experiment(Arguments more) const {
    more.insert(more.begin(), {"experiment", "--points", "20", "--until", "1", "--seeds", "2"});
    return run(more);
  }
};

std::vector<std::vector<std::string>> table(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

bool gnuplot_is_there() {
  return std::system("gnuplot --version >/dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

TEST_F(Experiment, writes_a_row_for_each_share_and_seed) {
  const Outcome outcome = experiment({"--output", "results/now", "--no-plots", "--compare"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("20 points, 22 runs"), std::string::npos) << outcome.err;
  const auto runs = table(read("results/now/experiment.csv"));
  ASSERT_EQ(runs.size(), 1 + 22u);
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(runs[0], name);
    EXPECT_NE(found, runs[0].end()) << name;
    return static_cast<std::size_t>(found - runs[0].begin());
  };
  EXPECT_EQ(runs[1][column("movers_percent")], "0");
  EXPECT_EQ(runs[1][column("flip")], "0");
  EXPECT_EQ(runs[11][column("movers_percent")], "100");
  EXPECT_EQ(runs[11][column("seed")], "1");
  EXPECT_NE(runs[11][column("flip")], "0");
  EXPECT_EQ(runs[22][column("seed")], "2");
  const auto comparisons = table(read("results/now/comparison.csv"));
  ASSERT_EQ(comparisons.size(), 1 + 16u);
  EXPECT_EQ(comparisons[1][0], "0.1");
}

TEST_F(Experiment, draws_plots_in_both_formats) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = experiment({"--output", "results", "--compare", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const std::string name : {"runtime", "events", "comparison"}) {
    const std::string svg = read("results/" + name + ".svg");
    EXPECT_EQ(svg.rfind("<?xml", 0), 0u) << name;
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << name;
    EXPECT_EQ(read("results/" + name + ".png").substr(1, 3), "PNG") << name;
  }
  EXPECT_NE(read("results/runtime.svg").find("run time (ms)"), std::string::npos);
  EXPECT_NE(read("results/events.svg").find("collisions, discarded"), std::string::npos);
}

TEST_F(Experiment, runs_a_single_one) {
  const Arguments one = {"experiment", "--points", "20",       "--until", "4",  "--single",
                         "50",         "--seed",   "3",        "--stats", "s",  "--events",
                         "e",          "--html",   "run.html", "--audit", "end"};
  const Outcome outcome = run(one);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  // The same run is a row of the tables.
  const Outcome all = run({"experiment", "--points", "20", "--until", "4", "--seeds", "3",
                           "--output", "r", "--no-plots", "--quiet"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  const auto stats = nlohmann::json::parse(read("s"));
  EXPECT_EQ(stats["points"], 20);
  const auto rows = table(read("r/experiment.csv"));
  const auto row = std::ranges::find_if(
      rows, [](const auto& fields) { return fields[0] == "50" && fields[1] == "3"; });
  ASSERT_NE(row, rows.end());
  for (std::size_t i = 0; i < row->size(); ++i) {
    const std::string& kind = rows[0][i];
    if (stats["events"].contains(kind)) {
      EXPECT_EQ(stats["events"][kind], std::stoi((*row)[i]));
    }
  }
  EXPECT_GT(stats["events"]["flip"], 0);
  EXPECT_NE(read("run.html").find("experiment: 20 points, 50 % moving, seed 3"), std::string::npos);
}

TEST_F(Experiment, of_two_sizes_has_columns_for_discs_that_are_hidden) {
  const Arguments setting = {"--radius", "0.5", "--sizes", "6", "--collisions", "log"};
  Arguments all = setting;
  all.insert(all.end(), {"--output", "r", "--no-plots", "--compare", "--quiet"});
  const Outcome outcome = experiment(all);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = table(read("r/experiment.csv"));
  ASSERT_EQ(rows.size(), 1 + 22u);
  Arguments one = {"experiment", "--points", "20",      "--until", "1",       "--single", "100",
                   "--seed",     "2",        "--stats", "s",       "--audit", "events"};
  one.insert(one.end(), setting.begin(), setting.end());
  EXPECT_EQ(run(one).exit_code, 0);
  const auto stats = nlohmann::json::parse(read("s"));
  std::size_t kinds = 0;
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    if (!stats["events"].contains(rows[0][i])) continue;
    EXPECT_EQ(stats["events"][rows[0][i]], std::stoi(rows.back()[i])) << rows[0][i];
    ++kinds;
  }
  EXPECT_EQ(kinds, 8u);
  EXPECT_GT(stats["events"]["collision"], 0);
  EXPECT_GT(stats["events"]["hide"], 0);
  EXPECT_EQ(table(read("r/comparison.csv")).size(), 1 + 16u);
}

TEST_F(Experiment, of_one_size_is_as_without_sizes) {
  for (const std::string sizes : {"", "1"}) {
    Arguments arguments = {"experiment", "--points", "20",       "--single",
                           "100",        "--quiet",  "--events", "e" + sizes};
    if (!sizes.empty()) arguments.insert(arguments.end(), {"--sizes", sizes});
    EXPECT_EQ(run(arguments).exit_code, 0);
  }
  EXPECT_EQ(read("e"), read("e1"));
}

TEST_F(Experiment, needs_no_gnuplot_for_tables) {
  test::Process_input input;
  input.environment = {"PATH=/nowhere"};
  const Arguments arguments = {"experiment", "--output", "r", "--points",
                               "5",          "--seeds",  "1", "--no-plots"};
  EXPECT_EQ(run(arguments, input).exit_code, 0);
  EXPECT_TRUE(exists("r/experiment.csv"));
}

TEST_F(Experiment, tables_take_their_places_with_the_plots_or_not_at_all) {
  std::filesystem::create_directory(file("r"));
  write("r/experiment.csv", "before");
  std::filesystem::create_directory(file("bin"));
  write("bin/gnuplot", "#!/bin/sh\n[ \"$1\" = --version ]\n");
  std::filesystem::permissions(file("bin/gnuplot"), std::filesystem::perms::owner_all);
  test::Process_input input;
  input.environment = {"PATH=bin:/bin:/usr/bin"};
  const Outcome outcome =
      run({"experiment", "--output", "r", "--points", "5", "--seeds", "1"}, input);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.rfind("gnuplot: drawing failed;", 0), 0U) << outcome.err;
  EXPECT_EQ(read("r/experiment.csv"), "before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("r")),
                          std::filesystem::directory_iterator()),
            1);
}

}  // namespace
}  // namespace kinetri::experiment_command_test
