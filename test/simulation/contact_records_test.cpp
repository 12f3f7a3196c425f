// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_records.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace kinetri::contact_records_test {
namespace {

using detail::Contact_kind;
using detail::Contact_records;
using detail::Contact_subject;

Contact_subject pair(Point_id a, Point_id b) {
  return {Contact_kind::collision, a, b};
}

TEST(Contact_records, of_a_pair_say_the_same_at_both_points) {
  Contact_records records;
  records.add_event(pair(2, 5), 17);
  records.add_event(pair(2, 7), 18);
  EXPECT_EQ(records.pair_event({2, 5}), 17u);
  EXPECT_EQ(records.pair_event({5, 2}), 17u);
  records.set_event(pair(2, 5), 20);
  EXPECT_EQ(records.pair_event({2, 5}), 20u);
  EXPECT_EQ(records.pair_event({5, 2}), 20u);
  EXPECT_EQ(records.pair_event({5, 7}), no_event);
  EXPECT_EQ(records.forget_pair({2, 5}), 20u);
  EXPECT_EQ(records.forget_pair({2, 5}), no_event);
  EXPECT_EQ(records.pair_event({5, 2}), no_event);
  EXPECT_EQ(records.pair_event({7, 2}), 18u) << "another pair stays";
}

TEST(Contact_records, have_one_entry_for_the_wall_and_one_for_the_end_of_the_radius) {
  Contact_records records;
  const Contact_subject wall = {Contact_kind::wall, 3, no_point};
  const Contact_subject vanishing = {Contact_kind::vanish, 3, no_point};
  EXPECT_EQ(records.event(wall), no_event);
  records.add_event(wall, 1);
  records.add_event(vanishing, 2);
  EXPECT_EQ(records.event(wall), 1u);
  EXPECT_EQ(records.event(vanishing), 2u);
  records.forget_event(wall);
  EXPECT_EQ(records.event(wall), no_event);
  EXPECT_EQ(records.event(vanishing), 2u);
  records.set_event(vanishing, 4);
  EXPECT_EQ(records.find(3)->vanish_event, 4u);
}

TEST(Contact_records, of_one_point_may_be_forgotten_alone) {
  Contact_records records;
  records.add_event(pair(1, 4), 9);
  EXPECT_EQ(records.forget_partner(1, 4), 9u);
  EXPECT_EQ(records.pair_event({1, 4}), no_event);
  EXPECT_EQ(records.pair_event({4, 1}), 9u);
}

TEST(Contact_records, of_an_overlap_are_made_once_and_say_the_same_at_both_points) {
  Contact_records records;
  records.start_overlap(6, 1, false);
  records.start_overlap(1, 6, false);
  ASSERT_EQ(records.overlaps(1).size(), 1u);
  ASSERT_EQ(records.overlaps(6).size(), 1u);
  EXPECT_FALSE(records.find_overlap({1, 6})->is_edge);
  records.start_overlap(1, 6, true);
  for (const Edge_ids& both : {Edge_ids{1, 6}, Edge_ids{6, 1}}) {
    EXPECT_TRUE(records.find_overlap(both)->is_edge);
    EXPECT_FALSE(records.find_overlap(both)->passes);
  }
  records.start_overlap(6, 1, false);
  EXPECT_TRUE(records.find_overlap({1, 6})->is_edge) << "what is known is kept";
  records.mark_passing(1, 6, true);
  records.mark_edge({1, 6}, false);
  for (const Point_id id : {1u, 6u}) {
    EXPECT_TRUE(records.overlaps(id).front().passes);
    EXPECT_FALSE(records.overlaps(id).front().is_edge);
  }
  records.start_overlap(1, 2, true);
  records.forget_overlap(6, 1);
  EXPECT_EQ(records.find_overlap({1, 6}), nullptr);
  EXPECT_TRUE(records.overlaps(6).empty());
  EXPECT_NE(records.find_overlap({1, 2}), nullptr);
}

// In a periodic box two points are as many pairs as they have images that meet.
TEST(Contact_records, tell_images_of_one_point_apart) {
  detail::Basic_contact_records<Periodic_image> records;
  const auto subject = [](Point_id a, Point_id b, Lattice_offset_2 offset) {
    return detail::Basic_contact_subject<Periodic_image>{Contact_kind::collision, a, b, offset};
  };
  records.add_event(subject(2, 5, {0, 0}), 17);
  records.add_event(subject(2, 5, {1, -3}), 18);
  EXPECT_EQ(records.pair_event({{2, 5}, {1, -3}}), 18u);
  EXPECT_EQ(records.pair_event({{5, 2}, {-1, 3}}), 18u) << "the same from the other end";
  EXPECT_EQ(records.pair_event({{5, 2}, {1, -3}}), no_event);
  EXPECT_EQ(records.forget_pair({{2, 5}, {0, 0}}), 17u);
  EXPECT_EQ(records.pair_event({{2, 5}, {1, -3}}), 18u) << "another pair stays";
  records.start_overlap(2, {5, {1, -3}}, true);
  EXPECT_NE(records.find_overlap({{5, 2}, {-1, 3}}), nullptr);
  EXPECT_EQ(records.find_overlap({{2, 5}, {0, 0}}), nullptr);
  records.forget_overlap(5, {2, {-1, 3}});
  EXPECT_EQ(records.find_overlap({{2, 5}, {1, -3}}), nullptr);
}

TEST(Contact_records, have_the_pair_of_a_point_with_its_own_image_from_both_ends) {
  detail::Basic_contact_records<Periodic_image> records;
  records.add_event({Contact_kind::collision, 4, 4, {0, 1}}, 9);
  EXPECT_EQ(records.of(4).partners.size(), 2u);
  EXPECT_EQ(records.pair_event({{4, 4}, {0, 1}}), 9u);
  EXPECT_EQ(records.pair_event({{4, 4}, {0, -1}}), 9u);
  EXPECT_EQ(records.forget_pair({{4, 4}, {0, -1}}), 9u);
  EXPECT_TRUE(records.of(4).partners.empty());
  records.start_overlap(4, {4, {0, 1}}, false);
  records.mark_edge({{4, 4}, {0, -1}}, true);
  EXPECT_TRUE(records.find_overlap({{4, 4}, {0, 1}})->is_edge);
  records.forget_overlap(4, {4, {0, 1}});
  EXPECT_TRUE(records.overlaps(4).empty());
}

// An offset costs nothing in the plane.
static_assert(sizeof(Contact_subject) == 3 * sizeof(Point_id));
static_assert(sizeof(detail::Contact_partner<Point_id>) == 2 * sizeof(Point_id));

TEST(Contact_records, come_with_what_they_have_and_go_with_their_points) {
  Contact_records records;
  EXPECT_EQ(records.find(9), nullptr);
  EXPECT_TRUE(records.overlaps(9).empty());
  records.make_room(10);
  EXPECT_EQ(records.size(), 10u);
  records.make_room(4);
  EXPECT_EQ(records.size(), 10u) << "there is room for more already";
  EXPECT_EQ(records.find(9), nullptr) << "room alone is no record";
  records.of(9).corners = {1};
  records.of(12).corners = {2};
  int count = 0;
  records.for_each([&](const detail::Contact_record& record) {
    EXPECT_EQ(record.corners.size(), 1u);
    ++count;
  });
  EXPECT_EQ(count, 2);
  records.forget_point(9);
  records.forget_point(100);
  EXPECT_EQ(records.find(9), nullptr);
  EXPECT_NE(records.find(12), nullptr);
}

}  // namespace
}  // namespace kinetri::contact_records_test
