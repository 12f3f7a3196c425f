// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/instantaneous_traits_2.h"

#include "filter/disc_filter.h"
#include "filter/filter.h"
#include "kinetri/kinetic/certificate_polynomials.h"

namespace kinetri {

// A sign that the filter knows is not zero, so that it is the same just before, at and just after.
template <class Motion>
template <class Filter, class Exact, class... Points>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::sign(const Filter& filter,
                                                           const Exact& polynomial,
                                                           const Points&... points) const {
  if (arithmetic_ == Arithmetic::filtered && (points.has_motion() && ...)) {
    const Sign s = filter(points.motion()..., instant_->time.interval());
    if (s != CGAL::ZERO) return s;
  }
  return sign_at(polynomial(points...), *instant_);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::x_order(const Point_2& p,
                                                              const Point_2& q) const {
  return sign(certain_x_order<Centre_motion_of<Motion>>, x_difference<Point_2>, p, q);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::y_order(const Point_2& p,
                                                              const Point_2& q) const {
  return sign(certain_y_order<Centre_motion_of<Motion>>, y_difference<Point_2>, p, q);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::orientation(const Point_2& p,
                                                                  const Point_2& q,
                                                                  const Point_2& r) const {
  return sign(certain_orientation<Centre_motion_of<Motion>>, orientation_polynomial<Point_2>, p, q,
              r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::in_circle(const Point_2& p, const Point_2& q,
                                                                const Point_2& r,
                                                                const Point_2& s) const {
  const auto filter = [](const auto&... arguments) { return certain_in_circle(arguments...); };
  return sign(filter, in_circle_polynomial<Point_2>, p, q, r, s);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::distance_order(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  return sign(certain_distance_order<Centre_motion_of<Motion>>, distance_difference<Point_2>, p, q,
              r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::scalar_product(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  return sign(certain_scalar_product<Centre_motion_of<Motion>>, scalar_product_polynomial<Point_2>,
              p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::weight_order(const Point_2& p,
                                                                   const Point_2& q) const {
  if constexpr (HasWeight<Motion>) {
    return sign(certain_weight_order<Motion>, weight_difference<Point_2>, p, q);
  }
  return CGAL::ZERO;
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::power_distance_order(const Point_2& p,
                                                                           const Point_2& q,
                                                                           const Point_2& r) const {
  if constexpr (HasWeight<Motion>) {
    return sign(certain_power_distance_order<Motion>, power_distance_difference<Point_2>, p, q, r);
  }
  return distance_order(p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::below_segment(const Point_2& p,
                                                                    const Point_2& q,
                                                                    const Point_2& r) const {
  return sign_at(segment_polynomial(p, q, r), *instant_);
}

template class Basic_instantaneous_traits_2<Linear_motion_2>;
template class Basic_instantaneous_traits_2<Polynomial_motion_2>;
template class Basic_instantaneous_traits_2<Disc_motion_2>;
template class Basic_instantaneous_traits_2<Polynomial_disc_motion_2>;

}  // namespace kinetri
