// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/hidden_events.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "support/kinetic_parts.h"
#include "support/message_of.h"

namespace kinetri::hidden_events_test {
namespace {

using detail::Entry_kind;
using Part = test::Updates_part<Disc_kinetic_traits_2>;

Disc_motion_2 disc(double x, double y, double vx, double radius, double growth = 0) {
  return {{{x, y}, {vx, 0}, 0}, radius, growth, 0};
}

/// A large square of discs, cut by the diagonal from 0 to 2, and a fifth disc, which they hide.
struct Hidden_events : testing::Test {
  void start(const Disc_motion_2& fifth) {
    part.emplace(
        std::vector{disc(0, 0, 0, 6), disc(8, 0, 0, 5), disc(8, 8, 0, 6), disc(0, 8, 0, 5), fifth});
    hidden.emplace(part->topology, part->schedule, part->reporter, part->updates);
    ASSERT_TRUE(part->topology.is_hidden(4));
    ASSERT_EQ(part->edges(), (std::set<Edge_ids>{{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 2}}));
  }
  /// Executes the first failure, which is that of the hidden disc.
  bool execute_first() {
    EXPECT_TRUE(part->schedule.settle(nullptr));
    part->schedule.set_current_time(part->schedule.queue().top());
    const auto failure = part->schedule.queue().pop();
    EXPECT_EQ(failure.kind, Entry_kind::hidden);
    return hidden->execute(failure);
  }
  bool has_corner(Point_id id) const {
    return part->topology.vertex(4)->face()->has_vertex(part->topology.vertex(id));
  }

  std::optional<Part> part;
  std::optional<detail::Kinetic_types<Disc_kinetic_traits_2>::Hidden_events> hidden;
};

// The corners 0, 1 and 2, lifted by the squared distance from 0 minus the weight, are on the plane
// z = -36 + 75/8 x + 53/8 y, which is 30.75 at (5, 3): 34 less the weight 3.25.
TEST_F(Hidden_events, make_a_disc_that_grows_a_vertex) {
  start(disc(5, 3, 0, 0.5, 1));
  EXPECT_TRUE(execute_first());
  EXPECT_FALSE(part->topology.is_hidden(4));
  EXPECT_EQ(part->topology.number_of_hidden_vertices(), 0u);
  EXPECT_EQ(part->topology.triangulation().degree(part->topology.vertex(4)), 3u);
  EXPECT_EQ(part->counters.events[static_cast<std::size_t>(Event_kind::reveal)], 1u);
  const Algebraic_number now = part->schedule.current_time();
  const Rational radius_before = Rational(1, 2) + now.lower();
  const Rational radius_after = Rational(1, 2) + now.upper();
  const Rational weight(13, 4);
  EXPECT_LE(Rational(radius_before * radius_before), weight);
  EXPECT_GE(Rational(radius_after * radius_after), weight);
}

TEST_F(Hidden_events, move_a_disc_that_passes_a_side_into_the_triangle_beyond) {
  start(disc(5, 4, -1, 0.5));
  ASSERT_TRUE(has_corner(1));
  EXPECT_TRUE(execute_first());
  EXPECT_EQ(part->schedule.current_time(), Algebraic_number(1.0)) << "on the diagonal";
  EXPECT_TRUE(part->topology.is_hidden(4));
  EXPECT_FALSE(has_corner(1));
  EXPECT_TRUE(has_corner(3));
  EXPECT_EQ(part->counters.number_of_events(), 0u) << "nothing that observers are told";
  part->reporter.keep_trail();
  EXPECT_NE(part->topology.vertex(4)->event(), no_event) << "it reaches the left side later";
}

TEST_F(Hidden_events, make_a_disc_that_leaves_the_hull_a_vertex) {
  start(disc(2, 4, -1, 0.5));
  EXPECT_TRUE(execute_first());
  EXPECT_EQ(part->schedule.current_time(), Algebraic_number(2.0));
  EXPECT_FALSE(part->topology.is_hidden(4));
  EXPECT_TRUE(part->topology.triangulation().is_edge(
      part->topology.vertex(4), part->topology.triangulation().infinite_vertex()));
}

TEST_F(Hidden_events, place_a_disc_by_its_weight) {
  start(disc(5, 4, 0, 0.5));
  const auto place = [&](const Disc_motion_2& motion) {
    const Point_id id = part->topology.give_ids(1);
    part->topology.set_point({id, motion});
    const auto v = part->topology.vertex(id);
    part->reporter.start_noting();
    EXPECT_TRUE(hidden->place(v, part->topology.locate(v->point(), {})));
    part->reporter.report_edges();
    return v->is_hidden();
  };
  EXPECT_TRUE(place(disc(6, 3, 0, 0)));
  EXPECT_FALSE(place(disc(4, 6, 0, 4)));
  EXPECT_TRUE(place(disc(8, 0, 0, 1))) << "in the place of a heavier one";
  EXPECT_FALSE(place(disc(20, 0, 0, 0))) << "beyond the hull";
}

TEST_F(Hidden_events, ask_for_a_reconstruction_where_a_heavier_disc_comes) {
  start(disc(5, 4, 0, 0.5));
  const Point_id id = part->topology.give_ids(1);
  part->topology.set_point({id, disc(8, 0, 0, 7)});
  const auto v = part->topology.vertex(id);
  part->reporter.start_noting();
  EXPECT_FALSE(hidden->place(v, part->topology.locate(v->point(), {})));
}

TEST_F(Hidden_events, find_a_disc_with_the_trajectory_and_the_weight_of_another) {
  start(disc(5, 4, 0, 0.5));
  using Pairs = std::vector<Edge_ids>;
  const auto found = [&](const Disc_motion_2& motion, std::vector<Point_id> changed) {
    const Part::Point_2 point(motion, 9);
    Pairs result;
    part->topology.find_coincident(point, part->topology.locate(point, {}), changed, result);
    return result;
  };
  EXPECT_EQ(found(disc(5, 4, 0, 0.5), {}), (Pairs{{4, 9}})) << "a hidden one";
  ASSERT_EQ(found(disc(8, 0, 0, 5), {}).size(), 1u) << "a vertex";
  EXPECT_EQ(found(disc(5, 4, 0, 0.5), {4}), Pairs()) << "which gets another one";
  EXPECT_EQ(found(disc(5, 4, 0, 0.25), {}), Pairs()) << "of another weight";
  EXPECT_EQ(found(disc(5, 4, 1, 0.5), {}), Pairs()) << "of another velocity";
}

}  // namespace
}  // namespace kinetri::hidden_events_test
