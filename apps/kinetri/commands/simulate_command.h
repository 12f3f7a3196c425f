// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri simulate`: the command line of a run.
#ifndef KINETRI_APPS_SIMULATE_COMMAND_H
#define KINETRI_APPS_SIMULATE_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "commands/run_options.h"
#include "sources/points_source.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Simulate_command {
 public:
  explicit Simulate_command(CLI::App& program);
  Simulate_command(const Simulate_command&) = delete;
  Simulate_command& operator=(const Simulate_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error, and what run_simulation throws.
  Exit_code run() const;

 private:
  Points_settings settings() const;

  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string points_;
  std::string from_ = "0";
  std::string until_;
  std::optional<std::string> box_;
  bool rim_ = false;
  std::string collisions_ = "none";
  std::optional<std::string> radius_;
  Run_options run_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SIMULATE_COMMAND_H
