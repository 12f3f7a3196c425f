// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event queue: a priority queue whose items are reached by handle, so that an event that became
// illegal is erased, or replaced, where it stands. It knows no geometry; the order is a parameter.
#ifndef KINETRI_EVENTS_INDEXED_QUEUE_H
#define KINETRI_EVENTS_INDEXED_QUEUE_H

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/base/check.h"

namespace kinetri {

/// Names an item of an Indexed_queue from its push to its pop or erase; then it may be reused.
using Queue_handle = std::uint32_t;

/// The handle of no item.
inline constexpr Queue_handle no_event = std::numeric_limits<Queue_handle>::max();

/// How the queue was used: `pushed` counts the items that entered, by push or in place of another;
/// `discarded` those that left without having been popped: erased, replaced, or cleared; `peak` is
/// the largest size so far. So pushed = popped + discarded + size.
struct Queue_counters {
  std::uint64_t pushed = 0;
  std::uint64_t discarded = 0;
  std::uint64_t peak = 0;

  friend bool operator==(const Queue_counters&, const Queue_counters&) = default;
};

/// An order that bounds its items: `bounds` gives an interval for each, and items with disjoint
/// intervals are in the order of these. The queue keeps the bounds in the heap itself, and asks the
/// order, with the memory accesses that this costs, only about items whose bounds overlap.
template <class Less, class Item>
concept Bounding_order = requires(const Less& less, const Item& item) {
  { less.bounds(item) } -> std::same_as<Double_interval>;
};

/// A 4-ary implicit heap with an index. `Less` is a strict weak order on `Item`; give it a total
/// one, and the order of pops depends on the items alone, not on the history of the queue. `Item`
/// is movable; it need not be copyable.
///
/// push, pop, update, erase: O(log n) comparisons and moves of handles; items stay where they are
/// until they leave, and are then released at once. top, contains, operator[]: O(1).
/// An exception thrown by the order leaves the queue unusable but destructible.
template <class Item, class Less>
class Indexed_queue {
 public:
  explicit Indexed_queue(Less less = Less()) : less_(std::move(less)) {}

  bool empty() const noexcept { return heap_.empty(); }
  std::size_t size() const noexcept { return heap_.size(); }

  /// Whether `handle` names an item of the queue.
  bool contains(Queue_handle handle) const noexcept {
    return handle < position_.size() && position_[handle] != nowhere;
  }

  /// Inserts `item`. Precondition: size() < 2^32 - 1.
  Queue_handle push(Item item);

  /// The handle of the least item, and that item. Precondition: not empty.
  Queue_handle top_handle() const {
    KINETRI_PRECONDITION(!empty(), "top of an empty queue");
    return heap_.front().handle;
  }
  const Item& top() const { return items_[top_handle()]; }

  /// Removes the least item and returns it. Precondition: not empty.
  Item pop();

  /// The item of `handle`. Precondition: contains(handle).
  const Item& operator[](Queue_handle handle) const {
    KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
    return items_[handle];
  }

  /// Replaces the item of `handle`. Precondition: contains(handle).
  void update(Queue_handle handle, Item item);

  /// Removes the item of `handle`. Precondition: contains(handle).
  void erase(Queue_handle handle);

  /// Removes all items.
  void clear();

  const Queue_counters& counters() const noexcept { return counters_; }

  /// Whether the heap order and the index are intact. O(n); for audits.
  bool is_valid() const;

 private:
  static constexpr std::size_t arity = 4;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  struct Unbounded {};
  using Bounds = std::conditional_t<Bounding_order<Less, Item>, Double_interval, Unbounded>;

  // What the heap holds: a handle, and the bounds of its item.
  struct Node {
    [[no_unique_address]] Bounds bounds;
    Queue_handle handle;
  };

  Node node(Queue_handle handle) const {
    if constexpr (Bounding_order<Less, Item>) {
      return {less_.bounds(items_[handle]), handle};
    } else {
      return {{}, handle};
    }
  }

  bool less(const Node& a, const Node& b) const {
    if constexpr (Bounding_order<Less, Item>) {
      if (a.bounds.upper < b.bounds.lower) return true;
      if (b.bounds.upper < a.bounds.lower) return false;
    }
    return less_(items_[a.handle], items_[b.handle]);
  }

  void place(std::size_t position, const Node& node) {
    heap_[position] = node;
    position_[node.handle] = static_cast<std::uint32_t>(position);
  }

  Queue_handle acquire_handle(Item&& item);
  Item take(Queue_handle handle);
  std::size_t least_child(std::size_t first_child) const;
  bool sift_up(std::size_t position, const Node& node);
  void sift_down(std::size_t position, const Node& node);
  void restore_order(std::size_t position, const Node& node);

  // Invariants: heap_[position_[h]].handle == h for each handle h in use; position_[h] == nowhere
  // for each one in free_; items_ and position_ are equally long, and each handle is in use or in
  // free_.
  std::vector<Node> heap_;
  std::vector<Item> items_;              // by handle
  std::vector<std::uint32_t> position_;  // by handle: its index in heap_
  std::vector<Queue_handle> free_;       // a stack
  Queue_counters counters_;
  [[no_unique_address]] Less less_;
};

template <class Item, class Less>
Queue_handle Indexed_queue<Item, Less>::push(Item item) {
  KINETRI_PRECONDITION(heap_.size() < nowhere, "the queue is full");
  const Queue_handle handle = acquire_handle(std::move(item));
  const Node added = node(handle);
  heap_.push_back(added);
  if (!sift_up(heap_.size() - 1, added)) place(heap_.size() - 1, added);
  ++counters_.pushed;
  counters_.peak = std::max<std::uint64_t>(counters_.peak, heap_.size());
  return handle;
}

template <class Item, class Less>
Item Indexed_queue<Item, Less>::pop() {
  return take(top_handle());
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::update(Queue_handle handle, Item item) {
  KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
  items_[handle] = std::move(item);
  restore_order(position_[handle], node(handle));
  ++counters_.pushed;
  ++counters_.discarded;
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::erase(Queue_handle handle) {
  KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
  static_cast<void>(take(handle));
  ++counters_.discarded;
}

template <class Item, class Less>
void Indexed_queue<Item, Less>::clear() {
  counters_.discarded += heap_.size();
  heap_.clear();
  items_.clear();
  position_.clear();
  free_.clear();
}

template <class Item, class Less>
bool Indexed_queue<Item, Less>::is_valid() const {
  if (items_.size() != position_.size() || heap_.size() + free_.size() != items_.size())
    return false;
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    if (heap_[i].handle >= position_.size() || position_[heap_[i].handle] != i) return false;
    if (i > 0 && less(heap_[i], heap_[(i - 1) / arity])) return false;
  }
  return std::all_of(free_.begin(), free_.end(), [this](Queue_handle handle) {
    return handle < position_.size() && position_[handle] == nowhere;
  });
}

// Stores the item under a handle that is not in the heap yet; the last one that became free first.
template <class Item, class Less>
Queue_handle Indexed_queue<Item, Less>::acquire_handle(Item&& item) {
  if (!free_.empty()) {
    const Queue_handle handle = free_.back();
    free_.pop_back();
    items_[handle] = std::move(item);
    return handle;
  }
  items_.push_back(std::move(item));
  position_.push_back(nowhere);
  return static_cast<Queue_handle>(items_.size() - 1);
}

// Removes the item of `handle` from heap and index. Moving it out releases what it owned.
template <class Item, class Less>
Item Indexed_queue<Item, Less>::take(Queue_handle handle) {
  const std::size_t position = position_[handle];
  const Node last = heap_.back();
  heap_.pop_back();
  if (last.handle != handle) restore_order(position, last);
  position_[handle] = nowhere;
  free_.push_back(handle);
  return std::move(items_[handle]);
}

// The position of the least of the children that begin at `first_child`, which exists.
template <class Item, class Less>
std::size_t Indexed_queue<Item, Less>::least_child(std::size_t first_child) const {
  const std::size_t end = std::min(first_child + arity, heap_.size());
  std::size_t least = first_child;
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
