// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame: the current triangulation as plain numbers, for pictures and files. Edges and triangles
// are exact; positions are rounded.
#ifndef KINETRI_TRIANGULATION_FRAME_2_H
#define KINETRI_TRIANGULATION_FRAME_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
class Kinetic_triangulation_2;

/// The triangulation just after a time. All indices refer to `ids`, `places` and `velocities`,
/// which have one element per point, hidden ones included.
struct Frame_2 {
  /// What is drawn of a disc.
  struct Disc {
    double radius = 0;       ///< at `time`, by rounded_radius; at least 0
    bool is_hidden = false;  ///< whether the point is hidden, and so has no edges

    friend bool operator==(const Disc&, const Disc&) = default;
  };

  /// What a periodic box has besides. Places are those of images within `corners`.
  struct Periodic {
    std::array<Vector_2, 4> corners;    ///< of the box, counterclockwise from the origin on
    std::vector<Vector_2> edge_shifts;  ///< of each edge, what leads from its second place to the
                                        ///< image at which it ends
    /// Of each triangle, what leads from its second and its third place to the corners.
    std::vector<std::array<Vector_2, 2>> triangle_shifts;

    friend bool operator==(const Periodic&, const Periodic&) = default;
  };

  double time = 0;                   ///< the time, rounded to nearest
  std::vector<Point_id> ids;         ///< ids of the present points, ascending
  std::vector<Vector_2> places;      ///< positions at `time`, by rounded_place; see `periodic`
  std::vector<Vector_2> velocities;  ///< velocities at `time`, by rounded_velocity
  /// One for each point; none if points are not discs.
  std::optional<std::vector<Disc>> discs = std::nullopt;
  /// Pairs of indices, the smaller first; sorted. In a periodic box those of all periodic edges.
  std::vector<std::array<std::size_t, 2>> edges;
  /// The edges on the boundary of the convex hull, in the same order; all edges if all points are
  /// collinear. A periodic box has no hull.
  std::vector<std::array<std::size_t, 2>> hull;
  /// Triples of indices, counterclockwise, the smallest first; sorted. Empty if all points are
  /// collinear.
  std::vector<std::array<std::size_t, 3>> triangles;
  std::optional<Periodic> periodic = std::nullopt;     ///< there if the box is periodic
  std::array<std::uint64_t, event_kinds> events = {};  ///< number of events so far, by Event_kind

  friend bool operator==(const Frame_2&, const Frame_2&) = default;
};

/// The frame at the current time. It does not depend on the order of faces or vertices. Cost: O(n
/// log n). Precondition: not within an event.
template <KineticTraits_2 Traits>
Frame_2 frame_of(const Kinetic_triangulation_2<Traits>& kinetic);

extern template Frame_2 frame_of(const Kinetic_triangulation_2<Linear_kinetic_traits_2>&);
extern template Frame_2 frame_of(const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&);
extern template Frame_2 frame_of(const Kinetic_triangulation_2<Disc_kinetic_traits_2>&);
extern template Frame_2 frame_of(const Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>&);
extern template Frame_2 frame_of(const Kinetic_triangulation_2<Periodic_kinetic_traits_2>&);
extern template Frame_2 frame_of(const Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>&);

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_FRAME_2_H
