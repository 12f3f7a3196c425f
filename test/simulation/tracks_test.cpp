// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/tracks.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/disc_runs.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::tracks_test {
namespace {

using test::Tracks;

struct Recorder : Simulation_2<>::Observer {
  void after_event(const Event& event) override {
    if (event.kind >= Event_kind::insert) events.push_back(event);
  }
  std::vector<Event> events;
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

const Tracks one_way = {{{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0}}},
                        {{0, {0, 5}}, {1, {1, 0}}, {2, {2, 0}}}};

TEST(Track_simulation, of_two_that_go_the_same_way_hides_one_while_they_do) {
  const auto simulation = simulation_of(one_way, 0);
  simulation->advance_to(1.5);
  EXPECT_EQ(simulation->triangulation().coincident_points(0), std::vector<Point_id>{1});
  EXPECT_TRUE(simulation->triangulation().is_hidden(1));
  simulation->advance_to(2.0);
  EXPECT_EQ(simulation->triangulation().number_of_points(), 0u);
}

TEST(Track_simulation, of_two_that_go_the_same_way_may_be_refused_when_they_do) {
  Simulation_options options;
  options.coincident = Coincident_points::refuse;
  const auto simulation = simulate_tracks(one_way, stays_of(one_way, {.from = 0}), 0, options);
  EXPECT_THROW(simulation->advance_to(2.0), Coincident_trajectories_error);
  EXPECT_EQ(simulation->current_time(), Algebraic_number(1.0));
}

TEST(Track_simulation, is_right_at_every_instant) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto simulation = simulation_of(test::random_walks(12, seed), 0);
    ASSERT_EQ(test::audited_run(*simulation, 25, Audit_level::reference), "");
    EXPECT_EQ(simulation->triangulation().number_of_points(), 0u);
  }
}

// Two discs about one place that moves are no two points with one trajectory.
TEST(Track_simulation, has_discs_of_a_radius_a_track) {
  const Tracks tracks = {{{0, {0, 0}}, {1, {1, 0}}, {9, {1, 0}}},
                         {{0, {9, 0}}, {2, {5, 0}}},
                         {{0, {0, 0}}, {1, {1, 0}}, {9, {1, 0}}}};
  const std::vector<double> radii = {1, 4, 2};
  const auto stays = stays_of(tracks, {});
  Simulation_options options;
  options.response = log_contact;
  const auto simulation = simulate_tracks(tracks, radii, stays, 0, options);
  struct Contacts : Event_observer {
    void after_event(const Event& event) override {
      if (event.kind != Event_kind::collision) return;
      seen.emplace_back(event.time.to_double(), Edge_ids{*event.point_a, *event.point_b});
    }
    std::vector<std::pair<double, Edge_ids>> seen;
  } contacts;
  simulation->add_observer(contacts);
  while (simulation->step(Algebraic_number(7.0)) > 0) {
    EXPECT_TRUE(simulation->audit(Audit_level::certificates).passed());
  }
  EXPECT_EQ(contacts.seen, (std::vector<std::pair<double, Edge_ids>>{{1, {1, 2}}, {1.5, {0, 1}}}));
  EXPECT_PRECONDITION_ERROR(simulate_tracks(tracks, std::span(radii).first(2), stays, 0),
                            "there are not as many radii as tracks; expected one for each");
}

TEST(Tracks, go_nowhere_after_their_last_observation) {
  const std::vector<Observation_2> track = {{0, {0, 0}}, {1, {2, 0}}};
  EXPECT_EQ(motion_after(track, 0).velocity, (Vector_2{2, 0}));
  EXPECT_PRECONDITION_ERROR(
      motion_after(track, 1),
      "there is no next observation; expected an index less than that of the last one");
}

}  // namespace
}  // namespace kinetri::tracks_test
