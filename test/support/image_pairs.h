// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random periodic boxes of small integers, and all pairs of images of points, or of discs, in a box
// that may be near each other: for brute force over pairs and offsets.
#ifndef KINETRI_TEST_SUPPORT_IMAGE_PAIRS_H
#define KINETRI_TEST_SUPPORT_IMAGE_PAIRS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/encounter_oracle.h"

namespace kinetri::test {

/// The kinds of random boxes.
inline constexpr int periodic_box_kinds = 4;
inline const char* periodic_box_kind(unsigned kind) {
  constexpr std::array<const char*, periodic_box_kinds> names = {"at rest", "sheared", "growing",
                                                                 "turning"};
  return names[kind];
}

/// The area of a box, rounded.
inline double rounded_area(const Periodic_box_2& box, double t) {
  const Vector_2 a = rounded_place(box.first(), t);
  const Vector_2 b = rounded_place(box.second(), t);
  return a.x * b.y - a.y * b.x;
}

/// A box with lattice vectors of integers up to `greatest` at time 0, and an area of about 4 or
/// more up to `end`.
inline Periodic_box_2 random_periodic_box(std::mt19937& random, int kind, int greatest,
                                          double end) {
  const auto integer = [&](int least, int most) {
    return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
  };
  for (;;) {
    const auto vector = [&] {
      const double x = integer(-greatest, greatest);
      return Vector_2{x, static_cast<double>(integer(-greatest, greatest))};
    };
    const Vector_2 a = vector();
    const Vector_2 b = vector();
    Vector_2 rate_a;
    Vector_2 rate_b;
    if (kind == 1) rate_b = {a.x * 0.5, a.y * 0.5};
    if (kind == 2) {
      rate_a = {a.x * 0.25, a.y * 0.25};
      rate_b = {b.x * 0.5, b.y * 0.5};
    }
    if (kind == 3) {
      rate_a = {integer(-1, 1) * 0.25, integer(-1, 1) * 0.25};
      rate_b = {integer(-1, 1) * 0.25, integer(-1, 1) * 0.25};
    }
    bool has_area = true;
    for (double t = 0; t <= end; t += 0x1p-6) {
      const Vector_2 at_a = {a.x + t * rate_a.x, a.y + t * rate_a.y};
      const Vector_2 at_b = {b.x + t * rate_b.x, b.y + t * rate_b.y};
      has_area = has_area && at_a.x * at_b.y - at_a.y * at_b.x >= 4;
    }
    if (has_area) return {{a, rate_a, 0}, {b, rate_b, 0}};
  }
}

/// So many that the images of a point within the range of another one have no greater offsets up
/// to `end`, as long as positions are not farther apart than `apart`.
inline int greatest_offset(const Periodic_box_2& box, double range, double apart, double end) {
  double least_area = rounded_area(box, 0);
  double length = 0;
  for (double t = 0; t <= end; t += 0x1p-6) {
    least_area = std::min(least_area, rounded_area(box, t));
    for (const Linear_motion_2* const vector : {&box.first(), &box.second()}) {
      const Vector_2 there = rounded_place(*vector, t);
      length = std::max(length, std::hypot(there.x, there.y));
    }
  }
  // Between these times the area falls by less than 1.
  return static_cast<int>((range + apart) * length / (least_area - 1)) + 1;
}

/// The legs of an image of a point, or of a disc.
template <class Motion>
std::vector<Leg_of<Image_motion_of<Motion>>> image_legs(const std::vector<Leg_of<Motion>>& legs,
                                                        const Lattice_offset_2& offset,
                                                        const Periodic_box_2& box) {
  std::vector<Leg_of<Image_motion_of<Motion>>> result;
  for (const Leg_of<Motion>& leg : legs) {
    result.push_back({image_of(leg.motion, offset, &box), leg.since, leg.until, leg.is_initial,
                      leg.is_last, leg.goes_on});
  }
  return result;
}

/// The greatest radius of a disc at two times; 0 of a point.
template <class Motion>
double greatest_radius(const Motion& motion, double t, double u) {
  if constexpr (HasWeight<Motion>) {
    return std::max(rounded_radius(motion, t), rounded_radius(motion, u));
  } else {
    return 0;
  }
}

/// Whether p and an image of q may be within the range while both have one of their motions: by
/// the least distance of straight lines, in numbers that are exact but for the last division.
template <class Leg>
bool may_be_near(const std::vector<Leg>& p, const std::vector<Leg>& q,
                 const Lattice_offset_2& offset, const Periodic_box_2& box, double range) {
  const Vector_2 place_zero = rounded_place(Image_motion_2{{}, offset, &box}, 0);
  const Vector_2 speed_zero = rounded_velocity(Image_motion_2{{}, offset, &box}, 0);
  for (const Leg& a : p) {
    const Vector_2 place_a = rounded_place(a.motion, 0);
    for (const Leg& b : q) {
      const double since = std::max(a.since, b.since).to_double();
      const double until = std::min(*a.until, *b.until).to_double();
      if (since > until) continue;
      const Vector_2 place_b = rounded_place(b.motion, 0);
      const Vector_2 d = {place_a.x - place_b.x - place_zero.x,
                          place_a.y - place_b.y - place_zero.y};
      const Vector_2 v = {a.motion.velocity.x - b.motion.velocity.x - speed_zero.x,
                          a.motion.velocity.y - b.motion.velocity.y - speed_zero.y};
      const double speed = v.x * v.x + v.y * v.y;
      const double least =
          speed > 0 ? std::clamp(-(d.x * v.x + d.y * v.y) / speed, since, until) : since;
      const double x = d.x + least * v.x;
      const double y = d.y + least * v.y;
      const double reach =
          range + greatest_radius(a.motion, since, until) + greatest_radius(b.motion, since, until);
      if (x * x + y * y <= reach * reach + 0.001) return true;
    }
  }
  return false;
}

/// Calls function(pair, p, q) for each pair of images whose gap may be at most `range` at a time up
/// to `end`, and others, with the motions of its ends: p and q are legs of images. The gap of
/// points is their distance.
template <class Leg, class Function>
void for_each_pair_of_images(const Periodic_box_2& box, const std::vector<std::vector<Leg>>& legs,
                             double range, double end, Function function) {
  double apart = 0;
  for (const auto& of_point : legs) {
    for (const Leg& leg : of_point) {
      for (const double t : {0.0, end}) {
        const Vector_2 place = rounded_place(leg.motion, t);
        apart = std::max(
            apart, std::hypot(place.x, place.y) + std::abs(greatest_radius(leg.motion, t, t)));
      }
    }
  }
  const int most = greatest_offset(box, range, 2 * apart, end);
  for (Point_id a = 0; a < legs.size(); ++a) {
    for (Point_id b = a; b < legs.size(); ++b) {
      for (int k = -most; k <= most; ++k) {
        for (int l = -most; l <= most; ++l) {
          const Lattice_offset_2 offset = {k, l};
          if (a == b && !(Lattice_offset_2() < offset)) continue;
          if (!may_be_near(legs[a], legs[b], offset, box, range)) continue;
          function(Periodic_edge{{a, b}, offset}, image_legs(legs[a], {}, box),
                   image_legs(legs[b], offset, box));
        }
      }
    }
  }
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_IMAGE_PAIRS_H
