// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/resume_command.h"

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "sources/checkpoint_source.h"

namespace kinetri::app {

Resume_command::Resume_command(CLI::App& program)
    : command_(add_command(program, "resume", "Go on with a run from its checkpoint")) {
  const auto add = [this](const char* option, auto& value, const char* type, const char* help) {
    return add_option(*command_, option, value, type, help);
  };
  add("CHECKPOINT", checkpoint_, "FILE",
      "What kinetri simulate --checkpoint has written; - is standard input")
      ->required();
  add("--until", until_, "T", "Execute every event at or before this time")->required();
  run_options_.add_to(*command_);
  run_options_.add_checkpoint_to(*command_);
  command_->footer(
      "The run goes on as if it had not been broken off: the events are the same, byte for byte, "
      "and\n"
      "so are their numbers. Box, discs and collisions are those of the checkpoint; so are the "
      "counts\n"
      "that go into --stats.\n\n"
      "Exit codes: as those of kinetri simulate.\n\n"
      "Example:\n"
      "  kinetri resume run.kinetri --until 20 --events more.csv --edges edges.csv\n"
      "  kinetri resume run.kinetri --until 20 --checkpoint later.kinetri");
}

Exit_code Resume_command::run() const {
  Checkpoint_source source(checkpoint_, number_argument("--until", until_));
  return run_simulation(run_options_.settings(), source);
}

}  // namespace kinetri::app
