// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progress line of a run on standard error, which is overwritten.
#ifndef KINETRI_APPS_PROGRESS_H
#define KINETRI_APPS_PROGRESS_H

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinetri::app {

enum class Progress_mode {
  automatic,  ///< if standard error is a terminal
  always,
  never,
};

/// Whole seconds as "12 s", "3 min 07 s" or "2 h 05 min".
std::string readable_duration(double seconds);

/// The text of the progress line at simulated time `time`, `seconds` after the start.
std::string progress_text(double from, double until, double time, std::uint64_t events,
                          double seconds);

/// Shows the progress line until it is destroyed.
class Progress {
 public:
  explicit Progress(Progress_mode mode);
  ~Progress() { clear(); }

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The range of simulated time that show() reports.
  void set_range(double from, double until);

  /// Shows the stage, and restarts the clock of the event rate.
  void show_stage(std::string_view stage);

  /// Whether the line should be shown again: five times a second, if at all. Cost: reading the
  /// clock.
  bool due() const;

  void show(double time, std::uint64_t events);

  /// Removes the line. Call it before writing anything else to standard error.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void show_line(std::string text);

  bool enabled_;
  bool shown_ = false;
  double from_ = 0;
  double until_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PROGRESS_H
