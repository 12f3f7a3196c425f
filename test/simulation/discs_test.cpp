// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs of which a few collide: when they do, and the velocities with which they part.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/message_of.h"

namespace kinetri::discs_test {
namespace {

using test::count;
using test::discs;
using test::Recorder;
using test::Simulation;
using test::velocity;

TEST(Discs, that_swap_velocities_pass_them_on_to_a_resting_one) {
  // Centers 0 and 5 apart, diameter 2: contact at time 3.
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, swap_velocities));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(4.0);
  const auto collisions = recorder.of(Event_kind::collision);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].time, Algebraic_number(3.0));
  EXPECT_EQ(collisions[0].point_a, 0u);
  EXPECT_EQ(collisions[0].point_b, 1u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
}

TEST(Discs, that_pass_at_just_their_diameter_do_not_collide) {
  const std::vector<Linear_motion_2> motions = {
      {{-5, 2}, {1, 0}, 0}, {{0, 0}, {0, 0}, 0}, {{0, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  simulation.advance_to(20.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 0u);
}

TEST(Discs, that_overlap_at_the_start_collide_at_once_only_if_they_approach) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {-1, 0}, 0},                           // part
      {{1, 0}, {1, 0}, 0},     {{20, 0}, {1, 0}, 0},  // approach
      {{21, 0.5}, {-1, 0}, 0}, {{40, 3}, {0, 0}, 0},  // rest
      {{41, 3}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(1.0);
  const auto collisions = recorder.of(Event_kind::collision);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].point_a, 2u);
  EXPECT_EQ(collisions[0].point_b, 3u);
  EXPECT_EQ(collisions[0].time, Algebraic_number(0.0));
}

TEST(Discs, that_are_logged_are_found_behind_one_that_overlaps_both) {
  // On one line: 0 and 2 come toward 1, which rests between them, and are no neighbors.
  Simulation simulation({{{0, 0}, {1, 0}, 0}, {{3, 0}, {0, 0}, 0}, {{6, 0}, {-1, 0}, 0}},
                        discs(1, log_contact));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(7.0);
  const auto contacts = recorder.of(Event_kind::collision);
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0].time, Algebraic_number(1.0));
  EXPECT_EQ(contacts[1].time, Algebraic_number(1.0));
  EXPECT_EQ(contacts[2].time, Algebraic_number(2.0));
  EXPECT_EQ(contacts[2].point_a, 0u);
  EXPECT_EQ(contacts[2].point_b, 2u);
}

TEST(Discs, that_overlap_without_being_neighbors_collide_at_once_if_they_approach) {
  // Point 1 lies between 0 and 2, which approach; it moves with 0.
  Simulation simulation({{{0, 0}, {1, 0}, 0}, {{1, 0}, {1, 0}, 0}, {{1.5, 0}, {0, 0}, 0}},
                        discs(1, collide_elastically));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(0.0);
  const auto contacts = recorder.of(Event_kind::collision);
  ASSERT_GE(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].point_a, 0u);
  EXPECT_EQ(contacts[0].point_b, 2u);
  EXPECT_EQ(contacts[0].time, Algebraic_number(0.0));
}

TEST(Discs, of_a_cradle_pass_the_velocity_on) {
  // Ten touching discs on a line that is no axis, hit by an eleventh.
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 10; ++i) motions.push_back({{6.0 * i, 8.0 * i}, {0, 0}, 0});
    motions.push_back({{-30, -40}, {3, 4}, 0});
    Simulation simulation(motions, discs(5, response));
    simulation.advance_to(20.0);
    EXPECT_EQ(count(simulation, Event_kind::collision), 10u);
    for (Point_id id = 0; id < 9; ++id) {
      EXPECT_NEAR(velocity(simulation, id).x, 0, 1e-12);
      EXPECT_NEAR(velocity(simulation, id).y, 0, 1e-12);
    }
    EXPECT_NEAR(velocity(simulation, 9).x, 3, 1e-12);
    EXPECT_NEAR(velocity(simulation, 10).y, 0, 1e-12);
  }
}

TEST(Discs, of_two_trains_that_meet_head_on_turn_back) {
  // In the middle, touching, and in motion: simultaneous contacts until the order is reversed.
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 6; ++i) motions.push_back({{2.0 * i, 0}, {1, 0}, 0});
  for (int i = 0; i < 6; ++i) motions.push_back({{20 + 2.0 * i, 0}, {-1, 0}, 0});
  Simulation simulation(motions, discs(1, collide_elastically));
  simulation.advance_to(50.0);
  for (Point_id id = 0; id < 6; ++id) EXPECT_NEAR(velocity(simulation, id).x, -1, 1e-12);
  for (Point_id id = 6; id < 12; ++id) EXPECT_NEAR(velocity(simulation, id).x, 1, 1e-12);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Discs, three_at_one_instant_end_apart) {
  // One comes between two that touch.
  const double height = std::sqrt(3.0);
  const std::vector<Linear_motion_2> motions = {
      {{-1, 0}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, height + 4}, {0, -1}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  EXPECT_EQ(test::audited_run(simulation, 30, Audit_level::reference), "");
  EXPECT_GE(count(simulation, Event_kind::collision), 2u);
  for (Point_id a = 0; a < 3; ++a) {
    for (Point_id b = 0; b < a; ++b) {
      EXPECT_FALSE(Linear_kinetic_traits_2().do_approach(
          simulation.triangulation().vertex(a)->point(),
          simulation.triangulation().vertex(b)->point(), simulation.current_time()));
    }
  }
}

TEST(Discs, meet_the_box_in_a_corner) {
  // One rests in the corner, the other drives it in along the diagonal.
  Simulation_options options = discs({0, 0, 20, 20}, 1, collide_elastically);
  options.rim_touches = true;
  Simulation simulation({{{1, 1}, {0, 0}, 0}, {{5, 5}, {-1, -1}, 0}}, options);
  EXPECT_EQ(test::audited_run(simulation, 40, Audit_level::certificates), "");
  EXPECT_GT(count(simulation, Event_kind::wall), 0u);
}

TEST(Discs, that_all_but_coincide_still_collide) {
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    for (const double distance : {1e-13, 1e-200, 5e-324}) {
      SCOPED_TRACE(distance);
      const std::vector<Linear_motion_2> motions = {
          {{0, 0}, {1, 0}, 0}, {{distance, 0}, {0, 0}, 0}, {{0, 30}, {0, 0}, 0}};
      Simulation simulation(motions, discs(1, response));
      EXPECT_EQ(test::audited_run(simulation, 10, Audit_level::certificates), "");
      EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
      EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
      EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
    }
  }
}

// Near an irrational time the places, rounded, may be the same, or such that no velocities part
// the discs: then they go through each other.
TEST(Discs, that_nothing_parts_keep_their_motions) {
  Contact_2 contact;
  contact.velocity_a = {1, 2};
  contact.velocity_b = {-1, 0};
  contact.would_approach = [](const Vector_2& a, const Vector_2& b) {
    EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(a.y));
    EXPECT_LT(std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y), 100);
    return true;
  };
  for (const Vector_2& separation : {Vector_2{0, 0}, Vector_2{1e-13, 0}, Vector_2{0, 1e-300}}) {
    contact.separation = separation;
    for (const auto response : {swap_velocities, collide_elastically}) {
      const Contact_response_2 result = response(contact);
      EXPECT_FALSE(result.velocity_a || result.velocity_b || result.erases_a || result.erases_b);
    }
  }
}

TEST(Discs, that_stop_stay) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0.5}, {-1, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, stop_both));
  simulation.advance_to(100.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{0, 0}));
}

TEST(Discs, that_are_erased_are_gone) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0.5}, {-1, 0}, 0}, {{2, 9}, {0, -1}, 0}, {{-5, 4}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, erase_both));
  EXPECT_EQ(test::audited_run(simulation, 20, Audit_level::certificates), "");
  EXPECT_FALSE(simulation.triangulation().contains(0));
  EXPECT_FALSE(simulation.triangulation().contains(1));
  EXPECT_EQ(simulation.triangulation().number_of_points(), 2u);
}

TEST(Discs, take_a_response_of_one_s_own) {
  // The heavier one, by its id, goes on; the other is thrown away at double speed.
  std::vector<Contact_2> contacts;
  const Collision_response response = [&](const Contact_2& contact) {
    contacts.push_back(contact);
    return Contact_response_2{Vector_2{-2 * contact.velocity_b.x, 0}, std::nullopt};
  };
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{-4, 0}, {1, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, [&](const Contact_2& c) {
                          Contact_response_2 r = response(c);
                          r.velocity_a->x = -r.velocity_a->x;
                          return r;
                        }));
  simulation.advance_to(10.0);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].time, 2.0);
  EXPECT_EQ(contacts[0].point_a, 0u);
  EXPECT_EQ(contacts[0].separation, (Vector_2{-2, 0}));
  EXPECT_EQ(contacts[0].velocity_b, (Vector_2{1, 0}));
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{2, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
}

TEST(Discs, whose_response_never_parts_them_are_named) {
  const Collision_response stubborn = [](const Contact_2& contact) {
    return Contact_response_2{Vector_2{contact.velocity_a.x * 2, 0}, std::nullopt};
  };
  Simulation_options options = discs(1, stubborn);
  options.max_contacts_per_instant = 50;
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, options);
  const std::string message =
      test::message_of<Endless_contacts_error>([&] { simulation.advance_to(10.0); });
  EXPECT_NE(message.find("point 0 and point 1"), std::string::npos) << message;
}

// Points 0 and 1, of which 0 comes into a corner at t = 1, and so meets two walls.
TEST(Contacts_without_end, are_those_beyond_the_limit) {
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {-1, -1}, 0}, {{2, 3}, {0, 0}, 0}};
  Simulation_options options = test::in_box({0, 0, 10, 10});
  options.max_contacts_per_instant = 2;
  Simulation allowed(motions, options);
  EXPECT_EQ(allowed.advance_to(3.0), 2u);
  options.max_contacts_per_instant = 1;
  Simulation simulation(motions, options);
  try {
    simulation.advance_to(3.0);
    ADD_FAILURE() << "two contacts are more than one";
  } catch (const Endless_contacts_error& error) {
    EXPECT_EQ(error.point(), 0u);
    EXPECT_STREQ(error.what(),
                 "more than 1 contacts at t = 1, the last one of point 0 and a wall; expected that "
                 "time goes on: let the points touch one by one, or take another response");
  }
}

// Three discs on a line that pass one another, or turn, at a limit of no contacts.
TEST(Contacts_without_end, are_none_where_discs_keep_their_motions) {
  const std::vector<Linear_motion_2> motions = {
      {{-2, 0}, {1, 0}, 0}, {{2, 0}, {-1, 0}, 0}, {{0, 9}, {0, 0}, 0}, {{8, 0}, {-5, 0}, 0}};
  Simulation_options options = discs(1, log_contact);
  options.max_contacts_per_instant = 0;
  Simulation passing(motions, options);
  EXPECT_GT(passing.advance_to(10.0), 2u);
  EXPECT_EQ(passing.number_of_passes(), 3u);
  options.response = swap_velocities;
  Simulation simulation(motions, options);
  EXPECT_THROW(simulation.advance_to(10.0), Endless_contacts_error);
}

}  // namespace
}  // namespace kinetri::discs_test
