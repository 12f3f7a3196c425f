// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that are inserted, redirected and erased by a simulation, now and by schedule.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/disc_runs.h"
#include "support/precondition_error.h"

namespace kinetri::scheduled_changes_test {
namespace {

using test::count;
using test::in_box;
using test::Recorder;
using test::Simulation;
using Events = std::vector<Event>;

// The triangle in which the others move.
std::vector<Linear_motion_2> triangle() {
  return {{{-50, -50}, {0, 0}, 0}, {{50, -50}, {0, 0}, 0}, {{0, 80}, {0, 0}, 0}};
}

Events without_edges(const Events& events) {
  Events result;
  for (const auto& event : events) {
    if (event.kind >= Event_kind::wall) result.push_back(event);
  }
  return result;
}

TEST(Scheduled_changes, happen_at_their_exact_times) {
  Simulation simulation(triangle(), {});
  Recorder recorder;
  simulation.add_observer(recorder);
  const Algebraic_number third(Rational(1, 3));
  const Point_id id = simulation.schedule_insert(third, {{1, 2}, {3, 4}, 0});
  simulation.schedule_motion(Algebraic_number(2.0), id, {{7, 10}, {-1, 0}, 2});
  simulation.schedule_erase(Algebraic_number(5.0), id);
  EXPECT_EQ(id, 3u);
  EXPECT_FALSE(simulation.triangulation().contains(id));
  EXPECT_EQ(simulation.step(), 4u);  // the point, and its three edges
  EXPECT_EQ(simulation.current_time(), third);
  EXPECT_TRUE(simulation.triangulation().contains(id));
  EXPECT_EQ(test::audited_run(simulation, 6, Audit_level::certificates), "");
  EXPECT_FALSE(simulation.triangulation().contains(id));
  const Events events = without_edges(recorder.events);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, Event_kind::insert);
  EXPECT_EQ(events[1].kind, Event_kind::trajectory);
  EXPECT_EQ(events[1].time, Algebraic_number(2.0));
  EXPECT_EQ(events[2].kind, Event_kind::erase);
  for (const auto& event : events) EXPECT_EQ(event.point_a, id);
}

TEST(Scheduled_changes, of_one_time_erase_then_turn_then_insert) {
  std::vector<Linear_motion_2> motions = triangle();
  motions.push_back({{0, 0}, {1, 0}, 0});
  motions.push_back({{5, 5}, {0, 0}, 0});
  Simulation simulation(motions, {});
  Recorder recorder;
  simulation.add_observer(recorder);
  // The new point takes the trajectory of the one that leaves, which is scheduled last.
  simulation.schedule_insert(Algebraic_number(1.0), motions[3]);
  simulation.schedule_motion(Algebraic_number(1.0), 4, {{5, 5}, {1, 1}, 1});
  simulation.schedule_motion(Algebraic_number(1.0), 4, {{5, 5}, {2, 1}, 1});
  simulation.schedule_erase(Algebraic_number(1.0), 3);
  simulation.advance_to(2.0);
  const Events events = without_edges(recorder.events);
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[0].kind, Event_kind::erase);
  EXPECT_EQ(events[1].kind, Event_kind::trajectory);
  EXPECT_EQ(events[2].kind, Event_kind::trajectory);
  EXPECT_EQ(events[3].kind, Event_kind::insert);
  EXPECT_EQ(simulation.triangulation().motion(4).velocity, (Vector_2{2, 1}));
  EXPECT_TRUE(simulation.triangulation().contains(5));
}

TEST(Scheduled_changes, wait_for_others_of_the_same_time_that_make_way) {
  // Two exchange their trajectories.
  std::vector<Linear_motion_2> motions = triangle();
  motions.push_back({{0, 0}, {1, 0}, 0});
  motions.push_back({{5, 5}, {0, 1}, 0});
  Simulation_options options;
  options.coincident = Coincident_points::refuse;
  Simulation simulation(motions, options);
  simulation.schedule_motion(Algebraic_number(1.0), 3, motions[4]);
  simulation.schedule_motion(Algebraic_number(1.0), 4, {{9, 9}, {0, 0}, 0});
  simulation.advance_to(2.0);
  EXPECT_EQ(simulation.triangulation().motion(3), motions[4]);
  EXPECT_EQ(test::audited_run(simulation, 3, Audit_level::certificates), "");
  // Nobody makes way for this one.
  simulation.schedule_motion(Algebraic_number(4.0), 4, motions[4]);
  EXPECT_THROW(simulation.advance_to(5.0), Coincident_trajectories_error);
}

TEST(Scheduled_changes, of_points_that_are_gone_are_dropped) {
  Simulation simulation(triangle(), {});
  const Point_id id = simulation.schedule_insert(Algebraic_number(1.0), {{1, 2}, {3, 4}, 0});
  simulation.schedule_erase(Algebraic_number(2.0), id);
  simulation.schedule_erase(Algebraic_number(3.0), id);
  simulation.schedule_motion(Algebraic_number(3.0), id, {{0, 0}, {1, 0}, 0});
  simulation.advance_to(4.0);
  EXPECT_EQ(count(simulation, Event_kind::erase), 1u);
  EXPECT_EQ(count(simulation, Event_kind::trajectory), 0u);
}

TEST(Scheduled_changes, of_points_that_are_gone_are_no_events) {
  Simulation simulation(triangle(), {});
  simulation.schedule_erase(Algebraic_number(1.0), 2);
  simulation.schedule_motion(Algebraic_number(3.0), 2, {{0, 0}, {1, 0}, 0});
  simulation.schedule_erase(Algebraic_number(4.0), 2);
  EXPECT_EQ(simulation.step(), 3u);  // the point, and its two edges
  EXPECT_EQ(simulation.step(Algebraic_number(5.0)), 0u);
  EXPECT_EQ(simulation.step(), 0u);
  EXPECT_EQ(simulation.current_time(), Algebraic_number(1.0));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Scheduled_changes, that_cannot_be_made_are_dropped_and_the_others_made) {
  std::vector<Linear_motion_2> motions = triangle();
  motions.push_back({{0, 0}, {1, 0}, 0});
  motions.push_back({{5, 5}, {0, 1}, 0});
  Simulation_options options = in_box({-100, -100, 100, 100});
  options.coincident = Coincident_points::refuse;
  Simulation simulation(motions, options);
  const Algebraic_number one(1.0);
  // Three wait for point 4 to make way, which it does not; then one leads out of the box.
  simulation.schedule_motion(one, 3, motions[4]);
  const Point_id same = simulation.schedule_insert(one, motions[4]);
  const Point_id outside = simulation.schedule_insert(one, {{101, 0}, {0, 0}, 0});
  const Point_id last = simulation.schedule_insert(one, {{3, 3}, {0, 0}, 0});
  EXPECT_THROW(simulation.advance_to(2.0), Outside_box_error);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  EXPECT_THROW(simulation.advance_to(2.0), Coincident_trajectories_error);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  EXPECT_TRUE(simulation.triangulation().contains(last));
  simulation.erase(4);
  EXPECT_EQ(test::audited_run(simulation, 2, Audit_level::certificates), "");
  EXPECT_TRUE(simulation.triangulation().contains(same));
  EXPECT_FALSE(simulation.triangulation().contains(outside));
  EXPECT_EQ(simulation.triangulation().motion(3), motions[3]);
}

TEST(Scheduled_changes, that_have_no_meaning_are_refused) {
  const Simulation_options options = in_box({-100, -100, 100, 100});
  Simulation simulation(triangle(), options);
  simulation.advance_to(1.0);
  EXPECT_PRECONDITION_ERROR(simulation.schedule_erase(Algebraic_number(0.5), 0),
                            "a change in the past; take the present time or a later one");
  EXPECT_PRECONDITION_ERROR(simulation.schedule_erase(Algebraic_number(2.0), 3),
                            "no point has the id 3; take one that insert or schedule_insert gave");
  EXPECT_PRECONDITION_ERROR(
      simulation.advance_to(0.5),
      "the time to advance to is in the past; take the present one or a later one");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(
      simulation.schedule_motion(Algebraic_number(2.0), 1, {{0, 0}, {0, infinity}, 0}),
      "the motion of point 1 has a number that is not finite");
  EXPECT_THROW(simulation.insert({{101, 0}, {0, 0}, 0}), Outside_box_error);
  EXPECT_THROW(simulation.set_motion(0, {{0, 99}, {0, 2}, 0}), Outside_box_error);
  simulation.schedule_insert(Algebraic_number(2.0), {{0, 99}, {0, 1}, 0});
  EXPECT_THROW(simulation.advance_to(3.0), Outside_box_error);
}

TEST(Scheduled_changes, may_be_scheduled_by_an_observer) {
  struct Stopper : Simulation::Observer {
    explicit Stopper(Simulation& s) : simulation(s) {}
    void after_event(const Event& event) override {
      if (event.kind != Event_kind::wall) return;
      simulation.schedule_erase(event.time, *event.point_a);
      simulation.schedule_insert(event.time, {{0, 0}, {7, 0}, event.time.to_double()});
    }
    Simulation& simulation;
  };
  std::vector<Linear_motion_2> motions = triangle();
  motions.push_back({{0, 0}, {7, 0}, 0});
  const Simulation_options options = in_box({-100, -100, 49, 100});
  motions[1].position.x = 40;
  Simulation simulation(motions, options);
  Stopper stopper(simulation);
  simulation.add_observer(stopper);
  EXPECT_EQ(test::audited_run(simulation, 70, Audit_level::reference), "");
  EXPECT_EQ(count(simulation, Event_kind::wall), 10u);
  EXPECT_EQ(simulation.triangulation().next_id(), 14u);
  EXPECT_EQ(simulation.triangulation().number_of_points(), 4u);
}

// The same changes, once scheduled at the start and once made when the time has come, among walls
// and discs: the same events.
TEST(Scheduled_changes, are_those_made_when_the_time_has_come) {
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-4, 30);
    std::uniform_real_distribution<double> speed(-5, 5);
    Simulation_options options = in_box(test::box_of(12));
    if (seed % 3 != 0) {
      options.radius = 1;
      options.response = seed % 3 == 1 ? collide_elastically : log_contact;
    }
    const auto motions = test::discs_in_a_box(12, 0.2, seed);
    Simulation scheduled(motions, options);
    Simulation immediate(motions, options);
    Recorder one;
    Recorder other;
    scheduled.add_observer(one);
    immediate.add_observer(other);
    struct Change {
      double time;
      int kind;
      Point_id id;
      Linear_motion_2 motion;
    };
    std::vector<Change> changes;
    for (int i = 1; i <= 30; ++i) {
      const double time = 0.125 * i;
      const Linear_motion_2 motion = {{place(random), place(random)}, {speed(random), 0}, time};
      Change change = {time, static_cast<int>(random() % 3), 0, motion};
      if (change.kind == 0) {
        change.id = scheduled.schedule_insert(Algebraic_number(time), motion);
      } else {
        change.id = static_cast<Point_id>(random() % scheduled.triangulation().next_id());
        if (change.kind == 1) {
          scheduled.schedule_motion(Algebraic_number(time), change.id, motion);
        } else {
          scheduled.schedule_erase(Algebraic_number(time), change.id);
        }
      }
      changes.push_back(change);
    }
    for (const Change& change : changes) {
      immediate.advance_to(change.time);
      const bool is_there = immediate.triangulation().contains(change.id);
      if (change.kind == 0) {
        EXPECT_EQ(immediate.insert(change.motion), change.id);
      } else if (is_there && change.kind == 1) {
        immediate.set_motion(change.id, change.motion);
      } else if (is_there) {
        immediate.erase(change.id);
      }
    }
    immediate.advance_to(5.0);
    ASSERT_EQ(test::audited_run(scheduled, 5.0, Audit_level::reference), "");
    ASSERT_EQ(one.events.size(), other.events.size());
    for (std::size_t i = 0; i < one.events.size(); ++i) {
      ASSERT_EQ(one.events[i].kind, other.events[i].kind);
      ASSERT_EQ(one.events[i].time, other.events[i].time);
      ASSERT_EQ(one.events[i].added, other.events[i].added);
      ASSERT_EQ(one.events[i].removed, other.events[i].removed);
      ASSERT_EQ(one.events[i].point_a, other.events[i].point_a);
    }
  }
}

TEST(Motions_at_once, are_as_one_after_the_other) {
  // In a box, with discs that collide elastically: all turn, then every third.
  Simulation_options options = test::discs(3, collide_elastically);
  options.box = test::box_of(25);
  const auto motions = test::discs_in_a_box(25, 0.2, 3);
  Simulation together(motions, options);
  Simulation apart(motions, options);
  Recorder recorder;
  Recorder expected;
  together.add_observer(recorder);
  apart.add_observer(expected);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> component(-5, 5);
  for (int round = 1; round <= 8; ++round) {
    const double now = 0.375 * round;
    together.advance_to(now);
    apart.advance_to(now);
    std::vector<Point_id> ids;
    std::vector<Linear_motion_2> turned;
    for (Point_id id = 0; id < 25; id += round % 2 == 0 ? 1U : 3U) {
      const double vx = component(random);
      ids.push_back(id);
      turned.push_back(
          with_velocity_at(apart.triangulation().motion(id), {vx, component(random)}, now));
      apart.set_motion(id, turned.back());
    }
    together.set_motions(ids, turned);
    EXPECT_EQ(together.triangulation().finite_edge_ids(), apart.triangulation().finite_edge_ids());
    const Audit_report report = together.audit(Audit_level::certificates);
    ASSERT_TRUE(report.passed()) << report.failures.front();
  }
  together.advance_to(4.0);
  apart.advance_to(4.0);
  for (const Event_kind kind : {Event_kind::collision, Event_kind::wall, Event_kind::trajectory}) {
    const auto found = recorder.of(kind);
    const auto others = expected.of(kind);
    ASSERT_EQ(found.size(), others.size());
    EXPECT_GT(found.size(), 3u);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].time, others[i].time);
      EXPECT_EQ(found[i].point_a, others[i].point_a);
      EXPECT_EQ(found[i].point_b, others[i].point_b);
    }
  }
}

TEST(Motions_at_once, that_lead_out_of_the_box_change_nothing) {
  Simulation simulation({{{1, 1}, {1, 0}, 0}, {{2, 2}, {0, 1}, 0}}, test::in_box({0, 0, 4, 4}));
  const std::vector<Point_id> ids = {0, 1};
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {0, 1}, 0}, {{5, 2}, {0, 1}, 0}};
  try {
    simulation.set_motions(ids, motions);
    FAIL() << "a point outside of the box";
  } catch (const Outside_box_error& error) {
    EXPECT_EQ(error.point(), 1u);
  }
  EXPECT_EQ(simulation.triangulation().motion(0), (Linear_motion_2{{1, 1}, {1, 0}, 0}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

// When a point reaches a wall at a time that is no binary64 number, its place at the nearest one
// may be beyond the wall: it goes on from inside.
TEST(Velocities_at_once, at_a_wall_keep_the_points_inside) {
  int at_walls = 0;
  for (int i = 1; i <= 40; ++i) {
    Simulation simulation({{{0.1, 1}, {0.1 + 0.07 * i, 0}, 0}, {{2, 3}, {-0.01, 0}, 0}},
                          test::in_box({0, 0, 4, 4}));
    ASSERT_GT(simulation.step(), 0u);
    const std::vector<Point_id> ids = {0};
    const std::vector<Vector_2> up = {{0, 1}};
    simulation.set_velocities(ids, up);
    ASSERT_TRUE(simulation.audit(Audit_level::delaunay).passed());
    at_walls += simulation.triangulation().motion(0).position.x == 4 ? 1 : 0;
  }
  EXPECT_GT(at_walls, 10);
}

TEST(Velocities_at_once, go_on_from_the_places_now) {
  Simulation simulation({{{1, 1}, {1, 0}, 0}, {{2, 2}, {0, 1}, 0}}, test::in_box({0, 0, 4, 4}));
  simulation.advance_to(1.5);
  const std::vector<Point_id> ids = {1, 0};
  const std::vector<Vector_2> velocities = {{-1, 0}, {0, -2}};
  simulation.set_velocities(ids, velocities);
  EXPECT_EQ(simulation.triangulation().motion(0), (Linear_motion_2{{2.5, 1}, {0, -2}, 1.5}));
  EXPECT_EQ(simulation.triangulation().motion(1), (Linear_motion_2{{2, 3.5}, {-1, 0}, 1.5}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Velocities_at_once, that_cannot_be_change_nothing) {
  Simulation simulation({{{1, 1}, {1, 0}, 0}, {{2, 2}, {0, 1}, 0}}, test::in_box({0, 0, 4, 4}));
  const std::vector<Point_id> ids = {0, 1};
  const std::vector<Vector_2> one = {{1, 1}};
  const std::vector<Vector_2> infinite = {{1, 1}, {0, std::numeric_limits<double>::infinity()}};
  const auto message = [&](std::span<const Point_id> points, std::span<const Vector_2> velocities) {
    try {
      simulation.set_velocities(points, velocities);
    } catch (const Precondition_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message(ids, one).find("2 ids and 1 velocities"), std::string::npos);
  EXPECT_NE(message(ids, infinite).find("the velocity of point 1 is not finite"),
            std::string::npos);
  EXPECT_EQ(simulation.triangulation().motion(0), (Linear_motion_2{{1, 1}, {1, 0}, 0}));
}

}  // namespace
}  // namespace kinetri::scheduled_changes_test
