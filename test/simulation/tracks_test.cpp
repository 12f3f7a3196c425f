// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/tracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "kinetri/simulation/closest_approaches.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"

namespace kinetri {
namespace {

using Tracks = std::vector<std::vector<Observation_2>>;

struct Recorder : Simulation_2<>::Observer {
  void after_event(const Event<Algebraic_number>& event) override {
    if (event.kind >= Event_kind::insert) events.push_back(event);
  }
  std::vector<Event<Algebraic_number>> events;
};

std::unique_ptr<Simulation_2<>> simulation_of(const Tracks& tracks, double start,
                                              const Tracks_options& options = {}) {
  Tracks_options from_start = options;
  from_start.from = start;
  return simulate_tracks(tracks, stays_of(tracks, from_start), start, {}, {});
}

TEST(Stays, are_ordered_by_their_begin_and_leave_single_observations_out) {
  const Tracks tracks = {{{5, {0, 0}}, {6, {1, 0}}},
                         {{1, {0, 0}}},
                         {{0, {0, 0}}, {9, {1, 0}}},
                         {{0, {2, 0}}, {1, {1, 0}}, {2, {0, 0}}},
                         {}};
  EXPECT_EQ(stays_of(tracks, {}), (std::vector<Stay>{{2, 0, 1}, {3, 0, 2}, {0, 0, 1}}));
  // What begins before the start begins there; what ends at it, or begins at the end, is left out.
  EXPECT_EQ(stays_of(tracks, {.from = 1.5}), (std::vector<Stay>{{2, 0, 1}, {3, 0, 2}, {0, 0, 1}}));
  EXPECT_EQ(stays_of(tracks, {.from = 2}), (std::vector<Stay>{{2, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(stays_of(tracks, {.until = 5}), (std::vector<Stay>{{2, 0, 1}, {3, 0, 2}}));
}

TEST(Stays, are_split_where_nothing_was_seen_for_long) {
  const Tracks tracks = {{{0, {}}, {1, {}}, {4, {}}, {5, {}}, {9, {}}}};
  EXPECT_EQ(stays_of(tracks, {}), (std::vector<Stay>{{0, 0, 4}}));
  EXPECT_EQ(stays_of(tracks, {.longest_gap = 3}), (std::vector<Stay>{{0, 0, 3}}));
  EXPECT_EQ(stays_of(tracks, {.longest_gap = 2.5}), (std::vector<Stay>{{0, 0, 1}, {0, 2, 3}}));
}

TEST(Track_simulation, comes_turns_and_goes_at_the_observations) {
  const Tracks tracks = {{{0, {0, 0}}, {10, {0, 0}}},
                         {{0, {9, 0}}, {10, {9, 0}}},
                         {{0, {0, 9}}, {10, {0, 9}}},
                         {{1, {1, 1}}, {2, {3, 1}}, {4, {3, 1}}, {5, {1, 4}}}};
  const auto simulation = simulation_of(tracks, 0);
  Recorder recorder;
  simulation->add_observer(recorder);
  EXPECT_EQ(simulation->triangulation().number_of_points(), 3u);
  EXPECT_EQ(test::audited_run(*simulation, 7, Audit_level::certificates), "");
  ASSERT_EQ(recorder.events.size(), 4u);
  const std::array<std::pair<Event_kind, double>, 4> expected = {{{Event_kind::insert, 1},
                                                                  {Event_kind::trajectory, 2},
                                                                  {Event_kind::trajectory, 4},
                                                                  {Event_kind::erase, 5}}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(recorder.events[i].kind, expected[i].first);
    EXPECT_EQ(recorder.events[i].time, Algebraic_number(expected[i].second));
    EXPECT_EQ(recorder.events[i].point_a, 3u);
  }
  simulation->advance_to(10.0);
  EXPECT_EQ(simulation->triangulation().number_of_points(), 0u);
}

TEST(Track_simulation, may_start_on_the_way) {
  const Tracks tracks = {{{0, {0, 0}}, {1, {2, 0}}, {3, {2, 8}}}, {{2, {5, 5}}, {9, {5, 5}}}};
  const auto simulation = simulation_of(tracks, 2);
  EXPECT_EQ(simulation->triangulation().number_of_points(), 2u);
  EXPECT_EQ(simulation->triangulation().motion(0), (Linear_motion_2{{2, 0}, {0, 4}, 1}));
  simulation->advance_to(3.0);
  EXPECT_EQ(simulation->triangulation().number_of_points(), 1u);
}

TEST(Track_simulation, of_two_that_go_the_same_way_is_refused_when_they_do) {
  const Tracks tracks = {{{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0}}},
                         {{0, {0, 5}}, {1, {1, 0}}, {2, {2, 0}}}};
  const auto simulation = simulation_of(tracks, 0);
  EXPECT_THROW(simulation->advance_to(2.0), Coincident_trajectories_error);
  EXPECT_EQ(simulation->current_time(), Algebraic_number(1.0));
}

// Random walks on a grid, with pauses, gaps and meetings.
Tracks random_walks(std::size_t number, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, 12);
  std::uniform_int_distribution<int> step(-2, 2);
  std::uniform_int_distribution<int> time(0, 6);
  Tracks tracks(number);
  for (std::size_t i = 0; i < number; ++i) {
    double t = time(random);
    Vector_2 here = {static_cast<double>(place(random)), static_cast<double>(place(random))};
    for (int k = 0; k < 6; ++k) {
      tracks[i].push_back({t, here});
      t += 1 + time(random) / 3;
      // No two share a trajectory: each has a fraction of its own.
      here = {here.x + step(random) + 0x1p-10 * static_cast<double>(i), here.y + step(random)};
    }
  }
  return tracks;
}

TEST(Track_simulation, is_right_at_every_instant) {
  for (unsigned seed = 0; seed < 10u * static_cast<unsigned>(test::multiplier()); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto simulation = simulation_of(random_walks(12, seed), 0);
    ASSERT_EQ(test::audited_run(*simulation, 25, Audit_level::reference), "");
    EXPECT_EQ(simulation->triangulation().number_of_points(), 0u);
  }
}

TEST(Tracks, go_nowhere_after_their_last_observation) {
  const std::vector<Observation_2> track = {{0, {0, 0}}, {1, {2, 0}}};
  EXPECT_EQ(motion_after(track, 0).velocity, (Vector_2{2, 0}));
  EXPECT_PRECONDITION_ERROR(
      motion_after(track, 1),
      "there is no next observation; expected an index less than that of the last one");
}

// ---- closest approaches ----

TEST(Closest_approaches, of_two_points_is_where_the_slope_vanishes) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{10, 3}, {-2, 0}, 0}}, {});
  Closest_approaches closest(simulation, 5);
  simulation.advance_to(100.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].time, Algebraic_number(Rational(10, 3)));
  EXPECT_EQ(found[0].distance, 3);
  EXPECT_PRECONDITION_ERROR(Closest_approaches(simulation, 0), "no approach is asked for");
}

// The closest approach of all, by looking at all pairs between all turns.
TEST(Closest_approaches, begin_with_the_closest_of_all_pairs) {
  for (unsigned seed = 0; seed < 10u * static_cast<unsigned>(test::multiplier()); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Tracks tracks = random_walks(9, seed);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      for (std::size_t j = i + 1; j < tracks.size(); ++j) {
        for (std::size_t k = 0; k + 1 < tracks[i].size(); ++k) {
          for (std::size_t l = 0; l + 1 < tracks[j].size(); ++l) {
            const double from = std::max(tracks[i][k].time, tracks[j][l].time);
            const double to = std::min(tracks[i][k + 1].time, tracks[j][l + 1].time);
            for (int step = 0; from <= to && step <= 400; ++step) {
              const double t = from + (to - from) * step / 400;
              const Vector_2 a = rounded_place(motion_after(tracks[i], k), t);
              const Vector_2 b = rounded_place(motion_after(tracks[j], l), t);
              const double distance = std::hypot(a.x - b.x, a.y - b.y);
              least = std::min(least, distance);
            }
          }
        }
      }
    }
    const auto stays = stays_of(tracks, {.from = 0});
    const auto simulation = simulate_tracks(tracks, stays, 0, {}, {});
    Closest_approaches closest(*simulation, 3);
    simulation->advance_to(25.0);
    const auto found = closest.approaches();
    ASSERT_EQ(found.size(), 3u);
    EXPECT_LE(found[0].distance, least * (1 + 1e-12));
    EXPECT_NEAR(found[0].distance, least, 0.01);
    EXPECT_LE(found[0].distance, found[1].distance);
    EXPECT_LE(found[1].distance, found[2].distance);
  }
}

}  // namespace
}  // namespace kinetri
