// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sequential loop of a simulation: events of its triangulation, contacts, and scheduled
// changes, in the order of time.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_LOOP_H
#define KINETRI_SRC_SIMULATION_CONTACT_LOOP_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/events/observer_list.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_outcomes.h"
#include "simulation/overlap_tracker.h"
#include "simulation/zeno_watch.h"

namespace kinetri::detail {

/// Executes events.
///
/// One contact: `step` refreshes the front of the queue and advances the triangulation to the time
/// of the first entry; `execute_due_entries` removes the contact from the queue; `Contact_outcomes`
/// computes the new motions; `change` removes the entries of the points, changes the points in the
/// triangulation, follows the changed edges (Event_reporter::take_trail), and schedules the points
/// again.
template <class Traits>
class Simulation_types<Traits>::Contact_loop {
 public:
  /// The others must outlive this object.
  Contact_loop(Kinetic_core& core, Simulation_setup& setup, const Disc_geometry& geometry,
               Contact_records& records, Contact_schedule& schedule, Overlap_tracker& tracker,
               const Contact_outcomes& outcomes, Contact_counters& counters)
      : core_(core),
        setup_(setup),
        geometry_(geometry),
        records_(records),
        schedule_(schedule),
        tracker_(tracker),
        outcomes_(outcomes),
        counters_(counters) {}

  /// Executes all events of the next time, if it is at or before `until` or that is null. Returns
  /// their number. Throws Negative_radius_error instead of passing the time at which a radius
  /// reaches zero.
  std::size_t step(const Time* until);
  /// Executes all events up to a time, or until the stop token returns false.
  void run_to(const Time& until, const std::function<bool()>& may_go_on);
  /// Whether an entry of the queue may be at or before a time. True if a radius reaches zero first,
  /// as `step` handles that.
  bool may_be_due(const Time& time);
  /// Advances the triangulation to a time before the first entry of the queue, or to `until`, and
  /// adds the number of its events. Returns whether to continue. Precondition: there is no
  /// response.
  bool run_triangulation(const Time& until, const std::function<bool()>& may_go_on,
                         std::size_t& events);

  // ---- immediate changes of points ----

  void insert(const Motion& motion, std::optional<Point_id> id);
  void set_motions(std::span<const Point_id> ids, std::span<const Motion> motions);
  void erase(Point_id id);

  /// Whether an error has left the simulation within a contact, or within an instant.
  bool is_within_contact() const { return is_within_contact_; }
  bool is_within_instant() const { return is_within_instant_; }

  Observer_list<Overlap_observer>& overlap_observers() { return overlap_observers_; }
  const Observer_list<Overlap_observer>& overlap_observers() const { return overlap_observers_; }
  /// The number of contacts at which both discs have kept their motions.
  std::uint64_t number_of_passes() const { return passes_; }

  /// Throws if discs overlap. Precondition: all overlaps are recorded.
  void refuse_overlaps() const;

 private:
  const Time& current_time() const { return geometry_.current_time(); }
  std::size_t execute_due_entries();
  void execute_due_entries(std::vector<Due_change>& postponed);
  void execute_contact(const Entry& contact, std::uint64_t& velocity_changes);
  std::vector<Change> changes_of(const Entry& contact, std::uint64_t& velocity_changes);
  void check_limit(const Entry& entry, std::uint64_t velocity_changes) const;
  void check_accumulation(const Entry& entry);
  void refuse_own_image(const Entry& contact);
  void apply(const Entry& contact, std::span<const Change> changes);
  template <class Make_changes>
  void change(std::span<const Point_id> points, const Make_changes& make_changes);
  void execute_change(const Due_change& change);
  bool try_change(const Due_change& change);
  std::vector<Due_change> pop_new_motions(const Entry& first);
  bool try_set_motions(std::span<const Due_change> new_motions);
  [[noreturn]] static void refuse_negative_radius(Point_id id, const Time& time);
  void refuse_overlaps_of(const Point_2& p) const;
  void refuse(std::vector<Edge_ids> pairs) const;

  Kinetic_core& core_;
  Simulation_setup& setup_;
  const Disc_geometry& geometry_;
  Contact_records& records_;
  Contact_schedule& schedule_;
  Overlap_tracker& tracker_;
  const Contact_outcomes& outcomes_;
  Contact_counters& counters_;
  Observer_list<Overlap_observer> overlap_observers_;
  std::uint64_t passes_ = 0;
  Zeno_watch zeno_watch_;
  const Time* until_ = nullptr;     // of the call of `step`
  bool is_within_instant_ = false;  // stays true after an exception
  bool is_within_contact_ = false;  // the same
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_LOOP_H
