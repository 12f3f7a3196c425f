// SPDX-License-Identifier: GPL-3.0-or-later
//
// The five certificates after a flip share points. So all of them are made from the differences to
// one corner, over one window, with the error bound of the largest; those of the outer edges two at
// a time, one in each lane of a Pair.
#include <algorithm>
#include <array>

#include "bernstein.h"
#include "coordinate_pair.h"
#include "differences.h"
#include "kinetri/kinetic/linear_filter.h"
#include "linear_frame.h"

namespace kinetri {
namespace {

template <class Number>
using Quadratic = std::array<Number, 3>;
template <class Number>
using Quartic = std::array<Number, 5>;

// The difference of a point to the corner in w, with its squared length.
template <class Number>
struct Lifted {
  Number x, y;
  Number slope_x, slope_y;
  Quadratic<Number> squared_length = {x * x + y * y, 2 * (x * slope_x + y * slope_y),
                                      slope_x* slope_x + slope_y* slope_y};
};

Lifted<double> lifted(const Difference& d) {
  return {d.place[0], d.place[1], d.slope[0], d.slope[1]};
}
Lifted<Pair> lifted(const Difference& a, const Difference& b) {
  return {firsts(a.place, b.place), seconds(a.place, b.place), firsts(a.slope, b.slope),
          seconds(a.slope, b.slope)};
}

template <class A, class B>
auto vector_product(const Lifted<A>& a, const Lifted<B>& b) {
  using Number = decltype(A() * B());
  return Quadratic<Number>{
      a.x * b.y - a.y * b.x,
      (a.x * b.slope_y - a.y * b.slope_x) + (a.slope_x * b.y - a.slope_y * b.x),
      a.slope_x * b.slope_y - a.slope_y * b.slope_x};
}

// Two points that make a left turn about the corner, and their vector product.
struct Triangle {
  Lifted<double> u;
  Lifted<double> v;
  Quadratic<double> uv = vector_product(u, v);
};

// Minus the in-circle determinant of the triangle and s.
template <class Number>
Quartic<Number> in_circle_coefficients(const Triangle& t, const Lifted<Number>& s) {
  const Quadratic<Number> vs = vector_product(t.v, s);
  const Quadratic<Number> us = vector_product(t.u, s);
  const Quadratic<double>& uv = t.uv;
  const Quadratic<double>& u = t.u.squared_length;
  const Quadratic<double>& v = t.v.squared_length;
  const Quadratic<Number>& l = s.squared_length;
  return {
      u[0] * vs[0] - v[0] * us[0] + uv[0] * l[0],
      (u[0] * vs[1] + u[1] * vs[0]) - (v[0] * us[1] + v[1] * us[0]) + (uv[1] * l[0] + uv[0] * l[1]),
      (u[0] * vs[2] + u[1] * vs[1] + u[2] * vs[0]) - (v[0] * us[2] + v[1] * us[1] + v[2] * us[0]) +
          (uv[2] * l[0] + uv[1] * l[1] + uv[0] * l[2]),
      (u[1] * vs[2] + u[2] * vs[1]) - (v[1] * us[2] + v[2] * us[1]) + (uv[2] * l[1] + uv[1] * l[2]),
      u[2] * vs[2] - v[2] * us[2] + uv[2] * l[2]};
}

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

  Filter_verdict verdict(std::size_t i, double error, double window,
                         const Double_interval& after) const {
    using Kind = Filter_verdict::Kind;
    if (!(least_b[i] > error)) {
      return in_time(first_failure(lane(c, i), lane(b, i), error), after.lower, window, after);
    }
    if (least_c[i] > error) return {Kind::holds_for_ever, {}};
    return in_time({Kind::holds, {1, 1}}, after.lower, window, after);
  }

  Quartic<Pair> c;
  Quartic<Pair> b;
  Pair least_c;
  Pair least_b;
};

}  // namespace

std::array<Filter_verdict, 5> filter_after_flip(const Flip_neighborhood<Linear_motion_2>& around,
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
  const Triangle first = {lifted(d[0]), far};
  const Triangle second = {far, left};
  const Two_certificates of_first(in_circle_coefficients(first, lifted(d[3], d[4])));
  const Two_certificates of_second(in_circle_coefficients(second, lifted(d[5], d[6])));
  const double error = f.in_circle_error();
  return {of_first.verdict(0, error, f.window, after), of_first.verdict(1, error, f.window, after),
          of_second.verdict(0, error, f.window, after),
          of_second.verdict(1, error, f.window, after),
          judge_after_root(in_circle_coefficients(first, left), error, in_circle_norm, f.window,
                           after)};
}

}  // namespace kinetri
