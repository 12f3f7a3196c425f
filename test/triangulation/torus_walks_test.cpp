// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks along the links of faces, and the checks of these.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/triangulation/incident.h"
#include "support/torus_points.h"
#include "support/torus_reference.h"

namespace kinetri::torus_walks_test {
namespace {

using test::normal_form;
using test::turn;
using test::torus::Box;
using test::torus::coincide;
using test::torus::Edge;
using test::torus::Face_handle;
using test::torus::faces_of;
using test::torus::Offset;
using test::torus::Point;
using test::torus::Random;
using test::torus::random_box;
using test::torus::random_points;
using test::torus::Torus;
using test::torus::torus_of;
using test::torus::Traits;
using test::torus::Vertex_handle;

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

// The walk in which each corner is once, and each face is to the left of the one before.
TEST(Torus_triangulation, walks_around_vertices_counterclockwise) {
  int with_loops = 0;
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
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
  for (unsigned seed = 1; seed <= test::cases(60u); ++seed) {
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
}  // namespace kinetri::torus_walks_test
