// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/image_motion_2.h"

#include <cmath>
#include <cstdint>

#include "algebra/rounded_quotient.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {
namespace {

// How often the area, a positive number at t, is in the other one, rounded down. The sign, since
// the offset of the image is against the position, is the opposite.
std::int32_t offset_back(const Polynomial& part, const Polynomial& area,
                         const Algebraic_number& t) {
  const double quotient = rounded_quotient(part, area, t);
  double whole = std::floor(quotient);
  constexpr double limit = 2147483648;  // 2^31
  // Only an integer may be that of a lesser number.
  if (std::abs(whole) < limit && quotient == whole &&
      sign_at(part - area * Integer(static_cast<std::int64_t>(whole)), t) == CGAL::NEGATIVE) {
    --whole;
  }
  if (!(std::abs(whole) < limit)) {
    throw Periodic_box_error(
        "a point is 2^31 or more lattice vectors away from the periodic box; give the position of "
        "an image that is closer");
  }
  return static_cast<std::int32_t>(-whole);
}

template <class Image>
bool are_same_image(const Image& a, const Image& b) {
  const Basic_moving_point_2<Image> p(a);
  const Basic_moving_point_2<Image> q(b);
  return x_difference(p, q).is_zero() && y_difference(p, q).is_zero() &&
         weight_difference(p, q).is_zero();
}

}  // namespace

bool same_trajectory(const Image_motion_2& a, const Image_motion_2& b) {
  return are_same_image(a, b);
}
bool same_trajectory(const Image_disc_motion_2& a, const Image_disc_motion_2& b) {
  return are_same_image(a, b);
}

Vector_2 rounded_position(const Image_motion_2& image, const Algebraic_number& t) {
  const auto [lower, upper] = t.interval();
  if (image.offset == Lattice_offset_2() && lower == upper) {
    return with_velocity_at(image.motion, {}, lower).position;
  }
  const Trajectory_2 path = trajectory(image);
  return {rounded_quotient(path.x, path.w, t), rounded_quotient(path.y, path.w, t)};
}

Image_motion_2 wrapped(const Linear_motion_2& motion, const Periodic_box_2& box,
                       const Algebraic_number& t) {
  const Moving_point_2 point(motion);
  const Moving_point_2 first(box.first());
  const Moving_point_2 second(box.second());
  const auto [p, a, b] = common_trajectories<3, Linear_motion_2>({&point, &first, &second});
  const Polynomial area = a.x * b.y - a.y * b.x;
  const Lattice_offset_2 offset = {offset_back(p.x * b.y - p.y * b.x, area, t),
                                   offset_back(a.x * p.y - a.y * p.x, area, t)};
  return {motion, offset, &box};
}

}  // namespace kinetri
