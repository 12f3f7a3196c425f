// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time windows in periodic boxes against the sequential loop, as regions_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "support/motions.h"
#include "support/multiplier.h"
#include "support/periodic_runs.h"
#include "support/region_runs.h"

namespace kinetri::periodic_regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::difference_of_states;
using test::discs_of;
using test::options_of;
using Traits = Periodic_kinetic_traits_2;
using Disc_traits = Periodic_disc_kinetic_traits_2;
using Kinetic = Kinetic_triangulation_2<Traits>;

// At rest, sheared, growing, and shrinking to nothing at time 5; `side` is about its size.
Periodic_box_2 box_of(double side, unsigned kind) {
  const double rate = side / 5;
  switch (kind % 4) {
    case 0:
      return {{{side, 0}, {0, 0}, 0}, {{side / 4, side}, {0, 0}, 0}};
    case 1:
      return {{{side, 0}, {0, 0}, 0}, {{0, side}, {3 * rate, 0}, 0}};
    case 2:
      return {{{side, 0}, {rate, 0}, 0}, {{0, side}, {0, rate}, 0}};
    default:
      return {{{side, 0}, {-rate, 0}, 0}, {{0, side}, {0, -rate}, 0}};
  }
}

// Points far outside of the box too.
TEST(Periodic_regions, run_random_points_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    const std::size_t n = 10 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    const double events = seed % 4 == 0 ? 0.02 : 0.2 * (seed % 4) * (seed % 5 + 1);
    ASSERT_EQ(difference_from_loop(test::random_motions(n, 3 * side, 5, seed), {0.5, 1.25},
                                   options_of(1 + seed * 7 % 64, events), sum,
                                   Traits(box_of(side, seed))),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Long windows and many small regions.
TEST(Periodic_regions, undo_flips_that_come_too_early) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    const std::size_t n = 30 + seed * 37 % 300;
    const Traits traits(box_of(seed % 3 == 2 ? 60 : 100, seed));
    const auto motions =
        seed % 3 == 2 ? test::grid_motions(n, 60, 50, seed) : test::random_motions(n, 100, 5, seed);
    Kinetic plain(motions, 0, traits);
    Kinetic kinetic(motions, 0, traits);
    auto run = detail::region_run_of(kinetic, options_of(2 + seed % 63, 0.05 * (1u << (seed % 8))));
    for (const double share : {0.25, 1.0}) {
      const double time = share * (seed % 3 == 2 ? 0.2 : 1);
      plain.advance_to(time);
      run.advance_to(time);
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
    }
    test::add(sum, run.counters());
  }
  EXPECT_GT(sum.rolled_back, 0u);
  EXPECT_GT(sum.truncated, 0u);
}

// Small integers: much happens at one time. With few points two sides of a quadrilateral are one
// edge.
TEST(Periodic_regions, run_points_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(24u); ++seed) {
    test::Random random(seed);
    const int range = 2 + static_cast<int>(seed % 7);
    const Periodic_box_2 box = test::random_box(random, range);
    const auto motions = test::random_motions(random, 1 + static_cast<int>(seed % 24), range);
    std::vector<Algebraic_number> times = {1.0, Rational(7, 3)};
    if (const auto collapse = box.collapse_after(0)) {
      std::erase_if(times, [&](const Algebraic_number& time) { return time >= *collapse; });
    }
    if (times.empty()) continue;
    ASSERT_EQ(difference_from_loop(motions, times, options_of(1 + seed % 9, 0.1 + seed % 3), sum,
                                   Traits(box)),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Some hide others; weights are equal in each fourth run.
TEST(Periodic_regions, run_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(16u); ++seed) {
    const bool is_grid = seed % 2 == 1;
    const std::size_t n = is_grid ? 5 + seed % 40 : 30 + 13 * (seed % 20);
    const double side = is_grid ? 20 : 10 * std::sqrt(static_cast<double>(n));
    const auto motions =
        is_grid ? test::grid_motions(n, 40, 3, seed) : test::random_motions(n, side, 5, seed);
    auto discs = discs_of(motions, is_grid ? 3 : 4 + 4 * (seed % 3), seed % 3, is_grid, seed);
    if (seed % 4 == 3) {
      for (Disc_motion_2& disc : discs) disc.radius = 1, disc.growth = 0.5;
    }
    ASSERT_EQ(
        difference_from_loop(discs, {0.5, 1.5}, options_of(1 + seed * 7 % 32, 0.1 * (1 + seed % 9)),
                             sum, Disc_traits(box_of(side, seed / 2))),
        "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Runs one after the other, with changes of points between them; many points turn at once.
TEST(Periodic_regions, keep_their_division_while_points_change) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    std::mt19937_64 random(seed);
    const auto motions = test::random_motions(150 + 120 * (seed % 4), 100, 5, seed);
    auto others = test::random_motions(700, 100, 5, seed + 100);
    const Traits traits(box_of(100, seed));
    Kinetic plain(motions, 0, traits);
    Kinetic kinetic(motions, 0, traits);
    kinetic.set_threads(seed % 3 == 0 ? 1 : 4);
    for (unsigned round = 1; round <= 6; ++round) {
      const double time = 0.25 * round;
      auto run = detail::region_run_of(kinetic, options_of(2 + seed % 4, 0.3));
      ASSERT_EQ(plain.advance_to(time), run.advance_to(time));
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed << ", t = " << time;
      test::add(sum, run.counters());
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> turned;
      for (Point_id id = 0; id < plain.next_id(); ++id) {
        if (!plain.contains(id) || random() % (round % 2 == 0 ? 3 : 16) != 0) continue;
        ids.push_back(id);
        turned.push_back(with_velocity_at(kinetic.motion(id), others[id].velocity, time));
      }
      for (Kinetic* k : {&plain, &kinetic}) {
        k->set_motions(ids, turned);
        if (round % 3 == 1) k->step();
        if (round % 3 == 2) k->next_event_time();
        if (round % 2 == 0) continue;
        k->insert(others[600 + round]);
        k->erase(ids.front());
      }
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed << ", t = " << time;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
    }
    plain.reverse();
    kinetic.reverse();
    ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Two points whose offset is too great for an edge come together, between others.
TEST(Periodic_regions, throw_what_the_loop_throws) {
  const double far = 100 * 1.5e9;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto motions = test::random_motions(100 + 40 * seed, 100, 2, seed);
    const Traits traits(box_of(100, 0));
    Kinetic plain(motions, 0, traits);
    Kinetic kinetic(motions, 0, traits);
    for (Kinetic* k : {&plain, &kinetic}) {
      k->insert({{far + 20, 50}, {8, 0}, 0});
      k->insert({{80 - far, 51}, {-8, 0}, 0});
    }
    auto run = detail::region_run_of(kinetic, options_of(1 + seed, 0.5));
    const auto error_of = [&](const auto& call) -> std::optional<Periodic_offset_error> {
      try {
        call();
      } catch (const Periodic_offset_error& error) {
        return error;
      }
      return std::nullopt;
    };
    const auto expected = error_of([&] { plain.advance_to(10); });
    const auto found = error_of([&] { run.advance_to(10); });
    ASSERT_TRUE(expected && found) << "seed " << seed;
    EXPECT_EQ(std::string(expected->what()), found->what());
    EXPECT_EQ(expected->time(), found->time());
    EXPECT_EQ(plain.current_time(), kinetic.current_time());
    EXPECT_GT(run.counters().windows, 0u);
  }
}

// So many points that advance_to takes regions.
TEST(Periodic_regions, are_taken_with_several_threads_and_many_points) {
  const auto motions = test::random_motions(60'000, 2450, 5, 4);
  const Traits traits(box_of(2450, 1));
  Kinetic plain(motions, 0, traits);
  Kinetic kinetic(motions, 0, traits);
  kinetic.set_threads(2);
  const std::size_t events = plain.advance_to(2.0);
  EXPECT_GT(events, 120'000u);
  EXPECT_EQ(kinetic.advance_to(2.0), events);
  EXPECT_EQ(difference_of_states(plain, kinetic), "");
  EXPECT_NE(plain.counters().rechecks, kinetic.counters().rechecks);  // by regions there are others
}

}  // namespace
}  // namespace kinetri::periodic_regions_test
