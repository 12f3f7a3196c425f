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
      regions_(number_of_regions(options, topology_.number_of_vertices())),
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
  return topology_.triangulation().dimension() == 2 &&
         static_cast<double>(topology_.number_of_hidden_vertices()) *
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
    // Without windows, a partitioned queue only makes single events more expensive.
    if (schedule_.queue().is_divided() && !can_run()) join();
    if constexpr (has_contacts) {
      window_.contacts().run_to(until, may_go_on);
    } else {
      core_.loop.run_to(until, may_go_on);
    }
  });
  return static_cast<std::size_t>(executed(before));
}

// How many events a window should have: fewer if discs collide, since contacts concern more faces
// than flips and conflict more often.
template <class Traits, class Contacts>
double Region_run<Traits, Contacts>::events_in_window() const {
  constexpr double most = 1 << 21;  // an eighth of the versions that there are
  double events = options_.events_per_vertex;
  if constexpr (has_contacts) {
    if (window_.contacts().has_pairs()) events /= 5;
  }
  return std::clamp(events * number_of_points(), 1.0, most);
}

// Executes the events up to `until`, in windows if these pay, as long as windows are possible.
// Returns whether to continue.
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
      // A radius that reaches zero at `until` is an event of the next call.
      if (has_contacts && executed(before) == 0) return true;
    }
  }
  return true;
}

// ---- windows ----

// Whether a window executes the next events, from `begin` on. Not if the call is short.
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

// Whether windows may pay from `begin` on. The sequential loop must have executed enough events to
// estimate the width of a window, the latest ones each alone at its time, and enough events must be
// expected. If so, sets the width of the first window, a short one.
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
    if (known.loop_events >= 4 * enough) known.loop_events = 0;  // their rate may change
    return false;
  }
  const double share = known.effort.is_unlimited() ? 1 : first_share;
  known.window_width = time * share * events_in_window() / events;
  known.runs_windows = true;
  return true;
}

// Prepares a window. Returns whether one is possible.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::begin_window([[maybe_unused]] double begin) {
  if constexpr (has_contacts) {
    if (!window_.contacts().begin_window(begin)) {
      division().effort.spend(cost_of_window());
      pause_.lengthen(topology_.number_of_vertices());
      return false;
    }
  }
  const double most = options_.events_per_division * number_of_points();
  if (!is_divided() || division().regions != regions_ || division().events > most) {
    window_.or_roll_back([this] { divide(); });
    division().effort.spend(cost_of_division());
  }
  if (window_.are_versions_spent()) {
    window_.or_roll_back([this] { clear_versions<Traits>(topology_, options_); });
    window_.start_versions();
  }
  return true;
}

// Executes a window and, if it is truncated, the instant at which it was truncated.
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

template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::adapt_width(bool is_whole, bool is_full) {
  const double target = events_in_window();
  const auto done = static_cast<double>(window_.reported());
  const bool is_truncated = window_.truncated().has_value();
  double& width = division().window_width;
  // The window had no event: the exact time of the first one may be after the window, though its
  // bounds begin in it.
  if (!is_truncated && done == 0) pause_.pass_one();
  // The last window before `until` may be short, and says nothing about the width.
  if ((is_whole && is_full) || done > target) {
    width *= std::clamp(target / std::max(done, 1.0), 0.25, 4.0);
    pause_.shorten();
  } else if (is_truncated) {
    width *= 0.5;
    if (done < target / 8) pause_.lengthen(topology_.number_of_vertices());
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

// Partitions both queues: the sequential loop may have rebuilt one of them in one part.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::distribute(std::size_t parts) {
  distribute_edges<Traits>(core_, options_, parts);
  if constexpr (has_contacts) {
    window_.contacts().divide(parts, [this](auto& elements, const auto& work) {
      call_for_each(options_, elements, work);
    });
  }
}

template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::is_divided() {
  bool result = true;
  window_.for_each_kind([&](auto& events) { result = result && events.queue().is_divided(); });
  return result;
}

// ---- the sequential loop ----

// The sequential loop executes the next instants, several of them, so that the checks between two
// calls cost little. Returns whether to continue.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::run_loop(const Time& until, const Go_on& may_go_on) {
  constexpr std::size_t many = 16;
  std::size_t left = std::min(many, topology_.number_of_vertices() / 1024 + 1);
  if (!pause_.is_over() || is_loop_next()) left = pause_.take(left);
  while (run_loop_instant(until) > 0 && --left > 0) {
    if (may_go_on != nullptr && !may_go_on()) return false;
    if constexpr (!has_contacts) {
      if (!can_run() || !settle(until)) break;
    }
  }
  return true;
}

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

// Whether an event is due up to a time.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::settle(const Time& until) {
  bool result = schedule_.settle(&until);
  if constexpr (has_contacts) result = window_.contacts().settle(until) || result;
  return result;
}

// The least lower bound of the next event's time; infinite if there is none.
template <class Traits, class Contacts>
double Region_run<Traits, Contacts>::next_lower() {
  double result = std::numeric_limits<double>::infinity();
  window_.for_each_kind([&](auto& events) {
    const auto& queue = events.queue();
    if (!queue.empty()) result = std::min(result, queue.top().bounds.lower);
  });
  return result;
}

// Whether the first entry is for the sequential loop: points may coincide, or a hidden point may be
// revealed.
template <class Traits, class Contacts>
bool Region_run<Traits, Contacts>::is_loop_next() {
  const auto& queue = schedule_.queue();
  return !queue.empty() && Window::Edges::is_for_loop(queue.top()) &&
         queue.top().bounds.lower <= next_lower();
}

// ---- other motions of many points at one time ----

// A region changes the points of which it owns all triangles, and writes the handles of their
// edges, which have both ends in the region. All entries are removed before the first motion
// changes, since they depend on motions, and made again after the last change.
template <class Traits, class Contacts>
void Region_run<Traits, Contacts>::change_in_place(std::span<const Change> changes) {
  using Edge_with_mirror = typename Topology<Traits>::Edge_with_mirror;
  struct Share {
    Process* process = nullptr;
    std::vector<const Change*> changes = {};
    std::vector<const Change*> others = {};  // of points with triangles in other regions
    std::vector<Edge_with_mirror> edges = {};
    Time now = {};  // its own copy
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
  for (const Change& change : changes) {
    const std::size_t owner = division().owner(change.point);
    (owner < regions_ ? shares[owner] : rest).changes.push_back(&change);
  }
  const auto unschedule = [this](Share& share, Triangulation_counters& counters) {
    for (const Change* change : share.changes) {
      schedule_.unschedule_around(topology_.vertex(change->point), share.edges, counters);
    }
  };
  const auto set_points = [this](const Share& share) {
    for (const Change* change : share.changes) core_.topology.set_point(*change);
  };
  call_with_threads(options_.threads, [&] {
    call_for_each(options_, shares, [&](Share& share) {
      const auto others = std::stable_partition(
          share.changes.begin(), share.changes.end(), [&](const Change* change) {
            return window_.edges().owns_star(*share.process, change->point);
          });
      share.others.assign(others, share.changes.end());
      share.changes.erase(others, share.changes.end());
      share.edges.reserve(16 * share.changes.size());
      unschedule(share, share.process->counters);
    });
    for (const Share& share : shares) {
      rest.changes.insert(rest.changes.end(), share.others.begin(), share.others.end());
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
