// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs points of a file, or recorded tracks, in a periodic box, and writes its outputs.
#ifndef KINETRI_APPS_PERIODIC_RUN_H
#define KINETRI_APPS_PERIODIC_RUN_H

#include <functional>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "kinetri/triangulation/coincident_points.h"
#include "outputs/output_table.h"
#include "runs/run_settings.h"
#include "sources/periodic_points.h"

namespace kinetri::app {

/// What a run in a periodic box needs besides the settings of all runs.
struct Periodic_settings {
  std::string path;                       ///< of the input, or "-"
  std::function<Periodic_points()> read;  ///< reads the input; called once
  std::vector<std::string> box_options;   ///< for kinetri-verify
  Coincident_points coincident = Coincident_points::hide;
};

/// Whether a run in a periodic box has this output.
constexpr bool is_for_periodic_boxes(Output output) {
  return output == Output::events || output == Output::motions || output == Output::initial_edges ||
         output == Output::edges || output == Output::stats || output == Output::frames ||
         output == Output::vtu || output == Output::html || output == Output::ids;
}

/// As run_simulation, of the triangulation alone. Precondition: all outputs of the settings are for
/// periodic boxes. Throws Input_error if the points cannot be used in the box, and Run_error if an
/// offset becomes too great.
Exit_code run_periodic(const Run_settings& settings, const Periodic_settings& periodic);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PERIODIC_RUN_H
