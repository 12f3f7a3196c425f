// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>
#include <span>

#include "cli/arguments.h"
#include "cli/text.h"
#include "commands/collisions_option.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "commands/run_options.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/simulation/experiment.h"
#include "outputs/gnuplot.h"
#include "runs/experiment_run.h"
#include "runs/simulation_run.h"
#include "sources/generated_source.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_experiment_points = 1'000'000;
constexpr std::uint64_t most_seeds = 1000;
constexpr std::span<const Named_response> all_but_none =
    std::span<const Named_response>(named_responses).subspan(1);

// The texts of the options.
struct Experiment_options {
  std::optional<std::string> output;
  std::string points = "100";
  std::string seeds = "5";
  std::string until = "10";
  std::string speed = "5";
  std::string radius = "0.5";
  std::string sizes = "1";
  std::optional<std::string> side;
  std::string collisions = "swap";
  bool compare = false;
  bool no_plots = false;
  std::optional<std::string> single;
  std::string seed = "1";
  Run_options run;
};

Experiment_run experiment_run(const Experiment_options& options) {
  Experiment_run result;
  result.points = count_argument("--points", options.points, most_experiment_points);
  if (result.points == 0) {
    throw Usage_error("--points: 0 points do nothing; expected a number from 1 to 1000000");
  }
  result.duration = scenario_size_argument("--until", options.until);
  result.speed = scenario_size_argument("--speed", options.speed);
  result.radius = scenario_size_argument("--radius", options.radius);
  result.side = options.side ? scenario_size_argument("--side", *options.side)
                             : 10 * std::sqrt(static_cast<double>(result.points));
  result.size_ratio = size_ratio_argument(options.sizes);
  const double share = experiment_setting(result).covered_share();
  if (result.size_ratio != 1 && !(share <= greatest_covered_share)) {
    throw Usage_error(joined("--sizes: discs of the radii ", result.radius, " and ",
                             result.radius * result.size_ratio, " cover ", significant(share, 3),
                             " of the box; expected at most ", greatest_covered_share,
                             ": smaller discs, or a larger --side"));
  }
  result.collisions = collisions_argument(options.collisions, all_but_none);
  return result;
}

Experiment_run single_run(const Experiment_options& options) {
  Experiment_run result = experiment_run(options);
  result.percentage = count_argument("--single", *options.single, 100);
  result.seed = seed_argument(options.seed);
  return result;
}

Experiment_plan experiment_plan(const Experiment_options& options) {
  if (!options.output) {
    throw Usage_error("--output is missing; expected a directory for the tables, or --single");
  }
  Experiment_plan result;
  result.directory = *options.output;
  result.run = experiment_run(options);
  result.seeds = count_argument("--seeds", options.seeds, most_seeds);
  if (result.seeds == 0) throw Usage_error("--seeds: 0 runs show nothing; expected 1 or more");
  result.compares = options.compare;
  result.plots = !options.no_plots;
  if (result.plots) require_gnuplot("--no-plots");
  const Run_settings settings = run_settings(options.run);
  result.progress = settings.progress;
  result.quiet = settings.quiet;
  return result;
}

void add_options_of_all_runs(Command& command, Experiment_options& options) {
  const std::size_t first = command.options.size();
  command.add("-o,--output", &options.output, "DIR",
              "Write the tables and plots into this directory (needed without --single)");
  command.add("--seeds", &options.seeds, "K", "Repeat with K sets of random points (default 5)");
  command.add_flag("--compare", options.compare,
                   "Compare with the discrete approach, which removes and reinserts the points at "
                   "fixed time steps");
  command.add_flag("--no-plots", options.no_plots, "Write tables only; gnuplot is not needed");
  for (std::size_t i = first; i < command.options.size(); ++i) {
    command.options[i].heading = "All runs";
    command.options[i].excludes = "--single";
  }
}

void add_options_of_single_run(Command& command, Experiment_options& options) {
  command
      .add("--single", &options.single, "P",
           "Make only one run, in which P percent of the points move")
      .heading = "One run";
  const std::size_t first = command.options.size();
  command.add("--seed", &options.seed, "S", "Number of the set of random points (default 1)")
      .heading = "One run";
  add_run_options(command, options.run);
  for (std::size_t i = first; i < command.options.size(); ++i) {
    Option& option = command.options[i];
    if (option.name() != "--progress" && option.name() != "--quiet") option.needs = "--single";
  }
}

}  // namespace

Command experiment_command() {
  const auto options = std::make_shared<Experiment_options>();
  Command result;
  result.name = "experiment";
  result.summary = "Measure run time and number of events for several shares of moving points";
  result.add("--points", &options->points, "N", "Number of points (default 100)");
  result.add("--until", &options->until, "T", "Length of each run (default 10)");
  result.add("--speed", &options->speed, "V", "Largest component of a velocity (default 5)");
  result.add("--radius", &options->radius, "R", "Radius of the discs (default 0.5)");
  result.add("--sizes", &options->sizes, "RATIO",
             "Radius of every second disc over that of the others, from 1 to 1000 (default 1)");
  result.add("--side", &options->side, "L", "Side of the box (default 10 sqrt(N))");
  add_collisions_option(result, options->collisions, all_but_none,
                        "What happens when two discs touch (default swap), see kinetri simulate");
  add_options_of_all_runs(result, *options);
  add_options_of_single_run(result, *options);
  result.description = {
      "The defaults are those of the paper: 100 discs of diameter 1 in a box of 100 x 100, of "
      "which 0 %, 10 %, ..., 100 % move, for 10 units of time.",
      "With --sizes the triangulation is the regular one of the discs. No two of them overlap at "
      "the start, and they cover at most a quarter of the box; of one size, random discs may "
      "overlap.",
      "The directory of --output gets experiment.csv (a row for each run), runtime.svg and .png, "
      "events.svg and .png, and with --compare comparison.csv, comparison.svg and .png. The "
      "options under \"Outputs\", --audit and --exact-only are for --single.",
      "Exit codes: see kinetri simulate."};
  result.examples = {"kinetri experiment --output results --compare",
                     "kinetri experiment --single 50 --seed 3 --html run.html",
                     "kinetri experiment --output results --sizes 4"};
  result.run = [options](const Command& /*program*/) {
    if (!options->single) return run_experiments(experiment_plan(*options));
    const auto source = experiment_source(single_run(*options));
    return run_simulation(run_settings(options->run), *source);
  };
  return result;
}

}  // namespace kinetri::app
