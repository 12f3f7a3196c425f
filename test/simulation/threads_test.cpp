// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts that several threads execute region by region: what ThreadSanitizer looks at.
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

#include "kinetri/simulation/detail/contact_turns.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {
namespace {

// Discs in the middle of the cells of a grid, which they fill to a third or so.
std::vector<Linear_motion_2> discs_on_grid(std::size_t columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> speed(-8, 8);
  std::vector<Linear_motion_2> result;
  for (std::size_t k = 0; k < columns * columns; ++k) {
    const auto x = static_cast<double>(k % columns);
    const auto y = static_cast<double>(k / columns);
    result.push_back({{10 * x + 5, 10 * y + 5}, {speed(random), speed(random)}});
  }
  return result;
}

// In many short pieces: windows end with flips and with contacts, and their times are asked for.
TEST(Threads, execute_contacts_by_regions_as_the_loop_does) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  constexpr std::size_t columns = 30;
  for (unsigned seed = 0; seed < 3; ++seed) {
    Simulation_options options;
    options.box = Box_2{0, 0, 10.0 * columns, 10.0 * columns};
    options.radius = 3;
    options.response = collide_elastically;
    const std::vector<Linear_motion_2> motions = discs_on_grid(columns, seed);
    Simulation plain(motions, options);
    Simulation simulation(motions, options);
    detail::Region_options regions;
    regions.regions = 8;
    regions.least_events_per_vertex = 0;
    regions.threads = 4;
    auto run = detail::Contact_turns<Simulation>::run_of(simulation, regions);
    for (int k = 1; k <= 10; ++k) {
      const double time = 0.2 * k;
      ASSERT_EQ(plain.advance_to(time), run.advance_to(time));
      ASSERT_EQ(plain.triangulation().finite_edge_ids(),
                simulation.triangulation().finite_edge_ids());
      ASSERT_EQ(plain.current_time(), simulation.current_time());
      for (Point_id id = 0; id < motions.size(); ++id) {
        ASSERT_EQ(plain.triangulation().motion(id), simulation.triangulation().motion(id));
      }
    }
    EXPECT_GT(run.counters().by_region, 300u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kinetri
