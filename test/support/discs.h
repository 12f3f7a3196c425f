// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving discs for tests: random ones from fixed seeds, and their values at a rational time.
#ifndef KINETRI_TEST_SUPPORT_DISCS_H
#define KINETRI_TEST_SUPPORT_DISCS_H

#include <cmath>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/moving_point_2.h"
#include "support/motions.h"

namespace kinetri::test {

using Static_disc = Static_kernel::Weighted_point_2;

/// The radius at time `t`, by its definition.
template <class Disc>
Rational radius_at(const Disc& disc, const Rational& t) {
  return to_rational(disc.radius) + to_rational(disc.growth) * (t - to_rational(epoch_of(disc)));
}

/// The weight at time `t`, by its definition; 0 of a motion without one.
template <class Motion>
Rational weight_at(const Motion& motion, const Rational& t) {
  if constexpr (HasWeight<Motion>) {
    const Rational radius = radius_at(motion, t);
    return radius * radius + to_rational(motion.weight);
  } else {
    return 0;
  }
}

/// The weighted point at time `t`.
template <class Disc>
Static_disc disc_at(const Disc& disc, const Rational& t) {
  return {place_at(center(disc), t), weight_at(disc, t)};
}

/// Random discs: 0 ordinary, 1 of tiny integers (degenerate), 2 of wild magnitudes, 3 of far-away
/// epochs, 4 points with weights of either sign, 5 of equal radii.
class Disc_source {
 public:
  static constexpr int flavors = 6;

  explicit Disc_source(unsigned seed) : random_(seed) {}

  template <class Disc>
  Disc next(int flavor) {
    Disc disc;
    const auto number = [&] { return flavor == 1 ? small() : flavor == 2 ? wild() : real(); };
    const auto vector = [&] {
      const double x = number();
      return Vector_2{x, number()};
    };
    disc.position = vector();
    disc.velocity = vector();
    if constexpr (requires { disc.jerk; }) {
      if (random_() % 2 == 0) disc.acceleration = vector();
      if (random_() % 2 == 0) disc.jerk = vector();
    }
    if (flavor == 1 && random_() % 2 == 0) disc.epoch = small();
    if (flavor == 2) disc.epoch = wild();
    if (flavor == 3) disc.epoch = 1e6 * real();
    if (flavor == 4) {
      disc.weight = 10 * real();
    } else if (flavor == 5) {
      disc.radius = 0.1;
    } else {
      disc.radius = std::abs(number()) * (flavor == 0 ? std::exp2(real() - 10) : 1);
      if (random_() % 2 == 0) disc.growth = number();
      if (random_() % 4 == 0) disc.weight = number();
    }
    return disc;
  }

  Rational time(int flavor) {
    if (flavor == 1) return Rational(integer_(random_), 2);
    return to_rational(real()) + Rational(integer_(random_), 3);
  }

 private:
  double real() { return real_(random_); }
  double small() { return integer_(random_); }
  double wild() { return std::ldexp(real_(random_), 60 * integer_(random_)); }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> real_{-10, 10};
  std::uniform_int_distribution<int> integer_{-3, 3};
};

/// The discs, for messages.
template <class Discs>
std::string describe_discs(const Discs& discs) {
  std::ostringstream out;
  for (const auto& disc : discs) {
    out << Basic_moving_point_2<std::remove_cvref_t<decltype(disc)>>(disc) << '\n';
  }
  return out.str();
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_DISCS_H
