// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encounters of discs with radii of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kinetri/observers/encounters.h"
#include "kinetri/simulation/tracks.h"
#include "observers/random_runs.h"
#include "support/disc_runs.h"
#include "support/encounter_oracle.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::encounters_discs_test {
namespace {

using Disc_simulation = Simulation_2<Disc_kinetic_traits_2>;
using Recorder = test::Leg_recorder<Disc_kinetic_traits_2>;
using Discs = std::vector<Disc_motion_2>;

Disc_motion_2 disc(const Vector_2& position, const Vector_2& velocity, double radius,
                   double growth = 0) {
  return {{position, velocity, 0}, radius, growth, 0};
}

// A tiny disc between two large ones: the pair of the large ones has no edge at their encounter,
// nor a disc in range of both that the regular triangulation would lead over.
TEST(Encounters_of_discs, are_about_gaps) {
  Disc_simulation simulation({disc({-10, 0}, {1, 0}, 3), disc({10, 0}, {-1, 0}, 3),
                              disc({0, 1e-3}, {0, 0}, 1e-6), disc({0, 40}, {0, 0}, 0)},
                             {});
  Encounters encounters(simulation, 4);
  simulation.advance_to(6.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 3U);
  // At the distance 7 from the small one, but for that one's own radius and place.
  EXPECT_EQ(found[2].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[2].begin, Algebraic_number(5.0));
  EXPECT_EQ(found[2].end, Algebraic_number(6.0));
  EXPECT_EQ(found[2].closest, Algebraic_number(6.0));
  EXPECT_EQ(found[2].distance, 8);
  EXPECT_EQ(found[2].gap, 2);
}

// Enlarged by half of the range, radii that differ in the last place become the same number.
TEST(Encounters_of_discs, about_one_center_may_have_nearly_equal_radii) {
  const double radius = std::nextafter(1, 2);
  Disc_simulation simulation(
      {disc({0, 0}, {1, 0}, 1), disc({0, 0}, {1, 0}, radius), disc({20, 0}, {0, 0}, 1)}, {});
  Encounters encounters(simulation, 1e9);
  Recorder recorder(simulation);
  simulation.advance_to(1.0);
  Disc_motion_2 next = disc({0, 0}, {1, 0}, std::nextafter(radius, 2));
  simulation.insert(next);
  next.velocity.y = 1;
  simulation.set_motion(0, next);
  simulation.advance_to(2.0);
  next.velocity.y = 0;
  next.radius = 1;
  simulation.set_motion(0, next);
  simulation.advance_to(3.0);
  test::expect_equal(encounters.encounters(), test::expected_encounters(recorder.legs(), 0, 1e9));
}

TEST(Encounters_of_discs, refuse_a_range_without_finite_radii) {
  Disc_simulation simulation({disc({0, 0}, {1, 0}, 0x1.8p1023)}, {});
  EXPECT_PRECONDITION_ERROR(Encounters(simulation, 0x1.8p1023),
                            "the range is too large: the sum of a radius and half of it is not "
                            "finite; expected a smaller one");
}

// ---- all pairs ----

Discs random_discs(std::size_t number, double side, double greatest_radius, double growth,
                   std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0, side);
  std::uniform_real_distribution<double> velocity(-2, 2);
  std::uniform_real_distribution<double> share(-12, 0);
  std::uniform_real_distribution<double> rate(0, growth);
  Discs result;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = place(random);
    const double y = place(random);
    const double vx = velocity(random);
    const double vy = velocity(random);
    const double radius = greatest_radius * std::exp2(share(random));
    result.push_back(disc({x, y}, {vx, vy}, radius, growth > 0 ? rate(random) : 0));
  }
  return result;
}

void expect_all_encounters(const Discs& discs, const Simulation_options& options, double range,
                           double until) {
  Disc_simulation simulation(discs, options);
  Recorder recorder(simulation);
  Encounters encounters(simulation, range);
  simulation.advance_to(until / 2);
  static_cast<void>(encounters.encounters());
  simulation.advance_to(until);
  test::expect_equal(encounters.encounters(), test::expected_encounters(recorder.legs(), 0, range));
}

TEST(Encounters_of_discs, are_those_of_all_pairs_at_any_range) {
  for (const double range : {0.0, 1e-3, 1.0, 6.0, 500.0}) {
    for (const double growth : {0.0, 0.25}) {
      for (unsigned seed = 0; seed < test::cases(1u); ++seed) {
        SCOPED_TRACE("range " + std::to_string(range) + ", growth " + std::to_string(growth) +
                     ", seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        expect_all_encounters(random_discs(20, 40, 6, growth, random), {}, range, 8);
      }
    }
  }
}

// Small integers: touches at the range, many at one time, hidden discs, equal centers.
TEST(Encounters_of_discs, on_a_grid_are_those_of_all_pairs) {
  std::mt19937_64 random(2);
  const auto integer = [&random](int least, int greatest) {
    return double(least + static_cast<int>(random() % static_cast<unsigned>(greatest - least + 1)));
  };
  for (const double range : {0.0, 1.0, 2.0, 5.0}) {
    for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
      SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
      Discs discs;
      const bool is_line = seed % 4 == 0;
      for (int i = 0; i < 10; ++i) {
        const double x = integer(0, 8);
        const double y = is_line ? 0 : integer(0, 8);
        const double vx = integer(-2, 2);
        const double vy = is_line ? 0 : integer(-2, 2);
        const double radius = integer(0, 2);
        const double growth = seed % 2 == 0 ? 0 : integer(0, 1);
        discs.push_back(disc({x, y}, {vx, vy}, radius, growth));
      }
      expect_all_encounters(discs, {}, range, 4);
    }
  }
}

TEST(Encounters_of_discs, that_collide_come_turn_and_leave_are_those_of_all_pairs) {
  for (const auto response : {collide_elastically, log_contact, erase_both}) {
    for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
      for (const double range : {0.0, 0.5, 8.0}) {
        SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        Discs discs = random_discs(12, 30, 3, 0, random);
        Simulation_options options;
        options.box = Box_2{-5, -5, 35, 35};
        options.response = response;
        Disc_simulation simulation(discs, options);
        Recorder recorder(simulation);
        Encounters encounters(simulation, range);
        for (int step = 0; step < 12; ++step) {
          simulation.advance_to(0.5 * step);
          const auto id = static_cast<Point_id>(random() % simulation.triangulation().next_id());
          Disc_motion_2 motion = random_discs(1, 30, 3, 0, random)[0];
          motion.epoch = 0.5 * step;
          if (step % 3 == 0) {
            simulation.insert(motion);
          } else if (!simulation.triangulation().contains(id)) {
            continue;
          } else if (step % 3 == 1) {
            simulation.set_motion(id, motion);
          } else {
            simulation.erase(id);
          }
        }
        test::expect_equal(encounters.encounters(),
                           test::expected_encounters(recorder.legs(), 0, range));
      }
    }
  }
}

TEST(Encounters_of_discs, that_shrink_end) {
  Disc_simulation simulation(
      {disc({0, 0}, {0, 0}, 3, -0.5), disc({6, 0}, {0, 0}, 2, -0.25), disc({-30, 5}, {0, 0}, 1)},
      {});
  Recorder recorder(simulation);
  Encounters encounters(simulation, 2);
  simulation.advance_to(5.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].end, Algebraic_number(Rational(4, 3)));
  test::expect_equal(found, test::expected_encounters(recorder.legs(), 0, 2));
}

TEST(Encounters_of_discs, of_tracks_are_those_of_all_pairs) {
  const std::vector<double> radii = {0.25, 0.125, 1, 0, 0.5, 0.25, 0.0625, 2, 0.125, 0.25, 0};
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    for (const double range : {0.0, 1.0}) {
      SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
      const test::Tracks tracks =
          test::random_walks(radii.size(), seed, 0, seed % 2 == 0 ? 0 : 0x1p-10);
      const auto stays = stays_of(tracks, {.from = 0, .longest_gap = 2});
      const auto simulation = simulate_tracks(tracks, radii, stays, 0);
      Recorder recorder(*simulation);
      Encounters encounters(*simulation, range);
      simulation->advance_to(20.0);
      test::expect_equal(encounters.encounters(),
                         test::expected_encounters(recorder.legs(), 0, range));
    }
  }
}

TEST(Encounters_of_discs, that_accelerate_are_those_of_all_pairs) {
  using Traits = Polynomial_disc_kinetic_traits_2;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Polynomial_disc_motion_2> discs;
    for (int i = 0; i < 5; ++i) {
      Polynomial_disc_motion_2 next;
      next.position = {4 * number(random), 4 * number(random)};
      next.velocity = {number(random), number(random)};
      next.acceleration = {number(random), number(random)};
      next.radius = std::abs(number(random));
      discs.push_back(next);
    }
    Simulation_2<Traits> simulation(discs, {});
    test::Leg_recorder<Traits> recorder(simulation);
    Encounters encounters(simulation, 1);
    simulation.advance_to(3.0);
    test::expect_equal(encounters.encounters(), test::expected_encounters(recorder.legs(), 0, 1));
  }
}

}  // namespace
}  // namespace kinetri::encounters_discs_test
