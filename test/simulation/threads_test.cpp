// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts that several threads schedule at the start, and execute region by region: what
// ThreadSanitizer looks at.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"

namespace kinetri::simulation_threads_test {
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

// So many discs, with walls and overlaps, that several threads have blocks of them.
TEST(Threads, start_a_simulation_as_one_does) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  constexpr std::size_t columns = 80;
  Simulation_options options;
  options.box = Box_2{0, 0, 10.0 * columns, 10.0 * columns};
  options.radius = 4;
  options.response = log_contact;
  std::vector<Linear_motion_2> motions = discs_on_grid(columns, 1);
  for (std::size_t k = 0; k < motions.size(); k += 7) motions[k].position.x -= 4.5;
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 4);
  const auto made_by = [&](int count) {
    return tbb::task_arena(count).execute([&] { return Simulation(motions, options).snapshot(); });
  };
  EXPECT_EQ(made_by(1).certificates, made_by(4).certificates);
  tbb::task_arena(4).execute([&] {
    Simulation simulation(motions, options);
    EXPECT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>());
    std::size_t overlaps = 0;
    for (Point_id id = 0; id < motions.size(); ++id) {
      overlaps += simulation.overlapping_discs(id).size();
      for (const Point_id other : simulation.overlapping_discs(id)) {
        const double x = motions[id].position.x - motions[other].position.x;
        const double y = motions[id].position.y - motions[other].position.y;
        EXPECT_LT(x * x + y * y, 64);  // both sides exact
      }
    }
    // Each disc that has been moved overlaps the one on its left, unless it is the first of a row.
    std::size_t expected = 0;
    for (std::size_t k = 0; k < motions.size(); k += 7) {
      if (k % columns != 0) expected += 2;
    }
    EXPECT_EQ(overlaps, expected);
  });
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
    auto run = detail::region_run_of(simulation, regions);
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
    EXPECT_GT(run.counters().by_region, 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kinetri::simulation_threads_test
