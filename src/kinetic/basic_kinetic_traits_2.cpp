// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/basic_kinetic_traits_2.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "certificate_formulas.h"
#include "filter/disc_filter.h"
#include "filter/filter.h"
#include "filter/precise_filter.h"
#include "filter/weighted_differences.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "polynomial_on_stack.h"

namespace kinetri {
namespace {

using Time = Algebraic_number;

// The polynomials of failures that the filter has bracketed, made when an exact decision needs
// them.
template <class Motion>
struct In_circle_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  In_circle_root(const Point& a, const Point& b, const Point& c, const Point& d)
      : p(a.motion()), q(b.motion()), r(c.motion()), s(d.motion()) {}
  Polynomial polynomial() const override {
    return in_circle_polynomial(Point(p), Point(q), Point(r), Point(s));
  }
  double certain_value_at(double high, double low) const override {
    return precise_in_circle(p, q, r, s, high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion>) {
      if constexpr (HasWeight<Motion>) {
        if (!have_same_weight_numbers(std::array{&p, &q, &r, &s})) return std::nullopt;
      }
      return rounded_in_circle(p, q, r, s, bracket);
    } else {
      return std::nullopt;
    }
  }
  Motion p, q, r, s;
};

template <class Motion>
struct Orientation_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Orientation_root(const Point& a, const Point& b, const Point& c)
      : p(a.motion()), q(b.motion()), r(c.motion()) {}
  Polynomial polynomial() const override {
    return orientation_polynomial(Point(p), Point(q), Point(r));
  }
  double certain_value_at(double high, double low) const override {
    return precise_orientation(p, q, r, high, low);
  }
  Motion p, q, r;
};

template <class Motion>
struct Contact_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Contact_root(const Point& a, const Point& b, double d)
      : p(a.motion()), q(b.motion()), diameter(d) {}
  Polynomial polynomial() const override {
    return contact_polynomial(Point(p), Point(q), diameter);
  }
  double certain_value_at(double high, double low) const override {
    return precise_contact(p, q, diameter, high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion>) {
      return rounded_contact(p, q, diameter, bracket);
    } else {
      return std::nullopt;
    }
  }
  Motion p, q;
  double diameter;
};

template <class Motion>
struct Distance_root : Root_source {
  using Point = Basic_moving_point_2<Motion>;
  Distance_root(const Point& a, const Point& b, const Point& c, const Point& d)
      : p(a.motion()), q(b.motion()), r(c.motion()), s(d.motion()) {}
  Polynomial polynomial() const override {
    return distance_comparison_polynomial(Point(p), Point(q), Point(r), Point(s));
  }
  double certain_value_at(double high, double low) const override {
    return precise_distance_comparison(centre(p), centre(q), centre(r), centre(s), high, low);
  }
  std::optional<Rounding> rounded(const Double_interval& bracket) const override {
    if constexpr (is_linear<Motion>) {
      return rounded_distance_comparison(centre(p), centre(q), centre(r), centre(s), bracket);
    } else {
      return std::nullopt;
    }
  }
  Motion p, q, r, s;
};

template <class Motion>
struct Wall_root : Root_source {  // of polynomial motion; else the root is rational
  using Point = Basic_moving_point_2<Motion>;
  Wall_root(const Point& a, const Wall_2& w) : p(a.motion()), wall(w) {}
  Polynomial polynomial() const override { return wall_polynomial(Point(p), wall); }
  Motion p;
  Wall_2 wall;
};

// The certificate that a result of the filter is. Precondition: the result is not unknown.
Certificate certificate(const Filter_result& result) {
  using Kind = Certificate::Kind;
  const auto means =
      result.is_refined ? Certificate::Means::refined_filter : Certificate::Means::filter;
  switch (result.kind) {
    case Filter_result::Kind::fails:
      return {Kind::fails, result.bounds, nullptr, result.may_vanish, means, true};
    case Filter_result::Kind::holds:
      return {Kind::holds, result.bounds, nullptr, result.may_vanish, means};
    default:
      return {Kind::never_fails, {}, nullptr, result.may_vanish, means};
  }
}

// A certificate that is certainly violated just after t, as after the insertion of a point.
Certificate failure_at_once(const Time& t) {
  return {Certificate::Kind::fails, t.interval(), std::make_unique<Time>(t), true,
          Certificate::Means::refined_filter};
}

// The certificate of which a batch of the filter has said something, be it "unknown".
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

Certificate exact_certificate(std::optional<Time> failure, bool is_root_solved) {
  using Kind = Certificate::Kind;
  constexpr auto means = Certificate::Means::exact;
  constexpr bool may_vanish = true;
  if (!failure) return {Kind::never_fails, {}, nullptr, may_vanish, means, is_root_solved};
  // The filter starts from this time's interval when the event has been executed, and knows nothing
  // if that is wide.
  failure->refine_to_bits(std::numeric_limits<double>::digits);
  const Double_interval bounds = failure->interval();
  return {Kind::fails, bounds, std::make_unique<Time>(std::move(*failure)),
          may_vanish,  means,  is_root_solved};
}

Certificate exact_certificate(const Polynomial& certificate, const Time& t) {
  return exact_certificate(failure_time(certificate, t), certificate.degree() > 0);
}

// The certificate of points in linear motion that `formula` makes from their trajectories, by Sturm
// counts in numbers on the stack; none if that does not decide.
template <class Formula, class... Motion>
std::optional<Certificate> counted_certificate(const Time& t, Certificate_state state,
                                               const Formula& formula, const Motion&... motions) {
  if constexpr ((is_linear<Motion> && ...)) {
    const auto p = polynomial_on_stack(formula, motions...);
    if (!p) return std::nullopt;
    if (p->is_zero()) return exact_certificate(std::nullopt, false);
    constexpr auto means = Certificate::Means::exact;
    const bool is_root_solved = p->degree() > 0;
    const Counted_failure failure =
        count_failure(*p, t.interval(), state == Certificate_state::vanishes);
    switch (failure.kind) {
      case Counted_failure::Kind::fails:
        return Certificate{
            Certificate::Kind::fails, failure.bounds, nullptr, false, means, is_root_solved};
      case Counted_failure::Kind::never_fails:
        return Certificate{
            Certificate::Kind::never_fails, {}, nullptr, false, means, is_root_solved};
      case Counted_failure::Kind::at_once:
        return exact_certificate(t, is_root_solved);
      case Counted_failure::Kind::unknown:
        break;
    }
  }
  return std::nullopt;
}

// Where the filter knows nothing of what `certificate` says after t. Just after a failure of its
// negation it vanishes at t: then that is all that the filter has to be told, `filter` being what
// it says.
template <class Filter>
Certificate exact_certificate(const Polynomial& certificate, const Time& t, const Filter& filter) {
  // In primitive form it is recognized where it is the one that has made t.
  const Polynomial primitive = primitive_part(certificate);
  if (sign_at(primitive, t) == CGAL::ZERO) {
    const Filter_result result = filter();
    if (result.kind != Filter_result::Kind::unknown) {
      Certificate known = kinetri::certificate(result);
      known.means = Certificate::Means::exact;
      return known;
    }
  }
  return exact_certificate(primitive, t);
}

// The first time from t on at which the distance is not positive and falls.
std::optional<Time> contact_time(const Polynomial& distance, const Time& t) {
  if (sign_at(distance, t) == CGAL::POSITIVE) return failure_time(distance, t);
  const std::optional<Time> fall = failure_time(derivative(distance), t);
  if (!fall || sign_at(distance, *fall) != CGAL::POSITIVE) return fall;
  return failure_time(distance, *fall);
}

// The first time strictly after t at which both coordinates of a difference vanish, and `weight`,
// the difference of the weights.
std::optional<Time> coincidence_time(const Polynomial& x, const Polynomial& y,
                                     const Polynomial& weight, const Time& t) {
  if (x.degree() > 1 || y.degree() > 1 || (x.degree() < 1 && y.degree() < 1)) {
    const Polynomial common = gcd(gcd(x, y), weight);
    if (common.degree() < 1) return std::nullopt;
    std::optional<Real_root> root = first_root_after(common, t);
    return root ? std::optional(std::move(root->value)) : std::nullopt;
  }
  // Linear polynomials: a common root is a root of the one that is not constant, and of the others.
  const Polynomial& moving = x.degree() == 1 ? x : y;
  const Polynomial& other = x.degree() == 1 ? y : x;
  const Rational root(-moving[0], moving[1]);
  if (other.sign_at(root) != CGAL::ZERO || weight.sign_at(root) != CGAL::ZERO ||
      compare(t, root) != CGAL::SMALLER) {
    return std::nullopt;
  }
  return Time(root);
}

template <class Point>
Polynomial weight_difference_or_zero(const Point& p, const Point& q) {
  if constexpr (HasWeight<typename Point::Motion>) return weight_difference(p, q);
  return {};
}

Certificate exact_contact_certificate(const Polynomial& distance, const Time& t) {
  std::optional<Time> contact = contact_time(distance, t);
  if (contact && *contact == t) {
    return {Certificate::Kind::fails, t.interval(), std::make_unique<Time>(t), true,
            Certificate::Means::exact};
  }
  const bool is_root_solved = contact.has_value();
  return exact_certificate(std::move(contact), is_root_solved);
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
  const auto formula = [](const auto&... paths) { return -in_circle_of(paths...); };
  if (auto counted =
          counted_certificate(t, state, formula, p.motion(), q.motion(), r.motion(), s.motion())) {
    return std::move(*counted);
  }
  return exact_certificate(-in_circle_polynomial(p, q, r, s), t);
}

// What the filter knows of an orientation from t on, if it knows anything.
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
  const auto formula = [](const auto&... paths) { return orientation_of(paths...); };
  if (auto counted = counted_certificate(t, state, formula, p.motion(), q.motion(), r.motion())) {
    return std::move(*counted);
  }
  return exact_certificate(orientation_polynomial(p, q, r), t);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::flatness_certificate(const Point_2& p, const Point_2& q,
                                                                 const Point_2& r, const Time& t,
                                                                 Certificate_state state) const {
  if (auto known = filtered_orientation(p, q, r, t, state)) return std::move(*known);
  const Polynomial orientation = orientation_polynomial(p, q, r);
  const bool is_root_solved = orientation.degree() > 0;
  if (sign_just_after(orientation, t) == CGAL::NEGATIVE) {
    return exact_certificate(t, is_root_solved);
  }
  if (orientation.is_zero()) return exact_certificate(std::nullopt, is_root_solved);
  std::optional<Real_root> root = first_root_after(orientation, t);
  return exact_certificate(root ? std::optional(std::move(root->value)) : std::nullopt,
                           is_root_solved);
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
    std::array<const Linear_motion_2*, most_around> others;
    if (arithmetic_ != Arithmetic::filtered || around.size() > others.size()) return false;
    std::ranges::transform(around, others.begin(), [](const Point_2* q) { return &q->motion(); });
    return certainly_surrounded(centre(p.motion()), std::span(others).first(around.size()), now);
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
  return exact_certificate(segment_polynomial(p, q, r), t);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::hiding_certificate(
    const Point_2& p, const Point_2& q, const Point_2& r,
    const Time& t) const requires HasWeight<Motion> {
  return exact_certificate(-segment_polynomial(p, q, r), t);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::meeting_certificate(
    const Point_2& p, const Point_2& q, const Time& t,
    const Double_interval& among) const requires HasWeight<Motion> {
  if (arithmetic_ == Arithmetic::filtered &&
      certainly_apart(centre(p.motion()), centre(q.motion()), among)) {
    return {Certificate::Kind::never_fails, {}, nullptr, false, Certificate::Means::filter};
  }
  return exact_certificate(
      coincidence_time(x_difference(p, q), y_difference(p, q), Polynomial(), t), true);
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::weight_certificate(
    const Point_2& p, const Point_2& q, const Time& t) const requires HasWeight<Motion> {
  return exact_certificate(weight_difference(p, q), t);
}

template <class Motion>
Sign Basic_kinetic_traits_2<Motion>::certain_turn(
    const Point_2& p, const Point_2& q, const Point_2& r,
    const Double_interval& now) const requires HasWeight<Motion> {
  if (arithmetic_ != Arithmetic::filtered) return CGAL::ZERO;
  return certain_orientation(centre(p.motion()), centre(q.motion()), centre(r.motion()), now);
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
  return exact_contact_certificate(contact_polynomial(p, q, diameter), t);
}

// On straight lines two that part never meet again: their distance is convex, and remains so less
// the sum of radii that grow at constant rates.
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
  return exact_contact_certificate(wall_polynomial(p, wall), t);
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
  const Polynomial distance = contact_polynomial(p, q, range);
  if (sign_at(distance, t) != CGAL::POSITIVE) {
    return {Certificate::Kind::fails, t.interval(), std::make_unique<Time>(t), true,
            Certificate::Means::exact};
  }
  std::optional<Real_root> touch = first_root_after(distance, t);
  return exact_certificate(touch ? std::optional(std::move(touch->value)) : std::nullopt, true);
}

// The next touch, of no duration or not, after a root at `t`; on straight lines there is none, as
// after a contact.
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
    std::optional<Real_root> touch = first_root_after(contact_polynomial(p, q, range), t);
    return exact_certificate(touch ? std::optional(std::move(touch->value)) : std::nullopt, true);
  }
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::near_certificate(const Point_2& p, const Point_2& q,
                                                             double range, const Time& t) const {
  const auto filter = [&](bool vanishes_at) {
    return filter_near(p.motion(), q.motion(), range, t.interval(), vanishes_at);
  };
  if (arithmetic_ == Arithmetic::exact_only) {
    return exact_certificate(-contact_polynomial(p, q, range), t);
  }
  const Filter_result result = filter(false);
  if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  if (certain_gap(p.motion(), q.motion(), range, t.interval()) == CGAL::POSITIVE) {
    return failure_at_once(t);
  }
  return exact_certificate(-contact_polynomial(p, q, range), t, [&] { return filter(true); });
}

template <class Motion>
Certificate Basic_kinetic_traits_2<Motion>::closer_certificate(const Point_2& p, const Point_2& q,
                                                               const Point_2& r, const Point_2& s,
                                                               const Time& t) const {
  const auto filter = [&](bool vanishes_at) {
    return filter_closer(p.motion(), q.motion(), r.motion(), s.motion(), t.interval(), vanishes_at);
  };
  if (arithmetic_ == Arithmetic::exact_only) {
    return exact_certificate(distance_comparison_polynomial(p, q, r, s), t);
  }
  const Filter_result result = filter(false);
  if (result.kind != Filter_result::Kind::unknown) return certificate(result);
  if (certain_distance_comparison(p.motion(), q.motion(), r.motion(), s.motion(), t.interval()) ==
      CGAL::NEGATIVE) {
    return failure_at_once(t);
  }
  return exact_certificate(distance_comparison_polynomial(p, q, r, s), t,
                           [&] { return filter(true); });
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
    const auto& [position, velocity, epoch] = centre(p.motion());
    Rational clearance = to_rational(wall.clearance);
    Rational growth = 0;
    if constexpr (HasWeight<Motion>) {
      if (wall.rim) {
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
  return sign_just_after(derivative(contact_polynomial(p, q, 0)), t) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::has_approach_speed(const Point_2& p, const Point_2& q,
                                                        const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered) {
    const Sign certain = certain_distance_slope(p.motion(), q.motion(), t.interval());
    if (certain != CGAL::ZERO) return certain == CGAL::NEGATIVE;
  }
  return sign_at(derivative(contact_polynomial(p, q, 0)), t) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::has_approach_speed(const Point_2& p, const Wall_2& wall,
                                                        const Time& t) const {
  if constexpr (is_linear<Motion>) {
    const Vector_2& velocity = p.motion().velocity;
    const double speed = wall.is_vertical() ? velocity.x : velocity.y;
    double growth = 0;
    if constexpr (HasWeight<Motion>) {
      if (wall.rim) growth = p.motion().growth;
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
  return sign_at(contact_polynomial(p, q, diameter), t) != CGAL::POSITIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::may_overlap(const Point_2& p, const Point_2& q,
                                                 double diameter, const Time& t) const {
  return arithmetic_ == Arithmetic::filtered
             ? certain_gap(p.motion(), q.motion(), diameter, t.interval()) != CGAL::POSITIVE
             : sign_just_after(contact_polynomial(p, q, diameter), t) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::is_inside(const Point_2& p, const Wall_2& wall,
                                               const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered && certainly_inside(p.motion(), wall, t.interval())) {
    return true;
  }
  return sign_at(wall_polynomial(p, wall), t) != CGAL::NEGATIVE;
}

template class Basic_kinetic_traits_2<Linear_motion_2>;
template class Basic_kinetic_traits_2<Polynomial_motion_2>;
template class Basic_kinetic_traits_2<Disc_motion_2>;
template class Basic_kinetic_traits_2<Polynomial_disc_motion_2>;

}  // namespace kinetri
