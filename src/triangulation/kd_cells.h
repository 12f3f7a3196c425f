// SPDX-License-Identifier: GPL-3.0-or-later
//
// A partition of the plane into cells with about the same number of positions.
#ifndef KINETRI_SRC_TRIANGULATION_KD_CELLS_H
#define KINETRI_SRC_TRIANGULATION_KD_CELLS_H

#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// A k-d tree whose leaves, the cells, are numbered in their order.
class Kd_cells {
 public:
  /// A position is in the cell if least <= position < greatest in each coordinate. Bounds may be
  /// infinite.
  struct Cell {
    Vector_2 least;
    Vector_2 greatest;
  };

  /// Splits the plane into `count` cells by a sample of the positions: perpendicular to the longer
  /// side of their bounding box, so that cells on both sides have equally many. Preconditions:
  /// count > 0; the coordinates are finite. O(n log count) for a sample of size n.
  Kd_cells(std::vector<Vector_2> sample, std::size_t count);

  /// The step k such that every k-th of `places` positions is a sufficient sample for `count`
  /// cells, some hundred for each. Precondition: count > 0.
  static std::size_t sample_step(std::size_t places, std::size_t count) {
    constexpr std::size_t sample_per_cell = 128;
    return places / (sample_per_cell * count) + 1;
  }

  /// The cell of a position. Precondition: the coordinates are finite. O(log count).
  std::size_t cell_of(const Vector_2& place) const;

  std::span<const Cell> cells() const { return cells_; }

 private:
  /// A part of the plane with at least one cell. If it has more, the next node is its part below
  /// the split.
  struct Node {
    std::size_t cells;
    std::size_t first_cell;
    double Vector_2::*axis = nullptr;
    double at = 0;
    std::size_t above = 0;  // the node of the part from the split on
  };

  void split(std::span<Vector_2> places, std::size_t count, const Cell& part);

  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_KD_CELLS_H
