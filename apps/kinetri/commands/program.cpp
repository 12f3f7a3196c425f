// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/documentation_commands.h"
#include "commands/commands.h"

namespace kinetri::app {
Command program() {
  Command result;
  result.name = "kinetri";
  result.summary = "Exact kinetic Delaunay triangulation of moving points in the plane";
  result.description = {
      "Kinetri keeps the Delaunay triangulation of moving points correct at every instant, not "
      "only at sampled times. It finds each time at which the triangulation changes, and decides "
      "every "
      "comparison exactly: the same input always gives the same events in the same order."};
  result.examples = {"kinetri generate uniform --points 100 --seed 1 -o points.csv",
                     "kinetri simulate points.csv --until 10 --events events.csv --audit end",
                     "kinetri help simulate"};
  result.commands = {generate_command(), simulate_command(),   resume_command(), tracks_command(),
                     wave_command(),     experiment_command(), render_command(), live_command()};
  result.exit_codes = {
      {0, "Done."},
      {1, "An audit failed, or kinetri-verify refuted the run."},
      {2, "Bad usage or bad input; standard error says what was expected."},
      {3, "An internal check failed."},
      {130,
       "Interrupted, jammed, or in contacts without end; the outputs hold what "
       "happened until then."},
      {141,
       "The pipe at standard output has no reader any more; outputs that are files are complete."}};
  add_documentation_commands(result, " A scenario of generate is named after it.",
                             {"kinetri help simulate", "kinetri help generate uniform"});
  return result;
}

}  // namespace kinetri::app
