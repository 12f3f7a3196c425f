// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flips.
#include <gtest/gtest.h>

#include <array>
#include <tuple>
#include <vector>

#include "support/torus_points.h"
#include "support/torus_reference.h"

namespace kinetri::torus_flips_test {
namespace {

using test::Face;
using test::turn;
using test::torus::Box;
using test::torus::Edge;
using test::torus::edge_names;
using test::torus::edges_of;
using test::torus::Face_handle;
using test::torus::faces_of;
using test::torus::Offset;
using test::torus::Point;
using test::torus::Random;
using test::torus::random_box;
using test::torus::random_points;
using test::torus::reference;
using test::torus::Torus;
using test::torus::torus_of;
using test::torus::Vertex_handle;

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

TEST(Torus_triangulation, is_the_same_after_a_flip_forth_and_back) {
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
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
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
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
  for (unsigned seed = 1; seed <= test::cases(100u); ++seed) {
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

}  // namespace
}  // namespace kinetri::torus_flips_test
