// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the options of a simulation mean, to the last bit; simulation_2_test.cpp has what is wrong
// with options.
#include "simulation/simulation_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "support/message_of.h"
#include "support/precondition_error.h"

namespace kinetri::simulation_setup_test {
namespace {

using Point_setup = detail::Simulation_types<Linear_kinetic_traits_2>::Simulation_setup;
using Disc_setup = detail::Simulation_types<Disc_kinetic_traits_2>::Simulation_setup;

Simulation_options in_box(double width, double radius, bool rim_touches) {
  Simulation_options options;
  options.box = Box_2{0, 0, width, 10};
  options.radius = radius;
  options.rim_touches = rim_touches;
  return options;
}

Point_setup setup(const Simulation_options& options) {
  return {Linear_kinetic_traits_2(), options};
}
Disc_setup disc_setup(const Simulation_options& options) {
  return {Disc_kinetic_traits_2(), options};
}

/// Whether the place of a point is refused.
template <class Any_setup, class Motion>
bool is_outside(const Any_setup& known, const Motion& motion, double now) {
  const Basic_moving_point_2<Motion> point(motion, 7);
  const std::string message =
      test::message_of<Outside_box_error>([&] { known.check_place(point, Algebraic_number(now)); });
  EXPECT_TRUE(message.empty() || message.starts_with("point 7 is outside of the box")) << message;
  return !message.empty();
}

TEST(Simulation_setup, has_walls_for_centers_or_for_rims) {
  EXPECT_EQ(setup(in_box(8, 1, false)).walls()[1], (Wall_2{Wall_2::Side::right, 8, 0}));
  EXPECT_EQ(setup(in_box(8, 1, true)).walls()[1], (Wall_2{Wall_2::Side::right, 8, 1}));
  EXPECT_EQ(disc_setup(in_box(8, 0, true)).walls()[1], (Wall_2{Wall_2::Side::right, 8, 0, true}));
  EXPECT_EQ(disc_setup(in_box(8, 0, false)).walls()[1], (Wall_2{Wall_2::Side::right, 8, 0}));
  EXPECT_EQ(setup(in_box(8, 1.5, false)).diameter(), 3);
  EXPECT_FALSE(setup({}).has_box());
  EXPECT_FALSE(setup({}).has_response());
}

// 1 - 0.1 is no binary64 number: the bound of the centers is exact, not rounded.
TEST(Simulation_setup, compares_places_with_the_exact_bound) {
  const Point_setup known = setup(in_box(1, 0.1, true));
  const double bound = 1 - 0.1;
  const bool is_above = to_rational(bound) > 1 - to_rational(0.1);
  const double inside = is_above ? std::nextafter(bound, 0) : bound;
  EXPECT_FALSE(is_outside(known, Linear_motion_2{{inside, 5}, {0, 0}, 0}, 0));
  EXPECT_TRUE(is_outside(known, Linear_motion_2{{std::nextafter(inside, 1), 5}, {0, 0}, 0}, 0));
  // Moving points, at their places then.
  const Linear_motion_2 leaves = {{0.5, 5}, {0.125, 0}, 0};
  EXPECT_FALSE(is_outside(setup(in_box(1, 0, false)), leaves, 4));
  EXPECT_TRUE(is_outside(setup(in_box(1, 0, false)), leaves, std::nextafter(4, 5)));
}

TEST(Simulation_setup, of_growing_discs_compares_their_rims) {
  const Disc_setup known = disc_setup(in_box(8, 0, true));
  const Disc_motion_2 grows = {{{5, 5}, {0, 0}, 0}, 1, 0.5, 0};
  EXPECT_FALSE(is_outside(known, grows, 4)) << "its rim is on the wall";
  EXPECT_TRUE(is_outside(known, grows, 4.5));
  EXPECT_FALSE(is_outside(disc_setup(in_box(8, 0, false)), grows, 4.5)) << "its center is inside";
}

TEST(Simulation_setup, refuses_a_radius_that_is_negative_from_now_on) {
  const Disc_setup known = disc_setup({});
  const auto refusal = [&](double radius, double growth, double now) {
    const Disc_kinetic_traits_2::Point_2 point({{{0, 0}, {0, 0}, 0}, radius, growth, 0}, 3);
    return test::message_of<Negative_radius_error>(
        [&] { known.check_place(point, Algebraic_number(now)); });
  };
  EXPECT_EQ(refusal(1, -0.5, 2), "") << "it is 0 then";
  EXPECT_NE(refusal(1, -0.5, 2.25), "");
  EXPECT_EQ(refusal(-1, 0.5, 2), "") << "it is 0, and grows";
  EXPECT_NE(refusal(-1, 0.5, 1.75), "");
  EXPECT_NE(refusal(-1, 0, 0), "");
}

TEST(Simulation_setup, of_discs_that_collide_refuses_weights_besides_radii) {
  Simulation_options options;
  options.response = collide_elastically;
  const Disc_kinetic_traits_2::Point_2 point({{{0, 0}, {0, 0}, 0}, 1, 0, 0.25}, 3);
  const Algebraic_number now(0.0);
  EXPECT_PRECONDITION_ERROR(disc_setup(options).check_place(point, now),
                            "disc 3 has a weight besides its radius; discs that collide have none");
  EXPECT_NO_THROW(disc_setup({}).check_place(point, now));
}

TEST(Simulation_setup, accepts_a_box_that_is_wider_than_a_disc_by_one_bit) {
  EXPECT_NE(setup(in_box(0.2, 0.1, true)).problem(), "");
  EXPECT_EQ(setup(in_box(std::nextafter(0.2, 1), 0.1, true)).problem(), "");
  EXPECT_EQ(setup(in_box(0.2, 0.1, false)).problem(), "");
}

TEST(Masses, are_1_until_they_are_set) {
  Simulation_options options;
  options.masses = {2, 3};
  Point_setup known = setup(options);
  EXPECT_EQ(known.mass(1), 3);
  EXPECT_EQ(known.mass(5), 1);
  known.set_mass(5, 1);
  EXPECT_EQ(known.options().masses.size(), 2u) << "nothing has changed";
  known.set_mass(4, 0.5);
  EXPECT_EQ(known.options().masses, (std::vector<double>{2, 3, 1, 1, 0.5}));
}

}  // namespace
}  // namespace kinetri::simulation_setup_test
