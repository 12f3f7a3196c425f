// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving points for tests: random ones from fixed seeds, and the exact static points they are at a
// rational time.
#ifndef KINETRI_TEST_SUPPORT_MOTIONS_H
#define KINETRI_TEST_SUPPORT_MOTIONS_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost_mp.h>

#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::test {

/// Points at one time, for CGAL's static predicates.
using Static_kernel = CGAL::Simple_cartesian<Rational>;
using Static_point = Static_kernel::Point_2;

/// The place of `m` at time `t`, straight from the definition.
inline Static_point place_at(const Linear_motion_2& m, const Rational& t) {
  const Rational elapsed = t - to_rational(m.epoch);
  return {to_rational(m.position.x) + to_rational(m.velocity.x) * elapsed,
          to_rational(m.position.y) + to_rational(m.velocity.y) * elapsed};
}

/// How many times the usual number of random cases to run: KINETRI_TEST_MULTIPLIER, or 1.
inline int multiplier() {
  const char* text = std::getenv("KINETRI_TEST_MULTIPLIER");
  const int value = text == nullptr ? 1 : std::atoi(text);
  return value < 1 ? 1 : value;
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

/// n distinct trajectories with integer places in [0, size) and integer velocities in
/// [-speed, speed]: so small a choice that most instants are degenerate.
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

/// The motions as a points file has them, for failure messages.
inline std::string describe(const std::vector<Linear_motion_2>& motions) {
  std::string text = "x,y,vx,vy\n";
  for (const Linear_motion_2& m : motions) {
    for (const double number : {m.position.x, m.position.y, m.velocity.x, m.velocity.y}) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.17g,", number);
      text += buffer;
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MOTIONS_H
