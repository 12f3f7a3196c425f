// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/closest_approaches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/contact_region_runs.h"
#include "support/disc_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::closest_approaches_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- the oracle: all pairs, in rational arithmetic ----

// An approach whose time is rational, ordered as Closest_approaches orders its own.
struct Rational_approach {
  Rational squared_distance;
  Rational time;
  Edge_ids points = {no_point, no_point};

  friend bool operator<(const Rational_approach& a, const Rational_approach& b) {
    return std::tie(a.squared_distance, a.time, a.points) <
           std::tie(b.squared_distance, b.time, b.points);
  }
};

Rational_approach closest_approach(const Edge_ids& points, const Linear_motion_2& p,
                                   const Linear_motion_2& q, const Rational& from,
                                   const Rational& to) {
  const Rational time = test::time_of_least_distance(p, q, from, to);
  return {test::squared_distance(p, q, time), time, points};
}

// Whether `distance` is the binary64 number nearest to the square root of `squared`.
testing::AssertionResult is_nearest_root(double distance, const Rational& squared) {
  const Rational exact = to_rational(distance);
  const Rational below = (exact + to_rational(std::nextafter(distance, -infinity))) / 2;
  const Rational above = (exact + to_rational(std::nextafter(distance, infinity))) / 2;
  if ((distance == 0 || below * below <= squared) && squared <= above * above) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << distance << " is not nearest to the root of " << squared;
}

std::vector<Linear_motion_2> random_motions(std::size_t number, unsigned seed, double origin) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, 40);
  std::uniform_real_distribution<double> velocity(-1, 1);
  std::vector<Linear_motion_2> motions(number);
  for (Linear_motion_2& motion : motions) {
    const double x = origin + place(random);
    const double y = origin + place(random);
    const double vx = velocity(random);
    motion = {{x, y}, {vx, velocity(random)}, 0};
  }
  return motions;
}

TEST(Closest_approaches, of_two_points_is_where_the_slope_vanishes) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{10, 3}, {-2, 0}, 0}}, {});
  Closest_approaches closest(simulation, 5);
  simulation.advance_to(100.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].time, Algebraic_number(Rational(10, 3)));
  EXPECT_EQ(found[0].distance, 3);
  EXPECT_PRECONDITION_ERROR(Closest_approaches(simulation, 0), "no approach is asked for");
}

// Near 1e15 neighboring binary64 numbers are 1/8 apart, and so a rounded place says nothing about
// distances that are less.
TEST(Closest_approaches, begin_with_the_closest_of_all_pairs_wherever_they_are) {
  for (const double origin : {0.0, 1e15}) {
    for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
      SCOPED_TRACE("origin " + std::to_string(origin) + ", seed " + std::to_string(seed));
      const std::vector<Linear_motion_2> motions = random_motions(30, seed, origin);
      std::optional<Rational_approach> least;
      for (Point_id i = 0; i < motions.size(); ++i) {
        for (Point_id j = i + 1; j < motions.size(); ++j) {
          const auto approach = closest_approach({i, j}, motions[i], motions[j], 0, 20);
          if (!least || approach < *least) least = approach;
        }
      }
      Simulation_2<> simulation(motions, {});
      Closest_approaches closest(simulation, 1);
      simulation.advance_to(20.0);
      const auto found = closest.approaches();
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(found[0].points, least->points);
      EXPECT_EQ(found[0].time, Algebraic_number(least->time));
      EXPECT_TRUE(is_nearest_root(found[0].distance, least->squared_distance));
    }
  }
}

TEST(Closest_approaches, of_tracks_begin_with_the_closest_of_all_pairs) {
  for (const auto& [origin, fraction] : {std::pair(0.0, 0x1p-10), {0.0, 0.0}, {1e15, 0.125}}) {
    for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
      SCOPED_TRACE("origin " + std::to_string(origin) + ", fraction " + std::to_string(fraction) +
                   ", seed " + std::to_string(seed));
      const test::Tracks tracks = test::random_walks(9, seed, origin, fraction);
      const auto stays = stays_of(tracks, {.from = 0});
      std::optional<Rational_approach> least;
      for (Point_id i = 0; i < stays.size(); ++i) {
        for (Point_id j = i + 1; j < stays.size(); ++j) {
          const auto& a = tracks[stays[i].track];
          const auto& b = tracks[stays[j].track];
          for (std::size_t k = 0; k + 1 < a.size(); ++k) {
            for (std::size_t l = 0; l + 1 < b.size(); ++l) {
              const double from = std::max(a[k].time, b[l].time);
              const double to = std::min(a[k + 1].time, b[l + 1].time);
              // One that leaves is still there at that time for one that comes then.
              const bool is_moment =
                  from == to && (k + 2 == a.size() || l + 2 == b.size()) && (k == 0 || l == 0);
              if (from >= to && !is_moment) continue;
              const auto approach = closest_approach({i, j}, motion_after(a, k), motion_after(b, l),
                                                     to_rational(from), to_rational(to));
              if (!least || approach < *least) least = approach;
            }
          }
        }
      }
      const auto simulation = simulate_tracks(tracks, stays, 0, {}, {});
      Closest_approaches closest(*simulation, 3);
      simulation->advance_to(60.0);
      const auto found = closest.approaches();
      ASSERT_EQ(found.size(), 3u);
      EXPECT_EQ(found[0].points, least->points);
      EXPECT_EQ(found[0].time, Algebraic_number(least->time));
      EXPECT_TRUE(is_nearest_root(found[0].distance, least->squared_distance));
    }
  }
}

// Contacts turn points, whose edges are then those of the triangulation: a run by regions is ahead.
TEST(Closest_approaches, of_points_between_walls_are_the_same_in_a_run_by_regions) {
  Simulation_options options;
  options.box = Box_2{0, 0, 100, 100};
  const auto motions = test::gas(100, 100, 0, 20, 1);
  std::vector<std::vector<Approach>> found;
  for (const bool is_by_regions : {false, true}) {
    Simulation_2<> simulation(motions, options);
    Closest_approaches closest(simulation, 50);
    if (is_by_regions) {
      detail::region_run_of(simulation, test::options_of(5, 0.5)).advance_to(5.0);
    } else {
      simulation.advance_to(5.0);
    }
    found.push_back(closest.approaches());
  }
  ASSERT_EQ(found[0].size(), 50u);
  ASSERT_EQ(found[1].size(), 50u);
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_EQ(found[0][k].points, found[1][k].points);
    EXPECT_EQ(found[0][k].time, found[1][k].time);
    EXPECT_EQ(found[0][k].distance, found[1][k].distance);
  }
}

// ---- points that are there together for one moment ----

// A thing leaves at t = 2, at (0, 0), where another one comes then, at (0, 1). Before and after
// that each has a neighbor at a distance of 5.
TEST(Closest_approaches, of_one_that_leaves_and_one_that_comes_are_at_that_time) {
  const test::Tracks tracks = {{{0, {0, 0}}, {2, {0, 0}}},
                               {{2, {0, 1}}, {5, {3, 1}}},
                               {{0, {5, 0}}, {5, {5, 0}}},
                               {{3, {0, 0.5}}, {5, {0, 0.5}}}};
  const auto stays = stays_of(tracks, {.from = 0});
  const auto simulation = simulate_tracks(tracks, stays, 0);
  Closest_approaches closest(*simulation, 9);
  simulation->advance_to(2.0);
  for (int i = 0; i < 2; ++i) {  // asked at the time itself, and later
    const auto found = closest.approaches();
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(stays[found[0].points[0]].track, 0u);
    EXPECT_EQ(stays[found[0].points[1]].track, 1u);
    EXPECT_EQ(found[0].time, Algebraic_number(2.0));
    EXPECT_EQ(found[0].distance, 1);
    // The one that comes at t = 3 does not meet the one that has left.
    const auto is_of = [&](const Approach& approach, std::size_t track) {
      return std::ranges::any_of(approach.points,
                                 [&](Point_id id) { return stays[id].track == track; });
    };
    EXPECT_TRUE(
        std::ranges::none_of(found, [&](const Approach& a) { return is_of(a, 0) && is_of(a, 3); }));
    simulation->advance_to(5.0);
  }
}

// Both are erased by a contact at t = 1, and one comes beside them then.
TEST(Closest_approaches, of_discs_that_vanish_and_one_that_comes_are_at_that_time) {
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0}, {{4, 0}, {-1, 0}, 0}},
                            test::discs(1, erase_both));
  simulation.schedule_insert(1.0, {{1, 0.25}, {0, 0}, 1});
  Closest_approaches closest(simulation, 9);
  simulation.advance_to(2.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 2}));
  EXPECT_EQ(found[0].gap, -1.75);
  EXPECT_EQ(found[0].time, Algebraic_number(1.0));
  EXPECT_EQ(found[1].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[2].points, (Edge_ids{1, 2}));
}

// Points that are far apart leave when others come that are: the nearest pairs are of one of these
// and one of those, and there are too many pairs to look at each.
TEST(Closest_approaches, of_many_that_leave_and_many_that_come_are_the_nearest_pairs) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> jitter(0, 16);
    constexpr int side = 12;
    test::Tracks tracks;
    for (const double time : {0.0, 1.0}) {
      for (int i = 0; i < side * side; ++i) {
        const Vector_2 place = {64 * (i % side) + 32 * time + (seed == 0 ? 0 : jitter(random)),
                                64 * (i / side) + (seed == 0 ? 0 : jitter(random))};
        tracks.push_back({{time, place}, {time + 1, place}});
      }
    }
    const auto stays = stays_of(tracks, {.from = 0});
    std::vector<Rational_approach> expected;
    for (Point_id i = 0; i < side * side; ++i) {
      for (Point_id j = side * side; j < 2 * side * side; ++j) {
        const auto& p = tracks[stays[i].track].back().place;
        const auto& q = tracks[stays[j].track].front().place;
        const Rational x = to_rational(p.x) - to_rational(q.x);
        const Rational y = to_rational(p.y) - to_rational(q.y);
        expected.push_back({x * x + y * y, 1, {i, j}});
      }
    }
    std::sort(expected.begin(), expected.end());
    for (const std::size_t number : {1u, 7u, 30u}) {
      const auto simulation = simulate_tracks(tracks, stays, 0);
      Closest_approaches closest(*simulation, number);
      simulation->advance_to(2.0);
      const auto found = closest.approaches();
      ASSERT_EQ(found.size(), number);
      for (std::size_t k = 0; k < number; ++k) {
        EXPECT_EQ(found[k].points, expected[k].points);
        EXPECT_EQ(found[k].time, Algebraic_number(1.0));
        EXPECT_TRUE(is_nearest_root(found[k].distance, expected[k].squared_distance));
      }
    }
  }
}

// ---- those that follow ----

// The pieces of the existence of all edges, with the motions that their points have.
class Edge_pieces : public Simulation_2<>::Observer {
 public:
  struct Piece {
    Edge_ids points;
    Linear_motion_2 p;
    Linear_motion_2 q;
    Algebraic_number from;
    Algebraic_number to;
  };

  explicit Edge_pieces(Simulation_2<>& simulation) : simulation_(simulation) {
    for (const Edge_ids& edge : simulation.triangulation().finite_edge_ids()) begin(edge, 0.0);
    simulation.add_observer(*this);
  }

  // The motions do not change in the runs that this is used for.
  void before_event(const Event& event) override {
    if (event.removed) end(*event.removed, event.time);
  }
  void after_event(const Event& event) override {
    if (event.added) begin(*event.added, event.time);
  }

  std::vector<Piece> all_until_now() {
    std::vector<Piece> result = ended_;
    for (const auto& [edge, from] : present_) {
      result.push_back(piece(edge, from, simulation_.current_time()));
    }
    return result;
  }

 private:
  Piece piece(const Edge_ids& edge, const Algebraic_number& from, const Algebraic_number& to) {
    const auto& triangulation = simulation_.triangulation();
    return {edge, triangulation.motion(edge[0]), triangulation.motion(edge[1]), from, to};
  }
  void begin(const Edge_ids& edge, const Algebraic_number& time) { present_.emplace(edge, time); }
  void end(const Edge_ids& edge, const Algebraic_number& time) {
    ended_.push_back(piece(edge, present_.at(edge), time));
    present_.erase(edge);
  }

  Simulation_2<>& simulation_;
  std::map<Edge_ids, Algebraic_number> present_;
  std::vector<Piece> ended_;
};

// An approach whose time is a rational number at most 2^-900 from the exact one: far nearer than
// two different squared distances of these runs are to each other.
struct Near_approach {
  Rational squared_distance;
  Algebraic_number time;
  Edge_ids points = {no_point, no_point};
};

Near_approach closest_approach(const Edge_pieces::Piece& piece) {
  const auto near = [](const Algebraic_number& time) {
    time.refine_to(scaled_by_power_of_two(1, -900));
    return time.lower();
  };
  const auto [squared, time, points] =
      closest_approach(piece.points, piece.p, piece.q, near(piece.from), near(piece.to));
  if (time == near(piece.from)) return {squared, piece.from, points};
  if (time == near(piece.to)) return {squared, piece.to, points};
  return {squared, time, points};
}

bool is_before(const Near_approach& a, const Near_approach& b) {
  const Rational difference = a.squared_distance - b.squared_distance;
  if (abs(difference) > scaled_by_power_of_two(1, -800)) return difference < 0;
  if (a.time != b.time) return a.time < b.time;
  return a.points < b.points;
}

// Every pair that ever had an edge, nearest first. The time is mostly that of a flip, a root of a
// polynomial of degree 4.
TEST(Closest_approaches, are_in_the_exact_order) {
  for (const double origin : {0.0, 1e15}) {
    for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
      for (const std::size_t number : {std::size_t{8}, std::size_t{1000}}) {
        SCOPED_TRACE("origin " + std::to_string(origin) + ", seed " + std::to_string(seed));
        Simulation_2<> simulation(random_motions(60, seed, origin), {});
        Edge_pieces pieces(simulation);
        Closest_approaches closest(simulation, number);
        simulation.advance_to(10.0);
        std::map<Edge_ids, Near_approach> of_pairs;
        for (const Edge_pieces::Piece& piece : pieces.all_until_now()) {
          const Near_approach approach = closest_approach(piece);
          const auto [known, is_new] = of_pairs.emplace(approach.points, approach);
          if (!is_new && is_before(approach, known->second)) known->second = approach;
        }
        std::vector<Near_approach> expected;
        for (const auto& [points, approach] : of_pairs) expected.push_back(approach);
        std::ranges::sort(expected, is_before);
        expected.resize(std::min(expected.size(), number));

        const auto found = closest.approaches();
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].points, expected[i].points) << "rank " << i;
          EXPECT_EQ(found[i].time, expected[i].time) << "rank " << i;
          EXPECT_TRUE(is_nearest_root(found[i].distance, expected[i].squared_distance));
        }
      }
    }
  }
}

// Discs that go when they touch: every contact has the squared distance 1, at an irrational time.
TEST(Closest_approaches, of_equal_distance_are_ordered_by_time_and_ids) {
  const Simulation_options options = test::discs(0.5, erase_both);
  Simulation_2<> simulation({{{0, 0}, {1, 0}, 0},
                             {{4, 0.5}, {0, 0}, 0},
                             {{0, 10}, {1, 0}, 0},
                             {{4, 10.5}, {0, 0}, 0},
                             {{0, -10}, {1, 0}, 0},
                             {{5, -10.5}, {0, 0}, 0}},
                            options);
  Closest_approaches closest(simulation, 3);
  simulation.advance_to(4.0);
  const auto early = closest.approaches();
  simulation.advance_to(6.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[1].points, (Edge_ids{2, 3}));
  EXPECT_EQ(found[2].points, (Edge_ids{4, 5}));
  EXPECT_EQ(found[0].time, found[1].time);
  EXPECT_FALSE(found[0].time.is_known_rational());
  EXPECT_LT(found[1].time, found[2].time);
  for (const Approach& approach : found) EXPECT_EQ(approach.distance, 1);
  EXPECT_EQ(early[0].time, found[0].time);
}

// ---- the distance ----

double least_distance(const Linear_motion_2& p, const Linear_motion_2& q, double until) {
  Simulation_2<> simulation({p, q}, {});
  Closest_approaches closest(simulation, 1);
  simulation.advance_to(until);
  return closest.approaches().at(0).distance;
}

TEST(Approach, has_the_distance_rounded_to_nearest) {
  const auto at_rest = [](double x, double y) {
    return least_distance({}, {{x, y}, {0, 0}, 0}, 1);
  };
  EXPECT_EQ(at_rest(3, 4), 5);
  EXPECT_EQ(at_rest(3e-300, 4e-300), std::sqrt(25.0) * 1e-300);
  EXPECT_EQ(at_rest(0x3p600, 0x4p600), 0x5p600);
  EXPECT_EQ(at_rest(0x3p-1074, 0x4p-1074), 0x5p-1074);
  EXPECT_EQ(at_rest(0, std::numeric_limits<double>::max()), std::numeric_limits<double>::max());
  EXPECT_EQ(least_distance({{-std::numeric_limits<double>::max(), 0}, {}, 0},
                           {{std::numeric_limits<double>::max(), 0}, {}, 0}, 1),
            infinity);
  // The middle of two numbers goes to the even one: the place at rest is 2^53 and 1 apart.
  EXPECT_EQ(least_distance({{-1, 0}, {}, 0}, {{0x1p53, 0}, {}, 0}, 1), 0x1p53);
  EXPECT_EQ(least_distance({{-3, 0}, {}, 0}, {{0x1p53, 0}, {}, 0}, 1), 0x1p53 + 4);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const double x = place(random);
    const double y = place(random);
    EXPECT_TRUE(is_nearest_root(at_rest(x, y),
                                to_rational(x) * to_rational(x) + to_rational(y) * to_rational(y)));
  }
}

// Points that meet are at the distance 0 exactly, however the places there are rounded.
TEST(Approach, of_points_that_meet_has_the_distance_zero) {
  EXPECT_EQ(least_distance({{1e15, 0}, {1, 1}, 0}, {{1e15 + 1, 1}, {-2, -2}, 0}, 1), 0);
}

}  // namespace
}  // namespace kinetri::closest_approaches_test
