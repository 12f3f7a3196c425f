// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences of centers with differences of weights, which are quadratic in time. docs/MATH.md,
// section 7, "Weights", derives the errors.
#ifndef KINETRI_SRC_KINETIC_FILTER_WEIGHTED_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_WEIGHTED_DIFFERENCES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "coordinate_pair.h"
#include "error_bounds.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "linear_differences.h"
#include "polynomial_differences.h"

namespace kinetri {

// Whether all discs have the same weight at every time because their numbers are equal and radii
// constant. (`have_equal_weights` decides it for any two, at more cost.) Without branches, which
// would cost more than the comparisons.
template <class Disc>
inline bool have_same_weight_numbers(const Disc& p, const Disc& q) {
  return (p.radius == q.radius) & (p.weight == q.weight) & (p.growth == 0) & (q.growth == 0);
}
template <class Disc, std::size_t N>
inline bool have_same_weight_numbers(const std::array<const Disc*, N>& discs) {
  bool result = discs[0]->growth == 0;
  for (std::size_t i = 1; i < N; ++i) {
    result &= have_same_weight_numbers(*discs[i], *discs[0]);
  }
  return result;
}

template <class Center, std::size_t N>
inline std::array<const Center*, N> centers(
    const std::array<const Basic_disc_motion_2<Center>*, N>& discs) {
  std::array<const Center*, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = discs[i];
  return result;
}

// constant + slope * (time - origin); `terms` is the sum of the magnitudes of the numbers that the
// constant was computed from.
struct Linear_function {
  double constant = 0;
  double slope = 0;
  double terms = 0;
};

// The radius of p from the origin on.
template <class Disc>
inline Linear_function radius_from(const Disc& p, double origin) {
  const double grown = p.growth * (origin - epoch_of(p));
  return {p.radius + grown, p.growth, std::abs(p.radius) + std::abs(grown)};
}

inline Linear_function operator+(const Linear_function& a, const Linear_function& b) {
  return {a.constant + b.constant, a.slope + b.slope, a.terms + b.terms};
}

// The difference of two radii. If the epochs are equal, their common part is not in the error.
template <class Disc>
inline Linear_function difference_of_radii(const Disc& p, const Disc& q, double origin) {
  const double slope = p.growth - q.growth;
  const double constant = p.radius - q.radius;
  if (epoch_of(p) == epoch_of(q)) {
    const double grown = slope * (origin - epoch_of(q));
    return {constant + grown, slope, std::abs(constant) + std::abs(grown)};
  }
  const double grown_p = p.growth * (origin - epoch_of(p));
  const double grown_q = q.growth * (origin - epoch_of(q));
  return {constant + (grown_p - grown_q), slope,
          std::abs(constant) + std::abs(grown_p) + std::abs(grown_q)};
}

// Whether the difference of two weights may change with time. Decided by the given numbers: what is
// computed may have been rounded to zero.
template <class Disc>
inline bool may_weights_change(const Disc& p, const Disc& q) {
  return p.growth != q.growth ||
         (p.growth != 0 && (p.radius != q.radius || epoch_of(p) != epoch_of(q)));
}

inline const Pair& place(const Difference& d) {
  return d.place;
}
template <std::size_t M>
inline const Pair& place(const std::array<Pair, M>& powers) {
  return powers[0];
}

// The window for the sum of two rates of change, each 1 / window. None is an infinite window.
inline std::optional<double> shorter(const std::optional<double>& one,
                                     const std::optional<double>& other) {
  if (!one) return other;
  if (!other) return one;
  return 1 / (1 / *one + 1 / *other);
}

// The differences of N discs to one more, and of their weights; in powers of w once they are
// scaled.
template <class Differences, std::size_t N>
class Weighted_differences : public Differences {
 public:
  template <class Center, class Disc>
  Weighted_differences(const std::array<const Center*, N>& centers, const Center& center_of_to,
                       const std::array<const Disc*, N>& from, const Disc& to, double origin)
      : Differences(centers, center_of_to, origin) {
    const Linear_function radius = radius_from(to, origin);
    for (std::size_t i = 0; i < N; ++i) {
      factors_[i] = {difference_of_radii(*from[i], to, origin),
                     radius_from(*from[i], origin) + radius, from[i]->weight - to.weight};
      may_weights_change_ = may_weights_change_ || may_weights_change(*from[i], to);
    }
  }

  // As for the centers alone, but lifts change with the weights too. The extent includes the root
  // of the weights, so that windows grow if weights grow without bound.
  std::optional<double> window_ahead(double share) const {
    double extent = 0;
    double weight = 0;
    double slope = 0;
    double curvature = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const auto& [difference, sum, rest] = factors_[i];
      weight = std::max(weight, std::abs(difference.constant * sum.constant + rest));
      extent = std::max(extent, greatest(absolute(place((*this)[i]))));
      slope = std::max(slope,
                       std::abs(difference.constant * sum.slope + difference.slope * sum.constant));
      curvature = std::max(curvature, std::abs(difference.slope * sum.slope));
    }
    std::optional<double> until;
    // If both are zero, the window is not finite, and once scaled the sizes are out of range.
    if (may_weights_change_) {
      extent = std::max(extent, std::sqrt(weight));
      until = share * extent / (0.5 * slope / extent + std::sqrt(curvature));
    }
    return shorter(Differences::window_ahead(share), until);
  }

  void scale(double window) {
    Differences::scale(window);
    double reach = 0;  // a sum, since it keeps values that are not finite
    for (std::size_t i = 0; i < N; ++i) {
      auto& [difference, sum, rest] = factors_[i];
      difference.slope *= window;
      sum.slope *= window;
      weights_[i] = {difference.constant * sum.constant + rest,
                     difference.constant * sum.slope + difference.slope * sum.constant,
                     difference.slope * sum.slope};
      const double greatest_difference = difference.terms + std::abs(difference.slope);
      const double greatest_sum = sum.terms + std::abs(sum.slope);
      weight_size_ = std::max(weight_size_, greatest_difference * greatest_sum + std::abs(rest));
      reach += greatest_difference + greatest_sum;
    }
    is_in_range_ = reach < greatest_size && weight_size_ < greatest_size * greatest_size;
  }

  // The weight of point i minus that of the last point.
  const std::array<double, 3>& weight(std::size_t i) const { return weights_[i]; }

  // Bounds the sum of the magnitudes of the coefficients of each such difference.
  double weight_size() const { return weight_size_; }
  double lift_size() const { return Differences::lift_size() + weight_size_; }
  bool is_in_range() const { return is_in_range_ && Differences::is_in_range(); }

 private:
  // The difference of two weights is difference * sum + rest.
  struct Factors {
    Linear_function difference;
    Linear_function sum;
    double rest;
  };
  std::array<Factors, N> factors_;
  std::array<std::array<double, 3>, N> weights_;
  double weight_size_ = 0;
  bool may_weights_change_ = false;
  bool is_in_range_ = false;
};

// The kind of differences (differences.h) of discs with weights: for each certificate the discs
// `from` and the disc `to`.
template <class Disc, std::size_t N, std::size_t Certificates = 1>
struct With_weights {
  template <class Differences, class Center>
  auto make(const std::array<const Center*, N>& centers, const Center& center_of_to, double origin,
            std::size_t certificate = 0) const {
    return Weighted_differences<Differences, N>(centers, center_of_to, from[certificate],
                                                *to[certificate], origin);
  }

  std::array<std::array<const Disc*, N>, Certificates> from;
  std::array<const Disc*, Certificates> to;
};

// Point i relative to the corner, lifted by the squared length less the weight.
template <class Differences>
inline auto lifted(const Differences& d, std::size_t i) {
  auto result = lifted(d[i]);
  if constexpr (requires { d.weight(i); }) {
    for (std::size_t k = 0; k < 3; ++k) result.lift[k] -= d.weight(i)[k];
  }
  return result;
}
// The same for two points, in the lanes of a Pair.
template <class Differences>
inline auto lifted(const Differences& d, std::size_t i, const Differences& e, std::size_t j) {
  auto result = lifted(d[i], e[j]);
  if constexpr (requires { d.weight(i); }) {
    for (std::size_t k = 0; k < 3; ++k) result.lift[k] -= Pair{d.weight(i)[k], e.weight(j)[k]};
  }
  return result;
}

// Minus the in-circle determinant of differences to the fourth point.
template <class Differences>
inline auto in_circle(const Differences& d) {
  return in_circle_coefficients(Triangle{lifted(d, 1), lifted(d, 0)}, lifted(d, 2));
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_WEIGHTED_DIFFERENCES_H
