// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of frames: what is drawn, and where.
#include "kinetri/io/svg_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "support/text.h"

namespace kinetri::svg_frame_test {
namespace {

using test::between;
using test::count;

std::string picture(const Frame_2& frame, const Svg_view& view) {
  std::ostringstream out;
  write_svg_frame(out, frame, view);
  return out.str();
}

std::string lines(const std::string& text, const std::string& name) {
  return between(between(text, "<path class=\"" + name + "\"", "/>"), "d=\"", "\"");
}

// A square with a point in the middle.
Frame_2 square() {
  Frame_2 frame;
  frame.time = 0.1;
  frame.ids = {0, 1, 2, 3, 7};
  frame.places = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 5}};
  frame.velocities.resize(5);
  frame.edges = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  frame.hull = {{0, 1}, {0, 3}, {1, 2}, {2, 3}};
  frame.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 3, 4}};
  frame.events[static_cast<std::size_t>(Event_kind::flip)] = 3;
  frame.events[static_cast<std::size_t>(Event_kind::wall)] = 4;
  return frame;
}

// The square fills the height of 672 pixels below a margin of 24.
TEST(Svg_frame, draws_each_edge_and_point_where_it_is) {
  const std::string svg = picture(square(), {.extent = {0, 0, 10, 10}, .points = 5});
  EXPECT_NE(svg.find("width=\"720\" height=\"752\" viewBox=\"0 0 720 752\""), std::string::npos);
  EXPECT_EQ(lines(svg, "edges"), "M24 696L360 360M696 696L360 360M696 24L360 360M24 24L360 360");
  EXPECT_EQ(lines(svg, "hull"), "M24 696L696 696M24 696L24 24M696 696L696 24M696 24L24 24");
  const std::string points = between(svg, "<g class=\"points\"", "</g>");
  EXPECT_EQ(count(points, "<circle "), 5U);
  EXPECT_NE(points.find("cx=\"24\" cy=\"696\""), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"discs\""), 0U);
  EXPECT_EQ(count(svg, "class=\"box\""), 0U);
  EXPECT_NE(svg.find(">t = 0.1</text>"), std::string::npos);
  EXPECT_NE(svg.find(">5 points, 7 events</text>"), std::string::npos);
}

TEST(Svg_frame, draws_discs_and_box) {
  Frame_2 frame = square();
  frame.discs.emplace(5, Frame_2::Disc{2});
  const std::string svg =
      picture(frame, {.extent = {0, 0, 10, 10}, .box = Box_2{0, 0, 10, 10}, .radius = 2});
  // 14 units are 672 pixels now: discs at the sides are seen as a whole.
  const std::string discs = between(svg, "<g class=\"discs\"", "</g>");
  EXPECT_EQ(count(discs, "r=\"96\""), 5U);
  EXPECT_NE(discs.find("cx=\"120\" cy=\"600\""), std::string::npos) << discs;
  EXPECT_NE(svg.find("<rect class=\"box\" x=\"120\" y=\"120\" width=\"480\" height=\"480\""),
            std::string::npos)
      << svg;
  EXPECT_EQ(count(svg, "<circle "), 10U);
  EXPECT_EQ(count(svg, "class=\"hidden"), 0U);
}

TEST(Svg_frame, draws_discs_of_any_size_and_hidden_points) {
  Frame_2 frame = square();
  frame.ids.push_back(9);
  frame.places.push_back({5, 6});
  frame.velocities.emplace_back();
  frame.discs = {{1}, {0.5}, {0}, {0.25}, {4}, {1.5, true}};
  const std::string svg = picture(frame, {.extent = {0, 0, 10, 10}, .radius = 4});
  const std::string discs = between(svg, "<g class=\"discs\"", "</g>");
  EXPECT_EQ(count(discs, "<circle "), 5U);
  // 18 units are 672 pixels.
  EXPECT_NE(discs.find("cx=\"360\" cy=\"360\" r=\"149.33\""), std::string::npos) << discs;
  EXPECT_NE(discs.find("r=\"0\""), std::string::npos) << discs;
  const std::string hidden_discs = between(svg, "<g class=\"hidden-discs\"", "</g>");
  EXPECT_NE(hidden_discs.find("fill=\"none\""), std::string::npos) << hidden_discs;
  EXPECT_EQ(count(hidden_discs, "<circle "), 1U);
  EXPECT_NE(hidden_discs.find("cx=\"360\" cy=\"322.67\" r=\"56\""), std::string::npos)
      << hidden_discs;
  EXPECT_EQ(count(between(svg, "<g class=\"points\"", "</g>"), "<circle "), 5U);
  EXPECT_EQ(count(between(svg, "<g class=\"hidden-points\"", "</g>"), "<circle "), 1U);
  // Below a point that may be in the same place.
  EXPECT_LT(svg.find("class=\"hidden-points\""), svg.find("class=\"points\""));
}

TEST(Svg_frame, has_one_size_for_one_view_in_even_pixels) {
  for (const Box_2 extent :
       {Box_2{0, 0, 1, 1}, Box_2{-3, 0, 8, 3}, Box_2{0, 0, 0, 0}, Box_2{0, 5, 0, 9},
        Box_2{5, 0, 9, 0}, Box_2{-1e308, -1e308, 1e308, 1e308}, Box_2{0, 0, 5e-324, 5e-324}}) {
    const std::string one = picture(square(), {.extent = extent});
    const std::string other = picture(Frame_2(), {.extent = extent});
    const std::string size = between(one, "<svg ", ">");
    EXPECT_EQ(between(other, "<svg ", ">"), size);
    for (const char* side : {" width=\"", " height=\""}) {
      const double pixels = std::stod(between(size, side, "\""));
      EXPECT_EQ(std::fmod(pixels, 2), 0) << size;
      EXPECT_GE(pixels, 200) << size;
      EXPECT_LE(pixels, 960) << size;
    }
  }
}

TEST(Svg_frame, of_no_points_has_none) {
  const std::string svg = picture(Frame_2(), {.extent = {0, 0, 1, 1}});
  EXPECT_EQ(lines(svg, "edges"), "");
  EXPECT_EQ(lines(svg, "hull"), "");
  EXPECT_EQ(count(svg, "<circle "), 0U);
  EXPECT_NE(svg.find(">0 points, 0 events</text>"), std::string::npos);
}

TEST(Svg_frame, leaves_out_what_is_nowhere) {
  Frame_2 frame = square();
  frame.places[4] = {std::numeric_limits<double>::infinity(), 5};
  const std::string svg = picture(frame, {.extent = {0, 0, 10, 10}});
  EXPECT_EQ(lines(svg, "edges"), "");
  EXPECT_EQ(count(svg, "<circle "), 4U);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Svg_frame, places_are_right_for_numbers_of_all_sizes) {
  for (const double unit : {1e-300, 1e-9, 1e9, 1e300, 1.7e308}) {
    for (const double lower : {0.0, -unit, unit / 2}) {
      Frame_2 frame = square();
      const auto moved = [&](double x) { return (1 - x / 10) * lower + x / 10 * unit; };
      for (Vector_2& place : frame.places) place = {moved(place.x), moved(place.y)};
      const std::string svg = picture(frame, {.extent = {lower, lower, unit, unit}});
      EXPECT_EQ(lines(svg, "edges"),
                "M24 696L360 360M696 696L360 360M696 24L360 360M24 24L360 360");
    }
  }
}

TEST(Svg_frame, has_finer_lines_where_there_are_more_points) {
  const auto width = [](std::size_t points) {
    const std::string svg = picture(square(), {.extent = {0, 0, 10, 10}, .points = points});
    return std::stod(between(svg, "stroke-width=\"", "\""));
  };
  EXPECT_GT(width(100), width(10'000));
  EXPECT_GT(width(1'000'000), 0);
}

TEST(Svg_frame, draws_edges_that_leave_a_periodic_box_at_both_ends) {
  Frame_2 frame;
  frame.ids = {0, 1};
  frame.places = {{1, 5}, {9, 5}};
  frame.velocities.resize(2);
  frame.edges = {{0, 1}, {0, 1}};
  frame.periodic = {{Vector_2{0, 0}, {10, 0}, {12, 10}, {2, 10}}, {{0, 0}, {-10, 0}}, {}};
  // 14 units of width are 672 pixels, as are 14 of height: 48 pixels each.
  const std::string svg = picture(frame, {.extent = {-1, -2, 13, 12}, .points = 2});
  const auto drawn = [](double x, double y) {
    std::ostringstream out;
    out << 24 + 48 * (x + 1) << ' ' << 24 + 48 * (12 - y);
    return out.str();
  };
  EXPECT_EQ(lines(svg, "edges"), "M" + drawn(1, 5) + "L" + drawn(9, 5));
  EXPECT_EQ(lines(svg, "leaving-edges"),
            "M" + drawn(1, 5) + "L" + drawn(-1, 5) + "M" + drawn(9, 5) + "L" + drawn(11, 5));
  EXPECT_EQ(count(between(svg, "<g class=\"images\"", "</g>"), "<circle "), 2U);
  EXPECT_EQ(count(between(svg, "<g class=\"points\"", "</g>"), "<circle "), 2U);
  EXPECT_NE(svg.find("<path class=\"box\" d=\"M" + drawn(0, 0) + "L" + drawn(10, 0) + "L" +
                     drawn(12, 10) + "L" + drawn(2, 10) + "Z\""),
            std::string::npos)
      << svg;
  EXPECT_EQ(count(svg, "class=\"hull\""), 0U);
  EXPECT_EQ(count(svg, "disc-images"), 0U);
}

TEST(Svg_frame, draws_images_of_discs_that_reach_into_a_periodic_box) {
  Frame_2 frame;
  frame.ids = {0, 1, 2};
  frame.places = {{5, 5}, {0.5, 4}, {9.5, 9.5}};
  frame.velocities.resize(3);
  frame.discs = {{1, false}, {1, false}, {1, false}};
  frame.periodic = {{Vector_2{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}, {}};
  const std::string svg = picture(frame, {.extent = {-2, -2, 12, 12}, .points = 3});
  const auto drawn = [](double x, double y) {
    std::ostringstream out;
    out << "<circle cx=\"" << 24 + 48 * (x + 2) << "\" cy=\"" << 24 + 48 * (12 - y)
        << "\" r=\"48\"/>\n";
    return out.str();
  };
  EXPECT_EQ(count(between(svg, "<g class=\"discs\"", "</g>"), "<circle "), 3U);
  const std::string images = between(svg, "<g class=\"disc-images\"", "</g>");
  EXPECT_EQ(count(images, "<circle "), 4U) << images;
  for (const std::string& image :
       {drawn(10.5, 4), drawn(-0.5, 9.5), drawn(9.5, -0.5), drawn(-0.5, -0.5)}) {
    EXPECT_NE(images.find(image), std::string::npos) << image << images;
  }
}

}  // namespace
}  // namespace kinetri::svg_frame_test
