// SPDX-License-Identifier: GPL-3.0-or-later
//
// The form of motions in checkpoint files: the name of the kind, and a list of numbers.
#ifndef KINETRI_SRC_IO_CHECKPOINT_MOTION_H
#define KINETRI_SRC_IO_CHECKPOINT_MOTION_H

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kinetri/kinetic/disc_motion_2.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "kinetri/kinetic/polynomial_motion_2.h"

namespace kinetri {

template <class Motion>
struct Checkpoint_motion;

template <>
struct Checkpoint_motion<Linear_motion_2> {
  static constexpr std::string_view name = "linear";
  static constexpr std::string_view expected = "x, y, vx, vy and epoch";

  static std::vector<double> numbers(const Linear_motion_2& motion) {
    return {motion.position.x, motion.position.y, motion.velocity.x, motion.velocity.y,
            motion.epoch};
  }

  /// None if the number of numbers is wrong.
  static std::optional<Linear_motion_2> from_numbers(std::span<const double> numbers) {
    if (numbers.size() != 5) return std::nullopt;
    return Linear_motion_2{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, numbers[4]};
  }
};

template <>
struct Checkpoint_motion<Polynomial_motion_2> {
  static constexpr std::string_view name = "polynomial";
  static constexpr std::string_view expected = "x, y, vx, vy, ax, ay, jx, jy and epoch";

  static std::vector<double> numbers(const Polynomial_motion_2& motion) {
    return {motion.position.x, motion.position.y,     motion.velocity.x,
            motion.velocity.y, motion.acceleration.x, motion.acceleration.y,
            motion.jerk.x,     motion.jerk.y,         motion.epoch};
  }

  static std::optional<Polynomial_motion_2> from_numbers(std::span<const double> n) {
    if (n.size() != 9) return std::nullopt;
    return Polynomial_motion_2{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}, n[8]};
  }
};

template <class CenterMotion>
struct Checkpoint_motion<Basic_disc_motion_2<CenterMotion>> {
  using Center = Checkpoint_motion<CenterMotion>;
  using Disc = Basic_disc_motion_2<CenterMotion>;

  static constexpr bool is_linear = std::is_same_v<CenterMotion, Linear_motion_2>;
  static constexpr std::string_view name = is_linear ? "disc" : "polynomial disc";
  static constexpr std::string_view expected =
      is_linear ? "x, y, vx, vy, epoch, radius, growth and weight"
                : "x, y, vx, vy, ax, ay, jx, jy, epoch, radius, growth and weight";

  static std::vector<double> numbers(const Disc& disc) {
    std::vector<double> result = Center::numbers(disc);
    result.insert(result.end(), {disc.radius, disc.growth, disc.weight});
    return result;
  }

  static std::optional<Disc> from_numbers(std::span<const double> n) {
    if (n.size() < 3) return std::nullopt;
    const std::size_t of_center = n.size() - 3;
    const auto center = Center::from_numbers(n.first(of_center));
    if (!center) return std::nullopt;
    return Disc{*center, n[of_center], n[of_center + 1], n[of_center + 2]};
  }
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_CHECKPOINT_MOTION_H
