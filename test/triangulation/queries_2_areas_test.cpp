// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of Voronoi cells within polygons against areas in exact arithmetic, from all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "support/area_oracle.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_areas_test {
namespace {

using test::exact_area;
using test::expect_areas;
using test::Kinetic_delaunay;
using test::Query_oracle;
using test::Region;

Region box(double xmin, double ymin, double xmax, double ymax) {
  const std::vector<Vector_2> corners = {{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}};
  return {corners, {corners}};
}

// Around the points of grids, across them, beside them; a triangle; and the shape of a U,
// clockwise, whose arms some cells reach while the part between them belongs to them as well.
std::vector<Region> regions() {
  const std::vector<Vector_2> triangle = {{-2, 0.5}, {5, -1}, {1.5, 6}};
  const Region u = {{{0, 0}, {0, 4}, {1, 4}, {1, 1}, {3, 1}, {3, 4}, {4, 4}, {4, 0}},
                    {{{0, 0}, {1, 0}, {1, 4}, {0, 4}},
                     {{1, 0}, {3, 0}, {3, 1}, {1, 1}},
                     {{3, 0}, {4, 0}, {4, 4}, {3, 4}}}};
  return {
      box(-5, -5, 10, 10), box(0.25, 0.5, 2, 3), box(20, -3, 21, 40), {triangle, {triangle}}, u};
}

void expect_areas_in_all_regions(const Kinetic_delaunay& kinetic, const Algebraic_number& time,
                                 const Rational& t) {
  const Kinetic_queries_2 queries(kinetic, time);
  const Query_oracle oracle(kinetic, t);
  for (const Region& region : regions()) {
    const auto areas = queries.rounded_voronoi_areas(region.polygon);
    ASSERT_EQ(areas.size(), kinetic.next_id());
    ASSERT_NO_FATAL_FAILURE(expect_areas(areas, oracle, region, 40));
  }
}

// Just after the start, in between and at each event, before it happens and after.
void ask_along(const std::vector<Linear_motion_2>& motions, int instants) {
  SCOPED_TRACE(test::describe(motions));
  Kinetic_delaunay kinetic(motions);
  for (int i = 0; i < instants && !testing::Test::HasFatalFailure(); ++i) {
    const auto ask = [&](const Algebraic_number& time) {
      const auto t = test::rational_value(time);
      if (t && *t < 30) expect_areas_in_all_regions(kinetic, time, *t);
    };
    ask(kinetic.current_time());
    const auto next = kinetic.next_event_time();
    if (!next) return;
    ask(simplest_between(kinetic.current_time(), *next));
    ask(*next);
    kinetic.step();
  }
}

TEST(Areas, on_grids_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    SCOPED_TRACE(seed);
    ask_along(test::grid_motions(seed % 8, 3, 1, seed), 3);
    if (HasFatalFailure()) return;
  }
}

TEST(Areas, of_random_points_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE(seed);
    ask_along(test::random_motions(12, 6, 3, seed), 2);
    if (HasFatalFailure()) return;
  }
}

TEST(Areas, of_lattices_and_of_points_on_a_line_are_those_of_the_exact_cells) {
  std::vector<Linear_motion_2> lattice;
  std::vector<Linear_motion_2> line;
  for (int i = 0; i < 16; ++i) {
    lattice.push_back({{i % 4 - 0.5, i / 4 + 0.5}, {0, 0}});
    if (i % 3 == 0) line.push_back({{i / 4.0, i / 8.0}, {0, 0}});
  }
  expect_areas_in_all_regions(Kinetic_delaunay(lattice), 0.0, 0);
  expect_areas_in_all_regions(Kinetic_delaunay(line), 0.0, 0);
}

// Five points meet at t = 1, with others around; two of them are erased later.
TEST(Areas, where_points_meet_are_those_of_the_first_of_them) {
  Kinetic_delaunay kinetic({{{3, 1}, {-1, 0}},
                            {{1, 1}, {1, 0}},
                            {{2, 3}, {0, -2}},
                            {{2, 1}, {0, 0}},
                            {{0, -1}, {2, 2}},
                            {{-4, -4}, {0, 0}},
                            {{6, 0}, {0, 0}},
                            {{0, 7}, {0, 0}},
                            {{5, 5}, {0, 0}}});
  while (*kinetic.next_event_time() < 1.0) kinetic.step();
  expect_areas_in_all_regions(kinetic, 1.0, 1);
  kinetic.advance_to(1.0);
  expect_areas_in_all_regions(kinetic, 1.0, 1);
  kinetic.erase(0);
  kinetic.erase(6);
  expect_areas_in_all_regions(kinetic, 1.0, 1);
  const auto areas = Kinetic_queries_2(kinetic).rounded_voronoi_areas(box(-5, -5, 8, 8).polygon);
  EXPECT_EQ(areas[0], 0);
  EXPECT_GT(areas[1], 0);
  EXPECT_EQ(areas[2], 0);
}

// Pairs that are so near to each other that binary64 numbers do not hold their difference, and
// places that cancellation leaves. The bisectors are in directions that only exact arithmetic
// knows.
TEST(Areas, of_points_that_nearly_coincide_are_those_of_the_exact_cells) {
  const std::vector<std::vector<Linear_motion_2>> pairs = {
      {{{1, 1}, {0, 0}}, {{1, 1}, {0x1p-70, 0x1p-71}}},
      {{{1, 1}, {0, 0}}, {{1, 1}, {0x1p-120, -0x1p-119}}},
      {{{1, 1}, {0, 0}}, {{1, 1}, {0x1p-1000, 0x1p-1000}, 1 - 0x1p-53}},
      {{{0, 0}, {0, 0}}, {{0, 0}, {0x1p-1070, 0x1p-1072}, 1 - 0x1p-53}, {{3, 3}, {0x1p-1070, 0}}},
      {{{-1e17, 1e17}, {1e17, -1e17}}, {{-1e17, 1e17}, {1e17 + 16, -1e17 + 32}}}};
  for (const auto& motions : pairs) {
    SCOPED_TRACE(test::describe(motions));
    const Kinetic_delaunay kinetic(motions, Algebraic_number(1.0));
    expect_areas_in_all_regions(kinetic, 1.0, 1);
  }
}

TEST(Areas, of_points_far_away_and_of_nearly_flat_triangles_are_those_of_the_exact_cells) {
  expect_areas_in_all_regions(Kinetic_delaunay({{{1e300, 0}, {0, 0}},
                                                {{-1.7e308, 1}, {0, 0}},
                                                {{1, 1}, {0, 0}},
                                                {{1.7e308, 1e308}, {0, 0}}}),
                              0.0, 0);
  expect_areas_in_all_regions(Kinetic_delaunay({{{0, 0}, {0, 0}},
                                                {{1, 0x1p-50}, {0, 0}},
                                                {{2, 0}, {0, 0}},
                                                {{3, -0x1p-51}, {0, 0}},
                                                {{1.5, 30}, {0, 0}}}),
                              0.0, 0);
}

// Most cells are in the box: their areas are summed over triangles, of which many are nearly flat
// in half of the cases. Positions are binary64 numbers at time 0 only.
TEST(Areas, of_cells_in_a_convex_polygon_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 4);
    std::uniform_int_distribution<int> exponent(-40, -2);
    std::vector<Linear_motion_2> motions(20);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      Linear_motion_2& motion = motions[i];
      motion.position = {place(random), place(random)};
      const double little = std::ldexp(place(random) - 2, exponent(random));
      if (seed % 2 == 0 && i < 10) {
        motion.position = {1 + static_cast<double>(i) / 5, 2 + little};
      } else if (i % 2 == 1) {
        const Vector_2 other = motions[i - 1].position;
        motion.position = {other.x + little, other.y - little * place(random)};
      }
      if (seed % 4 < 2) motion.velocity = {std::ldexp(place(random), -9), 0};
    }
    const Kinetic_delaunay kinetic(motions);
    const Kinetic_queries_2 queries(kinetic);
    const Query_oracle oracle(kinetic, 0);
    Region clockwise = box(-1, -1, 5, 5);
    std::ranges::reverse(clockwise.polygon);
    for (const Region& region : {box(-5, -5, 10, 10), box(0.5, 0.5, 3.5, 3.75), clockwise}) {
      ASSERT_NO_FATAL_FAILURE(
          expect_areas(queries.rounded_voronoi_areas(region.polygon), oracle, region, 10));
    }
    const Rational third = Rational(1, 3 << 20);
    if (kinetic.has_event_before(Algebraic_number(third))) continue;
    const Region region = box(-5, -5, 10, 10);
    ASSERT_NO_FATAL_FAILURE(expect_areas(
        Kinetic_queries_2(kinetic, Algebraic_number(third)).rounded_voronoi_areas(region.polygon),
        Query_oracle(kinetic, third), region, 10));
  }
}

// The pair 0-1 is sqrt(2) to the left and to the right of x = 2 then, and the pair 2-3 as far above
// and below y = 2: four equal triangles.
TEST(Areas, at_an_irrational_time_are_right) {
  const Kinetic_delaunay kinetic(
      {{{2, 2}, {-1, 0}}, {{2, 2}, {1, 0}}, {{2, 2}, {0, -1}}, {{2, 2}, {0, 1}}},
      Algebraic_number(1.0));
  const Algebraic_number root(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  const auto areas =
      Kinetic_queries_2(kinetic, root).rounded_voronoi_areas(box(0, 0, 4, 4).polygon);
  for (const double area : areas) EXPECT_NEAR(area, 4, 1e-14);
}

TEST(Areas, in_what_is_no_polygon_are_refused) {
  const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}});
  const Kinetic_queries_2 queries(kinetic);
  const auto areas = [&](const std::vector<Vector_2>& polygon) {
    return queries.rounded_voronoi_areas(polygon);
  };
  EXPECT_PRECONDITION_ERROR(areas({{0, 0}, {1, 0}}),
                            "a polygon with 2 vertices; expected three or more");
  EXPECT_PRECONDITION_ERROR(areas({{0, 0}, {1, 0}, {1, std::numeric_limits<double>::quiet_NaN()}}),
                            "vertex 2 of the polygon has a coordinate that is not finite, or "
                            "beyond 1e150; expected one whose square is finite");
  EXPECT_PRECONDITION_ERROR(areas({{0, 0}, {-1e151, 0}, {1, 1}}),
                            "vertex 1 of the polygon has a coordinate that is not finite, or "
                            "beyond 1e150; expected one whose square is finite");
  for (const std::vector<Vector_2>& polygon :
       {std::vector<Vector_2>{{0, 0}, {1, 1}, {1, 0}, {0, 1}},
        std::vector<Vector_2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}}}) {
    EXPECT_PRECONDITION_ERROR(areas(polygon),
                              "a polygon with edges that meet, or with a vertex that is named "
                              "twice; expected a simple one, without the first vertex again at the "
                              "end");
  }
}

}  // namespace
}  // namespace kinetri::queries_2_areas_test
