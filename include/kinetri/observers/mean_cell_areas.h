// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mean over time of the area of each point.
#ifndef KINETRI_OBSERVERS_MEAN_CELL_AREAS_H
#define KINETRI_OBSERVERS_MEAN_CELL_AREAS_H

#include <cstddef>
#include <memory>
#include <vector>

#include "kinetri/observers/cell_areas.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

namespace detail {
template <DistanceKineticTraits_2 Traits>
class Mean_area_tracker;
}  // namespace detail

/// The mean area of a point over the time in which it was observed.
struct Mean_cell_area {
  Point_id id = no_point;  ///< the point
  double from = 0;         ///< when that time began, rounded to the nearest binary64 number
  double until = 0;        ///< when it ended, or now; later than `from`
  double area = 0;         ///< the integral of the area over that time, divided by its length
  double error = 0;        ///< an estimate of the error of the mean, see Mean_cell_areas
};

/// An observer that integrates the area of each point's cell (cell_areas) over time; points that
/// coincide for a while share the area of their cell equally. Between two changes of the neighbors,
/// of their motions and its own, or of the points that share its cell, the area is a piecewise
/// smooth function of time: walls may begin to cut the cell in another way, or separate a part of
/// it, so that the area jumps. Each such piece of time is integrated separately, by the rule of
/// Gauss and Kronrod with 7 nodes (A. S. Kronrod, Nodes and weights of quadrature formulas, 1965),
/// and halved, up to 10 times, until the estimate of the error is small.
///
/// `error` is the sum, over the pieces, of the difference of the two rules, and of the bounds of
/// the errors of the areas (Cell_area::error) at the nodes. The difference is an estimate, not a
/// bound, since the rules evaluate the function at their nodes only; in general the rule of Kronrod
/// is far better than the difference.
///
/// Cost: 7 areas of cells for each piece and point, and more if it is halved. Memory: O(n), and one
/// result for each point that has ever existed.
template <DistanceKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Mean_cell_areas {
 public:
  /// @{
  /// Observes from the current time on. A piece is divided until the estimate of its error is at
  /// most `tolerance` times its integral. Throws Precondition_error as Cell_limits::check, and if
  /// the tolerance is not greater than 0. What is observed must outlive this object.
  Mean_cell_areas(Simulation_2<Traits>& simulation, const Cell_limits& limits,
                  double tolerance = 1e-6);
  /// The same of a triangulation.
  Mean_cell_areas(Kinetic_triangulation_2<Traits>& triangulation, const Cell_limits& limits,
                  double tolerance = 1e-6);
  /// @}
  ~Mean_cell_areas();

  /// The mean of each point that has existed for a time, up to now or its erasure, by ascending id.
  std::vector<Mean_cell_area> means();

 private:
  std::unique_ptr<detail::Mean_area_tracker<Traits>> tracker_;
};

extern template class Mean_cell_areas<Linear_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_kinetic_traits_2>;
extern template class Mean_cell_areas<Disc_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_disc_kinetic_traits_2>;
extern template class Mean_cell_areas<Periodic_kinetic_traits_2>;
extern template class Mean_cell_areas<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_MEAN_CELL_AREAS_H
