// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs of different sizes that grow: by hand, and beside simulations of equal discs and the oracle
// of all pairs (all_pairs_test.cpp has the comparison at every instant).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/message_of.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"

namespace kinetri::disc_simulation_test {
namespace {

using test::count;
using test::in_box;
using test::Recorder;
using Discs = Simulation_2<Disc_kinetic_traits_2>;

Simulation_options responding(Collision_response response) {
  Simulation_options options;
  options.response = std::move(response);
  return options;
}

Disc_motion_2 disc(const Vector_2& place, const Vector_2& velocity, double radius,
                   double growth = 0, double epoch = 0) {
  return {{place, velocity, epoch}, radius, growth, 0};
}

// ---- by hand ----

TEST(Discs_of_any_size, touch_where_their_radii_say) {
  Discs simulation({disc({0, 0}, {1, 0}, 1), disc({10, 0}, {0, 0}, 3), disc({0, 20}, {0, 0}, 0)},
                   responding(collide_elastically));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(7.0);
  const auto contacts = recorder.of(Event_kind::collision);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].time, Algebraic_number(6.0));
  EXPECT_EQ(simulation.triangulation().motion(1).velocity, (Vector_2{1, 0}));
  EXPECT_EQ(simulation.triangulation().motion(0).radius, 1);
}

// Two large discs touch between two small ones that are nearer to each other: the Delaunay edge is
// that of the small ones.
TEST(Discs_of_any_size, touch_without_a_delaunay_edge) {
  Discs simulation({disc({-1.5, 0}, {1, 0}, 1), disc({1.5, 0}, {-1, 0}, 1),
                    disc({0, 0.5}, {0, 0}, 0.05), disc({0, -0.5}, {0, 0}, 0.05)},
                   responding(log_contact));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(0.5);
  ASSERT_EQ(recorder.of(Event_kind::collision).size(), 1u);
  EXPECT_EQ(recorder.of(Event_kind::collision)[0].point_b, 1u);
}

TEST(Discs_of_any_size, grow_into_each_other_and_part_as_fast) {
  Discs simulation({disc({0, 0}, {0, 0}, 1, 0.5), disc({4, 0}, {0, 0}, 1, 0.5)},
                   responding(collide_elastically));
  simulation.advance_to(2.0);
  // The rims came with the speed 1, and part with it.
  EXPECT_EQ(simulation.triangulation().motion(0).velocity, (Vector_2{-1, 0}));
  EXPECT_EQ(simulation.triangulation().motion(1).velocity, (Vector_2{1, 0}));
  EXPECT_NEAR(simulation.triangulation().motion(0).radius, 2, 1e-14);
  EXPECT_LT(simulation.triangulation().motion(0).radius, 2);
}

TEST(Discs_of_any_size, that_rest_and_grow_pass_through_each_other_if_they_swap) {
  Discs simulation({disc({0, 0}, {0, 0}, 1, 0.5), disc({4, 0}, {0, 0}, 1, 0.5)},
                   responding(swap_velocities));
  simulation.advance_to(5.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
}

// At one place without radii the square of their gap has no slope, but the gap has one: they are
// not in resting contact.
TEST(Discs_of_any_size, that_grow_from_one_place_pass_through_each_other_if_they_approach) {
  for (const auto& response : {swap_velocities, collide_elastically}) {
    for (const double speed : {0.0, 0.5, 1.0, 2.0}) {
      Discs simulation({disc({1, 2}, {0, 0}, 0, 0.5), disc({1, 2}, {speed, 0}, 0, 0.5)},
                       responding(response));
      simulation.advance_to(5.0);
      EXPECT_EQ(count(simulation, Event_kind::collision), speed < 1 ? 1u : 0u) << speed;
      EXPECT_EQ(simulation.triangulation().motion(0).growth, 0.5);
    }
  }
}

TEST(Discs_of_any_size, stop_growing_where_they_stop) {
  Discs simulation({disc({0, 0}, {0, 1}, 1, 0.5), disc({4, 0}, {0, 1}, 1, 0.5)},
                   responding(stop_both));
  simulation.advance_to(100.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  EXPECT_EQ(simulation.triangulation().motion(0).growth, 0);
  EXPECT_NEAR(simulation.triangulation().motion(0).radius, 2, 1e-14);
}

TEST(Discs_of_any_size, with_rims_that_touch_part_from_a_wall_as_fast_as_they_came) {
  Simulation_options options = in_box({0, 0, 10, 10});
  options.rim_touches = true;
  Discs simulation({disc({7, 5}, {1, 0}, 1, 1)}, options);
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(1.5);
  ASSERT_EQ(recorder.of(Event_kind::wall).size(), 1u);
  EXPECT_EQ(recorder.of(Event_kind::wall)[0].time, Algebraic_number(1.0));
  EXPECT_EQ(simulation.triangulation().motion(0).velocity, (Vector_2{-3, 0}));
}

TEST(Discs_of_any_size, within_a_larger_one_are_found_and_leave) {
  // A small one enters a large one, meets another small one inside, where both are hidden, and
  // goes.
  Discs simulation({disc({0, 0}, {0, 0}, 5), disc({1, 0}, {0, 0}, 0.5),
                    disc({-10, 0}, {1, 0}, 0.25), disc({0, 0}, {0, 0}, 2)},
                   responding(log_contact));
  Recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(50.0);
  const auto contacts = recorder.of(Event_kind::collision);
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[0].time, Algebraic_number(4.75));  // with the rim of disc 0
  EXPECT_EQ(contacts[1].time, Algebraic_number(7.75));
  EXPECT_EQ(contacts[2].time, Algebraic_number(10.25));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Discs_of_any_size, that_overlap_at_the_start_collide_if_they_approach_even_if_hidden) {
  // No third disc overlaps the two, and one has no edge.
  Discs simulation({disc({0, 0}, {0, 0}, 5), disc({1, 0}, {-1, 0}, 0.5), disc({20, 0}, {0, 0}, 1),
                    disc({-20, 0}, {0, 0}, 1), disc({0, 20}, {0, 0}, 1), disc({0, -20}, {0, 0}, 1)},
                   responding(log_contact));
  EXPECT_TRUE(simulation.triangulation().is_hidden(1));
  simulation.advance_to(0.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
}

// Of the two that get new motions at once the larger one hides the smaller one, in one place.
TEST(Discs_of_any_size, that_are_concentric_stop_both) {
  Discs simulation(
      {disc({-7, -2}, {1, 2}, 3), disc({-7, -2}, {0, -1}, 0, 0.125), disc({20, 0}, {0, 0}, 1),
       disc({-20, 0}, {0, 0}, 1), disc({0, 20}, {0, 0}, 1), disc({0, -20}, {0, 0}, 1)},
      responding(stop_both));
  simulation.advance_to(0.0);
  EXPECT_EQ(count(simulation, Event_kind::collision), 1u);
  EXPECT_TRUE(is_at_rest(simulation.triangulation().motion(0)));
  EXPECT_TRUE(is_at_rest(simulation.triangulation().motion(1)));
}

// ---- what is refused ----

TEST(Discs_of_any_size, have_no_common_radius_and_no_weight_besides) {
  Simulation_options options = responding(log_contact);
  Disc_motion_2 weighted = disc({0, 0}, {0, 0}, 1);
  weighted.weight = 1;
  EXPECT_PRECONDITION_ERROR(Discs({weighted}, options),
                            "disc 0 has a weight besides its radius; discs that collide have none");
  EXPECT_NO_THROW(Discs({weighted}, {}));
  options.radius = 1;
  EXPECT_PRECONDITION_ERROR(Discs({disc({0, 0}, {0, 0}, 1)}, options),
                            "a radius for all discs, which have their own; leave it 0");
}

TEST(Discs_of_any_size, that_overlap_are_refused_if_the_options_say_so) {
  Simulation_options options = responding(collide_elastically);
  options.refuses_overlaps = true;
  const auto pairs_of = [&](const std::vector<Disc_motion_2>& discs) -> std::vector<Edge_ids> {
    try {
      Discs simulation(discs, options);
    } catch (const Overlapping_discs_error& error) {
      return error.pairs();
    }
    return {};
  };
  const Disc_motion_2 large = disc({0, 0}, {0, 0}, 3);
  // Touching, and touching while they approach, is allowed; the least overlap is not.
  EXPECT_EQ(pairs_of({large, disc({5, 0}, {0, 0}, 2), disc({-5, 0}, {1, 0}, 2)}),
            (std::vector<Edge_ids>{}));
  EXPECT_EQ(pairs_of({large, disc({std::nextafter(5, 0), 0}, {0, 0}, 2)}),
            (std::vector<Edge_ids>{{0, 1}}));
  EXPECT_EQ(pairs_of({disc({9, 9}, {0, 0}, 0), large, disc({1, 0}, {5, 0}, 0.5),
                      disc({0, 0}, {0, 0}, 1)}),
            (std::vector<Edge_ids>{{1, 2}, {1, 3}, {2, 3}}));
  Discs simulation({large, disc({9, 0}, {0, 0}, 1)}, options);
  EXPECT_NO_THROW(simulation.insert(disc({0, 4}, {0, 0}, 1)));
  const std::string message = test::message_of<Overlapping_discs_error>([&] {
    simulation.insert(disc({7, 0}, {0, 0}, 1.5));
  });
  EXPECT_EQ(message, "discs 1 and 3 overlap at t = 0; expected discs that are apart or touch");
  EXPECT_EQ(simulation.triangulation().number_of_points(), 3u);
}

TEST(Discs_of_any_size, with_negative_radii_are_refused) {
  for (const Disc_motion_2& bad :
       {disc({0, 0}, {0, 0}, -1), disc({0, 0}, {0, 0}, 1, 1, 2), disc({0, 0}, {0, 0}, 1, -1, -2)}) {
    EXPECT_THROW(Discs({bad}, {}), Negative_radius_error);
    Discs simulation({disc({5, 0}, {0, 0}, 0)}, {});
    EXPECT_THROW(simulation.insert(bad), Negative_radius_error);
    EXPECT_THROW(simulation.set_motion(0, bad), Negative_radius_error);
  }
}

TEST(Discs_of_any_size, that_shrink_may_vanish_but_not_more) {
  const std::vector<Disc_motion_2> discs = {disc({0, 0}, {0, 0}, 1, -0.375),
                                            disc({5, 0}, {0, 0}, 1, -0.125)};
  Discs simulation(discs, responding(log_contact));
  EXPECT_NO_THROW(simulation.advance_to(Algebraic_number(Rational(8, 3))));
  try {
    simulation.advance_to(3.0);
    FAIL() << "no error";
  } catch (const Negative_radius_error& error) {
    EXPECT_EQ(error.point(), 0u);
    EXPECT_EQ(error.time(), Algebraic_number(Rational(8, 3)));
    EXPECT_EQ(std::string(error.what()),
              "the radius of disc 0 shrinks to 0 at t = 2.6666666666666665 and would be negative "
              "after that; expected an end at that time or before, or another motion of the disc "
              "by then");
  }
  EXPECT_EQ(simulation.current_time(), Algebraic_number(Rational(8, 3)));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  // It goes on once the disc is gone; and a change at the very time of the other one is in time.
  simulation.erase(0);
  simulation.schedule_motion(8.0, 1, disc({5, 0}, {0, 0}, 0, 0, 8));
  EXPECT_NO_THROW(simulation.advance_to(20.0));
  EXPECT_EQ(simulation.queue_size(), 0u);
}

// ---- beside equal discs ----

TEST(Discs_of_any_size, that_are_equal_have_the_events_of_equal_discs) {
  for (const Collision_response& response :
       {Collision_response(swap_velocities), Collision_response(collide_elastically),
        Collision_response(log_contact)}) {
    constexpr double radius = 3;
    const auto motions = test::discs_in_a_box(30, 0.2, 5);
    std::vector<Disc_motion_2> equal;
    for (const Linear_motion_2& motion : motions) equal.push_back({motion, radius, 0, 0});
    Simulation_options options = test::discs(test::box_of(30), radius, response);
    options.rim_touches = true;
    test::Simulation points(motions, options);
    options.radius = 0;
    Discs discs(equal, options);
    Recorder one;
    Recorder other;
    points.add_observer(one);
    discs.add_observer(other);
    points.advance_to(10.0);
    discs.advance_to(10.0);
    ASSERT_EQ(one.events.size(), other.events.size());
    EXPECT_GT(one.of(Event_kind::collision).size(), 30u);
    for (std::size_t i = 0; i < one.events.size(); ++i) {
      const Event& a = one.events[i];
      const Event& b = other.events[i];
      ASSERT_EQ(a.kind, b.kind);
      ASSERT_EQ(a.time, b.time);
      ASSERT_EQ(a.removed, b.removed);
      ASSERT_EQ(a.added, b.added);
      ASSERT_EQ(a.point_a, b.point_a);
      ASSERT_EQ(a.point_b, b.point_b);
      // What a log prints.
      ASSERT_EQ(a.time.tight_interval().lower, b.time.tight_interval().lower);
      ASSERT_EQ(a.time.tight_interval().upper, b.time.tight_interval().upper);
    }
    for (Point_id id = 0; id < 30; ++id) {
      ASSERT_EQ(static_cast<const Linear_motion_2&>(discs.triangulation().motion(id)),
                points.triangulation().motion(id));
    }
  }
}

TEST(Discs_of_any_size, go_on_from_a_snapshot) {
  std::vector<Disc_motion_2> motions;
  for (const Linear_motion_2& motion : test::discs_in_a_box(25, 0.2, 6)) {
    const double radius = motions.size() % 3 == 0 ? 4 : 0.5;
    motions.push_back({motion, radius, motions.size() % 2 == 0 ? 0.125 : -0.03125, 0});
  }
  Simulation_options options = responding(log_contact);
  options.box = test::box_of(25);
  Discs simulation(motions, options);
  simulation.advance_to(2.0);
  Discs restored = Discs::restore(simulation.snapshot(), log_contact);
  Recorder one;
  Recorder other;
  simulation.add_observer(one);
  restored.add_observer(other);
  simulation.advance_to(5.0);
  restored.advance_to(5.0);
  ASSERT_EQ(one.events.size(), other.events.size());
  EXPECT_GT(one.contacts().size(), 5u);
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    ASSERT_EQ(one.events[i].kind, other.events[i].kind);
    ASSERT_EQ(one.events[i].time, other.events[i].time);
    ASSERT_EQ(one.events[i].added, other.events[i].added);
  }
}

// ---- many ----

// All discs are in a box; sizes from 1 to 1 : 1000; some large ones cover many small ones. Every
// pair touches at most once.
TEST(Discs_of_any_size, have_the_first_contacts_of_all_pairs) {
  std::size_t contacts = 0;
  for (unsigned seed = 0; seed < test::cases(5u); ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> exponent(-10, 0);
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : test::random_motions(60, 60, 5, seed)) {
      motions.push_back({motion, 12 * std::exp2(exponent(random)),
                         static_cast<double>(motions.size() % 4) / 4, 0});
    }
    std::map<Edge_ids, Algebraic_number> expected;
    for (Point_id a = 0; a < motions.size(); ++a) {
      for (Point_id b = a + 1; b < motions.size(); ++b) {
        const Moving_disc_2 p(motions[a], a);
        const Moving_disc_2 q(motions[b], b);
        const auto exact = Disc_kinetic_traits_2::exact();
        const Certificate certificate = exact.contact_certificate(p, q, 0, 0.0);
        if (certificate.kind == Certificate::Kind::never_fails) continue;
        const Algebraic_number time = certificate.failure
                                          ? *certificate.failure
                                          : exact.contact_failure(p, q, 0, certificate.bounds);
        if (time <= Algebraic_number(6.0)) expected.emplace(Edge_ids{a, b}, time);
      }
    }
    Discs simulation(motions, responding(log_contact));
    Recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(6.0);
    std::map<Edge_ids, Algebraic_number> found;  // the first ones
    for (const auto& event : recorder.of(Event_kind::collision)) {
      found.emplace(Edge_ids{*event.point_a, *event.point_b}, event.time);
    }
    ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
    for (const auto& [pair, time] : expected) {
      ASSERT_TRUE(found.contains(pair)) << "seed " << seed;
      ASSERT_EQ(found.at(pair), time);
    }
    contacts += found.size();
    EXPECT_TRUE(simulation.audit(Audit_level::delaunay).passed());
  }
  EXPECT_GT(contacts, 500u);
}

}  // namespace
}  // namespace kinetri::disc_simulation_test
