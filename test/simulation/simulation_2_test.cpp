// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/simulation_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"

namespace kinetri {
namespace {

using test::count;
using test::Simulation;

struct Recorder : Simulation::Observer {
  void after_event(const Event& event) override { events.push_back(event); }

  std::vector<Event> of(Event_kind kind) const {
    std::vector<Event> result;
    for (const auto& event : events) {
      if (event.kind == kind) result.push_back(event);
    }
    return result;
  }

  std::vector<Event> events;
};

Simulation_options in_box(const Box_2& box) {
  Simulation_options options;
  options.box = box;
  return options;
}

Simulation_options discs(double radius, Collision_response response) {
  Simulation_options options;
  options.radius = radius;
  options.response = std::move(response);
  return options;
}

Vector_2 velocity(const Simulation& simulation, Point_id id) {
  return simulation.triangulation().motion(id).velocity;
}

// ---- walls ----

TEST(Walls, are_reached_at_exact_times) {
  // A third of a unit of time is no binary64 number.
  Simulation simulation({{{5, 5}, {1, 3}, 0}}, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(6.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 3u);
  EXPECT_EQ(walls[0].time, Algebraic_number(Rational(5, 3)));
  EXPECT_EQ(walls[0].point_a, 0u);
  EXPECT_EQ(walls[0].point_b, std::nullopt);
  EXPECT_NEAR(walls[1].time.to_double(), 5, 1e-14);
  EXPECT_NEAR(walls[2].time.to_double(), 5, 1e-14);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{-1, 3}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Walls, at_a_corner_both_reflect_at_one_time) {
  Simulation simulation({{{5, 5}, {-1, -1}, 0}}, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  EXPECT_EQ(simulation.step(), 2u);
  ASSERT_EQ(recorder.events.size(), 2u);
  EXPECT_EQ(recorder.events[0].time, Algebraic_number(5.0));
  EXPECT_EQ(recorder.events[1].time, Algebraic_number(5.0));
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{1, 1}));
  EXPECT_EQ(simulation.contact_counters().most_at_one_time, 2u);
}

TEST(Walls, reflect_a_point_that_starts_on_a_side_only_outward) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 5}, {-1, 0}, 0}, {{0, 6}, {1, 0}, 0}, {{0, 7}, {0, 1}, 0}, {{0, 0}, {-1, -2}, 0}};
  Simulation simulation(motions, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(0.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 3u);  // point 3 twice
  for (const auto& wall : walls) EXPECT_EQ(wall.time, Algebraic_number(0.0));
  EXPECT_EQ(walls[0].point_a, 0u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{1, 0}));
  EXPECT_EQ(velocity(simulation, 3), (Vector_2{1, 2}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Walls, are_reached_by_several_points_at_one_instant) {
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 8; ++i) motions.push_back({{5, i + 1.0}, {i % 2 == 0 ? 1.0 : -1.0, 0}, 0});
  Simulation simulation(motions, in_box({0, 0, 10, 10}));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(5.0);
  const auto walls = recorder.of(Event_kind::wall);
  ASSERT_EQ(walls.size(), 8u);
  for (Point_id id = 0; id < 8; ++id) {
    EXPECT_EQ(walls[id].time, Algebraic_number(5.0));
    EXPECT_EQ(walls[id].point_a, id);
  }
  EXPECT_EQ(test::audited_run(simulation, 30, Audit_level::certificates), "");
}

TEST(Walls, are_touched_by_the_rim_if_asked) {
  Simulation_options options = in_box({0, 0, 10, 10});
  options.radius = 0.1;
  options.rim_touches = true;
  Simulation simulation({{{5, 5}, {1, 0}, 0}}, options);
  simulation.step();
  // The radius is the binary64 number next to 0.1, taken exactly.
  EXPECT_EQ(simulation.current_time(), Algebraic_number(Rational(5 - to_rational(0.1))));
}

TEST(Walls, keep_points_inside_through_a_million_bounces) {
  std::vector<Linear_motion_2> motions = test::random_motions(4, 1, 5, 3);
  Simulation simulation(motions, in_box({0, 0, 1, 1}));
  std::vector<Vector_2> speeds;
  for (const Linear_motion_2& m : motions) {
    speeds.push_back({std::abs(m.velocity.x), std::abs(m.velocity.y)});
  }
  std::uint64_t exact_in_first_half = 0;
  while (count(simulation, Event_kind::wall) < 1'000'000) {
    simulation.step();
    if (count(simulation, Event_kind::wall) == 500'000) {
      exact_in_first_half = simulation.certificate_counters().exact_decided;
    }
  }
  // Inside exactly, at the speed that it had, exactly.
  const Audit_report report = simulation.audit(Audit_level::certificates);
  EXPECT_TRUE(report.passed()) << report.failures.front();
  for (Point_id id = 0; id < motions.size(); ++id) {
    const Vector_2 v = velocity(simulation, id);
    EXPECT_EQ((Vector_2{std::abs(v.x), std::abs(v.y)}), speeds[id]);
  }
  const Certificate_counters counters = simulation.certificate_counters();
  std::printf("exact decisions: %llu in the first half, %llu in all, of %llu; time %.0f\n",
              static_cast<unsigned long long>(exact_in_first_half),
              static_cast<unsigned long long>(counters.exact_decided),
              static_cast<unsigned long long>(counters.created),
              simulation.current_time().to_double());
  EXPECT_LE(counters.exact_decided - exact_in_first_half, 2 * exact_in_first_half + 100);
}

TEST(Walls, stay_right_on_coarse_grids) {
  for (unsigned seed = 0; seed < 40u * static_cast<unsigned>(test::multiplier()); ++seed) {
    const auto motions = test::grid_motions(1 + seed % 7, 4, 2, seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + '\n' + test::describe(motions));
    Simulation simulation(motions, in_box({0, 0, 3, 3}));
    try {
      ASSERT_EQ(test::audited_run(simulation, 6, Audit_level::reference), "");
    } catch (const Coincident_trajectories_error& error) {
      // Two that start from one place of a side, one of them inward and the other its mirror image.
      EXPECT_EQ(simulation.current_time(), Algebraic_number(0.0));
      EXPECT_EQ(motions[error.first()].position, motions[error.second()].position);
    }
  }
}

// ---- discs ----

TEST(Discs, that_swap_velocities_pass_them_on_to_a_resting_one) {
  // Centres 0 and 5 apart, diameter 2: contact at time 3.
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, swap_velocities));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(4.0);
  const auto collisions = recorder.of(Event_kind::collision);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].time, Algebraic_number(3.0));
  EXPECT_EQ(collisions[0].point_a, 0u);
  EXPECT_EQ(collisions[0].point_b, 1u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
}

TEST(Discs, that_pass_at_just_their_diameter_do_not_collide) {
  const std::vector<Linear_motion_2> motions = {
      {{-5, 2}, {1, 0}, 0}, {{0, 0}, {0, 0}, 0}, {{0, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  simulation.advance_to(20.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 0u);
}

TEST(Discs, that_overlap_at_the_start_collide_at_once_only_if_they_approach) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {-1, 0}, 0},                           // part
      {{1, 0}, {1, 0}, 0},     {{20, 0}, {1, 0}, 0},  // approach
      {{21, 0.5}, {-1, 0}, 0}, {{40, 3}, {0, 0}, 0},  // rest
      {{41, 3}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(1.0);
  const auto collisions = recorder.of(Event_kind::collision);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].point_a, 2u);
  EXPECT_EQ(collisions[0].point_b, 3u);
  EXPECT_EQ(collisions[0].time, Algebraic_number(0.0));
}

TEST(Discs, of_a_cradle_pass_the_velocity_on) {
  // Ten touching discs on a line that is no axis, hit by an eleventh.
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 10; ++i) motions.push_back({{6.0 * i, 8.0 * i}, {0, 0}, 0});
    motions.push_back({{-30, -40}, {3, 4}, 0});
    Simulation simulation(motions, discs(5, response));
    simulation.advance_to(20.0);
    EXPECT_EQ(count(simulation, Event_kind::collision), 10u);
    for (Point_id id = 0; id < 9; ++id) {
      EXPECT_NEAR(velocity(simulation, id).x, 0, 1e-12);
      EXPECT_NEAR(velocity(simulation, id).y, 0, 1e-12);
    }
    EXPECT_NEAR(velocity(simulation, 9).x, 3, 1e-12);
    EXPECT_NEAR(velocity(simulation, 10).y, 0, 1e-12);
  }
}

TEST(Discs, of_two_trains_that_meet_head_on_turn_back) {
  // In the middle, touching, and in motion: simultaneous contacts until the order is reversed.
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 6; ++i) motions.push_back({{2.0 * i, 0}, {1, 0}, 0});
  for (int i = 0; i < 6; ++i) motions.push_back({{20 + 2.0 * i, 0}, {-1, 0}, 0});
  Simulation simulation(motions, discs(1, collide_elastically));
  simulation.advance_to(50.0);
  for (Point_id id = 0; id < 6; ++id) EXPECT_NEAR(velocity(simulation, id).x, -1, 1e-12);
  for (Point_id id = 6; id < 12; ++id) EXPECT_NEAR(velocity(simulation, id).x, 1, 1e-12);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Discs, three_at_one_instant_end_apart) {
  // One comes between two that touch.
  const double height = std::sqrt(3.0);
  const std::vector<Linear_motion_2> motions = {
      {{-1, 0}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, height + 4}, {0, -1}, 0}};
  Simulation simulation(motions, discs(1, collide_elastically));
  EXPECT_EQ(test::audited_run(simulation, 30, Audit_level::reference), "");
  EXPECT_GE(count(simulation, Event_kind::collision), 2u);
  for (Point_id a = 0; a < 3; ++a) {
    for (Point_id b = 0; b < a; ++b) {
      EXPECT_FALSE(Linear_kinetic_traits_2().do_approach(
          simulation.triangulation().vertex(a)->point(),
          simulation.triangulation().vertex(b)->point(), simulation.current_time()));
    }
  }
}

TEST(Discs, meet_the_box_in_a_corner) {
  // One rests in the corner, the other drives it in along the diagonal.
  Simulation_options options = discs(1, collide_elastically);
  options.box = Box_2{0, 0, 20, 20};
  options.rim_touches = true;
  Simulation simulation({{{1, 1}, {0, 0}, 0}, {{5, 5}, {-1, -1}, 0}}, options);
  EXPECT_EQ(test::audited_run(simulation, 40, Audit_level::certificates), "");
  EXPECT_GT(count(simulation, Event_kind::wall), 0u);
}

TEST(Discs, that_all_but_coincide_still_collide) {
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    for (const double distance : {1e-13, 1e-200, 5e-324}) {
      SCOPED_TRACE(distance);
      const std::vector<Linear_motion_2> motions = {
          {{0, 0}, {1, 0}, 0}, {{distance, 0}, {0, 0}, 0}, {{0, 30}, {0, 0}, 0}};
      Simulation simulation(motions, discs(1, response));
      EXPECT_EQ(test::audited_run(simulation, 10, Audit_level::certificates), "");
      EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
      EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
      EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
    }
  }
}

// Near an irrational time the places, rounded, may be the same, or such that no velocities part
// the discs: then they go through each other.
TEST(Discs, that_nothing_parts_keep_their_motions) {
  Contact_2 contact;
  contact.velocity_a = {1, 2};
  contact.velocity_b = {-1, 0};
  contact.would_approach = [](const Vector_2& a, const Vector_2& b) {
    EXPECT_TRUE(std::isfinite(a.x) && std::isfinite(a.y));
    EXPECT_LT(std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y), 100);
    return true;
  };
  for (const Vector_2& separation : {Vector_2{0, 0}, Vector_2{1e-13, 0}, Vector_2{0, 1e-300}}) {
    contact.separation = separation;
    for (const auto response : {swap_velocities, collide_elastically}) {
      const Contact_response_2 result = response(contact);
      EXPECT_FALSE(result.velocity_a || result.velocity_b || result.erases_a || result.erases_b);
    }
  }
}

TEST(Discs, that_stop_stay) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0.5}, {-1, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, stop_both));
  simulation.advance_to(100.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{0, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{0, 0}));
}

TEST(Discs, that_are_erased_are_gone) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0.5}, {-1, 0}, 0}, {{2, 9}, {0, -1}, 0}, {{-5, 4}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, erase_both));
  EXPECT_EQ(test::audited_run(simulation, 20, Audit_level::certificates), "");
  EXPECT_FALSE(simulation.triangulation().contains(0));
  EXPECT_FALSE(simulation.triangulation().contains(1));
  EXPECT_EQ(simulation.triangulation().number_of_points(), 2u);
}

TEST(Discs, take_a_response_of_one_s_own) {
  // The heavier one, by its id, goes on; the other is thrown away at double speed.
  std::vector<Contact_2> contacts;
  const Collision_response response = [&](const Contact_2& contact) {
    contacts.push_back(contact);
    return Contact_response_2{Vector_2{-2 * contact.velocity_b.x, 0}, std::nullopt};
  };
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{-4, 0}, {1, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, discs(1, [&](const Contact_2& c) {
                          Contact_response_2 r = response(c);
                          r.velocity_a->x = -r.velocity_a->x;
                          return r;
                        }));
  simulation.advance_to(10.0);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].time, 2.0);
  EXPECT_EQ(contacts[0].point_a, 0u);
  EXPECT_EQ(contacts[0].separation, (Vector_2{-2, 0}));
  EXPECT_EQ(contacts[0].velocity_b, (Vector_2{1, 0}));
  EXPECT_EQ(velocity(simulation, 0), (Vector_2{2, 0}));
  EXPECT_EQ(velocity(simulation, 1), (Vector_2{1, 0}));
}

TEST(Discs, whose_response_never_parts_them_are_named) {
  const Collision_response stubborn = [](const Contact_2& contact) {
    return Contact_response_2{Vector_2{contact.velocity_a.x * 2, 0}, std::nullopt};
  };
  Simulation_options options = discs(1, stubborn);
  options.max_contacts_per_instant = 50;
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{2, 9}, {0, 0}, 0}};
  Simulation simulation(motions, options);
  try {
    simulation.advance_to(10.0);
    FAIL() << "no error";
  } catch (const Endless_contacts_error& error) {
    EXPECT_NE(std::string(error.what()).find("point 0 and point 1"), std::string::npos)
        << error.what();
  }
}

// ---- all collisions are found ----

class Discs_in_a_box : public testing::TestWithParam<double> {};

TEST_P(Discs_in_a_box, never_come_nearer_than_their_diameter) {
  const double radius = GetParam();
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    for (unsigned seed = 0; seed < 4u * static_cast<unsigned>(test::multiplier()); ++seed) {
      Simulation_options options = discs(radius, response);
      options.box = test::box_of(30);
      options.rim_touches = seed % 2 == 0;
      Simulation simulation(test::discs_in_a_box(30, 0.2, seed), options);
      test::Distance_watcher watcher(simulation);
      simulation.advance_to(20.0);
      watcher.look_until(20.0);
      EXPECT_GT(watcher.least(), 2 * radius * (1 - 1e-13L));
      EXPECT_LT(watcher.least(), 2 * radius * (1 + 1e-13L));
      EXPECT_GT(count(simulation, Event_kind::collision), 30u);
      const Audit_report report = simulation.audit(Audit_level::certificates);
      EXPECT_TRUE(report.passed()) << report.failures.front();
    }
  }
}

TEST_P(Discs_in_a_box, stay_right_at_every_instant) {
  Simulation_options options = discs(GetParam(), collide_elastically);
  options.box = test::box_of(12);
  Simulation simulation(test::discs_in_a_box(12, 0.2, 7), options);
  EXPECT_EQ(test::audited_run(simulation, 8, Audit_level::certificates), "");
}

INSTANTIATE_TEST_SUITE_P(Radii, Discs_in_a_box, testing::Values(1.0, 3.0, 4.5));

// All contacts of two points that keep their motions: at most one.
std::optional<Algebraic_number> contact_time(const Linear_motion_2& p, const Linear_motion_2& q,
                                             double diameter) {
  const Polynomial gap = contact_polynomial(Moving_point_2(p), Moving_point_2(q), diameter);
  if (gap.degree() < 2) return std::nullopt;
  if (gap.sign_at(Rational(0)) != CGAL::POSITIVE) {
    if (derivative(gap).sign_at(Rational(0)) != CGAL::NEGATIVE) return std::nullopt;
    return Algebraic_number(0.0);
  }
  const auto root = first_root_after(gap, Algebraic_number(0.0));
  if (!root || root->multiplicity > 1) return std::nullopt;
  return root->value;
}

TEST(Logged_contacts, are_all_contacts_of_all_pairs) {
  std::size_t contacts = 0;
  for (unsigned seed = 0; seed < 20u * static_cast<unsigned>(test::multiplier()); ++seed) {
    // So few that contacts of three are rare; where they happen the case is left out.
    const double diameter = 1;
    const auto motions = test::random_motions(20, 60, 5, seed);
    std::map<Edge_ids, Algebraic_number> expected;
    std::map<Point_id, std::vector<std::pair<Algebraic_number, Algebraic_number>>> overlaps;
    for (Point_id a = 0; a < motions.size(); ++a) {
      for (Point_id b = a + 1; b < motions.size(); ++b) {
        const auto time = contact_time(motions[a], motions[b], diameter);
        if (!time || *time > Algebraic_number(10.0)) continue;
        expected.emplace(Edge_ids{a, b}, *time);
        const auto end = first_root_after(
            contact_polynomial(Moving_point_2(motions[a]), Moving_point_2(motions[b]), diameter),
            *time);
        overlaps[a].emplace_back(*time, end->value);
        overlaps[b].emplace_back(*time, end->value);
      }
    }
    bool has_three = false;
    for (auto& [id, spans] : overlaps) {
      std::ranges::sort(spans);
      for (std::size_t i = 1; i < spans.size(); ++i) {
        has_three |= spans[i].first <= spans[i - 1].second;
      }
    }
    if (has_three) continue;
    Simulation simulation(motions, discs(diameter / 2, log_contact));
    Recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(10.0);
    std::map<Edge_ids, Algebraic_number> found;
    for (const auto& event : recorder.of(Event_kind::collision)) {
      EXPECT_TRUE(found.emplace(Edge_ids{*event.point_a, *event.point_b}, event.time).second);
    }
    ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
    for (const auto& [pair, time] : expected) {
      ASSERT_TRUE(found.contains(pair));
      EXPECT_EQ(found.at(pair), time);
    }
    contacts += found.size();
  }
  EXPECT_GT(contacts, 50u);
}

TEST(Logged_contacts, are_not_repeated_before_the_discs_have_parted) {
  // Two overlap while a wall turns one of them, first away and then back.
  Simulation_options options = discs(2, log_contact);
  options.box = Box_2{0, 0, 10, 10};
  const std::vector<Linear_motion_2> motions = {{{1, 5}, {1, 0}, 0}, {{9, 5.5}, {-1, 0}, 0}};
  Simulation simulation(motions, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(100.0);
  // They meet in the middle twice in each period of 20: back and forth.
  const auto collisions = recorder.of(Event_kind::collision);
  EXPECT_EQ(collisions.size(), 10u);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

// ---- what is conserved ----

TEST(Conservation, of_energy_and_momentum_over_a_million_collisions) {
  // The energy in a box, which takes momentum; the momentum in free space, until nobody meets
  // anybody any more.
  Simulation_options options = discs(4, collide_elastically);
  options.box = test::box_of(100);
  Simulation in_the_box(test::discs_in_a_box(100, 0.2, 1), options);
  const long double energy = test::conserved(in_the_box).energy;
  while (count(in_the_box, Event_kind::collision) < 1'000'000) in_the_box.step();
  const long double drift = test::conserved(in_the_box).energy / energy - 1;
  std::printf("energy after %llu collisions: relative drift %.3Lg\n",
              static_cast<unsigned long long>(count(in_the_box, Event_kind::collision)), drift);
  EXPECT_LT(std::abs(drift), 1e-12L);

  options.box.reset();
  Simulation free(test::discs_in_a_box(2500, 0.2, 2), options);
  const test::Conserved before = test::conserved(free);
  free.advance_to(1000.0);
  const test::Conserved after = test::conserved(free);
  std::printf("free space, %llu collisions: momentum changed by %.3Lg, %.3Lg, energy by %.3Lg\n",
              static_cast<unsigned long long>(count(free, Event_kind::collision)),
              after.momentum_x - before.momentum_x, after.momentum_y - before.momentum_y,
              after.energy / before.energy - 1);
  EXPECT_GT(count(free, Event_kind::collision), 1000u);
  EXPECT_LT(std::abs(after.momentum_x - before.momentum_x), 1e-10L);
  EXPECT_LT(std::abs(after.momentum_y - before.momentum_y), 1e-10L);
  EXPECT_LT(std::abs(after.energy / before.energy - 1), 1e-12L);
}

// ---- options ----

TEST(Simulation_options, that_have_no_meaning_are_refused) {
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {1, 0}, 0}};
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [&](const Simulation_options& options, const char* message) {
    EXPECT_PRECONDITION_ERROR(Simulation(motions, options), message);
  };
  for (const Box_2& box : {Box_2{0, 0, 0, 10}, Box_2{0, 10, 10, 0}, Box_2{0, 0, infinity, 10},
                           Box_2{0, 0, std::nan(""), 10}}) {
    refuses(in_box(box), "the box has no area or is not finite");
  }
  refuses(discs(-1, log_contact), "the radius is negative or not finite");
  refuses(discs(infinity, log_contact), "the radius is negative or not finite");
  refuses(discs(0, log_contact), "the radius is 0, and discs without one never touch");
  Simulation_options rim = in_box({0, 0, 2, 10});
  rim.radius = 1;
  rim.rim_touches = true;
  refuses(rim, "the box is not wider and higher than a disc whose rim touches it");
}

TEST(Simulation_options, name_a_point_outside_of_the_box) {
  const std::vector<Linear_motion_2> motions = {{{1, 1}, {1, 0}, 0}, {{1, 10.5}, {0, 1}, 0}};
  try {
    Simulation simulation(motions, in_box({0, 0, 10, 10}));
    FAIL() << "no error";
  } catch (const Outside_box_error& error) {
    EXPECT_EQ(error.point(), 1u);
  }
  EXPECT_NO_THROW(Simulation(motions, in_box({1, 1, 2, 10.5})));
}

TEST(Simulation, of_free_points_is_the_triangulation) {
  const auto motions = test::random_motions(50, 70, 5, 5);
  Simulation simulation(motions, {});
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  EXPECT_EQ(simulation.advance_to(3.0), kinetic.advance_to(3.0));
  EXPECT_EQ(simulation.triangulation().finite_edge_ids(), kinetic.finite_edge_ids());
  EXPECT_EQ(simulation.contact_counters().queue.pushed, 0u);
}

TEST(Simulation, decides_the_same_without_filters) {
  Simulation_options options = discs(3, collide_elastically);
  options.box = test::box_of(16);
  const auto motions = test::discs_in_a_box(16, 0.2, 4);
  Simulation filtered(motions, options);
  Simulation exact(motions, options, 0.0, Linear_kinetic_traits_2::exact());
  Recorder one;
  Recorder other;
  filtered.add_observer(one);
  exact.add_observer(other);
  filtered.advance_to(3.0);
  exact.advance_to(3.0);
  ASSERT_EQ(one.events.size(), other.events.size());
  EXPECT_GT(one.of(Event_kind::collision).size(), 10u);
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].kind, other.events[i].kind);
    EXPECT_EQ(one.events[i].time, other.events[i].time);
    EXPECT_EQ(one.events[i].point_a, other.events[i].point_a);
    EXPECT_EQ(one.events[i].added, other.events[i].added);
  }
  for (Point_id id = 0; id < 16; ++id) {
    EXPECT_EQ(filtered.triangulation().motion(id), exact.triangulation().motion(id));
  }
}

// One point that reaches a wall, one that never does, and a change that is to come.
TEST(Simulation, tells_the_present_length_of_its_queue) {
  Simulation simulation({{{5, 5}, {1, 0}, 0}, {{6, 6}, {0, 0}, 0}}, in_box({0, 0, 10, 10}));
  EXPECT_EQ(simulation.queue_size(), 1u);
  simulation.schedule_erase(2.0, 0);
  EXPECT_EQ(simulation.queue_size(), 2u);
  simulation.advance_to(2.0);
  EXPECT_EQ(simulation.queue_size(), 0u);
}

}  // namespace
}  // namespace kinetri
