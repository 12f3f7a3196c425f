// SPDX-License-Identifier: GPL-3.0-or-later
//
// The differences of polynomial motions that the filter computes with, and the polynomials that
// certificates make of them: as linear_differences.h for linear motion.
#ifndef KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "bernstein.h"
#include "frame.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

using Cubic = Coefficients<3>;

inline Cubic absolute(Cubic c) {
  for (double& x : c) x = std::abs(x);
  return c;
}
inline double sum(const Cubic& c) {
  return (c[0] + c[1]) + (c[2] + c[3]);
}

// By powers of the time from `elapsed` later.
inline Cubic later(const Cubic& c, double elapsed) {
  const double c3 = elapsed * c[3];
  return {c[0] + elapsed * (c[1] + elapsed * (c[2] + c3)), c[1] + elapsed * (2 * c[2] + 3 * c3),
          c[2] + 3 * c3, c[3]};
}

// The difference of two polynomial motions: x and y.
using Cubic_difference = std::array<Cubic, 2>;

template <std::size_t N>
class Polynomial_differences : public Frame {
 public:
  // docs/MATH.md, section 9.
  static constexpr double in_circle_units = 8192;
  static constexpr double product_units = 512;
  static constexpr double coordinate_units = 128;

  Polynomial_differences(const std::array<const Polynomial_motion_2*, N>& from,
                         const Polynomial_motion_2& to, double origin) {
    for (std::size_t i = 0; i < N; ++i) {
      differences_[i] = {coordinate(*from[i], to, origin, &Vector_2::x),
                         coordinate(*from[i], to, origin, &Vector_2::y)};
    }
  }

  std::optional<double> window_ahead(double share) const {
    Cubic extent = {};
    for (const auto& [x, y] : differences_) {
      for (std::size_t k = 0; k < 4; ++k) {
        extent[k] = std::max({extent[k], std::abs(x[k]), std::abs(y[k])});
      }
    }
    const double speed = extent[1] + std::sqrt(extent[2] * extent[0]) +
                         std::cbrt(extent[3] * (extent[0] * extent[0]));
    if (extent[1] == 0 && extent[2] == 0 && extent[3] == 0) return std::nullopt;
    return share * extent[0] / speed;
  }

  void scale(double window) {
    const Cubic powers = {1, window, window * window, window * window * window};
    for (std::size_t k = 0; k < 4; ++k) {
      terms_[k] *= powers[k];
      for (auto& [x, y] : differences_) {
        x[k] *= powers[k];
        y[k] *= powers[k];
      }
    }
    const double total = sum(terms_);
    double size = 0;
    for (const auto& [x, y] : differences_) {
      size = std::max({size, sum(absolute(x)), sum(absolute(y))});
    }
    // The last term is more than the error of the coefficients.
    size += 0x1p-48 * total;
    // Outside of the range the powers of the window may have underflowed.
    const bool is_exact = window == 0 || kinetri::is_in_range(window);
    set_sizes(size, is_exact ? total : std::numeric_limits<double>::infinity());
  }

  const Cubic_difference& operator[](std::size_t i) const { return differences_[i]; }

 private:
  // One coordinate by powers of the time from the epoch.
  static Cubic by_powers(const Polynomial_motion_2& m, double Vector_2::*axis) {
    return {m.position.*axis, m.velocity.*axis, 0.5 * m.acceleration.*axis, m.jerk.*axis / 6};
  }

  Cubic coordinate(const Polynomial_motion_2& p, const Polynomial_motion_2& q, double origin,
                   double Vector_2::*axis) {
    // Times the unit roundoff, what a coefficient loses by underflow, here or in `later`.
    constexpr Cubic lost = {0x1p-1021, 0x1p-1021, 0x1p-1021, 0x1p-1021};
    const Cubic from = by_powers(p, axis);
    const Cubic to = by_powers(q, axis);
    if (p.epoch == q.epoch) {
      // Taking the difference first keeps the coordinates' common part out of the error.
      const Cubic difference = from - to;
      terms_ = terms_ + later(absolute(difference) + lost, std::abs(origin - p.epoch));
      return later(difference, origin - p.epoch);
    }
    terms_ = terms_ + later(absolute(from) + lost, std::abs(origin - p.epoch)) +
             later(absolute(to) + lost, std::abs(origin - q.epoch));
    return later(from, origin - p.epoch) - later(to, origin - q.epoch);
  }

  std::array<Cubic_difference, N> differences_;
  Cubic terms_ = {};  // the sums of all numbers that the coefficients were made from
};

inline Cubic coordinate(const Cubic_difference& d, int axis) {
  return d[static_cast<std::size_t>(axis)];
}

inline Coefficients<6> cross(const Cubic_difference& a, const Cubic_difference& b) {
  return a[0] * b[1] - a[1] * b[0];
}

inline Coefficients<6> dot(const Cubic_difference& a, const Cubic_difference& b) {
  return a[0] * b[0] + a[1] * b[1];
}

// Minus the in-circle determinant of differences to the fourth point.
inline Coefficients<12> in_circle(const Polynomial_differences<3>& d) {
  Coefficients<12> c = {};
  for (std::size_t i = 0; i < 3; ++i) {
    c = c - dot(d[i], d[i]) * cross(d[(i + 1) % 3], d[(i + 2) % 3]);
  }
  return c;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_POLYNOMIAL_DIFFERENCES_H
