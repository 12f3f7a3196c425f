// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nearest neighbors, closest pairs, positions and rounded cells of all points against a look at all
// pairs: on lattices, of accelerated points, and of points that nearly coincide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_nearest_test {
namespace {

using test::expect_right_for_all_points;
using test::Kinetic_delaunay;
using test::Query_oracle;
using test::Static_point;

void expect_right_at(const Kinetic_delaunay& kinetic, const Rational& t) {
  const Kinetic_queries_2 queries(kinetic, Algebraic_number(t));
  const Query_oracle oracle(kinetic, t);
  expect_right_for_all_points(queries, kinetic.next_id(), oracle);
  EXPECT_EQ(queries.closest_pair(), oracle.closest_pair());
  for (const auto& [id, place] : oracle.places()) {
    test::expect_rounded(queries.rounded_voronoi_cell(id), queries.voronoi_cell(id));
  }
}

// Every point has up to four nearest ones, at rest and while all move alike; the ids are shuffled.
TEST(Nearest, on_a_lattice_are_the_smallest_ids) {
  std::mt19937_64 random(4);
  for (const Vector_2& velocity : {Vector_2{0, 0}, Vector_2{0.1, -0.3}}) {
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 49; ++i) {
      motions.push_back({{i % 7 * 10.0, i / 7 * 10.0}, velocity});
    }
    std::shuffle(motions.begin(), motions.end(), random);
    const Kinetic_delaunay kinetic(motions);
    expect_right_at(kinetic, 0);
    expect_right_at(kinetic, to_rational(0.7));
    expect_right_at(kinetic, Rational(1, 3));
  }
}

TEST(Nearest, of_random_points_at_any_time_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(test::random_motions(40, 30, 4, seed));
    const double time = 0.1 * (seed % 8);
    kinetic.advance_to(time);
    expect_right_at(kinetic, to_rational(time));
    const Rational between = simplest_between(kinetic.current_time(), *kinetic.next_event_time());
    expect_right_at(kinetic, (between + 2 * to_rational(time)) / 3);
  }
}

// Of two points that are apart by less than binary64 numbers tell, next to one that is a little
// farther away; with the ids in either order.
TEST(Nearest, of_points_that_nearly_coincide_are_exact) {
  for (const double small : {0x1p-60, 0x1p-80, 0x1p-200, 0x1p-1000}) {
    SCOPED_TRACE(small);
    for (const double sign : {-1.0, 1.0}) {
      const Kinetic_delaunay kinetic({{{1, 1}, {0, 0}},
                                      {{1, 1}, {small, 0}},
                                      {{1, 1}, {0, sign * small}},
                                      {{1, 1}, {-small, small * 0x1p-30}},
                                      {{5, 2}, {0, 0}}},
                                     Algebraic_number(1.0));
      expect_right_at(kinetic, 1);
    }
  }
}

// Two points on a circle about a third one whose distances differ by some 2^-60 of themselves.
TEST(Nearest, of_distances_that_floating_point_cannot_tell_apart_are_exact) {
  for (const double difference : {-0x1p-60, 0.0, 0x1p-60}) {
    const Kinetic_delaunay kinetic(
        {{{0, 0}, {0, 0}}, {{3, 4}, {0, 0}}, {{-5, 0}, {difference, 0}}, {{50, 1}, {0, 0}}},
        Algebraic_number(1.0));
    expect_right_at(kinetic, 1);
    EXPECT_EQ(Kinetic_queries_2(kinetic).nearest_neighbor(0), difference > 0 ? 2u : 1u);
  }
}

TEST(Nearest, of_one_point_or_none_is_none) {
  const Kinetic_delaunay nothing{std::vector<Linear_motion_2>{}};
  EXPECT_TRUE(Kinetic_queries_2(nothing).nearest_neighbors().empty());
  EXPECT_TRUE(Kinetic_queries_2(nothing).rounded_positions().empty());
  Kinetic_delaunay one(std::vector<Linear_motion_2>{{{1, 2}, {0, 0}}});
  const Kinetic_queries_2 queries(one);
  EXPECT_EQ(queries.nearest_neighbor(0), std::nullopt);
  EXPECT_EQ(queries.nearest_neighbors(), (std::vector<Point_id>{no_point}));
  EXPECT_TRUE(Kinetic_queries_2(nothing).nearest_neighbors(2).empty());
  EXPECT_EQ(queries.nearest_neighbors(2), (std::vector<Point_id>{no_point, no_point}));
  EXPECT_TRUE(queries.nearest_neighbors(0).empty());
  EXPECT_EQ(queries.rounded_positions(), (std::vector<double>{1, 2}));
}

TEST(Nearest, of_points_that_come_and_go_know_them) {
  Kinetic_delaunay kinetic(test::random_motions(12, 10, 3, 5));
  kinetic.advance_to(0.5);
  for (const Point_id id : {0u, 3u, 11u}) kinetic.erase(id);
  kinetic.insert({kinetic.motion(5).position, {1, 1}, kinetic.motion(5).epoch});
  expect_right_at(kinetic, Rational(1, 2));
}

TEST(Nearest, after_an_event_or_of_no_point_is_refused) {
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  const Kinetic_queries_2 queries(kinetic, 1.0);
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbor(4),
                            "no point has the id 4; ask contains(id) first");
  kinetic.advance_to(2.0);
  const std::string problem =
      "the triangulation has changed since these queries were made; make new ones after an event";
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbor(0), problem);
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbors(), problem);
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbors(2), problem);
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic).nearest_neighbors(std::size_t{1} << 32),
                            "k is 4294967296; expected less than 2^32");
  EXPECT_PRECONDITION_ERROR(queries.rounded_positions(), problem);
  const std::vector<Vector_2> triangle = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_PRECONDITION_ERROR(queries.rounded_voronoi_areas(triangle), problem);
}

// Ball arithmetic says nothing then, and exact arithmetic decides.
TEST(Nearest, are_the_same_where_the_processor_rounds_upward) {
  const Kinetic_delaunay kinetic(test::random_motions(12, 10, 3, 5));
  const Kinetic_queries_2 queries(kinetic);
  const auto answers = [&] {
    std::vector<Vector_2> vertices;
    for (Point_id id = 0; id < 12; ++id) {
      for (const Vector_2& v : queries.rounded_voronoi_cell(id).vertices) vertices.push_back(v);
    }
    return std::tuple(vertices, queries.nearest_neighbors(), queries.nearest_neighbors(4),
                      queries.closest_pair(), queries.rounded_positions());
  };
  const auto expected = answers();
  std::fesetround(FE_UPWARD);
  const auto found = answers();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(found, expected);
}

// Of accelerated points, at a binary64 time and at another one.
TEST(Nearest, of_accelerated_points_are_those_of_all_pairs) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = test::random_polynomial_motions(30, 30, 2, seed);
    const Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2> kinetic(motions, 0.3);
    for (const Rational& t :
         {to_rational(0.3), to_rational(0.3) + Rational(1, Integer(1) << 60) / 3}) {
      const Kinetic_queries_2<Polynomial_kinetic_traits_2> queries(kinetic, Algebraic_number(t));
      const std::vector<double> positions = queries.rounded_positions();
      std::vector<Static_point> places;
      for (const Polynomial_motion_2& m : motions) places.push_back(test::place_at(m, t));
      for (Point_id id = 0; id < places.size(); ++id) {
        EXPECT_EQ(positions[2 * id], to_double(places[id].x()));
        EXPECT_EQ(positions[2 * id + 1], to_double(places[id].y()));
        Point_id nearest = id == 0 ? 1 : 0;
        for (Point_id other = 0; other < places.size(); ++other) {
          if (other != id &&
              CGAL::has_smaller_distance_to_point(places[id], places[other], places[nearest])) {
            nearest = other;
          }
        }
        EXPECT_EQ(queries.nearest_neighbor(id), nearest);
        test::expect_rounded(queries.rounded_voronoi_cell(id), queries.voronoi_cell(id));
      }
    }
  }
}

}  // namespace
}  // namespace kinetri::queries_2_nearest_test
