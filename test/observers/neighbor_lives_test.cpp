// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/neighbor_lives.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "observers/random_runs.h"
#include "support/brute_force_simulator.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"
#include "support/random_walks.h"

namespace kinetri::neighbor_lives_test {
namespace {

using test::seeds;
using test::weight_at;

// ---- the oracle: the triangulation as it is after each step ----

// The points opposite of an edge, sorted; no_point at the hull.
using Opposite = std::array<Point_id, 2>;

template <class Traits>
struct Snapshot {
  Algebraic_number time;
  std::map<Edge_ids, Opposite> edges;
  std::map<Point_id, typename Traits::Motion> motions;
};

template <class Traits>
Snapshot<Traits> snapshot_of(const Kinetic_triangulation_2<Traits>& kinetic) {
  Snapshot<Traits> result{kinetic.current_time(), {}, {}};
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    result.motions.emplace(id, kinetic.motion(id));
    const Point_id shown = kinetic.vertex(id)->point().id();
    if (shown != id) result.edges.emplace(Edge_ids{shown, id}, Opposite{no_point, no_point});
  }
  const auto& triangulation = kinetic.triangulation();
  for (const Edge_ids& edge : kinetic.finite_edge_ids()) {
    result.edges.emplace(edge, Opposite{no_point, no_point});
  }
  if (triangulation.dimension() < 2) return result;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    const auto id = [&](auto vertex) {
      return triangulation.is_infinite(vertex) ? no_point : vertex->point().id();
    };
    Opposite opposite = {id(face->vertex(i)), id(triangulation.mirror_vertex(face, i))};
    std::ranges::sort(opposite);
    result.edges[edge_ids(id(face->vertex(triangulation.cw(i))),
                          id(face->vertex(triangulation.ccw(i))))] = opposite;
  }
  return result;
}

// Whether a quotient of polynomials, excess / square, is negative at a root of the excess, as a
// limit. The square is never negative.
bool is_negative_at(const Real_root& root, const Polynomial& excess, const Polynomial& square) {
  if (sign_at(square, root.value) != CGAL::ZERO) return false;
  const auto roots = real_roots(square);
  const auto same = std::ranges::find(roots, root.value, &Real_root::value);
  if (same->multiplicity != root.multiplicity) return false;  // the limit is zero, or infinite
  const auto next = first_root_after(excess, root.value);
  const Algebraic_number end =
      next ? next->value : Algebraic_number(root.value.interval().upper + 1);
  return excess.sign_at(simplest_between(root.value, end)) == CGAL::NEGATIVE;
}

// Whether the ridge of the edge is as long as `length` at some time of the closed interval.
template <class Traits>
bool reaches(const Snapshot<Traits>& now, const Edge_ids& edge, double length,
             const Algebraic_number& until) {
  const Opposite& opposite = now.edges.at(edge);
  if (opposite[1] == no_point) return true;
  // The excess of the squared length, times a square; and the latter.
  const auto excess_and_square = [&](const Rational& t) {
    const auto place = [&](Point_id id) { return test::place_at(now.motions.at(id), t); };
    const auto weight = [&](Point_id id) { return weight_at(now.motions.at(id), t); };
    // The center less the place of the first end, times a denominator; and that.
    const auto center = [&](Point_id id) {
      const auto q = place(edge[1]) - place(edge[0]);
      const auto r = place(id) - place(edge[0]);
      const Rational of_q = q.squared_length() - weight(edge[1]) + weight(edge[0]);
      const Rational of_r = r.squared_length() - weight(id) + weight(edge[0]);
      return std::tuple(Rational(r.y() * of_q - q.y() * of_r),
                        Rational(q.x() * of_r - r.x() * of_q),
                        Rational(2 * CGAL::determinant(q, r)));
    };
    const auto [x1, y1, d1] = center(opposite[0]);
    const auto [x2, y2, d2] = center(opposite[1]);
    const Rational x = x1 * d2 - x2 * d1;
    const Rational y = y1 * d2 - y2 * d1;
    const Rational threshold = to_rational(length) * d1 * d2;
    return std::pair(Rational(x * x + y * y - threshold * threshold), Rational(d1 * d1 * d2 * d2));
  };
  const Polynomial excess =
      test::interpolate(12, [&](const Rational& t) { return excess_and_square(t).first; });
  const Polynomial square =
      test::interpolate(12, [&](const Rational& t) { return excess_and_square(t).second; });
  if (excess.is_zero()) return true;
  if (sign_at(excess, now.time) == CGAL::POSITIVE || sign_at(excess, until) == CGAL::POSITIVE ||
      excess.sign_at(simplest_between(now.time, until)) == CGAL::POSITIVE) {
    return true;
  }
  // Where it changes its sign, the quotient is zero or infinite.
  return std::ranges::any_of(real_roots(excess), [&](const Real_root& root) {
    return root.value >= now.time && root.value <= until && !is_negative_at(root, excess, square);
  });
}

// Steps through a run, and knows its lives.
template <class Traits>
class Stepped_run {
 public:
  explicit Stepped_run(Simulation_2<Traits>& simulation) : simulation_(simulation) { look(); }

  // Looks at the triangulation when that has changed. Points may meet without an event: the caller
  // looks then.
  void step_to(const Algebraic_number& until) {
    while (simulation_.step(until) > 0) look();
    simulation_.advance_to(until);
  }
  void look() {
    Snapshot<Traits> now = snapshot_of(simulation_.triangulation());
    if (!snapshots_.empty() && snapshots_.back().time == now.time) snapshots_.pop_back();
    snapshots_.push_back(std::move(now));
  }

  // In their order; without limits.
  std::vector<Neighbor_life> lives(std::optional<double> threshold) const {
    std::vector<Neighbor_life> result;
    std::map<Edge_ids, Neighbor_life> present;
    const auto end = [&](const Edge_ids& edge, const Algebraic_number& time) {
      present[edge].end = time;
      if (present[edge].begin != time) result.push_back(present[edge]);
      present.erase(edge);
    };
    for (std::size_t i = 0; i < snapshots_.size(); ++i) {
      const auto& now = snapshots_[i];
      std::vector<Edge_ids> gone;
      for (const auto& [edge, life] : present) {
        if (!now.edges.contains(edge)) gone.push_back(edge);
      }
      for (const Edge_ids& edge : gone) end(edge, now.time);
      const Algebraic_number until =
          i + 1 < snapshots_.size() ? snapshots_[i + 1].time : simulation_.current_time();
      for (const auto& [edge, opposite] : now.edges) {
        if (!present.contains(edge)) {
          present[edge] = {edge, now.time, now.time};
          present[edge].is_short = threshold.has_value();
        }
        if (threshold && until != now.time && reaches(now, edge, *threshold, until)) {
          present[edge].is_short = false;
        }
      }
    }
    while (!present.empty()) end(present.begin()->first, simulation_.current_time());
    std::ranges::sort(result, [](const auto& a, const auto& b) {
      return std::tie(a.begin, a.points) < std::tie(b.begin, b.points);
    });
    return result;
  }

 private:
  Simulation_2<Traits>& simulation_;
  std::vector<Snapshot<Traits>> snapshots_;
};

void expect_same(const std::vector<Neighbor_life>& actual,
                 const std::vector<Neighbor_life>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].points, expected[i].points) << i;
    EXPECT_EQ(actual[i].begin, expected[i].begin) << i;
    EXPECT_EQ(actual[i].end, expected[i].end) << i;
    EXPECT_EQ(actual[i].is_short, expected[i].is_short)
        << actual[i].points[0] << "-" << actual[i].points[1] << " from "
        << actual[i].begin.to_double() << " to " << actual[i].end.to_double();
  }
}

std::size_t number_of_short(const std::vector<Neighbor_life>& lives) {
  return static_cast<std::size_t>(std::ranges::count_if(lives, &Neighbor_life::is_short));
}

// ---- by hand ----

// Points 0 and 1 rest at (-1, 0) and (1, 0); 2 and 3, at (0, -h) and (0, h), come nearer to each
// other and turn back at t = 1.5: h = 2 - t, and then h = t - 1. While h < 1 the latter two are
// neighbors, with a ridge of length 1 - h^2, which is 3/4 at most.
std::vector<Linear_motion_2> cross() {
  return {{{-1, 0}, {}, 0}, {{1, 0}, {}, 0}, {{0, -2}, {0, 1}, 0}, {{0, 2}, {0, -1}, 0}};
}

void run_cross(Simulation_2<>& simulation) {
  simulation.schedule_motion(1.5, 2, {{0, -0.5}, {0, -1}, 1.5});
  simulation.schedule_motion(1.5, 3, {{0, 0.5}, {0, 1}, 1.5});
  simulation.advance_to(3.0);
}

TEST(Neighbor_lives, of_an_exchange_that_is_undone) {
  Simulation_2<> simulation(cross(), {});
  Neighbor_lives lives(simulation);
  run_cross(simulation);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 7u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(found[i].begin, Algebraic_number(0.0));
    EXPECT_EQ(found[i].begins_by, Life_limit::run);
  }
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].end, Algebraic_number(1.0));
  EXPECT_EQ(found[0].ends_by, Life_limit::exchange);
  EXPECT_EQ(found[1].end, Algebraic_number(3.0));
  EXPECT_EQ(found[1].ends_by, Life_limit::run);
  EXPECT_EQ(found[5].points, (Edge_ids{2, 3}));
  EXPECT_EQ(found[5].begin, Algebraic_number(1.0));
  EXPECT_EQ(found[5].end, Algebraic_number(2.0));
  EXPECT_EQ(found[6].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[6].begin, Algebraic_number(2.0));
  EXPECT_EQ(number_of_short(found), 0u);
  for (const Point_exchanges& point : lives.exchanges()) {
    EXPECT_EQ(point.gained, 1u);
    EXPECT_EQ(point.lost, 1u);
    EXPECT_EQ(point.short_ones, 0u);
    EXPECT_EQ(point.until, Algebraic_number(3.0));
  }
}

TEST(Neighbor_lives, are_short_below_the_threshold_exactly) {
  for (const double threshold : {0.75, std::nextafter(0.75, 1.0)}) {
    const bool is_short = threshold > 0.75;
    Simulation_2<> simulation(cross(), {});
    Neighbor_lives lives(simulation, threshold);
    run_cross(simulation);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found[i].is_short, is_short && i == 5) << i;
    for (const Point_exchanges& point : lives.exchanges()) {
      EXPECT_EQ(point.gained + point.lost, 2u);
      EXPECT_EQ(point.short_ones, is_short ? 2u : 0u);
    }
  }
}

// Points 0 and 1 pass through each other between 2 and 3, which rest: the length of their ridge is
// 3 minus a third of (2 - t)^2, and 3 at the time at which they meet.
TEST(Neighbor_lives, of_points_that_meet_have_the_limit_of_the_ridge_then) {
  for (const double threshold : {3.0, std::nextafter(3.0, 4.0)}) {
    const bool is_short = threshold > 3;
    Simulation_2<> simulation(
        {{{-2, 0}, {1, 0}, 0}, {{2, 0}, {-1, 0}, 0}, {{0, 3}, {}, 0}, {{0, -3}, {}, 0}}, {});
    Neighbor_lives lives(simulation, threshold);
    simulation.advance_to(4.0);
    const auto found = lives.lives();
    ASSERT_EQ(found.size(), 5u);
    for (const Neighbor_life& life : found) {
      EXPECT_EQ(life.begin, Algebraic_number(0.0));
      EXPECT_EQ(life.end, Algebraic_number(4.0));
      EXPECT_EQ(life.is_short, is_short && life.points == (Edge_ids{0, 1}));
    }
  }
}

// Points 0, 1 and 2 meet at t = 2 in the middle of the triangle of 3, 4 and 5, and part again,
// turned by half a turn: while all ridges that end are shorter than 100, none of those lives is
// long.
TEST(Neighbor_lives, of_three_points_that_meet_are_short) {
  Simulation_2<> simulation({{{2, 0}, {-1, 0}, 0},
                             {{-2, 2}, {1, -1}, 0},
                             {{-2, -2}, {1, 1}, 0},
                             {{-8, 0}, {}, 0},
                             {{8, 9}, {}, 0},
                             {{8, -9}, {}, 0}},
                            {});
  Neighbor_lives lives(simulation, 100);
  Stepped_run run(simulation);
  run.step_to(4.0);
  const auto found = lives.lives();
  expect_same(found, run.lives(100));
  const auto is_at_the_rim = [](const Neighbor_life& life) { return life.points[0] >= 3; };
  EXPECT_EQ(std::ranges::count_if(found, is_at_the_rim), 3);
  for (const Neighbor_life& life : found) EXPECT_EQ(life.is_short, !is_at_the_rim(life));
  std::size_t exchanges = 0;
  for (const Point_exchanges& point : lives.exchanges()) {
    EXPECT_EQ(point.short_ones, point.gained + point.lost);
    exchanges += point.gained + point.lost;
  }
  EXPECT_GT(exchanges, 0u);
}

// Points 0 and 3 pass through each other at t = 2: 3 leaves the triangle of 0, 1 and 2, and 0 comes
// into that of 1, 2 and 3. No edge comes or goes, but the ridges of 1-3 and 2-3 have no end then.
TEST(Neighbor_lives, of_points_that_exchange_the_hull_are_long) {
  Simulation_2<> simulation(
      {{{4, 0}, {-1, 0}, 0}, {{-4, 8}, {}, 0}, {{-4, -8}, {}, 0}, {{0, 0}, {1, 0}, 0}}, {});
  Neighbor_lives lives(simulation, 100);
  Stepped_run run(simulation);
  run.step_to(1.5);
  for (const Neighbor_life& life : lives.lives()) {
    EXPECT_EQ(life.is_short, life.points[1] == 3) << life.points[0] << "-" << life.points[1];
  }
  run.step_to(2.0);
  run.look();
  run.step_to(3.0);
  EXPECT_EQ(simulation.triangulation().counters().number_of_events(), 0u);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 6u);
  expect_same(found, run.lives(100));
  for (const Neighbor_life& life : found) {
    EXPECT_EQ(life.is_short, life.points == (Edge_ids{0, 3}));
  }
}

TEST(Neighbor_lives, refuse_a_threshold_that_is_none) {
  Simulation_2<> simulation(cross(), {});
  EXPECT_PRECONDITION_ERROR(Neighbor_lives(simulation, 0.0),
                            "the threshold of ridges is not positive and finite");
  EXPECT_PRECONDITION_ERROR(Neighbor_lives(simulation, std::nan("")),
                            "the threshold of ridges is not positive and finite");
}

// A point comes between two neighbors, and goes again.
TEST(Neighbor_lives, are_cut_by_points_that_come_and_go) {
  Simulation_2<> simulation({{{-1, 0}, {}, 0}, {{1, 0}, {}, 0}, {{0, -9}, {}, 0}, {{0, 9}, {}, 0}},
                            {});
  Neighbor_lives lives(simulation);
  simulation.schedule_insert(1.0, {{0, 0}, {}, 1});
  simulation.schedule_erase(2.0, 4);
  simulation.advance_to(3.0);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 10u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].end, Algebraic_number(1.0));
  EXPECT_EQ(found[0].ends_by, Life_limit::point);
  for (std::size_t i = 5; i < 9; ++i) {
    EXPECT_EQ(found[i].points, (Edge_ids{static_cast<Point_id>(i - 5), 4}));
    EXPECT_EQ(found[i].begins_by, Life_limit::point);
    EXPECT_EQ(found[i].ends_by, Life_limit::point);
  }
  EXPECT_EQ(found[9].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[9].begin, Algebraic_number(2.0));
  EXPECT_EQ(found[9].begins_by, Life_limit::point);
  const auto exchanges = lives.exchanges();
  ASSERT_EQ(exchanges.size(), 5u);
  for (const Point_exchanges& point : exchanges) EXPECT_EQ(point.gained + point.lost, 0u);
  EXPECT_EQ(exchanges[4].from, Algebraic_number(1.0));
  EXPECT_EQ(exchanges[4].until, Algebraic_number(2.0));
}

// ---- against the triangulation after each step ----

TEST(Neighbor_lives, of_random_motions_are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  std::size_t long_ones = 0;
  for (unsigned seed = 0; seed < seeds(3); ++seed) {
    for (const double threshold : {0.05, 0.5}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Simulation_2<> simulation(test::random_motions(9, 4, 1, seed), {});
      Neighbor_lives lives(simulation, threshold);
      Stepped_run run(simulation);
      run.step_to(3.0);
      const auto found = lives.lives();
      expect_same(found, run.lives(threshold));
      short_ones += number_of_short(found);
      long_ones += found.size() - number_of_short(found);
    }
  }
  EXPECT_GT(short_ones, 5u);
  EXPECT_GT(long_ones, 20u);
}

TEST(Neighbor_lives, of_degenerate_motions_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < seeds(15); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_2<> simulation(test::grid_motions(8, 4, 1, seed), {});
    Neighbor_lives lives(simulation, 0.5);
    Stepped_run run(simulation);
    run.step_to(4.0);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

TEST(Neighbor_lives, of_discs_are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  for (unsigned seed = 0; seed < seeds(5); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : test::grid_motions(8, 4, 1, seed)) {
      motions.push_back({motion, 0.25 * static_cast<double>(motions.size() % 4)});
    }
    Simulation_2<Disc_kinetic_traits_2> simulation(motions, {});
    Neighbor_lives lives(simulation, 0.25);
    Stepped_run run(simulation);
    run.step_to(3.0);
    const auto found = lives.lives();
    expect_same(found, run.lives(0.25));
    short_ones += number_of_short(found);
  }
  EXPECT_GT(short_ones, 0u);
}

TEST(Neighbor_lives, of_points_between_walls_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < seeds(2); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_options options = test::discs(0.125, collide_elastically);
    options.box = Box_2{0, 0, 4, 4};
    Simulation_2<> simulation(test::grid_motions(7, 4, 1, seed), options);
    Neighbor_lives lives(simulation, 0.25);
    Stepped_run run(simulation);
    run.step_to(4.0);
    expect_same(lives.lives(), run.lives(0.25));
  }
}

TEST(Neighbor_lives, of_tracks_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < seeds(3); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
    const test::Tracks tracks = test::random_walks(9, seed, 0, fraction);
    const auto simulation = simulate_tracks(tracks, stays_of(tracks, {.from = 0}), 0, {}, {});
    Neighbor_lives lives(*simulation, 0.5);
    Stepped_run run(*simulation);
    run.step_to(30.0);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

TEST(Neighbor_lives, of_points_that_come_turn_and_go_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < seeds(6); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Simulation_2<> simulation(test::grid_motions(5, 4, 1, seed), {});
    Neighbor_lives lives(simulation, 0.5);
    Stepped_run run(simulation);
    double now = 0;
    for (Linear_motion_2 motion : test::grid_motions(15, 4, 1, seed + 1000)) {
      now += 0.25 * static_cast<double>(random() % 4);
      run.step_to(now);
      motion.epoch = now;
      test::change_at_random(simulation, motion, random);
      run.look();
    }
    run.step_to(now + 1);
    expect_same(lives.lives(), run.lives(0.5));
  }
}

// ---- against the places at many times ----

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
  for (unsigned seed = 0; seed < seeds(12); ++seed) {
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
  for (unsigned seed = 0; seed < seeds(4); ++seed) {
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

// ---- exchanges ----

TEST(Neighbor_lives, count_the_points_of_each_flip) {
  for (unsigned seed = 0; seed < seeds(3); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation_2<> simulation(test::random_motions(30, 10, 1, seed), {});
    Neighbor_lives lives(simulation);
    test::Recorder recorder;
    simulation.add_observer(recorder);
    simulation.advance_to(5.0);
    std::map<Point_id, std::pair<std::size_t, std::size_t>> expected;
    for (const Event& event : recorder.events) {
      if (event.added) {
        for (const Point_id id : *event.added) ++expected[id].first;
      }
      if (event.removed) {
        for (const Point_id id : *event.removed) ++expected[id].second;
      }
    }
    EXPECT_GT(recorder.events.size(), 50u);
    for (const Point_exchanges& point : lives.exchanges()) {
      EXPECT_EQ(point.gained, expected[point.id].first);
      EXPECT_EQ(point.lost, expected[point.id].second);
    }
    for (const Neighbor_life& life : lives.lives()) {
      EXPECT_EQ(life.begins_by == Life_limit::run, life.begin == Algebraic_number(0.0));
      EXPECT_NE(life.begins_by, Life_limit::point);
      EXPECT_NE(life.ends_by, Life_limit::point);
    }
  }
}

// Real people, at first whole seconds of it.
TEST(Neighbor_lives, of_a_real_crowd_are_those_of_the_triangulation) {
  const std::string path = KINETRI_SHARED_DATA "/crowd/biwi_eth.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  test::Tracks tracks;
  for (const Track& track : read_tracks_file(path, Tracks_format::frames, 25).tracks) {
    tracks.emplace_back();
    for (const auto& seen : track.observations) tracks.back().push_back({seen.time, seen.place});
  }
  const auto simulation =
      simulate_tracks(tracks, stays_of(tracks, {.from = 30, .until = 60, .longest_gap = 1}), 30);
  Neighbor_lives lives(*simulation);
  Stepped_run run(*simulation);
  run.step_to(60.0);
  const auto found = lives.lives();
  EXPECT_GT(found.size(), 50u);
  expect_same(found, run.lives(std::nullopt));
}

}  // namespace
}  // namespace kinetri::neighbor_lives_test
