// SPDX-License-Identifier: GPL-3.0-or-later
//
// The queue of the cell list of discs: a timing wheel of short intervals, each a list of ids, so
// that an entry is moved in constant time. Entries of an interval may belong to any round. Each id
// has one entry. The order of ties is unspecified. Source: G. Paul, A complexity O(1) priority
// queue for event driven molecular dynamics simulations, J. Comput. Phys. 221 (2007), without its
// lists for later rounds, since few entries are that late.
#ifndef KINETRI_BENCH_TIME_WHEEL_H
#define KINETRI_BENCH_TIME_WHEEL_H

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace kinetri::bench {

class Time_wheel {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Gives id k the time times[k]. The width of intervals is chosen by the median of the times.
  void reset(std::span<const double> times) {
    std::vector<double> sorted(times.begin(), times.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    const auto entries = static_cast<double>(times.size());
    // Half of the entries are before the median.
    per_unit_time_ = intervals_per_entry * entries / (2 * std::clamp(*middle, 1e-300, 1e300));
    first_.assign(std::bit_ceil(static_cast<std::size_t>(intervals_per_wheel * entries)), none);
    entries_.assign(times.size(), {});
    present_ = 0;
    for (std::uint32_t id = 0; id < times.size(); ++id) insert(id, times[id]);
  }

  double time(std::uint32_t id) const { return entries_[id].time; }

  /// Gives `id` another time. Precondition: it is not before that of the last id that `next`
  /// returned.
  void set(std::uint32_t id, double time) {
    const Entry& entry = entries_[id];
    if (entry.next != none) entries_[entry.next].previous = entry.previous;
    (entry.previous != none ? entries_[entry.previous].next : first(entry.interval)) = entry.next;
    insert(id, time);
  }

  /// The id with the least time; `none` if that is after `until`.
  std::uint32_t next(double until) {
    const std::uint64_t last = interval(until);
    for (;; ++present_) {
      std::uint32_t result = none;
      double earliest = until;
      for (std::uint32_t id = first(present_); id != none; id = entries_[id].next) {
        const Entry& entry = entries_[id];
        if (entry.interval == present_ && entry.time <= earliest) {
          earliest = entry.time;
          result = id;
        }
      }
      if (result != none || present_ >= last) return result;
    }
  }

 private:
  static constexpr double intervals_per_entry = 1;
  static constexpr double intervals_per_wheel = 2;

  struct Entry {
    double time = 0;
    std::uint64_t interval = 0;  // of all rounds
    std::uint32_t next = none;
    std::uint32_t previous = none;
  };

  std::uint64_t interval(double time) const {
    return static_cast<std::uint64_t>(std::min(time * per_unit_time_, 0x1p62));
  }
  std::uint32_t& first(std::uint64_t interval) { return first_[interval & (first_.size() - 1)]; }

  void insert(std::uint32_t id, double time) {
    const std::uint64_t i = interval(time);
    std::uint32_t& head = first(i);
    if (head != none) entries_[head].previous = id;
    entries_[id] = {time, i, head, none};
    head = id;
  }

  double per_unit_time_ = 1;
  std::uint64_t present_ = 0;
  std::vector<std::uint32_t> first_;  // by interval of a round
  std::vector<Entry> entries_;        // by id
};

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_TIME_WHEEL_H
