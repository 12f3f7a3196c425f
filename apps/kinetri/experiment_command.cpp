// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "arguments.h"
#include "gnuplot.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_points = 1'000'000;
constexpr std::uint64_t most_seeds = 1000;
constexpr std::array<std::string_view, 3> progress_modes = {"auto", "always", "never"};

}  // namespace

Experiment_command::Experiment_command(CLI::App& program)
    : command_(program.add_subcommand(
          "experiment", "Measure run time and events against the share of points that move")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    return command_->add_option(option, value, help)->type_name(type);
  };
  add("--output", output_, "DIR", "Write tables and plots into this directory, made if need be")
      ->required();
  add("--points", points_, "N", "Number of points (default 100)");
  add("--seeds", seeds_, "K", "Repeat with K sets of random points (default 5)");
  add("--until", until_, "T", "Length of each run (default 10)");
  add("--speed", speed_, "V", "Largest velocity component (default 5)");
  add("--radius", radius_, "R", "Radius of the discs (default 0.5)");
  add("--side", side_, "L", "Side of the box (default 10 sqrt(N))");
  add("--collisions", collisions_, "log|swap|elastic|stop|remove",
      "What discs do that touch (default swap)");
  command_->add_flag(
      "--compare", compare_,
      "Compare with the discrete approach too, which removes and reinserts points at "
      "time steps");
  command_->add_flag("--no-plots", no_plots_, "Only tables, for which gnuplot is not needed");
  add("--progress", progress_, "auto|always|never",
      "Show a progress line; auto (default): on a terminal");
  command_->add_flag("--quiet", quiet_, "Neither a progress line nor a summary");
  command_->footer(
      "The defaults are those of the paper: 100 discs of diameter 1 in a box of 100 x 100, of "
      "which\n"
      "0 %, 10 %, ..., 100 % move, for 10 units of time.\n\n"
      "Written: experiment.csv (a row for each run), runtime.svg and .png, events.svg and .png;\n"
      "with --compare also comparison.csv, comparison.svg and .png.\n\n"
      "Example:\n"
      "  kinetri experiment --output results --compare");
}

Exit_code Experiment_command::run() const {
  return run_experiments(plan());
}

Experiment_plan Experiment_command::plan() const {
  Experiment_plan result;
  result.directory = output_;
  Experiment_setting& setting = result.setting;
  setting.points = count_argument("--points", points_, most_points);
  if (setting.points == 0) {
    throw Usage_error("--points: 0 points do nothing; expected a number from 1 to 1000000");
  }
  result.seeds = count_argument("--seeds", seeds_, most_seeds);
  if (result.seeds == 0) throw Usage_error("--seeds: 0 runs show nothing; expected 1 or more");
  const auto size = [](std::string_view option, const std::string& text) {
    return size_argument(option, text, smallest_scenario_size, largest_scenario_size, false);
  };
  setting.duration = size("--until", until_);
  setting.speed = size("--speed", speed_);
  setting.diameter = 2 * size("--radius", radius_);
  setting.side =
      side_ ? size("--side", *side_) : 10 * std::sqrt(static_cast<double>(setting.points));
  std::array<std::string_view, named_responses.size() - 1> names;
  std::ranges::transform(named_responses.begin() + 1, named_responses.end(), names.begin(),
                         &Named_response::name);
  setting.response =
      named_responses[1 + choice_argument("--collisions", collisions_, names)].response;
  result.compares = compare_;
  result.plots = !no_plots_;
  if (result.plots && !has_gnuplot()) {
    throw Usage_error(
        "plots are drawn by gnuplot, which is not there; expected it installed (Debian: "
        "gnuplot-nox), "
        "or --no-plots");
  }
  result.progress =
      static_cast<Progress_mode>(choice_argument("--progress", progress_, progress_modes));
  if (quiet_) result.progress = Progress_mode::never;
  result.quiet = quiet_;
  return result;
}

}  // namespace kinetri::app
