// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moving discs for which the filter's certificates are difficult: centers of every flavor, with
// radii and weights of every kind.
#ifndef KINETRI_TEST_SUPPORT_DISC_CERTIFICATES_H
#define KINETRI_TEST_SUPPORT_DISC_CERTIFICATES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <random>

#include "kinetic/rounded_places.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "support/certificates.h"

namespace kinetri::test {

/// Kinds of radii and weights.
enum Kind_of_radii {
  equal,
  different,
  ratios,
  growing,
  weights,
  touching,    // the first two at the start time, up to a few units in the last place
  cancelling,  // small differences of large numbers at the start time
  wild,
  kinds
};

/// Four discs for a certificate.
template <class Disc>
class Disc_certificates {
 public:
  Disc_certificates(int flavor, unsigned seed) : flavor_(flavor), centers_(seed), random_(seed) {}

  /// For certificates that start at the time t.
  std::array<Disc, 4> next(int kind, double t) {
    const auto lines = centers_.next(flavor_);
    std::array<Disc, 4> m;
    if constexpr (std::same_as<Disc, Disc_motion_2>) {
      for (std::size_t i = 0; i < 4; ++i) static_cast<Linear_motion_2&>(m[i]) = lines[i];
    } else {
      const auto curves = bent(lines, random_);
      for (std::size_t i = 0; i < 4; ++i) static_cast<Polynomial_motion_2&>(m[i]) = curves[i];
    }
    const auto size_of = [](const Vector_2& a, const Vector_2& b) {
      return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    };
    const double size = size_of(lines[0].position, lines[1].position);
    const double speed = size_of(lines[0].velocity, lines[1].velocity);
    const double common = std::abs(share_(random_));
    for (Disc& disc : m) {
      const double share = share_(random_);
      disc.radius = size * std::abs(kind == equal ? common : share);
      switch (kind) {
        case ratios:
          disc.radius *= std::exp2(20 * share_(random_));
          break;
        case growing:
          disc.growth = speed * share_(random_);
          break;
        case weights:
          disc.weight = 4 * size * size * share_(random_);
          disc.radius = random_() % 2 == 0 ? 0 : disc.radius;
          break;
        case cancelling: {
          const double elapsed = t - disc.epoch;
          disc.growth = std::ldexp(size * share_(random_) / (1 + std::abs(elapsed)), 24);
          disc.radius -= disc.growth * elapsed;
          break;
        }
        case wild:
          disc.radius = std::ldexp(disc.radius, static_cast<int>(200 * share_(random_)));
          disc.growth = std::ldexp(speed * share, static_cast<int>(100 * share_(random_)));
          disc.weight = std::ldexp(size * share, static_cast<int>(200 * share_(random_)));
          break;
        default:
          break;
      }
      if (flavor_ == 1) {  // tiny integers
        disc.radius = std::round(disc.radius);
        disc.growth = std::round(disc.growth);
        disc.weight = std::round(disc.weight);
      }
    }
    if (kind == touching) {
      const Vector_2 a = rounded_place(m[0], t);
      const Vector_2 b = rounded_place(m[1], t);
      m[0].radius = std::abs(std::hypot(a.x - b.x, a.y - b.y) - m[1].radius);
    }
    return m;
  }
  double time() { return centers_.time(flavor_); }

 private:
  int flavor_;
  Certificates centers_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> share_{-1, 1};
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_DISC_CERTIFICATES_H
