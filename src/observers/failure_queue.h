// SPDX-License-Identifier: GPL-3.0-or-later
//
// The queue of an observer: the failures of its own certificates, in the exact order of time.
#ifndef KINETRI_SRC_OBSERVERS_FAILURE_QUEUE_H
#define KINETRI_SRC_OBSERVERS_FAILURE_QUEUE_H

#include <optional>
#include <utility>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/events/event_scheduler.h"
#include "kinetri/kinetic/certificate.h"

namespace kinetri::detail {

/// The base of entries: when a certificate fails, or until when it certainly holds. A derived class
/// adds the subject of the certificate.
struct Failure : Scheduled {
  bool is_recheck = false;    ///< holds until bounds.lower, when it is to be checked again
  bool changes_sign = false;  ///< whether its polynomial certainly changes sign at the failure
};

/// The scheduled failures of an observer. `Observer` has these functions, which may be private if
/// the queue is a friend:
///
/// | Function | Result |
/// |---|---|
/// | `failure_time(entry)` | the exact time of an entry of which only bounds are known |
/// | `precedes(a, b)` | the order of two entries of one time, strict and total |
/// | `prefetch(entry)` | optional: starts to load memory for the first entry |
///
/// `prefetch` must be KINETRI_ALWAYS_INLINE (see detail::prefetch_address).
template <class Entry, class Observer>
class Failure_queue {
 public:
  using Time = Algebraic_number;  ///< of failures

  /// A removed entry, with its exact time.
  struct Due {
    Entry entry;  ///< what was pushed
    Time time;    ///< of the failure, or of the recheck
  };

  /// An empty queue of the observer, which must outlive it.
  explicit Failure_queue(const Observer& observer) : policy_{observer} {}

  /// Schedules the failure of a certificate under the entry. Returns no_event if it never fails.
  Queue_handle push(Entry entry, Certificate certificate) {
    if (certificate.kind == Certificate::Kind::never_fails) return no_event;
    entry.bounds = certificate.bounds;
    entry.is_recheck = certificate.kind == Certificate::Kind::holds;
    entry.changes_sign = !entry.is_recheck && !certificate.failure;
    return certificate.failure ? scheduler_.push(entry, std::move(*certificate.failure))
                               : scheduler_.emplace(entry);
  }

  /// Removes an entry, unless the handle is no_event.
  void erase(Queue_handle handle) {
    if (handle != no_event) scheduler_.erase(handle);
  }

  /// Removes the first entry if its time is at or before `time`. An entry at exactly that time
  /// stays if waits(entry); such entries come after the others. Precondition: `time` is not before
  /// that of any removed entry.
  template <class Waits>
  std::optional<Due> take_due(const Time& time, const Waits& waits) {
    if (scheduler_.empty()) return std::nullopt;
    const Entry& first = scheduler_.top();
    const Double_interval bounds = time.interval();
    if (first.bounds.lower > bounds.upper) return std::nullopt;
    if (first.bounds.upper >= bounds.lower) {
      const auto order = scheduler_.time(first) <=> time;
      if (waits(first) ? order >= 0 : order > 0) return std::nullopt;
    }
    Time its_time = scheduler_.time_of(first);
    return Due{scheduler_.pop(), std::move(its_time)};
  }
  /// The same if no entry waits.
  std::optional<Due> take_due(const Time& time) {
    return take_due(time, [](const Entry& /*entry*/) { return false; });
  }

  /// The entry of a handle. Precondition: it is in the queue.
  const Entry& operator[](Queue_handle handle) const { return scheduler_[handle]; }
  /// The exact time of an entry of the queue, computed once.
  const Time& time(const Entry& entry) { return scheduler_.time(entry); }
  /// Counts of the entries.
  const Queue_counters& counters() const { return scheduler_.counters(); }

 private:
  // See Event_scheduler.
  struct Policy {
    const Observer& observer;

    Time entry_time(const Entry& entry) const {
      return entry.is_recheck ? Time(entry.bounds.lower) : observer.failure_time(entry);
    }
    bool precedes(const Entry& a, const Entry& b) const { return observer.precedes(a, b); }
    bool is_recheck(const Entry& entry) const { return entry.is_recheck; }
    KINETRI_ALWAYS_INLINE static void prefetch(const Entry&) {}
    KINETRI_ALWAYS_INLINE static void prefetch_more(const Entry&) {}
    KINETRI_ALWAYS_INLINE void prefetch_first(const Entry& entry) const {
      if constexpr (requires { observer.prefetch(entry); }) observer.prefetch(entry);
    }
  };

  Policy policy_;
  Event_scheduler<Entry, Policy> scheduler_{policy_};
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_FAILURE_QUEUE_H
