// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closest approaches in periodic boxes, compared with all pairs of images, and with the lives of
// all edges, in exact arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/observers/closest_approaches.h"
#include "kinetri/observers/neighbor_lives.h"
#include "observers/random_runs.h"
#include "support/image_pairs.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_closest_test {
namespace {

using Points = Periodic_kinetic_traits_2;
using Discs = Periodic_disc_kinetic_traits_2;

constexpr double end = 3;

Periodic_box_2 square(double side) {
  return {{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}};
}

Disc_motion_2 disc(const Vector_2& position, const Vector_2& velocity, double radius,
                   double growth = 0, double epoch = 0) {
  return {{position, velocity, epoch}, radius, growth, epoch};
}

// ---- the oracle ----

struct Expected {
  Algebraic_number gap;
  Algebraic_number time;
  Periodic_edge pair;
  double distance = 0;

  friend bool operator<(const Expected& a, const Expected& b) {
    return std::tie(a.gap, a.time, a.pair) < std::tie(b.gap, b.time, b.pair);
  }
};

/// The first least gap of two images with these motions: at an end, or where its derivative
/// vanishes.
template <class Motion>
Expected least_gap(const Periodic_edge& pair, const Motion& p, const Motion& q, double radius,
                   const Algebraic_number& since, const Algebraic_number& until) {
  const test::encounter_oracle::Functions functions(p, q, radius, 0);
  std::vector<Algebraic_number> times = {since};
  for (const auto& root :
       test::encounter_oracle::roots_between(functions.critical(), since, until)) {
    times.push_back(root);
  }
  times.push_back(until);
  std::optional<Expected> result;
  for (const Algebraic_number& time : times) {
    const Algebraic_number gap =
        root_difference_at(functions.squared_distance, functions.radii, time);
    if (result && gap >= result->gap) continue;
    result = Expected{gap, time, pair,
                      root_difference_at(functions.squared_distance, {}, time).to_double()};
  }
  return *result;
}

void expect_equal(const Approach& found, const Expected& expected) {
  EXPECT_EQ(found.points, expected.pair.ids);
  EXPECT_EQ(found.offset, expected.pair.offset);
  EXPECT_EQ(found.time, expected.time);
  EXPECT_EQ(found.gap, expected.gap.to_double());
  EXPECT_EQ(found.distance, expected.distance);
}

template <class Traits>
struct Observed_run {
  using Motion = typename Traits::Motion;

  Observed_run(const std::vector<Motion>& motions, const Simulation_options& options,
               const Periodic_box_2& in, std::size_t number)
      : box(in),
        simulation(motions, options, 0, Traits(box)),
        recorder(simulation),
        closest(simulation, number) {}

  /// The least gap of all pairs of images, if it is at most `range`.
  std::optional<Expected> least(double range) const {
    const double radius = simulation.options().radius;
    std::optional<Expected> result;
    test::for_each_pair_of_images(
        box, recorder.legs(), range + 2 * radius, end,
        [&](const Periodic_edge& pair, const auto& p, const auto& q) {
          for (const auto& a : p) {
            for (const auto& b : q) {
              const Algebraic_number since = std::max(a.since, b.since);
              const Algebraic_number until = std::min(*a.until, *b.until);
              if (since > until) continue;
              // At the start both may be there before the first of them turns.
              if (since == until && !(a.is_before(since) && b.is_before(since))) continue;
              Expected next = least_gap(pair, a.motion, b.motion, radius, since, until);
              if (!result || next < *result) result = std::move(next);
            }
          }
        });
    return result;
  }

  void expect_least_first() {
    const auto found = closest.approaches();
    ASSERT_FALSE(found.empty());
    const auto expected = least(found[0].gap + 0.125);
    ASSERT_TRUE(expected);
    expect_equal(found[0], *expected);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].gap, found[i].gap);
  }

  Periodic_box_2 box;
  Simulation_2<Traits> simulation;
  test::Leg_recorder<Traits> recorder;
  Closest_approaches<Traits> closest;
};

double integer(std::mt19937& random, int least, int most) {
  return double(least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1)));
}

Linear_motion_2 random_motion(std::mt19937& random, double epoch = 0) {
  const double x = integer(random, -5, 5);
  const double y = integer(random, -5, 5);
  const double vx = integer(random, -2, 2);
  return {{x, y}, {vx, integer(random, -2, 2)}, epoch};
}

Disc_motion_2 random_disc(std::mt19937& random, double epoch = 0) {
  const Linear_motion_2 center = random_motion(random, epoch);
  const double radius = integer(random, 0, 4) / 2;
  // No radius is negative up to the end.
  const double growth = radius >= 1 ? integer(random, -2, 2) / 8 : 0.25;
  return disc(center.position, center.velocity, radius, growth, epoch);
}

template <class Motion>
std::vector<Motion> random_motions(std::mt19937& random, std::size_t number) {
  std::vector<Motion> result;
  while (result.size() < number) {
    if constexpr (HasWeight<Motion>) {
      result.push_back(random_disc(random));
    } else {
      result.push_back(random_motion(random));
    }
  }
  return result;
}

/// A box of each kind in turn.
Periodic_box_2 random_box(std::mt19937& random, unsigned seed) {
  return test::random_periodic_box(random, static_cast<int>(seed % test::periodic_box_kinds),
                                   seed % 3 == 0 ? 3 : 6, end);
}

std::string name_of(unsigned seed) {
  return "seed " + std::to_string(seed) + ", " +
         test::periodic_box_kind(seed % test::periodic_box_kinds);
}

// ---- by hand ----

TEST(Periodic_closest, is_that_of_images) {
  // They meet across the border of the box, and come near once more later.
  Observed_run<Points> run({{{9, 5}, {1, 0}, 0}, {{4, 6}, {0, 0}, 0}}, {}, square(10), 9);
  run.simulation.advance_to(16.0);
  const auto found = run.closest.approaches();
  ASSERT_GE(found.size(), 2U);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(found[0].time, Algebraic_number(5.0));
  EXPECT_EQ(found[0].distance, 1);
  EXPECT_EQ(found[1].offset, (Lattice_offset_2{2, 0}));
  EXPECT_EQ(found[1].time, Algebraic_number(15.0));
  EXPECT_EQ(found[1].distance, 1);
}

TEST(Periodic_closest, of_a_point_alone_is_that_of_its_own_image) {
  // The lattice shrinks from 4 to 1 along x.
  Observed_run<Points> run({{{0, 0}, {1, 1}, 0}}, {}, {{{4, 0}, {-1, 0}, 0}, {{0, 3}, {0, 0}, 0}},
                           2);
  run.simulation.advance_to(3.0);
  const auto found = run.closest.approaches();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 0}));
  EXPECT_EQ(found[0].offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(found[0].time, Algebraic_number(3.0));
  EXPECT_EQ(found[0].distance, 1);
  EXPECT_EQ(found[1].offset, (Lattice_offset_2{0, 1}));
  EXPECT_EQ(found[1].time, Algebraic_number(0.0));
  EXPECT_EQ(found[1].distance, 3);
}

// Discs that overlap, and pass through each other, in a run without a response.
TEST(Periodic_closest, of_discs_needs_no_response) {
  Observed_run<Discs> run(
      {disc({1, 10}, {1, 0}, 3), disc({-1, 10}, {-1, 0}, 3), disc({10, 10}, {}, 0.25)}, {},
      square(20), 3);
  const auto at_start = run.closest.approaches();
  EXPECT_EQ(at_start.at(0).points, (Edge_ids{0, 1}));
  EXPECT_EQ(at_start[0].gap, -4);
  run.simulation.advance_to(end);
  run.expect_least_first();
}

// ---- all pairs of images, and all edges ----

// Every pair that ever had an edge, nearest first.
TEST(Periodic_closest, are_the_least_distances_of_all_edges_in_the_exact_order) {
  std::size_t number = 0;
  std::size_t own = 0;
  std::size_t several = 0;
  for (unsigned seed = 0; seed < test::cases(24u); ++seed) {
    SCOPED_TRACE(name_of(seed));
    std::mt19937 random(seed);
    const Periodic_box_2 box = random_box(random, seed);
    const auto motions = random_motions<Linear_motion_2>(random, 1 + seed / 4 % 5);
    Observed_run<Points> run(motions, {}, box, 1000);
    Neighbor_lives<Points> lives(run.simulation);
    run.simulation.advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(run.closest.approaches());
    run.simulation.advance_to(end);
    std::map<Periodic_edge, Expected> least;
    const auto add = [&](const Periodic_edge& pair, const Algebraic_number& since,
                         const Algebraic_number& until) {
      Expected next =
          least_gap(pair, Image_motion_2{motions[pair.ids[0]], {}, &run.box},
                    Image_motion_2{motions[pair.ids[1]], pair.offset, &run.box}, 0, since, until);
      const auto [known, is_new] = least.try_emplace(pair, next);
      if (!is_new && next < known->second) known->second = std::move(next);
    };
    for (const Neighbor_life& life : lives.lives()) {
      add({life.points, life.offset}, life.begin, life.end);
    }
    // An edge that begins at the end has no life then.
    for (const Periodic_edge& pair : run.simulation.triangulation().periodic_edges()) {
      add(pair, end, end);
    }
    std::vector<Expected> expected;
    for (const auto& [pair, approach] : least) expected.push_back(approach);
    std::sort(expected.begin(), expected.end());
    const auto found = run.closest.approaches();
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) expect_equal(found[i], expected[i]);
    run.expect_least_first();
    if (testing::Test::HasFailure()) return;
    number += found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      own += found[i].points[0] == found[i].points[1];
      several += i > 0 && found[i].points == found[i - 1].points;
    }
  }
  EXPECT_GT(number, 400U);
  EXPECT_GT(own, 80U);
  EXPECT_GT(several, 80U);
}

/// A point turns, jumps, moves by a lattice vector, comes or goes.
template <class Traits>
void change(Observed_run<Traits>& run, std::mt19937& random) {
  using Motion = typename Traits::Motion;
  const auto& triangulation = run.simulation.triangulation();
  const double now = run.simulation.current_time().to_double();
  const auto id = static_cast<Point_id>(random() % triangulation.next_id());
  const auto what = static_cast<unsigned>(random() % 5);
  const auto other_motion = [&]() -> Motion {
    if constexpr (HasWeight<Motion>) {
      return random_disc(random, now);
    } else {
      return random_motion(random, now);
    }
  };
  if (what == 0 && triangulation.next_id() < 8) {
    run.simulation.insert(other_motion());
  } else if (!triangulation.contains(id)) {
    return;
  } else if (what == 1 && triangulation.number_of_points() > 1) {
    run.simulation.erase(id);
  } else if (what == 2) {
    run.simulation.set_motion(id, other_motion());
  } else if (what == 3) {
    Motion motion = triangulation.motion(id);
    const Linear_motion_2& a = run.box.first();
    const Vector_2 there = rounded_place(a, epoch_of(motion));
    motion.position = {motion.position.x + there.x, motion.position.y + there.y};
    motion.velocity = {motion.velocity.x + a.velocity.x, motion.velocity.y + a.velocity.y};
    run.simulation.set_motion(id, motion);
  } else {
    const Vector_2 velocity = {integer(random, -2, 2), integer(random, -2, 2)};
    run.simulation.set_velocities({&id, 1}, {&velocity, 1});
  }
}

template <class Traits>
void expect_least_of_changing_runs(unsigned number, double radius) {
  for (unsigned seed = 0; seed < test::cases(number); ++seed) {
    SCOPED_TRACE(name_of(seed));
    std::mt19937 random(seed);
    const Periodic_box_2 box = random_box(random, seed);
    Simulation_options options;
    options.radius = radius;
    Observed_run<Traits> run(random_motions<typename Traits::Motion>(random, 1 + seed / 4 % 5),
                             options, box, 3);
    while (run.simulation.current_time() < Algebraic_number(end)) {
      for (auto i = random() % 4; i > 0; --i) change(run, random);
      run.simulation.advance_to(run.simulation.current_time().to_double() + 0.5);
      if (random() % 4 == 0) static_cast<void>(run.closest.approaches());
    }
    run.expect_least_first();
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Periodic_closest, of_points_that_change_begins_with_the_closest_of_all_pairs) {
  expect_least_of_changing_runs<Points>(40, 0);
}

TEST(Periodic_closest, of_discs_of_one_radius_begins_with_the_closest_of_all_pairs) {
  expect_least_of_changing_runs<Points>(16, 0.1);
}

// Of any size: they overlap images of others and of themselves, and are hidden.
TEST(Periodic_closest, of_discs_of_any_size_begins_with_the_closest_of_all_pairs) {
  expect_least_of_changing_runs<Discs>(40, 0);
}

TEST(Periodic_closest, of_discs_that_collide_begins_with_the_closest_of_all_pairs) {
  std::size_t contacts = 0;
  for (const auto response : {collide_elastically, log_contact, erase_both}) {
    for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937_64 random(seed);
      const Periodic_box_2 box({{12, 0}, {0, 0}, 0}, {{0, 12}, {seed % 2 == 0 ? 0 : 1.0, 0}, 0});
      std::vector<Disc_motion_2> discs;
      for (const auto& motion : test::random_motions(8, 12, 3, seed)) {
        discs.push_back({motion, std::uniform_real_distribution<double>(0.1, 1.5)(random), 0, 0});
      }
      Simulation_options options;
      options.response = response;
      Observed_run<Discs> run(discs, options, box, 3);
      run.simulation.advance_to(end);
      run.expect_least_first();
      if (testing::Test::HasFailure()) return;
      const auto& counts = run.simulation.triangulation().counters().events;
      contacts += counts[static_cast<std::size_t>(Event_kind::collision)];
    }
  }
  EXPECT_GT(contacts, 40U);
}

}  // namespace
}  // namespace kinetri::periodic_closest_test
