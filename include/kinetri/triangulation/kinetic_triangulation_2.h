// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation: a CGAL::Delaunay_triangulation_2 of moving points, or, where points
// have weights, a CGAL::Regular_triangulation_2, that is kept right through time. This class owns
// the triangulation, the event queue, and the invariant that joins them:
//
//   between two calls of a public function the triangulation is Delaunay (regular) just after
//   current_time(), and each edge, and each hidden point, whose certificate may ever fail again has
//   exactly one entry in the queue: either its failure, at its exact time, or a time up to which
//   the certificate certainly holds, and at which it is checked again.
//
// One event's way through the code: `settle` has certificates checked again until a failure is
// first in the queue; `run_instant` takes it out; `execute` looks at its kind; `flip_edge` flips
// and calls `schedule_after_flip` for the five edges whose quadrilateral has changed. `certify`
// asks the kinetic traits for their certificates, and `push` puts the failures into the queue.
#ifndef KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H
#define KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H

#include <CGAL/Delaunay_triangulation_2.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/base/flag_while.h"
#include "kinetri/impl/events/divided_scheduler.h"
#include "kinetri/impl/events/event_scheduler.h"
#include "kinetri/impl/events/observer_list.h"
#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/kinetic_triangulation_data_structure_2.h"
#include "kinetri/impl/triangulation/prefetch.h"
#include "kinetri/impl/triangulation/region_division.h"
#include "kinetri/impl/triangulation/regular_triangulation.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/triangulation/audit.h"
#include "kinetri/triangulation/triangulation_counters.h"
#include "kinetri/triangulation/triangulation_snapshot.h"

namespace kinetri {

namespace detail {

template <class KineticTriangulation>
class Auditor;
template <class Kinetic, class Traits>
class Hidden_points;
template <class KineticTriangulation>
class Plain_loop;
struct No_turns;
template <class KineticTriangulation, class Turns = No_turns>
class Region_run;
template <class KineticTriangulation>
struct Region_runs;

/// CGAL's triangulation of moving points: regular where they have weights, else Delaunay.
template <class Traits>
struct Triangulation_of {
  using type = CGAL::Delaunay_triangulation_2<
      typename Traits::Instantaneous_traits,
      Kinetic_triangulation_data_structure_2<typename Traits::Instantaneous_traits>>;
};
template <WeightedKineticTraits_2 Traits>
struct Triangulation_of<Traits> {
  using type = Regular_triangulation<typename Traits::Instantaneous_traits>;
};

}  // namespace detail

/// The Delaunay triangulation of moving points, exact at every time; or the regular triangulation,
/// if the traits are WeightedKineticTraits_2: the points have weights, and those whose power cell
/// is empty are hidden. What is said of Delaunay triangulations below is then said of regular ones,
/// with power circles in place of circles.
///
/// Just after each time there is one such triangulation, and this is it, whatever came before: it
/// is a function of the motions and the time alone. Where points are cocircular for a while, those
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
  using Triangulation = typename detail::Triangulation_of<Traits>::type;
  using Vertex_handle = typename Triangulation::Vertex_handle;  ///< good while its point is there
  using Face_handle = typename Triangulation::Face_handle;      ///< good until the next event
  using Edge = typename Triangulation::Edge;                    ///< a face and an index, as CGAL's
  using Observer = Event_observer;                              ///< what add_observer takes
  using Snapshot = Triangulation_snapshot<Traits>;              ///< what snapshot() gives

  /// The triangulation of the motions in [first, last), numbered from 0, Delaunay just after
  /// `start`. The input may be degenerate at `start` and at every other time: any number of points,
  /// collinear, cocircular, or in one place as long as they part.
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
  const Time& current_time() const;

  /// The triangulation. Its predicates are those of the instant just after current_time(), so that
  /// CGAL's queries (locate, nearest_vertex, dual, ...) are about the points as they stand then. It
  /// is the object itself, valid until the next call that advances time.
  const Triangulation& triangulation() const { return triangulation_; }

  /// A vertex that is probably near the place of a point at the current time, which need not be
  /// one of the triangulation: where a search for the place may begin. O(n^(1/3)). Precondition:
  /// there is a point.
  Vertex_handle vertex_near(const Point_2& point) const;

  /// What decides about the points: certificates, and the predicates at an instant.
  const Traits& traits() const { return traits_; }

  /// How many points are there now.
  std::size_t number_of_points() const noexcept { return number_of_points_; }

  /// The id that is given next: one more than the greatest so far. Ids are not used again when
  /// their points have left.
  Point_id next_id() const noexcept { return static_cast<Point_id>(vertices_.size()); }

  /// Whether the point `id` is there: has been given, and not been erased.
  bool contains(Point_id id) const noexcept {
    return id < vertices_.size() && vertices_[id] != Vertex_handle();
  }

  /// Whether the point `id` has no power cell, and so no edges. Never without weights.
  /// Precondition: contains(id).
  bool is_hidden(Point_id id) const;

  /// The number of hidden points. O(1).
  std::size_t number_of_hidden_points() const;

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
  /// run by regions (set_threads) before each window of time. Where it returns false, nothing more
  /// happens: current_time() is the time of the last event. It may call current_time() and
  /// counters() of this object, and no other of its functions.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);

  /// How many threads advance_to may use from now on: 1, as at first, or more, or those of oneTBB's
  /// arena if 0. They share the work where there are some 50 000 points or more, with the traits of
  /// this library, of which at most one in 1000 is hidden, no observer looks at the triangulation
  /// (Event_observer::looks_at_triangulation), and many events are to come. The result is the same,
  /// event by event; only counts of certificates, rechecks and the queue, which
  /// tell how it was found, differ. Some 150 bytes a point more are in use from then on. If an
  /// observer throws, later events up to the end of a window of time have happened too, and
  /// observers are not told of them. If memory is missing for a window, the state is that before
  /// or after its events, where there is memory to schedule all certificates anew.
  void set_threads(std::size_t most) { threads_ = most; }

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
  // proportional to the degree of the point, and to the triangles on the way to its new place; O(n)
  // if all points are, or become, collinear at all times.

  /// Gives the point `id` another motion from now on: event `trajectory`. The motion need not go
  /// through the present place of the point, and may go through that of another point if the two
  /// part at once.
  /// Throws Coincident_trajectories_error, and changes nothing, if another point has the same
  /// trajectory. Precondition: contains(id); the motion is finite.
  void set_motion(Point_id id, const Motion& motion);

  /// Inserts a point, which gets the id next_id(), and returns that id: event `insert`. Throws what
  /// set_motion throws. Precondition: the motion is finite, and there is an id left.
  Point_id insert(const Motion& motion);

  /// Gives out the id next_id(), for a point that is to be inserted later, or never. Precondition:
  /// there is an id left.
  Point_id reserve_id();

  /// Inserts a point with a reserved id: event `insert`. Throws what set_motion throws.
  /// Precondition: the motion is finite; the id has been reserved, and has had no point (checked is
  /// that no point has it now).
  void insert(const Motion& motion, Point_id id);

  /// Erases the point `id`; the handle of its vertex is not valid from then on: event `erase`.
  /// Precondition: contains(id).
  void erase(Point_id id);

  // Changes of many points at once make each certificate once, on all threads that oneTBB has where
  // there are many. They are made entirely, or not at all: what throws changes nothing. Points that
  // turn cost O(1) certificates each, and O(n) together; where most of the points jump, come or go,
  // the triangulation is built anew, O(n log n). There is one event for each point, in the order of
  // the ids, then rebuild events for the edges that have changed.

  /// Gives the points `ids` these motions from now on, as set_motion does: an event `trajectory`
  /// for each point. Throws Coincident_trajectories_error if two points have the same trajectory
  /// then. Precondition: as many motions as ids; each id is contained, and named once; the motions
  /// are finite.
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);

  /// Gives the points `ids` these velocities from now on: set_motions, each point going on from its
  /// place at the binary64 number nearest to current_time(), rounded as `with_velocity_at` says.
  /// Throws what set_motions throws. Precondition: as many velocities as ids; each id is contained,
  /// and named once; velocities and places are finite.
  void set_velocities(std::span<const Point_id> ids,
                      std::span<const Vector_2> velocities) requires MotionWithVelocity_2<Motion>;

  /// Inserts points, which get consecutive ids, and returns the first id: an event `insert` for
  /// each point. Throws what set_motions throws. Precondition: the motions are finite, and there
  /// are ids left.
  Point_id insert(std::span<const Motion> motions);

  /// Erases the points: an event `erase` for each point. Precondition: each id is contained, and
  /// named once.
  void erase(std::span<const Point_id> ids);

  /// What an event does to a point: gives it another motion or, with none, erases it.
  struct Change {
    Point_id point;                ///< which one
    std::optional<Motion> motion;  ///< from then on
  };

  /// Makes the changes as one event of the given kind that concerns the given points. For events
  /// that are not failures of this triangulation's certificates, such as collisions. Throws what
  /// set_motion throws, and changes nothing then. Precondition: each point that is named in
  /// `changes` is there, and named once.
  void apply(Event_kind kind, std::optional<Point_id> point_a, std::optional<Point_id> point_b,
             std::span<const Change> changes);

  // ---- watching ----

  /// Calls `observer` before and after each event from now on. It must outlive this object or be
  /// removed. Costs nothing where there is none.
  void add_observer(Observer& observer) {
    check_may_change();
    observers_.add(observer);
  }
  /// Calls `observer` no more. Does nothing if it was not called. An observer may remove itself and
  /// others within an event, of which those are told no more.
  void remove_observer(Observer& observer) { observers_.remove(observer); }

  /// Counts since the start, those of the snapshot included.
  const Triangulation_counters& counters() const { return counters_; }
  /// How long the constructor took.
  const Construction_seconds& construction_seconds() const { return construction_seconds_; }
  /// Counts of the queue's entries since this object was made.
  Queue_counters queue_counters() const { return queue_.counters(); }
  /// The present number of entries in the queue: failures, and times up to which a certificate
  /// certainly holds; at most one for each edge, those to the infinite vertex included. O(1).
  std::size_t queue_size() const noexcept { return queue_.size(); }
  /// Counts of certificates since the start, those of the snapshot included.
  const Certificate_counters& certificate_counters() const { return certificate_counters_; }

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
  friend class detail::Auditor<Kinetic_triangulation_2>;
  friend class detail::Hidden_points<Kinetic_triangulation_2, Traits>;
  friend class detail::Hidden_points<const Kinetic_triangulation_2, Traits>;
  friend class detail::Plain_loop<Kinetic_triangulation_2>;
  template <class Kinetic, class Turns>
  friend class detail::Region_run;
  friend struct detail::Region_runs<Kinetic_triangulation_2>;

  static constexpr bool is_weighted = WeightedKineticTraits_2<Traits>;

  /// What the queue holds an entry for, in the order of entries at one time. Hidden points come
  /// last: where they are is looked for in a triangulation whose edges are right.
  enum class Entry_kind : std::uint8_t {
    recheck,      ///< the certificate certainly holds until then
    coincidence,  ///< the ends of the edge coincide
    hull_insert,
    hull_remove,
    flip,
    hidden,  ///< a hidden point reaches the side or the plane of the triangle that hides it
  };

  struct Nothing {};
  using Hidden_vertex = std::conditional_t<is_weighted, Vertex_handle, Nothing>;

  /// What an entry is about: an edge or, if `hidden` is not null, a hidden point.
  struct Subject {
    Edge edge;
    [[no_unique_address]] Hidden_vertex hidden = {};

    bool is_hidden() const {
      if constexpr (is_weighted) return hidden != Vertex_handle();
      return false;
    }
  };

  /// An edge and the failure of its certificate; or a hidden point. The exact time is made from the
  /// corners of the edge's two faces, or of the face that hides the point: these must stay what
  /// they were when the entry was made.
  struct Entry : detail::Scheduled {
    std::uint8_t index = 0;  // the edge is the one opposite this vertex of the face
    Entry_kind kind = Entry_kind::recheck;
    bool changes_sign = false;  // the polynomial does, certainly, when the certificate fails
    Face_handle face;
    [[no_unique_address]] Hidden_vertex hidden = {};

    /// As the index of a hidden point: it reaches the plane of the lifted face. A lesser index says
    /// that it reaches the side of the face that is opposite that vertex.
    static constexpr std::uint8_t plane = 3;

    /// An entry without its subject and its times.
    struct Kept {
      std::uint8_t kind : 3 = 0;      ///< the `Entry_kind`
      std::uint8_t index : 2 = 0;     ///< what a hidden point reaches
      bool changes_sign : 1 = false;  ///< as in `Entry`
    };

    Entry() = default;
    /// The failure of an edge's certificate, which is of the given kind, or the time to check it
    /// again; without the exact time. Precondition: the certificate may fail.
    Entry(const Edge& edge, Entry_kind failure, const Certificate& certificate)
        : detail::Scheduled{certificate.bounds},
          index(static_cast<std::uint8_t>(edge.second)),
          kind(certificate.kind == Certificate::Kind::holds ? Entry_kind::recheck : failure),
          changes_sign(certificate.failure == nullptr),
          face(edge.first) {}

    /// The entry of a subject, without the exact time.
    Entry(const Subject& subject, const Double_interval& times, const Kept& kept)
        : detail::Scheduled{times},
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

  /// What the scheduler asks; see Event_scheduler and Divided_scheduler.
  struct Queue_policy {
    const Kinetic_triangulation_2& triangulation;

    Time entry_time(const Entry& entry) const;
    bool precedes(const Entry& a, const Entry& b) const;
    bool is_recheck(const Entry& entry) const { return entry.kind == Entry_kind::recheck; }
    KINETRI_ALWAYS_INLINE static void prefetch(const Entry& entry) { detail::prefetch(entry.face); }
    KINETRI_ALWAYS_INLINE static void prefetch_more(const Entry& entry) {
      detail::prefetch_around(entry.face);
    }
    void prefetch_first(const Entry& entry) const;
    std::size_t part_of(const Subject& subject) const;
    Queue_handle handle(const Subject& subject) const;
    void set_handle(const Subject& subject, Queue_handle handle) const;
  };

  /// An edge as its two faces see it. In dimension 1, where edges have no two sides, `there` is the
  /// same as `here`.
  struct Two_sided_edge {
    Edge here;
    Edge there;
  };

  /// What a certificate is about: points for the kinetic traits, four for in-circle, three for
  /// orientation; and the kind of its failure.
  struct Certificate_points {
    Entry_kind kind;
    std::array<const Point_2*, 4> points;
  };

  /// Faces whose own edges one thread schedules.
  struct Block {
    std::span<const Face_handle> faces;
    Queue_handle next_handle = 0;  // for the next edge
    Time after;                    // a copy of its own
    Certificate_counters counters;
  };

  // Calls within calls.
  void check_may_change() const;
  [[nodiscard]] detail::Flag_while start_change() {
    check_may_change();
    return detail::Flag_while(is_changing_);
  }

  // Construction.
  void start_with(std::span<const Point_2> points);
  Triangulation build_now(std::span<const Point_2> points) const;
  static Triangulation build(std::span<const Point_2> points, const Time& time,
                             const Instantaneous_traits& traits);
  Rounded_places places_now() const;
  static Triangulation build_regular(std::span<const Point_2> points,
                                     const Instantaneous_traits& traits);
  static bool build_from_places(std::span<const Point_2> points, const Rounded_places& places,
                                Triangulation& result);
  static bool is_embedded(const Triangulation& triangulation, const Rounded_places& places);
  static bool is_left_turn(const Triangulation& triangulation, const Rounded_places& places,
                           Vertex_handle a, Vertex_handle b, Vertex_handle c);
  static bool is_hull_convex(const Triangulation& triangulation, const Rounded_places& places);
  static bool flip_until_delaunay(Triangulation& triangulation, const Rounded_places& places);
  void index_vertices();

  // Snapshots.
  struct Restoration {};
  Kinetic_triangulation_2(Restoration, const Snapshot& snapshot, const Traits& traits);

  // Certificates.
  std::vector<Face_handle> faces() const;
  template <class Function>
  void for_each_own_edge(Face_handle face, Function function) const;
  static bool is_chosen_side(const Edge& edge);
  static Two_sided_edge chosen_side(const Two_sided_edge& edge);
  std::vector<Edge> edges() const;
  Two_sided_edge two_sided(const Edge& edge) const;
  static Edge_ids ids_of(const Edge& edge);
  std::array<Vertex_handle, 3> hull_turn(const Two_sided_edge& infinite_edge) const;
  Certificate_points certificate_points(const Two_sided_edge& edge) const;
  Certificate_points certificate_points(const Entry& entry) const;
  static Certificate certificate(const Certificate_points& points, const Time& after,
                                 Certificate_state state, const Traits& traits);
  template <class Put>
  void certify(std::span<const Two_sided_edge> edges, const Time& after, Certificate_state state,
               const Traits& traits, Certificate_counters& counters, const Put& put) const;
  std::pair<Entry_kind, Certificate> certificate_of(const Two_sided_edge& edge, const Time& after,
                                                    const Traits& traits) const;
  std::pair<Certificate_points, Certificate> certificate_of(const Entry& entry, const Time& after,
                                                            const Traits& traits) const;
  template <class After>
  Entry_kind first_failure(const Two_sided_edge& edge, Entry_kind kind, Certificate& certificate,
                           const After& after, const Traits& traits,
                           Certificate_counters& counters) const;
  Certificate coincidence(const Two_sided_edge& edge, const Time& after,
                          const Double_interval& among, const Traits& traits,
                          Certificate_counters& counters) const;
  Time failure_time(const Two_sided_edge& edge, Entry_kind kind,
                    const Double_interval& bounds) const;
  Time failure_time(const Certificate_points& failed, const Double_interval& bounds) const;

  // Scheduling.
  KINETRI_ALWAYS_INLINE Queue_handle push(const Edge& edge, Entry_kind kind,
                                          Certificate&& certificate);
  void schedule(std::span<const Two_sided_edge> edges, const Time& after,
                Certificate_state state = Certificate_state::any);
  void schedule_after_flip(const Two_sided_edge& edge, const std::array<Two_sided_edge, 4>& outer);
  template <class Now, class Put>
  bool certify_after_flip(const Two_sided_edge& edge, const std::array<Two_sided_edge, 4>& outer,
                          const Double_interval& bounds, const Now& now,
                          Certificate_counters& counters, const Put& put) const;
  void schedule_all();
  template <class Put>
  void schedule_block(Block& block, const Put& put) const;
  KINETRI_ALWAYS_INLINE void unschedule(const Two_sided_edge& edge) { unschedule(edge, counters_); }
  KINETRI_ALWAYS_INLINE void unschedule(const Two_sided_edge& edge,
                                        Triangulation_counters& counters);
  static Event_kind event_kind(Entry_kind failure);
  static void set_event(const Two_sided_edge& edge, Queue_handle handle);

  // Events.
  Double_interval current_bounds() const;
  void set_current_time(Time time);
  void set_current_time(const Entry& entry);
  bool settle(const Time* until);
  bool settle_now();
  template <class Is_due>
  bool settle_while(const Is_due& is_due);
  void recheck(std::span<const Entry> entries);
  bool fails_before(const Entry& entry, const Time& time) const;
  void execute_due_events();
  std::size_t step_until(const Time* until);
  std::size_t step_in_parts(const Time* until);
  std::size_t run_to(const Time& time, const std::function<bool()>& may_go_on);
  std::size_t run_instant();
  void join_parts();
  void show_current_time();
  void execute(const Entry& event);
  void count_event(Event_kind kind);
  const Edge& hull_triangle(const Two_sided_edge& hull_edge) const;
  bool is_touch(Face_handle face) const;
  bool do_corners_meet(Face_handle face) const;
  bool may_hide_a_turn(const Two_sided_edge& hull_edge) const;
  bool are_all_collinear(const Two_sided_edge& hull_edge) const;
  bool can_insert_into_hull(const Two_sided_edge& hull_edge) const;
  void flip_edge(const Two_sided_edge& edge, Event_kind kind);
  static Event flip_event(Event_kind kind, const Edge_ids& removed, const Edge_ids& added);
  static std::pair<Edge_ids, Edge_ids> flipped_edges(const Two_sided_edge& edge);

  struct Location {
    Face_handle face;  // infinite beyond the hull
    typename Triangulation::Locate_type locus = Triangulation::FACE;
    int index = 0;  // of the edge or vertex where the place is on one
  };

  // Where points have weights.
  detail::Hidden_points<Kinetic_triangulation_2, Traits> hidden_points() {
    return detail::Hidden_points<Kinetic_triangulation_2, Traits>(*this);
  }
  detail::Hidden_points<const Kinetic_triangulation_2, Traits> hidden_points() const {
    return detail::Hidden_points<const Kinetic_triangulation_2, Traits>(*this);
  }
  std::vector<Vertex_handle> take_hidden_at(const Edge& edge);
  static bool have_equal_weights(std::span<const Point_2> points);
  void check_turns_are_new(std::span<const Change> changes, std::span<const Change> turns) const;
  void note_weights(std::span<const Change> changes);
  bool retry_postponed();
  void flip_or_hide(const Two_sided_edge& edge);

  // Instants that flips alone do not pass.
  void set_coincident_points_aside();
  void put_points_back();
  void rebuild();
  template <class Change_vertices>
  void rebuild(Change_vertices change_vertices,
               std::optional<Triangulation> rebuilt = std::nullopt);
  bool has_flat_triangle() const;
  void adopt(Triangulation rebuilt);
  void report_rebuild();
  void report_rebuilt_points();
  void report_hiding();
  template <class Change_edges>
  void report(Event event, Change_edges change_edges);

  // Changes of single points.
  /// A point that leaves its triangles, comes or goes.
  struct Jump {
    Change change;
    Location location = {};   // where it comes, in the triangulation before any point jumps
    Vertex_handle near = {};  // a corner there that does not change, if there is one
  };
  /// How changes of points are made.
  struct Change_plan {
    std::vector<Change> turns;             ///< that keep the triangles around them embedded
    std::vector<Jump> jumps;               ///< the others
    std::optional<Triangulation> rebuilt;  ///< where all of it is built anew
  };
  Point_id give_id();
  void change_all(Event_kind kind, std::vector<Change> changes);
  void perform(std::span<const Event> events, std::span<const Change> changes);
  Change_plan plan(std::span<const Change> changes);
  bool are_most(std::size_t points) const;
  void find_turns(std::span<const Change> changes, Change_plan& plan);
  void check_are_distinct(std::span<const Change> changes, std::vector<Jump>& jumps) const;
  void locate_jumps(std::span<const Change> changes, std::span<Jump> jumps) const;
  std::vector<Point_2> points_after(std::span<const Change> changes) const;
  void make_changes(std::span<const Change> changes, Change_plan& plan);
  void make_turns(std::span<const Change> turns);
  bool make_jumps(std::span<const Jump> jumps, bool are_located);
  void set_point(const Change& change);
  bool is_embedded_around(Vertex_handle v) const;
  template <class Is_left_turn>
  bool is_embedded_around(Vertex_handle v, const Double_interval& bounds,
                          const Is_left_turn& is_left_turn) const;
  Location locate(const Point_2& point, Face_handle start) const;
  void take_out(Vertex_handle v);
  std::vector<Two_sided_edge> remove_from_faces(Vertex_handle v, std::vector<Face_handle>& faces);
  void put_in(Vertex_handle v, const Location& location,
              Certificate_state state = Certificate_state::any);
  std::vector<Two_sided_edge> list_inside(std::span<const Edge> polygon,
                                          std::vector<Face_handle>& faces);
  void flip_link(Vertex_handle v);
  void replace_in_faces(Vertex_handle old, Vertex_handle replacement);
  void unschedule_face(Face_handle face);
  void unschedule_around(Vertex_handle v);
  void unschedule_around(Vertex_handle v, std::vector<Two_sided_edge>& edges,
                         Triangulation_counters& counters);
  void schedule_around(Vertex_handle v, Certificate_state state = Certificate_state::any);
  void note_edges_at(Vertex_handle v, int change);

  struct Point_set_aside {
    Vertex_handle vertex;
    Vertex_handle companion;  // where to look for its place: was in the same one
  };

  Traits traits_;
  mutable Time current_time_;
  /// Where the present time has not been made yet: the certificate that failed then, and bounds of
  /// the time. The points must stay what they are until the time is made or another time comes.
  /// None when a public function returns or an observer is called: const functions change nothing.
  mutable std::optional<std::pair<Certificate_points, Double_interval>> pending_time_;
  Instant_clock clock_;  // of the triangulation's predicates
  Triangulation triangulation_;
  std::vector<Vertex_handle> vertices_;  // by point id; none where the point has been erased
  std::size_t number_of_points_ = 0;
  Queue_policy queue_policy_{*this};
  detail::Divided_scheduler<Entry, Queue_policy> queue_{queue_policy_};
  detail::Region_division division_;  // of the vertices, while the queue is in parts
  std::size_t threads_ = 1;           // of advance_to; 0: those of oneTBB's arena
  Certificate_counters certificate_counters_;
  detail::Observer_list<Observer> observers_;
  std::vector<Point_set_aside> points_set_aside_;
  /// Whether all weights are equal at all times, as without weights: then the triangulation is the
  /// Delaunay triangulation, and no point is hidden.
  bool weights_are_equal_ = true;
  std::vector<Edge_ids> postponed_;  // edges whose certificates fail now, but cannot be flipped yet
  std::uint64_t changes_ = 0;        // of the triangulation, to see that something has happened
  std::uint64_t changes_before_retry_ = 0;
  /// Present while changes of edges are noted, not reported.
  std::optional<detail::Edge_changes> rebuilt_edges_;
  std::vector<std::pair<Point_id, bool>> rebuilt_points_;  // meanwhile hidden (true) and revealed
  std::vector<Point_id> moved_hidden_;   // hidden points that may have other triangles since then
  std::uint64_t events_in_instant_ = 0;  // of the last run_instant
  bool hull_is_flat_ = false;            // at the present time
  bool is_changing_ = false;             // a function that changes this runs
  bool is_in_event_ = false;             // and stays so if an observer throws
  Triangulation_counters counters_;
  Construction_seconds construction_seconds_;
};

extern template class Kinetic_triangulation_2<Linear_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Disc_kinetic_traits_2>;
extern template class Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_KINETIC_TRIANGULATION_2_H
