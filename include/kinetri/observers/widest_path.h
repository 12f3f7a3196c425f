// SPDX-License-Identifier: GPL-3.0-or-later
//
// The widest way between two places among moving points: through the triangles, across edges whose
// ends are far apart.
//
// A disc passes between two points if it is not wider than their distance. So the way that lets the
// widest disc pass is a path of triangles, the shortest edge of which is as long as possible: a
// path in the maximum spanning tree of the dual graph. It stands for a path on the Voronoi diagram,
// where one is as far away from all points as can be.
//
// That this is exact: a disc of diameter w that has no point inside it at either place can go from
// one to the other, while the points rest, if and only if w is at most the length of the shortest
// edge of that path. The discs of radius w/2 about the points are where its centre must not be;
// their union and its dual complex, whose edges are shorter than w, separate the same places. An
// edge that is shorter than w and not in the complex has, in one of its two triangles, an obtuse
// angle opposite of it; that triangle is left by shorter edges, and has no place for the disc.
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

/// The widest way from one place to another.
struct Widest_path {
  Vector_2 from;  ///< where it begins
  Vector_2 to;    ///< where it ends
  /// The pairs of points between which it passes, in this order. None if the two places are in one
  /// triangle, or both outside of the convex hull.
  std::vector<Edge_ids> gaps;
  /// The narrowest of the gaps; none if there is no gap, and the way as wide as one likes.
  std::optional<Edge_ids> narrowest;
  /// @{
  /// The ends of the edges that the places are to the left of: of the triangles that they are in,
  /// or, outside of the convex hull, of an edge of it.
  std::vector<std::array<Point_id, 2>> around_from;
  std::vector<std::array<Point_id, 2>> around_to;
  /// @}
};

/// The widest way just after the current time, exactly. For discs of one radius r about the points,
/// each gap is 2r less wide than the distance of the two points, and the way is the widest one too.
/// Of gaps that are equally wide, the one with the smaller ids counts as narrower. A place on an
/// edge belongs to one of its triangles. Precondition: the places are finite.
///
/// Cost: that of finding the triangles; O(k log k) exact comparisons for the k triangles that can
/// be reached across gaps that are not narrower, O(n) at most.
template <class Traits>
requires HasNearestNeighbors<Traits> Widest_path widest_path(
    const Kinetic_triangulation_2<Traits>& triangulation, const Vector_2& from, const Vector_2& to);

/// The first time, from the current one on, at which the points, moving on as they do now, close
/// the way or leave it to be looked for again: a gap is not wider than `width`, or the edge of a
/// triangle comes to one of the places. The way is there up to that time or to the next event of
/// the triangulation, whichever is earlier. The present time if a gap is not wider even now; none
/// if nothing of this ever happens. Exact: a root of a quadratic for linear motion.
///
/// Precondition: `path` is the result of widest_path for the present triangulation; `width` is at
/// least 0 and finite. (For discs of radius r about the points, add 2r to the width of the ship.)
template <class Traits>
requires HasNearestNeighbors<Traits> std::optional<Algebraic_number> end_of_path(
    const Kinetic_triangulation_2<Traits>& triangulation, const Widest_path& path, double width);

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
