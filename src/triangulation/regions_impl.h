// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run.
#ifndef KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/optimistic_window_impl.h"
#include "triangulation/regions.h"
#include "triangulation/subdomains.h"

namespace kinetri::detail {

template <class Traits, class Contacts>
Region_run<Traits, Contacts>::Region_run(typename Contacts::Core& core,
                                         const Region_options& options)
    : core_(Contacts::kinetic(core)),
      topology_(core_.topology),
      schedule_(core_.schedule),
      reporter_(core_.reporter),
      options_(options),
      regions_(number_of_regions(options, topology_.number_of_points())),
      window_(core, options_) {
  bool is_in_use = false;
  window_.for_each_kind([&](auto& events) { is_in_use |= events.queue().is_divided(); });
  if (!is_in_use) division().clear();
}

template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::can_run() const {
  if constexpr (has_contacts) {
    if (!window_.contacts().can_run()) return false;
  }
  return HasRoundedPlace<typename Traits::Motion> && topology_.triangulation().dimension() == 2 &&
         static_cast<double>(topology_.number_of_hidden_points()) *
                 options_.points_per_hidden_one <=
             number_of_points() &&
         !reporter_.observers().any_of(
             [](const Event_observer& observer) { return observer.looks_at_triangulation(); });
}

template <class Traits, class Contacts>
std::size_t Region_run<Traits, Contacts>::advance_to(const Time& until, const Go_on& may_go_on) {
  const std::uint64_t before = reporter_.counters().number_of_events();
  call_with_threads(options_.threads, [&] {
    bool goes_on = true;
    try {
      goes_on = run_windows(until, may_go_on);
    } catch (...) {
      core_.updates.show_current_time();
      throw;
    }
    if (!goes_on) return core_.updates.show_current_time();
    // Without windows, single events are to cost what they should.
    if (schedule_.queue().is_divided() && !can_run()) join();
    if constexpr (has_contacts) {
      window_.contacts().run_to(until, may_go_on);
    } else {
      core_.loop.run_to(until, may_go_on);
    }
  });
  return static_cast<std::size_t>(executed(before));
}

// How many events a window should have: fewer where discs collide, since contacts concern more
// faces than flips, and are more often in each other's way.
template <class Traits, class Contacts>
double Region_run<Traits, Contacts>::events_in_window() const {
  constexpr double most = 1 << 21;  // an eighth of the versions that there are
  double events = options_.events_per_vertex;
  if constexpr (has_contacts) {
    if (window_.contacts().has_pairs()) events /= 5;
  }
  return std::clamp(events * number_of_points(), 1.0, most);
}

// Executes the events up to `until`, by windows where these pay, as long as there can be windows.
// Returns whether the run may go on.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::run_windows(const Time& until, const Go_on& may_go_on) {
  const double last = until.interval().lower;
  windows_before_ = counters().windows;
  division().effort.open(options_.most_waste,
                         cost_of_division() + first_share * events_in_window());
  if (is_divided() && (options_.regions == 0 || division().regions == regions_)) {
    regions_ = division().regions;
    window_.take_up_division(events_in_window());
  }
  while (can_run() && settle(until)) {
    if (may_go_on != nullptr && !may_go_on()) return false;
    const double begin = next_lower();
    if (is_window_next(begin, last)) {
      if (begin_window(begin)) run_window(std::min(begin + division().window_width, last), last);
    } else {
      const std::uint64_t before = reporter_.counters().number_of_events();
      if (!run_loop(until, may_go_on)) return false;
      // A radius that ends at `until` itself is no event before the next call.
      if (has_contacts && executed(before) == 0) return true;
    }
  }
  return true;
}

// ---- windows ----

// Whether the next events are for a window, from `begin` on. Those of a short call are not.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::is_window_next(double begin, double last) {
  Region_division& known = division();
  if (!pause_.is_over()) return false;
  if (known.runs_windows && !known.effort.has(is_divided() ? 0 : cost_of_division())) {
    known.runs_windows = false;
    known.loop_begin = begin;
    known.loop_events = 0;
  }
  if (!known.runs_windows && !may_windows_pay(begin, last)) return false;
  double& width = known.window_width;
  if (counters().windows == windows_before_ && last - begin < width / 16) return false;
  if (!(begin + width > begin)) width = std::max(2 * width, std::numeric_limits<double>::min());
  return std::min(begin + width, last) > begin && !is_loop_next();
}

// Whether windows may pay from `begin` on, by the last events that the loop has executed: enough of
// them to know how long a window should be, each alone at its time; and so many are to come. Then
// it sets how long the first window is: a short one.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::may_windows_pay(double begin, double last) {
  Region_division& known = division();
  const double n = number_of_points();
  const auto enough = static_cast<std::uint64_t>(std::min(events_in_window(), 0.02 * n)) + 1;
  const double time = begin - known.loop_begin;
  if (known.loop_events == 0 || !(time >= 0)) {
    known.loop_begin = begin;
    known.loop_events = 0;
    return false;
  }
  if (known.loop_events < enough || !(time > 0)) return false;
  const auto events = static_cast<double>(known.loop_events);
  const bool are_many = (last - begin) * events > options_.least_events_per_vertex * n * time;
  const bool are_alone = known.effort.is_unlimited() || known.effort.alone() >= enough;
  const double cost = (is_divided() ? 0 : cost_of_division()) + first_share * events_in_window();
  if (!are_many || !are_alone || !known.effort.has(cost)) {
    if (known.loop_events >= 4 * enough) known.loop_events = 0;  // how fast they come may change
    return false;
  }
  const double share = known.effort.is_unlimited() ? 1 : first_share;
  known.window_width = time * share * events_in_window() / events;
  known.runs_windows = true;
  return true;
}

// Makes all ready for a window. Returns whether there can be one.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::begin_window([[maybe_unused]] double begin) {
  if constexpr (has_contacts) {
    if (!window_.contacts().begin_window(begin)) {
      division().effort.spend(cost_of_window());
      pause_.lengthen(topology_.number_of_points());
      return false;
    }
  }
  const double most = options_.events_per_division * number_of_points();
  if (!is_divided() || division().regions != regions_ || division().events > most) {
    window_.or_roll_back([this] { divide(); });
    division().effort.spend(cost_of_division());
  }
  if (window_.are_versions_spent()) {
    window_.or_roll_back([this] { clear_versions(topology_, options_); });
    window_.start_versions();
  }
  return true;
}

// Executes a window and, if it is truncated, the instant at which it is.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::run_window(double end, double last) {
  const double serial = cost_of_window();
  const bool is_whole = window_.run(end);
  if (window_.truncated() && settle(*window_.truncated())) run_loop_instant(*window_.truncated());
  Window_work work = window_.work();
  work.serial = serial;
  division().effort.add_window(work);
  adapt_width(is_whole, end < last);
}

// Chooses how long the next window is, after one that reached its end or was truncated.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::adapt_width(bool is_whole, bool is_full) {
  const double target = events_in_window();
  const auto done = static_cast<double>(window_.reported());
  const bool is_truncated = window_.truncated().has_value();
  double& width = division().window_width;
  // Its first event may be later than its bounds say, and so than the window.
  if (!is_truncated && done == 0) pause_.pass_one();
  // The last window before `until` is a short one, and says nothing.
  if ((is_whole && is_full) || done > target) {
    width *= std::clamp(target / std::max(done, 1.0), 0.25, 4.0);
    pause_.shorten();
  } else if (is_truncated) {
    width *= 0.5;
    if (done < target / 8) pause_.lengthen(topology_.number_of_points());
  }
}

// ---- the parts of the queues ----

template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::divide() {
  choose_regions<Traits>(core_, options_, regions_);
  distribute(division().parts());
  window_.take_up_division(events_in_window());
}

template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::join() {
  window_.or_roll_back([this] { call_with_threads(options_.threads, [this] { distribute(1); }); });
  division().clear();
}

// The sequential loop may have put one of two queues into one part: where it has built all anew.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::distribute(std::size_t parts) {
  distribute_edges<Traits>(core_, options_, parts);
  if constexpr (has_contacts) {
    window_.contacts().divide(parts, [this](auto& elements, const auto& work) {
      call_for_each(options_, elements, work);
    });
  }
}

// Whether all that is to come is in parts.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::is_divided() {
  bool result = true;
  window_.for_each_kind([&](auto& events) { result = result && events.queue().is_divided(); });
  return result;
}

// ---- the sequential loop ----

// Has the loop execute the events of the next times: of several, so that what is asked between them
// takes little. Returns whether the run may go on.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::run_loop(const Time& until, const Go_on& may_go_on) {
  constexpr std::size_t many = 16;
  std::size_t left = std::min(many, topology_.number_of_points() / 1024 + 1);
  if (!pause_.is_over() || is_loop_next()) left = pause_.take(left);
  while (run_loop_instant(until) > 0 && --left > 0) {
    if (may_go_on != nullptr && !may_go_on()) return false;
    if constexpr (!has_contacts) {
      if (!can_run() || !settle(until)) break;
    }
  }
  return true;
}

// Executes the events at one time. Returns their number.
template <class Traits, class Contacts>
std::size_t Region_run<Traits, Contacts>::run_loop_instant(const Time& until) {
  std::size_t events = 0;
  if constexpr (has_contacts) {
    events = window_.contacts().run_instant(until);
  } else {
    events = core_.loop.run_instant();
  }
  division().loop_events += events;
  division().effort.add_loop(events);
  return events;
}

// Whether something happens up to a time.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::settle(const Time& until) {
  bool result = schedule_.settle(&until);
  if constexpr (has_contacts) result = window_.contacts().settle(until) || result;
  return result;
}

// The least lower bound of a time of what happens next. Precondition: something does.
template <class Traits, class Contacts>
double Region_run<Traits, Contacts>::next_lower() {
  double result = std::numeric_limits<double>::infinity();
  window_.for_each_kind([&](auto& events) {
    const auto& queue = events.queue();
    if (!queue.empty()) result = std::min(result, queue.top().bounds.lower);
  });
  return result;
}

// Whether points may coincide at that time, or a hidden one may reach its triangle.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::is_loop_next() {
  const auto& queue = schedule_.queue();
  return !queue.empty() && Window::Edges::is_for_loop(queue.top()) &&
         queue.top().bounds.lower <= next_lower();
}

// ---- other motions of many points at one time ----

// A region does what concerns the points of which it owns all triangles; of these it writes the
// slots of their edges, which have both ends in the region. Entries leave all parts before the
// first motion changes, since they speak of motions, and come back when the last one has.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::make_turns(std::span<const Change> turns) {
  using Two_sided_edge = typename Topology<Traits>::Two_sided_edge;
  struct Share {
    Process* process = nullptr;
    std::vector<const Change*> turns = {};
    std::vector<const Change*> others = {};  // of points that have triangles with other regions
    std::vector<Two_sided_edge> edges = {};
    Time now = {};  // a copy of its own
  };
  regions_ = division().regions;
  window_.take_up_division(events_in_window());
  window_.forget_first();
  std::vector<Share> shares(regions_);
  for (std::size_t region = 0; region < regions_; ++region) {
    shares[region].process = &window_.processes()[region];
    shares[region].now = schedule_.current_time().detached();
  }
  Share rest;
  for (const Change& change : turns) {
    const std::size_t owner = division().owner(change.point);
    (owner < regions_ ? shares[owner] : rest).turns.push_back(&change);
  }
  const auto unschedule = [this](Share& share, Triangulation_counters& counters) {
    for (const Change* turn : share.turns) {
      schedule_.unschedule_around(topology_.vertex(turn->point), share.edges, counters);
    }
  };
  const auto set_points = [this](const Share& share) {
    for (const Change* turn : share.turns) core_.topology.set_point(*turn);
  };
  call_with_threads(options_.threads, [&] {
    call_for_each(options_, shares, [&](Share& share) {
      const auto others =
          std::stable_partition(share.turns.begin(), share.turns.end(), [&](const Change* turn) {
            return window_.edges().owns_star(*share.process, turn->point);
          });
      share.others.assign(others, share.turns.end());
      share.turns.erase(others, share.turns.end());
      share.edges.reserve(16 * share.turns.size());
      unschedule(share, share.process->counters);
    });
    for (const Share& share : shares) {
      rest.turns.insert(rest.turns.end(), share.others.begin(), share.others.end());
    }
    unschedule(rest, reporter_.counters());
    call_for_each(options_, shares, set_points);
    set_points(rest);
    call_for_each(options_, shares, [this](Share& share) {
      window_.edges().certify(*share.process, share.edges, share.now);
    });
  });
  schedule_.schedule(rest.edges, schedule_.current_time());
  for (Process& process : window_.processes()) window_.count_certificates(process);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H
