// SPDX-License-Identifier: GPL-3.0-or-later
//
// The widest (bottleneck) path between two positions among moving points: through triangles, across
// edges.
//
// A disc passes between two points if its diameter is at most their distance. So the path for the
// widest disc is a path of triangles whose shortest crossed edge is as long as possible: a path in
// the maximum spanning tree of the dual graph. It corresponds to a path on the Voronoi diagram.
//
// This is exact: a disc of diameter w that has no point inside it at either position can go from
// one to the other, while the points rest, if and only if w is at most the length of the shortest
// edge of that path. Proof: its center must not be in the discs of radius w/2 about the points;
// their union and its dual complex, whose edges are shorter than w, separate the same positions. An
// edge that is shorter than w and not in the complex is opposite to an obtuse angle in one of its
// triangles; the other edges of that triangle are shorter, and the disc has no position in it.
// Sources: C. O'Dunlaing, C. K. Yap, A "retraction" method for planning the motion of a disc,
// Journal of Algorithms 6, 1985; H. Edelsbrunner, The union of balls and its dual shape, Discrete &
// Computational Geometry 13, 1995.
#ifndef KINETRI_OBSERVERS_WIDEST_PATH_H
#define KINETRI_OBSERVERS_WIDEST_PATH_H

#include <array>
#include <optional>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// The widest path from one position to another.
struct Widest_path {
  Vector_2 from;  ///< the begin
  Vector_2 to;    ///< the end
  /// The pairs of points between which it passes, in this order. None if both positions are in one
  /// triangle, or outside of the convex hull. Of points that coincide for a while, here and below,
  /// the one that hides the others is named.
  std::vector<Edge_ids> gaps;
  /// The narrowest of the gaps: the bottleneck. None if there is no gap; the width is then
  /// unbounded.
  std::optional<Edge_ids> narrowest;
  /// @{
  /// The edges to whose left the positions are: those of their triangles or, outside of the convex
  /// hull, one of its edges.
  std::vector<std::array<Point_id, 2>> around_from;
  std::vector<std::array<Point_id, 2>> around_to;
  /// @}
};

/// The widest path just after the current time, exactly. It is also the widest among discs of one
/// radius r about the points; each gap is then narrower by 2r. Of equally wide gaps, the one with
/// the smaller ids counts as narrower. A position on an edge belongs to one of its triangles.
/// Precondition: the positions are finite.
///
/// Cost: that of locating the positions, and O(k log k) exact comparisons for the k triangles that
/// are reachable across gaps that are not narrower; k = O(n).
template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits> Widest_path widest_path(
    const Kinetic_triangulation_2<Traits>& triangulation, const Vector_2& from, const Vector_2& to);

/// The first time, from the current one on, at which the path may end under the present motions: a
/// gap is not wider than `width` (at first, mostly, just as wide, so that a disc could still pass),
/// or an edge in `around_from` or `around_to` reaches its position.
/// The path exists up to that time or the next event of the triangulation, whichever is earlier.
/// The present time if a gap is not wider now; none if the path never ends. Exact: a root of a
/// quadratic for linear motion.
///
/// Precondition: `path` is the result of widest_path for the present triangulation; `width` is at
/// least 0 and finite. (For discs of radius r about the points, add 2r to the width.)
template <class Traits>
requires HasNearestNeighbors<Traits> && PlanarKineticTraits_2<Traits>
    std::optional<Algebraic_number> end_of_path(
        const Kinetic_triangulation_2<Traits>& triangulation, const Widest_path& path,
        double width);

/// @cond
#define KINETRI_WIDEST_PATH(declaration, Traits)                                                  \
  declaration Widest_path widest_path(const Kinetic_triangulation_2<Traits>&, const Vector_2&,    \
                                      const Vector_2&);                                           \
  declaration std::optional<Algebraic_number> end_of_path(const Kinetic_triangulation_2<Traits>&, \
                                                          const Widest_path&, double)
KINETRI_WIDEST_PATH(extern template, Linear_kinetic_traits_2);
KINETRI_WIDEST_PATH(extern template, Polynomial_kinetic_traits_2);
/// @endcond

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_WIDEST_PATH_H
