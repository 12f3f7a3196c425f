// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: the end of a window: its flips in the order of time.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/region_division_impl.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

// Puts the flips of the window in the order of time, but for those from the first time on that two
// have in common, or from the cut on: these are undone.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::settle_order() {
  put_in_order();
  for (std::size_t k = 1; k < order_.size(); ++k) {
    if (order_[k - 1].bounds.upper < order_[k].bounds.lower) continue;
    if (compare(order_[k - 1], order_[k]) != 0) continue;
    const Time& tie = time(order_[k]);
    if (!cut_ || tie < *cut_) cut_ = tie;
    break;
  }
  if (cut_) cut_off();
  for (const Lane& lane : lanes_) {
    if (lane.is_region()) continue;
    move_home(due_part(lane.number));
    if constexpr (has_turns) move_turns_home(due_part(lane.number));
  }
}

// Reports the flips of the window, and counts them. Throws what an observer throws, after that.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::close_window() {
  std::exception_ptr thrown;
  try {
    report();
  } catch (...) {
    thrown = std::current_exception();
  }
  done_ = order_.size();
  division().events += static_cast<double>(done_);
  try {
    count_and_clear();
  } catch (...) {
    start_anew();
    throw;
  }
  if (thrown) std::rethrow_exception(thrown);
}

// Counts what the nodes have done in the window, and forgets their flips.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_and_clear() {
  if constexpr (has_turns) settle_turns_of_window();
  const auto count = [this](Lane& lane) {
    (is_root(lane)      ? counters_.by_rest
     : lane.is_region() ? counters_.by_region
                        : counters_.by_union) += lane.flips.size();
    counters_.undone += std::exchange(lane.undone, 0);
    lane.flips_before += lane.flips.size();
    division().flips[lane.number] = lane.flips_before;
    count_certificates(lane);
  };
  const auto clear = [](Lane& lane) {
    lane.flips.clear();
    lane.keys.clear();
    lane.has_undone = false;
  };
  std::ranges::for_each(lanes_, count);
  for_each(lanes_, clear);
}

// Counts the certificates that a node has made, and those discarded.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_certificates(Lane& lane) {
  schedule_.certificate_counters() += std::exchange(lane.certificates, {});
  reporter_.counters().rechecks += lane.counters.rechecks;
  for (std::size_t k = 0; k < event_kinds; ++k) {
    reporter_.counters().discarded[k] += lane.counters.discarded[k];
  }
  lane.counters = {};
}

// Puts the flips that are not undone in the order of time: several threads do so for slices of the
// window by lower bounds; since bounds may overlap, the first flips of a slice may then go further
// to the front.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::put_in_order() {
  order_.clear();
  std::size_t size = 0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const Lane& lane : lanes_) {
    if (lane.keys.empty()) continue;
    size += lane.keys.size();
    least = std::min(least, lane.keys.front().reached);
    greatest = std::max(greatest, lane.keys.back().reached);
  }
  if (size == 0) return;
  const std::size_t number = size / options_.flips_per_slice + 1;
  std::vector<Slice> slices;
  for (std::size_t k = 0; k < number; ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(number);
    const double end = k + 1 == number ? std::numeric_limits<double>::infinity()
                                       : least + share * (greatest - least);
    slices.push_back({k == 0 ? least : slices.back().end, end});
  }
  for_each(slices, [this](Slice& slice) { slice.size = count_keys(slice); });
  std::size_t first = 0;
  for (Slice& slice : slices) slice.first = std::exchange(first, first + slice.size);
  order_.resize(first);
  for_each(slices, [&](Slice& slice) {
    const std::span<Key> keys = std::span(order_).subspan(slice.first, slice.size);
    distribute(slice, (greatest - least) / static_cast<double>(number), keys);
    slice.is_in_order = insert_in_order(keys);
  });
  bool are_in_order = true;
  for (const Slice& slice : slices) {
    are_in_order = are_in_order && slice.is_in_order;
    // Where one stays, those after it in its slice do.
    std::size_t k = slice.first;
    while (are_in_order && k < slice.first + slice.size && insert_in_order(order_, k) > 0) ++k;
  }
  if (are_in_order) return;
  std::ranges::sort(order_, [this](const Key& a, const Key& b) { return compare(a, b) < 0; });
}

// The keys of a lane that reach from the beginning of a slice on, but not its end.
template <class Traits, class Turns>
auto Region_run<Traits, Turns>::keys_in(const Lane& lane, const Slice& slice)
    -> std::span<const Key> {
  const auto first = std::ranges::lower_bound(lane.keys, slice.least, {}, &Key::reached);
  const auto last = std::ranges::lower_bound(first, lane.keys.end(), slice.end, {}, &Key::reached);
  return {first, last};
}

// How many flips of a slice are not undone.
template <class Traits, class Turns>
std::size_t Region_run<Traits, Turns>::count_keys(const Slice& slice) const {
  std::size_t result = 0;
  for (const Lane& lane : lanes_) {
    const std::span<const Key> keys = keys_in(lane, slice);
    result += keys.size();
    if (!lane.has_undone) continue;
    const auto is_undone = [&](const Key& key) { return lane.flips[key.index].is_undone; };
    result -= static_cast<std::size_t>(std::ranges::count_if(keys, is_undone));
  }
  return result;
}

// Writes the keys of a slice of flips that are not undone to `keys`, nearly in order: through as
// many buckets, of equal shares of the slice's width.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::distribute(const Slice& slice, double width,
                                           std::span<Key> keys) const {
  const auto count = static_cast<double>(keys.size());
  const auto bucket_of = [&](const Key& key) {
    const double bucket = (key.reached - slice.least) / width * count;
    return bucket < count ? static_cast<std::size_t>(bucket) : keys.size();
  };
  const auto for_each_key = [&](const auto& function) {
    for (const Lane& lane : lanes_) {
      for (const Key& key : keys_in(lane, slice)) {
        if (!lane.has_undone || !lane.flips[key.index].is_undone) function(key);
      }
    }
  };
  std::vector<std::size_t> first(keys.size() + 2, 0);  // of each bucket
  for_each_key([&](const Key& key) { ++first[bucket_of(key) + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  for_each_key([&](const Key& key) { keys[first[bucket_of(key)]++] = key; });
}

// Puts each key after those that it does not precede. Gives up, and returns false, where too many
// are in the way.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::insert_in_order(std::span<Key> keys) {
  std::size_t steps = 8 * keys.size();
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const std::size_t moved = insert_in_order(keys, k);
    if (moved > steps) return false;
    steps -= moved;
  }
  return true;
}

// Puts a key after those of the keys before it, which are in order, that it does not precede.
// Returns how many it precedes.
template <class Traits, class Turns>
inline std::size_t Region_run<Traits, Turns>::insert_in_order(std::span<Key> keys, std::size_t k) {
  if (k == 0 || keys[k - 1].bounds.upper < keys[k].bounds.lower) return 0;
  const Key key = keys[k];
  std::size_t to = k;
  for (; to > 0 && compare(key, keys[to - 1]) < 0; --to) keys[to] = keys[to - 1];
  keys[to] = key;
  return k - to;
}

// Undoes the flips from the cut on.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::cut_off() {
  ++counters_.cuts;
  Lane& root_lane = lanes_.back();
  const std::uint64_t undone = root_lane.undone;
  Moment cut = {{}, cut_->interval(), *cut_};
  const auto first =
      std::ranges::partition_point(order_, [&](const Key& key) { return compare(key, cut) < 0; });
  order_.erase(first, order_.end());
  const auto undo_from_cut = [&](Lane& lane) {
    for (std::size_t k = lane.flips.size(); k-- > 0;) {
      if (!lane.flips[k].is_undone && compare(lane.keys[k], cut) >= 0) {
        undo(root_lane, stamp(lane, k));
      }
    }
  };
  std::for_each(lanes_.rbegin(), lanes_.rend(), undo_from_cut);
  counters_.cut_off += std::exchange(root_lane.undone, undone) - undone;
}

// Counts what the flips of the window have in common, and its turns.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_window() {
  reporter_.counters().flat_hulls +=
      static_cast<std::uint64_t>(std::ranges::count(order_, Event_kind::hull_insert, &Key::kind));
  const auto flips = static_cast<std::uint64_t>(
      std::ranges::count_if(order_, [](const Key& key) { return !is_turn(key); }));
  reporter_.counters().instants += flips;
  reporter_.counters().largest_instant =
      std::max<std::uint64_t>(reporter_.counters().largest_instant, flips > 0 ? 1 : 0);
  if constexpr (has_turns) turns_.count(order_.size() - flips);
}

// Counts the flips of the window and shows them to the observers. If an observer throws, the window
// has been executed and counted all the same.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::report() {
  if (order_.empty()) return;
  count_window();
  // Observers get exact times. Several threads make those of some events, which are then reported.
  auto next = order_.cbegin();
  const bool is_watched = !reporter_.observers().empty();
  if (is_watched) go_back_in_turns();
  reporter_.set_in_event(true);
  try {
    while (is_watched && next != order_.cend()) {
      const auto end = next + std::min(events_at_once, order_.cend() - next);
      auto blocks = blocks_of(std::span(next, end), events_of_thread);
      for_each(blocks, [this](std::span<const Key> block) {
        for (const Key& key : block) time(key);
      });
      while (next != end) {
        const Key& key = *next++;
        report(key);
        flip(key).exact.reset();
      }
    }
  } catch (...) {
    go_through_turns();
    count_from(next);
    throw;
  }
  count_from(next);
}

// Counts flips that no observer is told of.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_from(typename std::vector<Key>::const_iterator next) {
  reporter_.set_in_event(false);
  if (next == order_.cend()) return;  // the present time is that of the last one
  for (; next != order_.cend(); ++next) reporter_.count_event(next->kind);
  const Key& last = order_.back();
  Flip& f = flip(last);
  // Where points turn, what it was made from may be in a record, which does not stay.
  if (has_turns || f.exact) {
    time(last);
    schedule_.set_current_time(std::move(*f.exact));
  } else {
    schedule_.set_current_time(certificate_points(last), last.bounds);
  }
}

// Counts a flip and shows it to the observers.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::report(const Key& key) {
  const std::array<Point_id, 4>& corners = flip(key).corners;
  Event event;
  if (is_turn(key)) {
    event = turn_event(key);
  } else {
    event =
        flip_event(key.kind, {edge_ids(corners[0], corners[1]), edge_ids(corners[2], corners[3])});
  }
  schedule_.set_current_time(time(key));
  event.time = schedule_.current_time();
  event.number = reporter_.counters().number_of_events();
  reporter_.count_event(key.kind);
  auto& observers = reporter_.observers();
  observers.call([&](Event_observer& observer) { observer.before_event(event); });
  if (is_turn(key)) go_through(key);
  observers.call([&](Event_observer& observer) { observer.after_event(event); });
  if (!is_turn(key)) return;
  // Each change of points ends with the edges that it has changed, here none.
  observers.call([&](Event_observer& observer) { observer.after_rebuild(event.time, {}); });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H
