// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets of images in a periodic box: sums, and how many whole lattice vectors one position is
// from another, exactly.
#ifndef KINETRI_SRC_TRIANGULATION_WHOLE_VECTORS_H
#define KINETRI_SRC_TRIANGULATION_WHOLE_VECTORS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

inline Lattice_offset_2 reversed(const Lattice_offset_2& offset) {
  return {-offset.x, -offset.y};  // The smallest integer is none.
}

/// The offset of an image. Throws Periodic_box_error if it is 2^31 or more.
inline Lattice_offset_2 offset_of_image(std::int64_t x, std::int64_t y) {
  const auto result = to_offset(x, y);
  if (result) return *result;
  throw Periodic_box_error(
      "an image of a point is 2^31 or more lattice vectors away from the position of the point; "
      "give positions that are closer together");
}

/// Throws Periodic_box_error if the sum is 2^31 or more.
inline Lattice_offset_2 sum(const Lattice_offset_2& a, const Lattice_offset_2& b) {
  return offset_of_image(std::int64_t{a.x} + b.x, std::int64_t{a.y} + b.y);
}

/// The greatest integer for which `is_reached` holds, which holds for all lesser ones and for no
/// greater one; none if that is 2^31 or more, or less. The search begins near `guess`.
template <class IsReached>
std::optional<std::int64_t> greatest_reached(double guess, const IsReached& is_reached) {
  constexpr std::int64_t beyond = std::int64_t{1} << 31;
  std::int64_t low = -beyond;  // reached, or not known
  std::int64_t high = beyond;  // not reached, or not known
  std::int64_t k = std::abs(guess) < 0x1p31 - 1 ? static_cast<std::int64_t>(std::floor(guess)) : 0;
  for (std::int64_t step = 1; low + 1 < high;) {
    (is_reached(k) ? low : high) = k;
    if (high == beyond) {
      k = std::min(low + step, high - 1);
      step *= 2;
    } else if (low == -beyond) {
      k = std::max(high - step, low + 1);
      step *= 2;
    } else {
      k = low + (high - low) / 2;
    }
  }
  if (low == -beyond || high == beyond) return std::nullopt;
  return low;
}

/// Two vectors, given by their offsets, of which the second is to the left of the first.
using Lattice_basis_2 = std::array<Lattice_offset_2, 2>;

/// The sum of whole multiples of the vectors of the basis that leads from `from` to an image of it
/// such that `to` is in the parallelogram of the two vectors at that image, or on one of its two
/// sides there, and not on the other two. Exact. Throws Periodic_box_error if a number is 2^31 or
/// more. Precondition: the predicates are those at a time.
template <class Predicates>
Lattice_offset_2 whole_vectors(const Predicates& at, const typename Predicates::Point_2& from,
                               const typename Predicates::Image_2& to,
                               const Lattice_basis_2& basis = {{{1, 0}, {0, 1}}}) {
  const auto known = [&](const std::optional<Lattice_offset_2>& offset) {
    if (offset) return *offset;
    throw Periodic_box_error(
        "a position is 2^31 or more lattice vectors away from " +
        (from.id() == no_point ? "the origin" : "point " + std::to_string(from.id())) +
        "; expected less: take an image of it that is closer");
  };
  const auto offset = [&](std::int64_t first, std::int64_t second) {
    return known(to_offset(first * basis[0].x + second * basis[1].x,
                           first * basis[0].y + second * basis[1].y));
  };
  const auto image = [&](std::int64_t first, std::int64_t second) {
    return at.image(from, offset(first, second));
  };
  const auto vector_to = [&, t = at.instant().time.to_double()](const auto& p) -> Vector_2 {
    const Vector_2 here = rounded_place(image(0, 0).motion(), t);
    const Vector_2 there = rounded_place(p.motion(), t);
    return {there.x - here.x, there.y - here.y};
  };
  const auto cross = [](const Vector_2& a, const Vector_2& b) { return a.x * b.y - a.y * b.x; };
  const Vector_2 first = vector_to(image(1, 0));
  const Vector_2 second = vector_to(image(0, 1));
  const Vector_2 whole = vector_to(to);
  const double area = cross(first, second);
  const auto orientation = at.orientation_2_object();
  const auto k = greatest_reached(cross(whole, second) / area, [&](std::int64_t number) {
    return orientation(image(number, 0), image(number, 1), to) != CGAL::LEFT_TURN;
  });
  const auto l = greatest_reached(cross(first, whole) / area, [&](std::int64_t number) {
    return orientation(image(0, number), image(1, number), to) != CGAL::RIGHT_TURN;
  });
  return known(k && l ? std::optional(offset(*k, *l)) : std::nullopt);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_WHOLE_VECTORS_H
