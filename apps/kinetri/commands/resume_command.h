// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri resume`: the command line of a run that goes on from a checkpoint.
#ifndef KINETRI_APPS_RESUME_COMMAND_H
#define KINETRI_APPS_RESUME_COMMAND_H

#include <CLI/App.hpp>
#include <string>

#include "cli/exit_code.h"
#include "commands/run_options.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Resume_command {
 public:
  explicit Resume_command(CLI::App& program);
  Resume_command(const Resume_command&) = delete;
  Resume_command& operator=(const Resume_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error, and what run_simulation throws.
  Exit_code run() const;

 private:
  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string checkpoint_;
  std::string until_;
  Run_options run_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RESUME_COMMAND_H
