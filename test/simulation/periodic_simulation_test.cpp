// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs in a periodic box that collide: against an oracle that looks at all pairs of images, in
// boxes that are at rest, sheared, growing and shrinking; and what a periodic box does not allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/message_of.h"
#include "support/multiplier.h"
#include "support/periodic_contacts.h"

namespace kinetri::periodic_simulation_test {
namespace {

using test::boxes;
using test::Contact_recorder;
using test::difference;
using test::Named_box;
using test::own_image;
using test::square;
using test::Totals;
using Traits = Periodic_kinetic_traits_2;
using Simulation = Simulation_2<Traits>;
using Motions = std::vector<Linear_motion_2>;

Simulation_options discs(double radius, const Collision_response& response) {
  Simulation_options options;
  options.radius = radius;
  options.response = response;
  return options;
}

/// Whole numbers lead to simultaneous contacts.
Motions random_discs(std::mt19937_64& random, std::size_t number, bool are_whole, double speed) {
  const auto between = [&](double least, double greatest) {
    return are_whole ? static_cast<double>(std::uniform_int_distribution<int>(
                           static_cast<int>(least), static_cast<int>(greatest))(random))
                     : std::uniform_real_distribution<double>(least, greatest)(random);
  };
  Motions result;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = between(-8, 16);
    const double y = between(-8, 16);
    const double vx = between(-speed, speed);
    result.push_back({{x, y}, {vx, between(-speed, speed)}, 0});
  }
  return result;
}

TEST(Periodic_simulation, has_the_contacts_of_all_pairs_of_images) {
  std::mt19937_64 random(1);
  Totals totals;
  std::size_t refused = 0;
  const int runs = test::cases(3);
  for (const Named_box& named : boxes()) {
    for (int run = 0; run < runs;) {
      const bool are_whole = run % 2 == 0;
      const std::size_t number = run % 12 == 0 ? 1 : 2 + random() % 4;
      const double radius = are_whole ? 0.5 + static_cast<double>(random() % 3) / 2
                                      : std::uniform_real_distribution<double>(0.5, 1.5)(random);
      Simulation_options options = discs(radius, collide_elastically);
      options.refuses_overlaps = true;
      const Motions motions = random_discs(random, number, are_whole, 4);
      try {
        const std::string problem =
            difference<Traits>(named.box, motions, options, named.until, 60, totals);
        ASSERT_EQ(problem, "") << named.name << ", run " << run;
        ++run;
      } catch (const Overlapping_discs_error&) {
        ++refused;
      } catch (const Coincident_trajectories_error&) {
        ++refused;
      }
    }
  }
  std::printf("%zu contacts; %zu runs with 60; %zu ended at an own image; %zu inputs refused\n",
              totals.contacts, totals.full, totals.own_images, refused);
  EXPECT_GT(2U * totals.full, 3U * static_cast<unsigned>(runs));
  EXPECT_GT(totals.own_images, 0U);
}

// Discs that overlap at the start, that pass through each other, and that swap velocities.
TEST(Periodic_simulation, lets_discs_pass_as_the_oracle_does) {
  std::mt19937_64 random(2);
  Totals totals;
  const int runs = test::cases(6);
  for (const Named_box& named : boxes()) {
    for (int run = 0; run < runs; ++run) {
      const Motions motions = random_discs(random, 2 + random() % 4, run % 2 == 0, 2);
      const double radius = 0.5 + static_cast<double>(random() % 4) / 2;
      const Simulation_options options = discs(radius, log_contact);
      try {
        const std::string problem = difference<Traits>(named.box, motions, options, 8, 200, totals);
        ASSERT_EQ(problem, "") << named.name << ", run " << run;
      } catch (const Coincident_trajectories_error&) {
        --run;
      }
    }
  }
  std::printf("%zu contacts of discs that pass; %zu runs ended at an own image\n", totals.contacts,
              totals.own_images);
  EXPECT_GT(totals.contacts, 200U);
}

// After every change a new oracle begins with the motions that there are.
TEST(Periodic_simulation, has_these_contacts_after_changes) {
  std::mt19937_64 random(3);
  std::size_t contacts = 0;
  for (const Named_box& named : boxes()) {
    for (int run = 0; run < test::cases(4); ++run) {
      const Simulation_options options = discs(0.5, collide_elastically);
      Simulation simulation(random_discs(random, 4, false, 2), options, 0,
                            Periodic_kinetic_traits_2(named.box));
      Contact_recorder recorder;
      simulation.add_observer(recorder);
      for (int time = 1; time < 8; ++time) {
        simulation.advance_to(time);
        const Linear_motion_2 motion = random_discs(random, 1, false, 2).front();
        const auto id = static_cast<Point_id>(random() % 4);
        if (time % 3 == 0) {
          simulation.insert(motion);
        } else {
          simulation.set_motion(id, motion);
        }
        const Audit_report report = simulation.audit(Audit_level::certificates);
        ASSERT_TRUE(report.passed()) << report.failures.front();
        Motions motions;
        for (Point_id k = 0; k < simulation.triangulation().next_id(); ++k) {
          motions.push_back(simulation.triangulation().motion(k));
        }
        test::Image_contacts<> oracle(named.box, motions, options, time);
        recorder.contacts.clear();
        simulation.advance_to(time + 1);
        for (const Event& event : recorder.contacts) {
          const auto expected = oracle.step(time + 1);
          ASSERT_TRUE(expected) << named.name << ", run " << run;
          EXPECT_EQ(expected->time, event.time);
          EXPECT_EQ(expected->pair,
                    (Periodic_edge{{*event.point_a, *event.point_b}, event.added_offset}));
          ++contacts;
        }
        EXPECT_FALSE(oracle.step(time + 1)) << named.name << ", run " << run;
      }
    }
  }
  EXPECT_GT(contacts, 100U);
}

/// The contacts up to a time.
std::vector<Event> contacts_until(const Motions& motions, const Periodic_box_2& box,
                                  const Simulation_options& options, double time) {
  Simulation simulation(motions, options, 0, Periodic_kinetic_traits_2(box));
  Contact_recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(time);
  return recorder.contacts;
}

// Whole numbers, so that positions far away are exact; velocities are swapped, so that they stay
// whole.
TEST(Periodic_simulation, does_not_depend_on_which_images_are_given) {
  std::mt19937_64 random(4);
  for (const double shear : {0.0, 1.0}) {
    const Periodic_box_2 box({{8, 0}, {0, 0}}, {{0, 8}, {shear, 0}});
    const Motions motions = random_discs(random, 6, true, 3);
    Motions moved = motions;
    std::vector<Lattice_offset_2> offsets;
    for (Linear_motion_2& motion : moved) {
      const Lattice_offset_2 offset = {static_cast<int>(random() % 2001) - 1000,
                                       static_cast<int>(random() % 2001) - 1000};
      offsets.push_back(offset);
      motion.position.x += 8 * offset.x;
      motion.position.y += 8 * offset.y;
      motion.velocity.x += shear * offset.y;
    }
    const Simulation_options options = discs(0.5, log_contact);
    const std::vector<Event> expected = contacts_until(motions, box, options, 40);
    const std::vector<Event> found = contacts_until(moved, box, options, 40);
    EXPECT_GT(expected.size(), 30U);
    ASSERT_EQ(found.size(), expected.size());
    // Simultaneous contacts of two points are in the order of offsets.
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].time, expected[i].time);
      EXPECT_EQ(found[i].point_a, expected[i].point_a);
      EXPECT_EQ(found[i].point_b, expected[i].point_b);
      const Lattice_offset_2& of_a = offsets[*found[i].point_a];
      const Lattice_offset_2& of_b = offsets[*found[i].point_b];
      EXPECT_EQ(found[i].added_offset.x - of_a.x + of_b.x, expected[i].added_offset.x);
      EXPECT_EQ(found[i].added_offset.y - of_a.y + of_b.y, expected[i].added_offset.y);
    }
  }
}

TEST(Periodic_simulation, conserves_momentum_and_in_a_box_at_rest_energy) {
  for (const double shear : {0.0, 0.25}) {
    Motions motions;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> velocity(-1, 1);
    for (int i = 0; i < 36; ++i) {
      const double vx = velocity(random);
      motions.push_back({{1.0 * (i % 6), 1.0 * (i / 6)}, {vx, velocity(random)}, 0});
    }
    Simulation_options options = discs(0.4, collide_elastically);
    for (int i = 0; i < 36; ++i) options.masses.push_back(1 + i % 3);
    const Periodic_box_2 box({{6, 0}, {0, 0}}, {{0, 6}, {6 * shear, 0}});
    Simulation simulation(motions, options, 0, Periodic_kinetic_traits_2(box));
    struct Sums {
      long double energy = 0;
      long double x = 0;
      long double y = 0;
    };
    const auto sums = [&] {
      Sums result;
      for (Point_id id = 0; id < 36; ++id) {
        const Vector_2& v = simulation.triangulation().motion(id).velocity;
        const long double mass = simulation.mass(id);
        const long double x = v.x;
        const long double y = v.y;
        result.energy += mass * (x * x + y * y) / 2;
        result.x += mass * x;
        result.y += mass * y;
      }
      return result;
    };
    const Sums before = sums();
    simulation.advance_to(20);
    const Sums after = sums();
    const auto number =
        static_cast<long double>(simulation.triangulation()
                                     .counters()
                                     .events[static_cast<std::size_t>(Event_kind::collision)]);
    EXPECT_GT(number, 1000);
    // A collision changes the momenta of two discs of a mass of at most 3 by rounding their
    // velocities, which are less than 16.
    EXPECT_LT(std::abs(after.x - before.x), number * 2 * 3 * 16 * 0x1p-51L);
    EXPECT_LT(std::abs(after.y - before.y), number * 2 * 3 * 16 * 0x1p-51L);
    if (shear == 0) {
      EXPECT_LT(std::abs(after.energy - before.energy), number * before.energy * 0x1p-48L);
    } else {
      EXPECT_GT(after.energy, before.energy) << "shear heats the gas";
    }
  }
}

// ---- own images ----

TEST(Own_image, of_a_disc_in_a_shrinking_box_is_met_at_the_exact_time) {
  const Periodic_box_2 box({{8, 0}, {0, 0}}, {{0, 4}, {0, -0.5}});
  for (const auto& response : {Collision_response(log_contact), Collision_response(stop_both)}) {
    Simulation simulation({{{100, 3}, {1, 2}}}, discs(0.5, response), 0,
                          Periodic_kinetic_traits_2(box));
    const Own_image_error error = own_image(simulation, 7.5);
    EXPECT_EQ(error.point(), 0U);
    EXPECT_EQ(error.offset(), (Lattice_offset_2{0, 1}));
    EXPECT_EQ(error.time(), 6);
    EXPECT_EQ(simulation.current_time(), 6);
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
    // As between two events: a snapshot, and the same again.
    Simulation restored =
        Simulation::restore(simulation.snapshot(), response, Periodic_kinetic_traits_2(box));
    EXPECT_EQ(own_image(simulation, 7.5).time(), 6);
    EXPECT_EQ(own_image(restored, 7.5).time(), 6);
    // Without the disc the run goes on.
    simulation.erase(0);
    simulation.advance_to(7.5);
    EXPECT_EQ(simulation.current_time(), 7.5);
  }
}

// The vector (t - 8, 3/2) becomes as short as 2 at 8 - sqrt(7) / 2.
TEST(Own_image, of_a_disc_in_a_sheared_box_may_be_met_at_an_irrational_time) {
  const Periodic_box_2 box({{8, 0}, {0, 0}}, {{0, 1.5}, {1, 0}});
  Simulation simulation({{{0, 0}, {0, 0}}}, discs(1, collide_elastically), 2,
                        Periodic_kinetic_traits_2(box));
  const Own_image_error error = own_image(simulation, 100);
  const Polynomial expected({Integer(64 * 4 - 7), Integer(-64), Integer(4)});
  EXPECT_EQ(sign_at(expected, error.time()), CGAL::ZERO);
  EXPECT_LT(error.time(), 8);
  EXPECT_EQ(error.offset(), (Lattice_offset_2{1, -1}));
}

TEST(Own_image, may_touch_without_approach) {
  Simulation simulation({{{0, 0}, {1, 0}}}, discs(1, collide_elastically), 0,
                        Periodic_kinetic_traits_2(square(2)));
  EXPECT_EQ(simulation.advance_to(10), 0U);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Own_image, that_overlaps_is_refused) {
  // The shortest vector of this lattice is 3 (1, 0) - (2.5, 0.5), up to its sign.
  const Periodic_box_2 box({{1, 0}, {0, 0}}, {{2.5, 0.5}, {0, 0}});
  const Periodic_kinetic_traits_2 traits(box);
  const double length = std::sqrt(0.5);
  for (const bool is_too_large : {false, true}) {
    const double radius = is_too_large ? std::nextafter(length / 2, 1) : length / 2 - 0x1p-50;
    const auto make = [&] {
      Simulation simulation({{{0, 0}, {0, 0}}}, discs(radius, collide_elastically), 0, traits);
    };
    if (is_too_large) {
      EXPECT_THROW(make(), Own_image_error);
    } else {
      EXPECT_NO_THROW(make());
    }
    Simulation empty({}, discs(radius, collide_elastically), 0, traits);
    if (is_too_large) {
      EXPECT_THROW(empty.insert({{0, 0}, {0, 0}}), Own_image_error);
      EXPECT_EQ(empty.triangulation().next_id(), 0U);
    } else {
      empty.insert({{0, 0}, {0, 0}});
    }
    // Without a response discs do not matter.
    EXPECT_NO_THROW(Simulation({{{0, 0}, {0, 0}}}, discs(radius, nullptr), 0, traits));
  }
}

// ---- what else ----

TEST(Periodic_simulation, knows_each_image_that_overlaps) {
  // The discs overlap two images of each other.
  Simulation simulation({{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}}, discs(1.5, log_contact), 0,
                        Periodic_kinetic_traits_2(square(4)));
  EXPECT_EQ(simulation.overlapping_discs(0), (std::vector<Point_id>{1, 1}));
  EXPECT_EQ(simulation.overlapping_discs(1), (std::vector<Point_id>{0, 0}));
  simulation.set_motion(1, {{0.5, 0}, {0, 0}});
  EXPECT_EQ(simulation.overlapping_discs(0), (std::vector<Point_id>{1}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  Simulation_options strict = discs(1.5, collide_elastically);
  strict.refuses_overlaps = true;
  Simulation alone({{{0, 0}, {0, 0}}}, strict, 0, Periodic_kinetic_traits_2(square(4)));
  EXPECT_THROW(alone.insert({{2, 12}, {0, 0}}), Overlapping_discs_error);
  EXPECT_THROW(alone.insert({{6, 0}, {0, 0}}), Overlapping_discs_error);
}

TEST(Periodic_simulation, refuses_walls_and_discs_that_coincide) {
  const Periodic_kinetic_traits_2 traits(square(4));
  Simulation_options walls = discs(0.5, collide_elastically);
  walls.box = Box_2{0, 0, 4, 4};
  EXPECT_THROW(Simulation({}, walls, 0, traits), Precondition_error);
  const Motions twice = {{{0, 0}, {1, 0}}, {{4, 8}, {1, 0}}};
  EXPECT_THROW(Simulation(twice, discs(0.5, log_contact), 0, traits),
               Coincident_trajectories_error);
  Simulation without(twice, discs(0, nullptr), 0, traits);
  EXPECT_EQ(without.triangulation().number_of_hidden_points(), 1U);
  Simulation_options strict = discs(0.5, nullptr);
  strict.refuses_overlaps = true;
  EXPECT_THROW(Simulation(twice, strict, 0, traits), Overlapping_discs_error);
  strict.radius = 0;
  EXPECT_NO_THROW(Simulation(twice, strict, 0, traits));
}

TEST(Periodic_simulation, has_the_other_responses) {
  const Motions motions = {{{0, 0}, {1, 0}}, {{6, 0}, {0, 0}}};
  const Periodic_kinetic_traits_2 traits(square(8));
  const auto contacts_by = [&](Simulation& simulation, double time) {
    Contact_recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(time);
    simulation.remove_observer(recorder);
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
    return recorder.contacts.size();
  };
  Simulation stopping(motions, discs(0.5, stop_both), 0, traits);
  EXPECT_EQ(contacts_by(stopping, 100), 1U);
  EXPECT_EQ(stopping.triangulation().motion(0).position, (Vector_2{5, 0}));
  // Each goes around the box, less two diameters in all.
  Simulation swapping(motions, discs(0.5, swap_velocities), 0, traits);
  EXPECT_EQ(contacts_by(swapping, 5 + 6 + 6), 3U);
  Simulation erasing(motions, discs(0.5, erase_both), 0, traits);
  EXPECT_EQ(contacts_by(erasing, 100), 1U);
  EXPECT_EQ(erasing.triangulation().number_of_points(), 0U);
  erasing.insert({{0, 0}, {1, 0}});
  EXPECT_EQ(contacts_by(erasing, 200), 0U);
}

// A disc that has been stopped rests, but its images go on with the box.
TEST(Periodic_simulation, lets_stopped_discs_pass_in_a_box_that_moves) {
  const Periodic_box_2 box({{8, 0}, {0, 0}}, {{0, 8}, {0, -0.5}});
  Simulation simulation({{{0, 0}, {0, 0}}, {{0, 5}, {0, 0}}}, discs(0.5, stop_both), 0,
                        Periodic_kinetic_traits_2(box));
  simulation.advance_to(5);
  EXPECT_EQ(simulation.number_of_passes(), 1U);
  EXPECT_EQ(simulation.overlapping_discs(0), (std::vector<Point_id>{1}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Periodic_simulation, continues_from_a_snapshot) {
  std::mt19937_64 random(6);
  for (const auto& response :
       {Collision_response(collide_elastically), Collision_response(log_contact)}) {
    const Periodic_kinetic_traits_2 traits({{{8, 0}, {0, 0}}, {{0, 8}, {1, 0}}});
    const Motions motions = random_discs(random, 5, false, 2);
    Simulation simulation(motions, discs(1, response), 0, traits);
    simulation.schedule_motion(6, 1, {{3, 3}, {1, 1}, 6});
    test::expect_same_contacts_if_restored(simulation, response, traits, 2);
  }
}

}  // namespace
}  // namespace kinetri::periodic_simulation_test
