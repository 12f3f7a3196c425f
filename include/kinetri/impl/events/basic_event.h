// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinds of event, and events with any type of time: without exact numbers, for code that only
// counts or shows events.
#ifndef KINETRI_IMPL_EVENTS_BASIC_EVENT_H
#define KINETRI_IMPL_EVENTS_BASIC_EVENT_H

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "kinetri/base/ids.h"

namespace kinetri {

/// The kinds of event. Up to `collision`, simultaneous events are taken from the queue in the order
/// of the enumerators, then of point ids; scheduled changes follow (Simulation_2). First coinciding
/// points are temporarily removed, since all other events concern distinct points; then flat hull
/// triangles, since flips require an embedded triangulation. The edges of a rebuild are reported at
/// the end of the instant, those removed first.
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

/// The name of the kind in files: "flip", "hull_insert", ...
std::string_view name(Event_kind kind);

/// The color of the kind in every picture, as `#rrggbb` in sRGB. Its contrast with the page, light
/// or dark, is at least 3 : 1 (WCAG 2.2, success criterion 1.4.11), and no two kinds look the same
/// with protanopia, deuteranopia or tritanopia. Constant time.
std::string_view color(Event_kind kind);

/// The ends of an edge, the smaller id first.
using Edge_ids = std::array<Point_id, 2>;

/// The ends in order.
constexpr Edge_ids edge_ids(Point_id a, Point_id b) {
  return a < b ? Edge_ids{a, b} : Edge_ids{b, a};
}

/// An edge in a periodic box, which stands for all its images: the one from the point ids[0] to the
/// image of the point ids[1] with `offset`. An edge of two points has ids[0] < ids[1]. One from a
/// point to its own image could have this offset or the negative; it has the greater one.
struct Periodic_edge {
  Edge_ids ids = {};             ///< the ends, the smaller id first
  Lattice_offset_2 offset = {};  ///< of the second end against the first

  friend auto operator<=>(const Periodic_edge&, const Periodic_edge&) = default;
};

/// The edge from the point `a` to the image of `b` with this offset against `b`.
constexpr Periodic_edge periodic_edge(Point_id a, Point_id b, Lattice_offset_2 offset) {
  const Lattice_offset_2 reverse = {-offset.x, -offset.y};
  if (a != b ? a < b : reverse < offset) return {{a, b}, offset};
  return {{b, a}, reverse};
}

/// The edges that a change has removed and added in the end, both sorted. In a periodic box without
/// offsets: a pair of ids occurs once for each such edge.
struct Changed_edges {
  std::vector<Edge_ids> removed;  ///< that were there before
  std::vector<Edge_ids> added;    ///< that are there now
};

/// An event, in terms of point ids. `removed` and `added` are finite edges. Each kind has these
/// fields; the others are empty:
///
/// | Kind | Fields |
/// |---|---|
/// | `flip` | `removed`, `added` |
/// | `hull_insert` | `removed`; `apex`, the new hull vertex |
/// | `hull_remove` | `added`; `apex`, the former hull vertex |
/// | `rebuild` | `removed` or `added`: each edge has an event of its own |
/// | `hide`, `reveal` | `point_a`; its edges have `rebuild` events after it; `point_b`: see below |
/// | `wall`, `insert`, `erase`, `trajectory` | `point_a` |
/// | `collision` | `point_a`, `point_b`, the smaller id first |
///
/// If a point with the trajectory of point_a hides it, or hid it (Coincident_points), that is
/// point_b of `hide` or `reveal`. It may be erased at that time.
///
/// In a periodic box several edges may have the same ends. `removed` and `removed_offset` together
/// are a Periodic_edge, as are `added` and `added_offset`. A `collision` is one of point_a and of
/// the image of point_b with `added_offset`.
template <class Time>
struct Basic_event {
  std::uint64_t number = 0;            ///< 0 for the first event of a run, then one more each
  Event_kind kind = Event_kind::flip;  ///< what happened
  Time time;                           ///< when
  std::optional<Edge_ids> removed = std::nullopt;  ///< the removed edge
  std::optional<Edge_ids> added = std::nullopt;    ///< the added edge
  std::optional<Point_id> point_a = std::nullopt;  ///< the point, or the first of two
  std::optional<Point_id> point_b = std::nullopt;  ///< the second of two points
  /// The third corner of the triangle removed or added at a hull edge. Not in files.
  std::optional<Point_id> apex = std::nullopt;
  Lattice_offset_2 removed_offset = {};  ///< of the removed edge, in a periodic box
  Lattice_offset_2 added_offset = {};    ///< of the added edge, or of point_b, in a periodic box
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_EVENTS_BASIC_EVENT_H
