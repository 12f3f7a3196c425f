// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter works with the polynomial of the certificate over a window of time (linear_frame.h).
// Where sizes are out of range the result is unknown.
#include "linear_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bernstein.h"
#include "coordinate_pair.h"
#include "differences.h"
#include "in_circle_coefficients.h"
#include "linear_frame.h"

namespace kinetri {
namespace {

// Minus the in-circle determinant of differences to the fourth point, in powers of w.
inline Coefficients<4> in_circle_coefficients(std::array<Difference, 3> d, double window) {
  for (Difference& difference : d) difference.slope *= window;
  return in_circle_coefficients(Triangle<double>{lifted(d[1]), lifted(d[0])}, lifted(d[2]));
}

Coefficients<2> coefficients(const Product& p, double window) {
  return {p.low[0], p.low[1] * window, p.high * (window * window)};
}

// The orientation of differences to the first point.
Coefficients<2> orientation_coefficients(const std::array<Difference, 2>& d, double window) {
  return coefficients(vector_product(d[0], d[1]), window);
}

// The sign of a coordinate of the difference p - q throughout the interval.
Sign certain_coordinate(double value, double slope, const Magnitudes& m,
                        const Double_interval& interval) {
  const double error = 16 * unit_roundoff * sum(m.terms) +
                       2 * std::abs(slope) * (interval.upper - interval.lower) +
                       std::numeric_limits<double>::min();
  if (value > error) return CGAL::POSITIVE;
  if (value < -error) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

// The frame for a given interval of time.
Frame frame_of(const Magnitudes& m, const Double_interval& interval) {
  return Frame(m, 2 * (interval.upper - interval.lower));
}

// Whether the polynomial over the window can be computed without under- or overflow.
bool is_safe(const Magnitudes& m, const Frame& f) {
  const double slope = greatest(m.slope);
  return f.is_in_range() && (f.window == 0 || slope == 0 || is_in_range(slope));
}

}  // namespace

Filter_result filter_in_circle(const Linear_motion_2& p, const Linear_motion_2& q,
                               const Linear_motion_2& r, const Linear_motion_2& s,
                               const Double_interval& after, bool vanishes_at) {
  Magnitudes m;
  const double origin = after.lower;
  const std::array<Difference, 3> d = {difference(p, s, origin, m), difference(q, s, origin, m),
                                       difference(r, s, origin, m)};
  if (!is_in_range(greatest(m.slope))) {
    const Frame f(m, 0);
    if (greatest(m.slope) != 0 || !f.is_in_range()) return {};
    return judge_constant(in_circle_coefficients(d, 0)[0], f.in_circle_error());
  }
  const Frame f(m, window_ahead(m));
  if (!f.is_in_range()) return {};
  const Coefficients<4> c = in_circle_coefficients(d, f.window);
  const double error = f.in_circle_error();
  return vanishes_at ? first_failure_after_known_root(c, error, in_circle_norm, f.window, after)
                     : judge(c, error, f.window, after);
}

Filter_result filter_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                                 const Linear_motion_2& r, const Double_interval& after,
                                 bool vanishes_at) {
  Magnitudes m;
  const double origin = after.lower;
  const std::array<Difference, 2> d = {difference(q, p, origin, m), difference(r, p, origin, m)};
  if (!is_in_range(greatest(m.slope))) {
    const Frame f(m, 0);
    if (greatest(m.slope) != 0 || !f.is_in_range()) return {};
    return judge_constant(orientation_coefficients(d, 0)[0], f.orientation_error());
  }
  const Frame f(m, window_ahead(m));
  if (!f.is_in_range()) return {};
  const Coefficients<2> c = orientation_coefficients(d, f.window);
  const double error = f.orientation_error();
  return vanishes_at ? first_failure_after_known_root(c, error, orientation_norm, f.window, after)
                     : judge(c, error, f.window, after);
}

Sign certain_x_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.place[0], d.slope[0], m, interval);
}

Sign certain_y_order(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& interval) {
  Magnitudes m;
  const Difference d = difference(p, q, interval.lower, m);
  return certain_coordinate(d.place[1], d.slope[1], m, interval);
}

Sign certain_orientation(const Linear_motion_2& p, const Linear_motion_2& q,
                         const Linear_motion_2& r, const Double_interval& interval) {
  Magnitudes m;
  const std::array<Difference, 2> d = {difference(q, p, interval.lower, m),
                                       difference(r, p, interval.lower, m)};
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  return certain_sign(orientation_coefficients(d, f.window), f.orientation_error());
}

Sign certain_in_circle(const Linear_motion_2& p, const Linear_motion_2& q, const Linear_motion_2& r,
                       const Linear_motion_2& s, const Double_interval& interval) {
  Magnitudes m;
  const std::array<Difference, 3> d = {difference(p, s, interval.lower, m),
                                       difference(q, s, interval.lower, m),
                                       difference(r, s, interval.lower, m)};
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  return -certain_sign(in_circle_coefficients(d, f.window), f.in_circle_error());
}

Sign certain_scalar_product(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Linear_motion_2& r, const Double_interval& interval) {
  Magnitudes m;
  const Difference to_p = difference(p, q, interval.lower, m);
  const Difference to_r = difference(r, q, interval.lower, m);
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  return certain_sign(coefficients(scalar_product(to_p, to_r), f.window), f.orientation_error());
}

Sign certain_distance_order(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Linear_motion_2& r, const Double_interval& interval) {
  Magnitudes m;
  const Difference to_q = difference(q, p, interval.lower, m);
  const Difference to_r = difference(r, p, interval.lower, m);
  const Frame f = frame_of(m, interval);
  if (!is_safe(m, f)) return CGAL::ZERO;
  const Product q_squared = squared_length(to_q);
  const Product r_squared = squared_length(to_r);
  const Product order = {q_squared.low - r_squared.low, q_squared.high - r_squared.high};
  return certain_sign(coefficients(order, f.window), 2 * f.orientation_error());
}

bool certainly_apart(const Linear_motion_2& p, const Linear_motion_2& q,
                     const Double_interval& /*interval*/) {
  Magnitudes m;
  const Difference d = difference(p, q, p.epoch, m);
  const double slope = greatest(m.slope);
  if (slope == 0) return true;
  const double terms = sum(m.terms);
  if (!is_in_range(terms) || !is_in_range(slope)) return false;
  const double cross = vector_product(d, Difference{d.slope, Pair{}}).low[0];
  return std::abs(cross) > 64 * unit_roundoff * (terms * slope);
}

}  // namespace kinetri
