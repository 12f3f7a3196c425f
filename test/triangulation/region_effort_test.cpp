// SPDX-License-Identifier: GPL-3.0-or-later
//
// The account of a run by regions, what it lets windows take, whatever they do; and pauses.
#include "triangulation/region_effort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

#include "support/multiplier.h"

namespace kinetri::detail::region_effort_test {
namespace {

// Windows of any size, that pay or do not, for a while or for long. `taken` and `of_processor` are
// what they take, by the rule that the header states.
TEST(Region_effort, bounds_what_windows_take) {
  std::uint64_t windows = 0;
  std::uint64_t loops = 0;
  for (unsigned seed = 1; seed <= test::cases(200u); ++seed) {
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
      work.rolled_back = executed - work.reported;
      work.serial = static_cast<double>(random() % 20) + (kind == 3 ? 300 : 0);
      effort.add_window(work);
      const double wall = 1.25 * work.in_turn + work.rolled_back + work.serial;
      const double processor = 1.25 * work.executed + work.rolled_back + work.serial;
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

// Exactly: numbers here are sums of few powers of two.
void expect_balance(const Region_effort& effort, double balance, const char* after = "") {
  EXPECT_TRUE(effort.has(balance)) << after;
  EXPECT_FALSE(effort.has(std::nextafter(balance, 1e9))) << after;
}

Region_effort opened(double share, double advance, double spent = 0) {
  Region_effort effort;
  effort.open(share, advance);
  effort.spend(spent);
  return effort;
}

Window_work work(double reported, double executed, double in_turn, double undone = 0,
                 double serial = 0) {
  Window_work result;
  result.reported = reported;
  result.executed = executed;
  result.in_turn = in_turn;
  result.rolled_back = undone;
  result.serial = serial;
  return result;
}

TEST(Region_effort, begins_with_its_advance) {
  expect_balance(opened(1.0 / 16, 10), 10);
  expect_balance(opened(1.0 / 16, 0), 0);
}

// A time with several events earns for each of them.
TEST(Region_effort, earns_a_share_of_each_event_of_the_loop) {
  Region_effort effort = opened(1.0 / 16, 10, 10);
  effort.add_loop(1);
  expect_balance(effort, 0.0625);
  effort.add_loop(31);
  expect_balance(effort, 2);
  effort.add_loop(0);
  expect_balance(effort, 2);
}

// What windows lose or save, without a share of events.
TEST(Region_effort, compares_windows_with_the_loop) {
  const struct {
    const char* name;
    Window_work work;
    double saved;
  } windows[] = {
      {"nothing", work(0, 0, 0), 0},
      {"one thread: a quarter more for each event", work(64, 64, 64), -16},
      {"two threads, each half: a quarter less of the time", work(64, 64, 32), 64 - 40},
      {"many threads: no more than half of all work", work(64, 64, 1), 64 - 40},
      {"three threads, of which one has most", work(64, 64, 48), 4},
      {"in turn, what is undone costs one more each", work(60, 64, 64, 4), 60 - 84},
      {"in turn, what one thread has done besides", work(64, 64, 64, 0, 8), 64 - 88},
      {"by many, what is undone", work(60, 64, 1, 4), 60 - 42},
      {"by many, what one thread has done besides", work(64, 64, 1, 0, 8), 64 - 44},
      {"in turn, what is executed and not reported", work(0, 64, 64, 64), -144},
      {"nothing but what one thread has done", work(0, 0, 0, 0, 8), -8},
  };
  for (const auto& window : windows) {
    Region_effort effort = opened(0, 1000, 500);
    effort.add_window(window.work);
    expect_balance(effort, 500 + window.saved, window.name);
  }
}

// Only those that are reported are events of the run.
TEST(Region_effort, earns_a_share_of_the_events_that_a_window_reports) {
  for (const double share : {1.0 / 16, 0.25}) {
    Region_effort effort = opened(share, 1000, 500);
    effort.add_window(work(64, 128, 128, 64));
    expect_balance(effort, 500 + 64 - (160 + 64) + 64 * share);
  }
}

// The share is earned after the loss is paid: a full account gets it too.
TEST(Region_effort, that_is_full_pays_what_a_window_loses_less_its_share) {
  Region_effort effort = opened(0.125, 100);
  effort.add_window(work(64, 64, 64));
  expect_balance(effort, 100 - 16 + 8);
}

TEST(Region_effort, has_no_more_than_the_advance) {
  Region_effort by_loop = opened(1.0 / 16, 10, 1);
  by_loop.add_loop(1000);
  expect_balance(by_loop, 10);
  Region_effort by_window = opened(0, 10, 1);
  by_window.add_window(work(64, 64, 32));
  expect_balance(by_window, 10);
  Region_effort by_saving = opened(0, 10, -1);
  expect_balance(by_saving, 10);
  by_saving.spend(3);
  expect_balance(by_saving, 7);
}

// A window that loses is followed by 16 events of the loop for each that it has lost.
TEST(Region_effort, makes_losses_good_before_the_next_window) {
  Region_effort effort = opened(1.0 / 16, 10);
  effort.add_window(work(0, 80, 80));  // takes 100
  expect_balance(effort, -90);
  for (int k = 0; k < 90 * 16; ++k) {
    ASSERT_FALSE(effort.has(0)) << k;
    effort.add_loop(1);
  }
  expect_balance(effort, 0);
}

// Each call of advance_to opens the account of the triangulation: the advance is given once.
TEST(Region_effort, that_is_opened_again_has_what_it_had) {
  Region_effort effort = opened(1.0 / 16, 10, 100);
  effort.open(1.0 / 16, 10);
  expect_balance(effort, -90);
  effort.open(0.5, 20);  // points have come, say
  expect_balance(effort, -90);
  effort.add_loop(2);
  expect_balance(effort, -89);
  effort.spend(-1000);
  expect_balance(effort, 20);
  effort.open(0.5, 5);
  effort.add_loop(1);
  expect_balance(effort, 5);
}

TEST(Region_effort, of_windows_that_pay_is_never_overdrawn) {
  Region_effort effort = opened(1.0 / 16, 10);
  for (int k = 0; k < 1000; ++k) {
    effort.add_window(work(100, 100, 50));
    ASSERT_TRUE(effort.has(10));
  }
}

TEST(Region_effort, counts_times_with_one_event) {
  Region_effort effort = opened(1.0 / 16, 10);
  EXPECT_EQ(effort.alone(), 0u);
  for (int k = 0; k < 5; ++k) effort.add_loop(1);
  EXPECT_EQ(effort.alone(), 5u);
  effort.add_window(work(64, 64, 32));
  effort.spend(3);
  effort.open(1.0 / 16, 10);
  EXPECT_EQ(effort.alone(), 5u) << "only the loop changes it";
  for (const std::size_t other : {2u, 0u, 1000u}) {
    effort.add_loop(other);
    EXPECT_EQ(effort.alone(), 0u) << other;
    effort.add_loop(1);
    EXPECT_EQ(effort.alone(), 1u) << other;
  }
}

TEST(Region_effort, without_a_limit_tries_always) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(opened(1e9, 10).is_unlimited());
  Region_effort effort = opened(no_limit, 0, 1e9);
  EXPECT_TRUE(effort.is_unlimited());
  EXPECT_TRUE(effort.has(1e9));
  effort.add_loop(0);
  effort.add_loop(1);
  effort.add_window(work(0, 64, 64, 64));
  EXPECT_EQ(effort.alone(), 1u);
  effort.open(1.0 / 16, 10);
  EXPECT_FALSE(effort.is_unlimited());
  expect_balance(effort, 0, "what was noted without a limit is not paid");
}

// How many instants the loop executes before a window may be next, if it takes one at a time.
std::size_t length(Region_pause& pause) {
  std::size_t result = 0;
  for (; !pause.is_over(); ++result) EXPECT_EQ(pause.take(1), 1u);
  return result;
}

TEST(Region_pause, is_over_before_the_first_window) {
  EXPECT_TRUE(Region_pause().is_over());
}

TEST(Region_pause, is_twice_as_long_each_time_up_to_a_limit) {
  Region_pause pause;
  for (const std::size_t expected : {1u, 2u, 4u, 8u, 16u, 20u, 20u}) {
    pause.lengthen(20);
    EXPECT_EQ(length(pause), expected);
  }
}

TEST(Region_pause, is_short_again_after_a_window_that_executes_enough) {
  Region_pause pause;
  for (int k = 0; k < 3; ++k) pause.lengthen(1000);
  pause.shorten();
  EXPECT_EQ(length(pause), 4u) << "the present one goes on";
  pause.lengthen(1000);
  EXPECT_EQ(length(pause), 1u);
  pause.lengthen(1000);
  EXPECT_EQ(length(pause), 2u);
}

TEST(Region_pause, of_one_instant_does_not_lengthen_the_next) {
  Region_pause pause;
  pause.lengthen(1000);
  pause.lengthen(1000);
  pause.pass_one();
  EXPECT_EQ(length(pause), 1u);
  pause.lengthen(1000);
  EXPECT_EQ(length(pause), 4u);
}

TEST(Region_pause, is_taken_in_parts) {
  Region_pause pause;
  EXPECT_EQ(pause.take(16), 1u) << "without a pause";
  EXPECT_TRUE(pause.is_over());
  for (int k = 0; k < 5; ++k) pause.lengthen(1000);
  EXPECT_EQ(pause.take(10), 10u);
  EXPECT_FALSE(pause.is_over());
  EXPECT_EQ(pause.take(10), 6u);
  EXPECT_TRUE(pause.is_over());
}

}  // namespace
}  // namespace kinetri::detail::region_effort_test
