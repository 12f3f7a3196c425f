// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why neighbors meet and part, and what counts as an exchange: cases by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "kinetri/impl/observers/answer_columns.h"
#include "kinetri/observers/neighbor_lives.h"

namespace kinetri::neighbor_exchanges_test {
namespace {

// Points 0 and 1 rest at (-1, 0) and (1, 0); 2 and 3, at (0, -h) and (0, h), come nearer to each
// other, h = 2 - t. From t = 1 on they are neighbors instead of 0 and 1.
std::vector<Linear_motion_2> cross() {
  return {{{-1, 0}, {}, 0}, {{1, 0}, {}, 0}, {{0, -2}, {0, 1}, 0}, {{0, 2}, {0, -1}, 0}};
}

// Point 8 comes at the left of 0 at the very time at which 0 and 1 part: 0, 2 and 3 are its
// neighbors, so that 2 and 3 are said to meet by its coming. Points 4 to 7 are a cross far away.
TEST(Neighbor_lives, end_by_exchange_unless_both_ends_are_beside_a_point_that_comes) {
  std::vector<Linear_motion_2> motions = cross();
  for (Linear_motion_2 motion : cross()) {
    motion.position.x += 100;
    motions.push_back(motion);
  }
  Simulation_2<> simulation(motions, {});
  Neighbor_lives lives(simulation);
  simulation.schedule_insert(1.0, {{-3, 0}, {}, 1});
  simulation.advance_to(1.25);
  std::map<Edge_ids, Neighbor_life> found;
  for (const Neighbor_life& life : lives.lives()) found[life.points] = life;
  const Point_id visitor = 8;
  EXPECT_EQ(found.at({0, 1}).end, Algebraic_number(1.0));
  EXPECT_EQ(found.at({0, 1}).ends_by, Life_limit::exchange);
  EXPECT_EQ(found.at({2, 3}).begin, Algebraic_number(1.0));
  EXPECT_EQ(found.at({2, 3}).begins_by, Life_limit::point);
  EXPECT_EQ(found.at({4, 5}).ends_by, Life_limit::exchange);
  EXPECT_EQ(found.at({6, 7}).begins_by, Life_limit::exchange);
  for (const Point_id id : {0u, 2u, 3u}) {
    EXPECT_EQ(found.at({id, visitor}).begins_by, Life_limit::point) << id;
    EXPECT_EQ(found.at({id, visitor}).ends_by, Life_limit::run) << id;
  }
  const auto exchanges = lives.exchanges();
  ASSERT_EQ(exchanges.size(), 9u);
  const std::vector<std::pair<std::size_t, std::size_t>> gained_and_lost = {
      {0, 1}, {0, 1}, {0, 0}, {0, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 0}, {0, 0}};
  for (std::size_t id = 0; id < exchanges.size(); ++id) {
    EXPECT_EQ(exchanges[id].id, id);
    EXPECT_EQ(std::pair(exchanges[id].gained, exchanges[id].lost), gained_and_lost[id]) << id;
    EXPECT_EQ(exchanges[id].from, Algebraic_number(id == visitor ? 1.0 : 0.0));
    EXPECT_EQ(exchanges[id].until, Algebraic_number(1.25));
  }
}

// At the time of an exchange it counts, but the life that begins with it has no duration.
TEST(Neighbor_lives, that_begin_now_are_left_out) {
  Simulation_2<> simulation(cross(), {});
  Neighbor_lives lives(simulation, 1.0);
  simulation.advance_to(1.0);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].end, Algebraic_number(1.0));
  EXPECT_EQ(found[0].ends_by, Life_limit::exchange);
  const auto exchanges = lives.exchanges();
  for (const Point_exchanges& point : exchanges) {
    EXPECT_EQ(point.gained, point.id < 2 ? 0u : 1u);
    EXPECT_EQ(point.lost, point.id < 2 ? 1u : 0u);
    // Up to now the ridge that begins has no length.
    EXPECT_EQ(point.short_ones, 1u);
  }
}

// Of the ridge of 0 and 1, of length h - 1 / h, which shrinks from 3 / 2 to nothing, what is before
// the observer comes says nothing; and a turn of its points does not begin another life.
TEST(Neighbor_lives, have_the_ridge_from_the_observation_on) {
  for (const double start : {0.0, 0.75}) {  // when it is 9 / 20 long
    Simulation_2<> simulation(cross(), {});
    simulation.advance_to(start);
    Neighbor_lives lives(simulation, 1.0);
    simulation.set_motion(0, {{-1, 0}, {0, 0}, start});
    simulation.advance_to(1.0);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 5u);
    EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
    EXPECT_EQ(found[0].begin, Algebraic_number(start));
    EXPECT_EQ(found[0].is_short, start > 0);
  }
}

// The ridge of 2 and 3, of length 1 - h^2, is 3 / 4 long at t = 3 / 2 for the first time.
TEST(Neighbor_lives, are_long_if_the_ridge_reaches_the_threshold_now) {
  for (const double threshold : {0.75, std::nextafter(0.75, 1.0)}) {
    Simulation_2<> simulation(cross(), {});
    Neighbor_lives lives(simulation, threshold);
    simulation.advance_to(1.5);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 6u);
    EXPECT_EQ(found[5].points, (Edge_ids{2, 3}));
    EXPECT_EQ(found[5].is_short, threshold > 0.75);
  }
}

TEST(Neighbor_lives, have_limits_with_names) {
  EXPECT_STREQ(name(Life_limit::run), "run");
  EXPECT_STREQ(name(Life_limit::point), "point");
  EXPECT_STREQ(name(Life_limit::exchange), "exchange");
}

TEST(Exchange_columns, have_the_rate_of_exchanges_that_are_not_short) {
  using detail::Exchange_columns;
  const Algebraic_number one(1.0);
  const Algebraic_number three(3.0);
  EXPECT_EQ(Exchange_columns::rate({0, one, three, 4, 3, 1}), 3.0);
  EXPECT_EQ(Exchange_columns::rate({0, one, three, 2, 1, 3}), 0.0);
  EXPECT_TRUE(std::isnan(Exchange_columns::rate({0, three, three, 2, 1, 0})));
}

}  // namespace
}  // namespace kinetri::neighbor_exchanges_test
