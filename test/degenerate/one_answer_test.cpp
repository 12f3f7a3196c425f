// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation is a function of the motions and the time: however a run has come to a time,
// the edges are those of a triangulation that starts there. On tiny grids most points of which stay
// cocircular, so that only the infinitely small terms of the lifting decide.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <numeric>
#include <random>
#include <set>

#include "kinetri/simulation/scenarios.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "support/multiplier.h"
#include "support/region_runs.h"
#include "support/same_run.h"
#include "support/static_regular.h"

namespace kinetri::one_answer_test {
namespace {

using test::edges_of;
using test::Kinetic_delaunay;

// Points of a grid that turn about its corner, grow from there and move along, all at once: each
// stays similar to the grid. Some have velocities of their own.
std::vector<Linear_motion_2> grid_that_turns(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto whole = [&](int lowest, int highest) {
    return static_cast<double>(std::uniform_int_distribution<int>(lowest, highest)(random));
  };
  const double turning = whole(-1, 1);
  const double growing = whole(-1, 1);
  const Vector_2 along = {whole(-1, 1), whole(-1, 1)};
  const std::size_t n = 4 + random() % 5;
  const std::size_t strangers = random() % 3;
  std::vector<Linear_motion_2> result;
  std::set<std::array<double, 4>> chosen;
  while (result.size() < n) {
    const Vector_2 place = {whole(0, 2), whole(0, 2)};
    Vector_2 velocity = {growing * place.x - turning * place.y + along.x,
                         turning * place.x + growing * place.y + along.y};
    if (result.size() < strangers) velocity = {whole(-2, 2), whole(-2, 2)};
    if (!chosen.insert({place.x, place.y, velocity.x, velocity.y}).second) continue;
    result.push_back({place, velocity, 0});
  }
  return result;
}

// Times at which, and between which, something happens.
const std::array<Rational, 6> times = {Rational(1, 3), Rational(1, 2), Rational(1),
                                       Rational(3, 2), Rational(2),    Rational(7, 2)};

// The edges of a run that starts at the time.
std::set<Edge_ids> start_at(const std::vector<Linear_motion_2>& motions, const Rational& time) {
  return edges_of(Kinetic_delaunay(motions, Algebraic_number(time)));
}

std::vector<Linear_motion_2> mirrored_in_time(std::vector<Linear_motion_2> motions) {
  for (Linear_motion_2& m : motions) m = mirrored(m);
  return motions;
}

// What differs from the one answer; empty if nothing does.
std::string problem(const std::vector<Linear_motion_2>& motions, unsigned seed) {
  std::mt19937_64 random(seed);
  // Of all times between which nothing can happen, the oracle says what is there.
  const std::string from_oracle = test::difference_from_brute_force(motions);
  if (!from_oracle.empty()) return from_oracle;

  std::vector<Point_id> order(motions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, random);
  std::vector<Linear_motion_2> permuted;
  for (const Point_id id : order) permuted.push_back(motions[id]);

  Kinetic_delaunay whole(motions);
  auto restored = std::make_unique<Kinetic_delaunay>(motions);
  Kinetic_delaunay other(permuted);
  test::Event_recorder expected(whole);
  std::vector<test::Kinetic_event> events_of_restored;
  for (const Rational& time : times) {
    const std::string where = " at " + time.str();
    const Algebraic_number t(time);
    // Restored at every event, and in between.
    for (;;) {
      const auto snapshot = restored->snapshot();
      restored.reset(new Kinetic_delaunay(Kinetic_delaunay::restore(snapshot)));
      test::Event_recorder recorder(*restored);
      const bool is_there = restored->step(t) == 0;
      restored->remove_observer(recorder);
      std::ranges::copy(recorder.events, std::back_inserter(events_of_restored));
      if (is_there) break;
    }
    restored->advance_to(t);
    whole.advance_to(t);
    other.advance_to(t);
    const std::set<Edge_ids> edges = edges_of(whole);
    if (edges != start_at(motions, time)) return "a start at the time differs" + where;
    if (edges != edges_of(*restored)) return "restored runs differ" + where;
    const std::string of_events = test::difference(expected.events, events_of_restored);
    if (!of_events.empty()) return "restored: " + of_events + where;
    std::set<Edge_ids> renumbered;
    for (const auto& [a, b] : edges_of(other)) renumbered.insert(edge_ids(order[a], order[b]));
    if (edges != renumbered) return "permuted points differ" + where;
  }

  // Back: at an event it is the triangulation just before it, of the mirrored motions just after.
  const std::vector<Linear_motion_2> back = mirrored_in_time(motions);
  whole.remove_observer(expected);
  const std::set<Edge_ids> at_end = edges_of(whole);
  whole.reverse();
  for (std::size_t i = times.size(); i-- > 0;) {
    const Rational time = -times[i];
    whole.advance_to(Algebraic_number(time));
    if (edges_of(whole) != start_at(back, time)) return "backwards differs at " + time.str();
  }
  whole.reverse();
  whole.advance_to(Algebraic_number(times.back()));
  if (edges_of(whole) != at_end) return "there, back and there again differs";

  test::Region_counters unused;
  const std::vector<Algebraic_number> pieces(times.begin(), times.end());
  return test::difference_from_loop(motions, pieces, test::options_of(1 + seed % 5, 0.5), unused);
}

TEST(One_answer, whatever_the_way) {
  const unsigned runs = test::cases(100u);
  for (unsigned seed = 0; seed < runs; ++seed) {
    const auto motions = grid_that_turns(seed);
    ASSERT_EQ(problem(motions, seed), "") << "seed " << seed << '\n' << test::describe(motions);
  }
}

// ---- discs ----

using Kinetic_regular = Kinetic_regular_triangulation_2<>;

// The same points as centers of discs, whose weights mostly stay on one lifted paraboloid, or
// nearly so.
std::vector<Disc_motion_2> with_weights(const std::vector<Linear_motion_2>& motions,
                                        unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& m : motions) {
    const double weight = random() % 3 == 0 ? 2.0 * static_cast<double>(random() % 3) : 0;
    const Disc_motion_2 disc = {m, 0, 0, weight};
    result.push_back(disc);
  }
  return result;
}

std::set<Point_id> visible_in(const Kinetic_regular& kinetic) {
  std::set<Point_id> result;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.is_hidden(id)) result.insert(id);
  }
  return result;
}

TEST(One_answer, of_discs_whatever_the_way) {
  int compared = 0;
  int hidden = 0;
  const unsigned runs = test::cases(100u);
  for (unsigned seed = 0; seed < runs; ++seed) {
    const auto discs = with_weights(grid_that_turns(seed), seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    Kinetic_regular kinetic(discs);
    ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
    for (const Rational& time : times) {
      for (const Rational& t : {time, Rational(time + Rational(1, 1009))}) {
        kinetic.advance_to(Algebraic_number(t));
        ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << t;
        const Kinetic_regular started(discs, Algebraic_number(t));
        ASSERT_EQ(edges_of(kinetic), edges_of(started)) << t;
        ASSERT_EQ(visible_in(kinetic), visible_in(started)) << t;
        const test::Static_regular expected(discs, t);
        if (!expected.is_certain()) continue;
        ASSERT_EQ(edges_of(kinetic), expected.edges()) << t;
        ASSERT_EQ(visible_in(kinetic), expected.visible()) << t;
        ++compared;
        hidden += kinetic.number_of_hidden_points() > 0 ? 1 : 0;
      }
    }
    kinetic.reverse();
    kinetic.advance_to(0.0);
    std::vector<Disc_motion_2> back = discs;
    for (Disc_motion_2& d : back) d = mirrored(d);
    ASSERT_EQ(edges_of(kinetic), edges_of(Kinetic_regular(back, Algebraic_number(0.0))));
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(hidden, 100);
}

// ---- lattices ----

// Movers leave diagonals behind them that do not depend on them.
TEST(One_answer, of_lattices_after_movers_is_that_of_a_start_at_the_end) {
  const unsigned seeds = std::min(36u, test::cases(4u));
  for (const Lattice_movers movers :
       {Lattice_movers::one, Lattice_movers::columns, Lattice_movers::all}) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      Scenario_options options;
      options.points = 49;
      options.seed = seed;
      options.movers = movers;
      const auto motions = make_scenario(Scenario::lattice, options);
      Kinetic_delaunay kinetic(motions);
      kinetic.advance_to(20.0);
      ASSERT_EQ(edges_of(kinetic), start_at(motions, Rational(20))) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace kinetri::one_answer_test
