// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs points of a file in a periodic box, and writes its outputs.
#ifndef KINETRI_APPS_PERIODIC_RUN_H
#define KINETRI_APPS_PERIODIC_RUN_H

#include <string>

#include "cli/exit_code.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/triangulation/coincident_points.h"
#include "outputs/output_table.h"
#include "runs/run_settings.h"

namespace kinetri::app {

/// What a run in a periodic box needs besides the settings of all runs.
struct Periodic_settings {
  std::string points;  ///< a path, or "-"
  double from = 0;
  double until = 0;  ///< at least `from`
  Periodic_box_2 box;
  std::string box_options;  ///< for kinetri-verify: the value of --periodic
  std::string shear;        ///< and that of --shear
  Coincident_points coincident = Coincident_points::hide;
};

/// Whether a run in a periodic box has this output.
constexpr bool is_for_periodic_boxes(Output output) {
  return output == Output::events || output == Output::motions || output == Output::initial_edges ||
         output == Output::edges || output == Output::stats || output == Output::frames ||
         output == Output::vtu || output == Output::html;
}

/// As run_simulation, of the triangulation alone. Precondition: all outputs of the settings are for
/// periodic boxes. Throws Input_error if the points cannot be used in the box, and Run_error if an
/// offset becomes too great.
Exit_code run_periodic(const Run_settings& settings, const Periodic_settings& periodic);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PERIODIC_RUN_H
