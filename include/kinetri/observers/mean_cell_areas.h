// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mean over time of the area of each point.
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

  /// The mean of each point that has existed for a time, up to now or its erasure, by ascending id.
  std::vector<Mean_cell_area> means();

 private:
  using Point_2 = typename Traits::Point_2;
  using Changed_point = typename Edge_follower<Traits>::Changed_point;

  struct Record {
    double from = 0;
    double until = 0;  // the end of what has been integrated
    double integral = 0;
    double error = 0;
    bool has_come = false;
    bool is_there = false;
    bool is_hidden = false;            // by a triangle
    bool is_linked = false;            // hidden by a point that coincides with it for a while
    int count = 1;                     // of points that share the cell
    std::vector<Point_2> points = {};  // the point, and the neighbors of the cell
  };

  void start(const Cell_limits& limits, double tolerance);
  void advance(const Algebraic_number& /*time*/) override {}
  void change(const Algebraic_number& time, std::span<const Edge_ids> removed,
              std::span<const Edge_ids> added, std::span<const Changed_point> points) override;
  void integrate(Record& record, double until);
  void begin(Point_id id, double time);
  void update_link(Point_id id);
  // The point that has the vertex of the point.
  Point_id shown_at(Point_id id) const { return this->graph().hidden_by(id).value_or(id); }

  std::unique_ptr<detail::Cell_integrator<Traits>> integrator_;
  std::vector<Record> records_;  // by id
  std::size_t edges_ = 0;        // of the graph
  std::size_t links_ = 0;        // those of them that join points that coincide for a while
};

extern template class Mean_cell_areas<Linear_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_kinetic_traits_2>;
extern template class Mean_cell_areas<Disc_kinetic_traits_2>;
extern template class Mean_cell_areas<Polynomial_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_MEAN_CELL_AREAS_H
