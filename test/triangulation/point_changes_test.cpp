// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of points, of which the loop executes the flips.
#include "kinetri/impl/triangulation/point_changes.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "support/kinetic_parts.h"
#include "support/message_of.h"
#include "support/precondition_error.h"

namespace kinetri::point_changes_test {
namespace {

using Core = detail::Kinetic_core<Linear_kinetic_traits_2>;
using Change = detail::Point_change<Linear_motion_2>;
using Edge_set = std::set<Edge_ids>;

/// Points at the time 1, and changes of them.
struct Point_changes : testing::Test {
  Point_changes() {
    core.start_with(test::points_of<Moving_point_2>(motions), motions.size());
    core.loop.run_to(1.0, nullptr);
  }

  Edge_set edges() const {
    const auto ids = core.topology.finite_edges();
    return {ids.begin(), ids.end()};
  }
  /// Makes the changes as one event each. Compares the edges that it says have changed.
  void perform(const std::vector<Change>& changes) {
    std::vector<Event> events(changes.size());
    for (std::size_t i = 0; i < changes.size(); ++i) {
      events[i].kind = Event_kind::trajectory;
      events[i].point_a = changes[i].point;
      if (changes[i].motion) motions[changes[i].point] = *changes[i].motion;
    }
    Edge_set expected = edges();
    const Changed_edges changed = core.changes.perform(events, changes);
    for (const Edge_ids& edge : changed.removed) EXPECT_EQ(expected.erase(edge), 1u);
    for (const Edge_ids& edge : changed.added) EXPECT_TRUE(expected.insert(edge).second);
    EXPECT_EQ(edges(), expected) << "what is returned accounts for all edges";
    EXPECT_EQ(core.schedule.current_time(), Algebraic_number(1.0));
  }

  std::vector<Linear_motion_2> motions = test::random_motions(10, 10, 1, 3);
  Core core{Linear_kinetic_traits_2(), 0.0};
};

TEST_F(Point_changes, of_velocities_keep_the_triangles_and_change_what_comes) {
  const Edge_set before = edges();
  perform({{4, with_velocity_at(motions[4], {-3, 2}, 1.0)}});
  EXPECT_EQ(edges(), before);
  EXPECT_EQ(core.counters.events[static_cast<std::size_t>(Event_kind::trajectory)], 1u);
  core.loop.run_to(2.5, nullptr);
  EXPECT_EQ(edges(), test::edges_after(motions, 2.5));
}

// A few points jump one by one, many of them by a reconstruction.
TEST_F(Point_changes, to_other_places_leave_the_edges_of_those) {
  for (const Point_id n : {1u, 2u, 5u, 10u}) {
    SCOPED_TRACE(n);
    const auto others = test::random_motions(n, 10, 1, 30 + n);
    std::vector<Change> changes;
    for (Point_id id = 0; id < n; ++id) changes.push_back({id, others[id]});
    perform(changes);
    EXPECT_EQ(edges(), test::edges_after(motions, 1.0));
  }
}

TEST_F(Point_changes, of_points_that_come_and_go_leave_the_edges_of_those_that_are_there) {
  const Point_id id = core.topology.give_ids(1);
  motions.push_back({});
  perform({{id, Linear_motion_2{{20, -5}, {1, 0}, 0}}});
  EXPECT_EQ(edges(), test::edges_after(motions, 1.0));
  perform({{id, std::nullopt}});
  motions.pop_back();
  EXPECT_FALSE(core.topology.contains(id));
  EXPECT_EQ(edges(), test::edges_after(motions, 1.0));
}

TEST_F(Point_changes, are_one_event_each_in_the_order_of_ids) {
  struct Observer : Event_observer {
    void after_event(const Event& event) override {
      if (event.kind == Event_kind::trajectory) points.push_back(*event.point_a);
    }
    std::vector<Point_id> points;
  } observer;
  core.reporter.observers().add(observer);
  core.changes.change_all(Event_kind::trajectory,
                          {{7, motions[8]}, {2, motions[7]}, {8, motions[2]}});
  EXPECT_EQ(observer.points, (std::vector<Point_id>{2, 7, 8}));
}

TEST_F(Point_changes, that_are_refused_change_nothing) {
  core.topology.refuse_twins();
  struct Observer : Event_observer {
    void before_event(const Event&) override { ADD_FAILURE() << "an event"; }
  } observer;
  core.reporter.observers().add(observer);
  const Edge_set before = edges();
  const std::size_t size = core.schedule.queue().size();
  const auto refusal = [&](const std::vector<Change>& changes) {
    return test::message_of<Coincident_trajectories_error>(
        [&] { core.changes.change_all(Event_kind::trajectory, changes); });
  };
  EXPECT_NE(refusal({{1, motions[6]}}), "");
  EXPECT_NE(
      refusal({{1, Linear_motion_2{{3, 3}, {0, 0}, 0}}, {2, Linear_motion_2{{3, 3}, {0, 0}, 5}}}),
      "");
  EXPECT_PRECONDITION_ERROR(
      core.changes.change_all(Event_kind::trajectory, {{3, motions[3]}, {3, motions[4]}}),
      "point 3 is named twice; expected each point once");
  EXPECT_EQ(edges(), before);
  EXPECT_EQ(core.schedule.queue().size(), size);
  for (Point_id id = 0; id < 10; ++id) {
    EXPECT_EQ(core.topology.vertex(id)->point().motion(), motions[id]);
  }
}

}  // namespace
}  // namespace kinetri::point_changes_test
