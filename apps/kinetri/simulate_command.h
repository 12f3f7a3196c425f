// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri simulate`: the command line of a run.
#ifndef KINETRI_APPS_SIMULATE_COMMAND_H
#define KINETRI_APPS_SIMULATE_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "exit_code.h"
#include "simulation_run.h"

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
  Simulation_settings settings() const;

  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string points_;
  std::string from_ = "0";
  std::string until_;
  std::optional<std::string> events_;
  std::optional<std::string> initial_edges_;
  std::optional<std::string> edges_;
  std::optional<std::string> stats_;
  std::string audit_ = "none";
  std::optional<std::string> box_;
  bool rim_ = false;
  std::string collisions_ = "none";
  std::optional<std::string> radius_;
  std::string progress_ = "auto";
  bool exact_only_ = false;
  bool quiet_ = false;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SIMULATE_COMMAND_H
