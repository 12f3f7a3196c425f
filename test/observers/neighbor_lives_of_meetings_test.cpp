// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lives of points that meet, also against the places at many times.
#include <CGAL/Delaunay_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/observers/neighbor_lives.h"
#include "observers/random_runs.h"
#include "observers/stepped_run.h"
#include "support/query_oracle.h"

namespace kinetri::neighbor_lives_of_meetings_test {
namespace {

using test::expect_same;
using test::number_of_short;
using test::Stepped_run;

// The squared lengths of the ridges of points at a rational time, by CGAL's static triangulation of
// their places; none of those without an end.
std::map<Edge_ids, std::optional<Rational>> squared_ridges(
    const std::vector<Linear_motion_2>& motions, const Rational& t) {
  using Kernel = test::Static_kernel;
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  std::map<Kernel::Point_2, Point_id> ids;
  for (Point_id id = 0; id < motions.size(); ++id) {
    ids.emplace(test::place_at(motions[id], t), id);
    triangulation.insert(test::place_at(motions[id], t));
  }
  std::map<Edge_ids, std::optional<Rational>> result;
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    const auto [face, i] = *edge;
    std::optional<Rational>& squared =
        result[edge_ids(ids.at(face->vertex(triangulation.cw(i))->point()),
                        ids.at(face->vertex(triangulation.ccw(i))->point()))];
    const auto other = face->neighbor(i);
    if (triangulation.is_infinite(face) || triangulation.is_infinite(other)) continue;
    squared =
        CGAL::squared_distance(triangulation.circumcenter(face), triangulation.circumcenter(other));
  }
  return result;
}

// Of which points how many are to meet, and where.
std::vector<Linear_motion_2> motions_that_meet(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> number(-4, 4);
  std::vector<Linear_motion_2> motions;
  for (const auto& [size, time] : {std::pair(3, 2.0), {2, 1.0}, {2, 2.0}, {3, 0.0}}) {
    const Vector_2 place = {static_cast<double>(2 * number(random)),
                            static_cast<double>(2 * number(random))};
    std::set<std::pair<int, int>> velocities;
    while (velocities.size() < static_cast<std::size_t>(size)) {
      velocities.emplace(number(random), number(random));
    }
    for (const auto& [vx, vy] : velocities) {
      motions.push_back({{place.x - time * vx, place.y - time * vy},
                         {static_cast<double>(vx), static_cast<double>(vy)},
                         0});
    }
  }
  return motions;
}

// The times at which two of the points, whose epochs are 0, are in one place.
std::set<Rational> times_of_meetings(const std::vector<Linear_motion_2>& motions) {
  std::set<Rational> result;
  for (const Linear_motion_2& p : motions) {
    for (const Linear_motion_2& q : motions) {
      for (const auto axis : {&Vector_2::x, &Vector_2::y}) {
        const Rational speed = to_rational(q.velocity.*axis) - to_rational(p.velocity.*axis);
        if (speed == 0) continue;
        const Rational t = (to_rational(p.position.*axis) - to_rational(q.position.*axis)) / speed;
        if (test::place_at(p, t) == test::place_at(q, t)) result.insert(t);
      }
    }
  }
  return result;
}

// Every life whose ridge is seen to be long is long, and each of the others is never seen to be. A
// life that is long, but at none of the times, is so for the reason that the polynomials give.
TEST(Neighbor_lives, of_points_that_meet_are_those_of_the_places_at_many_times) {
  std::size_t short_ones = 0;
  std::size_t long_ones = 0;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Linear_motion_2> motions = motions_that_meet(seed);
    const double threshold = std::array{0.625, 4.0, 64.0}[seed % 3];
    Simulation_2<> simulation(motions, {});
    Neighbor_lives lives(simulation, threshold);
    std::vector<double> times = {0, 4};
    while (simulation.step(4.0) > 0) times.push_back(simulation.current_time().to_double());
    simulation.advance_to(4.0);
    const auto found = lives.lives();
    // Between each two events; just before and after each; and at regular times.
    std::set<Rational> samples;
    std::ranges::sort(times);
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      const Rational gap = to_rational(times[i + 1]) - to_rational(times[i]);
      for (const Rational& share : {Rational(1, 1 << 20), Rational(1, 64), Rational(1, 3),
                                    Rational(63, 64), Rational((1 << 20) - 1, 1 << 20)}) {
        samples.insert(to_rational(times[i]) + share * gap);
      }
    }
    std::vector<bool> is_seen_long(found.size(), false);
    const std::set<Rational> meetings = times_of_meetings(motions);
    for (const Rational& t : samples) {
      if (t <= 0 || t >= 4 || meetings.contains(t)) continue;
      const auto ridges = squared_ridges(motions, t);
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].begin >= Algebraic_number(t) || found[i].end <= Algebraic_number(t)) continue;
        const auto ridge = ridges.find(found[i].points);
        if (ridge == ridges.end()) continue;  // of length 0, as points are cocircular for a while
        const Rational length = to_rational(threshold);
        if (!ridge->second || *ridge->second >= length * length) is_seen_long[i] = true;
      }
    }
    std::size_t unseen = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_FALSE(is_seen_long[i] && found[i].is_short) << i;
      if (!is_seen_long[i] && !found[i].is_short) ++unseen;
    }
    EXPECT_LE(10 * unseen, found.size());
    short_ones += number_of_short(found);
    long_ones += found.size() - number_of_short(found);
  }
  EXPECT_GT(short_ones, 50u);
  EXPECT_GT(long_ones, 50u);
}

TEST(Neighbor_lives, of_points_that_meet_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Linear_motion_2> motions = motions_that_meet(seed);
    Simulation_2<> simulation(motions, {});
    const double threshold = std::array{0.625, 4.0, 64.0}[seed % 3];
    Neighbor_lives lives(simulation, threshold);
    Stepped_run run(simulation);
    for (const Rational& time : times_of_meetings(motions)) {
      if (time <= 0 || time >= 4) continue;
      run.step_to(Algebraic_number(time));
      run.look();
    }
    run.step_to(4.0);
    expect_same(lives.lives(), run.lives(threshold));
  }
}

}  // namespace
}  // namespace kinetri::neighbor_lives_of_meetings_test
