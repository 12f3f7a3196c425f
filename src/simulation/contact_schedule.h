// SPDX-License-Identifier: GPL-3.0-or-later
//
// The schedule of a simulation: the queue of contacts and scheduled changes.
#ifndef KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_H
#define KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "events/divided_scheduler_impl.h"
#include "simulation/contact_records.h"
#include "simulation/disc_geometry.h"
#include "triangulation/region_division.h"

namespace kinetri::detail {

/// The entries of contacts, scheduled changes, and times at which radii reach zero.
///
/// Invariant: the record of a point has the handles of all its entries except changes. A point has
/// one entry for walls, of the first one that it reaches.
template <class Traits>
class Simulation_types<Traits>::Contact_schedule {
 public:
  /// The policy of the scheduler; see Event_scheduler and Divided_scheduler.
  class Policy {
   public:
    explicit Policy(Contact_schedule& schedule) : schedule_(schedule) {}

    Time entry_time(const Entry& entry) const;
    bool precedes(const Entry& a, const Entry& b) const;
    bool is_recheck(const Entry& entry) const;
    static void prefetch(const Entry&) {}
    static void prefetch_more(const Entry&) {}
    static void prefetch_first(const Entry&) {}
    std::size_t part_of(const Subject& subject) const;
    Queue_handle handle(const Subject& subject) const;
    void set_handle(const Subject& subject, Queue_handle handle) const;

   private:
    Contact_schedule& schedule_;
  };
  using Queue = Divided_scheduler<Entry, Policy>;

  /// The others must outlive this object; `division` is that of the triangulation's queue.
  Contact_schedule(const Disc_geometry& geometry, Contact_records& records,
                   const Region_division& division, Contact_counters& counters)
      : geometry_(geometry),
        setup_(geometry.setup()),
        records_(records),
        division_(division),
        counters_(counters) {}
  Contact_schedule(const Contact_schedule&) = delete;
  Contact_schedule& operator=(const Contact_schedule&) = delete;

  // ---- the queue ----

  Queue& queue() { return queue_; }
  const Queue& queue() const { return queue_; }
  const Policy& policy() const { return policy_; }
  Certificate_counters& certificate_counters() { return certificate_counters_; }
  const Certificate_counters& certificate_counters() const { return certificate_counters_; }

  /// Refreshes the front of the queue: rechecks certificates until the first entry is an event.
  void settle();
  /// Removes the first entry from the queue.
  Entry pop();
  /// Whether the first entry is a contact at the present time.
  bool is_contact_due();
  /// Pushes a contact of the present time.
  void put_contact(const Entry& contact) {
    records_.add_event(contact.subject(), queue_.push(contact, geometry_.current_time()));
  }

  // ---- single points ----

  /// Schedules the first wall that a point reaches, and the time at which its radius reaches zero.
  void schedule_single(Point_id id, const Time& after);
  void unschedule_single(Point_id id);
  /// The same for all points, by several threads. Precondition: they have no such entries.
  void schedule_all_singles();
  /// The entry of the first wall that a point reaches, and its certificate.
  std::pair<Entry, Certificate> first_wall(Point_id id, const Time& after,
                                           Certificate_counters& counters) const;

  // ---- pairs ----

  /// The certificate of the next contact of a pair.
  Certificate pair_certificate(const Pair& pair, const Time& after, const Traits& traits) const;
  /// Schedules the next contact of a pair again. Does nothing without a response.
  void schedule_pair(const Pair& pair, bool is_edge, const Time& after);
  /// The same for a pair that has no entry. Returns whether the discs may overlap just after
  /// `after`. Precondition: there is a response.
  bool schedule_new_pair(const Pair& pair, bool is_edge, const Time& after);
  /// The same with a certificate that is known.
  void push_pair(const Pair& pair, bool is_edge, Certificate certificate);
  void unschedule_pair(const Pair& pair);
  /// Removes the entries of all pairs of a point.
  void unschedule_pairs(Point_id id);

  // ---- changes ----

  /// Schedules a change of a point. Precondition: the time is not in the past.
  void schedule_change(const Time& time, Contact_kind kind, Point_id id,
                       const std::optional<Motion>& motion);
  /// Returns a change of the present time to the queue.
  void put_back(const Due_change& change) {
    push_change(geometry_.current_time(), change.entry, change.motion);
  }
  /// The change of an entry that has left the queue.
  Due_change take_change(const Entry& entry) { return {entry, take_motion(entry)}; }
  /// The new motion of a change in the queue.
  const std::optional<Motion>& motion_of(const Entry& change) const {
    return changes_.at(change.point_b).motion;
  }
  /// The number of changes scheduled so far.
  std::uint32_t number_of_changes() const { return scheduled_; }
  /// The number of changes in the queue.
  std::size_t changes_in_queue() const { return changes_in_queue_; }

 private:
  /// A scheduled change, with its new motion.
  struct Scheduled_change {
    std::optional<Motion> motion;
    Queue_handle event = no_event;
  };

  Queue_handle push(Entry entry, Certificate certificate);
  void schedule_wall(Point_id id, const Time& after);
  void schedule_radius_end(Point_id id);
  void recheck(const Entry& entry);
  void forget(const Entry& entry);
  void discard(Queue_handle handle);
  void push_change(const Time& time, Entry entry, const std::optional<Motion>& motion);
  std::optional<Motion> take_motion(const Entry& change);

  const Disc_geometry& geometry_;
  const Simulation_setup& setup_;
  Contact_records& records_;
  const Region_division& division_;
  Contact_counters& counters_;
  Policy policy_{*this};
  Queue queue_{policy_};
  Certificate_counters certificate_counters_;
  std::unordered_map<std::uint32_t, Scheduled_change> changes_;  // by their numbers
  std::uint32_t scheduled_ = 0;                                  // changes so far
  std::size_t changes_in_queue_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_CONTACT_SCHEDULE_H
