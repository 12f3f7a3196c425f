// SPDX-License-Identifier: GPL-3.0-or-later
//
// VTU and PVD files, read back by a few lines of one's own. test/vtk has VTK read them.
#include "kinetri/io/vtu_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace kinetri::vtu_file_test {
namespace {

std::string vtu(const Frame_2& frame) {
  std::ostringstream out;
  write_vtu(out, frame);
  return out.str();
}

// The bytes that a text in base64 stands for.
std::vector<std::uint8_t> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<bool> bits;
  for (const char c : text) {
    if (c == '=') continue;
    const std::size_t digit = digits.find(c);
    EXPECT_NE(digit, std::string::npos) << text;
    for (int bit = 5; bit >= 0; --bit) bits.push_back((digit >> static_cast<unsigned>(bit) & 1U));
  }
  EXPECT_EQ(text.size() % 4, 0U);
  std::vector<std::uint8_t> bytes(bits.size() / 8);
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] * 2 + (bits[i] ? 1 : 0));
  }
  return bytes;
}

// The numbers of the array `name`, of `size` bytes each, as patterns of bits.
std::vector<std::uint64_t> array(const std::string& text, const std::string& name,
                                 std::size_t size) {
  const auto named = text.find("Name=\"" + name + "\"");
  if (named == std::string::npos) return {404};
  const auto begin = text.find('>', named) + 1;
  const std::vector<std::uint8_t> bytes =
      decoded(text.substr(begin, text.find('<', begin) - begin));
  const auto number = [&](std::size_t first, std::size_t length) {
    std::uint64_t result = 0;
    for (std::size_t i = length; i > 0; --i) result = result << 8U | bytes.at(first + i - 1);
    return result;
  };
  EXPECT_EQ(number(0, 8), bytes.size() - 8) << name;
  std::vector<std::uint64_t> result;
  for (std::size_t i = 8; i < bytes.size(); i += size) result.push_back(number(i, size));
  return result;
}

std::vector<std::uint64_t> bits(std::initializer_list<double> numbers) {
  std::vector<std::uint64_t> result;
  for (const double number : numbers) result.push_back(std::bit_cast<std::uint64_t>(number));
  return result;
}

Frame_2 two_triangles() {
  Frame_2 frame;
  frame.time = 0.1;
  frame.ids = {0, 3, 258, 70'000};
  frame.places = {{0, -0.0}, {0.1, 1e-300}, {3, 4}, {-1, 1e300}};
  frame.velocities = {{1, 2}, {-3, 4}, {5, -6}, {std::numeric_limits<double>::denorm_min(), 0}};
  frame.triangles = {{0, 1, 2}, {0, 2, 3}};
  frame.events[static_cast<std::size_t>(Event_kind::flip)] = 5;
  frame.events[static_cast<std::size_t>(Event_kind::trajectory)] = std::uint64_t{1} << 40U;
  return frame;
}

TEST(Vtu_file, holds_every_number_exactly) {
  const Frame_2 frame = two_triangles();
  const std::string text = vtu(frame);
  EXPECT_NE(text.find("<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">"), std::string::npos);
  EXPECT_EQ(array(text, "id", 4), (std::vector<std::uint64_t>{0, 3, 258, 70'000}));
  EXPECT_EQ(array(text, "Points", 8), bits({0, -0.0, 0, 0.1, 1e-300, 0, 3, 4, 0, -1, 1e300, 0}));
  EXPECT_EQ(array(text, "velocity", 8), bits({1, 2, 0, -3, 4, 0, 5, -6, 0, 5e-324, 0, 0}));
  EXPECT_EQ(array(text, "connectivity", 8), (std::vector<std::uint64_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(array(text, "offsets", 8), (std::vector<std::uint64_t>{3, 6}));
  EXPECT_EQ(array(text, "types", 1), (std::vector<std::uint64_t>{5, 5}));
  EXPECT_EQ(array(text, "TimeValue", 8), bits({0.1}));
  EXPECT_EQ(array(text, "events", 8), (std::vector<std::uint64_t>{(std::uint64_t{1} << 40U) + 5}));
  EXPECT_EQ(array(text, "events_flip", 8), std::vector<std::uint64_t>{5});
  EXPECT_EQ(array(text, "events_trajectory", 8),
            std::vector<std::uint64_t>{std::uint64_t{1} << 40U});
  EXPECT_EQ(array(text, "events_wall", 8), std::vector<std::uint64_t>{0});
}

TEST(Vtu_file, has_radii_of_discs_only) {
  Frame_2 frame = two_triangles();
  EXPECT_EQ(vtu(frame).find("radius"), std::string::npos);
  EXPECT_EQ(vtu(frame).find("hidden"), std::string::npos);
  frame.discs = {{1.5, false}, {0, false}, {1e-300, true}, {7, false}};
  EXPECT_EQ(array(vtu(frame), "radius", 8), bits({1.5, 0, 1e-300, 7}));
  EXPECT_EQ(array(vtu(frame), "hidden", 1), (std::vector<std::uint64_t>{0, 0, 1, 0}));
}

TEST(Vtu_file, of_nothing_is_a_file_of_nothing) {
  Frame_2 frame;
  frame.discs.emplace();
  const std::string text = vtu(frame);
  EXPECT_NE(text.find("<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\">"), std::string::npos);
  for (const char* name :
       {"id", "velocity", "radius", "hidden", "Points", "connectivity", "offsets"}) {
    EXPECT_EQ(array(text, name, 8), std::vector<std::uint64_t>{}) << name;
  }
}

TEST(Pvd_file, names_each_file_with_its_time) {
  std::ostringstream out;
  write_pvd(out, std::vector<Vtu_frame>{{-1, "a.vtu"}, {0.1, "b.vtu"}, {1e300, "c.vtu"}});
  const std::string text = out.str();
  EXPECT_NE(text.find("timestep=\"-1\" group=\"\" part=\"0\" file=\"a.vtu\"/>"), std::string::npos);
  EXPECT_NE(text.find("timestep=\"0.1\" group=\"\" part=\"0\" file=\"b.vtu\"/>"),
            std::string::npos);
  EXPECT_NE(text.find("timestep=\"1e+300\" group=\"\" part=\"0\" file=\"c.vtu\"/>"),
            std::string::npos);
}

TEST(Vtu_file, has_the_images_of_a_periodic_box_as_points) {
  Frame_2 frame;
  frame.ids = {4, 7};
  frame.places = {{1, 5}, {9, 5}};
  frame.velocities = {{1, 2}, {3, 4}};
  frame.triangles = {{0, 1, 1}, {0, 0, 1}};
  frame.periodic = {{Vector_2{0, 0}, {10, 0}, {12, 10}, {2, 10}},
                    {},
                    {{Vector_2{-10, 0}, {0, 0}}, {Vector_2{2, 10}, {0, 0}}}};
  const std::string text = vtu(frame);
  EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(array(text, "id", 4), (std::vector<std::uint64_t>{4, 7, 7, 4}));
  EXPECT_EQ(array(text, "image", 1), (std::vector<std::uint64_t>{0, 0, 1, 1}));
  EXPECT_EQ(array(text, "Points", 8), bits({1, 5, 0, 9, 5, 0, -1, 5, 0, 3, 15, 0}));
  EXPECT_EQ(array(text, "velocity", 8), bits({1, 2, 0, 3, 4, 0, 3, 4, 0, 1, 2, 0}));
  EXPECT_EQ(array(text, "connectivity", 8), (std::vector<std::uint64_t>{0, 2, 1, 0, 3, 1}));
  EXPECT_EQ(array(text, "box", 8), bits({0, 0, 0, 10, 0, 0, 12, 10, 0, 2, 10, 0}));
  EXPECT_EQ(vtu(two_triangles()).find("image"), std::string::npos);
}

}  // namespace
}  // namespace kinetri::vtu_file_test
