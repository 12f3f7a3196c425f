// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/connecting_range.h"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>

#include <utility>

#include "algebra/root_difference.h"
#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri::detail {
namespace {

// Bounds of the value of a polynomial at a time; anything if they overflow.
Double_interval bounds_at(const std::vector<Rational>& polynomial, const Algebraic_number& time) {
  const auto [lower, upper] = time.interval();
  std::vector<Double_interval> coefficients;
  for (const Rational& coefficient : polynomial) {
    coefficients.push_back(Algebraic_number(coefficient).interval());
  }
  const CGAL::Protect_FPU_rounding<true> upward;
  CGAL::Interval_nt<false> value = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) {
    value = value * CGAL::Interval_nt<false>(lower, upper) +
            CGAL::Interval_nt<false>(c->lower, c->upper);
  }
  return {value.inf(), value.sup()};
}

// A time at which a length may be extreme.
class Candidate {
 public:
  Candidate(const Length_piece& piece, Algebraic_number time)
      : piece_(&piece), time_(std::move(time)), bounds_(bounds_at(piece.squared_length, time_)) {}

  // False if bounds are not numbers.
  friend bool is_shorter(const Candidate& a, const Candidate& b) {
    if (a.bounds_.upper < b.bounds_.lower) return true;
    if (b.bounds_.upper < a.bounds_.lower) return false;
    return a.length() < b.length();
  }

  const Length_piece* piece() const { return piece_; }
  const Algebraic_number& time() const { return time_; }
  const Algebraic_number& length() const {
    if (!length_) length_ = length_at(piece_->squared_length, time_);
    return *length_;
  }

 private:
  const Length_piece* piece_;
  Algebraic_number time_;
  Double_interval bounds_;
  mutable std::optional<Algebraic_number> length_;
};

// The ends, and the roots of the derivative.
std::vector<Algebraic_number> extreme_times(const Length_piece& piece) {
  std::vector<Algebraic_number> result = {piece.from};
  const Polynomial slope = derivative(primitive_polynomial(piece.squared_length));
  if (slope.degree() > 0) {
    for (const Real_root& root : real_roots(slope)) {
      if (piece.from < root.value && root.value < piece.to) result.push_back(root.value);
    }
  }
  result.push_back(piece.to);
  return result;
}

}  // namespace

template <class Point>
std::vector<Rational> squared_distance(const Point& p, const Point& q) {
  const Trajectory_2 a = p.trajectory();
  const Trajectory_2 b = q.trajectory();
  const Polynomial x = a.x * b.w - b.x * a.w;
  const Polynomial y = a.y * b.w - b.y * a.w;
  const Polynomial square = x * x + y * y;
  const Integer denominator = a.w[0] * b.w[0];
  std::vector<Rational> result;
  for (const Integer& coefficient : square.coefficients()) {
    result.emplace_back(coefficient, Integer(denominator * denominator));
  }
  if (result.empty()) result.emplace_back(0);
  return result;
}

Algebraic_number length_at(const std::vector<Rational>& squared_length,
                           const Algebraic_number& time) {
  return root_difference_at(squared_length, {}, time);
}

std::optional<Extreme_length> extreme_length(std::span<const Length_piece> pieces, bool greatest) {
  std::optional<Candidate> extreme;
  for (const Length_piece& piece : pieces) {
    for (const Algebraic_number& time : extreme_times(piece)) {
      Candidate candidate(piece, time);
      if (!extreme ||
          (greatest ? is_shorter(*extreme, candidate) : is_shorter(candidate, *extreme))) {
        extreme = std::move(candidate);
      }
    }
  }
  if (!extreme) return std::nullopt;
  return Extreme_length{static_cast<std::size_t>(extreme->piece() - pieces.data()),
                        extreme->length(), extreme->time()};
}

template std::vector<Rational> squared_distance(const Basic_moving_point_2<Linear_motion_2>&,
                                                const Basic_moving_point_2<Linear_motion_2>&);
template std::vector<Rational> squared_distance(const Basic_moving_point_2<Polynomial_motion_2>&,
                                                const Basic_moving_point_2<Polynomial_motion_2>&);
template std::vector<Rational> squared_distance(const Moving_image_2&, const Moving_image_2&);

}  // namespace kinetri::detail
