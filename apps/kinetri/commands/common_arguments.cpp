// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/common_arguments.h"

#include <limits>

#include "cli/arguments.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {

double scenario_size_argument(std::string_view option, std::string_view text, bool zero_allowed) {
  return size_argument(option, text, smallest_scenario_size, largest_scenario_size, zero_allowed);
}

double size_ratio_argument(std::string_view text) {
  return size_argument("--sizes", text, 1, 1000, false);
}

std::uint64_t seed_argument(std::string_view text) {
  return count_argument("--seed", text, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace kinetri::app
