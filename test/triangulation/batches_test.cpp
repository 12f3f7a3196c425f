// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes of many points at once: the same as a triangulation of the points as they are then, with
// one event for each point, and all or nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "support/kinetic_runs.h"
#include "support/precondition_error.h"

namespace kinetri::batches_test {
namespace {

using test::Kinetic_delaunay;

std::vector<Point_id> all_ids(std::size_t n) {
  std::vector<Point_id> result(n);
  std::iota(result.begin(), result.end(), Point_id(0));
  return result;
}

/// Every `period`-th id.
std::vector<Point_id> some_ids(std::size_t n, std::size_t period) {
  std::vector<Point_id> result;
  for (std::size_t id = 0; id < n; id += period) result.push_back(static_cast<Point_id>(id));
  return result;
}

void expect_same_as_new(Kinetic_delaunay& kinetic) {
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  std::vector<Linear_motion_2> motions;
  std::vector<Point_id> ids;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    motions.push_back(kinetic.motion(id));
    ids.push_back(id);
  }
  const Kinetic_delaunay anew(motions, kinetic.current_time());
  std::vector<Edge_ids> expected;
  for (const auto& [a, b] : anew.finite_edge_ids()) expected.push_back({ids[a], ids[b]});
  EXPECT_EQ(kinetic.finite_edge_ids(), expected);
}

/// A share of the points: 1 is all, 4 every fourth one.
class Batches : public testing::TestWithParam<std::size_t> {};

TEST_P(Batches, of_turns_are_as_a_new_triangulation) {
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    Kinetic_delaunay kinetic(test::random_motions(120, 100, 5, seed));
    test::Event_recorder recorder(kinetic);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> component(-5, 5);
    const std::vector<Point_id> ids = some_ids(120, GetParam());
    for (int round = 1; round <= 4; ++round) {
      const double now = 0.37 * round;
      kinetic.advance_to(now);
      recorder.events.clear();
      std::vector<Vector_2> velocities;
      std::vector<Linear_motion_2> motions;
      for (const Point_id id : ids) {
        const double vx = component(random);
        velocities.push_back({vx, component(random)});
        motions.push_back(with_velocity_at(kinetic.motion(id), velocities.back(), now));
      }
      kinetic.set_velocities(ids, velocities);
      ASSERT_EQ(recorder.events.size(), ids.size());
      for (std::size_t i = 0; i < ids.size(); ++i) {
        EXPECT_EQ(recorder.events[i].kind, Event_kind::trajectory);
        EXPECT_EQ(recorder.events[i].point_a, ids[i]);
        EXPECT_EQ(kinetic.motion(ids[i]), motions[i]);
      }
      expect_same_as_new(kinetic);
    }
    EXPECT_EQ(recorder.edges, test::edges_of(kinetic));
  }
}

TEST_P(Batches, of_jumps_are_as_a_new_triangulation) {
  for (unsigned seed = 1; seed <= test::cases(1u); ++seed) {
    Kinetic_delaunay kinetic(test::random_motions(120, 100, 5, seed));
    test::Event_recorder recorder(kinetic);
    kinetic.advance_to(0.5);
    const std::vector<Point_id> ids = some_ids(120, GetParam());
    std::vector<Linear_motion_2> motions = test::random_motions(ids.size(), 100, 5, seed + 100);
    kinetic.set_motions(ids, motions);
    expect_same_as_new(kinetic);
    EXPECT_EQ(recorder.edges, test::edges_of(kinetic));
    const Point_id first = kinetic.insert(test::random_motions(ids.size(), 100, 5, seed + 200));
    EXPECT_EQ(first, 120u);
    EXPECT_EQ(kinetic.number_of_points(), 120 + ids.size());
    expect_same_as_new(kinetic);
    kinetic.erase(ids);
    EXPECT_EQ(kinetic.number_of_points(), 120u);
    expect_same_as_new(kinetic);
    EXPECT_EQ(recorder.edges, test::edges_of(kinetic));
    EXPECT_EQ(test::audited_run(kinetic, Algebraic_number(0.75), Audit_level::links), "");
  }
}

TEST_P(Batches, on_a_lattice_are_delaunay) {
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    Kinetic_delaunay kinetic(test::grid_motions(48, 7, 2, seed));
    std::vector<Linear_motion_2> others = test::grid_motions(48, 7, 2, seed + 50);
    const std::vector<Point_id> ids = some_ids(48, GetParam());
    others.resize(ids.size());
    kinetic.advance_to(1.0);
    kinetic.set_motions(ids, others);
    ASSERT_EQ(test::audited_run(kinetic, Algebraic_number(1.5), Audit_level::reference), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Batches, testing::Values(1, 3, 5, 40));

TEST(Batch, may_exchange_the_motions_of_points) {
  for (const Point_id n : {4u, 120u}) {
    Kinetic_delaunay kinetic(test::random_motions(n, 100, 5, 1));
    std::vector<Linear_motion_2> motions;
    const std::vector<Point_id> ids = all_ids(n);
    for (const Point_id id : ids) motions.push_back(kinetic.motion((id + 1) % n));
    kinetic.set_motions(ids, motions);
    for (const Point_id id : ids) EXPECT_EQ(kinetic.motion(id), motions[id]);
    expect_same_as_new(kinetic);
  }
}

TEST(Batch, that_is_refused_changes_nothing) {
  Kinetic_delaunay kinetic(test::random_motions(40, 100, 5, 1), {}, {}, Coincident_points::refuse);
  struct Watcher : Kinetic_delaunay::Observer {
    void before_event(const test::Kinetic_event&) override { ++events; }
    int events = 0;
  } watcher;
  kinetic.add_observer(watcher);
  const std::vector<Linear_motion_2> before = test::random_motions(40, 100, 5, 1);
  const std::vector<Edge_ids> edges = kinetic.finite_edge_ids();
  const Linear_motion_2 at_17 = before[17];
  const auto set = [&](std::vector<Point_id> ids, const std::vector<Linear_motion_2>& motions) {
    kinetic.set_motions(ids, motions);
  };
  const Linear_motion_2 one = {{1, 2}, {3, 4}, 0};
  const Linear_motion_2 other = {{2, 2}, {3, 4}, 0};
  EXPECT_PRECONDITION_ERROR(set({3, 5, 3}, {one, at_17, other}),
                            "point 3 is named twice; expected each point once");
  EXPECT_PRECONDITION_ERROR(set({3, 4}, {one}),
                            "2 ids and 1 motions; expected a motion for each id");
  const std::vector<Point_id> two = {3, 4};
  const std::vector<Vector_2> single = {{1, 2}};
  EXPECT_PRECONDITION_ERROR(kinetic.set_velocities(two, single),
                            "2 ids and 1 velocities; expected as many of each");
  const std::vector<Vector_2> infinite = {{1, 2}, {1, std::numeric_limits<double>::infinity()}};
  EXPECT_PRECONDITION_ERROR(kinetic.set_velocities(two, infinite),
                            "the velocity of point 4 is not finite; expected two finite numbers");
  EXPECT_THROW(set({3, 40}, {one, other}), Precondition_error);
  EXPECT_THROW(set({3, 4}, {one, {{1, 2}, {std::numeric_limits<double>::infinity(), 0}, 0}}),
               Precondition_error);
  EXPECT_THROW(set({3, 4}, {one, one}), Coincident_trajectories_error);
  EXPECT_THROW(set({3, 4}, {one, at_17}), Coincident_trajectories_error);
  std::vector<Linear_motion_2> many = test::random_motions(40, 100, 5, 2);
  many[31] = many[7];
  try {
    set(all_ids(40), many);
    FAIL() << "two points with one trajectory";
  } catch (const Coincident_trajectories_error& error) {
    EXPECT_EQ(error.first(), 7u);
    EXPECT_EQ(error.second(), 31u);
  }
  EXPECT_THROW(kinetic.insert(many), Coincident_trajectories_error);
  EXPECT_EQ(kinetic.next_id(), 40u);
  EXPECT_THROW(kinetic.erase(std::vector<Point_id>{1, 2, 1}), Precondition_error);
  EXPECT_EQ(watcher.events, 0);
  EXPECT_EQ(kinetic.finite_edge_ids(), edges);
  for (Point_id id = 0; id < 40; ++id) EXPECT_EQ(kinetic.motion(id), before[id]);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
}

TEST(Batch, of_nothing_does_nothing) {
  Kinetic_delaunay kinetic(test::random_motions(5, 10, 5, 1));
  kinetic.set_motions({}, {});
  kinetic.erase(std::span<const Point_id>());
  EXPECT_EQ(kinetic.insert(std::span<const Linear_motion_2>()), 5u);
  EXPECT_EQ(kinetic.counters().number_of_events(), 0u);
}

TEST(Batch, may_erase_all_points_and_insert_them_again) {
  for (const std::size_t n : {3u, 60u}) {
    const std::vector<Linear_motion_2> motions = test::random_motions(n, 100, 5, 1);
    Kinetic_delaunay kinetic(motions);
    kinetic.erase(all_ids(n));
    EXPECT_EQ(kinetic.number_of_points(), 0u);
    EXPECT_TRUE(kinetic.finite_edge_ids().empty());
    EXPECT_EQ(kinetic.insert(motions), n);
    expect_same_as_new(kinetic);
  }
}

}  // namespace
}  // namespace kinetri::batches_test
