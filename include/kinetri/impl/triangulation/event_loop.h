// SPDX-License-Identifier: GPL-3.0-or-later
//
// The events of a kinetic triangulation, in the order of time.
#ifndef KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_H
#define KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinetri/impl/triangulation/decisions.h"
#include "kinetri/impl/triangulation/hidden_events.h"
#include "kinetri/impl/triangulation/updates.h"

namespace kinetri::detail {

/// Executes events. Between two calls the triangulation is Delaunay (regular) just after the
/// present time.
///
/// `run_to` calls `Schedule::settle` until a failure is first, `run_instant` removes it from the
/// queue, and `execute` asks `Decisions` what it leads to and calls `Updates`.
template <class Traits>
class Kinetic_types<Traits>::Event_loop {
 public:
  /// The others must outlive this object.
  Event_loop(Topology& topology, Certification& certification, Schedule& schedule,
             Event_reporter& reporter, Updates& updates)
      : topology_(topology),
        certification_(certification),
        schedule_(schedule),
        reporter_(reporter),
        updates_(updates) {}

  /// Executes all events up to `time`, as long as may_go_on(), if given, is true before each time
  /// with events. Returns their number.
  std::size_t run_to(const Time& time, const std::function<bool()>& may_go_on);
  /// Executes the events of the next time that has some, up to `until` if given. Returns their
  /// number. Points may meet and separate without an event, so several times may be passed; calls
  /// after_instant() after each.
  template <class After_instant>
  std::size_t step(const Time* until, const After_instant& after_instant) {
    std::size_t events = 0;
    while (events == 0 && schedule_.settle(until)) {
      events = run_instant();
      updates_.show_current_time();
      after_instant();
    }
    return events;
  }
  std::size_t step(const Time* until) {
    return step(until, [] {});
  }
  /// Executes every event of the first time in the queue. Precondition: the first entry of the
  /// queue is a failure (see Schedule::settle).
  std::size_t run_instant();
  /// Executes the failures at the present time until there is none. An edge that a flip leaves
  /// violated just after that time fails at that time; so the triangulation is Delaunay when no
  /// failure is left. docs/MATH.md, section 5, proves this and that it ends.
  void execute_due_events();
  /// The same while points are being changed. If everything must be rebuilt, set_points() makes the
  /// rest of the changes: before that, points might have the trajectories of others. Returns
  /// whether this has been so.
  bool execute_due_events_within(std::function<void()> set_points);
  void rebuild();
  /// Reverses time: mirrors the motions, and undoes the events of the present time.
  void reverse();
  /// Whether coinciding points are temporarily removed at the present instant.
  bool has_points_set_aside() const { return !points_set_aside_.empty(); }

 private:
  struct Point_set_aside {
    Vertex_handle vertex;
    Vertex_handle companion;  // was at the same position: the search starts there
  };

  template <class Function>
  void within_event(const Function& function);
  std::size_t run_events_of_instant();
  void execute(const Entry& failure);
  bool retry_postponed();
  bool retry_postponed_edges();
  void set_coincident_points_aside();
  void put_points_back();
  bool has_flat_triangle() const;

  Topology& topology_;
  Certification& certification_;
  Schedule& schedule_;
  Event_reporter& reporter_;
  Updates& updates_;
  std::vector<Point_set_aside> points_set_aside_;
  std::vector<Edge_name> postponed_;  // they fail now, but cannot be flipped yet
  std::uint64_t changes_before_retry_ = 0;
  std::function<void()> rest_of_changes_;  // while points are being changed
  bool is_hull_flat_ = false;              // at the present time
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_EVENT_LOOP_H
