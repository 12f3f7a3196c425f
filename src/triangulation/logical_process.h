// SPDX-License-Identifier: GPL-3.0-or-later
//
// A logical process: it executes the events of one subdomain, or merged subdomain, in a time
// window.
#ifndef KINETRI_SRC_TRIANGULATION_LOGICAL_PROCESS_H
#define KINETRI_SRC_TRIANGULATION_LOGICAL_PROCESS_H

#include <cstddef>
#include <cstdint>
#include <limits>

#include "kinetri/impl/triangulation/schedule.h"
#include "triangulation/window_log.h"

namespace kinetri::detail {

/// The state of one node, a region or a union of regions. One thread at a time writes it.
///
/// Invariant: the entries that it executes are in the part `from` of each queue, its records in
/// `log`.
template <class Traits, bool has_contacts>
struct alignas(64) Logical_process {
  std::size_t number = 0;  ///< of the node
  unsigned level = 0;      ///< of the node; regions are 0
  bool is_root = false;
  std::size_t from = 0;                                     ///< the part of its entries
  typename Schedule<Traits>::Queue::Part* edges = nullptr;  ///< that part of the queue of edges
  Queue_handle first_handle = 0;                            ///< the first handle of that part
  /// New entries whose bounds begin at or before this time go to the part `from`, later ones to the
  /// part in which they are between two windows. Infinite for a region; minus infinity for a union
  /// that is not executing.
  double due_until = -std::numeric_limits<double>::infinity();
  typename Window_log<Traits, has_contacts>::Node* log = nullptr;  ///< of its events
  std::size_t most_events = 0;  ///< per window, if enough numbers are left
  std::size_t capacity = 0;     ///< the most events in this window
  Certificate_counters certificates = {};
  Triangulation_counters counters = {};
  std::uint64_t rolled_back = 0;  ///< events

  bool is_region() const { return level == 0; }
  bool has_room() const { return log->records.size() < capacity; }
};

/// Whether the entry of a handle is in a part other than `own`, and not later than the time
/// exact(), which is within `bounds`.
template <class Queue, class Exact>
bool waits_before(const Queue& queue, Queue_handle handle, const typename Queue::Part* own,
                  const Double_interval& bounds, const Exact& exact) {
  const typename Queue::Part& part = queue.part(queue.part_of_handle(handle));
  if (&part == own) return false;
  const auto& entry = queue[handle];
  if (entry.bounds.lower > bounds.upper) return false;
  return entry.bounds.upper < bounds.lower || part.time_of(entry) <= exact();
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_LOGICAL_PROCESS_H
