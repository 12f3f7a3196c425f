// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation of few points against the brute-force simulator, on random input and on
// input so coarse that most instants are degenerate.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/brute_force_simulator.h"

namespace kinetri {
namespace {

using Kinetic_delaunay = Kinetic_delaunay_triangulation_2<>;
using test::Static_edges;

std::set<Edge_ids> edges_of(const Kinetic_delaunay& kinetic) {
  const auto edges = kinetic.finite_edge_ids();
  return {edges.begin(), edges.end()};
}

// The net change of the edges that the observed events made.
class Net_change : public Kinetic_delaunay::Observer {
 public:
  void after_event(const Event<Algebraic_number>& event) override {
    time = event.time;
    ++events;
    if (event.removed) edges.erase(*event.removed);
    if (event.added) edges.insert(*event.added);
  }

  std::set<Edge_ids> edges;
  Algebraic_number time;
  int events = 0;
};

// Runs both from `start` to the last critical time and compares the edges between all of them, and,
// where the triangulation is unique, the times at which they change.
void expect_same_run(const std::vector<Linear_motion_2>& motions, const Algebraic_number& start) {
  SCOPED_TRACE(test::describe(motions));
  Kinetic_delaunay kinetic(motions.begin(), motions.end(), start);
  Net_change log;
  log.edges = edges_of(kinetic);
  kinetic.add_observer(log);

  std::vector<Algebraic_number> times = test::critical_times(motions, start);
  times.push_back(times.empty() ? Algebraic_number(Rational(start.upper() + 1))
                                : Algebraic_number(Rational(times.back().upper() + 1)));
  Algebraic_number previous = start;
  std::set<Edge_ids> previous_edges = log.edges;
  bool was_unique = true;
  for (const Algebraic_number& time : times) {
    // Everything between two critical times is alike: look at one time of it.
    const Rational between = simplest_between(previous, time);
    const int events_before = log.events;
    kinetic.advance_to(Algebraic_number(between));
    const Static_edges expected = test::edges_at(motions, between);
    const std::set<Edge_ids> actual = edges_of(kinetic);
    ASSERT_EQ(actual, log.edges) << "the log does not add up at " << between;
    ASSERT_TRUE(std::ranges::includes(actual, expected.certain)) << "edge missing at " << between;
    ASSERT_TRUE(std::ranges::includes(expected.possible, actual)) << "wrong edge at " << between;
    if (log.events != events_before) {
      ASSERT_EQ(log.time, previous) << "an event at no critical time";
    } else {
      ASSERT_EQ(actual, previous_edges);
    }
    const bool is_unique = expected.certain == expected.possible;
    if (is_unique && was_unique && log.events != events_before && log.events == events_before + 1) {
      ASSERT_NE(actual, previous_edges) << "an event that changes nothing";
    }
    ASSERT_TRUE(kinetic.audit(Audit_level::reference).passed())
        << kinetic.audit(Audit_level::reference).failures.front() << " at " << between;
    was_unique = is_unique;
    previous = time;
    previous_edges = actual;
  }
  kinetic.advance_to(times.back());
  EXPECT_FALSE(kinetic.next_event_time()) << "an event after the last critical time";
}

TEST(Brute_force, random_points_change_in_the_same_way) {
  for (unsigned seed = 0; seed < 40u * static_cast<unsigned>(test::multiplier()); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::size_t n = 3 + seed % 6;
    expect_same_run(test::random_motions(n, 10, 5, seed), Algebraic_number());
    if (HasFatalFailure()) return;
  }
}

TEST(Brute_force, random_points_from_an_irrational_start_change_in_the_same_way) {
  const Polynomial p{-2, 0, 1};
  const Algebraic_number start(p, Rational(1), Rational(2));
  for (unsigned seed = 100; seed < 110; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(test::random_motions(5, 10, 5, seed), start);
    if (HasFatalFailure()) return;
  }
}

// Places in a square of few integers, small integer velocities: simultaneous events, collinear
// hulls, points that pass through one another, everything on a line or in one place for an instant.
class Brute_force_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Brute_force_on_grids, degenerate_points_change_in_the_same_way) {
  const auto [points, size, speed] = GetParam();
  const unsigned cases = (points <= 4   ? 150u
                          : points == 5 ? 60u
                                        : 15u) *
                         static_cast<unsigned>(test::multiplier());
  for (unsigned seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(test::grid_motions(static_cast<std::size_t>(points), size, speed, seed),
                    Algebraic_number());
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Brute_force_on_grids,
                         testing::Values(std::tuple(2, 3, 1), std::tuple(3, 2, 1),
                                         std::tuple(3, 4, 2), std::tuple(4, 2, 1),
                                         std::tuple(4, 3, 1), std::tuple(4, 5, 2),
                                         std::tuple(5, 3, 1), std::tuple(5, 4, 2),
                                         std::tuple(6, 3, 1), std::tuple(6, 5, 2),
                                         std::tuple(7, 3, 1), std::tuple(8, 4, 1)));

}  // namespace
}  // namespace kinetri
