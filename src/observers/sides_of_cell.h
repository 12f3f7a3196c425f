// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sides of Voronoi and power cells at one time, as half planes relative to the point. In a
// periodic box the points are images.
#ifndef KINETRI_SRC_OBSERVERS_SIDES_OF_CELL_H
#define KINETRI_SRC_OBSERVERS_SIDES_OF_CELL_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "algebra/rounded_quotient.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/simulation_2.h"
#include "observers/limited_cell.h"
#include "triangulation/ball.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

template <KineticTraits_2 Traits>
class Exact_cell_at_time;

/// Computes the sides at one time, in one thread: by ball arithmetic if that suffices, else exact
/// arithmetic.
template <KineticTraits_2 Traits>
class Sides_at_time {
 public:
  using Point_2 = Certified_point_2<Traits>;  ///< in a periodic box: an image

  /// The time must live as long as this object.
  Sides_at_time(const Traits& traits, const Algebraic_number& time)
      : traits_(traits), time_(time), t_(ball_of(time)) {}

  /// No position of a cell in a periodic box is farther from its point, since it is in the cell of
  /// the point among its own images: half of the lengths of two vectors that span the lattice.
  /// Infinite in the plane. Throws Precondition_error if a cell may reach 1e150.
  double reach() const {
    double result = std::numeric_limits<double>::infinity();
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      const Periodic_box_2& box = traits_.box();
      const Wrapping wrapping(box, time_.to_double());
      double sum = 0;
      for (const Lattice_offset_2& vector : wrapping.basis()) {
        const Ball_2 there = ball_place(Image_motion_2{{}, vector, &box}, t_);
        sum += std::hypot(std::abs(there.x.high) + 2 * there.x.radius,
                          std::abs(there.y.high) + 2 * there.y.radius);
      }
      result = (1 + 0x1p-40) * sum / 2;
      constexpr double greatest = 1e150;
      KINETRI_PRECONDITION(result < greatest,
                           "a Voronoi cell is so large that its area may not be a binary64 number; "
                           "give lattice vectors below 1e150");
    }
    return result;
  }

  /// The accurate position of the point.
  Ball_2 place(const Point_2& p) const {
    const Ball_2 result = ball_place(center(p.motion()), t_);
    if (is_known_well(result.x) && is_known_well(result.y)) return result;
    const Trajectory_2 path = p.trajectory();
    const auto ball = [](double x) { return Ball(x, 0, 0x1p-53 * std::abs(x)); };
    return {ball(rounded_quotient(path.x, path.w, time_)),
            ball(rounded_quotient(path.y, path.w, time_))};
  }

  /// Whether the two have the same position and, with weights, the same weight.
  bool are_alike(const Point_2& p, const Ball_2& at_p, const Point_2& q, const Ball_2& at_q) const {
    const Ball_2 d = at_q - at_p;
    if (d.x.is_nonzero() || d.y.is_nonzero()) return false;
    return coincide(p, q) && weight_order(p, q) == CGAL::ZERO;
  }

  /// Adds the half plane of the positions that are as near to `p` as to `q`, or nearer; with
  /// weights, those with no more power. All of the plane if the two are alike.
  void add(const Point_2& p, const Ball_2& at_p, const Point_2& q, const Ball_2& at_q,
           Sides_of_cell& sides) const {
    const Ball_2 d = at_q - at_p;
    Vector_2 vector = {d.x.high, d.y.high};
    const double size = std::max(std::abs(vector.x), std::abs(vector.y));
    int exponent = 0;  // of the scale of the vector, a power of two
    const bool is_known =
        std::max(d.x.radius, d.y.radius) <= 0x1p-60 * size && size >= 0x1p-500 && size <= 0x1p500;
    if (!is_known) {
      if (coincide(p, q)) {
        sides.is_empty = sides.is_empty || weight_order(p, q) == CGAL::NEGATIVE;
        return;
      }
      vector = scaled_vector(p, q, exponent);
    }
    const double length = std::sqrt(vector.x * vector.x + vector.y * vector.y);
    const double middle = std::ldexp(length / 2, -exponent);
    const double shift = std::ldexp(weight_difference(p, q) / 2 / length, exponent);
    double bound = middle + shift;
    if (shift != 0) {
      const double error = 0x1p-50 * (std::abs(middle) + std::abs(shift));
      sides.displacement = std::max(sides.displacement, error);
      // Its sign says whether the cell of p contains p.
      if (std::abs(bound) <= error)
        bound = std::numeric_limits<double>::min() * static_cast<int>(power_order(p, q));
    }
    sides.half_planes.push_back({{vector.x / length, vector.y / length}, bound});
  }

 private:
  using Instantaneous_traits = typename Traits::Instantaneous_traits;

  static constexpr bool is_weighted = HasWeight<typename Traits::Motion>;

  Point_2 at_rest(const Vector_2& place) const {
    typename Traits::Motion motion{};
    motion.position = place;
    if constexpr (PeriodicKineticTraits_2<Traits>) {
      return traits_.image(typename Traits::Point_2(motion), {});
    } else {
      return Point_2(motion);
    }
  }

  bool coincide(const Point_2& p, const Point_2& q) const {
    return exactly().compare_x_2_object()(p, q) == CGAL::EQUAL &&
           exactly().compare_y_2_object()(p, q) == CGAL::EQUAL;
  }

  // The sign of the weight of p minus that of q.
  CGAL::Sign weight_order(const Point_2& p, const Point_2& q) const {
    if constexpr (is_weighted) return sign_at(weight_polynomial(p, q), time_);
    return CGAL::ZERO;
  }

  // The sign of the power of the position of p to q minus that to p.
  CGAL::Sign power_order(const Point_2& p, const Point_2& q) const {
    const Trajectory_2 here = p.trajectory();
    const Trajectory_2 there = q.trajectory();
    const Polynomial x = there.x * here.w - here.x * there.w;
    const Polynomial y = there.y * here.w - here.y * there.w;
    return sign_at(x * x + y * y + weight_polynomial(p, q), time_);
  }

  // The weight of p minus that of q, times the squares of both denominators.
  static Polynomial weight_polynomial(const Point_2& p, const Point_2& q) {
    const Trajectory_2 here = p.trajectory();
    const Trajectory_2 there = q.trajectory();
    return here.weight * there.w * there.w - there.weight * here.w * here.w;
  }

  double weight_difference(const Point_2& p, const Point_2& q) const {
    if constexpr (is_weighted) {
      const Ball known = ball_weight(p.motion(), t_) - ball_weight(q.motion(), t_);
      if (known.is_zero() || is_known_well(known)) return known.high;
      const Polynomial w = p.trajectory().w * q.trajectory().w;
      return rounded_quotient(weight_polynomial(p, q), w * w, time_);
    }
    return 0;
  }

  // The vector from p to q, scaled by a power of two so that it is neither huge nor tiny.
  // Precondition: the two do not coincide.
  Vector_2 scaled_vector(const Point_2& p, const Point_2& q, int& exponent) const {
    const Trajectory_2 here = p.trajectory();
    const Trajectory_2 there = q.trajectory();
    Polynomial x = there.x * here.w - here.x * there.w;
    Polynomial y = there.y * here.w - here.y * there.w;
    Polynomial w = here.w * there.w;
    constexpr double huge = 0x1p500;
    constexpr int step = 600;
    const Integer factor = Integer(1) << step;
    for (;;) {
      const Vector_2 vector = {rounded_quotient(x, w, time_), rounded_quotient(y, w, time_)};
      const double size = std::max(std::abs(vector.x), std::abs(vector.y));
      if (size >= 1 / huge && size <= huge) return vector;
      const bool is_huge = size > huge;
      (is_huge ? w : x) *= factor;
      if (!is_huge) y *= factor;
      exponent += is_huge ? -step : step;
    }
  }

  friend class Exact_cell_at_time<Traits>;

  const Instantaneous_traits& exactly() const {
    if (!exactly_) exactly_ = traits_.instantaneous_traits({time_, Time_side::at});
    return *exactly_;
  }

  const Traits& traits_;
  const Algebraic_number& time_;
  Ball t_;
  mutable std::optional<Instantaneous_traits> exactly_ = std::nullopt;  // created on demand
};

/// The cell of one point among neighbors.
template <KineticTraits_2 Traits>
class Exact_cell_at_time final : public Exact_cell {
 public:
  using Point_2 = Certified_point_2<Traits>;

  /// All of these must live as long as this object.
  Exact_cell_at_time(const Sides_at_time<Traits>& at_time, const Point_2& point,
                     std::span<const Point_2> neighbors)
      : at_time_(at_time), point_(point), neighbors_(neighbors) {}

  bool is_left(const Vector_2& from, const Vector_2& to) const override {
    return at_time_.exactly().orientation_2_object()(at_time_.at_rest(from), at_time_.at_rest(to),
                                                     point_) != CGAL::RIGHT_TURN;
  }

  std::optional<bool> is_open(const Vector_2& from, const Vector_2& to,
                              double cutoff) const override {
    const Algebraic_number& time = at_time_.time_;
    time.tight_interval();  // detects binary64 numbers
    if (!time.is_known_rational()) return std::nullopt;
    const Rational t = time.rational();
    const Exact_position_2 p = point_.position(t);
    // The power of the position from + s (to - from) to a point is square s^2 + slope s + power.
    const Rational x = to_rational(from.x);
    const Rational y = to_rational(from.y);
    const Rational dx = to_rational(to.x) - x;
    const Rational dy = to_rational(to.y) - y;
    const auto slope = [&](const Exact_position_2& q) {
      return Rational(2 * (dx * (x - q.x) + dy * (y - q.y)));
    };
    const auto power = [&](const Exact_position_2& q, const Rational& weight) {
      return Rational((x - q.x) * (x - q.x) + (y - q.y) * (y - q.y) - weight);
    };
    Rational begin = 0;
    Rational end = 1;
    for (const Point_2& neighbor : neighbors_) {
      const Exact_position_2 q = neighbor.position(t);
      const Rational a = slope(p) - slope(q);
      const Rational b = power(p, point_.weight(t)) - power(q, neighbor.weight(t));
      // Inside if a s + b < 0.
      if (a == 0 && b >= 0) return false;
      if (a == 0) continue;
      const Rational s = -b / a;
      if (a > 0 && s < end) end = s;
      if (a < 0 && s > begin) begin = s;
    }
    if (begin >= end) return false;
    if (std::isinf(cutoff)) return true;
    const Rational square = dx * dx + dy * dy;
    const Rational r = to_rational(cutoff);
    const auto is_inside = [&](const Rational& s) {
      return square * s * s + slope(p) * s + power(p, r * r) < 0;
    };
    const Rational nearest = -slope(p) / (2 * square);
    return is_inside(nearest < begin ? begin : nearest > end ? end : nearest);
  }

 private:
  const Sides_at_time<Traits>& at_time_;
  const Point_2& point_;
  std::span<const Point_2> neighbors_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_SIDES_OF_CELL_H
