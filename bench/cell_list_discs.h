// SPDX-License-Identifier: GPL-3.0-or-later
//
// The baseline for colliding discs: event-driven molecular dynamics of hard discs in a box, in
// doubles, without certificates or a triangulation. Rounding decides the order of collisions that
// are nearly simultaneous, and how far discs overlap.
//
// Cells are at least as wide as the greatest diameter, so a disc's events are its collisions with
// discs of the 3 x 3 cells around it, its passage to the next cell, and the wall. A disc is moved
// only at its events. The queue has one entry for each disc, its next event, computed when its
// motion last changed. If the partner of a collision changes its velocity first, the disc's next
// event is searched for again only at the old time: the disc collides with nothing earlier.
// Sources: D. C. Rapaport, The event scheduling problem in molecular dynamic simulation, J. Comput.
// Phys. 34 (1980); B. D. Lubachevsky, How to simulate billiards and similar systems, J. Comput.
// Phys. 94 (1991); M. Marin, D. Risso, P. Cordero, Efficient algorithms for many-body hard particle
// molecular dynamics, J. Comput. Phys. 109 (1993).
#ifndef KINETRI_BENCH_CELL_LIST_DISCS_H
#define KINETRI_BENCH_CELL_LIST_DISCS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/simulation/box_2.h"
#include "time_wheel.h"

namespace kinetri::bench {

struct Cell_list_counters {
  std::uint64_t collisions = 0;
  std::uint64_t wall_contacts = 0;
  std::uint64_t crossings = 0;     ///< passages to another cell
  std::uint64_t looked_again = 0;  ///< collisions whose partner had changed its velocity
};

/// The discs from time 0 on. Walls reflect their centers; discs collide elastically, with their
/// areas as masses. Preconditions: at least one disc; centers in the box; positive radii; epochs 0;
/// no overlap.
class Cell_list_discs {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  Cell_list_discs(std::span<const Linear_motion_2> motions, std::span<const double> radii,
                  const Box_2& box);

  /// Executes all events up to `time`.
  void advance_to(double time);

  const Cell_list_counters& counters() const { return counters_; }

  /// From now on the discs of each collision are appended to `log`, the smaller id first.
  void log_collisions(std::vector<Pair>& log) { log_ = &log; }

  /// The sum of the squared speeds, each times the square of the radius.
  long double energy() const;

  /// The greatest present overlap of two discs, divided by the sum of their radii; 0 if none
  /// overlap.
  double deepest_overlap() const;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// A disc at its last event, in one cache line.
  struct alignas(64) Disc {
    Vector_2 place;
    Vector_2 velocity;
    double radius = 0;
    double time = 0;
    std::uint32_t changes = 0;  // of its velocity
    std::uint32_t next = none;  // in its cell
    std::uint32_t previous = none;
    std::uint16_t column = 0;
    std::uint16_t row = 0;
  };

  /// The earliest collision found, with the partner's number of velocity changes then, and the exit
  /// from the cell.
  struct Plan {
    double collision_time = never;
    double crossing_time = never;
    std::uint32_t partner = none;
    std::uint32_t partner_changes = 0;
    bool crosses_column = false;  // else row
  };

  /// The bounds of the columns or rows of cells, one more than there are.
  static std::vector<double> bounds(double first, double last, double least_width);

  std::size_t cell(std::size_t column, std::size_t row) const { return row * stride_ + column; }
  void enter(std::uint32_t id);
  void leave(std::uint32_t id);

  void move_to(Disc& disc, double time) const;
  double collision_time(const Disc& p, const Disc& q) const;
  void look_at_cell(std::uint32_t id, std::size_t cell);
  void find_collision(std::uint32_t id);
  void find_crossing(std::uint32_t id);
  void plan_anew(std::uint32_t id);
  double next_event_time(std::uint32_t id) const;
  void schedule(std::uint32_t id);

  void collide(std::uint32_t id);
  void cross(std::uint32_t id);

  std::vector<double> column_bounds_;
  std::vector<double> row_bounds_;
  std::size_t stride_;                // of a row, which has an empty cell at either end
  std::vector<std::uint32_t> cells_;  // the first disc of each; empty cells around
  std::vector<Disc> discs_;
  std::vector<Plan> plans_;  // by disc
  Time_wheel queue_;         // by disc
  double now_ = 0;
  std::vector<Pair>* log_ = nullptr;
  Cell_list_counters counters_;
};

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_CELL_LIST_DISCS_H
