// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area of the Voronoi cell of each point within walls and within a distance.
#ifndef KINETRI_OBSERVERS_CELL_AREAS_H
#define KINETRI_OBSERVERS_CELL_AREAS_H

#include <limits>
#include <optional>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/observers/walkable_area.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// Bounds of cells besides their neighbors. In the plane there must be at least one, since the
/// cells of points on the convex hull are unbounded. In a periodic box, where all cells are
/// bounded, there may be a cutoff; walls are not periodic.
struct Cell_limits {
  std::optional<Walkable_area> walkable = std::nullopt;  ///< where points may be
  /// No position of a cell is farther from its point than this; at least 1e-150, and at most 1e150
  /// or infinite.
  double cutoff = std::numeric_limits<double>::infinity();

  /// Throws Precondition_error if there is no limit, or in a periodic box a walkable area, or if
  /// the cutoff is not in its range.
  void check(bool is_in_periodic_box = false) const;
};

/// The area of a point.
struct Cell_area {
  Point_id id = no_point;  ///< the point
  double area = 0;         ///< of its cell within the limits
  double error = 0;        ///< the area is off by at most this, see cell_areas

  /// 1 / area; NaN if the area is 0.
  double density() const { return area > 0 ? 1 / area : std::numeric_limits<double>::quiet_NaN(); }
};

/// The area of each point at current_time(), by ascending id: that of its Voronoi cell (of points
/// with weights: power cell), within the limits. If walls divide a cell, only the part that
/// contains the point counts: the positions in the cell, the walkable area and the cutoff that a
/// path through such positions connects with the point (no path leads through a position in which
/// walls meet). (B. Steffen and A. Seyfried, Methods for measuring pedestrian density, flow, speed
/// and direction with minimal scatter, Physica A 389, 2010, measure densities so.)
///
/// The area is 0 if the point is outside of the walkable area, decided exactly; walls belong to it.
/// Points that coincide for a while (coincident_points) share the area of their cell equally. Of
/// points of equal weights that coincide only at current_time(), the one with the least id has the
/// area of the common cell, or shares it with those that coincide with it for a while, and the
/// others have 0. A power cell need not contain its point; then all of its parts count. If it is
/// only a segment, its area is at most `error`. Without obstacles the areas of points in a convex
/// walkable area sum to its area. In a periodic box the cells are those among all images, and
/// without a cutoff their areas sum to the area of the box.
///
/// The cutoff is an exact circle, not a polygon. Which sides a cell has is exact; the rest is
/// binary64 arithmetic. `error` bounds the sum of all errors. Let u = 2^-53, h the largest
/// coordinate of a clipped corner relative to the point, l the perimeter of a part of the cell, and
/// n its number of sides: the bound is (80 + 18 n) u h l, and with a cutoff r 32 u r^2 more for
/// each side (docs/MATH.md, section 13). Whether walls leave an opening is also decided exactly,
/// unless the time is irrational and the opening narrower than these errors. The bound holds
/// without underflow, as is certain for lengths beyond 1e-150.
///
/// Cost: some 100 floating-point operations for each neighbor, and a search in a tree of the walls;
/// near walls, as much for each triangle of the walkable area that the cell meets. Exact arithmetic
/// only if positions almost coincide, or lie almost on a wall. Throws Precondition_error as
/// Cell_limits::check, and in a periodic box if a cell may reach 1e150.
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
extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Periodic_kinetic_traits_2>&, const Cell_limits&);
extern template std::vector<Cell_area> cell_areas(
    const Kinetic_triangulation_2<Periodic_disc_kinetic_traits_2>&, const Cell_limits&);

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CELL_AREAS_H
