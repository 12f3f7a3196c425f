// SPDX-License-Identifier: GPL-3.0-or-later
//
// The differences that a filter computes with, for either motion.
#ifndef KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
#define KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H

#include <algorithm>
#include <array>
#include <cstddef>

#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"
#include "linear_differences.h"
#include "polynomial_differences.h"

namespace kinetri {

inline bool is_linear(const Polynomial_motion_2& m) {
  constexpr Vector_2 zero = {};
  return m.acceleration == zero && m.jerk == zero;
}
inline Linear_motion_2 linear(const Polynomial_motion_2& m) {
  return {m.position, m.velocity, m.epoch};
}

// What `function` makes of the differences of the points `from` to `to`: those of linear motion,
// where all points are linear.
template <std::size_t N, class Function>
inline auto with_differences(const std::array<const Linear_motion_2*, N>& from,
                             const Linear_motion_2& to, double origin, const Function& function) {
  Linear_differences<N> d(from, to, origin);
  return function(d);
}
template <std::size_t N, class Function>
inline auto with_differences(const std::array<const Polynomial_motion_2*, N>& from,
                             const Polynomial_motion_2& to, double origin,
                             const Function& function) {
  if (is_linear(to) && std::ranges::all_of(from, [](const auto* p) { return is_linear(*p); })) {
    std::array<Linear_motion_2, N> lines;
    std::array<const Linear_motion_2*, N> pointers;
    for (std::size_t i = 0; i < N; ++i) {
      lines[i] = linear(*from[i]);
      pointers[i] = &lines[i];
    }
    return with_differences(pointers, linear(to), origin, function);
  }
  Polynomial_differences<N> d(from, to, origin);
  return function(d);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_DIFFERENCES_H
