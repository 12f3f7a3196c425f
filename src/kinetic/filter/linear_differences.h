// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences of linear motions over a window, and their products.
#ifndef KINETRI_SRC_KINETIC_FILTER_LINEAR_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_LINEAR_DIFFERENCES_H

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include "bernstein.h"
#include "coordinate_pair.h"
#include "error_bounds.h"
#include "in_circle_coefficients.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

// difference(), if the epochs differ.
inline Difference difference_from_two_epochs(const Linear_motion_2& p, const Linear_motion_2& q,
                                             double origin, Pair& terms) {
  const Pair moved_p = pair(p.velocity) * (origin - p.epoch);
  const Pair moved_q = pair(q.velocity) * (origin - q.epoch);
  const Pair place = pair(p.position) - pair(q.position);
  terms += absolute(place) + absolute(moved_p) + absolute(moved_q);
  return {place + (moved_p - moved_q), pair(p.velocity) - pair(q.velocity)};
}

// The difference p - q at the origin; adds the magnitudes of all numbers that it is computed from
// to `terms`. The positions are subtracted first, so that their common part is not in the error.
inline Difference difference(const Linear_motion_2& p, const Linear_motion_2& q, double origin,
                             Pair& terms) {
  if (p.epoch != q.epoch) return difference_from_two_epochs(p, q, origin, terms);
  const Pair slope = pair(p.velocity) - pair(q.velocity);
  const Pair place = pair(p.position) - pair(q.position);
  const Pair moved = slope * (origin - q.epoch);
  terms += absolute(place) + absolute(moved);
  return {place + moved, slope};
}

// The sum of the magnitudes of all numbers that slopes were computed from, by coordinate. A slope
// of points is one difference of given numbers, with no error but its rounding: nothing is summed.
struct No_slope_terms {};
template <class Motion>
struct Slope_terms_type {
  using type = No_slope_terms;
};
template <class Motion>
using Slope_terms = typename Slope_terms_type<Motion>::type;

inline Difference difference(const Linear_motion_2& p, const Linear_motion_2& q, double origin,
                             Pair& terms, No_slope_terms& /*slope_terms*/) {
  return difference(p, q, origin, terms);
}

// The sizes of differences, by coordinate, until they are scaled.
template <class Motion>
class Linear_sizes {
 public:
  // The difference p - q at the origin, which is counted.
  Difference count(const Motion& p, const Motion& q, double origin) {
    const Difference d = difference(p, q, origin, terms_, slope_terms_);
    extent_ = greater(absolute(d.place), extent_);
    slope_ = greater(absolute(d.slope), slope_);
    return d;
  }

  // Bounds the positions.
  double extent() const { return greatest(extent_); }
  // The sum of all numbers that the positions were computed from.
  double terms() const { return sum(terms_); }
  // Bounds the slopes and, if they have more than one rounding, their errors too.
  double speed() const {
    if constexpr (has_slope_terms) {
      return greatest(slope_) + 0x1p-49 * sum(slope_terms_);
    } else {
      return greatest(slope_);
    }
  }
  // Bounds the slopes and the sum of all numbers that they were computed from.
  double slope_terms() const {
    if constexpr (has_slope_terms) {
      return speed() + sum(slope_terms_);
    } else {
      return speed();
    }
  }

 private:
  static constexpr bool has_slope_terms = !std::same_as<Slope_terms<Motion>, No_slope_terms>;

  Pair terms_ = {};
  Pair extent_ = {};
  Pair slope_ = {};
  [[no_unique_address]] Slope_terms<Motion> slope_terms_ = {};
};

// The differences of the points `from` to `to`, with bounds: by powers of the time from the origin;
// once scaled, by powers of w. `Motion` is Linear_motion_2 or, with image_differences.h,
// Image_motion_2.
template <std::size_t N, class Motion = Linear_motion_2>
class Linear_differences : public Error_bounds {
 public:
  // The errors, in units of 2^-53 * size^(degree - 1) * total: docs/MATH.md, section 7; of images,
  // section 18.
  static constexpr double in_circle_units = 2048;
  static constexpr double product_units = 256;
  static constexpr double coordinate_units = std::same_as<Motion, Linear_motion_2> ? 16 : 32;

  Linear_differences(const std::array<const Motion*, N>& from, const Motion& to, double origin) {
    Linear_sizes<Motion> sizes;
    for (std::size_t i = 0; i < N; ++i) differences_[i] = sizes.count(*from[i], to, origin);
    sizes_ = sizes;
  }

  // The time in which the points would pass `share` of their distance. None if they do not move
  // relative to each other.
  std::optional<double> window_ahead(double share) const {
    if (speed() == 0) return std::nullopt;
    return share * sizes_.extent() / speed();
  }

  void scale(double window) {
    for (Difference& d : differences_) d.slope *= window;
    const double moved = speed() * window;
    // The last term is more than the error of the extent.
    set_sizes(sizes_.extent() + moved + 0x1p-49 * terms(), terms() + slope_terms() * window);
  }

  const Difference& operator[](std::size_t i) const { return differences_[i]; }

  // As Linear_sizes says.
  double terms() const { return sizes_.terms(); }
  double speed() const { return sizes_.speed(); }
  double slope_terms() const { return sizes_.slope_terms(); }

 private:
  std::array<Difference, N> differences_;
  Linear_sizes<Motion> sizes_;
};

// The error of a product of unscaled position and slope, and whether it can be computed.
template <class Motion>
inline double unscaled_error(const Linear_differences<1, Motion>& d) {
  return 64 * unit_roundoff * (d.terms() * d.slope_terms());
}
template <class Motion>
inline bool is_unscaled_in_range(const Linear_differences<1, Motion>& d) {
  return is_in_range(d.terms()) && is_in_range(d.slope_terms());
}

// A bound for the change of a product of two positions, computed from `terms` and with slopes up to
// `speed`, throughout an interval that begins at the origin, with its rounding error; infinite if
// it cannot be computed.
inline double error_throughout(double terms, double speed, const Double_interval& interval) {
  // The length of the interval is rounded.
  const double moved = 2 * speed * (interval.upper - interval.lower);
  const double reach = terms + moved;
  if (!is_in_range(reach)) return std::numeric_limits<double>::infinity();
  return (Linear_differences<1>::product_units * unit_roundoff * reach + 4 * moved) * reach;
}
template <std::size_t N, class Motion>
inline double error_throughout(const Linear_differences<N, Motion>& d,
                               const Double_interval& interval) {
  return error_throughout(d.terms(), d.speed(), interval);
}

inline Coefficients<1> coordinate(const Difference& d, int axis) {
  return {d.place[axis], d.slope[axis]};
}

inline Coefficients<2> cross(const Difference& a, const Difference& b) {
  const Pair place = swapped(b.place);
  const Pair slope = swapped(b.slope);
  const Pair pp = a.place * place;
  const Pair ps = a.place * slope;
  const Pair sp = a.slope * place;
  const Pair ss = a.slope * slope;
  const Pair from_place = firsts(pp, ps) - seconds(pp, ps);
  const Pair from_slope = firsts(sp, ss) - seconds(sp, ss);
  return {from_place[0], from_place[1] + from_slope[0], from_slope[1]};
}

inline Coefficients<2> dot(const Difference& a, const Difference& b) {
  return {sum(a.place * b.place), sum(a.place * b.slope) + sum(a.slope * b.place),
          sum(a.slope * b.slope)};
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_LINEAR_DIFFERENCES_H
