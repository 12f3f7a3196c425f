// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs of any radii, which may grow, in a periodic box: against the oracle that looks at all pairs
// of images, for every response, in boxes that are at rest, sheared, growing and shrinking; and
// what a periodic box does not allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/multiplier.h"
#include "support/periodic_contacts.h"

namespace kinetri::periodic_disc_simulation_test {
namespace {

using test::boxes;
using test::Contact_recorder;
using test::difference;
using test::Named_box;
using test::own_image;
using test::square;
using test::Totals;
using Traits = Periodic_disc_kinetic_traits_2;
using Simulation = Simulation_2<Traits>;
using Motions = std::vector<Disc_motion_2>;
using Oracle = test::Image_contacts<Disc_motion_2>;

Simulation_options responding(const Collision_response& response) {
  Simulation_options options;
  options.response = response;
  return options;
}

Disc_motion_2 disc(const Vector_2& place, const Vector_2& velocity, double radius,
                   double growth = 0, double epoch = 0) {
  return {{place, velocity, epoch}, radius, growth, 0};
}

/// Random discs: whole numbers and halves, which lead to simultaneous contacts, or any; points,
/// tiny and large ones.
class Source {
 public:
  explicit Source(unsigned seed) : random(seed) {}

  double real(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random);
  }
  double number(bool is_whole, int least, int greatest) {
    return is_whole ? std::uniform_int_distribution<int>(least, greatest)(random)
                    : real(least, greatest);
  }
  bool one_in(unsigned n) { return random() % n == 0; }

  Disc_motion_2 next(bool is_whole, int speed, double greatest_radius) {
    const double x = number(is_whole, -8, 16);
    const double y = number(is_whole, -8, 16);
    const double vx = number(is_whole, -speed, speed);
    const double vy = number(is_whole, -speed, speed);
    double radius = 0;
    if (is_whole) {
      radius = number(true, 0, static_cast<int>(2 * greatest_radius)) / 2;
    } else if (!one_in(5)) {
      radius = one_in(4) ? std::ldexp(1, -20) : greatest_radius * real(0, 1);
    }
    return disc({x, y}, {vx, vy}, radius);
  }
  /// Each with a growth that is zero or of either sign, and no radius less than zero until then.
  Motions growing(Motions discs, bool is_whole, double until) {
    for (Disc_motion_2& disc : discs) {
      const double growth = number(is_whole, -2, 2) / 16;
      if (one_in(2) && disc.radius + growth * until > 0) disc.growth = growth;
      if (one_in(4) && disc.radius == 0) disc.growth = std::abs(growth);
    }
    return discs;
  }
  Motions discs(std::size_t number, bool is_whole, int speed, double greatest_radius) {
    Motions result;
    for (std::size_t i = 0; i < number; ++i) {
      result.push_back(next(is_whole, speed, greatest_radius));
    }
    return result;
  }

  std::mt19937_64 random;
};

struct Named_response {
  const char* name;
  Collision_response response;
};
std::vector<Named_response> responses() {
  std::vector<Named_response> result;
  for (const auto& named : named_responses) {
    if (named.response != nullptr) result.push_back({named.name.data(), named.response});
  }
  return result;
}

/// Compares runs of discs that may overlap if `overlap`, and grow if `grow`.
void compare(unsigned seed, bool overlap, bool grow, int runs, double most_time, std::size_t most,
             Totals& totals) {
  Source source(seed);
  std::size_t refused = 0;
  for (const Named_box& named : boxes()) {
    for (const Named_response& response : responses()) {
      for (int run = 0; run < runs; ++run) {
        const bool is_whole = run % 2 == 0;
        Simulation_options options = responding(response.response);
        options.refuses_overlaps = !overlap;
        options.max_contacts_per_instant = 50;  // three that overlap may swap velocities forever
        // Until there are discs that are not refused.
        for (bool is_done = false; !is_done;) {
          const bool is_alone = run % 4 < 2 && source.one_in(3);
          const std::size_t number = is_alone ? 1 : 2 + source.random() % 6;
          const double until = is_alone ? named.until : most_time;
          Motions motions = source.discs(number, is_whole, 2, is_alone ? 3.5 : overlap ? 2.5 : 1.5);
          if (grow) motions = source.growing(std::move(motions), is_whole, until);
          options.masses.clear();
          for (std::size_t i = 0; i < number; ++i) {
            options.masses.push_back(static_cast<double>(1 + source.random() % 3));
          }
          const std::vector<Periodic_edge> overlaps =
              Oracle(named.box, motions, options).overlaps();
          const auto is_own = [](const Periodic_edge& pair) { return pair.ids[0] == pair.ids[1]; };
          const bool overlap_own = std::ranges::any_of(overlaps, is_own);
          try {
            const std::string problem =
                difference<Traits>(named.box, motions, options, until, most, totals);
            ASSERT_EQ(problem, "") << named.name << ", " << response.name << ", run " << run;
            ASSERT_FALSE(overlap_own);
            ASSERT_TRUE(overlap || overlaps.empty());
            is_done = true;
          } catch (const Own_image_error& error) {
            ASSERT_TRUE(std::ranges::any_of(overlaps, [&](const Periodic_edge& pair) {
              return is_own(pair) && pair.ids[0] == error.point();
            }));
            ++refused;
          } catch (const Overlapping_discs_error& error) {
            ASSERT_FALSE(overlap_own);
            std::vector<Edge_ids> expected;
            for (const Periodic_edge& pair : overlaps) expected.push_back(pair.ids);
            ASSERT_EQ(error.pairs(), expected);
            ++refused;
          } catch (const Coincident_trajectories_error&) {
            ++refused;
          }
        }
      }
    }
  }
  std::printf(
      "%zu contacts; %zu runs with %zu; %zu ended at an own image; %zu endless; %zu hidden discs; "
      "%zu inputs refused\n",
      totals.contacts, totals.full, most, totals.own_images, totals.endless, totals.hidden,
      refused);
  EXPECT_TRUE(overlap || refused > 0U);
}

TEST(Periodic_discs, have_the_contacts_of_all_pairs_of_images) {
  Totals totals;
  compare(1, false, false, test::cases(3), 30, 40, totals);
  EXPECT_GT(totals.contacts, 300U);
  EXPECT_GT(totals.own_images, 3U);
}

TEST(Periodic_discs, that_grow_have_the_contacts_of_all_pairs_of_images) {
  Totals totals;
  compare(2, false, true, test::cases(3), 16, 40, totals);
  EXPECT_GT(totals.contacts, 300U);
  EXPECT_GT(totals.own_images, 5U);
}

TEST(Periodic_discs, that_overlap_have_the_contacts_of_all_pairs_of_images) {
  Totals totals;
  compare(3, true, false, test::cases(3), 8, 80, totals);
  EXPECT_GT(totals.contacts, 300U);
  EXPECT_GT(totals.hidden, 200U);
}

TEST(Periodic_discs, that_overlap_and_grow_have_the_contacts_of_all_pairs_of_images) {
  Totals totals;
  compare(4, true, true, test::cases(3), 8, 80, totals);
  EXPECT_GT(totals.contacts, 300U);
  EXPECT_GT(totals.hidden, 200U);
}

// ---- changes ----

/// The next contacts of a simulation, up to a time, are those of a new oracle. Returns their
/// number.
std::size_t compare_until(Simulation& simulation, double until) {
  const Audit_report report = simulation.audit(Audit_level::certificates);
  EXPECT_TRUE(report.passed()) << report.failures.front();
  std::vector<std::optional<Disc_motion_2>> motions;
  for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) {
    const bool is_there = simulation.triangulation().contains(id);
    motions.push_back(is_there ? std::optional(simulation.triangulation().motion(id))
                               : std::nullopt);
  }
  const Traits& traits = simulation.triangulation().traits();
  Oracle oracle(traits.box(), motions, simulation.options(), simulation.current_time(),
                simulation.snapshot().in_contact);
  Contact_recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(until);
  simulation.remove_observer(recorder);
  for (const Event& event : recorder.contacts) {
    const auto expected = oracle.step(until);
    const test::Image_contact found = {event.time,
                                       {{*event.point_a, *event.point_b}, event.added_offset}};
    if (!expected || expected->time != found.time || expected->pair != found.pair) {
      ADD_FAILURE() << test::text(found) << ", expected "
                    << (expected ? test::text(*expected) : "none");
      return 0;
    }
  }
  const auto missed = oracle.step(until);
  EXPECT_FALSE(missed) << test::text(*missed);
  return recorder.contacts.size();
}

// One disc at a time, or all at once; as many that each way of finding new overlaps is taken.
TEST(Periodic_discs, have_these_contacts_after_changes) {
  Source source(5);
  std::size_t contacts = 0;
  std::size_t refused = 0;
  const auto may_be_refused = [&](const auto& change) {
    try {
      change();
    } catch (const Own_image_error&) {
      ++refused;
    } catch (const Coincident_trajectories_error&) {
      ++refused;
    }
  };
  for (const Named_box& named : boxes()) {
    for (int run = 0; run < test::cases(4); ++run) {
      const bool is_whole = run % 2 == 0;
      Simulation simulation({}, responding(run % 4 < 2 ? log_contact : erase_both), 0,
                            Traits(named.box));
      const double most_time = 6;
      const auto discs = [&](std::size_t number) {
        Motions result = source.discs(number, is_whole, 2, 2);
        if (run % 4 % 3 == 0) result = source.growing(std::move(result), is_whole, most_time);
        for (Disc_motion_2& disc : result) disc.epoch = simulation.current_time().to_double();
        if (source.one_in(40)) result[0].radius = 5;  // overlaps an image of itself
        return result;
      };
      for (std::size_t i = 0; i < 6; ++i) may_be_refused([&] { simulation.insert(discs(1)[0]); });
      for (double time = 1; time <= most_time; ++time) {
        contacts += compare_until(simulation, time);
        ASSERT_FALSE(testing::Test::HasFailure()) << named.name << ", run " << run;
        std::vector<Point_id> ids;
        for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) {
          if (simulation.triangulation().contains(id)) ids.push_back(id);
        }
        may_be_refused([&] {
          if (ids.size() < 6 || source.one_in(3)) {
            for (int i = 0; i < 4; ++i) simulation.insert(discs(1)[0]);
          } else if (source.one_in(2)) {
            const Motions motions = discs(ids.size());
            simulation.set_motions(ids, motions);
          } else if (source.one_in(2)) {
            simulation.set_motion(ids[source.random() % ids.size()], discs(1)[0]);
          } else {
            simulation.erase(ids[source.random() % ids.size()]);
          }
        });
      }
    }
  }
  std::printf("%zu contacts, %zu changes refused\n", contacts, refused);
  EXPECT_GT(contacts, 400U);
  EXPECT_GT(refused, 0U);
}

// ---- by hand ----

// A point in a large disc, near the side of the box: they part, and meet at the image beyond it.
TEST(Periodic_discs, touch_where_their_radii_say) {
  Simulation simulation({disc({1, 1}, {0, 0}, 3), disc({0, 1}, {-1, 0}, 0)},
                        responding(collide_elastically), 0, Traits(square(8)));
  EXPECT_EQ(simulation.triangulation().number_of_hidden_points(), 1U);
  Contact_recorder recorder;
  simulation.add_observer(recorder);
  simulation.advance_to(5);
  ASSERT_EQ(recorder.contacts.size(), 1U);
  EXPECT_EQ(recorder.contacts[0].time, 4);
  EXPECT_EQ(recorder.contacts[0].added_offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(simulation.triangulation().motion(0).velocity, (Vector_2{-1, 0}));
  EXPECT_EQ(simulation.triangulation().motion(0).radius, 3);
}

TEST(Periodic_discs, know_each_image_that_overlaps) {
  Simulation simulation(
      {disc({0, 0}, {0, 0}, 2), disc({2, 0}, {0, 0}, 0.5), disc({2, 2}, {0, 0}, 1)},
      responding(log_contact), 0, Traits(square(4)));
  EXPECT_EQ(simulation.overlapping_discs(0), (std::vector<Point_id>{1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(simulation.overlapping_discs(1), (std::vector<Point_id>{0, 0}));
  simulation.set_motion(2, disc({0.5, 0}, {0, 0}, 0));
  EXPECT_EQ(simulation.overlapping_discs(0), (std::vector<Point_id>{1, 1, 2}));
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Periodic_discs, that_overlap_are_refused_with_their_images) {
  Simulation_options strict = responding(collide_elastically);
  strict.refuses_overlaps = true;
  const Traits traits(square(4));
  Simulation simulation({disc({0, 0}, {0, 0}, 1.5)}, strict, 0, traits);
  EXPECT_THROW(simulation.insert(disc({22, 0.5}, {0, 0}, 0.75)), Overlapping_discs_error);
  EXPECT_NO_THROW(simulation.insert(disc({22, 0.5}, {0, 0}, 0.5)));
  // Without a response discs may coincide; those with an area overlap.
  strict.response = nullptr;
  for (const double radius : {0.0, 0.5}) {
    const Motions twice = {disc({0, 0}, {1, 0}, radius), disc({4, 8}, {1, 0}, radius)};
    EXPECT_THROW(Simulation(twice, responding(log_contact), 0, traits),
                 Coincident_trajectories_error);
    if (radius > 0) {
      EXPECT_THROW(Simulation(twice, strict, 0, traits), Overlapping_discs_error);
    } else {
      EXPECT_NO_THROW(Simulation(twice, strict, 0, traits));
    }
  }
}

TEST(Periodic_discs, do_not_shrink_beyond_nothing) {
  Simulation simulation({disc({0, 0}, {0, 0}, 1, -0.5)}, responding(log_contact), 0,
                        Traits(square(4)));
  simulation.advance_to(2);
  EXPECT_THROW(simulation.advance_to(3), Negative_radius_error);
  EXPECT_THROW(simulation.insert(disc({1, 0}, {0, 0}, -1)), Negative_radius_error);
}

// ---- own images ----

// The lattice vectors have the lengths 8 and 4 - t / 2.
TEST(Own_image_of_discs, is_met_by_the_disc_that_is_greatest_then) {
  const Periodic_box_2 box({{8, 0}, {0, 0}}, {{0, 4}, {0, -0.5}});
  Simulation simulation({disc({0, 0}, {0, 0}, 0.5), disc({4, 1}, {0, 0}, 1, -0.125),
                         disc({6, 50}, {0, 1}, 0.25, 0.125)},
                        responding(log_contact), 0, Traits(box));
  // The diameter of the third one, 1/2 + t / 4, is 4 - t / 2 at 14/3.
  const Own_image_error error = own_image(simulation, 7.5);
  EXPECT_EQ(error.point(), 2U);
  EXPECT_EQ(error.offset(), (Lattice_offset_2{0, 1}));
  EXPECT_EQ(sign_at(Polynomial{Integer(-14), Integer(3)}, error.time()), CGAL::ZERO);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  // As between two events: a snapshot, and the same again.
  Simulation restored = Simulation::restore(simulation.snapshot(), log_contact, Traits(box));
  EXPECT_EQ(own_image(simulation, 7.5).time(), error.time());
  EXPECT_EQ(own_image(restored, 7.5).time(), error.time());
  // With a smaller disc the run goes on, up to the next one.
  simulation.set_motion(2, disc({6, 0}, {0, 1}, 0.125));
  const Own_image_error next = own_image(simulation, 7.5);
  EXPECT_EQ(next.point(), 0U);
  EXPECT_EQ(next.time(), 6);
}

TEST(Own_image_of_discs, that_overlaps_is_refused) {
  const Traits traits(square(4));
  const Collision_response response = collide_elastically;
  EXPECT_THROW(Simulation({disc({0, 0}, {0, 0}, 1), disc({2, 2}, {0, 0}, 2.5)},
                          responding(response), 0, traits),
               Own_image_error);
  Simulation simulation({disc({0, 0}, {0, 0}, 1), disc({2, 2}, {0, 0}, 1)}, responding(response), 0,
                        traits);
  EXPECT_THROW(simulation.insert(disc({2, 0}, {0, 0}, 2.5)), Own_image_error);
  EXPECT_EQ(simulation.triangulation().next_id(), 2U);
  EXPECT_THROW(simulation.set_motion(1, disc({2, 2}, {0, 0}, 2.5)), Own_image_error);
  EXPECT_EQ(simulation.triangulation().motion(1).radius, 1);
  // Of changes at one time the others are made.
  simulation.schedule_motion(1, 0, disc({0, 0}, {0, 0}, 2.5));
  simulation.schedule_motion(1, 1, disc({2, 2}, {0, 0}, 0.5));
  simulation.schedule_insert(1, disc({2, 0}, {0, 0}, 2.5));
  EXPECT_THROW(simulation.advance_to(2), Own_image_error);
  EXPECT_THROW(simulation.advance_to(2), Own_image_error);
  simulation.advance_to(2);
  EXPECT_EQ(simulation.triangulation().motion(0).radius, 1);
  EXPECT_EQ(simulation.triangulation().motion(1).radius, 0.5);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  // Snapshots with such a disc are none of a simulation.
  Simulation::Snapshot snapshot = simulation.snapshot();
  snapshot.triangulation.motions[1]->radius = 2.5;
  EXPECT_THROW(Simulation::restore(snapshot, response, traits), Snapshot_error);
  // Without a response discs do not matter.
  EXPECT_NO_THROW(Simulation({disc({0, 0}, {0, 0}, 2.5)}, Simulation_options(), 0, traits));
}

// ---- snapshots ----

TEST(Periodic_discs, continue_from_a_snapshot) {
  Source source(6);
  const Traits traits({{{8, 0}, {0, 0}}, {{0, 8}, {1, 0}}});
  for (const auto& response :
       {Collision_response(swap_velocities), Collision_response(log_contact)}) {
    const Motions motions = source.growing(source.discs(8, false, 2, 1.5), false, 9);
    Simulation simulation(motions, responding(response), 0, traits);
    simulation.schedule_motion(6, 1, disc({3, 3}, {1, 1}, 1, 0, 6));
    test::expect_same_contacts_if_restored(simulation, response, traits, 5);
  }
}

// ---- one radius ----

// The events of contacts are those of the simulation of discs of one radius.
TEST(Periodic_discs, of_one_radius_have_the_contacts_of_equal_discs) {
  Source source(7);
  for (const Named_box& named : boxes()) {
    const Motions motions = source.discs(12, false, 2, 0);
    std::vector<Linear_motion_2> points;
    Motions discs;
    for (const Disc_motion_2& motion : motions) {
      points.push_back(motion);
      discs.push_back({motion, 0.5, 0, 0});
    }
    Simulation_options options = responding(collide_elastically);
    Simulation simulation(discs, options, 0, Traits(named.box));
    options.radius = 0.5;
    Simulation_2<Periodic_kinetic_traits_2> equal(points, options, 0,
                                                  Periodic_kinetic_traits_2(named.box));
    Contact_recorder found;
    Contact_recorder expected;
    simulation.add_observer(found);
    equal.add_observer(expected);
    simulation.advance_to(8);
    equal.advance_to(8);
    EXPECT_GT(expected.contacts.size(), 30U);
    ASSERT_EQ(found.contacts.size(), expected.contacts.size()) << named.name;
    for (std::size_t i = 0; i < found.contacts.size(); ++i) {
      EXPECT_EQ(found.contacts[i].time, expected.contacts[i].time);
      EXPECT_EQ(found.contacts[i].point_a, expected.contacts[i].point_a);
      EXPECT_EQ(found.contacts[i].point_b, expected.contacts[i].point_b);
      EXPECT_EQ(found.contacts[i].added_offset, expected.contacts[i].added_offset);
    }
    for (Point_id id = 0; id < points.size(); ++id) {
      EXPECT_EQ(center(simulation.triangulation().motion(id)), equal.triangulation().motion(id));
    }
  }
}

}  // namespace
}  // namespace kinetri::periodic_disc_simulation_test
