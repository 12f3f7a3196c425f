// SPDX-License-Identifier: GPL-3.0-or-later
//
// Snapshots of the triangulation: what is restored goes on as the original does, and what is no
// state is refused.
#include "kinetri/triangulation/triangulation_snapshot.h"

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

// The order of vertices in each face, and around each vertex from where CGAL begins: all that its
// algorithms may depend on.
std::vector<std::vector<Point_id>> layout(const Kinetic_delaunay& kinetic) {
  std::vector<std::vector<Point_id>> result;
  const auto& triangulation = kinetic.triangulation();
  const auto id = [](auto v) { return v->point().id(); };
  if (triangulation.dimension() < 2) return result;
  for (const auto face : triangulation.all_face_handles()) {
    result.push_back({id(face->vertex(0)), id(face->vertex(1)), id(face->vertex(2))});
  }
  for (const auto v : triangulation.all_vertex_handles()) {
    result.push_back({id(v)});
    auto neighbor = triangulation.incident_vertices(v, v->face());
    const auto first = neighbor;
    do {
      result.back().push_back(id(neighbor));
    } while (++neighbor != first);
    if (result.back().size() < 4) result.back().push_back(id(v));  // unlike a face
  }
  std::ranges::sort(result);
  return result;
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

// The same random operation on each. False if it was refused.
bool operate(Kinetic_delaunay& kinetic, std::mt19937_64 random, int size, int speed) {
  const double now = kinetic.current_time().to_double();
  const auto some_point = [&] {
    std::vector<Point_id> ids;
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id)) ids.push_back(id);
    }
    return ids.empty() ? no_point : ids[random() % ids.size()];
  };
  try {
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
  } catch (const Coincident_trajectories_error&) {
    return false;
  }
  return true;
}

class Snapshots_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Snapshots_on_grids, go_on_as_the_original) {
  const auto [points, size, speed] = GetParam();
  std::set<int> dimensions;
  int irrational = 0;
  for (unsigned seed = 0; seed < 15u * static_cast<unsigned>(test::multiplier()); ++seed) {
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
    ASSERT_EQ(layout(restored), layout(original));
    const Event_recorder one(original);
    const Event_recorder other(restored);
    for (int i = 0; i < 25; ++i) {
      const std::mt19937_64 same(random());
      ASSERT_EQ(operate(restored, same, size, speed), operate(original, same, size, speed));
      ASSERT_EQ(difference(other, one), "") << "operation " << i;
      ASSERT_EQ(layout(restored), layout(original)) << "operation " << i;
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

// On a lattice at rest all neighbors are cocircular, and the diagonals depend on the history.
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
  original.reserve_id();
  const Snapshot first = original.snapshot();
  const Snapshot second = Kinetic_delaunay::restore(first).snapshot();
  EXPECT_EQ(second.time, first.time);
  EXPECT_EQ(second.motions, first.motions);
  EXPECT_EQ(second.dimension, first.dimension);
  ASSERT_EQ(second.faces.size(), first.faces.size());
  for (std::size_t f = 0; f < first.faces.size(); ++f) {
    EXPECT_EQ(second.faces[f].vertices, first.faces[f].vertices);
    EXPECT_EQ(second.faces[f].neighbors, first.faces[f].neighbors);
  }
  EXPECT_EQ(second.vertex_faces, first.vertex_faces);
  EXPECT_EQ(second.infinite_vertex_face, first.infinite_vertex_face);
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

std::string refusal(const Snapshot& snapshot) {
  return test::message_of<Snapshot_error>(
      [&snapshot] { const auto restored = Kinetic_delaunay::restore(snapshot); });
}

bool is_refused_for(const Snapshot& snapshot, const std::string& reason) {
  const std::string text = refusal(snapshot);
  EXPECT_NE(text.find(reason), std::string::npos) << text;
  return text.find(reason) != std::string::npos;
}

class Forged_snapshot : public testing::Test {
 protected:
  Snapshot snapshot = Kinetic_delaunay(test::random_motions(20, 40, 0, 1)).snapshot();

  // The first face without the infinite vertex.
  std::size_t finite_face() const {
    std::size_t f = 0;
    while (std::ranges::count(snapshot.faces[f].vertices, no_point) > 0) ++f;
    return f;
  }
};

TEST_F(Forged_snapshot, with_links_that_are_none_is_refused) {
  const Snapshot whole = snapshot;
  const auto expect = [&](const std::string& reason) {
    EXPECT_TRUE(is_refused_for(snapshot, reason));
    snapshot = whole;
  };
  EXPECT_EQ(refusal(snapshot), "");
  snapshot.faces[3].vertices[1] = 20;
  expect("face 3 of the snapshot has point 20, which is not there");
  snapshot.motions[5].reset();
  expect("38 faces; expected 36 for 19 points");
  snapshot.faces[3].vertices[1] = snapshot.faces[3].vertices[2];
  expect("twice");
  snapshot.faces[3].neighbors[1] = 38;
  expect("face 3 of the snapshot has a neighbor 38, which is no other face");
  snapshot.faces[3].neighbors[1] = 3;
  expect("face 3 of the snapshot has a neighbor 3, which is no other face");
  std::swap(snapshot.faces[3].neighbors[0], snapshot.faces[3].neighbors[1]);
  expect("at an edge that they do not share");
  snapshot.faces.pop_back();
  expect("37 faces; expected 38 for 20 points");
  snapshot.dimension = 1;
  expect("38 faces; expected 21 for 20 points");
  snapshot.dimension = 3;
  expect("20 points has no dimension 3");
  snapshot.vertex_faces.pop_back();
  expect("20 points, but faces of 19");
  snapshot.vertex_faces[4] = 38;
  expect("gives point 4 the face 38, which does not have it");
  snapshot.infinite_vertex_face = finite_face();
  expect("gives the infinite vertex the face");
  snapshot.motions[2]->velocity.x = std::numeric_limits<double>::infinity();
  expect("the motion of point 2 has a number that is not finite");
}

TEST_F(Forged_snapshot, turned_inside_out_is_refused) {
  for (auto& motion : snapshot.motions) motion->position.x = -motion->position.x;
  EXPECT_TRUE(is_refused_for(snapshot, "is not counterclockwise"));
}

TEST_F(Forged_snapshot, whose_hull_is_dented_is_refused) {
  // The middle of the hull: its own triangles stay counterclockwise on their way there.
  Snapshot square = Kinetic_delaunay(std::vector<Linear_motion_2>{{{0, 0}, {0, 0}, 0},
                                                                  {{9, 0}, {0, 0}, 0},
                                                                  {{9, 9}, {0, 0}, 0},
                                                                  {{0, 9}, {0, 0}, 0},
                                                                  {{5, 6}, {0, 0}, 0}})
                        .snapshot();
  EXPECT_EQ(refusal(square), "");
  square.motions[0]->position = {4.7, 4.6};
  EXPECT_TRUE(is_refused_for(square, "hull is not convex at point 0"));
}

TEST_F(Forged_snapshot, with_an_edge_flipped_is_refused) {
  // At rest, so that the snapshot of what is flipped by hand stays otherwise right.
  Kinetic_delaunay kinetic(test::random_motions(20, 40, 0, 1));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): what nobody else may do
  auto& triangulation = const_cast<Kinetic_delaunay::Triangulation&>(kinetic.triangulation());
  int flipped = 0;
  for (const auto& edge :
       std::vector(triangulation.finite_edges().begin(), triangulation.finite_edges().end())) {
    const auto [face, i] = edge;
    const auto neighbor = face->neighbor(i);
    if (triangulation.is_infinite(face) || triangulation.is_infinite(neighbor)) continue;
    triangulation.tds().flip(face, i);
    EXPECT_NE(refusal(kinetic.snapshot()), "");
    // Twice more is a half turn: the same diagonal as before.
    for (int more = 0; more < 3; ++more) triangulation.tds().flip(face, face->index(neighbor));
    EXPECT_EQ(refusal(kinetic.snapshot()), "");
    ++flipped;
  }
  EXPECT_GT(flipped, 20);
}

// Five triangles about a point, of 144 degrees each: every one is counterclockwise, every edge is
// locally Delaunay, and the hull turns left at each of its vertices.
TEST(Forged_snapshots, that_go_around_twice_are_refused) {
  Snapshot star;
  const std::array<Vector_2, 5> corners = {{{100, 0}, {-81, 59}, {31, -95}, {31, 95}, {-81, -59}}};
  for (const Vector_2& corner : corners) {
    star.motions.emplace_back(Linear_motion_2{corner, {0, 0}, 0});
  }
  star.motions.emplace_back(Linear_motion_2{{0, 0}, {0, 0}, 0});
  star.dimension = 2;
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t next = (k + 1) % 5;
    const std::size_t previous = (k + 4) % 5;
    const auto a = static_cast<Point_id>(k);
    const auto b = static_cast<Point_id>(next);
    // Faces 0 to 4 are triangles at the centre, 5 to 9 those beyond the hull.
    star.faces.push_back({{5, a, b}, {5 + k, next, previous}});
    star.vertex_faces.push_back(k);
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const auto a = static_cast<Point_id>(k);
    const auto b = static_cast<Point_id>((k + 1) % 5);
    star.faces.push_back({{no_point, b, a}, {k, 5 + (k + 4) % 5, 5 + (k + 1) % 5}});
  }
  star.vertex_faces.push_back(0);
  star.infinite_vertex_face = 5;
  EXPECT_TRUE(is_refused_for(star, "goes around more than once"));
}

// Two points that stay in one place, the second of which has two infinite faces for itself.
TEST(Forged_snapshots, with_an_edge_without_triangles_are_refused) {
  std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{9, 0}, {0, 0}, 0}, {{0, 9}, {0, 0}, 0}};
  Snapshot forged = Kinetic_delaunay(motions).snapshot();
  ASSERT_EQ(forged.faces.size(), 4u);
  forged.motions.push_back(forged.motions[1]);
  forged.faces.push_back({{no_point, 1, 3}, {5, 5, 5}});
  forged.faces.push_back({{no_point, 3, 1}, {4, 4, 4}});
  forged.vertex_faces.push_back(4);
  EXPECT_TRUE(is_refused_for(forged, "edge of points 1 and 3 has no triangle"));
}

TEST(Forged_snapshots, of_a_chain_out_of_order_are_refused) {
  std::vector<Linear_motion_2> motions;
  for (const double x : {0, 1, 2, 3, 4}) motions.push_back({{x, 2 * x}, {1, 0}, 0});
  Snapshot chain = Kinetic_delaunay(motions).snapshot();
  EXPECT_EQ(chain.dimension, 1);
  EXPECT_EQ(refusal(chain), "");
  const Snapshot whole = chain;
  std::swap(chain.motions[1], chain.motions[2]);
  EXPECT_TRUE(is_refused_for(chain, "not in order"));
  chain = whole;
  chain.motions[4]->position.x = 3.5;
  EXPECT_TRUE(is_refused_for(chain, "not in order"));
  chain = whole;
  chain.motions[4] = chain.motions[3];
  EXPECT_TRUE(is_refused_for(chain, "not in order"));
  Snapshot pair = Kinetic_delaunay(std::vector{motions[0], motions[1]}).snapshot();
  pair.motions[1] = pair.motions[0];
  EXPECT_TRUE(is_refused_for(pair, "not in order at points"));
}

// Whatever is changed, it is refused, or it makes no difference to what a triangulation is.
TEST(Forged_snapshots, changed_at_random_are_refused_or_right) {
  int refused = 0;
  for (unsigned seed = 0; seed < 400u * static_cast<unsigned>(test::multiplier()); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto motions = seed % 4 == 0 ? test::grid_motions(4, 2, 0, seed)
                                       : test::grid_motions(3 + seed % 7, 4, 1, seed);
    Kinetic_delaunay kinetic(motions);
    for (auto steps = random() % 4; steps > 0; --steps) kinetic.step();
    Snapshot snapshot = kinetic.snapshot();
    for (auto changes = 1 + random() % 2; changes > 0; --changes) {
      auto& face = snapshot.faces[random() % snapshot.faces.size()];
      auto& other = snapshot.faces[random() % snapshot.faces.size()];
      const std::size_t i = random() % 3;
      switch (random() % 8) {
        case 0:
          face.vertices[i] = static_cast<Point_id>(random() % (motions.size() + 1));
          break;
        case 1:
          face.neighbors[i] = random() % (snapshot.faces.size() + 1);
          break;
        case 2:
          snapshot.infinite_vertex_face = random() % snapshot.faces.size();
          break;
        case 3:
          std::swap(face, other);
          break;
        case 4:
          std::swap(face.neighbors, other.neighbors);
          break;
        case 5:
          snapshot.vertex_faces[random() % motions.size()] = random() % snapshot.faces.size();
          break;
        case 6:
          std::swap(snapshot.motions[random() % motions.size()],
                    snapshot.motions[random() % motions.size()]);
          break;
        default:
          snapshot.dimension = static_cast<int>(random() % 4) - 1;
      }
    }
    try {
      auto restored = Kinetic_delaunay::restore(snapshot);
      ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
      restored.step();
      ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
    } catch (const Snapshot_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace kinetri::triangulation_snapshot_test
