// SPDX-License-Identifier: GPL-3.0-or-later
//
// A field on moving points: each point has values, such as a color or a temperature, which are
// interpolated at positions in the convex hull, at the current time.
//
// The triangle of a position is found exactly. Then values are computed from correctly rounded
// positions by a fixed sequence of binary64 additions, multiplications and divisions. So the
// results have the same bits on every machine that rounds to nearest; the code is compiled in the
// library, where no multiplication is fused with an addition.
#ifndef KINETRI_TRIANGULATION_FIELD_2_H
#define KINETRI_TRIANGULATION_FIELD_2_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// A value that changes linearly in time: value + slope * (t - epoch). All numbers are finite.
struct Linear_value {
  double value = 0;  ///< at the epoch
  double slope = 0;  ///< change per unit of time
  double epoch = 0;  ///< the time at which it is `value`

  friend bool operator==(const Linear_value&, const Linear_value&) = default;
};

/// How values are interpolated.
enum class Interpolation : std::uint8_t {
  /// The mean of the three corners of the triangle. It jumps at edges.
  flat,
  /// The linear function on the triangle that has the values of the corners. It is continuous, but
  /// when an edge is flipped, the values in its quadrilateral jump.
  linear,
  /// Natural neighbor interpolation with Laplace coordinates. It does not depend on the
  /// triangulation, and so does not jump when an edge is flipped (docs/MATH.md, section 16). It
  /// reproduces linear functions. Sources: N. H. Christ, R. Friedberg, T. D. Lee, Weights of links
  /// and plaquettes in a random lattice, Nuclear Physics B 210, 1982; V. V. Belikov et al., The
  /// non-Sibsonian interpolation, Computational Mathematics and Mathematical Physics 37, 1997.
  smooth,
};

/// The positions (column, row) of a raster.
struct Grid_2 {
  Vector_2 origin = {0, 0};  ///< of column 0 and row 0
  Vector_2 step = {1, 1};    ///< to the next column, and to the next row; either may be negative
  std::size_t columns = 0;   ///< how many in each row
  std::size_t rows = 0;      ///< how many

  /// The position: origin + step * (column, row), each product and each sum rounded to the nearest
  /// binary64 number.
  Vector_2 place(std::size_t column, std::size_t row) const;
};

/// Values at the points of a triangulation, and between them.
///
/// *The triangle of a position* is one that contains it, inside or on its boundary, of those that
/// have an area at the current time; of several, the one whose sorted ids come first. It is found
/// exactly. Positions outside the convex hull have no triangle and no values; nor has any position
/// while all points are collinear.
///
/// All values are rounded. Each lies between the least and the greatest value of the points that it
/// is computed from; equal values are reproduced exactly. At the rounded position of a point,
/// `linear` and `smooth` give its value (if points coincide, that of the corner of the triangle).
/// A value of `linear` is off by at most 2^-46 (v + d M / h): v is the greatest absolute value at
/// the corners, d the difference of the greatest and the least, M the greatest absolute coordinate,
/// and h the least height of the triangle. A value of `smooth` is rounded in the same way, without
/// such a bound near the hull and near flat triangles.
///
/// Points that coincide for a while (Coincident_points) are like one point that has the mean of
/// their values. The mean of n values is off by at most 2^-52 n
/// times the greatest of their absolute values.
///
/// The field refers to the triangulation; values belong to ids. Only for points without weights, in
/// the plane.
/// Several threads may call const functions at once, if none changes the triangulation. Coordinates
/// beyond 1e300 throw Precondition_error.
template <KineticTraits_2 Traits = Linear_kinetic_traits_2>
requires(!WeightedKineticTraits_2<Traits>) class Kinetic_field_2 {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< whose points have the values

  /// A field with `channels` values at each point, which are not set. Precondition: channels > 0.
  Kinetic_field_2(const Triangulation& triangulation, std::size_t channels);

  /// How many values each point has.
  std::size_t channels() const { return channels_; }

  /// Sets the values of a point, one for each channel. Precondition: the triangulation contains the
  /// point; the numbers are finite.
  void set_values(Point_id id, std::span<const Linear_value> values);

  /// The values of a point, one for each channel; none if they have not been set.
  std::span<const Linear_value> values(Point_id id) const;

  /// The values at a position, one for each channel, at the current time; none if the position has
  /// no triangle. The time is rounded to the nearest binary64 number for the values of the points.
  /// Precondition: the position is finite; the points that are used have values. Cost: a walk, as
  /// that of Kinetic_queries_2::locate; for `smooth` a test of each triangle whose circle contains
  /// the position.
  std::optional<std::vector<double>> at(const Vector_2& place, Interpolation interpolation) const;

  /// The values at all positions of a grid, row by row, the channels of one position side by side:
  /// the same bits as from `at`. NaN if the position has no triangle. Precondition: the grid is
  /// finite, with steps that are not zero; `result` has rows * columns * channels elements; all
  /// points have values. Cost: O(n log n), and some floating-point operations for each position,
  /// triangle and row that meet; for `smooth` a test of each triangle whose circle contains the
  /// position.
  void raster(const Grid_2& grid, Interpolation interpolation, std::span<double> result) const;

 private:
  const Triangulation& triangulation_;
  std::size_t channels_;
  std::vector<Linear_value> values_;  // by id, then by channel
  std::vector<bool> is_set_;          // by id
};

/// A position as a combination of the corners of its triangle.
struct Corner_weights {
  /// Counterclockwise, the least id first; no_point if the position has no triangle. Of points that
  /// coincide for a while the least id, for all of them, which share the weight equally.
  std::array<Point_id, 3> corners = {no_point, no_point, no_point};
  std::array<double, 3> weights =
      {};  ///< of the corners: at least 0, their sum is 1 up to rounding
};

/// The weights that `linear` uses at all positions of a grid, row by row, at the current time: for
/// fitting values to given ones. Precondition: the grid is finite, with steps that are not zero;
/// `result` has rows * columns elements. Cost: as that of Kinetic_field_2::raster.
template <KineticTraits_2 Traits>
requires(!WeightedKineticTraits_2<Traits>) void find_corner_weights(
    const Kinetic_triangulation_2<Traits>& triangulation, const Grid_2& grid,
    std::span<Corner_weights> result);

extern template void find_corner_weights(const Kinetic_triangulation_2<Linear_kinetic_traits_2>&,
                                         const Grid_2&, std::span<Corner_weights>);
extern template void find_corner_weights(
    const Kinetic_triangulation_2<Polynomial_kinetic_traits_2>&, const Grid_2&,
    std::span<Corner_weights>);

extern template class Kinetic_field_2<Linear_kinetic_traits_2>;
extern template class Kinetic_field_2<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_FIELD_2_H
