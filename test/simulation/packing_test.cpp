// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packings: their shares and sizes, and that no two discs overlap, by a look at all pairs.
#include "kinetri/simulation/packing.h"

#include <gtest/gtest.h>

#include <numbers>

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
}

}  // namespace
}  // namespace kinetri::packing_test
