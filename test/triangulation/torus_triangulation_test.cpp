// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that come and go.
#include "kinetri/impl/triangulation/torus_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/incident.h"
#include "support/precondition_error.h"
#include "support/torus_points.h"
#include "support/torus_reference.h"

namespace kinetri::torus_triangulation_test {
namespace {

using test::Face;
using test::torus::Box;
using test::torus::edge_names;
using test::torus::Face_handle;
using test::torus::faces_of;
using test::torus::Offset;
using test::torus::Place;
using test::torus::Point;
using test::torus::Random;
using test::torus::random_box;
using test::torus::random_points;
using test::torus::reference;
using test::torus::Torus;
using test::torus::torus_of;
using test::torus::Traits;
using test::torus::Vertex_handle;

TEST(Torus_triangulation, is_empty_without_points) {
  Torus torus;
  EXPECT_EQ(torus.dimension(), -1);
  EXPECT_EQ(torus.number_of_vertices(), 0u);
  EXPECT_EQ(torus.problem(), "");
  EXPECT_TRUE(torus.is_delaunay());
  EXPECT_PRECONDITION_ERROR(torus.locate(Point(0, {0, 0})),
                            "there are no points; expected at least one");
}

// The corners of a square are on a circle; the product xy makes the diagonal.
TEST(Torus_triangulation, of_one_point_has_three_loops) {
  Torus torus{Traits(Box{{4, 0}, {0, 4}})};
  const Vertex_handle v = torus.insert(Point(0, {1, 1}));
  EXPECT_EQ(torus.dimension(), 2);
  EXPECT_EQ(torus.number_of_vertices(), 1u);
  EXPECT_EQ(torus.problem(), "");
  const std::set<std::tuple<Point_id, Point_id, Offset>> names = {
      {0, 0, {0, 1}}, {0, 0, {1, -1}}, {0, 0, {1, 0}}};
  EXPECT_EQ(edge_names(torus), names);
  int corners = 0;
  detail::for_each_face_at(torus, v, [&](Face_handle, int) { ++corners; });
  EXPECT_EQ(corners, 6);
  EXPECT_EQ(torus.edges_opposite(v).size(), 6u);
}

TEST(Torus_triangulation, of_one_point_is_that_of_a_reduced_basis) {
  for (unsigned seed = 1; seed <= test::cases(300u); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const std::vector<Point> points = {Point(0, {random(-9, 9), random(-9, 9)})};
    const Torus torus = torus_of(box, points);
    ASSERT_EQ(torus.problem(), "") << "seed " << seed;
    ASSERT_EQ(faces_of(torus), reference(box, points)) << "seed " << seed;
  }
}

TEST(Torus_triangulation, begins_with_any_vectors_that_span_the_lattice) {
  const std::int64_t shear = 1'000'000'007;
  const Box box{{1, 0}, {shear, 1}};
  Torus torus{Traits(box)};
  const auto insert_first = [&](const Torus::Basis& basis) {
    const Vertex_handle v = torus.tds().create_vertex();
    v->set_point(Point(0, {0, 0}));
    torus.insert_first(v, basis);
  };
  EXPECT_PRECONDITION_ERROR(
      insert_first({{{1, 0}, {0, -1}}}),
      "the two vectors do not span the lattice; expected offsets whose determinant is 1");
  EXPECT_EQ(torus.dimension(), -1);
  insert_first({{{1, 0}, {-static_cast<std::int32_t>(shear) + 3, 1}}});
  EXPECT_EQ(torus.problem(), "");
  EXPECT_TRUE(torus.is_delaunay());
  EXPECT_EQ(faces_of(torus), reference(box, {Point(0, {0, 0})}));
  EXPECT_PRECONDITION_ERROR(insert_first({{{1, 0}, {0, 1}}}),
                            "the triangulation is not empty; expected no vertices");
}

TEST(Torus_triangulation, of_random_points_is_delaunay_in_any_order_of_insertion) {
  for (unsigned seed = 1; seed <= test::cases(140u); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    std::vector<Point> points = random_points(random, box, 1 + seed % 6);
    const std::vector<Face> expected = reference(box, points);
    ASSERT_EQ(expected.size(), 2 * points.size()) << "seed " << seed;
    for (int order = 0; order < 3; ++order) {
      const Torus torus = torus_of(box, points);
      ASSERT_EQ(torus.problem(), "") << "seed " << seed;
      ASSERT_EQ(faces_of(torus), expected) << "seed " << seed;
      ASSERT_EQ(torus.number_of_vertices(), points.size());
      ASSERT_EQ(edge_names(torus).size(), 3 * points.size()) << "seed " << seed;
      std::rotate(points.begin(), points.begin() + 1, points.end());
    }
  }
}

TEST(Torus_triangulation, remains_delaunay_when_points_come_and_go) {
  int removals = 0;
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const std::vector<Point> all = random_points(random, box, 6);
    Torus torus{Traits(box)};
    std::map<Point_id, Vertex_handle> there;
    for (int step = 0; step < 20; ++step) {
      const Point& point = all[random.index(all.size())];
      if (const auto found = there.find(point.id()); found != there.end()) {
        ASSERT_TRUE(torus.remove_from_faces(found->second)) << "seed " << seed;
        EXPECT_EQ(found->second->face(), Face_handle());
        torus.tds().delete_vertex(found->second);
        there.erase(found);
        ++removals;
      } else {
        there[point.id()] = torus.insert(point);
      }
      std::vector<Point> points;
      for (const auto& [id, v] : there) points.push_back(v->point());
      ASSERT_EQ(torus.problem(), "") << "seed " << seed << ", step " << step;
      ASSERT_EQ(torus.number_of_vertices(), points.size());
      ASSERT_EQ(faces_of(torus), reference(box, points)) << "seed " << seed << ", step " << step;
    }
  }
  EXPECT_GT(removals, 500);
}

TEST(Torus_triangulation, has_only_faces_that_turn_left_after_an_insertion_without_flips) {
  std::map<Torus::Locate_type, int> found;
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const std::vector<Point> points = random_points(random, box, 2 + seed % 5);
    if (points.size() < 2) continue;
    Torus torus = torus_of(box, {points.begin(), points.end() - 1});
    const Vertex_handle v = torus.tds().create_vertex();
    v->set_point(points.back());
    const Torus::Location location = torus.locate(v->point());
    torus.insert_in_faces(v, location);
    ++found[location.locus];
    ASSERT_EQ(torus.problem(), "") << "seed " << seed;
    torus.restore_delaunay(torus.edges_opposite(v));
    ASSERT_EQ(faces_of(torus), reference(box, points)) << "seed " << seed;
  }
  for (const auto locus : {Torus::EDGE, Torus::FACE}) EXPECT_GT(found[locus], 10);
}

TEST(Torus_triangulation, of_many_points_does_not_depend_on_the_others_that_have_been_there) {
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    Random random(seed);
    const Box box{{100'000, 3}, {70'000, 90'001}};
    std::vector<Point> points;
    for (Point_id id = 0; id < 200; ++id) {
      points.emplace_back(id, Place{random(0, 400'000), random(0, 400'000)});
    }
    Torus torus = torus_of(box, points);
    EXPECT_EQ(torus.problem(), "") << "seed " << seed;
    EXPECT_TRUE(torus.is_delaunay()) << "seed " << seed;
    std::vector<Vertex_handle> leaving;
    for (const Vertex_handle v : torus.tds().vertex_handles()) {
      if (v->point().id() % 2 == 1) leaving.push_back(v);
    }
    for (const Vertex_handle v : leaving) ASSERT_TRUE(torus.remove_from_faces(v));
    EXPECT_EQ(torus.problem(), "") << "seed " << seed;
    EXPECT_TRUE(torus.is_delaunay()) << "seed " << seed;
    std::erase_if(points, [](const Point& point) { return point.id() % 2 == 1; });
    std::ranges::reverse(points);
    EXPECT_EQ(faces_of(torus), faces_of(torus_of(box, points))) << "seed " << seed;
  }
}

TEST(Torus_triangulation, keeps_a_removed_vertex_for_another_insertion) {
  const Box box{{3, 0}, {0, 3}};
  Torus torus{Traits(box)};
  const Vertex_handle first = torus.insert(Point(0, {0, 0}));
  const Vertex_handle second = torus.insert(Point(1, {1, 1}));
  const std::vector<Face> before = faces_of(torus);
  ASSERT_TRUE(torus.remove_from_faces(second));
  EXPECT_EQ(torus.problem(), "");
  EXPECT_EQ(torus.number_of_vertices(), 1u);
  const Torus::Location location = torus.locate(second->point());
  torus.insert_in_faces(second, location);
  torus.restore_delaunay(torus.edges_opposite(second));
  EXPECT_EQ(faces_of(torus), before);
  ASSERT_TRUE(torus.remove_from_faces(first));
  ASSERT_TRUE(torus.remove_from_faces(second));
  EXPECT_EQ(torus.dimension(), -1);
  torus.insert_first(first);
  EXPECT_EQ(faces_of(torus), reference(box, {first->point()}));
}

TEST(Torus_triangulation, gives_the_vertex_that_is_in_the_place_of_a_point) {
  const Box box{{3, 1}, {1, 2}};
  Torus torus = torus_of(box, {Point(0, {0, 0}), Point(1, {1, 0})});
  const std::vector<Face> before = faces_of(torus);
  const Point image(2, {1 + 4 * 3 - 5, 4 - 5 * 2});
  const Vertex_handle v = torus.insert(image);
  EXPECT_EQ(v->point().id(), 1u);
  EXPECT_EQ(torus.tds().number_of_vertices(), 2u);
  EXPECT_EQ(faces_of(torus), before);
  const Vertex_handle other = torus.tds().create_vertex();
  other->set_point(image);
  EXPECT_PRECONDITION_ERROR(torus.insert_in_faces(other, torus.locate(image)),
                            "there is a vertex at the location; expected a face or an edge");
}

TEST(Torus_triangulation, keeps_handles_when_it_is_moved) {
  const Box box{{5, 0}, {1, 4}};
  const std::vector<Point> points = {Point(0, {0, 0}), Point(1, {1, 3}), Point(2, {2, 1})};
  Torus torus = torus_of(box, points);
  const Vertex_handle v = torus.insert(Point(3, {3, 3}));
  Torus moved = std::move(torus);
  ASSERT_TRUE(moved.remove_from_faces(v));
  EXPECT_EQ(moved.problem(), "");
  EXPECT_EQ(faces_of(moved), reference(box, points));
}

}  // namespace
}  // namespace kinetri::torus_triangulation_test
