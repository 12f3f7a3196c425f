// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Euclidean minimum spanning tree over time, as the rows of one table.
#ifndef KINETRI_IMPL_OBSERVERS_SPANNING_TREE_ROWS_H
#define KINETRI_IMPL_OBSERVERS_SPANNING_TREE_ROWS_H

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "kinetri/observers/kinetic_spanning_tree_2.h"

namespace kinetri::detail {

/// The kinds of rows.
enum class Spanning_tree_row_kind : std::uint8_t {
  start,     ///< an edge of the tree at the start
  remove,    ///< an edge of the tree just before the time and not just after it
  add,       ///< an edge of the tree just after the time and not just before it
  longest,   ///< the longest edge of the tree, from the time on
  least,     ///< the least range at which all points are connected, of all times
  greatest,  ///< the greatest such range
};

/// The kind's name in files: "start", "remove", ...
std::string_view name(Spanning_tree_row_kind kind);

/// A row, about one edge.
struct Spanning_tree_row {
  Algebraic_number time;                                        ///< exact
  Spanning_tree_row_kind kind = Spanning_tree_row_kind::start;  ///< what happens
  Edge_ids edge = {no_point, no_point};                         ///< the smaller id first
  Lattice_offset_2 offset = {};  ///< in a periodic box, of the second end; else zero
  /// Of `longest`, `least` and `greatest`, the length of the edge at the time, rounded to nearest,
  /// ties to even; else NaN.
  double length = std::numeric_limits<double>::quiet_NaN();
};

/// An observer that follows a Kinetic_spanning_tree_2 from the current time on.
template <SimulationKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Spanning_tree_rows {
 public:
  /// @{
  /// What is observed must outlive this object.
  explicit Spanning_tree_rows(Simulation_2<Traits>& simulation);
  explicit Spanning_tree_rows(Kinetic_triangulation_2<Traits>& triangulation);
  /// @}

  /// The edges at the start, sorted; then the changes in the order of time, at one time removed
  /// edges, added edges, and the longest edge if it has changed; at the end the least and the
  /// greatest range, each at its first time. These two, and longest edges, exist if there are two
  /// or more points. Cost: see Kinetic_spanning_tree_2.
  std::vector<Spanning_tree_row> rows();

 private:
  Kinetic_spanning_tree_2<Traits> tree_;
  Algebraic_number start_;
  std::vector<Edge_name<Traits>> at_start_;
};

extern template class Spanning_tree_rows<Linear_kinetic_traits_2>;
extern template class Spanning_tree_rows<Polynomial_kinetic_traits_2>;
extern template class Spanning_tree_rows<Periodic_kinetic_traits_2>;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_OBSERVERS_SPANNING_TREE_ROWS_H
