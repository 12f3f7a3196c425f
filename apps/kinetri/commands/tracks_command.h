// SPDX-License-Identifier: GPL-3.0-or-later
//
// `kinetri tracks`: the command line of a run of recorded tracks.
#ifndef KINETRI_APPS_TRACKS_COMMAND_H
#define KINETRI_APPS_TRACKS_COMMAND_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "cli/exit_code.h"
#include "commands/run_options.h"
#include "sources/tracks_source.h"

namespace kinetri::app {

/// The command: declares its options in the constructor; `run` after they were parsed.
class Tracks_command {
 public:
  explicit Tracks_command(CLI::App& program);
  Tracks_command(const Tracks_command&) = delete;
  Tracks_command& operator=(const Tracks_command&) = delete;

  bool chosen() const { return command_->parsed(); }

  /// Throws Usage_error, and what run_simulation throws.
  Exit_code run() const;

 private:
  Tracks_settings settings() const;

  // The options' values as they stand on the command line.
  CLI::App* command_;
  std::string tracks_;
  std::string format_ = "rows";
  std::optional<std::string> fps_;
  std::optional<std::string> from_;
  std::optional<std::string> until_;
  std::optional<std::string> longest_gap_;
  std::optional<std::string> ids_;
  std::optional<std::string> closest_;
  std::string collisions_ = "none";
  std::optional<std::string> radius_;
  Run_options run_options_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TRACKS_COMMAND_H
