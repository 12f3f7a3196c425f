// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving points in a box, with discs about them that collide: a kinetic triangulation, and the
// contacts that change its motions.
//
// The triangulation's events have a queue of their own. This one holds, for each point, the next
// wall that it reaches; for each pair of discs that may touch next, their contact; and changes of
// points that were scheduled.
//
// Which pairs these are follows from the triangulation. The points in a disc are connected by edges
// inside of it. So two discs of equal diameter that come into contact are neighbors, or there is a
// disc that overlaps both and is a neighbor of one (docs/MATH.md, section 8). Of discs of any radii
// that is true of the regular triangulation, but for the last condition; a hidden point of radius 0
// is watched with the corners of the triangle that hides it. The pairs that overlap are kept. The
// simulation follows the edges as an observer of the triangulation.
//
// With several threads `advance_to` runs by regions (detail/contact_runs.h), contacts and
// all, unless an observer looks on. Where nothing but changes is
// scheduled, what happens to the triangulation changes nothing in the queue, and it runs up to the
// first entry by itself.
//
// One contact's way through the code: `step` lets the triangulation execute what is before it, in
// exact order; `execute_due_entries` takes it out of the queue; `changes_of` finds the motions
// after it; `change` hands these to the triangulation, which reports the event, and schedules the
// contacts of the points anew.
#ifndef KINETRI_SIMULATION_SIMULATION_2_H
#define KINETRI_SIMULATION_SIMULATION_2_H

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/flag_while.h"
#include "kinetri/impl/events/divided_scheduler.h"
#include "kinetri/impl/events/event_scheduler.h"
#include "kinetri/impl/events/observer_list.h"
#include "kinetri/kinetic/contact_kinetic_traits_2.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/simulation/overlap_observer.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/simulation/simulation_snapshot.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

namespace detail {

template <class Simulation>
class Contact_turns;
template <class Simulation>
struct Contact_runs;

}  // namespace detail

/// A contact that no response can deal with.
class Contact_error : public Error {
 public:
  /// About the contact of the point, with the message that what() gives.
  Contact_error(Point_id point, const std::string& message) : Error(message), point_(point) {}
  /// The point; of two, the one with the smaller id.
  Point_id point() const noexcept { return point_; }

 private:
  Point_id point_;
};

/// Contacts that do not end: more at one time than allowed; or a point that is pressed against a
/// wall or another point, so that no new velocity separates them. The contact has not been executed
/// and is still to come, at the present time: until it is, the simulation is as between two events,
/// and its snapshot too. Other motions of its points may let the run go on.
class Endless_contacts_error : public Contact_error {
 public:
  using Contact_error::Contact_error;
};

/// After a contact, a place, velocity or acceleration is beyond the range of binary64.
class Contact_overflow_error : public Contact_error {
 public:
  using Contact_error::Contact_error;
};

/// Discs overlap at the start, or where one is inserted, and the options refuse that.
class Overlapping_discs_error : public Error {
 public:
  /// About the pairs, with the message that what() gives.
  Overlapping_discs_error(std::vector<Edge_ids> pairs, const std::string& message)
      : Error(message), pairs_(std::move(pairs)) {}
  /// All pairs that overlap, sorted. The id of an inserted point is the one that it would have got.
  const std::vector<Edge_ids>& pairs() const noexcept { return pairs_; }

 private:
  std::vector<Edge_ids> pairs_;
};

/// The radius of a disc is negative at the start, or where it is inserted or gets another motion;
/// or it shrinks, and would be negative after a time that the simulation was to pass.
class Negative_radius_error : public Error {
 public:
  /// About the radius of the point after the time, with the message that what() gives.
  Negative_radius_error(Point_id point, Algebraic_number time, const std::string& message)
      : Error(message), point_(point), time_(std::move(time)) {}
  /// The id that the point has, or would have got.
  Point_id point() const noexcept { return point_; }
  /// The time, exactly: at or just after it the radius is negative.
  const Algebraic_number& time() const noexcept { return time_; }

 private:
  Point_id point_;
  Algebraic_number time_;
};

/// A point is outside of the box at the start, or when it is inserted or given another motion.
class Outside_box_error : public Error {
 public:
  /// About the point, with the message that what() gives.
  Outside_box_error(Point_id point, const std::string& message) : Error(message), point_(point) {}
  /// The id that the point has, or would have got.
  Point_id point() const noexcept { return point_; }

 private:
  Point_id point_;
};

/// The simulation. Points have the common radius of the options; motions that have a radius
/// (HasWeight) are discs of that radius, which may differ and grow, and the triangulation is the
/// regular one. At each time first the triangulation's own events are executed, then contacts
/// with walls, by point id, then those of discs, by ids, then changes that were scheduled.
///
/// A reflection or response gives a point a new motion whose place is that of the old one at the
/// binary64 number nearest to the time, rounded (see `with_velocity_at`); where that would be
/// outside of the box at the time itself, it is moved onto its inner side, by the least binary64
/// step that is certain to do it. So points are never outside of the box, exactly, and everything
/// else happens exactly for the motions as they are.
///
/// Functions that are not const change the simulation, except set_threads and those that remove
/// observers. They throw Precondition_error if they are called while another one of them runs: by
/// an observer, a response, or the function `may_go_on`. Only changes may be scheduled within an
/// event (see below). All of these functions throw Precondition_error when an observer has thrown
/// within an event, or an exception (Contact_error, or one of a response) has left the simulation
/// within a contact: make another one then, or restore a snapshot. Until then only what is const
/// may be called.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Simulation_2 : private Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what a simulation owns
  using Motion = typename Traits::Motion;                 ///< of the traits
  using Point_2 = typename Traits::Point_2;               ///< of the traits
  using Time = Algebraic_number;                          ///< of events
  using Observer = Event_observer;                        ///< what add_observer takes
  using Snapshot = Simulation_snapshot<Traits>;           ///< what snapshot() gives

  /// Throws Precondition_error where an option has no meaning: a box without area, or not finite;
  /// a radius that is negative or not finite; collisions of discs without a radius; a box that is
  /// not wider than a disc whose rim touches it; masses that are not positive and finite, or
  /// another number of masses than of points. Throws Outside_box_error if a point is outside of the
  /// box at the start, and as the constructor of the triangulation. Cost: that of the
  /// triangulation, and a contact certificate for each edge and wall.
  Simulation_2(const std::vector<Motion>& motions, const Simulation_options& options,
               const Time& start = Time(), const Traits& traits = Traits());

  /// The simulation of the snapshot. It goes on as the simulation that the snapshot was taken of:
  /// the same events, with the same numbers, for the same calls. The response is what that
  /// simulation had, since a function cannot be kept. Counters go on, except those of the queues.
  ///
  /// Throws Snapshot_error if the snapshot is not the state of a simulation. Precondition: there is
  /// a response if there was one. Cost: that of the triangulation, and a contact certificate for
  /// each edge and wall.
  static Simulation_2 restore(const Snapshot& snapshot, Collision_response response,
                              const Traits& traits = Traits()) {
    return Simulation_2(Restoration(), snapshot, std::move(response), traits);
  }

  Simulation_2(const Simulation_2&) = delete;
  Simulation_2& operator=(const Simulation_2&) = delete;

  // ---- the present ----

  /// The triangulation, to look at. Time advances here.
  const Triangulation& triangulation() const { return triangulation_; }
  /// The time just after which the triangulation is Delaunay now.
  const Time& current_time() const { return triangulation_.current_time(); }
  /// The box and the discs, as given to the constructor or held by the snapshot, with the present
  /// masses.
  const Simulation_options& options() const { return options_; }
  /// The mass of a point: as given, or 1.
  double mass(Point_id id) const { return id < options_.masses.size() ? options_.masses[id] : 1; }

  /// The whole state but the response and the observers, to be restored later or elsewhere; see
  /// Simulation_snapshot. O(n). Precondition: not within an event or an instant: not called by an
  /// observer or a response, nor after an exception has left the simulation there (checked).
  Snapshot snapshot() const;

  // ---- time ----

  /// Goes to the time of the next event and executes all events of that time, contacts included.
  /// Returns their number; 0 if there is no next event. Throws Endless_contacts_error before
  /// the contact that it names. After another Contact_error the simulation is left within the
  /// contact, and cannot go on. Throws Negative_radius_error instead of
  /// passing the time at which a radius that shrinks is 0; change that motion then, or erase the
  /// point, to go on.
  std::size_t step() { return checked_step(nullptr); }

  /// As step(), but only if the next event is at or before `until`; else nothing happens.
  std::size_t step(const Time& until) { return checked_step(&until); }

  /// Goes to `time`: every event at or before it has happened. Returns the number of events. The
  /// result, exceptions included, is that of step(time) until there is none, and then of time
  /// passing. Precondition: time >= current_time().
  std::size_t advance_to(const Time& time) { return advance_to(time, nullptr); }

  /// As advance_to(time), but asks `may_go_on` at first and then again and again: not less often
  /// than at every second time at which something changes, or in a run by regions (set_threads) in
  /// each window of time. Where it returns false, nothing more happens: current_time() is the time
  /// of the last event. It may call current_time(), and current_time() and counters() of
  /// triangulation(), and no other function of this object.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);

  /// How many threads advance_to may use from now on: 1, as at first, or more, or those of oneTBB's
  /// arena if 0. They share the work, contacts included, where set_threads of the triangulation
  /// says so, there is no overlap observer, and a response of the user is said to be pure
  /// (Simulation_options::response_is_pure). One thread does everything with log_contact or
  /// erase_both, and while discs overlap that collide. The result is the same. An error that an
  /// observer throws then leaves the simulation as it is some events later.
  void set_threads(std::size_t most) {
    threads_ = most;
    triangulation_.set_threads(most);
  }

  // ---- changing points ----

  /// @{
  /// Changes a point at current_time(), as the functions of the triangulation of these names do.
  /// Precondition: triangulation().contains(id); the mass is positive and finite. With a box, the
  /// point must be inside the box now; throws Outside_box_error if it is not.
  Point_id insert(const Motion& motion, double mass = 1);
  void set_motion(Point_id id, const Motion& motion);
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);
  void erase(Point_id id);
  /// @}

  /// Gives the points `ids` these velocities from now on. Each goes on from its place now, rounded
  /// and kept inside of the box as after a contact; see `with_velocity_at`. All or nothing, and one
  /// set_motions. Throws Contact_overflow_error if a place is beyond the range of binary64, and
  /// what set_motions throws. Precondition: as many velocities as ids; each id is contained, and
  /// named once; the velocities are finite.
  void set_velocities(std::span<const Point_id> ids, std::span<const Vector_2> velocities);

  /// Gives a point another mass from now on. Precondition: triangulation().contains(id); the mass
  /// is positive and finite.
  void set_mass(Point_id id, double mass);

  /// @{
  /// Schedules a change at `time`, after the triangulation's events and the contacts of that time.
  /// Changes of one time are made in this order: erasures, new motions, insertions; each by point
  /// id, then in the order in which they were scheduled. New motions of several points are one
  /// set_motions. A change of a point that is not there then
  /// is dropped. A change that leads out of the box, or to the trajectory of a point that keeps it
  /// at that time, is dropped too: the call that has reached its time throws what the functions
  /// above throw, and the next call goes on with the remaining changes. An observer may schedule
  /// changes within an event if it looks at the triangulation
  /// (Event_observer::looks_at_triangulation; checked by advance_to); so may a response that is not
  /// pure (Simulation_options::response_is_pure). Precondition: time >= current_time(); the motion
  /// is finite; the id has been given or reserved; the mass is positive and finite. schedule_insert
  /// returns the id that the point will have.
  Point_id schedule_insert(const Time& time, const Motion& motion, double mass = 1);
  void schedule_motion(const Time& time, Point_id id, const Motion& motion);
  void schedule_erase(const Time& time, Point_id id);
  /// @}

  // ---- watching ----

  /// @{
  /// The functions of the triangulation of these names. Contacts are events of the kinds wall and
  /// collision; the motions change between `before_event` and `after_event`.
  void add_observer(Observer& observer) {
    check_may_change();
    triangulation_.add_observer(observer);
    observers_.push_back(&observer);
  }
  void remove_observer(Observer& observer) {
    triangulation_.remove_observer(observer);
    std::erase(observers_, &observer);
  }
  /// @}

  /// The points whose discs overlap that of the point just after the current time, exactly; sorted.
  /// Precondition: there is a response, since without one overlaps are not followed;
  /// triangulation().contains(id). Cost: an exact predicate for each disc that overlaps or almost
  /// does.
  std::vector<Point_id> overlapping_discs(Point_id id) const;

  /// @{
  /// Has the observer told of changes of points; it must outlive this object or be removed, which
  /// it may do when it is called.
  void add_overlap_observer(Overlap_observer& observer) {
    check_may_change();
    overlap_observers_.add(observer);
  }
  void remove_overlap_observer(Overlap_observer& observer) { overlap_observers_.remove(observer); }
  /// @}

  /// Counts of contacts since the start, those of the snapshot included; of the queue since this
  /// object was made.
  Contact_counters contact_counters() const;
  /// The present number of entries in the queue of contacts and scheduled changes, which is apart
  /// from that of the triangulation: contacts, and times up to which there certainly is none; at
  /// most one for each point, one for each edge, and one for each change. O(1).
  std::size_t queue_size() const noexcept { return queue_.size(); }
  /// How many contacts of discs, since this object was made, have left both discs their motions: of
  /// log_contact all, of other responses those whose discs pass through each other. O(1).
  std::uint64_t number_of_passes() const noexcept { return passes_; }
  /// Counts of certificates, those of topology and of contacts together.
  Certificate_counters certificate_counters() const;

  /// Audits the triangulation up to `level`, and from the level `links` on the queue of contacts;
  /// from `delaunay` on that no point is outside of the box, and that no two discs overlap and
  /// approach each other unless a response has let them pass; from `certificates` on every contact
  /// is computed anew. All of it exactly, just after now.
  Audit_report audit(Audit_level level) const;

  /// Whether the simulation is valid: audit() up to the level `links` if `level` is 0, else up to
  /// `delaunay`. Prints what is wrong to std::cerr if `verbose`.
  bool is_valid(bool verbose = false, int level = 0) const {
    return detail::is_passed(audit(level > 0 ? Audit_level::delaunay : Audit_level::links),
                             verbose);
  }

 private:
  friend class detail::Contact_turns<Simulation_2>;
  friend struct detail::Contact_runs<Simulation_2>;

  /// In the order in which they are executed at one time. A contact of discs that is not noted
  /// comes before those that are.
  enum class Entry_kind : std::uint8_t { wall, collision, erase, trajectory, insert, vanish };

  /// Whether discs have radii of their own.
  static constexpr bool has_radii = HasWeight<Motion>;

  static bool is_contact(Entry_kind kind) { return kind <= Entry_kind::collision; }
  static bool is_change(Entry_kind kind) { return !is_contact(kind) && kind != Entry_kind::vanish; }

  /// What an entry is about.
  struct Subject {
    Entry_kind kind = Entry_kind::wall;
    Point_id point_a = no_point;
    Point_id point_b = no_point;
  };

  /// A contact, or a time up to which there certainly is none; or a change that was scheduled; or
  /// the time at which the radius of a disc is 0.
  struct Entry : detail::Scheduled {
    Entry_kind kind = Entry_kind::wall;
    bool is_event = false;
    bool is_edge = false;   // whether there is an edge between two discs, if they ever touch
    bool is_noted = false;  // whether the overlap that begins with the contact is known already
    Point_id point_a = no_point;
    Point_id point_b = no_point;  // of a wall, which of the four; of a change, its number

    /// What an entry says besides its subject and its times. A subject does not name the wall.
    struct Kept {
      bool is_event = false;  ///< a contact, not a time to check again
      bool is_edge = false;   ///< as the entry has it
      std::uint8_t wall = 0;  ///< which of the four; 0 for a contact
    };

    Entry() = default;
    /// The entry of a subject, without the exact time.
    Entry(const Subject& subject, const Double_interval& times, const Kept& kept)
        : detail::Scheduled{times},
          kind(subject.kind),
          is_event(kept.is_event),
          is_edge(kept.is_edge),
          point_a(subject.point_a),
          point_b(subject.kind == Entry_kind::wall ? kept.wall : subject.point_b) {}

    Kept kept() const { return {is_event, is_edge, static_cast<std::uint8_t>(point_b & 3U)}; }
    Subject subject() const { return {kind, point_a, point_b}; }
  };

  /// A scheduled change that is not in the queue any more; the motion is the one that it gives.
  struct Due_change {
    Entry entry;
    std::optional<Motion> motion;
  };

  /// What the scheduler asks; see Event_scheduler and Divided_scheduler.
  struct Queue_policy {
    Simulation_2& simulation;

    Time entry_time(const Entry& entry) const;
    bool precedes(const Entry& a, const Entry& b) const;
    bool is_recheck(const Entry& entry) const;
    static void prefetch(const Entry&) {}
    static void prefetch_more(const Entry&) {}
    static void prefetch_first(const Entry&) {}
    std::size_t part_of(const Subject& subject) const;
    Queue_handle handle(const Subject& subject) const;
    void set_handle(const Subject& subject, Queue_handle handle) const;
  };

  /// A change that was scheduled; the motion is the one that it gives.
  struct Scheduled_change {
    std::optional<Motion> motion;
    Queue_handle event = no_event;
  };

  /// A disc that may come into contact.
  struct Partner {
    Point_id id;
    Queue_handle event;
  };

  /// A disc that overlaps, or almost does, or has overlapped until a short time ago.
  struct Overlap {
    Point_id id;
    bool passes;  // a response has let the two pass: they have no contact until they have separated
    bool is_edge;  // whether there is an edge between the two, if they do overlap now
  };

  /// The entries of a point in the queue, and its overlaps. Of each pair both points have a record.
  struct Contacts {
    Queue_handle wall_event = no_event;
    Queue_handle vanish_event = no_event;
    std::vector<Partner> partners;
    std::vector<Overlap> overlaps;  // all those of the present time, and perhaps others
    std::vector<Point_id> corners;  // that the point is linked with; see for_each_corner
  };

  const Point_2& point(Point_id id) const { return triangulation_.vertex(id)->point(); }
  std::string options_problem() const;
  void make_walls();
  void keep_mass(Point_id id, double mass);
  template <class Insert>
  void insert_checked(const Motion& motion, Point_id id, Insert insert);
  struct Restoration {};
  Simulation_2(Restoration, const Snapshot& snapshot, Collision_response response,
               const Traits& traits);
  void restore_contacts(const Snapshot& snapshot);
  void restore_changes(const Snapshot& snapshot);

  // Scheduling.
  Queue_handle push(Entry entry, Certificate certificate);
  void schedule_single(Point_id id, const Time& after);
  void schedule_vanishing(Point_id id);
  void schedule_wall(Point_id id, const Time& after);
  std::pair<Entry, Certificate> first_wall(Point_id id, const Time& after,
                                           Certificate_counters& counters) const;
  void unschedule_wall(Point_id id);
  void schedule_pair(const Edge_ids& pair, bool is_edge, const Time& after);
  bool schedule_new_pair(const Edge_ids& pair, bool is_edge, const Time& after);
  void push_pair(const Edge_ids& pair, bool is_edge, Certificate certificate);
  Certificate pair_certificate(const Edge_ids& pair, const Time& after, const Traits& traits) const;
  void unschedule_pair(const Edge_ids& pair);
  void schedule_pairs(std::span<const Point_id> points);
  void schedule_edges(Point_id id, std::span<const Point_id> points);
  void schedule_pairs_beside(Point_id id);
  void schedule_all();
  void schedule_all_walls();
  void schedule_all_pairs();
  template <class Made, class Make>
  std::vector<Made> make_for_edges(const Make& make) const;
  void unschedule_single(Point_id id);
  void unschedule_pairs(Point_id id);
  void discard(Queue_handle handle);
  Entry pop();
  void forget(const Entry& entry);
  Queue_handle forget_pair(const Edge_ids& pair);
  Queue_handle forget_partner(Point_id id, Point_id other);
  void note(const Subject& subject, Queue_handle handle);
  template <class Function>
  void for_each_neighbor(Point_id id, Function function) const;

  // Points of radius 0 that are hidden.
  bool is_without_area(Point_id id) const;
  template <class Function>
  void for_each_corner(Point_id id, Function function) const;
  template <class Function>
  void for_each_hidden_link(Point_id id, Function function) const;
  std::vector<Point_id> corners_of(Point_id id) const;
  void after_hiding(const Time& time, std::span<const Point_id> points) override;
  void follow_links(Point_id id, const Time& after);
  void keep_links();

  // The contacts of points.
  Contacts* find_contacts(Point_id id) const {
    return id < contacts_.size() ? contacts_[id].get() : nullptr;
  }
  Contacts& contacts_of(Point_id id);

  // Overlaps, and the pairs that are watched because of them.
  const std::vector<Overlap>& overlaps(Point_id id) const;
  const Overlap* find_overlap(const Edge_ids& pair) const;
  Queue_handle find_pair(const Edge_ids& pair) const;
  std::vector<Point_id> overlapping_points(Point_id id, const Traits& traits) const;
  bool is_edge(const Edge_ids& pair) const;
  bool is_watched(const Edge_ids& pair) const;
  bool is_overlapped(const Edge_ids& pair) const;
  void watch(const Edge_ids& pair, bool is_edge, const Time& after);
  void watch_unless_changing(const Edge_ids& pair, bool is_edge, const Time& after);
  bool is_changing(const Edge_ids& pair) const;
  void unwatch(const Edge_ids& pair);
  template <class Function>
  void for_each_pair_beside(Point_id a, Point_id b, bool is_edge, Function function) const;
  template <class Counts, class Function>
  void for_each_pair_of(Point_id first, const Counts& counts, Function function) const;
  template <class Function>
  void for_each_pair_over(const Edge_ids& edge, Function function) const;
  bool is_hidden(Point_id id) const;
  bool may_touch(Point_id a, Point_id b, const Traits& traits) const;
  bool may_touch(Point_id a, Point_id b, const Traits& traits, const Time& time) const;
  void find_all_overlaps();
  bool do_overlap(const Point_2& p, const Point_2& q) const;
  void refuse_overlaps() const;
  void refuse_overlaps_of(const Point_2& p) const;
  void refuse(std::vector<Edge_ids> pairs) const;
  void drop_overlaps(Point_id id);
  void start_overlap(Point_id a, Point_id b, bool is_edge);
  template <class Amend>
  void amend_overlap(const Edge_ids& pair, const Amend& amend);
  void end_overlap(Point_id a, Point_id b);
  void mark_passing(Point_id a, Point_id b, bool passes);
  void let_pass(Point_id a, Point_id b, bool is_edge);
  void end_passes(Point_id id);
  bool is_passing(Point_id a, Point_id b);
  void update_overlaps(std::span<const Point_id> points);
  void find_new_overlaps_of(Point_id id);
  template <HasWeight M = Motion>
  void find_new_overlaps(std::span<const Point_id> points);
  template <HasWeight M = Motion>
  void find_overlaps_of_seeds(std::span<const Point_id> points);
  template <HasWeight M = Motion>
  bool is_seed(Point_id id) const;
  void keep_seeds();
  template <HasWeight M = Motion>
  std::vector<Point_id> discs_about(std::span<const Point_id> points) const;
  template <HasWeight M = Motion>
  std::vector<Point_id> owners_in(Point_id id) const;
  template <HasWeight M = Motion>
  Point_id owner_of_centre(Point_id id) const;
  template <class Function>
  void for_each_close_pair(std::span<const Point_id> ids, Function function) const;
  std::vector<Point_id> present_points() const;
  template <class Function>
  void for_each_exact_overlap(Function function) const;

  // Calls within calls.
  void check_may_change() const;
  void check_is_whole() const;
  [[nodiscard]] detail::Flag_while start_change() {
    check_may_change();
    return detail::Flag_while(is_changing_);
  }

  // Events.
  std::size_t checked_step(const Time* until) {
    const detail::Flag_while changing = start_change();
    return step(until);
  }
  std::size_t step(const Time* until);
  std::size_t step_in_parts(const Time* until);
  void join_parts();
  void join_parts_of_contacts();
  bool may_be_due(const Time& time);
  bool may_run_by_regions() const;
  bool can_run_triangulation() const;
  bool run_triangulation(const Time& until, const std::function<bool()>& may_go_on,
                         std::size_t& events);
  void settle();
  void recheck(const Entry& entry);
  std::size_t execute_due_entries();
  void execute_due_entries(std::vector<Due_change>& postponed);
  bool is_contact_due();
  bool note_contact(const Entry& contact);
  void check_limit(const Entry& entry, std::uint64_t turning) const;
  [[noreturn]] void refuse_press(Point_id id, const std::string& who, const std::string& remedy,
                                 const Time& now) const;
  using Change = typename Triangulation::Change;
  void execute_contact(const Entry& contact, std::uint64_t& turning);
  std::vector<Change> changes_of(const Entry& contact, std::uint64_t& turning);
  void hit_wall(Point_id id, std::span<const Change> changes);
  Change reflection(Point_id id, std::size_t wall, const Time& now) const;
  void collide(Point_id a, Point_id b, bool is_edge, std::span<const Change> changes);
  std::vector<Change> collision(Point_id a, Point_id b, const Time& now) const;
  void schedule(const Time& time, Entry_kind kind, Point_id id,
                const std::optional<Motion>& motion);
  void push_change(const Time& time, Entry entry, const std::optional<Motion>& motion);
  std::optional<Motion> take_scheduled_motion(const Entry& change);
  void execute_change(const Due_change& change);
  bool try_change(const Due_change& change);
  std::vector<Due_change> pop_turns(const Entry& first);
  bool try_turns(std::span<const Due_change> turns);
  void turn(std::span<const Point_id> ids, std::span<const Motion> motions);
  void take_away(Point_id id);
  void check_place(const Point_2& point) const;
  template <HasWeight M = Motion>
  void check_radius(const Point_2& point) const;
  [[noreturn]] void refuse_vanishing(Point_id id, const Time& time) const;
  template <class Make_changes>
  void change(std::span<const Point_id> points, Make_changes make_changes);
  Motion with_velocity(Point_id id, const Vector_2& velocity, const Time& now) const;
  Motion usable(Point_id id, Motion motion, const Time& now) const;
  bool looks_at_triangulation() const override { return false; }  // a run by regions tells it
  void after_event(const Event& event) override;
  void leave_edge(const Edge_ids& edge);
  void follow_edge(const Edge_ids& edge, const Time& after);

  Traits traits_;
  Simulation_options options_;
  double diameter_ = 0;
  std::array<Wall_2, 4> walls_ = {};
  Triangulation triangulation_;
  Queue_policy queue_policy_{*this};
  detail::Divided_scheduler<Entry, Queue_policy> queue_{queue_policy_};
  std::size_t threads_ = 1;  // of advance_to
  Certificate_counters certificate_counters_;
  // By point id; null where the point has none, or has been erased.
  std::vector<std::unique_ptr<Contacts>> contacts_;
  std::unordered_map<std::uint32_t, Scheduled_change> scheduled_changes_;  // by their numbers
  std::uint32_t scheduled_ = 0;                                            // changes so far
  std::size_t scheduled_entries_ = 0;       // of changes, in the queue
  std::vector<const Observer*> observers_;  // but for this object
  detail::Observer_list<Overlap_observer> overlap_observers_;
  std::span<const Point_id> changing_points_;  // of which `change` schedules all contacts anew
  std::vector<Point_id> seeds_;                // discs that may grow from 0 at the present time
  std::uint64_t passes_ = 0;        // contacts at which both discs have kept their motions
  bool is_changing_ = false;        // a function that changes this runs
  bool is_within_instant_ = false;  // and stays so if something throws
  bool is_within_contact_ = false;  // the same
  Contact_counters counters_;       // but for those of the queue
};

extern template class Simulation_2<Linear_kinetic_traits_2>;
extern template class Simulation_2<Polynomial_kinetic_traits_2>;
extern template class Simulation_2<Disc_kinetic_traits_2>;
extern template class Simulation_2<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_2_H
