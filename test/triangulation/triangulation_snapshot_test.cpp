// SPDX-License-Identifier: GPL-3.0-or-later
//
// Snapshots of the triangulation: what is restored goes on as the original does, and what is no
// state is refused.
#include "kinetri/triangulation/kinetic_triangulation_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "support/kinetic_runs.h"
#include "support/message_of.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::triangulation_snapshot_test {
namespace {

using test::Kinetic_delaunay;
using test::Kinetic_event;
using Snapshot = Kinetic_delaunay::Snapshot;

// ---- the same future ----

using test::Event_recorder;

// How the events differ, their numbers included.
std::string difference(const Event_recorder& one, const Event_recorder& other) {
  for (std::size_t i = 0; i < one.events.size() && i < other.events.size(); ++i) {
    const Kinetic_event& a = one.events[i];
    const Kinetic_event& b = other.events[i];
    if (a.number != b.number || a.point_a != b.point_a || a.point_b != b.point_b) {
      return "event " + std::to_string(i) + " has another number, or other points";
    }
  }
  return test::difference(one.events, other.events);
}

// A point on the grid on which the others move.
Linear_motion_2 random_motion(std::mt19937_64& random, int size, int speed, double time) {
  const auto whole = [&](int lowest, int highest) {
    return static_cast<double>(std::uniform_int_distribution<int>(lowest, highest)(random));
  };
  const double x = whole(0, size - 1);
  const double y = whole(0, size - 1);
  const double vx = whole(-speed, speed);
  return {{x, y}, {vx, whole(-speed, speed)}, time};
}

// The same random operation on each.
void operate(Kinetic_delaunay& kinetic, std::mt19937_64 random, int size, int speed) {
  const double now = kinetic.current_time().to_double();
  const auto some_point = [&] {
    std::vector<Point_id> ids;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id)) ids.push_back(id);
    }
    return ids.empty() ? no_point : ids[random() % ids.size()];
  };
  switch (random() % 8) {
    case 0:
    case 1:
    case 2:
      kinetic.step();
      break;
    case 3:
      kinetic.advance_to(Algebraic_number(kinetic.current_time().tight_interval().upper + 0.125));
      break;
    case 4:
    case 5:
      kinetic.insert(random_motion(random, size, speed, now));
      break;
    case 6:
      if (const Point_id id = some_point(); id != no_point) kinetic.erase(id);
      break;
    default:
      if (const Point_id id = some_point(); id != no_point) {
        kinetic.set_motion(id, random_motion(random, size, speed, now));
      }
  }
}

class Snapshots_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Snapshots_on_grids, go_on_as_the_original) {
  const auto [points, size, speed] = GetParam();
  std::set<int> dimensions;
  int irrational = 0;
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Kinetic_delaunay original(
        test::grid_motions(static_cast<std::size_t>(points), size, speed, seed));
    for (auto operations = random() % 20; operations > 0; --operations) {
      operate(original, std::mt19937_64(random()), size, speed);
    }
    dimensions.insert(original.triangulation().dimension());
    irrational += original.current_time().is_known_rational() ? 0 : 1;
    auto restored = Kinetic_delaunay::restore(original.snapshot());
    ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
    ASSERT_EQ(restored.current_time(), original.current_time());
    ASSERT_EQ(restored.next_id(), original.next_id());
    ASSERT_EQ(restored.finite_edge_ids(), original.finite_edge_ids());
    const Event_recorder one(original);
    const Event_recorder other(restored);
    for (int i = 0; i < 25; ++i) {
      const std::mt19937_64 same(random());
      operate(restored, same, size, speed);
      operate(original, same, size, speed);
      ASSERT_EQ(difference(other, one), "") << "operation " << i;
      ASSERT_EQ(restored.finite_edge_ids(), original.finite_edge_ids()) << "operation " << i;
    }
    ASSERT_EQ(restored.finite_edge_ids(), original.finite_edge_ids());
    ASSERT_EQ(restored.counters().events, original.counters().events);
    ASSERT_EQ(restored.counters().instants, original.counters().instants);
    ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
  }
  if (points == 0) {
    EXPECT_EQ(dimensions, (std::set<int>{-1, 0, 1, 2}));
  }
  if (points == 12) {
    EXPECT_GT(irrational, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Snapshots_on_grids,
                         testing::Values(std::tuple(0, 2, 1), std::tuple(4, 2, 1),
                                         std::tuple(6, 3, 0), std::tuple(9, 3, 1),
                                         std::tuple(12, 5, 2), std::tuple(12, 40, 7)));

// On a lattice at rest all neighbors are cocircular.
TEST(Triangulation_snapshot, chooses_the_same_diagonals_of_cocircular_points) {
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 64; ++i) motions.push_back({{double(i % 8), double(i / 8)}, {0, 0}, 0});
  std::mt19937_64 random(1);
  Kinetic_delaunay original(motions);
  for (int i = 0; i < 25; ++i) {
    auto restored = Kinetic_delaunay::restore(original.snapshot());
    Point_id id = no_point;
    while (!original.contains(id)) id = static_cast<Point_id>(random() % 64);
    original.erase(id);
    restored.erase(id);
    ASSERT_EQ(restored.finite_edge_ids(), original.finite_edge_ids()) << "erased " << id;
    if (i % 2 == 0) continue;
    const Linear_motion_2 between = {{1 + double(i % 6), 1 + double(i % 5) + 0.5}, {0, 0}, 0};
    original.insert(between);
    restored.insert(between);
    ASSERT_EQ(restored.finite_edge_ids(), original.finite_edge_ids()) << "inserted " << i;
  }
}

// Beyond one task of the threads that find the certificates.
TEST(Triangulation_snapshot, of_many_points_goes_on_as_the_original) {
  Kinetic_delaunay original(test::random_motions(3000, 550, 5, 7));
  original.advance_to(0.25);
  auto restored = Kinetic_delaunay::restore(original.snapshot());
  const Event_recorder one(original);
  const Event_recorder other(restored);
  original.advance_to(0.5);
  restored.advance_to(0.5);
  EXPECT_GT(one.events.size(), 500u);
  EXPECT_EQ(difference(other, one), "");
}

TEST(Triangulation_snapshot, is_restored_to_the_same_snapshot) {
  Kinetic_delaunay original(test::random_motions(50, 70, 5, 3));
  for (int i = 0; i < 30; ++i) original.step();
  original.erase(17);
  original.erase(original.insert({{1, 2}, {0, 0}, 0}));
  const Snapshot first = original.snapshot();
  const Snapshot second = Kinetic_delaunay::restore(first).snapshot();
  EXPECT_EQ(second.time, first.time);
  EXPECT_EQ(second.motions, first.motions);
  EXPECT_EQ(second.counters, first.counters);
  EXPECT_GE(second.certificates.created, first.certificates.created);
}

TEST(Triangulation_snapshot, is_not_taken_within_an_event) {
  struct Taker : Kinetic_delaunay::Observer {
    explicit Taker(const Kinetic_delaunay& k) : kinetic(k) {}
    void before_event(const Kinetic_event&) override {
      EXPECT_PRECONDITION_ERROR(
          kinetic.snapshot(),
          "a snapshot within an event; take it when advance_to or step has returned");
    }
    void after_event(const Kinetic_event&) override {
      EXPECT_PRECONDITION_ERROR(
          kinetic.snapshot(),
          "a snapshot within an event; take it when advance_to or step has returned");
      ++events;
    }
    const Kinetic_delaunay& kinetic;
    int events = 0;
  };
  Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 1));
  Taker taker(kinetic);
  kinetic.add_observer(taker);
  kinetic.step();
  kinetic.erase(3);
  EXPECT_GT(taker.events, 2);
  EXPECT_NO_THROW(kinetic.snapshot());
}

// ---- what is no state ----

std::string refusal(const Snapshot& snapshot,
                    Coincident_points coincident = Coincident_points::refuse) {
  return test::message_of<Snapshot_error>(
      [&] { const auto restored = Kinetic_delaunay::restore(snapshot, {}, coincident); });
}

bool is_refused_for(const Snapshot& snapshot, const std::string& reason) {
  const std::string text = refusal(snapshot);
  EXPECT_NE(text.find(reason), std::string::npos) << text;
  return text.find(reason) != std::string::npos;
}

TEST(Forged_snapshots, with_numbers_or_points_that_cannot_be_are_refused) {
  const Snapshot whole = Kinetic_delaunay(test::random_motions(20, 40, 1, 1)).snapshot();
  EXPECT_EQ(refusal(whole), "");
  Snapshot forged = whole;
  forged.motions[2]->velocity.x = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_refused_for(forged, "the motion of point 2 has a number that is not finite"));
  forged = whole;
  forged.motions[7] = forged.motions[3];
  EXPECT_TRUE(is_refused_for(forged, "the snapshot's points 3 and 7 have the same trajectory"));
}

// Other motions are those of another state, which is as good.
TEST(Forged_snapshots, with_other_motions_are_those_of_these) {
  for (unsigned seed = 0; seed < test::cases(100u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto motions = test::grid_motions(3 + seed % 7, 4, 1, seed);
    Kinetic_delaunay kinetic(motions);
    for (auto steps = random() % 4; steps > 0; --steps) kinetic.step();
    Snapshot snapshot = kinetic.snapshot();
    std::swap(snapshot.motions[random() % motions.size()],
              snapshot.motions[random() % motions.size()]);
    snapshot.motions[random() % motions.size()].reset();
    auto restored = Kinetic_delaunay::restore(snapshot);
    ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
    restored.step();
    ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
  }
}

}  // namespace
}  // namespace kinetri::triangulation_snapshot_test
