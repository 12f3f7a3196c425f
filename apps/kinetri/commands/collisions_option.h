// SPDX-License-Identifier: GPL-3.0-or-later
//
// The option --collisions: one of the built-in responses, or of some of them.
#ifndef KINETRI_APPS_COLLISIONS_OPTION_H
#define KINETRI_APPS_COLLISIONS_OPTION_H

#include <span>
#include <string>

#include "cli/command.h"
#include "kinetri/simulation/collision_response.h"

namespace kinetri::app {

/// Declares the option. `target` holds the default, and must outlive the command.
void add_collisions_option(Command& command, std::string& target,
                           std::span<const Named_response> responses, const std::string& help);

/// "What happens when two discs touch", for each of the responses.
std::string collisions_help(std::span<const Named_response> responses);

/// The response that `text` names. Throws Usage_error.
const Named_response& collisions_argument(const std::string& text,
                                          std::span<const Named_response> responses);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COLLISIONS_OPTION_H
