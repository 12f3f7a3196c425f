// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion of an image of a point, or of a disc, in a periodic box.
#ifndef KINETRI_KINETIC_IMAGE_MOTION_2_H
#define KINETRI_KINETIC_IMAGE_MOTION_2_H

#include <cmath>
#include <iosfwd>

#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri {

/// The trajectory of the point plus `offset.x` times the first and `offset.y` times the second
/// lattice vector of the box, exactly. With a linear motion it is linear in time, but in general no
/// Linear_motion_2, whose numbers would be rounded. With the offset zero it is the point itself,
/// and results are those of the point.
///
/// The box must exist as long as the image is used; exact times, such as failure times, keep a
/// copy of it. Precondition of all that takes several images: they have the same box.
template <class PointMotion>
struct Basic_image_motion_2 {
  using Point_motion = PointMotion;  ///< of the point

  PointMotion motion = {};              ///< of the point
  Lattice_offset_2 offset = {};         ///< of the image against the point
  const Periodic_box_2* box = nullptr;  ///< not null, unless the offset is zero
};

/// The motion of an image of a point in linear motion. Predicates and certificates of such images
/// (Basic_instantaneous_traits_2, Basic_kinetic_traits_2) have the degrees of those of points.
using Image_motion_2 = Basic_image_motion_2<Linear_motion_2>;
/// An image of a point in linear motion.
using Moving_image_2 = Basic_moving_point_2<Image_motion_2>;

/// The motion of an image of a disc: the center is the image of the center, and the radius and the
/// weight are those of the disc. So formulas and filters of discs are those of their images.
using Image_disc_motion_2 = Basic_disc_motion_2<Image_motion_2>;
/// An image of a disc whose center is in linear motion.
using Moving_image_disc_2 = Basic_moving_point_2<Image_disc_motion_2>;

/// The motion of an image of a point or, if it has a weight, of a disc.
template <class Motion>
struct Image_motion_type {
  using type = Basic_image_motion_2<Motion>;  ///< of a point
};
/// The same of a disc.
template <class CenterMotion>
struct Image_motion_type<Basic_disc_motion_2<CenterMotion>> {
  using type = Basic_disc_motion_2<Basic_image_motion_2<CenterMotion>>;  ///< of a disc
};
/// The type that Image_motion_type has.
template <class Motion>
using Image_motion_of = typename Image_motion_type<Motion>::type;

/// The image of a motion in a box, which must exist as long as the image is used.
template <class Motion>
Image_motion_of<Motion> image_of(const Motion& motion, const Lattice_offset_2& offset,
                                 const Periodic_box_2* box) {
  if constexpr (HasWeight<Motion>) {
    return {{center(motion), offset, box}, motion.radius, motion.growth, motion.weight};
  } else {
    return {motion, offset, box};
  }
}

/// The epoch of the point, or of the disc.
template <class PointMotion>
double epoch_of(const Basic_image_motion_2<PointMotion>& image) {
  return epoch_of(image.motion);
}

// As for Linear_motion_2 and Disc_motion_2:

/// Whether all numbers are finite; those of a box always are.
inline bool is_finite(const Image_motion_2& image) {
  return is_finite(image.motion);
}

/// Whether the two are at the same position at every time, exactly.
bool same_trajectory(const Image_motion_2& a, const Image_motion_2& b);
/// Whether the two also have the same weight at every time, exactly.
bool same_trajectory(const Image_disc_motion_2& a, const Image_disc_motion_2& b);

/// The position at time t, rounded, for output, not for decisions. The error is a few units in the
/// last place of the largest term of the formula.
inline Vector_2 rounded_place(const Image_motion_2& image, double t) {
  Vector_2 place = rounded_place(image.motion, t);
  const auto add = [&](double times, const Linear_motion_2& vector) {
    const Vector_2 there = rounded_place(vector, t);
    place.x += times * there.x;
    place.y += times * there.y;
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return place;
}

/// The velocity, rounded, for output, not for decisions.
inline Vector_2 rounded_velocity(const Image_motion_2& image, double /*t*/) {
  Vector_2 velocity = image.motion.velocity;
  const auto add = [&](double times, const Linear_motion_2& vector) {
    velocity.x += times * vector.velocity.x;
    velocity.y += times * vector.velocity.y;
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return velocity;
}

/// Bounds how far, in either coordinate, rounded_place(image, t) is from the position at any of
/// the times. Not finite if numbers overflow. Precondition: t is one of the times.
inline double place_error(const Image_motion_2& image, double t, const Double_interval& times) {
  // The errors of the three places have room for the product and the two sums: at most six
  // roundings of a term, each of at most two unit roundoffs, and each place_error has sixteen.
  double error = place_error(image.motion, t, times);
  const auto add = [&](double number, const Linear_motion_2& vector) {
    error += std::abs(number) * place_error(vector, t, times);
  };
  if (image.offset.x != 0) add(image.offset.x, image.box->first());
  if (image.offset.y != 0) add(image.offset.y, image.box->second());
  return error;
}

/// The trajectory of an image as polynomials in time, exactly; w is a positive constant.
/// Precondition: the numbers of the motion are finite.
Trajectory_2 trajectory(const Image_motion_2& image);
/// The same with the weight of the disc.
Trajectory_2 trajectory(const Image_disc_motion_2& image);

/// The position at time t, each coordinate rounded to the nearest binary64 number, ties to even.
/// Cost: some operations on integers, more if t is irrational; few in binary64 if the offset is
/// zero and t a binary64 number.
Vector_2 rounded_position(const Image_motion_2& image, const Algebraic_number& t);

/// The image that is in the parallelogram of the box at time t: its position is a sum of multiples
/// of the lattice vectors, each from 0 to less than 1, exactly. Throws Periodic_box_error if its
/// offset is 2^31 or more. Precondition: the area of the box is positive at t. Cost: as of
/// rounded_position; a few times as much for an image on a side of the parallelogram.
Image_motion_2 wrapped(const Linear_motion_2& motion, const Periodic_box_2& box,
                       const Algebraic_number& t);

extern template class Basic_moving_point_2<Image_motion_2>;
extern template class Basic_moving_point_2<Image_disc_motion_2>;
extern template std::ostream& operator<<(std::ostream& out, const Moving_image_2& point);
extern template std::ostream& operator<<(std::ostream& out, const Moving_image_disc_2& point);

}  // namespace kinetri

#endif  // KINETRI_KINETIC_IMAGE_MOTION_2_H
