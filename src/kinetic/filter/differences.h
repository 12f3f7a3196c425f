// SPDX-License-Identifier: GPL-3.0-or-later
//
// The differences of linear motions that the filters compute with, what bounds them, and their
// products.
#ifndef KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H

#include <algorithm>

#include "coordinate_pair.h"

namespace kinetri {

inline constexpr double unit_roundoff = 0x1p-53;

// Sizes, slopes and windows outside of this range might under- or overflow on their way to the
// fourth power.
inline constexpr double least_size = 0x1p-200;
inline constexpr double greatest_size = 0x1p200;

inline bool is_in_range(double x) {
  return x > least_size && x < greatest_size;
}

// The difference of two linear motions: place + slope * (time - origin).
struct Difference {
  Pair place;
  Pair slope;
};

// Bounds for the differences that a polynomial is made from, by coordinate.
struct Magnitudes {
  Pair terms = {};   // the sum of all numbers that the places were made from
  Pair extent = {};  // of the places
  Pair slope = {};

  void add(const Difference& d) {
    extent = greater(absolute(d.place), extent);
    slope = greater(absolute(d.slope), slope);
  }
};

inline Difference difference_from_two_epochs(const Linear_motion_2& p, const Linear_motion_2& q,
                                             double origin, Magnitudes& m) {
  const Pair moved_p = pair(p.velocity) * (origin - p.epoch);
  const Pair moved_q = pair(q.velocity) * (origin - q.epoch);
  m.terms += absolute(pair(p.position)) + absolute(moved_p);
  m.terms += absolute(pair(q.position)) + absolute(moved_q);
  return {(pair(p.position) + moved_p) - (pair(q.position) + moved_q),
          pair(p.velocity) - pair(q.velocity)};
}

inline Difference difference(const Linear_motion_2& p, const Linear_motion_2& q, double origin,
                             Magnitudes& m) {
  Difference d;
  if (p.epoch == q.epoch) {
    // Taking the difference first keeps the coordinates' common part out of the error.
    d.slope = pair(p.velocity) - pair(q.velocity);
    const Pair place = pair(p.position) - pair(q.position);
    const Pair moved = d.slope * (origin - q.epoch);
    m.terms += absolute(place) + absolute(moved);
    d.place = place + moved;
  } else {
    d = difference_from_two_epochs(p, q, origin, m);
  }
  m.add(d);
  return d;
}

// The vector products of the places and slopes of two differences, as the polynomial in time that
// is the product of the differences.
struct Product {
  Pair low;     // the coefficients of degree 0 and 1
  double high;  // that of degree 2
};

inline Product vector_product(const Difference& a, const Difference& b) {
  const Pair place = swapped(b.place);
  const Pair slope = swapped(b.slope);
  const Pair pp = a.place * place;
  const Pair ps = a.place * slope;
  const Pair sp = a.slope * place;
  const Pair ss = a.slope * slope;
  const Pair from_place = firsts(pp, ps) - seconds(pp, ps);
  const Pair from_slope = firsts(sp, ss) - seconds(sp, ss);
  return {from_place + Pair{0, from_slope[0]}, from_slope[1]};
}

inline Product scalar_product(const Difference& a, const Difference& b) {
  const double mixed = sum(a.place * b.slope) + sum(a.slope * b.place);
  return {Pair{sum(a.place * b.place), mixed}, sum(a.slope * b.slope)};
}

inline Product squared_length(const Difference& a) {
  const Pair pp = a.place * a.place;
  const Pair ps = a.place * a.slope;
  const Pair half = firsts(pp, ps) + seconds(pp, ps);
  return {half + Pair{0, half[1]}, sum(a.slope * a.slope)};
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
