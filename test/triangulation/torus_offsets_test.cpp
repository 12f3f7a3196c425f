// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets of more than 32 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/base/error.h"
#include "support/message_of.h"
#include "support/torus_points.h"
#include "support/torus_reference.h"

namespace kinetri::torus_offsets_test {
namespace {

using test::Face;
using test::torus::Box;
using test::torus::Edge;
using test::torus::edge_names;
using test::torus::edges_of;
using test::torus::Face_handle;
using test::torus::faces_of;
using test::torus::Offset;
using test::torus::Place;
using test::torus::Point;
using test::torus::Torus;
using test::torus::torus_of;
using test::torus::Traits;
using test::torus::Vertex_handle;

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

}  // namespace
}  // namespace kinetri::torus_offsets_test
