// SPDX-License-Identifier: GPL-3.0-or-later
//
// As in linear_filter.cpp the polynomials are in w, where the time is origin + w * window and
// 0 <= w <= 1. The constants of the errors are derived in docs/MATH.md, section 9.
#include "polynomial_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "bernstein.h"
#include "contact_filter.h"
#include "differences.h"
#include "linear_filter.h"

namespace kinetri {
namespace {

using Cubic = Coefficients<3>;

// ---- polynomials ----

template <std::size_t M, std::size_t N>
std::array<double, M + N - 1> operator*(const std::array<double, M>& a,
                                        const std::array<double, N>& b) {
  std::array<double, M + N - 1> result = {};
  for (std::size_t i = 0; i < M; ++i) {
    for (std::size_t j = 0; j < N; ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}
template <std::size_t M>
std::array<double, M> operator+(std::array<double, M> a, const std::array<double, M>& b) {
  for (std::size_t i = 0; i < M; ++i) a[i] += b[i];
  return a;
}
template <std::size_t M>
std::array<double, M> operator-(std::array<double, M> a, const std::array<double, M>& b) {
  for (std::size_t i = 0; i < M; ++i) a[i] -= b[i];
  return a;
}

template <std::size_t M>
std::array<double, M - 1> slope_of(const std::array<double, M>& c) {
  std::array<double, M - 1> result;
  for (std::size_t i = 1; i < M; ++i) result[i - 1] = static_cast<double>(i) * c[i];
  return result;
}

Cubic absolute(Cubic c) {
  for (double& x : c) x = std::abs(x);
  return c;
}
double sum(const Cubic& c) {
  return (c[0] + c[1]) + (c[2] + c[3]);
}

// ---- motions about an origin ----

// One coordinate by powers of the time from its epoch.
Cubic by_powers(const Polynomial_motion_2& m, double Vector_2::*axis) {
  return {m.position.*axis, m.velocity.*axis, 0.5 * m.acceleration.*axis, m.jerk.*axis / 6};
}

// By powers of the time from `elapsed` later.
Cubic later(const Cubic& c, double elapsed) {
  const double c3 = elapsed * c[3];
  return {c[0] + elapsed * (c[1] + elapsed * (c[2] + c3)), c[1] + elapsed * (2 * c[2] + 3 * c3),
          c[2] + 3 * c3, c[3]};
}

struct Cubic_difference {
  Cubic x;
  Cubic y;
};

// The differences that a certificate is made from, and what bounds them: with a window they become
// polynomials in w.
template <std::size_t N>
class Differences {
 public:
  // Of the points `from` to `to`, at the origin.
  Differences(const std::array<const Polynomial_motion_2*, N>& from, const Polynomial_motion_2& to,
              double origin) {
    for (std::size_t i = 0; i < N; ++i) {
      differences_[i] = {coordinate(*from[i], to, origin, &Vector_2::x),
                         coordinate(*from[i], to, origin, &Vector_2::y)};
    }
  }

  // The time in which the points would pass `share` of their distance from one another. None if
  // they do not move against each other; out of range where that cannot be said.
  std::optional<double> window_ahead(double share) const {
    Cubic extent = {};
    for (const auto& [x, y] : differences_) {
      for (std::size_t k = 0; k < 4; ++k) {
        extent[k] = std::max({extent[k], std::abs(x[k]), std::abs(y[k])});
      }
    }
    const double speed = extent[1] + std::sqrt(extent[2] * extent[0]) +
                         std::cbrt(extent[3] * (extent[0] * extent[0]));
    if (extent[1] == 0 && extent[2] == 0 && extent[3] == 0) return std::nullopt;
    return share * extent[0] / speed;
  }

  // Scales to the window.
  void scale(double window) {
    const Cubic powers = {1, window, window * window, window * window * window};
    for (std::size_t k = 0; k < 4; ++k) {
      terms_[k] *= powers[k];
      for (auto& [x, y] : differences_) {
        x[k] *= powers[k];
        y[k] *= powers[k];
      }
    }
    total_ = sum(terms_);
    for (const auto& [x, y] : differences_) {
      size_ = std::max({size_, sum(absolute(x)), sum(absolute(y))});
    }
    // More than the error of the coefficients.
    size_ += 0x1p-48 * total_;
    is_in_range_ = size_ > least_size && total_ < greatest_size &&
                   (window == 0 || kinetri::is_in_range(window));
  }

  const Cubic_difference& operator[](std::size_t i) const { return differences_[i]; }

  // Of the scaled differences: the greatest sum of magnitudes of the coefficients of one, and the
  // sum of all numbers that they were made from.
  double size() const { return size_; }
  double total() const { return total_; }
  bool is_in_range() const { return is_in_range_; }

 private:
  Cubic coordinate(const Polynomial_motion_2& p, const Polynomial_motion_2& q, double origin,
                   double Vector_2::*axis) {
    const Cubic from = by_powers(p, axis);
    const Cubic to = by_powers(q, axis);
    if (p.epoch == q.epoch) {
      // Taking the difference first keeps the coordinates' common part out of the error.
      const Cubic difference = from - to;
      terms_ = terms_ + later(absolute(difference), std::abs(origin - p.epoch));
      return later(difference, origin - p.epoch);
    }
    terms_ = terms_ + later(absolute(from), std::abs(origin - p.epoch)) +
             later(absolute(to), std::abs(origin - q.epoch));
    return later(from, origin - p.epoch) - later(to, origin - q.epoch);
  }

  std::array<Cubic_difference, N> differences_;
  Cubic terms_ = {};
  double size_ = 0;
  double total_ = 0;
  bool is_in_range_ = false;
};

Coefficients<6> cross(const Cubic_difference& a, const Cubic_difference& b) {
  return a.x * b.y - a.y * b.x;
}
Coefficients<6> dot(const Cubic_difference& a, const Cubic_difference& b) {
  return a.x * b.x + a.y * b.y;
}

// ---- linear points ----

bool is_linear(const Polynomial_motion_2& m) {
  constexpr Vector_2 zero = {};
  return m.acceleration == zero && m.jerk == zero;
}
Linear_motion_2 linear(const Polynomial_motion_2& m) {
  return {m.position, m.velocity, m.epoch};
}

// ---- the certificates ----

constexpr double window_share = 0.5;
// Walls are far away and stay where they are, so that the time of the contact is looked for at
// once.
constexpr double window_share_of_walls = 4;

// Minus the in-circle determinant of differences to the fourth point.
Coefficients<12> in_circle(const Differences<3>& d) {
  Coefficients<12> c = {};
  for (std::size_t i = 0; i < 3; ++i) {
    c = c - dot(d[i], d[i]) * cross(d[(i + 1) % 3], d[(i + 2) % 3]);
  }
  return c;
}
Coefficients<6> orientation(const Differences<2>& d) {
  return cross(d[0], d[1]);
}

template <std::size_t N>
double in_circle_error(const Differences<N>& d) {
  return 8192 * unit_roundoff * (d.size() * d.size()) * (d.size() * d.total());
}
template <std::size_t N>
double orientation_error(const Differences<N>& d) {
  return 512 * unit_roundoff * (d.size() * d.total());
}
double contact_error(const Differences<1>& d, double squared_diameter) {
  return 512 * unit_roundoff * (d.size() * d.total() + squared_diameter);
}
template <std::size_t N>
double coordinate_error(const Differences<N>& d) {
  return 128 * unit_roundoff * d.total();
}

// The sum of the coefficients' magnitudes is at most this many times error.
constexpr double in_circle_norm = 12 / (8192 * unit_roundoff);
constexpr double orientation_norm = 2 / (512 * unit_roundoff);

// The result on the certificate that `polynomial` makes of the differences.
template <std::size_t N, class Polynomial, class Error>
Filter_result judge_differences(Differences<N> d, Polynomial polynomial, Error error, double norm,
                                const Double_interval& after, bool vanishes_at) {
  const std::optional<double> window = d.window_ahead(window_share);
  d.scale(window.value_or(0));
  if (!d.is_in_range()) return {};
  const auto c = polynomial(d);
  if (!window) return judge_constant(c[0], error(d));
  return vanishes_at ? first_failure_after_known_root(c, error(d), norm, *window, after)
                     : judge(c, error(d), *window, after);
}

// The sign throughout an interval, where it is certain.
template <std::size_t N, class Polynomial, class Error>
Sign sign_throughout(Differences<N> d, Polynomial polynomial, Error error,
                     const Double_interval& interval) {
  d.scale(2 * (interval.upper - interval.lower));
  if (!d.is_in_range()) return CGAL::ZERO;
  return certain_sign(polynomial(d), error(d));
}

// The first time at which a distance, as a polynomial, is not positive and falls.
template <std::size_t M>
Filter_result first_contact(const std::array<double, M>& c, double error, double window,
                            const Double_interval& after) {
  if (c[0] > error) return judge(c, error, window, after);
  // It may touch or overlap: nothing happens as long as it rises.
  const auto slope = slope_of(c);
  const double error_of_slope = static_cast<double>(M) * error;
  if (least(slope) > error_of_slope) return {Filter_result::Kind::never_fails};
  const double share = positive_share(bernstein(slope), error_of_slope);
  return in_time({Filter_result::Kind::holds, {share, share}}, after.lower, window, after);
}

}  // namespace

Filter_result filter_in_circle(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                               const Polynomial_motion_2& r, const Polynomial_motion_2& s,
                               const Double_interval& after, bool vanishes_at) {
  if (is_linear(p) && is_linear(q) && is_linear(r) && is_linear(s)) {
    return filter_in_circle(linear(p), linear(q), linear(r), linear(s), after, vanishes_at);
  }
  return judge_differences(Differences<3>({&p, &q, &r}, s, after.lower), in_circle,
                           in_circle_error<3>, in_circle_norm, after, vanishes_at);
}

Filter_result filter_orientation(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                                 const Polynomial_motion_2& r, const Double_interval& after,
                                 bool vanishes_at) {
  if (is_linear(p) && is_linear(q) && is_linear(r)) {
    return filter_orientation(linear(p), linear(q), linear(r), after, vanishes_at);
  }
  return judge_differences(Differences<2>({&q, &r}, p, after.lower), orientation,
                           orientation_error<2>, orientation_norm, after, vanishes_at);
}

Sign certain_x_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval) {
  return sign_throughout(
      Differences<1>({&p}, q, interval.lower), [](const auto& d) { return d[0].x; },
      coordinate_error<1>, interval);
}

Sign certain_y_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval) {
  return sign_throughout(
      Differences<1>({&p}, q, interval.lower), [](const auto& d) { return d[0].y; },
      coordinate_error<1>, interval);
}

Sign certain_orientation(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                         const Polynomial_motion_2& r, const Double_interval& interval) {
  return sign_throughout(Differences<2>({&q, &r}, p, interval.lower), orientation,
                         orientation_error<2>, interval);
}

Sign certain_in_circle(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                       const Polynomial_motion_2& r, const Polynomial_motion_2& s,
                       const Double_interval& interval) {
  return -sign_throughout(Differences<3>({&p, &q, &r}, s, interval.lower), in_circle,
                          in_circle_error<3>, interval);
}

Sign certain_scalar_product(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Polynomial_motion_2& r, const Double_interval& interval) {
  return sign_throughout(
      Differences<2>({&p, &r}, q, interval.lower), [](const auto& d) { return dot(d[0], d[1]); },
      orientation_error<2>, interval);
}

Sign certain_distance_order(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Polynomial_motion_2& r, const Double_interval& interval) {
  return sign_throughout(
      Differences<2>({&q, &r}, p, interval.lower),
      [](const auto& d) { return dot(d[0], d[0]) - dot(d[1], d[1]); },
      [](const auto& d) { return 2 * orientation_error(d); }, interval);
}

bool certainly_apart(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                     const Double_interval& interval) {
  if (!std::isfinite(interval.upper)) return false;
  return certain_x_order(p, q, interval) != CGAL::ZERO ||
         certain_y_order(p, q, interval) != CGAL::ZERO;
}

// ---- contacts ----

Filter_result filter_contact(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                             double diameter, const Double_interval& after) {
  if (is_linear(p) && is_linear(q)) return filter_contact(linear(p), linear(q), diameter, after);
  Differences<1> d({&p}, q, after.lower);
  const std::optional<double> window = d.window_ahead(window_share);
  if (!window) return {Filter_result::Kind::never_fails};
  d.scale(*window);
  if (!d.is_in_range() || !(diameter < greatest_size)) return {};
  Coefficients<6> c = dot(d[0], d[0]);
  const double squared_diameter = diameter * diameter;
  c[0] -= squared_diameter;
  return first_contact(c, contact_error(d, squared_diameter), *window, after);
}

Sign certain_distance_slope(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                            const Double_interval& interval) {
  return sign_throughout(
      Differences<1>({&p}, q, interval.lower),
      [](const auto& d) { return slope_of(dot(d[0], d[0])); },
      [](const auto& d) { return 7 * orientation_error(d); }, interval);
}

Sign certain_gap(const Polynomial_motion_2& p, const Polynomial_motion_2& q, double diameter,
                 const Double_interval& interval) {
  if (!(diameter < greatest_size)) return CGAL::ZERO;
  const double squared_diameter = diameter * diameter;
  return sign_throughout(
      Differences<1>({&p}, q, interval.lower),
      [&](const auto& d) {
        Coefficients<6> c = dot(d[0], d[0]);
        c[0] -= squared_diameter;
        return c;
      },
      [&](const auto& d) { return contact_error(d, squared_diameter); }, interval);
}

namespace {

// The point that is at the line of the wall, and else where `p` is.
Polynomial_motion_2 foot_at(const Polynomial_motion_2& p, const Wall_2& wall) {
  Polynomial_motion_2 foot = p;
  const auto axis = wall.is_vertical() ? &Vector_2::x : &Vector_2::y;
  foot.position.*axis = wall.position;
  foot.velocity.*axis = 0;
  foot.acceleration.*axis = 0;
  foot.jerk.*axis = 0;
  return foot;
}

// How far inside of the bound, from the scaled difference of the point from its foot.
Cubic distance_inside(const Differences<1>& d, const Wall_2& wall) {
  Cubic c = wall.is_vertical() ? d[0].x : d[0].y;
  if (wall.is_upper()) {
    for (double& x : c) x = -x;
  }
  c[0] -= wall.clearance;
  return c;
}

double wall_error(const Differences<1>& d, const Wall_2& wall) {
  return 128 * unit_roundoff * (d.total() + wall.clearance);
}

}  // namespace

bool certainly_inside(const Polynomial_motion_2& p, const Wall_2& wall,
                      const Double_interval& interval) {
  return sign_throughout(
             Differences<1>({&p}, foot_at(p, wall), interval.lower),
             [&](const auto& d) { return distance_inside(d, wall); },
             [&](const auto& d) { return wall_error(d, wall); }, interval) == CGAL::POSITIVE;
}

Filter_result filter_wall_contact(const Polynomial_motion_2& p, const Wall_2& wall,
                                  const Double_interval& after) {
  if (is_linear(p)) return filter_wall_contact(linear(p), wall, after);
  Differences<1> d({&p}, foot_at(p, wall), after.lower);
  const std::optional<double> window = d.window_ahead(window_share_of_walls);
  if (!window) return {Filter_result::Kind::never_fails};
  d.scale(*window);
  if (!d.is_in_range() || !(wall.clearance < greatest_size)) return {};
  return first_contact(distance_inside(d, wall), wall_error(d, wall), *window, after);
}

}  // namespace kinetri
