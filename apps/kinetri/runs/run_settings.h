// SPDX-License-Identifier: GPL-3.0-or-later
//
// The settings of a run, independent of its source.
#ifndef KINETRI_APPS_RUN_SETTINGS_H
#define KINETRI_APPS_RUN_SETTINGS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "answers/answer_settings.h"
#include "cli/progress.h"
#include "outputs/output_table.h"

namespace kinetri::app {

enum class Audit_mode {
  none,
  end,
  events,  ///< at the start, after each group of simultaneous events, and at the end
};

/// The rate of frames.
struct Frame_rate {
  double per_time = 0;  ///< frames in a unit of time
  std::string option;   ///< the option, for messages
};

/// When a thermostat scales velocities, and to which kinetic energy.
struct Thermostat_settings {
  double per_time = 0;           ///< how often in a unit of time
  std::optional<double> energy;  ///< none: that at the start
};

struct Run_settings {
  Output_paths outputs;
  std::optional<Frame_rate> frame_rate;  ///< without one, there are 101 frames
  Answer_settings answers;
  std::uint64_t max_events = 1'000'000'000;  ///< the run stops after the instant that exceeds it
  std::string html_view;                     ///< what the page of --html shows first
  std::optional<double> html_range;          ///< of the encounters in that page
  std::optional<double> until_share;         ///< the run ends where the discs cover this share
  std::optional<Thermostat_settings> thermostat;
  Audit_mode audit = Audit_mode::none;
  std::size_t threads = 0;  ///< 0: as many as are available
  bool exact_only = false;  ///< without filters
  bool verifies = false;    ///< whether kinetri-verify checks the run
  Progress_mode progress = Progress_mode::automatic;
  bool quiet = false;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_SETTINGS_H
