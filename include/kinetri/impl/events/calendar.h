// SPDX-License-Identifier: GPL-3.0-or-later
//
// The slots of a calendar queue. It stores handles only; the queue knows the items, and which
// records are still valid.
#ifndef KINETRI_IMPL_EVENTS_CALENDAR_H
#define KINETRI_IMPL_EVENTS_CALENDAR_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/events/queue_handle.h"

namespace kinetri::detail {

/// Slots of equal width, in ascending order, that are opened one after the other. A slot holds
/// records: handles in no order. A slot is given by a number whose integer part is its index.
/// Numbers beyond the last slot are allowed; nothing is recorded for them.
class Calendar {
 public:
  /// The fewest items for which slots pay.
  static constexpr std::size_t least_items = 9;

  /// The slot of a bound; monotone in the bound, in spite of rounding.
  double slot(double bound) const { return (bound - origin_) * slots_per_unit_; }
  /// Whether the slot has been opened; true for NaN (0 times infinity).
  bool is_open(double slot) const { return !(slot >= open_slots_); }
  bool has_slot(double slot) const { return slot < static_cast<double>(std::ssize(slots_)); }
  bool has_next() const { return has_slot(open_slots_); }

  std::size_t number_of_records() const { return records_; }

  /// Records the handle in the slot, if there is one of that number. Returns whether the slot got
  /// another chunk for the record.
  bool record(double slot, Queue_handle handle);

  /// Whether the handle is recorded in the slot. Precondition: has_slot(slot).
  bool is_recorded(double slot, Queue_handle handle) const;

  /// Opens the next slot, removes its records and calls `visit` with each span of them, of at most
  /// Chunk::capacity handles. Precondition: has_next(). `visit` must not change the calendar.
  template <class Visit>
  void open_next(const Visit& visit);

  /// Removes all slots and records; then every bound is in an open slot.
  void reset();

  /// Makes slots for the first three quarters of `items` items, whose least bound is `least` and of
  /// whose bounds `sample` is a sorted sample; for more of them if these have one bound, for fewer
  /// if only bounds up to `greatest` matter. Makes no slots if the bounds are too near to each
  /// other or too far apart. Precondition: reset() was called.
  void choose_slots(double least, std::span<const double> sample, std::size_t items,
                    double greatest);

  /// A cache line of records: a slot is a list of these.
  struct Chunk {
    static constexpr std::size_t capacity = 14;  ///< the most records in one
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no chunk

    std::uint32_t next = none;                   ///< of the list
    std::uint32_t size = 0;                      ///< the number of records
    std::array<Queue_handle, capacity> handles;  ///< the records
  };

 private:
  std::vector<std::uint32_t> slots_;  // the first chunk of each
  std::vector<Chunk> chunks_;
  std::uint32_t free_chunk_ = Chunk::none;  // the first of a list
  double open_slots_ = 1;                   // the number of these
  double origin_ = 0;
  double slots_per_unit_ = 0;
  std::size_t records_ = 0;
};

inline bool Calendar::record(double slot, Queue_handle handle) {
  if (!has_slot(slot)) return false;
  std::uint32_t& first = slots_[static_cast<std::size_t>(slot)];
  std::uint32_t chunk = first;
  const bool is_full = chunk == Chunk::none || chunks_[chunk].size == Chunk::capacity;
  if (is_full) {
    if (free_chunk_ == Chunk::none) {
      free_chunk_ = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    }
    const std::uint32_t added = std::exchange(free_chunk_, chunks_[free_chunk_].next);
    chunks_[added].next = chunk;
    chunks_[added].size = 0;
    chunk = first = added;
  }
  chunks_[chunk].handles[chunks_[chunk].size++] = handle;
  ++records_;
  return is_full;
}

template <class Visit>
inline void Calendar::open_next(const Visit& visit) {
  std::uint32_t chunk = slots_[static_cast<std::size_t>(open_slots_)];
  ++open_slots_;
  while (chunk != Chunk::none) {
    Chunk& records = chunks_[chunk];
    visit(std::span<const Queue_handle>(records.handles.data(), records.size));
    records_ -= records.size;
    const std::uint32_t next = records.next;
    records.next = std::exchange(free_chunk_, chunk);
    chunk = next;
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_EVENTS_CALENDAR_H
