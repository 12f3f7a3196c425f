// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/common_arguments.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "cli/arguments.h"
#include "kinetri/simulation/scenarios.h"

namespace kinetri::app {

double scenario_size_argument(std::string_view option, std::string_view text, bool zero_allowed) {
  return size_argument(option, text, smallest_scenario_size, largest_scenario_size, zero_allowed);
}

std::uint64_t seed_argument(std::string_view text) {
  return count_argument("--seed", text, std::numeric_limits<std::uint64_t>::max());
}

const Named_response& response_argument(std::string_view text, bool none_allowed) {
  std::array<std::string_view, named_responses.size()> names;
  std::ranges::transform(named_responses, names.begin(), &Named_response::name);
  const std::size_t first = none_allowed ? 0 : 1;  // "none" is the first one
  return named_responses[first +
                         choice_argument("--collisions", text, std::span(names).subspan(first))];
}

}  // namespace kinetri::app
