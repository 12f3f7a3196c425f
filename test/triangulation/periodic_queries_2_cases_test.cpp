// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries in periodic boxes: cases by hand, and errors.
#include "kinetri/triangulation/periodic_queries_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "support/kinetic_in_box.h"
#include "support/message_of.h"
#include "support/periodic_runs.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_queries_2_cases_test {
namespace {

using test::kinetic_in_box;
using test::square;
using test::text;
using Kinetic = test::Kinetic_in_box;
using Time = Algebraic_number;
using Kind = Location_2::Kind;

TEST(Periodic_queries_2, about_one_point_in_a_square) {
  Kinetic kinetic = kinetic_in_box(square(4), {{{9, 1}, {1, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.time(), Time(0));
  EXPECT_EQ(text(queries.nearest_neighbor(0)), "0 (-1, 0)");
  EXPECT_EQ(text(queries.nearest_neighbors(5)),
            "0 (-1, 0); 0 (0, -1); 0 (0, 1); 0 (1, 0); 0 (-1, -1); ");
  EXPECT_EQ(queries.closest_pair(), (Periodic_edge{{0, 0}, {0, 1}}));
  EXPECT_EQ(text(*queries.nearest_vertex({0, 0})), "0 (-2, 0)");
  EXPECT_EQ(text(queries.locate({5, 1}).points), "0 (-1, 0); ");
  EXPECT_EQ(queries.locate({7, 1}).kind, Kind::edge);
  EXPECT_EQ(text(queries.locate({7, 1}).points), "0 (-1, 0); 0 (0, 0); ");
  EXPECT_EQ(queries.neighbors(0).size(), 6u);
  const auto cell = queries.rounded_voronoi_cell(0);
  EXPECT_EQ(text(cell.neighbors), "0 (-1, 0); 0 (0, -1); 0 (1, 0); 0 (0, 1); ");
  EXPECT_EQ(cell.vertices, (std::vector<Vector_2>{{7, -1}, {11, -1}, {11, 3}, {7, 3}}));
  EXPECT_EQ(queries.rounded_voronoi_areas(), std::vector<double>{16});
  EXPECT_EQ(queries.rounded_positions(), (std::vector<double>{9, 1}));
  EXPECT_EQ(queries.rounded_positions(true), (std::vector<double>{1, 1}));
  // On the sides at the origin, and on the other ones.
  EXPECT_EQ(Periodic_queries_2(kinetic, Time(3)).rounded_positions(true),
            (std::vector<double>{0, 1}));
}

// That is found out when the cell is asked for.
TEST(Periodic_queries_2, give_an_exact_cell_at_a_root_that_is_a_binary64_number) {
  const Kinetic kinetic = kinetic_in_box(square(4), {{{1, 1}, {1, 0}, 0}, {{3, 2}, {0, 1}, 0}});
  const Periodic_queries_2 queries(kinetic, Time(Polynomial{-1, 0, 1024}, 0, 1));
  ASSERT_FALSE(queries.time().is_known_rational());
  const auto cell = queries.voronoi_cell(0);
  const auto expected = Periodic_queries_2(kinetic, Time(0x1p-5)).voronoi_cell(0);
  EXPECT_EQ(text(cell.neighbors), text(expected.neighbors));
  EXPECT_TRUE(std::ranges::equal(cell.vertices, expected.vertices,
                                 [](const Exact_position_2& p, const Exact_position_2& q) {
                                   return p.x == q.x && p.y == q.y;
                                 }));
}

TEST(Periodic_queries_2, about_nothing) {
  Kinetic kinetic = kinetic_in_box(square(4), {});
  const Periodic_queries_2 empty(kinetic);
  EXPECT_EQ(empty.nearest_vertex({1, 1}), std::nullopt);
  EXPECT_EQ(empty.locate({1, 1}), Periodic_location_2());
  EXPECT_TRUE(empty.rounded_voronoi_areas().empty());
  EXPECT_TRUE(empty.nearest_neighbors().empty());
  EXPECT_TRUE(empty.nearest_neighbors(3).empty());
  EXPECT_EQ(empty.closest_pair(), std::nullopt);
  kinetic.insert({{1, 1}, {0, 0}, 0});
  kinetic.insert({{1, 2}, {0, 0}, 0});
  kinetic.erase(0);
  const Periodic_queries_2 queries(kinetic);
  EXPECT_TRUE(std::isnan(queries.rounded_positions()[0]));
  EXPECT_EQ(queries.rounded_positions()[3], 2);
  EXPECT_EQ(queries.nearest_neighbors()[0], Periodic_image());
  EXPECT_EQ(text(queries.nearest_neighbors(2)),
            text({Periodic_image(), Periodic_image(), {1, {-1, 0}}, {1, {0, -1}}}));
  EXPECT_EQ(queries.rounded_voronoi_areas(), (std::vector<double>{0, 16}));
}

TEST(Periodic_queries_2, throw_as_those_in_the_plane) {
  Kinetic kinetic = kinetic_in_box(square(4), {{{1, 1}, {1, 0}, 0}, {{3, 2}, {0, 1}, 0}});
  kinetic.advance_to(Time(Rational(1) / 16));
  EXPECT_PRECONDITION_ERROR(Periodic_queries_2(kinetic, Time(0)),
                            "a query about the past; query a time before the triangulation "
                            "advances beyond it");
  EXPECT_PRECONDITION_ERROR(Periodic_queries_2(kinetic, Time(100)),
                            "a query about a time after the next event; call advance_to for that "
                            "time first");
  const Periodic_queries_2 queries(kinetic);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(queries.nearest_vertex({infinity, 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({0, std::nan("")}),
                            "a place has a coordinate that is not finite");
  EXPECT_THROW(queries.neighbors(2), Precondition_error);
  EXPECT_THROW(queries.voronoi_cell(2), Precondition_error);
  EXPECT_THROW(queries.nearest_neighbor(2), Precondition_error);
  EXPECT_PRECONDITION_ERROR(queries.nearest_neighbors(std::size_t{1} << 32),
                            "k is 4294967296; expected less than 2^32");
  for (const double far : {1e10, 1e300}) {
    EXPECT_EQ(
        test::message_of<Periodic_box_error>([&] {
          queries.locate({far, 0});
        }),
        "a position is 2^31 or more lattice vectors away from point 0; expected less: take an "
        "image of it that is closer");
  }
  kinetic.step();
  EXPECT_PRECONDITION_ERROR(queries.rounded_positions(),
                            "the triangulation has changed since these queries were made; make new "
                            "ones after an event");

  const Kinetic shrinking = kinetic_in_box({{{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, 0}, 0}}, {});
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] { Periodic_queries_2(shrinking, Time(4)); }),
            "the periodic box has no area at time 4; stop before that time, or change the rates of "
            "the lattice vectors");
}

// The quotients of these positions and the side round to the other side of 7 and of 9.
TEST(Periodic_queries_2, know_exactly_what_is_in_the_box) {
  const double side = 0.1;
  const Vector_2 place = {0.7000000000000001, 0.9};
  const Kinetic kinetic = kinetic_in_box(square(side), {{place, {0, 0}, 0}});
  const auto rest = [&](double x, int sides) {
    return to_double(to_rational(x) - sides * to_rational(side));
  };
  EXPECT_EQ(Periodic_queries_2(kinetic).rounded_positions(true),
            (std::vector<double>{rest(place.x, 7), rest(place.y, 8)}));
}

TEST(Periodic_queries_2, refuse_images_beyond_2_to_the_31_boxes) {
  const Kinetic kinetic =
      kinetic_in_box(square(1), {{{0, 0}, {0, 0}, 0}, {{0x1p30, 0.5}, {0, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(text(*queries.nearest_vertex({5, 0.5})), "1 (-1073741819, 0)");
  EXPECT_EQ(test::message_of<Periodic_box_error>([&] {
              queries.nearest_vertex({-0x1p30, 0});
            }),
            "an image of a point is 2^31 or more lattice vectors away from the position of the "
            "point; give positions that are closer together");
}

// An image of a point that is on it for a while is another one, at the distance 0.
TEST(Periodic_queries_2, about_images_that_coincide_for_a_while) {
  const Kinetic kinetic =
      kinetic_in_box(square(4), {{{1, 1}, {0, 0}, 0}, {{9, 1}, {0, 0}, 0}, {{2, 1}, {0, 0}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.closest_pair(), (Periodic_edge{{0, 1}, {-2, 0}}));
  EXPECT_EQ(text(queries.nearest_neighbors(3)),
            "1 (-2, 0); 2 (0, 0); 2 (-1, 0); 0 (2, 0); 2 (2, 0); 2 (1, 0); "
            "0 (0, 0); 1 (-2, 0); 0 (1, 0); ");
}

// Numbers whose products are too great for binary64.
TEST(Periodic_queries_2, about_huge_boxes_are_exact) {
  const double side = 0x1p600;
  const Kinetic kinetic =
      kinetic_in_box(square(side), {{{0, 0}, {0, 0}, 0}, {{side / 2, 0}, {}, 0}});
  const Periodic_queries_2 queries(kinetic);
  EXPECT_EQ(text(*queries.nearest_vertex({5.75 * side, 3 * side})), "0 (6, 3)");
  EXPECT_EQ(text(*queries.nearest_vertex({0x1p630, 0})), "0 (1073741824, 0)");
  EXPECT_EQ(queries.rounded_voronoi_cell(0).vertices.size(), 4u);
  EXPECT_PRECONDITION_ERROR(queries.rounded_voronoi_areas(),
                            "a Voronoi cell is so large that its area may not be a binary64 "
                            "number; give lattice vectors below 1e150");
}

}  // namespace
}  // namespace kinetri::periodic_queries_2_cases_test
