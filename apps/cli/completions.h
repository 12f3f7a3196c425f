// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scripts by which shells complete the program's command lines: commands, options, and the values
// of those whose values are choices, files or directories.
#ifndef KINETRI_APPS_COMPLETIONS_H
#define KINETRI_APPS_COMPLETIONS_H

#include <iosfwd>

#include "cli/command.h"

namespace kinetri::app {

/// For bash 4 or newer; needs nothing of the package bash-completion.
void write_bash_completion(std::ostream& out, const Command& program);

/// For zsh: works as a file _NAME in $fpath and, after compinit, sourced.
void write_zsh_completion(std::ostream& out, const Command& program);

/// For fish 3 or newer.
void write_fish_completion(std::ostream& out, const Command& program);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMPLETIONS_H
