// SPDX-License-Identifier: GPL-3.0-or-later
//
// Identifiers that name things across layers and in files.
#ifndef KINETRI_BASE_IDS_H
#define KINETRI_BASE_IDS_H

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <limits>

#include "kinetri/base/platform.h"

namespace kinetri {

/// The number of a point: points of the input are numbered from 0, and points that are inserted get
/// the next numbers. Never reused.
using Point_id = std::uint32_t;

/// The id of points outside the input, such as query points and circumcenters, and of the infinite
/// vertex.
inline constexpr Point_id no_point = std::numeric_limits<Point_id>::max();

/// The offset of an image in a periodic box: how often each lattice vector is added to a position.
struct Lattice_offset_2 {
  std::int32_t x = 0;  ///< how often the first lattice vector
  std::int32_t y = 0;  ///< how often the second

  friend auto operator<=>(const Lattice_offset_2&, const Lattice_offset_2&) = default;
};

/// What is to be added to `from` to get `to`, modulo 2^32 and so without overflow.
constexpr Lattice_offset_2 offset_between(const Lattice_offset_2& from,
                                          const Lattice_offset_2& to) {
  const auto difference = [](std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(b) - static_cast<std::uint32_t>(a));
  };
  return {difference(from.x, to.x), difference(from.y, to.y)};
}

/// An image of a point in a periodic box: its position is that of the point plus `offset.x` times
/// the first and `offset.y` times the second lattice vector.
struct Periodic_image {
  Point_id id = no_point;        ///< the point
  Lattice_offset_2 offset = {};  ///< of the image against the position of the point as given

  friend auto operator<=>(const Periodic_image&, const Periodic_image&) = default;
};

/// The corners of a triangle, counterclockwise.
using Triangle_ids = std::array<Point_id, 3>;

/// The corners in the same cyclic order, the least id first.
constexpr Triangle_ids triangle_ids(Point_id a, Point_id b, Point_id c) {
  if (a < b && a < c) return {a, b, c};
  return b < c ? Triangle_ids{b, c, a} : Triangle_ids{c, a, b};
}

/// A triangle in a periodic box, counterclockwise, which stands for all its images: the one with
/// the point corners[0], as given, and images of the other two points. Each corner could be the
/// first one; of these three names it is the least.
struct Periodic_triangle {
  Triangle_ids corners = {};                     ///< the points, the least id first
  std::array<Lattice_offset_2, 2> offsets = {};  ///< of the corners 1 and 2 against corner 0

  friend auto operator<=>(const Periodic_triangle&, const Periodic_triangle&) = default;
};

/// The triangle of these images, which are given counterclockwise.
constexpr Periodic_triangle periodic_triangle(const Periodic_image& a, const Periodic_image& b,
                                              const Periodic_image& c) {
  const auto named = [](const Periodic_image& p, const Periodic_image& q, const Periodic_image& r) {
    return Periodic_triangle{
        {p.id, q.id, r.id},
        {offset_between(p.offset, q.offset), offset_between(p.offset, r.offset)}};
  };
  return std::min({named(a, b, c), named(b, c, a), named(c, a, b)});
}

}  // namespace kinetri

#endif  // KINETRI_BASE_IDS_H
