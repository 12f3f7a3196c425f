// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: the end of a window: its flips in the order of time.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H

#include <algorithm>
#include <array>
#include <exception>
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
  log_.put_in_order(options_.flips_per_slice,
                    [this](auto& slices, const auto& work) { this->for_each(slices, work); });
  const std::vector<Key>& order = log_.order();
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (order[k - 1].bounds.upper < order[k].bounds.lower) continue;
    if (log_.compare(order[k - 1], order[k]) != 0) continue;
    const Time& tie = log_.time(order[k]);
    if (!cut_ || tie < *cut_) cut_ = tie;
    break;
  }
  if (cut_) cut_off();
  for (const Lane& lane : lanes_) {
    if (lane.is_region()) continue;
    queue().move_home(due_part(lane.number));
    if constexpr (has_turns) turns_.queue().move_home(due_part(lane.number));
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
  done_ = log_.order().size();
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
                        : counters_.by_union) += lane.log->flips.size();
    counters_.undone += std::exchange(lane.undone, 0);
    count_certificates(lane);
  };
  std::ranges::for_each(lanes_, count);
  for_each(lanes_, [this](Lane& lane) { log_.clear(*lane.log); });
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

// Undoes the flips from the cut on.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::cut_off() {
  ++counters_.cuts;
  Lane& root_lane = lanes_.back();
  const std::uint64_t undone = root_lane.undone;
  Moment cut = {{}, cut_->interval(), *cut_};
  const auto first = std::ranges::partition_point(
      log_.order(), [&](const Key& key) { return log_.compare(key, cut) < 0; });
  log_.order().erase(first, log_.order().end());
  const auto undo_from_cut = [&](Lane& lane) {
    for (std::size_t k = lane.log->flips.size(); k-- > 0;) {
      if (!lane.log->flips[k].is_undone && log_.compare(lane.log->keys[k], cut) >= 0) {
        undo(root_lane, log_.stamp(*lane.log, k));
      }
    }
  };
  std::for_each(lanes_.rbegin(), lanes_.rend(), undo_from_cut);
  counters_.cut_off += std::exchange(root_lane.undone, undone) - undone;
}

// Counts what the flips of the window have in common, and its turns.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_window() {
  reporter_.counters().flat_hulls += static_cast<std::uint64_t>(
      std::ranges::count(log_.order(), Event_kind::hull_insert, &Key::kind));
  const auto flips = static_cast<std::uint64_t>(
      std::ranges::count_if(log_.order(), [](const Key& key) { return !Log::is_turn(key); }));
  reporter_.counters().instants += flips;
  reporter_.counters().largest_instant =
      std::max<std::uint64_t>(reporter_.counters().largest_instant, flips > 0 ? 1 : 0);
  if constexpr (has_turns) turns_.count(log_.order().size() - flips);
}

// Counts the flips of the window and shows them to the observers. If an observer throws, the window
// has been executed and counted all the same.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::report() {
  if (log_.order().empty()) return;
  count_window();
  // Observers get exact times. Several threads make those of some events, which are then reported.
  auto next = log_.order().cbegin();
  const bool is_watched = !reporter_.observers().empty();
  if (is_watched) log_.go_back_in_turns();
  reporter_.set_in_event(true);
  try {
    while (is_watched && next != log_.order().cend()) {
      const auto end = next + std::min(events_at_once, log_.order().cend() - next);
      auto blocks = blocks_of(std::span(next, end), events_of_thread);
      for_each(blocks, [this](std::span<const Key> block) {
        for (const Key& key : block) log_.time(key);
      });
      while (next != end) {
        const Key& key = *next++;
        report(key);
        log_.flip(key).exact.reset();
      }
    }
  } catch (...) {
    for (const Key& key : log_.order()) log_.go_through(key);
    count_from(next);
    throw;
  }
  count_from(next);
}

// Counts flips that no observer is told of.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::count_from(typename std::vector<Key>::const_iterator next) {
  reporter_.set_in_event(false);
  if (next == log_.order().cend()) return;  // the present time is that of the last one
  for (; next != log_.order().cend(); ++next) reporter_.count_event(next->kind);
  const Key& last = log_.order().back();
  Flip& f = log_.flip(last);
  // Where points turn, what it was made from may be in a record, which does not stay.
  if (has_turns || f.exact) {
    log_.time(last);
    schedule_.set_current_time(std::move(*f.exact));
  } else {
    schedule_.set_current_time(log_.certificate_points(last), last.bounds);
  }
}

// Counts a flip and shows it to the observers.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::report(const Key& key) {
  const std::array<Point_id, 4>& corners = log_.flip(key).corners;
  Event event;
  if (Log::is_turn(key)) {
    event = turn_event(key);
  } else {
    event =
        flip_event(key.kind, {edge_ids(corners[0], corners[1]), edge_ids(corners[2], corners[3])});
  }
  schedule_.set_current_time(log_.time(key));
  event.time = schedule_.current_time();
  event.number = reporter_.counters().number_of_events();
  reporter_.count_event(key.kind);
  auto& observers = reporter_.observers();
  observers.call([&](Event_observer& observer) { observer.before_event(event); });
  log_.go_through(key);
  observers.call([&](Event_observer& observer) { observer.after_event(event); });
  if (!Log::is_turn(key)) return;
  // Each change of points ends with the edges that it has changed, here none.
  observers.call([&](Event_observer& observer) { observer.after_rebuild(event.time, {}); });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_ORDER_IMPL_H
