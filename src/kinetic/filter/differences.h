// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences of motions, as a filter uses them, for all kinds of motion.
#ifndef KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include "image_differences.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "linear_differences.h"
#include "polynomial_differences.h"
#include "weighted_differences.h"

namespace kinetri {

inline bool is_linear(const Polynomial_motion_2& m) {
  return degree(m) == 1;
}
inline Linear_motion_2 linear(const Polynomial_motion_2& m) {
  return {m.position, m.velocity, m.epoch};
}
inline const Linear_motion_2& linear(const Linear_motion_2& m) {
  return m;
}

// Motions of which all differences are linear.
template <class Motion>
concept LinearMotion =
    std::same_as<Motion, Linear_motion_2> || std::same_as<Motion, Image_motion_2>;

// The same motions as linear ones, stored in `lines`. Precondition: all are linear.
template <std::size_t N>
std::array<const Linear_motion_2*, N> linear(
    const std::array<const Polynomial_motion_2*, N>& motions,
    std::array<Linear_motion_2, N>& lines) {
  std::array<const Linear_motion_2*, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    lines[i] = linear(*motions[i]);
    result[i] = &lines[i];
  }
  return result;
}

template <std::size_t N>
std::size_t degree(const std::array<const Polynomial_motion_2*, N>& motions) {
  std::size_t result = 1;
  for (const Polynomial_motion_2* m : motions) result = std::max(result, degree(*m));
  return result;
}

// A kind of differences: those of the motions alone.
struct Alone {
  template <class Differences, class Motion, std::size_t N>
  Differences make(const std::array<const Motion*, N>& from, const Motion& to, double origin,
                   std::size_t /*certificate*/ = 0) const {
    return Differences(from, to, origin);
  }
};

// Calls `function` with the differences of the points `from` to `to`, of the given kind and of the
// degree of the motions.
template <std::size_t N, LinearMotion Motion, class Kind, class Function>
inline auto with_differences(const std::array<const Motion*, N>& from, const Motion& to,
                             double origin, const Kind& kind, const Function& function) {
  auto d = kind.template make<Linear_differences<N, Motion>>(from, to, origin);
  return function(d);
}
template <std::size_t N, class Kind, class Function>
inline auto with_differences(const std::array<const Polynomial_motion_2*, N>& from,
                             const Polynomial_motion_2& to, double origin, const Kind& kind,
                             const Function& function) {
  const std::size_t k = std::max(degree(from), degree(to));
  if (k == 1) {
    std::array<Linear_motion_2, N> lines;
    return with_differences(linear(from, lines), linear(to), origin, kind, function);
  }
  if (k == 2) {
    auto d = kind.template make<Polynomial_differences<N, 2>>(from, to, origin);
    return function(d);
  }
  auto d = kind.template make<Polynomial_differences<N, 3>>(from, to, origin);
  return function(d);
}

// The same for points; for discs, with their weights. (Discs of equal weights are left to the
// filter of points.)
template <std::size_t N, class Motion, class Function>
inline auto with_differences(const std::array<const Motion*, N>& from, const Motion& to,
                             double origin, const Function& function) {
  if constexpr (HasWeight<Motion>) {
    return with_differences(centers(from), center(to), origin,
                            With_weights<Motion, N>{{from}, {&to}}, function);
  } else {
    return with_differences(from, to, origin, Alone(), function);
  }
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
