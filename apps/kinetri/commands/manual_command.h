// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri manual`: writes the manual page.
#ifndef KINETRI_APPS_MANUAL_COMMAND_H
#define KINETRI_APPS_MANUAL_COMMAND_H

#include <CLI/App.hpp>

#include "cli/exit_code.h"

namespace kinetri::app {

/// The command. What it writes, in the language of man, is made from the commands and options of
/// the program as they are when it runs.
class Manual_command {
 public:
  explicit Manual_command(CLI::App& program);
  Manual_command(const Manual_command&) = delete;
  Manual_command& operator=(const Manual_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Output_error.
  Exit_code run() const;

 private:
  const CLI::App* program_;
  CLI::App* command_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_MANUAL_COMMAND_H
