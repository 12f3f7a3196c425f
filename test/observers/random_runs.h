// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random simulations for tests of observers.
#ifndef KINETRI_TEST_OBSERVERS_RANDOM_RUNS_H
#define KINETRI_TEST_OBSERVERS_RANDOM_RUNS_H

#include <memory>
#include <random>
#include <type_traits>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/motions.h"
#include "support/multiplier.h"

namespace kinetri::test {

/// Makes the simulation of the motions, again at each call.
template <class Motion>
auto run_of(const std::vector<Motion>& motions, const Simulation_options& options = {}) {
  using Traits = std::conditional_t<std::is_same_v<Motion, Linear_motion_2>,
                                    Linear_kinetic_traits_2, Polynomial_kinetic_traits_2>;
  return [&motions, &options] { return std::make_unique<Simulation_2<Traits>>(motions, options); };
}

/// Makes a simulation of points on a grid that come, go, turn and jump, twice as many changes as
/// points, up to `halves` half units of time after the start; several at one time.
inline auto scheduled_changes(unsigned points, unsigned halves, unsigned seed) {
  return [=] {
    auto simulation =
        std::make_unique<Simulation_2<>>(grid_motions(points, 6, 1, seed), Simulation_options());
    std::mt19937_64 random(seed);
    const auto small = [&](unsigned limit) { return static_cast<double>(random() % limit); };
    for (unsigned k = 1; k <= 2 * points; ++k) {
      const double time = (1 + small(halves)) / 2;
      Linear_motion_2 motion;
      motion.position.x = small(7) + k * 0x1p-20;
      motion.position.y = small(7);
      motion.velocity.x = small(3) - 1;
      motion.velocity.y = small(3) - 1;
      motion.epoch = time;
      const auto id = static_cast<Point_id>(random() % points);
      if (k % 3 == 0) simulation->schedule_insert(time, motion);
      if (k % 3 == 1) simulation->schedule_motion(time, id, motion);
      if (k % 6 == 2) simulation->schedule_erase(time, id);
    }
    return simulation;
  };
}

/// A point comes with the motion, goes or takes the motion.
inline void change_at_random(Simulation_2<>& simulation, const Linear_motion_2& motion,
                             std::mt19937_64& random) {
  const auto id = static_cast<Point_id>(random() % simulation.triangulation().next_id());
  if (!simulation.triangulation().contains(id) || random() % 3 == 0) {
    simulation.insert(motion);
  } else if (random() % 2 == 0) {
    simulation.erase(id);
  } else {
    simulation.set_motion(id, motion);
  }
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_OBSERVERS_RANDOM_RUNS_H
