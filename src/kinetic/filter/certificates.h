// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates and predicates in the form that classify.h takes. An error is infinite if the values
// cannot be computed.
#ifndef KINETRI_SRC_KINETIC_FILTER_CERTIFICATES_H
#define KINETRI_SRC_KINETIC_FILTER_CERTIFICATES_H

#include <limits>

#include "differences.h"
#include "error_bounds.h"

namespace kinetri {

inline constexpr double infinite_error = std::numeric_limits<double>::infinity();

// The error of a product of two differences.
template <class Differences>
inline double product_error(const Differences& d) {
  if (!d.is_in_range()) return infinite_error;
  return d.product_units * unit_roundoff * (d.size() * d.total());
}

// The error of a coordinate of a difference; at most one underflow may occur in it.
template <class Differences>
inline double coordinate_error(const Differences& d) {
  return d.coordinate_units * unit_roundoff * d.total() + std::numeric_limits<double>::min();
}

// Minus the in-circle determinant, of differences to the fourth point.
struct In_circle {
  auto operator()(const auto& d) const { return in_circle(d); }
  double error(const auto& d) const {
    if (!d.is_in_range()) return infinite_error;
    return d.in_circle_units * unit_roundoff * d.lift_size() * (d.size() * d.total());
  }
  double norm(const auto& d) const { return 12 * d.lift_size() * (d.size() * d.size()); }
};

// These take differences to one point.
struct Orientation {
  auto operator()(const auto& d) const { return cross(d[0], d[1]); }
  double error(const auto& d) const { return product_error(d); }
  double norm(const auto& d) const { return 2 * (d.size() * d.size()); }
};
struct Scalar_product {
  auto operator()(const auto& d) const { return dot(d[0], d[1]); }
  double error(const auto& d) const { return product_error(d); }
};
struct Distance_order {
  auto operator()(const auto& d) const { return lifted(d, 0).lift - lifted(d, 1).lift; }
  double error(const auto& d) const {
    return 2 * (product_error(d) + d.product_units * unit_roundoff * d.weight_size());
  }
};

// This one takes one difference.
struct Coordinate {
  int axis;  // 0 or 1

  auto operator()(const auto& d) const { return coordinate(d[0], axis); }
  double error(const auto& d) const { return coordinate_error(d); }
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_CERTIFICATES_H
