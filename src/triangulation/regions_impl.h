// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Region_run: the run, and its windows of time.
#ifndef KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H
#define KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/region_batches_impl.h"
#include "triangulation/region_division_impl.h"
#include "triangulation/region_flips_impl.h"
#include "triangulation/region_order_impl.h"
#include "triangulation/region_turns_impl.h"
#include "triangulation/regions.h"
#include "triangulation/window_log_impl.h"

namespace kinetri::detail {

// So many that each thread has several, and that what a region has stays near in memory. Fewer
// where there are few points, of which more are beside another region then; and where there are so
// many that handles, which name one of at most 5 R - 1 parts, would have no bits left for the
// entries of all 3 n edges in one part, and of as many that come later.
inline std::size_t number_of_regions(const Region_options& options, std::size_t points) {
  const std::size_t threads = usable_threads(options.threads);
  const std::size_t enough = std::max(4 * threads, points / 12'500);
  const auto by_points =
      std::min(enough, static_cast<std::size_t>(std::sqrt(static_cast<double>(points)) / 15));
  const int bits = std::max(2, 32 - static_cast<int>(std::bit_width(6 * points)));
  const std::size_t most = std::min<std::size_t>(128, ((std::size_t{1} << bits) + 1) / 5);
  return std::bit_floor(
      std::clamp<std::size_t>(options.regions > 0 ? options.regions : by_points, 1, most));
}

template <class Traits, class Turns>
Region_run<Traits, Turns>::Region_run(Kinetic_core<Traits>& core, const Region_options& options,
                                      Turns turns)
    : topology_(core.topology),
      triangulation_(core.topology.triangulation()),
      certification_(core.certification),
      schedule_(core.schedule),
      reporter_(core.reporter),
      updates_(core.updates),
      loop_(core.loop),
      turns_(std::move(turns)),
      options_(options),
      regions_(number_of_regions(options, core.topology.number_of_points())),
      threads_(usable_threads(options.threads)),
      log_(topology_, certification_, schedule_.division()) {
  bool is_in_use = queue().is_divided();
  if constexpr (has_turns) is_in_use = is_in_use || turns_.queue().is_divided();
  if (!is_in_use) division().clear();
}

template <class Traits, class Turns>
bool Region_run<Traits, Turns>::can_run() const {
  if constexpr (has_turns) {
    if (!turns_.can_run()) return false;
  }
  return HasRoundedPlace<typename Types::Motion> && triangulation_.dimension() == 2 &&
         static_cast<double>(topology_.number_of_hidden_points()) *
                 options_.points_per_hidden_one <=
             static_cast<double>(topology_.number_of_points()) &&
         !reporter_.observers().any_of(
             [](const Event_observer& observer) { return observer.looks_at_triangulation(); });
}

template <class Traits, class Turns>
std::size_t Region_run<Traits, Turns>::advance_to(const Time& until, const Go_on& may_go_on) {
  std::size_t events = 0;
  call_with_threads(options_.threads, [&] { events = advance(until, may_go_on); });
  return events;
}

template <class Traits, class Turns>
std::size_t Region_run<Traits, Turns>::advance(const Time& until, const Go_on& may_go_on) {
  const std::uint64_t before = reporter_.counters().number_of_events();
  bool goes_on = true;
  try {
    goes_on = run_windows(until, may_go_on);
  } catch (...) {
    updates_.show_current_time();
    throw;
  }
  if (goes_on) {
    // Where there are no windows, single events are to cost what they should.
    if (queue().is_divided() && !can_run()) join();
    if constexpr (has_turns) {
      turns_.run_to(until, may_go_on);
    } else {
      loop_.run_to(until, may_go_on);
    }
  } else {
    updates_.show_current_time();
  }
  return static_cast<std::size_t>(executed(before));
}

// How many events a window should have: fewer where discs collide, since contacts concern more
// faces than flips, and are more often in each other's way.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::events_in_window() const {
  constexpr double most = 1 << 21;  // an eighth of the numbers that stamps have
  const double events = options_.events_per_vertex / (has_contacts() ? 5 : 1);
  return std::clamp(events * static_cast<double>(topology_.number_of_points()), 1.0, most);
}

// What a division of the queue costs, and to put it together again, in events; and a window,
// besides its events. Estimates.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::cost_of_division() const {
  return 0.25 * static_cast<double>(topology_.number_of_points());
}
template <class Traits, class Turns>
double Region_run<Traits, Turns>::cost_of_window() const {
  return static_cast<double>(topology_.number_of_points()) / (has_turns ? 128 : 256);
}

// Executes the events up to `until`, by windows where these pay, as long as there can be windows.
// Returns whether the run may go on.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::run_windows(const Time& until, const Go_on& may_go_on) {
  const double last = until.interval().lower;
  Region_effort& effort = division().effort;
  windows_before_ = counters_.windows;
  effort.open(options_.most_waste, cost_of_division() + first_share * events_in_window());
  if (is_divided() && (options_.regions == 0 || division().regions == regions_)) {
    go_on_with_division();
  }
  while (can_run() && settle(until)) {
    if (may_go_on != nullptr && !may_go_on()) return false;
    const double begin = next_lower();
    if (is_window_next(begin, last)) {
      if (!begin_window(begin)) continue;
      const double end = std::min(begin + division().window_width, last);
      const bool is_whole = run_window(end);
      effort.add_window(work_);
      adapt_width(is_whole, end < last);
    } else {
      const std::uint64_t before = reporter_.counters().number_of_events();
      if (!run_loop(until, may_go_on)) return false;
      // A radius that ends at `until` itself is no event before the next call.
      if (has_turns && executed(before) == 0) return true;
    }
  }
  return true;
}

// Whether the next events are for a window, from `begin` on. Those of a short call are not.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_window_next(double begin, double last) {
  Region_division& known = division();
  if (!pause_.is_over()) return false;
  if (known.runs_windows && !known.effort.has(is_divided() ? 0 : cost_of_division())) {
    known.runs_windows = false;
    known.loop_begin = begin;
    known.loop_events = 0;
  }
  if (!known.runs_windows && !may_windows_pay(begin, last)) return false;
  double& width = known.window_width;
  if (counters_.windows == windows_before_ && last - begin < width / 16) return false;
  if (!(begin + width > begin)) width = std::max(2 * width, std::numeric_limits<double>::min());
  return std::min(begin + width, last) > begin && !is_loop_next();
}

// Whether windows may pay from `begin` on, by the last events that the loop has executed: enough of
// them to know how long a window should be, each alone at its time; and so many are to come. Then
// it sets how long the first window is: a short one.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::may_windows_pay(double begin, double last) {
  Region_division& known = division();
  const auto n = static_cast<double>(topology_.number_of_points());
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
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::begin_window([[maybe_unused]] double begin) {
  if constexpr (has_turns) {
    if (!turns_.begin_window(begin)) {
      division().effort.spend(cost_of_window());
      pause_.lengthen(topology_.number_of_points());
      return false;
    }
  }
  const double most =
      options_.events_per_division * static_cast<double>(topology_.number_of_points());
  if (!is_divided() || division().regions != regions_ || division().events > most) {
    or_go_back([this] { divide(); });
    division().effort.spend(cost_of_division());
  }
  if (are_stamps_spent()) or_go_back([this] { clear_stamps(); });
  return true;
}

// Chooses how long the next window is, after one that reached its end or was cut.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::adapt_width(bool is_whole, bool is_full) {
  const double target = events_in_window();
  const auto done = static_cast<double>(done_);
  double& width = division().window_width;
  // Its first event may be later than its bounds say, and so than the window.
  if (!cut_ && done_ == 0) pause_.pass_one();
  // The last window before `until` is a short one, and says nothing.
  if ((is_whole && is_full) || done > target) {
    width *= std::clamp(target / std::max(done, 1.0), 0.25, 4.0);
    pause_.shorten();
  } else if (cut_) {
    width *= 0.5;
    if (done < target / 8) pause_.lengthen(topology_.number_of_points());
  }
}

// Has the loop execute the events of the next times: of several, so that what is asked between them
// takes little. Returns whether the run may go on.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::run_loop(const Time& until, const Go_on& may_go_on) {
  constexpr std::size_t many = 16;
  std::size_t left = std::min(many, topology_.number_of_points() / 1024 + 1);
  if (!pause_.is_over() || is_loop_next()) left = pause_.take(left);
  while (run_loop_instant(until) > 0 && --left > 0) {
    if (may_go_on != nullptr && !may_go_on()) return false;
    if constexpr (!has_turns) {
      if (!can_run() || !settle(until)) break;
    }
  }
  return true;
}

// Executes the events at one time as the plain loop does. Returns their number.
template <class Traits, class Turns>
std::size_t Region_run<Traits, Turns>::run_loop_instant(const Time& until) {
  std::size_t events = 0;
  if constexpr (has_turns) {
    events = turns_.run_instant(until);
  } else {
    events = loop_.run_instant();
  }
  division().loop_events += events;
  division().effort.add_loop(events);
  return events;
}

// Whether something happens up to a time.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::settle(const Time& until) {
  bool result = schedule_.settle(&until);
  if constexpr (has_turns) result = turns_.settle(until) || result;
  return result;
}

// The least lower bound of a time of what happens next. Precondition: something does.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::next_lower() {
  double result = std::numeric_limits<double>::infinity();
  if (!queue().empty()) result = queue().top().bounds.lower;
  if constexpr (has_turns) {
    if (!turns_.queue().empty()) result = std::min(result, turns_.queue().top().bounds.lower);
  }
  return result;
}

// Whether points may coincide at that time, or a hidden one may reach its triangle.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::is_loop_next() {
  return !queue().empty() && is_for_loop(queue().top()) &&
         queue().top().bounds.lower <= next_lower();
}

// ---- a window ----

// Returns whether the window reached `end`.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::run_window(double end) {
  ++counters_.windows;
  cut_.reset();
  double reached = end;
  const std::uint64_t cut_off_before = counters_.cut_off;
  or_go_back([&] {
    reached = execute_window(end);
    settle_order();
  });
  work_ = work_of_nodes();
  work_.undone += static_cast<double>(counters_.cut_off - cut_off_before);
  close_window();
  const bool is_whole = !cut_ && reached == end;
  if (cut_ && settle(*cut_)) run_loop_instant(*cut_);
  return is_whole;
}

// What the nodes have done in the window.
template <class Traits, class Turns>
Window_work Region_run<Traits, Turns>::work_of_nodes() const {
  Window_work work;
  work.reported = static_cast<double>(log_.order().size());
  work.serial = cost_of_window();
  for (unsigned level = 0; level <= lanes_.back().level; ++level) {
    double most = 0;
    double sum = 0;
    for (const Lane& lane : lanes_) {
      if (lane.level != level) continue;
      const auto executed = static_cast<double>(lane.log->flips.size());
      most = std::max(most, executed);
      sum += executed;
      work.undone += static_cast<double>(lane.undone);
    }
    work.executed += sum;
    work.in_turn += std::max(most, sum / static_cast<double>(threads_));
  }
  return work;
}

// Has the nodes execute the events of a window. Returns where it ends.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::execute_window(double end) {
  updates_.show_current_time();  // made from motions of now, by one thread
  forget_first();
  if constexpr (has_turns) {
    log_.make_room(topology_.vertices().size());
    stalls_.resize(topology_.vertices().size(), std::numeric_limits<double>::infinity());
  }
  for (Lane& lane : lanes_) {
    lane.capacity = std::min(lane.most_flips, lane.log->numbers - lane.log->before);
  }
  end = gather_due(end);
  for (unsigned level = 0; level <= lanes_.back().level; ++level) {
    auto lanes = lanes_at(level);
    for_each(lanes, [&](Lane* lane) {
      lane->is_region() ? run_region(*lane, end) : run_union(*lane, end);
    });
    due_until_ = end;
  }
  due_until_ = -std::numeric_limits<double>::infinity();
  return end;
}

// Calls work(), part of a window. If that throws, which is for want of memory, the state is that
// before the window.
template <class Traits, class Turns>
template <class Work>
void Region_run<Traits, Turns>::or_go_back(const Work& work) {
  try {
    work();
  } catch (...) {
    go_back();
    throw;
  }
}

// Undoes what has been executed of a window, the last events first: those of nodes of one level do
// not conflict. Entries of the queues are lost.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::go_back() {
  log_.roll_back_all();
  start_anew();
}

// Forgets the window and the parts, and schedules everything from the present time on.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::start_anew() {
  for (Lane& lane : lanes_) {
    Lane cleared;
    std::swap(lane, cleared);
  }
  log_.reset();
  std::ranges::fill(stalls_, std::numeric_limits<double>::infinity());
  due_until_ = -std::numeric_limits<double>::infinity();
  division().clear();
  queue().clear();
  schedule_.schedule_all();
  if constexpr (has_turns) turns_.start_anew();
}

template <class Traits, class Turns>
auto Region_run<Traits, Turns>::lanes_at(unsigned level) -> std::vector<Lane*> {
  std::vector<Lane*> result;
  for (Lane& lane : lanes_) {
    if (lane.level == level) result.push_back(&lane);
  }
  return result;
}

// Puts aside what fails in the window at edges between regions. Returns where the window ends:
// before the first entry there that is for the plain loop.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::gather_due(double end) {
  struct Gathering {
    Lane* lane;
    double end;
  };
  std::vector<Gathering> all;
  for (Lane& lane : lanes_) {
    if (!lane.is_region()) all.push_back({&lane, end});
  }
  for_each(all, [&](Gathering& g) { g.end = gather_due(*g.lane, end); });
  if constexpr (has_turns) {
    for (Lane& lane : lanes_) {
      if (lane.is_region()) continue;
      lane.turn_part->for_each([&](const Turn_entry& entry) { stall(lane, entry); });
    }
  }
  return std::ranges::min(all, {}, &Gathering::end).end;
}

// The same for a union of regions: has the certificates of its part checked again until it is known
// which fail in the window.
template <class Traits, class Turns>
double Region_run<Traits, Turns>::gather_due(Lane& lane, double end) {
  Part& part = queue().part(lane.number);
  const Time last(end);
  const auto exact = [&]() -> const Time& { return last; };
  while (!part.empty() && part.is_due(part.top(), {end, end}, exact)) {
    const Entry entry = part.top();
    if (entry.kind == Entry_kind::recheck) {
      part.pop();
      recheck(lane, {&entry, 1});
      continue;
    }
    queue().move_first(lane.number, due_part(lane.number));
    if (is_for_loop(entry)) {
      end = std::min(end, entry.bounds.lower);
      break;
    }
  }
  if constexpr (has_turns) return gather_due_turns(lane, end);
  return end;
}

// Certifies the edges of entries anew, from the time of the first entry on.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::recheck(Lane& lane, std::span<const Entry> entries) {
  lane.counters.rechecks += entries.size();
  if constexpr (Types::is_weighted) {
    // In the part of the root, whose entries are taken one by one.
    const Entry& first = entries.front();
    if (first.is_hidden()) {
      return schedule_.schedule_hidden(first.hidden, Time(first.bounds.lower));
    }
  }
  std::array<Two_sided_edge, 2> edges;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    edges[k] = topology_.two_sided(entries[k].edge());
  }
  certification_.certify(std::span(edges).first(entries.size()), Time(entries.front().bounds.lower),
                         Certificate_state::any, lane.certificates,
                         [&](const Two_sided_edge& edge, Entry_kind kind, Certificate&& known) {
                           put(lane, edge, kind, std::move(known));
                         });
}

// Executes what is due in a region, in its order.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::run_region(Lane& lane, double end) {
  Part& part = *lane.part;
  // Somewhat later than the end, so that what is first then is known too.
  const double soon = end + division().window_width / 16;
  part.expect(soon);
  if constexpr (has_turns) lane.turn_part->expect(soon);
  const Time last(end);
  const auto exact = [&]() -> const Time& { return last; };
  const auto is_due = [&](const Entry& entry) { return part.is_due(entry, {end, end}, exact); };
  const auto recheck_entries = [&](std::span<const Entry> entries) { recheck(lane, entries); };
  while (true) {
    const bool is_flip_due = part.settle(is_due, recheck_entries);
    if constexpr (has_turns) {
      if (settle_turns(lane, last) && is_turn_first(lane, is_flip_due)) {
        execute_turn(lane);
        continue;
      }
    }
    if (!is_flip_due) break;
    const Entry entry = part.top();
    const Two_sided_edge edge = topology_.two_sided(entry.edge());
    Moment moment = moment_of(entry, edge, part);
    if (!may_execute(lane, entry, edge) || !is_flip(entry, edge, moment)) {
      defer(lane, lane.number);
      continue;
    }
    part.pop();
    execute(lane, entry, edge, moment);
  }
}

// Executes what is due in a union of regions and has not been executed by one of these, in the
// order of the queue. The root stops where an event is no flip.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::run_union(Lane& lane, double end) {
  const std::size_t from = due_part(lane.number);
  for (std::size_t below = 0; below < lane.number; ++below) {
    if (division().above(below) != lane.number) continue;
    while (!queue().part(deferred_part(below)).empty())
      queue().move_first(deferred_part(below), from);
    if constexpr (has_turns) {
      auto& turns = turns_.queue();
      while (!turns.part(deferred_part(below)).empty())
        turns.move_first(deferred_part(below), from);
    }
  }
  Part& due = *lane.part;
  const Time last(end);
  const auto exact = [&]() -> const Time& { return last; };
  while (true) {
    const bool is_one_due = !due.empty() && due.is_due(due.top(), {end, end}, exact);
    if (is_one_due && due.top().kind == Entry_kind::recheck) {
      // Alone: beside it may be one that is about a flip later than this time.
      const Entry entry = due.pop();
      recheck(lane, {&entry, 1});
      continue;
    }
    if constexpr (has_turns) {
      if (settle_turns(lane, last) && is_turn_first(lane, is_one_due)) {
        if (!execute_turn(lane)) break;
        continue;
      }
    }
    if (!is_one_due) break;
    const Entry entry = due.top();
    if (entry.is_hidden()) {  // in the part of the root alone
      cut_ = due.time_of(due.top());
      break;
    }
    const Two_sided_edge edge = topology_.two_sided(entry.edge());
    if (!is_root(lane) && !may_execute(lane, entry, edge)) {
      defer(lane, from);
      continue;
    }
    if (is_for_loop(entry) || lane.log->flips.size() >= lane.capacity) {
      cut_ = due.time_of(due.top());
      break;
    }
    Moment moment = moment_of(entry, edge, due);
    undo_later(lane, edge, moment);
    // What comes back is later, but may begin with a certificate that is to be checked again
    // before.
    const auto handle = [&](const Entry& e) { return schedule_.policy().handle(e.subject()); };
    if (handle(due.top()) != handle(entry)) continue;
    if (!is_flip(entry, edge, moment)) {
      if (!is_root(lane)) {
        defer(lane, from);
        continue;
      }
      cut_ = log_.time(moment);
      break;
    }
    due.pop();
    execute(lane, entry, edge, moment);
  }
}

// Whether a node that is not the root may flip the edge of the first of its entries now.
template <class Traits, class Turns>
bool Region_run<Traits, Turns>::may_execute(Lane& lane, const Entry& entry,
                                            const Two_sided_edge& edge) {
  return entry.kind == Entry_kind::flip && lane.log->flips.size() < lane.capacity &&
         is_owned(lane, edge) && !is_blocked(lane, entry, edge);
}

// Leaves the first entry of a part to the node above.
template <class Traits, class Turns>
void Region_run<Traits, Turns>::defer(Lane& lane, std::size_t from) {
  queue().move_first(from, deferred_part(lane.number));
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_REGIONS_IMPL_H
