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

std::vector<double> numbers_argument(std::string_view option, const std::string& text,
                                     std::size_t least, std::size_t most,
                                     std::string_view expected) {
  std::vector<std::string> pieces;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    pieces.push_back(text.substr(start, comma - start));
    start = comma + 1;
  }
  if (pieces.size() < least || pieces.size() > most) {
    throw Usage_error(
        joined(option, ": '", text, "' has ", pieces.size(), " numbers; expected ", expected));
  }
  std::vector<double> result;
  for (const std::string& piece : pieces) result.push_back(number_argument(option, piece));
  return result;
}

Box_2 box_argument(const std::string& text) {
  const std::vector<double> sides =
      numbers_argument("--box", text, 4, 4, "four, XMIN,YMIN,XMAX,YMAX");
  const double xmin = sides[0];
  const double ymin = sides[1];
  const double xmax = sides[2];
  const double ymax = sides[3];
  if (xmin < xmax && ymin < ymax) return {xmin, ymin, xmax, ymax};
  throw Usage_error(
      joined("--box: '", text,
             "' has no area; expected XMIN,YMIN,XMAX,YMAX with XMIN < XMAX and YMIN < YMAX"));
}

}  // namespace kinetri::app
