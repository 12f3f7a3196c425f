// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls, discs and scheduled changes of points that accelerate.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/kinetic_runs.h"
#include "support/message_of.h"

namespace kinetri::accelerated_simulation_test {
namespace {

using test::discs;
using test::in_box;
using test::message_of;
using test::Recorder;
using Simulation = Simulation_2<Polynomial_kinetic_traits_2>;

TEST(Accelerated_points, bounce_from_the_floor_at_exact_times) {
  // y = 1 - t^2: down at time 1, then up and down again in 2 units of time.
  Simulation simulation({{{0.5, 1}, {0, 0}, {0, -2}, {0, 0}, 0}}, in_box({0, 0, 1, 4}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(100.0);
  ASSERT_EQ(recorder.contacts().size(), 50u);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(recorder.contacts()[i].time, Algebraic_number(2.0 * static_cast<double>(i) + 1));
    EXPECT_EQ(recorder.contacts()[i].kind, Event_kind::wall);
  }
  EXPECT_EQ(simulation.triangulation().motion(0),
            (Polynomial_motion_2{{0.5, 0}, {0, 2}, {0, -2}, {0, 0}, 99}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Accelerated_points, reach_walls_at_irrational_times) {
  // x = t^3 is 10 at the cube root of 10; y = 1 + t^2 / 2 is 10 later.
  Simulation simulation({{{0, 1}, {0, 0}, {0, 1}, {6, 0}, 0}}, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(3.0);
  ASSERT_EQ(recorder.contacts().size(), 1u);
  EXPECT_TRUE(recorder.contacts()[0].time.is_root_of(Polynomial{-10, 0, 0, 1}));
}

TEST(Accelerated_points, that_only_touch_a_wall_are_not_reflected) {
  // y = (t - 1)^2
  Simulation simulation({{{1, 1}, {0, -2}, {0, 2}, {0, 0}, 0}}, in_box({0, 0, 2, 20}));
  EXPECT_EQ(simulation.advance_to(3.0), 0u);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Accelerated_points, pressed_against_a_wall_end_the_run_with_their_name) {
  const Simulation_options options = in_box({0, 0, 2, 2});
  Simulation simulation(
      {{{0.5, 1}, {0, 0}, {0, 0}, {0, 0}, 0}, {{1, 0}, {0, 0}, {0, -1}, {0, 0}, 0}}, options);
  const std::string message =
      message_of<Endless_contacts_error>([&] { simulation.advance_to(1.0); });
  EXPECT_NE(message.find("point 1 accelerates toward the lower wall at t = 0"), std::string::npos)
      << message;
  // It is still to come, and does not if the point has another motion.
  EXPECT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>());
  Simulation restored = Simulation::restore(simulation.snapshot(), nullptr);
  EXPECT_EQ(message_of<Endless_contacts_error>([&] { restored.advance_to(1.0); }), message);
  EXPECT_EQ(message_of<Endless_contacts_error>([&] { simulation.advance_to(1.0); }), message);
  simulation.set_motion(1, {{1, 0}, {0, 0}, {0, 1}, {0, 0}, 0});
  simulation.advance_to(1.0);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

// Two discs that touch, at rest, and accelerate toward each other.
const std::vector<Polynomial_motion_2> pressed = {{{0, 0}, {0, 0}, {1, 0}, {0, 0}, 0},
                                                  {{2, 0}, {0, 0}, {-1, 0}, {0, 0}, 0}};

TEST(Pressed_discs, end_the_run_with_their_names_where_velocities_are_exchanged) {
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    const Simulation_options options = discs(1, response);
    Simulation simulation(pressed, options);
    const std::string message =
        message_of<Endless_contacts_error>([&] { simulation.advance_to(3.0); });
    EXPECT_NE(message.find("points 0 and 1 accelerate toward each other at t = 0"),
              std::string::npos)
        << message;
  }
}

TEST(Pressed_discs, stay_where_they_are_if_they_stop) {
  const Simulation_options options = discs(1, stop_both);
  Simulation simulation(pressed, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(3.0);
  EXPECT_EQ(recorder.contacts().size(), 1u);
  EXPECT_EQ(simulation.triangulation().motion(0), (Polynomial_motion_2{{0, 0}, {}, {}, {}, 0}));
  EXPECT_EQ(simulation.triangulation().motion(1), (Polynomial_motion_2{{2, 0}, {}, {}, {}, 0}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Pressed_discs, pass_if_contacts_are_only_logged) {
  const Simulation_options options = discs(1, log_contact);
  Simulation simulation(pressed, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(3.0);
  EXPECT_EQ(recorder.contacts().size(), 1u);
}

TEST(Pressed_discs, are_told_to_the_response_which_may_kick_them_apart) {
  Simulation_options options;
  options.radius = 1;
  int calls = 0;
  options.response = [&calls](const Contact_2& contact) {
    EXPECT_EQ(contact.is_pressed, calls == 0);  // later they come back with a speed
    ++calls;
    return Contact_response_2{Vector_2{-1, 0}, Vector_2{1, 0}};
  };
  Simulation simulation(pressed, options);
  simulation.advance_to(3.0);
  EXPECT_EQ(calls, 2);  // at 0 and at 2
}

TEST(Accelerated_discs, that_stop_stay) {
  const Simulation_options options = discs(1, stop_both);
  Simulation simulation(
      {{{0, 0}, {0, 0}, {1, 0}, {0, 0}, 0}, {{3.1, 0.3}, {0, 0}, {-1, 0}, {0, 0}, 0}}, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(8.0);
  EXPECT_EQ(recorder.contacts().size(), 1u);
  for (Point_id id = 0; id < 2; ++id) {
    EXPECT_TRUE(is_at_rest(simulation.triangulation().motion(id)));
  }
}

TEST(Accelerated_discs, that_part_and_come_back_before_they_are_apart_collide) {
  // Along x at a distance of 1 + t - t^2 / 2, with a diameter of 2: greatest at t = 1, where it is
  // 1.5. They overlap throughout, and approach from then on.
  const Simulation_options options = discs(1, log_contact);
  Simulation simulation({{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0}, {{1, 0}, {1, 0}, {-1, 0}, {0, 0}, 0}},
                        options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(2.0);
  ASSERT_EQ(recorder.contacts().size(), 1u);
  EXPECT_EQ(recorder.contacts()[0].time, Algebraic_number(1.0));
}

TEST(Accelerated_discs, that_part_and_come_back_are_logged_again) {
  // Their distance is 2 - (t - 1) (t - 2) (t - 3), that of their touch 2.
  const Simulation_options options = discs(1, log_contact);
  Simulation simulation(
      {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0}, {{8, 0}, {-11, 0}, {12, 0}, {-6, 0}, 0}}, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  for (const double time : {0.5, 1.0, 1.5, 2.0, 2.5, 2.75, 3.0, 3.5}) {
    simulation.advance_to(time);
    const Audit_report report = simulation.audit(Audit_level::certificates);
    ASSERT_TRUE(report.passed()) << time << ": " << report.failures.front();
  }
  ASSERT_EQ(recorder.contacts().size(), 2u);
  EXPECT_EQ(recorder.contacts()[0].time, Algebraic_number(1.0));
  EXPECT_EQ(recorder.contacts()[1].time, Algebraic_number(3.0));
}

TEST(Accelerated_discs, that_have_passed_may_vanish_when_they_come_back) {
  // As above; the second contact erases one of them.
  Simulation_options options;
  options.radius = 1;
  int calls = 0;
  options.response = [&calls](const Contact_2&) {
    Contact_response_2 result;
    result.erases_b = ++calls == 2;
    return result;
  };
  Simulation simulation(
      {{{0, 0}, {0, 0}, {0, 0}, {0, 0}, 0}, {{8, 0}, {-11, 0}, {12, 0}, {-6, 0}, 0}}, options);
  simulation.advance_to(3.5);
  EXPECT_EQ(calls, 2);
  EXPECT_FALSE(simulation.triangulation().contains(1));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

// Balls on a lattice that fall, some of them also with a jerk of their own.
std::vector<Polynomial_motion_2> falling_balls(int side, bool has_jerk, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Polynomial_motion_2> result;
  for (int i = 0; i < side * side; ++i) {
    Polynomial_motion_2 m;
    m.position = {4.0 * (i % side) + unit(random), 4.0 * (i / side) + unit(random)};
    m.velocity = {3 * unit(random), 3 * unit(random)};
    m.acceleration = {0, -2};
    if (has_jerk && i % 3 == 0) m.jerk = {unit(random), 0};
    result.push_back(m);
  }
  return result;
}

Box_2 box_of(int side) {
  return {-2, -2, 4.0 * side - 2, 4.0 * side - 2};
}

TEST(Accelerated_discs, keep_their_energy_in_a_box_and_are_audited) {
  constexpr int side = 5;
  Simulation simulation(falling_balls(side, false, 1),
                        discs(box_of(side), 0.7, collide_elastically));
  const auto energy = [&] {
    double sum = 0;
    for (Point_id id = 0; id < side * side; ++id) {
      const Polynomial_motion_2& m = simulation.triangulation().motion(id);
      const double t = simulation.current_time().to_double();
      const Vector_2 v = rounded_velocity(m, t);
      sum += (v.x * v.x + v.y * v.y) / 2 + 2 * rounded_place(m, t).y;
    }
    return sum;
  };
  const double before = energy();
  for (int second = 1; second <= 10; ++second) {
    simulation.advance_to(static_cast<double>(second));
    const Audit_report report = simulation.audit(Audit_level::certificates);
    ASSERT_TRUE(report.passed()) << report.failures.front();
  }
  const auto& events = simulation.triangulation().counters().events;
  EXPECT_GT(events[static_cast<std::size_t>(Event_kind::collision)], 100u);
  EXPECT_GT(events[static_cast<std::size_t>(Event_kind::wall)], 30u);
  // Rounded places and velocities: not exact, as for all responses.
  EXPECT_NEAR(energy(), before, 1e-9 * before);
}

TEST(Accelerated_discs, have_the_same_events_without_filters) {
  constexpr int side = 3;
  const auto events_with = [&](const Polynomial_kinetic_traits_2& traits) {
    Simulation simulation(falling_balls(side, true, 2),
                          discs(box_of(side), 0.7, collide_elastically), Algebraic_number(),
                          traits);
    Recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(4.0);
    return recorder.events;
  };
  const auto filtered = events_with(Polynomial_kinetic_traits_2());
  EXPECT_GT(filtered.size(), 50u);
  EXPECT_EQ(test::difference(filtered, events_with(Polynomial_kinetic_traits_2::exact())), "");
}

TEST(Accelerated_discs, go_on_from_a_snapshot_as_if_there_had_been_no_break) {
  constexpr int side = 4;
  const auto options = discs(box_of(side), 0.7, collide_elastically);
  Simulation whole(falling_balls(side, true, 3), options);
  Simulation first(falling_balls(side, true, 3), options);
  Recorder expected;
  whole.add_observer(expected);
  Recorder actual;
  first.add_observer(actual);
  first.advance_to(1.3);
  auto second = Simulation::restore(first.snapshot(), collide_elastically);
  second.add_observer(actual);
  second.advance_to(3.0);
  whole.advance_to(3.0);
  EXPECT_GT(expected.events.size(), 60u);
  EXPECT_EQ(test::difference(expected.events, actual.events), "");
}

TEST(Accelerated_points, come_turn_and_go_by_schedule) {
  Simulation simulation(falling_balls(3, true, 4), {});
  const Point_id comes = simulation.schedule_insert(0.5, {{3, 3}, {1, 0}, {0, 5}, {0, 0}, 0.5});
  simulation.schedule_motion(1.0, 0, {{0, 9}, {1, 0}, {0, -5}, {1, 1}, 1.0});
  simulation.schedule_erase(1.5, 4);
  simulation.advance_to(2.0);
  EXPECT_TRUE(simulation.triangulation().contains(comes));
  EXPECT_FALSE(simulation.triangulation().contains(4));
  EXPECT_EQ(simulation.triangulation().motion(0).jerk, (Vector_2{1, 1}));
  const Audit_report report = simulation.audit(Audit_level::certificates);
  EXPECT_TRUE(report.passed()) << report.failures.front();
}

}  // namespace
}  // namespace kinetri::accelerated_simulation_test
