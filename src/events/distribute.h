// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a scheduler is divided into parts, for events on several threads, and becomes one again.
#ifndef KINETRI_SRC_EVENTS_DISTRIBUTE_H
#define KINETRI_SRC_EVENTS_DISTRIBUTE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "events/divided_scheduler_impl.h"

namespace kinetri::detail {

template <class Entry, class Policy>
template <class Block, class For_each_subject, class In_parallel>
void Divided_scheduler<Entry, Policy>::distribute(std::size_t count,
                                                  const std::vector<Block>& blocks,
                                                  const For_each_subject& for_each_subject,
                                                  const In_parallel& in_parallel) {
  if (count == 1 && !is_divided()) return;
  Queue_counters before = counters();
  if (count == number_of_parts()) before.peak = first_.counters().peak;  // without the present size
  forget_first();
  if (is_divided()) {
    in_parallel(parts_, [](const std::unique_ptr<Part>& part) { part->forget_order(); });
  } else {
    first_.forget_order();
  }
  struct Share {
    const Block* block;
    std::vector<Queue_handle> next;                               // of each part
    std::size_t first = 0;                                        // of its entries among all
    std::vector<std::uint16_t> parts;                             // of each of them
    std::vector<std::pair<std::size_t, Algebraic_number>> times;  // of few: their numbers
  };
  std::vector<Share> shares;
  for (const Block& block : blocks) {
    shares.push_back({&block, std::vector<Queue_handle>(count, 0), 0, {}, {}});
  }
  in_parallel(shares, [&](Share& share) {
    for_each_subject(*share.block, [&](const auto& subject) {
      const std::size_t part = count == 1 ? 0 : policy_.part_of(subject);
      share.parts.push_back(static_cast<std::uint16_t>(part));
      ++share.next[part];
    });
  });
  std::size_t number = 0;
  for (Share& share : shares) share.first = std::exchange(number, number + share.parts.size());
  // One large block, which is returned to the system when it is freed.
  std::vector<Double_interval> bounds(number);
  std::vector<typename Entry::Kept> kept(number);
  in_parallel(shares, [&](Share& share) {
    std::vector<Queue_handle> handles;
    handles.reserve(share.parts.size());
    for_each_subject(*share.block,
                     [&](const auto& subject) { handles.push_back(policy_.handle(subject)); });
    constexpr std::size_t ahead = 8;
    for (std::size_t k = 0; k < handles.size(); ++k) {
      if (k + ahead < handles.size()) prefetch(handles[k + ahead]);
      const Entry& entry = (*this)[handles[k]];
      bounds[share.first + k] = entry.bounds;
      kept[share.first + k] = entry.kept();
      if (entry.time == Time_pool::none) continue;
      share.times.emplace_back(k, part(part_of_handle(handles[k])).time_of(entry));
    }
  });
  // Frees the memory of the entries before they are made anew.
  first_.clear();
  in_parallel(parts_, [](std::unique_ptr<Part>& part) { part.reset(); });
  parts_.clear();
  struct Made {
    std::unique_ptr<Part> part;
    Queue_handle size = 0;
  };
  std::vector<Made> made(count);
  for (std::size_t p = 0; p < count; ++p) {
    if (count > 1) made[p].part = std::make_unique<Part>(policy_);
    for (Share& share : shares) made[p].size += std::exchange(share.next[p], made[p].size);
  }
  in_parallel(made, [&](const Made& m) { (count == 1 ? first_ : *m.part).begin_assign(m.size); });
  const unsigned shift = shift_of(count);
  std::mutex times_are_kept;
  in_parallel(shares, [&](Share& share) {
    std::size_t k = 0;
    auto time = share.times.begin();
    for_each_subject(*share.block, [&](const auto& subject) {
      const std::size_t to = share.parts[k];
      const Queue_handle local_handle = share.next[to]++;
      std::unique_ptr<Algebraic_number> exact;
      if (time != share.times.end() && time->first == k) {
        exact = std::make_unique<Algebraic_number>(std::move((time++)->second));
      }
      Part& part = count == 1 ? first_ : *made[to].part;
      const std::size_t n = share.first + k;
      part.assign_entry(local_handle, Entry(subject, bounds[n], kept[n]), std::move(exact),
                        times_are_kept);
      policy_.set_handle(subject, named(to, local_handle, shift));
      ++k;
    });
    Share done = std::move(share);
  });
  for (Made& m : made) {
    if (count > 1) parts_.push_back(std::move(m.part));
  }
  shift_ = shift;
  if (count == 1) {
    first_.end_assign();
  } else {
    in_parallel(parts_, [](const std::unique_ptr<Part>& part) {
      part->end_assign();
      part->count_as({});
    });
  }
  first_.count_as(before);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_EVENTS_DISTRIBUTE_H
