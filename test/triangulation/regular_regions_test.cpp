// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regular triangulations in runs by regions, against the plain loop: the same events, with the same
// numbers and exact times, and the same state, hidden points included.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/motions.h"
#include "support/multiplier.h"
#include "support/region_runs.h"
#include "triangulation/regions.h"

namespace kinetri::regular_regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::discs_of;
using test::options_of;

// Some hide others, some touch none.
TEST(Regular_regions, run_random_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    const std::size_t n = 30 + 13 * (seed % 40);
    const double radius = std::array{1.0, 8.0, 30.0}[seed % 3];
    const double side = 10 * std::sqrt(static_cast<double>(n));
    const auto discs =
        discs_of(test::random_motions(n, side, 5, seed), radius, seed % 2, false, seed);
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                  discs, {0.5, 1.5}, options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Places, velocities and radii are small integers, so that much happens at one time.
TEST(Regular_regions, run_discs_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    const std::size_t n = 5 + seed % 60;
    const auto motions = test::grid_motions(n, 4 + static_cast<int>(seed % 40), 3, seed);
    const auto discs = discs_of(motions, 3, seed % 3, true, seed);
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(
                  discs, {1.0, Rational(7, 3), 4.0}, options_of(1 + seed % 9, 0.1 + seed % 3), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

TEST(Regular_regions, run_accelerated_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    const std::size_t n = 40 + 10 * (seed % 12);
    const auto motions = seed % 3 == 2 ? test::polynomial_grid_motions(n, 30, 4, 3, seed)
                                       : test::random_polynomial_motions(n, 100, 5, seed);
    const auto discs = discs_of(motions, seed % 2 == 0 ? 3 : 12, 0, seed % 3 == 2, seed);
    ASSERT_EQ(difference_from_loop<Polynomial_disc_kinetic_traits_2>(
                  discs, {0.5, 2.0}, options_of(2 + seed % 7, 0.5), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Equal weights, of which the points know: the Delaunay triangulation.
TEST(Regular_regions, run_equal_discs_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    const std::size_t n = 40 + 50 * (seed % 8);
    const auto motions = seed % 2 == 0 ? test::random_motions(n, 100, 5, seed)
                                       : test::grid_motions(n / 8, 30, 3, seed);
    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& motion : motions) discs.push_back({motion, 2, 0.5, 0});
    ASSERT_EQ(difference_from_loop<Disc_kinetic_traits_2>(discs, {0.5, 1.25},
                                                          options_of(2 + seed % 8, 0.4), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Runs one after the other, with changes of points between them and hidden ones in the queue.
TEST(Regular_regions, keep_their_division_while_discs_change) {
  using Kinetic = Kinetic_triangulation_2<Disc_kinetic_traits_2>;
  Region_counters sum;
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    std::mt19937_64 random(seed);
    const auto discs =
        discs_of(test::random_motions(150 + 20 * (seed % 12), 100, 5, seed), 12, 0.5, false, seed);
    const auto others = discs_of(test::random_motions(400, 100, 5, seed + 100), 9, 0, false, seed);
    Kinetic plain(discs);
    Kinetic kinetic(discs);
    for (unsigned round = 1; round <= 6; ++round) {
      const double time = 0.25 * round;
      auto run = detail::region_run_of(kinetic, options_of(2 + seed % 4, 0.3));
      ASSERT_EQ(plain.advance_to(time), run.advance_to(time));
      ASSERT_EQ(test::difference_of_states(plain, kinetic), "")
          << "seed " << seed << ", t = " << time;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
      test::add(sum, run.counters());
      hidden += kinetic.number_of_hidden_points();
      std::vector<Point_id> ids;
      std::vector<Disc_motion_2> turned;
      for (Point_id id = 0; id < plain.next_id(); ++id) {
        if (!plain.contains(id) || random() % 16 != 0) continue;
        ids.push_back(id);
        turned.push_back(others[id]);
        turned.back().epoch = time;
      }
      if (ids.empty()) continue;
      for (Kinetic* k : {&plain, &kinetic}) {
        k->set_motions(ids, turned);
        k->insert(others[300 + round]);
        k->erase(ids.front());
        if (round % 3 == 1) k->step();
      }
      ASSERT_EQ(test::difference_of_states(plain, kinetic), "")
          << "seed " << seed << ", t = " << time;
    }
  }
  EXPECT_GT(sum.windows, 0u);
  EXPECT_GT(hidden, 100u);
}

// So many that advance_to takes regions, and few enough hidden ones.
TEST(Regular_regions, are_taken_with_several_threads_and_many_discs) {
  using Kinetic = Kinetic_triangulation_2<Disc_kinetic_traits_2>;
  // So small that a disc is seldom hidden: where that happens often, windows do not pay.
  const auto discs = discs_of(test::random_motions(60'000, 2500, 5, 4), 0.05, 0, false, 4);
  Kinetic plain(discs);
  Kinetic kinetic(discs);
  plain.set_threads(1);
  kinetic.set_threads(2);
  const std::size_t events = plain.advance_to(2.0);
  EXPECT_GT(events, 100'000u);
  EXPECT_EQ(kinetic.advance_to(2.0), events);
  EXPECT_EQ(test::difference_of_states(plain, kinetic), "");
  EXPECT_NE(plain.counters().rechecks, kinetic.counters().rechecks);  // by regions there are others
}

}  // namespace
}  // namespace kinetri::regular_regions_test
