// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/basic_kinetic_traits_2.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "certificate_formulas.h"
#include "exact_certificates.h"
#include "failure_roots.h"
#include "filter/disc_filter.h"
#include "filter/filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "polynomial_on_stack.h"

namespace kinetri {
namespace {

using Time = Algebraic_number;

// Converts a result of the filter. Precondition: the result is not unknown.
Certificate certificate(const Filter_result& result) {
  using Kind = Certificate::Kind;
  const auto means =
      result.is_refined ? Certificate::Means::refined_filter : Certificate::Means::filter;
  switch (result.kind) {
    case Filter_result::Kind::fails:
      return {Kind::fails, result.bounds, nullptr, result.may_be_zero, means, true};
    case Filter_result::Kind::holds:
      return {Kind::holds, result.bounds, nullptr, result.may_be_zero, means};
    default:
      return {Kind::never_fails, {}, nullptr, result.may_be_zero, means};
  }
}

// A certificate that is certainly violated just after t, for example after an insertion.
Certificate failure_at_once(const Time& t) {
  return {Certificate::Kind::fails, t.interval(), std::make_unique<Time>(t), true,
          Certificate::Means::refined_filter};
}

// The same for a result that may be unknown.
Certificate certificate_or_unknown(const Filter_result& result) {
  if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  return {Certificate::Kind::unknown};
}

template <class Motion, std::size_t N>
std::array<const Motion*, N> motions(
    const std::array<const Basic_moving_point_2<Motion>*, N>& points) {
  std::array<const Motion*, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = &points[i]->motion();
  return result;
}

// The certificate p >= 0 from t on, by general algebraic numbers. Just after a failure of -p, p is
// zero at t; if the filter is given this, by filter(true), it may decide.
template <class Filter>
Certificate exact_or_filtered(const Polynomial& p, const Time& t, Arithmetic arithmetic,
                              const Filter& filter) {
  if (arithmetic == Arithmetic::exact_only) return exact_certificate(p, t);
  // In primitive form it is recognized if it is the polynomial that defines t.
  const Polynomial primitive = primitive_part(p);
  if (sign_at(primitive, t) == CGAL::ZERO) {
    const Filter_result result = filter(true);
    if (result.kind != Filter_result::Kind::unknown) {
      Certificate known = certificate(result);
      known.means = Certificate::Means::exact;
      return known;
    }
  }
  return exact_certificate(primitive, t);
}

constexpr auto outside_circle = [](const auto&... all) { return -in_circle_of(all...); };
constexpr auto left_turn = [](const auto&... all) { return orientation_of(all...); };
constexpr auto gap = [](const auto&... all) { return contact_of(all...); };
constexpr auto nearness = [](const auto&... all) { return -contact_of(all...); };
constexpr auto gap_growth = [](const auto&... all) { return derivative(contact_of(all...)); };
constexpr auto comparison = [](const auto&... all) { return distance_comparison_of(all...); };
constexpr auto below_segment = perturbed([](const auto&... all) { return segment_of(all...); });
constexpr auto above_segment = perturbed([](const auto&... all) { return -segment_of(all...); });
constexpr auto weight_order = [](const auto&... all) { return weight_difference_of(all...); };
auto inside_of(const Wall_2& wall) {
  return [&wall](const auto&... all) { return wall_of(wall, all...); };
}

// The certificate by Sturm counts of the polynomial on the stack, by one of the functions
// counted_...; if there is none or they do not decide, general().
template <class Certify, class General>
Certificate exactly(const std::optional<Narrow_polynomial>& p, const Certify& certify,
                    const General& general) {
  if (p) {
    if (std::optional<Certificate> counted = certify(*p)) return std::move(*counted);
  }
  return general();
}

// The sign of a formula at an instant. general() makes its polynomial on the heap.
template <class General, class Formula, class... Given>
Sign exact_sign(const Instant& instant, const General& general, const Formula& formula,
                const Given&... given) {
  const std::optional<Sign> on_stack = sign_on_stack(instant, formula, given...);
  return on_stack ? *on_stack : sign_at(general(), instant);
}

// The polynomial of a formula of the centers of two discs and of their distance when their gap is
// `diameter`.
template <class Formula, class Motion>
std::optional<Narrow_polynomial> polynomial_of_contact(const Formula& formula, const Motion& p,
                                                       const Motion& q, double diameter) {
  return polynomial_on_stack(formula, center(p), center(q), touching_distance(p, q, diameter));
}

template <class Point>
Polynomial weight_difference_or_zero(const Point& p, const Point& q) {
  if constexpr (HasWeight<typename Point::Motion>) return weight_difference(p, q);
  return {};
}

// The sign of contact_polynomial.
template <class Point>
Sign sign_of_gap(const Point& p, const Point& q, double diameter, const Instant& instant) {
  return exact_sign(
      instant, [&] { return contact_polynomial(p, q, diameter); }, gap, center(p.motion()),
      center(q.motion()), touching_distance(p.motion(), q.motion(), diameter));
}

// The sign of the derivative of contact_polynomial(p, q, 0).
template <class Point>
Sign sign_of_gap_growth(const Point& p, const Point& q, const Instant& instant) {
  return exact_sign(
      instant, [&] { return derivative(contact_polynomial(p, q, 0)); }, gap_growth,
      center(p.motion()), center(q.motion()), touching_distance(p.motion(), q.motion(), 0));
}

// Whether Sturm counts prove that the positions differ at all times after t.
template <class Motion>
bool never_meet(const Motion& p, const Motion& q, const Time& t) {
  const auto distance = polynomial_of_contact(gap, center(p), center(q), 0);
  return distance && !distance->is_zero() &&
         count_failure(*distance, t.interval(), false).kind == Counted_failure::Kind::never_fails;
}

}  // namespace

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::in_circle_certificate(const Point_2& p,
                                                                  const Point_2& q,
                                                                  const Point_2& r,
                                                                  const Point_2& s, const Time& t,
                                                                  Certificate_state state) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result =
        filter_in_circle(p.motion(), q.motion(), r.motion(), s.motion(), t.interval(),
                         state == Certificate_state::vanishes);
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
    if (certain_in_circle(p.motion(), q.motion(), r.motion(), s.motion(), t.interval()) ==
        CGAL::POSITIVE) {
      return failure_at_once(t);
    }
  }
  const auto on_stack = [&](const auto& formula) {
    return polynomial_on_stack(formula, p.motion(), q.motion(), r.motion(), s.motion());
  };
  const auto general = [&] {
    const Polynomial polynomial = -perturbed_in_circle_polynomial(p, q, r, s);
    if constexpr (HasWeight<Motion>) {
      // A touch of discs that grow alike is no event, as `Decisions` expects.
      const auto has_weight_of_p = [&](const Point_2& other) {
        return weight_difference(p, other).is_zero();
      };
      if (!has_weight_of_p(q) || !has_weight_of_p(r) || !has_weight_of_p(s)) {
        return exact_touch_certificate(polynomial, t);
      }
    }
    return exact_certificate(polynomial, t);
  };
  const auto counted = [&](Certificate_state known) {
    return
        [&t, known](const auto& polynomial) { return counted_certificate(polynomial, t, known); };
  };
  const auto in_circle = on_stack(lifted_by(Lifting::paraboloid, outside_circle));
  if (!in_circle || !in_circle->is_zero()) return exactly(in_circle, counted(state), general);
  // Not `state`: within an instant such an edge may also be flipped because it was not Delaunay at
  // that time, between points cocircular then. So the perturbed polynomial need not be zero.
  return exactly(on_stack(perturbed(outside_circle)), counted(Certificate_state::any), general);
}

// The filter's certificate of an orientation from t on, if it decides.
template <class Motion>
std::optional<Certificate> Basic_kinetic_traits_2<Motion>::filtered_orientation(
    const Point_2& p, const Point_2& q, const Point_2& r, const Time& t,
    Certificate_state state) const {
  if (arithmetic_ != Arithmetic::filtered) return std::nullopt;
  const Filter_result result = filter_orientation(p.motion(), q.motion(), r.motion(), t.interval(),
                                                  state == Certificate_state::vanishes);
  if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  if (certain_orientation(p.motion(), q.motion(), r.motion(), t.interval()) == CGAL::NEGATIVE) {
    return failure_at_once(t);
  }
  return std::nullopt;
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::orientation_certificate(const Point_2& p,
                                                                    const Point_2& q,
                                                                    const Point_2& r, const Time& t,
                                                                    Certificate_state state) const {
  if (auto known = filtered_orientation(p, q, r, t, state)) return std::move(*known);
  return exactly(
      polynomial_on_stack(left_turn, p.motion(), q.motion(), r.motion()),
      [&](const auto& polynomial) { return counted_certificate(polynomial, t, state); },
      [&] { return exact_certificate(orientation_polynomial(p, q, r), t); });
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::flatness_certificate(const Point_2& p, const Point_2& q,
                                                                 const Point_2& r, const Time& t,
                                                                 Certificate_state state) const {
  if (auto known = filtered_orientation(p, q, r, t, state)) return std::move(*known);
  return exactly(
      polynomial_on_stack(left_turn, p.motion(), q.motion(), r.motion()),
      [&](const auto& polynomial) { return counted_certificate(polynomial, t, state); },
      [&] { return exact_touch_certificate(orientation_polynomial(p, q, r), t); });
}

template <class Motion>
std::array<Certificate, 2> Basic_kinetic_traits_2<Motion>::in_circle_certificates(
    const std::array<Quadruple<Point_2>, 2>& certificates, const Time& t) const {
  std::array<Filter_result, 2> results;
  if (arithmetic_ == Arithmetic::filtered) {
    results = filter_in_circles(std::array{motions(certificates[0]), motions(certificates[1])},
                                t.interval());
  }
  return {certificate_or_unknown(results[0]), certificate_or_unknown(results[1])};
}

template <class Motion>
std::array<Certificate, 5> Basic_kinetic_traits_2<Motion>::certificates_after_flip(
    const Flip_neighborhood<Point_2>& around, const Double_interval& now) const {
  std::array<Filter_result, 5> results;
  if (arithmetic_ == Arithmetic::filtered) {
    results = filter_after_flip(
        Flip_neighborhood<Motion>{motions(around.corners), motions(around.beyond)}, now);
  }
  return {certificate_or_unknown(results[0]), certificate_or_unknown(results[1]),
          certificate_or_unknown(results[2]), certificate_or_unknown(results[3]),
          certificate_or_unknown(results[4])};
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::is_surrounded(const Point_2& p,
                                                   std::span<const Point_2* const> around,
                                                   const Double_interval& now) const {
  if constexpr (is_linear<Motion>) {
    using Center = Center_motion_of<Motion>;
    std::array<const Center*, most_around> others;
    if (arithmetic_ != Arithmetic::filtered || around.size() > others.size()) return false;
    std::ranges::transform(around, others.begin(),
                           [](const Point_2* q) { return &center(q->motion()); });
    return certainly_surrounded<Center>(center(p.motion()), std::span(others).first(around.size()),
                                        now);
  }
  return false;
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::in_circle_failure(const Point_2& p, const Point_2& q,
                                                       const Point_2& r, const Point_2& s,
                                                       const Double_interval& bounds) const {
  return Time(std::make_shared<In_circle_root<Motion>>(p, q, r, s), bounds);
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::orientation_failure(const Point_2& p, const Point_2& q,
                                                         const Point_2& r,
                                                         const Double_interval& bounds) const {
  return Time(std::make_shared<Orientation_root<Motion>>(p, q, r), bounds);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::coincidence_certificate(
    const Point_2& p, const Point_2& q, const Time& t, const Double_interval& among) const {
  if (arithmetic_ == Arithmetic::filtered && certainly_apart(p.motion(), q.motion(), among)) {
    return {Certificate::Kind::never_fails, {}, nullptr, false, Certificate::Means::filter};
  }
  if (never_meet(p.motion(), q.motion(), t)) {
    return {Certificate::Kind::never_fails, {}, nullptr, false, Certificate::Means::exact};
  }
  std::optional<Time> time =
      coincidence_time(x_difference(p, q), y_difference(p, q), weight_difference_or_zero(p, q), t);
  if (!time) return {Certificate::Kind::never_fails, {}, nullptr, false, Certificate::Means::exact};
  const Double_interval bounds = time->interval();
  return {Certificate::Kind::fails, bounds, std::make_unique<Time>(std::move(*time)), false,
          Certificate::Means::exact};
}

// ---- weights ----

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::segment_certificate(
    const Point_2& p, const Point_2& q, const Point_2& r,
    const Time& t) const requires HasWeight<Motion> {
  return exactly(
      polynomial_on_stack(below_segment, p.motion(), q.motion(), r.motion()),
      [&](const auto& polynomial) { return counted_certificate_with_time(polynomial, t); },
      [&] { return exact_certificate(perturbed_segment_polynomial(p, q, r), t); });
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::hiding_certificate(
    const Point_2& p, const Point_2& q, const Point_2& r,
    const Time& t) const requires HasWeight<Motion> {
  return exactly(
      polynomial_on_stack(above_segment, p.motion(), q.motion(), r.motion()),
      [&](const auto& polynomial) { return counted_certificate_with_time(polynomial, t); },
      [&] { return exact_certificate(-perturbed_segment_polynomial(p, q, r), t); });
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::meeting_certificate(
    const Point_2& p, const Point_2& q, const Time& t,
    const Double_interval& among) const requires HasWeight<Motion> {
  if (arithmetic_ == Arithmetic::filtered &&
      certainly_apart(center(p.motion()), center(q.motion()), among)) {
    return {Certificate::Kind::never_fails, {}, nullptr, false, Certificate::Means::filter};
  }
  if (never_meet(p.motion(), q.motion(), t)) return exact_certificate(std::nullopt, true);
  return exact_certificate(
      coincidence_time(x_difference(p, q), y_difference(p, q), Polynomial(), t), true);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::weight_certificate(
    const Point_2& p, const Point_2& q, const Time& t) const requires HasWeight<Motion> {
  return exactly(
      polynomial_on_stack(weight_order, p.motion(), q.motion()),
      [&](const auto& polynomial) { return counted_certificate_with_time(polynomial, t); },
      [&] { return exact_certificate(weight_difference(p, q), t); });
}

template <class Motion>
Sign Basic_kinetic_traits_2<Motion>::certain_turn(
    const Point_2& p, const Point_2& q, const Point_2& r,
    const Double_interval& now) const requires HasWeight<Motion> {
  if (arithmetic_ != Arithmetic::filtered) return CGAL::ZERO;
  return certain_orientation(center(p.motion()), center(q.motion()), center(r.motion()), now);
}

// ---- contacts ----

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::contact_certificate(const Point_2& p, const Point_2& q,
                                                                double diameter,
                                                                const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter_contact(p.motion(), q.motion(), diameter, t.interval());
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  }
  return exactly(
      polynomial_of_contact(gap, p.motion(), q.motion(), diameter),
      [&](const auto& polynomial) { return counted_contact_certificate(polynomial, t); },
      [&] { return exact_contact_certificate(contact_polynomial(p, q, diameter), t); });
}

// On straight lines discs that separate never meet again: their distance is convex in time, also
// less the sum of radii that grow at constant rates.
template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::next_contact_certificate(const Point_2& p,
                                                                     const Point_2& q,
                                                                     double diameter,
                                                                     const Time& t) const {
  if constexpr (is_linear<Motion>) {
    return {};
  } else {
    const std::optional<Time> parting = failure_time(-contact_polynomial(p, q, diameter), t);
    if (!parting) return {};
    return contact_certificate(p, q, diameter, *parting);
  }
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::wall_certificate(const Point_2& p, const Wall_2& wall,
                                                             const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter_wall_contact(p.motion(), wall, t.interval());
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  }
  return exactly(
      polynomial_on_stack(inside_of(wall), center(p.motion()), bound_of(wall, p.motion())),
      [&](const auto& polynomial) { return counted_contact_certificate(polynomial, t); },
      [&] { return exact_contact_certificate(wall_polynomial(p, wall), t); });
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::contact_failure(const Point_2& p, const Point_2& q,
                                                     double diameter,
                                                     const Double_interval& bounds) const {
  return Time(std::make_shared<Contact_root<Motion>>(p, q, diameter), bounds);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::apart_certificate(const Point_2& p, const Point_2& q,
                                                              double range, const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter_apart(p.motion(), q.motion(), range, t.interval(), false);
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
    if (certain_gap(p.motion(), q.motion(), range, t.interval()) == CGAL::NEGATIVE) {
      return failure_at_once(t);
    }
  }
  return exactly(
      polynomial_of_contact(gap, p.motion(), q.motion(), range),
      [&](const auto& polynomial) { return counted_apart_certificate(polynomial, t); },
      [&] { return exact_apart_certificate(contact_polynomial(p, q, range), t); });
}

// The next touch, of any duration, after a root at `t`. On straight lines there is none, as after a
// contact.
template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::next_apart_certificate(const Point_2& p,
                                                                   const Point_2& q, double range,
                                                                   const Time& t) const {
  if constexpr (is_linear<Motion>) {
    return {};
  } else {
    if (arithmetic_ == Arithmetic::filtered) {
      const Filter_result result = filter_apart(p.motion(), q.motion(), range, t.interval(), true);
      if (result.kind != Filter_result::Kind::unknown) return certificate(result);
    }
    return exact_root_certificate(contact_polynomial(p, q, range), t);
  }
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::near_certificate(const Point_2& p, const Point_2& q,
                                                             double range, const Time& t) const {
  const auto filter = [&](bool vanishes_at) {
    return filter_near(p.motion(), q.motion(), range, t.interval(), vanishes_at);
  };
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter(false);
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
    if (certain_gap(p.motion(), q.motion(), range, t.interval()) == CGAL::POSITIVE) {
      return failure_at_once(t);
    }
  }
  return exactly(
      polynomial_of_contact(nearness, p.motion(), q.motion(), range),
      [&](const auto& polynomial) {
        return counted_certificate(polynomial, t, Certificate_state::any);
      },
      [&] { return exact_or_filtered(-contact_polynomial(p, q, range), t, arithmetic_, filter); });
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::closer_certificate(const Point_2& p, const Point_2& q,
                                                               const Point_2& r, const Point_2& s,
                                                               const Time& t) const {
  const auto filter = [&](bool vanishes_at) {
    return filter_closer(p.motion(), q.motion(), r.motion(), s.motion(), t.interval(), vanishes_at);
  };
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_result result = filter(false);
    if (result.kind != Filter_result::Kind::unknown) return certificate(result);
    if (certain_distance_comparison(p.motion(), q.motion(), r.motion(), s.motion(), t.interval()) ==
        CGAL::NEGATIVE) {
      return failure_at_once(t);
    }
  }
  return exactly(
      polynomial_on_stack(comparison, center(p.motion()), center(q.motion()), center(r.motion()),
                          center(s.motion())),
      [&](const auto& polynomial) {
        return counted_certificate(polynomial, t, Certificate_state::any);
      },
      [&] {
        return exact_or_filtered(distance_comparison_polynomial(p, q, r, s), t, arithmetic_,
                                 filter);
      });
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::closer_failure(const Point_2& p, const Point_2& q,
                                                    const Point_2& r, const Point_2& s,
                                                    const Double_interval& bounds) const {
  return Time(std::make_shared<Distance_root<Motion>>(p, q, r, s), bounds);
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::wall_failure(const Point_2& p, const Wall_2& wall,
                                                  const Double_interval& bounds) const {
  if constexpr (is_linear<Motion>) {
    const auto& [position, velocity, epoch] = center(p.motion());
    Rational clearance = to_rational(wall.clearance);
    Rational growth = 0;
    if constexpr (HasWeight<Motion>) {
      if (wall.rim_touches) {
        clearance += to_rational(p.motion().radius);
        growth = to_rational(p.motion().growth);
      }
    }
    const Rational bound = to_rational(wall.position) + (wall.is_upper() ? -clearance : clearance);
    const Rational place = to_rational(wall.is_vertical() ? position.x : position.y);
    const Rational speed = to_rational(wall.is_vertical() ? velocity.x : velocity.y) +
                           (wall.is_upper() ? growth : -growth);
    return Time(Rational(to_rational(epoch) + (bound - place) / speed));
  } else {
    return Time(std::make_shared<Wall_root<Motion>>(p, wall), bounds);
  }
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::do_approach(const Point_2& p, const Point_2& q,
                                                 const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Sign certain = certain_distance_slope(p.motion(), q.motion(), t.interval());
    if (certain != CGAL::ZERO) return certain == CGAL::NEGATIVE;
  }
  return sign_of_gap_growth(p, q, {t, Time_side::after}) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::has_approach_speed(const Point_2& p, const Point_2& q,
                                                        const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Sign certain = certain_distance_slope(p.motion(), q.motion(), t.interval());
    if (certain != CGAL::ZERO) return certain == CGAL::NEGATIVE;
  }
  return sign_of_gap_growth(p, q, {t, Time_side::at}) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::has_approach_speed(const Point_2& p, const Wall_2& wall,
                                                        const Time& t) const {
  if constexpr (is_linear<Motion>) {
    const Vector_2& velocity = p.motion().velocity;
    const double speed = wall.is_vertical() ? velocity.x : velocity.y;
    double growth = 0;
    if constexpr (HasWeight<Motion>) {
      if (wall.rim_touches) growth = p.motion().growth;
    }
    return wall.is_upper() ? speed > -growth : speed < growth;
  }
  return sign_at(derivative(wall_polynomial(p, wall)), t) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::do_touch(const Point_2& p, const Point_2& q, double diameter,
                                              const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Sign certain = certain_gap(p.motion(), q.motion(), diameter, t.interval());
    if (certain != CGAL::ZERO) return certain == CGAL::NEGATIVE;
  }
  return sign_of_gap(p, q, diameter, {t, Time_side::at}) != CGAL::POSITIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::may_overlap(const Point_2& p, const Point_2& q,
                                                 double diameter, const Time& t) const {
  return arithmetic_ == Arithmetic::filtered
             ? certain_gap(p.motion(), q.motion(), diameter, t.interval()) != CGAL::POSITIVE
             : sign_of_gap(p, q, diameter, {t, Time_side::after}) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::is_inside(const Point_2& p, const Wall_2& wall,
                                               const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered && certainly_inside(p.motion(), wall, t.interval())) {
    return true;
  }
  return exact_sign(
             {t, Time_side::at}, [&] { return wall_polynomial(p, wall); }, inside_of(wall),
             center(p.motion()), bound_of(wall, p.motion())) != CGAL::NEGATIVE;
}

template class Basic_kinetic_traits_2<Linear_motion_2>;
template class Basic_kinetic_traits_2<Polynomial_motion_2>;
template class Basic_kinetic_traits_2<Disc_motion_2>;
template class Basic_kinetic_traits_2<Polynomial_disc_motion_2>;

// Of images, the certificates of triangulations. clang 14 takes no alias here.
#define KINETRI_OF_IMAGES(Motion, Image)                                                       \
  template Certificate Basic_kinetic_traits_2<Motion>::in_circle_certificate(                  \
      const Image&, const Image&, const Image&, const Image&, const Time&, Certificate_state)  \
      const;                                                                                   \
  template Certificate Basic_kinetic_traits_2<Motion>::orientation_certificate(                \
      const Image&, const Image&, const Image&, const Time&, Certificate_state) const;         \
  template Certificate Basic_kinetic_traits_2<Motion>::flatness_certificate(                   \
      const Image&, const Image&, const Image&, const Time&, Certificate_state) const;         \
  template Certificate Basic_kinetic_traits_2<Motion>::coincidence_certificate(                \
      const Image&, const Image&, const Time&, const Double_interval&) const;                  \
  template Time Basic_kinetic_traits_2<Motion>::in_circle_failure(                             \
      const Image&, const Image&, const Image&, const Image&, const Double_interval&) const;   \
  template Time Basic_kinetic_traits_2<Motion>::orientation_failure(                           \
      const Image&, const Image&, const Image&, const Double_interval&) const;                 \
  template std::array<Certificate, 2> Basic_kinetic_traits_2<Motion>::in_circle_certificates(  \
      const std::array<Quadruple<Image>, 2>&, const Time&) const;                              \
  template std::array<Certificate, 5> Basic_kinetic_traits_2<Motion>::certificates_after_flip( \
      const Flip_neighborhood<Image>&, const Double_interval&) const;                          \
  template bool Basic_kinetic_traits_2<Motion>::is_surrounded(                                 \
      const Image&, std::span<const Image* const>, const Double_interval&) const
KINETRI_OF_IMAGES(Image_motion_2, Moving_image_2);
KINETRI_OF_IMAGES(Image_disc_motion_2, Moving_image_disc_2);
#undef KINETRI_OF_IMAGES
template Certificate Basic_kinetic_traits_2<Image_disc_motion_2>::segment_certificate(
    const Moving_image_disc_2&, const Moving_image_disc_2&, const Moving_image_disc_2&,
    const Time&) const;
template Certificate Basic_kinetic_traits_2<Image_disc_motion_2>::hiding_certificate(
    const Moving_image_disc_2&, const Moving_image_disc_2&, const Moving_image_disc_2&,
    const Time&) const;
template Certificate Basic_kinetic_traits_2<Image_disc_motion_2>::weight_certificate(
    const Moving_image_disc_2&, const Moving_image_disc_2&, const Time&) const;
template Certificate Basic_kinetic_traits_2<Image_disc_motion_2>::meeting_certificate(
    const Moving_image_disc_2&, const Moving_image_disc_2&, const Time&,
    const Double_interval&) const;
template Sign Basic_kinetic_traits_2<Image_disc_motion_2>::certain_turn(
    const Moving_image_disc_2&, const Moving_image_disc_2&, const Moving_image_disc_2&,
    const Double_interval&) const;
// The certificates of distances.
#define KINETRI_DISTANCES_OF_IMAGES(Motion, Image)                                \
  template Certificate Basic_kinetic_traits_2<Motion>::apart_certificate(         \
      const Image&, const Image&, double, const Time&) const;                     \
  template Certificate Basic_kinetic_traits_2<Motion>::next_apart_certificate(    \
      const Image&, const Image&, double, const Time&) const;                     \
  template Certificate Basic_kinetic_traits_2<Motion>::near_certificate(          \
      const Image&, const Image&, double, const Time&) const;                     \
  template Certificate Basic_kinetic_traits_2<Motion>::closer_certificate(        \
      const Image&, const Image&, const Image&, const Image&, const Time&) const; \
  template Time Basic_kinetic_traits_2<Motion>::closer_failure(                   \
      const Image&, const Image&, const Image&, const Image&, const Double_interval&) const
KINETRI_DISTANCES_OF_IMAGES(Image_motion_2, Moving_image_2);
KINETRI_DISTANCES_OF_IMAGES(Image_disc_motion_2, Moving_image_disc_2);
#undef KINETRI_DISTANCES_OF_IMAGES
// The certificates of contacts.
#define KINETRI_CONTACTS_OF_IMAGES(Motion, Image)                                               \
  template Certificate Basic_kinetic_traits_2<Motion>::contact_certificate(                     \
      const Image&, const Image&, double, const Time&) const;                                   \
  template Certificate Basic_kinetic_traits_2<Motion>::next_contact_certificate(                \
      const Image&, const Image&, double, const Time&) const;                                   \
  template Time Basic_kinetic_traits_2<Motion>::contact_failure(                                \
      const Image&, const Image&, double, const Double_interval&) const;                        \
  template bool Basic_kinetic_traits_2<Motion>::do_approach(const Image&, const Image&,         \
                                                            const Time&) const;                 \
  template bool Basic_kinetic_traits_2<Motion>::has_approach_speed(const Image&, const Image&,  \
                                                                   const Time&) const;          \
  template bool Basic_kinetic_traits_2<Motion>::do_touch(const Image&, const Image&, double,    \
                                                         const Time&) const;                    \
  template bool Basic_kinetic_traits_2<Motion>::may_overlap(const Image&, const Image&, double, \
                                                            const Time&) const
KINETRI_CONTACTS_OF_IMAGES(Image_motion_2, Moving_image_2);
KINETRI_CONTACTS_OF_IMAGES(Image_disc_motion_2, Moving_image_disc_2);
#undef KINETRI_CONTACTS_OF_IMAGES

}  // namespace kinetri
