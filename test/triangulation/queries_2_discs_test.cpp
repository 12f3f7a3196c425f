// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries about discs and other points with weights, hidden ones included, against oracles that
// look at all of them at their exact places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "support/area_oracle.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"

namespace kinetri::queries_2_discs_test {
namespace {

using test::expect_areas;
using test::expect_right_answers;
using test::Query_oracle;
using test::Region;
using test::Static_point;
using test::static_point;

using Kinetic = Kinetic_regular_triangulation_2<>;
using Queries = Kinetic_queries_2<Disc_kinetic_traits_2>;
using Discs = std::vector<Disc_motion_2>;
using Exact_cell = Voronoi_cell_2<Exact_position_2>;

template <class Q>
concept Knows_nearest_neighbors = requires(const Q& queries) {
  queries.nearest_neighbors();
};
template <class Q>
concept Knows_nearest_neighbor = requires(const Q& queries) {
  queries.nearest_neighbor(Point_id{0});
};
template <class Q>
concept Knows_closest_pair = requires(const Q& queries) {
  queries.closest_pair();
};
static_assert(Knows_closest_pair<Kinetic_queries_2<>> && !Knows_closest_pair<Queries>);
static_assert(Knows_nearest_neighbor<Kinetic_queries_2<>> && !Knows_nearest_neighbor<Queries>);
static_assert(Knows_nearest_neighbors<Kinetic_queries_2<>> && !Knows_nearest_neighbors<Queries>);

Disc_motion_2 disc(double x, double y, double vx, double vy, double radius, double growth = 0,
                   double weight = 0) {
  return {{{x, y}, {vx, vy}, 0}, radius, growth, weight};
}

Disc_motion_2 resting(double x, double y, double radius, double weight = 0) {
  return disc(x, y, 0, 0, radius, 0, weight);
}

std::string text(const Discs& discs) {
  std::ostringstream out;
  out.precision(17);
  for (const Disc_motion_2& d : discs) {
    out << "disc(" << d.position.x << ", " << d.position.y << ", " << d.velocity.x << ", "
        << d.velocity.y << ", " << d.radius << ", " << d.growth << ", " << d.weight << "),\n";
  }
  return out.str();
}

// What random discs are made of; numbers are multiples of `step`, if that is not zero.
struct Range {
  double step = 0;
  double side = 10;
  double speed = 1;
  double radius = 0;
  double growth = 0;
  double weight = 0;
};

Discs random_discs(std::mt19937_64& random, std::size_t points, const Range& range) {
  const auto number = [&](double from, double to) {
    const double x = from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
    return range.step == 0 ? x : std::round(x / range.step) * range.step;
  };
  const auto& [step, side, speed, radius, growth, weight] = range;
  Discs discs;
  while (discs.size() < points) {
    const double x = number(0, side);
    const double y = number(0, side);
    const double vx = number(-speed, speed);
    const double vy = number(-speed, speed);
    const double r = number(0, radius);
    const double g = number(-growth, growth);
    const Disc_motion_2 d = disc(x, y, vx, vy, r, g, number(-weight, weight));
    const auto is_alike = [&](const Disc_motion_2& other) { return same_trajectory(d, other); };
    if (std::ranges::none_of(discs, is_alike)) discs.push_back(d);
  }
  return discs;
}

// How many cells of each shape have been looked at.
struct Shapes {
  int empty = 0;
  int position = 0;
  int segment = 0;
  int ray = 0;
  int line = 0;

  void count(const Exact_cell& cell, const Query_oracle& oracle, Point_id id) {
    if (cell.is_empty) ++empty;
    if (cell.neighbors.empty() && cell.vertices.size() == 1) ++position;
    if (cell.neighbors.size() != 2) return;
    // Two sides of the same length, one of them before the other.
    const auto sides = oracle.cell(id).sides;
    const auto& first = sides.begin()->second;
    const auto& second = std::next(sides.begin())->second;
    if (!cell.rays) ++segment;
    if (cell.rays && cell.vertices.size() == 1 && first.source == second.target &&
        first.target == second.source) {
      ++ray;
    }
    const Static_point& p = oracle.place(cell.neighbors[0]);
    const Static_point& q = oracle.place(cell.neighbors[1]);
    const Static_point& here = oracle.place(id);
    const auto d = q - p;
    if (cell.rays && cell.vertices.empty() &&
        oracle.power(here, id) - oracle.power(here, cell.neighbors[0]) ==
            (here - p) * d / (d * d) *
                (oracle.power(here, cell.neighbors[1]) - oracle.power(here, cell.neighbors[0]))) {
      ++line;
    }
  }
};

const Region box = {{{-1, -2}, {11, -2}, {11, 9}, {-1, 9}},
                    {{{-1, -2}, {11, -2}, {11, 9}, {-1, 9}}}};
const Region corner = {{{0.25, 0.5}, {2, 0.5}, {2, 3}, {0.25, 3}},
                       {{{0.25, 0.5}, {2, 0.5}, {2, 3}, {0.25, 3}}}};

template <class Triangulation>
void ask_all(const Triangulation& kinetic, const Algebraic_number& time, const Rational& t,
             std::mt19937_64& random, Shapes& shapes) {
  SCOPED_TRACE(testing::Message() << "at the time " << t);
  ASSERT_NO_FATAL_FAILURE(expect_right_answers(kinetic, time, t, random));
  const Query_oracle oracle(kinetic, t);
  const Kinetic_queries_2 queries(kinetic, Algebraic_number(t));
  for (const auto& [id, place] : oracle.places()) {
    shapes.count(queries.voronoi_cell(id), oracle, id);
    if (kinetic.is_hidden(id)) {
      ASSERT_TRUE(queries.neighbors(id).empty());
    }
  }
  for (const Region& region : {box, corner}) {
    const auto areas = Kinetic_queries_2(kinetic, time).rounded_voronoi_areas(region.polygon);
    ASSERT_EQ(areas.size(), kinetic.next_id());
    ASSERT_NO_FATAL_FAILURE(expect_areas(areas, oracle, region, 60));
  }
}

// test::ask_along with the oracles.
template <class Triangulation>
int ask_along(Triangulation& kinetic, int instants, unsigned seed, Shapes& shapes) {
  std::mt19937_64 random(seed);
  return test::ask_along(kinetic, instants, [&](const Algebraic_number& time) {
    const auto t = test::rational_value(time);
    if (!t || *t > 30 || testing::Test::HasFatalFailure()) return false;
    ask_all(kinetic, time, *t, random, shapes);
    return true;
  });
}

int ask_discs(const Discs& discs, int instants, unsigned seed, Shapes& shapes) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << text(discs));
  Kinetic kinetic(discs);
  return ask_along(kinetic, instants, seed, shapes);
}

// ---- against oracles ----

TEST(Queries_of_discs, on_lattices_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  int events = 0;
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    std::mt19937_64 random(seed);
    const Range range = {.step = 1,
                         .side = 1.0 + seed % 4,
                         .radius = 2,
                         .growth = seed % 3 == 0 ? 1.0 : 0.0,
                         .weight = seed % 2 == 0 ? 3.0 : 0.0};
    events += ask_discs(random_discs(random, 1 + seed % 9, range), 3, seed, shapes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(events, 10);
  EXPECT_GT(shapes.empty, 40);
}

// The lifted points are on a few planes, but for some that are above or below: so that many cells
// are segments or single positions, and rays or lines where all points are on a line.
TEST(Queries_of_discs, whose_cells_have_no_area_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(40u); ++seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](unsigned limit) { return static_cast<double>(random() % limit); };
    const double cx = below(4);
    const double cy = below(4);
    const bool is_line = seed % 4 == 0;
    Discs discs;
    for (unsigned i = 0; i < 4 + seed % 8; ++i) {
      const double x = below(4);
      const double y = is_line ? x : below(4);
      const double bump = random() % 6 == 0 ? below(3) - 1 : 0;
      const double lift = std::abs(x - cx) * (seed % 3) + std::abs(y - cy) * 2 + bump;
      const Disc_motion_2 d = resting(x, y, 0, x * x + y * y - lift);
      const auto is_alike = [&](const Disc_motion_2& other) { return same_trajectory(d, other); };
      if (std::ranges::none_of(discs, is_alike)) discs.push_back(d);
    }
    SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << text(discs));
    ask_all(Kinetic(discs), 0.0, 0, random, shapes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(shapes.empty, 10);
  EXPECT_GT(shapes.position, 5);
  EXPECT_GT(shapes.segment, 1);
  EXPECT_GT(shapes.ray, 5);
  EXPECT_GT(shapes.line, 3);
}

TEST(Queries_of_discs, at_random_places_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
    std::mt19937_64 random(seed);
    const Range range = {.radius = 3, .growth = 0.5, .weight = seed % 2 == 0 ? 4.0 : 0.0};
    ask_discs(random_discs(random, 1 + seed % 9, range), 4, seed, shapes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(shapes.empty, 5);
}

TEST(Queries_of_discs, of_fifty_discs_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    std::mt19937_64 random(seed);
    const Range range = {.step = seed % 2 == 0 ? 1.0 : 0.0, .radius = 3, .growth = 0.5};
    ask_all(Kinetic(random_discs(random, 50, range)), 0.0, 0, random, shapes);
    if (HasFatalFailure()) return;
  }
}

// On a line for ever, and on one at t = 1 only.
TEST(Queries_of_discs, on_a_line_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(24u); ++seed) {
    std::mt19937_64 random(seed);
    const Range range = {.step = 1, .side = 4, .speed = 1, .radius = 2, .growth = 1, .weight = 2};
    Discs discs;
    for (Disc_motion_2 d : random_discs(random, 1 + seed % 7, range)) {
      d.position.y = d.position.x;
      if (seed % 2 == 0) d.velocity.y = d.velocity.x;
      if (seed % 2 != 0) d.epoch = 1;
      const auto is_alike = [&](const Disc_motion_2& other) { return same_trajectory(d, other); };
      if (std::ranges::none_of(discs, is_alike)) discs.push_back(d);
    }
    ask_discs(discs, 3, seed, shapes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(shapes.line, 1);
}

TEST(Queries_of_discs, in_one_place_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    std::mt19937_64 random(seed);
    const Range range = {
        .step = 1, .side = 2, .speed = seed % 3 == 0 ? 1.0 : 0.0, .radius = 3, .growth = 1};
    ask_discs(random_discs(random, 2 + seed % 6, range), 3, seed, shapes);
    if (HasFatalFailure()) return;
  }
}

TEST(Queries_of_discs, that_accelerate_are_answered_as_by_a_look_at_everything) {
  Shapes shapes;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto centers = test::polynomial_grid_motions(2 + seed % 5, 4, 1, 2, seed);
    std::vector<Polynomial_disc_motion_2> discs;
    for (const Polynomial_motion_2& center : centers) {
      discs.push_back({center, static_cast<double>(random() % 4), 0, 0});
    }
    Kinetic_regular_triangulation_2<Polynomial_disc_kinetic_traits_2> kinetic(discs);
    ask_along(kinetic, 3, seed, shapes);
    if (HasFatalFailure()) return;
  }
}

TEST(Queries_of_discs, that_come_and_go_know_them) {
  std::mt19937_64 random(7);
  Shapes shapes;
  Kinetic kinetic(random_discs(random, 12, {.step = 1, .side = 4, .radius = 3}));
  kinetic.advance_to(0.5);
  kinetic.erase(3);
  kinetic.erase(0);
  kinetic.insert(resting(2, 2, 4));
  ask_along(kinetic, 3, 9, shapes);
  kinetic.erase(12);
  ask_along(kinetic, 3, 9, shapes);
}

// ---- with equal radii ----

TEST(Queries_of_discs, of_equal_radii_are_those_of_points) {
  const auto motions = test::random_motions(30, 10, 1, 3);
  Discs discs;
  for (const Linear_motion_2& m : motions) discs.push_back({m, 0.75, 0, 0});
  test::Kinetic_delaunay points(motions);
  Kinetic kinetic(discs);
  for (const double t : {0.0, 0.25, 0.5}) {
    points.advance_to(t);
    kinetic.advance_to(t);
    const Kinetic_queries_2 of_points(points);
    const Queries of_discs(kinetic);
    for (Point_id id = 0; id < motions.size(); ++id) {
      const auto expected = of_points.rounded_voronoi_cell(id);
      const auto cell = of_discs.rounded_voronoi_cell(id);
      EXPECT_EQ(cell.neighbors, expected.neighbors);
      EXPECT_EQ(cell.vertices, expected.vertices);
      EXPECT_EQ(cell.rays, expected.rays);
      EXPECT_EQ(of_discs.neighbors(id), of_points.neighbors(id));
    }
    EXPECT_EQ(of_discs.rounded_positions(), of_points.rounded_positions());
    // Their sums are rounded differently: sides of at most 40 in all, off by a few units of 2^-49.
    const std::vector<double> areas = of_discs.rounded_voronoi_areas(box.polygon);
    const std::vector<double> expected = of_points.rounded_voronoi_areas(box.polygon);
    ASSERT_EQ(areas.size(), expected.size());
    for (std::size_t k = 0; k < areas.size(); ++k)
      EXPECT_NEAR(areas[k], expected[k], 160 * 0x1p-49);
  }
}

// ---- cells without area ----

// The corners of a square, of weight 0, and its center, whose weight grows or shrinks from or to
// -2, the height of the square's face there.
TEST(Queries_of_discs, a_cell_is_one_position_when_it_appears_and_when_it_vanishes) {
  for (const double growth : {-1.0, 1.0}) {
    SCOPED_TRACE(growth);
    Kinetic kinetic({resting(0, 0, 0), resting(2, 0, 0), resting(2, 2, 0), resting(0, 2, 0),
                     disc(1, 1, 0, 0, 1 - growth, growth, -3)});
    EXPECT_EQ(kinetic.is_hidden(4), growth > 0);
    EXPECT_EQ(Queries(kinetic, 0.5).voronoi_cell(4).is_empty, growth > 0);
    ASSERT_EQ(kinetic.next_event_time(), Algebraic_number(1.0));
    for (int i = 0; i < 2; ++i) {
      const auto cell = Queries(kinetic, 1.0).voronoi_cell(4);
      EXPECT_FALSE(cell.is_empty);
      EXPECT_TRUE(cell.is_bounded());
      EXPECT_TRUE(cell.neighbors.empty());
      EXPECT_FALSE(cell.rays);
      ASSERT_EQ(cell.vertices.size(), 1u);
      EXPECT_EQ(static_point(cell.vertices[0]), Static_point(1, 1));
      EXPECT_EQ(Queries(kinetic, 1.0).rounded_voronoi_cell(4).vertices,
                (std::vector<Vector_2>{{1, 1}}));
      // The others have one corner there, and the first of them is named.
      EXPECT_EQ(Queries(kinetic, 1.0).nearest_vertex({1, 1}), 0u);
      kinetic.advance_to(1.0);
    }
    EXPECT_EQ(kinetic.is_hidden(4), growth < 0);
    EXPECT_EQ(Queries(kinetic, 1.5).voronoi_cell(4).is_empty, growth < 0);
    EXPECT_TRUE(growth > 0 || Queries(kinetic, 1.5).neighbors(4).empty());
  }
}

// On the edge of two others, at its height: between the centers of the triangles beside it.
TEST(Queries_of_discs, a_cell_on_an_edge_is_a_segment_with_two_sides) {
  const Kinetic kinetic({resting(-1, 0, 0), resting(1, 0, 0), resting(0, 3, 0), resting(0, -5, 0),
                         resting(0, 0, 0, -1)});
  const Queries queries(kinetic);
  const auto cell = queries.voronoi_cell(4);
  EXPECT_EQ(cell.neighbors, (std::vector<Point_id>{0, 1}));
  EXPECT_FALSE(cell.is_empty);
  EXPECT_TRUE(cell.is_bounded());
  ASSERT_EQ(cell.vertices.size(), 2u);
  EXPECT_EQ(static_point(cell.vertices[0]), Static_point(0, Rational(-12, 5)));
  EXPECT_EQ(static_point(cell.vertices[1]), Static_point(0, Rational(4, 3)));
  EXPECT_EQ(queries.voronoi_cell(0).neighbors, (std::vector<Point_id>{3, 1, 2}));
  EXPECT_EQ(queries.rounded_voronoi_areas(box.polygon)[4], 0);
}

TEST(Queries_of_discs, a_cell_between_two_points_is_a_line) {
  const Kinetic kinetic({resting(-1, 0, 0), resting(1, 0, 0), resting(0, 0, 0, -1)});
  const auto cell = Queries(kinetic).voronoi_cell(2);
  EXPECT_EQ(cell.neighbors.size(), 2u);
  EXPECT_TRUE(cell.vertices.empty());
  EXPECT_TRUE(cell.rays);
  EXPECT_FALSE(cell.is_empty);
  EXPECT_EQ(Queries(kinetic).voronoi_cell(0).neighbors, (std::vector<Point_id>{1}));
}

TEST(Queries_of_discs, the_plane_is_told_from_nothing) {
  const Kinetic kinetic(Discs{resting(3, 3, 1), resting(3, 3, 2)});
  const Queries queries(kinetic);
  EXPECT_TRUE(queries.voronoi_cell(0).is_empty);
  EXPECT_TRUE(queries.voronoi_cell(0).is_bounded());
  const auto plane = queries.voronoi_cell(1);
  EXPECT_FALSE(plane.is_empty);
  EXPECT_FALSE(plane.is_bounded());
  EXPECT_TRUE(plane.neighbors.empty() && plane.vertices.empty() && !plane.rays);
  EXPECT_EQ(queries.rounded_voronoi_areas(box.polygon), (std::vector<double>{0, 132}));
}

// Two points cross whose weights differ by 1: at t = 1 the cell of the lighter one is at infinity.
TEST(Queries_of_discs, a_cell_that_goes_to_infinity_is_empty_there) {
  Kinetic kinetic(Discs{disc(0, 0, 1, 0, 2), disc(1, 0, 0, 0, 1)});
  while (kinetic.next_event_time() && *kinetic.next_event_time() < 1.0) kinetic.step();
  EXPECT_FALSE(Queries(kinetic, 0.75).voronoi_cell(1).is_empty);
  EXPECT_TRUE(Queries(kinetic, 1.0).voronoi_cell(1).is_empty);
  EXPECT_EQ(Queries(kinetic, 1.0).nearest_vertex({100, 0}), 0u);
  kinetic.advance_to(1.0);
  EXPECT_TRUE(Queries(kinetic, 1.0).voronoi_cell(1).is_empty);
  EXPECT_FALSE(Queries(kinetic, 1.25).voronoi_cell(1).is_empty);
}

// ---- times and preconditions ----

// Cells at irrational times, between events, are those at a rational time very near.
TEST(Queries_of_discs, at_an_irrational_time_are_answered_as_right_beside_it) {
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    Kinetic kinetic(random_discs(random, 12, {.radius = 3, .growth = 0.25}));
    const Rational next = simplest_between(kinetic.current_time(), *kinetic.next_event_time());
    const Rational square = next * next / 2;
    const Algebraic_number time(Polynomial{-boost::multiprecision::numerator(square), 0,
                                           boost::multiprecision::denominator(square)},
                                0, next);
    time.refine_to_bits(400);
    const Queries queries(kinetic, time);
    const Queries beside(kinetic, Algebraic_number(time.lower()));
    for (Point_id id = 0; id < 12; ++id) {
      test::expect_rounded(queries.rounded_voronoi_cell(id), beside.voronoi_cell(id));
    }
    EXPECT_EQ(queries.rounded_positions(), beside.rounded_positions());
    EXPECT_EQ(queries.rounded_voronoi_areas(box.polygon),
              beside.rounded_voronoi_areas(box.polygon));
    EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(0),
                              "at a time that is not known to be rational a Voronoi vertex has "
                              "no exact coordinates; call rounded_voronoi_cell");
  }
}

// A small disc goes from one triangle that hides it to the next: no event, but another answer to
// where it is.
TEST(Queries_of_discs, after_a_hidden_point_has_changed_triangles_are_refused) {
  Kinetic kinetic({resting(0, 0, 4), resting(4, 0, 4), resting(4, 4.5, 4), resting(0, 4, 4),
                   disc(1, 2, 1, 0, 0)});
  ASSERT_TRUE(kinetic.is_hidden(4));
  const Queries queries(kinetic, 0.5);
  kinetic.advance_to(0.75);
  EXPECT_NO_THROW(queries.voronoi_cell(4));
  const auto events = kinetic.counters().number_of_events();
  kinetic.advance_to(2.5);
  ASSERT_EQ(kinetic.counters().number_of_events(), events);
  EXPECT_PRECONDITION_ERROR(
      queries.voronoi_cell(4),
      "the triangulation has changed since these queries were made; make new ones after an event");
}

// Weights whose difference is far less than the weights, and the other way round.
TEST(Queries_of_discs, areas_with_huge_and_tiny_numbers_are_those_of_the_exact_cells) {
  const std::vector<Discs> cases = {
      {resting(0, 0, 1e15), resting(3, 1, 1e15, 2), resting(1, 3, 1e15, -1)},
      {resting(0, 0, 0, 1e30), resting(5, 0, 0x1p-30, 1e30)},
      {resting(0, 0, 1e-8), resting(5, 0x1p-40, 2), resting(5, -0x1p-40, 2)},
      {resting(0, 0, 1e150), resting(5, 0, 1e140), resting(5, 1, 0)},
      {resting(0, 0, 1e170), resting(5, 0, 1e160), resting(5, 1, 0)},
      {resting(2, 2, 0x1p-500), disc(2, 2, 0x1p-1000, 0x1p-1000, 0x1p-501)}};
  for (const auto& discs : cases) {
    SCOPED_TRACE(text(discs));
    const Kinetic kinetic(discs, Algebraic_number(1.0));
    const Query_oracle oracle(kinetic, 1);
    for (const Region& region : {box, corner}) {
      const auto areas = Queries(kinetic).rounded_voronoi_areas(region.polygon);
      expect_areas(areas, oracle, region, 60);
    }
  }
}

}  // namespace
}  // namespace kinetri::queries_2_discs_test
