// SPDX-License-Identifier: GPL-3.0-or-later
//
// Positions at one time in twice the precision of binary64, and certain values computed from them
// (docs/MATH.md, section 7).
#ifndef KINETRI_SRC_KINETIC_FILTER_PRECISE_PLACES_H
#define KINETRI_SRC_KINETIC_FILTER_PRECISE_PLACES_H

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "double_double.h"
#include "error_bounds.h"
#include "image_differences.h"
#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

inline constexpr double unit = unit_roundoff * unit_roundoff;

struct Place {
  Double_double x;
  Double_double y;
};

// A position times `scale`, with the sum of the magnitudes of all numbers that it is computed from.
// Errors are those of linear motion times `error_factor`.
template <class Motion>
struct Scaled;

template <>
struct Scaled<Linear_motion_2> {
  static constexpr double scale = 1;
  static constexpr double error_factor = 1;

  static Place place(const Linear_motion_2& m, const Double_double& time, double& terms) {
    const Double_double elapsed = time - Double_double{m.epoch};
    const Double_double moved_x = elapsed * Double_double{m.velocity.x};
    const Double_double moved_y = elapsed * Double_double{m.velocity.y};
    terms += std::abs(m.position.x) + std::abs(m.position.y) + std::abs(moved_x.high) +
             std::abs(moved_y.high);
    return {Double_double{m.position.x} + moved_x, Double_double{m.position.y} + moved_y};
  }
};

// The scale 6 avoids divisions.
template <>
struct Scaled<Polynomial_motion_2> {
  static constexpr double scale = 6;
  static constexpr double error_factor = 2;

  static Place place(const Polynomial_motion_2& m, const Double_double& time, double& terms) {
    const Double_double elapsed = time - Double_double{m.epoch};
    const auto coordinate = [&](double Vector_2::*axis) {
      Double_double result;
      double magnitude = 0;
      const auto add = [&](double factor, double derivative) {
        const Double_double term = exact_product(factor, derivative);
        result = result * elapsed + term;
        magnitude = magnitude * std::abs(elapsed.high) + std::abs(term.high);
      };
      add(1, m.jerk.*axis);
      add(3, m.acceleration.*axis);
      add(6, m.velocity.*axis);
      add(6, m.position.*axis);
      terms += magnitude;
      return result;
    };
    return {coordinate(&Vector_2::x), coordinate(&Vector_2::y)};
  }
};

// That of the point.
template <>
struct Scaled<Image_motion_2> : Scaled<Linear_motion_2> {
  static Place place(const Image_motion_2& image, const Double_double& time, double& terms) {
    return Scaled<Linear_motion_2>::place(image.motion, time, terms);
  }
};

// What p has more than q in addition to the difference of the points: for images the difference of
// the offsets times the lattice vectors.
template <class Motion>
Place shifted(const Place& of_points, const Motion& /*p*/, const Motion& /*q*/,
              const Double_double& /*time*/, double& /*terms*/) {
  return of_points;
}
inline Place shifted(const Place& of_points, const Image_motion_2& p, const Image_motion_2& q,
                     const Double_double& time, double& terms) {
  const Offset_difference offset(p, q);
  if (offset.is_zero()) return of_points;
  const Periodic_box_2& box = p.box != nullptr ? *p.box : *q.box;
  double terms_a = 0;
  double terms_b = 0;
  const Place a = Scaled<Linear_motion_2>::place(box.first(), time, terms_a);
  const Place b = Scaled<Linear_motion_2>::place(box.second(), time, terms_b);
  const Double_double k = {offset.first};
  const Double_double l = {offset.second};
  terms += std::abs(offset.first) * terms_a + std::abs(offset.second) * terms_b;
  return {of_points.x + (k * a.x + l * b.x), of_points.y + (k * a.y + l * b.y)};
}

// Positions at one time, relative to the last point.
template <std::size_t N, class Motion>
class Places {
 public:
  Places(const std::array<const Motion*, N>& motions, const Double_double& time) {
    std::array<Place, N> places;
    for (std::size_t i = 0; i < N; ++i) {
      places[i] = Scaled<Motion>::place(*motions[i], time, terms_);
    }
    for (std::size_t i = 0; i + 1 < N; ++i) {
      relative_[i] = shifted({places[i].x - places[N - 1].x, places[i].y - places[N - 1].y},
                             *motions[i], *motions[N - 1], time, terms_);
      size_ = std::max({size_, std::abs(relative_[i].x.high), std::abs(relative_[i].y.high)});
    }
    size_ += 0x1p-90 * terms_;
  }

  Double_double cross(std::size_t i, std::size_t j) const {
    return relative_[i].x * relative_[j].y - relative_[i].y * relative_[j].x;
  }
  Double_double squared_length(std::size_t i) const {
    return relative_[i].x * relative_[i].x + relative_[i].y * relative_[i].y;
  }

  const Place& relative(std::size_t i) const { return relative_[i]; }
  double size() const { return size_; }
  double terms() const { return terms_; }
  bool is_in_range() const { return kinetri::is_in_range(size_) && terms_ < greatest_size; }

 private:
  std::array<Place, N - 1> relative_;
  double size_ = 0;   // bounds the relative positions
  double terms_ = 0;  // the sum of all numbers that the positions were computed from
};

// The error bounds are proved for rounding to nearest.
inline bool is_precise() {
  return std::fegetround() == FE_TONEAREST;
}

inline double certain(const Double_double& value, double error) {
  return std::abs(value.high) > error ? value.high : 0;
}

// One step of Newton's method from `origin`, which is in the bracket of the root. The error of
// `value` there is at most `error`; that of `slope` throughout the bracket is at most
// `slope_error`. For so small a step the error is far below half a unit in the last place
// (docs/MATH.md, section 8).
inline std::optional<Rounding> newton_rounding(double origin, double value, double error,
                                               double slope, double slope_error) {
  const double least_slope = std::abs(slope) - slope_error;
  if (!(least_slope > 0x1p-20 * std::abs(slope))) return std::nullopt;
  const double step = -value / slope;
  const Double_double root = exact_sum(origin, step);
  const double distance = 2 * (error + std::abs(step) * slope_error) / least_slope +
                          8 * unit_roundoff * (std::abs(step) + std::abs(root.low)) +
                          std::numeric_limits<double>::min();
  const double nearest = root.high + (root.low - distance);
  if (nearest != root.high + (root.low + distance) || !std::isfinite(nearest)) return std::nullopt;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Rounding result = {nearest,
                     {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)}};
  // The side of `nearest` on which the root is, if it is certain.
  if (nearest == root.high && root.low > distance) result.bounds.lower = nearest;
  if (nearest == root.high && root.low < -distance) result.bounds.upper = nearest;
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_PRECISE_PLACES_H
