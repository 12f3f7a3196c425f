// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values between moving points. What is exact is compared with a search of all triangles in
// rational arithmetic; what is rounded, with rational values and the bound that the header gives.
#include "kinetri/triangulation/field_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::field_2_test {
namespace {

using Triangulation = Kinetic_delaunay_triangulation_2<>;
using Field = Kinetic_field_2<>;

constexpr std::array interpolations = {Interpolation::flat, Interpolation::linear,
                                       Interpolation::smooth};

test::Static_point static_point(const Vector_2& place) {
  return {to_rational(place.x), to_rational(place.y)};
}

// The values of the function a + b x + c y on moving points, which are linear in time.
Linear_value function_on(const Linear_motion_2& m) {
  return {0.5 + 2 * m.position.x - 3 * m.position.y, 2 * m.velocity.x - 3 * m.velocity.y, m.epoch};
}
double function_at(const Vector_2& p) {
  return 0.5 + 2 * p.x - 3 * p.y;
}

Field random_field(const Triangulation& kdt, std::size_t channels, unsigned seed) {
  Field field(kdt, channels);
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> number(-8, 8);
  std::vector<Linear_value> values(channels);
  for (Point_id id = 0; id < kdt.next_id(); ++id) {
    for (Linear_value& v : values) {
      v.value = number(random);
      v.slope = number(random);
      v.epoch = number(random);
    }
    field.set_values(id, values);
  }
  return field;
}

Rational value_at(const Linear_value& v, const Rational& t) {
  return to_rational(v.value) + to_rational(v.slope) * (t - to_rational(v.epoch));
}

// The corners of the triangle of a position, in ascending order of ids, by looking at all.
std::optional<std::array<Point_id, 3>> triangle_by_search(const Triangulation& kdt,
                                                          const test::Static_point& q,
                                                          const Rational& t) {
  std::optional<std::array<Point_id, 3>> least;
  if (kdt.triangulation().dimension() < 2) return least;
  for (const auto face : kdt.triangulation().finite_face_handles()) {
    std::array<Point_id, 3> ids{};
    std::array<test::Static_point, 3> p;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      ids[k] = face->vertex(i)->point().id();
      p[k] = test::place_at(kdt.motion(ids[k]), t);
    }
    if (CGAL::orientation(p[0], p[1], p[2]) != CGAL::LEFT_TURN) continue;
    if (CGAL::orientation(p[0], p[1], q) == CGAL::RIGHT_TURN ||
        CGAL::orientation(p[1], p[2], q) == CGAL::RIGHT_TURN ||
        CGAL::orientation(p[2], p[0], q) == CGAL::RIGHT_TURN) {
      continue;
    }
    std::ranges::sort(ids);
    if (!least || ids < *least) least = ids;
  }
  return least;
}

// The linear value, exactly, and the bound of the header for its rounding.
struct Exact_value {
  Rational value;
  double bound;
};
Exact_value linear_by_cramer(const Field& field, const Triangulation& kdt,
                             const std::array<Point_id, 3>& ids, const test::Static_point& q,
                             const Rational& t) {
  std::array<test::Static_point, 3> p;
  std::array<double, 3> values{};
  Rational sum = 0;
  double largest_coordinate = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = test::place_at(kdt.motion(ids[i]), t);
    largest_coordinate = std::max(
        {largest_coordinate, std::abs(to_double(p[i].x())), std::abs(to_double(p[i].y()))});
  }
  const auto twice_area = [](const auto& a, const auto& b, const auto& c) {
    return Rational((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
  };
  const Rational area = twice_area(p[0], p[1], p[2]);
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational value = value_at(field.values(ids[i])[0], t);
    values[i] = to_double(value);
    const auto& a = p[(i + 1) % 3];
    const auto& b = p[(i + 2) % 3];
    sum += twice_area(a, b, q) / area * value;
    longest = std::max(longest, std::sqrt(to_double(CGAL::squared_distance(a, b))));
  }
  const double height = std::abs(to_double(area)) / longest;
  const auto [least, greatest] = std::minmax({values[0], values[1], values[2]});
  const double size = std::max(std::abs(least), std::abs(greatest));
  return {sum, 0x1p-46 * (size + (greatest - least) * largest_coordinate / height)};
}

// A position for a query: now and then at a point or on the middle between two.
Vector_2 some_place(std::mt19937_64& random, int size) {
  std::uniform_int_distribution<int> number(-4, 4 * size + 4);
  const double x = number(random);
  const double y = number(random);
  return {x / 4, y / 4};
}

TEST(Kinetic_field_2, values_in_triangles_agree_with_a_search_of_all_of_them_in_exact_arithmetic) {
  std::size_t inside = 0;
  std::size_t outside = 0;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    const int size = 6;
    Triangulation kdt(test::grid_motions(14, size, 2, seed));
    const Field field = random_field(kdt, 2, seed);
    std::mt19937_64 random(seed);
    // At integers points coincide, triangles are flat and positions are on edges.
    for (const Rational& t : {Rational(0), Rational(1), Rational(3, 2), Rational(2)}) {
      kdt.advance_to(t);
      for (int i = 0; i < 40; ++i) {
        const Vector_2 place = some_place(random, size);
        const auto ids = triangle_by_search(kdt, static_point(place), t);
        for (const Interpolation interpolation : interpolations) {
          EXPECT_EQ(field.at(place, interpolation).has_value(), ids.has_value())
              << "seed " << seed << " t " << t << " at " << place.x << ", " << place.y;
        }
        ++(ids ? inside : outside);
        if (!ids) continue;
        const Exact_value exact = linear_by_cramer(field, kdt, *ids, static_point(place), t);
        const double linear = (*field.at(place, Interpolation::linear))[0];
        EXPECT_LE(std::abs(to_double(to_rational(linear) - exact.value)), exact.bound)
            << "seed " << seed << " t " << t << " at " << place.x << ", " << place.y;
        Rational mean = 0;
        for (const Point_id id : *ids) mean += value_at(field.values(id)[1], t) / 3;
        EXPECT_NEAR((*field.at(place, Interpolation::flat))[1], to_double(mean), 1e-13);
      }
    }
  }
  EXPECT_GT(inside, 300u);
  EXPECT_GT(outside, 300u);
}

TEST(Kinetic_field_2, a_raster_has_the_bits_of_single_positions) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Triangulation kdt(test::grid_motions(20, 8, 2, seed));
    const Field field = random_field(kdt, 2, seed);
    // Rows from above to below, and columns that are no sums of powers of two.
    for (const Grid_2& grid :
         {Grid_2{{-1, 9}, {0.5, -0.5}, 21, 23}, Grid_2{{0, 0}, {0.1, 1}, 80, 9}}) {
      for (const Rational& t : {Rational(1), Rational(7, 5)}) {
        if (t < kdt.current_time()) continue;
        kdt.advance_to(t);
        for (const Interpolation interpolation : interpolations) {
          std::vector<double> raster(grid.columns * grid.rows * 2);
          field.raster(grid, interpolation, raster);
          for (std::size_t row = 0; row < grid.rows; ++row) {
            for (std::size_t column = 0; column < grid.columns; ++column) {
              const double* found = &raster[2 * (row * grid.columns + column)];
              const auto expected = field.at(grid.place(column, row), interpolation);
              if (expected) {
                ASSERT_EQ((*expected)[0], found[0]) << "seed " << seed << " t " << t;
                ASSERT_EQ((*expected)[1], found[1]) << "seed " << seed << " t " << t;
              } else {
                ASSERT_TRUE(std::isnan(found[0]) && std::isnan(found[1]));
              }
            }
          }
        }
      }
    }
  }
}

TEST(Kinetic_field_2, corner_weights_make_the_linear_raster) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Triangulation kdt(test::grid_motions(30, 8, 2, seed));
    const Field field = random_field(kdt, 1, seed);
    kdt.advance_to(0.75);
    // Many positions are on edges and at points, or outside of the hull.
    const Grid_2 grid = {{-1, 9}, {0.5, -0.25}, 21, 41};
    std::vector<Corner_weights> weights(grid.columns * grid.rows);
    std::vector<double> raster(weights.size());
    find_corner_weights(kdt, grid, weights);
    field.raster(grid, Interpolation::linear, raster);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      ASSERT_EQ(weights[i].corners[0] == no_point, std::isnan(raster[i]));
      if (std::isnan(raster[i])) continue;
      ++inside;
      EXPECT_EQ(std::ranges::min(weights[i].corners), weights[i].corners[0]);
      double value = 0;
      double size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Linear_value& v = field.values(weights[i].corners[k])[0];
        value += weights[i].weights[k] * (v.value + v.slope * (0.75 - v.epoch));
        size = std::max(size, std::abs(v.value + v.slope * (0.75 - v.epoch)));
      }
      EXPECT_NEAR(value, raster[i], 1e-12 * size);
    }
    EXPECT_GT(inside, 100U);
  }
}

TEST(Kinetic_field_2, linear_functions_on_moving_points_are_reproduced) {
  const std::vector<Linear_motion_2> motions = test::random_motions(60, 10, 1, 5);
  Triangulation kdt(motions);
  Field field(kdt, 1);
  for (Point_id id = 0; id < motions.size(); ++id) {
    field.set_values(id, std::array{function_on(motions[id])});
  }
  const Grid_2 grid = {{0.05, 0.05}, {0.25, 0.25}, 40, 40};
  std::vector<double> raster(grid.columns * grid.rows);
  for (const double t : {0.0, 0.7, 2.0, 5.5}) {
    kdt.advance_to(t);
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
      field.raster(grid, interpolation, raster);
      std::size_t found = 0;
      for (std::size_t i = 0; i < raster.size(); ++i) {
        if (std::isnan(raster[i])) continue;
        ++found;
        const Vector_2 place = grid.place(i % grid.columns, i / grid.columns);
        EXPECT_NEAR(raster[i], function_at(place), 1e-9) << "t " << t;
      }
      EXPECT_GT(found, 1200u);
    }
  }
}

// Of the position as a further point: the exact lengths of the sides of its cell, each divided by
// the distance of the neighbor across it.
double laplace_by_voronoi_cell(const Field& field, const std::vector<Linear_motion_2>& motions,
                               const Vector_2& place, const Rational& t) {
  std::vector<Linear_motion_2> more = motions;
  more.push_back({place, {0, 0}, 0});
  const Triangulation kdt(more, t);
  const auto last = static_cast<Point_id>(motions.size());
  const auto cell = Kinetic_queries_2(kdt, t).voronoi_cell(last);
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < cell.neighbors.size(); ++i) {
    const Exact_position_2& to = cell.vertices[i];
    const Exact_position_2& from = cell.vertices[i > 0 ? i - 1 : cell.vertices.size() - 1];
    const test::Static_point p = test::place_at(motions[cell.neighbors[i]], t);
    const Rational side = (to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y);
    const double weight =
        std::sqrt(to_double(side / CGAL::squared_distance(p, static_point(place))));
    sum += weight * to_double(value_at(field.values(cell.neighbors[i])[0], t));
    weights += weight;
  }
  return sum / weights;
}

TEST(Kinetic_field_2, smooth_values_are_those_of_the_cell_that_the_position_would_have) {
  std::size_t compared = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    // Cocircular neighbors on a lattice, and points in general position.
    const std::vector<Linear_motion_2> motions =
        seed % 2 == 0 ? test::grid_motions(16, 6, 1, seed) : test::random_motions(16, 6, 1, seed);
    Triangulation kdt(motions);
    const Field field = random_field(kdt, 1, seed);
    for (const Rational& t : {Rational(1, 3), Rational(7, 4)}) {
      kdt.advance_to(t);
      for (double x = 0.375; x < 6; x += 0.75) {
        for (double y = 0.25; y < 6; y += 0.75) {
          const Kinetic_queries_2 queries(kdt);
          if (queries.locate({x, y}).kind != Location_2::Kind::face) continue;
          EXPECT_NEAR((*field.at({x, y}, Interpolation::smooth))[0],
                      laplace_by_voronoi_cell(field, motions, {x, y}, t), 1e-9)
              << "seed " << seed << " t " << t << " at " << x << ", " << y;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 100u);
}

// Three corners of a square rest; a point falls through the fourth one at t = 1.
std::vector<Linear_motion_2> falling_point() {
  return {{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{2, 2}, {0, 0}}, {{0, 3}, {0, -1}}};
}

TEST(Kinetic_field_2, a_flip_changes_linear_values_and_no_smooth_ones) {
  Triangulation kdt(falling_point());
  Field field(kdt, 1);
  for (Point_id id = 0; id < 4; ++id) {
    field.set_values(id, std::array{Linear_value{id % 2 == 0 ? 0.0 : 10.0}});
  }
  const double moment = 0x1p-30;
  const Vector_2 center = {1, 1};
  const std::array<Vector_2, 3> places = {center, Vector_2{0.5, 1}, Vector_2{1.25, 1.5}};
  std::vector<double> before;
  kdt.advance_to(1 - moment);
  for (const Vector_2& p : places) before.push_back((*field.at(p, Interpolation::smooth))[0]);
  // On the diagonal 0 - 2, whose ends have the value 0; afterwards on 1 - 3.
  EXPECT_NEAR((*field.at(center, Interpolation::linear))[0], 0, 1e-6);
  ASSERT_EQ(kdt.advance_to(1), 1u);
  std::vector<double> at;
  for (const Vector_2& p : places) at.push_back((*field.at(p, Interpolation::smooth))[0]);
  EXPECT_EQ((*field.at(center, Interpolation::linear))[0], 10);
  kdt.advance_to(1 + moment);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(before[i], at[i], 1e-7);
    EXPECT_NEAR((*field.at(places[i], Interpolation::smooth))[0], at[i], 1e-7);
  }
  EXPECT_EQ(at[0], 5);  // by symmetry
}

TEST(Kinetic_field_2, at_a_point_its_value_and_on_the_hull_that_of_the_edge) {
  Triangulation kdt(falling_point());
  Field field(kdt, 2);
  for (Point_id id = 0; id < 4; ++id) {
    field.set_values(id, std::array{Linear_value{0.1 * id, 0.3, 0.25}, Linear_value{-1.0 * id}});
  }
  kdt.advance_to(0.5);
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
    for (Point_id id = 0; id < 4; ++id) {
      const auto values = field.at(rounded_place(kdt.motion(id), 0.5), interpolation);
      ASSERT_TRUE(values);
      EXPECT_EQ((*values)[0], 0.1 * id + 0.3 * 0.25);
      EXPECT_EQ((*values)[1], -1.0 * id);
    }
    EXPECT_EQ((*field.at({0.5, 0}, interpolation))[1], -0.25);
    EXPECT_EQ((*field.at({2, 0.5}, interpolation))[1], -1.25);
    // Just beside the hull the values tend to those on it.
    EXPECT_NEAR((*field.at({0.5, 0x1p-40}, interpolation))[1], -0.25, 1e-9);
    EXPECT_NEAR((*field.at({0.5, 0x1p-1070}, interpolation))[1], -0.25, 1e-9);
    EXPECT_FALSE(field.at({0.5, -0x1p-1070}, interpolation));
    EXPECT_FALSE(field.at({2.5, 1}, interpolation));
  }
}

TEST(Kinetic_field_2, equal_values_are_reproduced_exactly) {
  const std::vector<Linear_motion_2> motions = test::random_motions(40, 1, 1, 8);
  Triangulation kdt(motions);
  Field field(kdt, 1);
  for (Point_id id = 0; id < motions.size(); ++id) {
    field.set_values(id, std::array{Linear_value{0.1}});
  }
  const Grid_2 grid = {{0, 0}, {0.03, 0.03}, 33, 33};
  std::vector<double> raster(grid.columns * grid.rows);
  for (const Interpolation interpolation : interpolations) {
    field.raster(grid, interpolation, raster);
    for (const double value : raster) EXPECT_TRUE(std::isnan(value) || value == 0.1);
    EXPECT_GT(std::ranges::count(raster, 0.1), 800);
  }
}

TEST(Kinetic_field_2,
     tiny_huge_and_nearly_flat_triangles_have_values_between_those_of_the_corners) {
  for (const double size : {0x1p-1000, 1.0, 0x1p990}) {
    for (const double height : {1.0, 0x1p-60}) {
      const std::vector<Linear_motion_2> motions = {
          {{0, 0}, {0, 0}}, {{size, 0}, {0, 0}}, {{size / 2, size * height}, {0, 0}}};
      const Triangulation kdt(motions);
      Field field(kdt, 1);
      for (Point_id id = 0; id < 3; ++id) {
        field.set_values(id, std::array{Linear_value{1.0 + id}});
      }
      const Vector_2 place = {size / 4, size * height / 4};
      for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
        EXPECT_NEAR((*field.at(place, interpolation))[0], 1.625, 1e-9) << size << ' ' << height;
      }
    }
  }
}

TEST(Kinetic_field_2, points_on_one_line_have_no_values_between_them) {
  // On one line at t = 1 only.
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{1, 1}, {0, -1}}};
  Triangulation kdt(motions);
  Field field(kdt, 1);
  for (Point_id id = 0; id < 3; ++id) field.set_values(id, std::array{Linear_value{1.0}});
  EXPECT_TRUE(field.at({1, 0.5}, Interpolation::smooth));
  kdt.advance_to(1);
  for (const Interpolation interpolation : interpolations) {
    EXPECT_FALSE(field.at({1, 0}, interpolation));
    std::vector<double> raster(2);
    field.raster({{0, 0}, {1, 1}, 2, 1}, interpolation, raster);
    EXPECT_TRUE(std::isnan(raster[0]) && std::isnan(raster[1]));
  }
  kdt.advance_to(1.5);
  EXPECT_TRUE(field.at({1, -0.25}, Interpolation::linear));

  const std::vector<Linear_motion_2> line = {{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}};
  const Triangulation two(line);
  EXPECT_FALSE(Field(two, 1).at({1, 0}, Interpolation::linear));
  const Triangulation none(std::vector<Linear_motion_2>{});
  EXPECT_FALSE(Field(none, 1).at({1, 0}, Interpolation::linear));
}

TEST(Kinetic_field_2, points_may_come_go_turn_and_accelerate) {
  using Accelerated = Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2>;
  std::vector<Polynomial_motion_2> motions(4);
  motions[0].position = {-1, -1};
  motions[1].position = {3, -1};
  motions[2].position = {3, 3};
  motions[3].position = {-1, 3};
  Accelerated kdt(motions);
  Kinetic_field_2<Polynomial_kinetic_traits_2> field(kdt, 1);
  for (Point_id id = 0; id < 4; ++id) field.set_values(id, std::array{Linear_value{0}});
  Polynomial_motion_2 falling;
  falling.position = {1, 2};
  falling.acceleration = {0, -2};
  const Point_id id = kdt.insert(falling);
  EXPECT_PRECONDITION_ERROR(field.at({1, 1.5}, Interpolation::flat), "point 4 has no values");
  EXPECT_TRUE(field.values(id).empty());
  field.set_values(id, std::array{Linear_value{0, 5}});
  kdt.advance_to(1);
  EXPECT_EQ((*field.at({1, 1}, Interpolation::linear))[0], 5);
  EXPECT_EQ((*field.at({1, 2}, Interpolation::linear))[0], 2.5);
  kdt.erase(id);
  EXPECT_EQ((*field.at({1, 1}, Interpolation::linear))[0], 0);
}

TEST(Kinetic_field_2, points_that_coincide_for_a_while_have_the_mean_of_their_values) {
  Triangulation kdt(std::vector<Linear_motion_2>{{{1, 1}, {0, 0}},
                                                 {{-1, -1}, {0, 0}},
                                                 {{3, -1}, {0, 0}},
                                                 {{3, 3}, {0, 0}},
                                                 {{-1, 3}, {0, 0}}});
  Field field(kdt, 1);
  for (Point_id id = 0; id < 5; ++id) field.set_values(id, std::array{Linear_value{0}});
  field.set_values(0, std::array{Linear_value{4}});
  const Point_id other = kdt.insert({{1, 1}, {0, 0}});
  EXPECT_PRECONDITION_ERROR(field.at({1, 1}, Interpolation::flat), "point 5 has no values");
  field.set_values(other, std::array{Linear_value{8, 2}});
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
    EXPECT_EQ((*field.at({1, 1}, interpolation))[0], 6);
  }
  EXPECT_EQ((*field.at({1, 0}, Interpolation::linear))[0], 3);
  EXPECT_NEAR((*field.at({1, 0}, Interpolation::flat))[0], 2, 1e-15);
  EXPECT_EQ(field.values(other)[0].value, 8);
  kdt.advance_to(1.0);
  EXPECT_EQ((*field.at({1, 1}, Interpolation::linear))[0], 7);
  kdt.set_motion(0, {{1, 1}, {1, 0}, 1});  // the other one has the vertex then
  EXPECT_NEAR((*field.at({1, 2}, Interpolation::flat))[0], 10 / 3.0, 1e-14);
}

// A field on one point for each position that points share, which has the mean of their values.
TEST(Kinetic_field_2, coincident_points_are_like_one_point_with_the_mean) {
  const Grid_2 grid = {{-0.5, 2.75}, {0.125, -0.25}, 25, 14};
  std::size_t coincident = 0;
  std::size_t inside = 0;
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    Triangulation kdt(test::coincident_motions(4 + seed % 9, seed));
    const Field field = random_field(kdt, 1, seed);
    for (const Rational& t : {Rational(0), Rational(1, 4), Rational(1)}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " t " << t);
      kdt.advance_to(t);
      const test::Query_oracle oracle(kdt, t);
      std::vector<Linear_motion_2> motions;
      std::vector<Point_id> shown;
      std::vector<double> means;
      for (const auto& [id, place] : oracle.places()) {
        const std::vector<Point_id>& group = oracle.group(id);
        if (id != group.front()) continue;
        coincident += group.size() - 1;
        shown.push_back(id);
        motions.push_back(kdt.motion(id));
        Rational sum = 0;
        for (const Point_id other : group) sum += value_at(field.values(other)[0], t);
        means.push_back(to_double(Rational(sum / static_cast<int>(group.size()))));
      }
      const Triangulation of_shown(motions, Algebraic_number(t));
      Field field_of_shown(of_shown, 1);
      for (Point_id k = 0; k < means.size(); ++k) {
        field_of_shown.set_values(k, std::array{Linear_value{means[k]}});
      }
      std::vector<double> found(grid.columns * grid.rows);
      std::vector<double> expected(found.size());
      for (const Interpolation interpolation : interpolations) {
        field.raster(grid, interpolation, found);
        field_of_shown.raster(grid, interpolation, expected);
        for (std::size_t i = 0; i < found.size(); ++i) {
          ASSERT_EQ(std::isnan(found[i]), std::isnan(expected[i]));
          const auto value =
              field.at(grid.place(i % grid.columns, i / grid.columns), interpolation);
          ASSERT_EQ(value.has_value(), !std::isnan(found[i]));
          if (!value) continue;
          ++inside;
          ASSERT_EQ((*value)[0], found[i]);
          ASSERT_NEAR(found[i], expected[i], 1e-12);
        }
      }
      std::vector<Corner_weights> weights(found.size());
      std::vector<Corner_weights> weights_of_shown(found.size());
      find_corner_weights(kdt, grid, weights);
      find_corner_weights(of_shown, grid, weights_of_shown);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        ASSERT_EQ(weights[i].weights, weights_of_shown[i].weights);
        for (std::size_t k = 0; k < 3; ++k) {
          const Point_id corner = weights_of_shown[i].corners[k];
          ASSERT_EQ(weights[i].corners[k], corner == no_point ? no_point : shown[corner]);
        }
      }
    }
  }
  EXPECT_GT(coincident, 40u);
  EXPECT_GT(inside, 1000u);
}

TEST(Kinetic_field_2, wrong_use_is_refused) {
  const Triangulation kdt(falling_point());
  EXPECT_PRECONDITION_ERROR(Field(kdt, 0), "a field needs at least one channel");
  Field field(kdt, 2);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(field.set_values(4, std::vector<Linear_value>(2)),
                            "there is no point 4");
  EXPECT_PRECONDITION_ERROR(field.set_values(0, std::vector<Linear_value>(1)),
                            "point 0 is given 1 values; the field has 2 channels");
  EXPECT_PRECONDITION_ERROR(field.set_values(0, std::array{Linear_value{infinity}, Linear_value{}}),
                            "a value of point 0 is not finite");
  EXPECT_TRUE(field.values(0).empty());
  EXPECT_PRECONDITION_ERROR(field.at({1, 1}, Interpolation::flat), "point 0 has no values");
  for (Point_id id = 0; id < 4; ++id) field.set_values(id, std::vector<Linear_value>(2));
  EXPECT_PRECONDITION_ERROR(field.at({infinity, 1}, Interpolation::flat),
                            "a position has a coordinate that is not finite or beyond 1e300");
  EXPECT_PRECONDITION_ERROR(field.at({1, 2e300}, Interpolation::flat),
                            "a position has a coordinate that is not finite or beyond 1e300");
  std::vector<double> result(8);
  const auto raster = [&](const Grid_2& grid) {
    field.raster(grid, Interpolation::linear, result);
  };
  EXPECT_PRECONDITION_ERROR(raster({{0, 0}, {0, 1}, 2, 2}),
                            "a step of a grid is zero or not finite");
  EXPECT_PRECONDITION_ERROR(raster({{0, 0}, {1, infinity}, 2, 2}),
                            "a step of a grid is zero or not finite");
  EXPECT_PRECONDITION_ERROR(
      raster({{0, 0}, {1, 1}, 2, 3}),
      "the result has 8 elements; a grid of 2 x 3 positions with 2 channels needs 12");
  EXPECT_PRECONDITION_ERROR(raster({{0, 0}, {1e300, 1}, 4, 1}),
                            "a position has a coordinate that is not finite or beyond 1e300");
  EXPECT_PRECONDITION_ERROR(raster({{0, 0}, {1, 1}, std::size_t{1} << 62, 4}),
                            "a grid has too many positions");
  EXPECT_NO_THROW(raster({{0, 0}, {1, 1}, 2, 2}));
}

// The bits are a promise. A change of this number is a change for users.
TEST(Kinetic_field_2, a_raster_has_the_same_bits_on_every_machine) {
  // No distributions of the standard library: these differ.
  std::mt19937_64 random(3);
  const auto number = [&] { return static_cast<double>(random() % 1024); };
  std::vector<Linear_motion_2> motions(50);
  for (Linear_motion_2& m : motions) {
    const double x = number();
    const double y = number();
    const double vx = number();
    const double vy = number();
    m = {{x / 128, y / 128}, {vx / 512 - 1, vy / 512 - 1}, 0};
  }
  Triangulation kdt(motions);
  Field field(kdt, 1);
  for (Point_id id = 0; id < motions.size(); ++id) {
    const double value = number();
    field.set_values(id, std::array{Linear_value{value, number(), 0.1}});
  }
  kdt.advance_to(Rational(5, 3));
  const Grid_2 grid = {{0.3, 0.3}, {0.21, 0.21}, 36, 36};
  std::vector<double> raster(grid.columns * grid.rows);
  std::uint64_t hash = 14695981039346656037u;
  for (const Interpolation interpolation : interpolations) {
    field.raster(grid, interpolation, raster);
    for (const double value : raster) {
      if (std::isnan(value)) continue;
      hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    }
  }
  EXPECT_EQ(hash, 6138185579823881850u);
}

}  // namespace
}  // namespace kinetri::field_2_test
