// SPDX-License-Identifier: GPL-3.0-or-later
//
// The floating-point stage of discs. What is about their centres alone is left to the filter of the
// motion of these.
#ifndef KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H
#define KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H

#include <array>
#include <optional>
#include <span>

#include "filter.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "precise_filter.h"

namespace kinetri {

// ---- of centres ----

template <HasWeight Disc>
Filter_result filter_orientation(const Disc& p, const Disc& q, const Disc& r,
                                 const Double_interval& after, bool vanishes_at) {
  return filter_orientation(centre(p), centre(q), centre(r), after, vanishes_at);
}
template <HasWeight Disc>
Sign certain_orientation(const Disc& p, const Disc& q, const Disc& r,
                         const Double_interval& interval) {
  return certain_orientation(centre(p), centre(q), centre(r), interval);
}
template <HasWeight Disc>
double precise_orientation(const Disc& p, const Disc& q, const Disc& r, double high, double low) {
  return precise_orientation(centre(p), centre(q), centre(r), high, low);
}
inline bool have_same_derivatives(const Linear_motion_2& p, const Linear_motion_2& q) {
  return p.velocity == q.velocity;
}
inline bool have_same_derivatives(const Polynomial_motion_2& p, const Polynomial_motion_2& q) {
  return p.velocity == q.velocity && p.acceleration == q.acceleration && p.jerk == q.jerk;
}

// Points that are in one place at all times never come to one place, and so count as apart. Discs
// are not, as their weights may become equal.
template <HasWeight Disc>
bool certainly_apart(const Disc& p, const Disc& q, const Double_interval& interval) {
  if (have_same_derivatives(centre(p), centre(q))) {
    return p.epoch == q.epoch && p.position != q.position;
  }
  return certainly_apart(centre(p), centre(q), interval);
}
template <HasWeight Disc>
Filter_result filter_wall_contact(const Disc& p, const Wall_2& wall, const Double_interval& after) {
  if (wall.rim) return {};
  return filter_wall_contact(centre(p), wall, after);
}
template <HasWeight Disc>
bool certainly_inside(const Disc& p, const Wall_2& wall, const Double_interval& interval) {
  return !wall.rim && certainly_inside(centre(p), wall, interval);
}

// ---- of discs: not yet ----

template <HasWeight Disc>
Filter_result filter_in_circle(const Disc& /*p*/, const Disc& /*q*/, const Disc& /*r*/,
                               const Disc& /*s*/, const Double_interval& /*after*/,
                               bool /*vanishes_at*/) {
  return {};
}
template <HasWeight Disc>
std::array<Filter_result, 2> filter_in_circles(
    const std::array<Quadruple<Disc>, 2>& /*certificates*/, const Double_interval& /*after*/) {
  return {};
}
template <HasWeight Disc>
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Disc>& /*around*/,
                                               const Double_interval& /*after*/) {
  return {};
}
template <HasWeight Disc>
Sign certain_in_circle(const Disc& /*p*/, const Disc& /*q*/, const Disc& /*r*/, const Disc& /*s*/,
                       const Double_interval& /*interval*/) {
  return CGAL::ZERO;
}
template <HasWeight Disc>
double precise_in_circle(const Disc& /*p*/, const Disc& /*q*/, const Disc& /*r*/, const Disc& /*s*/,
                         double /*high*/, double /*low*/) {
  return 0;
}
template <HasWeight Disc>
Filter_result filter_contact(const Disc& /*p*/, const Disc& /*q*/, double /*diameter*/,
                             const Double_interval& /*after*/) {
  return {};
}
template <HasWeight Disc>
Sign certain_distance_slope(const Disc& /*p*/, const Disc& /*q*/,
                            const Double_interval& /*interval*/) {
  return CGAL::ZERO;
}
template <HasWeight Disc>
Sign certain_gap(const Disc& /*p*/, const Disc& /*q*/, double /*diameter*/,
                 const Double_interval& /*interval*/) {
  return CGAL::ZERO;
}
template <HasWeight Disc>
double precise_contact(const Disc& /*p*/, const Disc& /*q*/, double /*diameter*/, double /*high*/,
                       double /*low*/) {
  return 0;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DISC_FILTER_H
