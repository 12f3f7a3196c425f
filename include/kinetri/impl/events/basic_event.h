// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinds of event, whose order is that of simultaneous events, and what an event is apart from
// the type of its time. Without exact numbers, for what only counts or shows events.
#ifndef KINETRI_IMPL_EVENTS_BASIC_EVENT_H
#define KINETRI_IMPL_EVENTS_BASIC_EVENT_H

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

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
  hide,         ///< point_a has no power cell from now on: another point hides it
  reveal,       ///< point_a has a power cell from now on
  wall,         ///< point_a hits the box
  collision,    ///< point_a and point_b touch
  insert,       ///< point_a is inserted
  erase,        ///< point_a is erased
  trajectory,   ///< point_a has a new trajectory
};

/// The number of kinds.
inline constexpr std::size_t event_kinds = 11;

/// The kind's name in files: "flip", "hull_insert", ...
std::string_view name(Event_kind kind);

/// The ends of an edge, the smaller id first.
using Edge_ids = std::array<Point_id, 2>;

/// The ends in order.
constexpr Edge_ids edge_ids(Point_id a, Point_id b) {
  return a < b ? Edge_ids{a, b} : Edge_ids{b, a};
}

/// The edges that a change has removed and added in the end, each sorted.
struct Changed_edges {
  std::vector<Edge_ids> removed;  ///< that were there before
  std::vector<Edge_ids> added;    ///< that are there now
};

/// What happened at one time, in terms of point ids. `removed` and `added` are finite edges. These
/// fields are present; the others are empty:
///
/// | Kind | Fields |
/// |---|---|
/// | `flip` | `removed`, `added` |
/// | `hull_insert` | `removed`; `apex`, which comes to the hull there |
/// | `hull_remove` | `added`; `apex`, which leaves the hull there |
/// | `rebuild` | `removed` or `added`: each edge has an event of its own |
/// | `hide`, `reveal` | `point_a`; its edges have `rebuild` events after it |
/// | `wall`, `insert`, `erase`, `trajectory` | `point_a` |
/// | `collision` | `point_a`, `point_b`, the smaller id first |
template <class Time>
struct Basic_event {
  std::uint64_t number = 0;            ///< 0 for the first event of a run, then one more each
  Event_kind kind = Event_kind::flip;  ///< what happened
  Time time;                           ///< when
  std::optional<Edge_ids> removed = std::nullopt;  ///< the edge that goes
  std::optional<Edge_ids> added = std::nullopt;    ///< the edge that comes
  std::optional<Point_id> point_a = std::nullopt;  ///< the point, or the first of two
  std::optional<Point_id> point_b = std::nullopt;  ///< the second of two points
  /// The third corner of the triangle that goes or comes at a hull edge. Files do not have it.
  std::optional<Point_id> apex = std::nullopt;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_EVENTS_BASIC_EVENT_H
