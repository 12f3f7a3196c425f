// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lives against the triangulation after each step.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "kinetri/observers/neighbor_lives.h"
#include "observers/random_runs.h"
#include "observers/stepped_run.h"
#include "support/disc_runs.h"
#include "support/random_walks.h"

namespace kinetri::neighbor_lives_of_runs_test {
namespace {

using test::expect_same;
using test::number_of_short;
using test::Stepped_run;

TEST(Neighbor_lives, of_random_motions_are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  std::size_t long_ones = 0;
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    for (const double threshold : {0.05, 0.5}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Simulation_2<> simulation(test::random_motions(9, 4, 1, seed), {});
      Neighbor_lives lives(simulation, threshold);
      Stepped_run run(simulation);
      run.step_to(3.0);
      const auto found = lives.lives();
      expect_same(found, run.lives(threshold));
      short_ones += number_of_short(found);
      long_ones += found.size() - number_of_short(found);
    }
  }
  EXPECT_GT(short_ones, 5u);
  EXPECT_GT(long_ones, 20u);
}

TEST(Neighbor_lives, of_degenerate_motions_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_2<> simulation(test::grid_motions(8, 4, 1, seed), {});
    Neighbor_lives lives(simulation, 0.5);
    Stepped_run run(simulation);
    run.step_to(4.0);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

TEST(Neighbor_lives, of_discs_are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : test::grid_motions(8, 4, 1, seed)) {
      motions.push_back({motion, 0.25 * static_cast<double>(motions.size() % 4)});
    }
    Simulation_2<Disc_kinetic_traits_2> simulation(motions, {});
    Neighbor_lives lives(simulation, 0.25);
    Stepped_run run(simulation);
    run.step_to(3.0);
    const auto found = lives.lives();
    expect_same(found, run.lives(0.25));
    short_ones += number_of_short(found);
  }
  EXPECT_GT(short_ones, 0u);
}

TEST(Neighbor_lives, of_points_between_walls_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_options options = test::discs(0.125, collide_elastically);
    options.box = Box_2{0, 0, 4, 4};
    Simulation_2<> simulation(test::grid_motions(7, 4, 1, seed), options);
    Neighbor_lives lives(simulation, 0.25);
    Stepped_run run(simulation);
    run.step_to(4.0);
    expect_same(lives.lives(), run.lives(0.25));
  }
}

TEST(Neighbor_lives, of_tracks_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
    const test::Tracks tracks = test::random_walks(9, seed, 0, fraction);
    const auto simulation = simulate_tracks(tracks, stays_of(tracks, {.from = 0}), 0, {}, {});
    Neighbor_lives lives(*simulation, 0.5);
    Stepped_run run(*simulation);
    run.step_to(30.0);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

TEST(Neighbor_lives, of_points_that_come_turn_and_go_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Simulation_2<> simulation(test::grid_motions(5, 4, 1, seed), {});
    Neighbor_lives lives(simulation, 0.5);
    Stepped_run run(simulation);
    double now = 0;
    for (Linear_motion_2 motion : test::grid_motions(15, 4, 1, seed + 1000)) {
      now += 0.25 * static_cast<double>(random() % 4);
      run.step_to(now);
      motion.epoch = now;
      test::change_at_random(simulation, motion, random);
      run.look();
    }
    run.step_to(now + 1);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

// Real people, at first whole seconds of it.
TEST(Neighbor_lives, of_a_real_crowd_are_those_of_the_triangulation) {
  const std::string path = KINETRI_SHARED_DATA "/crowd/biwi_eth.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  test::Tracks tracks;
  for (const Track& track : read_tracks_file(path, Tracks_format::frames, 25).tracks) {
    tracks.emplace_back();
    for (const auto& seen : track.observations) tracks.back().push_back({seen.time, seen.place});
  }
  const auto simulation =
      simulate_tracks(tracks, stays_of(tracks, {.from = 30, .until = 60, .longest_gap = 1}), 30);
  Neighbor_lives lives(*simulation);
  Stepped_run run(*simulation);
  run.step_to(60.0);
  const auto found = lives.lives();
  EXPECT_GT(found.size(), 50u);
  expect_same(found, run.lives(std::nullopt));
}

}  // namespace
}  // namespace kinetri::neighbor_lives_of_runs_test
