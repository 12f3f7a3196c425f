// SPDX-License-Identifier: GPL-3.0-or-later
//
// The schedule of a kinetic triangulation: the present time and the event queue.
#ifndef KINETRI_IMPL_TRIANGULATION_SCHEDULE_H
#define KINETRI_IMPL_TRIANGULATION_SCHEDULE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/events/divided_scheduler.h"
#include "kinetri/impl/events/event_scheduler.h"
#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri::detail {

/// The kind of event that a failure of this kind leads to.
inline Event_kind event_kind_of(Entry_kind failure) {
  switch (failure) {
    case Entry_kind::flip:
      return Event_kind::flip;
    case Entry_kind::hull_insert:
      return Event_kind::hull_insert;
    case Entry_kind::hull_remove:
      return Event_kind::hull_remove;
    case Entry_kind::hidden:
      return Event_kind::reveal;
    default:
      return Event_kind::rebuild;
  }
}

/// The tree of subdomains (regions) of docs/PARALLEL.md; defined in
/// src/triangulation/region_division.h.
struct Region_division;
std::shared_ptr<Region_division> make_division();
std::size_t number_of_regions(const Region_division& division);
/// The lowest node that contains two vertices: the root if one of them is in no region.
std::size_t node_of(const Region_division& division, Point_id a, Point_id b);

/// The subject of an entry: an edge or, if `hidden` is not null, a hidden point.
template <class Traits>
struct Kinetic_types<Traits>::Subject {
  struct Nothing {};
  using Hidden_vertex = std::conditional_t<is_weighted, Vertex_handle, Nothing>;

  Edge edge;
  [[no_unique_address]] Hidden_vertex hidden = {};

  bool is_hidden() const {
    if constexpr (is_weighted) return hidden != Vertex_handle();
    return false;
  }
};

/// The failure of the certificate of an edge or hidden point, or a time to recheck it. The exact
/// time is computed from the corners of the two faces at the edge, or of the face that hides the
/// point: these must not change while the entry exists.
template <class Traits>
struct Kinetic_types<Traits>::Entry : Scheduled {
  std::uint8_t index = 0;  ///< of the vertex of the face opposite the edge; or of a condition
  Entry_kind kind = Entry_kind::recheck;
  bool changes_sign = false;  ///< whether the polynomial certainly changes sign at the failure
  Face_handle face;
  [[no_unique_address]] typename Subject::Hidden_vertex hidden = {};

  /// An entry without its subject and its times.
  struct Kept {
    std::uint8_t kind : 3 = 0;      ///< the `Entry_kind`
    std::uint8_t index : 2 = 0;     ///< the condition on a hidden point
    bool changes_sign : 1 = false;  ///< as in the entry
  };

  Entry() = default;
  /// The failure of an edge's certificate, which is of the given kind, or the time to check it
  /// again; without the exact time. Precondition: the certificate may fail.
  Entry(const Edge& edge, Entry_kind failure, const Certificate& certificate)
      : Scheduled{certificate.bounds},
        index(static_cast<std::uint8_t>(edge.second)),
        kind(certificate.kind == Certificate::Kind::holds ? Entry_kind::recheck : failure),
        changes_sign(certificate.failure == nullptr),
        face(edge.first) {}

  /// The entry of a subject, without the exact time.
  Entry(const Subject& subject, const Double_interval& times, const Kept& kept)
      : Scheduled{times},
        index(subject.is_hidden() ? kept.index : static_cast<std::uint8_t>(subject.edge.second)),
        kind(static_cast<Entry_kind>(kept.kind)),
        changes_sign(kept.changes_sign),
        face(subject.edge.first),
        hidden(subject.hidden) {}

  Kept kept() const {
    return {static_cast<std::uint8_t>(static_cast<unsigned>(kind) & 7U),
            static_cast<std::uint8_t>(index & 3U), changes_sign};
  }
  Edge edge() const { return Edge(face, index); }
  Subject subject() const { return {edge(), hidden}; }
  bool is_hidden() const { return subject().is_hidden(); }
};

/// The present time, and the entries of edges and hidden points.
///
/// Invariant, except while edges are changed, or certificates are deferred: each edge and each
/// hidden point whose certificate may fail has one entry: its failure, or a time up to which the
/// certificate certainly holds. The two faces at the edge, or the hidden vertex, store the handle
/// of the entry.
template <class Traits>
class Kinetic_types<Traits>::Schedule {
 public:
  using Certificate_points = typename Kinetic_types::Certificate_points;
  using Entry = typename Kinetic_types::Entry;
  using Subject = typename Kinetic_types::Subject;

  /// The policy of Event_scheduler and Divided_scheduler.
  class Policy {
   public:
    explicit Policy(const Schedule& schedule) : schedule_(schedule) {}

    Time entry_time(const Entry& entry) const;
    bool precedes(const Entry& a, const Entry& b) const;
    bool is_recheck(const Entry& entry) const { return entry.kind == Entry_kind::recheck; }
    KINETRI_ALWAYS_INLINE static void prefetch(const Entry& entry) { detail::prefetch(entry.face); }
    KINETRI_ALWAYS_INLINE static void prefetch_more(const Entry& entry) {
      prefetch_around(entry.face);
    }
    void prefetch_first(const Entry& entry) const;
    std::size_t part_of(const Subject& subject) const;
    Queue_handle handle(const Subject& subject) const;
    void set_handle(const Subject& subject, Queue_handle handle) const;

   private:
    const Schedule& schedule_;
  };
  using Queue = std::conditional_t<has_region_runs<Traits>, Divided_scheduler<Entry, Policy>,
                                   Event_scheduler<Entry, Policy>>;

  /// The certification and the counters must outlive this object.
  Schedule(const Certification& certification, const Time& start, Triangulation_counters& counters)
      : certification_(certification),
        topology_(certification.topology()),
        counters_(counters),
        current_time_(start) {}
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  // ---- the present time ----

  /// The present time, computed if it has not been.
  const Time& current_time() const;
  /// Bounds of the present time. O(1).
  Double_interval current_bounds() const {
    return pending_time_ ? pending_time_->second : current_time().interval();
  }
  void set_current_time(Time time) {
    pending_time_.reset();
    current_time_ = std::move(time);
  }
  /// Makes the time of a failure the present one. It is computed when needed: usually its bounds
  /// are enough until the next event.
  void set_current_time(const Entry& entry) {
    if (entry.time != Time_pool::none) return set_current_time(queue_.time_of(entry));
    set_current_time(points(entry), entry.bounds);
  }
  /// The same for a certificate that fails then.
  void set_current_time(const Certificate_points& failed, const Double_interval& bounds) {
    pending_time_.emplace(failed, bounds);
  }

  /// Calls a function, in which an offset that is too great is an error at the present time.
  template <class Function>
  decltype(auto) with_time_of_errors(const Function& function) const {
    if constexpr (is_periodic) {
      try {
        return function();
      } catch (const Offset_overflow& error) {
        const auto [first, second] = edge_ids(error.of(), error.against());
        throw Periodic_offset_error(first, second, current_time().detached(), error.what());
      }
    } else {
      return function();
    }
  }

  // ---- the queue ----

  Queue& queue() { return queue_; }
  const Queue& queue() const { return queue_; }
  const Policy& policy() const { return policy_; }
  /// The regions of the vertices, while the queue is in parts.
  Region_division& division() { return *division_; }
  const Region_division& division() const { return *division_; }
  Certificate_counters& certificate_counters() { return certificate_counters_; }
  const Certificate_counters& certificate_counters() const { return certificate_counters_; }

  /// Ends time: failures at or after `end`, if given, are not due.
  void set_end(std::optional<Time> end) { end_ = std::move(end); }
  /// The end of time; none if there is no end.
  const std::optional<Time>& end() const { return end_; }

  /// Rechecks certificates until the first entry is a failure or later than `until` (if not null).
  /// Returns whether it is a failure at or before `until`, and before the end.
  bool settle(const Time* until);
  /// Calls `settle` with the present time.
  bool settle_now();
  /// Whether the first failure is before `latest`, and before the end. Rechecks certificates, but
  /// stores nothing.
  bool has_failure_before(const Time& latest) const;
  /// The points of the certificate of an entry. Precondition: dimension 2.
  Certificate_points points(const Entry& entry) const;

  /// Schedules the certificates of edges from `after` on. Precondition: the edges have no entries.
  void schedule(std::span<const Edge_with_mirror> edges, const Time& after,
                Certificate_state state = Certificate_state::any);
  /// The same for an edge that has just been flipped, and the outer edges of its quadrilateral, as
  /// Topology::flip returns them.
  void schedule_after_flip(const Edge_with_mirror& edge, const Outer_edges& outer);
  /// Schedules all edges, on all threads of oneTBB, and all hidden points. Precondition: the queue
  /// is empty.
  void schedule_all();
  /// Empties the queue; all certificates are computed when the first of them is needed.
  /// Precondition: the triangulation is Delaunay just after the present time.
  void defer() {
    queue_.clear();
    is_deferred_ = true;
  }
  bool is_deferred() const { return is_deferred_; }
  /// Computes the certificates that have been deferred, if they have. settle() and settle_now() do
  /// so.
  void schedule_deferred() {
    if (is_deferred_) schedule_all();
  }
  /// In a periodic box, notes that an edge has no entry any more, since two outer edges of a
  /// quadrilateral may be one edge, whose entry is removed and made once. In the plane the faces
  /// keep the handle.
  KINETRI_ALWAYS_INLINE static void forget_entry(const Edge_with_mirror& edge) {
    if constexpr (is_periodic) Topology::set_event(edge, no_event);
  }
  /// Removes the entry of an edge from the queue, if it has one, and forgets it.
  KINETRI_ALWAYS_INLINE void unschedule(const Edge_with_mirror& edge) {
    unschedule(edge, counters_);
  }
  /// The same for each edge of a face, whose handles are reset.
  void unschedule_face(Face_handle face);
  /// The same for the edges of the faces at a vertex: all certificates that depend on it.
  void unschedule_around(Vertex_handle v);
  /// The same; adds to `edges` those that are not among them yet, with the handle `listed` until
  /// they are scheduled. Counts discarded failures in `counters`.
  void unschedule_around(Vertex_handle v, std::vector<Edge_with_mirror>& edges,
                         Triangulation_counters& counters);
  /// Schedules the edges of the faces at a vertex that have no entry; `state` is that of the
  /// certificates of edges at the vertex.
  void schedule_around(Vertex_handle v, Certificate_state state);

  /// Schedules a hidden point; for `vanishing` see Certification::hidden_certificate. Precondition:
  /// it has no entry.
  void schedule_hidden(Vertex_handle v, const Time& after, std::uint8_t vanishing = no_condition);
  /// Schedules the points that a face hides and that have no entry.
  void schedule_hidden_in(Face_handle face);
  void unschedule_hidden(Vertex_handle v);
  void unschedule_hidden_in(Face_handle face);

 private:
  /// Puts the certificates of edges into the queue.
  struct Put_certificate {
    Schedule& schedule;
    KINETRI_ALWAYS_INLINE void operator()(const Edge_with_mirror& edge, Entry_kind kind,
                                          Certificate&& certificate) const {
      schedule.put(edge, kind, std::move(certificate));
    }
  };

  /// Faces whose own edges one thread schedules.
  struct Block {
    std::span<const Face_handle> faces;
    Queue_handle next_handle = 0;  // for the next edge
    Time after;                    // a copy of its own
    Certificate_counters counters;
  };

  template <class Is_due>
  bool settle_while(const Is_due& is_due) {
    return queue_.settle(is_due, [this](std::span<const Entry> entries) { recheck(entries); });
  }
  void recheck(std::span<const Entry> entries);
  bool fails_before(const Entry& entry, const Time& time) const;
  bool fails_before(const Entry& recheck, Time checked, const Time& time) const;
  bool has_deferred_failure_before(const Time& time) const;
  std::pair<Certificate_points, Certificate> certificate_of(const Entry& entry,
                                                            const Time& after) const;
  KINETRI_ALWAYS_INLINE void put(const Edge_with_mirror& edge, Entry_kind kind,
                                 Certificate&& certificate);
  KINETRI_ALWAYS_INLINE void unschedule(const Edge_with_mirror& edge,
                                        Triangulation_counters& counters);
  template <class Put>
  void schedule_block(Block& block, const Put& put) const;

  const Certification& certification_;
  const Topology& topology_;
  Triangulation_counters& counters_;
  mutable Time current_time_;
  /// If the present time has not been computed: the certificate that failed then, and bounds of the
  /// time. The points must not change until then. Empty when a public function returns or an
  /// observer is called, so that const functions change nothing.
  mutable std::optional<std::pair<Certificate_points, Double_interval>> pending_time_;
  std::optional<Time> end_;
  Policy policy_{*this};
  Queue queue_{policy_};
  bool is_deferred_ = false;
  std::shared_ptr<Region_division> division_ = make_division();
  Certificate_counters certificate_counters_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_SCHEDULE_H
