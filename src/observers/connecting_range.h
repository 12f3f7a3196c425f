// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extreme length of the longest edge of a spanning tree over time.
#ifndef KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H
#define KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinetri/algebra/algebraic_number.h"

namespace kinetri::detail {

/// The squared length of an edge from one time to another, both included: a polynomial, by
/// ascending power.
struct Length_piece {
  Algebraic_number from;
  Algebraic_number to;
  std::vector<Rational> squared_length;
};

/// The extreme length of several pieces.
struct Extreme_length {
  std::size_t piece;  ///< index
  Algebraic_number length;
  Algebraic_number time;
};

/// The squared distance of two points or images, as a polynomial in time, by ascending power.
template <class Point>
std::vector<Rational> squared_distance(const Point& p, const Point& q);

/// The length at a time.
Algebraic_number length_at(const std::vector<Rational>& squared_length,
                           const Algebraic_number& time);

/// The least or the greatest length of the pieces, at its first time; none without pieces. Exact;
/// interval arithmetic excludes most candidates. Precondition: the pieces are in the order of time.
std::optional<Extreme_length> extreme_length(std::span<const Length_piece> pieces, bool greatest);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H
