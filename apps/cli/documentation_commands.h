// SPDX-License-Identifier: GPL-3.0-or-later
//
// help, completion and manual, --help and --version: what a program says of itself, made from its
// own commands.
#ifndef KINETRI_APPS_DOCUMENTATION_COMMANDS_H
#define KINETRI_APPS_DOCUMENTATION_COMMANDS_H

#include <string>
#include <vector>

#include "cli/command.h"

namespace kinetri::app {

/// Adds these commands to the program, which has all others, and these options. The help of help
/// has the examples, and the remark at its end.
void add_documentation_commands(Command& program, const std::string& remark,
                                const std::vector<std::string>& examples);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_DOCUMENTATION_COMMANDS_H
