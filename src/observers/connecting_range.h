// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the length of an edge, one after the other of a sequence of edges, is least or greatest.
#ifndef KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H
#define KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H

#include <optional>
#include <span>
#include <vector>

#include "kinetri/observers/kinetic_spanning_tree_2.h"

namespace kinetri::detail {

/// The length of an edge from one time to another one, both included: the square root of the
/// polynomial with these coefficients, by ascending power.
struct Length_piece {
  Algebraic_number from;
  Algebraic_number to;
  Edge_ids edge;
  std::vector<Rational> squared_length;
};

/// The squared distance of two points, as a polynomial in time, by ascending power.
template <class Point>
std::vector<Rational> squared_distance(const Point& p, const Point& q);

/// The length at a time.
Algebraic_number length_at(const std::vector<Rational>& squared_length,
                           const Algebraic_number& time);

/// The least length of the pieces, or the greatest one, at the first time at which it is that; none
/// of no pieces. Precondition: the pieces are in the order of time. Exact; what interval arithmetic
/// excludes costs no more.
std::optional<Connecting_range> extreme_length(std::span<const Length_piece> pieces, bool greatest);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_CONNECTING_RANGE_H
