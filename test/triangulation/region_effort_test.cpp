// SPDX-License-Identifier: GPL-3.0-or-later
//
// The account of a run by regions: what it lets windows take, whatever they do.
#include "kinetri/triangulation/detail/region_effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>

#include "support/multiplier.h"

namespace kinetri::detail {
namespace {

// Windows of any size, that pay or do not, for a while or for long. `taken` and `of_processor` are
// what they take, by the rule that the header states.
TEST(Region_effort, bounds_what_windows_take) {
  std::uint64_t windows = 0;
  std::uint64_t loops = 0;
  for (unsigned seed = 1; seed <= 200u * static_cast<unsigned>(test::multiplier()); ++seed) {
    std::mt19937_64 random(seed);
    const double share = seed % 2 == 0 ? 1.0 / 16 : 0.25;
    const double advance = 1000;
    Region_effort effort;
    effort.open(share, advance);
    double events = 0;
    double taken = 0;
    double of_processor = 0;
    double greatest_loss = 0;
    unsigned kind = 0;
    for (int k = 0; k < 2000; ++k) {
      if (random() % 50 == 0) kind = static_cast<unsigned>(random() % 4);
      if (!effort.has(0)) {
        const auto more = static_cast<std::size_t>(random() % 3);
        effort.add_loop(more);
        events += static_cast<double>(more);
        taken += static_cast<double>(more);
        of_processor += static_cast<double>(more);
        ++loops;
        continue;
      }
      const auto executed = static_cast<double>(random() % 400);
      const double kept = kind == 0 ? 1 : static_cast<double>(random() % 101) / 100;
      Window_work work;
      work.executed = executed;
      work.in_turn = executed / (kind == 1 ? 1 : 2);
      work.reported = executed * kept;
      work.undone = executed - work.reported;
      work.serial = static_cast<double>(random() % 20) + (kind == 3 ? 300 : 0);
      effort.add_window(work);
      const double wall = 1.25 * work.in_turn + work.undone + work.serial;
      const double processor = 1.25 * work.executed + work.undone + work.serial;
      events += work.reported;
      taken += wall;
      of_processor += processor;
      greatest_loss = std::max({greatest_loss, wall - work.reported,  //
                                processor / 2 - work.reported});
      ++windows;
      ASSERT_LE(taken, (1 + share) * events + advance + greatest_loss + 1e-6) << "seed " << seed;
      ASSERT_LE(of_processor, 2 * ((1 + share) * events + advance + greatest_loss) + 1e-6)
          << "seed " << seed;
    }
  }
  EXPECT_GT(windows, 10'000u);
  EXPECT_GT(loops, 10'000u);
}

// A window that loses is followed by 16 events of the loop for each that it has lost.
TEST(Region_effort, makes_losses_good_before_the_next_window) {
  Region_effort effort;
  effort.open(1.0 / 16, 10);
  Window_work work;
  work.executed = work.in_turn = 80;  // takes 100
  effort.add_window(work);
  EXPECT_EQ(effort.spent(), 100);
  for (int k = 0; k < 90 * 16; ++k) {
    ASSERT_FALSE(effort.has(0)) << k;
    effort.add_loop(1);
  }
  EXPECT_TRUE(effort.has(0));
  EXPECT_FALSE(effort.has(1));
  for (int k = 0; k < 1000; ++k) effort.add_loop(1);
  EXPECT_TRUE(effort.has(10)) << "what the loop earns is kept up to the advance";
  EXPECT_FALSE(effort.has(10.5));
}

// Each call of advance_to opens the account of the triangulation: the advance is given once.
TEST(Region_effort, that_is_opened_again_is_as_overdrawn_as_before) {
  Region_effort effort;
  effort.open(1.0 / 16, 10);
  effort.spend(100);
  effort.open(1.0 / 16, 10);
  EXPECT_FALSE(effort.has(0));
  effort.spend(-100);
  EXPECT_TRUE(effort.has(10));
}

TEST(Region_effort, of_windows_that_pay_is_never_overdrawn) {
  Region_effort effort;
  effort.open(1.0 / 16, 10);
  for (int k = 0; k < 1000; ++k) {
    Window_work work;
    work.executed = work.reported = 100;
    work.in_turn = 50;
    effort.add_window(work);
    ASSERT_TRUE(effort.has(10));
  }
  EXPECT_EQ(effort.spent(), 0);
}

TEST(Region_effort, counts_events_that_were_alone) {
  Region_effort effort;
  effort.open(1.0 / 16, 10);
  for (int k = 0; k < 5; ++k) effort.add_loop(1);
  EXPECT_EQ(effort.alone(), 5u);
  effort.add_loop(2);
  EXPECT_EQ(effort.alone(), 0u);
  effort.add_loop(1);
  effort.add_loop(0);
  EXPECT_EQ(effort.alone(), 0u);
}

TEST(Region_effort, without_a_limit_tries_always) {
  Region_effort effort;
  effort.open(std::numeric_limits<double>::infinity(), 0);
  effort.spend(1e9);
  EXPECT_TRUE(effort.has(1e9));
  EXPECT_TRUE(effort.is_unlimited());
}

}  // namespace
}  // namespace kinetri::detail
