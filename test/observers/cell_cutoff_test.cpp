// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells within a circle: known numbers, and polygons inside and outside of the circle in exact
// arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "kinetri/observers/cell_areas.h"
#include "observers/polygon_and_disc.h"
#include "support/area_oracle.h"
#include "support/motions.h"
#include "support/query_oracle.h"

namespace kinetri::cell_cutoff_test {
namespace {

using std::numbers::pi;

std::vector<Cell_area> areas_of(const std::vector<Vector_2>& places, const Cell_limits& limits) {
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : places) motions.push_back({place, {0, 0}});
  return cell_areas(Kinetic_delaunay_triangulation_2<>(motions), limits);
}

void expect_area(const Cell_area& cell, double expected) {
  EXPECT_NEAR(cell.area, expected, cell.error);
  EXPECT_LT(cell.error, 1e-10);
}

Cell_limits limits(const char* text, double cutoff) {
  return {Walkable_area::from_wkt(text), cutoff};
}

constexpr const char* square = "POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))";

TEST(Cutoff, of_known_cells_leaves_known_areas) {
  expect_area(areas_of({{7, 9}}, {std::nullopt, 2})[0], 4 * pi);
  expect_area(areas_of({{2, 2}}, limits(square, 1))[0], pi);
  expect_area(areas_of({{0, 0}}, limits(square, 1.5))[0], 1.5 * 1.5 * pi / 4);
  expect_area(areas_of({{0, 2}}, limits(square, 1))[0], pi / 2);
  expect_area(areas_of({{2, 2}}, limits(square, 2))[0], 4 * pi);  // it touches four walls
  expect_area(areas_of({{2, 2}}, limits(square, 9))[0], 16);
  expect_area(areas_of({{2, 2}}, limits(square, std::sqrt(8)))[0], 16);
  EXPECT_EQ(areas_of({{5, 2}}, limits(square, 3))[0].area, 0);
  // Of two points at a distance of 1: the disc without the segment beyond the distance 1/2.
  const double segment = pi / 3 - std::sqrt(3) / 4;
  for (const Cell_area& cell : areas_of({{1.5, 2}, {2.5, 2}}, limits(square, 1))) {
    expect_area(cell, pi - segment);
  }
  // A wall at a third of the radius.
  const double d = 1.0 / 3;
  expect_area(areas_of({{d, 2}}, limits(square, 1))[0],
              pi - (std::acos(d) - d * std::sqrt(1 - d * d)));
}

// A wall between: beyond it, the cell goes on, but the circle does not lead around.
TEST(Cutoff, does_not_lead_around_walls) {
  const char* wall = "POLYGON((0 0, 20 0, 20 8, 0 8, 0 4.5, 7 4.5, 7 4, 0 4, 0 0))";
  expect_area(areas_of({{3, 3.5}}, limits(wall, 2))[0],
              4 * pi - (4 * std::acos(0.25) - 0.5 * std::sqrt(4 - 0.25)));
  // Near to the end of the wall it does: below the wall, beside it, and beyond it.
  const auto beyond = [](double h) { return 4 * std::acos(h / 2) - h * std::sqrt(4 - h * h); };
  const auto integral_of_half_chord = [](double y) {
    return (y * std::sqrt(4 - y * y) + 4 * std::asin(y / 2)) / 2;
  };
  const double beside = integral_of_half_chord(1) - integral_of_half_chord(0.5) - 0.5 * 0.5;
  expect_area(areas_of({{6.5, 3.5}}, limits(wall, 2))[0],
              (4 * pi - beyond(0.5)) + beside + beyond(1));
}

// ---- the disc formula ----

// For a polygon around the center, in polar coordinates, with more digits.
double area_in_polar_coordinates(const std::vector<Vector_2>& polygon, long double radius) {
  long double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const long double ax = polygon[i].x;
    const long double ay = polygon[i].y;
    const long double bx = polygon[(i + 1) % polygon.size()].x;
    const long double by = polygon[(i + 1) % polygon.size()].y;
    // The edge is at the distance h from the center in the direction of angle 0.
    const long double length = std::hypot(bx - ax, by - ay);
    const long double h = (ax * by - ay * bx) / length;
    const long double from = std::atan2((ax * (bx - ax) + ay * (by - ay)) / length, h);
    const long double to = std::atan2((bx * (bx - ax) + by * (by - ay)) / length, h);
    // Inside of the circle where the angle is at most `half`.
    const long double half = h < radius ? std::acos(h / radius) : 0;
    const long double begin = std::clamp(from, -half, half);
    const long double end = std::clamp(to, -half, half);
    sum += h * h * (std::tan(end) - std::tan(begin)) / 2;
    sum += radius * radius * ((to - from) - (end - begin)) / 2;
  }
  return static_cast<double>(sum);
}

TEST(Cutoff, of_random_polygons_is_that_in_polar_coordinates) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> distance(0.4, 1.6);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  for (int i = 0; i < 2000; ++i) {
    const int corners = 3 + i % 7;
    std::vector<Vector_2> polygon;
    for (int k = 0; k < corners; ++k) {
      const double angle = (k + jitter(random)) * 2 * pi / corners;
      const double r = distance(random);
      polygon.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    // Edges that touch the circle, or almost, too.
    const Vector_2& a = polygon[0];
    const Vector_2& b = polygon[1];
    const double touching = (a.x * b.y - a.y * b.x) / std::hypot(b.x - a.x, b.y - a.y);
    for (const double radius : {1.0, touching, touching * (1 + 1e-15), touching * (1 + 1e-9)}) {
      if (!(radius > 0.1)) continue;
      ASSERT_NEAR(detail::area_within_disc(polygon, radius),
                  area_in_polar_coordinates(polygon, radius), corners * 0x1p-48 * radius * radius);
    }
  }
}

// ---- cells with walls, neighbors and a circle ----

// Rational positions on the circle about (0, 0), counterclockwise.
std::vector<test::Static_point> positions_on_circle(int number, const Rational& radius) {
  std::vector<test::Static_point> result;
  for (int i = 0; i < number; ++i) {
    // The position of the angle 2 arctan(m), with m close to tan(angle / 2).
    const double angle = (2 * pi * (i + 0.5)) / number - pi;
    const Rational m = to_rational(std::tan(angle / 2));
    result.emplace_back(radius * (1 - m * m) / (1 + m * m), radius * 2 * m / (1 + m * m));
  }
  return result;
}

// A convex room, so that each cell has one part: the polygon in the circle, cut by the walls and
// the neighbors, is smaller, and by at most what is between it and the circle.
TEST(Cutoff, of_random_cells_is_between_polygons) {
  constexpr int number = 48;
  const double between = pi - number * std::sin(2 * pi / number) / 2;
  const std::vector<Vector_2> walls = {{0, 0}, {5, -1}, {6, 4}, {1, 5}};
  for (unsigned seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    const Kinetic_delaunay_triangulation_2<> kinetic(test::random_motions(10, 4, 0, seed));
    const test::Query_oracle oracle(kinetic, 0);
    for (const double cutoff : {0.3, 1.0, 2.5}) {
      const auto areas = cell_areas(kinetic, {Walkable_area(walls), cutoff});
      for (const auto& [id, area, error] : areas) {
        const test::Static_point p = oracle.place(id);
        std::vector<test::Static_point> part;
        for (const auto& v : positions_on_circle(number, to_rational(cutoff))) {
          part.push_back(p + (v - test::Static_point(0, 0)));
        }
        for (const auto& [other, q] : oracle.places()) {
          if (other != id) part = test::nearer_part(part, {p, 0}, {q, 0});
        }
        bool is_inside = true;
        for (std::size_t i = 0; i < walls.size(); ++i) {
          const auto a = test::static_point(walls[i]);
          const auto b = test::static_point(walls[(i + 1) % walls.size()]);
          is_inside = is_inside && CGAL::orientation(a, b, p) != CGAL::RIGHT_TURN;
          // The wall is the bisector of its mirror images.
          const auto n = (b - a).perpendicular(CGAL::COUNTERCLOCKWISE);
          part = test::nearer_part(part, {a + n, 0}, {a - n, 0});
        }
        const double least = is_inside ? to_double(test::exact_area(part)) : 0;
        ASSERT_GE(area, least - error) << id;
        ASSERT_LE(area, is_inside ? least + error + 1.01 * between * cutoff * cutoff : 0) << id;
      }
    }
  }
}

}  // namespace
}  // namespace kinetri::cell_cutoff_test
