// SPDX-License-Identifier: GPL-3.0-or-later
//
// The events of edges in a time window: which ones a node may execute, flips, and their rollback.
// docs/PARALLEL.md has the contract.
#ifndef KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_H
#define KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_H

#include <span>
#include <utility>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "triangulation/logical_process.h"

namespace kinetri::detail {

/// The entries of edges and hidden points. Several threads may call functions that take a process,
/// for different nodes of one level.
///
/// Owns nothing: the queue is that of the triangulation, the records are in the log, counts in the
/// process. Invariant: both faces of an edge have the handle of its entry; after `execute` and
/// `roll_back` the five edges of a flip have entries, if they may fail.
template <class Traits, bool has_contacts>
class Edge_events {
 public:
  using Types = Topology<Traits>;
  using Time = typename Types::Time;
  using Edge = typename Types::Edge;
  using Face_handle = typename Types::Face_handle;
  using Edge_with_mirror = typename Types::Edge_with_mirror;
  using Entry = typename Schedule<Traits>::Entry;
  using Queue = typename Schedule<Traits>::Queue;
  using Part = typename Queue::Part;
  using Log = Window_log<Traits, has_contacts>;
  using Moment = typename Log::Moment;
  using Record = typename Log::Record;
  using Process = Logical_process<Traits, has_contacts>;

  /// An entry that a process may execute.
  struct Candidate {
    Entry entry;
    Edge_with_mirror edge;
    Moment moment;
  };

  /// The others must outlive this object.
  Edge_events(Kinetic_core<Traits>& core, Log& log)
      : topology_(core.topology),
        certification_(core.certification),
        schedule_(core.schedule),
        log_(log) {}

  // ---- entries ----

  Queue& queue() { return schedule_.queue(); }
  Part& part(const Process& process) const { return *process.edges; }
  Queue_handle handle(const Entry& entry) const {
    return schedule_.policy().handle(entry.subject());
  }
  static bool is_recheck(const Entry& entry) { return entry.kind == Entry_kind::recheck; }
  /// Whether only the sequential loop executes such entries.
  static bool is_for_loop(const Entry& entry) {
    return entry.kind == Entry_kind::coincidence || entry.is_hidden();
  }
  /// Certifies again the edges of entries that have left their part, from the time of the first one
  /// on.
  void recheck(Process& process, std::span<const Entry> entries);
  /// Certifies edges that have no entries from `after` on, and schedules them. `state` is that of
  /// their certificates.
  void certify(Process& process, std::span<const Edge_with_mirror> edges, const Time& after,
               Certificate_state state = Certificate_state::any);
  /// Schedules an edge that has no entry yet.
  KINETRI_ALWAYS_INLINE void put(const Process& process, const Edge_with_mirror& edge,
                                 Entry_kind kind, Certificate&& known);
  /// Removes and counts the entry of an edge, if it has one.
  void discard(Process& process, Queue_handle handle);
  /// Whether an edge of a face has an entry in a window's part other than that of the process, not
  /// later than the time exact(), which is within `bounds`.
  template <class Exact>
  bool waits_before(Face_handle face, const Process& process, const Double_interval& bounds,
                    const Exact& exact);

  // ---- a flip ----

  /// Precondition: !is_for_loop(entry).
  Candidate candidate(Process& process, const Entry& entry) const;
  /// Whether the contract allows the process to execute the candidate, its first entry.
  bool may_execute(const Process& process, const Candidate& candidate);
  /// Calls `function` with the four faces beside the two of the edge.
  template <class Function>
  void for_each_surrounding_face(const Candidate& candidate, const Function& function) const;
  /// Whether the sequential loop would flip the edge and do nothing else.
  bool is_flip(Candidate& candidate) const;
  /// Flips the edge of the first entry of the process, as Updates::flip does, and returns the
  /// record for a rollback. keep_time adds the exact time.
  Record& execute(Process& process, Candidate& candidate);
  /// Stores the exact time of an executed flip, if it has been computed.
  void keep_time(Record& record, Candidate& candidate) const;
  /// Rolls a flip back and computes the entries of its edges again. Precondition: it is the last
  /// event of its faces.
  void roll_back(Process& process, Record& record);
  /// Schedules edges whose quadrilaterals a rollback has restored.
  void certify_again(Process& process, std::span<const Edge_with_mirror> edges);

  /// Whether a point and all its neighbors are in the node of a process. Then the point is not on
  /// the hull.
  bool owns_star(const Process& process, Point_id id) const;
  /// Whether points are hidden in a face.
  static bool hides_points(Face_handle face) {
    if constexpr (Types::is_weighted) return !face->vertex_list().empty();
    return false;
  }

 private:
  using Triangulation = typename Types::Triangulation;
  using Point_2 = typename Types::Point_2;

  // Schedules the certificates that Certification::certify makes.
  struct Put_certificate {
    Edge_events& events;
    const Process& process;

    KINETRI_ALWAYS_INLINE void operator()(const Edge_with_mirror& edge, Entry_kind kind,
                                          Certificate&& known) const {
      events.put(process, edge, kind, std::move(known));
    }
  };

  bool is_blocked(const Process& process, const Candidate& candidate);
  bool is_convex(const Candidate& candidate) const;
  const Time& birth(const Edge_with_mirror& edge);
  bool is_added_by_birth(const Edge_with_mirror& edge);

  Topology<Traits>& topology_;
  const Certification<Traits>& certification_;
  Schedule<Traits>& schedule_;
  Log& log_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_EDGE_EVENTS_H
