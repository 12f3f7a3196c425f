// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts and walls in runs by regions, against the plain loop: the same events, with the same
// numbers and exact times, and the same state.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"
#include "support/contact_region_runs.h"
#include "support/multiplier.h"

namespace kinetri::contact_regions_test {
namespace {

using detail::Region_counters;
using test::change_some_points;
using test::difference_from_loop;
using test::difference_of_simulations;
using test::gas;
using test::in_square;
using test::on_lattice;
using test::options_of;

TEST(Contact_regions, reflect_points_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    ASSERT_EQ(difference_from_loop(gas(n, side, 0, 20, seed), in_square(side), {0.5, 2.0},
                                   options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Of few and of many discs, of equal and of other masses, with and without a box.
TEST(Contact_regions, collide_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options;
    if (seed % 4 != 3) options = in_square(side);
    options.radius = std::array{1.2, 2.5, 4.0}[seed % 3];
    options.rim_touches = seed % 4 == 0;
    options.response = seed % 5 == 4 ? swap_velocities : collide_elastically;
    if (seed % 3 == 1) {
      for (std::size_t k = 0; k < n; ++k) {
        options.masses.push_back(1 + static_cast<double>(k % 3));
      }
    }
    ASSERT_EQ(difference_from_loop(gas(n, side, 2 * options.radius, 10, seed), options, {0.5, 1.5},
                                   options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Long windows and many small regions: events come too early. Audits in between tell whether
// undoing has left each contact where it was.
TEST(Contact_regions, undo_contacts_that_come_too_early) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 100 + seed % 99;
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options = in_square(side);
    options.radius = std::array{1.5, 3.0}[seed % 2];
    options.response = collide_elastically;
    std::vector<Algebraic_number> times;
    for (int k = 1; k <= 12; ++k) times.emplace_back(Rational(k, 10));
    ASSERT_EQ(difference_from_loop(gas(n, side, 2 * options.radius, 10, seed), options, times,
                                   options_of(16 + 16 * (seed % 4), 1.5), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.rolled_back, 0u);
}

// Many contacts at one time, and discs that touch several.
TEST(Contact_regions, collide_discs_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    const std::size_t n = 5 + seed % 40;
    Simulation_options options;
    options.box = Box_2{-1, -1, 20, 20};
    options.radius = seed % 3 == 0 ? 1 : 0.5;
    options.response = seed % 2 == 0 ? collide_elastically : swap_velocities;
    ASSERT_EQ(
        difference_from_loop(on_lattice(n, 5 + seed % 3, seed), options, {1.0, Rational(7, 3), 4.0},
                             options_of(1 + seed % 9, 0.2 + seed % 3), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

TEST(Contact_regions, collide_accelerated_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 40 + 13 * (seed % 10);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::vector<Polynomial_motion_2> motions;
    for (const Linear_motion_2& motion : gas(n, side, 4, 8, seed)) {
      Polynomial_motion_2 falling;
      falling.position = motion.position;
      falling.velocity = motion.velocity;
      falling.acceleration = {0, seed % 2 == 0 ? -1.0 : 0.25};
      motions.push_back(falling);
    }
    Simulation_options options = in_square(side);
    if (seed % 3 != 2) {
      options.radius = 2;
      options.response = collide_elastically;
    }
    ASSERT_EQ(difference_from_loop<Polynomial_kinetic_traits_2>(motions, options, {0.5, 1.5},
                                                                options_of(2 + seed % 7, 0.4), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Discs of different radii, some of which grow or shrink, and discs of one radius.
TEST(Contact_regions, collide_discs_of_any_size_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    const double most = std::array{1.2, 2.5, 4.0}[seed % 3];
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : gas(n, side, 2 * most, 10, seed)) {
      const double share = static_cast<double>(1 + random() % 100) / 100;
      const double radius = seed % 7 == 6 ? most : share * most;
      double growth = 0;
      if (seed % 4 == 1) growth = 0.1;
      if (seed % 4 == 2 && random() % 8 == 0) growth = random() % 2 == 0 ? 0.2 : -radius / 4;
      discs.push_back({motion, radius, growth, 0});
    }
    Simulation_options options;
    if (seed % 4 != 3) options = in_square(side);
    options.rim_touches = seed % 8 == 0;
    options.response = seed % 5 == 4 ? swap_velocities : collide_elastically;
    ASSERT_EQ(
        difference_from_loop<Disc_kinetic_traits_2>(
            discs, options, {0.5, 1.5}, options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Few large discs among many small ones. Some are smaller than a rounding, so that a contact may
// leave their centers in others.
TEST(Contact_regions, collide_small_discs_with_large_ones_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    const std::size_t n = 40 + 10 * (seed % 20);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : gas(n, side, 6, 10, seed)) {
      const double radius = random() % 8 == 0 ? 3
                            : seed % 4 == 0 ? std::ldexp(1.0, -40 - static_cast<int>(random() % 15))
                            : random() % 4 == 0 ? 1e-3
                                                : 0.05;
      discs.push_back({motion, radius, 0, 0});
    }
    Simulation_options options = in_square(side);
    options.response = collide_elastically;
    for (std::size_t k = 0; k < n && seed % 2 == 1; ++k) {
      options.masses.push_back(discs[k].radius * discs[k].radius);
    }
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                  discs, options, {0.5, 1.0, 2.0, 3.0},
                  options_of(1 + seed * 5 % 32, 0.1 * (1 + seed % 9)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Radii, places and velocities are small integers: many contacts at one time.
TEST(Contact_regions, collide_discs_of_any_size_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    const std::size_t n = 5 + seed % 40;
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : on_lattice(n, 5 + seed % 3, seed)) {
      const double radius = std::array{0.5, 1.0, 1.5}[random() % (seed % 2 == 0 ? 2 : 3)];
      discs.push_back({motion, radius, seed % 5 == 0 ? 0.25 : 0.0, 0});
    }
    Simulation_options options;
    options.box = Box_2{-3, -3, 25, 25};
    options.response = seed % 3 == 0   ? stop_both
                       : seed % 3 == 1 ? collide_elastically
                                       : swap_velocities;
    ASSERT_EQ(
        difference_from_loop<Disc_kinetic_traits_2>(discs, options, {1.0, Rational(7, 3), 4.0},
                                                    options_of(1 + seed % 9, 0.2 + seed % 3), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Walls alone: discs overlap, and hide one another.
TEST(Contact_regions, reflect_discs_that_hide_others_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    const std::size_t n = 50 + 20 * (seed % 12);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::mt19937_64 random(seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : gas(n, side, 0, 20, seed)) {
      const double radius = random() % 8 == 0 ? 12 : 1;
      discs.push_back({motion, radius, seed % 3 == 0 ? 0.5 : 0.0, 0});
    }
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                  discs, in_square(side), {0.5, 1.5},
                  options_of(1 + seed % 12, 0.1 * (1 + seed % 5)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Discs that overlap, and that come, turn and go while regions are there.
TEST(Contact_regions, follow_changes_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    const std::size_t n = 60 + 11 * (seed % 20);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options = in_square(side);
    if (seed % 3 != 0) {
      options.radius = 2;
      options.response = collide_elastically;
    }
    const auto change = [&](Simulation_2<Linear_kinetic_traits_2>& simulation) {
      std::mt19937_64 random(seed + simulation.triangulation().next_id());
      change_some_points(simulation, side, random);
      if (seed % 4 == 1 && simulation.current_time() > 0) {  // the triangulation schedules all anew
        std::vector<Point_id> ids;
        std::vector<Vector_2> velocities;
        std::uniform_real_distribution<double> speed(-5, 5);
        for (Point_id id = 0; id < n; ++id) {
          if (!simulation.triangulation().contains(id)) continue;
          ids.push_back(id);
          velocities.push_back({speed(random), speed(random)});
        }
        simulation.set_velocities(ids, velocities);
        if (seed % 8 == 1) simulation.step();
      }
    };
    ASSERT_EQ(difference_from_loop<Linear_kinetic_traits_2>(
                  gas(n, side, 3, 6, seed), options, {0.5, 1.0, 2.0},
                  options_of(1 + seed % 20, 0.2), sum, change),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// A response that changes nothing lets discs pass: contacts for the plain loop.
TEST(Contact_regions, leave_other_responses_to_the_loop) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::size_t n = 50 + 10 * seed;
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options = in_square(side);
    options.radius = 1.5;
    options.response_is_pure = seed % 2 == 0;
    options.response = [](const Contact_2& /*contact*/) { return Contact_response_2(); };
    Region_counters counters;
    ASSERT_EQ(difference_from_loop(gas(n, side, 3, 6, seed), options, {0.5, 1.5},
                                   options_of(3, 0.2), counters),
              "")
        << "seed " << seed;
    EXPECT_EQ(counters.windows == 0, seed % 2 == 1) << "seed " << seed;
  }
}

// Both discs vanish at a contact, and no window is tried; or the lighter one, and the window is
// cut.
TEST(Contact_regions, leave_discs_that_vanish_to_the_loop) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options;
    if (seed % 4 != 3) options = in_square(side);
    options.response_is_pure = true;
    for (std::size_t k = 0; k < n; ++k) {
      options.masses.push_back(1 + static_cast<double>(k % 3));
    }
    const auto motions = gas(n, side, 3, 10, seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : motions) {
      discs.push_back({motion, 1.5 / static_cast<double>(1 + discs.size() % 4), 0, 0});
    }
    for (const auto response : {erase_both, test::erase_lighter}) {
      options.response = response;
      Region_counters counters;
      std::size_t left = n;
      const auto count = [&](auto& simulation) {
        left = std::min(left, simulation.triangulation().number_of_points());
      };
      options.radius = 1.5;
      ASSERT_EQ(
          difference_from_loop<Linear_kinetic_traits_2>(
              motions, options, {0.25, 0.5, 1.5}, options_of(1 + seed % 9, 0.2), counters, count),
          "")
          << "seed " << seed;
      options.radius = 0;
      ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                    discs, options, {0.5, 1.5}, options_of(1 + seed % 9, 0.2), counters, count),
                "")
          << "seed " << seed;
      EXPECT_LT(left, n) << "seed " << seed;
      EXPECT_EQ(counters.windows == 0, response == erase_both) << "seed " << seed;
    }
  }
}

// A response given by the user, called by several threads.
TEST(Contact_regions, call_a_response_that_is_said_to_be_pure) {
  Region_counters sum;
  Simulation_options options = in_square(100);
  options.radius = 1.5;
  options.response = [](const Contact_2& contact) {
    Contact_response_2 result = collide_elastically(contact);
    if (result.velocity_a) result.velocity_a->x /= 2;
    return result;
  };
  options.response_is_pure = true;
  ASSERT_EQ(
      difference_from_loop(gas(100, 100, 3, 6, 1), options, {1.0, 2.0}, options_of(5, 0.2), sum),
      "");
  EXPECT_GT(sum.by_region, 0u);
}

// An error of a response comes where the plain loop has it.
TEST(Contact_regions, throw_what_the_loop_throws) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  Simulation_options options = in_square(100);
  options.radius = 1.5;
  options.response = [](const Contact_2& contact) {
    if (contact.time > 1) throw std::runtime_error("late");
    return collide_elastically(contact);
  };
  options.response_is_pure = true;
  const auto motions = gas(100, 100, 3, 6, 2);
  Simulation plain(motions, options);
  Simulation simulation(motions, options);
  auto run = detail::region_run_of(simulation, options_of(5, 0.2));
  EXPECT_THROW(plain.advance_to(2), std::runtime_error);
  EXPECT_THROW(run.advance_to(2), std::runtime_error);
  EXPECT_EQ(plain.current_time(), simulation.current_time());
  EXPECT_EQ(plain.triangulation().counters().number_of_events(),
            simulation.triangulation().counters().number_of_events());
  EXPECT_EQ(plain.triangulation().finite_edge_ids(), simulation.triangulation().finite_edge_ids());
}

// Single steps, snapshots and queries after a run by regions, and a run that is stopped.
TEST(Contact_regions, leave_a_usable_simulation) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  for (unsigned seed = 0; seed < 10; ++seed) {
    Simulation_options options = in_square(100);
    options.radius = 2;
    options.response = collide_elastically;
    const auto motions = gas(100, 100, 4, 6, seed);
    Simulation plain(motions, options);
    Simulation simulation(motions, options);
    auto run = detail::region_run_of(simulation, options_of(2 + seed, 0.2));
    int asked = 0;
    run.advance_to(1, [&] { return ++asked < 4; });
    while (plain.current_time() < simulation.current_time()) plain.step();
    ASSERT_EQ(difference_of_simulations(plain, simulation), "");
    for (int k = 0; k < 20; ++k) ASSERT_EQ(plain.step(), simulation.step());
    ASSERT_EQ(difference_of_simulations(plain, simulation), "");
    run.advance_to(2);
    const auto snapshot = simulation.snapshot();
    Simulation restored = Simulation::restore(snapshot, collide_elastically);
    plain.advance_to(3);
    detail::region_run_of(restored, options_of(3 + seed, 0.3)).advance_to(3);
    ASSERT_EQ(difference_of_simulations(plain, restored), "");
    EXPECT_TRUE(restored.is_valid(true, 1));
  }
}

// An observer that throws: the simulation is what it is after the window. (Not after an event that
// the plain loop executes; there is none here.)
TEST(Contact_regions, go_on_after_an_observer_has_thrown) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  struct Thrower : test::Log {
    void before_event(const Event& event) override {
      if (event.number == 40) throw std::runtime_error("enough");
      test::Log::before_event(event);
    }
  };
  for (const unsigned seed : {0u, 1u, 2u, 4u, 5u, 6u}) {
    Simulation_options options = in_square(100);
    options.radius = 2;
    options.response = collide_elastically;
    const auto motions = gas(100, 100, 4, 9, seed);
    Simulation plain(motions, options);
    Simulation simulation(motions, options);
    Thrower thrower;
    simulation.add_observer(thrower);
    auto run = detail::region_run_of(simulation, options_of(1 + seed, 0.5));
    EXPECT_THROW(run.advance_to(2), std::runtime_error);
    simulation.remove_observer(thrower);
    run.advance_to(3);
    plain.advance_to(3);
    ASSERT_EQ(difference_of_simulations(plain, simulation), "");
    const Audit_report report = simulation.audit(Audit_level::certificates);
    EXPECT_TRUE(report.failures.empty());
  }
}

}  // namespace
}  // namespace kinetri::contact_regions_test
