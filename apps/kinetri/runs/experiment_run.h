// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's experiment, for all percentages of moving points and several seeds: tables and plots.
#ifndef KINETRI_APPS_EXPERIMENT_RUN_H
#define KINETRI_APPS_EXPERIMENT_RUN_H

#include <cstdint>
#include <string>

#include "cli/exit_code.h"
#include "cli/progress.h"
#include "sources/generated_source.h"

namespace kinetri::app {

struct Experiment_plan {
  Experiment_run run;       ///< of all runs, except for the percentage of movers and the seed
  std::uint64_t seeds = 5;  ///< the seeds are 1 to this number
  std::string directory;    ///< where to write
  bool compares = false;    ///< with discrete steps
  bool plots = true;
  Progress_mode progress = Progress_mode::automatic;
  bool quiet = false;
};

/// Makes all runs, then writes all files. If interrupted, it writes the results so far. Throws
/// Output_error, and what Simulation_2 throws.
Exit_code run_experiments(const Experiment_plan& plan);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_EXPERIMENT_RUN_H
