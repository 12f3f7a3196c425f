// SPDX-License-Identifier: GPL-3.0-or-later
//
// Snapshots of the simulation: contacts and scheduled changes. That a run goes on from one as if
// there had been no break is tested through files: test/io/checkpoint_file_test.cpp.
#include "kinetri/simulation/simulation_2.h"

#include <gtest/gtest.h>

#include "support/disc_runs.h"
#include "support/message_of.h"
#include "support/precondition_error.h"

namespace kinetri::simulation_snapshot_test {
namespace {

using test::count;
using test::discs;
using test::Simulation;
using Snapshot = Simulation::Snapshot;

// Discs 0 and 1 approach along a line, and touch at t = 4 - radius.
std::vector<Linear_motion_2> two_and_two() {
  return {{{-4, 0}, {1, 0}, 0}, {{4, 0}, {-1, 0}, 0}, {{0, 50}, {0, 0}, 0}, {{0, -40}, {0, 0}, 0}};
}

TEST(Simulation_snapshot, knows_the_discs_left_in_contact) {
  Simulation simulation(two_and_two(), discs(1, log_contact));
  simulation.advance_to(3.5);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  const Snapshot snapshot = simulation.snapshot();
  EXPECT_EQ(snapshot.in_contact, (std::vector<Edge_ids>{{0, 1}}));
  auto restored = Simulation::restore(snapshot, log_contact);
  restored.advance_to(10.0);
  EXPECT_EQ(count(restored, Event_kind::collision), 1u);
  EXPECT_EQ(simulation.contact_counters().instants, 1u);
  EXPECT_EQ(restored.contact_counters().instants, 1u);
  auto forgetful = Simulation::restore(
      [&] {
        Snapshot forgets = snapshot;
        forgets.in_contact.clear();
        return forgets;
      }(),
      log_contact);
  forgetful.advance_to(10.0);
  EXPECT_EQ(count(forgetful, Event_kind::collision), 2u);
}

TEST(Simulation_snapshot, keeps_a_contact_that_is_due) {
  Simulation simulation(two_and_two(), discs(1, swap_velocities));
  simulation.insert({{-5, 0.5}, {9, 0}, 0});
  auto restored = Simulation::restore(simulation.snapshot(), swap_velocities);
  simulation.step();
  restored.step();
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  EXPECT_EQ(count(restored, Event_kind::collision), 1u);
  EXPECT_EQ(restored.current_time(), Algebraic_number(0.0));
}

TEST(Simulation_snapshot, keeps_scheduled_changes_in_their_order) {
  Simulation simulation(two_and_two(), {});
  const Point_id id = simulation.schedule_insert(Algebraic_number(3.0), {{9, 9}, {0, 0}, 0});
  simulation.schedule_motion(Algebraic_number(2.0), 2, {{1, 60}, {1, 0}, 0});
  simulation.schedule_motion(Algebraic_number(2.0), 2, {{2, 60}, {2, 0}, 0});
  simulation.schedule_erase(Algebraic_number(1.0), 3);
  simulation.advance_to(1.5);
  simulation.schedule_erase(Algebraic_number(1.5), 0);
  const Snapshot snapshot = simulation.snapshot();
  ASSERT_EQ(snapshot.scheduled.size(), 4u);
  EXPECT_EQ(snapshot.scheduled[0].kind, Event_kind::insert);
  EXPECT_EQ(snapshot.scheduled[0].point, id);
  EXPECT_EQ(snapshot.scheduled[3].kind, Event_kind::erase);
  auto restored = Simulation::restore(snapshot, nullptr);
  EXPECT_TRUE(restored.triangulation().contains(0));
  restored.schedule_motion(Algebraic_number(2.0), 2, {{3, 60}, {3, 0}, 0});
  restored.advance_to(4.0);
  EXPECT_FALSE(restored.triangulation().contains(0));
  EXPECT_FALSE(restored.triangulation().contains(3));
  EXPECT_TRUE(restored.triangulation().contains(id));
  EXPECT_EQ(restored.triangulation().motion(2).velocity, (Vector_2{3, 0}));
  EXPECT_EQ(count(restored, Event_kind::trajectory), 3u);
}

TEST(Simulation_snapshot, is_not_taken_within_an_instant) {
  const Simulation* taken = nullptr;
  int calls = 0;
  const auto take = [&](const Contact_2&) -> Contact_response_2 {
    ++calls;
    EXPECT_PRECONDITION_ERROR(
        taken->snapshot(),
        "a snapshot within an instant; take it when advance_to or step has returned");
    return {};
  };
  Simulation_options options = discs(1, take);
  options.coincident = Coincident_points::refuse;
  Simulation simulation(two_and_two(), options);
  taken = &simulation;
  simulation.advance_to(3.5);
  EXPECT_EQ(calls, 1);
  EXPECT_NO_THROW(simulation.snapshot());
  simulation.schedule_motion(Algebraic_number(4.0), 2, simulation.triangulation().motion(3));
  EXPECT_THROW(simulation.advance_to(5.0), Coincident_trajectories_error);
  EXPECT_PRECONDITION_ERROR(
      simulation.snapshot(),
      "a snapshot within an instant; take it when advance_to or step has returned");
}

TEST(Simulation_snapshot, that_is_no_state_is_refused) {
  Simulation_options options = discs({-10, -50, 10, 60}, 1, log_contact);
  Simulation simulation(two_and_two(), options);
  simulation.schedule_insert(Algebraic_number(9.0), {{1, 1}, {0, 0}, 0});
  simulation.advance_to(3.5);
  const Snapshot whole = simulation.snapshot();
  Snapshot forged = whole;
  const auto expect = [&](const std::string& reason) {
    const std::string message = test::message_of<Snapshot_error>(
        [&forged] { const auto restored = Simulation::restore(forged, log_contact); });
    EXPECT_NE(message.find(reason), std::string::npos) << reason << "; found: " << message;
    forged = whole;
  };
  forged.options.radius = -1;
  expect("the radius is negative");
  forged.options.radius = 0;
  expect("such discs never touch");
  forged.options.box->xmax = -10;
  expect("the box has no area");
  forged.options.rim_touches = true;
  forged.options.radius = 10;
  expect("the box is not wider and higher than a disc");
  forged.options.box->ymax = 49;
  expect("the snapshot cannot be used: point 2 is outside of the box");
  forged.in_contact = {{1, 0}};
  expect("points 1 and 0 in contact");
  forged.in_contact = {{0, 0}};
  expect("points 0 and 0 in contact");
  forged.in_contact = {{0, 1}, {0, 1}};
  expect("points 0 and 1 in contact");
  forged.in_contact = {{1, 4}};
  expect("points 1 and 4 in contact");
  const std::string no_change = "a scheduled change of point";
  forged.scheduled[0].time = 3.0;
  expect(no_change);
  forged.scheduled[0].point = 5;
  expect(no_change);
  forged.scheduled[0].point = 2;
  expect(no_change);
  forged.scheduled.push_back(forged.scheduled[0]);
  expect(no_change);
  forged.scheduled[0].kind = Event_kind::erase;
  expect(no_change);
  forged.scheduled[0].kind = Event_kind::flip;
  expect(no_change);
  forged.scheduled[0].motion.reset();
  expect(no_change);
  forged.scheduled[0].motion->epoch = std::numeric_limits<double>::quiet_NaN();
  expect(no_change);
  EXPECT_PRECONDITION_ERROR(Simulation::restore(whole, nullptr),
                            "a response where the snapshot's simulation had none, or none where it "
                            "had one; pass one if and only if has_response is set");
}

}  // namespace
}  // namespace kinetri::simulation_snapshot_test
