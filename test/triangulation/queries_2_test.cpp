// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries at one time against oracles that look at all points, pairs, edges and triangles at their
// exact places.
#include "kinetri/triangulation/queries_2.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_test {
namespace {

using test::expect_right_answers;
using test::Kinetic_delaunay;
using test::Query_oracle;
using test::Static_kernel;
using test::Static_point;
using test::static_point;
using Kind = Location_2::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

// test::ask_along with the oracle.
int ask_along(const std::vector<Linear_motion_2>& motions, int instants, unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << test::describe(motions));
  std::mt19937_64 random(seed);
  Kinetic_delaunay kinetic(motions);
  return test::ask_along(kinetic, instants, [&](const Algebraic_number& time) {
    const auto t = test::rational_value(time);
    if (!t || testing::Test::HasFatalFailure()) return false;
    SCOPED_TRACE(testing::Message() << "at the time " << *t);
    expect_right_answers(kinetic, time, *t, random);
    return true;
  });
}

class Queries_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Queries_on_grids, are_answered_as_by_a_look_at_everything) {
  const auto [points, size, speed] = GetParam();
  const int cases = test::cases(points <= 4 ? 15 : points <= 7 ? 5 : 3);
  int events = 0;
  for (int seed = 0; seed < cases; ++seed) {
    events += ask_along(test::grid_motions(static_cast<std::size_t>(points), size, speed,
                                           static_cast<unsigned>(seed)),
                        6, static_cast<unsigned>(seed));
    if (HasFatalFailure()) return;
  }
  if (points > 2) {
    EXPECT_GE(events, 4) << "degenerate times with a rational value";
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Queries_on_grids,
                         testing::Values(std::tuple(0, 3, 1), std::tuple(1, 3, 1),
                                         std::tuple(2, 3, 1), std::tuple(3, 2, 1),
                                         std::tuple(4, 3, 1), std::tuple(5, 3, 1),
                                         std::tuple(6, 3, 1), std::tuple(7, 4, 2),
                                         std::tuple(9, 3, 1), std::tuple(11, 4, 1)));

// On lines, so that nothing is ever two-dimensional, or all of it is flat once.
TEST(Queries, of_points_on_a_line_are_answered_as_by_a_look_at_everything) {
  for (unsigned seed = 0; seed < test::cases(25u); ++seed) {
    auto motions = test::grid_motions(2 + seed % 5, seed % 4 == 3 ? 30 : 4, 2, seed);
    std::set<std::pair<double, double>> seen;
    std::erase_if(motions, [&](Linear_motion_2& m) {
      const bool is_flat_for_ever = seed % 2 == 0;
      m.position.y = m.position.x;
      if (is_flat_for_ever) m.velocity.y = m.velocity.x;
      return is_flat_for_ever && !seen.insert({m.position.x, m.velocity.x}).second;
    });
    if (seed % 2 != 0) {
      // All on the line at t = 1, and anywhere before.
      std::set<std::tuple<double, double, double>> trajectories;
      std::erase_if(motions, [&](Linear_motion_2& m) {
        m.epoch = 1;
        return !trajectories.insert({m.position.x, m.velocity.x, m.velocity.y}).second;
      });
    }
    ask_along(motions, 6, seed);
    if (HasFatalFailure()) return;
  }
}

TEST(Queries, of_random_points_are_answered_as_by_a_look_at_everything) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    ask_along(test::random_motions(5 + 4 * (seed % 4), 6, 3, seed), 4, seed);
    if (HasFatalFailure()) return;
  }
}

// At t = 1 five points are in one place, with others around.
TEST(Queries, where_points_meet_are_about_their_common_place) {
  const std::vector<Linear_motion_2> motions = {
      {{3, 1}, {-1, 0}},  {{1, 1}, {1, 0}}, {{2, 3}, {0, -2}}, {{2, 1}, {0, 0}}, {{0, -1}, {2, 2}},
      {{-4, -4}, {0, 0}}, {{6, 0}, {0, 0}}, {{0, 7}, {0, 0}},  {{5, 5}, {0, 0}}};
  Kinetic_delaunay kinetic(motions);
  while (*kinetic.next_event_time() < 1.0) kinetic.step();
  std::mt19937_64 random(1);
  const auto ask = [&] {
    expect_right_answers(kinetic, 1.0, 1, random);
    const Kinetic_queries_2 queries(kinetic, 1.0);
    EXPECT_EQ(queries.nearest_vertex({2, 1}), 0u);
    EXPECT_EQ(queries.locate({2, 1}), (Location_2{Kind::vertex, {0}}));
    EXPECT_EQ(queries.closest_pair(), (Edge_ids{0, 1}));
    for (const Point_id id : {1u, 2u, 3u, 4u}) {
      EXPECT_EQ(queries.voronoi_cell(id).neighbors, queries.voronoi_cell(0).neighbors);
    }
  };
  ask();
  kinetic.advance_to(1.0);
  ask();
}

// All points on one line at t = 1, as in a test of the triangulation, and not before or after.
TEST(Queries, where_the_hull_is_flat_are_about_the_line) {
  Kinetic_delaunay kinetic(
      {{{1, 1}, {0, 1}, 0}, {{0, 0}, {1, 0}, 0}, {{2, 0}, {-1, -1}, 0}, {{1, 1}, {0, 0}, 0}});
  std::mt19937_64 random(1);
  for (const bool is_after : {false, true}) {
    if (is_after) kinetic.advance_to(1.0);
    expect_right_answers(kinetic, 1.0, 1, random);
    const Kinetic_queries_2 queries(kinetic, 1.0);
    EXPECT_EQ(queries.locate({1, 0.5}), (Location_2{Kind::edge, {1, 3}}));
    EXPECT_EQ(queries.locate({1, 0}), (Location_2{Kind::vertex, {1}}));
    EXPECT_EQ(queries.locate({1, 2.5}), Location_2{});
    EXPECT_EQ(queries.locate({0.5, 0.5}), Location_2{});
    EXPECT_TRUE(queries.voronoi_cell(1).vertices.empty());
    EXPECT_EQ(queries.voronoi_cell(1).neighbors.size(), 2u);
  }
}

TEST(Queries, of_no_point_have_no_answer) {
  const Kinetic_delaunay kinetic{std::vector<Linear_motion_2>{}};
  const Kinetic_queries_2 queries(kinetic, 7.0);
  EXPECT_EQ(queries.nearest_vertex({0, 0}), std::nullopt);
  EXPECT_EQ(queries.locate({0, 0}), Location_2{});
  EXPECT_EQ(queries.closest_pair(), std::nullopt);
  EXPECT_PRECONDITION_ERROR(queries.neighbors(0), "no point has the id 0; ask contains(id) first");
}

// Of a static triangulation with CGAL's exact predicates, the dual of its faces around a vertex.
TEST(Queries, voronoi_cells_are_those_of_cgals_static_dual) {
  using Static_triangulation = CGAL::Delaunay_triangulation_2<Static_kernel>;
  std::size_t bounded = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(seed % 2 == 0 ? test::random_motions(25, 10, 4, seed)
                                           : test::grid_motions(14, 5, 1, seed));
    kinetic.advance_to(0.25 * seed);
    const Rational t(static_cast<int>(seed), 4);
    const Query_oracle oracle(kinetic, t);
    Static_triangulation reference;
    for (const auto& [id, p] : oracle.places()) reference.insert(p);
    ASSERT_EQ(reference.dimension(), 2);
    const Kinetic_queries_2 queries(kinetic);
    for (const auto& [id, p] : oracle.places()) {
      const auto v = reference.nearest_vertex(p);
      std::vector<std::optional<Static_point>> centers;
      auto face = reference.incident_faces(v);
      const auto start = face;
      do {
        const auto center = reference.is_infinite(face)
                                ? std::optional<Static_point>()
                                : std::optional<Static_point>(reference.dual(face));
        if (centers.empty() || centers.back() != center) centers.push_back(center);
      } while (++face != start);
      if (centers.size() > 1 && centers.front() == centers.back()) centers.pop_back();
      const auto outside = std::ranges::find(centers, std::optional<Static_point>());
      const auto cell = queries.voronoi_cell(id);
      EXPECT_EQ(cell.is_bounded(), outside == centers.end());
      std::vector<std::optional<Static_point>> vertices;
      for (const auto& x : cell.vertices) vertices.emplace_back(static_point(x));
      if (outside != centers.end()) {
        std::rotate(centers.begin(), outside, centers.end());
        centers.erase(centers.begin());
      } else {
        ++bounded;
        std::rotate(centers.begin(), std::ranges::find(centers, vertices.front()), centers.end());
      }
      ASSERT_EQ(vertices, centers) << "cell of " << id;
    }
  }
  EXPECT_GT(bounded, 50u);
}

// The corners of a square and its center: four cocircular neighbors of each corner's kind.
TEST(Queries, a_voronoi_cell_has_no_side_without_length) {
  const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}},
                                  {{2, 0}, {0, 0}},
                                  {{2, 2}, {0, 0}},
                                  {{0, 2}, {0, 0}},
                                  {{1, 1}, {0, 0}},
                                  {{4, 0}, {0, 0}}});
  const Kinetic_queries_2 queries(kinetic);
  const auto center = queries.voronoi_cell(4);
  EXPECT_EQ(center.neighbors, (std::vector<Point_id>{0, 1, 2, 3}));
  ASSERT_EQ(center.vertices.size(), 4u);
  const auto corner = queries.voronoi_cell(0);
  EXPECT_EQ(corner.neighbors, (std::vector<Point_id>{1, 4, 3}));
  ASSERT_EQ(corner.vertices.size(), 2u);
  EXPECT_EQ(static_point(corner.vertices[0]), Static_point(1, 0));
  EXPECT_EQ(static_point(corner.vertices[1]), Static_point(0, 1));
  const auto rays = queries.rounded_voronoi_cell(0).rays;
  ASSERT_TRUE(rays);
  EXPECT_EQ((*rays)[0], (Vector_2{0, -2}));
  EXPECT_EQ((*rays)[1], (Vector_2{-2, 0}));
}

TEST(Queries, neighbors_are_counterclockwise_and_those_of_all_edges) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(test::random_motions(3 + seed, 10, 4, seed));
    kinetic.advance_to(1.0);
    const Kinetic_queries_2 queries(kinetic);
    const Query_oracle oracle(kinetic, 1);
    std::set<Edge_ids> edges;
    for (const auto& [id, place] : oracle.places()) {
      const std::vector<Point_id> around = queries.neighbors(id);
      for (const Point_id other : around) edges.insert(edge_ids(id, other));
      // Counterclockwise: only over the last one and the first may there be half a turn or more.
      for (std::size_t i = 0; i + 1 < around.size(); ++i) {
        EXPECT_TRUE(CGAL::left_turn(place, oracle.place(around[i]), oracle.place(around[i + 1])));
      }
      if (CGAL::left_turn(place, oracle.place(around.back()), oracle.place(around.front()))) {
        if (around.size() > 2) {
          EXPECT_EQ(around.front(), *std::ranges::min_element(around));
        }
      }
    }
    EXPECT_EQ(edges, test::edges_of(kinetic));
  }
  const Kinetic_delaunay on_line({{{2, 0}, {0, 0}}, {{4, 0}, {0, 0}}, {{0, 0}, {0, 0}}});
  EXPECT_EQ(Kinetic_queries_2(on_line).neighbors(0), (std::vector<Point_id>{1, 2}));
  EXPECT_EQ(Kinetic_queries_2(on_line).neighbors(1), (std::vector<Point_id>{0}));
}

TEST(Queries, of_erased_and_inserted_points_know_them) {
  Kinetic_delaunay kinetic(test::random_motions(12, 10, 3, 5));
  kinetic.advance_to(0.5);
  kinetic.erase(3);
  kinetic.erase(0);
  kinetic.insert({{4, 4}, {1, 1}, 0.5});
  std::mt19937_64 random(9);
  expect_right_answers(kinetic, 0.5, Rational(1, 2), random);
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic).neighbors(3),
                            "no point has the id 3; ask contains(id) first");
}

// ---- preconditions ----

TEST(Queries, at_a_time_that_is_past_or_beyond_the_next_event_are_refused) {
  // The flip at t = 2 of a test of the triangulation.
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  kinetic.advance_to(0.5);
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic, 0.25),
                            "a query about the past; query a time before the triangulation "
                            "advances beyond it");
  EXPECT_NO_THROW(Kinetic_queries_2(kinetic, 0.5));
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic, 2.0000000000000004),
                            "a query about a time after the next event; call advance_to for that "
                            "time first");
  EXPECT_EQ(Kinetic_queries_2(kinetic, 2.0).neighbors(0), (std::vector<Point_id>{1, 2, 3}));
  kinetic.advance_to(2.0);
  EXPECT_EQ(Kinetic_queries_2(kinetic, 2.0).neighbors(0), (std::vector<Point_id>{1, 3}));
}

TEST(Queries, after_an_event_are_refused_and_after_mere_time_are_not) {
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  const Kinetic_queries_2 queries(kinetic, 1.0);
  kinetic.advance_to(1.5);
  EXPECT_EQ(queries.nearest_vertex({0, 3}), 3u);
  kinetic.advance_to(2.0);
  EXPECT_PRECONDITION_ERROR(
      queries.nearest_vertex({0, 3}),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.locate({0, 3}),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.neighbors(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.voronoi_cell(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.rounded_voronoi_cell(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.closest_pair(),
      "the triangulation has changed since these queries were made; make new ones after an event");
}

TEST(Queries, of_a_place_that_is_not_finite_or_of_no_point_are_refused) {
  const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{9, 5}, {0, 0}}});
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_PRECONDITION_ERROR(queries.nearest_vertex({infinity, 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({0, -infinity}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({std::numeric_limits<double>::quiet_NaN(), 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.neighbors(3), "no point has the id 3; ask contains(id) first");
  EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(no_point),
                            "no point has the id 4294967295; ask contains(id) first");
  EXPECT_PRECONDITION_ERROR(queries.rounded_voronoi_cell(3),
                            "no point has the id 3; ask contains(id) first");
}

}  // namespace
}  // namespace kinetri::queries_2_test
