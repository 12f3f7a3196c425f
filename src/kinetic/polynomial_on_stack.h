// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials of points in linear motion with numbers on the stack.
#ifndef KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H
#define KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H

#include <concepts>
#include <optional>
#include <tuple>

#include "algebra/count_failure.h"
#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/kinetic/instant.h"
#include "length.h"
#include "scaled_coordinates.h"

namespace kinetri {

/// Whether `Given` is a linear motion, perhaps of a disc or an image, or a length.
template <class Given>
constexpr bool is_linear =
    std::same_as<Given, Length> || std::same_as<Center_motion_of<Given>, Linear_motion_2> ||
    std::same_as<Center_motion_of<Given>, Image_motion_2>;

/// The polynomial of a formula, of degree at most 4 in the coordinates, of points and lengths; none
/// if motions are not linear or the numbers have too many bits.
template <class Formula, class... Given>
std::optional<Narrow_polynomial> polynomial_on_stack(const Formula& formula,
                                                     const Given&... given) {
  if constexpr ((is_linear<Given> && ...)) {
    // Then coefficients of the formula have at most 1024 bits: lengths have two bits more, but
    // formulas with lengths have degree 2.
    constexpr int most_bits = 250;
    if (const auto all = scaled_together<Narrow_polynomial>(most_bits, given...)) {
      return std::apply(formula, *all);
    }
  }
  return std::nullopt;
}

/// The sign of that polynomial at an instant; none if there is no such polynomial or the sign is
/// not certain (count_sign).
template <class Formula, class... Given>
std::optional<Sign> sign_on_stack(const Instant& instant, const Formula& formula,
                                  const Given&... given) {
  const auto p = polynomial_on_stack(formula, given...);
  if (!p) return std::nullopt;
  const Sign side = instant.side == Time_side::before ? CGAL::NEGATIVE
                    : instant.side == Time_side::at   ? CGAL::ZERO
                                                      : CGAL::POSITIVE;
  const std::optional<Sign> known = count_sign(*p, instant.time.interval(), side);
  if (known || !instant.time.is_known_rational()) return known;
  return count_sign(*p, instant.time.rational(), side);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_POLYNOMIAL_ON_STACK_H
