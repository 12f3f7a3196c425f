// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/neighbor_lives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "support/brute_force_simulator.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri {
namespace {

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
    if (kinetic.contains(id)) result.motions.emplace(id, kinetic.motion(id));
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

template <class Motion>
Rational weight_at(const Motion& motion, const Rational& t) {
  if constexpr (HasWeight<Motion>) {
    const Rational radius =
        to_rational(motion.radius) + to_rational(motion.growth) * (t - to_rational(motion.epoch));
    return radius * radius + to_rational(motion.weight);
  } else {
    return 0;
  }
}

// Whether the ridge of the edge is as long as `length` at some time of the closed interval.
template <class Traits>
bool reaches(const Snapshot<Traits>& now, const Edge_ids& edge, double length,
             const Algebraic_number& until) {
  const Opposite& opposite = now.edges.at(edge);
  if (opposite[1] == no_point) return true;
  const Polynomial excess = test::interpolate(12, [&](const Rational& t) {
    const auto place = [&](Point_id id) { return test::place_at(now.motions.at(id), t); };
    const auto weight = [&](Point_id id) { return weight_at(now.motions.at(id), t); };
    // The centre less the place of the first end, times a denominator; and that.
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
    return Rational(x * x + y * y - threshold * threshold);
  });
  if (sign_at(excess, now.time) != CGAL::NEGATIVE || sign_at(excess, until) != CGAL::NEGATIVE) {
    return true;
  }
  return std::ranges::any_of(real_roots(excess), [&](const Real_root& root) {
    return root.value > now.time && root.value < until;
  });
}

// Steps through a run, and knows its lives.
template <class Traits>
class Stepped_run {
 public:
  explicit Stepped_run(Simulation_2<Traits>& simulation) : simulation_(simulation) { look(); }

  void step_to(double until) {
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

unsigned seeds(unsigned number) {
  return number * static_cast<unsigned>(test::multiplier());
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
    const test::Tracks tracks = test::random_walks(9, seed);
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
      const Point_id id = static_cast<Point_id>(random() % simulation.triangulation().next_id());
      const bool is_there = simulation.triangulation().contains(id);
      motion.epoch = now;
      try {
        if (!is_there || random() % 3 == 0) {
          simulation.insert(motion);
        } else if (random() % 2 == 0) {
          simulation.erase(id);
        } else {
          simulation.set_motion(id, motion);
        }
      } catch (const Coincident_trajectories_error&) {
      }
      run.look();
    }
    run.step_to(now + 1);
    expect_same(lives.lives(), run.lives(0.5));
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
}  // namespace kinetri
