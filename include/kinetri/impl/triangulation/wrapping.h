// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of points near the middle of a periodic box, by rounded positions: a choice among images
// that is good for searches, not a decision.
#ifndef KINETRI_IMPL_TRIANGULATION_WRAPPING_H
#define KINETRI_IMPL_TRIANGULATION_WRAPPING_H

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/impl/triangulation/torus_triangulation_impl.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri::detail {

/// The box at one time with two vectors of the lattice that are nearly as short as possible. If
/// numbers overflow, or the box has lost its area by rounding, images are the positions themselves.
/// All functions throw Periodic_box_error if an offset is 2^31 or more.
class Wrapping {
 public:
  /// An image in the parallelogram of the two short vectors, up to rounding.
  struct Image {
    Vector_2 place = {};           ///< in multiples of the two vectors, from 0 to 1
    Lattice_offset_2 offset = {};  ///< of the image against the position
  };

  Wrapping(const Periodic_box_2& box, double time)
      : first_(rounded_place(box.first(), time)), second_(rounded_place(box.second(), time)) {
    reduce();
    area_ = cross(first_, second_);
  }

  /// The position that is so many of the two vectors from the origin.
  Vector_2 position(const Vector_2& multiples) const {
    return {multiples.x * first_.x + multiples.y * second_.x,
            multiples.x * first_.y + multiples.y * second_.y};
  }
  /// How wide the parallelogram is across each of its vectors: what one more of the vector adds to
  /// the distance from the other one. Not positive, or not a number, if the box has no area.
  Vector_2 heights() const {
    return {area_ / std::sqrt(dot(second_, second_)), area_ / std::sqrt(dot(first_, first_))};
  }
  /// The offset, moved by so many of the two vectors; none if it is 2^31 or more then.
  std::optional<Lattice_offset_2> moved(const Lattice_offset_2& offset,
                                        const std::array<std::int8_t, 2>& by) const {
    const std::int64_t x = std::int64_t{offset.x} + std::int64_t{by[0]} * basis_[0].x +
                           std::int64_t{by[1]} * basis_[1].x;
    const std::int64_t y = std::int64_t{offset.y} + std::int64_t{by[0]} * basis_[0].y +
                           std::int64_t{by[1]} * basis_[1].y;
    return to_offset(x, y);
  }

  /// The offsets of the two vectors.
  const std::array<Lattice_offset_2, 2>& basis() const { return basis_; }

  /// The place that image() has, of a position any number of vectors away.
  Vector_2 place_of_image(const Vector_2& position) const {
    const Vector_2 there = multiples(position);
    return {there.x - std::floor(there.x), there.y - std::floor(there.y)};
  }
  /// The image of the position of a point.
  Image image(const Vector_2& position, Point_id id) const {
    const Vector_2 there = multiples(position);
    const Vector_2 whole = {std::floor(there.x), std::floor(there.y)};
    return {{there.x - whole.x, there.y - whole.y}, offset(whole, id)};
  }
  /// The offset of the image of the position of a point that is near another position.
  Lattice_offset_2 nearest(const Vector_2& position, const Vector_2& other, Point_id id) const {
    const Vector_2 away = multiples({position.x - other.x, position.y - other.y});
    return offset({std::nearbyint(away.x), std::nearbyint(away.y)}, id);
  }

 private:
  static constexpr double two_to_the_31 = 2147483648;

  static double cross(const Vector_2& a, const Vector_2& b) { return a.x * b.y - a.y * b.x; }
  static double dot(const Vector_2& a, const Vector_2& b) { return a.x * b.x + a.y * b.y; }

  // The vector in multiples of the two.
  Vector_2 multiples(const Vector_2& vector) const {
    const Vector_2 result = {cross(vector, second_) / area_, cross(first_, vector) / area_};
    return area_ > 0 && std::isfinite(result.x) && std::isfinite(result.y) ? result : Vector_2{};
  }
  // That many vectors back.
  Lattice_offset_2 offset(const Vector_2& whole, Point_id id) const {
    const double x = -whole.x * basis_[0].x - whole.y * basis_[1].x;
    const double y = -whole.x * basis_[0].y - whole.y * basis_[1].y;
    if (std::abs(x) < two_to_the_31 && std::abs(y) < two_to_the_31) {
      return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    }
    throw Periodic_box_error("point " + std::to_string(id) +
                             " is 2^31 or more lattice vectors away from the periodic box, or from "
                             "other points; give the position of an image that is closer");
  }

  // The reduction of Lagrange, in which each step makes the sum of the lengths less. It stops when
  // rounding, or the range of offsets, allows no further step.
  void reduce() {
    for (;;) {
      if (dot(second_, second_) < dot(first_, first_)) {
        first_ = std::exchange(second_, {-first_.x, -first_.y});
        basis_[0] = std::exchange(basis_[1], {-basis_[0].x, -basis_[0].y});
      }
      const double k = std::nearbyint(dot(first_, second_) / dot(first_, first_));
      if (k == 0 || !(std::abs(k) < two_to_the_31)) return;
      const auto number = static_cast<std::int64_t>(k);
      const std::int64_t x = basis_[1].x - number * basis_[0].x;
      const std::int64_t y = basis_[1].y - number * basis_[0].y;
      const Vector_2 shorter = {second_.x - k * first_.x, second_.y - k * first_.y};
      const auto offset = to_offset(x, y);
      if (!offset || !(dot(shorter, shorter) < dot(second_, second_))) return;
      second_ = shorter;
      basis_[1] = *offset;
    }
  }

  Vector_2 first_;
  Vector_2 second_;
  double area_ = 0;
  std::array<Lattice_offset_2, 2> basis_ = {{{1, 0}, {0, 1}}};
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_WRAPPING_H
