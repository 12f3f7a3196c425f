// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulations as a whole, and their options. Their parts: walls_test.cpp, discs_test.cpp,
// contacts_test.cpp, scheduled_changes_test.cpp.
#include "kinetri/simulation/simulation_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/disc_runs.h"
#include "support/precondition_error.h"

namespace kinetri::simulation_2_test {
namespace {

using test::discs;
using test::in_box;
using test::Recorder;
using test::Simulation;

TEST(Simulation_options, that_have_no_meaning_are_refused) {
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {1, 0}, 0}};
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [&](const Simulation_options& options, const char* message) {
    EXPECT_PRECONDITION_ERROR(Simulation(motions, options), message);
  };
  for (const Box_2& box : {Box_2{0, 0, 0, 10}, Box_2{0, 10, 10, 0}, Box_2{0, 0, infinity, 10},
                           Box_2{0, 0, std::nan(""), 10}}) {
    refuses(in_box(box), "the box has no area or is not finite");
  }
  refuses(discs(-1, log_contact), "the radius is negative, or the diameter is not finite");
  refuses(discs(infinity, log_contact), "the radius is negative, or the diameter is not finite");
  refuses(discs(0, log_contact),
          "the radius is 0, and such discs never touch; expected a radius greater than 0");
  Simulation_options rim = in_box({0, 0, 2, 10});
  rim.radius = 1;
  rim.rim_touches = true;
  refuses(rim, "the box is not wider and higher than a disc whose rim touches it");
}

TEST(Simulation_options, name_a_point_outside_of_the_box) {
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {1, 0}, 0}, {{1, 10.5}, {0, 1}, 0}};
  try {
    Simulation simulation(motions, in_box({0, 0, 10, 10}));
    FAIL() << "no error";
  } catch (const Outside_box_error& error) {
    EXPECT_EQ(error.point(), 1u);
    EXPECT_EQ(std::string(error.what()).find("point 1 is outside of the box at t = 0: at "), 0u)
        << error.what();
  }
  EXPECT_NO_THROW(Simulation(motions, in_box({1, 1, 2, 10.5})));
}

TEST(Simulation, of_free_points_is_the_triangulation) {
  const auto motions = test::random_motions(50, 70, 5, 5);
  Simulation simulation(motions, {});
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  EXPECT_EQ(simulation.advance_to(3.0), kinetic.advance_to(3.0));
  EXPECT_EQ(simulation.triangulation().finite_edge_ids(), kinetic.finite_edge_ids());
  EXPECT_EQ(simulation.contact_counters().queue.pushed, 0u);
}

TEST(Simulation, decides_the_same_without_filters) {
  const Simulation_options options = discs(test::box_of(16), 3, collide_elastically);
  const auto motions = test::discs_in_a_box(16, 0.2, 4);
  Simulation filtered(motions, options);
  Simulation exact(motions, options, 0.0, Linear_kinetic_traits_2::exact());
  Recorder one;
  Recorder other;
  filtered.add_observer(one);
  exact.add_observer(other);
  filtered.advance_to(3.0);
  exact.advance_to(3.0);
  ASSERT_EQ(one.events.size(), other.events.size());
  EXPECT_GT(one.of(Event_kind::collision).size(), 10u);
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].kind, other.events[i].kind);
    EXPECT_EQ(one.events[i].time, other.events[i].time);
    EXPECT_EQ(one.events[i].point_a, other.events[i].point_a);
    EXPECT_EQ(one.events[i].added, other.events[i].added);
  }
  for (Point_id id = 0; id < 16; ++id) {
    EXPECT_EQ(filtered.triangulation().motion(id), exact.triangulation().motion(id));
  }
}

// One point that reaches a wall, one that never does, and a change that is to come.
TEST(Simulation, tells_the_present_length_of_its_queue) {
  Simulation simulation({{{5, 5}, {1, 0}, 0}, {{6, 6}, {0, 0}, 0}}, in_box({0, 0, 10, 10}));
  EXPECT_EQ(simulation.queue_size(), 1u);
  simulation.schedule_erase(2.0, 0);
  EXPECT_EQ(simulation.queue_size(), 2u);
  simulation.advance_to(2.0);
  EXPECT_EQ(simulation.queue_size(), 0u);
}

TEST(Simulation, is_as_before_when_it_refuses_to_change_a_point_twice) {
  Simulation simulation({{{1, 1}, {1, 0.25}, 0}, {{5, 5}, {0, 0.5}, 0}, {{8, 2}, {0, 0}, 0}},
                        in_box({0, 0, 10, 10}));
  const std::size_t entries = simulation.queue_size();
  const std::vector<Point_id> ids = {0, 0};
  const Linear_motion_2 motion = {{1, 1}, {1, 0}, 0};
  const std::vector<Linear_motion_2> motions = {motion, motion};
  EXPECT_PRECONDITION_ERROR(simulation.set_motions(ids, motions),
                            "point 0 is named twice; expected each point once");
  EXPECT_PRECONDITION_ERROR(simulation.set_velocities(ids, std::vector<Vector_2>{{1, 0}, {0, 1}}),
                            "point 0 is named twice; expected each point once");
  EXPECT_EQ(simulation.queue_size(), entries);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  EXPECT_EQ(simulation.advance_to(12.0), 2u);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

}  // namespace
}  // namespace kinetri::simulation_2_test
