// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where windows do not pay, a run by regions stays with the sequential loop: counted in events that
// it executes and undoes. The result is the same in any case.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"
#include "support/contact_region_runs.h"

namespace kinetri::region_decisions_test {
namespace {

using detail::Region_counters;
using Simulation = Simulation_2<Linear_kinetic_traits_2>;

// With the decisions of the library, but for fewer points.
detail::Region_options usual_options() {
  detail::Region_options options;
  options.regions = 8;
  options.threads = 4;
  return options;
}

struct Outcome {
  std::string problem;  ///< what differs from the loop
  std::uint64_t events = 0;
  Region_counters counters;

  /// Events that were executed and undone, by whatever cause.
  std::uint64_t undone() const { return counters.rolled_back + counters.truncated; }
  std::uint64_t by_windows() const {
    return counters.by_region + counters.by_union + counters.by_root - undone();
  }
};

Outcome run_to(double until, const std::vector<Linear_motion_2>& motions,
               const Simulation_options& options, const detail::Region_options& regions) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  Simulation plain(motions, options);
  Simulation by_regions(motions, options);
  test::Log expected;
  test::Log log;
  plain.add_observer(expected);
  by_regions.add_observer(log);
  auto run = detail::region_run_of(by_regions, regions);
  Outcome result;
  result.events = plain.advance_to(until);
  if (run.advance_to(until) != result.events) result.problem = "another number of events";
  if (result.problem.empty()) result.problem = test::difference(expected.events, log.events);
  if (result.problem.empty()) result.problem = test::difference_of_simulations(plain, by_regions);
  result.counters = run.counters();
  return result;
}

std::vector<Linear_motion_2> scenario(Scenario which, std::size_t points) {
  Scenario_options options;
  options.points = points;
  options.seed = 3;
  return make_scenario(which, options);
}

Simulation_options discs_in_box(double side, double radius,
                                Contact_response_2 (*response)(const Contact_2&)) {
  Simulation_options options;
  options.box = Box_2{-5, -5, side, side};
  options.radius = radius;
  options.response = response;
  return options;
}

Simulation_options discs_of(double radius) {
  Simulation_options options;
  options.radius = radius;
  options.response = collide_elastically;
  return options;
}

// An account begins with a quarter of an event for each point and an eighth of a window, and gets a
// sixteenth of all events.
double most_undone(const Outcome& run, std::size_t points) {
  return static_cast<double>(run.events) / 16 + 0.4 * static_cast<double>(points);
}

// On a lattice with whole velocities nearly every time has several events.
TEST(Region_decisions, leave_discs_on_a_lattice_to_the_loop) {
  constexpr std::size_t n = 900;
  for (const auto response : {collide_elastically, swap_velocities}) {
    const auto options = discs_in_box(295, 2, response);
    const auto motions = scenario(Scenario::lattice, n);
    const Outcome run = run_to(4, motions, options, usual_options());
    EXPECT_EQ(run.problem, "");
    EXPECT_GT(run.events, 3 * n);
    EXPECT_LT(static_cast<double>(run.undone()), most_undone(run, n));
  }
}

// A gas and its copy elsewhere: what happens in one happens in the other at the same time.
std::vector<Linear_motion_2> twins(std::size_t points) {
  std::vector<Linear_motion_2> result;
  const auto rounded = [](double x) { return std::round(x * 256) / 256; };
  for (const Linear_motion_2& motion : test::gas(points / 2, 200, 4, 5, 1)) {
    result.push_back({{rounded(motion.position.x), rounded(motion.position.y)},
                      {rounded(motion.velocity.x), rounded(motion.velocity.y)}});
  }
  for (std::size_t k = 0; k < points / 2; ++k) {
    result.push_back(result[k]);
    result.back().position.x += 4096;
  }
  return result;
}

TEST(Region_decisions, try_no_windows_where_no_event_is_alone) {
  constexpr std::size_t n = 900;
  const Outcome run = run_to(6, twins(n), discs_of(1.5), usual_options());
  EXPECT_EQ(run.problem, "");
  EXPECT_GT(run.events, 2 * n);
  EXPECT_EQ(run.counters.windows, 0u);
}

// Without an account windows are always tried. Where they are cut at once, they are farther apart.
TEST(Region_decisions, make_pauses_between_windows_that_are_cut_at_once) {
  constexpr std::size_t n = 900;
  detail::Region_options regions = usual_options();
  regions.most_waste = std::numeric_limits<double>::infinity();
  const Outcome run = run_to(6, twins(n), discs_of(1.5), regions);
  EXPECT_EQ(run.problem, "");
  EXPECT_GT(run.counters.windows, 1u);
  EXPECT_LT(run.counters.windows, 250u);
}

// A gas, and far away a small one with its copy: every few events two are at one time, and a window
// in which they are is cut. What that undoes is paid too.
TEST(Region_decisions, pay_for_what_is_undone_where_windows_are_cut) {
  std::vector<Linear_motion_2> motions = test::gas(800, 280, 4, 5, 2);
  for (const Linear_motion_2& motion : twins(100)) {
    motions.push_back(motion);
    motions.back().position.y += 4096;
  }
  const Outcome run = run_to(6, motions, discs_of(1.5), usual_options());
  EXPECT_EQ(run.problem, "");
  EXPECT_GT(run.counters.truncated_windows, 0u);
  EXPECT_LT(static_cast<double>(run.undone()), most_undone(run, motions.size()));
}

// One thread executes all in turn: each window takes a quarter more than the loop, and its share of
// the events is what pays for that.
TEST(Region_decisions, leave_most_events_to_the_loop_where_windows_lose) {
  constexpr std::size_t n = 900;
  detail::Region_options regions = usual_options();
  regions.threads = 1;
  const Outcome run =
      run_to(6, test::gas(n, 300, 4, 5, 1), discs_in_box(305, 2, collide_elastically), regions);
  EXPECT_EQ(run.problem, "");
  EXPECT_GT(run.counters.windows, 0u) << "of what the account begins with";
  EXPECT_LT(run.by_windows(), run.events / 3);
}

// Where each event is alone, nearly all are executed in windows.
TEST(Region_decisions, take_windows_for_discs_that_move_at_random) {
  constexpr std::size_t n = 900;
  const Outcome run = run_to(6, test::gas(n, 300, 4, 5, 1),
                             discs_in_box(305, 2, collide_elastically), usual_options());
  EXPECT_EQ(run.problem, "");
  EXPECT_GT(run.by_windows(), run.events * 3 / 4);
  EXPECT_GT(run.counters.windows, 10u);
}

}  // namespace
}  // namespace kinetri::region_decisions_test
