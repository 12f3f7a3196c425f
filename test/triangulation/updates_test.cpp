// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each change of faces leaves the edges that it should, an entry of each, and notes what it did.
#include "kinetri/impl/triangulation/updates.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "support/kinetic_parts.h"

namespace kinetri::updates_test {
namespace {

using Part = test::Updates_part<>;
using Edge_set = std::set<Edge_ids>;

/// Makes the changes of noted edges in a set of edges.
void make_changes(const Changed_edges& changed, Edge_set& edges) {
  for (const Edge_ids& edge : changed.removed) EXPECT_EQ(edges.erase(edge), 1u);
  for (const Edge_ids& edge : changed.added) EXPECT_TRUE(edges.insert(edge).second);
}

/// The motions but for one.
std::vector<Linear_motion_2> without(std::vector<Linear_motion_2> motions, Point_id id) {
  motions.erase(motions.begin() + id);
  return motions;
}
/// Edges of those, by the ids of all.
Edge_set renumbered(const Edge_set& edges, Point_id id) {
  Edge_set result;
  for (const auto& [a, b] : edges) result.insert({a < id ? a : a + 1, b < id ? b : b + 1});
  return result;
}

TEST(Flip, at_its_time_leaves_the_edges_just_after_it) {
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    const auto motions = test::random_motions(9, 10, 2, seed);
    Part part(motions);
    auto& schedule = part.schedule;
    for (int flips = 0; flips < 5 && schedule.settle(nullptr); ++flips) {
      schedule.set_current_time(schedule.queue().top());
      const auto failure = schedule.queue().pop();
      part.updates.flip(part.topology.with_mirror(failure.edge()),
                        detail::event_kind_of(failure.kind));
      part.updates.show_current_time();
      ASSERT_EQ(part.edges(), test::edges_after(motions, schedule.current_time())) << seed;
      ASSERT_EQ(part.problem(), "") << seed;
      EXPECT_EQ(part.updates.number_of_changes(), static_cast<std::uint64_t>(flips + 1));
      EXPECT_EQ(part.counters.number_of_events(), static_cast<std::uint64_t>(flips + 1));
    }
  }
}

TEST(Point, taken_out_and_put_in_leaves_the_edges_of_all) {
  for (unsigned seed = 1; seed <= test::cases(1u); ++seed) {
    const auto motions = test::random_motions(9, 10, 2, seed);
    for (Point_id id = 0; id < 9; ++id) {
      SCOPED_TRACE(id);
      Part part(motions);
      Edge_set edges = part.edges();
      part.reporter.start_noting();
      part.updates.take_out(part.topology.vertex(id));
      make_changes(part.reporter.report_edges(), edges);
      ASSERT_EQ(edges, renumbered(test::edges_after(without(motions, id), 0.0), id));
      EXPECT_EQ(part.edges(), edges);
      ASSERT_EQ(part.problem(), "");
      const auto v = part.topology.vertex(id);
      const auto location = part.topology.locate(v->point(), {});
      if (part.topology.triangulation().is_infinite(location.face)) continue;
      part.reporter.start_noting();
      part.updates.put_in(v, location);
      make_changes(part.reporter.report_edges(), edges);
      ASSERT_EQ(edges, test::edges_after(motions, 0.0));
      EXPECT_EQ(part.edges(), edges);
      ASSERT_EQ(part.problem(), "");
    }
  }
}

// Beyond the hull some edges are violated at once: they have entries at the present time.
TEST(Point, put_in_beyond_the_hull_leaves_entries_that_are_due) {
  using test::resting;
  const std::vector<Linear_motion_2> motions = {resting(0, 0), resting(4, 0), resting(5, 4),
                                                resting(0, 5), resting(9, -3)};
  Part part(motions);
  part.reporter.start_noting();
  part.updates.take_out(part.topology.vertex(4));
  EXPECT_FALSE(part.schedule.settle_now());
  const auto v = part.topology.vertex(4);
  part.updates.put_in(v, part.topology.locate(v->point(), {}));
  EXPECT_EQ(part.problem(), "");
  int flips = 0;
  while (part.schedule.settle_now()) {
    const auto failure = part.schedule.queue().pop();
    part.updates.flip(part.topology.with_mirror(failure.edge()),
                      detail::event_kind_of(failure.kind));
    ++flips;
  }
  EXPECT_GT(flips, 0);
  EXPECT_EQ(part.edges(), test::edges_after(motions, 0.0));
  EXPECT_EQ(part.counters.number_of_events(), 0u) << "edges are noted";
}

TEST(Reconstruction, with_other_motions_leaves_the_edges_of_those) {
  for (unsigned seed = 1; seed <= test::cases(4u); ++seed) {
    Part part(test::random_motions(8, 10, 2, seed));
    auto motions = test::grid_motions(9, 4, 2, seed);
    Edge_set edges = part.edges();
    part.schedule.set_current_time(Algebraic_number(1.0));
    const Point_id id = part.topology.give_ids(1);
    part.updates.rebuild([&] {
      for (Point_id k = 0; k <= id; ++k) part.topology.set_point({k, motions[k]});
    });
    make_changes(part.reporter.report_edges(), edges);
    ASSERT_EQ(edges, test::edges_after(motions, 1.0)) << seed;
    EXPECT_EQ(part.edges(), edges);
    EXPECT_TRUE(part.schedule.is_deferred());
    part.schedule.schedule_deferred();
    ASSERT_EQ(part.problem(), "") << seed;
    EXPECT_EQ(part.counters.reconstructions, 0u) << "no failure made it necessary";
    part.updates.rebuild();
    EXPECT_EQ(part.counters.reconstructions, 1u);
    const Changed_edges changed = part.reporter.report_edges();
    EXPECT_TRUE(changed.removed.empty() && changed.added.empty());
  }
}

// Only points with weights are looked for so.
TEST(Weighted_point, is_inside_a_face_whose_sides_it_is_to_the_left_of_just_after_now) {
  using Weighted_part = test::Updates_part<Disc_kinetic_traits_2>;
  const auto disc = [](double x, double y, double vy) {
    return Disc_motion_2{{{x, y}, {0, vy}, 0}, 1, 0, 0};
  };
  const Weighted_part part({disc(0, 0, 0), disc(4, 0, 0), disc(0, 4, 0)});
  const auto lower = part.edge(0, 1);
  const auto face = part.topology.hull_triangle(lower).first;
  const auto is_inside = [&](const Disc_motion_2& motion, bool strictly) {
    return part.updates.is_inside(Weighted_part::Point_2(motion, 3), {face}, strictly);
  };
  EXPECT_TRUE(is_inside(disc(1, 1, 0), true));
  EXPECT_FALSE(is_inside(disc(3, 3, 0), false));
  EXPECT_TRUE(is_inside(disc(2, 0, 0), false)) << "it stays on a side";
  EXPECT_FALSE(is_inside(disc(2, 0, 0), true));
  EXPECT_TRUE(is_inside(disc(2, 0, 1), true)) << "it comes inside";
  EXPECT_FALSE(is_inside(disc(2, 0, -1), false));
}

}  // namespace
}  // namespace kinetri::updates_test
