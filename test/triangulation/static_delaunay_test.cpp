// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation of places that stand still, made cell by cell, against the one that CGAL makes
// of all places at once.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/multiplier.h"
#include "support/precondition_error.h"
#include "triangulation/kd_cells.h"
#include "triangulation/static_delaunay.h"

namespace kinetri::static_delaunay_test {
namespace {

using detail::Static_delaunay;
using detail::static_delaunay_by_cells;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Places = std::vector<Vector_2>;
using Triangles = std::set<std::array<Point_id, 3>>;

void insert(Triangles& triangles, std::array<Point_id, 3> corners) {
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  EXPECT_TRUE(triangles.insert(corners).second) << "a triangle that is there twice";
}

Triangles triangles_of(const Static_delaunay& triangulation) {
  Triangles result;
  for (const auto& face : triangulation.faces) insert(result, face.vertices);
  return result;
}

Triangles all_at_once(const Places& places) {
  using Triangulation = CGAL::Delaunay_triangulation_2<
      Kernel, CGAL::Triangulation_data_structure_2<
                  CGAL::Triangulation_vertex_base_with_info_2<Point_id, Kernel>>>;
  std::vector<std::pair<Kernel::Point_2, Point_id>> points;
  for (const Vector_2& place : places) {
    points.emplace_back(Kernel::Point_2(place.x, place.y), static_cast<Point_id>(points.size()));
  }
  Triangulation triangulation(points.begin(), points.end());
  triangulation.infinite_vertex()->info() = no_point;
  Triangles result;
  for (const auto face : triangulation.all_face_handles()) {
    insert(result, {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return result;
}

// What is wrong with the links of faces; empty if nothing is. Neighbor i has the two vertices but
// vertex i, in the other direction, and this face beyond them.
std::string problem_of_links(const Static_delaunay& triangulation) {
  for (std::size_t f = 0; f < triangulation.faces.size(); ++f) {
    const auto& face = triangulation.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.neighbors[i] >= triangulation.faces.size()) return "no neighbor";
      const auto& beyond = triangulation.faces[face.neighbors[i]];
      std::size_t k = 0;
      while (k < 3 && (beyond.neighbors[k] != f ||
                       beyond.vertices[(k + 1) % 3] != face.vertices[(i + 2) % 3] ||
                       beyond.vertices[(k + 2) % 3] != face.vertices[(i + 1) % 3])) {
        ++k;
      }
      if (k == 3) return "the neighbor of face " + std::to_string(f) + " has another one";
    }
  }
  return {};
}

Places uniform(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-50, 50);
  Places result;
  while (result.size() < n) {
    const double x = place(random);
    const double y = place(random);
    result.push_back({x, y});
  }
  return result;
}

// Most places are in some clusters, a thousand times smaller than the distances between these.
Places clustered(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> distance(0, 1);
  Places result;
  while (result.size() < n) {
    const double x = distance(random);
    const double y = distance(random);
    const double cluster = static_cast<double>(random() % 5);
    result.push_back({x + 1000 * cluster * cluster, y + 1000 * cluster});
  }
  return result;
}

// Some places of a lattice, many of which are cocircular.
Places of_lattice(int side, std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  Places result;
  for (int i = 0; i < side * side; ++i) {
    result.push_back({static_cast<double>(i % side), static_cast<double>(i / side)});
  }
  std::ranges::shuffle(result, random);
  result.resize(std::min(n, result.size()));
  return result;
}

// Whether all finite triangles turn left, and no place beyond an edge is inside of a circle. The
// coordinates are small integers.
bool is_delaunay(const Places& places, const Static_delaunay& triangulation) {
  const auto point = [&](Point_id id) { return Kernel::Point_2(places[id].x, places[id].y); };
  const auto is_infinite = [](const Static_delaunay::Face& face) {
    return std::ranges::find(face.vertices, no_point) != face.vertices.end();
  };
  for (const auto& face : triangulation.faces) {
    if (is_infinite(face)) continue;
    const auto& [p, q, r] = face.vertices;
    if (CGAL::orientation(point(p), point(q), point(r)) != CGAL::LEFT_TURN) return false;
    for (const std::uint32_t g : face.neighbors) {
      if (is_infinite(triangulation.faces[g])) continue;
      for (const Point_id s : triangulation.faces[g].vertices) {
        if (CGAL::side_of_oriented_circle(point(p), point(q), point(r), point(s)) ==
            CGAL::ON_POSITIVE_SIDE) {
          return false;
        }
      }
    }
  }
  return true;
}

void expect_those_of_all_at_once(const Places& places, std::size_t cells) {
  const Static_delaunay found = static_delaunay_by_cells(places, cells);
  ASSERT_FALSE(found.faces.empty());
  EXPECT_EQ(problem_of_links(found), "");
  EXPECT_EQ(triangles_of(found), all_at_once(places));
  std::vector<Point_id> order = found.order;
  std::ranges::sort(order);
  for (std::size_t id = 0; id < places.size(); ++id) ASSERT_EQ(order[id], id);
}

TEST(Static_delaunay_by_cells, has_the_triangles_of_all_places) {
  for (unsigned seed = 1; seed <= test::cases(4u); ++seed) {
    for (const std::size_t cells : {1u, 2u, 3u, 7u, 16u}) {
      SCOPED_TRACE(std::to_string(cells) + " cells, seed " + std::to_string(seed));
      expect_those_of_all_at_once(uniform(4000 + seed, seed), cells);
      expect_those_of_all_at_once(clustered(4000 + seed, seed), cells);
    }
  }
}

// Either there is none, or it is right: mostly half of the places are on the border.
TEST(Static_delaunay_by_cells, of_few_places_is_right_or_empty) {
  std::size_t made = 0;
  for (unsigned seed = 1; seed <= test::cases(1000u); ++seed) {
    const Places places = uniform(1 + seed % 300, seed);
    const Static_delaunay found = static_delaunay_by_cells(places, 1 + seed % 7);
    if (found.faces.empty()) continue;
    ++made;
    EXPECT_EQ(problem_of_links(found), "") << "seed " << seed;
    ASSERT_EQ(triangles_of(found), all_at_once(places)) << "seed " << seed;
  }
  EXPECT_GT(made, 100U);
}

// The cells may take other diagonals than the border.
TEST(Static_delaunay_by_cells, of_a_lattice_is_right_or_empty) {
  std::size_t made = 0;
  const auto check = [&made](const Places& places, std::size_t cells) {
    const Static_delaunay found = static_delaunay_by_cells(places, cells);
    if (found.faces.empty()) return;
    ++made;
    ASSERT_EQ(problem_of_links(found), "");
    ASSERT_EQ(found.faces.size(), 2 * places.size() - 2);
    ASSERT_TRUE(is_delaunay(places, found));
  };
  for (unsigned seed = 1; seed <= test::cases(750u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const int side = 12 + static_cast<int>(seed % 20);
    check(of_lattice(side, 100 + seed % 900, seed), 1 + seed % 5);
  }
  EXPECT_GT(made, 100U);
}

TEST(Static_delaunay_by_cells, of_equal_places_or_of_a_line_is_empty) {
  Places equal = uniform(2000, 1);
  equal.push_back(equal[77]);
  EXPECT_TRUE(static_delaunay_by_cells(equal, 4).faces.empty());
  Places line;
  for (int i = 0; i < 1000; ++i) line.push_back({double(i), 2.0 * i});
  EXPECT_TRUE(static_delaunay_by_cells(line, 4).faces.empty());
  EXPECT_TRUE(static_delaunay_by_cells({}, 4).faces.empty());
}

// Many places, which are divided into cells whatever the number of threads.
TEST(Static_delaunay_by_cells, does_not_depend_on_threads) {
  const Places places = uniform(70000, 3);
  const auto made_by = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return detail::static_delaunay({places, {}, 0, 0});
  };
  const Static_delaunay one = made_by(1);
  const Static_delaunay four = made_by(4);
  ASSERT_EQ(one.faces.size(), 2 * places.size() - 2);
  ASSERT_EQ(one.faces.size(), four.faces.size());
  for (std::size_t f = 0; f < one.faces.size(); ++f) {
    ASSERT_EQ(one.faces[f].vertices, four.faces[f].vertices);
    ASSERT_EQ(one.faces[f].neighbors, four.faces[f].neighbors);
  }
  EXPECT_EQ(one.order, four.order);
  EXPECT_EQ(problem_of_links(one), "");
  EXPECT_EQ(triangles_of(one), all_at_once(places));
}

TEST(Kd_cells, are_one_or_more) {
  EXPECT_PRECONDITION_ERROR(detail::Kd_cells({}, 0), "a plane without cells");
  EXPECT_EQ(detail::Kd_cells({}, 3).cells().size(), 3U);
}

TEST(Kd_cells, contain_the_places_that_are_in_them) {
  const Places places = clustered(5000, 9);
  for (const std::size_t count : {1u, 2u, 3u, 10u, 64u}) {
    const detail::Kd_cells plane(places, count);
    ASSERT_EQ(plane.cells().size(), count);
    std::vector<std::size_t> sizes(count);
    for (const Vector_2& place : places) {
      const std::size_t number = plane.cell_of(place);
      ++sizes.at(number);
      for (std::size_t other = 0; other < count; ++other) {
        const auto& [least, greatest] = plane.cells()[other];
        const bool is_inside = least.x <= place.x && place.x < greatest.x && least.y <= place.y &&
                               place.y < greatest.y;
        ASSERT_EQ(is_inside, other == number);
      }
    }
    // The sample is all places, which are distinct.
    const auto [least, greatest] = std::ranges::minmax(sizes);
    EXPECT_LE(greatest - least, 2 + count / 4);
  }
}

}  // namespace
}  // namespace kinetri::static_delaunay_test
