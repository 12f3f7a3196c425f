// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/dynamic_connectivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include "support/multiplier.h"
#include "support/precondition_error.h"

namespace kinetri::dynamic_connectivity_test {
namespace {

// The component of each point by a search over all edges.
std::map<Point_id, Point_id> components(const std::set<Point_id>& points,
                                        const std::set<Edge_ids>& edges) {
  std::map<Point_id, Point_id> result;
  for (const Point_id id : points) result[id] = id;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const auto& [a, b] : edges) {
      if (result[a] == result[b]) continue;
      result[a] = result[b] = std::min(result[a], result[b]);
      has_changed = true;
    }
  }
  return result;
}

void expect_same(const Dynamic_connectivity& graph, const std::set<Point_id>& points,
                 const std::set<Edge_ids>& edges) {
  const auto expected = components(points, edges);
  std::map<Point_id, std::size_t> sizes;
  for (const auto& [id, component] : expected) ++sizes[component];
  EXPECT_EQ(graph.number_of_components(), sizes.size());
  std::size_t largest = 0;
  for (const auto& [component, size] : sizes) largest = std::max(largest, size);
  EXPECT_EQ(graph.largest(), largest);
  for (const auto& [a, component] : expected) {
    ASSERT_TRUE(graph.contains(a));
    EXPECT_EQ(graph.size_of(a), sizes[component]);
    for (const auto& [b, other] : expected) {
      EXPECT_EQ(graph.are_connected(a, b), component == other) << a << " and " << b;
    }
  }
}

// Few edges, so that components are of all sizes, and both kinds of change split and join.
TEST(Dynamic_connectivity, is_that_of_a_search_over_all_edges) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const unsigned most = 12 + 3 * (seed % 10);
    Dynamic_connectivity graph;
    std::set<Point_id> points;
    std::set<Edge_ids> edges;
    for (int change = 0; change < 400; ++change) {
      const auto a = static_cast<Point_id>(random() % most);
      const auto b = static_cast<Point_id>(random() % most);
      const Edge_ids edge = edge_ids(a, b);
      const std::size_t before = graph.number_of_components();
      if (points.insert(a).second) {
        graph.add_point(a);
      } else if (edges.contains(edge)) {
        edges.erase(edge);
        const bool splits = graph.remove_edge(edge);
        EXPECT_EQ(graph.number_of_components(), before + (splits ? 1 : 0));
      } else if (a != b && points.contains(b) && random() % 3 > 0) {
        edges.insert(edge);
        const bool joins = graph.add_edge(edge);
        EXPECT_EQ(graph.number_of_components(), before - (joins ? 1 : 0));
      } else if (random() % 2 == 0) {
        for (auto at = edges.begin(); at != edges.end();) {
          const bool has_a = (*at)[0] == a || (*at)[1] == a;
          if (has_a) graph.remove_edge(*at);
          at = has_a ? edges.erase(at) : std::next(at);
        }
        graph.remove_point(a);
        points.erase(a);
        EXPECT_FALSE(graph.contains(a));
      }
      expect_same(graph, points, edges);
      if (testing::Test::HasFailure()) return;
    }
  }
}

// The removal of each edge of a path splits it; that of one edge of a cycle does not.
TEST(Dynamic_connectivity, of_a_cycle_is_lost_with_the_second_edge) {
  Dynamic_connectivity graph;
  constexpr Point_id n = 1000;
  for (Point_id id = 0; id < n; ++id) graph.add_point(id);
  EXPECT_EQ(graph.number_of_components(), n);
  for (Point_id id = 0; id + 1 < n; ++id) EXPECT_TRUE(graph.add_edge({id, id + 1}));
  EXPECT_FALSE(graph.add_edge({0, n - 1}));
  EXPECT_FALSE(graph.remove_edge({299, 300}));
  EXPECT_EQ(graph.largest(), n);
  EXPECT_TRUE(graph.remove_edge({799, 800}));
  EXPECT_EQ(graph.size_of(300), 500u);
  EXPECT_EQ(graph.size_of(299), 500u);
  EXPECT_FALSE(graph.are_connected(299, 300));
  EXPECT_TRUE(graph.are_connected(299, 800));
  EXPECT_EQ(graph.largest(), 500u);
}

TEST(Dynamic_connectivity, refuses_what_is_not_there) {
  Dynamic_connectivity graph;
  EXPECT_PRECONDITION_ERROR(graph.remove_point(3), "no such point");
  EXPECT_PRECONDITION_ERROR(graph.component(3), "no such point");
  graph.add_point(3);
  graph.add_point(1);
  EXPECT_PRECONDITION_ERROR(graph.add_point(3), "the point is in the graph already");
  EXPECT_PRECONDITION_ERROR(graph.add_edge({2, 3}), "an edge needs two points");
  EXPECT_PRECONDITION_ERROR(graph.add_edge({3, 3}), "an edge needs two points");
  EXPECT_PRECONDITION_ERROR(graph.remove_edge({1, 3}), "no such edge");
  graph.add_edge({1, 3});
  EXPECT_PRECONDITION_ERROR(graph.remove_point(3), "a point that goes still has edges");
}

}  // namespace
}  // namespace kinetri::dynamic_connectivity_test
