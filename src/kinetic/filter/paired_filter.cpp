// SPDX-License-Identifier: GPL-3.0-or-later
//
// In-circle certificates two at a time, one in each lane of a Pair.
#include <array>
#include <cstddef>
#include <optional>

#include "bernstein.h"
#include "certificates.h"
#include "coordinate_pair.h"
#include "filter.h"
#include "in_circle_coefficients.h"
#include "judge.h"
#include "linear_differences.h"

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

  // As `judge`.
  Filter_result result(std::size_t i, double error) const {
    using Kind = Filter_result::Kind;
    if (!(least_b[i] > error)) return first_failure(lane(c, i), lane(b, i), error);
    if (least_c[i] > error) return {Kind::never_fails, {}};
    return {Kind::holds, {1, 1}};
  }

  Quartic<Pair> c;
  Quartic<Pair> b;
  Pair least_c;
  Pair least_b;
};

}  // namespace

std::array<Filter_result, 2> filter_in_circles(
    const std::array<Quadruple<Linear_motion_2>, 2>& certificates, const Double_interval& after) {
  const auto differences = [&](const Quadruple<Linear_motion_2>& points) {
    const auto& [p, q, r, s] = points;
    return Linear_differences<3>({p, q, r}, *s, after.lower);
  };
  std::array<Linear_differences<3>, 2> d = {differences(certificates[0]),
                                            differences(certificates[1])};
  std::array<double, 2> windows;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::optional<double> window = d[k].window_ahead(window_share);
    if (!window) return {};
    d[k].scale(*window);
    if (!d[k].is_in_range()) return {};
    windows[k] = *window;
  }
  const Triangle<Pair> triangles = {lifted(d[0][1], d[1][1]), lifted(d[0][0], d[1][0])};
  const Two_certificates both(in_circle_coefficients(triangles, lifted(d[0][2], d[1][2])));
  return {in_time(both.result(0, In_circle().error(d[0])), windows[0], after),
          in_time(both.result(1, In_circle().error(d[1])), windows[1], after)};
}

// The five certificates share points. So all of them are made from the differences to one corner,
// over one window, with the error bound of the largest.
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Linear_motion_2>& around,
                                               const Double_interval& after) {
  const auto& [corner, to_right, to_far, to_left] = around.corners;
  const auto& beyond = around.beyond;
  Linear_differences<7> d({to_right, to_far, to_left, beyond[0], beyond[1], beyond[2], beyond[3]},
                          *corner, after.lower);
  const std::optional<double> window = d.window_ahead(window_share);
  if (!window) return {};
  d.scale(*window);
  if (!d.is_in_range()) return {};
  const Lifted<double> far = lifted(d[1]);
  const Lifted<double> left = lifted(d[2]);
  const Triangle<double> first = {lifted(d[0]), far};
  const Triangle<double> second = {far, left};
  const Two_certificates of_first(in_circle_coefficients(first, lifted(d[3], d[4])));
  const Two_certificates of_second(in_circle_coefficients(second, lifted(d[5], d[6])));
  const double error = In_circle().error(d);
  const auto result = [&](const Filter_result& in_w) { return in_time(in_w, *window, after); };
  return {result(of_first.result(0, error)), result(of_first.result(1, error)),
          result(of_second.result(0, error)), result(of_second.result(1, error)),
          result(judge_after_known_root(in_circle_coefficients(first, left), error,
                                        In_circle().norm(d), greatest_root(after, *window)))};
}

}  // namespace kinetri
