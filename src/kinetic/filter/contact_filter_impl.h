// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of filter.h: the certificates of contacts. The constants of the errors are derived in
// docs/MATH.md, sections 8 and 9.
#ifndef KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_IMPL_H
#define KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_IMPL_H

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

#include "bernstein.h"
#include "certificates.h"
#include "classify.h"
#include "differences.h"
#include "filter.h"
#include "reach.h"

namespace kinetri {
namespace {

using Kind = Filter_result::Kind;

// The squared distance of two points minus the squared contact distance.
struct Distance {
  auto operator()(const auto& d) const {
    const auto& reach = d.reach();
    auto c = dot(d[0], d[0]);
    c[0] -= reach.constant * reach.constant;
    if constexpr (is_changing<std::remove_cvref_t<decltype(reach)>>) {
      c[1] -= 2 * (reach.constant * reach.slope);
      c[2] -= reach.slope * reach.slope;
    }
    return c;
  }
  double error(const auto& d) const {
    return product_error(d) + d.product_units * unit_roundoff * (d.reach_size() * d.reach_size());
  }
  double norm(const auto& d) const {
    return 2 * (d.size() * d.size()) + d.reach_size() * d.reach_size();
  }
};

// The distance of a point from the bound of a wall, positive inside. Takes the difference of the
// point and its foot.
struct Inside {
  const Wall_2& wall;

  auto operator()(const auto& d) const {
    auto c = coordinate(d[0], wall.is_vertical() ? 0 : 1);
    if (wall.is_upper()) c = negated(c);
    const auto& reach = d.reach();
    c[0] -= reach.constant;
    if constexpr (is_changing<std::remove_cvref_t<decltype(reach)>>) c[1] -= reach.slope;
    return c;
  }
  double error(const auto& d) const {
    return coordinate_error(d) + d.coordinate_units * unit_roundoff * d.reach_size();
  }
};

// The foot of the perpendicular from p to the line of the wall.
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

template <class Motion, class Reach>
using Linear_contact = Differences_and_reach<Linear_differences<1, Motion>, Reach>;

// A bound for the reach throughout the interval, from the origin on, and for the terms of its
// constant. Precondition: the reach is not scaled.
inline Constant_reach greatest_reach(const Constant_reach& reach,
                                     const Double_interval& /*interval*/) {
  return reach;
}
inline Linear_function greatest_reach(const Linear_function& reach,
                                      const Double_interval& interval) {
  // The length of the interval is rounded.
  const double grown = 2 * std::abs(reach.slope) * (interval.upper - interval.lower);
  return {std::abs(reach.constant) + grown, 0, reach.terms + grown};
}

// Whether the discs are certainly apart throughout the interval, from the origin on. Precondition:
// the differences are not scaled.
template <class Motion, class Reach>
inline bool are_apart(const Linear_contact<Motion, Reach>& d, const Double_interval& interval) {
  const Reach reach = greatest_reach(d.reach(), interval);
  const double error =
      error_throughout(d, interval) + d.product_units * unit_roundoff * (size(reach) * size(reach));
  const Pair& place = d[0].place;
  return sum(place * place) - reach.constant * reach.constant > error;
}

// A number with an error bound.
struct Estimate {
  double value;
  double error;
};

// A bound for the rate of change of the distance minus the reach.
template <class Motion>
inline double speed(const Linear_contact<Motion, Constant_reach>& d) {
  return d.speed();
}
template <class Motion>
inline double speed(const Linear_contact<Motion, Linear_function>& d) {
  return d.speed() + std::abs(d.reach().slope);
}

// The error of the length of the slope. That of points is relative to the length, and less than
// what the caller allows for.
inline double slope_error(const Linear_differences<1, Linear_motion_2>& /*d*/) {
  return 0;
}
inline double slope_error(const Linear_differences<1, Image_motion_2>& d) {
  return 64 * unit_roundoff * d.slope_terms();
}

// Whether the quadratic of the contact is certainly convex.
template <class Motion>
inline bool is_convex(const Linear_contact<Motion, Constant_reach>& /*d*/) {
  return true;
}
template <class Motion>
inline bool is_convex(const Linear_contact<Motion, Linear_function>& d) {
  const double growth = d.reach().slope;
  return growth == 0 || sum(d[0].slope * d[0].slope) - 4 * (slope_error(d) * d.slope_terms()) >
                            (1 + 0x1p-40) * (growth * growth);
}

// Half the slope of the quadratic at the origin.
template <class Motion>
inline Estimate half_slope(const Linear_contact<Motion, Constant_reach>& d) {
  return {sum(d[0].place * d[0].slope), unscaled_error(d)};
}
template <class Motion>
inline Estimate half_slope(const Linear_contact<Motion, Linear_function>& d) {
  const auto& [reach, growth, terms] = d.reach();
  return {sum(d[0].place * d[0].slope) - reach * growth,
          unscaled_error(d) + 64 * unit_roundoff * (terms * std::abs(growth))};
}

// The discriminant is the difference of two squares. This is the root of the first one: for
// constant radii, the reach times the relative speed.
template <class Motion>
inline Estimate reach_across(const Linear_contact<Motion, Constant_reach>& d) {
  const double reach = d.reach().constant;
  return {reach * std::sqrt(sum(d[0].slope * d[0].slope)), reach * slope_error(d)};
}
template <class Motion>
inline Estimate reach_across(const Linear_contact<Motion, Linear_function>& d) {
  const auto& [reach, growth, terms] = d.reach();
  const Pair reaching = reach * d[0].slope - growth * d[0].place;
  return {std::sqrt(sum(reaching * reaching)),
          64 * unit_roundoff *
              (terms * (d.slope_terms() + std::abs(growth)) + d.terms() * std::abs(growth))};
}

// The distance of two points in linear motion is convex in time, also less a reach that is linear
// in time: the discs approach up to one time, and separate from then on. The squared distance minus
// the squared reach is a quadratic that changes from positive to negative at most once.
template <class Motion, class Reach>
inline Filter_result contact(Linear_contact<Motion, Reach>& d, const Double_interval& after) {
  const auto never = [&] {
    return Filter_result{Kind::never_fails, {}, false, !are_apart(d, after)};
  };
  if (speed(d) == 0) return never();
  if (!is_in_range(d.terms()) || !is_in_range(speed(d)) || !(size(d.reach()) < greatest_size)) {
    return {};
  }
  // The slope of a convex quadratic grows with time.
  const auto [slope, slope_error] = half_slope(d);
  if (is_convex(d) && slope > slope_error) return never();
  const Difference& ahead = d[0];
  const double cross = std::abs(ahead.place[0] * ahead.slope[1] - ahead.place[1] * ahead.slope[0]);
  const auto [across, across_error] = reach_across(d);
  if (is_convex(d) && cross - unscaled_error(d) > across * (1 + 0x1p-40) + across_error) {
    return never();
  }

  const double reach = d.reach().constant;
  const double gap = sum(ahead.place * ahead.place) - reach * reach;
  const double discriminant = (across - cross) * (across + cross);
  if (!(discriminant > 0) || !(gap > 0)) return {};
  // The window is twice the time to the root, which is computed without cancellation.
  const double window = 2 * gap / (std::sqrt(discriminant) - slope);
  if (!(window > 0)) return {};
  d.scale(window);
  if (!d.is_in_range()) return {};
  const Coefficients<2> c = Distance()(d);
  const double error = Distance().error(d);
  // A quadratic that is positive at the origin and at the lower end of the bracket, and negative at
  // the upper end, has one root up to there: in the bracket.
  double lower = 0;
  double upper = 1;
  if (!(c[0] > error) || !bracket_root(c, error, 0.5, lower, upper)) return {};
  return in_time({Kind::fails, {lower, upper}}, window, after);
}

// `radius`, which grows at the rate `growth`, is added to the clearance of the wall.
inline Filter_result wall_contact(const Linear_motion_2& p, double radius, double growth,
                                  const Wall_2& wall, const Double_interval& after) {
  const double place = wall.is_vertical() ? p.position.x : p.position.y;
  const double velocity = wall.is_vertical() ? p.velocity.x : p.velocity.y;
  const double speed = wall.is_upper() ? velocity + growth : velocity - growth;
  if (wall.is_upper() ? speed <= 0 : speed >= 0) return {Kind::never_fails};
  const double clearance = wall.clearance + radius;
  const double terms =
      std::abs(wall.position) + (wall.clearance + std::abs(radius)) + std::abs(place);
  if (!is_in_range(std::abs(speed)) || !is_in_range(terms)) return {};
  const double bound = wall.position + (wall.is_upper() ? -clearance : clearance);
  const double elapsed = (bound - place) / speed;
  const double time = p.epoch + elapsed;
  const double error = 16 * unit_roundoff * (terms / std::abs(speed) + std::abs(time)) +
                       std::numeric_limits<double>::min();
  const Double_interval bounds = {time - error, time + error};
  if (!(bounds.lower > after.upper) || !std::isfinite(bounds.upper)) return {};
  return {Kind::fails, bounds};
}

// ---- polynomial motion ----

// Walls are far away and at rest, so the time of the contact is searched for in a long window.
constexpr double window_share_of_walls = 4;

// The error of the slope of a polynomial, relative to that of its values.
template <std::size_t M>
constexpr double slope_errors(const std::array<double, M>& /*slope*/) {
  return static_cast<double>(M + 1);
}

// The first time at which a distance is not positive and decreases.
template <class Differences, class Certificate>
Filter_result first_contact(Differences& d, const Certificate& distance, double share,
                            const Double_interval& after) {
  const std::optional<double> window = d.window_ahead(share);
  if (!window) return {Kind::never_fails, {}, false, true};
  d.scale(*window);
  if (!d.is_in_range()) return {};
  const auto c = distance(d);
  const double error = distance.error(d);
  if (c[0] > error) return in_time(classify(c, error), *window, after);
  // The discs may touch or overlap: there is no contact while the distance grows.
  const auto slope = slope_of(c);
  if (least(slope) > slope_errors(slope) * error) return {Kind::never_fails, {}, false, true};
  const double rising = positive_share(bernstein(slope), slope_errors(slope) * error);
  Filter_result result = in_time({Kind::holds, {rising, rising}}, *window, after);
  result.may_be_zero = true;
  return result;
}

template <std::size_t K, class Reach>
Filter_result contact(Differences_and_reach<Polynomial_differences<1, K>, Reach>& d,
                      const Double_interval& after) {
  return first_contact(d, Distance(), window_share, after);
}

// Calls `function` with the difference of two centers and their reach.
template <class Motion, class Function>
inline auto with_contact(const Motion& p, const Motion& q, double diameter, double origin,
                         const Function& function) {
  return with_reach_of(p, q, diameter, origin, [&](const auto& reach) {
    return with_differences(std::array{&center(p)}, center(q), origin, With_reach{reach}, function);
  });
}
// The same for a center and its foot on a wall.
template <class Motion, class Function>
inline auto with_wall(const Motion& p, const Wall_2& wall, double origin,
                      const Function& function) {
  return with_reach_of(p, wall, origin, [&](const auto& reach) {
    return with_differences(std::array{&center(p)}, foot_at(center(p), wall), origin,
                            With_reach{reach}, function);
  });
}

}  // namespace

template <class Motion>
Filter_result filter_contact(const Motion& p, const Motion& q, double diameter,
                             const Double_interval& after) {
  return with_contact(p, q, diameter, after.lower, [&](auto& d) { return contact(d, after); });
}

template <class Motion>
Filter_result filter_wall_contact(const Motion& p, const Wall_2& wall,
                                  const Double_interval& after) {
  if constexpr (std::same_as<Center_motion_of<Motion>, Polynomial_motion_2>) {
    if (!is_linear(center(p))) {
      return with_wall(p, wall, after.lower, [&](auto& d) {
        return first_contact(d, Inside{wall}, window_share_of_walls, after);
      });
    }
  }
  double radius = 0;
  double growth = 0;
  if constexpr (HasWeight<Motion>) {
    if (wall.rim_touches) {
      radius = p.radius;
      growth = p.growth;
    }
  }
  return wall_contact(linear(center(p)), radius, growth, wall, after);
}

template <class Motion>
Sign certain_distance_slope(const Motion& p, const Motion& q, const Double_interval& interval) {
  return with_contact(p, q, 0, interval.lower, [&](auto& d) {
    // Not over the interval, which may be a single time: the slope in w would be zero.
    const std::optional<double> window = d.window_ahead(window_share);
    if (!window) return CGAL::ZERO;
    d.scale(*window);
    if (!d.is_in_range()) return CGAL::ZERO;
    const auto slope = slope_of(Distance()(d));
    const double error = slope_errors(slope) * Distance().error(d);
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
  return with_contact(p, q, diameter, interval.lower, [&](auto& d) {
    // Usually they are far apart.
    if constexpr (requires { are_apart(d, interval); }) {
      if (are_apart(d, interval)) return CGAL::POSITIVE;
    }
    return sign_throughout(d, Distance(), interval);
  });
}

template <class Motion>
bool certainly_inside(const Motion& p, const Wall_2& wall, const Double_interval& interval) {
  return with_wall(p, wall, interval.lower, [&](auto& d) {
    return sign_throughout(d, Inside{wall}, interval) == CGAL::POSITIVE;
  });
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_CONTACT_FILTER_IMPL_H
