// SPDX-License-Identifier: GPL-3.0-or-later
//
// The event: what happened to the triangulation at one exact time, in terms of point ids. A value
// that observers receive and that the event log prints; the order of simultaneous events is fixed
// here.
#ifndef KINETRI_EVENTS_EVENT_H
#define KINETRI_EVENTS_EVENT_H

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "kinetri/base/ids.h"

namespace kinetri {

/// The kinds of event. Up to `collision` the enumerators' order is the order in which simultaneous
/// events are taken from the queue, before their point ids decide; changes that were scheduled
/// follow (Simulation_2). It is not arbitrary: points that coincide are
/// set aside first, since all else is about distinct points; flat hull triangles are removed next,
/// since every later flip relies on a triangulation that is properly embedded. The edges of a
/// rebuild are reported when its instant is done, those removed first.
enum class Event_kind : std::uint8_t {
  rebuild,      ///< an edge removed or added by reconstruction at a degenerate instant
  hull_insert,  ///< a vertex becomes a hull vertex: the hull edge in front of it is removed
  hull_remove,  ///< a vertex leaves the hull: the edge between its hull neighbors is added
  flip,         ///< an edge is replaced by the other diagonal of its quadrilateral
  wall,         ///< point_a hits the box
  collision,    ///< point_a and point_b touch
  insert,       ///< point_a is inserted
  erase,        ///< point_a is erased
  trajectory,   ///< point_a has a new trajectory
};

/// The number of kinds.
inline constexpr std::size_t event_kinds = 9;

/// The kind's name in files: "flip", "hull_insert", ...
std::string_view name(Event_kind kind);

/// The ends of an edge, the smaller id first.
using Edge_ids = std::array<Point_id, 2>;

/// The ends in order.
constexpr Edge_ids edge_ids(Point_id a, Point_id b) {
  return a < b ? Edge_ids{a, b} : Edge_ids{b, a};
}

/// An event at an exact time. `removed` and `added` are finite edges; which of them and of the
/// points are present depends on the kind.
template <class Time>
struct Event {
  std::uint64_t number = 0;            ///< 0 for the first event of a run, then one more each
  Event_kind kind = Event_kind::flip;  ///< what happened
  Time time;                           ///< when, exactly
  /// The edge that goes: of a flip, a hull_insert, and one of a rebuild that removes.
  std::optional<Edge_ids> removed = std::nullopt;
  /// The edge that comes: of a flip, a hull_remove, and one of a rebuild that adds.
  std::optional<Edge_ids> added = std::nullopt;
  std::optional<Point_id> point_a = std::nullopt;  ///< of the other kinds
  std::optional<Point_id> point_b = std::nullopt;  ///< of a collision, the greater id
};

/// Called before and after each event, in the order in which the observers were added. Derive and
/// override what is needed. An observer must not change the triangulation.
///
/// In `before_event` the triangulation still has the removed edge, in `after_event` it has the
/// added one; only of a rebuild both are called when all of it is done. Within a group of
/// simultaneous events it is Delaunay only after the last of them.
template <class Time>
class Event_observer {
 public:
  virtual ~Event_observer() = default;
  /// Called when `event` is about to happen. Does nothing unless it is overridden.
  virtual void before_event(const Event<Time>& /*event*/) {}
  /// Called when `event` has happened. Does nothing unless it is overridden.
  virtual void after_event(const Event<Time>& /*event*/) {}
  /// Called at the end of changes that are not reported flip by flip: those of a degenerate
  /// instant, and those that a change of points makes. The rebuild events, if there are any, have
  /// been reported. `edges` has every edge whose triangles may have changed, sorted; among them may
  /// be edges that were and are there, and edges that never were. Triangles may change, or turn
  /// over, although no edge does. Does nothing unless it is overridden.
  virtual void after_rebuild(const Time& /*time*/, std::span<const Edge_ids> /*edges*/) {}
};

}  // namespace kinetri

#endif  // KINETRI_EVENTS_EVENT_H
