// SPDX-License-Identifier: GPL-3.0-or-later
//
// The queue of the uncertified kinetic Delaunay triangulation: a 4-ary heap of (double, id) that
// stores the position of each id, so that entries can be moved and removed. Each id has at most one
// entry. The order of ties is unspecified.
#ifndef KINETRI_BENCH_TIME_HEAP_H
#define KINETRI_BENCH_TIME_HEAP_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace kinetri::bench {

class Time_heap {
 public:
  struct Entry {
    double time;
    std::uint32_t id;
  };

  /// Empties the heap and makes room for the ids 0, 1, ..., ids - 1.
  void reset(std::size_t ids) {
    heap_.clear();
    heap_.reserve(ids);
    position_.assign(ids, nowhere);
  }

  bool empty() const { return heap_.empty(); }
  const Entry& top() const { return heap_.front(); }
  /// The entries among which the next one after the top is, if there is one.
  std::span<const Entry> after_top() const {
    return {heap_.data() + 1, std::min(arity, heap_.size() - 1)};
  }
  bool contains(std::uint32_t id) const { return position_[id] != nowhere; }

  /// Gives `id` the time `time`, whether it has an entry or not.
  void set(std::uint32_t id, double time) {
    std::size_t position = position_[id];
    if (position == nowhere) {
      position = heap_.size();
      heap_.push_back({time, id});
    }
    restore_order(position, {time, id});
  }

  /// Takes out the entry of `id`. Precondition: contains(id).
  void erase(std::uint32_t id) {
    const std::size_t position = position_[id];
    position_[id] = nowhere;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.id != id) restore_order(position, last);
  }

 private:
  static constexpr std::size_t arity = 4;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  void place(std::size_t position, const Entry& entry) {
    heap_[position] = entry;
    position_[entry.id] = static_cast<std::uint32_t>(position);
  }

  // Without branches, which would often be mispredicted.
  std::size_t least_child(std::size_t first) const {
    const auto least = [this](std::size_t a, std::size_t b) {
      return heap_[b].time < heap_[a].time ? b : a;
    };
    if (first + arity <= heap_.size()) {
      return least(least(first, first + 1), least(first + 2, first + 3));
    }
    std::size_t result = first;
    for (std::size_t child = first + 1; child < heap_.size(); ++child)
      result = least(result, child);
    return result;
  }

  // Fills the hole at `position` with `entry`, which may belong above or below it.
  void restore_order(std::size_t position, const Entry& entry) {
    const std::size_t start = position;
    while (position > 0) {
      const std::size_t parent = (position - 1) / arity;
      if (!(entry.time < heap_[parent].time)) break;
      place(position, heap_[parent]);
      position = parent;
    }
    if (position == start) {
      for (std::size_t child = arity * position + 1; child < heap_.size();
           child = arity * position + 1) {
        const std::size_t least = least_child(child);
        if (!(heap_[least].time < entry.time)) break;
        place(position, heap_[least]);
        position = least;
      }
    }
    place(position, entry);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> position_;  // by id
};

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_TIME_HEAP_H
