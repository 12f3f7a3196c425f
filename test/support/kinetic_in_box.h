// SPDX-License-Identifier: GPL-3.0-or-later
//
// Kinetic triangulations of points in periodic boxes, and names of images in messages.
#ifndef KINETRI_TEST_SUPPORT_KINETIC_IN_BOX_H
#define KINETRI_TEST_SUPPORT_KINETIC_IN_BOX_H

#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/periodic_queries_2.h"

namespace kinetri::test {

using Kinetic_in_box = Kinetic_delaunay_triangulation_2<Periodic_kinetic_traits_2>;

/// At time 0.
inline Kinetic_in_box kinetic_in_box(const Periodic_box_2& box,
                                     const std::vector<Linear_motion_2>& motions) {
  return Kinetic_in_box(motions, Algebraic_number(0), Periodic_kinetic_traits_2(box));
}

inline std::string text(const Periodic_image& image) {
  return std::to_string(image.id) + " (" + std::to_string(image.offset.x) + ", " +
         std::to_string(image.offset.y) + ")";
}
inline std::string text(const std::vector<Periodic_image>& images) {
  std::string result;
  for (const Periodic_image& image : images) result += text(image) + "; ";
  return result;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_KINETIC_IN_BOX_H
