// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/image_motion_2.h"

#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {

bool same_trajectory(const Image_motion_2& a, const Image_motion_2& b) {
  const Moving_image_2 p(a);
  const Moving_image_2 q(b);
  return x_difference(p, q).is_zero() && y_difference(p, q).is_zero();
}

}  // namespace kinetri
