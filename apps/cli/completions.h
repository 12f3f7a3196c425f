// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scripts for shells that complete commands, options, and values that are choices, files or
// directories.
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
