// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/moving_point_2.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <ostream>
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

// One coordinate of a motion, scaled to an integer polynomial: a model has the least exponent of
// its terms that are not zero, if that is less than a given one, and the coordinate, times its
// `denominator`, divided by 2^exponent. Precondition of that: no term that is not zero has a lesser
// exponent.

int least_exponent_of(std::initializer_list<const Dyadic*> terms, int exponent) {
  for (const Dyadic* term : terms) {
    if (term->mantissa != 0) exponent = std::min(exponent, term->exponent);
  }
  return exponent;
}

Integer shifted(const Dyadic& term, int exponent) {
  return term.mantissa == 0 ? Integer(0) : Integer(term.mantissa << (term.exponent - exponent));
}

Dyadic product(const Dyadic& a, const Dyadic& b) {
  return {a.mantissa * b.mantissa, a.exponent + b.exponent};
}

// (position - velocity * epoch) + velocity * t, each term of it a dyadic number.
class Linear_coordinate {
 public:
  static constexpr int denominator = 1;

  Linear_coordinate(const Linear_motion_2& motion, double Vector_2::*axis)
      : Linear_coordinate(motion.position.*axis, motion.velocity.*axis, motion.epoch) {}
  Linear_coordinate(double position, double velocity, double epoch)
      : position_(dyadic(position)),
        velocity_(dyadic(velocity)),
        drift_(product(velocity_, dyadic(epoch))) {}

  int least_exponent(int exponent) const {
    return least_exponent_of({&position_, &velocity_, &drift_}, exponent);
  }
  Polynomial scaled(int exponent) const {
    return Polynomial(std::vector<Integer>{shifted(position_, exponent) - shifted(drift_, exponent),
                                           shifted(velocity_, exponent)});
  }

 private:
  Dyadic position_;
  Dyadic velocity_;
  Dyadic drift_;  // velocity * epoch
};

// 6 p + 6 v s + 3 a s^2 + j s^3 with s = t - epoch, by powers of t.
class Polynomial_coordinate {
 public:
  static constexpr int denominator = 6;

  Polynomial_coordinate(const Polynomial_motion_2& motion, double Vector_2::*axis) {
    const std::array<Dyadic, 4> derivatives = {
        dyadic(motion.position.*axis), dyadic(motion.velocity.*axis),
        dyadic(motion.acceleration.*axis), dyadic(motion.jerk.*axis)};
    const Dyadic back = dyadic(-motion.epoch);
    // Of (t - epoch)^k / k! the coefficient of t^i is (-epoch)^(k-i) / (i! (k-i)!).
    constexpr std::array<int, 4> factorials = {1, 1, 2, 6};
    for (std::size_t k = 0; k < 4; ++k) {
      Dyadic term = derivatives[k];
      for (std::size_t i = k + 1; i-- > 0;) {
        const int factor = denominator / (factorials[i] * factorials[k - i]);
        terms_[i].push_back({term.mantissa * factor, term.exponent});
        term = product(term, back);
      }
    }
  }

  int least_exponent(int exponent) const {
    for (const std::vector<Dyadic>& power : terms_) {
      for (const Dyadic& term : power) exponent = least_exponent_of({&term}, exponent);
    }
    return exponent;
  }
  Polynomial scaled(int exponent) const {
    std::vector<Integer> coefficients(terms_.size());
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      for (const Dyadic& term : terms_[i]) coefficients[i] += shifted(term, exponent);
    }
    return Polynomial(std::move(coefficients));
  }

 private:
  std::array<std::vector<Dyadic>, 4> terms_;  // by power of t
};

template <class Coordinate>
struct Coordinates {
  static constexpr int denominator = Coordinate::denominator;
  Coordinate x;
  Coordinate y;

  template <class Motion>
  explicit Coordinates(const Motion& motion) : x(motion, &Vector_2::x), y(motion, &Vector_2::y) {}

  int least_exponent(int exponent) const { return y.least_exponent(x.least_exponent(exponent)); }
  Trajectory_2 scaled(int exponent, Integer w) const {
    return {x.scaled(exponent), y.scaled(exponent), Polynomial{std::move(w)}};
  }
};

// The weight of a disc, scaled by the square of what scales the coordinates, to which `Centre`
// belongs.
template <class Centre>
struct Weighted_coordinates {
  static constexpr int denominator = Centre::denominator;
  Centre centre;
  Linear_coordinate radius;
  Dyadic weight;

  template <class Disc>
  explicit Weighted_coordinates(const Disc& disc)
      : centre(kinetri::centre(disc)),
        radius(disc.radius, disc.growth, disc.epoch),
        weight(dyadic(disc.weight)) {}

  int least_exponent(int exponent) const {
    exponent = radius.least_exponent(centre.least_exponent(exponent));
    // Twice the exponent of the result must not be above that of the weight.
    return weight.mantissa == 0 ? exponent : std::min(exponent, floor_of_half(weight.exponent));
  }
  Trajectory_2 scaled(int exponent, Integer w) const {
    const Polynomial scaled_radius = radius.scaled(exponent) * Integer(denominator);
    const Integer scaled_weight = shifted(weight, 2 * exponent) * (denominator * denominator);
    Trajectory_2 result = centre.scaled(exponent, std::move(w));
    result.weight = scaled_radius * scaled_radius + Polynomial{scaled_weight};
    return result;
  }

 private:
  static int floor_of_half(int x) { return x >= 0 ? x / 2 : -((1 - x) / 2); }
};

Coordinates<Linear_coordinate> coordinates(const Linear_motion_2& motion) {
  return Coordinates<Linear_coordinate>(motion);
}
Coordinates<Polynomial_coordinate> coordinates(const Polynomial_motion_2& motion) {
  return Coordinates<Polynomial_coordinate>(motion);
}
template <class Centre>
auto coordinates(const Basic_disc_motion_2<Centre>& disc) {
  return Weighted_coordinates<decltype(coordinates(kinetri::centre(disc)))>(disc);
}

std::ostream& operator<<(std::ostream& out, const Vector_2& v) {
  return out << '(' << v.x << ", " << v.y << ')';
}

void print(std::ostream& out, const Linear_motion_2& motion) {
  out << motion.position << " at time " << motion.epoch << ", velocity " << motion.velocity;
}

void print(std::ostream& out, const Polynomial_motion_2& motion) {
  out << motion.position << " at time " << motion.epoch << ", velocity " << motion.velocity
      << ", acceleration " << motion.acceleration << ", jerk " << motion.jerk;
}

template <class Centre>
void print(std::ostream& out, const Basic_disc_motion_2<Centre>& disc) {
  print(out, centre(disc));
  out << ", radius " << disc.radius << ", growth " << disc.growth << ", weight " << disc.weight;
}

constexpr int no_exponent = 1 << 20;  // above that of every product of binary64 numbers here

template <class Motion>
Trajectory_2 trajectory_of(const Motion& motion) {
  const auto c = coordinates(motion);
  const int exponent = std::min(0, c.least_exponent(no_exponent));
  return c.scaled(exponent, Integer(c.denominator) << -exponent);
}

}  // namespace

Trajectory_2 trajectory(const Linear_motion_2& motion) {
  return trajectory_of(motion);
}
Trajectory_2 trajectory(const Polynomial_motion_2& motion) {
  return trajectory_of(motion);
}
Trajectory_2 trajectory(const Disc_motion_2& motion) {
  return trajectory_of(motion);
}
Trajectory_2 trajectory(const Polynomial_disc_motion_2& motion) {
  return trajectory_of(motion);
}

template <class Motion>
Basic_moving_point_2<Motion>::Basic_moving_point_2(Trajectory_2 trajectory)
    : constructed_(new Trajectory_2(std::move(trajectory))) {
  KINETRI_PRECONDITION(!constructed_->w.is_zero(), "a trajectory whose denominator is zero");
}

template <class Motion>
Trajectory_2 Basic_moving_point_2<Motion>::trajectory() const {
  return has_motion() ? kinetri::trajectory(motion_) : *constructed_;
}

template <class Motion>
Exact_position_2 Basic_moving_point_2<Motion>::position(const Rational& t) const {
  const Trajectory_2 path = trajectory();
  const Rational w = path.w(t);
  KINETRI_PRECONDITION(w != 0, "the point is nowhere at this time");
  return {path.x(t) / w, path.y(t) / w};
}

template <class Motion>
Rational Basic_moving_point_2<Motion>::weight(const Rational& t) const {
  const Trajectory_2 path = trajectory();
  const Rational w = path.w(t);
  KINETRI_PRECONDITION(w != 0, "the point is nowhere at this time");
  return path.weight(t) / (w * w);
}

template <class Motion>
std::ostream& operator<<(std::ostream& out, const Basic_moving_point_2<Motion>& point) {
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "point ";
  if (point.id() != no_point) out << point.id() << ' ';
  if (point.has_motion()) {
    print(out, point.motion());
  } else {
    const Trajectory_2 path = point.trajectory();
    out << "((" << path.x << ") / (" << path.w << "), (" << path.y << ") / (" << path.w << "))";
  }
  out.precision(precision);
  return out;
}

template <std::size_t N, class Motion>
std::array<Trajectory_2, N> common_trajectories(
    const std::array<const Basic_moving_point_2<Motion>*, N>& points) {
  std::array<Trajectory_2, N> result;
  if (!std::ranges::all_of(points, &Basic_moving_point_2<Motion>::has_motion)) {
    std::ranges::transform(points, result.begin(),
                           [](const auto* point) { return point->trajectory(); });
    return result;
  }
  std::vector<decltype(coordinates(Motion()))> all;
  all.reserve(N);
  int exponent = no_exponent;
  for (const auto* point : points) {
    exponent = all.emplace_back(coordinates(point->motion())).least_exponent(exponent);
  }
  for (std::size_t i = 0; i < N; ++i) result[i] = all[i].scaled(exponent, Integer(1));
  return result;
}

#define KINETRI_INSTANTIATE(N, Motion)                                 \
  template std::array<Trajectory_2, N> common_trajectories<N, Motion>( \
      const std::array<const Basic_moving_point_2<Motion>*, N>&)
#define KINETRI_INSTANTIATE_ALL(Motion)                                                      \
  template class Basic_moving_point_2<Motion>;                                               \
  template std::ostream& operator<<(std::ostream& out, const Basic_moving_point_2<Motion>&); \
  KINETRI_INSTANTIATE(2, Motion);                                                            \
  KINETRI_INSTANTIATE(3, Motion);                                                            \
  KINETRI_INSTANTIATE(4, Motion)
KINETRI_INSTANTIATE_ALL(Linear_motion_2);
KINETRI_INSTANTIATE_ALL(Polynomial_motion_2);
KINETRI_INSTANTIATE_ALL(Disc_motion_2);
KINETRI_INSTANTIATE_ALL(Polynomial_disc_motion_2);
#undef KINETRI_INSTANTIATE_ALL
#undef KINETRI_INSTANTIATE

}  // namespace kinetri
