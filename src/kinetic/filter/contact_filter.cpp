// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificates of contacts. The constants of the errors are derived in docs/MATH.md, sections 8
// and 9.
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include "bernstein.h"
#include "certificates.h"
#include "differences.h"
#include "filter.h"
#include "judge.h"

namespace kinetri {
namespace {

using Kind = Filter_result::Kind;

// Of the difference of two points: how much their squared distance is more than another.
struct Distance {
  double squared_diameter;

  auto operator()(const auto& d) const {
    auto c = dot(d[0], d[0]);
    c[0] -= squared_diameter;
    return c;
  }
  double error(const auto& d) const {
    return product_error(d) + d.product_units * unit_roundoff * squared_diameter;
  }
};

// Of the difference of a point from its foot: how far inside of the bound it is.
struct Inside {
  const Wall_2& wall;

  auto operator()(const auto& d) const {
    auto c = coordinate(d[0], wall.is_vertical() ? 0 : 1);
    if (wall.is_upper()) c = negated(c);
    c[0] -= wall.clearance;
    return c;
  }
  double error(const auto& d) const {
    return coordinate_error(d) + d.coordinate_units * unit_roundoff * wall.clearance;
  }
};

// The point that is at the line of the wall, and else where `p` is.
template <class Motion>
Motion foot_at(const Motion& p, const Wall_2& wall) {
  Motion foot = p;
  const auto axis = wall.is_vertical() ? &Vector_2::x : &Vector_2::y;
  foot.position.*axis = wall.position;
  foot.velocity.*axis = 0;
  if constexpr (requires { foot.jerk; }) {
    foot.acceleration.*axis = 0;
    foot.jerk.*axis = 0;
  }
  return foot;
}

// ---- linear motion ----

// Whether the discs are certainly apart throughout the interval, from the origin on, before the
// differences are scaled.
bool are_apart(const Linear_differences<1>& d, double diameter, const Double_interval& interval) {
  const double squared_diameter = diameter * diameter;
  const double error =
      error_throughout(d, interval) + d.product_units * unit_roundoff * squared_diameter;
  const Pair& place = d[0].place;
  return sum(place * place) - squared_diameter > error;
}

// The squared distance of two points in linear motion is a convex quadratic in time. So the discs
// approach up to one time and part from then on, and where its value falls through the squared
// diameter it does so once.
Filter_result contact(Linear_differences<1>& d, double diameter, const Double_interval& after) {
  const auto never = [&] {
    return Filter_result{Kind::never_fails, {}, false, !are_apart(d, diameter, after)};
  };
  if (d.speed() == 0) return never();
  if (!is_unscaled_in_range(d)) return {};
  const auto& [place, slope] = d[0];
  // Half the slope of the squared distance; it grows with time.
  const double half_slope = sum(place * slope);
  if (half_slope > unscaled_error(d)) return never();
  const double squared_speed = sum(slope * slope);
  // The distance at which they pass, times their relative speed.
  const double cross = std::abs(place[0] * slope[1] - place[1] * slope[0]);
  const double reach = diameter * std::sqrt(squared_speed);
  if (cross - unscaled_error(d) > reach * (1 + 0x1p-40)) return never();

  const double squared_diameter = diameter * diameter;
  const double gap = sum(place * place) - squared_diameter;
  const double discriminant = (reach - cross) * (reach + cross);
  if (!(discriminant > 0) || !(gap > 0)) return {};
  // The root is at half of the window. Its distance is computed without cancellation.
  const double window = 2 * gap / (std::sqrt(discriminant) - half_slope);
  d.scale(window);
  if (!d.is_in_range()) return {};
  const Distance distance = {squared_diameter};
  const Coefficients<2> c = distance(d);
  const double error = distance.error(d);
  // Positive at the lower end of the bracket and negative at the upper one, the convex polynomial
  // falls up to there.
  double lower = 0;
  double upper = 1;
  if (!(c[0] > error) || !bracket_root(c, error, 0.5, lower, upper)) return {};
  return in_time({Kind::fails, {lower, upper}}, window, after);
}

Filter_result wall_contact(const Linear_motion_2& p, const Wall_2& wall,
                           const Double_interval& after) {
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
  const Double_interval bounds = {time - error, time + error};
  if (!(bounds.lower > after.upper) || !std::isfinite(bounds.upper)) return {};
  return {Kind::fails, bounds};
}

// ---- polynomial motion ----

// Walls are far away and stay where they are, so that the time of the contact is looked for at
// once.
constexpr double window_share_of_walls = 4;

// The error of the slope of a polynomial, in errors of its values.
template <std::size_t M>
constexpr double slope_errors(const std::array<double, M>& /*slope*/) {
  return static_cast<double>(M + 1);
}

// The first time at which a distance is not positive and falls.
template <std::size_t K, class Certificate>
Filter_result first_contact(Polynomial_differences<1, K>& d, const Certificate& distance,
                            double share, const Double_interval& after) {
  const std::optional<double> window = d.window_ahead(share);
  if (!window) return {Kind::never_fails, {}, false, true};
  d.scale(*window);
  if (!d.is_in_range()) return {};
  const auto c = distance(d);
  const double error = distance.error(d);
  if (c[0] > error) return in_time(judge(c, error), *window, after);
  // It may touch or overlap: nothing happens as long as it rises.
  const auto slope = slope_of(c);
  if (least(slope) > slope_errors(slope) * error) return {Kind::never_fails, {}, false, true};
  const double rising = positive_share(bernstein(slope), slope_errors(slope) * error);
  Filter_result result = in_time({Kind::holds, {rising, rising}}, *window, after);
  result.may_vanish = true;
  return result;
}

template <std::size_t K>
Filter_result contact(Polynomial_differences<1, K>& d, double diameter,
                      const Double_interval& after) {
  return first_contact(d, Distance{diameter * diameter}, window_share, after);
}

Filter_result wall_contact(const Polynomial_motion_2& p, const Wall_2& wall,
                           const Double_interval& after) {
  if (is_linear(p)) return wall_contact(linear(p), wall, after);
  if (!(wall.clearance < greatest_size)) return {};
  Polynomial_differences<1> d({&p}, foot_at(p, wall), after.lower);
  return first_contact(d, Inside{wall}, window_share_of_walls, after);
}

}  // namespace

template <class Motion>
Filter_result filter_contact(const Motion& p, const Motion& q, double diameter,
                             const Double_interval& after) {
  if (!(diameter < greatest_size)) return {};
  return with_differences(std::array{&p}, q, after.lower,
                          [&](auto& d) { return contact(d, diameter, after); });
}

template <class Motion>
Filter_result filter_wall_contact(const Motion& p, const Wall_2& wall,
                                  const Double_interval& after) {
  return wall_contact(p, wall, after);
}

template <class Motion>
Sign certain_distance_slope(const Motion& p, const Motion& q, const Double_interval& interval) {
  return with_differences(std::array{&p}, q, interval.lower, [&](auto& d) {
    // The interval may be one time, at which the slope by w vanishes: hence not over the interval.
    const std::optional<double> window = d.window_ahead(window_share);
    if (!window) return CGAL::ZERO;
    d.scale(*window);
    const auto slope = slope_of(dot(d[0], d[0]));
    const double error = slope_errors(slope) * product_error(d);
    const auto is_positive = [&](const auto& c) {
      return positive_share(bernstein(c), error) * *window > 2 * (interval.upper - interval.lower);
    };
    if (is_positive(slope)) return CGAL::POSITIVE;
    return is_positive(negated(slope)) ? CGAL::NEGATIVE : CGAL::ZERO;
  });
}

template <class Motion>
Sign certain_gap(const Motion& p, const Motion& q, double diameter,
                 const Double_interval& interval) {
  return with_differences(std::array{&p}, q, interval.lower, [&](auto& d) {
    // Mostly they are far from one another.
    if constexpr (std::same_as<decltype(d), Linear_differences<1>&>) {
      if (are_apart(d, diameter, interval)) return CGAL::POSITIVE;
    }
    return sign_throughout(d, Distance{diameter * diameter}, interval);
  });
}

template <class Motion>
bool certainly_inside(const Motion& p, const Wall_2& wall, const Double_interval& interval) {
  const Motion foot = foot_at(p, wall);
  return with_differences(std::array{&p}, foot, interval.lower, [&](auto& d) {
    return sign_throughout(d, Inside{wall}, interval) == CGAL::POSITIVE;
  });
}

#define KINETRI_INSTANTIATE(M)                                                                 \
  template Filter_result filter_contact(const M&, const M&, double, const Double_interval&);   \
  template Filter_result filter_wall_contact(const M&, const Wall_2&, const Double_interval&); \
  template Sign certain_distance_slope(const M&, const M&, const Double_interval&);            \
  template Sign certain_gap(const M&, const M&, double, const Double_interval&);               \
  template bool certainly_inside(const M&, const Wall_2&, const Double_interval&)
KINETRI_INSTANTIATE(Linear_motion_2);
KINETRI_INSTANTIATE(Polynomial_motion_2);
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
