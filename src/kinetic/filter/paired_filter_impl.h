// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of filter.h: in-circle certificates two at a time, one in each lane of a Pair.
#ifndef KINETRI_SRC_KINETIC_FILTER_PAIRED_FILTER_IMPL_H
#define KINETRI_SRC_KINETIC_FILTER_PAIRED_FILTER_IMPL_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "bernstein.h"
#include "certificates.h"
#include "classify.h"
#include "coordinate_pair.h"
#include "differences.h"
#include "filter.h"
#include "first_failure.h"
#include "in_circle_coefficients.h"

namespace kinetri {
namespace {

template <std::size_t M>
Pair least(const std::array<Pair, M>& c) {
  Pair result = c[0];
  for (std::size_t i = 1; i < M; ++i) result = lesser(result, c[i]);
  return result;
}

// Two certificates over a window, one in each lane.
template <std::size_t M>
struct Two_certificates {
  explicit Two_certificates(const std::array<Pair, M>& coefficients)
      : c(coefficients), b(bernstein(c)), least_c(least(c)), least_b(least(b)) {}

  static std::array<double, M> lane(const std::array<Pair, M>& x, std::size_t i) {
    std::array<double, M> result;
    for (std::size_t k = 0; k < M; ++k) result[k] = x[k][i];
    return result;
  }

  // As `classify`.
  Filter_result result(std::size_t i, double error) const {
    if (!(least_b[i] > error)) return first_failure(lane(c, i), lane(b, i), error);
    if (least_c[i] > error) return {Filter_result::Kind::never_fails, {}};
    return {Filter_result::Kind::holds, {1, 1}};
  }

  std::array<Pair, M> c;
  std::array<Pair, M> b;
  Pair least_c;
  Pair least_b;
};

// Two in-circle certificates, of differences to the fourth point of each.
template <class Differences>
std::array<Filter_result, 2> in_circles(std::array<Differences, 2> d,
                                        const Double_interval& after) {
  std::array<double, 2> windows;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::optional<double> window = d[k].window_ahead(window_share);
    if (!window) return {};
    d[k].scale(*window);
    if (!d[k].is_in_range()) return {};
    windows[k] = *window;
  }
  const Triangle triangles = {lifted(d[0], 1, d[1], 1), lifted(d[0], 0, d[1], 0)};
  const Two_certificates both(in_circle_coefficients(triangles, lifted(d[0], 2, d[1], 2)));
  return {in_time(both.result(0, In_circle().error(d[0])), windows[0], after),
          in_time(both.result(1, In_circle().error(d[1])), windows[1], after)};
}

// The five certificates share points, so all are computed from the differences `d` to one corner,
// over one window, with one error bound.
template <class Differences>
std::array<Filter_result, 5> after_flip(Differences d, const Double_interval& after) {
  const std::optional<double> window = d.window_ahead(window_share);
  if (!window) return {};
  d.scale(*window);
  if (!d.is_in_range()) return {};
  const auto far = lifted(d, 1);
  const auto left = lifted(d, 2);
  const Triangle first = {lifted(d, 0), far};
  const Triangle second = {far, left};
  const Two_certificates of_first(in_circle_coefficients(first, lifted(d, 3, d, 4)));
  const Two_certificates of_second(in_circle_coefficients(second, lifted(d, 5, d, 6)));
  const double error = In_circle().error(d);
  const auto result = [&](const Filter_result& in_w) { return in_time(in_w, *window, after); };
  return {result(of_first.result(0, error)), result(of_first.result(1, error)),
          result(of_second.result(0, error)), result(of_second.result(1, error)),
          result(classify_after_known_root(in_circle_coefficients(first, left), error,
                                           In_circle().norm(d), greatest_root(after, *window)))};
}

template <class Motion>
std::array<const Motion*, 3> all_but_last(const Quadruple<Motion>& points) {
  return {points[0], points[1], points[2]};
}
template <class Motion>
std::array<const Motion*, 7> all_but_first(const Flip_neighborhood<Motion>& around) {
  const auto& [corner, to_right, to_far, to_left] = around.corners;
  const auto& beyond = around.beyond;
  return {to_right, to_far, to_left, beyond[0], beyond[1], beyond[2], beyond[3]};
}

// In what follows `kind` is the kind of differences (differences.h).

template <class Differences, class Motion, class Kind>
std::array<Filter_result, 2> in_circles_of(const std::array<Quadruple<Motion>, 2>& certificates,
                                           const Double_interval& after, const Kind& kind) {
  const auto differences = [&](std::size_t k) {
    const Quadruple<Motion>& points = certificates[k];
    return kind.template make<Differences>(all_but_last(points), *points[3], after.lower, k);
  };
  return in_circles(std::array{differences(0), differences(1)}, after);
}

template <LinearMotion Motion, class Kind>
std::array<Filter_result, 2> in_circles(const std::array<Quadruple<Motion>, 2>& certificates,
                                        const Double_interval& after, const Kind& kind) {
  return in_circles_of<Linear_differences<3, Motion>>(certificates, after, kind);
}

template <class Kind>
std::array<Filter_result, 2> in_circles(
    const std::array<Quadruple<Polynomial_motion_2>, 2>& certificates, const Double_interval& after,
    const Kind& kind) {
  const std::size_t k = degree(certificates[0]);
  if (degree(certificates[1]) != k) return {};  // so that no result depends on the pairing
  if (k == 3) {
    return in_circles_of<Polynomial_differences<3, 3>>(certificates, after, kind);
  }
  if (k == 2) {
    return in_circles_of<Polynomial_differences<3, 2>>(certificates, after, kind);
  }
  std::array<std::array<Linear_motion_2, 4>, 2> lines;
  return in_circles(
      std::array{linear(certificates[0], lines[0]), linear(certificates[1], lines[1])}, after,
      kind);
}

template <class Differences, class Motion, class Kind>
std::array<Filter_result, 5> after_flip_of(const Flip_neighborhood<Motion>& around,
                                           const Double_interval& after, const Kind& kind) {
  return after_flip(
      kind.template make<Differences>(all_but_first(around), *around.corners[0], after.lower, 0),
      after);
}

template <LinearMotion Motion, class Kind>
std::array<Filter_result, 5> after_flip(const Flip_neighborhood<Motion>& around,
                                        const Double_interval& after, const Kind& kind) {
  return after_flip_of<Linear_differences<7, Motion>>(around, after, kind);
}

template <class Kind>
std::array<Filter_result, 5> after_flip(const Flip_neighborhood<Polynomial_motion_2>& around,
                                        const Double_interval& after, const Kind& kind) {
  const std::size_t k = std::max(degree(around.corners), degree(around.beyond));
  if (k == 3) return after_flip_of<Polynomial_differences<7, 3>>(around, after, kind);
  if (k == 2) return after_flip_of<Polynomial_differences<7, 2>>(around, after, kind);
  std::array<std::array<Linear_motion_2, 4>, 2> lines;
  return after_flip(Flip_neighborhood<Linear_motion_2>{linear(around.corners, lines[0]),
                                                       linear(around.beyond, lines[1])},
                    after, kind);
}

}  // namespace

template <class Motion>
std::array<Filter_result, 2> filter_in_circles(const std::array<Quadruple<Motion>, 2>& certificates,
                                               const Double_interval& after) {
  if constexpr (HasWeight<Motion>) {
    const std::array of_centers = {centers(certificates[0]), centers(certificates[1])};
    if (have_same_weight_numbers(certificates[0]) && have_same_weight_numbers(certificates[1])) {
      return filter_in_circles(of_centers, after);
    }
    const With_weights<Motion, 3, 2> weights = {
        {all_but_last(certificates[0]), all_but_last(certificates[1])},
        {certificates[0][3], certificates[1][3]}};
    return in_circles(of_centers, after, weights);
  } else {
    return in_circles(certificates, after, Alone());
  }
}

template <class Motion>
std::array<Filter_result, 5> filter_after_flip(const Flip_neighborhood<Motion>& around,
                                               const Double_interval& after) {
  if constexpr (HasWeight<Motion>) {
    const Flip_neighborhood<typename Motion::Center_motion> of_centers = {centers(around.corners),
                                                                          centers(around.beyond)};
    if (have_same_weight_numbers(around.corners) && have_same_weight_numbers(around.beyond) &&
        have_same_weight_numbers(*around.corners[0], *around.beyond[0])) {
      return filter_after_flip(of_centers, after);
    }
    const With_weights<Motion, 7> weights = {{all_but_first(around)}, {around.corners[0]}};
    return after_flip(of_centers, after, weights);
  } else {
    return after_flip(around, after, Alone());
  }
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_PAIRED_FILTER_IMPL_H
