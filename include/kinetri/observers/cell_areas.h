// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much room each point has: the area of its Voronoi cell within walls, and within a distance.
#ifndef KINETRI_OBSERVERS_CELL_AREAS_H
#define KINETRI_OBSERVERS_CELL_AREAS_H

#include <limits>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/observers/walkable_area.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// What bounds the cells besides their neighbors: at least one of the two, since the cells of
/// points on the convex hull are unbounded.
struct Cell_limits {
  std::optional<Walkable_area> walkable = std::nullopt;  ///< where points can be
  /// No position of a cell is farther from its point than this; at least 1e-150, and at most 1e150
  /// or infinite.
  double cutoff = std::numeric_limits<double>::infinity();

  /// Throws Precondition_error if there is no limit, or a cutoff that is none.
  void check() const;
};

/// The room of a point.
struct Cell_area {
  Point_id id = no_point;  ///< the point
  double area = 0;         ///< of its cell within the limits
  double error = 0;        ///< the area is off by at most this, see cell_areas

  /// One over the area: points in a unit of area. NaN where the area is 0, as there is no cell.
  double density() const { return area > 0 ? 1 / area : std::numeric_limits<double>::quiet_NaN(); }
};

/// The room of each point at current_time(), by ascending id: the area of its Voronoi cell (of
/// points with weights: power cell), within the limits. Of a cell that walls divide, only the part
/// counts that has the point: of the positions inside of the cell, the walkable area and the cutoff
/// those that a path through such positions connects with the point (walls that meet in one
/// position let nothing through). (B. Steffen and A.
/// Seyfried, Methods for measuring pedestrian density, flow, speed and direction with minimal
/// scatter, Physica A 389, 2010, measure the density of a person in this way.)
///
/// The area is 0 where the point is outside of the walkable area, decided exactly; a wall belongs
/// to it. Of coinciding points, of equal weights, the smallest id has the area of the common cell,
/// and the others have 0; and so has a point whose power cell has no area. A power cell need not
/// contain its point; then all of its parts count. Without obstacles the areas of points in a
/// convex walkable area sum to the area of that.
///
/// The cutoff is a circle, and no polygon. The sides of the cells are those of the exact ones, and
/// the rest is computed in binary64 arithmetic. `error` bounds the sum of all errors: with u =
/// 2^-53, of h, the largest coordinate of a corner that has been cut, from the point on, and a part
/// of the cell with the perimeter l and n sides, at most (80 + 18 n) u h l, and 32 u r^2 more for
/// each side where there is a cutoff r (docs/MATH.md, section 13).
/// Whether an opening between walls is open is decided exactly, too, unless the time is irrational
/// and the opening narrower than these errors.
/// The bound holds where nothing underflows, as is certain for lengths beyond 1e-150.
///
/// Cost: some 100 floating-point operations for each neighbor, and a search in a tree of the walls;
/// where walls are near to a cell, as much for each triangle of a triangulation of the walkable
/// area that the cell meets. Exact arithmetic only where places almost coincide, or lie almost on a
/// wall. Throws Precondition_error as Cell_limits::check.
template <KineticTraits_2 Traits>
std::vector<Cell_area> cell_areas(const Kinetic_triangulation_2<Traits>& triangulation,
                                  const Cell_limits& limits);

extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Linear_kinetic_traits_2>&, const Cell_limits&);
extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&, const Cell_limits&);
extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Disc_kinetic_traits_2>&, const Cell_limits&);
extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2>&, const Cell_limits&);

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CELL_AREAS_H
