// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a simulation from a source, and writes its outputs.
#ifndef KINETRI_APPS_SIMULATION_RUN_H
#define KINETRI_APPS_SIMULATION_RUN_H

#include "cli/exit_code.h"
#include "runs/run_settings.h"

namespace kinetri::app {

class Run_source;

/// Outputs are opened first, and replace existing files only after all have been written: a run
/// that throws changes no file, except with Unread_output_error. Failures of audits and a summary
/// go to standard error.
///
/// Throws Usage_error if two outputs, or an output and the input, are one file, or there are too
/// many frames; Run_error if points keep colliding without time advancing; Output_error, of which
/// Unread_output_error after the other outputs have been written; and what the source and
/// Simulation_2 throw.
Exit_code run_simulation(const Run_settings& settings, Run_source& source);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SIMULATION_RUN_H
