// SPDX-License-Identifier: GPL-3.0-or-later
//
// In-circle certificates two at a time, one in each lane of a Pair.
#include <algorithm>
#include <array>

#include "bernstein.h"
#include "coordinate_pair.h"
#include "differences.h"
#include "in_circle_coefficients.h"
#include "linear_filter.h"
#include "linear_frame.h"

namespace kinetri {
namespace {

Pair least(const Quartic<Pair>& c) {
  return lesser(lesser(lesser(c[0], c[1]), lesser(c[2], c[3])), c[4]);
}

// Two certificates over the window, one in each lane.
struct Two_certificates {
  explicit Two_certificates(const Quartic<Pair>& coefficients)
      : c(coefficients), b(bernstein_of_quartic(c)), least_c(least(c)), least_b(least(b)) {}

  static Quartic<double> lane(const Quartic<Pair>& x, std::size_t i) {
    return {x[0][i], x[1][i], x[2][i], x[3][i], x[4][i]};
  }

  Filter_result result(std::size_t i, double error, double window,
                       const Double_interval& after) const {
    using Kind = Filter_result::Kind;
    if (!(least_b[i] > error)) {
      return in_time(first_failure(lane(c, i), lane(b, i), error), after.lower, window, after);
    }
    if (least_c[i] > error) return {Kind::never_fails, {}};
    return in_time({Kind::holds, {1, 1}}, after.lower, window, after);
  }

  Quartic<Pair> c;
  Quartic<Pair> b;
  Pair least_c;
  Pair least_b;
};

}  // namespace

std::array<Filter_result, 2> filter_in_circles(
    const std::array<Quadruple<Linear_motion_2>, 2>& certificates, const Double_interval& after) {
  std::array<std::array<Difference, 3>, 2> d;
  std::array<double, 2> window;
  std::array<double, 2> error;
  for (std::size_t k = 0; k < 2; ++k) {
    Magnitudes m;
    const auto& [p, q, r, s] = certificates[k];
    d[k] = {difference(*p, *s, after.lower, m), difference(*q, *s, after.lower, m),
            difference(*r, *s, after.lower, m)};
    if (!is_in_range(greatest(m.slope))) return {};
    const Frame f(m, window_ahead(m));
    if (!f.is_in_range()) return {};
    for (Difference& difference : d[k]) difference.slope *= f.window;
    window[k] = f.window;
    error[k] = f.in_circle_error();
  }
  const Triangle<Pair> triangles = {lifted(d[0][1], d[1][1]), lifted(d[0][0], d[1][0])};
  const Two_certificates both(in_circle_coefficients(triangles, lifted(d[0][2], d[1][2])));
  return {both.result(0, error[0], window[0], after), both.result(1, error[1], window[1], after)};
}

// The five certificates share points. So all of them are made from the differences to one corner,
// over one window, with the error bound of the largest.
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Linear_motion_2>& around,
                                               const Double_interval& after) {
  Magnitudes m;
  const auto from_corner = [&](const Linear_motion_2* p) {
    return difference(*p, *around.corners[0], after.lower, m);
  };
  const auto& [corner, to_right, to_far, to_left] = around.corners;
  std::array<Difference, 7> d = {from_corner(to_right),         from_corner(to_far),
                                 from_corner(to_left),          from_corner(around.beyond[0]),
                                 from_corner(around.beyond[1]), from_corner(around.beyond[2]),
                                 from_corner(around.beyond[3])};
  if (!is_in_range(greatest(m.slope))) return {};
  const Frame f(m, window_ahead(m));
  if (!f.is_in_range()) return {};
  for (Difference& difference : d) difference.slope *= f.window;
  const Lifted<double> far = lifted(d[1]);
  const Lifted<double> left = lifted(d[2]);
  const Triangle<double> first = {lifted(d[0]), far};
  const Triangle<double> second = {far, left};
  const Two_certificates of_first(in_circle_coefficients(first, lifted(d[3], d[4])));
  const Two_certificates of_second(in_circle_coefficients(second, lifted(d[5], d[6])));
  const double error = f.in_circle_error();
  return {of_first.result(0, error, f.window, after), of_first.result(1, error, f.window, after),
          of_second.result(0, error, f.window, after), of_second.result(1, error, f.window, after),
          first_failure_after_known_root(in_circle_coefficients(first, left), error, in_circle_norm,
                                         f.window, after)};
}

}  // namespace kinetri
