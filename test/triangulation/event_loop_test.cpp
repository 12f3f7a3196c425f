// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/event_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/kinetic_parts.h"

namespace kinetri::event_loop_test {
namespace {

using test::resting;
using Part = test::Event_loop_part<>;

/// A square to which a point comes at t = 1, when its diagonal is flipped.
const std::vector<Linear_motion_2> one_flip = {
    resting(0, 0), resting(2, 0), resting(2, 2), {{0, 3}, {0, -1}}};

TEST(Event_loop, has_the_edges_of_static_points_after_each_time) {
  for (unsigned seed = 1; seed <= test::cases(3u); ++seed) {
    SCOPED_TRACE(seed);
    const auto motions =
        seed % 2 == 0 ? test::grid_motions(7, 3, 1, seed) : test::random_motions(8, 10, 3, seed);
    Part part(motions);
    const auto times = test::critical_times(motions, 0.0);
    // Each third one: so that events of several times are executed by one call.
    for (std::size_t k = 0; k + 1 < times.size(); k += 3) {
      part.loop.run_to(times[k], nullptr);
      ASSERT_EQ(part.schedule.current_time(), times[k]);
      ASSERT_EQ(part.edges(), test::edges_at(motions, simplest_between(times[k], times[k + 1])));
      ASSERT_EQ(part.problem(), "");
    }
    ASSERT_TRUE(part.topology.triangulation().is_valid());
  }
}

TEST(Event_loop, passes_coincidences_with_curved_motions) {
  using Curved_part = test::Event_loop_part<Polynomial_kinetic_traits_2>;
  const auto motions = test::polynomial_grid_motions(6, 3, 1, 2, 3);
  const auto times = test::critical_times(motions, 0.0);
  Curved_part part(motions);
  for (std::size_t k = 0; k + 1 < times.size(); k += 5) {
    part.loop.run_to(times[k], nullptr);
    ASSERT_EQ(part.edges(), test::edges_at(motions, simplest_between(times[k], times[k + 1])));
  }
}

TEST(Event_loop, goes_on_only_as_long_as_it_may) {
  Part part(test::random_motions(12, 10, 3, 1));
  int asked = 0;
  part.loop.run_to(100.0, [&] { return ++asked <= 2; });
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(part.counters.instants, 2u);
  EXPECT_LT(part.schedule.current_time(), Algebraic_number(100.0));
  EXPECT_EQ(part.problem(), "") << "it stops between two times";
}

TEST(Event_loop, steps_to_the_next_event_and_no_further_than_asked) {
  Part part(one_flip);
  const Algebraic_number early = 0.5;
  int instants = 0;
  const auto count = [&] { ++instants; };
  EXPECT_EQ(part.loop.step(&early, count), 0u);
  EXPECT_EQ(instants, 0);
  EXPECT_EQ(part.schedule.current_time(), Algebraic_number(0.0));
  EXPECT_EQ(part.loop.step(nullptr, count), 1u);
  EXPECT_EQ(instants, 1);
  EXPECT_EQ(part.schedule.current_time(), Algebraic_number(1.0));
  EXPECT_TRUE(part.edges().contains({1, 3}));
}

TEST(Event_loop, counts_instants_and_the_events_of_each) {
  // The same four points twice, far from each other.
  std::vector<Linear_motion_2> motions = one_flip;
  for (Linear_motion_2 m : one_flip) {
    m.position.x += 1000;
    m.position.y += 300;
    motions.push_back(m);
  }
  Part part(motions);
  const Algebraic_number end = 1.0;
  part.loop.run_to(end, nullptr);
  EXPECT_EQ(part.counters.batches, 1u);
  EXPECT_EQ(part.counters.largest_instant, 2u);
  EXPECT_EQ(part.reporter.events_in_instant(), 2u);
  EXPECT_EQ(part.counters.events[static_cast<std::size_t>(Event_kind::flip)],
            part.counters.number_of_events());
}

TEST(Event_loop, takes_points_that_meet_out_and_puts_them_back) {
  const std::vector<Linear_motion_2> motions = {resting(0, 0),    resting(9, 1),     resting(4, 9),
                                                {{3, 3}, {1, 0}}, {{6, 3}, {-1, 0}}, resting(1, 20),
                                                resting(20, 2),   resting(-9, 5)};
  Part part(motions);
  part.reporter.keep_trail();
  std::set<Edge_ids> edges = part.edges();
  part.loop.run_to(1.5, nullptr);
  EXPECT_EQ(part.counters.points_set_aside, 1u);
  EXPECT_EQ(part.counters.reconstructions, 0u);
  EXPECT_FALSE(part.loop.has_points_set_aside());
  EXPECT_EQ(part.edges(), test::edges_after(motions, 1.5));
  EXPECT_EQ(part.problem(), "");
  for (const auto& [removed, added] : part.reporter.take_trail().edges) {
    if (removed) edges.erase(*removed);
    if (added) edges.insert(*added);
  }
  EXPECT_EQ(edges, part.edges()) << "the trail accounts for all edges";
}

TEST(Event_loop, that_runs_backwards_comes_by_the_same_edges) {
  for (unsigned seed = 1; seed <= test::cases(4u); ++seed) {
    const auto motions =
        seed % 2 == 0 ? test::grid_motions(7, 3, 1, seed) : test::random_motions(8, 10, 3, seed);
    Part part(motions);
    const auto times = test::critical_times(motions, 0.0);
    const std::size_t last = std::min<std::size_t>(times.size() - 1, 12);
    part.loop.run_to(times[last], nullptr);
    part.loop.reverse();
    EXPECT_EQ(part.schedule.current_time(), -times[last]);
    for (std::size_t k = last; k > 0; --k) {
      ASSERT_EQ(part.edges(), test::edges_at(motions, simplest_between(times[k - 1], times[k])))
          << "seed " << seed << ", " << k;
      part.loop.run_to(-times[k - 1], nullptr);
    }
    EXPECT_EQ(part.problem(), "");
  }
}

}  // namespace
}  // namespace kinetri::event_loop_test
