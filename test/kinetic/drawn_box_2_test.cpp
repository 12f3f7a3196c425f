// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box of pictures. All numbers are multiples of 1/64, with which binary64 is exact.
#include "kinetri/impl/kinetic/drawn_box_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kinetri::drawn_box_2_test {
namespace {

Vector_2 sum(const Vector_2& a, double k, const Vector_2& u, double l, const Vector_2& v) {
  return {a.x + k * u.x + l * v.x, a.y + k * u.y + l * v.y};
}

// Sides that are powers of two, so that quotients are exact.
Periodic_box_2 box(double tilt, double rate) {
  return {{{8, 0}, {0, 0}}, {{tilt, 4}, {rate, 0}}};
}

TEST(Drawn_box, leans_by_half_of_its_first_side_at_most) {
  const Drawn_box_2 square(box(0, 1), 0);
  EXPECT_EQ(square.first(), (Vector_2{8, 0}));
  EXPECT_EQ(square.second(), (Vector_2{0, 4}));
  EXPECT_EQ(square.corners(), (std::array<Vector_2, 4>{Vector_2{0, 0}, {8, 0}, {8, 4}, {0, 4}}));
  EXPECT_EQ(Drawn_box_2(box(0, 1), 3).second(), (Vector_2{3, 4}));
  EXPECT_EQ(Drawn_box_2(box(0, 1), 5).second(), (Vector_2{-3, 4}));
  EXPECT_EQ(Drawn_box_2(box(-2, 1), 85).second(), (Vector_2{3, 4}));
  // A box that lies on its side.
  const Drawn_box_2 other({{{0, 8}, {0, 0}}, {{-4, 21}, {0, 0}}}, 0);
  EXPECT_EQ(other.second(), (Vector_2{-4, -3}));
}

TEST(Drawn_box, has_one_image_of_each_point) {
  std::mt19937 random(5);
  const auto number = [&random](int most) {
    return std::uniform_int_distribution<int>(-64 * most, 64 * most)(random) / 64.0;
  };
  for (int i = 0; i < 500; ++i) {
    const Drawn_box_2 drawn(box(number(20), 0), 0);
    const Vector_2 place = {number(100), number(100)};
    const auto [inside, moves] = drawn.image(place);
    EXPECT_EQ(inside, sum(place, moves.x, drawn.first(), moves.y, drawn.second()));
    EXPECT_EQ(moves.x, std::floor(moves.x));
    EXPECT_EQ(moves.y, std::floor(moves.y));
    const double part = inside.y / 4;
    EXPECT_TRUE(part >= 0 && part < 1) << inside.y;
    const double along = inside.x - part * drawn.second().x;
    EXPECT_TRUE(along >= 0 && along < 8) << along;
  }
}

TEST(Drawn_box, leads_along_edges_and_motions) {
  std::mt19937 random(6);
  const auto whole = [&random](int most) {
    return std::uniform_int_distribution<int>(-most, most)(random);
  };
  const Periodic_box_2 sheared = box(3, 2);
  for (int i = 0; i < 500; ++i) {
    const double time = whole(9);
    const Drawn_box_2 drawn(sheared, time);
    const Vector_2 u = rounded_place(sheared.first(), time);
    const Vector_2 v = rounded_place(sheared.second(), time);
    const Vector_2 p = {whole(640) / 64.0, whole(640) / 64.0};
    const Vector_2 q = {whole(640) / 64.0, whole(640) / 64.0};
    const Lattice_offset_2 offset = {whole(5), whole(5)};
    const auto from = drawn.image(p);
    const auto to = drawn.image(q);
    const Vector_2 shift = drawn.shift(offset, from, to);
    const Vector_2 end = sum(q, offset.x, u, offset.y, v);
    EXPECT_EQ(to.place.x + shift.x - from.place.x, end.x - p.x);
    EXPECT_EQ(to.place.y + shift.y - from.place.y, end.y - p.y);
    const Vector_2 move = drawn.move(from, u, v);
    EXPECT_EQ(from.place, sum(p, 1, move, 0, {}));
  }
}

TEST(Drawn_box, is_right_for_numbers_of_all_sizes) {
  for (const double unit : {1e-300, 1.0, 1e300}) {
    const Drawn_box_2 drawn({{{unit, 0}, {0, 0}}, {{2.25 * unit, unit}, {0, 0}}}, 0);
    EXPECT_DOUBLE_EQ(drawn.second().x, 0.25 * unit);
    const Vector_2 place = drawn.image({-0.5 * unit, 0.5 * unit}).place;
    EXPECT_DOUBLE_EQ(place.x, 0.5 * unit);
    EXPECT_DOUBLE_EQ(place.y, 0.5 * unit);
  }
}

}  // namespace
}  // namespace kinetri::drawn_box_2_test
