// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of cells within walls against exact arithmetic: from all pairs of points, and from convex
// parts of the walkable area that are written down here.
#include "kinetri/observers/cell_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/area_oracle.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::cell_areas_test {
namespace {

using test::exact_area;
using test::Query_oracle;
using test::Static_point;
using test::Weighted_place;

using Part = std::vector<Static_point>;

// ---- the oracle ----

// A walkable area, and counterclockwise convex polygons whose union it is, disjoint but for sides.
struct Room {
  const char* text;
  std::vector<std::vector<Vector_2>> convex_parts;
};

// Whether the polygons share a segment.
bool share_a_side(const Part& one, const Part& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    const auto& a = one[i];
    const auto& b = one[(i + 1) % one.size()];
    for (std::size_t k = 0; k < other.size(); ++k) {
      const auto& c = other[k];
      const auto& d = other[(k + 1) % other.size()];
      if (a == b || c == d) continue;
      if (CGAL::orientation(a, b, c) != CGAL::COLLINEAR ||
          CGAL::orientation(a, b, d) != CGAL::COLLINEAR) {
        continue;
      }
      const Rational at_c = (c - a) * (b - a);
      const Rational at_d = (d - a) * (b - a);
      const Rational end = (b - a) * (b - a);
      const Rational from = std::max(Rational(0), std::min(at_c, at_d));
      const Rational to = std::min(end, std::max(at_c, at_d));
      if (from < to) return true;
    }
  }
  return false;
}

bool contains(const Part& polygon, const Static_point& place) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (CGAL::orientation(polygon[i], polygon[(i + 1) % polygon.size()], place) ==
        CGAL::RIGHT_TURN) {
      return false;
    }
  }
  return true;
}

Part exact_polygon(const std::vector<Vector_2>& polygon) {
  Part result;
  for (const Vector_2& v : polygon) result.push_back(test::static_point(v));
  return result;
}

bool contains(const Room& room, const Static_point& place) {
  return std::ranges::any_of(
      room.convex_parts, [&](const auto& part) { return contains(exact_polygon(part), place); });
}

// The area of the part of the cell that has its point; of all of it if the cell has not.
std::map<Point_id, Rational> exact_connected_areas(const std::map<Point_id, Weighted_place>& places,
                                                   const Room& room) {
  std::map<Point_id, Rational> result;
  std::set<Weighted_place> seen;
  for (const auto& [id, p] : places) {
    Rational& area = result[id];
    if (!seen.insert(p).second) continue;
    if (!contains(room, p.first)) continue;
    bool has_point = true;
    for (const auto& [other, q] : places) {
      const Rational power = CGAL::squared_distance(p.first, q.first) - q.second;
      if (power < -p.second) has_point = false;
    }
    std::vector<Part> parts;
    std::vector<bool> is_connected;
    for (const auto& convex : room.convex_parts) {
      Part part = exact_polygon(convex);
      const bool is_start = contains(part, p.first);
      for (const auto& [other, q] : places) {
        if (q != p) part = test::nearer_part(part, p, q);
      }
      if (exact_area(part) == 0) continue;
      parts.push_back(part);
      is_connected.push_back(is_start || !has_point);
    }
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = 0; k < parts.size(); ++k) {
          if (is_connected[i] && !is_connected[k] && share_a_side(parts[i], parts[k])) {
            has_grown = is_connected[k] = true;
          }
        }
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (is_connected[i]) area += exact_area(parts[i]);
    }
  }
  return result;
}

// A square; a room with a square hole; two rooms with a door; a U, clockwise; a comb with teeth;
// two polygons that touch in a corner.
std::vector<Room> rooms() {
  return {
      {"POLYGON((-1 -1, 5 -1, 5 5, -1 5, -1 -1))", {{{-1, -1}, {5, -1}, {5, 5}, {-1, 5}}}},
      {"POLYGON((-1 -1, 5 -1, 5 5, -1 5, -1 -1),(1 1, 3 1, 3 3, 1 3, 1 1))",
       {{{-1, -1}, {5, -1}, {5, 1}, {-1, 1}},
        {{-1, 1}, {1, 1}, {1, 3}, {-1, 3}},
        {{3, 1}, {5, 1}, {5, 3}, {3, 3}},
        {{-1, 3}, {5, 3}, {5, 5}, {-1, 5}}}},
      {"POLYGON((-2 -2, 1.5 -2, 1.5 1, 1.75 1, 1.75 -2, 6 -2, 6 6, 1.75 6, 1.75 1.25, 1.5 1.25, "
       "1.5 6, -2 6, -2 -2))",
       {{{-2, -2}, {1.5, -2}, {1.5, 6}, {-2, 6}},
        {{1.5, 1}, {1.75, 1}, {1.75, 1.25}, {1.5, 1.25}},
        {{1.75, -2}, {6, -2}, {6, 6}, {1.75, 6}}}},
      {"POLYGON((0 0, 0 4, 1 4, 1 1, 3 1, 3 4, 4 4, 4 0, 0 0))",
       {{{0, 0}, {1, 0}, {1, 4}, {0, 4}},
        {{1, 0}, {3, 0}, {3, 1}, {1, 1}},
        {{3, 0}, {4, 0}, {4, 4}, {3, 4}}}},
      {"POLYGON((-1 -1, 8 -1, 5 5, 4 0, 3 5, 2 0, 1 5, 0 0, -1 5, -1 -1))",
       {{{-1, -1}, {8, -1}, {7.5, 0}, {-1, 0}},
        {{-1, 0}, {0, 0}, {-1, 5}},
        {{0, 0}, {2, 0}, {1, 5}},
        {{2, 0}, {4, 0}, {3, 5}},
        {{4, 0}, {7.5, 0}, {5, 5}}}},
      {"GEOMETRYCOLLECTION(POLYGON((-1 -1, 2 -1, 2 2, -1 2, -1 -1)), "
       "POLYGON((2 2, 5 2, 5 5, 2 5, 2 2)))",
       {{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}, {{2, 2}, {5, 2}, {5, 5}, {2, 5}}}}};
}

template <class Kinetic>
void expect_exact_areas(const Kinetic& kinetic, const Rational& t, const Room& room) {
  constexpr bool has_weights = HasWeight<typename Kinetic::Motion>;
  SCOPED_TRACE(room.text);
  const Query_oracle oracle(kinetic, t);
  std::map<Point_id, Weighted_place> places;
  for (const auto& [id, p] : oracle.places()) {
    places.emplace(id, Weighted_place(p, oracle.weight(id)));
  }
  auto expected = exact_connected_areas(places, room);
  test::share_areas(expected, oracle);
  const auto areas = cell_areas(kinetic, {Walkable_area::from_wkt(room.text)});
  ASSERT_EQ(areas.size(), expected.size());
  auto next = expected.begin();
  for (const auto& [id, area, error] : areas) {
    SCOPED_TRACE(testing::Message() << "area of " << id << " at " << t);
    ASSERT_EQ(id, next->first);
    const Rational exact = (next++)->second;
    const Rational difference = abs(Rational(to_rational(area) - exact));
    ASSERT_LE(difference, to_rational(error)) << area << " " << to_double(exact);
    ASSERT_LE(error, 1e-9);
    // A power cell may be a segment or a position: then only the error bounds its area.
    if (exact == 0 && !(has_weights && contains(room, places.at(id).first))) {
      ASSERT_EQ(area, 0);
    }
  }
}

// At the start, at the time of each event, and in between.
template <class Kinetic>
void expect_exact_areas_along(Kinetic& kinetic, int instants) {
  for (int i = 0; i < instants; ++i) {
    const auto t = test::rational_value(kinetic.current_time());
    if (t) {
      for (const Room& room : rooms()) {
        ASSERT_NO_FATAL_FAILURE(expect_exact_areas(kinetic, *t, room));
      }
    }
    const auto next = kinetic.next_event_time();
    if (!next || *next > 30.0) return;
    if (i % 2 == 0) {
      kinetic.advance_to(simplest_between(kinetic.current_time(), *next));
    } else {
      kinetic.step();
    }
  }
}

// ---- against the oracle ----

TEST(CellAreas, of_points_on_grids_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < test::cases(16u); ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay_triangulation_2<> kinetic(test::grid_motions(1 + seed % 8, 4, 1, seed));
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(kinetic, 5));
  }
}

TEST(CellAreas, of_random_points_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay_triangulation_2<> kinetic(test::random_motions(10, 5, 3, seed));
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(kinetic, 4));
  }
}

TEST(CellAreas, of_points_that_accelerate_are_those_of_the_exact_cells) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_triangulation_2<Polynomial_kinetic_traits_2> kinetic(
        test::polynomial_grid_motions(6, 4, 1, 1, seed));
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(kinetic, 4));
  }
}

// Some discs are hidden, some do not have their center in their cell, some coincide.
TEST(CellAreas, of_discs_are_those_of_the_exact_power_cells) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> radius(0, 3);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : test::grid_motions(2 + seed % 7, 5, 1, seed)) {
      discs.push_back({motion, radius(random) * 0.75, seed % 2 == 0 ? 0.0 : 0.25, 0});
    }
    Kinetic_triangulation_2<Disc_kinetic_traits_2> kinetic(discs);
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(kinetic, 3));
  }
}

TEST(CellAreas, of_points_that_coincide_for_a_while_are_equal_shares_of_the_exact_cells) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = test::coincident_motions(2 + seed % 8, seed);
    Kinetic_delaunay_triangulation_2<> kinetic(motions);
    hidden += kinetic.number_of_hidden_points();
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(kinetic, 3));
    std::vector<Disc_motion_2> discs;
    std::mt19937_64 random(seed);
    for (const Linear_motion_2& motion : motions) {
      discs.push_back({motion, 0, 0, static_cast<double>(random() % 2)});
    }
    Kinetic_triangulation_2<Disc_kinetic_traits_2> of_discs(discs);
    ASSERT_NO_FATAL_FAILURE(expect_exact_areas_along(of_discs, 3));
  }
  EXPECT_GT(hidden, 5u);
}

TEST(CellAreas, of_points_that_nearly_coincide_are_those_of_the_exact_cells) {
  const std::vector<std::vector<Linear_motion_2>> pairs = {
      {{{2, 0}, {0, 0}}, {{2, 0}, {0x1p-70, 0x1p-71}}},
      {{{2, 0}, {0, 0}}, {{2, 0}, {0x1p-120, -0x1p-119}}},
      {{{2, 0}, {0, 0}}, {{2, 0}, {0x1p-1000, 0x1p-1000}, 1 - 0x1p-53}},
      {{{-1e17, 1e17}, {1e17, -1e17}}, {{-1e17, 1e17}, {1e17 + 16, -1e17 + 32}}}};
  for (const auto& motions : pairs) {
    SCOPED_TRACE(test::describe(motions));
    const Kinetic_delaunay_triangulation_2<> kinetic(motions, Algebraic_number(1.0));
    for (const Room& room : rooms()) {
      ASSERT_NO_FATAL_FAILURE(expect_exact_areas(kinetic, 1, room));
    }
  }
}

// Coordinates of maps: far from the origin, the positions do not lose digits to it.
TEST(CellAreas, far_from_the_origin_are_as_good_as_near_to_it) {
  const double east = 5e6;
  const std::string room =
      "POLYGON((5000000 5000000, 5000008 5000000, 5000008 5000008, 5000000 5000008, "
      "5000000 5000000))";
  const Kinetic_delaunay_triangulation_2<> kinetic(
      std::vector<Linear_motion_2>{{{east + 1, east + 1}, {0, 0}},
                                   {{east + 1.0625, east + 1}, {0, 0}},
                                   {{east + 4, east}, {0, 0}}});
  double sum = 0;
  for (const Cell_area& cell : cell_areas(kinetic, {Walkable_area::from_wkt(room)})) {
    EXPECT_LT(cell.error, 1e-11);
    sum += cell.area;
  }
  EXPECT_NEAR(sum, 64, 1e-12);
}

// ---- known cases ----

std::vector<double> areas_in(const char* text, const std::vector<Vector_2>& places) {
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : places) motions.push_back({place, {0, 0}});
  std::vector<double> result;
  for (const auto& cell :
       cell_areas(Kinetic_delaunay_triangulation_2<>(motions), {Walkable_area::from_wkt(text)})) {
    result.push_back(cell.area);
  }
  return result;
}

constexpr const char* square = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))";

TEST(CellAreas, of_known_cells_are_known) {
  EXPECT_EQ(areas_in(square, {}), std::vector<double>{});
  EXPECT_EQ(areas_in(square, {{1, 2}}), std::vector<double>{16});
  for (const double area : areas_in(square, {{1, 1}, {3, 1}, {3, 3}, {1, 3}})) {
    EXPECT_NEAR(area, 4, 1e-14);
  }
  EXPECT_EQ(areas_in(square, {{1, 2}, {2, 2}, {3, 2}}), (std::vector<double>{6, 4, 6}));
}

TEST(CellAreas, of_points_outside_are_zero_and_a_wall_is_inside) {
  EXPECT_EQ(areas_in(square, {{1, 2}, {5, 2}}), (std::vector<double>{12, 0}));
  EXPECT_EQ(areas_in(square, {{0, 2}, {4, 2}}), (std::vector<double>{8, 8}));
  EXPECT_NEAR(areas_in(square, {{0, 0}, {4, 4}})[0], 8, 1e-14);
  EXPECT_EQ(areas_in("POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,3 1,3 3,1 3,1 1))", {{2, 2}, {2, 1}}),
            (std::vector<double>{0, 5}));  // all below y = 1.5
}

// Its path leads along a slanted wall: the rounded position is beside it, the exact one is not.
TEST(CellAreas, of_a_point_on_a_slanted_wall_are_not_zero_by_rounding) {
  Kinetic_delaunay_triangulation_2<> kinetic(
      std::vector<Linear_motion_2>{{{0, 0}, {3, 1}}, {{1, 5}, {0, 0}}});
  const Cell_limits limits = {Walkable_area::from_wkt("POLYGON((0 0, 9 3, 0 9, 0 0))")};
  for (int i = 1; i < 30; ++i) {
    kinetic.advance_to(Algebraic_number(Rational(i, 10)));
    EXPECT_GT(cell_areas(kinetic, limits)[0].area, 0) << i;
  }
}

TEST(CellAreas, do_not_lead_through_walls) {
  // A wall with a gap at its end: the cell of the point below goes around, if it is wide enough.
  const char* wall = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 2.5, 3 2.5, 3 1.5, 0 1.5, 0 0))";
  EXPECT_EQ(areas_in(wall, {{1, 1}}), std::vector<double>{13});
  EXPECT_EQ(areas_in(wall, {{1, 1}, {5, 1}}), (std::vector<double>{4.5, 0}));  // up to x = 3
  const std::vector<double> around = areas_in(wall, {{1, 1}, {6, 1}});         // up to x = 3.5
  EXPECT_EQ(around, (std::vector<double>{14 - 3, 0}));
}

TEST(CellAreas, of_coinciding_points_are_those_of_the_first) {
  Kinetic_delaunay_triangulation_2<> kinetic(std::vector<Linear_motion_2>{
      {{3, 2}, {1, 0}}, {{2, 1}, {0, 1}}, {{1, 2}, {1, 0}}, {{6, 2}, {0, 0}}});
  kinetic.advance_to(1.0);  // 1 and 2 meet at (2, 2), 0 is at (4, 2)
  const auto areas = cell_areas(kinetic, {Walkable_area::from_wkt(square)});
  EXPECT_EQ(areas[0].area, 4);
  EXPECT_EQ(areas[1].area, 12);
  EXPECT_EQ(areas[2].area, 0);
  EXPECT_TRUE(std::isnan(areas[2].density()));
  EXPECT_EQ(areas[1].density(), 1 / 12.0);
  EXPECT_EQ(areas[3].area, 0);  // outside
}

// At time 1 another point passes through two that coincide.
TEST(CellAreas, of_points_that_coincide_for_a_while_are_equal_shares) {
  EXPECT_EQ(areas_in(square, {{1, 2}, {3, 2}, {1, 2}}), (std::vector<double>{4, 8, 4}));
  EXPECT_EQ(areas_in(square, {{1, 2}, {1, 2}}), (std::vector<double>{8, 8}));
  std::vector<Linear_motion_2> motions = {
      {{1, 2}, {0, 0}}, {{3, 2}, {0, 0}}, {{1, 2}, {0, 0}}, {{1, 2}, {0, 8}, 1}};
  const auto areas_at_1 = [&] {
    Kinetic_delaunay_triangulation_2<> kinetic(motions);
    kinetic.advance_to(1.0);
    std::vector<double> result;
    for (const auto& cell : cell_areas(kinetic, {Walkable_area::from_wkt(square)})) {
      result.push_back(cell.area);
    }
    return result;
  };
  EXPECT_EQ(areas_at_1(), (std::vector<double>{4, 8, 4, 0}));
  std::rotate(motions.begin(), motions.end() - 1, motions.end());
  EXPECT_EQ(areas_at_1(), (std::vector<double>{8, 0, 8, 0}));
}

TEST(CellAreas, want_a_limit) {
  const Kinetic_delaunay_triangulation_2<> kinetic(std::vector<Linear_motion_2>{{{0, 0}, {0, 0}}});
  EXPECT_PRECONDITION_ERROR(cell_areas(kinetic, {}),
                            "cells of points on the convex hull are unbounded; expected a walkable "
                            "area, or a cutoff, or both");
  EXPECT_PRECONDITION_ERROR(cell_areas(kinetic, {Walkable_area::from_wkt(square), 0.0}),
                            "the cutoff is 0.000000; expected a distance between 1e-150 and 1e150");
}

}  // namespace
}  // namespace kinetri::cell_areas_test
