// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that pass through each other: what is known of them after each step; and runs by regions
// against the plain loop: the same events, with the same numbers and exact times, and the same
// state.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_turns.h"
#include "support/contact_region_runs.h"
#include "support/multiplier.h"

namespace kinetri::passing_regions_test {
namespace {

using detail::Region_counters;
using test::change_some_points;
using test::difference_from_loop;
using test::difference_of_simulations;
using test::gas;
using test::in_square;
using test::on_lattice;
using test::options_of;

// ---- by the plain loop ----

// Many events at one time: a step executes all of them, those of discs whose edge comes at that
// time too, if nothing was in the queue before; and discs that only touch are no reason to watch
// others.
TEST(Passing_discs, on_a_grid_are_known_after_each_step) {
  for (const auto& [seed, end] :
       {std::pair(65u, Rational(1, 2)), {178u, Rational(2, 5)}, {163u, Rational(2)}}) {
    Simulation_options options;
    if (seed % 3 != 1) options.box = Box_2{-1, -1, 20, 20};
    options.radius = seed % 3 == 1 ? 1 : 2.5;
    options.response = log_contact;
    Simulation_2<Linear_kinetic_traits_2> simulation(on_lattice(5 + seed % 40, 5 + seed % 3, seed),
                                                     options);
    const Algebraic_number until(end);
    std::optional<Algebraic_number> last;
    while (simulation.step(until) > 0) {
      ASSERT_TRUE(!last || *last < simulation.current_time()) << "seed " << seed;
      last = simulation.current_time();
      ASSERT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>())
          << "seed " << seed << " at t = " << simulation.current_time();
    }
    ASSERT_EQ(last, until) << "seed " << seed;
  }
}

// ---- by regions ----

// Discs that are apart at first, and discs of which each overlaps many.
TEST(Passing_regions, let_discs_pass_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 60u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options;
    if (seed % 4 != 3) options = in_square(side);
    options.radius = std::array{1.2, 4.0, 9.0}[seed % 3];
    options.response = log_contact;
    const double apart = seed % 2 == 0 ? 2 * std::min(options.radius, 4.0) : 0;
    ASSERT_EQ(difference_from_loop(gas(n, side, apart, 10, seed), options, {0.5, 1.5},
                                   options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 3'000u);
  EXPECT_GT(sum.by_union, 3'000u);
  EXPECT_GT(sum.by_rest, 3'000u);
  EXPECT_GT(sum.undone, 100u);
}

// Many contacts at one time, at those of flips and walls too.
TEST(Passing_regions, let_discs_pass_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 90u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 5 + seed % 40;
    Simulation_options options;
    if (seed % 3 != 1) options.box = Box_2{-1, -1, 20, 20};
    options.radius = std::array{0.5, 1.0, 2.5}[seed % 3];
    options.response = log_contact;
    ASSERT_EQ(
        difference_from_loop(on_lattice(n, 5 + seed % 3, seed), options, {1.0, Rational(7, 3), 4.0},
                             options_of(1 + seed % 9, 0.2 + seed % 3), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.cuts, 50u);
  EXPECT_GT(sum.by_rest, 100u);
}

// Whole velocities, but places at random: few events at one time, so that windows are long, and
// contacts of some at one time.
TEST(Passing_regions, let_rows_of_discs_pass_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 30u * static_cast<unsigned>(test::multiplier()); ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Linear_motion_2> motions;
    for (std::size_t k = 0; k < 100; ++k) {
      // Rows in turn go to the right and to the left, all at one speed: each disc of one meets each
      // of the other, and those at whole distances do so at one time.
      const auto row = static_cast<double>(k / 10);
      const double y = 2 * row + 0.001 * static_cast<double>(random() % 100);
      motions.push_back(
          {{static_cast<double>(3 * (k % 10)), y}, {k / 10 % 2 == 0 ? 1.0 : -1.0, 0}});
    }
    Simulation_options options;
    options.radius = 1.25;
    options.response = log_contact;
    ASSERT_EQ(difference_from_loop(motions, options, {1.0, 6.0},
                                   options_of(1 + seed % 9, 0.2 + seed % 3), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 100u);
}

TEST(Passing_regions, let_accelerated_discs_pass_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 10u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 40 + 13 * (seed % 10);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::mt19937_64 random(seed);
    std::vector<Polynomial_motion_2> motions;
    for (const Linear_motion_2& motion : gas(n, side, 0, 8, seed)) {
      Polynomial_motion_2 falling;
      falling.position = motion.position;
      falling.velocity = motion.velocity;
      falling.acceleration = {static_cast<double>(random() % 16) - 8, seed % 2 == 0 ? -6.0 : 0.25};
      motions.push_back(falling);
    }
    Simulation_options options;
    if (seed % 3 != 2) options = in_square(side);
    options.radius = seed % 2 == 0 ? 2 : 7;
    options.response = log_contact;
    ASSERT_EQ(difference_from_loop<Polynomial_kinetic_traits_2>(motions, options, {0.5, 2.5},
                                                                options_of(2 + seed % 7, 0.4), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 500u);
  EXPECT_GT(sum.by_rest, 500u);
}

// Discs of different radii, some of which grow, and hide others. In a box the plain loop runs.
TEST(Passing_regions, let_discs_of_any_size_pass_as_the_loop_does) {
  Region_counters in_plane;
  Region_counters in_box;
  for (unsigned seed = 0; seed < 40u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 20);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : gas(n, side, 0, 10, seed)) {
      const double radius =
          seed % 3 == 0 && random() % 16 == 0 ? 15 : 0.5 + 0.25 * static_cast<double>(random() % 8);
      discs.push_back({motion, radius, seed % 4 == 1 ? 0.1 : 0, 0});
    }
    Simulation_options options;
    if (seed % 8 == 7) options = in_square(side);
    options.response = log_contact;
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                  discs, options, {0.5, 1.5}, options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)),
                  options.box ? in_box : in_plane),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(in_plane.by_region, 1'000u);
  EXPECT_GT(in_plane.by_union, 1'000u);
  EXPECT_EQ(in_box.windows, 0u);
}

// Discs that come, turn and go while others pass.
TEST(Passing_regions, follow_changes_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 20u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const std::size_t n = 60 + 11 * (seed % 20);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options = in_square(side);
    options.radius = seed % 2 == 0 ? 2 : 6;
    options.response = log_contact;
    const auto change = [&](Simulation_2<Linear_kinetic_traits_2>& simulation) {
      std::mt19937_64 random(seed + simulation.triangulation().next_id());
      change_some_points(simulation, side, random);
    };
    ASSERT_EQ(difference_from_loop<Linear_kinetic_traits_2>(
                  gas(n, side, 0, 6, seed), options, {0.5, 1.0, 2.0},
                  options_of(1 + seed % 20, 0.2), sum, change),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 500u);
  EXPECT_GT(sum.by_loop, 500u);
}

// Single steps, snapshots and queries after a run by regions, and a run that is stopped.
TEST(Passing_regions, leave_a_usable_simulation) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Simulation_options options = in_square(100);
    options.radius = 4;
    options.response = log_contact;
    const auto motions = gas(100, 100, 0, 6, seed);
    Simulation plain(motions, options);
    Simulation simulation(motions, options);
    auto run = detail::Contact_turns<Simulation>::run_of(simulation, options_of(2 + seed, 0.2));
    int asked = 0;
    run.advance_to(1, [&] { return ++asked < 4; });
    while (plain.current_time() < simulation.current_time()) plain.step();
    ASSERT_EQ(difference_of_simulations(plain, simulation), "");
    for (int k = 0; k < 20; ++k) ASSERT_EQ(plain.step(), simulation.step());
    ASSERT_EQ(difference_of_simulations(plain, simulation), "");
    run.advance_to(2);
    Simulation restored = Simulation::restore(simulation.snapshot(), log_contact);
    plain.advance_to(3);
    detail::Contact_turns<Simulation>::run_of(restored, options_of(3 + seed, 0.3)).advance_to(3);
    ASSERT_EQ(difference_of_simulations(plain, restored), "");
    EXPECT_TRUE(restored.is_valid(true, 1));
  }
}

// An observer that throws, before or after an event, at each of some: the simulation is what it is
// after the window.
TEST(Passing_regions, go_on_after_an_observer_has_thrown) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  struct Thrower : test::Log {
    std::uint64_t last = 0;
    bool is_after = false;

    void before_event(const Event& event) override {
      if (event.number == last && !is_after) throw std::runtime_error("enough");
    }
    void after_event(const Event& event) override {
      if (event.number == last && is_after) throw std::runtime_error("enough");
      kinds[static_cast<std::size_t>(event.kind)] = true;
    }
    std::array<bool, event_kinds> kinds = {};
  };
  std::array<std::size_t, event_kinds> thrown_at = {};
  for (unsigned seed = 0; seed < 40; ++seed) {
    Simulation_options options = in_square(100);
    options.radius = 4;
    options.response = log_contact;
    const auto motions = gas(100, 100, 0, 9, seed % 4);
    Simulation plain(motions, options);
    test::Log expected;
    plain.add_observer(expected);
    Simulation simulation(motions, options);
    Thrower thrower;
    thrower.last = 40 + seed;
    thrower.is_after = seed % 2 == 1;
    simulation.add_observer(thrower);
    auto run = detail::Contact_turns<Simulation>::run_of(simulation, options_of(1 + seed % 6, 0.5));
    EXPECT_THROW(run.advance_to(2), std::runtime_error);
    simulation.remove_observer(thrower);
    run.advance_to(3);
    plain.advance_to(3);
    ASSERT_EQ(difference_of_simulations(plain, simulation), "") << "seed " << seed;
    EXPECT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>());
    ++thrown_at[static_cast<std::size_t>(expected.events[thrower.last].kind)];
  }
  EXPECT_GT(thrown_at[static_cast<std::size_t>(Event_kind::flip)], 0u);
  EXPECT_GT(thrown_at[static_cast<std::size_t>(Event_kind::wall)], 0u);
  EXPECT_GT(thrown_at[static_cast<std::size_t>(Event_kind::collision)], 0u);
}

// Contacts at which discs keep their motions are one for each pair, so that they end: how many
// there may be at one time is not asked.
TEST(Passing_regions, have_no_limit_of_contacts_at_one_time) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  // Two columns of discs, each of which meets one of the other at the time 2.25.
  std::vector<Linear_motion_2> motions;
  for (int k = 0; k < 40; ++k) {
    motions.push_back({{0, 3.0 * k}, {1, 0}});
    motions.push_back({{5.5, 3.0 * k}, {-1, 0}});
    motions.push_back({{100 + 1.7 * k + 0.01 * k * k, 3.0 * k}, {0.3, k % 3 - 1.0}});
  }
  Simulation_options options;
  options.radius = 0.5;
  options.response = log_contact;
  options.max_contacts_per_instant = 1;
  Simulation plain(motions, options);
  test::Log expected;
  plain.add_observer(expected);
  Simulation simulation(motions, options);
  test::Log log;
  simulation.add_observer(log);
  auto run = detail::Contact_turns<Simulation>::run_of(simulation, options_of(3, 0.5));
  EXPECT_EQ(run.advance_to(4), plain.advance_to(4));
  EXPECT_EQ(test::difference(expected.events, log.events), "");
  EXPECT_GE(plain.contact_counters().most_at_one_time, 40u);
}

}  // namespace
}  // namespace kinetri::passing_regions_test
