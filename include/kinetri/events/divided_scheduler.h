// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scheduler in parts: several Event_schedulers that look like one. A run by regions gives each
// region a part of its own, which one thread may use while others use other parts. In one part it
// is an Event_scheduler, and costs no more than that.
#ifndef KINETRI_EVENTS_DIVIDED_SCHEDULER_H
#define KINETRI_EVENTS_DIVIDED_SCHEDULER_H

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/events/event_scheduler.h"

namespace kinetri::detail {

/// Entries in parts. A handle names the part in its highest bits, so that whoever has a handle
/// needs nothing else to find the entry. `Policy` has the functions that Event_scheduler asks for,
/// and these, which are called only where there are several parts:
///
/// | Function | Result |
/// |---|---|
/// | `part_of(entry)` | the part in which an entry belongs that is about to be scheduled |
/// | `handle(entry)` | the handle of an entry of the scheduler |
/// | `set_handle(entry, handle)` | notes that an entry has another handle from now on |
///
/// The order of entries is that of one scheduler, whatever their parts are. Several threads may
/// call const functions at once, and functions of different parts.
template <class Entry, class Policy>
class Divided_scheduler {
 public:
  using Part = Event_scheduler<Entry, Policy>;  ///< one of the parts

  /// One part, without entries. The policy must outlive the scheduler.
  explicit Divided_scheduler(const Policy& policy) : policy_(policy), first_(policy) {}

  // ---- parts ----

  /// Whether there are several parts.
  bool is_divided() const noexcept { return is_divided_; }

  /// Distributes the entries over `count` parts; handles are others then. `blocks` are entries that
  /// one thread moves: for_each_entry(block, function) calls function(handle, part) with each of
  /// them and the part where it belongs. in_parallel(vector, work) calls work with each element of
  /// a vector, by several threads if that helps. O(n).
  template <class Block, class For_each_entry, class In_parallel>
  void divide(std::size_t count, const std::vector<Block>& blocks,
              const For_each_entry& for_each_entry, const In_parallel& in_parallel) {
    struct Share {
      const Block* block;
      std::vector<std::pair<Queue_handle, std::uint32_t>> entries;  // with their parts
      std::vector<Queue_handle> next;                               // by part
    };
    std::vector<Share> shares;
    for (const Block& block : blocks) {
      shares.push_back({&block, {}, std::vector<Queue_handle>(count, 0)});
    }
    in_parallel(shares, [&](Share& share) {
      for_each_entry(*share.block, [&share](Queue_handle handle, std::size_t part) {
        share.entries.emplace_back(handle, static_cast<std::uint32_t>(part));
        ++share.next[part];
      });
    });
    std::vector<Filling> fillings(count);
    for (std::size_t p = 0; p < count; ++p) {
      fillings[p].part = p;
      for (Share& share : shares) {
        fillings[p].size += std::exchange(share.next[p], fillings[p].size);
      }
    }
    in_parallel(fillings, [](Filling& filling) { filling.moved.resize(filling.size); });
    const unsigned shift = shift_of(count);
    in_parallel(shares, [&](Share& share) {
      constexpr std::size_t ahead = 8;
      for (std::size_t k = 0; k < share.entries.size(); ++k) {
        if (k + ahead < share.entries.size()) prefetch(share.entries[k + ahead].first);
        const auto [handle, to] = share.entries[k];
        const Queue_handle local_handle = share.next[to]++;
        Moved& moved = fillings[to].moved[local_handle];
        moved.entry = (*this)[handle];
        if (moved.entry.time != Time_pool::none) {
          const Part& from = part(part_of(handle));
          moved.time = std::make_unique<Algebraic_number>(from.time_of(moved.entry));
          moved.entry.time = Time_pool::none;
        }
        policy_.set_handle(moved.entry, named(to, local_handle, shift));
      }
    });
    shares.clear();
    const Queue_counters before = sum_of_counters();
    make_parts(count);
    in_parallel(fillings, [this](Filling& filling) {
      Part& filled = part(filling.part);
      filled.assign(filling.size, [&](const auto& put) {
        for (Queue_handle h = 0; h < filling.size; ++h) {
          put(h, filling.moved[h].entry, std::move(filling.moved[h].time));
        }
      });
      filled.count_as({});
      filling.moved = std::vector<Moved>();
    });
    first_.count_as(before);
  }

  /// A part.
  Part& part(std::size_t number) { return number == 0 ? first_ : *more_[number - 1]; }
  const Part& part(std::size_t number) const { return number == 0 ? first_ : *more_[number - 1]; }

  /// The part that holds the entry of a handle.
  std::size_t part_of(Queue_handle handle) const {
    return static_cast<std::size_t>(std::uint64_t{handle} >> shift_);
  }

  /// Schedules an entry in a part. Its exact time is that of the same entry in `from`, if it has
  /// been made there.
  Queue_handle put(std::size_t to, Entry entry, const Part& from) {
    if (entry.time == Time_pool::none) return named(to, part(to).emplace(entry));
    Algebraic_number time = from.time_of(entry);
    return named(to, part(to).push(entry, std::move(time)));
  }

  /// The handle here of what has this handle in its part.
  Queue_handle named(std::size_t part, Queue_handle handle) const {
    return named(part, handle, shift_);
  }

  // ---- the same as Event_scheduler ----

  bool empty() const noexcept {
    return first_.empty() &&
           (!is_divided() || std::ranges::all_of(more_, [](const auto& p) { return p->empty(); }));
  }
  std::size_t size() const noexcept {
    std::size_t result = first_.size();
    for (const auto& part : more_) result += part->size();
    return result;
  }
  /// Without what a division has moved; of the first part alone as long as there are several.
  const Queue_counters& counters() const noexcept { return first_.counters(); }
  bool contains(Queue_handle handle) const noexcept {
    if (!is_divided()) return first_.contains(handle);
    return part_of(handle) <= more_.size() && part(part_of(handle)).contains(local(handle));
  }
  const Entry& operator[](Queue_handle handle) const {
    return is_divided() ? part(part_of(handle))[local(handle)] : first_[handle];
  }
  const Entry& top() const { return is_divided() ? part(first_part()).top() : first_.top(); }
  KINETRI_ALWAYS_INLINE void prefetch(Queue_handle handle) const {
    if (!is_divided()) return first_.prefetch(handle);
    if (handle != no_event) part(part_of(handle)).prefetch(local(handle));
  }
  template <class Function>
  void for_each(Function function) const {
    first_.for_each(function);
    for (const auto& part : more_) part->for_each(function);
  }
  bool is_valid() const {
    return first_.is_valid() &&
           std::ranges::all_of(more_, [](const auto& part) { return part->is_valid(); });
  }

  template <class... Parts>
  KINETRI_ALWAYS_INLINE Queue_handle emplace(Parts&&... parts) {
    if (is_divided()) [[unlikely]]
      return emplace_in_parts(Entry(std::forward<Parts>(parts)...));
    return first_.emplace(std::forward<Parts>(parts)...);
  }
  Queue_handle push(Entry entry, Algebraic_number time) {
    if (!is_divided()) return first_.push(std::move(entry), std::move(time));
    const std::size_t to = policy_.part_of(entry);
    return named(to, part(to).push(std::move(entry), std::move(time)));
  }
  /// Leaves one part.
  template <class Fill>
  void assign(std::size_t size, Fill fill) {
    first_.assign(size, std::move(fill));
  }
  KINETRI_ALWAYS_INLINE Entry pop() {
    if (is_divided()) [[unlikely]]
      return pop_of_parts();
    return first_.pop();
  }
  KINETRI_ALWAYS_INLINE Entry erase(Queue_handle handle) {
    if (is_divided()) [[unlikely]]
      return erase_from_parts(handle);
    return first_.erase(handle);
  }
  /// Takes all entries out, and leaves one part.
  void clear() {
    Queue_counters cleared = sum_of_counters();
    cleared.discarded += size();
    make_parts(1);
    first_.count_as(cleared);
  }

  const Algebraic_number& time(const Entry& entry) { return part_with(entry).time(entry); }
  Algebraic_number time_of(const Entry& entry) const {
    return const_cast<Divided_scheduler*>(this)->part_with(entry).Part::time_of(entry);
  }
  template <class Exact_time>
  bool is_due(const Entry& entry, const Double_interval& bounds, const Exact_time& exact_time) {
    if (entry.bounds.upper < bounds.lower) return true;
    if (entry.bounds.lower > bounds.upper) return false;
    return time(entry) <= exact_time();
  }
  template <class Is_due, class Recheck>
  bool settle(const Is_due& is_due, const Recheck& recheck) {
    if (!is_divided()) return first_.settle(is_due, recheck);
    while (!empty() && is_due(top())) {
      if (!policy_.is_recheck(top())) return true;
      const Entry entry = pop();
      recheck(std::span<const Entry>(&entry, 1));
    }
    return false;
  }

 private:
  // An entry on its way to another part, and its exact time if that has been made.
  struct Moved {
    Entry entry;
    std::unique_ptr<Algebraic_number> time;
  };

  // What a part will hold.
  struct Filling {
    std::size_t part = 0;
    Queue_handle size = 0;
    std::vector<Moved> moved;
  };

  // How many bits handles have in a part, of so many.
  static unsigned shift_of(std::size_t count) {
    return 32 - static_cast<unsigned>(std::bit_width(count - 1));
  }
  static Queue_handle named(std::size_t part, Queue_handle handle, unsigned shift) {
    return static_cast<Queue_handle>((std::uint64_t{part} << shift) | handle);
  }

  // What is done where there are several parts: not inlined, so that one part costs no more.
  Queue_handle emplace_in_parts(const Entry& entry) {
    const std::size_t to = policy_.part_of(entry);
    return named(to, part(to).emplace(entry));
  }
  Entry pop_of_parts() { return part(first_part()).pop(); }
  Entry erase_from_parts(Queue_handle handle) { return part(part_of(handle)).erase(local(handle)); }

  // The part that has the first entry. Precondition: not empty.
  std::size_t first_part() const {
    std::size_t first = 0;
    for (std::size_t p = 1; p <= more_.size(); ++p) {
      if (part(p).empty()) continue;
      if (part(first).empty() || precedes(part(p), part(first))) first = p;
    }
    return first;
  }

  // Makes so many empty parts.
  void make_parts(std::size_t count) {
    first_.clear();
    more_.clear();
    while (more_.size() + 1 < count) more_.push_back(std::make_unique<Part>(policy_));
    is_divided_ = count > 1;
    shift_ = shift_of(count);
  }

  Queue_counters sum_of_counters() const {
    Queue_counters result = first_.counters();
    for (const auto& part : more_) {
      result.pushed += part->counters().pushed;
      result.discarded += part->counters().discarded;
      result.peak = std::max(result.peak, part->counters().peak);
    }
    return result;
  }

  Queue_handle local(Queue_handle handle) const {
    return static_cast<Queue_handle>(handle & ((std::uint64_t{1} << shift_) - 1));
  }

  Part& part_with(const Entry& entry) {
    return is_divided() ? part(part_of(policy_.handle(entry))) : first_;
  }

  // The first entries of two parts.
  bool precedes(const Part& p, const Part& q) const {
    const Entry& a = p.top();
    const Entry& b = q.top();
    if (a.bounds.upper < b.bounds.lower) return true;
    if (b.bounds.upper < a.bounds.lower) return false;
    const auto order = p.time_of(a) <=> q.time_of(b);
    return order != 0 ? order < 0 : policy_.precedes(a, b);
  }

  const Policy& policy_;
  Part first_;  // the only one, mostly
  std::vector<std::unique_ptr<Part>> more_;
  bool is_divided_ = false;
  unsigned shift_ = 32;  // handles have so many bits in their part
};

}  // namespace kinetri::detail

#endif  // KINETRI_EVENTS_DIVIDED_SCHEDULER_H
