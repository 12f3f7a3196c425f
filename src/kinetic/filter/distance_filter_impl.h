// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of filter.h: the certificates of distances. The constants of the errors are derived
// in docs/MATH.md, section 8.
#ifndef KINETRI_SRC_KINETIC_FILTER_DISTANCE_FILTER_IMPL_H
#define KINETRI_SRC_KINETIC_FILTER_DISTANCE_FILTER_IMPL_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "contact_filter_impl.h"

namespace kinetri {
namespace {

// The squared reach minus the squared distance of two points.
struct Nearness {
  auto operator()(const auto& d) const { return negated(Distance()(d)); }
  double error(const auto& d) const { return Distance().error(d); }
  double norm(const auto& d) const { return Distance().norm(d); }
};

// The difference of two points within their reach.
template <class Differences>
struct Difference_within_reach : Differences {
  std::optional<double> window_ahead(double share) const {
    return Differences::window_within_reach(share);
  }
};

// The differences of two pairs of points, over one window.
template <class Differences>
struct Two_differences {
  Differences first;
  Differences second;
  bool have_equal_speeds = false;  // the exact relative velocities have the same length

  // Precondition: the first length is greater than the second.
  std::optional<double> window_ahead(double share) const {
    const double extent = greatest(absolute(place(first[0])));
    return shorter(first.window_ahead(share), second.window_ahead(share, extent));
  }
  void scale(double window) {
    first.scale(window);
    second.scale(window);
  }
};

// The squared length of the first difference minus that of the second.
struct Distance_comparison {
  auto operator()(const auto& d) const {
    auto c = dot(d.first[0], d.first[0]) - dot(d.second[0], d.second[0]);
    if (d.have_equal_speeds) c[2] = 0;
    return c;
  }
  double error(const auto& d) const { return product_error(d.first) + product_error(d.second); }
  double norm(const auto& d) const {
    return 2 * (d.first.size() * d.first.size() + d.second.size() * d.second.size());
  }
};

// Whether the relative velocities p - q and r - s certainly have the same length, exactly: for
// example, if both pairs share a point and the other two have equal velocities.
inline bool have_equal_speeds(const Linear_motion_2& p, const Linear_motion_2& q,
                              const Linear_motion_2& r, const Linear_motion_2& s) {
  return (p.velocity == r.velocity && q.velocity == s.velocity) ||
         (p.velocity == s.velocity && q.velocity == r.velocity);
}
// Of images, if as many lattice vectors are between the points of both pairs, or none moves.
inline bool have_equal_speeds(const Image_motion_2& p, const Image_motion_2& q,
                              const Image_motion_2& r, const Image_motion_2& s) {
  const Offset_difference first(p, q);
  const Offset_difference second(r, s);
  // Images with the offset zero may have no box.
  const bool is_box_at_rest =
      std::ranges::all_of(std::array{p.box, q.box, r.box, s.box}, [](auto box) {
        return box == nullptr || (is_at_rest(box->first()) && is_at_rest(box->second()));
      });
  const auto are_equal = [&](double sign) {
    return is_box_at_rest ||
           (first.first == sign * second.first && first.second == sign * second.second);
  };
  const auto& [a, b, c, d] =
      std::array{p.motion.velocity, q.motion.velocity, r.motion.velocity, s.motion.velocity};
  return (a == c && b == d && are_equal(1)) || (a == d && b == c && are_equal(-1));
}

// Calls `function` with the differences r - s and p - q.
template <LinearMotion Motion, class Function>
inline auto with_two_differences(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                                 double origin, const Function& function) {
  using Differences = Linear_differences<1, Motion>;
  Two_differences<Differences> d = {Differences({&r}, s, origin), Differences({&p}, q, origin),
                                    have_equal_speeds(p, q, r, s)};
  return function(d);
}
template <class Function>
inline auto with_two_differences(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                                 const Polynomial_motion_2& r, const Polynomial_motion_2& s,
                                 double origin, const Function& function) {
  const std::size_t k = degree(std::array{&p, &q, &r, &s});
  if (k == 1) {
    return with_two_differences(linear(p), linear(q), linear(r), linear(s), origin, function);
  }
  const auto with = [&]<class Differences>(std::type_identity<Differences>) {
    Two_differences<Differences> d = {Differences({&r}, s, origin), Differences({&p}, q, origin)};
    return function(d);
  };
  if (k == 2) return with(std::type_identity<Polynomial_differences<1, 2>>());
  return with(std::type_identity<Polynomial_differences<1, 3>>());
}

// Whether the differences are constant.
template <class Motion, class Reach>
inline bool are_constant(const Linear_contact<Motion, Reach>& d) {
  return speed(d) == 0;
}
template <class Motion>
inline bool are_constant(const Two_differences<Linear_differences<1, Motion>>& d) {
  return d.first.speed() == 0 && d.second.speed() == 0;
}

// Whether the certificate is linear in time, exactly.
template <class Motion, class Reach>
inline bool is_linear(const Linear_contact<Motion, Reach>& d) {
  return are_constant(d);
}
template <class Motion>
inline bool is_linear(const Two_differences<Linear_differences<1, Motion>>& d) {
  return d.have_equal_speeds;
}

// The approximate first root after 0 of a quadratic that is positive at 0, or zero and increasing
// there, without cancellation. Not positive, or not a number, if there is none.
inline double root_ahead(const Coefficients<2>& c) {
  const double half_slope = 0.5 * c[1];
  const double root = std::sqrt(half_slope * half_slope - c[0] * c[2]);
  return half_slope > 0 ? (half_slope + root) / -c[2] : c[0] / (root - half_slope);
}

// Whether a quadratic whose coefficients are known up to `error` is certainly positive from 0 on;
// if `vanishes_at`, from just after its root at some time >= 0 on.
inline bool is_positive_from_now_on(const Coefficients<2>& c, double error, bool is_linear,
                                    bool vanishes_at) {
  if (c[1] > error && (c[2] > error || is_linear)) return vanishes_at || c[0] > error;
  if (vanishes_at || !(c[0] > error && c[2] > error)) return false;
  // Its discriminant is negative.
  const double greatest_slope = std::abs(c[1]) + error;
  return greatest_slope * greatest_slope * (1 + 0x1p-40) < 4 * (c[0] - error) * (c[2] - error);
}

// As classify_ahead, for certificates of linear motions that are quadratic in time: one window
// covers all time. Scales the differences.
template <class Differences, class Certificate>
inline Filter_result classify_quadratic(Differences& d, const Certificate& certificate,
                                        const Double_interval& after, bool vanishes_at) {
  if (are_constant(d)) {
    d.scale(0);
    if (vanishes_at || !(certificate(d)[0] > certificate.error(d))) return {};
    return {Kind::never_fails};
  }
  const Coefficients<2> by_time = certificate(d);  // approximate; only chooses the window
  const double root = root_ahead(by_time);
  double window = 2 * root;
  if (!(root > 0)) {
    // The time scale at which the quadratic term matters.
    window = is_linear(d)  ? std::abs(by_time[0] / by_time[1])
             : vanishes_at ? std::abs(by_time[1] / by_time[2])
                           : std::sqrt(std::abs(by_time[0] / by_time[2]));
  }
  d.scale(window);
  const double error = certificate.error(d);
  if (!std::isfinite(error)) return {};
  const Coefficients<2> c = certificate(d);
  if (!(root > 0)) {
    if (!is_positive_from_now_on(c, error, is_linear(d), vanishes_at)) return {};
    return {Kind::never_fails};
  }
  // A quadratic that is positive or zero at the start, positive at the lower end of the bracket and
  // negative at the upper end, has no other root between.
  double lower = 0;
  double upper = 1;
  if (!vanishes_at && !(c[0] > error)) return {};
  if (!bracket_root(c, error, 0.5, lower, upper)) return {};
  return in_time({Kind::fails, {lower, upper}, true}, window, after);
}

// For linear and for polynomial motion.
template <class Motion, class Reach>
inline Filter_result near(Linear_contact<Motion, Reach>& d, const Double_interval& after,
                          bool vanishes_at) {
  return classify_quadratic(d, Nearness(), after, vanishes_at);
}
template <std::size_t K, class Reach>
inline Filter_result near(const Differences_and_reach<Polynomial_differences<1, K>, Reach>& d,
                          const Double_interval& after, bool vanishes_at) {
  Difference_within_reach<Differences_and_reach<Polynomial_differences<1, K>, Reach>> within = {d};
  return classify_ahead(within, Nearness(), after, vanishes_at);
}

template <class Motion>
inline Filter_result closer(Two_differences<Linear_differences<1, Motion>>& d,
                            const Double_interval& after, bool vanishes_at) {
  return classify_quadratic(d, Distance_comparison(), after, vanishes_at);
}
template <std::size_t K>
inline Filter_result closer(Two_differences<Polynomial_differences<1, K>>& d,
                            const Double_interval& after, bool vanishes_at) {
  return classify_ahead(d, Distance_comparison(), after, vanishes_at);
}

// Whether the two are certainly apart at the origin and separate from then on, as half of all pairs
// do.
template <class Motion, class Reach>
inline bool do_part(const Linear_contact<Motion, Reach>& d) {
  const double terms = d.terms();
  const double extent = size(d.reach());
  if (!is_in_range(terms) || !is_in_range(speed(d)) || !(extent < greatest_size)) return false;
  const auto [slope, slope_error] = half_slope(d);
  const double reach = d.reach().constant;
  const double gap = sum(d[0].place * d[0].place) - reach * reach;
  const double gap_error = d.product_units * unit_roundoff * (terms * terms + extent * extent);
  return is_convex(d) && slope > slope_error && gap > gap_error;
}

// The first contact is the first touch if the distance is certainly positive from the time on, or
// up to a root at which it certainly changes its sign. If `vanishes_at`, no caller needs a result:
// discs that separate never touch again.
template <class Motion, class Reach>
inline Filter_result apart(Linear_contact<Motion, Reach>& d, const Double_interval& after,
                           bool vanishes_at) {
  if (vanishes_at) return {};
  if (do_part(d)) return {Kind::never_fails};
  const Filter_result result = contact(d, after);
  if (result.kind == Kind::never_fails && result.may_be_zero) return {};
  return result;
}
template <std::size_t K, class Reach>
inline Filter_result apart(Differences_and_reach<Polynomial_differences<1, K>, Reach>& d,
                           const Double_interval& after, bool vanishes_at) {
  return classify_ahead(d, Distance(), after, vanishes_at);
}

}  // namespace

template <class Motion>
Filter_result filter_apart(const Motion& p, const Motion& q, double range,
                           const Double_interval& after, bool vanishes_at) {
  return with_contact(p, q, range, after.lower,
                      [&](auto& d) { return apart(d, after, vanishes_at); });
}

template <class Motion>
Filter_result filter_near(const Motion& p, const Motion& q, double range,
                          const Double_interval& after, bool vanishes_at) {
  return with_contact(p, q, range, after.lower,
                      [&](auto& d) { return near(d, after, vanishes_at); });
}

template <class Motion>
Filter_result filter_closer(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                            const Double_interval& after, bool vanishes_at) {
  return with_two_differences(center(p), center(q), center(r), center(s), after.lower,
                              [&](auto& d) { return closer(d, after, vanishes_at); });
}

template <class Motion>
Sign certain_distance_comparison(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                                 const Double_interval& interval) {
  return with_two_differences(
      center(p), center(q), center(r), center(s), interval.lower,
      [&](auto& d) { return sign_throughout(d, Distance_comparison(), interval); });
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DISTANCE_FILTER_IMPL_H
