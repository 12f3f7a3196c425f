// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string_view>

#include "cli/arguments.h"
#include "commands/commands.h"
#include "commands/common_arguments.h"
#include "commands/run_options.h"
#include "kinetri/impl/io/text.h"
#include "runs/simulation_run.h"
#include "sources/generated_source.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_wave_points = 1'000'000;

// The texts of the options.
struct Wave_options {
  std::string columns = "30";
  std::string rows = "30";
  std::string spacing = "10";
  std::optional<std::string> speed;
  std::optional<std::string> radius;
  std::string sizes = "1";
  std::string jitter = "0";
  std::string seed = "1";
  std::optional<std::string> height;
  std::optional<std::string> width;
  std::optional<std::string> until;
  Run_options run;
};

std::size_t lattice_count(std::string_view option, const std::string& text) {
  const std::uint64_t value = count_argument(option, text, most_wave_points);
  if (value > 0) return static_cast<std::size_t>(value);
  throw Usage_error(joined(option, ": 0 is too few; expected 1 or more"));
}

Wave_setting wave_setting(const Wave_options& options) {
  Wave_setting result;
  result.columns = lattice_count("--columns", options.columns);
  result.rows = lattice_count("--rows", options.rows);
  if (result.columns > most_wave_points / result.rows) {
    throw Usage_error(joined("--rows: ", result.columns, " x ", result.rows,
                             " points are too many; expected at most ", most_wave_points));
  }
  result.spacing = scenario_size_argument("--spacing", options.spacing);
  result.speed = options.speed ? scenario_size_argument("--speed", *options.speed) : result.spacing;
  const double radius =
      options.radius ? scenario_size_argument("--radius", *options.radius) : result.spacing / 128;
  result.diameter = 2 * radius;
  if (!(result.diameter < result.spacing)) {
    throw Usage_error(joined("--radius: ", radius, " makes neighbors overlap; expected less than ",
                             result.spacing / 2, ", half of --spacing"));
  }
  result.size_ratio = size_ratio_argument(options.sizes);
  if (!(result.greatest_diameter() < result.spacing)) {
    throw Usage_error(joined("--sizes: points of the radius ", radius * result.size_ratio,
                             " overlap their neighbors; expected a radius of less than ",
                             result.spacing / 2, ", half of --spacing"));
  }
  result.jitter = scenario_size_argument("--jitter", options.jitter, true);
  const double room = (result.spacing - result.greatest_diameter()) / 2;
  if (!(result.jitter < room)) {
    throw Usage_error(joined("--jitter: ", options.jitter,
                             " lets neighbors overlap; expected less than ", room,
                             ", half of the gap between them"));
  }
  result.seed = seed_argument(options.seed);
  return result;
}

Wave_run wave_run(const Wave_options& options) {
  Wave_run result;
  result.setting = wave_setting(options);
  const Wave_setting& setting = result.setting;
  result.until = options.until ? scenario_size_argument("--until", *options.until, true)
                               : 2 * setting.height() / setting.speed;
  result.height =
      options.height ? scenario_size_argument("--height", *options.height) : 3 * setting.spacing;
  result.width =
      options.width ? scenario_size_argument("--width", *options.width) : 2 * setting.spacing;
  return result;
}

}  // namespace

Command wave_command() {
  const auto options = std::make_shared<Wave_options>();
  Command result;
  result.name = "wave";
  result.summary = "Simulate a wave: a moving row of points crosses a lattice of points at rest";
  result.add("--columns", &options->columns, "N", "Points in a row (default 30)");
  result.add("--rows", &options->rows, "N", "Number of rows (default 30)");
  result.add("--spacing", &options->spacing, "D",
             "Distance of neighbors in the lattice (default 10)");
  result.add("--speed", &options->speed, "V",
             "Speed of the moving row (default: one spacing in a unit of time)");
  result.add("--radius", &options->radius, "R",
             "Radius of the points, which exchange velocities when they touch (default: 1/128 of "
             "the spacing)");
  result.add("--sizes", &options->sizes, "RATIO",
             "Radius of every second point, as the fields of a chessboard alternate, over that of "
             "the others, from 1 to 1000 (default 1)");
  result.add("--jitter", &options->jitter, "D",
             "Largest random offset of a point in y (default 0: the lattice is exact)");
  result.add("--seed", &options->seed, "S", "Seed of the random offsets (default 1)");
  result.add("--until", &options->until, "T",
             "Run from time 0 to this time (default: the time in "
             "which the row crosses the lattice twice)");
  result.add("--height", &options->height, "H",
             "Height of the wave on the page of --html (default: 3 spacings)");
  result.add("--width", &options->width, "W",
             "Standard deviation of the wave's shape, a Gaussian, on the page of --html (default: "
             "2 spacings)");
  add_run_options(result, options->run);
  result.description = {
      "The first row moves up. When it meets the next row, the points exchange their velocities: "
      "the first row stops, and the next one moves on. The wall reflects the last row. On the page "
      "of --html the height of a point is a Gaussian of its distance to the moving row.",
      "Exit codes: see kinetri simulate."};
  result.examples = {"kinetri wave --html wave.html",
                     "kinetri wave --columns 60 --rows 40 --jitter 2 --html wave.html --audit end",
                     "kinetri wave --radius 0.5 --sizes 4 --html wave.html"};
  result.run = [options](const Command& /*program*/) {
    const auto source = wave_source(wave_run(*options));
    return run_simulation(run_settings(options->run), *source);
  };
  return result;
}

}  // namespace kinetri::app
