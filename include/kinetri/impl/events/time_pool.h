// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact times of queue entries. Few entries need one, so an entry has an index instead of a
// time.
#ifndef KINETRI_IMPL_EVENTS_TIME_POOL_H
#define KINETRI_IMPL_EVENTS_TIME_POOL_H

#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/platform.h"

namespace kinetri::detail {

class Time_pool {
 public:
  using Index = std::uint32_t;

  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Keeps `time` until its index is released. References to other times stay valid.
  Index keep(Algebraic_number time) {
    if (free_.empty()) {
      times_.push_back(std::move(time));
      return static_cast<Index>(times_.size() - 1);
    }
    const Index index = free_.back();
    free_.pop_back();
    times_[index] = std::move(time);
    return index;
  }

  const Algebraic_number& operator[](Index index) const { return times_[index]; }

  /// Forgets the time of `index`. Does nothing for none.
  void release(Index index) {
    if (index == none) return;
    times_[index] = Algebraic_number();
    free_.push_back(index);
  }

  void clear() {
    times_.clear();
    free_.clear();
  }

 private:
  std::deque<Algebraic_number> times_;
  std::vector<Index> free_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_EVENTS_TIME_POOL_H
