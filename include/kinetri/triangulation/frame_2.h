// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame: the triangulation as it stands, as plain numbers, for pictures and for the files of
// other programs. Which edges and triangles there are is exact; where the points are is rounded.
#ifndef KINETRI_TRIANGULATION_FRAME_2_H
#define KINETRI_TRIANGULATION_FRAME_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
class Kinetic_delaunay_triangulation_2;

/// The state just after a time. Points are named by their positions in `ids`.
struct Frame_2 {
  double time = 0;                                ///< the binary64 number nearest to it
  std::vector<Point_id> ids;                      ///< of the points that are there, ascending
  std::vector<Vector_2> places;                   ///< at `time`, as rounded_place gives them
  std::vector<Vector_2> velocities;               ///< as rounded_velocity gives them
  std::vector<std::array<std::size_t, 2>> edges;  ///< the smaller position first, sorted
  /// Those of them that are on the boundary of the convex hull, in the same order: all of them
  /// where all points are collinear.
  std::vector<std::array<std::size_t, 2>> hull;
  /// Counterclockwise, the smallest position first, sorted; none where all points are collinear.
  std::vector<std::array<std::size_t, 3>> triangles;
  std::array<std::uint64_t, event_kinds> events = {};  ///< so far, by Event_kind

  friend bool operator==(const Frame_2&, const Frame_2&) = default;
};

/// The present frame. The same state gives the same frame, whatever led there. Cost: O(n log n).
/// Precondition: as that of snapshot(): not within an event.
template <KineticTraits_2 Traits>
Frame_2 frame_of(const Kinetic_delaunay_triangulation_2<Traits>& kinetic);

extern template Frame_2 frame_of(const Kinetic_delaunay_triangulation_2<Linear_kinetic_traits_2>&);
extern template Frame_2 frame_of(
    const Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2>&);

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_FRAME_2_H
