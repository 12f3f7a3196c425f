// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts in time windows (docs/PARALLEL.md): which of them a process executes, and how they are
// rolled back.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_EVENTS_H
#define KINETRI_SRC_SIMULATION_CONTACT_EVENTS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/simulation_core.h"
#include "simulation/watched_contacts.h"
#include "triangulation/edge_events.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

/// The entries of contacts and scheduled changes of a simulation, in time windows. Functions with a
/// parameter `process` may be called by several threads, for different nodes of one level.
///
/// Owns the counts of each process, and which points have deferred contacts. Invariant, in a
/// window: each watched contact that may happen has one entry, in any part, whose handle is in the
/// records of its points; between two windows nothing is deferred.
template <class Traits>
class Contact_events {
 public:
  static constexpr bool exist = true;
  using Watch = Watched_contacts<Traits>;
  using Core = typename Watch::Core;    ///< of the simulation
  using Entry = typename Watch::Entry;  ///< of the queue of contacts and changes
  using Queue = typename Watch::Queue;  ///< that queue
  using Part = typename Watch::Part;    ///< of the queue
  using Time = typename Watch::Time;    ///< of contacts
  using Edges = Edge_events<Traits, true>;
  using Log = Window_log<Traits, true>;
  using Moment = typename Log::Moment;
  using Record = typename Log::Record;
  using Process = Logical_process<Traits, true>;
  using Edge_with_mirror = typename Edges::Edge_with_mirror;
  using Face_handle = typename Edges::Face_handle;
  using Points = typename Watch::Points;  ///< some points

  /// A contact that a process may execute.
  struct Candidate {
    Entry entry = {};
    Moment moment = {};
    std::unique_ptr<typename Log::Velocity_change> change = {};

    Points points() const {
      return Points(change->points).first(change->points[1] == no_point ? 1 : 2);
    }
  };

  /// The others must outlive this object.
  Contact_events(Core& core, Edges& edges, Log& log)
      : core_(core),
        topology_(core.kinetic().topology),
        certification_(core.kinetic().certification),
        records_(core.records),
        schedule_(core.schedule),
        watch_(core),
        edges_(edges),
        log_(log) {}
  static Kinetic_core<Traits>& kinetic(Core& core) { return core.kinetic(); }

  /// Whether contacts can be executed in windows.
  bool can_run() const { return Watch::can_run(core_); }
  /// Whether discs have contacts.
  bool has_pairs() const { return watch_.has_pairs(); }

  // ---- the sequential loop ----

  /// Whether the first entry of the queue is due at or before a time.
  bool settle(const Time& until) {
    schedule_.settle();
    return !queue().empty() &&
           queue().is_due(queue().top(), until.interval(), [&]() -> const Time& { return until; });
  }
  /// Executes the events of the next time, of the triangulation too. Returns their number.
  std::size_t run_instant(const Time& until) { return core_.loop.step(&until); }
  /// Executes all events up to a time.
  void run_to(const Time& until, const std::function<bool()>& may_go_on) {
    core_.loop.run_to(until, may_go_on);
  }

  // ---- entries ----

  Queue& queue() { return schedule_.queue(); }  ///< of all entries
  Part& part(const Process& process) { return *of(process).part; }
  Queue_handle handle(const Entry& entry) const {
    return schedule_.policy().handle(entry.subject());
  }
  /// Whether the certificate of a contact is to be checked again.
  static bool is_recheck(const Entry& entry) { return is_contact(entry.kind) && !entry.is_event; }
  /// Whether only the sequential loop may execute the entry.
  static bool is_for_loop(const Entry& entry) { return !is_contact(entry.kind); }
  /// Distributes the entries, as Divided_scheduler::distribute says.
  template <class In_parallel>
  void divide(std::size_t count, const In_parallel& in_parallel) {
    watch_.divide(count, in_parallel);
  }
  /// Adopts the processes of the division.
  void take_up(std::span<const Process> processes);
  /// Checks the certificates of removed entries again.
  void recheck(Process& process, std::span<const Entry> entries);
  /// Records that an entry is deferred. This saves rollbacks, and does not change results.
  void note_blocked(Process& process, const Entry& entry);

  // ---- a contact ----

  /// Precondition: !is_for_loop(entry); the entry is the first one of the process.
  Candidate candidate(Process& process, const Entry& entry);
  /// Whether the process may execute the contact, its first entry.
  bool may_execute(Process& process, Candidate& candidate);
  /// Calls `function` with the faces at the points and the adjacent ones.
  template <class Function>
  void for_each_surrounding_face(const Candidate& candidate, const Function& function) const;
  /// Executes a contact. Returns false, and changes nothing, if a node above or the sequential loop
  /// has to execute it.
  bool execute(Process& process, Candidate& candidate);
  /// Rolls a contact back, at the time `now`, and computes its entries again. Precondition: it is
  /// the last event of its faces.
  void roll_back(Process& process, Record& record, const Time& now);

  // ---- flips ----

  /// Whether a deferred contact of the edge's pair or of one of the four points is before a flip.
  bool blocks(const Process& process, const typename Edges::Candidate& flip);
  /// Whether the ends of the edge are discs that have touched in this window and still meet, so
  /// that the edge must not be flipped.
  bool keeps(const Edge_with_mirror& edge, Moment& moment);
  /// Schedules the contact of the edge that a flip has added, instead of that of the removed one.
  void follow_flip(Process& process, const Record& flip, Moment& moment);
  /// The reverse, for a flip that is rolled back at the time `now`.
  void unfollow_flip(Process& process, const Record& flip, const Time& now);

  // ---- windows ----

  /// Prepares a window, before whose beginning no event happens. Returns whether it may begin.
  bool begin_window(double begin) { return watch_.begin_window(begin); }
  /// Resizes the data by point.
  void make_room();
  /// The event of a contact, without number and time.
  Event event(const typename Log::Key& key);
  /// Counts contacts, each without another event at its time.
  void count(std::uint64_t contacts);
  /// Called after each window: records overlaps for the sequential loop.
  void end_window();
  /// Finds overlaps and schedules contacts again, between two events. Keeps scheduled changes.
  void start_anew();

 private:
  using Types = Topology<Traits>;
  using Triangulation = typename Types::Triangulation;
  using Vertex_handle = typename Types::Vertex_handle;
  using Point_2 = typename Types::Point_2;
  using Velocity_change = typename Log::Velocity_change;
  using Change = typename Types::Change;
  using Pair = typename Watch::Pair;

  // Of one process. Vectors are members to reuse their memory.
  struct alignas(64) State {
    Part* part = nullptr;  // whose entries it executes
    Certificate_counters certificates = {};
    std::uint64_t discarded_walls = 0;
    std::uint64_t discarded_collisions = 0;
    std::vector<Point_id> blocked = {};  // points of deferred contacts
    std::vector<Edge_with_mirror> edges = {};
    std::vector<std::tuple<Edge_with_mirror, Entry_kind, Certificate>> edge_certificates = {};
    std::vector<std::pair<Entry, Certificate>> contact_certificates = {};
    std::vector<Queue_handle> handles = {};

    void count_discarded(const Entry& entry) {
      if (!entry.is_event) return;
      ++(entry.kind == Contact_kind::wall ? discarded_walls : discarded_collisions);
    }
  };

  State& of(const Process& process) { return states_[process.number]; }

  void put(const Process& process, Entry entry, Certificate&& known);
  Entry take(Queue_handle handle);
  template <class Function>
  void take_all(Process& process, Points points, const Function& function);

  bool has_each_face_once(Point_id id) const;
  bool is_blocked(Process& process, const Candidate& candidate);
  bool is_point_blocked(Point_id id, const Double_interval& bounds) const {
    return id < blocked_from_.size() && blocked_from_[id] <= bounds.upper;
  }
  template <class Exact>
  bool waits_before(Queue_handle handle, const Process& process, const Double_interval& bounds,
                    const Exact& exact);

  bool set_points(Velocity_change& change, std::span<const Change> changes, Moment& moment);
  bool certify(Process& process, const Entry& contact, Points changed, const Moment& moment);
  void record(Process& process, Candidate&& candidate);
  template <class Function>
  void for_each_face_around(Points points, const Function& function) const;
  std::span<const Edge_with_mirror> edges_around(State& state, Points points) const;

  static bool is_finite(const Pair& edge) { return detail::ids_of(edge)[1] != no_point; }

  static constexpr double never = std::numeric_limits<double>::infinity();

  Core& core_;
  Topology<Traits>& topology_;
  const Certification<Traits>& certification_;
  typename Simulation_types<Traits>::Contact_records& records_;
  Contact_schedule<Traits>& schedule_;
  Watch watch_;
  Edges& edges_;
  Log& log_;
  std::vector<State> states_;  // of the processes, by their numbers
  // By point: a time before which no contact of it is deferred.
  std::vector<double> blocked_from_;
};

/// The optimistic parallel execution of a simulation.
template <class Traits>
auto region_run_of(Simulation_2<Traits>& simulation, const Region_options& options = {}) {
  return Region_run<Traits, Contact_events<Traits>>(*Core_access::core(simulation), options);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_EVENTS_H
