// SPDX-License-Identifier: GPL-3.0-or-later
//
// The text of --help.
#ifndef KINETRI_APPS_HELP_H
#define KINETRI_APPS_HELP_H

#include <string>

#include "cli/command.h"

namespace kinetri::app {

/// The name of the command with its arguments and required options: "kinetri simulate POINTS
/// --until T [OPTIONS]". `name` is the command's full name.
std::string usage_line(const Command& command, const std::string& name);

/// The names of the option and its type: "-o, --output FILE".
std::string option_label(const Option& option);

/// The text of --help, in lines of at most 80 columns unless a word is longer. Headings are bold if
/// standard output has colors.
std::string help_text(const Command& command, const std::string& name);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_HELP_H
