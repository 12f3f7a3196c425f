// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving points in a box, with discs about them that collide: a kinetic triangulation whose motions
// change at contacts.
//
// The triangulation has its own queue of events. That of the simulation holds for each point the
// next wall that it reaches, for each pair of discs that may touch next their contact, and
// scheduled changes.
//
// The pairs follow from the triangulation (docs/MATH.md, section 8). Two discs of equal diameter
// that come into contact are neighbors, or there is a disc that overlaps both and is a neighbor of
// one, since the points in a disc are connected by edges inside it. The same holds for discs of any
// radii and the regular triangulation, except that the third disc need not be a neighbor; a hidden
// point of radius 0 is watched with the corners of the triangle that hides it. Overlapping pairs
// are stored.
//
// docs/ARCHITECTURE.md follows one contact through the parts (detail::Simulation_core).
#ifndef KINETRI_SIMULATION_SIMULATION_2_H
#define KINETRI_SIMULATION_SIMULATION_2_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/flag_while.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_errors.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

namespace detail {
template <class Traits>
struct Simulation_core;
enum class Contact_kind : std::uint8_t;
}  // namespace detail

/// A snapshot of Simulation_2. It does not include future contacts, because the motions determine
/// them.
template <KineticTraits_2 Traits>
struct Simulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events
  /// What names two discs.
  using Pair = std::conditional_t<PeriodicKineticTraits_2<Traits>, Periodic_edge, Edge_ids>;

  /// A scheduled change of a point that is still to be made.
  struct Change {
    Time time;                                    ///< time of the change
    Event_kind kind = Event_kind::trajectory;     ///< insert, erase or trajectory
    Point_id point = no_point;                    ///< the point; for insert, its future id
    std::optional<Motion> motion = std::nullopt;  ///< the new motion; none for erase
  };

  Triangulation_snapshot<Traits> triangulation;  ///< of the simulation's triangulation
  Simulation_options options;                    ///< without the response
  bool has_response = false;                     ///< whether there was one
  std::vector<Pair> in_contact;   ///< pairs of discs that a response has left in contact; sorted
  std::vector<Change> scheduled;  ///< in the order of the calls that scheduled them
  Contact_counters counters;      ///< without the counters of the queue
  Certificate_counters certificates;  ///< of contacts
};

/// Is called after points of a simulation have changed and their overlaps have been updated. An
/// overlap begins with a contact, which is an event, or with such a change.
class Overlap_observer {
 public:
  virtual ~Overlap_observer() = default;

  /// The points, sorted, have got other motions or have been inserted or erased, at the current
  /// time. All events of the change have been reported, and Simulation_2::overlapping_discs is up
  /// to date. May read the simulation; functions that change it throw Precondition_error.
  virtual void after_change(std::span<const Point_id> points) = 0;

 protected:
  Overlap_observer() = default;
  /// @{
  /// For the copies of derived classes.
  Overlap_observer(const Overlap_observer&) = default;
  Overlap_observer& operator=(const Overlap_observer&) = default;
  /// @}
};

/// The simulation, compiled into the library for its own traits. Points have the common radius of
/// the options; motions with a radius (HasWeight) are discs whose radii may differ and grow, and
/// the triangulation is the regular one. At each time the triangulation's events are executed
/// first, then contacts with walls, by point id, then those of discs, by ids, then scheduled
/// changes.
///
/// After a reflection or response the motion of a point begins at its old position at the binary64
/// number nearest to the time, rounded (see `with_velocity_at`); if that would be outside of the
/// box at the time itself, the position is moved inside by the least binary64 step that is certain
/// to suffice. So points are never outside of the box, exactly, and all events are exact for these
/// motions.
///
/// With PeriodicContactKineticTraits_2 the discs, of one radius or with radii of their own, are in
/// a periodic box, without walls (Simulation_options::box is empty). A contact is then one of a
/// disc and an image of another one: the offset of the image against point_b is added_offset of the
/// event. Points may leave the box, and positions are rounded after contacts as in the plane;
/// nothing is wrapped. All responses work. They are told the position and the velocity of the
/// image, which differs from that of point_b by the rates of the lattice vectors, and a new
/// velocity is one of the image. So elastic collisions conserve momentum, and in a box at rest
/// energy, up to rounding. In a box that moves, images of a disc that is stopped go on: discs that
/// are stopped already pass through each other. An own image stops the run: with a response, or if
/// overlaps are refused, Own_image_error is thrown if a disc, with its own radius, overlaps one at
/// the start, or when it is inserted or gets another motion; and instead of the contact of a disc
/// with one, at the exact time. With a response discs may not coincide for a while:
/// Coincident_trajectories_error, whatever Simulation_options::coincident says. One thread executes
/// the events.
///
/// Functions that are not const change the simulation, except set_threads and those that remove
/// observers. They throw Precondition_error if called while another one of them runs: by an
/// observer, a response, or the stop token `may_go_on`. Within an event only the functions
/// schedule_... may be called (see below). All of these functions throw Precondition_error after an
/// observer has thrown within an event, or an exception (Contact_error, or one of a response) has
/// left the simulation within a contact: then only const functions may be called; construct another
/// simulation, or restore a snapshot.
template <SimulationKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Simulation_2 {
  static_assert(std::same_as<Traits, Linear_kinetic_traits_2> ||
                    std::same_as<Traits, Polynomial_kinetic_traits_2> ||
                    std::same_as<Traits, Disc_kinetic_traits_2> ||
                    std::same_as<Traits, Polynomial_disc_kinetic_traits_2> ||
                    std::same_as<Traits, Periodic_kinetic_traits_2> ||
                    std::same_as<Traits, Periodic_disc_kinetic_traits_2>,
                "Simulation_2 is compiled into the library for six traits: use one of "
                "Linear_kinetic_traits_2, Polynomial_kinetic_traits_2, Disc_kinetic_traits_2, "
                "Polynomial_disc_kinetic_traits_2, Periodic_kinetic_traits_2 and "
                "Periodic_disc_kinetic_traits_2; or Kinetic_triangulation_2, which works with "
                "traits of your own");

 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what a simulation owns
  using Motion = typename Traits::Motion;                 ///< of the traits
  using Point_2 = typename Traits::Point_2;               ///< of the traits
  using Time = Algebraic_number;                          ///< of events
  using Observer = Event_observer;                        ///< what add_observer takes
  using Snapshot = Simulation_snapshot<Traits>;           ///< what snapshot() gives

  /// Throws Precondition_error for invalid options: a box without area, or not finite; a radius
  /// that is negative or not finite; collisions of discs without a radius; a box that is not wider
  /// than a disc whose boundary circle touches it; masses that are not positive and finite, or not
  /// as many as points; a box besides a periodic box. Throws Outside_box_error,
  /// Negative_radius_error, Overlapping_discs_error or Own_image_error if a point, radius, pair of
  /// discs or disc is invalid at the start, and as the constructor of the triangulation. Cost: that
  /// of the triangulation, and a contact certificate for each edge and wall.
  Simulation_2(const std::vector<Motion>& motions, const Simulation_options& options,
               const Time& start = Time(), const Traits& traits = Traits());

  /// The simulation of the snapshot. From here on it behaves exactly like the original: the same
  /// events, with the same numbers, for the same calls. Pass the response of the original, since a
  /// snapshot cannot store a function. Counters continue, except those of the queues.
  ///
  /// Throws Snapshot_error if the snapshot is not the state of a simulation. Precondition: there is
  /// a response if there was one. Cost: that of the triangulation, and a contact certificate for
  /// each edge and wall.
  static Simulation_2 restore(const Snapshot& snapshot, Collision_response response,
                              const Traits& traits = Traits()) {
    return Simulation_2(Restoration(), snapshot, std::move(response), traits);
  }

  ~Simulation_2();
  Simulation_2(const Simulation_2&) = delete;
  Simulation_2& operator=(const Simulation_2&) = delete;

  // ---- the present ----

  /// The triangulation, const: this object advances its time.
  const Triangulation& triangulation() const;
  /// The time just after which the triangulation is Delaunay now.
  const Time& current_time() const { return triangulation().current_time(); }
  /// The options of the constructor or snapshot, with the present masses.
  const Simulation_options& options() const;
  /// The mass of a point: as given, or 1.
  double mass(Point_id id) const;

  /// The whole state except the response and the observers; see Simulation_snapshot. O(n).
  /// Precondition (checked): not called by an observer or a response, nor after an exception has
  /// left the simulation within an event or instant.
  Snapshot snapshot() const;

  // ---- time ----

  /// The time of the next event of the triangulation, contact or scheduled change, or at which a
  /// shrinking radius reaches zero, whichever comes first; empty if nothing will happen. May
  /// recheck certificates, but executes no event. (As for the triangulation there may be no event
  /// then: if points meet, or if another triangle hides a point.) Cost: O(1) besides those
  /// certificates.
  std::optional<Time> next_event_time();

  /// Goes to the time of the next event and executes all events of that time, contacts included.
  /// Returns their number; 0 if there is no next event. Throws Endless_contacts_error or
  /// Own_image_error before the contact that it names. After another Contact_error the simulation
  /// is left within the contact, and cannot continue. Throws Negative_radius_error instead of
  /// passing the time at which a shrinking radius reaches zero; to continue, change that motion or
  /// erase the point.
  std::size_t step();

  /// As step(), if the next event is at or before `until`; else returns 0.
  std::size_t step(const Time& until);

  /// Executes every event at or before `time`, which is then the current time. Returns their
  /// number. The result, exceptions included, is that of step(time) until it returns 0. But in a
  /// periodic box without a response it throws Periodic_box_error, and executes no event, if the
  /// box has no area at a time up to then. Precondition: time >= current_time().
  std::size_t advance_to(const Time& time) { return advance_to(time, nullptr); }

  /// As advance_to(time), but calls the stop token `may_go_on` first and then at least at every
  /// second time with an event or, on several threads, in each time window. If it returns false,
  /// current_time() is the time of the last event. It may call current_time(), and current_time()
  /// and counters() of triangulation(), and no other function of this object.
  std::size_t advance_to(const Time& time, const std::function<bool()>& may_go_on);

  /// The greatest number of threads that advance_to may use from now on; 1 at first; 0 stands for
  /// all of oneTBB's arena. Events, contacts included, are executed in parallel under the
  /// conditions of the triangulation's set_threads, if there is no overlap observer, and a
  /// user-defined response is declared pure (Simulation_options::response_is_pure). The sequential
  /// loop runs with log_contact or erase_both, and while discs that collide overlap. The result is
  /// the same. If an observer throws, later events may have been executed already.
  void set_threads(std::size_t most);

  // ---- changing points ----

  /// @{
  /// Changes a point at current_time(), as the functions of the triangulation of these names do.
  /// Throws Outside_box_error, Negative_radius_error or Own_image_error if the new motion is
  /// invalid now, and insert() Overlapping_discs_error if the options refuse overlaps.
  /// Precondition: triangulation().contains(id); the mass is positive and finite.
  Point_id insert(const Motion& motion, double mass = 1);
  void set_motion(Point_id id, const Motion& motion);
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);
  void erase(Point_id id);
  /// @}

  /// Gives the points `ids` these velocities from now on. Each continues from its present position,
  /// rounded and kept inside the box as after a contact (`with_velocity_at`). All or nothing: one
  /// call of set_motions. Throws Contact_overflow_error if a position is beyond the range of
  /// binary64, and what set_motions throws. Precondition: as many velocities as ids; the ids are
  /// contained and distinct; the velocities are finite.
  void set_velocities(std::span<const Point_id> ids, std::span<const Vector_2> velocities);

  /// Gives a point another mass from now on. Precondition: triangulation().contains(id); the mass
  /// is positive and finite.
  void set_mass(Point_id id, double mass);

  /// @{
  /// Schedules a change at `time`, after the triangulation's events and the contacts of that time.
  /// Changes at one time are made in this order: erasures, new motions, insertions; each by point
  /// id, then in the order in which they were scheduled. New motions of several points are one
  /// set_motions. A change of a point that does not exist then is dropped. So is a change that
  /// leads out of the box, to an overlap with an own image, or to the trajectory of another point:
  /// the call that reaches its time throws what the functions above throw, and the next call
  /// continues with the remaining changes.
  /// An observer may schedule changes within an event if it looks at the triangulation
  /// (Event_observer::looks_at_triangulation; checked by advance_to); so may a response that is not
  /// pure (Simulation_options::response_is_pure). Precondition: time >= current_time(); the motion
  /// is finite; the id has been given, by schedule_insert too; the mass is positive and finite.
  /// schedule_insert returns the id that the point will have.
  Point_id schedule_insert(const Time& time, const Motion& motion, double mass = 1);
  void schedule_motion(const Time& time, Point_id id, const Motion& motion);
  void schedule_erase(const Time& time, Point_id id);
  /// @}

  // ---- watching ----

  /// @{
  /// The functions of the triangulation of these names. Contacts are events of the kinds wall and
  /// collision; the motions change between `before_event` and `after_event`. The queue of contacts
  /// is updated after all events of the triangulation at one time, so within an event it may be out
  /// of date.
  void add_observer(Observer& observer);
  void remove_observer(Observer& observer);
  /// @}

  /// The points whose discs overlap that of the point just after the current time, exactly; sorted.
  /// In a periodic box a point occurs once for each image that overlaps. Precondition: there is a
  /// response, since overlaps are not tracked without one; triangulation().contains(id). Cost: an
  /// exact predicate for each disc that overlaps or almost does.
  std::vector<Point_id> overlapping_discs(Point_id id) const;

  /// @{
  /// The observer is called after changes of points; it must outlive this object or be removed,
  /// which it may do when it is called.
  void add_overlap_observer(Overlap_observer& observer);
  void remove_overlap_observer(Overlap_observer& observer);
  /// @}

  /// Counts of contacts since the start of the run, before a snapshot too; of the queue since this
  /// object was made.
  Contact_counters contact_counters() const;
  /// The present number of entries in the queue of contacts and scheduled changes: contacts, times
  /// at which a certificate must be checked again, and changes. O(1).
  std::size_t queue_size() const noexcept;
  /// The number of non-colliding contacts of discs since this object was made: both discs kept
  /// their motions. O(1).
  std::uint64_t number_of_passes() const noexcept;
  /// Counts of certificates, of the triangulation and of contacts together.
  Certificate_counters certificate_counters() const;

  /// Audits the triangulation up to `level`; from `links` on also the queue of contacts; from
  /// `delaunay` on that no point is outside of the box, and that no two discs overlap and approach
  /// each other unless a response has let them pass; from `certificates` on every contact, computed
  /// anew. All of it exactly, just after now.
  Audit_report audit(Audit_level level) const;

  /// Whether audit() passes, up to the level `links` if `level` is 0, else `delaunay`. Prints
  /// errors to std::cerr if `verbose`.
  bool is_valid(bool verbose = false, int level = 0) const {
    return detail::is_passed(audit(level > 0 ? Audit_level::delaunay : Audit_level::links),
                             verbose);
  }

 private:
  friend struct detail::Core_access;

  struct Restoration {};
  Simulation_2(Restoration, const Snapshot& snapshot, Collision_response response,
               const Traits& traits);
  void restore_contacts(const Snapshot& snapshot);
  void restore_changes(const Snapshot& snapshot);

  void check_may_change() const;
  void check_is_whole() const;
  [[nodiscard]] detail::Flag_while start_change() {
    check_may_change();
    return detail::Flag_while(is_changing_);
  }
  void schedule(const Time& time, detail::Contact_kind kind, Point_id id,
                const std::optional<Motion>& motion);

  std::unique_ptr<detail::Simulation_core<Traits>> core_;
  bool is_changing_ = false;  // a function that changes this runs
};

extern template class Simulation_2<Linear_kinetic_traits_2>;
extern template class Simulation_2<Polynomial_kinetic_traits_2>;
extern template class Simulation_2<Disc_kinetic_traits_2>;
extern template class Simulation_2<Polynomial_disc_kinetic_traits_2>;
extern template class Simulation_2<Periodic_kinetic_traits_2>;
extern template class Simulation_2<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_SIMULATION_2_H
