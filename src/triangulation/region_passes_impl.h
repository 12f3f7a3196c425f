// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: contacts of discs that pass through each other. They change nothing in
// the triangulation, so they are executed when that has been done for a window, between its other
// events, by what the records say of these.
#ifndef KINETRI_SRC_TRIANGULATION_REGION_PASSES_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGION_PASSES_IMPL_H

#include <algorithm>
#include <array>
#include <exception>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

// Executes the passes of the window, which ends at `end` unless it is cut, counts all of its events
// and shows them to the observers. What an observer throws is thrown when all has been done.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::report_with_passes(double end) {
  if constexpr (has_turns) {
    count_window();
    // The loop follows edges too, while it executes a flip.
    constexpr double cost_of_following = 0.5;
    work_.serial += cost_of_following * static_cast<double>(order_.size());
    Walk walk;
    walk.is_told = are_events_told();
    go_back_in_turns();
    kinetic_.is_in_event_ = true;
    for (auto next = order_.cbegin(); next != order_.cend();) {
      const auto size = std::min(events_at_once, order_.cend() - next);
      const std::span<const Key> keys(next, next + size);
      std::vector<Certificate> known = certificates_of_edges(keys, walk.is_told);
      for (std::size_t k = 0; k < keys.size(); ++k) {
        prefetch_pairs(keys.subspan(k));
        const auto exact = [&]() -> const Time& { return time(keys[k]); };
        execute_passes(
            walk, [&](const Turn_entry& pass) { return precedes(pass, keys[k].bounds, exact); });
        walk_through(walk, keys[k], std::move(known[k]));
      }
      next += size;
    }
    if (cut_) {
      const auto exact = [&]() -> const Time& { return *cut_; };
      execute_passes(
          walk, [&](const Turn_entry& pass) { return precedes(pass, cut_->interval(), exact); });
    } else {
      const Time last(end);
      const auto exact = [&]() -> const Time& { return last; };
      execute_passes(walk, [&](const Turn_entry& pass) {
        return passes().is_due(pass, {end, end}, exact);
      });
    }
    kinetic_.is_in_event_ = false;
    if (walk.last != nullptr && !walk.is_pass_last) kinetic_.set_current_time(time(*walk.last));
    if (walk.thrown) std::rethrow_exception(walk.thrown);
  }
}

// Starts to load what the next events will look at.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::prefetch_pairs(std::span<const Key> next) {
  constexpr std::array<std::size_t, 3> ahead = {24, 16, 8};
  for (int step = 0; step < 3; ++step) {
    const std::size_t k = ahead[static_cast<std::size_t>(step)];
    if (k >= next.size() || is_turn(next[k])) continue;
    for (const Point_id id : flip(next[k]).corners) {
      if (id != no_point) turns_.prefetch(id, step);
    }
  }
}

// The certificates of the edges that flips add, and the exact times if observers are told of them.
// Those of turns are empty.
template <class Kinetic, class Turns>
std::vector<Certificate> Region_run<Kinetic, Turns>::certificates_of_edges(
    std::span<const Key> keys, bool are_told) {
  std::vector<Certificate> result(keys.size());
  auto blocks = blocks_of(keys, events_of_thread);
  for_each(blocks, [&](std::span<const Key> block) {
    for (const Key& key : block) {
      if (are_told) time(key);
      const auto& [right, left, corner, opposite] = flip(key).corners;
      if (is_turn(key) || corner == no_point || opposite == no_point) continue;
      const Stamp number = stamp(lanes_[key.lane], key.index);
      // A little before the flip; see Contact_turns::follow_edges.
      result[static_cast<std::size_t>(&key - keys.data())] =
          turns_.certificate(point_at(std::min(corner, opposite), number),
                             point_at(std::max(corner, opposite), number), Time(key.bounds.lower));
    }
  });
  return result;
}

// Whether a pass is before another event.
template <class Kinetic, class Turns>
template <class Exact>
bool Region_run<Kinetic, Turns>::precedes(const Turn_entry& pass, const Double_interval& bounds,
                                          const Exact& exact) {
  if (pass.bounds.upper < bounds.lower) return true;
  if (pass.bounds.lower > bounds.upper) return false;
  return passes().time(pass) < exact();
}

// Executes the first passes as long as they are due.
template <class Kinetic, class Turns>
template <class Is_due>
void Region_run<Kinetic, Turns>::execute_passes(Walk& walk, const Is_due& is_due) {
  while (!passes().empty() && is_due(passes().top())) {
    const bool is_recheck = turns_.is_recheck(passes().top());
    Time now = is_recheck ? Time() : passes().time(passes().top());
    const Turn_entry pass = passes().pop();
    if (is_recheck) {
      turns_.recheck(pass);
      continue;
    }
    turns_.forget(pass);
    go_to_pass(walk, pass, std::move(now));
    if (!turns_.note_pass(pass, [this] { return is_pass_due(); })) execute_pass(walk, pass);
  }
}

// Whether the first pass is at the present time.
template <class Kinetic, class Turns>
bool Region_run<Kinetic, Turns>::is_pass_due() {
  const Time& now = kinetic_.current_time();
  while (!passes().empty() && passes().top().bounds.lower <= now.interval().upper) {
    if (!turns_.is_recheck(passes().top())) return passes().time(passes().top()) <= now;
    turns_.recheck(passes().pop());
  }
  return false;
}

// Goes to the time of a pass. At one time passes come after all else.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::go_to_pass(Walk& walk, const Turn_entry& pass, Time now) {
  const auto is_now = [&](const Key& key) {
    return key.bounds.upper >= pass.bounds.lower && time(key) == now;
  };
  const bool is_another = walk.is_pass_last ? now == kinetic_.current_time()
                                            : walk.last != nullptr && is_now(*walk.last);
  if (!is_another) {
    walk.contacts_now = 0;
    walk.is_alone = true;
  }
  walk.is_pass_last = true;
  kinetic_.set_current_time(std::move(now));
}

// Executes a pass of the present time that has left the queue.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::execute_pass(Walk& walk, const Turn_entry& pass) {
  ++walk.contacts_now;
  work_.reported += 1;
  work_.serial += 1;
  turns_.count_pass(walk.contacts_now, std::exchange(walk.is_alone, false));
  turns_.pass(pass, [&] {
    Event event;
    event.kind = Event_kind::collision;
    event.point_a = pass.point_a;
    event.point_b = pass.point_b;
    const std::uint64_t number = kinetic_.counters_.number_of_events();
    kinetic_.count_event(event.kind);
    tell_if_told(walk, [&] {
      tell(event, number, [] {});
      report_edges({}, number + 1);
    });
  });
}

// Goes through another event of the window. `known` is the certificate of the edge that it adds.
template <class Kinetic, class Turns>
void Region_run<Kinetic, Turns>::walk_through(Walk& walk, const Key& key, Certificate&& known) {
  const auto report_or_count = [&] {
    if (!walk.is_told) return count(key);
    tell_if_told(walk, [&] { report(key); });
  };
  if (walk.last != nullptr) flip(*walk.last).exact.reset();
  walk.last = &key;
  walk.is_pass_last = false;
  walk.is_alone = false;
  walk.contacts_now = is_turn(key) ? 1 : 0;
  if (is_turn(key)) {
    kinetic_.set_current_time(time(key));
    const Turn& turn = *flip(key).turn;
    turns_.turn(turn.turned[0], turn.neighbors, [&] {
      report_or_count();
      go_through(key);  // if an observer has thrown, it has not been yet
    });
  } else {
    report_or_count();
    const auto& [right, left, corner, opposite] = flip(key).corners;
    turns_.follow_edges(
        Kinetic::flip_event(key.kind, edge_ids(right, left), edge_ids(corner, opposite)),
        std::move(known), key.bounds, [&]() -> const Time& { return time(key); });
  }
}

// Calls tell() if observers are told, and keeps what they throw.
template <class Kinetic, class Turns>
template <class Tell>
void Region_run<Kinetic, Turns>::tell_if_told(Walk& walk, const Tell& tell) {
  if (!walk.is_told) return;
  try {
    tell();
  } catch (...) {
    walk.thrown = std::current_exception();
    walk.is_told = false;
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGION_PASSES_IMPL_H
