// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/experiment_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "kinetri/simulation/scenarios.h"
#include "outputs/gnuplot.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_points = 1'000'000;
constexpr std::uint64_t most_seeds = 1000;

}  // namespace

Experiment_command::Experiment_command(CLI::App& program)
    : command_(add_command(program, "experiment",
                           "Measure run time and events against the share of points that move")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    return add_option(*command_, option, value, type, help);
  };
  const std::initializer_list<CLI::Option*> for_all_runs = {
      add("--output", output_, "DIR",
          "Write tables and plots into this directory, made if need be; needed but for --single"),
      add("--seeds", seeds_, "K", "Repeat with K sets of random points (default 5)"),
      add_flag(*command_, "--compare", compare_,
               "Compare with the discrete approach too, which removes and reinserts "
               "points at time steps"),
      add_flag(*command_, "--no-plots", no_plots_, "Only tables, for which gnuplot is not needed")};
  add("--points", points_, "N", "Number of points (default 100)");
  add("--until", until_, "T", "Length of each run (default 10)");
  add("--speed", speed_, "V", "Largest velocity component (default 5)");
  add("--radius", radius_, "R", "Radius of the discs (default 0.5)");
  add("--side", side_, "L", "Side of the box (default 10 sqrt(N))");
  add("--collisions", collisions_, "log|swap|elastic|stop|remove",
      "What discs do that touch (default swap)");
  CLI::Option* const single =
      add("--single", single_, "P", "Instead of all, one run in which P % of the points move");
  for (CLI::Option* const option : for_all_runs) option->excludes(single);
  add("--seed", seed_, "S", "Which set of random points that is (default 1)")->needs(single);
  for (CLI::Option* const option : run_options_.add_to(*command_)) option->needs(single);
  command_->footer(
      "The defaults are those of the paper: 100 discs of diameter 1 in a box of 100 x 100, of "
      "which\n"
      "0 %, 10 %, ..., 100 % move, for 10 units of time.\n\n"
      "Written: experiment.csv (a row for each run), runtime.svg and .png, events.svg and .png;\n"
      "with --compare also comparison.csv, comparison.svg and .png.\n\n"
      "Example:\n"
      "  kinetri experiment --output results --compare\n"
      "  kinetri experiment --single 50 --seed 3 --html run.html");
}

Exit_code Experiment_command::run() const {
  if (!single_) return run_experiments(plan());
  Generated_source source(single_run());
  return run_simulation(run_options_.settings(), source);
}

Experiment_setting Experiment_command::setting() const {
  Experiment_setting result;
  result.points = count_argument("--points", points_, most_points);
  if (result.points == 0) {
    throw Usage_error("--points: 0 points do nothing; expected a number from 1 to 1000000");
  }
  const auto size = [](std::string_view option, const std::string& text) {
    return size_argument(option, text, smallest_scenario_size, largest_scenario_size, false);
  };
  result.duration = size("--until", until_);
  result.speed = size("--speed", speed_);
  result.diameter = 2 * size("--radius", radius_);
  result.side = side_ ? size("--side", *side_) : 10 * std::sqrt(static_cast<double>(result.points));
  result.response = response().response;
  return result;
}

const Named_response& Experiment_command::response() const {
  std::array<std::string_view, named_responses.size() - 1> names;
  std::ranges::transform(named_responses.begin() + 1, named_responses.end(), names.begin(),
                         &Named_response::name);
  return named_responses[1 + choice_argument("--collisions", collisions_, names)];
}

Experiment_plan Experiment_command::plan() const {
  if (!output_) {
    throw Usage_error("--output: there is none; expected a directory for the tables, or --single");
  }
  Experiment_plan result;
  result.directory = *output_;
  result.setting = setting();
  result.seeds = count_argument("--seeds", seeds_, most_seeds);
  if (result.seeds == 0) throw Usage_error("--seeds: 0 runs show nothing; expected 1 or more");
  result.compares = compare_;
  result.plots = !no_plots_;
  if (result.plots) require_gnuplot("--no-plots");
  const Run_settings run_settings = run_options_.settings();
  result.progress = run_settings.progress;
  result.quiet = run_settings.quiet;
  return result;
}

Generated_run Experiment_command::single_run() const {
  Experiment_setting setting = this->setting();
  const std::uint64_t percentage = count_argument("--single", *single_, 100);
  setting.movers = setting.points * static_cast<std::size_t>(percentage) / 100;
  setting.seed = count_argument("--seed", seed_, std::numeric_limits<std::uint64_t>::max());
  Generated_run result;
  result.title = fmt::format("experiment: {} points, {} % moving, seed {}", setting.points,
                             percentage, setting.seed);
  result.motions = experiment_motions(setting);
  result.options = experiment_options(setting);
  result.response = response().name;
  result.until = setting.duration;
  return result;
}

}  // namespace kinetri::app
