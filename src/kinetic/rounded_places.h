// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of moving points at one time, in doubles, with a bound for their errors: for signs
// that are certain despite the errors, and for searches that may begin anywhere.
#ifndef KINETRI_SRC_KINETIC_ROUNDED_PLACES_H
#define KINETRI_SRC_KINETIC_ROUNDED_PLACES_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

#include "kinetic/certain_signs.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/base/ids.h"
#include "kinetri/impl/base/double_interval.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// The positions, by point id, with one bound for the errors of all coordinates. The signs are
/// those at the time and just after it, or ZERO if that is not certain. Signs are O(1).
class Rounded_places {
 public:
  /// No positions: no sign is certain.
  Rounded_places() = default;

  /// The positions of the points `point_of(element)` of a range at `time`. Linear in the greatest
  /// minus the least id.
  template <class Range, class Projection = std::identity>
  Rounded_places(const Range& range, const Algebraic_number& time,
                 const Projection& point_of = Projection()) {
    Point_id last = 0;
    first_ = no_point;
    for (const auto& element : range) {
      const Point_id id = point_of(element).id();
      first_ = std::min(first_, id);
      last = std::max(last, id);
    }
    if (first_ == no_point) return;
    places_.resize(std::size_t{last} - first_ + 1);
    const double rounded_time = time.to_double();
    const Double_interval times = time.interval();
    for (const auto& element : range) {
      const auto& point = point_of(element);
      places_[point.id() - first_] = rounded_place(point.motion(), rounded_time);
      error_ = greater_or_infinite(error_, place_error(point.motion(), rounded_time, times));
    }
    using Motion = std::remove_cvref_t<decltype(point_of(*std::begin(range)).motion())>;
    if constexpr (HasWeight<Motion>) set_weights(range, rounded_time, times, point_of);
  }

  /// The position. Precondition: the point is one of those given.
  const Vector_2& operator[](Point_id id) const { return places_[id - first_]; }

  /// The error of each coordinate, at most.
  double error() const { return error_; }

  /// The weights by point id, from that of the least id on; none if all are equal at all times.
  const std::vector<double>& weights() const { return weights_; }
  /// The error of each weight, at most.
  double error_of_weights() const { return weight_error_; }
  Point_id first() const { return first_; }

  bool are_finite() const {
    return std::ranges::all_of(
        places_, [](const Vector_2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  }

  /// Positive if p, q, r certainly make a left turn, negative if they certainly make a right
  /// turn.
  Sign orientation(Point_id p, Point_id q, Point_id r) const {
    if (places_.empty()) return CGAL::ZERO;
    return detail::certain_orientation((*this)[p], (*this)[q], (*this)[r], error_);
  }

  /// Positive if s is certainly on the left of the oriented circle through p, q, r, negative
  /// if it is certainly on the right of it; of points with weights it is the power circle.
  Sign side_of_oriented_circle(Point_id p, Point_id q, Point_id r, Point_id s) const {
    if (places_.empty()) return CGAL::ZERO;
    if (!weights_.empty()) {
      return detail::certain_side_of_oriented_circle(
          (*this)[p], (*this)[q], (*this)[r], (*this)[s], error_,
          {{weights_[p - first_], weights_[q - first_], weights_[r - first_], weights_[s - first_]},
           weight_error_});
    }
    return detail::certain_side_of_oriented_circle((*this)[p], (*this)[q], (*this)[r], (*this)[s],
                                                   error_);
  }

 private:
  static double greater_or_infinite(double a, double b) {
    return std::isfinite(b) ? std::max(a, b) : std::numeric_limits<double>::infinity();
  }

  // Equal weights that never change make no difference.
  template <class Range, class Projection>
  void set_weights(const Range& range, double rounded_time, const Double_interval& times,
                   const Projection& point_of) {
    const auto& first = point_of(*std::begin(range)).motion();
    const bool are_equal = std::ranges::all_of(range, [&](const auto& element) {
      const auto& motion = point_of(element).motion();
      return motion.growth == 0 && motion.radius == first.radius && motion.weight == first.weight;
    });
    if (are_equal && first.growth == 0) return;
    weights_.resize(places_.size());
    for (const auto& element : range) {
      const auto& point = point_of(element);
      weights_[point.id() - first_] = rounded_weight(point.motion(), rounded_time);
      weight_error_ =
          greater_or_infinite(weight_error_, weight_error(point.motion(), rounded_time, times));
    }
  }

  Point_id first_ = 0;
  std::vector<Vector_2> places_;  // from the point first_ on
  std::vector<double> weights_;   // the same; none if all are equal
  double error_ = 0;              // of each coordinate
  double weight_error_ = 0;       // of each weight
};

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_ROUNDED_PLACES_H
