// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much room each point has had on the average of a time.
#ifndef KINETRI_OBSERVERS_MEAN_CELL_AREAS_H
#define KINETRI_OBSERVERS_MEAN_CELL_AREAS_H

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kinetri/impl/observers/edge_follower.h"
#include "kinetri/observers/cell_areas.h"

namespace kinetri {

namespace detail {

template <class Traits>
class Cell_integrator;

}  // namespace detail

/// The room of a point on the average of the time in which it was observed.
struct Mean_cell_area {
  Point_id id = no_point;  ///< the point
  double from = 0;         ///< when that time began, rounded to the nearest binary64 number
  double until = 0;        ///< when it ended, or now; later than `from`
  double area = 0;         ///< the integral of the area over that time, divided by its length
  double error = 0;        ///< an estimate of how far the mean is off, see Mean_cell_areas
};

/// An observer that integrates the area of each point's cell (cell_areas) over time. Between two
/// changes of its neighbors, and of the motions of these and its own, the area is a smooth function
/// of time, but where walls begin to cut the cell in another way, or it jumps, as where walls
/// separate a part of the cell. Each such piece of time is integrated by itself, by the rule of
/// Gauss and Kronrod with 7 nodes (A. S. Kronrod, Nodes and weights of quadrature formulas, 1965),
/// and divided in halves, up to 10 times, until the estimate of the error is small.
///
/// `error` is the sum, over the pieces, of the difference of the two rules, and of the bounds of
/// the errors of the areas (Cell_area::error) at the nodes. The first of these is an estimate and
/// no bound, as a rule sees the function at its nodes only; that of Kronrod is in general far
/// better than the difference.
///
/// Cost: 7 areas of cells for a piece, and more where the error is not small at once. Memory: O(n),
/// and one result for each point that has ever been there.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Mean_cell_areas : private Edge_follower<Traits> {
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
  ~Mean_cell_areas() override;

  /// The mean up to now, or up to when the point left, of each point that has been there for a
  /// time, by ascending id.
  std::vector<Mean_cell_area> means();

 private:
  using Point_2 = typename Traits::Point_2;
  using Changed_point = typename Edge_follower<Traits>::Changed_point;

  // What is known of a point.
  struct Record {
    double from = 0;
    double until = 0;  // as far as has been integrated
    double integral = 0;
    double error = 0;
    bool has_come = false;
    bool is_there = false;
    bool is_hidden = false;
    std::vector<Point_2> points = {};  // the point, and its neighbors
  };

  void start(const Cell_limits& limits, double tolerance);
  void advance(const Algebraic_number& /*time*/) override {}
  void change(const Algebraic_number& time, std::span<const Edge_ids> removed,
              std::span<const Edge_ids> added, std::span<const Changed_point> points) override;
  void integrate(Record& record, double until);
  void begin(Point_id id, double time);

  std::unique_ptr<detail::Cell_integrator<Traits>> integrator_;
  std::vector<Record> records_;  // by id
  std::size_t edges_ = 0;        // of the graph
};

extern template class Mean_cell_areas<Linear_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_kinetic_traits_2>;
extern template class Mean_cell_areas<Disc_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_MEAN_CELL_AREAS_H
