// SPDX-License-Identifier: GPL-3.0-or-later
//
// Collisions of many discs: a look at all pairs misses none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"

namespace kinetri::contacts_test {
namespace {

using test::count;
using test::discs;
using test::Recorder;
using test::Simulation;

// ---- all collisions are found ----

class Discs_in_a_box : public testing::TestWithParam<double> {};

TEST_P(Discs_in_a_box, never_come_nearer_than_their_diameter) {
  const double radius = GetParam();
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically)}) {
    for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
      Simulation_options options = discs(test::box_of(30), radius, response);
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
  const Simulation_options options = discs(test::box_of(12), GetParam(), collide_elastically);
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
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    // So dense that many overlap a third one when they come into contact.
    const double diameter = 6;
    const auto motions = test::random_motions(20, 60, 5, seed);
    std::map<Edge_ids, Algebraic_number> expected;
    for (Point_id a = 0; a < motions.size(); ++a) {
      for (Point_id b = a + 1; b < motions.size(); ++b) {
        const auto time = contact_time(motions[a], motions[b], diameter);
        if (time && *time <= Algebraic_number(10.0)) expected.emplace(Edge_ids{a, b}, *time);
      }
    }
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
  EXPECT_GT(contacts, 250u);
}

TEST(Logged_contacts, are_not_repeated_before_the_discs_have_parted) {
  // Two overlap while a wall turns one of them, first away and then back.
  const Simulation_options options = discs({0, 0, 10, 10}, 2, log_contact);
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

}  // namespace
}  // namespace kinetri::contacts_test
