// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls: when points reach them, and the motions with which they leave.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"

namespace kinetri::walls_test {
namespace {

using test::count;
using test::in_box;
using test::Recorder;
using test::Simulation;
using test::velocity;

TEST(Walls, have_corners_that_are_counterclockwise) {
  const auto corners = Box_2{1, 2, 3, 5}.corners();
  EXPECT_EQ(corners, (std::array<Vector_2, 4>{{{1, 2}, {3, 2}, {3, 5}, {1, 5}}}));
}

TEST(Walls, are_reached_at_exact_times) {
  // A third of a unit of time is no binary64 number.
  Simulation simulation({{{5, 5}, {1, 3}, 0}}, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(6.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 3u);
  EXPECT_EQ(walls[0].time, Algebraic_number(Rational(5, 3)));
  EXPECT_EQ(walls[0].point_a, 0u);
  EXPECT_EQ(walls[0].point_b, std::nullopt);
  EXPECT_NEAR(walls[1].time.to_double(), 5, 1e-14);
  EXPECT_NEAR(walls[2].time.to_double(), 5, 1e-14);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{-1, 3}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Walls, at_a_corner_both_reflect_at_one_time) {
  Simulation simulation({{{5, 5}, {-1, -1}, 0}}, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  EXPECT_EQ(simulation.step(), 2u);
  ASSERT_EQ(recorder.events.size(), 2u);
  EXPECT_EQ(recorder.events[0].time, Algebraic_number(5.0));
  EXPECT_EQ(recorder.events[1].time, Algebraic_number(5.0));
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{1, 1}));
  EXPECT_EQ(simulation.contact_counters().most_at_one_time, 2u);
}

TEST(Walls, reflect_a_point_that_starts_on_a_side_only_outward) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 5}, {-1, 0}, 0}, {{0, 6}, {1, 0}, 0}, {{0, 7}, {0, 1}, 0}, {{0, 0}, {-1, -2}, 0}};
  Simulation simulation(motions, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(0.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 3u);  // point 3 twice
  for (const auto& wall : walls) EXPECT_EQ(wall.time, Algebraic_number(0.0));
  EXPECT_EQ(walls[0].point_a, 0u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{1, 0}));
  EXPECT_EQ(velocity(simulation, 3), (Vector_2{1, 2}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Walls, are_reached_by_several_points_at_one_instant) {
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 8; ++i) motions.push_back({{5, i + 1.0}, {i % 2 == 0 ? 1.0 : -1.0, 0}, 0});
  Simulation simulation(motions, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(5.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 8u);
  for (Point_id id = 0; id < 8; ++id) {
    EXPECT_EQ(walls[id].time, Algebraic_number(5.0));
    EXPECT_EQ(walls[id].point_a, id);
  }
  EXPECT_EQ(test::audited_run(simulation, 30, Audit_level::certificates), "");
}

TEST(Walls, are_touched_by_the_rim_if_asked) {
  Simulation_options options = in_box({0, 0, 10, 10});
  options.radius = 0.1;
  options.rim_touches = true;
  Simulation simulation({{{5, 5}, {1, 0}, 0}}, options);
  simulation.step();
  // The radius is the binary64 number next to 0.1, taken exactly.
  EXPECT_EQ(simulation.current_time(), Algebraic_number(Rational(5 - to_rational(0.1))));
}

TEST(Walls, keep_points_inside_through_many_bounces) {
  std::vector<Linear_motion_2> motions = test::random_motions(4, 1, 5, 3);
  Simulation simulation(motions, in_box({0, 0, 1, 1}));
  std::vector<Vector_2> speeds;
  for (const Linear_motion_2& m : motions) {
    speeds.push_back({std::abs(m.velocity.x), std::abs(m.velocity.y)});
  }
  const std::uint64_t bounces = test::cases<std::uint64_t>(25000u);
  std::uint64_t exact_in_first_half = 0;
  while (count(simulation, Event_kind::wall) < bounces) {
    simulation.step();
    if (count(simulation, Event_kind::wall) == bounces / 2) {
      exact_in_first_half = simulation.certificate_counters().exact_decided;
    }
  }
  // Inside exactly, at the speed that it had, exactly.
  const Audit_report report = simulation.audit(Audit_level::certificates);
  EXPECT_TRUE(report.passed()) << report.failures.front();
  for (Point_id id = 0; id < motions.size(); ++id) {
    const Vector_2 v = velocity(simulation, id);
    EXPECT_EQ((Vector_2{std::abs(v.x), std::abs(v.y)}), speeds[id]);
  }
  const Certificate_counters counters = simulation.certificate_counters();
  std::printf("exact decisions: %llu in the first half, %llu in all, of %llu; time %.0f\n",
              static_cast<unsigned long long>(exact_in_first_half),
              static_cast<unsigned long long>(counters.exact_decided),
              static_cast<unsigned long long>(counters.created),
              simulation.current_time().to_double());
  EXPECT_LE(counters.exact_decided - exact_in_first_half, 2 * exact_in_first_half + 100);
}

TEST(Walls, stay_right_on_coarse_grids) {
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    const auto motions = test::grid_motions(1 + seed % 7, 4, 2, seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + '\n' + test::describe(motions));
    Simulation simulation(motions, in_box({0, 0, 3, 3}));
    // Two that start from one place of a side, one of them inward and the other its mirror image,
    // coincide from then on.
    ASSERT_EQ(test::audited_run(simulation, 6, Audit_level::reference), "");
  }
}

}  // namespace
}  // namespace kinetri::walls_test
