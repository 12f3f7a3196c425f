// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation/repair.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core_impl.h"
#include "support/kinetic_parts.h"
#include "support/kinetic_runs.h"

namespace kinetri::repair_test {
namespace {

using Core = detail::Kinetic_core<Linear_kinetic_traits_2>;
using Types = detail::Kinetic_types<Linear_kinetic_traits_2>;
using Motions = std::vector<Linear_motion_2>;

// A triangulation whose points move to the positions of other motions by a repair.
struct Moved {
  Moved(const Motions& before, const Motions& after) : core({}, Algebraic_number(0)) {
    core.start_with(test::points_of<Types::Point_2>(before), before.size());
    std::vector<Types::Change> changes;
    for (Point_id id = 0; id < after.size(); ++id) changes.push_back({id, after[id]});
    core.reporter.start_noting();
    is_repaired = detail::From_places<Linear_kinetic_traits_2>::move(
        core.topology, core.reporter.notes(), 0, changes);
  }

  Core core;
  bool is_repaired = false;
};

std::vector<Edge_ids> edges_of(const Motions& motions) {
  return test::Kinetic_delaunay(motions).finite_edge_ids();
}

Motions at_random(std::size_t n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0, 20);
  Motions result(n);
  for (Linear_motion_2& motion : result) motion.position = {place(random), place(random)};
  return result;
}

Motions shifted(Motions motions, double length, std::mt19937_64& random) {
  std::normal_distribution<double> shift(0, length);
  for (Linear_motion_2& motion : motions) {
    motion.position = {motion.position.x + shift(random), motion.position.y + shift(random)};
  }
  return motions;
}

TEST(Repair, of_small_steps_pays_and_ends_with_the_edges_of_the_new_positions) {
  std::mt19937_64 random(1);
  std::size_t flips = 0;
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    const Motions before = at_random(400, random);
    const Motions after = shifted(before, 0.06, random);
    Moved moved(before, after);
    ASSERT_TRUE(moved.is_repaired);
    EXPECT_EQ(moved.core.topology.finite_edges(), edges_of(after));
    const Changed_edges changed = moved.core.reporter.report_edges();
    EXPECT_EQ(changed.removed.size() + edges_of(after).size(),
              changed.added.size() + edges_of(before).size());
    flips += changed.added.size();
  }
  EXPECT_GT(flips, 100U);
}

// Steps as long as half the distance of neighbors: one triangle in five turns over, and points at
// the hull change places.
TEST(Repair, of_long_steps_takes_points_out_where_flips_do_not_help) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 50; ++run) {
    SCOPED_TRACE(run);
    const Motions before = at_random(400, random);
    const Motions after = shifted(before, 0.3, random);
    Moved moved(before, after);
    ASSERT_TRUE(moved.is_repaired);
    EXPECT_TRUE(moved.core.topology.triangulation().tds().is_valid());
    EXPECT_EQ(moved.core.topology.finite_edges(), edges_of(after));
  }
}

// The first point jumps over the others, and out of the hull; the triangles at it turn over.
TEST(Repair, takes_out_a_point_that_jumps_and_inserts_it_again) {
  std::mt19937_64 random(2);
  for (const Vector_2 place : {Vector_2{19, 19}, Vector_2{60, 5}, Vector_2{-30, -40}}) {
    const Motions before = at_random(400, random);
    Motions after = before;
    after.front().position = place;
    Moved moved(before, after);
    ASSERT_TRUE(moved.is_repaired);
    EXPECT_EQ(moved.core.topology.finite_edges(), edges_of(after));
  }
}

TEST(Repair, does_not_pay_if_many_triangles_turn_over) {
  std::mt19937_64 random(3);
  EXPECT_FALSE(Moved(at_random(400, random), at_random(400, random)).is_repaired);
}

TEST(Repair, ends_without_a_triangulation_if_a_point_meets_another) {
  std::mt19937_64 random(4);
  const Motions before = at_random(400, random);
  Motions after = before;
  after[7].position = after[200].position;
  EXPECT_FALSE(Moved(before, after).is_repaired);
}

}  // namespace
}  // namespace kinetri::repair_test
