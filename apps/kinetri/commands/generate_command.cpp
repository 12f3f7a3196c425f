// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/points_file.h"
#include "kinetri/simulation/packing.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_generated_points = 100'000'000;
constexpr std::uint64_t most_packed_points = 1'000'000;
constexpr double fastest_lattice = 0x1p53;

// The texts of the options.
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

struct Packing_arguments {
  std::string points;
  std::string seed = "1";
  std::optional<std::string> side;
  std::string speed = "5";
  std::string share = "0.8";
  std::string sizes = "1";
  std::optional<std::string> growth;
  bool periodic = false;
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

// The text quoted for the shell if necessary.
std::string shell_word(const std::string& text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,:+-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

// The command that simulates the discs in their box, which the points file does not have.
std::string command_for(const Box_2& box, bool is_periodic, const std::string& points) {
  const std::string option = is_periodic ? joined("--periodic ", box.xmax, ",", box.ymax)
                                         : joined("--box ", box.xmin, ",", box.ymin, ",", box.xmax,
                                                  ",", box.ymax, " --rim");
  return joined("kinetri simulate ", shell_word(points), " --until 10 ", option,
                " --collisions elastic --mass area");
}

Exit_code generate_packing(const Packing_arguments& given) {
  Packing_options options;
  options.points = count_argument("--points", given.points, most_packed_points);
  if (options.points == 0) size_argument("--points", given.points, 1, most_packed_points, false);
  options.seed = seed_argument(given.seed);
  if (given.side) options.side = scenario_size_argument("--side", *given.side);
  options.speed = scenario_size_argument("--speed", given.speed, true);
  options.share = size_argument("--share", given.share, 1e-9, 0.9, false);
  options.size_ratio = size_ratio_argument(given.sizes);
  options.is_periodic = given.periodic;
  std::optional<double> growth;
  if (given.growth) growth = scenario_size_argument("--growth", *given.growth);

  Output_file output(given.output);
  Packing packing;
  try {
    packing = make_packing(options);
  } catch (const Packing_error& error) {
    throw Run_error(error.what());
  }
  std::vector<Linear_motion_2> centers;
  std::vector<double> radii;
  for (const Disc_motion_2& disc : packing.discs) {
    centers.push_back(disc);
    radii.push_back(disc.radius);
  }
  std::vector<double> growths;
  if (growth) {
    const double mean =
        std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
    for (const double radius : radii) growths.push_back(*growth * (radius / mean));
  }
  write_points(output.stream(), centers, radii, growths);
  output.commit();
  print_error(joined("To simulate these discs in their box:\n  ",
                     command_for(packing.box, given.periodic, given.output), "\n"));
  return Exit_code::done;
}

Command packing_command() {
  const auto options = std::make_shared<Packing_arguments>();
  Command result;
  result.name = "packing";
  result.summary = "Discs that grow in a square box until they cover a share of it";
  result.description = {
      "No two discs overlap, and all are within the box, exactly; in a periodic box no two images "
      "overlap. It is an error if the discs jam "
      "before they cover the share: a thousand discs reach 0.82 if they are equal, and 0.8 with "
      "the ratio 1.4. The command that simulates them in this box is printed to standard "
      "error."};
  result.add_required("--points", &options->points, "N",
                      joined("Number of discs, from 1 to ", most_packed_points));
  result.add("--share", &options->share, "S",
             "Share of the box that the discs cover, up to 0.9 (default 0.8)");
  result.add("--sizes", &options->sizes, "RATIO",
             "Radius of every second disc over that of the others, from 1 to 1000 (default 1)");
  result.add("--growth", &options->growth, "G",
             "Write a column growth, in proportion to the radii: G is the growth of the mean "
             "radius in a unit of time");
  result.add_flag("--periodic", options->periodic,
                  "A periodic box, without walls: discs that leave it on one side enter on the "
                  "opposite one");
  result.add("--seed", &options->seed, "S",
             "Seed of the random numbers, from 0 to 2^64 - 1 (default 1)");
  result.add("--side", &options->side, "L", "Side of the square (default 10 sqrt(N))");
  result.add("--speed", &options->speed, "V", "Largest component of a velocity (default 5)");
  result.add("-o,--output", &options->output, "FILE",
             "Write the points here; - (default) is standard output");
  result.examples = {
      "kinetri generate packing --points 1000 --share 0.8 --sizes 1.4 --seed 1 > points.csv",
      "kinetri generate packing --points 100 --share 0.1 --side 100 --growth 0.1 > points.csv",
      "kinetri generate packing --points 1000 --share 0.8 --sizes 1.4 --periodic > points.csv"};
  result.run = [options](const Command& /*program*/) { return generate_packing(*options); };
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
  result.commands.push_back(packing_command());
  return result;
}

}  // namespace kinetri::app
