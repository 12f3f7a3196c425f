// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries whose answers floating point does not know: at irrational times, about lengths that are
// all but equal, and about numbers of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_exactness_test {
namespace {

using test::Kinetic_delaunay;
using test::Query_oracle;
using test::static_point;

// So near to a time that random input does not tell the two apart, and rational.
Rational rational_near(const Algebraic_number& time) {
  time.refine_to_bits(400);
  return time.lower();
}

TEST(Queries, at_an_irrational_time_are_answered_as_right_beside_it) {
  int asked = 0;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(-2, 12);
    Kinetic_delaunay kinetic(test::random_motions(5 + seed % 10 / 2, 10, 5, seed));
    for (int i = 0; i < 3; ++i) {
      const auto next = kinetic.next_event_time();
      if (!next) break;
      const Rational far = to_rational(1e50);
      // A root of 2 t^2 = a^2 + b^2, between a and b.
      const Rational a = simplest_between(kinetic.current_time(), *next);
      const Rational b = simplest_between(a, *next);
      const Rational square = (a * a + b * b) / 2;
      const Algebraic_number mean(Polynomial{-boost::multiprecision::numerator(square), 0,
                                             boost::multiprecision::denominator(square)},
                                  a, b);
      for (const Algebraic_number& time : {kinetic.current_time(), mean, *next}) {
        if (test::rational_value(time)) continue;
        ++asked;
        const Kinetic_queries_2 queries(kinetic, time);
        const Query_oracle oracle(kinetic, rational_near(time));
        EXPECT_EQ(queries.closest_pair(), oracle.closest_pair());
        test::expect_right_for_all_points(queries, kinetic.next_id(), oracle);
        for (int j = 0; j < 10; ++j) {
          const Vector_2 place = {anywhere(random), anywhere(random)};
          EXPECT_EQ(queries.nearest_vertex(place), oracle.nearest(static_point(place)));
          EXPECT_EQ(queries.locate(place), oracle.locate(static_point(place)));
        }
        EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(0),
                                  "at a time that is not known to be rational a Voronoi vertex has "
                                  "no exact coordinates; call rounded_voronoi_cell");
        for (const auto& [id, place] : oracle.places()) {
          const auto cell = queries.rounded_voronoi_cell(id);
          // At the time of a flip there is a side less than beside it, whose ends round alike; at
          // that of a hull event, where three points are collinear, a vertex less, which is far.
          std::vector<Vector_2> vertices;
          const auto expected = oracle.cell(id);
          for (const auto& [other, side] : expected.sides) {
            if (!side.target || CGAL::abs(side.target->x()) + CGAL::abs(side.target->y()) > far) {
              continue;
            }
            vertices.push_back({to_double(side.target->x()), to_double(side.target->y())});
          }
          const auto by_coordinates = [](const Vector_2& p, const Vector_2& q) {
            return std::pair(p.x, p.y) < std::pair(q.x, q.y);
          };
          std::ranges::sort(vertices, by_coordinates);
          vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
          auto found = cell.vertices;
          std::ranges::sort(found, by_coordinates);
          EXPECT_EQ(found, vertices) << "cell of " << id;
          EXPECT_TRUE(std::ranges::adjacent_find(found) == found.end());
        }
      }
      kinetic.step();
    }
  }
  EXPECT_GT(asked, 50);
}

// The pair 2-3 is at the distance sqrt(2) t, the pair 0-1 at 2: equal at sqrt(2), where the ids
// decide.
TEST(Queries, a_tie_at_an_irrational_time_is_found) {
  const Kinetic_delaunay kinetic(
      std::vector<Linear_motion_2>{
          {{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{9, 0}, {0, 0}}, {{9, 0}, {1, 1}}},
      Algebraic_number(1.0));
  const Algebraic_number root(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  ASSERT_FALSE(kinetic.has_event_before(2.0));
  EXPECT_EQ(Kinetic_queries_2(kinetic, 1.25).closest_pair(), (Edge_ids{2, 3}));
  EXPECT_EQ(Kinetic_queries_2(kinetic, root).closest_pair(), (Edge_ids{0, 1}));
  EXPECT_EQ(Kinetic_queries_2(kinetic, 1.5).closest_pair(), (Edge_ids{0, 1}));
}

// The pair 2-3 is longer or shorter than 1, the length of the pair 0-1, by 2^-40 t: far less than
// the error of its coordinates in binary64.
TEST(Queries, lengths_that_floating_point_cannot_tell_apart_are_compared_exactly) {
  for (const double difference : {-0x1p-40, 0x1p-40}) {
    const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}},
                                    {{1, 0}, {0, 0}},
                                    {{1e6, 5}, {3, 0}},
                                    {{1e6 + 1, 5}, {3 + difference, 0}}});
    EXPECT_EQ(Kinetic_queries_2(kinetic, 0.1).closest_pair(),
              (difference < 0 ? Edge_ids{2, 3} : Edge_ids{0, 1}));
  }
}

TEST(Queries, of_tiny_and_huge_coordinates_are_exact) {
  const Kinetic_delaunay kinetic({{{1e300, 0}, {1e10, 0}},
                                  {{-1e300, 1}, {0, 3}},
                                  {{0, 0}, {0, 0}},
                                  {{1e-300, 0}, {0, 0}},
                                  {{0, 3e-300}, {0, 0}},
                                  {{0, 1.7e308}, {0, 0}}});
  std::mt19937_64 random(5);
  test::expect_right_answers(kinetic, 0.0, 0, random);
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.closest_pair(), (Edge_ids{2, 3}));
  EXPECT_EQ(queries.nearest_vertex({1e-300, 1e-301}), 3u);
  EXPECT_EQ(queries.nearest_vertex({-1.7e308, 1.7e308}), 5u);
}

}  // namespace
}  // namespace kinetri::queries_2_exactness_test
