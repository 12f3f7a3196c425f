// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which contacts are watched in a time window (docs/PARALLEL.md): those of pairs of discs with an
// edge. That suffices while no two discs meet except those that have just touched: else a disc that
// meets two could be between them (docs/MATH.md, section 17). Two discs *meet* if they overlap or,
// with radii of their own, touch. So a window begins only if no discs meet; after a contact a disc
// may only meet the one that it touched, else the sequential loop executes the contact; and at the
// end of a window the pairs that still meet are recorded as overlaps. Pairs that a response has let
// pass, and that have separated, are removed temporarily during a window; the next contact of one
// of the two is left to the sequential loop.
//
// With log_contact discs overlap for long, so that no window could begin: the sequential loop runs.
// It also executes contacts that erase discs.
//
// Discs with radii of their own could be hidden. In a window all radii are positive; no disc is
// hidden; and the center of a disc that gets another velocity is in its own power cell, since it is
// in no other disc. Flips of edges between two discs that meet are left to the sequential loop.
#ifndef KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_H
#define KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::detail {

/// The contacts of a simulation that windows watch, and their certificates. Const functions may be
/// called by several threads.
///
/// Owns the temporarily removed pairs. Invariant: between two windows there are none; in a window
/// no two discs meet except those that have just touched.
template <class Traits>
class Watched_contacts {
 public:
  using Types = Simulation_types<Traits>;                  ///< of the parts of a simulation
  using Core = Simulation_core<Traits>;                    ///< of the simulation
  using Entry = typename Types::Entry;                     ///< of the queue of contacts and changes
  using Queue = typename Contact_schedule<Traits>::Queue;  ///< that queue
  using Part = typename Queue::Part;                       ///< of the queue
  using Time = Algebraic_number;                           ///< of contacts
  using Change = typename Types::Change;                   ///< of a point
  using Points = std::span<const Point_id>;                ///< some points
  using Disc = typename Types::Disc;                       ///< how one disc names another
  using Pair = typename Types::Pair;                       ///< of discs

  /// The simulation must outlive this object.
  explicit Watched_contacts(Core& core)
      : core_(core),
        geometry_(core.geometry),
        records_(core.records),
        schedule_(core.schedule),
        tracker_(core.tracker) {}

  /// Whether contacts can be executed in windows: of walls, and of discs whose response may be
  /// called at any time, by any thread, and is not log_contact or erase_both.
  static bool can_run(const Core& core);
  /// Whether discs have contacts.
  bool has_pairs() const { return core_.setup.has_response(); }
  /// Whether discs that meet keep their edge in a window.
  bool keep_edges() const { return has_radii && has_pairs(); }

  // ---- entries ----

  Queue& queue() { return schedule_.queue(); }  ///< of all entries
  /// Distributes the entries, as Divided_scheduler::distribute says.
  template <class In_parallel>
  void divide(std::size_t count, const In_parallel& in_parallel);
  /// The points of a contact; with a wall, the second one is no_point.
  static std::array<Point_id, 2> points(const Entry& entry) {
    return {entry.point_a, entry.kind == Contact_kind::collision ? entry.point_b : no_point};
  }
  /// The contact of a pair of discs.
  static Entry entry_of(const Pair& pair);
  /// Calls `function` with the handles of all contacts of a point.
  template <class Function>
  void for_each_handle(Point_id id, const Function& function) const;

  // ---- contacts ----

  /// Whether two discs meet just after `now`; true if unsure.
  bool do_meet(const Pair& pair, const Time& now) const {
    return do_meet(ids_of(pair)[0], second_of(pair), now);
  }
  /// The new motions of points by a contact at `now`. None if it is left to the sequential loop,
  /// where it may throw.
  std::vector<Change> changes(const Entry& entry, const Time& now) const;
  /// The entry of the same contact, and its certificate after a time.
  std::pair<Entry, Certificate> certificate(const Entry& entry, const Time& after,
                                            Certificate_counters& counters) const;
  /// Calls put(entry, certificate) with all watched contacts of one or two points from `now` on:
  /// those with walls, and those of their edges.
  template <class Put>
  void for_each_contact(Points points, const Time& now, Certificate_counters& counters,
                        const Put& put) const;
  /// Computes the certificates of points that have changed at `now`, in a contact. Returns false if
  /// discs meet that have not just touched, or may do so undetected.
  bool certify(const Entry& contact, Points changed, const Time& now,
               Certificate_counters& counters,
               std::vector<std::pair<Entry, Certificate>>& result) const;

  // ---- windows ----

  /// Prepares a window, before whose beginning no event happens. Returns whether it may begin.
  bool begin_window(double begin);
  /// Records the overlap of a contact of discs in the finished window, if they still meet.
  void end_contact(const Pair& pair);
  /// Called after each window.
  void end_window();
  /// Finds overlaps and schedules contacts again, between two events. Keeps scheduled changes.
  void start_anew();

  /// Whether `some` contains a point.
  static bool is_one(Points some, Point_id id) { return std::ranges::find(some, id) != some.end(); }

 private:
  static constexpr bool has_radii = HasWeight<typename Traits::Motion>;

  bool do_meet(Point_id a, const Disc& b, const Time& now) const;
  bool is_center_in(Point_id id, const Disc& other, const Time& now) const;
  bool have_areas();
  bool drop_overlaps(const Time& time);
  void put_passes_back();

  Core& core_;
  const Disc_geometry<Traits>& geometry_;
  typename Types::Contact_records& records_;
  Contact_schedule<Traits>& schedule_;
  Overlap_tracker<Traits>& tracker_;
  std::uint32_t scheduled_ = 0;                      // changes before the window
  std::vector<std::pair<Entry, Time>> moving_ = {};  // changes, while the queue is split
  std::vector<Pair> passes_ = {};                    // temporarily removed
  std::unordered_set<Point_id> passing_ = {};        // their points
  bool have_areas_ = false;                          // whether all radii are positive
  std::optional<std::uint64_t> changes_ =
      {};  // the number of changes when have_areas_ was computed
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_WATCHED_CONTACTS_H
