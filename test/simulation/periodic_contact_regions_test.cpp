// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts of discs in periodic boxes in time windows, against the sequential loop, as
// contact_regions_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/contact_region_runs.h"
#include "support/multiplier.h"

namespace kinetri::periodic_contact_regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::difference_of_simulations;
using test::gas;
using test::on_lattice;
using test::options_of;
using Traits = Periodic_kinetic_traits_2;
using Disc_traits = Periodic_disc_kinetic_traits_2;

// At rest and oblique, sheared, growing, shrinking slowly.
Periodic_box_2 box_of(const Vector_2& size, unsigned kind) {
  const double rate = size.x / 64;
  switch (kind % 4) {
    case 0:
      return {{{size.x, 0}, {0, 0}, 0}, {{size.x / 4, size.y}, {0, 0}, 0}};
    case 1:
      return {{{size.x, 0}, {0, 0}, 0}, {{0, size.y}, {16 * rate, 0}, 0}};
    case 2:
      return {{{size.x, 0}, {rate, 0}, 0}, {{0, size.y}, {0, rate}, 0}};
    default:
      return {{{size.x, 0}, {-rate, 0}, 0}, {{0, size.y}, {0, -rate}, 0}};
  }
}

template <class Motion>
const std::function<void(Simulation_2<Basic_periodic_kinetic_traits_2<Motion>>&)> no_change =
    [](auto&) {};

Simulation_options discs(double radius, Collision_response response) {
  Simulation_options options;
  options.radius = radius;
  options.response = std::move(response);
  return options;
}

TEST(Periodic_contact_regions, collide_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    const std::size_t n = 20 + 31 * (seed % 16);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    const double radius = std::array{1.2, 2.5, 4.0}[seed % 3];
    Simulation_options options =
        discs(radius, seed % 5 == 4 ? swap_velocities : collide_elastically);
    if (seed % 3 == 1) {
      for (std::size_t k = 0; k < n; ++k) {
        options.masses.push_back(1 + static_cast<double>(k % 3));
      }
    }
    ASSERT_EQ(difference_from_loop(gas(n, side, 2 * radius, 10, seed), options, {0.5, 1.5},
                                   options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum,
                                   no_change<Linear_motion_2>, Traits(box_of({side, side}, seed))),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Long windows and many small regions, and audits in between.
TEST(Periodic_contact_regions, undo_contacts_that_come_too_early) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 100 + seed % 99;
    const double side = 10 * std::sqrt(static_cast<double>(n));
    const double radius = std::array{1.5, 3.0}[seed % 2];
    std::vector<Algebraic_number> times;
    for (int k = 1; k <= 12; ++k) times.emplace_back(Rational(k, 10));
    ASSERT_EQ(
        difference_from_loop(gas(n, side, 2 * radius, 10, seed), discs(radius, collide_elastically),
                             times, options_of(16 + 16 * (seed % 4), 1.5), sum,
                             no_change<Linear_motion_2>, Traits(box_of({side, side}, seed))),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.rolled_back, 0u);
}

// Many contacts at one time, discs that touch several, and few discs: their neighbors are images of
// one disc.
TEST(Periodic_contact_regions, collide_discs_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(40u); ++seed) {
    const std::size_t n = 1 + seed % 40;
    const std::size_t columns = 2 + seed % 6;
    const std::size_t rows = n / columns + 1;
    const Vector_2 size = {2 * static_cast<double>(columns), 2 * static_cast<double>(rows)};
    const double radius = seed % 3 == 0 ? 0.75 : 0.5;
    ASSERT_EQ(
        difference_from_loop(on_lattice(n, columns, seed),
                             discs(radius, seed % 2 == 0 ? collide_elastically : swap_velocities),
                             {1.0, Rational(7, 3), 4.0}, options_of(1 + seed % 9, 0.2 + seed % 3),
                             sum, no_change<Linear_motion_2>, Traits(box_of(size, seed % 3))),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Discs of different radii, some of which grow or shrink.
TEST(Periodic_contact_regions, collide_discs_of_any_size_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t n = 20 + 23 * (seed % 16);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : gas(n, side, 8, 10, seed)) {
      const double radius = 1 + static_cast<double>(random() % 8) / 4;
      const double growth = seed % 3 == 0 ? 0 : static_cast<double>(random() % 3) / 8 - 0.125;
      motions.push_back({motion, radius, growth, 0});
    }
    ASSERT_EQ(
        difference_from_loop(motions, discs(0, collide_elastically), {0.5, 1.5},
                             options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum,
                             no_change<Disc_motion_2>, Disc_traits(box_of({side, side}, seed))),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

TEST(Periodic_contact_regions, follow_changes_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    const std::size_t n = 60 + 40 * (seed % 4);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::array<std::mt19937_64, 3> randoms;  // of the three runs, which change in turn
    for (auto& random : randoms) random.seed(seed);
    std::size_t calls = 0;
    const std::function<void(Simulation_2<Traits>&)> change =
        [&](Simulation_2<Traits>& simulation) {
          test::change_some_points(simulation, side, randoms[calls++ % 3]);
        };
    ASSERT_EQ(difference_from_loop(gas(n, side, 3, 10, seed), discs(1.5, collide_elastically),
                                   {0.5, 1.0, 1.5, 2.0}, options_of(2 + seed % 8, 0.3), sum, change,
                                   Traits(box_of({side, side}, seed))),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// A disc grows until it touches its own image, which it may not; or a response throws.
TEST(Periodic_contact_regions, throw_what_the_loop_throws) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const bool is_alone = seed < 4;
    const std::size_t n = is_alone ? 1 : 40 * seed;
    const double side = 10 * std::sqrt(static_cast<double>(n));
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : gas(n, side, 4, 8, seed)) {
      motions.push_back({motion, 2, is_alone ? 1.0 : 0.0, 0});
    }
    const Disc_traits traits(box_of({side, side}, seed));
    Simulation_options options = discs(0, collide_elastically);
    options.response_is_pure = true;
    if (!is_alone) {
      options.response = [](const Contact_2& contact) {
        if (contact.time > 1) throw std::runtime_error("a response after the time 1");
        return collide_elastically(contact);
      };
    }
    const auto error_of = [&](const auto& run) -> std::string {
      try {
        run();
      } catch (const std::exception& error) {
        return error.what();
      }
      return "none";
    };
    Simulation_2<Disc_traits> plain(motions, options, 0, traits);
    Simulation_2<Disc_traits> simulation(motions, options, 0, traits);
    const std::string expected = error_of([&] { plain.advance_to(12); });
    EXPECT_NE(expected, "none");
    EXPECT_EQ(error_of([&] {
                detail::region_run_of(simulation, options_of(1 + seed, 0.5)).advance_to(12);
              }),
              expected)
        << "seed " << seed;
    EXPECT_EQ(plain.current_time(), simulation.current_time()) << "seed " << seed;
  }
}

// So many discs that advance_to takes regions.
TEST(Periodic_contact_regions, are_taken_with_several_threads_and_many_discs) {
  constexpr double side = 2500;
  const auto motions = gas(60'000, side, 4, 10, 1);
  const Traits traits(box_of({side, side}, 1));
  const Simulation_options options = discs(2, collide_elastically);
  Simulation_2<Traits> plain(motions, options, 0, traits);
  Simulation_2<Traits> simulation(motions, options, 0, traits);
  simulation.set_threads(2);
  EXPECT_EQ(plain.advance_to(1.0), simulation.advance_to(1.0));
  EXPECT_EQ(difference_of_simulations(plain, simulation), "");
  EXPECT_NE(plain.triangulation().counters().rechecks,
            simulation.triangulation().counters().rechecks);
}

}  // namespace
}  // namespace kinetri::periodic_contact_regions_test
