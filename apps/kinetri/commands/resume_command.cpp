// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "commands/commands.h"
#include "commands/run_options.h"
#include "runs/simulation_run.h"
#include "sources/checkpoint_source.h"

namespace kinetri::app {
namespace {

// The texts of the options.
struct Resume_options {
  std::string checkpoint;
  Run_options run;
};

}  // namespace

Command resume_command() {
  const auto options = std::make_shared<Resume_options>();
  Command result;
  result.name = "resume";
  result.summary = "Continue a run from a checkpoint";
  result.add_required("CHECKPOINT", &options->checkpoint, "FILE",
                      "A file that --checkpoint has written; - is standard input");
  add_end_options(result, options->run);
  add_thermostat_option(result, options->run);
  add_run_options(result, options->run,
                  {Output::checkpoint, Output::neighbors, Output::exchanges, Output::nearest,
                   Output::components, Output::connected, Output::spanning_tree, Output::areas,
                   Output::mean_areas, Output::pressure, Output::encounters, Output::contact_plan});
  result.description = {
      "The run continues as if it had never stopped: the event log of the first part and that of "
      "this one together are the log of one long run, byte for byte, and event numbers continue. "
      "Box, discs and collisions are those of the checkpoint. Counts of events and instants in "
      "--stats "
      "include the first part.",
      "With --events or --motions, the files that --events, --motions, --initial-edges and --edges "
      "of the first part have written must be unchanged, or absent.",
      "Exit codes: see kinetri simulate."};
  result.examples = {"kinetri resume run.kinetri --until 20 --events more.csv --edges edges.csv",
                     "kinetri resume run.kinetri --until 20 --checkpoint later.kinetri"};
  result.run = [options](const Command& /*program*/) {
    const auto source = checkpoint_source(options->checkpoint, until_argument(options->run));
    return run_simulation(run_settings(options->run), *source);
  };
  return result;
}

}  // namespace kinetri::app
