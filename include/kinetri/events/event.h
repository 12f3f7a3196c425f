// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event: what happened to the triangulation at one exact time; and the observers of events.
#ifndef KINETRI_EVENTS_EVENT_H
#define KINETRI_EVENTS_EVENT_H

#include <span>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/events/basic_event.h"

namespace kinetri {

/// An event at an exact time.
using Event = Basic_event<Algebraic_number>;

/// Called before and after each event, in the order in which the observers were added. An observer
/// may read the triangulation or the simulation, but not change it: functions that would do so
/// throw Precondition_error. It may remove itself and other observers, but not add any. Its
/// exceptions reach the caller of the function that advanced time; the triangulation is then within
/// an event and cannot continue, unless several threads were executing its events
/// (Kinetic_triangulation_2::set_threads).
///
/// In `before_event` the triangulation still has the removed edge; in `after_event` it has the
/// added one. For a `rebuild` event both are called when the whole reconstruction is done. Within a
/// group of simultaneous events the triangulation is Delaunay only after the last of them.
class Event_observer {
 public:
  virtual ~Event_observer() = default;
  /// Whether the functions below read the triangulation. If an observer does, one thread executes
  /// the events; if none does, several threads may, and they report events some time after these
  /// have happened (docs/PARALLEL.md).
  virtual bool looks_at_triangulation() const { return true; }
  /// Called when `event` is about to happen. By default this and the functions below do nothing.
  virtual void before_event(const Event& /*event*/) {}
  /// Called when `event` has happened.
  virtual void after_event(const Event& /*event*/) {}
  /// Called at the end of changes that are not reported flip by flip: those of a degenerate
  /// instant, and those that a change of points makes. The rebuild events, if there are any, have
  /// been reported. `edges` has every edge whose triangles may have changed, sorted; it may also
  /// have edges that have not changed, and edges that existed only in between. Triangles may
  /// change, or turn over, although no edge does. In a periodic box each pair of ends comes once.
  virtual void after_rebuild(const Algebraic_number& /*time*/,
                             std::span<const Edge_ids> /*edges*/) {}
  /// Of a regular triangulation, or if points coincide for a while: called after all events of a
  /// time, and after a change of points, if hidden points may have other triangles than before,
  /// even if there was no event. `points`, sorted, has each of them; it may also have points whose
  /// triangle is the same, or that are no longer hidden, or that were erased.
  virtual void after_hiding(const Algebraic_number& /*time*/,
                            std::span<const Point_id> /*points*/) {}
};

}  // namespace kinetri

#endif  // KINETRI_EVENTS_EVENT_H
