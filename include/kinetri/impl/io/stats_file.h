// SPDX-License-Identifier: GPL-3.0-or-later
//
// The statistics of a run, and the JSON file that holds them.
#ifndef KINETRI_IMPL_IO_STATS_FILE_H
#define KINETRI_IMPL_IO_STATS_FILE_H

#include <cstddef>
#include <cstdint>
#include <iosfwd>

#include "kinetri/impl/events/indexed_queue.h"
#include "kinetri/kinetic/certificate.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// The wall time of the parts of a run, in seconds.
struct Run_seconds {
  double read = 0;        ///< reading the points
  double build = 0;       ///< the first triangulation
  double initialize = 0;  ///< its first events
  double run = 0;         ///< events, without audits
  double audit = 0;       ///< audits
  double write = 0;       ///< edges; the event log is part of `run`

  /// The sum.
  double total() const { return read + build + initialize + run + audit + write; }
};

/// Counts and costs of a run.
struct Run_statistics {
  std::size_t points = 0;    ///< of the input
  double from = 0;           ///< the time at the start, rounded
  double until = 0;          ///< the intended end
  double reached = 0;        ///< the time at the end, rounded; `until` unless interrupted
  bool interrupted = false;  ///< whether the user stopped the run before `until`
  Triangulation_counters triangulation;  ///< events
  Certificate_counters certificates;     ///< of topology and contacts together
  Queue_counters queue;                  ///< of the triangulation
  Contact_counters contacts;             ///< of walls and discs
  Run_seconds seconds;                   ///< of wall time
  std::uint64_t peak_rss_bytes = 0;      ///< 0 if unknown
  std::uint64_t audits_run = 0;          ///< the number of audits
  std::uint64_t audits_failed = 0;       ///< the number of audits with failures
};

/// Writes the statistics as a JSON object, its keys always in the same order. `events` has one key
/// for each Event_kind. Errors are those of the stream.
void write_stats(std::ostream& out, const Run_statistics& statistics);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_STATS_FILE_H
