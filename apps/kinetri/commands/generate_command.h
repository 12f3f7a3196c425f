// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri generate`: writes the moving points of a scenario.
#ifndef KINETRI_APPS_GENERATE_COMMAND_H
#define KINETRI_APPS_GENERATE_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/exit_code.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Generate_command {
 public:
  explicit Generate_command(CLI::App& program);
  Generate_command(const Generate_command&) = delete;
  Generate_command& operator=(const Generate_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error and Output_error.
  Exit_code run() const;

 private:
  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string points_;
  std::string seed_ = "1";
  std::optional<std::string> side_;
  std::string speed_ = "5";
  std::string spacing_ = "10";
  std::string jitter_ = "0.1";
  std::string movers_ = "all";
  std::string output_ = "-";
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_GENERATE_COMMAND_H
