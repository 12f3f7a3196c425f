// SPDX-License-Identifier: GPL-3.0-or-later
//
// What runs of every kind measure, and tell the user at their end.
#ifndef KINETRI_APPS_RUN_SUMMARY_H
#define KINETRI_APPS_RUN_SUMMARY_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/progress.h"
#include "kinetri/impl/io/stats_file.h"
#include "kinetri/triangulation/audit.h"

namespace kinetri::app {

/// Measures stages of a run.
class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// The most memory that the program has used; 0 if the system does not tell.
std::uint64_t peak_rss_bytes();

/// Reports and counts the failures of the audits of a run.
class Audits {
 public:
  /// Counts the audit in the statistics, and reports up to 100 failures of the run on standard
  /// error.
  void note(const Audit_report& audited, double time, Run_statistics& statistics,
            Progress& progress);

 private:
  std::size_t failures_ = 0;
};

/// The last line of a run with audits that failed. Precondition: there are such audits.
void report_failed_audits(const Run_statistics& statistics);

/// What the summary says besides the statistics.
struct Run_summary {
  std::uint64_t events_before = 0;      ///< of the run that this one continues
  std::string end;                      ///< why the run has ended early, as in ", interrupted"
  std::vector<std::string> remarks;     ///< about the input
  std::string coincident;               ///< points that coincide at the start; may be empty
  std::optional<double> covered_share;  ///< of the box, by discs
  std::vector<std::string> paths;       ///< of outputs
};

/// Prints the summary of a run on standard error.
void print_summary(const Run_summary& summary, const Run_statistics& statistics);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_SUMMARY_H
