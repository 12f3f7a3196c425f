// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "io/output_file.h"
#include "io/text.h"
#include "kinetri/io/points_file.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_generated_points = 100'000'000;
constexpr double fastest_lattice = 0x1p53;

// The options' values as they stand on the command line.
struct Generate_options {
  std::string points;
  std::string seed = "1";
  std::optional<std::string> side;
  std::string speed = "5";
  std::string spacing = "10";
  std::string jitter = "0.1";
  std::string movers = "all";
  std::string output = "-";
};

std::string_view summary(Scenario scenario) {
  switch (scenario) {
    case Scenario::uniform:
      return "Uniformly random positions in a square, random velocities";
    case Scenario::gaussian:
      return "Normally distributed positions, random velocities";
    case Scenario::constant_speed:
      return "Random positions in a square, random directions, the same speed for all";
    case Scenario::one_mover:
      return "Random positions in a square; only the first point moves";
    case Scenario::lattice:
      return "An exact lattice with integer velocities: many degenerate positions";
    case Scenario::lattice_jitter:
      return "A lattice with small random offsets, random velocities";
  }
  return "";
}

template <std::size_t N, class Enumeration>
std::array<std::string_view, N> names(const std::array<Enumeration, N>& values) {
  std::array<std::string_view, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = name(values[i]);
  return result;
}

Exit_code generate(Scenario scenario, const Generate_options& given) {
  Scenario_options options;
  options.points = count_argument("--points", given.points, most_generated_points);
  options.seed = seed_argument(given.seed);
  if (given.side) options.side = scenario_size_argument("--side", *given.side);
  options.speed = scenario_size_argument("--speed", given.speed, true);
  options.spacing = scenario_size_argument("--spacing", given.spacing);
  options.jitter = scenario_size_argument("--jitter", given.jitter, true);
  options.movers =
      all_lattice_movers[choice_argument("--movers", given.movers, names(all_lattice_movers))];
  if (scenario == Scenario::lattice && options.movers != Lattice_movers::none) {
    options.speed = size_argument("--speed", given.speed, 1, fastest_lattice, false);
  }

  Output_file output(given.output);
  write_points(output.stream(), make_scenario(scenario, options));
  output.commit();
  return Exit_code::done;
}

Command scenario_command(Scenario scenario) {
  const auto options = std::make_shared<Generate_options>();
  Command result;
  result.name = name(scenario);
  result.summary = summary(scenario);
  result.add_required("--points", &options->points, "N",
                      joined("Number of points, from 0 to ", most_generated_points));
  result.add("--seed", &options->seed, "S",
             "Seed of the random numbers, from 0 to 2^64 - 1 (default 1)");
  if (scenario == Scenario::lattice || scenario == Scenario::lattice_jitter) {
    result.add("--spacing", &options->spacing, "D",
               "Distance of neighbors in the lattice (default 10)");
  } else {
    result.add("--side", &options->side, "L", "Side of the square (default 10 sqrt(N))");
  }
  const bool has_one_speed =
      scenario == Scenario::constant_speed || scenario == Scenario::one_mover;
  result.add("--speed", &options->speed, "V",
             has_one_speed ? "Speed of the points that move (default 5)"
                           : "Largest component of a velocity (default 5)");
  if (scenario == Scenario::lattice_jitter) {
    result.add("--jitter", &options->jitter, "D", "Largest offset of a coordinate (default 0.1)");
  }
  if (scenario == Scenario::lattice) {
    result.add("--movers", &options->movers, choice_type(names(all_lattice_movers)),
               "Which points move (default all)");
  }
  result.add("-o,--output", &options->output, "FILE",
             "Write the points here; - (default) is standard output");
  const std::string_view more = scenario == Scenario::lattice ? " --movers one" : "";
  result.examples = {
      joined("kinetri generate ", result.name, " --points 100 --seed 1", more, " > points.csv")};
  result.run = [options, scenario](const Command& /*program*/) {
    return generate(scenario, *options);
  };
  return result;
}

}  // namespace

Command generate_command() {
  Command result;
  result.name = "generate";
  result.summary = "Write random or regular moving points, to try things out with";
  result.description = {
      "Each scenario has options of its own: see kinetri help generate uniform, for example."};
  result.examples = {"kinetri generate uniform --points 100 --seed 1 > points.csv"};
  for (const Scenario scenario : all_scenarios) {
    result.commands.push_back(scenario_command(scenario));
  }
  return result;
}

}  // namespace kinetri::app
