// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/contact_outcomes.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "support/message_of.h"
#include "support/simulation_parts.h"

namespace kinetri::contact_outcomes_test {
namespace {

using detail::Contact_entry;
using detail::Contact_kind;

Simulation_options discs(double radius, Collision_response response) {
  Simulation_options options;
  options.radius = radius;
  options.response = std::move(response);
  return options;
}

/// What a contact at a time does to its points.
template <class Traits = Linear_kinetic_traits_2>
auto changes(const std::vector<typename Traits::Motion>& motions, const Simulation_options& options,
             double now, Contact_kind kind, Point_id a, Point_id b) {
  const test::Geometry_part<Traits> part(motions, options, now);
  Contact_entry contact;
  contact.kind = kind;
  contact.point_a = a;
  contact.point_b = b;
  return typename detail::Simulation_types<Traits>::Contact_outcomes(part.geometry)
      .changes(contact, Algebraic_number(now));
}

auto collision(const std::vector<Linear_motion_2>& motions, const Simulation_options& options) {
  return changes(motions, options, 2, Contact_kind::collision, 0, 1);
}

/// Two discs of radius 1 that touch at t = 2, and one far away.
const std::vector<Linear_motion_2> head_on = {
    {{0, 0}, {2, 1}, 0}, {{8, 0}, {-1, 1}, 0}, {{50, 50}, {0, 0}, 0}};

TEST(Wall, turns_one_component_of_the_velocity_around) {
  Simulation_options options;
  options.box = Box_2{0, 0, 10, 10};
  const std::vector<Linear_motion_2> motions = {{{6, 2}, {2, 1}, 0}, {{1, 1}, {0, 0}, 0}};
  const auto right = changes(motions, options, 2, Contact_kind::wall, 0, 1);
  ASSERT_EQ(right.size(), 1u);
  EXPECT_EQ(right[0].point, 0u);
  EXPECT_EQ(rounded_velocity(*right[0].motion, 2), (Vector_2{-2, 1}));
  EXPECT_EQ(rounded_place(*right[0].motion, 2), (Vector_2{10, 4}));
  const auto upper = changes({{{6, 2}, {-2, 4}, 0}}, options, 2, Contact_kind::wall, 0, 3);
  EXPECT_EQ(rounded_velocity(*upper[0].motion, 2), (Vector_2{-2, -4}));
}

// The exact contact is at 1/3 of a unit: the point stays inside whatever the rounding.
TEST(Wall, leaves_the_point_inside_of_the_box) {
  Simulation_options options;
  options.box = Box_2{0, 0, 1.0 / 3, 10};
  for (const double speed : {0.1, 0.3, 0.7, 1.1}) {
    const std::vector<Linear_motion_2> motions = {{{1.0 / 3 - speed * 0.7, 5}, {speed, 0}, 0}};
    const Wall_2 wall = options.box->walls(0)[1];
    const Linear_kinetic_traits_2 traits;
    const Moving_point_2 point(motions[0], 0);
    const Certificate known = traits.wall_certificate(point, wall, 0.0);
    const Algebraic_number now =
        known.failure ? *known.failure : traits.wall_failure(point, wall, known.bounds);
    const test::Geometry_part<> part(motions, options, now);
    Contact_entry contact;
    contact.point_a = 0;
    contact.point_b = 1;
    const auto made =
        detail::Simulation_types<Linear_kinetic_traits_2>::Contact_outcomes(part.geometry)
            .changes(contact, now);
    EXPECT_TRUE(traits.is_inside(Moving_point_2(*made[0].motion, 0), wall, now)) << speed;
    EXPECT_EQ(rounded_velocity(*made[0].motion, now.to_double()).x, -speed);
  }
}

TEST(Wall, parts_from_the_rim_of_a_growing_disc_as_fast_as_they_met) {
  Simulation_options options;
  options.box = Box_2{0, 0, 10, 10};
  options.rim_touches = true;
  // At t = 2 its center is at 8 and its radius 2; they meet at the speed 1 + 0.5.
  const std::vector<Disc_motion_2> motions = {{{{6, 5}, {1, 0}, 0}, 1, 0.5, 0}};
  const auto made = changes<Disc_kinetic_traits_2>(motions, options, 2, Contact_kind::wall, 0, 1);
  EXPECT_EQ(rounded_velocity(*made[0].motion, 2).x, -2) << "-(1 + 2 * 0.5)";
}

TEST(Collision, of_equal_masses_exchanges_what_is_along_the_line_of_centers) {
  const auto made = collision(head_on, discs(1, collide_elastically));
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(rounded_velocity(*made[0].motion, 2), (Vector_2{-1, 1}));
  EXPECT_EQ(rounded_velocity(*made[1].motion, 2), (Vector_2{2, 1}));
  EXPECT_EQ(rounded_place(*made[0].motion, 2), (Vector_2{4, 2})) << "it stays where it is";
}

TEST(Collision, asks_for_masses_by_id) {
  Simulation_options options = discs(1, collide_elastically);
  options.masses = {1, 2, 1};
  const auto made = collision(head_on, options);
  // The common velocity is 0: each component turns around, relative to that.
  EXPECT_NEAR(rounded_velocity(*made[0].motion, 2).x, -2, 1e-12);
  EXPECT_NEAR(rounded_velocity(*made[1].motion, 2).x, 1, 1e-12);
}

TEST(Collision, is_what_the_response_says) {
  Contact_2 seen;
  Contact_response_2 answer;
  const auto response = [&](const Contact_2& contact) {
    seen = contact;
    return answer;
  };
  EXPECT_TRUE(collision(head_on, discs(1, response)).empty()) << "they pass through each other";
  EXPECT_EQ(seen.time, 2);
  EXPECT_EQ(seen.separation, (Vector_2{2, 0}));
  EXPECT_EQ(seen.velocity_a, (Vector_2{2, 1}));
  EXPECT_FALSE(seen.is_pressed);
  answer.velocity_a = Vector_2{2, 1};
  EXPECT_TRUE(collision(head_on, discs(1, response)).empty()) << "the velocity that it has";
  answer = {};
  answer.erases_b = true;
  answer.velocity_a = Vector_2{0, 7};
  const auto made = collision(head_on, discs(1, response));
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(rounded_velocity(*made[0].motion, 2), (Vector_2{0, 7}));
  EXPECT_EQ(made[1].point, 1u);
  EXPECT_FALSE(made[1].motion);
  answer = {};
  answer.stops_a = true;
  const auto stopped = collision(head_on, discs(1, response));
  ASSERT_EQ(stopped.size(), 1u);
  EXPECT_EQ(*stopped[0].motion, (Linear_motion_2{{4, 2}, {0, 0}, 2}));
}

TEST(Collision, tells_the_response_whether_velocities_would_approach) {
  std::vector<bool> answers;
  const auto response = [&](const Contact_2& contact) {
    answers = {contact.would_approach({2, 1}, {-1, 1}), contact.would_approach({-1, 1}, {2, 1}),
               contact.would_approach({0, 1}, {0, 1}), contact.would_approach({1, 0}, {0, 9})};
    return Contact_response_2();
  };
  collision(head_on, discs(1, response));
  EXPECT_EQ(answers, (std::vector<bool>{true, false, false, true}));
}

TEST(Collision, with_velocities_beyond_all_numbers_is_refused) {
  const auto response = [](const Contact_2&) {
    Contact_response_2 answer;
    answer.velocity_b = Vector_2{std::numeric_limits<double>::infinity(), 0};
    return answer;
  };
  const std::string message =
      test::message_of<Contact_overflow_error>([&] { collision(head_on, discs(1, response)); });
  EXPECT_TRUE(message.starts_with("after its contact at t = 2 point 1 ")) << message;
}

}  // namespace
}  // namespace kinetri::contact_outcomes_test
