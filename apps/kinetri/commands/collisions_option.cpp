// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/collisions_option.h"

#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

std::vector<std::string_view> names_of(std::span<const Named_response> responses) {
  std::vector<std::string_view> result;
  for (const Named_response& response : responses) result.push_back(response.name);
  return result;
}

}  // namespace

void add_collisions_option(Command& command, std::string& target,
                           std::span<const Named_response> responses, const std::string& help) {
  command.add("--collisions", &target, choice_type(names_of(responses)), help);
}

std::string collisions_help(std::span<const Named_response> responses) {
  std::vector<std::string> effects;
  for (const auto& [name, response, effect] : responses) {
    effects.push_back(joined(name, response == nullptr ? " (default), " : ", ", effect));
  }
  return joined("What happens when two discs touch: ", separated(effects, "; "));
}

const Named_response& collisions_argument(const std::string& text,
                                          std::span<const Named_response> responses) {
  return responses[choice_argument("--collisions", text, names_of(responses))];
}

}  // namespace kinetri::app
