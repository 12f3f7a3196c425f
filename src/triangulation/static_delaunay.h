// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Delaunay triangulation of static points in doubles, or the regular one of weighted points, by
// CGAL's fastest kernel, as plain numbers. The construction of a kinetic triangulation begins with
// that of the rounded positions, and checks each triangle and edge for the exact ones.
#ifndef KINETRI_SRC_TRIANGULATION_STATIC_DELAUNAY_H
#define KINETRI_SRC_TRIANGULATION_STATIC_DELAUNAY_H

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// The faces of a triangulation, as plain numbers.
struct Static_delaunay {
  /// A face, as CGAL has it: neighbor i is opposite vertex i.
  struct Face {
    std::array<Point_id, 3> vertices;        ///< counterclockwise; no_point is the infinite vertex
    std::array<std::uint32_t, 3> neighbors;  ///< positions in `faces`
  };

  /// All faces, infinite ones too.
  std::vector<Face> faces;
  /// The points in an order in which near ones follow one another.
  std::vector<Point_id> order;
  /// Each hidden point, with the index of the face that it is above.
  std::vector<std::pair<Point_id, std::uint32_t>> hidden;
};

/// The positions of points, their weights if these differ, and bounds for the errors.
struct Static_points {
  std::span<const Vector_2> places;  ///< numbered from 0
  std::span<const double> weights;   ///< the same; none without weights
  double error = 0;                  ///< of each coordinate
  double weight_error = 0;           ///< of each weight
};

/// The triangulation of the positions. Empty if there is none with a vertex for each position: if
/// two positions are equal, or all are on a line. Precondition: all coordinates are finite. O(n log
/// n), some microseconds a point. Many points without weights are divided into cells for several
/// threads (static_delaunay_by_cells); the result does not depend on the number of threads.
Static_delaunay static_delaunay(const Static_points& points);

/// The same for points without weights, cell by cell [Funke and Sanders 2017]: several threads
/// triangulate the positions of a cell each. A triangle whose circle is inside its cell is a
/// triangle of the whole. The corners of the others are the border; a triangulation of these alone
/// fills the gaps. Empty also if the parts do not fit together, for instance because four positions
/// are on a circle, or if half of the positions or more are on the border. Since circles are
/// rounded, a triangle may not be Delaunay (see is_certainly_delaunay). Precondition: cells > 0.
Static_delaunay static_delaunay_by_cells(std::span<const Vector_2> places, std::size_t cells);

/// Whether all triangles certainly turn left, the certificates of all edges between two of them
/// certainly hold, and hidden points are certainly inside of and above their faces, for all points
/// within the errors of the positions and weights. Uses several threads.
bool is_certainly_delaunay(const Static_delaunay& triangulation, const Static_points& points);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_STATIC_DELAUNAY_H
