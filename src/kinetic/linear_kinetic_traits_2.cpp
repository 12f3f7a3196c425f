// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_kinetic_traits_2.h"

#include <limits>
#include <memory>
#include <utility>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/kinetic/contact_filter.h"
#include "kinetri/kinetic/linear_filter.h"
#include "precise_filter.h"

namespace kinetri {
namespace {

using Time = Algebraic_number;

// The polynomials of failures that the filter has bracketed, made when an exact decision needs
// them.
struct In_circle_root : Root_source {
  In_circle_root(const Moving_point_2& a, const Moving_point_2& b, const Moving_point_2& c,
                 const Moving_point_2& d)
      : p(a.motion()), q(b.motion()), r(c.motion()), s(d.motion()) {}
  Polynomial polynomial() const override {
    return in_circle_polynomial(Moving_point_2(p), Moving_point_2(q), Moving_point_2(r),
                                Moving_point_2(s));
  }
  double certain_value_at(double high, double low) const override {
    return precise_in_circle(p, q, r, s, high, low);
  }
  Linear_motion_2 p, q, r, s;
};

struct Orientation_root : Root_source {
  Orientation_root(const Moving_point_2& a, const Moving_point_2& b, const Moving_point_2& c)
      : p(a.motion()), q(b.motion()), r(c.motion()) {}
  Polynomial polynomial() const override {
    return orientation_polynomial(Moving_point_2(p), Moving_point_2(q), Moving_point_2(r));
  }
  double certain_value_at(double high, double low) const override {
    return precise_orientation(p, q, r, high, low);
  }
  Linear_motion_2 p, q, r;
};

struct Contact_root : Root_source {
  Contact_root(const Moving_point_2& a, const Moving_point_2& b, double d)
      : p(a.motion()), q(b.motion()), diameter(d) {}
  Polynomial polynomial() const override {
    return contact_polynomial(Moving_point_2(p), Moving_point_2(q), diameter);
  }
  double certain_value_at(double high, double low) const override {
    return precise_contact(p, q, diameter, high, low);
  }
  Linear_motion_2 p, q;
  double diameter;
};

// The outlook that a verdict of the filter is. Precondition: it is not unknown.
Outlook<Time> outlook(const Filter_verdict& verdict, Certificate_counters& counters) {
  using Kind = Outlook<Time>::Kind;
  ++counters.filter_decided;
  if (verdict.is_refined) ++counters.refined_decided;
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
  return {Outlook<Time>::Kind::fails, t.interval(), std::make_unique<Time>(t)};
}

Outlook<Time> exact_outlook(const Polynomial& certificate, const Time& t,
                            Certificate_counters& counters) {
  ++counters.exact_decided;
  if (certificate.degree() > 0) ++counters.root_solves;
  std::optional<Time> failure = failure_time(certificate, t);
  if (!failure) return {};
  // The filter starts from this time's interval when the event has been executed, and knows nothing
  // if that is wide.
  failure->refine_to_bits(std::numeric_limits<double>::digits);
  const Double_interval bounds = failure->interval();
  return {Outlook<Time>::Kind::fails, bounds, std::make_unique<Time>(std::move(*failure))};
}

// That of a contact certificate of degree at most 2: the time t itself if it is not positive then,
// and falls.
Outlook<Time> exact_contact_outlook(const Polynomial& certificate, const Time& t,
                                    Certificate_counters& counters) {
  if (sign_at(derivative(certificate), t) != CGAL::NEGATIVE) {
    ++counters.exact_decided;
    return {};
  }
  if (sign_at(certificate, t) == CGAL::POSITIVE) return exact_outlook(certificate, t, counters);
  ++counters.exact_decided;
  return {Outlook<Time>::Kind::fails, t.interval(), std::make_unique<Time>(t)};
}

}  // namespace

Outlook<Time> Linear_kinetic_traits_2::in_circle_outlook(const Point_2& p, const Point_2& q,
                                                         const Point_2& r, const Point_2& s,
                                                         const Time& t, Certificate_state state,
                                                         Certificate_counters& counters) const {
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

Outlook<Time> Linear_kinetic_traits_2::orientation_outlook(const Point_2& p, const Point_2& q,
                                                           const Point_2& r, const Time& t,
                                                           Certificate_state state,
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

Time Linear_kinetic_traits_2::in_circle_failure(const Point_2& p, const Point_2& q,
                                                const Point_2& r, const Point_2& s,
                                                const Double_interval& bounds) const {
  return Time(std::make_shared<In_circle_root>(p, q, r, s), bounds);
}

Time Linear_kinetic_traits_2::orientation_failure(const Point_2& p, const Point_2& q,
                                                  const Point_2& r,
                                                  const Double_interval& bounds) const {
  return Time(std::make_shared<Orientation_root>(p, q, r), bounds);
}

std::optional<Time> Linear_kinetic_traits_2::coincidence_time(
    const Point_2& p, const Point_2& q, const Time& t, Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered && certainly_never_coincide(p.motion(), q.motion())) {
    ++counters.filter_decided;
    return std::nullopt;
  }
  ++counters.exact_decided;
  const Polynomial x = x_difference(p, q);
  const Polynomial y = y_difference(p, q);
  // Linear polynomials: a common root is a root of the one that is not constant, and of the other.
  const Polynomial& moving = x.degree() == 1 ? x : y;
  const Polynomial& other = x.degree() == 1 ? y : x;
  if (moving.degree() != 1) return std::nullopt;
  const Rational root(-moving[0], moving[1]);
  if (other.sign_at(root) != CGAL::ZERO || compare(t, root) != CGAL::SMALLER) return std::nullopt;
  return Time(root);
}

// ---- contacts ----

// A contact is a failure of a certificate only while the two approach, or the point moves outward.
// A certificate that is violated, or zero, is so at once where that is the case, and never again
// where it is not: what has passed its least value has passed it for ever.

Outlook<Time> Linear_kinetic_traits_2::contact_outlook(const Point_2& p, const Point_2& q,
                                                       double diameter, const Time& t,
                                                       Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_contact(p.motion(), q.motion(), diameter, t.interval());
    if (verdict.kind != Filter_verdict::Kind::unknown) return outlook(verdict, counters);
  }
  return exact_contact_outlook(contact_polynomial(p, q, diameter), t, counters);
}

Outlook<Time> Linear_kinetic_traits_2::wall_outlook(const Point_2& p, const Wall_2& wall,
                                                    const Time& t,
                                                    Certificate_counters& counters) const {
  ++counters.created;
  if (arithmetic_ == Arithmetic::filtered) {
    const Filter_verdict verdict = filter_wall_contact(p.motion(), wall, t.interval());
    if (verdict.kind != Filter_verdict::Kind::unknown) return outlook(verdict, counters);
  }
  return exact_contact_outlook(wall_polynomial(p, wall), t, counters);
}

Time Linear_kinetic_traits_2::contact_failure(const Point_2& p, const Point_2& q, double diameter,
                                              const Double_interval& bounds) const {
  return Time(std::make_shared<Contact_root>(p, q, diameter), bounds);
}

Time Linear_kinetic_traits_2::wall_failure(const Point_2& p, const Wall_2& wall,
                                           const Double_interval& /*bounds*/) const {
  const Polynomial h = wall_polynomial(p, wall);
  return Time(Rational(-h[0], h[1]));
}

bool Linear_kinetic_traits_2::do_approach(const Point_2& p, const Point_2& q, const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered &&
      certainly_do_not_approach(p.motion(), q.motion(), t.interval())) {
    return false;
  }
  return sign_at(derivative(contact_polynomial(p, q, 0)), t) == CGAL::NEGATIVE;
}

bool Linear_kinetic_traits_2::do_overlap(const Point_2& p, const Point_2& q, double diameter,
                                         const Time& t) const {
  return sign_at(contact_polynomial(p, q, diameter), t) != CGAL::POSITIVE;
}

bool Linear_kinetic_traits_2::is_inside(const Point_2& p, const Wall_2& wall, const Time& t) const {
  if (arithmetic_ == Arithmetic::filtered && certainly_inside(p.motion(), wall, t.interval())) {
    return true;
  }
  return sign_at(wall_polynomial(p, wall), t) != CGAL::NEGATIVE;
}

}  // namespace kinetri
