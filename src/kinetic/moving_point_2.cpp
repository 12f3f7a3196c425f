// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/moving_point_2.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kinetri/base/check.h"

namespace kinetri {
namespace {

// mantissa * 2^exponent; the mantissa of zero is 0, and its exponent does not matter.
struct Dyadic {
  Integer mantissa;
  int exponent = 0;
};

Dyadic dyadic(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  constexpr int digits = 53;
  return {Integer(static_cast<long long>(std::ldexp(fraction, digits))), exponent - digits};
}

// One coordinate of a linear motion, (position - velocity * epoch) + velocity * t, each term of it
// a dyadic number.
struct Linear_coordinate {
  Dyadic position;
  Dyadic velocity;
  Dyadic drift;  // velocity * epoch

  Linear_coordinate(double p, double v, double epoch) : position(dyadic(p)), velocity(dyadic(v)) {
    const Dyadic e = dyadic(epoch);
    drift = {velocity.mantissa * e.mantissa, velocity.exponent + e.exponent};
  }

  // The least exponent of a term that is not zero, if that is less than `exponent`.
  int least_exponent(int exponent) const {
    for (const Dyadic* term : {&position, &velocity, &drift}) {
      if (term->mantissa != 0) exponent = std::min(exponent, term->exponent);
    }
    return exponent;
  }

  // The coordinate divided by 2^exponent, with integer coefficients. Precondition: no term that is
  // not zero has a lesser exponent.
  Polynomial scaled(int exponent) const {
    const auto shifted = [exponent](const Dyadic& term) {
      return term.mantissa == 0 ? Integer(0) : Integer(term.mantissa << (term.exponent - exponent));
    };
    return Polynomial(std::vector<Integer>{shifted(position) - shifted(drift), shifted(velocity)});
  }
};

struct Linear_coordinates {
  Linear_coordinate x;
  Linear_coordinate y;

  explicit Linear_coordinates(const Linear_motion_2& m)
      : x(m.position.x, m.velocity.x, m.epoch), y(m.position.y, m.velocity.y, m.epoch) {}

  int least_exponent(int exponent) const { return y.least_exponent(x.least_exponent(exponent)); }
};

constexpr int no_exponent = 1 << 20;  // above that of every binary64 number and product of two

}  // namespace

Moving_point_2::Moving_point_2(Trajectory_2 trajectory)
    : constructed_(new Trajectory_2(std::move(trajectory))) {
  KINETRI_PRECONDITION(!constructed_->w.is_zero(), "a trajectory whose denominator is zero");
}

Trajectory_2 Moving_point_2::trajectory() const {
  if (!is_linear()) return *constructed_;
  const Linear_coordinates coordinates(motion_);
  const int exponent = std::min(0, coordinates.least_exponent(no_exponent));
  return {coordinates.x.scaled(exponent), coordinates.y.scaled(exponent),
          Polynomial{Integer(1) << -exponent}};
}

Exact_position_2 Moving_point_2::position(const Rational& t) const {
  const Trajectory_2 path = trajectory();
  const Rational w = path.w(t);
  KINETRI_PRECONDITION(w != 0, "the point is nowhere at this time");
  return {path.x(t) / w, path.y(t) / w};
}

template <std::size_t N>
std::array<Trajectory_2, N> common_trajectories(
    const std::array<const Moving_point_2*, N>& points) {
  std::array<Trajectory_2, N> result;
  if (!std::ranges::all_of(points, &Moving_point_2::is_linear)) {
    std::ranges::transform(points, result.begin(),
                           [](const Moving_point_2* p) { return p->trajectory(); });
    return result;
  }
  std::vector<Linear_coordinates> coordinates;
  coordinates.reserve(N);
  int exponent = no_exponent;
  for (const Moving_point_2* point : points) {
    exponent = coordinates.emplace_back(point->motion()).least_exponent(exponent);
  }
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = {coordinates[i].x.scaled(exponent), coordinates[i].y.scaled(exponent),
                 Polynomial{Integer(1)}};
  }
  return result;
}

template std::array<Trajectory_2, 2> common_trajectories<2>(
    const std::array<const Moving_point_2*, 2>&);
template std::array<Trajectory_2, 3> common_trajectories<3>(
    const std::array<const Moving_point_2*, 3>&);
template std::array<Trajectory_2, 4> common_trajectories<4>(
    const std::array<const Moving_point_2*, 4>&);

}  // namespace kinetri
