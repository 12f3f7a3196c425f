// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area of one cell within walls and a circle, in binary64 arithmetic.
#ifndef KINETRI_SRC_OBSERVERS_LIMITED_CELL_H
#define KINETRI_SRC_OBSERVERS_LIMITED_CELL_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/impl/triangulation/ball.h"
#include "kinetri/impl/triangulation/clipped_polygon.h"
#include "kinetri/observers/cell_areas.h"
#include "observers/triangulated_area.h"

namespace kinetri::detail {

/// The sides of the cell of a point, as half planes from the point on.
struct Sides_of_cell {
  std::vector<Half_plane> half_planes;
  /// The half planes are off by at most this, besides some units in the last place of the vectors
  /// to what they cut.
  double displacement = 0;
  bool is_empty = false;  ///< whether there is no cell, whatever the half planes are
};

/// Decides where binary64 numbers do not.
class Exact_cell {
 public:
  virtual ~Exact_cell() = default;
  Exact_cell(const Exact_cell&) = delete;
  Exact_cell& operator=(const Exact_cell&) = delete;

  /// Whether the point is on the line through two positions, or to the left of it.
  virtual bool is_left(const Vector_2& from, const Vector_2& to) const = 0;

  /// Whether a segment has a positive length inside of the cell and of the circle. None if the time
  /// is irrational.
  virtual std::optional<bool> is_open(const Vector_2& from, const Vector_2& to,
                                      double cutoff) const = 0;

 protected:
  Exact_cell() = default;
};

/// Measures cells within the limits. Keeps memory for the next one: one thread at a time.
///
/// The walkable area is a union of triangles (Triangulated_area). What a cell, a disc and a
/// triangle have in common is convex, and so connected; two such parts are connected where the side
/// between their triangles has, in the cell and the disc, a positive length. So the part of a cell
/// that has the point is found from triangle to triangle, beginning with the point's own.
class Limited_cell {
 public:
  explicit Limited_cell(const Cell_limits& limits);

  /// The area and its error, without the id. `place` is that of the point, each coordinate known
  /// well.
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
  // Of the present cell.
  Ball_2 place_;
  Box_2 box_;         // from the point on, contains all that the limits leave
  double scale_ = 0;  // the largest coordinate of that
  Cell_area result_;
  Clipped_polygon cell_;
  Clipped_polygon part_;
  std::vector<std::size_t> open_;  // triangles that are yet to be looked at
  // Of each triangle the number of the cell for which it has been visited last.
  std::vector<std::uint64_t> visited_;
  std::uint64_t number_ = 0;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_LIMITED_CELL_H
