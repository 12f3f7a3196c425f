// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands of the program, one by each function.
#ifndef KINETRI_APPS_COMMANDS_H
#define KINETRI_APPS_COMMANDS_H

#include "cli/command.h"

namespace kinetri::app {

Command generate_command();
Command simulate_command();
Command resume_command();
Command tracks_command();
Command wave_command();
Command experiment_command();
Command render_command();
Command live_command();

/// The program with all of them.
Command program();

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMANDS_H
