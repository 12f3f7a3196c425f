// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/events/calendar.h"

#include <algorithm>
#include <cmath>

namespace kinetri::detail {

bool Calendar::is_recorded(double slot, Queue_handle handle) const {
  for (std::uint32_t c = slots_[static_cast<std::size_t>(slot)]; c != Chunk::none;
       c = chunks_[c].next) {
    const auto begin = chunks_[c].handles.begin();
    const auto end = begin + chunks_[c].size;
    if (std::find(begin, end, handle) != end) return true;
  }
  return false;
}

void Calendar::reset() {
  slots_.clear();
  chunks_.clear();
  free_chunk_ = Chunk::none;
  records_ = 0;
  open_slots_ = 1;
  origin_ = 0;
  slots_per_unit_ = 0;
}

void Calendar::choose_slots(double least, std::span<const double> sample, std::size_t items,
                            double greatest) {
  constexpr std::size_t least_per_slot = 4;
  constexpr std::size_t most_per_slot = 16;
  // Few items per slot keep the heap small, few slots stay in the cache.
  const std::size_t per_slot = std::clamp(items / 4096, least_per_slot, most_per_slot);
  for (std::size_t rest = sample.size() / 4; rest > 0; rest /= 2) {
    std::size_t nearer = sample.size() - rest;
    double last = sample[nearer];
    if (!(last > least)) continue;
    if (greatest > least && greatest < last) {
      last = greatest;
      nearer = static_cast<std::size_t>(std::ranges::upper_bound(sample, last) - sample.begin());
    }
    const double share = static_cast<double>(nearer) / static_cast<double>(sample.size());
    const auto count = static_cast<std::size_t>(share * static_cast<double>(items)) / per_slot + 2;
    const double slots_per_unit = static_cast<double>(count - 1) / (last - least);
    if (!std::isfinite(least) || !std::isnormal(slots_per_unit)) return;
    origin_ = least;
    slots_per_unit_ = slots_per_unit;
    slots_.assign(count, Chunk::none);
    chunks_.reserve(count + count / 4);
    return;
  }
}

}  // namespace kinetri::detail
