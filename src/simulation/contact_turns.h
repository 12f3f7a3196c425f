// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts in a run by regions (docs/PARALLEL.md): what Region_run asks of turns.
//
// Which pairs are watched. In a window of time these are the pairs of discs with an edge between
// them, and no others. That is enough as long as no two discs meet but those that have just
// touched: else a disc that meets two could be between them (docs/MATH.md, section 17). Two discs
// *meet* if they overlap or, where they have radii of their own, touch. So a window begins where no
// discs meet; a contact after which a disc meets another one than that which it touched is left to
// the plain loop; and where a window ends, the pairs that still meet are noted, as the plain loop
// does at each contact. Pairs that a response has let pass, and that have parted, are put aside for
// a window, since the plain loop knows of them up to the next contact of one of the two, which is
// left to it.
//
// Discs that pass through each other (log_contact) overlap for long, so that no window could begin:
// the plain loop runs. It also executes contacts that erase discs.
//
// Discs with radii of their own may be inside of others, and hidden. Here all radii are positive;
// no disc is hidden; and the centre of a disc that turns is in its own power cell, since it is in
// no other disc. Two that meet keep their edge: its flip is left to the plain loop.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_TURNS_H
#define KINETRI_SRC_SIMULATION_CONTACT_TURNS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/simulation/simulation_2.h"
#include "triangulation/regions.h"

namespace kinetri::detail {

/// The turns of a simulation. Functions that are given a node's entries or points may be called by
/// several threads, for different nodes of one level.
template <class Traits>
class Contact_turns {
 public:
  static constexpr bool exist = true;
  using Core = Simulation_core<Traits>;                    ///< of the simulation
  using Entry = Contact_entry;                             ///< of the queue of contacts and changes
  using Queue = typename Contact_schedule<Traits>::Queue;  ///< that queue
  using Part = typename Queue::Part;                       ///< of the queue
  using Time = Algebraic_number;                           ///< of contacts
  using Change = Point_change<typename Traits::Motion>;    ///< of a point
  using Points = std::span<const Point_id>;                ///< some points

  /// The simulation must outlive this object.
  explicit Contact_turns(Core& core)
      : core_(&core),
        geometry_(&core.geometry),
        records_(&core.records),
        schedule_(&core.schedule),
        tracker_(&core.tracker) {}

  /// A run of the simulation by regions.
  static auto run_of(Core& core, const Region_options& options) {
    return region_run_of(core.triangulation, options, Contact_turns(core));
  }

  /// Counts of contacts that were discarded.
  struct Discarded {
    std::uint64_t walls = 0;
    std::uint64_t collisions = 0;

    void count(const Entry& entry) {
      if (entry.is_event) ++(entry.kind == Contact_kind::wall ? walls : collisions);
    }
  };

  // ---- what they are ----

  /// Whether contacts can be executed in windows: of walls, and of discs whose response may be
  /// called at any time, by any thread, and is not log_contact or erase_both.
  static bool can_run(const Core& core);
  bool can_run() const { return can_run(*core_); }
  /// Whether discs have contacts.
  bool has_pairs() const { return core_->setup.has_response(); }
  /// Whether discs that meet keep their edge in a window.
  bool keep_edges() const { return has_radii && has_pairs(); }
  /// Whether two discs meet just after `now`, or true if unsure.
  bool do_meet(Point_id a, Point_id b, const Time& now) const;

  // ---- the plain loop ----

  /// Whether something of the queue is due up to a time.
  bool settle(const Time& until) {
    schedule_->settle();
    return !queue().empty() &&
           queue().is_due(queue().top(), until.interval(), [&]() -> const Time& { return until; });
  }
  /// Executes the events of the next time, of the triangulation too. Returns their number.
  std::size_t run_instant(const Time& until) { return core_->loop.step(&until); }
  /// Executes all events up to a time.
  void run_to(const Time& until, const std::function<bool()>& may_go_on) {
    core_->loop.run_to(until, may_go_on);
  }

  // ---- the queue ----

  Queue& queue() { return schedule_->queue(); }  ///< of all entries
  /// Distributes the entries, as Divided_scheduler::distribute says.
  template <class In_parallel>
  void divide(std::size_t count, const In_parallel& in_parallel);
  /// The part in which an entry belongs between two windows.
  std::size_t part_of(const Entry& entry) const {
    return schedule_->policy().part_of(entry.subject());
  }
  /// Whether it is a contact, or else a change.
  static bool is_contact(const Entry& entry) { return detail::is_contact(entry.kind); }
  /// Whether it is a contact whose certificate is to be checked again.
  static bool is_recheck(const Entry& entry) { return is_contact(entry) && !entry.is_event; }
  /// The points of a contact; the second is no_point if it is with a wall.
  static std::array<Point_id, 2> points(const Entry& entry);
  /// Of the event of a contact.
  static Event_kind event_kind(const Entry& entry) {
    return entry.kind == Contact_kind::wall ? Event_kind::wall : Event_kind::collision;
  }
  /// Whether two entries of contacts are about the same.
  static bool are_same(const Entry& a, const Entry& b) {
    return a.kind == b.kind && a.point_a == b.point_a && a.point_b == b.point_b;
  }
  /// The contact of a pair.
  static Entry pair(const Edge_ids& pair);

  /// The handle of the entry of a pair; no_event if there is none.
  Queue_handle handle(const Edge_ids& pair) const { return records_->pair_event(pair); }
  /// Calls `function` with the handles of all contacts of a point that change it.
  template <class Function>
  void for_each_handle(Point_id id, const Function& function) const;
  /// The entry has another handle from now on.
  void set_handle(const Entry& entry, Queue_handle handle) {
    schedule_->policy().set_handle(entry.subject(), handle);
  }
  /// The entry has come, under this handle.
  void note(const Entry& entry, Queue_handle handle) {
    records_->add_event(entry.subject(), handle);
  }
  /// The entry has gone.
  void forget(const Entry& entry) { records_->forget_event(entry.subject()); }

  // ---- contacts ----

  /// The new motions that a contact at `now` gives its points. None where what it does is for the
  /// plain loop, which may throw then. Changes nothing.
  std::vector<Change> changes(const Entry& entry, const Time& now) const;
  /// The entry of what the given one is about, and its certificate after a time.
  std::pair<Entry, Certificate> certificate(const Entry& entry, const Time& after,
                                            Certificate_counters& counters) const;
  /// Calls put(entry, certificate) with all contacts of points that may have some in a window, one
  /// or two points, from `now` on: those with walls, and those of their edges.
  template <class Put>
  void for_each_contact(Points points, const Time& now, Certificate_counters& counters,
                        const Put& put) const;
  /// Makes the certificates of points that have turned at `now`, in a contact of `points`. Returns
  /// false where discs meet that have not just touched, or may do so unnoticed.
  bool certify(const std::array<Point_id, 2>& points, Points turned, const Time& now,
               Certificate_counters& counters,
               std::vector<std::pair<Entry, Certificate>>& result) const;

  // ---- windows ----

  /// Whether a window may begin, up to whose beginning nothing happens; makes it ready.
  bool begin_window(double begin);
  /// Notes what the plain loop is to know of a contact of the window that has ended.
  void end_turn(const std::array<Point_id, 2>& points);
  /// To be called after each window.
  void end_window();
  /// Finds overlaps and schedules contacts anew, at any time between two events. Keeps the changes
  /// that are scheduled.
  void start_anew();
  /// Counts contacts, each without another event at its time.
  void count(std::uint64_t contacts);
  /// Counts certificates of contacts.
  void count(const Certificate_counters& counted);
  /// Counts contacts that were discarded.
  void count(const Discarded& discarded);

 private:
  static bool is_one(Points some, Point_id id) { return std::ranges::find(some, id) != some.end(); }
  bool is_centre_in(Point_id id, Point_id other, const Time& now) const;
  bool have_areas();
  bool drop_overlaps(const Time& time);
  void put_passes_back();

  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;

  Core* core_;
  const Disc_geometry<Traits>* geometry_;
  Contact_records* records_;
  Contact_schedule<Traits>* schedule_;
  Overlap_tracker<Traits>* tracker_;
  std::uint32_t scheduled_ = 0;                // changes before the window
  std::vector<Edge_ids> passes_ = {};          // put aside
  std::unordered_set<Point_id> passing_ = {};  // their points
  bool have_areas_ = false;                    // whether all radii are positive
  std::optional<std::uint64_t> changes_ = {};  // how many there had been when that was so
};

/// A run of a simulation by regions.
template <class Traits>
auto region_run_of(Simulation_2<Traits>& simulation, const Region_options& options = {}) {
  return Contact_turns<Traits>::run_of(Core_access::core(simulation), options);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_TURNS_H
