// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way of a program from its command line to its exit code.
#ifndef KINETRI_APPS_RUN_PROGRAM_H
#define KINETRI_APPS_RUN_PROGRAM_H

#include "cli/command.h"

namespace kinetri::app {

/// Runs the command that the command line names, and turns every exception into a message and an
/// exit code, which is returned. `main` does nothing else: standard streams, signals and iostreams
/// are set up here.
int run_program(Command (*make_program)(), int argc, char** argv);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_PROGRAM_H
