// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/mean_cell_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "kinetri/simulation/tracks.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::mean_cell_areas_test {
namespace {

Walkable_area square() {
  return Walkable_area::from_wkt("POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))");
}

void expect_mean(const Mean_cell_area& mean, Point_id id, double from, double until, double area) {
  EXPECT_EQ(mean.id, id);
  EXPECT_EQ(mean.from, from);
  EXPECT_EQ(mean.until, until);
  EXPECT_NEAR(mean.area, area, mean.error);
  EXPECT_LT(mean.error, 1e-5 * area + 1e-12);
}

// The line between two points moves with constant velocity: areas are linear in time.
TEST(MeanCellAreas, of_linear_areas_are_known) {
  Simulation_2<> simulation({{{0.5, 2}, {0, 0}}, {{1.5, 2}, {1, 0}}}, {});
  Mean_cell_areas<> means(simulation, {square()});
  simulation.advance_to(1.0);
  const auto first = means.means();  // the line goes from x = 1 to x = 1.5
  ASSERT_EQ(first.size(), 2u);
  expect_mean(first[0], 0, 0, 1, 5);
  expect_mean(first[1], 1, 0, 1, 11);
  simulation.advance_to(2.0);
  const auto both = means.means();  // up to x = 2
  expect_mean(both[0], 0, 0, 2, 6);
  expect_mean(both[1], 1, 0, 2, 10);
}

// Points that come, turn and leave: 1 is there from t = 1 to t = 3, and halves the room.
TEST(MeanCellAreas, of_points_that_come_and_go_are_over_their_own_time) {
  Simulation_2<> simulation({{{1, 2}, {0, 0}}}, {});
  simulation.schedule_insert(1.0, {{3, 2}, {0, 0}});
  simulation.schedule_motion(2.0, 1, {{3, 2}, {0, 1}, 2});
  simulation.schedule_erase(3.0, 1);
  Mean_cell_areas<> means(simulation, {square()});
  simulation.advance_to(4.0);
  const auto result = means.means();
  ASSERT_EQ(result.size(), 2u);
  // While the second point climbs to (3, 2 + s), the line between is at x = 2 + s (2 + s / 2 - y) /
  // 2 for y from 0 to 4: to its left are 8 + s^2, on the mean 8 + 1 / 3.
  const double left = 8 + 1.0 / 3;
  expect_mean(result[0], 0, 0, 4, (16 + 8 + left + 16) / 4);
  expect_mean(result[1], 1, 1, 3, (8 + (16 - left)) / 2);
}

TEST(MeanCellAreas, within_a_circle_are_those_of_a_segment) {
  // Two points go apart: the segment beyond the line at h = (1 + t) / 2 from the first one is lost.
  Simulation_2<> simulation({{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}}, {});
  Mean_cell_areas<> means(simulation, {std::nullopt, 2}, 1e-10);
  simulation.advance_to(2.0);
  // The integral of r^2 acos(h / r) - h sqrt(r^2 - h^2) is, with x = h / r,
  // r^3 (x acos(x) - sqrt(1 - x^2) + (1 - x^2)^(3/2) / 3).
  const auto integral = [](double x) {
    return 8 * (x * std::acos(x) - std::sqrt(1 - x * x) + std::pow(1 - x * x, 1.5) / 3);
  };
  const double lost = 2 * (integral(0.75) - integral(0.25)) / 2;  // dh = dt / 2, over 2
  const double pi = std::acos(-1);
  expect_mean(means.means()[0], 0, 0, 2, 4 * pi - lost);
}

// The area jumps where the point goes out: the mean still is right within its error.
TEST(MeanCellAreas, of_a_point_that_leaves_the_area_count_that_time_as_zero) {
  Simulation_2<> simulation({{{1, 2}, {1, 0}}}, {});
  Mean_cell_areas<> means(simulation, {square()});
  simulation.advance_to(4.5);
  const auto result = means.means();
  EXPECT_NEAR(result[0].area, 16 * 3 / 4.5, result[0].error);
  EXPECT_LT(result[0].error, 0.1);
}

template <class Traits>
void expect_riemann_sum(Simulation_2<Traits>& simulation, const Cell_limits& limits, double until,
                        double tolerance, double most_error = 1e-2) {
  Mean_cell_areas<Traits> means(simulation, limits);
  std::map<Point_id, double> sums;
  std::map<Point_id, int> numbers;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    simulation.advance_to((i + 0.5) * until / steps);
    for (const auto& [id, area, error] : cell_areas(simulation.triangulation(), limits)) {
      sums[id] += area;
      ++numbers[id];
    }
  }
  simulation.advance_to(until);
  const auto result = means.means();
  ASSERT_EQ(result.size(), sums.size());
  for (const Mean_cell_area& mean : result) {
    SCOPED_TRACE(mean.id);
    EXPECT_NEAR(mean.area, sums[mean.id] / numbers[mean.id], tolerance);
    EXPECT_LT(mean.error, most_error);
  }
}

// Each step has an error of its square at most, and a jump one of a step times its height.
TEST(MeanCellAreas, of_random_points_are_near_to_riemann_sums) {
  const auto room = Walkable_area::from_wkt(
      "POLYGON((-2 -2, 10 -2, 10 10, -2 10, -2 -2),(3 3, 3 4, 4 4, 4 3, 3 3))");
  for (unsigned seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    Simulation_2<> simulation(test::random_motions(12, 8, 1, seed), {});
    expect_riemann_sum(simulation, {room, seed == 1 ? 2.0 : 1e9}, 2, 0.03);
  }
}

// Points join others, move with them, and leave them, also those that hide others: 1 joins 0 at t =
// 1, where 2 joins too, 0 leaves at t = 2, and 1 is erased at t = 3.
TEST(MeanCellAreas, of_points_that_coincide_for_a_while_are_equal_shares) {
  Simulation_2<> simulation({{{1, 2}, {0, 0}}, {{3, 2}, {0, 0}}, {{3, 2}, {0, 0}}}, {});
  simulation.schedule_motion(1.0, 1, {{1, 2}, {0, 0}});
  simulation.schedule_motion(1.0, 2, {{1, 2}, {0, 0}});
  simulation.schedule_motion(2.0, 0, {{3, 2}, {0, 0}});
  simulation.schedule_erase(3.0, 1);
  Mean_cell_areas<> means(simulation, {square()});
  simulation.advance_to(4.0);
  const auto result = means.means();
  ASSERT_EQ(result.size(), 3u);
  expect_mean(result[0], 0, 0, 4, (8 + 16 / 3.0 + 8 + 8) / 4);
  expect_mean(result[1], 1, 0, 3, (4 + 16 / 3.0 + 4) / 3);
  expect_mean(result[2], 2, 0, 4, (4 + 16 / 3.0 + 4 + 8) / 4);
}

// The cell of points that coincide changes with the motion of a neighbor.
TEST(MeanCellAreas, of_points_that_coincide_follow_their_neighbors) {
  Simulation_2<> simulation({{{0.5, 2}, {0, 0}}, {{1.5, 2}, {1, 0}}, {{0.5, 2}, {0, 0}}}, {});
  simulation.schedule_motion(1.0, 1, {{2.5, 2}, {-1, 0}, 1});
  Mean_cell_areas<> means(simulation, {square()});
  simulation.advance_to(2.0);  // the line goes from x = 1 to x = 1.5, and back
  const auto result = means.means();
  expect_mean(result[0], 0, 0, 2, 2.5);
  expect_mean(result[1], 1, 0, 2, 11);
  expect_mean(result[2], 2, 0, 2, 2.5);
}

// Points join others and leave them at random. Where they pass each other, areas jump.
TEST(MeanCellAreas, of_points_that_join_and_part_are_near_to_riemann_sums) {
  const auto room = Walkable_area::from_wkt("POLYGON((-3 -3, 5 -3, 5 5, -3 5, -3 -3))");
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto motions = test::coincident_motions(9, seed);
    Simulation_2<> simulation(motions, {});
    for (int k = 1; k <= 6; ++k) {
      const double time = 0.25 * k;
      const auto id = static_cast<Point_id>(random() % motions.size());
      if (k == 4) {
        simulation.schedule_erase(time, 0);
      } else {
        simulation.schedule_motion(time, id == 0 ? 1 : id, motions[random() % motions.size()]);
      }
    }
    hidden += simulation.triangulation().number_of_hidden_points();
    expect_riemann_sum(simulation, {room}, 2, 0.2, 0.2);
  }
  EXPECT_GT(hidden, 2u);
}

// A disc hides two points that coincide, until it is erased.
TEST(MeanCellAreas, of_coincident_points_are_zero_while_others_hide_all_of_them) {
  const std::vector<Disc_motion_2> discs = {{{{2, 2}, {0, 0}}, 2, 0, 0},
                                            {{{1, 2}, {0, 0}}, 0, 0, 0},
                                            {{{1, 2}, {0, 0}}, 0, 0, 0},
                                            {{{3, 2}, {0, 0}}, 1, 0, 0},
                                            {{{0, 2}, {0, 0}}, 0, 0, 0}};
  Kinetic_triangulation_2<Disc_kinetic_traits_2> kinetic(discs);
  Mean_cell_areas<Disc_kinetic_traits_2> means(kinetic, {square()});
  kinetic.advance_to(1.0);
  kinetic.erase(0);
  kinetic.advance_to(2.0);  // from x = 0.5 to x = 1.75
  const auto result = means.means();
  ASSERT_EQ(result.size(), 5u);
  expect_mean(result[1], 1, 0, 2, 1.25);
  expect_mean(result[2], 2, 0, 2, 1.25);
}

TEST(MeanCellAreas, of_discs_are_near_to_riemann_sums) {
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& motion : test::random_motions(10, 8, 1, 5)) {
    discs.push_back({motion, 0.25 * static_cast<double>(discs.size() % 4), 0.125, 0});
  }
  Simulation_2<Disc_kinetic_traits_2> simulation(discs, {});
  expect_riemann_sum(simulation,
                     {Walkable_area(std::vector<Vector_2>{{-2, -2}, {10, -2}, {10, 10}, {-2, 10}})},
                     2, 0.03);
}

// One disc hides all others; then the others come out.
TEST(MeanCellAreas, of_hidden_discs_are_zero_while_they_are_hidden) {
  std::vector<Disc_motion_2> discs = {{{{2, 2}, {0, 0}}, 3, 0, 0}, {{{2, 2}, {1, 0}}, 0, 0, 0}};
  Simulation_2<Disc_kinetic_traits_2> simulation(discs, {});
  Mean_cell_areas<Disc_kinetic_traits_2> means(simulation, {square()});
  simulation.advance_to(1.0);
  const auto result = means.means();
  ASSERT_EQ(result.size(), 2u);
  expect_mean(result[0], 0, 0, 1, 16);
  EXPECT_EQ(result[1].area, 0);
}

TEST(MeanCellAreas, want_a_limit_and_a_tolerance) {
  Simulation_2<> simulation({{{0, 0}, {0, 0}}}, {});
  EXPECT_PRECONDITION_ERROR(Mean_cell_areas<>(simulation, {}),
                            "cells of points on the convex hull are unbounded; expected a walkable "
                            "area, or a cutoff, or both");
  EXPECT_PRECONDITION_ERROR(Mean_cell_areas<>(simulation, {square()}, 0),
                            "the tolerance is 0.000000; expected a number greater than 0");
}

}  // namespace
}  // namespace kinetri::mean_cell_areas_test
