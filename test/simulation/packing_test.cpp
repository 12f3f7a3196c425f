// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packings: their shares and sizes, and that no two discs overlap, by a look at all pairs; in a
// periodic box, at all pairs of images.
#include "kinetri/simulation/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <tuple>

#include "kinetri/algebra/number_types.h"
#include "support/precondition_error.h"

namespace kinetri::packing_test {
namespace {

void expect_apart(const Packing& packing) {
  const auto& discs = packing.discs;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto [x, y] = discs[i].position;
    const Rational r = to_rational(discs[i].radius);
    for (const double place : {x, y}) {
      EXPECT_GE(to_rational(place), r);
      EXPECT_LE(to_rational(place) + r, to_rational(packing.box.xmax));
    }
    for (std::size_t k = 0; k < i; ++k) {
      const Rational dx = to_rational(x) - to_rational(discs[k].position.x);
      const Rational dy = to_rational(y) - to_rational(discs[k].position.y);
      const Rational contact = r + to_rational(discs[k].radius);
      EXPECT_GE(dx * dx + dy * dy, contact * contact) << i << " and " << k;
    }
  }
}

// Centers are in the box: so images that are two boxes apart are further apart than discs are wide.
void expect_images_apart(const Packing& packing) {
  const auto& discs = packing.discs;
  const Rational side = to_rational(packing.box.xmax);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto [x, y] = discs[i].position;
    for (const double place : {x, y}) {
      EXPECT_GE(place, 0);
      EXPECT_LT(place, packing.box.xmax);
    }
    const Rational r = to_rational(discs[i].radius);
    EXPECT_LE(2 * r, side);
    for (std::size_t k = 0; k <= i; ++k) {
      for (int image = 0; image < 9; ++image) {
        if (k == i && image == 4) continue;
        const Rational dx =
            to_rational(x) - to_rational(discs[k].position.x) + (image % 3 - 1) * side;
        const Rational dy =
            to_rational(y) - to_rational(discs[k].position.y) + (image / 3 - 1) * side;
        const Rational contact = r + to_rational(discs[k].radius);
        EXPECT_GE(dx * dx + dy * dy, contact * contact) << i << " and " << k;
      }
    }
  }
}

double share(const Packing& packing) {
  double area = 0;
  for (const Disc_motion_2& disc : packing.discs) {
    area += std::numbers::pi * disc.radius * disc.radius;
  }
  return area / (packing.box.xmax * packing.box.ymax);
}

TEST(Packing, of_equal_discs_covers_its_share_without_an_overlap) {
  Packing_options options;
  options.points = 60;
  options.share = 0.75;
  const Packing packing = make_packing(options);
  ASSERT_EQ(packing.discs.size(), 60u);
  EXPECT_NEAR(share(packing), 0.75, 1e-12);
  expect_apart(packing);
  for (const Disc_motion_2& disc : packing.discs) {
    EXPECT_EQ(disc.radius, packing.discs[0].radius);
    EXPECT_EQ(disc.growth, 0);
    EXPECT_EQ(disc.epoch, 0);
  }
}

TEST(Packing, of_two_sizes_has_their_ratio) {
  Packing_options options;
  options.points = 60;
  options.share = 0.7;
  options.size_ratio = 4;
  options.speed = 0;
  options.side = 3;
  const Packing packing = make_packing(options);
  EXPECT_NEAR(share(packing), 0.7, 1e-12);
  expect_apart(packing);
  EXPECT_DOUBLE_EQ(packing.discs[1].radius, 4 * packing.discs[0].radius);
  EXPECT_EQ(packing.box, (Box_2{0, 0, 3, 3}));
  EXPECT_EQ(packing.discs[5].velocity, (Vector_2{0, 0}));
}

TEST(Packing, is_the_same_for_the_same_seed_only) {
  Packing_options options;
  options.points = 20;
  options.share = 0.5;
  const Packing one = make_packing(options);
  EXPECT_EQ(make_packing(options).discs, one.discs);
  options.seed = 2;
  EXPECT_NE(make_packing(options).discs, one.discs);
}

TEST(Packing, of_one_disc_or_of_tiny_ones) {
  Packing_options options;
  options.points = 1;
  options.share = 0.5;
  expect_apart(make_packing(options));
  options.points = 10;
  options.share = 1e-9;
  expect_apart(make_packing(options));
}

TEST(Packing, in_a_periodic_box_covers_its_share_without_an_overlap_of_images) {
  Packing_options options;
  options.is_periodic = true;
  options.speed = 0;
  for (const auto& [points, share_of_box, ratio] :
       {std::tuple(1u, 0.75, 1.0), std::tuple(2u, 0.6, 1.0), std::tuple(3u, 0.5, 10.0),
        std::tuple(3u, 0.6, 1.0), std::tuple(40u, 0.75, 1.0), std::tuple(40u, 0.72, 2.0),
        std::tuple(10u, 1e-9, 1.0)}) {
    SCOPED_TRACE(std::to_string(points) + " points, " + std::to_string(share_of_box));
    options.points = points;
    options.share = share_of_box;
    options.size_ratio = ratio;
    const Packing packing = make_packing(options);
    ASSERT_EQ(packing.discs.size(), points);
    EXPECT_NEAR(share(packing) / share_of_box, 1, 1e-12);
    expect_images_apart(packing);
  }
}

// Some discs are at a side of the box, where walls would not let them be.
TEST(Packing, in_a_periodic_box_has_no_walls) {
  Packing_options options;
  options.points = 40;
  options.share = 0.7;
  options.is_periodic = true;
  const Packing packing = make_packing(options);
  const auto is_across = [&](const Disc_motion_2& disc) {
    const auto [x, y] = disc.position;
    return std::min({x, y, packing.box.xmax - x, packing.box.ymax - y}) < disc.radius;
  };
  EXPECT_GT(std::ranges::count_if(packing.discs, is_across), 5);
  EXPECT_EQ(make_packing(options).discs, packing.discs);
}

TEST(Packing, that_has_no_meaning_is_refused) {
  Packing_options options;
  options.points = 0;
  EXPECT_PRECONDITION_ERROR(make_packing(options), "a packing of no discs");
  options.points = 1;
  for (const double bad : {0.0, 1.0, -1.0}) {
    options.share = bad;
    EXPECT_PRECONDITION_ERROR(make_packing(options),
                              "the share of a packing is not between 0 and 1");
  }
  options.share = 0.5;
  options.size_ratio = 0.5;
  EXPECT_PRECONDITION_ERROR(make_packing(options),
                            "the ratio of the sizes of a packing is not from 1 to 1000");
}

TEST(Packing, that_cannot_be_is_given_up) {
  Packing_options options;
  options.points = 1;  // a disc in a square covers pi / 4 at most
  options.share = 0.8;
  EXPECT_THROW(make_packing(options), Packing_error);
  options.is_periodic = true;  // it meets its own image then
  EXPECT_THROW(make_packing(options), Packing_error);
  options.points = 3;
  options.share = 0.88;  // which a triangular lattice has, but not three discs in a square
  EXPECT_THROW(make_packing(options), Packing_error);
}

}  // namespace
}  // namespace kinetri::packing_test
