// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_distance.h"

#include <cmath>
#include <limits>

#include "precise_places.h"

namespace kinetri {
namespace {

// The difference d of two points at a time, and the exact difference v of their velocities.
struct Difference_of_places {
  Difference_of_places(const Linear_motion_2& p, const Linear_motion_2& q, double time)
      : places({&p, &q}, {time}),
        vx(exact_sum(p.velocity.x, -q.velocity.x)),
        vy(exact_sum(p.velocity.y, -q.velocity.y)),
        speed(std::abs(vx.high) + std::abs(vy.high)) {}

  const Double_double& x() const { return places.relative(0).x; }
  const Double_double& y() const { return places.relative(0).y; }
  // d.v, half the slope of the squared distance; the determinant |d v|, which is constant in time;
  // and an error bound for both.
  Double_double half_slope() const { return x() * vx + y() * vy; }
  Double_double determinant() const { return x() * vy - y() * vx; }
  double error() const { return 256 * unit * (places.terms() * speed); }
  Double_double squared_speed() const { return vx * vx + vy * vy; }
  bool is_in_range() const {
    return places.is_in_range() && kinetri::is_in_range(speed) && is_precise();
  }

  Places<2, Linear_motion_2> places;
  Double_double vx;
  Double_double vy;
  double speed;
};

// The binary64 number nearest to sqrt(a / b) if it is certain, that is, if the root is between the
// midpoints of the number and its neighbors. a and b have errors up to error_a and error_b.
std::optional<double> rounded_root(const Double_double& a, double error_a, const Double_double& b,
                                   double error_b) {
  double nearest = std::sqrt(a.high / b.high);
  if (!is_in_range(nearest)) return std::nullopt;
  // The sign of a - m^2 b, where m is the midpoint of the number and its neighbor.
  const auto beyond_middle = [&](double neighbor) {
    const Double_double middle = exact_sum(nearest, 0.5 * (neighbor - nearest));
    const Double_double square = middle * middle;
    const Double_double other = square * b;
    const double error = error_a + 2 * square.high * error_b + 32 * unit * other.high;
    return certain(a - other, error);
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int attempts = 0; attempts < 3; ++attempts) {
    const double next = std::nextafter(nearest, infinity);
    const double previous = std::nextafter(nearest, 0);
    const double above = beyond_middle(next);
    const double below = beyond_middle(previous);
    if (above == 0 || below == 0) return std::nullopt;
    if (above < 0 && below > 0) return nearest;
    nearest = above > 0 ? next : previous;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Rounding> rounded_time_of_least_distance(const Linear_motion_2& p,
                                                       const Linear_motion_2& q) {
  // Newton steps in binary64, so that the last step, with double_double, is small.
  double time = p.epoch;
  for (int attempts = 0; attempts < 2; ++attempts) {
    const Difference_of_places at(p, q, time);
    if (!at.is_in_range()) return std::nullopt;
    time -= at.half_slope().high / at.squared_speed().high;
    if (!std::isfinite(time)) return std::nullopt;
  }
  const Difference_of_places at(p, q, time);
  if (!at.is_in_range()) return std::nullopt;
  const double slope = at.squared_speed().high;
  return newton_rounding(time, at.half_slope().high, at.error(), slope, 8 * unit_roundoff * slope);
}

std::optional<double> rounded_least_distance(const Linear_motion_2& p, const Linear_motion_2& q) {
  const Difference_of_places at(p, q, p.epoch);
  if (!at.is_in_range()) return std::nullopt;
  const Double_double determinant = at.determinant();
  const Double_double squared_speed = at.squared_speed();
  const Double_double square = determinant * determinant;
  const double error = at.error() * (2 * std::abs(determinant.high) + at.error());
  return rounded_root(square, 2 * error + 16 * unit * square.high, squared_speed,
                      32 * unit * squared_speed.high);
}

std::optional<double> rounded_distance_at(const Linear_motion_2& p, const Linear_motion_2& q,
                                          double time) {
  const Places<2, Linear_motion_2> places({&p, &q}, {time});
  if (!places.is_in_range() || !is_precise()) return std::nullopt;
  return rounded_root(places.squared_length(0), 256 * unit * (places.size() * places.terms()), {1},
                      0);
}

}  // namespace kinetri
