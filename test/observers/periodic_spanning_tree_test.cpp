// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimum spanning trees in periodic boxes, compared with Kruskal's algorithm over all points and
// their nearest images, in rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/observers/kinetic_spanning_tree_2.h"
#include "observers/random_runs.h"
#include "support/component_oracle.h"
#include "support/observed_periodic_run.h"

namespace kinetri::periodic_spanning_tree_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Time = Algebraic_number;
using Edges = std::vector<Periodic_edge>;
using test::Periodic_run;

// ---- the oracle ----

/// A pair in the order of lengths just after a time: by the squared distance, its derivatives, and
/// the name.
struct Pair {
  Rational square;
  Rational slope;
  Rational curvature;
  Periodic_edge name;

  friend bool operator<(const Pair& a, const Pair& b) {
    return std::tie(a.square, a.slope, a.curvature, a.name) <
           std::tie(b.square, b.slope, b.curvature, b.name);
  }
};

Pair pair_at(Periodic_run& run, const Periodic_edge& name, const Rational& now) {
  const Kinetic& kinetic = run.kinetic();
  const Linear_motion_2& p = kinetic.motion(name.ids[0]);
  const Image_motion_2 q = {kinetic.motion(name.ids[1]), name.offset, &run.box()};
  const auto square_at = [&](const Rational& t) {
    return Rational(CGAL::squared_distance(test::place_at(p, t), test::place_at(q, t)));
  };
  const Rational here = square_at(now);
  const Rational before = square_at(now - 1);
  const Rational after = square_at(now + 1);
  return {here, (after - before) / 2, after - 2 * here + before, name};
}

struct Tree {
  Edges edges;
  std::optional<Pair> longest;
};

/// Of two points only the nearest image can be in the tree.
Tree tree_after(Periodic_run& run, const Rational& now) {
  const Kinetic& kinetic = run.kinetic();
  std::set<Pair> pairs;
  test::Partition partition;
  for (Point_id a = 0; a < kinetic.next_id(); ++a) {
    if (!kinetic.contains(a)) continue;
    partition.add(a);
    for (Point_id b = a + 1; b < kinetic.next_id(); ++b) {
      if (!kinetic.contains(b)) continue;
      std::optional<Pair> nearest;
      for (const auto& offset : run.offsets_near(kinetic.motion(a), kinetic.motion(b), now)) {
        Pair pair = pair_at(run, {{a, b}, offset}, now);
        if (!nearest || pair < *nearest) nearest = pair;
      }
      pairs.insert(*nearest);
    }
  }
  Tree result;
  for (const Pair& pair : pairs) {
    const auto& [a, b] = pair.name.ids;
    if (partition.are_joined(a, b)) continue;
    partition.join(a, b);
    result.edges.push_back(pair.name);
    result.longest = pair;
  }
  std::ranges::sort(result.edges);
  return result;
}

// ---- by hand ----

// Two points, a long way around the box from each other: the tree changes from the one image to the
// other where both are equally far.
TEST(Periodic_spanning_tree, of_two_points_is_the_nearest_image) {
  const Periodic_box_2 box({{10, 0}, {0, 0}, 0}, {{0, 10}, {0, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{1, 2}, {0, 0}, 0}, {{2, 2}, {1, 0}, 0}}, Time(),
                  Traits(box));
  Kinetic_spanning_tree_2 tree(kinetic);
  EXPECT_EQ(tree.edges(), (Edges{{{0, 1}, {0, 0}}}));
  kinetic.advance_to(12.0);
  EXPECT_TRUE(tree.is_edge({{0, 1}, {-1, 0}}));
  EXPECT_FALSE(tree.is_edge({{0, 1}, {0, 0}}));
  const auto& changes = tree.changes();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].time, Time(4.0));
  EXPECT_EQ(changes[0].removed, (Edges{{{0, 1}, {0, 0}}}));
  EXPECT_EQ(changes[0].added, (Edges{{{0, 1}, {-1, 0}}}));
  const auto longest = tree.longest_edges();
  ASSERT_EQ(longest.size(), 2U);
  EXPECT_EQ(longest[1].edge, (Periodic_edge{{0, 1}, {-1, 0}}));
  EXPECT_EQ(longest[1].length, 5);
  EXPECT_EQ(tree.least_connecting_range()->range, Time(0.0));
  EXPECT_EQ(tree.least_connecting_range()->time, Time(9.0));
  EXPECT_EQ(tree.greatest_connecting_range()->range, Time(5.0));
  EXPECT_EQ(tree.greatest_connecting_range()->time, Time(4.0));
}

TEST(Periodic_spanning_tree, of_one_point_is_empty) {
  const Periodic_box_2 box({{4, 0}, {-1, 0}, 0}, {{0, 3}, {0, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Time(), Traits(box));
  Kinetic_spanning_tree_2 tree(kinetic);
  kinetic.advance_to(3.0);
  EXPECT_TRUE(tree.edges().empty());
  EXPECT_TRUE(tree.changes().empty());
  EXPECT_FALSE(tree.connecting_range());
}

// ---- Kruskal's algorithm ----

// Between two changes the tree is that of all pairs; at each change an edge that leaves and one
// that enters are equally long.
TEST(Periodic_spanning_tree, is_that_of_all_pairs_of_images) {
  std::size_t number = 0;
  std::size_t images = 0;
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    Kinetic& kinetic = run.kinetic();
    Kinetic_spanning_tree_2 tree(kinetic);
    const Edges start = tree.edges();
    kinetic.advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(tree.changes());
    kinetic.advance_to(3.0);
    const auto changes = tree.changes();
    const auto longest = tree.longest_edges();
    std::set<Time> times = {Time(3.0)};
    for (double t = 0; t < 3; t += 0.75) times.insert(Time(t));
    for (const auto& change : changes) times.insert(change.time);
    for (const auto& edge : longest) times.insert(edge.time);
    std::set<Periodic_edge> present(start.begin(), start.end());
    auto change = changes.begin();
    auto longest_one = longest.begin();
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0;
    for (auto time = times.begin(); *time < Time(3.0); ++time) {
      if (change != changes.end() && change->time == *time) {
        ASSERT_EQ(change->removed.size(), change->added.size());
        for (const auto& edge : change->removed) ASSERT_EQ(present.erase(edge), 1U);
        for (const auto& edge : change->added) ASSERT_TRUE(present.insert(edge).second);
        if (change->added.size() == 1) {
          const auto ends = [&](const Periodic_edge& edge) {
            return test::paths_of(std::array<Image_motion_2, 4>{
                Image_motion_2{kinetic.motion(change->removed[0].ids[0]), {}, &run.box()},
                Image_motion_2{kinetic.motion(change->removed[0].ids[1]), change->removed[0].offset,
                               &run.box()},
                Image_motion_2{kinetic.motion(edge.ids[0]), {}, &run.box()},
                Image_motion_2{kinetic.motion(edge.ids[1]), edge.offset, &run.box()}});
          }(change->added[0]);
          const auto square = [](const auto& p, const auto& q) {
            return (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
          };
          ASSERT_EQ(sign_at(square(ends[0], ends[1]) - square(ends[2], ends[3]), *time),
                    CGAL::ZERO);
        }
        ++number;
        ++change;
      }
      while (longest_one + 1 != longest.end() && longest_one[1].time <= *time) ++longest_one;
      const Rational between = simplest_between(*time, *std::next(time));
      const Tree expected = tree_after(run, between);
      ASSERT_EQ(Edges(present.begin(), present.end()), expected.edges) << "after " << *time;
      ASSERT_EQ(longest_one->edge.has_value(), expected.longest.has_value());
      for (const auto& edge : expected.edges) images += edge.offset != Lattice_offset_2();
      if (!expected.longest) continue;
      ASSERT_EQ(*longest_one->edge, expected.longest->name) << "after " << *time;
      const double length = std::sqrt(expected.longest->square.convert_to<double>());
      least = std::min(least, length);
      greatest = std::max(greatest, length);
    }
    // What changes at the end is for just after it.
    ASSERT_TRUE(change == changes.end() || change->time == Time(3.0));
    if (greatest == 0) continue;
    EXPECT_LE(tree.least_connecting_range()->range.to_double(), least * (1 + 1e-12));
    EXPECT_GE(tree.greatest_connecting_range()->range.to_double(), greatest * (1 - 1e-12));
    for (const bool is_greatest : {false, true}) {
      const auto range =
          is_greatest ? tree.greatest_connecting_range() : tree.least_connecting_range();
      const double t = range->time.to_double();
      const Vector_2 p = rounded_place(kinetic.motion(range->edge.ids[0]), t);
      const Vector_2 q = rounded_place(
          Image_motion_2{kinetic.motion(range->edge.ids[1]), range->edge.offset, &run.box()}, t);
      EXPECT_NEAR(range->range.to_double(), std::hypot(p.x - q.x, p.y - q.y), 1e-9);
    }
  }
  EXPECT_GT(number, 60U);
  EXPECT_GT(images, 300U);
}

// Points that turn, jump, come, go, and coincide with images of others for a while.
TEST(Periodic_spanning_tree, of_points_that_change_is_that_of_all_pairs_of_images) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(40u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    Kinetic& kinetic = run.kinetic();
    Kinetic_spanning_tree_2 tree(kinetic);
    for (double time = 0; time <= 3; time += 0.5) {
      kinetic.advance_to(time);
      const int changes = run.integer(0, 3);
      for (int i = 0; i < changes; ++i) run.change();
      hidden += kinetic.number_of_hidden_points();
      if (run.integer(0, 2) == 0) continue;
      const Tree expected = tree_after(run, to_rational(time));
      ASSERT_EQ(tree.edges(), expected.edges) << "at " << time;
      const auto range = tree.connecting_range();
      ASSERT_EQ(range.has_value(), expected.longest.has_value());
      if (range) {
        ASSERT_EQ(range->edge, expected.longest->name) << "at " << time;
      }
    }
  }
  EXPECT_GT(hidden, 5U);
}

}  // namespace
}  // namespace kinetri::periodic_spanning_tree_test
