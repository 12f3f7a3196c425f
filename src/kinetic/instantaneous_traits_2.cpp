// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/instantaneous_traits_2.h"

#include <algorithm>

#include "filter/filter.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {

template <class Motion>
std::optional<Double_interval> Basic_instantaneous_traits_2<Motion>::Predicate::filtered_interval(
    std::initializer_list<const Point_2*> points) const {
  if (state_->arithmetic == Arithmetic::exact_only) return std::nullopt;
  if (!std::ranges::all_of(points, &Point_2::has_motion)) return std::nullopt;
  return state_->instant.time.interval();
}

// A sign that the filter knows is not zero, so that it is the same just before, at and just after.

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::x_order(const Point_2& p,
                                                              const Point_2& q) const {
  if (const auto interval = filtered_interval({&p, &q})) {
    const Sign s = certain_x_order(p.motion(), q.motion(), *interval);
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(x_difference(p, q), state_->instant);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::y_order(const Point_2& p,
                                                              const Point_2& q) const {
  if (const auto interval = filtered_interval({&p, &q})) {
    const Sign s = certain_y_order(p.motion(), q.motion(), *interval);
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(y_difference(p, q), state_->instant);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::orientation(const Point_2& p,
                                                                  const Point_2& q,
                                                                  const Point_2& r) const {
  if (const auto interval = filtered_interval({&p, &q, &r})) {
    const Sign s = certain_orientation(p.motion(), q.motion(), r.motion(), *interval);
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(orientation_polynomial(p, q, r), state_->instant);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::in_circle(const Point_2& p, const Point_2& q,
                                                                const Point_2& r,
                                                                const Point_2& s) const {
  if (const auto interval = filtered_interval({&p, &q, &r, &s})) {
    const Sign side = certain_in_circle(p.motion(), q.motion(), r.motion(), s.motion(), *interval);
    if (side != CGAL::ZERO) return side;
  }
  return sign_at(in_circle_polynomial(p, q, r, s), state_->instant);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::distance_order(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  if (const auto interval = filtered_interval({&p, &q, &r})) {
    const Sign s = certain_distance_order(p.motion(), q.motion(), r.motion(), *interval);
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(distance_difference(p, q, r), state_->instant);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::scalar_product(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  if (const auto interval = filtered_interval({&p, &q, &r})) {
    const Sign s = certain_scalar_product(p.motion(), q.motion(), r.motion(), *interval);
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(scalar_product_polynomial(p, q, r), state_->instant);
}

template class Basic_instantaneous_traits_2<Linear_motion_2>;
template class Basic_instantaneous_traits_2<Polynomial_motion_2>;

}  // namespace kinetri
