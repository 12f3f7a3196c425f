// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disc_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/simulation_parts.h"

namespace kinetri::disc_geometry_test {
namespace {

using Pairs = std::set<Edge_ids>;
using Discs = test::Geometry_part<Disc_kinetic_traits_2>;

Simulation_options of_radius(double radius) {
  Simulation_options options;
  options.radius = radius;
  return options;
}

std::vector<Disc_motion_2> random_discs(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> radius(0, 2);
  std::vector<Disc_motion_2> discs;
  for (const auto& m : test::random_motions(n, 10, 1, seed)) {
    discs.push_back({m, radius(random), 0.25 * radius(random), 0});
  }
  return discs;
}

Disc_motion_2 disc(double x, double y, double radius, double growth = 0) {
  return {{{x, y}, {0, 0}, 0}, radius, growth, 0};
}

TEST(Equal_discs, that_overlap_are_found_by_walking_along_edges) {
  for (unsigned seed = 1; seed <= test::cases(5u); ++seed) {
    const test::Geometry_part<> part(test::random_motions(40, 10, 1, seed), of_radius(1), 0.5);
    const Pairs expected = part.overlaps_at(Rational(1, 2));
    const Linear_kinetic_traits_2 exact = part.setup.traits().exact();
    Pairs found;
    part.geometry.for_each_exact_overlap(exact, [&](Point_id a, Point_id b) {
      EXPECT_TRUE(found.insert({a, b}).second);
    });
    EXPECT_EQ(found, expected) << "seed " << seed;
    for (Point_id id = 0; id < 40; ++id) {
      for (const Point_id other : part.geometry.overlapping_points(id, exact)) {
        EXPECT_TRUE(expected.contains(edge_ids(id, other)));
        EXPECT_TRUE(part.geometry.may_touch(id, other)) << "true if unsure";
      }
    }
  }
}

TEST(Discs, that_overlap_are_found_by_their_boxes_and_their_places) {
  for (unsigned seed = 1; seed <= test::cases(5u); ++seed) {
    SCOPED_TRACE(seed);
    const Discs part(random_discs(40, seed), {}, 0.5);
    const Pairs expected = part.overlaps_at(Rational(1, 2));
    Pairs found;
    part.geometry.for_each_exact_overlap(part.setup.traits().exact(), [&](Point_id a, Point_id b) {
      found.insert({a, b});
    });
    EXPECT_EQ(found, expected);
    // Each disc that overlaps one of the points is in the result, or overlaps one that is.
    for (Point_id id = 0; id < 40; ++id) {
      const auto about = part.geometry.discs_about(std::span(&id, 1));
      for (const auto& [a, b] : expected) {
        if (a != id && b != id) continue;
        const Point_id other = a == id ? b : a;
        EXPECT_TRUE(std::ranges::any_of(about,
                                        [&](Point_id near) {
                                          return near == other ||
                                                 expected.contains(edge_ids(near, other));
                                        }))
            << id << " and " << other;
      }
    }
  }
}

TEST(Discs, that_touch_do_not_overlap) {
  const test::Geometry_part<> part({{{0, 0}, {0, 0}, 0}, {{4, 0}, {-1, 0}, 0}, {{0, 9}, {0, 0}, 0}},
                                   of_radius(1));
  const auto& geometry = part.geometry;
  EXPECT_FALSE(geometry.do_touch(0, 1, 1.0));
  EXPECT_TRUE(geometry.do_touch(0, 1, 2.0));
  EXPECT_TRUE(geometry.do_touch(0, 1, 3.0));
  EXPECT_FALSE(geometry.do_overlap(geometry.point(0), geometry.point(1)));
  const auto overlap_at = [&](double time) {
    const test::Geometry_part<> then({geometry.motion(0), geometry.motion(1), geometry.motion(2)},
                                     of_radius(1), time);
    return then.geometry.do_overlap(then.geometry.point(0), then.geometry.point(1));
  };
  EXPECT_FALSE(overlap_at(2));
  EXPECT_TRUE(overlap_at(3));
}

TEST(Neighbors, are_those_that_have_an_edge) {
  const test::Geometry_part<> part(test::random_motions(20, 10, 1, 1), of_radius(1));
  const auto ids = part.triangulation.finite_edge_ids();
  const Pairs edges(ids.begin(), ids.end());
  for (Point_id a = 0; a < 20; ++a) {
    for (Point_id b = a + 1; b < 20; ++b) {
      EXPECT_EQ(part.geometry.is_edge({a, b}), edges.contains({a, b}));
      EXPECT_EQ(part.geometry.is_edge({b, a}), edges.contains({a, b}));
    }
  }
  EXPECT_FALSE(part.geometry.is_edge({0, 20})) << "which is not there";
}

// A hidden point without area has the corners of its triangle as neighbors; one with area has none.
TEST(Neighbors, of_a_hidden_point_are_the_corners_of_its_triangle) {
  const std::vector<Disc_motion_2> discs = {disc(0, 0, 5), disc(8, 0, 5),   disc(4, 7, 5),
                                            disc(4, 3, 0), disc(4, 2, 0.5), disc(20, 30, 1)};
  const Discs part(discs, {});
  ASSERT_TRUE(part.geometry.is_hidden(3) && part.geometry.is_hidden(4));
  std::vector<Point_id> corners = part.geometry.corners_of(3);
  std::ranges::sort(corners);
  EXPECT_EQ(corners, (std::vector<Point_id>{0, 1, 2}));
  EXPECT_TRUE(part.geometry.corners_of(4).empty());
  EXPECT_TRUE(part.geometry.corners_of(0).empty());
  EXPECT_TRUE(part.geometry.is_edge({1, 3}) && part.geometry.is_edge({3, 1}));
  EXPECT_FALSE(part.geometry.is_edge({1, 4}));
  // Each pair of neighbors once.
  const auto blocks = part.geometry.make_for_edges<std::vector<Edge_ids>>(
      [](const Edge_ids& edge, const Algebraic_number&, auto& made) { made.push_back(edge); });
  Pairs made;
  std::size_t number = 0;
  for (const auto& block : blocks) {
    number += block.size();
    made.insert(block.begin(), block.end());
  }
  const auto ids = part.triangulation.finite_edge_ids();
  Pairs expected(ids.begin(), ids.end());
  expected.insert({{0, 3}, {1, 3}, {2, 3}});
  EXPECT_EQ(made, expected);
  EXPECT_EQ(number, expected.size());
}

TEST(Disc, that_grows_from_nothing_is_a_seed_at_that_time_alone) {
  const std::vector<Disc_motion_2> discs = {disc(0, 0, 0, 1), disc(9, 0, 0), disc(0, 9, -1, 0.5),
                                            disc(9, 9, 1, 1)};
  const Discs at_0(discs, {}, 0.0);
  const Discs at_2(discs, {}, 2.0);
  EXPECT_TRUE(at_0.geometry.is_seed(0));
  EXPECT_FALSE(at_2.geometry.is_seed(0));
  EXPECT_FALSE(at_0.geometry.is_seed(1)) << "it never grows";
  EXPECT_TRUE(at_2.geometry.is_seed(2));
  EXPECT_FALSE(at_0.geometry.is_seed(3));
  EXPECT_TRUE(at_0.geometry.is_without_area(1));
  EXPECT_FALSE(at_0.geometry.is_without_area(0));
}

}  // namespace
}  // namespace kinetri::disc_geometry_test
