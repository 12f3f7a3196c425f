// SPDX-License-Identifier: GPL-3.0-or-later
//
// Images of points near the middle of a periodic box, by rounded positions: a choice among images
// that is good for searches, not a decision.
#ifndef KINETRI_SRC_TRIANGULATION_WRAPPING_H
#define KINETRI_SRC_TRIANGULATION_WRAPPING_H

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri::detail {

/// The box at one time with two vectors of the lattice that are nearly as short as possible. If
/// rounding leaves the box no area, images are the positions themselves. `image` and `nearest`
/// throw Periodic_box_error if an offset is 2^31 or more.
class Wrapping {
 public:
  /// An image in the parallelogram of the two short vectors, up to rounding.
  struct Image {
    Vector_2 place = {};           ///< in multiples of the two vectors, from 0 to 1
    Lattice_offset_2 offset = {};  ///< of the image against the position
  };

  Wrapping(const Periodic_box_2& box, double time);

  /// The position that is so many of the two vectors from the origin.
  Vector_2 position(const Vector_2& multiples) const {
    return {(multiples.x * first_.x + multiples.y * second_.x) / scale_,
            (multiples.x * first_.y + multiples.y * second_.y) / scale_};
  }
  /// How wide the parallelogram is across each of its vectors: what one more of the vector adds to
  /// the distance from the other one. Not positive, or not a number, if the box has no area.
  Vector_2 heights() const;
  /// The offset, moved by so many of the two vectors; none if it is 2^31 or more then.
  std::optional<Lattice_offset_2> moved(const Lattice_offset_2& offset,
                                        const std::array<std::int8_t, 2>& by) const;

  /// The offsets of the two vectors.
  const std::array<Lattice_offset_2, 2>& basis() const { return basis_; }

  /// The place that image() has, of a position any number of vectors away.
  Vector_2 place_of_image(const Vector_2& position) const {
    const Vector_2 there = multiples(position);
    if (!std::isfinite(there.x) || !std::isfinite(there.y)) return {};
    return {there.x - std::floor(there.x), there.y - std::floor(there.y)};
  }
  /// The image of the position of a point.
  Image image(const Vector_2& position, Point_id id) const;
  /// The offset of the image of the position of a point that is near another position.
  Lattice_offset_2 nearest(const Vector_2& position, const Vector_2& other, Point_id id) const;

 private:
  static double cross(const Vector_2& a, const Vector_2& b) { return a.x * b.y - a.y * b.x; }

  // The vector in multiples of the two; not finite if these are too many for binary64, and zero if
  // the box has no area.
  Vector_2 multiples(const Vector_2& vector) const {
    if (!(area_ > 0)) return {};
    const Vector_2 scaled = {scale_ * vector.x, scale_ * vector.y};
    return {cross(scaled, second_) / area_, cross(first_, scaled) / area_};
  }
  // That many vectors back.
  Lattice_offset_2 offset(const Vector_2& whole, Point_id id) const;
  void reduce();

  // The two vectors are kept times this power of two, so that the product of their lengths is in
  // the range of binary64.
  double scale_ = 1;
  Vector_2 first_;
  Vector_2 second_;
  double area_ = 0;
  std::array<Lattice_offset_2, 2> basis_ = {{{1, 0}, {0, 1}}};
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_WRAPPING_H
