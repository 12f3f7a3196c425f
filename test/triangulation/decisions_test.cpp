// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/decisions.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/kinetic_parts.h"

namespace kinetri::decisions_test {
namespace {

using detail::Action;
using detail::Entry_kind;

/// What the first failure leads to, and which edge it is of.
template <class Traits>
struct First_decision {
  using Part = test::Schedule_part<Traits>;

  explicit First_decision(const std::vector<typename Traits::Motion>& motions) : part(motions) {
    EXPECT_TRUE(part.schedule.settle(nullptr));
    part.schedule.set_current_time(part.schedule.queue().time(part.schedule.queue().top()));
    const auto entry = part.schedule.queue().pop();
    kind = entry.kind;
    edge = Part::Topology::ids_of(entry.edge());
    const auto now = [&]() -> const Algebraic_number& { return part.schedule.current_time(); };
    decision = detail::Decisions<Traits>(part.certification)
                   .decide(entry, part.topology.with_mirror(entry.edge()),
                           part.schedule.current_bounds(), now);
  }

  Part part;
  Entry_kind kind = Entry_kind::recheck;
  Edge_ids edge = {};
  typename detail::Decisions<Traits>::Decision decision;
};
using Decision = First_decision<Linear_kinetic_traits_2>;
using Curved_decision = First_decision<Polynomial_kinetic_traits_2>;
using Disc_decision = First_decision<Disc_kinetic_traits_2>;

using test::resting;

Polynomial_motion_2 curve(double x, double y, double vy = 0, double ay = 0) {
  Polynomial_motion_2 result;
  result.position = {x, y};
  result.velocity = {0, vy};
  result.acceleration = {0, ay};
  return result;
}

Disc_motion_2 disc(double x, double y, double vy, double radius, double growth = 0) {
  return {{{x, y}, {0, vy}, 0}, radius, growth, 0};
}

TEST(Decision, of_points_that_become_cocircular_is_a_flip) {
  const Decision first({resting(0, 0), resting(2, 0), resting(2, 2), {{0, 3}, {0, -1}}});
  EXPECT_EQ(first.kind, Entry_kind::flip);
  EXPECT_EQ(first.decision.action, Action::flip);
  EXPECT_FALSE(first.decision.is_hull_flat);
}

TEST(Decision, of_a_point_that_leaves_the_hull_is_a_flip_of_the_hull_edge) {
  const Decision first({resting(0, 0), resting(4, 0), resting(2, 5), {{2, 1}, {0, -1}}});
  EXPECT_EQ(first.kind, Entry_kind::hull_insert);
  EXPECT_EQ(first.edge, (Edge_ids{0, 1}));
  EXPECT_EQ(first.decision.action, Action::flip);
  EXPECT_TRUE(first.decision.is_hull_flat);
}

TEST(Decision, of_a_hull_vertex_that_comes_inside_is_a_flip) {
  const Decision first({resting(0, 0), resting(4, 0), resting(2, 5), {{2, -0.125}, {0, 1}}});
  EXPECT_EQ(first.kind, Entry_kind::hull_remove);
  EXPECT_EQ(first.edge, (Edge_ids{3, no_point}));
  EXPECT_EQ(first.decision.action, Action::flip);
}

TEST(Decision, of_a_point_that_only_touches_the_hull_is_another_certificate) {
  // At height (1 - t)^2.
  const Curved_decision first({curve(0, 0), curve(4, 0), curve(2, 5), curve(2, 1, -2, 2)});
  EXPECT_EQ(first.kind, Entry_kind::hull_insert);
  EXPECT_EQ(first.part.schedule.current_time(), Algebraic_number(1.0));
  EXPECT_EQ(first.decision.action, Action::reschedule);
}

TEST(Decision, of_points_that_are_all_on_a_line_is_a_reconstruction) {
  const Decision first({resting(0, 0), resting(4, 0), {{2, 1}, {0, -1}}});
  EXPECT_EQ(first.kind, Entry_kind::hull_insert);
  EXPECT_EQ(first.decision.action, Action::rebuild);
  EXPECT_TRUE(first.decision.is_hull_flat);
}

TEST(Decision, where_a_flat_triangle_beside_the_hull_may_hide_a_turn_is_a_reconstruction) {
  // Points 3 and 4 come to the hull edge at one time; one of them only touches it.
  const Curved_decision first(
      {curve(0, 0), curve(6, 0), curve(3, 9), curve(2, 1, -1), curve(4, 1, -2, 2)});
  EXPECT_EQ(first.part.schedule.current_time(), Algebraic_number(1.0));
  EXPECT_EQ(first.decision.action, Action::rebuild);
}

// Without weights all decisions inside the hull are flips; with weights these are three more.
TEST(Weighted_decision, of_a_disc_that_falls_below_its_neighbors_is_to_hide_it) {
  const Disc_decision first(
      {disc(0, 0, 0, 3), disc(4, 0, 0, 3), disc(2, 4, 0, 3), disc(2, 1, 0, 3, -1)});
  EXPECT_EQ(first.kind, Entry_kind::flip);
  EXPECT_EQ(first.decision.action, Action::hide);
  EXPECT_EQ(first.decision.hidden, first.part.topology.vertex(3));
  EXPECT_FALSE(first.decision.is_hull_flat);
}

TEST(Weighted_decision, of_a_hull_vertex_that_its_neighbors_hide_is_to_hide_it) {
  const Disc_decision first(
      {disc(0, 0, 0, 3), disc(4, 0, 0, 3), disc(2, 4, 0, 3), disc(2, -1, 1, 0)});
  EXPECT_EQ(first.decision.action, Action::hide);
  EXPECT_EQ(first.decision.hidden, first.part.topology.vertex(3));
}

TEST(Weighted_decision, in_a_convex_quadrilateral_is_a_flip) {
  const Disc_decision first(
      {disc(0, 0, 0, 1), disc(2, 0, 0, 1), disc(2, 2, 0, 1), disc(0, 2, 0, 0.5, 0.1)});
  EXPECT_EQ(first.kind, Entry_kind::flip);
  EXPECT_EQ(first.decision.action, Action::flip);
}

TEST(Turn, is_that_just_after_the_time) {
  const test::Certification_part<Disc_kinetic_traits_2> part(
      {disc(0, 0, 0, 1), disc(4, 0, 0, 1), disc(2, 1, -1, 1), disc(2, 5, 0, 1)});
  const detail::Decisions<Disc_kinetic_traits_2> decisions(part.certification);
  const auto turn = [&](double time) {
    const Algebraic_number exact(time);
    const auto now = [&]() -> const Algebraic_number& { return exact; };
    const auto point = [&](Point_id id) -> const auto& {
      return part.topology.vertex(id)->point();
    };
    return decisions.turn(point(0), point(1), point(2), exact.interval(), now);
  };
  EXPECT_EQ(turn(0.5), CGAL::LEFT_TURN);
  EXPECT_EQ(turn(1.0), CGAL::RIGHT_TURN);
  EXPECT_EQ(turn(2.0), CGAL::RIGHT_TURN);
}

}  // namespace
}  // namespace kinetri::decisions_test
