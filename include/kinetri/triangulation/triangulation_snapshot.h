// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state of a kinetic triangulation between two events, as plain values: what decides its future
// and nothing else, so that it can be kept, sent and read back.
#ifndef KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
#define KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/triangulation/triangulation_counters.h"

namespace kinetri {

/// A snapshot of Kinetic_delaunay_triangulation_2. The edges alone would not do: which of two
/// diagonals of cocircular points an insertion or removal chooses depends on the face in which it
/// begins, and on the order of the vertices in the faces. The queue is not part of it, since a
/// certificate's failure does not depend on when it was found; only the side of its edge is, from
/// which it will be flipped.
template <KineticTraits_2 Traits>
struct Triangulation_snapshot {
  using Motion = typename Traits::Motion;
  using Time = typename Traits::Time;

  /// A face of CGAL's data structure. In dimension d it has d + 1 vertices and as many neighbors,
  /// each opposite to the vertex of the same index; below dimension 0 one vertex and no neighbor.
  struct Face {
    std::array<Point_id, 3> vertices = {};      ///< the infinite one is no_point
    std::array<std::size_t, 3> neighbors = {};  ///< positions in `faces`
    std::array<bool, 3> has_queue_entry = {};   ///< in dimension 2: whether the edge opposite has
                                                ///< one, on this side; at most one of its sides has
  };

  Time time = {};                              ///< the state is the one just after it
  std::vector<std::optional<Motion>> motions;  ///< by point id; none of a point that is not there
  int dimension = -1;
  std::vector<Face> faces;
  std::vector<std::size_t> vertex_faces;  ///< by point id: the face at which CGAL begins; 0 of a
                                          ///< point that is not there
  std::size_t infinite_vertex_face = 0;
  Triangulation_counters counters;
  Certificate_counters certificates;
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
