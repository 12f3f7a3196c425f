// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scheduler: an event queue in the exact order of time. Most entries have only an interval that
// contains the time; the exact number is made when intervals do not decide. The triangulation
// schedules failures of certificates, the simulation contacts.
#ifndef KINETRI_IMPL_EVENTS_EVENT_SCHEDULER_H
#define KINETRI_IMPL_EVENTS_EVENT_SCHEDULER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/impl/events/indexed_queue.h"

namespace kinetri::detail {

/// The exact times of entries. Few entries need one, so an entry has an index instead of a time.
class Time_pool {
 public:
  using Index = std::uint32_t;

  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Keeps `time` until its index is released. References to other times stay valid.
  Index keep(Algebraic_number time) {
    if (free_.empty()) {
      times_.push_back(std::move(time));
      return static_cast<Index>(times_.size() - 1);
    }
    const Index index = free_.back();
    free_.pop_back();
    times_[index] = std::move(time);
    return index;
  }

  const Algebraic_number& operator[](Index index) const { return times_[index]; }

  /// Forgets the time of `index`. Does nothing for none.
  void release(Index index) {
    if (index == none) return;
    times_[index] = Algebraic_number();
    free_.push_back(index);
  }

  void clear() {
    times_.clear();
    free_.clear();
  }

 private:
  std::deque<Algebraic_number> times_;
  std::vector<Index> free_;
};

/// The times of an entry. Entries derive from it and add their subjects.
struct Scheduled {
  Double_interval bounds = {};  ///< contain the time
  /// The exact time in the scheduler's pool, if it has been made.
  mutable Time_pool::Index time = Time_pool::none;
};

/// A queue of entries. `Policy` has these functions, which the scheduler calls with its entries:
///
/// | Function | Result |
/// |---|---|
/// | `entry_time(entry)` | the exact time of an entry that was scheduled by bounds alone |
/// | `precedes(a, b)` | the order of two entries of one time, strict and total |
/// | `is_recheck(entry)` | whether the entry is no event, but a time to check a certificate again |
/// | `prefetch(entry)` | starts to load memory for an entry that will be first soon; static |
/// | `prefetch_more(entry)` | the same, one step later; static |
/// | `prefetch_first(entry)` | the same, when the entry has become the first one |
///
/// The const functions of a scheduler change nothing: several threads may call them at once.
template <class Entry, class Policy>
class Event_scheduler {
 public:
  /// Without entries. The policy must outlive the scheduler.
  explicit Event_scheduler(const Policy& policy)
      : policy_(policy), queue_(Order{this, Time_use::keep}) {}

  Event_scheduler(const Event_scheduler&) = delete;
  Event_scheduler& operator=(const Event_scheduler&) = delete;

  // ---- the entries, as in Indexed_queue ----

  bool empty() const noexcept { return queue_.empty(); }
  std::size_t size() const noexcept { return queue_.size(); }
  const Queue_counters& counters() const noexcept { return queue_.counters(); }
  void count_as(const Queue_counters& counters) noexcept { queue_.count_as(counters); }
  bool contains(Queue_handle handle) const noexcept { return queue_.contains(handle); }
  const Entry& operator[](Queue_handle handle) const { return queue_[handle]; }
  template <class Amend>
  void amend(Queue_handle handle, const Amend& function) {
    queue_.amend(handle, function);
  }
  KINETRI_ALWAYS_INLINE const Entry& top() const { return queue_.top(); }
  KINETRI_ALWAYS_INLINE void prefetch(Queue_handle handle) const { queue_.prefetch(handle); }
  template <class Function>
  void for_each(Function function) const {
    queue_.for_each(std::move(function));
  }
  bool is_valid() const { return queue_.is_valid(Order{this, Time_use::discard}); }

  // ---- scheduling ----

  template <class... Parts>
  Queue_handle emplace(Parts&&... parts) {
    return queue_.emplace(std::forward<Parts>(parts)...);
  }

  Queue_handle push(Entry entry, Algebraic_number time) {
    entry.time = times_.keep(std::move(time));
    return queue_.push(entry);
  }

  /// Schedules entries under handles less than `size`, as Indexed_queue::assign says: `fill` is
  /// called with a function put(handle, entry, time), which several threads may call; `time` is
  /// null or the exact time.
  template <class Fill>
  void assign(std::size_t size, Fill fill) {
    std::mutex times_are_kept;
    begin_assign(size);
    fill([&](Queue_handle handle, Entry entry, std::unique_ptr<Algebraic_number> time) {
      assign_entry(handle, std::move(entry), std::move(time), times_are_kept);
    });
    end_assign();
  }

  /// @{
  /// The steps of assign, as Indexed_queue has them. The mutex protects the exact times of one
  /// scheduler, or of several.
  void begin_assign(std::size_t size) { queue_.begin_assign(size); }
  void assign_entry(Queue_handle handle, Entry entry, std::unique_ptr<Algebraic_number> time,
                    std::mutex& times_are_kept) {
    entry.time = Time_pool::none;
    if (time) {
      const std::scoped_lock lock(times_are_kept);
      entry.time = times_.keep(std::move(*time));
    }
    queue_.assign_item(handle, std::move(entry));
  }
  void end_assign() { queue_.end_assign(); }
  /// @}

  void expect(double bound) { queue_.expect(bound); }
  /// Keeps exact times.
  void forget_order() { queue_.forget_order(); }

  /// Removes the first entry. Precondition: not empty.
  Entry pop() {
    const Entry entry = forgotten(queue_.pop());
    if (!empty()) policy_.prefetch_first(top());
    return entry;
  }

  /// Removes an entry. Precondition: contains(handle).
  Entry erase(Queue_handle handle) { return forgotten(queue_.erase(handle)); }

  void clear() {
    queue_.clear();
    times_.clear();
  }

  // ---- time ----

  /// The exact time of an entry of the queue, stored until the entry leaves.
  const Algebraic_number& time(const Entry& entry) { return kept_time(entry); }

  /// The same, not stored.
  Algebraic_number time_of(const Entry& entry) const {
    return entry.time == Time_pool::none ? policy_.entry_time(entry) : times_[entry.time];
  }

  /// Whether the time of an entry of the queue is at or before exact_time(), which is within
  /// `bounds`; exact_time is called only if intervals do not decide.
  template <class Exact_time>
  bool is_due(const Entry& entry, const Double_interval& bounds, const Exact_time& exact_time) {
    if (entry.bounds.upper < bounds.lower) return true;
    if (entry.bounds.lower > bounds.upper) return false;
    return time(entry) <= exact_time();
  }

  /// Rechecks certificates until the first entry is an event or is not due. Returns whether it is
  /// an event that is due. Calls `recheck` with one entry or two successive ones, which have been
  /// removed.
  template <class Is_due, class Recheck>
  KINETRI_ALWAYS_INLINE bool settle(const Is_due& is_due, const Recheck& recheck) {
    while (!empty() && is_due(top())) {
      if (!policy_.is_recheck(top())) return true;
      std::array<Entry, 2> entries = {pop(), Entry()};
      std::size_t number = 1;
      if (!empty() && policy_.is_recheck(top()) && is_due(top())) entries[number++] = pop();
      recheck(std::span<const Entry>(entries.data(), number));
    }
    return false;
  }

 private:
  /// Whether an exact time that a comparison needs is stored.
  enum class Time_use : bool { discard, keep };

  struct Order {
    const Event_scheduler* scheduler;
    Time_use use;

    bool operator()(const Entry& a, const Entry& b) const {
      const auto order = use == Time_use::keep ? scheduler->kept_time(a) <=> scheduler->kept_time(b)
                                               : scheduler->time_of(a) <=> scheduler->time_of(b);
      return order != 0 ? order < 0 : scheduler->policy_.precedes(a, b);
    }
    Double_interval bounds(const Entry& entry) const { return entry.bounds; }
    KINETRI_ALWAYS_INLINE static void prefetch(const Entry& entry) { Policy::prefetch(entry); }
    KINETRI_ALWAYS_INLINE static void prefetch_more(const Entry& entry) {
      Policy::prefetch_more(entry);
    }
  };

  // Const because the order, which the queue calls only when it changes, is const.
  const Algebraic_number& kept_time(const Entry& entry) const {
    if (entry.time == Time_pool::none) entry.time = times_.keep(policy_.entry_time(entry));
    return times_[entry.time];
  }

  Entry forgotten(Entry entry) {
    times_.release(entry.time);
    entry.time = Time_pool::none;
    return entry;
  }

  const Policy& policy_;
  mutable Time_pool times_;
  Indexed_queue<Entry, Order> queue_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_EVENTS_EVENT_SCHEDULER_H
