// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/generate_command.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "io/output_file.h"
#include "kinetri/io/points_file.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_points = 100'000'000;
constexpr double fastest_lattice = 0x1p53;

std::string_view description(Scenario scenario) {
  switch (scenario) {
    case Scenario::uniform:
      return "random places in a square, random velocities";
    case Scenario::gaussian:
      return "normally distributed places, random velocities";
    case Scenario::constant_speed:
      return "random places in a square, random directions, exactly one speed";
    case Scenario::one_mover:
      return "random places in a square, all points but the first at rest";
    case Scenario::lattice:
      return "an exact lattice, whole-numbered velocities: degenerate on purpose";
    case Scenario::lattice_jitter:
      return "a lattice with small random offsets, random velocities";
  }
  return "";
}

std::string example(Scenario scenario) {
  const std::string_view options = scenario == Scenario::lattice ? " --movers one" : "";
  return fmt::format("Example:\n  kinetri generate {} --points 100 --seed 1{} > points.csv",
                     name(scenario), options);
}

template <std::size_t N, class Enumeration>
std::array<std::string_view, N> names(const std::array<Enumeration, N>& values) {
  std::array<std::string_view, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = name(values[i]);
  return result;
}

double length(std::string_view option, const std::string& text, bool zero_allowed) {
  return size_argument(option, text, smallest_scenario_size, largest_scenario_size, zero_allowed);
}

}  // namespace

Generate_command::Generate_command(CLI::App& program)
    : command_(add_command(program, "generate", "Write moving points to simulate")) {
  command_->require_subcommand(1);
  command_->footer(
      "Each scenario has its own options: see kinetri generate uniform --help.\n\n"
      "Example:\n  kinetri generate uniform --points 100 --seed 1 > points.csv");
  for (const Scenario scenario : all_scenarios) {
    CLI::App& app =
        *add_command(*command_, std::string(name(scenario)), std::string(description(scenario)));
    app.footer(example(scenario));
    const auto add = [&app](const char* option, auto& value, const char* type,
                            const std::string& help) {
      return add_option(app, option, value, type, help);
    };
    add("--points", points_, "N", fmt::format("Number of points, from 0 to {}", most_points))
        ->required();
    add("--seed", seed_, "S", "Start of the random numbers, from 0 to 2^64 - 1 (default 1)");
    const bool lattice = scenario == Scenario::lattice || scenario == Scenario::lattice_jitter;
    if (lattice) {
      add("--spacing", spacing_, "D", "Distance of neighbors in the lattice (default 10)");
    } else {
      add("--side", side_, "L", "Side of the square (default 10 sqrt(N))");
    }
    add("--speed", speed_, "V", "Largest velocity component, or the speed (default 5)");
    if (scenario == Scenario::lattice_jitter) {
      add("--jitter", jitter_, "D", "Largest offset of a coordinate (default 0.1)");
    }
    if (scenario == Scenario::lattice) {
      add("--movers", movers_, "none|one|columns|all", "Which points move (default all)");
    }
    add("--output", output_, "FILE", "Where to write; - is standard output (default)");
  }
}

Exit_code Generate_command::run() const {
  const std::string scenario_name = command_->get_subcommands().front()->get_name();
  const Scenario scenario =
      all_scenarios[choice_argument("generate", scenario_name, names(all_scenarios))];
  Scenario_options options;
  options.points = count_argument("--points", points_, most_points);
  options.seed = count_argument("--seed", seed_, std::numeric_limits<std::uint64_t>::max());
  if (side_) options.side = length("--side", *side_, false);
  options.speed = length("--speed", speed_, true);
  options.spacing = length("--spacing", spacing_, false);
  options.jitter = length("--jitter", jitter_, true);
  options.movers =
      all_lattice_movers[choice_argument("--movers", movers_, names(all_lattice_movers))];
  if (scenario == Scenario::lattice && options.movers != Lattice_movers::none) {
    options.speed = size_argument("--speed", speed_, 1, fastest_lattice, false);
  }

  Output_file output(output_);
  write_points(output.stream(), make_scenario(scenario, options));
  output.commit();
  return Exit_code::done;
}

}  // namespace kinetri::app
