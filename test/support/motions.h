// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving points for tests: random ones from fixed seeds, and their exact positions at a rational
// time.
#ifndef KINETRI_TEST_SUPPORT_MOTIONS_H
#define KINETRI_TEST_SUPPORT_MOTIONS_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost_mp.h>

#include <algorithm>
#include <concepts>
#include <cstdio>
#include <initializer_list>
#include <random>
#include <ranges>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "support/multiplier.h"

namespace kinetri::test {

/// Points at one time, for CGAL's static predicates.
using Static_kernel = CGAL::Simple_cartesian<Rational>;
using Static_point = Static_kernel::Point_2;

/// The position of `m` at time `t`, by its definition.
inline Static_point place_at(const Linear_motion_2& m, const Rational& t) {
  const Rational elapsed = t - to_rational(m.epoch);
  return {to_rational(m.position.x) + to_rational(m.velocity.x) * elapsed,
          to_rational(m.position.y) + to_rational(m.velocity.y) * elapsed};
}

inline Static_point place_at(const Polynomial_motion_2& m, const Rational& t) {
  const Rational s = t - to_rational(m.epoch);
  const auto coordinate = [&](double Vector_2::*axis) {
    return Rational(to_rational(m.position.*axis) + to_rational(m.velocity.*axis) * s +
                    to_rational(m.acceleration.*axis) * s * s / 2 +
                    to_rational(m.jerk.*axis) * s * s * s / 6);
  };
  return {coordinate(&Vector_2::x), coordinate(&Vector_2::y)};
}

inline Rational squared_distance(const Linear_motion_2& p, const Linear_motion_2& q,
                                 const Rational& t) {
  return (place_at(p, t) - place_at(q, t)).squared_length();
}

/// The time in [from, to] at which two points are closest; `from` if their distance is constant.
inline Rational time_of_least_distance(const Linear_motion_2& p, const Linear_motion_2& q,
                                       const Rational& from, const Rational& to) {
  // The parabola through the squared distances at three times.
  const Rational d0 = squared_distance(p, q, 0);
  const Rational d1 = squared_distance(p, q, 1);
  const Rational a = (squared_distance(p, q, 2) - 2 * d1 + d0) / 2;
  const Rational b = d1 - d0 - a;
  return a == 0 ? from : std::clamp(Rational(-b / (2 * a)), from, to);
}

/// n points in a square of side `side`, velocity components in [-speed, speed].
inline std::vector<Linear_motion_2> random_motions(std::size_t n, double side, double speed,
                                                   unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, side);
  std::uniform_real_distribution<double> velocity(-speed, speed);
  std::vector<Linear_motion_2> motions(n);
  for (Linear_motion_2& m : motions) {
    m.position = {place(random), place(random)};
    m.velocity = {velocity(random), velocity(random)};
  }
  return motions;
}

/// n distinct trajectories with integer positions in [0, size) and integer velocities in [-speed,
/// speed]. If these ranges are small, most instants are degenerate.
inline std::vector<Linear_motion_2> grid_motions(std::size_t n, int size, int speed,
                                                 unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, size - 1);
  std::uniform_int_distribution<int> velocity(-speed, speed);
  std::set<std::tuple<int, int, int, int>> chosen;
  std::vector<Linear_motion_2> motions;
  while (motions.size() < n) {
    const int x = place(random);
    const int y = place(random);
    const int vx = velocity(random);
    const int vy = velocity(random);
    if (!chosen.insert({x, y, vx, vy}).second) continue;
    motions.push_back({{double(x), double(y)}, {double(vx), double(vy)}, 0});
  }
  return motions;
}

/// n trajectories through the nine positions of a grid of 3 x 3 at time 0, half of them at rest; a
/// third of the points have the trajectory of another one, perhaps in another representation.
inline std::vector<Linear_motion_2> coincident_motions(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto whole = [&](int lowest, int highest) {
    return static_cast<double>(std::uniform_int_distribution<int>(lowest, highest)(random));
  };
  std::vector<Linear_motion_2> motions;
  for (std::size_t k = 0; k < n; ++k) {
    Linear_motion_2 m;
    if (k > 0 && random() % 3 == 0) {
      m = motions[random() % k];
    } else {
      const bool is_moving = random() % 2 == 0;
      m.position.x = whole(0, 2);
      m.position.y = whole(0, 2);
      m.velocity.x = is_moving ? whole(-1, 1) : 0;
      m.velocity.y = is_moving ? whole(-1, 1) : 0;
    }
    const double later = whole(-1, 1);
    m.epoch += later;
    m.position.x += later * m.velocity.x;
    m.position.y += later * m.velocity.y;
    motions.push_back(m);
  }
  return motions;
}

/// n distinct trajectories of degrees up to `degree`, with small integer positions and derivatives.
inline std::vector<Polynomial_motion_2> polynomial_grid_motions(std::size_t n, int size, int speed,
                                                                int degree, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, size - 1);
  std::uniform_int_distribution<int> derivative(-speed, speed);
  std::vector<Polynomial_motion_2> motions;
  const auto vector = [&](int power) {
    if (power > degree || random() % 3 == 0) return Vector_2{};
    const double x = derivative(random);
    const double y = derivative(random);
    return Vector_2{x, y};
  };
  while (motions.size() < n) {
    Polynomial_motion_2 m;
    m.position.x = place(random);
    m.position.y = place(random);
    m.velocity = vector(1);
    m.acceleration = vector(2);
    m.jerk = vector(3);
    m.epoch = random() % 4 == 0 ? derivative(random) : 0;
    const auto is_same = [&](const Polynomial_motion_2& other) {
      return same_trajectory(m, other);
    };
    if (std::ranges::none_of(motions, is_same)) motions.push_back(m);
  }
  return motions;
}

/// n points in a square of side `side`, the components of their derivatives in [-speed, speed].
inline std::vector<Polynomial_motion_2> random_polynomial_motions(std::size_t n, double side,
                                                                  double speed, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, side);
  std::uniform_real_distribution<double> derivative(-speed, speed);
  std::vector<Polynomial_motion_2> motions(n);
  for (Polynomial_motion_2& m : motions) {
    m.position = {place(random), place(random)};
    m.velocity = {derivative(random), derivative(random)};
    if (random() % 4 == 0) continue;
    m.acceleration = {derivative(random), derivative(random)};
    if (random() % 2 == 0) m.jerk = {derivative(random), derivative(random)};
  }
  return motions;
}

/// Appends a row of a points file.
inline void append_row(std::string& text, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g,", number);
    text += buffer;
  }
  text.back() = '\n';
}

/// The motions as a points file, for failure messages.
template <class Range>
requires std::same_as<std::ranges::range_value_t<Range>, Polynomial_motion_2> std::string describe(
    const Range& motions) {
  std::string text = "x,y,vx,vy,ax,ay,jx,jy,epoch\n";
  for (const Polynomial_motion_2& m : motions) {
    append_row(text, {m.position.x, m.position.y, m.velocity.x, m.velocity.y, m.acceleration.x,
                      m.acceleration.y, m.jerk.x, m.jerk.y, m.epoch});
  }
  return text;
}
inline std::string describe(const std::vector<Linear_motion_2>& motions) {
  std::string text = "x,y,vx,vy\n";
  for (const Linear_motion_2& m : motions) {
    append_row(text, {m.position.x, m.position.y, m.velocity.x, m.velocity.y});
  }
  return text;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MOTIONS_H
