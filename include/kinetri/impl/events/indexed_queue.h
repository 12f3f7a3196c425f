// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event queue: a priority queue whose items have handles, so that events can be erased. The
// order is a parameter.
#ifndef KINETRI_IMPL_EVENTS_INDEXED_QUEUE_H
#define KINETRI_IMPL_EVENTS_INDEXED_QUEUE_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/impl/events/calendar.h"
#include "kinetri/impl/events/queue_handle.h"

namespace kinetri {

/// Counts of the queue. `pushed` is the number of items popped, discarded and present.
struct Queue_counters {
  std::uint64_t pushed = 0;     ///< items that entered
  std::uint64_t discarded = 0;  ///< items erased or cleared
  std::uint64_t peak = 0;       ///< the largest size so far

  friend bool operator==(const Queue_counters&, const Queue_counters&) = default;
};

/// A strict weak order with bounds: items with disjoint intervals `bounds(item)` are in the order
/// of these. The queue calls the order only for items whose bounds overlap.
///
/// `prefetch` and `prefetch_more` may prefetch memory of items that will be first soon: the queue
/// calls `prefetch` for several items, then `prefetch_more` for each of them, which may read what
/// `prefetch` has prefetched. Both must be KINETRI_ALWAYS_INLINE (see detail::prefetch_address).
template <class Less, class Item>
concept Bounding_order = requires(const Less& less, const Item& item) {
  { less(item, item) } -> std::convertible_to<bool>;
  { less.bounds(item) } -> std::same_as<Double_interval>;
  less.prefetch(item);
  less.prefetch_more(item);
};

/// A calendar queue with an index: items that will be first soon are in a 4-ary implicit heap; the
/// others are unordered in slots by their lower bounds, and enter the heap slot by slot. An item
/// that is erased before its slot is opened, as most are, is never compared.
///
/// If the order is total, the order of pops does not depend on the history of the queue. `Item` is
/// movable and has a default constructor.
///
/// push, pop, erase: constant expected cost if the bounds are evenly distributed, O(log n)
/// comparisons at most, amortized. top, contains, operator[]: O(1). An insertion may move items in
/// memory. After the order has thrown, the queue can only be destroyed.
///
/// Source: R. Brown, Calendar queues: a fast O(1) priority queue implementation for the simulation
/// event set problem, Communications of the ACM 31, 1988.
template <class Item, Bounding_order<Item> Less>
class Indexed_queue {
 public:
  explicit Indexed_queue(Less less = Less()) : less_(std::move(less)) {}

  bool empty() const noexcept { return heap_.empty(); }
  std::size_t size() const noexcept { return size_; }

  /// Whether `handle` names an item of the queue.
  bool contains(Queue_handle handle) const noexcept {
    return handle < places_.size() && places_[handle].position != nowhere;
  }

  /// Inserts `item` and returns its handle. Precondition: size() < 2^32 - 2.
  Queue_handle push(Item item) { return emplace(std::move(item)); }

  /// Inserts an item, constructed in the queue from `parts`. Its constructor must not throw, and
  /// `parts` must not refer to an item of the queue. Precondition: size() < 2^32 - 2.
  template <class... Parts>
  Queue_handle emplace(Parts&&... parts);

  /// Inserts many items, faster than one by one. Calls `fill` with a function put(handle, item),
  /// which several threads may call, at most once for each handle below `size`. The other handles
  /// stay free. Linear in `size`. Precondition: the queue is empty and has had no item since it was
  /// made or cleared.
  template <class Fill>
  void assign(std::size_t size, Fill fill) {
    begin_assign(size);
    fill([this](Queue_handle handle, Item item) { assign_item(handle, std::move(item)); });
    end_assign();
  }

  /// @{
  /// The steps of assign. Several threads may call assign_item at once, for different handles;
  /// between the first step and the last one no other function.
  void begin_assign(std::size_t size);
  void assign_item(Queue_handle handle, Item item) {
    places_[handle].item = std::move(item);
    places_[handle].position = far;
  }
  void end_assign();
  /// @}

  /// Frees the memory for the order. From then on only contains, operator[], prefetch, size,
  /// counters and clear may be called.
  void forget_order();

  /// The handle of the least item. Precondition: not empty.
  KINETRI_ALWAYS_INLINE Queue_handle top_handle() const {
    KINETRI_PRECONDITION(!empty(), "top of an empty queue");
    return heap_.front().handle;
  }
  /// The least item. Precondition: not empty.
  KINETRI_ALWAYS_INLINE const Item& top() const { return places_[top_handle()].item; }

  /// Removes the least item and returns it. Precondition: not empty.
  Item pop() { return take(top_handle()); }

  /// The item of `handle`. Precondition: contains(handle).
  const Item& operator[](Queue_handle handle) const {
    KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
    return places_[handle].item;
  }

  /// Calls function(item) with the item of `handle`, to change what does not concern the order.
  /// Precondition: contains(handle).
  template <class Amend>
  void amend(Queue_handle handle, const Amend& function) {
    KINETRI_PRECONDITION(contains(handle), "the handle names no item of the queue");
    function(places_[handle].item);
  }

  /// Announces that only items with lower bounds up to `bound` will be first soon: the others are
  /// not put in order before. Changes only the cost of later calls. Linear in the largest size so
  /// far.
  void expect(double bound);

  /// Prefetches the item of `handle`; does nothing for no_event. Precondition: `handle` is no_event
  /// or a handle of the queue, whose item may have left.
  KINETRI_ALWAYS_INLINE void prefetch(Queue_handle handle) const {
    if (handle != no_event) detail::prefetch_address(&places_[handle]);
  }

  /// Removes the item of `handle` and returns it. Precondition: contains(handle).
  Item erase(Queue_handle handle);

  void clear();

  /// Calls `function` with each item, in the order of their handles. Linear in the largest size so
  /// far.
  template <class Function>
  void for_each(Function function) const;

  /// Counts since the queue was made; clear() does not reset them.
  const Queue_counters& counters() const noexcept { return counters_; }

  /// Continues counting from these counts.
  void count_as(const Queue_counters& counters) noexcept { counters_ = counters; }

  /// Whether heap order, slots and index are intact. O(n); for audits.
  bool is_valid() const { return is_valid(less_); }
  /// The same with another order object.
  bool is_valid(const Less& order) const;

 private:
  static constexpr std::size_t arity = 4;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t far = nowhere - 1;

  struct Place {
    Item item;
    std::uint32_t position = nowhere;  // in the heap, or far, or nowhere
  };

  struct Node {
    Double_interval bounds;
    Queue_handle handle;
  };

  Double_interval bounds(Queue_handle handle) const { return less_.bounds(places_[handle].item); }
  // The slot of an item. Reads only the lower bound: both at once would stall the processor, since
  // they have just been written one by one.
  double slot(const Item& item) const { return calendar_.slot(less_.bounds(item).lower); }

  bool less(const Node& a, const Node& b, const Less& order) const {
    if (a.bounds.upper < b.bounds.lower) return true;
    if (b.bounds.upper < a.bounds.lower) return false;
    return order(places_[a.handle].item, places_[b.handle].item);
  }
  bool less(const Node& a, const Node& b) const { return less(a, b, less_); }

  void place(std::size_t position, const Node& node) {
    heap_[position] = node;
    places_[node.handle].position = static_cast<std::uint32_t>(position);
  }

  Queue_handle acquire_handle();
  void add_handle();
  Item take(Queue_handle handle);
  void remove(Queue_handle handle);

  bool insert(Queue_handle handle);
  void keep_in_order();
  bool is_settled() const;
  void settle();
  bool has_long_slots() const;
  void open_next_slot();
  void spread(double greatest = std::numeric_limits<double>::infinity());
  void spread_all(double greatest = std::numeric_limits<double>::infinity());
  void choose_slots(double greatest);

  void insert_into_heap(const Node& node);
  std::size_t least_child(std::size_t first_child) const;
  bool sift_up(std::size_t position, const Node& node);
  void sift_down(std::size_t position, const Node& node);
  void restore_order(std::size_t position, const Node& node);

  bool is_heap_valid(const Less& order) const;
  bool is_calendar_valid() const;

  // Invariants: an item is in the heap if its lower bound is in an open slot, else it is far. If
  // the upper bound of the first item of the heap is in an open slot, that item is the least of
  // all; between public calls it is. A far item is recorded in its slot, unless that is beyond the
  // last one. Slots may also hold obsolete records, which are recognized when the slot is opened.
  std::vector<Node> heap_;
  std::vector<Place> places_;       // by handle
  std::vector<Queue_handle> free_;  // a stack
  detail::Calendar calendar_;
  std::size_t size_ = 0;            // of heap_, and far_
  std::size_t far_ = 0;             // the number of far items
  std::size_t size_at_spread_ = 0;  // when the slots were chosen
  Queue_counters counters_;
  [[no_unique_address]] Less less_;
};

}  // namespace kinetri

#include "kinetri/impl/events/indexed_queue_impl.h"

#endif  // KINETRI_IMPL_EVENTS_INDEXED_QUEUE_H
