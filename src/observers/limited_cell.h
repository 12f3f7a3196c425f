// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area of one cell within walls and a circle, in binary64 arithmetic.
#ifndef KINETRI_SRC_OBSERVERS_LIMITED_CELL_H
#define KINETRI_SRC_OBSERVERS_LIMITED_CELL_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/observers/cell_areas.h"
#include "observers/triangulated_area.h"
#include "triangulation/ball.h"
#include "triangulation/clipped_polygon.h"

namespace kinetri::detail {

/// The sides of the cell of a point, as half planes relative to the point.
struct Sides_of_cell {
  std::vector<Half_plane> half_planes;
  /// Bound of the errors of the half planes, besides some units in the last place of the vectors to
  /// what they clip.
  double displacement = 0;
  bool is_empty = false;  ///< whether the cell is empty in any case
};

/// Exact decisions, if binary64 numbers do not decide.
class Exact_cell {
 public:
  virtual ~Exact_cell() = default;
  Exact_cell(const Exact_cell&) = delete;
  Exact_cell& operator=(const Exact_cell&) = delete;

  /// Whether the point is on the line through two positions, or to the left of it.
  virtual bool is_left(const Vector_2& from, const Vector_2& to) const = 0;

  /// Whether the part of a segment inside the cell and the circle has a positive length. None if
  /// the time is irrational.
  virtual std::optional<bool> is_open(const Vector_2& from, const Vector_2& to,
                                      double cutoff) const = 0;

 protected:
  Exact_cell() = default;
};

/// Measures cells within the limits. Reuses memory: for one thread at a time.
///
/// The walkable area is a union of triangles (Triangulated_area). The intersection of a cell, a
/// disc and a triangle is convex; two such parts are connected if the common side of their
/// triangles has a positive length in the cell and the disc. So the part of a cell that contains
/// the point is found by a search over triangles from that of the point.
class Limited_cell {
 public:
  /// Throws as Cell_limits::check. In a periodic box set_reach must be called.
  Limited_cell(const Cell_limits& limits, bool is_in_box);

  /// From now on no position of a cell is farther from its point than this, without the limits.
  void set_reach(double reach) { reach_ = reach; }

  /// The area and its error, without the id. `place` is the accurate position of the point.
  Cell_area measure(const Sides_of_cell& sides, const Ball_2& place, const Exact_cell& exact);

 private:
  using Triangle = Triangulated_area::Triangle;

  Vector_2 relative(const Vector_2& v) const;
  bool is_left(const Vector_2& from, const Vector_2& to, const Exact_cell& exact) const;
  void find_triangles_of_point(const Exact_cell& exact);
  bool find_box();
  Box_2 extent_of_cell() const;
  bool is_wall_near(const Sides_of_cell& sides) const;
  bool may_meet(const Triangulated_area::Wall& wall, const Sides_of_cell& sides) const;
  void add(const Clipped_polygon& part, const Sides_of_cell& sides, double scale);
  void add_within(const Triangle& triangle, const Sides_of_cell& sides);
  void add_connected(const Sides_of_cell& sides, bool has_point, const Exact_cell& exact);
  bool is_open(const Vector_2& from, const Vector_2& to, const Sides_of_cell& sides,
               const Exact_cell& exact) const;
  bool is_open(const Vector_2& from, const Vector_2& to, const Sides_of_cell& sides,
               double margin) const;
  bool visit(std::size_t triangle);

  const Cell_limits& limits_;
  const Triangulated_area* area_ = nullptr;
  double reach_ = std::numeric_limits<double>::infinity();
  // Of the present cell.
  Ball_2 place_;
  Box_2 box_;         // relative to the point, contains the limited cell
  double scale_ = 0;  // the largest coordinate of that
  Cell_area result_;
  Clipped_polygon cell_;
  Clipped_polygon part_;
  std::vector<std::size_t> open_;  // triangles that are still to be examined
  // By triangle: the number of the last cell for which it has been visited.
  std::vector<std::uint64_t> visited_;
  std::uint64_t number_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_LIMITED_CELL_H
