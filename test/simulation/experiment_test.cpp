// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri::experiment_test {
namespace {

Experiment_setting small_setting() {
  Experiment_setting setting;
  setting.points = 40;
  setting.movers = 40;
  setting.side = 40;
  setting.duration = 5;
  return setting;
}

TEST(Experiment, moves_as_many_points_as_asked_for) {
  Experiment_setting setting = small_setting();
  for (const std::size_t movers : {std::size_t{0}, std::size_t{13}, std::size_t{40}}) {
    setting.movers = movers;
    const auto motions = experiment_motions(setting);
    ASSERT_EQ(motions.size(), 40u);
    const auto moving = std::ranges::count_if(
        motions, [](const Linear_motion_2& m) { return m.velocity != Vector_2{}; });
    EXPECT_EQ(static_cast<std::size_t>(moving), movers);
    for (const Linear_motion_2& m : motions) {
      EXPECT_TRUE(m.position.x >= 0 && m.position.x < 40 && m.position.y >= 0 && m.position.y < 40);
      EXPECT_TRUE(std::abs(m.velocity.x) <= 5 && std::abs(m.velocity.y) <= 5);
    }
  }
  setting.movers = 41;
  EXPECT_PRECONDITION_ERROR(
      experiment_motions(setting),
      "more points move than there are; expected as many movers as points, or fewer");
}

TEST(Experiment, has_no_events_where_nothing_moves) {
  Experiment_setting setting = small_setting();
  setting.movers = 0;
  const Experiment_result result = run_experiment(setting);
  EXPECT_EQ(result.events.number_of_events(), 0u);
  EXPECT_GT(result.seconds, 0);
}

TEST(Experiment, is_the_same_for_the_same_seed) {
  const Experiment_result one = run_experiment(small_setting());
  const Experiment_result other = run_experiment(small_setting());
  EXPECT_EQ(one.events.events, other.events.events);
  EXPECT_EQ(one.events.discarded, other.events.discarded);
  EXPECT_EQ(one.contacts.discarded_walls, other.contacts.discarded_walls);
  for (const Event_kind kind : {Event_kind::flip, Event_kind::wall, Event_kind::collision}) {
    EXPECT_GT(one.events.events[static_cast<std::size_t>(kind)], 0u);
  }
}

// Also where they cover as much as they may: 40 discs of the radii 1 and 3 cover 0.25 of 50 x 50.
TEST(Experiment, of_two_sizes_has_discs_that_do_not_overlap) {
  for (const double side : {100.0, 50.2}) {
    Experiment_setting setting = small_setting();
    setting.movers = 13;
    setting.side = side;
    setting.diameter = 2;
    setting.size_ratio = 3;
    for (setting.seed = 1; setting.seed <= 5; ++setting.seed) {
      const auto motions = experiment_motions(setting);
      const auto discs = experiment_discs(setting);
      EXPECT_EQ(discs, experiment_discs(setting));
      ASSERT_EQ(discs.size(), motions.size());
      std::size_t at_their_places = 0;
      for (std::size_t i = 0; i < discs.size(); ++i) {
        EXPECT_EQ(discs[i].radius, i % 2 == 0 ? 1 : 3);
        EXPECT_EQ(discs[i].velocity, motions[i].velocity);
        EXPECT_TRUE(discs[i].position.x >= 0 && discs[i].position.x < side &&
                    discs[i].position.y >= 0 && discs[i].position.y < side);
        if (discs[i].position == motions[i].position) ++at_their_places;
        for (std::size_t j = 0; j < i; ++j) {
          const Rational x = to_rational(discs[i].position.x) - to_rational(discs[j].position.x);
          const Rational y = to_rational(discs[i].position.y) - to_rational(discs[j].position.y);
          const Rational reach = to_rational(discs[i].radius) + to_rational(discs[j].radius);
          EXPECT_GT(x * x + y * y, reach * reach) << i << " and " << j << ", seed " << setting.seed;
        }
      }
      EXPECT_GT(at_their_places, side == 100 ? 25u : 10u);
      EXPECT_LT(at_their_places, 40u);
    }
  }
}

TEST(Experiment, of_two_sizes_runs_audited_and_the_same_for_the_same_seed) {
  Experiment_setting setting = small_setting();
  setting.diameter = 0.5;
  setting.size_ratio = 6;
  const Experiment_result one = run_experiment(setting);
  EXPECT_EQ(one.events.events, run_experiment(setting).events.events);
  for (const Event_kind kind : {Event_kind::flip, Event_kind::wall, Event_kind::collision}) {
    EXPECT_GT(one.events.events[static_cast<std::size_t>(kind)], 0u);
  }
  Simulation_2<Disc_kinetic_traits_2> simulation(experiment_discs(setting),
                                                 experiment_options(setting));
  for (double t = 1; t <= setting.duration; ++t) {
    simulation.advance_to(t);
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  }
  EXPECT_EQ(simulation.triangulation().counters().events, one.events.events);
}

TEST(Experiment, of_two_sizes_has_room_for_the_discs) {
  Experiment_setting setting = small_setting();
  setting.size_ratio = 0.5;
  EXPECT_PRECONDITION_ERROR(experiment_discs(setting),
                            "the size ratio of an experiment is less than 1");
  // With the radii 0.5 and 2.5 the 40 discs cover 0.255 of 40 x 40.
  setting.size_ratio = 5;
  EXPECT_NEAR(setting.covered_share(), 0.2553, 1e-4);
  EXPECT_PRECONDITION_ERROR(
      run_experiment(setting),
      "discs of two sizes cover more than a quarter of the box of an experiment");
}

TEST(Discrete_steps, of_discs_of_two_sizes_miss_nothing_when_tiny_and_much_when_wide) {
  Experiment_setting setting = small_setting();
  setting.diameter = 0.5;
  setting.size_ratio = 3;
  setting.duration = 2;
  const auto comparisons = compare_with_discrete_steps(setting, {1, 0.001});
  ASSERT_EQ(comparisons.size(), 2u);
  EXPECT_GT(comparisons[0].contacts, 5u);
  EXPECT_GT(comparisons[0].edge_changes_missed, comparisons[0].edge_changes / 4);
  EXPECT_GT(comparisons[0].contacts_missed, comparisons[0].contacts / 2);
  EXPECT_LE(comparisons[1].edge_changes_missed, comparisons[1].edge_changes / 50);
  EXPECT_EQ(comparisons[1].contacts_missed, 0u);
}

// Discs that pass through a large one have no edges, as they are hidden, and touch each other.
TEST(Discrete_steps, miss_contacts_of_discs_without_an_edge) {
  Experiment_setting setting = small_setting();
  setting.points = 60;
  setting.movers = 60;
  setting.diameter = 0.25;
  setting.size_ratio = 16;
  setting.duration = 2;
  const auto comparisons = compare_with_discrete_steps(setting, {0.001});
  EXPECT_GT(comparisons.at(0).contacts, 20u);
  EXPECT_GT(comparisons[0].contacts_missed, 0u);
  EXPECT_LT(comparisons[0].contacts_missed, comparisons[0].contacts / 2);
}

TEST(Discrete_steps, miss_nothing_when_tiny_and_much_when_wide) {
  const auto comparisons = compare_with_discrete_steps(small_setting(), {2.5, 0.5, 0.001});
  ASSERT_EQ(comparisons.size(), 3u);
  for (const Discrete_comparison& c : comparisons) {
    EXPECT_GT(c.topologic_events, 100u);
    EXPECT_GT(c.edge_changes, c.topologic_events);
    EXPECT_LE(c.edge_changes, 2 * c.topologic_events);
    EXPECT_GT(c.contacts, 10u);
  }
  EXPECT_GT(comparisons[0].edge_changes_missed, comparisons[0].edge_changes / 4);
  EXPECT_GT(comparisons[0].contacts_missed, comparisons[0].contacts / 2);
  EXPECT_LT(comparisons[1].edge_changes_missed, comparisons[0].edge_changes_missed);
  EXPECT_LE(comparisons[2].edge_changes_missed, comparisons[2].edge_changes / 50);
  EXPECT_EQ(comparisons[2].contacts_missed, 0u);
  EXPECT_PRECONDITION_ERROR(compare_with_discrete_steps(small_setting(), {0.0}),
                            "a time step is not greater than 0");
}

}  // namespace
}  // namespace kinetri::experiment_test
