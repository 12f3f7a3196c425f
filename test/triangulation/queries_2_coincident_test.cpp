// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about points of which some coincide for a while: known answers, and oracles that look at
// all points.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "support/area_oracle.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_coincident_test {
namespace {

using test::Kinetic_delaunay;
using test::Query_oracle;
using test::Region;
using Ids = std::vector<Point_id>;
using Kind = Location_2::Kind;

constexpr Point_id none = no_point;

std::vector<Linear_motion_2> at_rest(const std::vector<Vector_2>& places) {
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : places) motions.push_back({place, {0, 0}});
  return motions;
}

const std::vector<Vector_2> square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};

std::vector<double> areas_of(const Kinetic_delaunay& kinetic) {
  return Kinetic_queries_2(kinetic).rounded_voronoi_areas(square);
}

// 0 and 4 are at one corner, and 2, 5 and 6 at another one.
TEST(Queries_of_coincident_points, know_each_point_at_its_id) {
  const Kinetic_delaunay kinetic(at_rest({{0, 0}, {4, 0}, {4, 4}, {0, 3}, {0, 0}, {4, 4}, {4, 4}}));
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.nearest_vertex({0.5, 0.5}), 0u);
  EXPECT_EQ(queries.locate({4, 4}), (Location_2{Kind::vertex, {2}}));
  EXPECT_EQ(queries.neighbors(0), (Ids{1, 3, 4}));
  EXPECT_EQ(queries.neighbors(1), (Ids{2, 3, 0}));
  EXPECT_EQ(queries.neighbors(2), (Ids{3, 1, 5, 6}));
  EXPECT_EQ(queries.neighbors(3), (Ids{0, 1, 2}));
  EXPECT_EQ(queries.neighbors(4), Ids{0});
  EXPECT_EQ(queries.neighbors(5), Ids{2});
  EXPECT_EQ(queries.neighbors(6), Ids{2});
  EXPECT_EQ(queries.voronoi_cell(6).neighbors, queries.voronoi_cell(2).neighbors);
  EXPECT_EQ(queries.rounded_voronoi_cell(6).vertices, queries.rounded_voronoi_cell(2).vertices);
  EXPECT_EQ(queries.nearest_neighbors(), (Ids{4, 0, 5, 0, 0, 2, 2}));
  EXPECT_EQ(queries.nearest_neighbor(0), 4u);
  EXPECT_EQ(queries.nearest_neighbor(6), 2u);
  EXPECT_EQ(queries.nearest_neighbors(2), (Ids{4, 3, 0, 2, 5, 6, 0, 4, 0, 3, 2, 6, 2, 5}));
  EXPECT_EQ(queries.closest_pair(), (Edge_ids{0, 4}));
  EXPECT_EQ(queries.rounded_positions(),
            (std::vector<double>{0, 0, 4, 0, 4, 4, 0, 3, 0, 0, 4, 4, 4, 4}));
}

TEST(Queries_of_coincident_points, know_points_that_all_coincide) {
  const Kinetic_delaunay kinetic(at_rest({{1, 2}, {1, 2}, {1, 2}}));
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.neighbors(0), (Ids{1, 2}));
  EXPECT_EQ(queries.neighbors(2), Ids{0});
  EXPECT_EQ(queries.nearest_neighbors(), (Ids{1, 0, 0}));
  EXPECT_EQ(queries.nearest_neighbors(3), (Ids{1, 2, none, 0, 2, none, 0, 1, none}));
  EXPECT_EQ(queries.closest_pair(), (Edge_ids{0, 1}));
  EXPECT_TRUE(queries.voronoi_cell(2).neighbors.empty());
  EXPECT_FALSE(queries.voronoi_cell(2).is_bounded());
  for (const double area : areas_of(kinetic)) EXPECT_EQ(area, 16 / 3.0);
}

// At time 1 another point passes through them: of those that only meet the first has the area.
TEST(Queries_of_coincident_points, share_a_cell_equally_but_not_with_points_that_pass) {
  std::vector<Linear_motion_2> motions = at_rest({{1, 2}, {3, 2}, {1, 2}});
  motions.push_back({{1, 2}, {0, 8}, 1});
  Kinetic_delaunay kinetic(motions);
  EXPECT_EQ(areas_of(kinetic), (std::vector<double>{4, 8, 4, 0}));
  kinetic.advance_to(1.0);
  EXPECT_EQ(areas_of(kinetic), (std::vector<double>{4, 8, 4, 0}));
  EXPECT_EQ(Kinetic_queries_2(kinetic).nearest_neighbors(), (Ids{2, 0, 0, 0}));
  std::rotate(motions.begin(), motions.end() - 1, motions.end());
  Kinetic_delaunay passed(motions);
  passed.advance_to(1.0);
  EXPECT_EQ(areas_of(passed), (std::vector<double>{8, 0, 8, 0}));
  const Kinetic_queries_2 queries(passed);
  EXPECT_EQ(queries.nearest_neighbors(), (Ids{1, 0, 0, 0}));
  EXPECT_EQ(queries.nearest_neighbors(2), (Ids{1, 3, 0, 3, 0, 1, 0, 1}));
  EXPECT_EQ(queries.closest_pair(), (Edge_ids{0, 1}));
}

TEST(Queries_of_coincident_points, of_which_a_triangle_hides_the_first_know_their_link) {
  const auto disc = [](double x, double y, double weight) {
    return Disc_motion_2{{{x, y}, {0, 0}}, 0, 0, weight};
  };
  const Kinetic_regular_triangulation_2<> kinetic(std::vector<Disc_motion_2>{
      disc(0, 0, 0), disc(8, 0, 0), disc(0, 8, 0), disc(2, 2, 1), disc(2, 2, 3), disc(2, 2, 1)});
  const Kinetic_queries_2<Disc_kinetic_traits_2> queries(kinetic);
  EXPECT_EQ(queries.neighbors(3), Ids{5});
  EXPECT_EQ(queries.neighbors(5), Ids{3});
  EXPECT_EQ(queries.neighbors(4), (Ids{0, 1, 2}));
  EXPECT_TRUE(queries.voronoi_cell(5).is_empty);
  EXPECT_EQ(queries.nearest_vertex({2, 2}), 4u);
  const std::vector<double> areas = queries.rounded_voronoi_areas(square);
  EXPECT_EQ(areas[3], 0);
  EXPECT_EQ(areas[5], 0);
}

// ---- against oracles ----

const Region box = {{{-4, -4}, {7, -4}, {7, 7}, {-4, 7}}, {{{-4, -4}, {7, -4}, {7, 7}, {-4, 7}}}};
const Region corner = {{{0.25, 0.5}, {2, 0.5}, {2, 3}, {0.25, 3}},
                       {{{0.25, 0.5}, {2, 0.5}, {2, 3}, {0.25, 3}}}};

template <class Kinetic, class Queries>
void expect_neighbors(const Kinetic& kinetic, const Queries& queries, const Query_oracle& oracle) {
  for (const auto& [id, place] : oracle.places()) {
    SCOPED_TRACE(testing::Message() << "neighbors of " << id);
    const Ids& group = oracle.group(id);
    const Ids neighbors = queries.neighbors(id);
    if (id != group.front()) {
      ASSERT_EQ(neighbors, Ids{group.front()});
      continue;
    }
    std::set<Point_id> expected;
    for (const Edge_ids& edge : kinetic.finite_edge_ids()) {
      if (edge[0] == id) expected.insert(edge[1]);
      if (edge[1] == id) expected.insert(edge[0]);
    }
    ASSERT_EQ(neighbors.size(), expected.size() + group.size() - 1);
    const auto hidden = neighbors.begin() + static_cast<std::ptrdiff_t>(expected.size());
    EXPECT_EQ(std::set<Point_id>(neighbors.begin(), hidden), expected);
    EXPECT_EQ(Ids(hidden, neighbors.end()), Ids(group.begin() + 1, group.end()));
  }
}

// Returns the number of coincident points whose vertex another one has, summed over the times.
template <class Kinetic>
std::size_t ask_along(Kinetic& kinetic, unsigned seed) {
  std::mt19937_64 random(seed);
  std::size_t hidden = 0;
  test::ask_along(kinetic, 4, [&](const Algebraic_number& time) {
    const auto t = test::rational_value(time);
    if (!t || *t > 30 || testing::Test::HasFatalFailure()) return false;
    SCOPED_TRACE(testing::Message() << "at the time " << *t);
    test::expect_right_answers(kinetic, time, *t, random);
    const Kinetic_queries_2 queries(kinetic, time);
    const Query_oracle oracle(kinetic, *t);
    expect_neighbors(kinetic, queries, oracle);
    for (const Region& region : {box, corner}) {
      test::expect_areas(queries.rounded_voronoi_areas(region.polygon), oracle, region, 60);
    }
    for (const auto& [id, place] : oracle.places()) {
      if (id != oracle.group(id).front()) ++hidden;
    }
    return true;
  });
  return hidden;
}

TEST(Queries_of_coincident_points, on_a_tiny_grid_are_answered_as_by_a_look_at_everything) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(14u); ++seed) {
    const auto motions = test::coincident_motions(2 + seed % 9, seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << test::describe(motions));
    Kinetic_delaunay kinetic(motions);
    hidden += ask_along(kinetic, seed);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(hidden, 100u);
}

// Equal weights are given as weights, or as radii.
TEST(Queries_of_coincident_points, with_weights_are_answered_as_by_a_look_at_everything) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    const auto motions = test::coincident_motions(2 + seed % 8, seed + 1000);
    SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << test::describe(motions));
    std::vector<Disc_motion_2> discs;
    std::mt19937_64 random(seed);
    for (const Linear_motion_2& m : motions) {
      const std::vector<Disc_motion_2> weights = {{m, 0, 0, 0}, {m, 0, 0, 1}, {m, 1, 0, 0}};
      discs.push_back(weights[random() % 3]);
    }
    Kinetic_regular_triangulation_2<> kinetic(discs);
    hidden += ask_along(kinetic, seed);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(hidden, 40u);
}

// Points that join others and part from them at the current time, whose groups then have other
// first points.
TEST(Queries_of_coincident_points, that_join_and_part_are_answered_as_by_a_look_at_everything) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    Kinetic_delaunay kinetic(test::coincident_motions(8, seed));
    for (int k = 0; k < 3; ++k) {
      const auto joins = static_cast<Point_id>(random() % 4);
      const auto other = static_cast<Point_id>(4 + random() % 4);
      const Linear_motion_2 motion = kinetic.motion(other);
      kinetic.set_motion(joins, motion);
      const auto parts = static_cast<Point_id>(4 + random() % 4);
      kinetic.set_motion(parts, test::coincident_motions(1, seed + 100).front());
      if (k == 2) kinetic.erase(static_cast<Point_id>(random() % 2));
      hidden += ask_along(kinetic, seed);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(hidden, 40u);
}

}  // namespace
}  // namespace kinetri::queries_2_coincident_test
