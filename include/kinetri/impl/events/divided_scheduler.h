// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scheduler in parts: several Event_schedulers with the interface of one. With several threads
// (docs/PARALLEL.md), each node of the tree of regions has parts of its own, which one thread may
// use while others use other parts. A single part costs no more than an Event_scheduler.
#ifndef KINETRI_IMPL_EVENTS_DIVIDED_SCHEDULER_H
#define KINETRI_IMPL_EVENTS_DIVIDED_SCHEDULER_H

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/events/event_scheduler.h"

namespace kinetri::detail {

/// Entries in parts. The highest bits of a handle are the number of the part. `Policy` has the
/// functions that Event_scheduler requires, and these, which are called only if there are several
/// parts, or to make them. The *subject* of an entry, entry.subject(), is what it is about.
///
/// | Function | Result |
/// |---|---|
/// | `part_of(subject)` | the part in which an entry about it belongs |
/// | `handle(subject)` | the handle of its entry in the scheduler |
/// | `set_handle(subject, handle)` | stores the new handle of its entry |
///
/// `Entry::Kept`, given by `entry.kept()`, is an entry without subject and times: Entry(subject,
/// bounds, kept) makes it again, without its exact time.
///
/// The order of entries does not depend on the parts. Several threads may call const functions at
/// once, and functions of different parts; between forget_first() and the next settle() or pop()
/// they may also call `erase` and `emplace` for entries of different parts.
///
/// A tournament finds the part with the first entry; settle() and pop() begin it, and later changes
/// update it. So an operation costs O(log parts) comparisons more than in one part.
///
/// What concerns several parts is defined in src/events/divided_scheduler_impl.h.
template <class Entry, class Policy>
class Divided_scheduler {
 public:
  using Part = Event_scheduler<Entry, Policy>;  ///< one of the parts

  /// One part, without entries. The policy must outlive the scheduler.
  explicit Divided_scheduler(const Policy& policy) : policy_(policy), first_(policy) {}

  // ---- parts ----

  bool is_divided() const noexcept { return !parts_.empty(); }

  /// Distributes the entries over `count` parts, at most 65536; invalidates handles. One thread
  /// moves the entries of a block: for_each_subject(block, function) calls function(subject) with
  /// the subjects, in the same order each time. in_parallel(vector, work) calls work with each
  /// element of a vector, on several threads if that helps. O(n). Meanwhile entries take half as
  /// much memory again. If it throws, the scheduler can only be cleared. Defined in
  /// src/events/distribute.h.
  template <class Block, class For_each_subject, class In_parallel>
  void distribute(std::size_t count, const std::vector<Block>& blocks,
                  const For_each_subject& for_each_subject, const In_parallel& in_parallel);

  /// The number of parts; at least one.
  std::size_t number_of_parts() const noexcept { return is_divided() ? parts_.size() : 1; }
  /// A part; numbers begin at 0.
  Part& part(std::size_t number) { return is_divided() ? *parts_[number] : first_; }
  const Part& part(std::size_t number) const { return is_divided() ? *parts_[number] : first_; }

  /// Forgets which part comes first; call it before the functions of parts change them. O(1).
  void forget_first() noexcept { winners_.clear(); }

  std::size_t part_of_handle(Queue_handle handle) const {
    return static_cast<std::size_t>(std::uint64_t{handle} >> shift_);
  }

  /// Moves the first entry of a part to another one, with its exact time if that has been made.
  void move_first(std::size_t from, std::size_t to);
  /// Moves each entry of a part to the part in which it belongs.
  void move_home(std::size_t from);

  /// The handle of the entry with this handle in its part.
  Queue_handle named(std::size_t part, Queue_handle handle) const {
    return named(part, handle, shift_);
  }

  // ---- the same as Event_scheduler ----

  bool empty() const noexcept {
    if (!is_divided()) return first_.empty();
    if (is_first_known()) return parts_[winners_[1]]->empty();
    return std::ranges::all_of(parts_, [](const auto& p) { return p->empty(); });
  }
  std::size_t size() const noexcept {
    std::size_t result = first_.size();
    for (const auto& part : parts_) result += part->size();
    return result;
  }
  /// Without the moves between parts.
  Queue_counters counters() const noexcept;
  bool contains(Queue_handle handle) const noexcept {
    if (!is_divided()) return first_.contains(handle);
    return part_of_handle(handle) < parts_.size() &&
           part(part_of_handle(handle)).contains(local(handle));
  }
  const Entry& operator[](Queue_handle handle) const {
    return is_divided() ? part(part_of_handle(handle))[local(handle)] : first_[handle];
  }
  template <class Amend>
  void amend(Queue_handle handle, const Amend& function) {
    is_divided() ? part(part_of_handle(handle)).amend(local(handle), function)
                 : first_.amend(handle, function);
  }
  KINETRI_ALWAYS_INLINE const Entry& top() const {
    if (is_divided()) [[unlikely]]
      return top_of_parts();
    return first_.top();
  }
  KINETRI_ALWAYS_INLINE void prefetch(Queue_handle handle) const {
    if (!is_divided()) return first_.prefetch(handle);
    if (handle != no_event) part(part_of_handle(handle)).prefetch(local(handle));
  }
  template <class Function>
  void for_each(Function function) const {
    first_.for_each(function);
    for (const auto& part : parts_) part->for_each(function);
  }
  bool is_valid() const;

  template <class... Parts>
  KINETRI_ALWAYS_INLINE Queue_handle emplace(Parts&&... parts) {
    if (is_divided()) [[unlikely]]
      return emplace_in_parts(Entry(std::forward<Parts>(parts)...));
    return first_.emplace(std::forward<Parts>(parts)...);
  }
  Queue_handle push(Entry entry, Algebraic_number time);
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
  /// Removes all entries, and leaves one part.
  void clear();

  const Algebraic_number& time(const Entry& entry) { return part_with(entry).time(entry); }
  Algebraic_number time_of(const Entry& entry) const {
    return const_cast<Divided_scheduler*>(this)->part_with(entry).Part::time_of(entry);
  }
  template <class Exact_time>
  bool is_due(const Entry& entry, const Double_interval& bounds, const Exact_time& exact_time) {
    return part_with(entry).is_due(entry, bounds, exact_time);
  }
  template <class Is_due, class Recheck>
  KINETRI_ALWAYS_INLINE bool settle(const Is_due& is_due, const Recheck& recheck) {
    if (is_divided()) [[unlikely]]
      return settle_parts(is_due, recheck);
    return first_.settle(is_due, recheck);
  }

 private:
  // The functions for several parts are not inlined, so that one part costs no more.
  template <class Is_due, class Recheck>
  bool settle_parts(const Is_due& is_due, const Recheck& recheck) {
    find_first();
    while (!empty() && is_due(top())) {
      if (!policy_.is_recheck(top())) return true;
      const Entry entry = pop();
      recheck(std::span<const Entry>(&entry, 1));
      find_first();  // recheck may have changed any part
    }
    return false;
  }

  // How many bits handles have in a part if there are so many parts.
  static unsigned shift_of(std::size_t count) {
    return 32 - static_cast<unsigned>(std::bit_width(count - 1));
  }
  static Queue_handle named(std::size_t part, Queue_handle handle, unsigned shift) {
    KINETRI_ASSERT((std::uint64_t{handle} >> shift) == 0, "the handle has room in its part");
    return static_cast<Queue_handle>((std::uint64_t{part} << shift) | handle);
  }

  Queue_handle emplace_in_parts(const Entry& entry);
  const Entry& top_of_parts() const;
  Entry pop_of_parts();
  Entry erase_from_parts(Queue_handle handle);

  // The tournament of p parts: match k, 1 <= k < p, is between the winners of 2 k and 2 k + 1, of
  // which those from p on are the parts themselves. A part without entries loses.
  bool is_first_known() const { return !winners_.empty(); }

  std::size_t player(std::size_t k) const {
    return k < parts_.size() ? winners_[k] : k - parts_.size();
  }
  // `time_in(part, entry)` is the exact time of an entry of the part.
  template <class Time_in>
  std::size_t winner(std::size_t match, const Time_in& time_in) const;

  void find_first();
  void follow(std::size_t changed) noexcept;
  void set_winner(std::size_t match);
  std::size_t first_part() const;

  Queue_handle local(Queue_handle handle) const {
    return static_cast<Queue_handle>(handle & ((std::uint64_t{1} << shift_) - 1));
  }

  Part& part_with(const Entry& entry) {
    return is_divided() ? part(part_of_handle(policy_.handle(entry.subject()))) : first_;
  }

  // An exact time that is not stored, so that several threads may compute it.
  static Algebraic_number made(const Part& part, const Entry& entry) { return part.time_of(entry); }

  template <class Time_in>
  bool precedes(Part& p, Part& q, const Time_in& time_in) const;

  const Policy& policy_;
  Part first_;                                // the only one, mostly; else empty
  std::vector<std::unique_ptr<Part>> parts_;  // if there are several
  std::vector<std::uint16_t> winners_;        // of the matches; empty if not known
  unsigned shift_ = 32;                       // handles have so many bits in their part
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_EVENTS_DIVIDED_SCHEDULER_H
