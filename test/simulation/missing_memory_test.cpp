// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs by regions in which one allocation fails: the state is that before a window of time or after
// it, and the run can go on.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"
#include "support/live_bytes.h"
#include "support/motions.h"
#include "support/multiplier.h"
#include "support/region_runs.h"

namespace kinetri::missing_memory_test {
namespace {

using test::options_of;

enum class Failure { none, in_window, elsewhere };

// Runs to `until`, and has one allocation fail, so many after the beginning of the next window of
// time. Where a window is cut the plain loop executes events, in which memory must not be missing.
template <class Run>
Failure run_with_failure(Run& run, const Algebraic_number& until, std::int64_t allocations) {
  const auto before = run.counters();
  bool has_failed = false;
  try {
    run.advance_to(until, [&] {
      const bool is_first = run.counters().windows == before.windows;
      test::allocations_before_failure = is_first ? allocations : -1;
      return true;
    });
  } catch (const std::bad_alloc&) {
    has_failed = true;
  }
  test::allocations_before_failure = -1;
  if (!has_failed) return Failure::none;
  const bool is_in_window = run.counters().windows == before.windows + 1 &&
                            run.counters().truncated_windows == before.truncated_windows;
  return is_in_window ? Failure::in_window : Failure::elsewhere;
}

// Calls check(allocations) for numbers of allocations that grow, until nothing fails.
template <class Check>
void expect_failures(const Check& check) {
  std::size_t failures = 0;
  std::int64_t allocations = 0;
  for (Failure failure = Failure::elsewhere; failure != Failure::none; ++allocations) {
    // Few at first, since these are of all kinds.
    if (allocations > 100) allocations += 240 / test::multiplier();
    failure = check(allocations);
    failures += failure == Failure::in_window ? 1 : 0;
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(failures, 30u);
}

template <class Traits>
void expect_goes_on(const std::vector<typename Traits::Motion>& motions, std::size_t regions) {
  using Kinetic = Kinetic_triangulation_2<Traits>;
  Kinetic plain(motions);
  plain.advance_to(1.0);
  const auto check = [&](std::int64_t allocations) {
    Kinetic kinetic(motions);
    auto run = detail::region_run_of(kinetic, options_of(regions, 1));
    run.advance_to(0.25);
    const Failure failure = run_with_failure(run, 1.0, allocations);
    if (failure != Failure::in_window) return failure;
    Kinetic expected(motions);
    expected.advance_to(kinetic.current_time());
    EXPECT_EQ(test::difference_of_states(expected, kinetic), "") << allocations;
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << allocations;
    run.advance_to(1.0);
    EXPECT_EQ(test::difference_of_states(plain, kinetic), "") << allocations;
    return failure;
  };
  expect_failures(check);
}

TEST(Missing_memory, in_a_window_of_flips) {
  for (const std::size_t regions : {2u, 13u}) {
    expect_goes_on<Linear_kinetic_traits_2>(test::random_motions(150, 100, 5, 1), regions);
  }
}

TEST(Missing_memory, in_a_window_of_flips_of_discs) {
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& motion : test::random_motions(120, 100, 5, 2)) {
    discs.push_back({motion, discs.size() % 4 == 0 ? 3.0 : 1.0, 0, 0});
  }
  expect_goes_on<Disc_kinetic_traits_2>(discs, 6);
}

// Discs that collide, and one that is to come.
TEST(Missing_memory, in_a_window_of_contacts) {
  using Simulation = Simulation_2<Linear_kinetic_traits_2>;
  std::vector<Linear_motion_2> motions;
  std::mt19937_64 random(3);
  const auto number = [&](double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random);
  };
  for (int k = 0; k < 100; ++k) {
    const double x = 10 * (k % 10);
    const double y = 10 * std::floor(k / 10);
    motions.push_back({{x + number(2, 8), y + number(2, 8)}, {number(-9, 9), number(-9, 9)}});
  }
  // At the hull are others, which rest.
  for (const double x : {-60.0, 160.0}) {
    for (const double y : {-60.0, 160.0}) motions.push_back({{x, y}, {0, 0}});
  }
  Simulation_options options;
  options.box = Box_2{-60, -60, 160, 160};
  options.radius = 2;
  options.response = collide_elastically;
  const auto make = [&] {
    auto result = std::make_unique<Simulation>(motions, options);
    result->schedule_insert(0.75, Linear_motion_2{{50, 50}, {1, 2}, 0.75});
    return result;
  };
  const auto plain = make();
  plain->advance_to(1.0);
  for (const std::size_t regions : {6u, 13u}) {
    const auto check = [&](std::int64_t allocations) {
      const auto simulation = make();
      auto run = detail::region_run_of(*simulation, options_of(regions, 6));
      run.advance_to(0.25);
      const Failure failure = run_with_failure(run, 1.0, allocations);
      if (failure != Failure::in_window) return failure;
      const auto expected = make();
      expected->advance_to(simulation->current_time());
      EXPECT_EQ(test::difference_of_states(expected->triangulation(), simulation->triangulation()),
                "")
          << allocations;
      const Audit_report report = simulation->audit(Audit_level::certificates);
      EXPECT_TRUE(report.failures.empty()) << allocations << ": " << report.failures.front();
      run.advance_to(1.0);
      EXPECT_EQ(test::difference_of_states(plain->triangulation(), simulation->triangulation()), "")
          << allocations;
      for (Point_id id = 0; id < motions.size(); ++id) {
        EXPECT_EQ(plain->overlapping_discs(id), simulation->overlapping_discs(id)) << allocations;
      }
      return failure;
    };
    expect_failures(check);
  }
}

}  // namespace
}  // namespace kinetri::missing_memory_test
