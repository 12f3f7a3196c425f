// SPDX-License-Identifier: GPL-3.0-or-later
//
// A time window, executed by optimistic parallel discrete-event simulation. docs/PARALLEL.md has
// the method, the terms, the contract and the invariants; docs/MATH.md, section 17, proves that the
// result is that of the sequential loop.
#ifndef KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_H
#define KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "triangulation/edge_events.h"
#include "triangulation/region_effort.h"
#include "triangulation/region_options.h"
#include "triangulation/window_reporter.h"

namespace kinetri::detail {

/// Points without contacts. The other model is Contact_events of simulation/contact_events.h, which
/// has the functions that Optimistic_window and Region_run call if contacts exist.
template <class Traits>
struct No_contacts {
  static constexpr bool exist = false;
  using Core = Kinetic_core<Traits>;

  No_contacts(Core& /*core*/, Edge_events<Traits, false>& /*edges*/,
              Window_log<Traits, false>& /*log*/) {}
  static Core& kinetic(Core& core) { return core; }
};

/// The logical processes of the tree of regions, and the windows that they execute. Edge_events and
/// Contact_events have the same functions: the same code executes, defers and rolls back flips and
/// contacts.
///
/// Owns the processes, their log, and the time at which the window was truncated. Invariant:
/// between two windows the log is empty, the parts that serve windows alone are empty, and the
/// triangulation, the queues and the present time are those of the sequential loop after the same
/// events.
template <class Traits, class Contacts>
class Optimistic_window {
 public:
  static constexpr bool has_contacts = Contacts::exist;
  using Types = Topology<Traits>;
  using Time = typename Types::Time;
  using Edges = Edge_events<Traits, has_contacts>;
  using Log = Window_log<Traits, has_contacts>;
  using Process = Logical_process<Traits, has_contacts>;

  /// The core and the options must outlive this object.
  Optimistic_window(typename Contacts::Core& core, const Region_options& options);
  Optimistic_window(const Optimistic_window&) = delete;
  Optimistic_window& operator=(const Optimistic_window&) = delete;

  Contacts& contacts() { return contacts_; }
  const Contacts& contacts() const { return contacts_; }
  Edges& edges() { return edges_; }
  std::vector<Process>& processes() { return processes_; }
  const Region_counters& counters() const { return counters_; }

  /// Makes the processes of the division. `events` is the expected number of events of a window.
  void take_up_division(double events);
  /// Whether the versions of a node may not suffice for a window.
  bool are_versions_spent() const;
  void start_versions() { log_.start_numbers(); }

  /// Executes and reports the events up to `end`, or before a tie or an event for the sequential
  /// loop. Returns whether it reached `end`. If an observer throws, all events have been executed
  /// and counted. If memory runs out, the state is that before the window, or after its events if
  /// they have been reported. Precondition: !are_versions_spent().
  bool run(double end);
  /// The time at which the last window was truncated, if it was.
  const std::optional<Time>& truncated() const { return truncated_; }
  /// The number of events that the last window reported, and its work without Window_work::serial.
  std::size_t reported() const { return reported_; }
  const Window_work& work() const { return work_; }

  /// Calls work(), which executes a window or partitions queues. If it throws (memory ran out),
  /// restores the state before the window.
  template <class Work>
  void or_roll_back(const Work& work);
  /// Adds the counts of a process to those of the triangulation.
  void count_certificates(Process& process);
  /// Must be called before several threads change parts of the queues.
  void forget_first() {
    for_each_kind([](auto& events) { events.queue().forget_first(); });
  }
  /// Calls `function` with the events of edges and, if contacts exist, with those of contacts.
  template <class Function>
  void for_each_kind(const Function& function) {
    function(edges_);
    if constexpr (has_contacts) function(contacts_);
  }

 private:
  using Face_handle = typename Types::Face_handle;
  using Version = typename Log::Version;
  using Moment = typename Log::Moment;
  using Record = typename Log::Record;
  using Key = typename Log::Key;

  template <class Events>
  static constexpr bool is_of_contacts = std::is_same_v<Events, Contacts>;

  Region_division& division() { return schedule_.division(); }
  template <class Vector, class Work>
  void for_each(Vector& elements, const Work& work) const {
    call_for_each(options_, elements, work);
  }

  double execute(double end);
  double gather_due(double end);
  template <class Events>
  double gather_due(Events& events, Process& process, double end);
  void run(Process& process, double end);
  void take_deferred(const Process& process);
  template <class Events>
  bool settle(Events& events, Process& process, const Time& last);
  bool settle_edges_of_region(Process& process, const Time& last);
  bool is_contact_first(const Process& process, bool is_edge_due);
  template <class Events>
  bool execute_first(Events& events, Process& process);
  bool flip(Process& process, typename Edges::Candidate& candidate);
  template <class Events, class Candidate>
  void roll_back_later(Events& events, Process& process, Candidate& candidate);
  void roll_back(Process& process, Version number);
  void roll_back_last(Process& process, Version number);
  void start_anew();

  void put_in_order();
  void truncate();
  Window_work work_of_processes() const;
  void close();
  void count_and_clear();

  Kinetic_core<Traits>& core_;
  Schedule<Traits>& schedule_;
  const Region_options& options_;
  const std::size_t threads_;
  Log log_;
  Edges edges_;
  [[no_unique_address]] Contacts contacts_;
  Window_reporter<Traits, Contacts> reporter_;
  std::vector<Process> processes_;  // of the nodes, by their numbers
  std::optional<Time> truncated_;
  std::size_t reported_ = 0;
  Window_work work_ = {};
  Region_counters counters_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_OPTIMISTIC_WINDOW_H
