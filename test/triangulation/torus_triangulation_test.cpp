// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/torus_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/base/error.h"
#include "support/message_of.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"
#include "support/torus_reference.h"
#include "triangulation/torus_triangulation_impl.h"

namespace kinetri::torus_triangulation_test {
namespace {

using Offset = Lattice_offset_2;

using test::cross;
using test::Face;
using test::floor_of_quotient;
using test::Image;
using test::in_circle;
using test::normal_form;
using test::turn;
using test::Vector;

using Place = Vector<std::int64_t>;
using Box = test::Box<std::int64_t>;

/// Points at rest with integer coordinates.
class Traits {
 public:
  class Point_2 {
   public:
    Point_2() = default;
    Point_2(Point_id id, const Place& place) : id_(id), place_(place) {}
    Point_id id() const { return id_; }
    const Place& place() const { return place_; }

   private:
    Point_id id_ = no_point;
    Place place_{0, 0};
  };
  using Image_2 = Vector<Integer>;
  struct Orientation_2 {
    CGAL::Orientation operator()(const Image_2& p, const Image_2& q, const Image_2& r) const {
      return static_cast<CGAL::Orientation>(turn(p, q, r));
    }
  };
  struct Side_of_oriented_circle_2 {
    CGAL::Oriented_side operator()(const Image_2& p, const Image_2& q, const Image_2& r,
                                   const Image_2& s) const {
      return static_cast<CGAL::Oriented_side>(in_circle(p, q, r, s));
    }
  };

  Traits() = default;
  explicit Traits(const Box& box) : box_(box) {}

  Image_2 image(const Point_2& point, const Offset& offset) const {
    const auto coordinate = [&](std::int64_t p, std::int64_t a, std::int64_t b) {
      return Integer(p) + Integer(offset.x) * a + Integer(offset.y) * b;
    };
    return {coordinate(point.place().x, box_.first.x, box_.second.x),
            coordinate(point.place().y, box_.first.y, box_.second.y)};
  }
  Orientation_2 orientation_2_object() const { return {}; }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }

 private:
  Box box_;
};

using Torus = detail::Torus_triangulation<Traits>;
using Point = Traits::Point_2;
using Vertex_handle = Torus::Vertex_handle;
using Face_handle = Torus::Face_handle;
using Edge = Torus::Edge;

Image image_of(Face_handle face, int i) {
  return {face->vertex(i)->point().id(), Torus::offset(face, i).x, Torus::offset(face, i).y};
}

/// Sorted. A face that is there twice is there twice.
std::vector<Face> faces_of(const Torus& torus) {
  std::vector<Face> result;
  for (const Face_handle face : torus.tds().face_handles()) {
    result.push_back(normal_form({image_of(face, 0), image_of(face, 1), image_of(face, 2)}));
  }
  std::ranges::sort(result);
  return result;
}

/// The faces of the Delaunay triangulation by brute force, sorted, each once.
std::vector<Face> reference(const Box& box, const std::vector<Point>& points) {
  std::vector<test::Placed_point<std::int64_t>> places;
  for (const Point& point : points) places.emplace_back(point.id(), point.place());
  return test::reference(box, places);
}

bool coincide(const Box& box, const Place& p, const Place& q) {
  const std::int64_t area = cross(box.first, box.second);
  return cross(p - q, box.second) % area == 0 && cross(box.first, p - q) % area == 0;
}

// ---- random cases ----

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  std::int64_t operator()(std::int64_t least, std::int64_t greatest) {
    return least + static_cast<std::int64_t>(generator_() %
                                             static_cast<std::uint64_t>(greatest - least + 1));
  }
  std::size_t index(std::size_t size) { return generator_() % size; }

 private:
  std::mt19937_64 generator_;
};

/// On tiny lattices, on which most sets of four images are on a circle; many of them sheared by
/// several times their width.
Box random_box(Random& random) {
  const std::int64_t range = std::array{1, 2, 4, 9}[random.index(4)];
  for (;;) {
    Box box{{random(0, range), random(-range, range)}, {random(-range, range), random(0, range)}};
    if (random(0, 2) == 0) {
      const std::int64_t shear = random(-40, 40);
      box.second = {box.second.x + shear * box.first.x, box.second.y + shear * box.first.y};
    }
    if (random(0, 2) == 0) box.first = {box.first.x * random(1, 30), box.first.y};
    if (cross(box.first, box.second) > 0) return box;
  }
}

/// Up to `count` points, some boxes away; fewer if the lattice has less room.
std::vector<Point> random_points(Random& random, const Box& box, std::size_t count) {
  std::vector<Point> result;
  for (std::size_t tries = 0; tries < 20 && result.size() < count; ++tries) {
    const Place place{random(-20, 20), random(-20, 20)};
    const auto is_there = [&](const Point& p) { return coincide(box, p.place(), place); };
    if (std::ranges::any_of(result, is_there)) continue;
    result.emplace_back(static_cast<Point_id>(result.size()), place);
  }
  return result;
}

Torus torus_of(const Box& box, const std::vector<Point>& points) {
  Torus torus{Traits(box)};
  for (const Point& point : points) {
    EXPECT_EQ(torus.insert(point)->point().id(), point.id());
  }
  return torus;
}

std::vector<Edge> edges_of(const Torus& torus) {
  std::vector<Edge> result;
  for (const Face_handle face : torus.tds().face_handles()) {
    for (int i = 0; i < 3; ++i) result.emplace_back(face, i);
  }
  return result;
}

/// Whether both new faces would turn left.
bool is_flippable(const Torus& torus, const Edge& edge) {
  const auto& [f, i] = edge;
  const auto [n, j] = Torus::mirror(edge);
  const Offset b = Torus::offset(f, Torus::cw(i), Torus::ccw(i));
  const Offset c = Torus::offset(f, Torus::cw(i), i);
  const Offset d = Torus::offset(n, Torus::ccw(j), j);
  const auto at = [&](Vertex_handle v, Offset o) {
    return torus.geom_traits().image(v->point(), o);
  };
  const auto pa = at(f->vertex(Torus::cw(i)), {});
  const auto pb = at(f->vertex(Torus::ccw(i)), b);
  const auto pc = at(f->vertex(i), c);
  const auto pd = at(n->vertex(j), d);
  return turn(pc, pb, pd) > 0 && turn(pd, pa, pc) > 0;
}

/// Unordered pairs of ids with the offset of the second against the first.
std::set<std::tuple<Point_id, Point_id, Offset>> edge_names(const Torus& torus) {
  std::set<std::tuple<Point_id, Point_id, Offset>> result;
  for (const auto& [face, i] : edges_of(torus)) {
    Point_id a = face->vertex(Torus::cw(i))->point().id();
    Point_id b = face->vertex(Torus::ccw(i))->point().id();
    Offset offset = Torus::offset(face, Torus::cw(i), Torus::ccw(i));
    if (b < a || (a == b && offset < Offset{})) {
      std::swap(a, b);
      offset = {-offset.x, -offset.y};
    }
    result.emplace(a, b, offset);
  }
  return result;
}

unsigned times(unsigned number) {
  return number * static_cast<unsigned>(test::multiplier());
}

// ---- two faces by hand ----

/// Adds a vertex with the faces of the two halves of the box, whose neighbors no vertex tells
/// apart.
Vertex_handle add_box(Torus& torus, Point_id id) {
  const Vertex_handle v = torus.tds().create_vertex();
  v->set_point(Point(id, {0, 0}));
  const Face_handle f = torus.tds().create_face(v, v, v);
  const Face_handle g = torus.tds().create_face(v, v, v);
  f->set_offsets({1, 0}, {1, 1});
  g->set_offsets({1, 1}, {0, 1});
  const auto link = [](Face_handle a, int i, Face_handle b, int j) {
    a->set_neighbor(i, b);
    a->set_mirror(i, j);
    b->set_neighbor(j, a);
    b->set_mirror(j, i);
  };
  link(f, 0, g, 1);
  link(f, 1, g, 2);
  link(f, 2, g, 0);
  v->set_face(f);
  return v;
}

TEST(Torus_triangulation, follows_edges_by_their_indices) {
  Torus torus{Traits(Box{{6, 0}, {0, 7}})};
  const Vertex_handle v = add_box(torus, 0);
  const Face_handle f = v->face();
  const Face_handle g = f->neighbor(0);
  EXPECT_EQ(torus.problem(), "");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(Torus::mirror(Edge(f, i)), Edge(g, Torus::ccw(i)));
    EXPECT_EQ(Torus::mirror(Edge(g, Torus::ccw(i))), Edge(f, i));
  }
  std::vector<Edge> corners;
  const auto visit = [&](Face_handle face, int i) { corners.emplace_back(face, i); };
  detail::for_each_face_at(torus, v, visit);
  const std::vector<Edge> expected = {Edge(f, 0), Edge(g, 0), Edge(f, 1),
                                      Edge(g, 1), Edge(f, 2), Edge(g, 2)};
  EXPECT_EQ(corners, expected);
  // The opposite sides of the box are one edge each.
  const Edge flipped = torus.flip(Edge(f, 1));
  EXPECT_EQ(torus.problem(), "");
  EXPECT_EQ(faces_of(torus), (std::vector{normal_form({{{0, 1, 0}, {0, 1, 1}, {0, 0, 1}}}),
                                          normal_form({{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}})}));
  torus.flip(flipped);
  EXPECT_EQ(torus.problem(), "");
}

// ---- points come and go ----

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
  for (unsigned seed = 1; seed <= times(150); ++seed) {
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
  for (unsigned seed = 1; seed <= times(200); ++seed) {
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
  for (unsigned seed = 1; seed <= times(50); ++seed) {
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
  for (unsigned seed = 1; seed <= times(50); ++seed) {
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
  for (unsigned seed = 1; seed <= times(2); ++seed) {
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

TEST(Torus_triangulation, is_the_same_after_a_flip_forth_and_back) {
  for (unsigned seed = 1; seed <= times(50); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    Torus torus = torus_of(box, random_points(random, box, 1 + seed % 6));
    const std::vector<Face> before = faces_of(torus);
    for (const Edge& edge : edges_of(torus)) {
      if (!is_flippable(torus, edge)) continue;
      const Edge flipped = torus.flip(edge);
      ASSERT_EQ(torus.problem(), "") << "seed " << seed;
      ASSERT_NE(faces_of(torus), before) << "seed " << seed;
      torus.flip(flipped);
      ASSERT_EQ(torus.problem(), "") << "seed " << seed;
      ASSERT_EQ(faces_of(torus), before) << "seed " << seed;
    }
  }
}

TEST(Torus_triangulation, keeps_the_outer_edges_of_a_flip_where_it_says) {
  for (unsigned seed = 1; seed <= times(50); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    Torus torus = torus_of(box, random_points(random, box, 1 + seed % 6));
    const std::vector<Edge> edges = edges_of(torus);
    const auto& [f, i] = edges[random.index(edges.size())];
    const auto [n, j] = Torus::mirror(Edge(f, i));
    const auto ends = [](Face_handle face, int k) {
      const Offset offset = Torus::offset(face, Torus::ccw(k), Torus::cw(k));
      return std::tuple(face->vertex(Torus::ccw(k)), face->vertex(Torus::cw(k)), offset);
    };
    const std::array before = {ends(f, Torus::cw(i)), ends(n, Torus::ccw(j)), ends(n, Torus::cw(j)),
                               ends(f, Torus::ccw(i))};
    const Edge flipped = torus.flip(Edge(f, i));
    EXPECT_EQ(flipped, Edge(f, Torus::ccw(i)));
    EXPECT_EQ(Torus::mirror(flipped), Edge(n, Torus::ccw(j)));
    const std::array after = {ends(f, Torus::cw(i)), ends(f, i), ends(n, Torus::cw(j)), ends(n, j)};
    ASSERT_EQ(after, before) << "seed " << seed;
  }
}

TEST(Torus_triangulation, becomes_delaunay_after_random_flips) {
  int flips = 0;
  int with_one_edge_on_both_sides = 0;
  for (unsigned seed = 1; seed <= times(100); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const std::vector<Point> points = random_points(random, box, 1 + seed % 6);
    Torus torus = torus_of(box, points);
    for (int k = 0; k < 40; ++k) {
      const std::vector<Edge> edges = edges_of(torus);
      const Edge edge = edges[random.index(edges.size())];
      if (!is_flippable(torus, edge)) continue;
      const Edge there = Torus::mirror(edge);
      const Edge left(edge.first, Torus::ccw(edge.second));
      const Edge right(there.first, Torus::ccw(there.second));
      if (Torus::mirror(left) == right) ++with_one_edge_on_both_sides;
      ++flips;
      torus.flip(edge);
      ASSERT_EQ(torus.problem(), "") << "seed " << seed;
      ASSERT_EQ(edge_names(torus).size(), 3 * points.size()) << "seed " << seed;
    }
    torus.restore_delaunay(edges_of(torus));
    ASSERT_EQ(torus.problem(), "") << "seed " << seed;
    ASSERT_TRUE(torus.is_delaunay());
    ASSERT_EQ(faces_of(torus), reference(box, points)) << "seed " << seed;
  }
  EXPECT_GT(flips, 1000);
  EXPECT_GT(with_one_edge_on_both_sides, 100);
}

// The walk in which each corner is once, and each face is to the left of the one before.
TEST(Torus_triangulation, walks_around_vertices_counterclockwise) {
  int with_loops = 0;
  for (unsigned seed = 1; seed <= times(50); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const Torus torus = torus_of(box, random_points(random, box, 1 + seed % 6));
    std::set<Edge> corners;
    for (const Vertex_handle v : torus.tds().vertex_handles()) {
      std::vector<std::pair<Vertex_handle, Offset>> right;
      std::vector<std::pair<Vertex_handle, Offset>> left;
      detail::for_each_face_at(torus, v, [&](Face_handle face, int i) {
        ASSERT_EQ(face->vertex(i), v);
        ASSERT_TRUE(corners.emplace(face, i).second) << "seed " << seed;
        right.emplace_back(face->vertex(Torus::ccw(i)), Torus::offset(face, i, Torus::ccw(i)));
        left.emplace_back(face->vertex(Torus::cw(i)), Torus::offset(face, i, Torus::cw(i)));
        if (right.back().first == v) ++with_loops;
      });
      std::rotate(right.begin(), right.begin() + 1, right.end());
      ASSERT_EQ(left, right) << "seed " << seed;
    }
    ASSERT_EQ(corners.size(), 3 * torus.tds().faces().size()) << "seed " << seed;
  }
  EXPECT_GT(with_loops, 100);
}

TEST(Torus_triangulation, locates_each_image_of_a_position_from_each_face) {
  std::map<Torus::Locate_type, int> found;
  for (unsigned seed = 1; seed <= times(30); ++seed) {
    Random random(seed);
    const Box box = random_box(random);
    const Torus torus = torus_of(box, random_points(random, box, 1 + seed % 6));
    const Point query(99, {random(-20, 20), random(-20, 20)});
    std::map<std::pair<Face_handle, int>, Offset> offsets;
    for (const Face_handle start : torus.tds().face_handles()) {
      const Offset offset{static_cast<std::int32_t>(random(-9, 9)),
                          static_cast<std::int32_t>(random(-9, 9))};
      const Torus::Location at = torus.locate(query, start, offset);
      ++found[at.locus];
      // The image that is found is in the closed face, and the locus is its smallest part there.
      const auto corner = [&](int i) {
        return torus.geom_traits().image(at.face->vertex(i)->point(), Torus::offset(at.face, i));
      };
      const auto place = torus.geom_traits().image(query, at.offset);
      std::set<int> zeros;
      for (int i = 0; i < 3; ++i) {
        const int side = turn(corner(Torus::ccw(i)), corner(Torus::cw(i)), place);
        ASSERT_GE(side, 0) << "seed " << seed;
        if (side == 0) zeros.insert(i);
      }
      if (at.locus == Torus::FACE) {
        ASSERT_EQ(zeros, (std::set<int>{}));
        const auto& [first, is_new] = offsets.emplace(std::pair(at.face, 0), at.offset);
        ASSERT_EQ(first->second, at.offset) << "one image of a point is in a face";
        ASSERT_EQ(offsets.size(), 1u) << "and it is always in the same face";
      } else if (at.locus == Torus::EDGE) {
        ASSERT_EQ(zeros, std::set<int>{at.index});
      } else {
        ASSERT_EQ(zeros, (std::set<int>{Torus::ccw(at.index), Torus::cw(at.index)}));
        ASSERT_TRUE(coincide(box, query.place(), at.face->vertex(at.index)->point().place()));
        ASSERT_EQ(place, corner(at.index));
      }
    }
  }
  for (const auto locus : {Torus::VERTEX, Torus::EDGE, Torus::FACE}) EXPECT_GT(found[locus], 10);
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

// ---- offsets of more than 32 bits ----

constexpr std::int32_t greatest = 2'147'483'647;

std::string too_long(const std::string& of, const std::string& against, const std::string& offset) {
  return "the image of point " + of + " next to point " + against + " is moved by (" + offset +
         ") vectors of the box; expected less than 2^31 of each: give positions that are closer "
         "together, or stop before the points or the box have moved so far";
}

TEST(Torus_triangulation, refuses_first_vectors_with_an_offset_of_more_than_32_bits) {
  // Shortest vectors: (greatest, 1) and (1, 0), of which the sum has too great an offset.
  const Box box{{1, 0}, {-greatest, 1}};
  Torus torus{Traits(box)};
  const Vertex_handle v = torus.tds().create_vertex();
  v->set_point(Point(7, {0, 0}));
  EXPECT_EQ(test::message_of<Error>([&] {
              torus.insert_first(v, {{{1, 0}, {greatest, 1}}});
            }),
            too_long("7", "7", "2147483648, 1"));
  EXPECT_EQ(torus.dimension(), -1);
  torus.insert_first(v, {{{1, 0}, {greatest - 1, 1}}});
  EXPECT_EQ(torus.problem(), "");
  EXPECT_TRUE(torus.is_delaunay());
  const std::set<std::tuple<Point_id, Point_id, Offset>> names = {
      {7, 7, {1, 0}}, {7, 7, {greatest - 1, 1}}, {7, 7, {greatest, 1}}};
  EXPECT_EQ(edge_names(torus), names);
}

TEST(Torus_triangulation, refuses_a_flip_to_an_offset_of_more_than_32_bits_and_stays_as_it_is) {
  const Box box{{1, 0}, {-greatest, 1}};
  Torus torus{Traits(box)};
  const Vertex_handle v = torus.tds().create_vertex();
  v->set_point(Point(7, {0, 0}));
  torus.insert_first(v, {{{1, 0}, {greatest - 1, 1}}});
  const std::vector<Face> before = faces_of(torus);
  int refused = 0;
  for (const Edge& edge : edges_of(torus)) {
    const int x = Torus::offset(edge.first, Torus::cw(edge.second), Torus::ccw(edge.second)).x;
    if (x != greatest - 1 && x != 1 - greatest) continue;
    const std::string message = test::message_of<Error>([&] { torus.flip(edge); });
    EXPECT_TRUE(message == too_long("7", "7", "2147483648, 1") ||
                message == too_long("7", "7", "-2147483648, -1"))
        << message;
    EXPECT_EQ(torus.problem(), "");
    EXPECT_EQ(faces_of(torus), before);
    ++refused;
  }
  EXPECT_EQ(refused, 2);
}

TEST(Torus_triangulation, refuses_a_walk_beyond_32_bits) {
  const Torus torus = torus_of(Box{{2, 0}, {0, 2}}, {Point(4, {0, 0})});
  const Face_handle start = torus.tds().faces().begin();
  // The image is near if the position and the offset cancel.
  const auto locate = [&](std::int64_t boxes) {
    torus.locate(Point(5, {-2 * boxes, 1}), start, {greatest, 0});
  };
  EXPECT_EQ(test::message_of<Error>([&] { locate(greatest); }), "");
  const std::string message = test::message_of<Error>([&] { locate(std::int64_t{greatest} + 9); });
  EXPECT_EQ(message.substr(0, message.find(',')),
            "the image of point 5 next to point 4 is moved by (2147483648");
}

// Of a point in a face or on an edge, with an offset that is just possible against corner 0, but
// not against the corner of the face, or beyond the edge, that is one box further.
TEST(Torus_triangulation, refuses_an_insertion_beyond_32_bits_and_stays_as_it_is) {
  Torus torus = torus_of(Box{{6, 0}, {0, 6}}, {Point(4, {0, 0})});
  const std::vector<Face> before = faces_of(torus);
  std::map<Torus::Locate_type, int> refused;
  const auto insert = [&](Torus::Locate_type locus, const Edge& edge, int sign,
                          const Place& inside) {
    const Offset offset{sign * greatest, 0};
    const Point point(5, {inside.x - 6 * std::int64_t{offset.x}, inside.y});
    ASSERT_EQ(torus.locate(point, edge.first, offset).locus, locus);
    const std::string message =
        test::message_of<Error>([&] { torus.insert(point, edge.first, offset); });
    EXPECT_EQ(message.substr(0, message.find(',')),
              std::string("the image of point 5 next to point 4 is moved by (") +
                  (sign < 0 ? "-" : "") + "2147483648");
    EXPECT_EQ(faces_of(torus), before);
    EXPECT_EQ(torus.problem(), "");
    EXPECT_EQ(torus.tds().number_of_vertices(), 1u) << "a refused point leaves no vertex";
    ++refused[locus];
  };
  for (const Edge& edge : edges_of(torus)) {
    const auto& [face, i] = edge;
    const auto [neighbor, j] = Torus::mirror(edge);
    const Offset right = Torus::offset(face, Torus::ccw(i));
    const Offset left = Torus::offset(face, Torus::cw(i));
    const Offset here = Torus::offset(face, i);
    const Offset beyond = Torus::offset(neighbor, Torus::cw(j), j);
    for (const int sign : {-1, 1}) {
      const int least = sign * std::min({sign * right.x, sign * left.x, sign * here.x});
      if (sign * least < 0) {
        insert(Torus::FACE, edge, sign,
               {2 * (right.x + left.x + here.x), 2 * (right.y + left.y + here.y)});
      } else if (sign * (right.x + beyond.x) < 0) {
        insert(Torus::EDGE, edge, sign, {3 * (right.x + left.x), 3 * (right.y + left.y)});
      }
    }
  }
  EXPECT_GT(refused[Torus::FACE], 0);
  EXPECT_GT(refused[Torus::EDGE], 0);
}

// ---- the checks ----

TEST(Torus_triangulation, finds_what_is_wrong) {
  const auto expect = [&](const std::string& end, const auto& change) {
    Torus torus =
        torus_of(Box{{6, 0}, {0, 7}}, {Point(0, {0, 0}), Point(1, {2, 1}), Point(2, {1, 5})});
    EXPECT_EQ(torus.problem(), "");
    change(torus, Face_handle(torus.tds().faces().begin()));
    EXPECT_TRUE(torus.problem().ends_with(end)) << torus.problem();
  };
  expect("does not fit its neighbor at edge 0",
         [](Torus&, Face_handle f) { f->set_mirror(0, Torus::ccw(f->mirror(0))); });
  expect("does not fit its neighbor at edge 1",
         [](Torus&, Face_handle f) { f->set_neighbor(1, f->neighbor(0)); });
  expect("does not fit its neighbor at edge 0", [](Torus&, Face_handle f) {
    f->set_offsets({f->offset(1).x + 1, f->offset(1).y}, f->offset(2));
  });
  expect("does not fit its neighbor at edge 1", [](Torus&, Face_handle f) {
    f->set_vertex(0, f->vertex(f->vertex(0) == f->vertex(1) ? 2 : 1));
  });
  expect("does not turn left", [](Torus&, Face_handle f) {
    f->vertex(0)->set_point(Point(f->vertex(0)->point().id(), {60, 60}));
  });
  expect("has no such corner", [](Torus& torus, Face_handle f) {
    const Vertex_handle v = torus.tds().create_vertex();
    v->set_face(f);
  });
}

TEST(Torus_triangulation, finds_faces_that_cover_the_torus_more_than_once) {
  Torus torus{Traits(Box{{6, 0}, {0, 7}})};
  add_box(torus, 0);
  EXPECT_EQ(torus.problem(), "");
  const Vertex_handle v = add_box(torus, 1);
  EXPECT_EQ(torus.problem(), "the faces have 4 times half the area of the box; expected 2");
  v->set_face(Face_handle());
  EXPECT_EQ(torus.problem(), "1 vertices have 4 faces; expected twice as many as vertices");
}

}  // namespace
}  // namespace kinetri::torus_triangulation_test
