// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/walkable_area.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "support/message_of.h"

namespace kinetri::walkable_area_test {
namespace {

Walkable_area area_of(const std::string& text) {
  return Walkable_area::from_wkt(text, "room.wkt");
}

std::string problem_of(const std::string& text) {
  return test::message_of<Input_error>([&] { area_of(text); });
}

constexpr const char* edges_cross =
    " crosses another edge, or runs along it; expected edges that share single positions at most";

TEST(WalkableArea, of_a_polygon_with_a_hole_is_what_the_text_says) {
  const auto room = area_of(
      "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (2 1, 2 2, 3 2, 3 1, 2 1), (5 1,6 1,6 3,5 1))");
  EXPECT_EQ(room.number_of_polygons(), 1u);
  EXPECT_EQ(room.area(), 50 - 1 - 1);
  EXPECT_EQ(room.extent(), (Box_2{0, 0, 10, 5}));
  EXPECT_TRUE(room.contains({1, 1}));
  EXPECT_TRUE(room.contains({0, 5}));    // a corner
  EXPECT_TRUE(room.contains({2, 1.5}));  // the wall of the hole
  EXPECT_FALSE(room.contains({2.5, 1.5}));
  EXPECT_FALSE(room.contains({10.5, 1}));
  EXPECT_TRUE(room.contains({5.5, 2}));  // on the slanted wall
  EXPECT_FALSE(room.contains({5.5, 2 - 0x1p-50}));
}

TEST(WalkableArea, is_read_from_each_kind_of_text) {
  const std::string one = "((0 0, 1 0, 1 1, 0 1, 0 0))";
  const std::string other = "((3 0, 3 2, 5 2, 5 0, 3 0))";
  EXPECT_EQ(area_of("MULTIPOLYGON (" + one + ", " + other + ")").area(), 5);
  EXPECT_EQ(area_of("GEOMETRYCOLLECTION (POLYGON " + one + ", POLYGON" + other + ")").area(), 5);
  EXPECT_EQ(area_of("GEOMETRYCOLLECTION(GEOMETRYCOLLECTION(POLYGON " + one +
                    ", GEOMETRYCOLLECTION "
                    "EMPTY), MULTIPOLYGON(" +
                    other + "))")
                .area(),
            5);
  EXPECT_EQ(area_of("geometrycollection(multipolygon(" + one + "),polygon empty)\n").area(), 1);
  EXPECT_EQ(area_of("POLYGON((+0.0 -0,1.e0 0,1 1,\n1 1,0 1e0,0 0))").area(), 1);
  EXPECT_EQ(area_of("MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 8 1, 8 8, 1 8, 1 1)), "
                    "((2 2, 7 2, 7 7, 2 7, 2 2)))")
                .area(),
            81 - 49 + 25);  // one in the hole of the other
}

TEST(WalkableArea, may_touch_itself_in_single_positions) {
  // Two polygons at a corner; a hole at a wall, and one at a corner of another one.
  EXPECT_EQ(area_of("MULTIPOLYGON(((0 0,1 0,1 1,0 1,0 0)),((1 1,2 1,2 2,1 2,1 1)))").area(), 2);
  EXPECT_EQ(area_of("POLYGON((0 0,8 0,8 8,0 8,0 0),(4 0,5 2,3 2,4 0),(4 4,5 2,6 4,4 4))").area(),
            64 - 2 - 2);
}

TEST(WalkableArea, says_where_a_text_is_wrong) {
  EXPECT_EQ(problem_of("LINESTRING (0 0, 1 1)"),
            "room.wkt:1: column 1: 'LINESTRING' stands here; expected POLYGON, MULTIPOLYGON, or "
            "GEOMETRYCOLLECTION of these");
  EXPECT_EQ(problem_of(""),
            "room.wkt:1: column 1: the text ends here; expected POLYGON, MULTIPOLYGON, or "
            "GEOMETRYCOLLECTION of these");
  std::string deep;
  for (int i = 0; i < 101; ++i) deep += "GEOMETRYCOLLECTION(";
  EXPECT_EQ(problem_of(deep),
            "room.wkt:1: column 1901: 'GEOMETRYCOLLECTION' stands here; expected POLYGON or "
            "MULTIPOLYGON, since collections are nested 100 deep here");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0,\n 1, 0 1, 0 0))"),
            "room.wkt:2: column 3: ',' stands here; expected a finite coordinate of at most 1e150");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0 7, 1 1, 0 0))"),
            "room.wkt:1: column 20: '7' stands here; expected , or )");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 nan, 1 1, 0 0))"),
            "room.wkt:1: column 18: 'nan' stands here; expected a finite coordinate of at most "
            "1e150");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 1e151, 1 1, 0 0))"),
            "room.wkt:1: column 18: '1e151' stands here; expected a finite coordinate of at most "
            "1e150");
  EXPECT_EQ(
      problem_of("POLYGON ((0 0, 1x 0, 1 1, 0 0))"),
      "room.wkt:1: column 17: 'x' stands here; expected a blank, a comma or ) after a number");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0, 1 1, 0 0)"),
            "room.wkt:1: column 30: the text ends here; expected , or )");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0, 1 1, 0 0)) POLYGON"),
            "room.wkt:1: column 32: the text goes on after its end; expected nothing more");
  EXPECT_EQ(problem_of("POLYGON (0 0, 1 0, 1 1, 0 0)"),
            "room.wkt:1: column 10: '0' stands here; expected ( and the positions of a ring");
  EXPECT_EQ(problem_of("POLYGON Z ((0 0, 1 0, 1 1, 0 0))"),
            "room.wkt:1: column 9: 'Z' stands here; expected ( or EMPTY");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0, 1 1, 0 1))"),
            "room.wkt:1: column 11: a ring ends elsewhere than it begins; expected the first "
            "position again at its end");
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0, 0 0))"),
            "room.wkt:1: column 11: a ring has 2 different positions; expected three or more");
  EXPECT_EQ(problem_of("MULTIPOLYGON EMPTY"),
            "room.wkt:1: column 19: there is no polygon; expected one or more");
}

TEST(WalkableArea, says_which_rings_bound_no_area) {
  EXPECT_EQ(problem_of("POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"),
            std::string("room.wkt: polygon 1: the edge from (2 0) to (0 2)") + edges_cross);
  EXPECT_EQ(problem_of("POLYGON ((0 0, 1 0, 2 0, 0 0))"),
            std::string("room.wkt: polygon 1: the edge from (2 0) to (0 0)") + edges_cross);
  EXPECT_EQ(problem_of("POLYGON ((0 0,4 0,4 4,0 4,0 0),(1 1,2 1,2 9,1 1))"),
            std::string("room.wkt: polygon 1, hole 1: the edge from (2 1) to (2 9)") + edges_cross);
  // A hole with a wall in common with the outer ring; two rooms with a wall in common.
  EXPECT_EQ(problem_of("POLYGON ((0 0,4 0,4 4,0 4,0 0),(1 0,2 0,2 1,1 0))"),
            std::string("room.wkt: polygon 1, hole 1: the edge from (1 0) to (2 0)") + edges_cross);
  EXPECT_EQ(problem_of("MULTIPOLYGON(((0 0,1 0,1 1,0 1,0 0)),((1 0,2 0,2 1,1 1,1 0)))"),
            std::string("room.wkt: polygon 2: the edge from (1 1) to (1 0)") + edges_cross);
  EXPECT_EQ(problem_of("POLYGON ((0 0,4 0,4 4,0 4,0 0),(5 5,6 5,6 6,5 5))"),
            "room.wkt: polygon 1, hole 1 is outside of its polygon, or overlaps another hole; "
            "expected holes inside of polygons that do not overlap");
  EXPECT_EQ(problem_of("POLYGON ((0 0,9 0,9 9,0 9,0 0),(1 1,8 1,8 8,1 1),(5 4,6 4,6 5,5 4))"),
            "room.wkt: polygon 1, hole 2 is outside of its polygon, or overlaps another hole; "
            "expected holes inside of polygons that do not overlap");
  EXPECT_EQ(problem_of("MULTIPOLYGON(((0 0,9 0,9 9,0 9,0 0)),((1 1,2 1,2 2,1 2,1 1)))"),
            "room.wkt: polygon 2 overlaps another polygon; expected polygons that do not overlap");
}

TEST(WalkableArea, of_vertices_is_their_polygon_in_either_direction) {
  const std::vector<Vector_2> clockwise = {{0, 0}, {0, 4}, {4, 4}, {4, 3}, {1, 3}, {1, 0}};
  EXPECT_EQ(Walkable_area(clockwise).area(), 7);
  const auto problem = [](const std::vector<Vector_2>& polygon) {
    return test::message_of<Precondition_error>([&] { Walkable_area{polygon}; });
  };
  EXPECT_EQ(problem({{0, 0}, {2, 2}, {2, 0}, {0, 2}}),
            std::string("polygon 1: the edge from (2 0) to (0 2)") + edges_cross);
  EXPECT_NE(problem({{0, 0}, {1, 0}}).find("a polygon with 2 vertices"), std::string::npos);
  EXPECT_NE(problem({{0, 0}, {1, 0}, {1, 1}, {0, 0}}).find("named twice"), std::string::npos);
  EXPECT_NE(problem({{0, 0}, {1, 0}, {1, 1e300}}).find("beyond"), std::string::npos);
}

}  // namespace
}  // namespace kinetri::walkable_area_test
