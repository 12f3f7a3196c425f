// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <vector>

#include "kinetri/impl/triangulation/twins.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/kinetic_parts.h"

namespace kinetri::twins_test {
namespace {

using Twins = detail::Kinetic_types<Linear_kinetic_traits_2>::Twins;
using Ids = std::vector<Point_id>;

TEST(Coincident_groups, have_the_least_id_as_root) {
  detail::Coincident_groups groups;
  groups.link(7, 3);
  groups.link(5, 9);
  groups.link(9, 7);
  groups.link(8, 6);
  EXPECT_EQ(groups.number_of_points(), 6u);
  EXPECT_EQ(groups.least(9), 3u);
  EXPECT_EQ(groups.others(), (std::vector<Edge_ids>{{3, 5}, {3, 7}, {6, 8}, {3, 9}}));
}

Linear_kinetic_traits_2::Point_2 resting(Point_id id) {
  return Linear_kinetic_traits_2::Point_2(test::resting(1, 1), id);
}

TEST(Twins, are_hidden_by_one_point_after_groups_join) {
  Twins twins;
  EXPECT_TRUE(twins.empty());
  twins.hide(resting(5), 2);
  twins.hide(resting(4), 2);
  twins.hide(resting(2), 0);
  EXPECT_EQ(twins.size(), 3u);
  EXPECT_EQ(twins.hidden_by(0), (Ids{2, 4, 5}));
  EXPECT_EQ(twins.hidden_by(2), Ids());
  EXPECT_EQ(twins.twin(5).shown, 0u);
}

TEST(Twins, are_hidden_by_the_next_one_when_the_first_leaves) {
  Twins twins;
  for (const Point_id id : {3u, 6u, 8u}) twins.hide(resting(id), 1);
  twins.take_out(6);
  EXPECT_FALSE(twins.contains(6));
  EXPECT_EQ(twins.hidden_by(1), (Ids{3, 8}));
  twins.show(3);
  EXPECT_FALSE(twins.contains(3));
  EXPECT_EQ(twins.hidden_by(1), Ids());
  EXPECT_EQ(twins.hidden_by(3), Ids{8});
  EXPECT_EQ(twins.twin(8).shown, 3u);
  twins.show(8);
  EXPECT_TRUE(twins.empty());
}

}  // namespace
}  // namespace kinetri::twins_test
