// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_EVENTS_INDEXED_QUEUE_IMPL_H
#define KINETRI_IMPL_EVENTS_INDEXED_QUEUE_IMPL_H

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "kinetri/impl/events/indexed_queue.h"

namespace kinetri {

// --- Items enter and leave ----------------------------------------------------------------------

template <class Item, Bounding_order<Item> Less>
template <class... Parts>
inline Queue_handle Indexed_queue<Item, Less>::emplace(Parts&&... parts) {
  KINETRI_PRECONDITION(size_ < far, "the queue is full");
  const Queue_handle handle = acquire_handle();
  Item* const item = &places_[handle].item;
  std::destroy_at(item);
  std::construct_at(item, std::forward<Parts>(parts)...);
  ++size_;
  if (insert(handle)) keep_in_order();
  ++counters_.pushed;
  counters_.peak = std::max<std::uint64_t>(counters_.peak, size_);
  return handle;
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::begin_assign(std::size_t size) {
  KINETRI_PRECONDITION(places_.empty(), "the queue has been used");
  KINETRI_PRECONDITION(size < far, "too many items");
  places_.resize(size);
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::end_assign() {
  for (std::size_t h = places_.size(); h-- > 0;) {
    if (places_[h].position == nowhere) free_.push_back(static_cast<Queue_handle>(h));
  }
  size_ = far_ = places_.size() - free_.size();
  spread();
  settle();
  counters_.pushed += size_;
  counters_.peak = std::max<std::uint64_t>(counters_.peak, size_);
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::forget_order() {
  heap_ = {};
  free_ = {};
  calendar_ = {};
}

template <class Item, Bounding_order<Item> Less>
inline Item Indexed_queue<Item, Less>::erase(Queue_handle handle) {
  KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
  ++counters_.discarded;
  return take(handle);
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::clear() {
  Indexed_queue cleared(less_);
  cleared.counters_ = counters_;
  cleared.counters_.discarded += size();
  *this = std::move(cleared);
}

template <class Item, Bounding_order<Item> Less>
template <class Function>
void Indexed_queue<Item, Less>::for_each(Function function) const {
  for (const Place& place : places_) {
    if (place.position != nowhere) function(place.item);
  }
}

// A free handle; the one that was freed last.
template <class Item, Bounding_order<Item> Less>
inline Queue_handle Indexed_queue<Item, Less>::acquire_handle() {
  if (free_.empty()) [[unlikely]]
    add_handle();
  const Queue_handle handle = free_.back();
  free_.pop_back();
  return handle;
}

// Makes another handle. Grows by an eighth, not by half or more, since queues are large.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::add_handle() {
  const std::size_t size = places_.size();
  if (size == places_.capacity()) places_.reserve(size + size / 8 + 16);
  free_.push_back(static_cast<Queue_handle>(size));
  places_.emplace_back();
}

// Removes the item of `handle` and frees the handle. Moving it out releases what it owned.
template <class Item, Bounding_order<Item> Less>
inline Item Indexed_queue<Item, Less>::take(Queue_handle handle) {
  remove(handle);
  free_.push_back(handle);
  return std::move(places_[handle].item);
}

// Removes the item of `handle` from the heap; the record of a far item stays until its slot is
// opened.
template <class Item, Bounding_order<Item> Less>
inline void Indexed_queue<Item, Less>::remove(Queue_handle handle) {
  --size_;
  const std::uint32_t position = std::exchange(places_[handle].position, nowhere);
  if (position == far) {
    --far_;
    return;
  }
  const Node last = heap_.back();
  heap_.pop_back();
  if (position == 0) {
    if (!heap_.empty()) sift_down(0, last);
    settle();
  } else if (last.handle != handle) {
    restore_order(position, last);
  }
}

// --- The calendar -------------------------------------------------------------------------------

// Puts the item of `handle`, which is nowhere, into the heap or a slot. Returns false if the first
// item of the heap is still the least, and no slot has become longer.
template <class Item, Bounding_order<Item> Less>
inline bool Indexed_queue<Item, Less>::insert(Queue_handle handle) {
  const double s = slot(places_[handle].item);
  if (calendar_.is_open(s)) {
    insert_into_heap({bounds(handle), handle});
    return true;
  }
  places_[handle].position = far;
  ++far_;
  const bool is_longer = calendar_.record(s, handle);
  // If there was no far item, the heap may be empty, or the bounds of its first item may extend
  // beyond the open slots.
  return is_longer || far_ == 1;
}

// Distributes all items over new slots if the slots are too long, and opens slots until the least
// item of all is in the heap.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::keep_in_order() {
  if (has_long_slots()) spread_all();
  settle();
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::expect(double bound) {
  spread_all(bound);
  settle();
}

// Distributes all items over slots chosen for them; those that are in the heap become far first.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::spread_all(double greatest) {
  far_ = size_;
  for (const Node& node : heap_) places_[node.handle].position = far;
  heap_.clear();
  spread(greatest);
}

template <class Item, Bounding_order<Item> Less>
inline bool Indexed_queue<Item, Less>::is_settled() const {
  return far_ == 0 ||
         (!heap_.empty() && calendar_.is_open(calendar_.slot(heap_.front().bounds.upper)));
}

template <class Item, Bounding_order<Item> Less>
inline void Indexed_queue<Item, Less>::settle() {
  while (!is_settled()) open_next_slot();
}

// Whether there are too many items for the slots, or too many records of items that have left.
template <class Item, Bounding_order<Item> Less>
inline bool Indexed_queue<Item, Less>::has_long_slots() const {
  constexpr std::size_t least_size = 32;
  return size_ > 4 * size_at_spread_ + least_size ||
         calendar_.number_of_records() > 4 * size_ + least_size;
}

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::open_next_slot() {
  if (!calendar_.has_next()) return spread();
  calendar_.open_next([this](std::span<const Queue_handle> handles) {
    for (const Queue_handle handle : handles) detail::prefetch_address(&places_[handle]);
    // Without branches, which would be mispredicted.
    std::array<Queue_handle, detail::Calendar::Chunk::capacity> due;
    std::size_t number_due = 0;
    for (const Queue_handle handle : handles) {
      const Place& place = places_[handle];
      due[number_due] = handle;
      number_due += static_cast<std::size_t>(place.position == far) &
                    static_cast<std::size_t>(calendar_.is_open(slot(place.item)));
    }
    for (const Queue_handle handle : std::span(due.data(), number_due)) {
      if (places_[handle].position != far) continue;  // recorded twice
      --far_;
      less_.prefetch(places_[handle].item);
      insert_into_heap({bounds(handle), handle});
    }
    for (const Queue_handle handle : std::span(due.data(), number_due)) {
      less_.prefetch_more(places_[handle].item);
    }
  });
}

// Distributes the far items over slots chosen for them, or for those up to `greatest`. O(n); called
// when the queue has grown to a multiple, or all slots are open.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::spread(double greatest) {
  calendar_.reset();
  size_at_spread_ = size_;
  choose_slots(greatest);
  far_ = 0;
  for (Queue_handle handle = 0; handle < places_.size(); ++handle) {
    if (places_[handle].position == far) insert(handle);
  }
}

// Chooses slots for the far items. There are none, and all items go to the heap, if the items are
// too few, too near to each other, or too far apart.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::choose_slots(double greatest) {
  if (far_ < detail::Calendar::least_items) return;
  double least = std::numeric_limits<double>::infinity();
  for (const Place& place : places_) {
    if (place.position == far) least = std::min(least, less_.bounds(place.item).lower);
  }
  constexpr std::size_t sample_size = 256;
  const std::size_t stride = places_.size() / sample_size + 1;
  std::vector<double> sample;
  for (std::size_t h = 0; h < places_.size(); h += stride) {
    if (places_[h].position == far) sample.push_back(less_.bounds(places_[h].item).lower);
  }
  std::sort(sample.begin(), sample.end());
  calendar_.choose_slots(least, sample, far_, greatest);
}

// --- The heap -----------------------------------------------------------------------------------

template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::insert_into_heap(const Node& node) {
  heap_.push_back(node);
  if (!sift_up(heap_.size() - 1, node)) place(heap_.size() - 1, node);
}

// The position of the least of the children that begin at `first_child`, which exists.
template <class Item, Bounding_order<Item> Less>
std::size_t Indexed_queue<Item, Less>::least_child(std::size_t first_child) const {
  const std::size_t end = std::min(first_child + arity, heap_.size());
  // By the bounds first, without branches, which would be mispredicted.
  std::size_t least = first_child;
  bool overlap = false;
  for (std::size_t child = first_child + 1; child < end; ++child) {
    const Double_interval& a = heap_[child].bounds;
    const Double_interval& b = heap_[least].bounds;
    overlap |= !(std::max(a.lower, b.lower) > std::min(a.upper, b.upper));
    least = a.lower < b.lower ? child : least;
  }
  if (!overlap) return least;
  least = first_child;
  for (std::size_t child = first_child + 1; child < end; ++child) {
    if (less(heap_[child], heap_[least])) least = child;
  }
  return least;
}

// Moves the hole at `position` up to where `node` belongs and fills it. Returns false, and does
// nothing, if the node does not belong above `position`.
template <class Item, Bounding_order<Item> Less>
bool Indexed_queue<Item, Less>::sift_up(std::size_t position, const Node& node) {
  const std::size_t start = position;
  while (position > 0) {
    const std::size_t parent = (position - 1) / arity;
    if (!less(node, heap_[parent])) break;
    place(position, heap_[parent]);
    position = parent;
  }
  if (position == start) return false;
  place(position, node);
  return true;
}

// Moves the hole at `position` down to where `node` belongs and fills it.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::sift_down(std::size_t position, const Node& node) {
  for (std::size_t child = arity * position + 1; child < heap_.size();
       child = arity * position + 1) {
    const std::size_t least = least_child(child);
    if (!less(heap_[least], node)) break;
    place(position, heap_[least]);
    position = least;
  }
  place(position, node);
}

// Fills the hole at `position` with `node`, which may belong above or below it.
template <class Item, Bounding_order<Item> Less>
void Indexed_queue<Item, Less>::restore_order(std::size_t position, const Node& node) {
  if (!sift_up(position, node)) sift_down(position, node);
}

// --- The audit ----------------------------------------------------------------------------------

template <class Item, Bounding_order<Item> Less>
bool Indexed_queue<Item, Less>::is_valid(const Less& order) const {
  return size_ == heap_.size() + far_ && size_ + free_.size() == places_.size() &&
         is_heap_valid(order) && is_calendar_valid() &&
         std::all_of(free_.begin(), free_.end(), [this](Queue_handle handle) {
           return handle < places_.size() && places_[handle].position == nowhere;
         });
}

template <class Item, Bounding_order<Item> Less>
bool Indexed_queue<Item, Less>::is_heap_valid(const Less& order) const {
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    const Node& node = heap_[i];
    if (node.handle >= places_.size() || places_[node.handle].position != i) return false;
    if (i > 0 && less(node, heap_[(i - 1) / arity], order)) return false;
    if (!calendar_.is_open(calendar_.slot(node.bounds.lower))) return false;
  }
  return is_settled();
}

template <class Item, Bounding_order<Item> Less>
bool Indexed_queue<Item, Less>::is_calendar_valid() const {
  for (std::size_t h = 0; h < places_.size(); ++h) {
    if (places_[h].position != far) continue;
    const double s = slot(places_[h].item);
    if (calendar_.is_open(s)) return false;
    if (calendar_.has_slot(s) && !calendar_.is_recorded(s, static_cast<Queue_handle>(h))) {
      return false;
    }
  }
  return true;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_EVENTS_INDEXED_QUEUE_IMPL_H
