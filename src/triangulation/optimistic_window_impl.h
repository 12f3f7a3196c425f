// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Optimistic_window.
#ifndef KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_IMPL_H
#define KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_IMPL_H

#include <algorithm>
#include <exception>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "triangulation/edge_events_impl.h"
#include "triangulation/optimistic_window.h"
#include "triangulation/window_log_impl.h"

namespace kinetri::detail {

template <class Traits, class Contacts>
Optimistic_window<Traits, Contacts>::Optimistic_window(typename Contacts::Core& core,
                                                       const Region_options& options)
    : core_(Contacts::kinetic(core)),
      schedule_(core_.schedule),
      options_(options),
      threads_(usable_threads(options.threads)),
      log_(core_.topology, core_.certification, schedule_.division()),
      edges_(core_, log_),
      contacts_(core, edges_, log_),
      reporter_(core_, options_, log_, contacts_) {}

// ---- processes ----

template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::take_up_division(double events) {
  log_.take_up_division();
  processes_.resize(division().nodes());
  const auto most = static_cast<double>(options_.most_flips);
  for (std::size_t node = 0; node < processes_.size(); ++node) {
    Process& process = processes_[node];
    process.number = node;
    process.level = division().level(node);
    process.is_root = node + 1 == processes_.size();
    process.from = process.is_region() ? node : division().due_part(node);
    process.edges = &edges_.queue().part(process.from);
    process.first_handle = edges_.queue().named(process.from, 0);
    process.log = &log_.node(node);
    const double share = 4 * division().share(node) * events;
    process.most_events = static_cast<std::size_t>(std::min(share + 64, most));
    if (process.is_region()) {
      process.due_until = std::numeric_limits<double>::infinity();
      // Somewhat more than its share of a window.
      const auto expected = static_cast<std::size_t>(1.2 * share / 16) + 64;
      process.log->records.reserve(std::min(expected, process.most_events));
      process.log->keys.reserve(std::min(expected, process.most_events));
    }
  }
  if constexpr (has_contacts) contacts_.take_up(processes_);
}

template <class Traits, class Contacts>
bool Optimistic_window<Traits, Contacts>::are_versions_spent() const {
  return std::ranges::any_of(processes_, [](const Process& process) {
    return Log::are_numbers_spent(*process.log, process.most_events);
  });
}

template <class Traits, class Contacts>
template <class Work>
void Optimistic_window<Traits, Contacts>::or_roll_back(const Work& work) {
  try {
    work();
  } catch (...) {
    log_.roll_back_all();
    start_anew();
    throw;
  }
}

// Discards the window and the parts, and schedules everything from the present time on.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::start_anew() {
  processes_.clear();
  log_.reset();
  division().clear();
  schedule_.queue().clear();
  schedule_.schedule_all();
  if constexpr (has_contacts) contacts_.start_anew();
}

// ---- the execution of a window ----

template <class Traits, class Contacts>
bool Optimistic_window<Traits, Contacts>::run(double end) {
  ++counters_.windows;
  truncated_.reset();
  double reached = end;
  const std::uint64_t truncated_before = counters_.truncated;
  or_roll_back([&] {
    reached = execute(end);
    put_in_order();
  });
  work_ = work_of_processes();
  work_.rolled_back += static_cast<double>(counters_.truncated - truncated_before);
  close();
  return !truncated_ && reached == end;
}

// Executes the events of a window in all nodes. Returns its end, which may be earlier.
template <class Traits, class Contacts>
double Optimistic_window<Traits, Contacts>::execute(double end) {
  core_.updates.show_current_time();  // computed from the present motions, by one thread
  forget_first();
  if constexpr (has_contacts) contacts_.make_room();
  for (Process& process : processes_) {
    process.capacity = std::min(process.most_events, process.log->numbers - process.log->before);
  }
  end = gather_due(end);
  for (unsigned level = 0; level <= processes_.back().level; ++level) {
    std::vector<Process*> of_level;
    for (Process& process : processes_) {
      if (process.level == level) of_level.push_back(&process);
    }
    for_each(of_level, [&](Process* process) { run(*process, end); });
  }
  return end;
}

// Moves the entries of unions that are due in the window to their own parts. Returns the end of the
// window: at the latest the first of these entries that is for the sequential loop.
template <class Traits, class Contacts>
double Optimistic_window<Traits, Contacts>::gather_due(double end) {
  struct Gathering {
    Process* process;
    double end;
  };
  std::vector<Gathering> all;
  for (Process& process : processes_) {
    if (!process.is_region()) all.push_back({&process, end});
  }
  for_each(all, [&](Gathering& g) {
    for_each_kind([&](auto& events) { g.end = gather_due(events, *g.process, g.end); });
  });
  if constexpr (has_contacts) {
    for (const Gathering& g : all) {
      contacts_.part(*g.process).for_each([&](const auto& entry) {
        contacts_.note_blocked(*g.process, entry);
      });
    }
  }
  return std::ranges::min(all, {}, &Gathering::end).end;
}

// The same for one union: rechecks certificates until it is known which ones fail in the window.
template <class Traits, class Contacts>
template <class Events>
double Optimistic_window<Traits, Contacts>::gather_due(Events& events, Process& process,
                                                       double end) {
  auto& part = events.queue().part(process.number);
  const Time last(end);
  const auto exact = [&]() -> const Time& { return last; };
  while (!part.empty() && part.is_due(part.top(), {end, end}, exact)) {
    const auto entry = part.top();
    if (events.is_recheck(entry)) {
      part.pop();
      events.recheck(process, {&entry, 1});
      continue;
    }
    events.queue().move_first(process.number, process.from);
    if (events.is_for_loop(entry)) return std::min(end, entry.bounds.lower);
  }
  return end;
}

// Executes the due entries of a node in the order of its queues. In a union these are the entries
// that the nodes below have not executed.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::run(Process& process, double end) {
  if (process.is_region()) {
    // Somewhat later than the end, so that the first entry after it is known too.
    const double soon = end + division().window_width / 16;
    for_each_kind([&](auto& events) { events.part(process).expect(soon); });
  } else {
    process.due_until = end;
    take_deferred(process);
  }
  const Time last(end);
  bool goes_on = true;
  while (goes_on) {
    const bool is_edge_due =
        process.is_region() ? settle_edges_of_region(process, last) : settle(edges_, process, last);
    if constexpr (has_contacts) {
      if (settle(contacts_, process, last) && is_contact_first(process, is_edge_due)) {
        goes_on = execute_first(contacts_, process);
        continue;
      }
    }
    goes_on = is_edge_due && execute_first(edges_, process);
  }
  if (!process.is_region()) process.due_until = -std::numeric_limits<double>::infinity();
}

// Takes the entries that the two nodes below a union have deferred.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::take_deferred(const Process& process) {
  for (std::size_t below = 0; below < process.number; ++below) {
    if (division().above(below) != process.number) continue;
    const std::size_t deferred = division().deferred_part(below);
    for_each_kind([&](auto& events) {
      while (!events.queue().part(deferred).empty()) {
        events.queue().move_first(deferred, process.from);
      }
    });
  }
}

// Rechecks certificates, one by one, until the first entry is an event or is not due. Returns
// whether it is due. (Two at once are certified from the time of the first one. In a union the
// second edge may have an event after that.)
template <class Traits, class Contacts>
template <class Events>
bool Optimistic_window<Traits, Contacts>::settle(Events& events, Process& process,
                                                 const Time& last) {
  auto& part = events.part(process);
  const auto exact = [&]() -> const Time& { return last; };
  while (!part.empty() && part.is_due(part.top(), last.interval(), exact)) {
    if (!events.is_recheck(part.top())) return true;
    const auto entry = part.pop();
    events.recheck(process, {&entry, 1});
  }
  return false;
}

// The same, two at a time, which is cheaper.
template <class Traits, class Contacts>
bool Optimistic_window<Traits, Contacts>::settle_edges_of_region(Process& process,
                                                                 const Time& last) {
  using Entry = typename Edges::Entry;
  const auto exact = [&]() -> const Time& { return last; };
  return process.edges->settle(
      [&](const Entry& entry) { return process.edges->is_due(entry, last.interval(), exact); },
      [&](std::span<const Entry> entries) { edges_.recheck(process, entries); });
}

// Whether the first contact of a process is before the first entry of its edges, or the latter is
// not due.
template <class Traits, class Contacts>
bool Optimistic_window<Traits, Contacts>::is_contact_first(const Process& process,
                                                           bool is_edge_due) {
  if (!is_edge_due) return true;
  auto& contacts = contacts_.part(process);
  const auto& edge = process.edges->top();
  const auto& contact = contacts.top();
  if (contact.bounds.upper < edge.bounds.lower) return true;
  if (contact.bounds.lower > edge.bounds.upper) return false;
  return contacts.time(contact) < process.edges->time(edge);
}

// Executes the first entry of a process or defers it to the node above; the root truncates the
// window instead, and returns false. After a rollback another entry may be first: a rolled back
// event is later, but its entry may be a recheck that is earlier.
template <class Traits, class Contacts>
template <class Events>
bool Optimistic_window<Traits, Contacts>::execute_first(Events& events, Process& process) {
  auto& part = events.part(process);
  const auto entry = part.top();
  if (!events.is_for_loop(entry) && process.has_room()) {
    auto candidate = events.candidate(process, entry);
    bool may_execute = events.may_execute(process, candidate);
    if constexpr (has_contacts && !is_of_contacts<Events>) {
      may_execute = may_execute && (process.is_root || !contacts_.blocks(process, candidate));
    }
    if (may_execute) {
      if (!process.is_region()) {
        roll_back_later(events, process, candidate);
        if (events.handle(part.top()) != events.handle(entry)) return true;
      }
      if constexpr (is_of_contacts<Events>) {
        if (contacts_.execute(process, candidate)) return true;
      } else {
        if (flip(process, candidate)) return true;
      }
    }
  }
  if (process.is_root) {
    truncated_ = part.time_of(entry);
    return false;
  }
  if constexpr (is_of_contacts<Events>) events.note_blocked(process, entry);
  events.queue().move_first(process.from, division().deferred_part(process.number));
  return true;
}

// Flips an edge if the sequential loop would flip it and do nothing else. Returns whether it did.
template <class Traits, class Contacts>
bool Optimistic_window<Traits, Contacts>::flip(Process& process,
                                               typename Edges::Candidate& candidate) {
  for (const Face_handle face : {candidate.edge.here.first, candidate.edge.there.first}) {
    KINETRI_ASSERT(process.is_region() || !log_.is_later(face->version(), candidate.moment),
                   "a flip at a face whose edge has an entry before it");
  }
  if constexpr (has_contacts) {
    if (contacts_.keeps(candidate.edge, candidate.moment)) return false;
  }
  if (!edges_.is_flip(candidate)) return false;
  Record& record = edges_.execute(process, candidate);
  if constexpr (has_contacts) contacts_.follow_flip(process, record, candidate.moment);
  edges_.keep_time(record, candidate);
  return true;
}

// ---- rollback ----

// Rolls back later events in the surroundings of an event. The surroundings may change by that, so
// they are searched again.
template <class Traits, class Contacts>
template <class Events, class Candidate>
void Optimistic_window<Traits, Contacts>::roll_back_later(Events& events, Process& process,
                                                          Candidate& candidate) {
  const auto find_later = [&] {
    Version later = 0;
    events.for_each_surrounding_face(candidate, [&](Face_handle face) {
      if (later == 0 && log_.is_later(face->version(), candidate.moment)) later = face->version();
    });
    return later;
  };
  for (Version later = find_later(); later != 0; later = find_later()) roll_back(process, later);
}

// Rolls an event back, after the events that were executed later and conflict with it.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::roll_back(Process& process, Version number) {
  // The last event at a face or beside it.
  const auto last_at = [&](Face_handle face) {
    Version last = 0;
    for (const Face_handle f : {face, face->neighbor(0), face->neighbor(1), face->neighbor(2)}) {
      if (log_.is_of_window(f->version())) last = std::max(last, f->version());
    }
    return last;
  };
  std::vector<Version> waiting = {number};  // each waits for the one after it
  while (!waiting.empty()) {
    Version last = 0;
    log_.for_each_written_face(log_.record(waiting.back()),
                               [&](Face_handle face) { last = std::max(last, last_at(face)); });
    if (last > waiting.back()) {
      waiting.push_back(last);
    } else {
      roll_back_last(process, waiting.back());
      waiting.pop_back();
    }
  }
}

// Rolls back an event without a later one that conflicts with it.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::roll_back_last(Process& process, Version number) {
  const Key& key = log_.key(number);
  Record& record = log_.record(key);
  ++process.rolled_back;
  log_.node_of(number).has_rolled_back = true;
  log_.for_each_written_face(record, [&](Face_handle face) {
    KINETRI_ASSERT(face->version() == number, "the last event of its faces");
  });
  if constexpr (has_contacts) {
    const Time& now = log_.time(key);  // computed from the motions of that time
    if (record.change) return contacts_.roll_back(process, record, now);
    contacts_.unfollow_flip(process, record, now);
  }
  edges_.roll_back(process, record);
}

// ---- the order of time ----

// Sorts the events of the window by time, truncates it at the first tie or where the root has, and
// moves the due entries that are left back.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::put_in_order() {
  log_.put_in_order(options_.flips_per_slice,
                    [this](auto& slices, const auto& work) { this->for_each(slices, work); });
  const std::vector<Key>& order = log_.order();
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (order[k - 1].bounds.upper < order[k].bounds.lower) continue;
    if (log_.compare(order[k - 1], order[k]) != 0) continue;
    const Time& tie = log_.time(order[k]);
    if (!truncated_ || tie < *truncated_) truncated_ = tie;
    break;
  }
  if (truncated_) truncate();
  for (const Process& process : processes_) {
    if (process.is_region()) continue;
    for_each_kind([&](auto& events) { events.queue().move_home(process.from); });
  }
}

// Rolls back the events at and after the time at which the window is truncated.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::truncate() {
  ++counters_.truncated_windows;
  Process& root = processes_.back();
  const std::uint64_t rolled_back = root.rolled_back;
  Moment from = {{}, truncated_->interval(), *truncated_};
  const auto first = std::ranges::partition_point(
      log_.order(), [&](const Key& key) { return log_.compare(key, from) < 0; });
  log_.order().erase(first, log_.order().end());
  const auto roll_back_in = [&](Process& process) {
    for (std::size_t k = process.log->records.size(); k-- > 0;) {
      if (!process.log->records[k].is_rolled_back &&
          log_.compare(process.log->keys[k], from) >= 0) {
        roll_back(root, log_.version(*process.log, k));
      }
    }
  };
  std::for_each(processes_.rbegin(), processes_.rend(), roll_back_in);
  counters_.truncated += std::exchange(root.rolled_back, rolled_back) - rolled_back;
}

template <class Traits, class Contacts>
Window_work Optimistic_window<Traits, Contacts>::work_of_processes() const {
  Window_work work;
  work.reported = static_cast<double>(log_.order().size());
  for (unsigned level = 0; level <= processes_.back().level; ++level) {
    double most = 0;
    double sum = 0;
    for (const Process& process : processes_) {
      if (process.level != level) continue;
      const auto executed = static_cast<double>(process.log->records.size());
      most = std::max(most, executed);
      sum += executed;
      work.rolled_back += static_cast<double>(process.rolled_back);
    }
    work.executed += sum;
    work.in_turn += std::max(most, sum / static_cast<double>(threads_));
  }
  return work;
}

// ---- the end of a window ----

// Reports and counts the events of the window. Rethrows an observer's exception afterwards.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::close() {
  std::exception_ptr thrown;
  try {
    reporter_.report();
  } catch (...) {
    thrown = std::current_exception();
  }
  reported_ = log_.order().size();
  division().events += static_cast<double>(reported_);
  try {
    count_and_clear();
  } catch (...) {
    start_anew();
    throw;
  }
  if (thrown) std::rethrow_exception(thrown);
}

// Adds up the counts of the processes, and clears their logs.
template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::count_and_clear() {
  if constexpr (has_contacts) contacts_.end_window();
  for (Process& process : processes_) {
    (process.is_root       ? counters_.by_root
     : process.is_region() ? counters_.by_region
                           : counters_.by_union) += process.log->records.size();
    counters_.rolled_back += std::exchange(process.rolled_back, 0);
    count_certificates(process);
  }
  for_each(processes_, [this](Process& process) { log_.clear(*process.log); });
}

template <class Traits, class Contacts>
void Optimistic_window<Traits, Contacts>::count_certificates(Process& process) {
  Triangulation_counters& counters = core_.counters;
  schedule_.certificate_counters() += std::exchange(process.certificates, {});
  counters.rechecks += process.counters.rechecks;
  for (std::size_t k = 0; k < event_kinds; ++k) {
    counters.discarded[k] += process.counters.discarded[k];
  }
  process.counters = {};
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_IMPL_H
