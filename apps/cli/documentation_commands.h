// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands help, completion and manual, and the options --help and --version, generated from a
// program's commands.
#ifndef KINETRI_APPS_DOCUMENTATION_COMMANDS_H
#define KINETRI_APPS_DOCUMENTATION_COMMANDS_H

#include <string>
#include <vector>

#include "cli/command.h"

namespace kinetri::app {

/// Adds these commands and options to the program, which must have all others. The help of the
/// command help gets the examples, and ends with the remark.
void add_documentation_commands(Command& program, const std::string& remark,
                                const std::vector<std::string>& examples);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_DOCUMENTATION_COMMANDS_H
