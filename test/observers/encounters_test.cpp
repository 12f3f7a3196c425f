// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/encounters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/simulation/tracks.h"
#include "observers/random_runs.h"
#include "support/disc_runs.h"
#include "support/encounter_oracle.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::encounters_test {
namespace {

using Recorder = test::Leg_recorder<Linear_kinetic_traits_2>;

// ---- by hand ----

TEST(Encounters, of_two_points_begin_and_end_at_the_range) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{10, 3}, {-1, 0}, 0}}, {});
  Encounters encounters(simulation, 5);
  simulation.advance_to(2.0);
  EXPECT_TRUE(encounters.encounters().empty());
  simulation.advance_to(3.0);  // at the distance 5 exactly
  EXPECT_EQ(encounters.encounters().size(), 1U);
  simulation.advance_to(100.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].begin, Algebraic_number(3.0));
  EXPECT_EQ(found[0].end, Algebraic_number(7.0));
  EXPECT_EQ(found[0].closest, Algebraic_number(5.0));
  EXPECT_EQ(found[0].distance, 3);
  EXPECT_EQ(found[0].gap, 3);
}

TEST(Encounters, may_be_one_moment) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{10, 3}, {-1, 0}, 0}}, {});
  Encounters encounters(simulation, 3);
  simulation.advance_to(100.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].begin, Algebraic_number(5.0));
  EXPECT_EQ(found[0].end, Algebraic_number(5.0));
  EXPECT_EQ(found[0].distance, 3);
}

TEST(Encounters, of_points_that_meet_at_the_range_0) {
  Simulation_2<> simulation({{{0, 0}, {1, 1}, 0}, {{6, 0}, {-1, 1}, 0}, {{50, 40}, {0, 0}, 0}}, {});
  Encounters encounters(simulation, 0);
  simulation.advance_to(100.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].begin, Algebraic_number(3.0));
  EXPECT_EQ(found[0].end, Algebraic_number(3.0));
  EXPECT_EQ(found[0].distance, 0);
}

// What ends at a time goes on if a change at that time, however late it is made, lets it.
TEST(Encounters, go_on_through_a_turn_at_the_very_end) {
  for (const bool asks : {false, true}) {
    Simulation_2<> simulation({{{0, 0}, {0, 0}, 0}, {{0, 0}, {1, 0}, 0}, {{-9, 9}, {0, 0}, 0}}, {});
    Encounters encounters(simulation, 5);
    simulation.advance_to(5.0);
    if (asks) {
      EXPECT_EQ(encounters.encounters().size(), 1U);
    }
    simulation.set_motion(1, {{5, 0}, {-1, 0}, 5});
    simulation.advance_to(6.0);
    const auto found = encounters.encounters();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].begin, Algebraic_number(0.0));
    EXPECT_EQ(found[0].end, Algebraic_number(6.0));
    EXPECT_EQ(found[0].closest, Algebraic_number(0.0));
  }
}

TEST(Encounters, refuse_what_is_no_range) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}}, {});
  for (const double range :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_PRECONDITION_ERROR(Encounters(simulation, range),
                              "the range must be a number of at least 0");
  }
}

// The sum of 0.3 twice and 0.1 is no binary64 number: the rims decide.
TEST(Encounters, of_discs_of_one_radius_are_about_gaps) {
  Simulation_2<> simulation({{{0, 0}, {0, 0}, 0}, {{8, 0}, {-1, 0}, 0}}, test::discs(0.3, nullptr));
  Encounters encounters(simulation, 0.1);
  simulation.advance_to(20.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  const Rational reach = 2 * to_rational(0.3) + to_rational(0.1);
  EXPECT_EQ(found[0].begin, Algebraic_number(Rational(8 - reach)));
  EXPECT_EQ(found[0].end, Algebraic_number(Rational(8 + reach)));
  EXPECT_EQ(found[0].distance, 0);
  EXPECT_EQ(found[0].gap, -0.6);
}

// ---- all pairs ----

// Motions on a grid, so that many points meet, touch the range exactly, and do so at one time.
std::vector<Linear_motion_2> grid_motions(std::size_t number, int size, bool is_line,
                                          std::mt19937_64& random) {
  std::uniform_int_distribution<int> place(0, size);
  std::uniform_int_distribution<int> speed(-2, 2);
  std::vector<Linear_motion_2> result;
  std::set<std::tuple<double, double, double, double>> known;
  while (result.size() < number) {
    const double x = place(random);
    const double y = is_line ? 0 : place(random);
    const double vx = speed(random);
    const double vy = is_line ? 0 : speed(random);
    if (known.emplace(x, y, vx, vy).second) result.push_back({{x, y}, {vx, vy}, 0});
  }
  return result;
}

void expect_all_encounters(const std::vector<Linear_motion_2>& motions,
                           const Simulation_options& options, double range, double until) {
  Simulation_2<> simulation(motions, options);
  Recorder recorder(simulation);
  Encounters encounters(simulation, range);
  simulation.advance_to(until / 2);
  static_cast<void>(encounters.encounters());
  simulation.advance_to(until);
  test::expect_equal(encounters.encounters(),
                     test::expected_encounters(recorder.legs(), options.radius, range));
}

TEST(Encounters, are_those_of_all_pairs_at_any_range) {
  for (const double range : {0.0, 1e-3, 1.0, 4.0, 9.0, 25.0, 1000.0}) {
    for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
      SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
      expect_all_encounters(test::random_motions(30, 40, 2, seed), {}, range, 12);
    }
  }
}

TEST(Encounters, on_a_grid_are_those_of_all_pairs) {
  std::mt19937_64 random(1);
  for (const bool is_line : {false, true}) {
    for (const double range : {0.0, 1.0, std::sqrt(2.0), 2.0, 5.0}) {
      for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
        SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed) +
                     (is_line ? ", on a line" : ""));
        const int size = seed % 2 == 0 ? 4 : 10;
        expect_all_encounters(grid_motions(14, size, is_line, random), {}, range, 5);
      }
    }
  }
}

TEST(Encounters, in_a_box_are_those_of_all_pairs) {
  for (const auto response :
       {swap_velocities, collide_elastically, log_contact, erase_both, stop_both}) {
    for (unsigned seed = 0; seed < test::cases(1u); ++seed) {
      for (const double range : {0.0, 0.5, 12.0}) {
        SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
        expect_all_encounters(test::discs_in_a_box(16, 2, seed),
                              test::discs(test::box_of(16), 1.5, response), range, 4);
      }
    }
  }
}

// Inserts, erases, turns and jumps, at times of events too, several at one time.
TEST(Encounters, of_points_that_come_turn_jump_and_leave_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    for (const double range : {0.0, 1.0, 3.0}) {
      SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
      std::mt19937_64 random(seed);
      const auto motions = grid_motions(30, 8, seed % 5 == 0, random);
      Simulation_2<> simulation({motions.begin(), motions.begin() + 10}, {});
      Recorder recorder(simulation);
      Encounters encounters(simulation, range);
      std::size_t next = 10;
      for (int step = 0; step < 24; ++step) {
        simulation.advance_to(simulation.current_time().to_double() + 0.5 * double(random() % 2));
        const auto id = static_cast<Point_id>(random() % simulation.triangulation().next_id());
        const double t = simulation.current_time().to_double();
        if (random() % 3 == 0 && next < motions.size()) {
          Linear_motion_2 motion = motions[next++];
          motion.epoch = t;
          simulation.insert(motion);
        } else if (!simulation.triangulation().contains(id)) {
          continue;
        } else if (random() % 3 == 0) {
          simulation.erase(id);
        } else if (random() % 2 == 0) {
          Linear_motion_2 motion = motions[random() % motions.size()];
          motion.epoch = t;
          simulation.set_motion(id, motion);
        } else {
          const std::vector<Point_id> ids = {id};
          const std::vector<Vector_2> velocities = {
              {double(random() % 5) - 2, seed % 5 == 0 ? 0 : double(random() % 5) - 2}};
          simulation.set_velocities(ids, velocities);
        }
      }
      const auto legs = recorder.legs();
      test::expect_equal(encounters.encounters(), test::expected_encounters(legs, 0, range));
    }
  }
}

TEST(Encounters, of_tracks_with_gaps_are_those_of_all_pairs) {
  for (const auto& [origin, fraction] : {std::pair(0.0, 0x1p-10), {0.0, 0.0}, {1e15, 0.125}}) {
    for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
      for (const double range : {0.0, 1.0, 2.5}) {
        SCOPED_TRACE("origin " + std::to_string(origin) + ", fraction " + std::to_string(fraction) +
                     ", range " + std::to_string(range) + ", seed " + std::to_string(seed));
        const test::Tracks tracks = test::random_walks(9, seed, origin, fraction);
        const auto stays = stays_of(tracks, {.from = 0, .longest_gap = 2});
        const auto simulation = simulate_tracks(tracks, stays, 0);
        Recorder recorder(*simulation);
        Encounters encounters(*simulation, range);
        simulation->advance_to(20.0);
        test::expect_equal(encounters.encounters(),
                           test::expected_encounters(recorder.legs(), 0, range));
      }
    }
  }
}

// Many pieces of one distance: the first one counts.
TEST(Encounters, of_two_that_walk_side_by_side_are_nearest_at_the_first_time) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{0, 2}, {1, 0}, 0}}, {});
  Recorder recorder(simulation);
  Encounters encounters(simulation, 3);
  for (int i = 1; i <= 200; ++i) {
    simulation.advance_to(i);
    const double speed = i % 3 - 1;
    const std::vector<Point_id> ids = {0, 1};
    const std::vector<Vector_2> velocities(2, {speed, 0});
    simulation.set_velocities(ids, velocities);
  }
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].closest, Algebraic_number(0.0));
  EXPECT_EQ(found[0].distance, 2);
  test::expect_equal(found, test::expected_encounters(recorder.legs(), 0, 3));
}

TEST(Encounters, of_points_that_accelerate_are_those_of_all_pairs) {
  std::mt19937_64 random(5);
  const auto integer = [&random](int size) {
    return double(static_cast<int>(random() % static_cast<unsigned>(2 * size + 1)) - size);
  };
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    for (const double range : {0.0, 1.0, 3.0}) {
      SCOPED_TRACE("range " + std::to_string(range) + ", seed " + std::to_string(seed));
      std::vector<Polynomial_motion_2> motions;
      for (int i = 0; i < 7; ++i) {
        const double own = i * 0x1p-8;
        motions.push_back({{integer(6), integer(6) + own},
                           {integer(3), integer(3)},
                           {integer(2), integer(2)},
                           {0, seed % 2 == 0 ? 0 : integer(2)},
                           0});
      }
      Simulation_2<Polynomial_kinetic_traits_2> simulation(motions, {});
      test::Leg_recorder<Polynomial_kinetic_traits_2> recorder(simulation);
      Encounters encounters(simulation, range);
      simulation.advance_to(2.0);
      simulation.erase(3);
      simulation.advance_to(4.0);
      test::expect_equal(encounters.encounters(),
                         test::expected_encounters(recorder.legs(), 0, range));
    }
  }
}

TEST(Encounters, of_a_triangulation_are_those_of_all_pairs) {
  const auto motions = test::random_motions(30, 40, 2, 3);
  Kinetic_delaunay_triangulation_2<> triangulation(motions.begin(), motions.end());
  test::Leg_recorder<Linear_kinetic_traits_2> recorder(triangulation, triangulation);
  Encounters encounters(triangulation, 6);
  triangulation.advance_to(3.0);
  triangulation.erase(7);
  triangulation.advance_to(9.0);
  test::expect_equal(encounters.encounters(), test::expected_encounters(recorder.legs(), 0, 6));
}

// ---- cost ----

// With a constant density the certificates for each event and encounter do not depend on n.
TEST(Encounters, ask_for_few_certificates) {
  std::vector<double> costs;
  for (const std::size_t n : {200U, 800U, 3200U}) {
    const double side = 10 * std::sqrt(double(n));
    const auto motions = test::random_motions(n, side, 5, 1);
    Simulation_2<> simulation(motions, {});
    Encounters encounters(simulation, 12.6);  // about 5 points in range
    const std::size_t events = simulation.advance_to(1.0);
    const std::size_t number = encounters.encounters().size();
    EXPECT_GT(number, 2 * n);
    const double certificates = double(encounters.certificate_counters().created);
    costs.push_back(certificates / double(events + number));
  }
  for (const double cost : costs) EXPECT_LT(cost, 4) << "certificates for an event or encounter";
  EXPECT_LT(costs.back(), 1.2 * costs.front());
}

}  // namespace
}  // namespace kinetri::encounters_test
