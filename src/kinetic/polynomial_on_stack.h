// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials of points in linear motion, in numbers on the stack.
#ifndef KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H
#define KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H

#include <array>
#include <concepts>
#include <optional>
#include <tuple>

#include "algebra/count_failure.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "scaled_coordinates.h"

namespace kinetri {

/// Whether points move along straight lines.
template <class Motion>
constexpr bool is_linear = std::same_as<Centre_motion_of<Motion>, Linear_motion_2>;

/// The polynomial that a formula of degree 4 at most in the coordinates makes from the trajectories
/// of the points; none if numbers on the stack are too narrow for it. Precondition: `is_linear`.
template <class Formula, class... Motion>
std::optional<Narrow_polynomial> polynomial_on_stack(const Formula& formula,
                                                     const Motion&... motions) {
  // So the coefficients of the formula have no more than 1024 binary digits.
  constexpr int most_bits = 250;
  std::array<Basic_trajectory_2<Narrow_polynomial>, sizeof...(Motion)> paths;
  if (!make_common_trajectories(std::array{&motions...}, most_bits, paths)) return std::nullopt;
  return std::apply(formula, paths);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H
