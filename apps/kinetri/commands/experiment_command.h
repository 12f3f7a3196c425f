// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri experiment`: the command line of the paper's experiment.
#ifndef KINETRI_APPS_EXPERIMENT_COMMAND_H
#define KINETRI_APPS_EXPERIMENT_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "commands/run_options.h"
#include "runs/experiment_run.h"
#include "sources/generated_source.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Experiment_command {
 public:
  explicit Experiment_command(CLI::App& program);
  Experiment_command(const Experiment_command&) = delete;
  Experiment_command& operator=(const Experiment_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error, and what run_experiments and run_simulation throw.
  Exit_code run() const;

 private:
  Experiment_setting setting() const;
  const Named_response& response() const;
  Experiment_plan plan() const;
  Generated_run single_run() const;

  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::optional<std::string> output_;
  std::string points_ = "100";
  std::string seeds_ = "5";
  std::string until_ = "10";
  std::string speed_ = "5";
  std::string radius_ = "0.5";
  std::optional<std::string> side_;
  std::string collisions_ = "swap";
  bool compare_ = false;
  bool no_plots_ = false;
  std::optional<std::string> single_;
  std::string seed_ = "1";
  Run_options run_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_EXPERIMENT_COMMAND_H
