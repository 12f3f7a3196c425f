// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter for questions about the centers of discs alone: that of the motion of the centers.
#ifndef KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H

#include "filter.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "precise_filter.h"

namespace kinetri {

template <HasWeight Disc>
Filter_result filter_orientation(const Disc& p, const Disc& q, const Disc& r,
                                 const Double_interval& after, bool vanishes_at) {
  return filter_orientation(center(p), center(q), center(r), after, vanishes_at);
}
template <HasWeight Disc>
Sign certain_orientation(const Disc& p, const Disc& q, const Disc& r,
                         const Double_interval& interval) {
  return certain_orientation(center(p), center(q), center(r), interval);
}
template <HasWeight Disc>
double precise_orientation(const Disc& p, const Disc& q, const Disc& r, double high, double low) {
  return precise_orientation(center(p), center(q), center(r), high, low);
}
inline bool have_same_derivatives(const Linear_motion_2& p, const Linear_motion_2& q) {
  return p.velocity == q.velocity;
}
inline bool have_same_derivatives(const Polynomial_motion_2& p, const Polynomial_motion_2& q) {
  return p.velocity == q.velocity && p.acceleration == q.acceleration && p.jerk == q.jerk;
}

// Points that always coincide never begin to, and so count as apart. Discs do not, since their
// weights may become equal.
template <HasWeight Disc>
bool certainly_apart(const Disc& p, const Disc& q, const Double_interval& interval) {
  if (have_same_derivatives(center(p), center(q))) {
    return p.epoch == q.epoch && p.position != q.position;
  }
  return certainly_apart(center(p), center(q), interval);
}

// The same of images of discs. False, so that the exact stage decides, if the vector between them
// may be constant, which does not show in the numbers of the box.
inline bool certainly_apart(const Image_disc_motion_2& p, const Image_disc_motion_2& q,
                            const Double_interval& interval) {
  const auto is_constant = [](std::int32_t k, std::int32_t l, const Linear_motion_2& vector) {
    return k == l || vector.velocity == Vector_2();
  };
  const Periodic_box_2* const box = p.box != nullptr ? p.box : q.box;
  if (have_same_derivatives(p.motion, q.motion) &&
      (box == nullptr || (is_constant(p.offset.x, q.offset.x, box->first()) &&
                          is_constant(p.offset.y, q.offset.y, box->second())))) {
    const Double_interval now = {interval.lower, interval.lower};
    return certain_x_order(center(p), center(q), now) != CGAL::ZERO ||
           certain_y_order(center(p), center(q), now) != CGAL::ZERO;
  }
  return certainly_apart(center(p), center(q), interval);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H
