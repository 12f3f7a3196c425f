// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of all commands that run a simulation.
#ifndef KINETRI_APPS_RUN_OPTIONS_H
#define KINETRI_APPS_RUN_OPTIONS_H

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "outputs/output_table.h"
#include "runs/run_settings.h"

namespace kinetri::app {

/// Their texts.
struct Run_options {
  std::optional<std::string> until;
  std::optional<std::string> until_share;
  Output_paths outputs;
  std::optional<std::string> range;
  std::vector<std::string> between;
  std::optional<std::string> ridge;
  std::optional<std::string> walkable;
  std::optional<std::string> cutoff;
  std::vector<std::string> framed;  ///< the options for outputs in frames that the command has
  std::optional<std::string> thermostat;
  std::optional<std::string> frames_per_time;
  std::string frames_per_time_option;  ///< all names, since any of them may have been used
  std::optional<std::string> html_view;
  std::optional<std::string> max_events;
  std::string threads = "0";
  std::string audit = "none";
  std::string progress = "auto";
  bool exact_only = false;
  bool verify = false;
  bool quiet = false;
};

/// Declares --until, and --until-share, which may replace it. `options` must outlive the command.
void add_end_options(Command& command, Run_options& options);

/// The value of --until; none if --until-share is given instead. Throws Usage_error if neither is
/// given.
std::optional<double> until_argument(const Run_options& options);

/// Declares --thermostat. `options` must outlive the command.
void add_thermostat_option(Command& command, Run_options& options);

/// Declares the other options; the command's own must have been declared. `requested`: outputs that
/// only some commands have. `options` must outlive the command.
void add_run_options(Command& command, Run_options& options,
                     std::initializer_list<Output> requested = {});

/// The values of all options except --until. Throws Usage_error.
Run_settings run_settings(const Run_options& options);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_OPTIONS_H
