// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of the simulation: points in; events, edges and statistics out.
#ifndef KINETRI_APPS_SIMULATION_RUN_H
#define KINETRI_APPS_SIMULATION_RUN_H

#include <optional>
#include <string>

#include "exit_code.h"
#include "kinetri/kinetic/instantaneous_traits_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "progress.h"

namespace kinetri::app {

enum class Audit_mode {
  none,
  end,
  events,  ///< at the start, after each group of simultaneous events, and at the end
};

struct Simulation_settings {
  std::string points;  ///< a path, or "-"
  double from = 0;
  double until = 0;  ///< at least `from`
  std::optional<Box_2> box;
  bool rim_touches = false;
  std::optional<double> radius;  ///< of all discs, instead of the column of the points
  Named_response collisions = named_responses[0];
  // Output files: a path, or "-", or none.
  std::optional<std::string> events;
  std::optional<std::string> initial_edges;
  std::optional<std::string> edges;
  std::optional<std::string> stats;
  Audit_mode audit = Audit_mode::none;
  Arithmetic arithmetic = Arithmetic::filtered;
  Progress_mode progress = Progress_mode::automatic;
  bool quiet = false;
};

/// Runs. Outputs are opened first, and take the place of what was there only after all of them have
/// been written: a run that throws changes no file. Failures of audits and a summary go to standard
/// error.
///
/// Throws Usage_error if two outputs, or an output and the input, are one file, or discs do not fit
/// the box; Input_error, naming the line, for points outside of the box, unequal radii, and the
/// like; Output_error; and what Simulation_2 throws.
Exit_code run_simulation(const Simulation_settings& settings);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SIMULATION_RUN_H
