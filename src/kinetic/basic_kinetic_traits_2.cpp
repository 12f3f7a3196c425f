// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/basic_kinetic_traits_2.h"

#include <array>
#include <concepts>
#include <limits>
#include <memory>
#include <utility>

#include "filter/contact_filter.h"
#include "filter/linear_filter.h"
#include "filter/polynomial_filter.h"
#include "filter/precise_filter.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"

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
  Motion p, q;
  double diameter;
};

template <class Motion>
struct Wall_root : Root_source {  // of polynomial motion; else the root is rational
  using Point = Basic_moving_point_2<Motion>;
  Wall_root(const Point& a, const Wall_2& w) : p(a.motion()), wall(w) {}
  Polynomial polynomial() const override { return wall_polynomial(Point(p), wall); }
  Motion p;
  Wall_2 wall;
};

// The outlook that a verdict of the filter is. Precondition: it is not unknown.
Outlook<Time> outlook(const Filter_verdict& verdict, Certificate_counters& counters) {
  using Kind = Outlook<Time>::Kind;
  ++counters.filter_decided;
  counters.refined_decided += verdict.is_refined ? 1 : 0;
  switch (verdict.kind) {
    case Filter_verdict::Kind::fails:
      ++counters.root_solves;
      return {Kind::fails, verdict.bounds};
    case Filter_verdict::Kind::holds:
      return {Kind::holds, verdict.bounds};
    default:
      return {Kind::holds_for_ever};
  }
}

// That of a certificate that is certainly violated at t, as after the insertion of a point.
Outlook<Time> failure_at_once(const Time& t, Certificate_counters& counters) {
  ++counters.filter_decided;
  ++counters.refined_decided;
  return {Outlook<Time>::Kind::fails, t.interval(), std::make_unique<Time>(t), true};
}

// The outlook of an in-circle certificate of which the filter has said something, be it "unknown".
template <class Motion>
Outlook<Time> in_circle_outlook(const Basic_kinetic_traits_2<Motion>& traits,
                                const Filter_verdict& verdict,
                                const Quadruple<Basic_moving_point_2<Motion>>& points,
                                const Time& t, Certificate_state state,
                                Certificate_counters& counters) {
  if (verdict.kind != Filter_verdict::Kind::unknown) {
    ++counters.created;
    return outlook(verdict, counters);
  }
  const auto& [p, q, r, s] = points;
  return traits.in_circle_outlook(*p, *q, *r, *s, t, state, counters);
}

// What the filter knows of two in-circle certificates, without looking at each of them alone.
std::array<Filter_verdict, 2> verdicts(const std::array<Quadruple<Moving_point_2>, 2>& certificates,
                                       const Double_interval& after) {
  const auto& [a, b] = certificates;
  return filter_in_circles({{{&a[0]->motion(), &a[1]->motion(), &a[2]->motion(), &a[3]->motion()},
                             {&b[0]->motion(), &b[1]->motion(), &b[2]->motion(), &b[3]->motion()}}},
                           after);
}
std::array<Filter_verdict, 2> verdicts(
    const std::array<Quadruple<Basic_moving_point_2<Polynomial_motion_2>>, 2>& /*certificates*/,
    const Double_interval& /*after*/) {
  return {};
}

// What the filter knows of the certificates after a flip, without looking at each of them alone.
std::array<Filter_verdict, 5> verdicts_after_flip(const Flip_neighborhood<Moving_point_2>& around,
                                                  const Double_interval& after) {
  const auto& [a, b, c, d] = around.corners;
  const auto& [e, f, g, h] = around.beyond;
  return filter_after_flip({{&a->motion(), &b->motion(), &c->motion(), &d->motion()},
                            {&e->motion(), &f->motion(), &g->motion(), &h->motion()}},
                           after);
}
std::array<Filter_verdict, 5> verdicts_after_flip(
    const Flip_neighborhood<Basic_moving_point_2<Polynomial_motion_2>>& /*around*/,
    const Double_interval& /*after*/) {
  return {};
}

Outlook<Time> exact_outlook(std::optional<Time> failure) {
  using Kind = Outlook<Time>::Kind;
  constexpr bool may_vanish = true;
  if (!failure) return {Kind::holds_for_ever, {}, nullptr, may_vanish};
  // The filter starts from this time's interval when the event has been executed, and knows nothing
  // if that is wide.
  failure->refine_to_bits(std::numeric_limits<double>::digits);
  const Double_interval bounds = failure->interval();
  return {Kind::fails, bounds, std::make_unique<Time>(std::move(*failure)), may_vanish};
}

Outlook<Time> exact_outlook(const Polynomial& certificate, const Time& t,
                            Certificate_counters& counters) {
  ++counters.exact_decided;
  if (certificate.degree() > 0) ++counters.root_solves;
  return exact_outlook(failure_time(certificate, t));
}

// The first time from t on at which the distance is not positive and falls.
std::optional<Time> contact_time(const Polynomial& distance, const Time& t) {
  if (sign_at(distance, t) == CGAL::POSITIVE) return failure_time(distance, t);
  const std::optional<Time> fall = failure_time(derivative(distance), t);
  if (!fall || sign_at(distance, *fall) != CGAL::POSITIVE) return fall;
  return failure_time(distance, *fall);
}

Outlook<Time> exact_contact_outlook(const Polynomial& distance, const Time& t,
                                    Certificate_counters& counters) {
  ++counters.exact_decided;
  std::optional<Time> contact = contact_time(distance, t);
  if (contact && *contact == t) {
    return {Outlook<Time>::Kind::fails, t.interval(), std::make_unique<Time>(t)};
  }
  if (contact) ++counters.root_solves;
  return exact_outlook(std::move(contact));
}

}  // namespace

template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::in_circle_outlook(
    const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s, const Time& t,
    Certificate_state state, Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict =
        filter_in_circle(p.motion(), q.motion(), r.motion(), s.motion(), t.interval(),
                         state == Certificate_state::vanishes);
    if (verdict.kind != Filter_verdict::Kind::unknown) {
      return outlook(verdict, counters);
    }
    if (certain_in_circle(p.motion(), q.motion(), r.motion(), s.motion(), t.interval()) ==
        CGAL::POSITIVE) {
      return failure_at_once(t, counters);
    }
  }
  return exact_outlook(-in_circle_polynomial(p, q, r, s), t, counters);
}

template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::orientation_outlook(
    const Point_2& p, const Point_2& q, const Point_2& r, const Time& t, Certificate_state state,
    Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_orientation(
        p.motion(), q.motion(), r.motion(), t.interval(), state == Certificate_state::vanishes);
    if (verdict.kind != Filter_verdict::Kind::unknown) {
      return outlook(verdict, counters);
    }
    if (certain_orientation(p.motion(), q.motion(), r.motion(), t.interval()) == CGAL::NEGATIVE) {
      return failure_at_once(t, counters);
    }
  }
  return exact_outlook(orientation_polynomial(p, q, r), t, counters);
}

template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::flatness_outlook(
    const Point_2& p, const Point_2& q, const Point_2& r, const Time& t, Certificate_state state,
    Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_orientation(
        p.motion(), q.motion(), r.motion(), t.interval(), state == Certificate_state::vanishes);
    if (verdict.kind != Filter_verdict::Kind::unknown) return outlook(verdict, counters);
    if (certain_orientation(p.motion(), q.motion(), r.motion(), t.interval()) == CGAL::NEGATIVE) {
      return failure_at_once(t, counters);
    }
  }
  const Polynomial orientation = orientation_polynomial(p, q, r);
  ++counters.exact_decided;
  if (orientation.degree() > 0) ++counters.root_solves;
  if (sign_just_after(orientation, t) == CGAL::NEGATIVE) return exact_outlook(t);
  if (orientation.is_zero()) return exact_outlook(std::nullopt);
  std::optional<Real_root> root = first_root_after(orientation, t);
  return exact_outlook(root ? std::optional(std::move(root->value)) : std::nullopt);
}

template <class Motion>
std::array<Outlook<Time>, 2> Basic_kinetic_traits_2<Motion>::in_circle_outlooks(
    const std::array<Quadruple<Point_2>, 2>& certificates, const Time& t,
    Certificate_counters& counters) const {
  const auto known = arithmetic_ == Arithmetic::filtered ? verdicts(certificates, t.interval())
                                                         : std::array<Filter_verdict, 2>();
  constexpr auto any = Certificate_state::any;
  return {kinetri::in_circle_outlook(*this, known[0], certificates[0], t, any, counters),
          kinetri::in_circle_outlook(*this, known[1], certificates[1], t, any, counters)};
}

template <class Motion>
std::array<Outlook<Time>, 5> Basic_kinetic_traits_2<Motion>::outlooks_after_flip(
    const Flip_neighborhood<Point_2>& around, const Double_interval& now,
    Certificate_counters& counters) const {
  const auto known = arithmetic_ == Arithmetic::filtered ? verdicts_after_flip(around, now)
                                                         : std::array<Filter_verdict, 5>();
  const auto number = [&](std::size_t k) -> Outlook<Time> {
    if (known[k].kind == Filter_verdict::Kind::unknown) return {Outlook<Time>::Kind::unknown};
    ++counters.created;
    return outlook(known[k], counters);
  };
  return {number(0), number(1), number(2), number(3), number(4)};
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
std::optional<Time> Basic_kinetic_traits_2<Motion>::coincidence_time(
    const Point_2& p, const Point_2& q, const Time& t, const Double_interval& among,
    Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered && certainly_apart(p.motion(), q.motion(), among)) {
    ++counters.filter_decided;
    return std::nullopt;
  }
  ++counters.exact_decided;
  const Polynomial x = x_difference(p, q);
  const Polynomial y = y_difference(p, q);
  if (x.degree() > 1 || y.degree() > 1) {
    const Polynomial common = gcd(x, y);
    if (common.degree() < 1) return std::nullopt;
    std::optional<Real_root> root = first_root_after(common, t);
    return root ? std::optional(std::move(root->value)) : std::nullopt;
  }
  // Linear polynomials: a common root is a root of the one that is not constant, and of the other.
  const Polynomial& moving = x.degree() == 1 ? x : y;
  const Polynomial& other = x.degree() == 1 ? y : x;
  if (moving.degree() != 1) return std::nullopt;
  const Rational root(-moving[0], moving[1]);
  if (other.sign_at(root) != CGAL::ZERO || compare(t, root) != CGAL::SMALLER) return std::nullopt;
  return Time(root);
}

// ---- contacts ----

template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::contact_outlook(
    const Point_2& p, const Point_2& q, double diameter, const Time& t,
    Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_contact(p.motion(), q.motion(), diameter, t.interval());
    if (verdict.kind != Filter_verdict::Kind::unknown) return outlook(verdict, counters);
  }
  return exact_contact_outlook(contact_polynomial(p, q, diameter), t, counters);
}

// On straight lines two that part never meet again: their squared distance is convex.
template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::next_contact_outlook(
    const Point_2& p, const Point_2& q, double diameter, const Time& t,
    Certificate_counters& counters) const {
  if constexpr (std::same_as<Motion, Linear_motion_2>) {
    return {};
  } else {
    const std::optional<Time> parting = failure_time(-contact_polynomial(p, q, diameter), t);
    if (!parting) return {};
    return contact_outlook(p, q, diameter, *parting, counters);
  }
}

template <class Motion>
Outlook<Time> Basic_kinetic_traits_2<Motion>::wall_outlook(const Point_2& p, const Wall_2& wall,
                                                           const Time& t,
                                                           Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_wall_contact(p.motion(), wall, t.interval());
    if (verdict.kind != Filter_verdict::Kind::unknown) return outlook(verdict, counters);
  }
  return exact_contact_outlook(wall_polynomial(p, wall), t, counters);
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::contact_failure(const Point_2& p, const Point_2& q,
                                                     double diameter,
                                                     const Double_interval& bounds) const {
  return Time(std::make_shared<Contact_root<Motion>>(p, q, diameter), bounds);
}

template <class Motion>
Time Basic_kinetic_traits_2<Motion>::wall_failure(const Point_2& p, const Wall_2& wall,
                                                  const Double_interval& bounds) const {
  if constexpr (std::same_as<Motion, Linear_motion_2>) {
    const Polynomial h = wall_polynomial(p, wall);
    return Time(Rational(-h[0], h[1]));
  } else {
    return Time(std::make_shared<Wall_root<Motion>>(p, wall), bounds);
  }
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::do_approach(const Point_2& p, const Point_2& q,
                                                 const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered &&
      certainly_do_not_approach(p.motion(), q.motion(), t.interval())) {
    return false;
  }
  return sign_just_after(derivative(contact_polynomial(p, q, 0)), t) == CGAL::NEGATIVE;
}

template <class Motion>
bool Basic_kinetic_traits_2<Motion>::do_overlap(const Point_2& p, const Point_2& q, double diameter,
                                                const Time& t) const {
  return sign_at(contact_polynomial(p, q, diameter), t) != CGAL::POSITIVE;
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

}  // namespace kinetri
