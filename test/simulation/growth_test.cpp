// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that grow: the share that they cover, by rational arithmetic; when they cover one; and
// whether they are jammed.
#include "kinetri/simulation/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/simulation/scenarios.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"

namespace kinetri::growth_test {
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
  for (std::uint64_t seed = 1; seed <= test::cases(1u); ++seed) {
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
      for (const double share : {0.9, 0.99}) {
        Simulation simulation(discs, options);
        Jam_watch watch = Jam_watch::until(share * time);
        EXPECT_TRUE(run(simulation, share * time, watch)) << seed << ' ' << share;
      }
    }
  }
}

// ---- the rule, to the last bit ----

std::uint64_t contacts_in(const Simulation& simulation) {
  const auto& events = simulation.triangulation().counters().events;
  return events[static_cast<std::size_t>(Event_kind::collision)] +
         events[static_cast<std::size_t>(Event_kind::wall)];
}

// Steps until there have been so many contacts.
void step_to_contact(Simulation& simulation, std::uint64_t number) {
  while (contacts_in(simulation) < number) ASSERT_GT(simulation.step(), 0u);
}

// A disc of radius 4 that goes to and fro in a box 10 wide and high: its path between two contacts
// is 2.
const Disc_motion_2 to_and_fro = {{{5, 5}, {2, 0}}, 4, 0, 0};
constexpr std::uint64_t contacts_to_look = 10'000;

// The radius is to grow by 8, four times the path, or a little more.
TEST(Jam_watch, compares_the_path_with_a_quarter_of_the_growth_to_come) {
  const Disc_motion_2 upward = {{{5, 5}, {0, 0.5}}, 4, 0, 0};
  const Disc_motion_2 slanting = {{{5, 5}, {0.75, 1}}, 4, 0, 0};  // a path of 10 / 7, on average
  for (const auto& [disc, growth] :
       {std::pair(to_and_fro, 8.0), {upward, 8.0}, {slanting, 40.0 / 7}}) {
    for (const bool is_more : {false, true}) {
      Simulation simulation({disc}, in_box(10));
      Jam_watch watch(4 + growth * (is_more ? 1 + 1e-3 : 1 - 1e-3));
      step_to_contact(simulation, 1);
      EXPECT_FALSE(watch.is_jammed(simulation)) << "the first look";
      step_to_contact(simulation, 1 + contacts_to_look);
      EXPECT_EQ(watch.is_jammed(simulation), is_more);
    }
  }
  Simulation simulation({to_and_fro}, in_box(10));
  Jam_watch at_the_limit(12);
  step_to_contact(simulation, 1);
  EXPECT_FALSE(at_the_limit.is_jammed(simulation));
  step_to_contact(simulation, 1 + contacts_to_look);
  EXPECT_FALSE(at_the_limit.is_jammed(simulation)) << "a quarter exactly is enough";
}

TEST(Jam_watch, looks_after_ten_thousand_contacts) {
  Simulation simulation({to_and_fro}, in_box(10));
  Jam_watch watch(100);
  step_to_contact(simulation, 1);
  EXPECT_FALSE(watch.is_jammed(simulation));
  for (std::uint64_t number = 2; number <= 1 + 2 * contacts_to_look; ++number) {
    step_to_contact(simulation, number);
    ASSERT_EQ(watch.is_jammed(simulation), number % contacts_to_look == 1) << number;
  }
}

// Of 400 discs all but one rest, and touch nothing.
TEST(Jam_watch, looks_after_32_contacts_of_each_disc) {
  Discs discs = {to_and_fro};
  discs.push_back({{{0.25, 12}, {0, 0}}, 0.0078125, 0, 0});
  discs.push_back({{{9.75, 12}, {0, 0}}, 0.0078125, 0, 0});
  while (discs.size() < 400) {
    const auto k = static_cast<double>(discs.size());
    discs.push_back({{{5 + 0.01 * std::fmod(k, 20), 18 + 0.001 * k}, {0, 0}}, 0, 0, 0});
  }
  Simulation_options options = in_box(10);
  options.box->ymax = 20;
  Simulation simulation(discs, options);
  Jam_watch watch(100);
  EXPECT_FALSE(watch.is_jammed(simulation));
  step_to_contact(simulation, 32 * discs.size() - 1);
  EXPECT_FALSE(watch.is_jammed(simulation));
  step_to_contact(simulation, 32 * discs.size());
  EXPECT_TRUE(watch.is_jammed(simulation));
}

// Two discs on one line, where one passes the other, or each turns the other.
TEST(Jam_watch, counts_collisions_but_no_passes) {
  for (const bool do_pass : {true, false}) {
    Simulation_options options = in_box(10);
    options.refuses_overlaps = false;
    options.response = do_pass ? log_contact : collide_elastically;
    Simulation simulation({{{{2, 5}, {2, 0}}, 1, 0, 0}, {{{7, 5}, {-3, 0}}, 1, 0, 0}}, options);
    Jam_watch watch(100);
    EXPECT_FALSE(watch.is_jammed(simulation));
    while (!watch.is_jammed(simulation)) {
      ASSERT_LT(contacts_in(simulation) - simulation.number_of_passes(), contacts_to_look);
      simulation.step();
    }
    EXPECT_GE(contacts_in(simulation) - simulation.number_of_passes(), contacts_to_look);
    EXPECT_EQ(simulation.number_of_passes() > 1000, do_pass);
  }
}

// One of three discs grows, by 2^-20 until the end: by 24 at one time, which is 8 on average. One
// shrinks, which is not taken off. The mean path is 2.
TEST(Jam_watch, until_a_time_expects_discs_that_grow_to_go_on) {
  const double looked = 0.5 + static_cast<double>(contacts_to_look);  // the time of the look
  for (const double more : {-64.0, 64.0}) {
    Simulation simulation(
        {to_and_fro, {{{2, 15}, {0, 0}}, 0.125, 0x1p-20, 0}, {{{7, 15}, {0, 0}}, 0.5, -0x1p-20, 0}},
        [] {
          Simulation_options options = in_box(10);
          options.box->ymax = 20;
          return options;
        }());
    Jam_watch watch = Jam_watch::until(looked + 24 * 0x1p20 + more);
    step_to_contact(simulation, 1);
    EXPECT_FALSE(watch.is_jammed(simulation));
    step_to_contact(simulation, 1 + contacts_to_look);
    EXPECT_EQ(simulation.current_time(), Algebraic_number(looked));
    EXPECT_EQ(watch.is_jammed(simulation), more > 0);
  }
}

TEST(Jam_watch, is_not_alarmed_by_discs_that_have_gone) {
  Simulation simulation({to_and_fro}, in_box(10));
  Jam_watch watch(100);
  EXPECT_FALSE(watch.is_jammed(simulation));
  step_to_contact(simulation, contacts_to_look);
  simulation.erase(0);
  EXPECT_FALSE(watch.is_jammed(simulation));
}

// Tells a watch of contacts of a pair, or of a disc and a wall.
void tell(Jam_watch& watch, Event_kind kind, std::optional<Point_id> a, std::optional<Point_id> b,
          int times) {
  Event event;
  event.kind = kind;
  event.point_a = a;
  event.point_b = b;
  for (int k = 0; k < times; ++k) watch.after_event(event);
}

TEST(Jam_watch, names_discs_with_half_as_many_contacts_as_any_other) {
  using Ids = std::vector<Point_id>;
  Simulation simulation({to_and_fro}, in_box(10));
  Jam_watch watch(100);
  tell(watch, Event_kind::collision, 4, 1, 3);
  tell(watch, Event_kind::wall, 4, std::nullopt, 3);
  tell(watch, Event_kind::wall, 2, std::nullopt, 2);
  tell(watch, Event_kind::trajectory, 0, std::nullopt, 9);
  EXPECT_FALSE(watch.is_jammed(simulation));
  EXPECT_EQ(watch.jammed_discs(), (Ids{1, 4})) << "of 6, 3 are half, and 2 are less";
  step_to_contact(simulation, contacts_to_look);
  tell(watch, Event_kind::collision, 0, 2, 2);
  tell(watch, Event_kind::collision, 2, 1, 1);
  tell(watch, Event_kind::wall, 2, std::nullopt, 2);
  EXPECT_TRUE(watch.is_jammed(simulation));
  EXPECT_EQ(watch.jammed_discs(), Ids{2}) << "of 5, 2 are less than half; those before are old";
  step_to_contact(simulation, 2 * contacts_to_look);
  EXPECT_TRUE(watch.is_jammed(simulation));
  EXPECT_EQ(watch.jammed_discs(), Ids{}) << "it is told of nothing";
}

TEST(Growth, that_fills_the_box_does_so_at_an_exact_time) {
  const Disc_motion_2 grows = {{{4, 3}, {1, 0.5}, 2}, 1, 0.5, 0};  // of radius 3 at 6
  const Disc_motion_2 rests = {{{4, 4}, {0, 0}}, 4, 0, 0};
  const Disc_motion_2 shrinks = {{{4, 4}, {0, 0}}, 4, -0.125, 0};
  for (const Box_2& box : {Box_2{0, 0, 8, 6}, Box_2{-1, -3, 5, 5}}) {
    Simulation_options options = in_box(8);
    options.box = box;
    options.rim_touches = false;
    options.refuses_overlaps = false;
    for (const Discs& discs : {Discs{grows}, Discs{grows, rests}, Discs{shrinks, grows}}) {
      const Simulation simulation(discs, options);
      EXPECT_TRUE(does_disc_fill_box(simulation, 6));
      EXPECT_FALSE(does_disc_fill_box(simulation, std::nextafter(6, 0)));
    }
    EXPECT_FALSE(does_disc_fill_box(Simulation({rests, shrinks}, options), 1));
  }
  EXPECT_FALSE(does_disc_fill_box(Simulation({grows}, Simulation_options()), 1e9));
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
}  // namespace kinetri::growth_test
