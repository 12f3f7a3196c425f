// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of a simulation: a source in; events, edges and statistics out.
#ifndef KINETRI_APPS_SIMULATION_RUN_H
#define KINETRI_APPS_SIMULATION_RUN_H

#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "cli/progress.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "outputs/frame_outputs.h"
#include "sources/run_source.h"

namespace kinetri::app {

enum class Audit_mode {
  none,
  end,
  events,  ///< at the start, after each group of simultaneous events, and at the end
};

/// Which frames are written.
struct Frame_settings {
  // Output directories: a path, or none.
  std::optional<std::string> svg;
  std::optional<std::string> vtu;
  std::optional<Frame_rate> rate;  ///< without one, 101 in all
};

/// What is done with a run, whatever its source.
struct Run_settings {
  // Output files: a path, or "-", or none.
  std::optional<std::string> events;
  std::optional<std::string> initial_edges;
  std::optional<std::string> edges;
  std::optional<std::string> stats;
  std::optional<std::string> points;      ///< a table of the source's points
  std::optional<std::string> checkpoint;  ///< the state at the end
  std::optional<std::string> html;        ///< a page that plays the run
  std::optional<std::string> plot;        ///< a figure of the run; gnuplot is there
  Frame_settings frames;
  std::size_t closest = 0;  ///< how many closest approaches to print on standard output
  Audit_mode audit = Audit_mode::none;
  Arithmetic arithmetic = Arithmetic::filtered;
  Progress_mode progress = Progress_mode::automatic;
  bool quiet = false;
};

/// Runs. Outputs are opened first, and take the place of what was there only after all of them have
/// been written: a run that throws changes no file. Failures of audits and a summary go to standard
/// error.
///
/// Throws Usage_error if two outputs, or an output and the input, are one file, or there are too
/// many frames; Output_error; and what the source and Simulation_2 throw.
Exit_code run_simulation(const Run_settings& settings, Run_source& source);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SIMULATION_RUN_H
