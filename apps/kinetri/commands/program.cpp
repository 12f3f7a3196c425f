// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"

namespace kinetri::app {
namespace {

// Each command knows --help, and so do its commands.
void add_help(Command& command) {
  command.options.insert(command.options.begin(),
                         {{"-h", "--help"}, "", "Show this help and exit"});
  for (Command& inner : command.commands) add_help(inner);
}

}  // namespace

Command program() {
  Command result;
  result.name = "kinetri";
  result.summary = "Exact kinetic Delaunay triangulation of moving points in the plane";
  result.description = {
      "Kinetri keeps the Delaunay triangulation of moving points correct at every instant, not "
      "only "
      "at sampled times. It finds each time at which the triangulation changes, and decides every "
      "comparison exactly: the same input always gives the same events in the same order."};
  result.examples = {"kinetri generate uniform --points 100 --seed 1 -o points.csv",
                     "kinetri simulate points.csv --until 10 --events events.csv --audit end",
                     "kinetri help simulate"};
  result.commands = {generate_command(), simulate_command(), resume_command(),
                     tracks_command(),   wave_command(),     experiment_command()};
  result.commands.push_back(completion_command());
  result.commands.push_back(manual_command());
  std::vector<std::string> names;
  for (const Command& command : result.commands) names.push_back(command.name);
  result.commands.push_back(help_command(names));
  add_help(result);
  result.options.push_back({{"--version"}, "", "Show the version and exit"});
  return result;
}

}  // namespace kinetri::app
