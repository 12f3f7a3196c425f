// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a kinetic triangulation counts.
#ifndef KINETRI_TRIANGULATION_TRIANGULATION_COUNTERS_H
#define KINETRI_TRIANGULATION_TRIANGULATION_COUNTERS_H

#include <array>
#include <cstdint>

#include "kinetri/events/event.h"

namespace kinetri {

/// Counts of what the triangulation has done so far.
struct Triangulation_counters {
  std::array<std::uint64_t, event_kinds> events = {};  ///< by Event_kind
  /// Failures that were scheduled and did not happen, since the edge was removed or its neighbors
  /// changed; by the kind of event, coincidences as rebuild.
  std::array<std::uint64_t, event_kinds> discarded = {};
  std::uint64_t instants = 0;          ///< distinct times of failures
  std::uint64_t largest_instant = 0;   ///< the most events at one time
  std::uint64_t batches = 0;           ///< instants with two events or more
  std::uint64_t flat_hulls = 0;        ///< instants at which a triangle at the hull became flat
  std::uint64_t points_set_aside = 0;  ///< coinciding points temporarily removed
  std::uint64_t reconstructions = 0;   ///< of the whole triangulation, at degenerate times
  std::uint64_t rechecks = 0;          ///< certificates that held and were checked again

  /// The events of all kinds together.
  std::uint64_t number_of_events() const;

  friend bool operator==(const Triangulation_counters&, const Triangulation_counters&) = default;
};

/// How long the two stages of construction took, in seconds of wall-clock time.
struct Construction_seconds {
  double build = 0;       ///< the triangulation just after the start
  double initialize = 0;  ///< its certificates and the queue
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_TRIANGULATION_COUNTERS_H
