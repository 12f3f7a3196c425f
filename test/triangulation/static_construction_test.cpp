// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/static_construction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/kinetic_parts.h"
#include "support/message_of.h"

namespace kinetri::static_construction_test {
namespace {

using test::resting;

template <class Traits>
using Construction = typename detail::Kinetic_types<Traits>::Static_construction;

/// The edges of what is built just after a time.
template <class Traits, class Motion>
std::set<Edge_ids> built_edges(const std::vector<Motion>& motions, const Algebraic_number& time) {
  using Point_2 = typename Traits::Point_2;
  const std::vector<Point_2> points = test::points_of<Point_2>(motions);
  std::vector<Edge_ids> coincident;
  const auto made = Construction<Traits>::build(
      points, time, Traits().instantaneous_traits(Instant{time, Time_side::after}), coincident);
  EXPECT_TRUE(coincident.empty());
  EXPECT_TRUE(made.is_valid());
  EXPECT_EQ(made.number_of_vertices(), motions.size());
  std::set<Edge_ids> result;
  for (const auto& edge : made.finite_edges()) {
    result.insert(detail::Topology<Traits>::ids_of(edge));
  }
  return result;
}

// Fewer points than 16 are inserted by CGAL, more are made from rounded places; on a grid most are
// cocircular, or come together.
TEST(Static_construction, has_the_edges_of_static_points_just_after_the_time) {
  for (unsigned seed = 1; seed <= test::cases(3u); ++seed) {
    for (const std::size_t n : {1u, 2u, 3u, 9u, 18u}) {
      SCOPED_TRACE(testing::Message() << n << " points, seed " << seed);
      const auto at_random = test::random_motions(n, 10, 2, seed);
      EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(at_random, 1.5),
                test::edges_at(at_random, Rational(3, 2)));
    }
    const auto on_grid = test::grid_motions(10, 4, 1, seed);
    EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(on_grid, 1.0), test::edges_after(on_grid, 1.0));
  }
}

TEST(Static_construction, of_a_lattice_has_the_edges_that_the_lifting_chooses) {
  std::vector<Linear_motion_2> lattice;
  for (int i = 0; i < 25; ++i) lattice.push_back({{double(i % 5), double(i / 5)}, {1, 2}, 0});
  const auto expected = test::edges_at(lattice, Rational(0));
  EXPECT_EQ(expected.size(), 56u);
  EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(lattice, 0.0), expected);
  std::ranges::reverse(lattice);
  EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(lattice, 1.0),
            test::edges_at(lattice, Rational(0)));
}

TEST(Static_construction, at_times_of_events_has_the_edges_just_after_them) {
  const auto motions = test::grid_motions(7, 4, 2, 5);
  const auto times = test::critical_times(motions, 0.0);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(motions, times[k]),
              test::edges_at(motions, simplest_between(times[k], times[k + 1])));
  }
}

TEST(Static_construction, of_collinear_points_has_the_edges_along_the_line) {
  std::vector<Linear_motion_2> line;
  for (int i = 0; i < 20; ++i) line.push_back(resting(7 * i % 20, 2 * (7 * i % 20)));
  EXPECT_EQ(built_edges<Linear_kinetic_traits_2>(line, 0.0), test::edges_at(line, Rational(0)));
}

// Discs of one weight are as points; a light one among heavy ones is hidden.
TEST(Static_construction, of_discs_hides_those_that_have_no_cell) {
  std::vector<Disc_motion_2> discs;
  for (const auto& m : test::random_motions(18, 10, 2, 1)) discs.push_back({m, 2, 0, 0});
  EXPECT_EQ(built_edges<Disc_kinetic_traits_2>(discs, 1.0),
            built_edges<Linear_kinetic_traits_2>(test::random_motions(18, 10, 2, 1), 1.0));
  using Point_2 = Disc_kinetic_traits_2::Point_2;
  const auto hidden = [](double radius) {
    const auto disc = [](double x, double y, double r) {
      return Disc_motion_2{resting(x, y), r, 0, 0};
    };
    std::vector<Edge_ids> coincident;
    const auto made = Construction<Disc_kinetic_traits_2>::build(
        test::points_of<Point_2>(
            std::vector{disc(0, 0, 6), disc(8, 0, 6), disc(4, 8, 6), disc(4, 3, radius)}),
        0.0, Disc_kinetic_traits_2().instantaneous_traits(Instant{0.0, Time_side::after}),
        coincident);
    return made.number_of_hidden_vertices();
  };
  // (4, 3) is the center of the circle through the three, and 5 away from them: 36 - 25 = 11.
  EXPECT_EQ(hidden(3), 1u);
  EXPECT_EQ(hidden(3.5), 0u);
}

// Takes points out that are found to coincide with others, until there are none.
template <class Traits, class Motion>
void expect_coincident(const std::vector<Motion>& motions, const std::vector<Edge_ids>& expected) {
  auto points = test::points_of<typename Traits::Point_2>(motions);
  detail::Coincident_groups groups;
  for (std::size_t before = 0; before != points.size();) {
    std::vector<Edge_ids> pairs;
    Construction<Traits>::build(points, Algebraic_number(1.0),
                                Traits().instantaneous_traits(Instant{1.0, Time_side::after}),
                                pairs);
    for (const auto& [a, b] : pairs) groups.link(a, b);
    before = points.size();
    std::erase_if(points, [&](const auto& point) {
      return std::ranges::any_of(groups.others(),
                                 [&](const Edge_ids& pair) { return pair[1] == point.id(); });
    });
  }
  EXPECT_EQ(groups.others(), expected);
}

TEST(Static_construction, finds_points_with_one_trajectory) {
  for (const std::size_t n : {7u, 40u}) {
    auto motions = test::random_motions(n, 10, 2, 1);
    motions[n - 1] = motions[n - 2] = motions[2];
    motions[4] = motions[3];
    const auto a = static_cast<Point_id>(n - 2);
    expect_coincident<Linear_kinetic_traits_2>(motions, {{3, 4}, {2, a}, {2, a + 1}});
    std::vector<Disc_motion_2> discs;
    for (std::size_t k = 0; k < n; ++k) {
      discs.push_back({motions[k], 0, 0, 0.125 * static_cast<double>(k)});
    }
    expect_coincident<Disc_kinetic_traits_2>(discs, {});
    discs[2].weight = discs[n - 1].weight;
    discs[4].weight = discs[3].weight;
    expect_coincident<Disc_kinetic_traits_2>(discs, {{3, 4}, {2, a + 1}});
  }
}

TEST(Static_construction, finds_hidden_points_with_one_trajectory) {
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& m : test::random_motions(40, 10, 0, 1)) discs.push_back({m, 0, 0, 0});
  discs[0].weight = 0.5;  // so that not all weights are equal but for those of the hidden ones
  const Disc_motion_2 hidden = {discs[20], 0, 0, -1000};
  for (int k = 0; k < 3; ++k) discs.push_back(hidden);
  discs[20].position.x += 0.125;
  expect_coincident<Disc_kinetic_traits_2>(discs, {{40, 41}, {40, 42}});
}

TEST(Embedding, is_that_of_faces_that_turn_left_and_a_convex_hull) {
  using Part = test::Topology_part<>;
  Part part({resting(0, 0), resting(8, 0), resting(8, 8), resting(0, 8), resting(4, 3)});
  const auto is_embedded_at = [&](Point_id id, double x, double y) {
    const Linear_motion_2 before = part.topology.vertex(id)->point().motion();
    part.topology.set_point({id, resting(x, y)});
    const bool result = Construction<Linear_kinetic_traits_2>::is_embedded(
        part.topology.triangulation(), Algebraic_number(0.0));
    part.topology.set_point({id, before});
    return result;
  };
  EXPECT_TRUE(is_embedded_at(4, 4, 3));
  EXPECT_TRUE(is_embedded_at(4, 7.5, 0.25)) << "not Delaunay, but embedded";
  EXPECT_FALSE(is_embedded_at(4, 4, 0)) << "flat";
  EXPECT_FALSE(is_embedded_at(4, 4, -1));
  EXPECT_FALSE(is_embedded_at(2, 3.875, 3.875)) << "the hull is not convex";
}

}  // namespace
}  // namespace kinetri::static_construction_test
