// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/wave_command.h"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

constexpr std::uint64_t most_points = 1'000'000;

double size(std::string_view option, const std::string& text, bool zero_allowed = false) {
  return size_argument(option, text, smallest_scenario_size, largest_scenario_size, zero_allowed);
}

}  // namespace

Wave_command::Wave_command(CLI::App& program)
    : command_(add_command(program, "wave",
                           "Let a row of a lattice run through it, as the crest of a wave")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    add_option(*command_, option, value, type, help);
  };
  add("--columns", columns_, "N", "Points in a row (default 30)");
  add("--rows", rows_, "N", "Number of rows (default 30)");
  add("--spacing", spacing_, "D", "Distance of neighbors in the lattice (default 10)");
  add("--speed", speed_, "V", "Speed of the row that moves (default: a spacing in a unit of time)");
  add("--radius", radius_, "R",
      "Two points that are twice this apart exchange velocities (default: 1/128 of the spacing)");
  add("--jitter", jitter_, "D",
      "Largest random offset of a point in y (default 0: the lattice is exact)");
  add("--seed", seed_, "S", "Start of the random numbers of the jitter (default 1)");
  add("--height", height_, "H", "Height of the wave on the page (default: 3 spacings)");
  add("--width", width_, "W", "Standard deviation of its shape, a Gaussian (default: 2 spacings)");
  add("--until", until_, "T", "Length of the run (default: about once across and back)");
  run_options_.add_to(*command_);
  command_->footer(
      "The first row goes up. Where it meets the next one, the points exchange their velocities, "
      "so\n"
      "that it stops and the next one goes; the wall reflects the last one. A point's height on "
      "the\n"
      "page of --html is that of a Gaussian over its distance to the moving row.\n\n"
      "Exit codes: as those of kinetri simulate.\n\n"
      "Example:\n"
      "  kinetri wave --html wave.html\n"
      "  kinetri wave --columns 60 --rows 40 --jitter 2 --html wave.html --audit end");
}

Exit_code Wave_command::run() const {
  Generated_source source(wave());
  return run_simulation(run_options_.settings(), source);
}

Wave_setting Wave_command::setting() const {
  const auto count = [](std::string_view option, const std::string& text) {
    const std::uint64_t value = count_argument(option, text, most_points);
    if (value > 0) return static_cast<std::size_t>(value);
    throw Usage_error(fmt::format("{}: 0 make no lattice; expected 1 or more", option));
  };
  Wave_setting result;
  result.columns = count("--columns", columns_);
  result.rows = count("--rows", rows_);
  if (result.columns > most_points / result.rows) {
    throw Usage_error(fmt::format("--rows: {} x {} points are too many; expected at most {}",
                                  result.columns, result.rows, most_points));
  }
  result.spacing = size("--spacing", spacing_);
  result.speed = speed_ ? size("--speed", *speed_) : result.spacing;
  const double radius = radius_ ? size("--radius", *radius_) : result.spacing / 128;
  result.diameter = 2 * radius;
  if (!(result.diameter < result.spacing)) {
    throw Usage_error(fmt::format(
        "--radius: {} makes neighbors overlap; expected less than {}, half of --spacing", radius,
        result.spacing / 2));
  }
  result.jitter = size("--jitter", jitter_, true);
  const double room = (result.spacing - result.diameter) / 2;
  if (!(result.jitter < room)) {
    throw Usage_error(fmt::format(
        "--jitter: {} lets neighbors overlap; expected less than {}, half of what is between them",
        jitter_, room));
  }
  result.seed = count_argument("--seed", seed_, std::numeric_limits<std::uint64_t>::max());
  return result;
}

Generated_run Wave_command::wave() const {
  const Wave_setting setting = this->setting();
  Generated_run result;
  result.title = fmt::format("wave of {} x {} points", setting.columns, setting.rows);
  result.motions = wave_motions(setting);
  result.options = wave_options(setting);
  result.response = "swap";
  result.until = until_ ? size("--until", *until_, true) : 2 * setting.height() / setting.speed;
  result.wave = Wave_shape{height_ ? size("--height", *height_) : 3 * setting.spacing,
                           width_ ? size("--width", *width_) : 2 * setting.spacing};
  return result;
}

}  // namespace kinetri::app
