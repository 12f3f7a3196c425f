// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri wave`: the command line of the paper's 2.5D wave.
#ifndef KINETRI_APPS_WAVE_COMMAND_H
#define KINETRI_APPS_WAVE_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "commands/run_options.h"
#include "simulation/wave.h"
#include "sources/generated_source.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Wave_command {
 public:
  explicit Wave_command(CLI::App& program);
  Wave_command(const Wave_command&) = delete;
  Wave_command& operator=(const Wave_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error, and what run_simulation throws.
  Exit_code run() const;

 private:
  Wave_setting setting() const;
  Generated_run wave() const;

  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string columns_ = "30";
  std::string rows_ = "30";
  std::string spacing_ = "10";
  std::optional<std::string> speed_;
  std::optional<std::string> radius_;
  std::string jitter_ = "0";
  std::string seed_ = "1";
  std::optional<std::string> height_;
  std::optional<std::string> width_;
  std::optional<std::string> until_;
  Run_options run_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_WAVE_COMMAND_H
