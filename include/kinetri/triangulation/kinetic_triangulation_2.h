// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation: a CGAL::Delaunay_triangulation_2 of moving points or, if the points
// have weights, a CGAL::Regular_triangulation_2, that is kept right through time. Its parts are
// those of detail::Kinetic_core; docs/ARCHITECTURE.md follows one event through them.
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
#include "kinetri/triangulation/triangulation_counters.h"
#include "kinetri/triangulation/triangulation_snapshot.h"

namespace kinetri {

/// The Delaunay triangulation of moving points, exact at every time; or the regular triangulation,
/// if the traits are WeightedKineticTraits_2: the points have weights, and those whose power cell
/// is empty are hidden. What is said of Delaunay triangulations below is then said of regular ones,
/// with power circles in place of circles.
///
/// Just after each time there is one such triangulation, and this is it, whatever came before: it
/// is a function of the motions and the time alone. If points are cocircular for a while, those
/// diagonals are edges that are Delaunay if points are lifted by infinitely little more than x^2 +
/// y^2: by e1 x y + e2 x^2 + e3 y^2, with e1 far greater than e2 and e2 than e3
/// (perturbed_in_circle_polynomial; docs/MATH.md, section 4).
///
/// A hidden point is there, has an id and a motion, and has no edges. Its vertex is `is_hidden()`,
/// as CGAL has it, and the vertex's `face()` is the triangle that hides it.
///
/// A flip costs five certificates and as many changes of the queue, whatever the number of points;
/// memory is O(points), with one entry of the queue for each edge. Several threads may call const
/// functions of one object at once. Copies are not made: handles and observers belong to one
/// object.
///
/// Functions that are not const change the object, except set_threads and remove_observer. They
/// throw Precondition_error if they are called while another one of them runs: by an observer, or
/// by the function `may_go_on`. So they do when an observer has thrown within an event, since the
/// change of that event may not have been made, and other observers have not been told of it: make
/// another object then, or restore a snapshot. Until then only what is const may be called.
template <KineticTraits_2 Traits>
class Kinetic_triangulation_2 {
 public:
  using Motion = typename Traits::Motion;                              ///< of the traits
  using Point_2 = typename Traits::Point_2;                            ///< of the traits
  using Time = Algebraic_number;                                       ///< of events
  using Instantaneous_traits = typename Traits::Instantaneous_traits;  ///< of the traits
  /// CGAL's triangulation, whose points move.
  using Triangulation = typename detail::Kinetic_types<Traits>::Triangulation;
  using Vertex_handle = typename Triangulation::Vertex_handle;  ///< good while its point is there
  using Face_handle = typename Triangulation::Face_handle;      ///< good until the next event
  using Edge = typename Triangulation::Edge;                    ///< a face and an index, as CGAL's
  using Observer = Event_observer;                              ///< what add_observer takes
  using Snapshot = Triangulation_snapshot<Traits>;              ///< what snapshot() gives

  /// The triangulation of the motions in [first, last), numbered from 0, Delaunay just after
  /// `start`. The input may be degenerate at `start` and at every other time: any number of points,
  /// collinear, cocircular, or at one position as long as they part.
  ///
  /// Throws Coincident_trajectories_error if two motions are the same trajectory, and
  /// Precondition_error if a number is not finite or there are 2^32 - 1 points or more.
  /// Cost: expected O(n log n) exact predicates and O(n) failure times, the latter on all threads
  /// that oneTBB has, with the same result for any number of them.
  template <class InputIterator>
  Kinetic_triangulation_2(InputIterator first, InputIterator last, const Time& start = Time(),
                          const Traits& traits = Traits())
      : Kinetic_triangulation_2(std::vector<Motion>(first, last), start, traits) {}

  /// The triangulation of all motions in the vector; otherwise as the constructor above.
  explicit Kinetic_triangulation_2(const std::vector<Motion>& motions, const Time& start = Time(),
                                   const Traits& traits = Traits());

  /// The triangulation of the snapshot. It goes on as the triangulation that the snapshot was taken
  /// of: the same events, with the same numbers, for the same calls. Counters go on too, except
  /// those of the queue; certificates are made anew, and counted. Observers are not part of a
  /// snapshot.
  ///
  /// Throws Snapshot_error if a number of the snapshot is not finite, or two points have the same
  /// trajectory (and weight). Cost: as of the constructor.
  static Kinetic_triangulation_2 restore(const Snapshot& snapshot,
                                         const Traits& traits = Traits()) {
    return Kinetic_triangulation_2(Restoration(), snapshot, traits);
  }

  Kinetic_triangulation_2(const Kinetic_triangulation_2&) = delete;
  Kinetic_triangulation_2& operator=(const Kinetic_triangulation_2&) = delete;

  // ---- the present ----

  /// The time just after which the triangulation is Delaunay now.
  const Time& current_time() const { return core_.schedule.current_time(); }

  /// The triangulation. Its predicates are those of the instant just after current_time(), so that
  /// CGAL's queries (locate, nearest_vertex, dual, ...) are about the points as they stand then. It
  /// is the object itself, valid until the next call that advances time.
  const Triangulation& triangulation() const { return core_.topology.triangulation(); }

  /// What decides about the points: certificates, and the predicates at an instant.
  const Traits& traits() const { return core_.certification.traits(); }

  /// How many points are there now.
  std::size_t number_of_points() const noexcept { return core_.topology.number_of_points(); }

  /// The id that is given next: one more than the greatest so far. Ids are not used again when
  /// their points have left.
  Point_id next_id() const noexcept {
    return static_cast<Point_id>(core_.topology.vertices().size());
  }

  /// Whether the point `id` is there: has been inserted, and not been erased.
  bool contains(Point_id id) const noexcept { return core_.topology.contains(id); }

  /// Whether the point `id` has no power cell, and so no edges. Never without weights.
  /// Precondition: contains(id).
  bool is_hidden(Point_id id) const;

  /// The number of hidden points. O(1).
  std::size_t number_of_hidden_points() const { return core_.topology.number_of_hidden_points(); }

  /// The vertex of the point `id`, the same as long as the point is there.
  /// Precondition: contains(id).
  Vertex_handle vertex(Point_id id) const;

  /// The motion of the point `id`. Precondition: contains(id).
  const Motion& motion(Point_id id) const;

  /// The ids of the ends of all finite edges, sorted. O(n log n).
  std::vector<Edge_ids> finite_edge_ids() const;

  /// The whole state, to be restored later or elsewhere; see Triangulation_snapshot. O(n).
  /// Precondition: not within an event, that is, not called by an observer (checked), nor after an
  /// observer has thrown.
  Snapshot snapshot() const;

  // ---- time ----

  /// The time of the next event; empty if the triangulation never changes again. Checks
  /// certificates again as far as is needed to know. (If points meet at that time, it may turn out
  /// that no edge has changed just after it.)
  std::optional<Time> next_event_time();

  /// Whether next_event_time() is before `time`, exactly; changes nothing. Cost: O(1) after
  /// next_event_time(), or if no certificate is to be checked again before `time`; else O(n), and
  /// those certificates are checked in each call.
  bool has_event_before(const Time& time) const;

  /// Goes to the next time at which something changes and executes all events of that time, so that
  /// the triangulation is Delaunay just after it. Returns their number; 0 if there is no next
  /// event.
  std::size_t step();

  /// Goes to `time`: every event at or before it has happened, and current_time() is `time`.
  /// Returns the number of events. Precondition: time >= current_time().
  std::size_t advance_to(const Time& time);

  /// As advance_to(time), but asks `may_go_on` before each time at which something changes; in a
  /// run by regions (set_threads) before each window of time. If it returns false, nothing more
  /// happens: current_time() is the time of the last event. It may call current_time() and
  /// counters() of this object, and no other of its functions.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);

  /// How many threads advance_to may use from now on: 1, as at first, or more, or those of oneTBB's
  /// arena if 0. They share the work if there are some 50 000 points or more, with the traits of
  /// this library, of which at most one in 1000 is hidden, no observer looks at the triangulation
  /// (Event_observer::looks_at_triangulation), and many events are to come. The result is the same,
  /// event by event; only counts of certificates, rechecks and the queue, which
  /// tell how it was found, differ. Some 150 bytes a point more are in use from then on. If an
  /// observer throws, later events up to the end of a window of time have happened too, and
  /// observers are not told of them. If memory is missing for a window, the state is that before
  /// or after its events, if there is memory to schedule all certificates anew.
  void set_threads(std::size_t most) { core_.threads = most; }

  /// As step(), but only if the next event is at or before `until`; else nothing happens, and
  /// current_time() stays what it is. Returns the number of events.
  std::size_t step(const Time& until);

  /// Lets time run backwards: from now on the clock shows -t where it showed t, and each point has
  /// the mirrored motion (`mirrored`). Past events come again in reverse order, at mirrored times:
  /// edges that were removed are added. The events of the present time are undone at once; then the
  /// triangulation is Delaunay just after the new current_time(), which is just before the old one.
  /// Returns the number of events undone. Motions that were replaced do not come back. Vertices
  /// keep their handles.
  ///
  /// Cost: O(n) failure times, as at the start; O(n log n) predicates more if three neighbors are
  /// collinear now.
  std::size_t reverse();

  // ---- changing points ----

  // Each change takes place at current_time(), is an event, and leaves the triangulation Delaunay
  // just after that time; edges that it removes and adds are reported in rebuild events after it.
  // Other vertices keep their handles, and so does a point that gets a new motion. Expected cost:
  // proportional to the degree of the point, and to the triangles on the way to its new position;
  // O(n) if all points are, or become, collinear at all times.

  /// Gives the point `id` another motion from now on: event `trajectory`. The motion need not go
  /// through the present position of the point, and may go through that of another point if the two
  /// part at once.
  /// Throws Coincident_trajectories_error, and changes nothing, if another point has the same
  /// trajectory. Precondition: contains(id); the motion is finite.
  void set_motion(Point_id id, const Motion& motion);

  /// Inserts a point, which gets the id next_id(), and returns that id: event `insert`. Throws what
  /// set_motion throws. Precondition: the motion is finite, and there is an id left.
  Point_id insert(const Motion& motion);

  /// Erases the point `id`; the handle of its vertex is not valid from then on: event `erase`.
  /// Precondition: contains(id).
  void erase(Point_id id);

  // Changes of many points at once make each certificate once, on all threads that oneTBB has if
  // there are many. They are made entirely, or not at all: what throws changes nothing. Points that
  // turn cost O(1) certificates each, and O(n) together; if most of the points jump, come or go,
  // the triangulation is built anew, O(n log n). There is one event for each point, in the order of
  // the ids, then rebuild events for the edges that have changed.

  /// Gives the points `ids` these motions from now on, as set_motion does: an event `trajectory`
  /// for each point. Throws Coincident_trajectories_error if two points have the same trajectory
  /// then. Precondition: as many motions as ids; each id is contained, and named once; the motions
  /// are finite.
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);

  /// Gives the points `ids` these velocities from now on: set_motions, each point going on from its
  /// position at the binary64 number nearest to current_time(), rounded as `with_velocity_at` says.
  /// Throws what set_motions throws. Precondition: as many velocities as ids; each id is contained,
  /// and named once; velocities and positions are finite.
  void set_velocities(std::span<const Point_id> ids, std::span<const Vector_2> velocities) requires
      MotionWithVelocity_2<typename Traits::Motion>;

  /// Inserts points, which get consecutive ids, and returns the first id: an event `insert` for
  /// each point. Throws what set_motions throws. Precondition: the motions are finite, and there
  /// are ids left.
  Point_id insert(std::span<const Motion> motions);

  /// Erases the points: an event `erase` for each point. Precondition: each id is contained, and
  /// named once.
  void erase(std::span<const Point_id> ids);

  /// What an event does to a point: gives it another motion or, with none, erases it.
  using Change = detail::Point_change<Motion>;

  /// Makes the changes as one event of the given kind that concerns the given points: for events
  /// that are not failures of this triangulation's certificates, such as collisions. Returns the
  /// edges that this has removed and added. Throws what set_motion throws, and changes nothing
  /// then. Precondition: each point that is named in `changes` is there, and named once.
  Changed_edges apply(Event_kind kind, std::optional<Point_id> point_a,
                      std::optional<Point_id> point_b, std::span<const Change> changes);

  // ---- watching ----

  /// Calls `observer` before and after each event from now on. It must outlive this object or be
  /// removed. Costs nothing if there is none.
  void add_observer(Observer& observer) {
    core_.reporter.check_may_change();
    core_.reporter.observers().add(observer);
  }
  /// Calls `observer` no more. Does nothing if it was not called. An observer may remove itself and
  /// others within an event, of which those are told no more.
  void remove_observer(Observer& observer) { core_.reporter.observers().remove(observer); }

  /// Counts since the start, those of the snapshot included.
  const Triangulation_counters& counters() const { return core_.counters; }
  /// How long the constructor took.
  const Construction_seconds& construction_seconds() const { return core_.construction_seconds; }
  /// Counts of the queue's entries since this object was made.
  Queue_counters queue_counters() const { return core_.schedule.queue().counters(); }
  /// The present number of entries in the queue: failures, and times up to which a certificate
  /// certainly holds; at most one for each edge, those to the infinite vertex included. O(1).
  std::size_t queue_size() const noexcept { return core_.schedule.queue().size(); }
  /// Counts of certificates since the start, those of the snapshot included.
  const Certificate_counters& certificate_counters() const {
    return core_.schedule.certificate_counters();
  }

  /// Checks the present state up to `level`; see Audit_level. Costs from O(n) link checks to O(n)
  /// failure times. Changes nothing.
  Audit_report audit(Audit_level level) const;

  /// Whether the triangulation is valid, as CGAL's function of this name says it: audit() up to the
  /// level `links` if `level` is 0, else up to `delaunay`. Prints what is wrong to std::cerr if
  /// `verbose`.
  bool is_valid(bool verbose = false, int level = 0) const {
    return detail::is_passed(audit(level > 0 ? Audit_level::delaunay : Audit_level::links),
                             verbose);
  }

 private:
  friend struct detail::Core_access;

  struct Restoration {};
  Kinetic_triangulation_2(Restoration, const Snapshot& snapshot, const Traits& traits);

  detail::Kinetic_core<Traits> core_;
};

extern template class Kinetic_triangulation_2<Linear_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H
