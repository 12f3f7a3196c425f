// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation: a CGAL::Delaunay_triangulation_2 of moving points or, if they have
// weights, a CGAL::Regular_triangulation_2, updated at each event; or one of a flat torus.
// docs/ARCHITECTURE.md describes its parts, and follows one event through them.
#ifndef KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H
#define KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/triangulation/audit.h"
#include "kinetri/triangulation/coincident_points.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// A snapshot of Kinetic_triangulation_2: the points, and the time; not the traits, nor the
/// periodic box that these may have. They determine the triangulation, even if points are
/// cocircular (docs/MATH.md, section 4), and the queue, since failure times do not depend on when
/// they were computed.
template <KineticTraits_2 Traits>
struct Triangulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events

  Time time = {};                              ///< the state is the one just after it
  std::vector<std::optional<Motion>> motions;  ///< by point id; none for an erased point
  Triangulation_counters counters;             ///< so far
  Certificate_counters certificates;           ///< so far
};

/// The Delaunay triangulation of moving points, exact at every time; or, if the traits are
/// WeightedKineticTraits_2, the regular triangulation of points with weights, in which points with
/// empty power cells are hidden. Then read "regular" for "Delaunay" and "power circle" for "circle"
/// below.
///
/// If the traits are PeriodicKineticTraits_2, it is the Delaunay triangulation of points in a
/// periodic box, on the flat torus: n visible points have 3n edges and 2n faces, from n = 1 on, and
/// there is no hull. Then read "image of a point" for "point" where positions are compared. Time
/// ends when the box loses its area: `next_event_time` and `step` know only events before that, and
/// `advance_to` throws Periodic_box_error from then on. A Periodic_offset_error says that an edge
/// would get an offset of 2^31 or more, as may happen just before the end; so does a
/// Periodic_box_error about a point that is moved or inserted so far away from others. Then only
/// const functions may be called, unless the change was refused before its event. One thread
/// executes the events. With weights the vertex of a hidden point also has the `offset()` of its
/// image in the triangle that hides it, against corner 0; and before the end hidden points may
/// cross infinitely many triangles without an event: then `step` needs a time.
///
/// The triangulation just after a time is a function of the motions and the time alone. If points
/// are cocircular for a while, a perturbation of the lifting x^2 + y^2 by e1 x y + e2 x^2 + e3 y^2,
/// with infinitely small e1 >> e2 >> e3, chooses the diagonals (perturbed_in_circle_polynomial;
/// docs/MATH.md, section 4).
///
/// A hidden point has an id, a motion and a vertex, but no edges. As in CGAL, `is_hidden()` of the
/// vertex is true, and its `face()` is the triangle that hides it.
///
/// Of points that have the same trajectory (and weight) from some time on, the one with the least
/// id hides the others, which have no vertex of their own, until the motion of one of them changes:
/// events `hide` and `reveal`, whose point_b is the point that hides point_a. Points that only meet
/// and part hide nothing. Without such points this costs nothing. With k hidden points each change
/// costs O(log k) more, and a change of a point of a group as much as the group has points. They
/// may also be refused (Coincident_points).
///
/// A flip costs five certificates and as many changes of the queue; memory is O(n), with at most
/// one queue entry for each edge and hidden point. Several threads may call const functions of one
/// object at once. Objects cannot be copied, since handles and observers belong to one object.
///
/// Functions that are not const, except set_threads and remove_observer, throw Precondition_error
/// if they are called while another one runs, that is, by an observer or by `may_go_on`. They also
/// throw it after an observer has thrown within an event: that event may not have been executed.
/// Then make another object, or restore an earlier snapshot; of this object only const functions
/// may be called.
template <KineticTraits_2 Traits>
class Kinetic_triangulation_2 {
 public:
  using Motion = typename Traits::Motion;                              ///< of the traits
  using Point_2 = typename Traits::Point_2;                            ///< of the traits
  using Time = Algebraic_number;                                       ///< of events
  using Instantaneous_traits = typename Traits::Instantaneous_traits;  ///< of the traits
  /// CGAL's triangulation, whose points move; in a periodic box see triangulation().
  using Triangulation = typename detail::Kinetic_types<Traits>::Triangulation;
  using Vertex_handle = typename Triangulation::Vertex_handle;  ///< valid until its point is erased
  using Face_handle = typename Triangulation::Face_handle;      ///< valid until the next event
  using Edge = typename Triangulation::Edge;                    ///< a face and an index
  using Observer = Event_observer;                              ///< what add_observer takes
  using Snapshot = Triangulation_snapshot<Traits>;              ///< what snapshot() gives

  /// The triangulation of the motions in [first, last), numbered from 0, Delaunay just after
  /// `start`. The input may be degenerate at `start` and at every other time: any number of points,
  /// collinear, cocircular, or at one position for a moment.
  ///
  /// Throws Coincident_trajectories_error if two motions are the same trajectory and such points
  /// are refused, and Precondition_error if a number is not finite or there are 2^32 - 1 points or
  /// more. Cost: expected O(n log n) exact predicates and O(n) failure times, the latter on all
  /// threads of oneTBB, with the same result for any number of threads.
  template <class InputIterator>
  Kinetic_triangulation_2(InputIterator first, InputIterator last, const Time& start = Time(),
                          const Traits& traits = Traits(),
                          Coincident_points coincident = Coincident_points::hide)
      : Kinetic_triangulation_2(std::vector<Motion>(first, last), start, traits, coincident) {}

  /// The triangulation of all motions in the vector; otherwise as the constructor above.
  explicit Kinetic_triangulation_2(const std::vector<Motion>& motions, const Time& start = Time(),
                                   const Traits& traits = Traits(),
                                   Coincident_points coincident = Coincident_points::hide);

  /// The triangulation of the snapshot. It behaves from here on like the original: the same calls
  /// give the same events, with the same numbers. Counters continue, except those of the queue;
  /// certificates are recomputed, and counted. Observers are not part of a snapshot.
  ///
  /// Throws Snapshot_error if a number of the snapshot is not finite, or two points have the same
  /// trajectory (and weight) and such points are refused. Cost: as of the constructor.
  static Kinetic_triangulation_2 restore(const Snapshot& snapshot, const Traits& traits = Traits(),
                                         Coincident_points coincident = Coincident_points::hide) {
    return Kinetic_triangulation_2(Restoration(), snapshot, traits, coincident);
  }

  Kinetic_triangulation_2(const Kinetic_triangulation_2&) = delete;
  Kinetic_triangulation_2& operator=(const Kinetic_triangulation_2&) = delete;

  // ---- the present ----

  /// The current time: the triangulation is Delaunay just after it.
  const Time& current_time() const { return core_.schedule.current_time(); }

  /// The triangulation. Its predicates are those of the instant just after current_time(), so
  /// CGAL's queries (locate, nearest_vertex, dual, ...) answer for that instant. The reference
  /// stays valid; later calls change the triangulation. In a periodic box it is no triangulation of
  /// CGAL, which knows no edges with equal ends, but a detail::Torus_triangulation, whose faces
  /// store the offsets of their corners.
  const Triangulation& triangulation() const { return core_.topology.triangulation(); }

  /// The traits: certificates, and the predicates at an instant.
  const Traits& traits() const { return core_.certification.traits(); }

  /// The present number of points, hidden ones included.
  std::size_t number_of_points() const noexcept {
    return core_.topology.number_of_vertices() + core_.topology.twins().size();
  }

  /// The id that is given next: one more than the greatest so far. Ids are not reused.
  Point_id next_id() const noexcept {
    return static_cast<Point_id>(core_.topology.vertices().size());
  }

  /// Whether the point `id` has been inserted, and not been erased.
  bool contains(Point_id id) const { return core_.topology.contains(id); }

  /// Whether the point `id` is hidden: by a triangle, which happens only with weights, or by a
  /// point with the same trajectory. Precondition: contains(id).
  bool is_hidden(Point_id id) const;

  /// The number of hidden points. O(1).
  std::size_t number_of_hidden_points() const {
    return core_.topology.number_of_hidden_vertices() + core_.topology.twins().size();
  }

  /// What happens to points with the same trajectory (and weight), as given to the constructor.
  Coincident_points coincident() const noexcept {
    return core_.topology.refuses_twins() ? Coincident_points::refuse : Coincident_points::hide;
  }

  /// The other points with the trajectory (and weight) of the point `id`, sorted. Precondition:
  /// contains(id).
  std::vector<Point_id> coincident_points(Point_id id) const;

  /// The vertex of the point `id`, the same until the point is erased, or is hidden by a point with
  /// the same trajectory: then it is the vertex of that point. Precondition: contains(id).
  Vertex_handle vertex(Point_id id) const;

  /// The point `id` with its motion. The reference is valid until the next change of a point.
  /// Precondition: contains(id).
  const Point_2& point(Point_id id) const;

  /// The motion of the point `id`. Precondition: contains(id).
  const Motion& motion(Point_id id) const { return point(id).motion(); }

  /// The ids of the ends of all finite edges, sorted. In a periodic box a pair of ids occurs once
  /// for each of its edges. O(n log n).
  std::vector<Edge_ids> finite_edge_ids() const;

  /// In a periodic box, all 3n edges of the n visible points, sorted. O(n log n).
  std::vector<Periodic_edge> periodic_edges() const requires PeriodicKineticTraits_2<Traits>;

  /// The whole state; see Triangulation_snapshot. O(n). Precondition: not called by an observer,
  /// nor after one has thrown within an event (checked).
  Snapshot snapshot() const;

  // ---- time ----

  /// The time of the next event; empty if the triangulation never changes again. May recheck
  /// certificates. (If points meet at that time, there may be no event: no edge has changed just
  /// after it.)
  std::optional<Time> next_event_time();

  /// Whether next_event_time() is before `time`, exactly; changes nothing. Cost: O(1) after
  /// next_event_time(), or if no certificate must be rechecked before `time`; else O(n), and each
  /// call computes those certificates again, or all if they are deferred (see set_motions).
  bool has_event_before(const Time& time) const;

  /// Advances to the next time that has events and executes all of these. Returns their number; 0
  /// if there is none. Points may meet without an event: such a time is passed.
  std::size_t step();

  /// Advances to `time` and executes every event up to it, included. Returns the number of events.
  /// Precondition: time >= current_time().
  std::size_t advance_to(const Time& time);

  /// As advance_to(time), but calls `may_go_on` before each time with events; with several threads
  /// (set_threads) before each time window. If it returns false, advance_to returns: current_time()
  /// is then the time of the last event. `may_go_on` may call current_time() and counters() of this
  /// object, and no other of its functions.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);

  /// How many threads advance_to may use from now on: at first 1; 0 means those of oneTBB's arena.
  /// Several threads execute events if there are some 50 000 points or more, of which at most one
  /// in 1000 is hidden, the traits are the library's own for the plane, no observer reads the
  /// triangulation (Event_observer::looks_at_triangulation), and many events are to come
  /// (docs/PARALLEL.md). Events are the same, one by one; only counts of certificates, rechecks,
  /// discarded failures and the queue differ. Memory: some 30 bytes a point more, and 60 to 110 in
  /// a simulation of colliding discs. If an observer throws, the later events of the same time
  /// window have been executed too, without calls of observers. If a window runs out of memory, the
  /// state is that before or after its events, if there is memory to schedule all certificates
  /// anew.
  void set_threads(std::size_t most) { core_.threads = most; }

  /// As step(), but does nothing if the next event is after `until`. Returns the number of events.
  std::size_t step(const Time& until);

  /// Reverses time: time t becomes -t, and each point gets the mirrored motion (`mirrored`). Past
  /// events recur in reverse order, at mirrored times: edges that were removed are added. The
  /// events of the present time are undone at once; then the triangulation is Delaunay just after
  /// the new current_time(), which is just before the old one. Returns the number of events undone.
  /// Replaced motions do not come back. Vertices keep their handles.
  ///
  /// Cost: O(n) failure times, as at the start; and O(n log n) predicates if a triangle is flat
  /// now.
  std::size_t reverse();

  // ---- changing points ----

  // Each change takes place at current_time(), is an event, and leaves the triangulation Delaunay
  // just after that time; edges that it removes and adds are reported in rebuild events after it.
  // Vertices keep their handles, also if they get new motions. Expected cost: proportional to the
  // degree of the point, and to the triangles on the way to its new position; O(n log n) if all
  // points are, or become, collinear at all times.

  /// Gives the point `id` another motion from now on: event `trajectory`. The point may jump, even
  /// to the position of another point if the two separate at once. Throws
  /// Coincident_trajectories_error, and changes nothing, if another point has the same trajectory
  /// and such points are refused.
  /// Precondition: contains(id); the motion is finite.
  void set_motion(Point_id id, const Motion& motion);

  /// Inserts a point, which gets the id next_id(), and returns that id: event `insert`. Throws what
  /// set_motion throws. Precondition: the motion is finite, and there is an id left.
  Point_id insert(const Motion& motion);

  /// Erases the point `id` and invalidates the handle of its vertex: event `erase`. Precondition:
  /// contains(id).
  void erase(Point_id id);

  // Changes of many points at once compute each certificate once, on all threads of oneTBB if there
  // are many. What throws Coincident_trajectories_error or Precondition_error changes nothing.
  // There is one event for each point, in the order of the ids, then rebuild events for the edges
  // that have changed. Points whose triangles stay embedded cost O(1) certificates each, and O(n)
  // together; if more than an eighth of the points, and more than 8, jump, are inserted or erased,
  // the triangulation is constructed again, O(n log n).
  //
  // If more than a quarter of the points, and more than 16, get other motions, none is inserted or
  // erased, and coincident points are not refused, then the triangulation is repaired
  // (src/triangulation/repair.h) as long as that costs less than a construction: if points move
  // less than about half the distance of neighbors. It is constructed instead if points or
  // predicates are not those of this library, in a periodic box if weights differ, and after 32
  // changes of edges for each point, so that neighbors are near each other in memory again. After a
  // repair or construction certificates are *deferred*: computed only when time is to go on
  // (next_event_time, step, advance_to), or at another change.

  /// Gives the points `ids` these motions from now on, as set_motion does: an event `trajectory`
  /// for each point. Throws Coincident_trajectories_error if two points have the same trajectory
  /// then and such points are refused. Precondition: as many motions as ids; each id is contained,
  /// and named once; the motions are finite.
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);

  /// Gives the points `ids` these velocities from now on: as set_motions; each point continues from
  /// its position at the binary64 number nearest to current_time(), rounded as `with_velocity_at`
  /// says. Throws what set_motions throws. Precondition: as many velocities as ids; each id is
  /// contained, and named once; velocities and positions are finite.
  void set_velocities(std::span<const Point_id> ids, std::span<const Vector_2> velocities) requires
      MotionWithVelocity_2<typename Traits::Motion>;

  /// Moves the points `ids` to these positions, at which they stay at rest (`at_rest_in`): as
  /// set_motions. Radii, growth and weights stay. Throws what set_motions throws. Precondition: as
  /// many positions as ids; each id is contained, and named once; the positions are finite.
  void set_positions(std::span<const Point_id> ids, std::span<const Vector_2> positions) requires
      MotionWithPosition_2<typename Traits::Motion>;

  /// Moves all points: positions are in the order of the ids, without gaps for erased points.
  /// Precondition: as many positions as points, which are finite.
  void set_positions(std::span<const Vector_2> positions) requires
      MotionWithPosition_2<typename Traits::Motion> {
    set_positions(ids_of(positions), positions);
  }

  /// Moves the points `ids` on straight lines to these positions, which they reach in the time
  /// `duration`, and executes the events on the way; the other points go on. Returns the number of
  /// these events. Let `now` be the binary64 number nearest to current_time(). The line begins at
  /// the position at `now`, rounded as by set_velocities; the end is the rounded sum of `now` and
  /// `duration`. Velocities are rounded, so a point may miss its position a little; in the end it
  /// jumps there (set_positions). In a periodic box positions may be outside of the box, and lines
  /// are those of the plane.
  ///
  /// It is set_motions, advance_to and set_positions, and throws what these throw. A broken
  /// precondition, coincident points on the way that are refused, and a periodic box without an
  /// area by the end change nothing. If set_positions is refused, the time is the end, and the
  /// points still have the motions of the way. Else, as if an observer throws, the state is that of
  /// advance_to, in which points are on the way. Precondition: as for set_positions; the end is
  /// finite, and after current_time().
  std::size_t advance_through(std::span<const Point_id> ids, std::span<const Vector_2> positions,
                              double duration) requires
      MotionWithVelocity_2<typename Traits::Motion> &&
      MotionWithPosition_2<typename Traits::Motion>;

  /// The same of all points, as set_positions(positions).
  std::size_t advance_through(std::span<const Vector_2> positions, double duration) requires
      MotionWithVelocity_2<typename Traits::Motion> &&
      MotionWithPosition_2<typename Traits::Motion> {
    return advance_through(ids_of(positions), positions, duration);
  }

  /// Inserts points, which get consecutive ids, and returns the first id: an event `insert` for
  /// each point. Throws what set_motions throws. Precondition: the motions are finite, and there
  /// are ids left.
  Point_id insert(std::span<const Motion> motions);

  /// Erases the points: an event `erase` for each point. Precondition: each id is contained, and
  /// named once.
  void erase(std::span<const Point_id> ids);

  /// What an event does to a point: gives it another motion or, with none, erases it.
  using Change = detail::Point_change<Motion>;

  /// Makes the changes as one event of the given kind and points: for events that are not failures
  /// of certificates, such as collisions. Returns the edges removed and added. Throws what
  /// set_motion throws, and then changes nothing. Precondition: each point in `changes` is
  /// contained, and named once.
  Changed_edges apply(Event_kind kind, std::optional<Point_id> point_a,
                      std::optional<Point_id> point_b, std::span<const Change> changes);

  // ---- watching ----

  /// Calls `observer` before and after each event from now on. It must outlive this object or be
  /// removed.
  void add_observer(Observer& observer) {
    core_.reporter.check_may_change();
    core_.reporter.observers().add(observer);
  }
  /// Stops calling `observer`. Does nothing if it was not added. An observer may remove itself and
  /// others, also within an event.
  void remove_observer(Observer& observer) { core_.reporter.observers().remove(observer); }

  /// Counts since the start, those of the snapshot included.
  const Triangulation_counters& counters() const { return core_.counters; }
  /// How long the constructor took.
  const Construction_seconds& construction_seconds() const { return core_.construction_seconds; }
  /// Counts of the queue's entries since this object was made.
  Queue_counters queue_counters() const { return core_.schedule.queue().counters(); }
  /// The present number of entries in the queue: failures, and times up to which a certificate
  /// certainly holds; at most one for each edge, infinite ones included, and each hidden point;
  /// 0 while certificates are deferred (see set_motions). O(1).
  std::size_t queue_size() const noexcept { return core_.schedule.queue().size(); }
  /// Counts of certificates since the start, those of the snapshot included.
  const Certificate_counters& certificate_counters() const {
    return core_.schedule.certificate_counters();
  }

  /// Checks the present state up to `level`; see Audit_level. Costs from O(n) link checks to O(n)
  /// failure times.
  Audit_report audit(Audit_level level) const;

  /// Whether the triangulation is valid, like CGAL's function of this name: audit() up to the level
  /// `links` if `level` is 0, else up to `delaunay`. Prints failures to std::cerr if `verbose`.
  bool is_valid(bool verbose = false, int level = 0) const {
    return detail::is_passed(audit(level > 0 ? Audit_level::delaunay : Audit_level::links),
                             verbose);
  }

 private:
  friend struct detail::Core_access;

  struct Restoration {};
  Kinetic_triangulation_2(Restoration, const Snapshot& snapshot, const Traits& traits,
                          Coincident_points coincident);

  std::vector<Point_id> ids_of(std::span<const Vector_2> positions) const;

  detail::Kinetic_core<Traits> core_;
};

extern template class Kinetic_triangulation_2<Linear_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Periodic_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H
