// SPDX-License-Identifier: GPL-3.0-or-later
//
// The squared distance of two points in linear motion is a convex quadratic in time. So the discs
// approach up to one time and part from then on, and where its value falls through the squared
// diameter it does so once. The constants of the errors are derived in docs/MATH.md, section 8.
#include "contact_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bernstein.h"
#include "differences.h"

namespace kinetri {
namespace {

// The difference p - q at `origin`, and what is computed from it.
struct Approach {
  Magnitudes magnitudes = {};
  Difference difference;
  double error = 0;  // of a product of the place with the slope

  Approach(const Linear_motion_2& p, const Linear_motion_2& q, double origin)
      : difference(kinetri::difference(p, q, origin, magnitudes)),
        error(64 * unit_roundoff * (sum(magnitudes.terms) * greatest(magnitudes.slope))) {}

  bool is_at_rest() const { return greatest(magnitudes.slope) == 0; }
  bool is_in_range() const {
    return kinetri::is_in_range(sum(magnitudes.terms)) &&
           kinetri::is_in_range(greatest(magnitudes.slope));
  }
  // Half the slope of the squared distance at the origin; it grows with time.
  double half_slope() const { return sum(difference.place * difference.slope); }
};

Double_interval widened(double x, double error) {
  return {x - error, x + error};
}

}  // namespace

// The slope grows with time: the ends of the interval decide.
Sign certain_distance_slope(const Linear_motion_2& p, const Linear_motion_2& q,
                            const Double_interval& interval) {
  const Approach first(p, q, interval.lower);
  if (!first.is_in_range()) return CGAL::ZERO;
  if (first.half_slope() > first.error) return CGAL::POSITIVE;
  if (first.half_slope() >= -first.error) return CGAL::ZERO;
  const Approach last(p, q, interval.upper);
  return last.is_in_range() && last.half_slope() < -last.error ? CGAL::NEGATIVE : CGAL::ZERO;
}

Sign certain_gap(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                 const Double_interval& interval) {
  const Approach approach(p, q, interval.lower);
  const Magnitudes& magnitudes = approach.magnitudes;
  const double moved = greatest(magnitudes.slope) * (interval.upper - interval.lower);
  const double total = sum(magnitudes.terms) + moved;
  if (!kinetri::is_in_range(total) || !(diameter < greatest_size)) return CGAL::ZERO;
  const double squared_diameter = diameter * diameter;
  const auto& place = approach.difference.place;
  const double gap = sum(place * place) - squared_diameter;
  const double size = greatest(magnitudes.extent) + moved + 0x1p-49 * total;
  // The second term bounds the change of the squared distance during the interval.
  const double error = 256 * unit_roundoff * (size * total + squared_diameter) + 8 * size * moved;
  if (gap > error) return CGAL::POSITIVE;
  return gap < -error ? CGAL::NEGATIVE : CGAL::ZERO;
}

Filter_result filter_contact(const Linear_motion_2& p, const Linear_motion_2& q, double diameter,
                             const Double_interval& after) {
  using Kind = Filter_result::Kind;
  const Approach approach(p, q, after.lower);
  if (approach.is_at_rest()) return {Kind::never_fails};
  if (!approach.is_in_range() || !(diameter < greatest_size)) return {};
  const double half_slope = approach.half_slope();
  if (half_slope > approach.error) return {Kind::never_fails};

  const auto& [place, slope] = approach.difference;
  const double squared_speed = sum(slope * slope);
  // The distance at which they pass, times their relative speed.
  const double cross = std::abs(place[0] * slope[1] - place[1] * slope[0]);
  const double reach = diameter * std::sqrt(squared_speed);
  if (cross - approach.error > reach * (1 + 0x1p-40)) return {Kind::never_fails};

  const double squared_diameter = diameter * diameter;
  const double gap = sum(place * place) - squared_diameter;
  const double discriminant = (reach - cross) * (reach + cross);
  if (!(discriminant > 0) || !(gap > 0)) return {};
  // The root is at half of the window. Its distance is computed without cancellation.
  const double window = 2 * gap / (std::sqrt(discriminant) - half_slope);
  if (!is_in_range(window)) return {};
  const Coefficients<2> c = {gap, 2 * half_slope * window, squared_speed * (window * window)};
  const double moved = greatest(approach.magnitudes.slope) * window;
  const double total = sum(approach.magnitudes.terms) + moved;
  const double size = greatest(approach.magnitudes.extent) + moved + 0x1p-49 * total;
  if (!(total < greatest_size)) return {};
  const double error = 256 * unit_roundoff * (size * total + squared_diameter);
  // Positive at the lower end of the bracket and negative at the upper one, the convex polynomial
  // falls up to there.
  double lower = 0;
  double upper = 1;
  if (!(c[0] > error) || !bracket_root(c, error, 0.5, lower, upper)) return {};
  return in_time({Kind::fails, {lower, upper}}, after.lower, window, after);
}

bool certainly_inside(const Linear_motion_2& p, const Wall_2& wall,
                      const Double_interval& interval) {
  const double place = wall.is_vertical() ? p.position.x : p.position.y;
  const double velocity = wall.is_vertical() ? p.velocity.x : p.velocity.y;
  const double moved = std::abs(velocity) * std::max(std::abs(interval.lower - p.epoch),
                                                     std::abs(interval.upper - p.epoch));
  const double terms = std::abs(wall.position) + wall.clearance + std::abs(place) + moved;
  const auto inside = [&](double time) {
    const double there = place + velocity * (time - p.epoch);
    return (wall.is_upper() ? wall.position - there : there - wall.position) - wall.clearance;
  };
  const double error = 16 * unit_roundoff * terms + std::numeric_limits<double>::min();
  return inside(interval.lower) > error && inside(interval.upper) > error;
}

Filter_result filter_wall_contact(const Linear_motion_2& p, const Wall_2& wall,
                                  const Double_interval& after) {
  using Kind = Filter_result::Kind;
  const double place = wall.is_vertical() ? p.position.x : p.position.y;
  const double velocity = wall.is_vertical() ? p.velocity.x : p.velocity.y;
  if (wall.is_upper() ? velocity <= 0 : velocity >= 0) return {Kind::never_fails};
  const double terms = std::abs(wall.position) + wall.clearance + std::abs(place);
  if (!is_in_range(std::abs(velocity)) || !is_in_range(terms)) return {};
  const double bound = wall.position + (wall.is_upper() ? -wall.clearance : wall.clearance);
  const double elapsed = (bound - place) / velocity;
  const double time = p.epoch + elapsed;
  const double error = 16 * unit_roundoff * (terms / std::abs(velocity) + std::abs(time)) +
                       std::numeric_limits<double>::min();
  const Double_interval bounds = widened(time, error);
  if (!(bounds.lower > after.upper) || !std::isfinite(bounds.upper)) return {};
  return {Kind::fails, bounds};
}

}  // namespace kinetri
