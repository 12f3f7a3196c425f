// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that grow: the share that they cover, by rational arithmetic; when they cover one; and
// whether they are jammed.
#include "kinetri/simulation/growth.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/simulation/scenarios.h"
#include "support/precondition_error.h"

namespace kinetri {
namespace {

using Simulation = Simulation_2<Disc_kinetic_traits_2>;
using Discs = std::vector<Disc_motion_2>;

Simulation_options in_box(double side) {
  Simulation_options result;
  result.box = Box_2{0, 0, side, side};
  result.rim_touches = true;
  result.response = collide_elastically;
  result.refuses_overlaps = true;
  return result;
}

// Of every second one the growth is `ratio` times that of the others.
Discs growing_points(std::size_t number, double side, double growth, double ratio) {
  Scenario_options options;
  options.points = number;
  options.side = side;
  options.speed = 1;
  Discs result;
  for (const Linear_motion_2& motion : make_scenario(Scenario::uniform, options)) {
    result.push_back({motion, 0, result.size() % 2 == 0 ? growth : growth * ratio, 0});
  }
  return result;
}

// Of the areas over pi.
Rational squares_at(const Simulation& simulation, double time) {
  Rational result = 0;
  for (Point_id id = 0; id < simulation.triangulation().number_of_points(); ++id) {
    const Disc_motion_2& disc = simulation.triangulation().motion(id);
    const Rational r = to_rational(disc.radius) +
                       to_rational(disc.growth) * (to_rational(time) - to_rational(disc.epoch));
    result += r * r;
  }
  return result;
}

const Rational pi_from_below = Rational(314159265358979323) / 100000000000000000;
const Rational pi_from_above = Rational(314159265358979324) / 100000000000000000;

// Whether the discs cover the share at the time, and did not a little before.
void expect_share(const Simulation& simulation, double share, double time) {
  const Box_2& box = *simulation.options().box;
  const Rational area = to_rational(share) * (to_rational(box.xmax) - to_rational(box.xmin)) *
                        (to_rational(box.ymax) - to_rational(box.ymin));
  EXPECT_GE(squares_at(simulation, time) * pi_from_below, area);
  EXPECT_LT(squares_at(simulation, time * (1 - 0x1p-40)) * pi_from_above, area);
}

TEST(Growth, covers_the_areas_of_the_discs_over_that_of_the_box) {
  Simulation_options options = in_box(10);
  options.box = Box_2{-2, 0, 8, 5};
  Simulation simulation(Discs{{{{2, 2}, {0, 0}}, 1, 0.25, 0}, {{{6, 2}, {0, 0}, 2}, 0.5, 0, 0}},
                        options);
  EXPECT_DOUBLE_EQ(covered_share(simulation), std::numbers::pi * 1.25 / 50);
  EXPECT_DOUBLE_EQ(mean_radius(simulation, 4), 1.25);
  simulation.advance_to(2);
  EXPECT_DOUBLE_EQ(covered_share(simulation), std::numbers::pi * 2.5 / 50);
}

TEST(Growth, reaches_a_share_at_a_time_that_is_proved) {
  for (const double share : {1e-9, 0.01, 0.3, 0.7, 1.0}) {
    for (const double growth : {1e-3, 0.7, 40.0}) {
      const Simulation simulation(growing_points(7, 10, growth, 1.5), in_box(10));
      const std::optional<double> time = time_of_share(simulation, share);
      ASSERT_TRUE(time);
      expect_share(simulation, share, *time);
    }
  }
  // Some shrink.
  Simulation_options options = in_box(20);
  const Simulation mixed(Discs{{{{5, 5}, {0, 0}}, 2, -0.125, 0}, {{{15, 15}, {0, 0}}, 1, 0.25, 0}},
                         options);
  const std::optional<double> time = time_of_share(mixed, 0.05);
  ASSERT_TRUE(time);
  expect_share(mixed, 0.05, *time);
}

TEST(Growth, that_is_enough_reaches_a_share_now) {
  Simulation simulation(growing_points(7, 10, 0.25, 1), in_box(10));
  simulation.advance_to(1);
  EXPECT_EQ(time_of_share(simulation, 0.001), 1);
}

TEST(Growth, that_is_none_reaches_no_share) {
  const Discs resting = {{{{5, 5}, {0, 0}}, 1, 0, 0}};
  EXPECT_FALSE(time_of_share(Simulation(resting, in_box(10)), 0.5));
  const Discs shrinking = {{{{5, 5}, {0, 0}}, 1, -0.5, 0}};
  EXPECT_FALSE(time_of_share(Simulation(shrinking, in_box(10)), 0.5));
  const Discs slow = {{{{5, 5}, {0, 0}}, 0, 1e-320, 0}};
  EXPECT_FALSE(time_of_share(Simulation(slow, in_box(10)), 0.5));
}

TEST(Growth, goes_on_a_little_where_contacts_have_rounded_radii_down) {
  Simulation simulation(growing_points(40, 10, 0.1, 1.4), in_box(10));
  double end = *time_of_share(simulation, 0.6);
  Jam_watch watch(mean_radius(simulation, end));
  int parts = 0;
  while (simulation.current_time() != Algebraic_number(end)) {
    ASSERT_LT(++parts, 10);
    while (simulation.step(Algebraic_number(end)) > 0) EXPECT_FALSE(watch.is_jammed(simulation));
    simulation.advance_to(Algebraic_number(end));
    end = *time_of_share(simulation, 0.6);
  }
  EXPECT_GT(parts, 1);
  expect_share(simulation, 0.6, end);
  EXPECT_TRUE(simulation.audit(Audit_level::delaunay).passed());
}

TEST(Growth, of_accelerated_discs_reaches_a_share) {
  std::vector<Polynomial_disc_motion_2> discs;
  for (const Disc_motion_2& disc : growing_points(7, 10, 0.5, 2)) {
    discs.push_back(polynomial_motion(disc));
  }
  const Simulation_2<Polynomial_disc_kinetic_traits_2> accelerated(discs, in_box(10));
  const Simulation straight(growing_points(7, 10, 0.5, 2), in_box(10));
  EXPECT_EQ(time_of_share(accelerated, 0.3), time_of_share(straight, 0.3));
  EXPECT_EQ(covered_share(accelerated), covered_share(straight));
}

// A disc in a box as wide as the diameter that it is to have, or narrower.
TEST(Jam_watch, notices_that_there_is_no_room_left) {
  Simulation simulation(Discs{{{{3, 4}, {1, 0.5}}, 1, 0.125, 0}}, in_box(10));
  Jam_watch watch(6);
  int steps = 0;
  bool is_jammed = false;
  while (!is_jammed && ++steps < 200'000) {
    simulation.step();
    is_jammed = watch.is_jammed(simulation);
  }
  EXPECT_TRUE(is_jammed);
  EXPECT_GT(mean_radius(simulation, simulation.current_time().to_double()), 4.5);
}

// However slowly they grow, and however often they touch.
TEST(Jam_watch, is_not_alarmed_where_there_is_room) {
  Discs discs = growing_points(30, 12, 1e-7, 1);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    discs[i].position = {1.5 + 2 * static_cast<double>(i % 5), 1 + 2 * static_cast<double>(i / 5)};
    discs[i].radius = 0.75;
  }
  Simulation simulation(discs, in_box(12));
  Jam_watch watch(1);
  const auto contacts = [&] {
    const auto& events = simulation.triangulation().counters().events;
    return events[static_cast<std::size_t>(Event_kind::collision)];
  };
  while (contacts() < 11'000) {
    simulation.step();
    ASSERT_FALSE(watch.is_jammed(simulation));
  }
}

// Runs until `time` or an alarm of the watch, which observes. Returns whether it got there.
bool run(Simulation& simulation, double time, Jam_watch& watch, int most_steps = 200'000) {
  simulation.add_observer(watch);
  int steps = 0;
  while (simulation.step(Algebraic_number(time)) > 0) {
    if (watch.is_jammed(simulation)) return false;
    if (++steps == most_steps) {
      ADD_FAILURE() << "the run does not end";
      return false;
    }
  }
  return true;
}

// A disc that is as wide as the box at 3; a second one where discs pass through each other.
TEST(Jam_watch, notices_a_disc_between_walls_with_every_response) {
  const Discs discs = {{{{4, 3}, {1, 0.5}}, 1, 1, 0}, {{{7, 7}, {0, 0}}, 0.25, 0, 0}};
  for (const Named_response& named : named_responses) {
    Simulation_options options = in_box(8);
    options.response = named.response;
    options.refuses_overlaps = false;
    const bool do_pass = named.name == "none" || named.name == "log";
    Discs here = discs;
    if (!do_pass) here.pop_back();
    const double end = do_pass ? 3.25 : 20;
    Simulation jammed(here, options);
    EXPECT_TRUE(does_disc_fill_box(jammed, end));
    Jam_watch alarmed = Jam_watch::until(end);
    EXPECT_FALSE(run(jammed, end, alarmed)) << named.name;
    EXPECT_EQ(alarmed.jammed_discs().front(), 0u) << named.name;
    EXPECT_LT(jammed.current_time(), Algebraic_number(3.01)) << named.name;
    Simulation simulation(here, options);
    EXPECT_FALSE(does_disc_fill_box(simulation, 2.99));
    Jam_watch watch = Jam_watch::until(2.99);
    EXPECT_TRUE(run(simulation, 2.99, watch)) << named.name;
  }
}

// Four radii are the width of the box at 2. Who exchanges velocities is jammed, who passes is not.
TEST(Jam_watch, notices_discs_that_exchange_velocities) {
  const Discs discs = {{{{2, 4}, {1, 0}}, 1, 0.5, 0},
                       {{{6, 4}, {-1, 0}}, 1, 0.5, 0},
                       {{{4, 7.5}, {0, 0}}, 0.125, 0, 0}};
  Simulation_options options = in_box(8);
  options.response = swap_velocities;
  Simulation jammed(discs, options);
  Jam_watch watch = Jam_watch::until(5);
  EXPECT_FALSE(run(jammed, 5, watch));
  EXPECT_EQ(watch.jammed_discs(), (std::vector<Point_id>{0, 1}));
  EXPECT_EQ(jammed.number_of_passes(), 0u);
  options.response = log_contact;
  Simulation passing(discs, options);
  Jam_watch not_alarmed = Jam_watch::until(5);
  EXPECT_TRUE(run(passing, 5, not_alarmed));
  EXPECT_GT(passing.number_of_passes(), 0u);
}

// Random discs that are jammed, and the same until a little before.
TEST(Jam_watch, is_not_alarmed_by_dense_runs_that_end) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario_options scenario;
    scenario.points = 12;
    scenario.side = 8;
    scenario.speed = 1;
    scenario.seed = seed;
    Discs discs;
    for (const Linear_motion_2& motion : make_scenario(Scenario::uniform, scenario)) {
      discs.push_back({motion, 0, discs.size() % 2 == 0 ? 0.25 : 0.375, 0});
    }
    for (const auto response : {swap_velocities, collide_elastically}) {
      Simulation_options options = in_box(8);
      options.response = response;
      options.refuses_overlaps = false;
      Simulation jammed(discs, options);
      Jam_watch alarmed = Jam_watch::until(10);
      ASSERT_FALSE(run(jammed, 10, alarmed)) << seed;
      const double time = jammed.current_time().to_double();
      for (const double share : {0.5, 0.9, 0.99}) {
        Simulation simulation(discs, options);
        Jam_watch watch = Jam_watch::until(share * time);
        EXPECT_TRUE(run(simulation, share * time, watch)) << seed << ' ' << share;
      }
    }
  }
}

TEST(Growth, expects_a_box_a_share_and_discs) {
  const Discs discs = {{{{5, 5}, {0, 0}}, 1, 0.5, 0}};
  EXPECT_PRECONDITION_ERROR(covered_share(Simulation(discs, Simulation_options())),
                            "there is no box to be covered");
  for (const double share : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_PRECONDITION_ERROR(time_of_share(Simulation(discs, in_box(10)), share),
                              "the share is not positive and finite");
  }
  EXPECT_PRECONDITION_ERROR(mean_radius(Simulation(Discs(), in_box(10)), 0),
                            "the mean radius of no discs");
}

}  // namespace
}  // namespace kinetri
