// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounding boxes of discs, to find those that may touch, in binary64.
#ifndef KINETRI_SRC_SIMULATION_DISC_BOXES_H
#define KINETRI_SRC_SIMULATION_DISC_BOXES_H

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/disc_motion_2.h"

namespace kinetri::detail {

/// A box that holds a disc, with the name of the disc: its id, in a periodic box that of an image.
template <class Disc>
using Basic_disc_box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Disc>;
using Disc_box = Basic_disc_box<Point_id>;  ///< in the plane

/// A bound of the radius of a disc at each of the times. Precondition: t is one of the times.
template <HasWeight Motion>
double greatest_radius(const Motion& disc, double t, const Double_interval& times) {
  // Four roundings at most, each of two unit roundoffs of its terms, in any rounding mode.
  const double change = std::abs(disc.growth) * std::abs(t - epoch_of(disc));
  const double terms = std::abs(disc.radius) + change;
  return std::abs(rounded_radius(disc, t)) + 0x1p-48 * terms +
         2 * std::abs(disc.growth) * (times.upper - times.lower);
}

/// A box that certainly contains the disc at each of the times; the whole plane if numbers
/// overflow. Precondition: t is one of the times.
template <class Disc, HasWeight Motion>
Basic_disc_box<Disc> box_around(const Motion& disc, const Disc& name, double t,
                                const Double_interval& times) {
  const Vector_2 center = rounded_place(disc, t);
  // The center has four roundings too, and the sums and differences below have four more.
  const double reach = (greatest_radius(disc, t, times) + place_error(disc, t, times) +
                        0x1p-50 * (std::abs(center.x) + std::abs(center.y))) *
                           (1 + 0x1p-48) +
                       std::numeric_limits<double>::min();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double lower[] = {center.x - reach, center.y - reach};
  double upper[] = {center.x + reach, center.y + reach};
  if (!std::isfinite(lower[0] + lower[1] + upper[0] + upper[1])) {
    lower[0] = lower[1] = -infinite;
    upper[0] = upper[1] = infinite;
  }
  return {lower, upper, name};
}

/// Calls `function` once with the names of each two boxes that intersect. Cost: O(n log^2 n), and
/// the number of pairs.
template <class Disc, class Function>
void for_each_pair_of_boxes(std::vector<Basic_disc_box<Disc>>& boxes, Function function) {
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const Basic_disc_box<Disc>& a, const Basic_disc_box<Disc>& b) {
                                  function(a.info(), b.info());
                                });
}
/// The same for a box and one of `others` that intersect.
template <class Disc, class Function>
void for_each_pair_of_boxes(std::vector<Basic_disc_box<Disc>>& boxes,
                            std::vector<Basic_disc_box<Disc>>& others, Function function) {
  CGAL::box_intersection_d(boxes.begin(), boxes.end(), others.begin(), others.end(),
                           [&](const Basic_disc_box<Disc>& a, const Basic_disc_box<Disc>& b) {
                             function(a.info(), b.info());
                           });
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_DISC_BOXES_H
