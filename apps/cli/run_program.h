// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a program from its command line to its exit code.
#ifndef KINETRI_APPS_RUN_PROGRAM_H
#define KINETRI_APPS_RUN_PROGRAM_H

#include "cli/command.h"

namespace kinetri::app {

/// Sets up standard streams, signals and iostreams, runs the command that the command line names,
/// and turns every exception into a message and the exit code that is returned.
int run_program(Command (*make_program)(), int argc, char** argv);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_PROGRAM_H
