// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that vanish at contacts in runs by regions, against the plain loop.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "kinetri/simulation/recording.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_turns.h"
#include "support/contact_region_runs.h"
#include "support/multiplier.h"

namespace kinetri::erasure_regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::difference_of_simulations;
using test::erase_lighter;
using test::gas;
using test::in_square;
using test::options_of;

// Discs that vanish at a contact: both, or the lighter one. Among them are discs at the hull, and
// of high degree.
TEST(Erasure_regions, erase_discs_as_the_loop_does) {
  Region_counters sum;
  std::size_t erased = 0;
  for (unsigned seed = 0; seed < 60u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options;
    if (seed % 4 != 3) options = in_square(side);
    options.radius = std::array{0.5, 1.2, 2.5}[seed % 3];
    options.response = seed % 5 < 3 ? erase_both : erase_lighter;
    options.response_is_pure = true;
    for (std::size_t k = 0; k < n; ++k) {
      options.masses.push_back(1 + static_cast<double>(k % 3));
    }
    const auto motions = gas(n, side, 2 * options.radius, 10, seed);
    const auto count = [&](Simulation_2<Linear_kinetic_traits_2>& simulation) {
      erased += n - simulation.triangulation().number_of_points();
    };
    ASSERT_EQ(difference_from_loop<Linear_kinetic_traits_2>(
                  motions, options, {0.25, 0.5, 1.5},
                  options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum, count),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 3'000u);
  EXPECT_GT(sum.by_union, 3'000u);
  EXPECT_GT(sum.by_rest, 3'000u);
  EXPECT_GT(sum.undone, 100u);
  EXPECT_GT(sum.windows, 2 * sum.cuts);
  EXPECT_GT(erased, 1'000u);
}

// Discs of different radii vanish, and a few more turn than vanish.
TEST(Erasure_regions, erase_discs_of_any_size_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 40u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : gas(n, side, 4, 10, seed)) {
      const double radius = seed % 4 == 3 ? 2 : static_cast<double>(1 + random() % 100) / 50;
      discs.push_back({motion, radius, seed % 3 == 1 ? 0.1 : 0.0, 0});
    }
    Simulation_options options = in_square(side);
    options.rim_touches = seed % 2 == 0;
    options.response = seed % 3 == 0 ? erase_lighter : erase_both;
    options.response_is_pure = true;
    ASSERT_EQ(
        difference_from_loop<Disc_kinetic_traits_2>(
            discs, options, {0.5, 1.5}, options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 2'000u);
  EXPECT_GT(sum.by_rest, 2'000u);
}

// A few points of whole places and velocities among others: windows are cut after discs have
// vanished, so that these come back.
TEST(Erasure_regions, bring_erased_discs_back_where_a_window_is_cut) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 60u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 60 + seed % 60;
    const double side = 10 * std::sqrt(static_cast<double>(n));
    auto motions = gas(n, side, 5, 10, seed);
    for (std::size_t k = 0; k < n; ++k) {
      if (k % 3 != seed % 3) continue;
      auto& [position, velocity, start] = motions[k];
      position = {std::round(position.x), std::round(position.y)};
      velocity = {std::round(velocity.x), std::round(velocity.y)};
    }
    Simulation_options options = in_square(std::ceil(side));
    options.radius = 1.5;
    options.response = seed % 2 == 0 ? erase_both : erase_lighter;
    options.response_is_pure = true;
    ASSERT_EQ(difference_from_loop(motions, options, {0.5, 1.0, 2.0},
                                   options_of(1 + seed % 16, 1 + seed % 3), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.cuts, 100u);
  EXPECT_GT(sum.cut_off, 1'000u);
}

// A recorder looks at the triangulation that is there when a disc has vanished.
TEST(Erasure_regions, record_discs_that_vanish) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  Simulation_options options = in_square(100);
  options.radius = 1.5;
  options.response_is_pure = true;
  for (const auto& response : {erase_both, erase_lighter}) {
    options.response = response;
    const auto motions = gas(100, 100, 3, 6, 1);
    Simulation plain(motions, options);
    Simulation simulation(motions, options);
    Recorder<Linear_kinetic_traits_2> expected(plain.triangulation(), 2, 100'000);
    Recorder<Linear_kinetic_traits_2> recorder(simulation.triangulation(), 2, 100'000);
    plain.add_observer(expected);
    simulation.add_observer(recorder);
    plain.advance_to(2);
    detail::Contact_turns<Simulation>::run_of(simulation, options_of(5, 0.2)).advance_to(2);
    EXPECT_LT(plain.triangulation().number_of_points(), 95u);
    EXPECT_EQ(expected.recording().triangles, recorder.recording().triangles);
    EXPECT_EQ(difference_of_simulations(plain, simulation), "");
  }
}

}  // namespace
}  // namespace kinetri::erasure_regions_test
