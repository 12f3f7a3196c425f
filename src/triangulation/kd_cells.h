// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane cut into cells that hold about as many places each.
#ifndef KINETRI_SRC_TRIANGULATION_KD_CELLS_H
#define KINETRI_SRC_TRIANGULATION_KD_CELLS_H

#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// A k-d tree whose leaves are cells, numbered from 0; cells of near numbers are near one another.
class Kd_cells {
 public:
  /// A place is in the cell if least <= place < greatest, in each coordinate; these may be
  /// infinite.
  struct Cell {
    Vector_2 least;
    Vector_2 greatest;
  };

  /// Cuts the plane into `count` cells by a sample of the places: across its longer side, so that
  /// both sides get as many places for each of their cells. Precondition: count > 0; the
  /// coordinates are finite. O(n log count) for a sample of n places.
  Kd_cells(std::vector<Vector_2> sample, std::size_t count);

  /// Every so manieth of `places` places is enough of a sample for `count` cells: some hundred for
  /// each cell. Precondition: count > 0.
  static std::size_t sample_step(std::size_t places, std::size_t count) {
    constexpr std::size_t sample_per_cell = 128;
    return places / (sample_per_cell * count) + 1;
  }

  /// The cell that a place is in. Precondition: the coordinates are finite. O(log count).
  std::size_t cell_of(const Vector_2& place) const;

  /// All cells, by number.
  std::span<const Cell> cells() const { return cells_; }

 private:
  /// A part of the plane with one cell or more. If there are more, the part below the cut is the
  /// next node.
  struct Node {
    std::size_t cells;
    std::size_t first_cell;
    double Vector_2::*axis = nullptr;
    double at = 0;
    std::size_t above = 0;  // the node of the part from the cut on
  };

  void split(std::span<Vector_2> places, std::size_t count, const Cell& part);

  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_KD_CELLS_H
