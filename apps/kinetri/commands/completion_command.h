// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri completion`: writes what a shell needs to complete the program's command lines.
#ifndef KINETRI_APPS_COMPLETION_COMMAND_H
#define KINETRI_APPS_COMPLETION_COMMAND_H

#include <CLI/App.hpp>
#include <string>

#include "cli/exit_code.h"

namespace kinetri::app {

/// The command: declares its argument in the constructor; `run` after it was parsed. What it writes
/// is made from the commands and options of the program as they are then.
class Completion_command {
 public:
  explicit Completion_command(CLI::App& program);
  Completion_command(const Completion_command&) = delete;
  Completion_command& operator=(const Completion_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error and Output_error.
  Exit_code run() const;

 private:
  const CLI::App* program_;
  CLI::App* command_;
  std::string shell_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMPLETION_COMMAND_H
