// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options that the commands which run a simulation have in common.
#ifndef KINETRI_APPS_RUN_OPTIONS_H
#define KINETRI_APPS_RUN_OPTIONS_H

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runs/simulation_run.h"

namespace kinetri::app {

/// Declares the options of outputs, audits and progress, after those of the command itself, and
/// holds their values as they stand on the command line.
class Run_options {
 public:
  /// Returns those of outputs and of what is done in the run; not those of progress.
  std::vector<CLI::Option*> add_to(CLI::App& command);

  /// For commands whose runs can be taken up again.
  void add_checkpoint_to(CLI::App& command);

  /// Throws Usage_error.
  Run_settings settings() const;

 private:
  Frame_settings frame_settings() const;

  CLI::Option* frames_per_time_option_ = nullptr;

  std::optional<std::string> events_;
  std::optional<std::string> initial_edges_;
  std::optional<std::string> edges_;
  std::optional<std::string> stats_;
  std::optional<std::string> checkpoint_;
  std::optional<std::string> html_;
  std::optional<std::string> frames_;
  std::optional<std::string> vtu_;
  std::optional<std::string> frames_per_time_;
  std::optional<std::string> plot_;
  std::string audit_ = "none";
  std::string progress_ = "auto";
  bool exact_only_ = false;
  bool quiet_ = false;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_OPTIONS_H
