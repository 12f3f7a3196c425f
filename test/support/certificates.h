// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving points for which the filter's certificates are difficult.
#ifndef KINETRI_TEST_SUPPORT_CERTIFICATES_H
#define KINETRI_TEST_SUPPORT_CERTIFICATES_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri::test {

/// Four points for a certificate, of every flavor.
class Certificates {
 public:
  explicit Certificates(unsigned seed) : random_(seed) {}

  static constexpr int flavors = 9;
  static const char* name(int flavor) {
    constexpr const char* names[flavors] = {
        "random",         "tiny integers",   "nearly cocircular",
        "wild magnitude", "common velocity", "far-away epochs",
        "cancellation",   "nearly touching", "subnormal"};
    return names[flavor];
  }

  std::array<Linear_motion_2, 4> next(int flavor) {
    std::array<Linear_motion_2, 4> m;
    for (Linear_motion_2& motion : m) motion = {{real(), real()}, {real(), real()}, 0};
    switch (flavor) {
      case 0:
        break;
      case 1:
        for (auto& a : m) a = {{small(), small()}, {small(), small()}, 0};
        break;
      case 2:
        // On a circle, up to a few units in the last place, and slow.
        for (auto& a : m) {
          const double angle = real();
          const double radius = 1 + std::ldexp(small(), -50);
          a.position = {7 + radius * std::cos(angle), -5 + radius * std::sin(angle)};
          a.velocity.x *= 1e-14;
          a.velocity.y *= 1e-14;
        }
        break;
      case 3: {
        const int places = 50 * integer_(random_);
        const int speeds = 50 * integer_(random_);
        for (auto& a : m) {
          a.position = {std::ldexp(real(), places + integer_(random_)), std::ldexp(real(), places)};
          a.velocity = {std::ldexp(real(), speeds + integer_(random_)), std::ldexp(real(), speeds)};
        }
        break;
      }
      case 4: {
        const Vector_2 common = {1e6 * real(), 1e6 * real()};
        for (auto& a : m) {
          a.velocity = {common.x + std::ldexp(small(), -20), common.y + std::ldexp(small(), -20)};
        }
        break;
      }
      case 5:
        for (auto& a : m) a.epoch = 1e5 * small() + real();
        break;
      case 6: {
        // A unit square that moves fast, given at different epochs: coordinates cancel up to
        // rounding.
        const Vector_2 common = {1e6 * real(), 1e6 * real()};
        constexpr std::array<Vector_2, 4> square = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t i = 0; i < m.size(); ++i) {
          const double epoch = real();
          m[i] = {{common.x * epoch + square[i].x, common.y * epoch + square[i].y}, common, epoch};
          if (integer_(random_) > 0) m[i].velocity.x += 1e-6 * real();
        }
        break;
      }
      case 7:
        // A point moves along a tangent of a circle at rest, up to some units in the last place.
        m = {{{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {}}};
        m[3] = {{small() - 4 + real() / 32, 1 + std::ldexp(small(), -52 + 4 * integer_(random_))},
                {1, std::ldexp(small(), -40)},
                0};
        break;
      default:
        for (auto& a : m) {
          a.position = {5e-324 * std::round(1000 * real()), 5e-324 * std::round(1000 * real())};
          a.velocity = {std::ldexp(real(), -1000), std::ldexp(real(), -1040)};
        }
    }
    return m;
  }

  double time(int flavor) {
    if (flavor == 1 || flavor == 7) return small();
    return flavor == 5 ? 1e5 * real() : real();
  }

 private:
  double real() { return real_(random_); }
  double small() { return integer_(random_); }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> real_{-10, 10};
  std::uniform_int_distribution<int> integer_{-3, 3};
};

/// The linear motions with higher derivatives in proportion to velocities, of mixed degrees.
inline std::array<Polynomial_motion_2, 4> bent(const std::array<Linear_motion_2, 4>& lines,
                                               std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-1, 1);
  std::array<Polynomial_motion_2, 4> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    result[i] = polynomial_motion(lines[i]);
    const Vector_2 v = lines[(i + 1) % 4].velocity;
    const auto times = [&](double factor) { return Vector_2{v.x * factor, v.y * factor}; };
    // Keeps integers.
    const bool is_coarse = v.x == std::round(v.x) && v.y == std::round(v.y);
    const auto factor = [&] { return is_coarse ? std::round(2 * share(random)) : share(random); };
    if (random() % 3 > 0) result[i].acceleration = times(factor());
    if (random() % 3 == 0) result[i].jerk = times(factor());
  }
  return result;
}

/// The name of a test's flavor.
inline std::string flavor_name(const testing::TestParamInfo<int>& instance) {
  std::string name = Certificates::name(instance.param);
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_CERTIFICATES_H
