// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event: what happened to the triangulation at one exact time. A value that observers receive
// and that the event log prints.
#ifndef KINETRI_EVENTS_EVENT_H
#define KINETRI_EVENTS_EVENT_H

#include <span>

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/events/basic_event.h"

namespace kinetri {

/// An event at an exact time.
using Event = Basic_event<Algebraic_number>;

/// Called before and after each event, in the order in which the observers were added. Derive and
/// override what is needed. An observer may look at the triangulation, or the simulation, but not
/// change it: functions that do throw Precondition_error while it is called. It may remove itself
/// and others, but not add any. What it throws is passed on by the function that was called; the
/// triangulation is then within an event and cannot go on, unless several threads have run it by
/// regions (Kinetic_triangulation_2::set_threads).
///
/// In `before_event` the triangulation still has the removed edge; in `after_event` it has the
/// added one. For a `rebuild` event both are called when the whole reconstruction is done. Within a
/// group of simultaneous events the triangulation is Delaunay only after the last of them.
class Event_observer {
 public:
  virtual ~Event_observer() = default;
  /// Whether the functions below look at the triangulation. If no observer does, a run by regions
  /// may report events some time after they have happened; else there is none.
  virtual bool looks_at_triangulation() const { return true; }
  /// Called when `event` is about to happen. Does nothing unless it is overridden.
  virtual void before_event(const Event& /*event*/) {}
  /// Called when `event` has happened. Does nothing unless it is overridden.
  virtual void after_event(const Event& /*event*/) {}
  /// Called at the end of changes that are not reported flip by flip: those of a degenerate
  /// instant, and those that a change of points makes. The rebuild events, if there are any, have
  /// been reported. `edges` has every edge whose triangles may have changed, sorted; among them may
  /// be edges that were and are there, and edges that never were. Triangles may change, or turn
  /// over, although no edge does. Does nothing unless it is overridden.
  virtual void after_rebuild(const Algebraic_number& /*time*/,
                             std::span<const Edge_ids> /*edges*/) {}
  /// Of a regular triangulation: called after all events of a time, and after a change of points,
  /// if hidden points may have other triangles than before. There need be no event for that.
  /// `points`, sorted, has each of them; among them may be points that have the same triangle, or
  /// are not hidden or not there any more. Does nothing unless it is overridden.
  virtual void after_hiding(const Algebraic_number& /*time*/,
                            std::span<const Point_id> /*points*/) {}
};

}  // namespace kinetri

#endif  // KINETRI_EVENTS_EVENT_H
