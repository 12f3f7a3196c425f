// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/kinetic/linear_motion_2.h"

#include <cmath>

#include "kinetri/algebra/number_types.h"

namespace kinetri {
namespace {

// The coordinate at time 0.
Rational constant_term(double position, double velocity, double epoch) {
  return to_rational(position) - to_rational(velocity) * to_rational(epoch);
}

}  // namespace

bool is_finite(const Linear_motion_2& motion) {
  return std::isfinite(motion.position.x) && std::isfinite(motion.position.y) &&
         std::isfinite(motion.velocity.x) && std::isfinite(motion.velocity.y) &&
         std::isfinite(motion.epoch);
}

bool same_trajectory(const Linear_motion_2& a, const Linear_motion_2& b) {
  if (a.velocity != b.velocity) return false;
  if (a.epoch == b.epoch) return a.position == b.position;
  return constant_term(a.position.x, a.velocity.x, a.epoch) ==
             constant_term(b.position.x, b.velocity.x, b.epoch) &&
         constant_term(a.position.y, a.velocity.y, a.epoch) ==
             constant_term(b.position.y, b.velocity.y, b.epoch);
}

}  // namespace kinetri
