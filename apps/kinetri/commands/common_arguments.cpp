// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/common_arguments.h"

#include <algorithm>
#include <array>
#include <limits>

#include "cli/arguments.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators.
constexpr std::array<std::string_view, 2> coincidences = {"hide", "refuse"};

}  // namespace

double scenario_size_argument(std::string_view option, std::string_view text, bool zero_allowed) {
  return size_argument(option, text, smallest_scenario_size, largest_scenario_size, zero_allowed);
}

double size_ratio_argument(std::string_view text) {
  return size_argument("--sizes", text, 1, 1000, false);
}

std::uint64_t seed_argument(std::string_view text) {
  return count_argument("--seed", text, std::numeric_limits<std::uint64_t>::max());
}

void add_coincident_option(Command& command, std::string& target) {
  target = coincidences.front();
  command.add("--coincident", &target, choice_type(coincidences),
              "Points that coincide for a while, as a rider and the bus: hide (default), the one "
              "with the least number has the edges and the cell, and hides the others; refuse the "
              "run");
}

Coincident_points coincident_argument(const std::string& text) {
  return static_cast<Coincident_points>(choice_argument("--coincident", text, coincidences));
}

Box_2 box_argument(const std::string& text) {
  std::array<double, 4> sides = {};
  std::size_t number = 0;
  for (std::size_t start = 0; start <= text.size(); ++number) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::string side = text.substr(start, comma - start);
    if (number < sides.size()) sides[number] = number_argument("--box", side);
    start = comma + 1;
  }
  if (number != sides.size()) {
    throw Usage_error(
        joined("--box: '", text, "' has ", number, " numbers; expected four, XMIN,YMIN,XMAX,YMAX"));
  }
  const auto& [xmin, ymin, xmax, ymax] = sides;
  if (xmin < xmax && ymin < ymax) return {xmin, ymin, xmax, ymax};
  throw Usage_error(
      joined("--box: '", text,
             "' has no area; expected XMIN,YMIN,XMAX,YMAX with XMIN < XMAX and YMIN < YMAX"));
}

}  // namespace kinetri::app
