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

/// A snapshot of Kinetic_triangulation_2. The points alone would not do, since cocircular
/// ones have several triangulations. The order of the vertices in a face, and the face at which
/// CGAL begins at a vertex, are part of it so that CGAL's queries, too, go the same way and decide
/// ties alike. The queue is not, since when a certificate fails does not depend on when that was
/// found.
template <KineticTraits_2 Traits>
struct Triangulation_snapshot {
  using Motion = typename Traits::Motion;  ///< of the traits
  using Time = Algebraic_number;           ///< of events

  /// A face of CGAL's data structure. In dimension d it has d + 1 vertices and as many neighbors,
  /// each opposite to the vertex of the same index; below dimension 0 one vertex and no neighbor.
  struct Face {
    std::array<Point_id, 3> vertices = {};      ///< the infinite one is no_point
    std::array<std::size_t, 3> neighbors = {};  ///< positions in `faces`
  };

  Time time = {};                              ///< the state is the one just after it
  std::vector<std::optional<Motion>> motions;  ///< by point id; none of a point that is not there
  int dimension = -1;                          ///< of CGAL's triangulation: -1 without points, to 2
  std::vector<Face> faces;                     ///< infinite ones too, in CGAL's order
  std::vector<std::size_t> vertex_faces;  ///< by point id: the face at which CGAL begins; 0 of a
                                          ///< point that is not there
  std::vector<Point_id> hidden_points;    ///< sorted; the face of one is the one that hides it
  std::size_t infinite_vertex_face = 0;   ///< the one at which CGAL begins at the infinite vertex
  Triangulation_counters counters;        ///< so far
  Certificate_counters certificates;      ///< so far
};

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_TRIANGULATION_SNAPSHOT_H
