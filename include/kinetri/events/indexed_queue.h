// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event queue: a priority queue whose items are reached by handle, so that an event that became
// illegal is erased, or replaced, where it stands. It knows no geometry; the order is a parameter.
#ifndef KINETRI_EVENTS_INDEXED_QUEUE_H
#define KINETRI_EVENTS_INDEXED_QUEUE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/base/compiler.h"
#include "kinetri/base/double_interval.h"

namespace kinetri {

/// Names an item of an Indexed_queue from its push to its pop or erase; then it may be reused.
using Queue_handle = std::uint32_t;

/// The handle of no item.
inline constexpr Queue_handle no_event = std::numeric_limits<Queue_handle>::max();

/// How the queue was used. At any time pushed = popped + discarded + size.
struct Queue_counters {
  std::uint64_t pushed = 0;     ///< items that entered, by push or in place of another
  std::uint64_t discarded = 0;  ///< that left without having been popped: erased, replaced, cleared
  std::uint64_t peak = 0;       ///< the largest size so far

  friend bool operator==(const Queue_counters&, const Queue_counters&) = default;
};

/// An order that bounds its items: `bounds` gives an interval for each, and items with disjoint
/// intervals are in the order of these. The queue asks the order, with the memory accesses that
/// this costs, only about items whose bounds overlap.
///
/// It has two functions more, which may ask for the memory that an item will need: `prefetch` is
/// called for each of several items whose turn comes near, then, for each of them, `prefetch_more`,
/// which may use what the former has asked for. Both must be KINETRI_ALWAYS_INLINE; see
/// detail::prefetch_address.
template <class Less, class Item>
concept Bounding_order = requires(const Less& less, const Item& item) {
  { less.bounds(item) } -> std::same_as<Double_interval>;
  less.prefetch(item);
  less.prefetch_more(item);
};

/// A calendar queue with an index: the items whose turn is near are in a 4-ary implicit heap, the
/// others lie unordered in slots by their lower bounds, and reach the heap slot by slot. An item
/// that is replaced before its time, as most are, is never compared with another. Where the order
/// is not a Bounding_order all items are in the heap.
///
/// `Less` is a strict weak order on `Item`; give it a total one, and the order of pops depends on
/// the items alone, not on the history of the queue. `Item` is movable and has a
/// default; it need not be copyable.
///
/// push, pop, update, erase: constant expected cost where the bounds spread evenly, never more than
/// O(log n) comparisons; items stay where they are until they leave, and are then released at
/// once. top, contains, operator[]: O(1). An exception thrown by the order leaves the queue
/// unusable but destructible.
///
/// Source: R. Brown, Calendar queues: a fast O(1) priority queue implementation for the simulation
/// event set problem, Communications of the ACM 31, 1988.
template <class Item, class Less>
class Indexed_queue {
 public:
  /// An empty queue.
  explicit Indexed_queue(Less less = Less()) : less_(std::move(less)) {}

  /// Whether there is no item.
  bool empty() const noexcept { return heap_.empty(); }
  /// The number of items.
  std::size_t size() const noexcept { return size_; }

  /// Whether `handle` names an item of the queue.
  bool contains(Queue_handle handle) const noexcept {
    return handle < places_.size() && places_[handle].position != nowhere;
  }

  /// Inserts `item` and returns its handle. Precondition: size() < 2^32 - 2.
  Queue_handle push(Item item) { return emplace(std::move(item)); }

  /// Likewise an item that is made from `parts`, which refer to no item of the queue, where it will
  /// stay. Making it must not throw.
  template <class... Parts>
  Queue_handle emplace(Parts&&... parts);

  /// Inserts items under handles less than `size`, faster than one by one. Calls `fill` with a
  /// function put(handle, item), which is to be called at most once for each handle, in any order,
  /// by several threads if that helps; handles that are left out stay free. Linear in `size`.
  /// Precondition: the queue is empty and has had no item since it was made or cleared.
  template <class Fill>
  void assign(std::size_t size, Fill fill);

  /// The handle of the least item. Precondition: not empty.
  Queue_handle top_handle() const {
    KINETRI_PRECONDITION(!empty(), "top of an empty queue");
    return heap_.front().handle;
  }
  /// The least item. Precondition: not empty.
  const Item& top() const { return places_[top_handle()].item; }

  /// Removes the least item and returns it. Precondition: not empty.
  Item pop();

  /// The item of `handle`. Precondition: contains(handle).
  const Item& operator[](Queue_handle handle) const {
    KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
    return places_[handle].item;
  }

  /// Asks for the memory of the item of `handle`, which is wanted soon. Does nothing for no_event.
  /// Precondition: else the handle has been given out; its item may have left.
  KINETRI_ALWAYS_INLINE void prefetch(Queue_handle handle) const {
    if (handle != no_event) detail::prefetch_address(&places_[handle]);
  }

  /// Replaces the item of `handle`. Precondition: contains(handle).
  void update(Queue_handle handle, Item item);

  /// Removes the item of `handle` and returns it. Precondition: contains(handle).
  Item erase(Queue_handle handle);

  /// Removes all items.
  void clear();

  /// Calls `function` with each item, in the order of their handles. Linear in the largest size so
  /// far.
  template <class Function>
  void for_each(Function function) const;

  /// Counts since the queue was made; clear() goes on counting.
  const Queue_counters& counters() const noexcept { return counters_; }

  /// Whether heap order, slots and index are intact. O(n); for audits.
  bool is_valid() const;

 private:
  static constexpr std::size_t arity = 4;
  static constexpr std::size_t least_per_slot = 4;
  static constexpr std::size_t most_per_slot = 16;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t far = nowhere - 1;

  struct Place {
    Item item;
    std::uint32_t position = nowhere;  // in the heap, or far, or nowhere
  };

  // A cache line of records of far items: a slot is a list of these.
  struct Chunk {
    static constexpr std::size_t capacity = 14;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t next = none;
    std::uint32_t size = 0;
    std::array<Queue_handle, capacity> handles;
  };

  // What the heap holds: a handle, and the bounds of its item.
  struct Node {
    Double_interval bounds;
    Queue_handle handle;
  };

  Double_interval bounds(Queue_handle handle) const {
    if constexpr (Bounding_order<Less, Item>) {
      return less_.bounds(places_[handle].item);
    } else {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return {-infinity, infinity};
    }
  }

  // Alone, since the two bounds were written one by one: the processor waits where it reads both at
  // once soon after.
  double lower_bound(const Item& item) const {
    if constexpr (Bounding_order<Less, Item>) {
      return less_.bounds(item).lower;
    } else {
      return -std::numeric_limits<double>::infinity();
    }
  }

  bool less(const Node& a, const Node& b) const {
    if (a.bounds.upper < b.bounds.lower) return true;
    if (b.bounds.upper < a.bounds.lower) return false;
    return less_(places_[a.handle].item, places_[b.handle].item);
  }

  // The number of the slot of a bound, before truncation: monotone in the bound, even as rounded.
  double slot(double bound) const { return (bound - origin_) * slots_per_unit_; }
  // Whether the slot of a bound has been opened. So is what has no slot (0 times infinity).
  bool is_open(double bound) const { return !(slot(bound) >= open_slots_); }
  // Whether there is a slot of that number.
  bool has_slot(double number) const { return number < static_cast<double>(std::ssize(slots_)); }

  void place(std::size_t position, const Node& node) {
    heap_[position] = node;
    places_[node.handle].position = static_cast<std::uint32_t>(position);
  }

  Queue_handle acquire_handle();
  Item take(Queue_handle handle);
  void add(Queue_handle handle);
  bool insert(Queue_handle handle);
  void keep_in_order();
  void insert_into_heap(const Node& node);
  void remove(Queue_handle handle);
  void settle();
  bool has_long_slots() const;
  bool record(std::size_t slot, Queue_handle handle);
  void open_next_slot();
  void spread();
  bool choose_slots();

  std::size_t least_child(std::size_t first_child) const;
  bool sift_up(std::size_t position, const Node& node);
  void sift_down(std::size_t position, const Node& node);
  void restore_order(std::size_t position, const Node& node);

  // Invariants: an item is in the heap if its lower bound is in an open slot, else it is far. So
  // long as the upper bound of the heap's least item is in an open slot, that item is the least of
  // all; between two calls from outside it is. A far item is recorded in its slot, unless that is
  // beyond the last one; slots may also hold records of items that have left or moved, which are
  // recognized when they are opened.
  std::vector<Node> heap_;
  std::vector<Place> places_;         // by handle
  std::vector<Queue_handle> free_;    // a stack
  std::vector<std::uint32_t> slots_;  // the first chunk of each
  std::vector<Chunk> chunks_;
  std::uint32_t free_chunk_ = Chunk::none;  // the first of a list
  double open_slots_ = 1;                   // the number of these
  double origin_ = 0;
  double slots_per_unit_ = 0;
  std::size_t size_ = 0;            // of heap_, and far_: asked for at every change
  std::size_t far_ = 0;             // the number of far items
  std::size_t records_ = 0;         // in all slots
  std::size_t size_at_spread_ = 0;  // when the slots were chosen
  Queue_counters counters_;
  [[no_unique_address]] Less less_;
};

template <class Item, class Less>
template <class... Parts>
inline Queue_handle Indexed_queue<Item, Less>::emplace(Parts&&... parts) {
  KINETRI_PRECONDITION(size_ < far, "the queue is full");
  const Queue_handle handle = acquire_handle();
  Item* const item = &places_[handle].item;
  std::destroy_at(item);
  std::construct_at(item, std::forward<Parts>(parts)...);
  add(handle);
  ++counters_.pushed;
  counters_.peak = std::max<std::uint64_t>(counters_.peak, size_);
  return handle;
}

template <class Item, class Less>
template <class Fill>
void Indexed_queue<Item, Less>::assign(std::size_t size, Fill fill) {
  KINETRI_PRECONDITION(places_.empty(), "the queue has been used");
  KINETRI_PRECONDITION(size < far, "too many items");
  places_.resize(size);
  fill([this](Queue_handle handle, Item item) {
    places_[handle].item = std::move(item);
    places_[handle].position = far;
  });
  for (std::size_t h = size; h-- > 0;) {
    if (places_[h].position == nowhere) free_.push_back(static_cast<Queue_handle>(h));
  }
  size_ = far_ = size - free_.size();
  spread();
  settle();
  counters_.pushed += size_;
  counters_.peak = std::max<std::uint64_t>(counters_.peak, size_);
}

template <class Item, class Less>
Item Indexed_queue<Item, Less>::pop() {
  return take(top_handle());
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::update(Queue_handle handle, Item item) {
  KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
  remove(handle);
  places_[handle].item = std::move(item);
  add(handle);
  ++counters_.pushed;
  ++counters_.discarded;
}

template <class Item, class Less>
inline Item Indexed_queue<Item, Less>::erase(Queue_handle handle) {
  KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
  ++counters_.discarded;
  return take(handle);
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::clear() {
  Indexed_queue cleared(less_);
  cleared.counters_ = counters_;
  cleared.counters_.discarded += size();
  *this = std::move(cleared);
}

template <class Item, class Less>
template <class Function>
void Indexed_queue<Item, Less>::for_each(Function function) const {
  for (const Place& place : places_) {
    if (place.position != nowhere) function(place.item);
  }
}

template <class Item, class Less>
bool Indexed_queue<Item, Less>::is_valid() const {
  if (size_ != heap_.size() + far_ || size_ + free_.size() != places_.size()) return false;
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    if (heap_[i].handle >= places_.size() || places_[heap_[i].handle].position != i) return false;
    if (i > 0 && less(heap_[i], heap_[(i - 1) / arity])) return false;
    if (!is_open(heap_[i].bounds.lower)) return false;
  }
  if (far_ > 0 && (heap_.empty() || !is_open(heap_.front().bounds.upper))) return false;
  for (std::size_t h = 0; h < places_.size(); ++h) {
    if (places_[h].position != far) continue;
    const auto handle = static_cast<Queue_handle>(h);
    const double s = slot(bounds(handle).lower);
    if (!(s >= open_slots_)) return false;
    if (!has_slot(s)) continue;
    bool is_recorded = false;
    for (std::uint32_t c = slots_[static_cast<std::size_t>(s)]; c != Chunk::none;
         c = chunks_[c].next) {
      const auto begin = chunks_[c].handles.begin();
      const auto end = begin + chunks_[c].size;
      is_recorded = is_recorded || std::find(begin, end, handle) != end;
    }
    if (!is_recorded) return false;
  }
  return std::all_of(free_.begin(), free_.end(), [this](Queue_handle handle) {
    return handle < places_.size() && places_[handle].position == nowhere;
  });
}

// A handle that is not in use yet; the last one that became free first.
template <class Item, class Less>
inline Queue_handle Indexed_queue<Item, Less>::acquire_handle() {
  if (free_.empty()) {
    free_.push_back(static_cast<Queue_handle>(places_.size()));
    places_.emplace_back();
  }
  const Queue_handle handle = free_.back();
  free_.pop_back();
  return handle;
}

// Removes the item of `handle` and frees the handle. Moving it out releases what it owned.
template <class Item, class Less>
inline Item Indexed_queue<Item, Less>::take(Queue_handle handle) {
  remove(handle);
  free_.push_back(handle);
  return std::move(places_[handle].item);
}

// Adds the item of `handle` to the queue.
template <class Item, class Less>
inline void Indexed_queue<Item, Less>::add(Queue_handle handle) {
  ++size_;
  if (insert(handle)) keep_in_order();
}

// Puts the item of `handle`, which is nowhere, where it belongs. Returns false if the least item is
// first in the heap as it was before, and no slot has become long.
template <class Item, class Less>
inline bool Indexed_queue<Item, Less>::insert(Queue_handle handle) {
  const double s = slot(lower_bound(places_[handle].item));
  if (!(s >= open_slots_)) {
    insert_into_heap({bounds(handle), handle});
    return true;
  }
  places_[handle].position = far;
  ++far_;
  const bool is_longer = has_slot(s) && record(static_cast<std::size_t>(s), handle);
  // Where there was no far item the heap may be empty, or its first item have bounds that reach
  // beyond the open slots.
  return is_longer || far_ == 1;
}

// Spreads all items over slots anew where these have become too long, and opens slots until the
// least item of all is in the heap.
template <class Item, class Less>
void Indexed_queue<Item, Less>::keep_in_order() {
  if (has_long_slots()) {
    far_ = size_;
    for (const Node& node : heap_) places_[node.handle].position = far;
    heap_.clear();
    spread();
  }
  settle();
}

// Returns whether the slot got another chunk for this record.
template <class Item, class Less>
inline bool Indexed_queue<Item, Less>::record(std::size_t slot, Queue_handle handle) {
  std::uint32_t chunk = slots_[slot];
  const bool is_full = chunk == Chunk::none || chunks_[chunk].size == Chunk::capacity;
  if (is_full) {
    if (free_chunk_ == Chunk::none) {
      free_chunk_ = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    }
    const std::uint32_t added = std::exchange(free_chunk_, chunks_[free_chunk_].next);
    chunks_[added].next = chunk;
    chunks_[added].size = 0;
    chunk = slots_[slot] = added;
  }
  chunks_[chunk].handles[chunks_[chunk].size++] = handle;
  ++records_;
  return is_full;
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::insert_into_heap(const Node& node) {
  heap_.push_back(node);
  if (!sift_up(heap_.size() - 1, node)) place(heap_.size() - 1, node);
}

// Takes the item of `handle` out of the heap; of a far one only the record stays, until its slot is
// opened.
template <class Item, class Less>
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

// Opens slots until the least item of all is in the heap.
template <class Item, class Less>
inline void Indexed_queue<Item, Less>::settle() {
  while (far_ > 0 && (heap_.empty() || !is_open(heap_.front().bounds.upper))) open_next_slot();
}

// Whether there are too many items for the slots, or too many records of items that have left.
template <class Item, class Less>
inline bool Indexed_queue<Item, Less>::has_long_slots() const {
  if constexpr (Bounding_order<Less, Item>) {
    constexpr std::size_t least_size = 32;
    return size_ > 4 * size_at_spread_ + least_size || records_ > 4 * size_ + least_size;
  }
  return false;
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::open_next_slot() {
  if (!has_slot(open_slots_)) return spread();
  std::uint32_t chunk = slots_[static_cast<std::size_t>(open_slots_)];
  ++open_slots_;
  while (chunk != Chunk::none) {
    Chunk& records = chunks_[chunk];
    const std::span<const Queue_handle> handles(records.handles.data(), records.size);
    for (const Queue_handle handle : handles) detail::prefetch_address(&places_[handle]);
    // Which are due is chosen without branches, which nothing could predict.
    std::array<Queue_handle, Chunk::capacity> due;
    std::size_t number_due = 0;
    for (const Queue_handle handle : handles) {
      const Place& place = places_[handle];
      due[number_due] = handle;
      number_due += static_cast<std::size_t>(place.position == far) &
                    static_cast<std::size_t>(is_open(lower_bound(place.item)));
    }
    for (const Queue_handle handle : std::span(due.data(), number_due)) {
      if (places_[handle].position != far) continue;  // recorded twice
      --far_;
      if constexpr (Bounding_order<Less, Item>) less_.prefetch(places_[handle].item);
      insert_into_heap({bounds(handle), handle});
    }
    if constexpr (Bounding_order<Less, Item>) {
      for (const Queue_handle handle : std::span(due.data(), number_due)) {
        less_.prefetch_more(places_[handle].item);
      }
    }
    records_ -= records.size;
    const std::uint32_t next = records.next;
    records.next = std::exchange(free_chunk_, chunk);
    chunk = next;
  }
}

// Distributes the far items over slots chosen for them. Costs O(n), and happens when the queue has
// grown to a multiple, or when the nearer part of the items has been opened.
template <class Item, class Less>
void Indexed_queue<Item, Less>::spread() {
  slots_.clear();
  chunks_.clear();
  free_chunk_ = Chunk::none;
  records_ = 0;
  size_at_spread_ = size_;
  if (!choose_slots()) {
    slots_.clear();
    origin_ = 0;
    slots_per_unit_ = 0;
  }
  open_slots_ = 1;
  far_ = 0;
  for (Queue_handle handle = 0; handle < places_.size(); ++handle) {
    if (places_[handle].position == far) insert(handle);
  }
}

// Chooses slots for the nearest three quarters of the far items, or for more of them where those
// are at one time. Returns false, and the heap is left to do it all, where they are too few, or too
// near or too far from one another.
template <class Item, class Less>
bool Indexed_queue<Item, Less>::choose_slots() {
  if constexpr (!Bounding_order<Less, Item>) return false;
  if (far_ <= 2 * least_per_slot) return false;
  double least = std::numeric_limits<double>::infinity();
  for (const Place& place : places_) {
    if (place.position == far) least = std::min(least, lower_bound(place.item));
  }
  // Few items in a slot make a small heap, few slots can stay in the processor's cache.
  const std::size_t per_slot = std::clamp(far_ / 4096, least_per_slot, most_per_slot);
  constexpr std::size_t sample_size = 256;
  const std::size_t stride = places_.size() / sample_size + 1;
  std::vector<double> sample;
  for (std::size_t h = 0; h < places_.size(); h += stride) {
    if (places_[h].position == far) sample.push_back(lower_bound(places_[h].item));
  }
  std::sort(sample.begin(), sample.end());
  for (std::size_t rest = sample.size() / 4; rest > 0; rest /= 2) {
    const std::size_t nearer = sample.size() - rest;
    if (!(sample[nearer] > least)) continue;
    const double share = static_cast<double>(nearer) / static_cast<double>(sample.size());
    const auto count = static_cast<std::size_t>(share * static_cast<double>(far_)) / per_slot + 2;
    origin_ = least;
    slots_per_unit_ = static_cast<double>(count - 1) / (sample[nearer] - least);
    if (!std::isfinite(least) || !std::isnormal(slots_per_unit_)) return false;
    slots_.assign(count, Chunk::none);
    chunks_.reserve(count + count / 4);
    return true;
  }
  return false;
}

// The position of the least of the children that begin at `first_child`, which exists.
template <class Item, class Less>
std::size_t Indexed_queue<Item, Less>::least_child(std::size_t first_child) const {
  const std::size_t end = std::min(first_child + arity, heap_.size());
  // By the bounds first, without branches, which nothing could predict.
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

// Moves the hole at `position` up to where `node` belongs and fills it. Returns false, and has
// done nothing, if the node does not belong above `position`.
template <class Item, class Less>
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
template <class Item, class Less>
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
template <class Item, class Less>
void Indexed_queue<Item, Less>::restore_order(std::size_t position, const Node& node) {
  if (!sift_up(position, node)) sift_down(position, node);
}

}  // namespace kinetri

#endif  // KINETRI_EVENTS_INDEXED_QUEUE_H
