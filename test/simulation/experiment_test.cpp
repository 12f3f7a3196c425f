// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri {
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
}  // namespace kinetri
