// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/neighbor_lives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "observers/random_runs.h"
#include "observers/stepped_run.h"
#include "support/brute_force_simulator.h"
#include "support/precondition_error.h"

namespace kinetri::neighbor_lives_test {
namespace {

using test::expect_same;
using test::number_of_short;
using test::Stepped_run;

// Points 0 and 1 rest at (-1, 0) and (1, 0); 2 and 3, at (0, -h) and (0, h), come nearer to each
// other and turn back at t = 1.5: h = 2 - t, and then h = t - 1. While h < 1 the latter two are
// neighbors, with a ridge of length 1 - h^2, which is 3/4 at most.
std::vector<Linear_motion_2> cross() {
  return {{{-1, 0}, {}, 0}, {{1, 0}, {}, 0}, {{0, -2}, {0, 1}, 0}, {{0, 2}, {0, -1}, 0}};
}

void run_cross(Simulation_2<>& simulation) {
  simulation.schedule_motion(1.5, 2, {{0, -0.5}, {0, -1}, 1.5});
  simulation.schedule_motion(1.5, 3, {{0, 0.5}, {0, 1}, 1.5});
  simulation.advance_to(3.0);
}

TEST(Neighbor_lives, of_an_exchange_that_is_undone) {
  Simulation_2<> simulation(cross(), {});
  Neighbor_lives lives(simulation);
  run_cross(simulation);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 7u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(found[i].begin, Algebraic_number(0.0));
    EXPECT_EQ(found[i].begins_by, Life_limit::run);
  }
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].end, Algebraic_number(1.0));
  EXPECT_EQ(found[0].ends_by, Life_limit::exchange);
  EXPECT_EQ(found[1].end, Algebraic_number(3.0));
  EXPECT_EQ(found[1].ends_by, Life_limit::run);
  EXPECT_EQ(found[5].points, (Edge_ids{2, 3}));
  EXPECT_EQ(found[5].begin, Algebraic_number(1.0));
  EXPECT_EQ(found[5].end, Algebraic_number(2.0));
  EXPECT_EQ(found[6].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[6].begin, Algebraic_number(2.0));
  EXPECT_EQ(number_of_short(found), 0u);
  for (const Point_exchanges& point : lives.exchanges()) {
    EXPECT_EQ(point.gained, 1u);
    EXPECT_EQ(point.lost, 1u);
    EXPECT_EQ(point.short_ones, 0u);
    EXPECT_EQ(point.until, Algebraic_number(3.0));
  }
}

TEST(Neighbor_lives, are_short_below_the_threshold_exactly) {
  for (const double threshold : {0.75, std::nextafter(0.75, 1.0)}) {
    const bool is_short = threshold > 0.75;
    Simulation_2<> simulation(cross(), {});
    Neighbor_lives lives(simulation, threshold);
    run_cross(simulation);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found[i].is_short, is_short && i == 5) << i;
    for (const Point_exchanges& point : lives.exchanges()) {
      EXPECT_EQ(point.gained + point.lost, 2u);
      EXPECT_EQ(point.short_ones, is_short ? 2u : 0u);
    }
  }
}

// Points 0 and 1 pass through each other between 2 and 3, which rest: the length of their ridge is
// 3 minus a third of (2 - t)^2, and 3 at the time at which they meet.
TEST(Neighbor_lives, of_points_that_meet_have_the_limit_of_the_ridge_then) {
  for (const double threshold : {3.0, std::nextafter(3.0, 4.0)}) {
    const bool is_short = threshold > 3;
    Simulation_2<> simulation(
        {{{-2, 0}, {1, 0}, 0}, {{2, 0}, {-1, 0}, 0}, {{0, 3}, {}, 0}, {{0, -3}, {}, 0}}, {});
    Neighbor_lives lives(simulation, threshold);
    simulation.advance_to(4.0);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 5u);
    for (const Neighbor_life& life : found) {
      EXPECT_EQ(life.begin, Algebraic_number(0.0));
      EXPECT_EQ(life.end, Algebraic_number(4.0));
      EXPECT_EQ(life.is_short, is_short && life.points == (Edge_ids{0, 1}));
    }
  }
}

// Points 0, 1 and 2 meet at t = 2 in the middle of the triangle of 3, 4 and 5, and part again,
// turned by half a turn: while all ridges that end are shorter than 100, none of those lives is
// long.
TEST(Neighbor_lives, of_three_points_that_meet_are_short) {
  Simulation_2<> simulation({{{2, 0}, {-1, 0}, 0},
                             {{-2, 2}, {1, -1}, 0},
                             {{-2, -2}, {1, 1}, 0},
                             {{-8, 0}, {}, 0},
                             {{8, 9}, {}, 0},
                             {{8, -9}, {}, 0}},
                            {});
  Neighbor_lives lives(simulation, 100);
  Stepped_run run(simulation);
  run.step_to(4.0);
  const auto found = lives.lives();
  expect_same(found, run.lives(100));
  const auto is_at_the_rim = [](const Neighbor_life& life) { return life.points[0] >= 3; };
  EXPECT_EQ(std::ranges::count_if(found, is_at_the_rim), 3);
  for (const Neighbor_life& life : found) EXPECT_EQ(life.is_short, !is_at_the_rim(life));
  std::size_t exchanges = 0;
  for (const Point_exchanges& point : lives.exchanges()) {
    EXPECT_EQ(point.short_ones, point.gained + point.lost);
    exchanges += point.gained + point.lost;
  }
  EXPECT_GT(exchanges, 0u);
}

// Points 0 and 3 pass through each other at t = 2: 3 leaves the triangle of 0, 1 and 2, and 0 comes
// into that of 1, 2 and 3. No edge comes or goes, but the ridges of 1-3 and 2-3 have no end then.
TEST(Neighbor_lives, of_points_that_exchange_the_hull_are_long) {
  Simulation_2<> simulation(
      {{{4, 0}, {-1, 0}, 0}, {{-4, 8}, {}, 0}, {{-4, -8}, {}, 0}, {{0, 0}, {1, 0}, 0}}, {});
  Neighbor_lives lives(simulation, 100);
  Stepped_run run(simulation);
  run.step_to(1.5);
  for (const Neighbor_life& life : lives.lives()) {
    EXPECT_EQ(life.is_short, life.points[1] == 3) << life.points[0] << "-" << life.points[1];
  }
  run.step_to(2.0);
  run.look();
  run.step_to(3.0);
  EXPECT_EQ(simulation.triangulation().counters().number_of_events(), 0u);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 6u);
  expect_same(found, run.lives(100));
  for (const Neighbor_life& life : found) {
    EXPECT_EQ(life.is_short, life.points == (Edge_ids{0, 3}));
  }
}

TEST(Neighbor_lives, refuse_a_threshold_that_is_none) {
  Simulation_2<> simulation(cross(), {});
  EXPECT_PRECONDITION_ERROR(Neighbor_lives(simulation, 0.0),
                            "the threshold of ridges is not positive and finite");
  EXPECT_PRECONDITION_ERROR(Neighbor_lives(simulation, std::nan("")),
                            "the threshold of ridges is not positive and finite");
}

// A point comes between two neighbors, and goes again.
TEST(Neighbor_lives, are_cut_by_points_that_come_and_go) {
  Simulation_2<> simulation({{{-1, 0}, {}, 0}, {{1, 0}, {}, 0}, {{0, -9}, {}, 0}, {{0, 9}, {}, 0}},
                            {});
  Neighbor_lives lives(simulation);
  simulation.schedule_insert(1.0, {{0, 0}, {}, 1});
  simulation.schedule_erase(2.0, 4);
  simulation.advance_to(3.0);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 10u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].end, Algebraic_number(1.0));
  EXPECT_EQ(found[0].ends_by, Life_limit::point);
  for (std::size_t i = 5; i < 9; ++i) {
    EXPECT_EQ(found[i].points, (Edge_ids{static_cast<Point_id>(i - 5), 4}));
    EXPECT_EQ(found[i].begins_by, Life_limit::point);
    EXPECT_EQ(found[i].ends_by, Life_limit::point);
  }
  EXPECT_EQ(found[9].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[9].begin, Algebraic_number(2.0));
  EXPECT_EQ(found[9].begins_by, Life_limit::point);
  const auto exchanges = lives.exchanges();
  ASSERT_EQ(exchanges.size(), 5u);
  for (const Point_exchanges& point : exchanges) EXPECT_EQ(point.gained + point.lost, 0u);
  EXPECT_EQ(exchanges[4].from, Algebraic_number(1.0));
  EXPECT_EQ(exchanges[4].until, Algebraic_number(2.0));
}

TEST(Neighbor_lives, count_the_points_of_each_flip) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_2<> simulation(test::random_motions(30, 10, 1, seed), {});
    Neighbor_lives lives(simulation);
    test::Recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(5.0);
    std::map<Point_id, std::pair<std::size_t, std::size_t>> expected;
    for (const Event& event : recorder.events) {
      if (event.added) {
        for (const Point_id id : *event.added) ++expected[id].first;
      }
      if (event.removed) {
        for (const Point_id id : *event.removed) ++expected[id].second;
      }
    }
    EXPECT_GT(recorder.events.size(), 50u);
    for (const Point_exchanges& point : lives.exchanges()) {
      EXPECT_EQ(point.gained, expected[point.id].first);
      EXPECT_EQ(point.lost, expected[point.id].second);
    }
    for (const Neighbor_life& life : lives.lives()) {
      EXPECT_EQ(life.begins_by == Life_limit::run, life.begin == Algebraic_number(0.0));
      EXPECT_NE(life.begins_by, Life_limit::point);
      EXPECT_NE(life.ends_by, Life_limit::point);
    }
  }
}

}  // namespace
}  // namespace kinetri::neighbor_lives_test
