// SPDX-License-Identifier: GPL-3.0-or-later
//
// A periodic box at one time, rounded, for pictures.
#ifndef KINETRI_IMPL_KINETIC_DRAWN_BOX_2_H
#define KINETRI_IMPL_KINETIC_DRAWN_BOX_2_H

#include <array>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri {

/// The parallelogram that pictures show of a periodic box, at the origin. Its first vector is that
/// of the box. Its second one is that of the box plus the multiple of the first one with which it
/// leans by half of the first one at most: so the picture of a box that is sheared does not become
/// longer and longer. Everything is rounded, and not finite if numbers overflow.
class Drawn_box_2 {
 public:
  /// Of the box at time t. Precondition: t is finite.
  Drawn_box_2(const Periodic_box_2& box, double t);

  /// @{
  /// A side.
  const Vector_2& first() const { return first_; }
  const Vector_2& second() const { return second_; }
  /// @}
  /// Counterclockwise from the origin on.
  std::array<Vector_2, 4> corners() const;

  /// An image within the parallelogram.
  struct Image {
    Vector_2 place;  ///< of the image
    Vector_2 moves;  ///< how often each vector of the parallelogram is added to the place as given
  };
  /// The image of the place. As numbers are rounded, it may be just outside.
  Image image(const Vector_2& place) const;

  /// What is to be added to the image `to` of an end of an edge, so that the edge leads there from
  /// the image `from` of its other end. `offset`: of the end against the other one, in the vectors
  /// of the box, as of a Periodic_edge.
  Vector_2 shift(const Lattice_offset_2& offset, const Image& from, const Image& to) const;

  /// The sum of these vectors of the box, each as often as it leads to the image: of those of
  /// another time, or of their rates.
  Vector_2 move(const Image& image, const Vector_2& first, const Vector_2& second) const;

 private:
  Vector_2 first_;
  Vector_2 second_;
  double turns_ = 0;  // the second vector of the box is second_ + turns_ first_
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_KINETIC_DRAWN_BOX_2_H
