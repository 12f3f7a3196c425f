// SPDX-License-Identifier: GPL-3.0-or-later
//
// The indexed queue against a slow and obvious one, and the rules for handles, counters and order.
#include "kinetri/impl/events/indexed_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri::indexed_queue_test {
namespace {

using Item = std::pair<int, int>;  // priority, serial number

struct Nothing_to_prefetch {
  template <class T>
  void prefetch(const T& /*item*/) const {}
  template <class T>
  void prefetch_more(const T& /*item*/) const {}
};

// Bounds so loose and uneven that they overlap in every way.
struct Loosely_bounded : std::less<Item>, Nothing_to_prefetch {
  Double_interval bounds(const Item& item) const {
    const double priority = item.first;
    return {priority - item.first % 3, priority + 7 * item.first % 5};
  }
};
using Queue = Indexed_queue<Item, Loosely_bounded>;

// Bounds that say nothing, so that the order is asked about every pair.
struct Unbounded : std::less<Item>, Nothing_to_prefetch {
  Double_interval bounds(const Item& /*item*/) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity};
  }
};

// The order of what is pointed to, or of the items themselves; the bounds are their values.
struct By_number : Nothing_to_prefetch {
  static double number(int item) { return item; }
  template <class Pointer>
  static double number(const Pointer& item) {
    return item ? *item : 0;
  }
  template <class T>
  bool operator()(const T& a, const T& b) const {
    return number(a) < number(b);
  }
  template <class T>
  Double_interval bounds(const T& item) const {
    return {number(item), number(item)};
  }
};

// The reference: a map from handle to item, scanned for the least one.
class Linear_scan_queue {
 public:
  std::size_t size() const { return items_.size(); }
  bool contains(Queue_handle handle) const { return items_.contains(handle); }

  void push(Queue_handle handle, Item item) {
    ASSERT_FALSE(contains(handle)) << "the handle " << handle << " is in use";
    items_.emplace(handle, item);
    ++counters_.pushed;
    counters_.peak = std::max<std::uint64_t>(counters_.peak, size());
  }
  void erase(Queue_handle handle) {
    items_.erase(handle);
    ++counters_.discarded;
  }
  void clear() {
    counters_.discarded += size();
    items_.clear();
  }
  std::pair<Queue_handle, Item> top() const {
    return *std::min_element(items_.begin(), items_.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
  }
  void pop() { items_.erase(top().first); }

  Queue_handle handle_at(std::size_t index) const {
    return std::next(items_.begin(), static_cast<std::ptrdiff_t>(index))->first;
  }
  const std::map<Queue_handle, Item>& items() const { return items_; }
  const Queue_counters& counters() const { return counters_; }

 private:
  std::map<Queue_handle, Item> items_;
  Queue_counters counters_;
};

// Does the same to both queues, and compares what they show.
template <class Less>
class Pair_of_queues {
 public:
  explicit Pair_of_queues(std::uint64_t seed, int priorities)
      : random_(seed), priorities_(static_cast<std::uint64_t>(priorities)) {}

  // `growth` of 100 operations are pushes.
  void operate(unsigned growth) {
    const std::uint64_t choice = random_() % 100;
    if (reference_.size() == 0 || choice < growth) {
      const Item item = next_item();
      reference_.push(queue_.push(item), item);
      return;
    }
    const Queue_handle any = reference_.handle_at(random_() % reference_.size());
    if (random_() % 2 == 0) {
      EXPECT_EQ(queue_.erase(any), reference_.items().at(any));
      reference_.erase(any);
    } else {
      EXPECT_EQ(queue_.pop(), reference_.top().second);
      reference_.pop();
    }
  }

  void clear() {
    queue_.clear();
    reference_.clear();
  }

  // Which items are expected changes nothing that can be seen.
  void expect() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto priority = static_cast<double>(next_item().first);
    queue_.expect(std::array{priority, 0.1 * priority, -1.0, infinity, -infinity}[random_() % 5]);
  }

  void compare() const {
    ASSERT_EQ(queue_.size(), reference_.size());
    ASSERT_EQ(queue_.empty(), reference_.size() == 0);
    ASSERT_EQ(queue_.counters(), reference_.counters());
    if (queue_.empty()) return;
    ASSERT_EQ(queue_.top(), reference_.top().second);
    ASSERT_EQ(queue_.top_handle(), reference_.top().first);
  }

  void compare_everything() const {
    ASSERT_TRUE(queue_.is_valid());
    for (const auto& [handle, item] : reference_.items()) {
      ASSERT_TRUE(queue_.contains(handle));
      ASSERT_EQ(queue_[handle], item);
    }
    std::vector<Item> items;
    queue_.for_each([&](const Item& item) { items.push_back(item); });
    std::vector<Item> expected;
    for (const auto& [handle, item] : reference_.items()) expected.push_back(item);
    ASSERT_EQ(items, expected);
    for (Queue_handle handle = 0; handle < 2000; ++handle) {
      ASSERT_EQ(queue_.contains(handle), reference_.contains(handle)) << "handle " << handle;
    }
  }

 private:
  Item next_item() { return {static_cast<int>(random_() % priorities_), serial_++}; }

  std::mt19937_64 random_;
  std::uint64_t priorities_;
  int serial_ = 0;
  Indexed_queue<Item, Less> queue_;
  Linear_scan_queue reference_;
};

class Random_operations : public testing::TestWithParam<std::uint64_t> {};

template <class Less>
void expect_agreement_with_linear_scan(std::uint64_t seed) {
  for (const int priorities : {1, 3, 50, 1'000'000}) {
    Pair_of_queues<Less> queues(seed, priorities);
    // Growing, shrinking to nothing, growing again, so that handles are reused at every size.
    for (const unsigned growth : {60U, 20U, 55U, 35U}) {
      for (int i = 0; i < 800; ++i) {
        queues.operate(growth);
        if (i % 30 == 0) queues.expect();
        ASSERT_NO_FATAL_FAILURE(queues.compare()) << "seed " << seed << ", operation " << i;
        if (i % 40 != 0) continue;
        ASSERT_NO_FATAL_FAILURE(queues.compare_everything());
      }
    }
    queues.clear();
    ASSERT_NO_FATAL_FAILURE(queues.compare());
    queues.operate(100);
    ASSERT_NO_FATAL_FAILURE(queues.compare_everything());
  }
}

TEST_P(Random_operations, agree_with_linear_scan) {
  expect_agreement_with_linear_scan<Loosely_bounded>(GetParam());
}

TEST_P(Random_operations, without_bounds_agree_with_linear_scan) {
  expect_agreement_with_linear_scan<Unbounded>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_operations, testing::Range<std::uint64_t>(1, 9));

TEST(Indexed_queue, pops_come_in_ascending_order) {
  std::mt19937_64 random(7);
  Queue queue;
  std::vector<Item> items;
  for (int i = 0; i < 5000; ++i) {
    items.emplace_back(static_cast<int>(random() % 500), i);
    queue.push(items.back());
  }
  std::sort(items.begin(), items.end());
  for (const Item& item : items) ASSERT_EQ(queue.pop(), item);
  EXPECT_TRUE(queue.empty());
}

// Two queues with the same items and different histories pop the same: the order is the items' own.
TEST(Indexed_queue, order_of_pops_does_not_depend_on_history) {
  Queue plain;
  Queue shuffled;
  std::vector<Item> items;
  for (int i = 0; i < 1000; ++i) items.emplace_back(i % 7, i);
  for (const Item& item : items) plain.push(item);
  std::shuffle(items.begin(), items.end(), std::mt19937_64(3));
  for (const Item& item : items) {
    const Queue_handle before = shuffled.push({-1, 0});
    const Queue_handle after = shuffled.push({1000, 0});
    shuffled.erase(before);
    shuffled.push(item);
    shuffled.erase(after);
  }
  while (!plain.empty()) ASSERT_EQ(shuffled.pop(), plain.pop());
  EXPECT_TRUE(shuffled.empty());
}

struct Bounded_item {
  double lower;
  double upper;
  double value;
};
struct By_value : Nothing_to_prefetch {
  bool operator()(const Bounded_item& a, const Bounded_item& b) const { return a.value < b.value; }
  Double_interval bounds(const Bounded_item& item) const { return {item.lower, item.upper}; }
};

// Assigns the items, each under its index, the last one first.
template <class Queue, class Item>
void assign(Queue& queue, const std::vector<Item>& items) {
  queue.assign(items.size(), [&](const auto& put) {
    for (std::size_t i = items.size(); i-- > 0;) put(static_cast<Queue_handle>(i), items[i]);
  });
}

// The bounds of the first item reach beyond the near ones, which matters when another one comes
// that is not near.
TEST(Indexed_queue, an_item_of_wide_bounds_is_compared_with_later_ones) {
  for (double width : {0.0, 1.0, 10.0, 1000.0, 1e6}) {
    Indexed_queue<Bounded_item, By_value> queue;
    std::vector<Bounded_item> items;
    for (int i = 0; i < 40; ++i) items.push_back({i + 1.0, i + 1.0, i + 1.0});
    assign(queue, items);
    // Nothing is left, and the slots of the later items have not been opened.
    for (int i = 0; i < 10; ++i) queue.pop();
    for (Queue_handle handle = 40; handle-- > 10;) queue.erase(handle);
    queue.push({1, 25 + width, 25 + width});
    for (const double value : {25.0, 28.0, 39.0, 61.0, 300.0, 5000.0}) {
      queue.push({value, value, value});
    }
    ASSERT_TRUE(queue.is_valid()) << "width " << width;
    double previous = 0;
    while (!queue.empty()) {
      const double value = queue.pop().value;
      ASSERT_LE(previous, value) << "width " << width;
      previous = value;
    }
  }
}

// Items assigned at once are under their indices, and go on like pushed ones.
TEST(Indexed_queue, assigned_items_are_like_pushed_ones) {
  std::mt19937_64 random(5);
  std::vector<Item> items;
  for (int i = 0; i < 3000; ++i) items.emplace_back(static_cast<int>(random() % 100'000), i);
  Queue assigned;
  Queue pushed;
  assign(assigned, items);
  for (const Item& item : items) pushed.push(item);
  EXPECT_TRUE(assigned.is_valid());
  EXPECT_EQ(assigned.counters(), pushed.counters());
  for (Queue_handle handle = 0; handle < items.size(); ++handle) {
    ASSERT_EQ(assigned[handle], items[handle]);
    if (handle % 3 == 0) continue;
    const Item later = {items[handle].first + 50'000, items[handle].second};
    assigned.erase(handle);
    pushed.erase(handle);
    ASSERT_EQ(assigned.push(later), handle);
    ASSERT_EQ(pushed.push(later), handle);
  }
  while (!pushed.empty()) ASSERT_EQ(assigned.pop(), pushed.pop());
  EXPECT_TRUE(assigned.empty());
}

// Handles that are left out when others are assigned are the first ones that are given later.
TEST(Indexed_queue, handles_that_were_not_assigned_are_free) {
  Queue queue;
  queue.assign(100, [](const auto& put) {
    for (int i = 0; i < 100; ++i) {
      if (i != 7 && i != 60) put(static_cast<Queue_handle>(i), Item{i, i});
    }
  });
  EXPECT_TRUE(queue.is_valid());
  EXPECT_EQ(queue.size(), 98u);
  EXPECT_EQ(queue.counters().pushed, 98u);
  EXPECT_FALSE(queue.contains(7));
  EXPECT_EQ(queue.push({-1, 0}), 7u);
  EXPECT_EQ(queue.push({-2, 0}), 60u);
  EXPECT_EQ(queue.push({-3, 0}), 100u);
  EXPECT_EQ(queue.pop(), (Item{-3, 0}));

  Queue empty;
  empty.assign(3, [](const auto& /*put*/) {});
  EXPECT_TRUE(empty.empty());
  EXPECT_TRUE(empty.is_valid());
}

TEST(Indexed_queue, erasing_an_item_may_move_its_replacement_up) {
  // The last leaf (2) is smaller than the ancestors of the erased one (10, under 9).
  Indexed_queue<int, By_number> queue;
  std::vector<Queue_handle> handles;
  for (const int item : {0, 9, 1, 1, 1, 10, 10, 10, 10, 2}) handles.push_back(queue.push(item));
  EXPECT_EQ(queue.erase(handles[5]), 10);
  EXPECT_TRUE(queue.is_valid());
  std::vector<int> popped;
  while (!queue.empty()) popped.push_back(queue.pop());
  EXPECT_EQ(popped, (std::vector<int>{0, 1, 1, 1, 2, 9, 10, 10, 10}));
}

TEST(Indexed_queue, handle_stays_with_its_item_until_it_leaves_and_is_then_reused) {
  Indexed_queue<int, By_number> queue;
  const Queue_handle a = queue.push(5);
  const Queue_handle b = queue.push(3);
  EXPECT_FALSE(queue.contains(no_event));
  EXPECT_FALSE(queue.contains(2));
  const Queue_handle c = queue.push(1);
  EXPECT_EQ(queue.top_handle(), c);
  EXPECT_EQ(queue[b], 3);
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_FALSE(queue.contains(c));
  EXPECT_EQ(queue.push(9), c);
  EXPECT_EQ(queue[c], 9);
  EXPECT_EQ(queue.erase(a), 5);
  EXPECT_FALSE(queue.contains(a));
  EXPECT_EQ(queue.push(0), a);
  EXPECT_EQ(queue.top_handle(), a);
}

TEST(Indexed_queue, counters_say_what_happened) {
  Indexed_queue<int, By_number> queue;
  EXPECT_EQ(queue.counters(), (Queue_counters{}));
  const Queue_handle a = queue.push(1);
  const Queue_handle b = queue.push(2);
  queue.push(3);
  queue.push(4);
  queue.erase(a);
  queue.erase(b);
  queue.push(5);
  queue.pop();
  EXPECT_EQ(queue.counters(), (Queue_counters{.pushed = 5, .discarded = 2, .peak = 4}));
  queue.clear();
  EXPECT_EQ(queue.counters(), (Queue_counters{.pushed = 5, .discarded = 4, .peak = 4}));
}

TEST(Indexed_queue, holds_items_that_can_only_be_moved) {
  Indexed_queue<std::unique_ptr<int>, By_number> queue;
  for (int i = 100; i > 0; --i) queue.push(std::make_unique<int>(i));
  EXPECT_EQ(*queue.erase(queue.top_handle()), 1);
  queue.push(std::make_unique<int>(1000));
  EXPECT_EQ(*queue.top(), 2);
  for (int i = 2; i <= 100; ++i) ASSERT_EQ(*queue.pop(), i);
  EXPECT_EQ(*queue.pop(), 1000);
}

TEST(Indexed_queue, releases_what_an_item_owns_when_it_leaves) {
  Indexed_queue<std::shared_ptr<int>, By_number> queue;
  const auto popped = std::make_shared<int>(0);
  const auto erased = std::make_shared<int>(1);
  const auto cleared = std::make_shared<int>(2);
  queue.push(popped);
  const Queue_handle handle = queue.push(erased);
  queue.push(cleared);
  queue.pop();
  queue.erase(handle);
  for (const auto& item : {&popped, &erased}) {
    EXPECT_EQ(item->use_count(), 1) << "item " << **item;
  }
  queue.clear();
  EXPECT_EQ(cleared.use_count(), 1);
}

TEST(Indexed_queue, misuse_throws) {
  Indexed_queue<int, By_number> queue;
  EXPECT_PRECONDITION_ERROR(queue.top(), "top of an empty queue");
  EXPECT_PRECONDITION_ERROR(queue.top_handle(), "top of an empty queue");
  EXPECT_PRECONDITION_ERROR(queue.pop(), "top of an empty queue");
  const Queue_handle handle = queue.push(1);
  queue.pop();
  EXPECT_PRECONDITION_ERROR(queue.erase(handle), "the handle names no item of the queue");
  EXPECT_PRECONDITION_ERROR(queue[handle], "the handle names no item of the queue");
  EXPECT_PRECONDITION_ERROR(queue.erase(no_event), "the handle names no item of the queue");
  EXPECT_PRECONDITION_ERROR(queue.assign(2, [](const auto& /*put*/) {}), "the queue has been used");
}

}  // namespace
}  // namespace kinetri::indexed_queue_test
