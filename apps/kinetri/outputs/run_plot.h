// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figure of a run: its events, queues and run times.
#ifndef KINETRI_APPS_RUN_PLOT_H
#define KINETRI_APPS_RUN_PLOT_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/impl/io/stats_file.h"
#include "kinetri/simulation/event_statistics.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

/// The state of a run at a time.
struct Run_sample {
  double time = 0;
  Event_counts events = {};       ///< of this run, so far
  std::size_t queue = 0;          ///< length of the triangulation's
  std::size_t contact_queue = 0;  ///< and of that of contacts and scheduled changes
};

/// Samples a run at some 200 regular times.
class Run_sampler {
 public:
  /// Counts from the present on.
  void start(double until, const Any_simulation& simulation);

  /// The time of the next sample; none after the last.
  std::optional<double> next_time() const;

  /// Takes the next sample. Precondition: next_time() is the time of the simulation.
  void take(const Any_simulation& simulation);

  /// Samples the present state of an interrupted run, unless it has been sampled.
  void finish(const Any_simulation& simulation);

  const std::vector<Run_sample>& samples() const { return samples_; }

 private:
  std::vector<double> times_;
  std::size_t next_ = 0;
  Event_counts events_before_ = {};
  std::vector<Run_sample> samples_;
};

/// The figure as SVG. Throws as draw. Precondition: there is a sample, and times ascend.
std::string draw_run(const std::vector<Run_sample>& samples, const Run_statistics& statistics);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_PLOT_H
