// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/instantaneous_traits_2.h"

#include <tuple>

#include "certificate_formulas.h"
#include "filter/disc_filter.h"
#include "filter/filter.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "polynomial_on_stack.h"

namespace kinetri {
namespace {

constexpr auto no_filter = [](const auto&...) { return CGAL::ZERO; };

}  // namespace

// The sign of `formula` for the points. A sign that the filter knows is not zero, and so the same
// just before, at and just after the time.
template <class Motion>
template <class Filter, class Formula, class... Points>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::sign(const Filter& filter,
                                                           const Formula& formula,
                                                           const Points&... points) const {
  if ((points.has_motion() && ...)) {
    if (arithmetic_ == Arithmetic::filtered) {
      const Sign s = filter(points.motion()..., instant_->time.interval());
      if (s != CGAL::ZERO) return s;
    }
    if (const auto s = sign_on_stack(*instant_, formula, points.motion()...)) return *s;
  }
  const auto paths = common_trajectories<sizeof...(Points), Motion>({&points...});
  return sign_at(std::apply(formula, paths), *instant_);
}

// The same for a formula with a lifting: perturbed just before and just after the time.
template <class Motion>
template <class Filter, class Formula, class... Points>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::lifted_sign(const Filter& filter,
                                                                  const Formula& formula,
                                                                  const Points&... points) const {
  if (instant_->side != Time_side::at) return sign(filter, perturbed(formula), points...);
  return sign(filter, lifted_by(Lifting::paraboloid, formula), points...);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::x_order(const Point_2& p,
                                                              const Point_2& q) const {
  const auto formula = [](const auto&... paths) { return x_difference_of(paths...); };
  return sign(certain_x_order<Center_motion_of<Motion>>, formula, p, q);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::y_order(const Point_2& p,
                                                              const Point_2& q) const {
  const auto formula = [](const auto&... paths) { return y_difference_of(paths...); };
  return sign(certain_y_order<Center_motion_of<Motion>>, formula, p, q);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::orientation(const Point_2& p,
                                                                  const Point_2& q,
                                                                  const Point_2& r) const {
  const auto formula = [](const auto&... paths) { return orientation_of(paths...); };
  return sign(certain_orientation<Center_motion_of<Motion>>, formula, p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::in_circle(const Point_2& p, const Point_2& q,
                                                                const Point_2& r,
                                                                const Point_2& s) const {
  const auto filter = [](const auto&... arguments) { return certain_in_circle(arguments...); };
  const auto formula = [](const auto&... paths) { return in_circle_of(paths...); };
  return lifted_sign(filter, formula, p, q, r, s);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::distance_order(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  const auto formula = [](const auto&... paths) { return distance_difference_of(paths...); };
  return sign(certain_distance_order<Center_motion_of<Motion>>, formula, p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::scalar_product(const Point_2& p,
                                                                     const Point_2& q,
                                                                     const Point_2& r) const {
  const auto formula = [](const auto&... paths) { return scalar_product_of(paths...); };
  return sign(certain_scalar_product<Center_motion_of<Motion>>, formula, p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::weight_order(const Point_2& p,
                                                                   const Point_2& q) const {
  if constexpr (HasWeight<Motion>) {
    const auto formula = [](const auto&... paths) { return weight_difference_of(paths...); };
    return sign(certain_weight_order<Motion>, formula, p, q);
  }
  return CGAL::ZERO;
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::power_distance_order(const Point_2& p,
                                                                           const Point_2& q,
                                                                           const Point_2& r) const {
  if constexpr (HasWeight<Motion>) {
    const auto formula = [](const auto&... paths) {
      return power_distance_difference_of(paths...);
    };
    return sign(certain_power_distance_order<Motion>, formula, p, q, r);
  }
  return distance_order(p, q, r);
}

template <class Motion>
Sign Basic_instantaneous_traits_2<Motion>::Predicate::below_segment(const Point_2& p,
                                                                    const Point_2& q,
                                                                    const Point_2& r) const {
  const auto formula = [](const auto&... paths) { return segment_of(paths...); };
  return lifted_sign(no_filter, formula, p, q, r);
}

template class Basic_instantaneous_traits_2<Linear_motion_2>;
template class Basic_instantaneous_traits_2<Image_motion_2>;
template class Basic_instantaneous_traits_2<Image_disc_motion_2>;
template class Basic_instantaneous_traits_2<Polynomial_motion_2>;
template class Basic_instantaneous_traits_2<Disc_motion_2>;
template class Basic_instantaneous_traits_2<Polynomial_disc_motion_2>;

}  // namespace kinetri
