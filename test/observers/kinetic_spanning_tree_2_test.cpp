// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/kinetic_spanning_tree_2.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/io/tracks_file.h"
#include "observers/random_runs.h"
#include "support/component_oracle.h"
#include "support/disc_runs.h"
#include "support/random_walks.h"

namespace kinetri::kinetic_spanning_tree_2_test {
namespace {

using test::run_of;
using Edges = std::vector<Edge_ids>;

// ---- the oracle: Kruskal's algorithm over all pairs ----

template <class Motion>
struct Pair {
  Edge_ids points;
  double rounded_length;
  const Motion* p;
  const Motion* q;
};

// The order just before or just after a time, of lengths, then of ids. Lengths that differ by far
// more than they are rounded are not compared exactly.
class Is_shorter {
 public:
  Is_shorter(const Algebraic_number& time, Time_side side) : time_(time), side_(side) {}
  template <class Motion>
  bool operator()(const Pair<Motion>& a, const Pair<Motion>& b) const {
    const double least = std::min(a.rounded_length, b.rounded_length);
    const double greatest = std::max(a.rounded_length, b.rounded_length);
    if (greatest - least > 1e-6 * (1 + greatest)) return a.rounded_length < b.rounded_length;
    const Polynomial difference = primitive_polynomial(
        test::sum(test::squared_distance(*a.p, *a.q), test::squared_distance(*b.p, *b.q), -1));
    const Sign sign = sign_at(difference, Instant{time_, side_});
    return sign == CGAL::ZERO ? a.points < b.points : sign == CGAL::NEGATIVE;
  }

 private:
  Algebraic_number time_;
  Time_side side_;
};

struct Tree {
  Edges edges;
  std::optional<Edge_ids> longest;
  double longest_length = 0;  // rounded
};

template <class Motion>
Tree spanning_tree(const std::vector<std::pair<Point_id, Motion>>& points,
                   const Algebraic_number& time, Time_side side) {
  const double t = time.to_double();
  std::vector<Pair<Motion>> pairs;
  test::Partition partition;
  for (const auto& [a, p] : points) {
    partition.add(a);
    for (const auto& [b, q] : points) {
      if (a >= b) continue;
      const Vector_2 from = rounded_place(p, t);
      const Vector_2 to = rounded_place(q, t);
      pairs.push_back({{a, b}, std::hypot(from.x - to.x, from.y - to.y), &p, &q});
    }
  }
  std::ranges::sort(pairs, Is_shorter(time, side));
  Tree result;
  for (const Pair<Motion>& pair : pairs) {
    if (partition.are_joined(pair.points[0], pair.points[1])) continue;
    partition.join(pair.points[0], pair.points[1]);
    result.edges.push_back(pair.points);
    result.longest = pair.points;
    result.longest_length = pair.rounded_length;
  }
  std::ranges::sort(result.edges);
  return result;
}

// The tree of the motions that points have just before or just after a time.
template <class Motion>
Tree tree_at(const std::vector<test::Motion_piece<Motion>>& pieces, const Algebraic_number& time,
             Time_side side) {
  std::vector<std::pair<Point_id, Motion>> points;
  for (const auto& [id, motion, from, to] : pieces) {
    const bool is_there =
        side == Time_side::before ? from < time && time <= to : from <= time && time < to;
    if (is_there) points.emplace_back(id, motion);
  }
  return spanning_tree(points, time, side);
}

// ---- comparisons ----

Edges without(const Edges& a, const Edges& b) {
  Edges result;
  std::ranges::set_difference(a, b, std::back_inserter(result));
  return result;
}

// Runs to `until`, asks at each instant and at rational times between, then compares each change,
// and the tree between two changes.
template <class Traits, class Make>
void expect_right(const Make& make_simulation, double until) {
  const auto asked_simulation = make_simulation();
  Kinetic_spanning_tree_2<Traits> asked(*asked_simulation);
  const auto look = [&] {
    std::vector<std::pair<Point_id, typename Traits::Motion>> points;
    const auto& triangulation = asked_simulation->triangulation();
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (triangulation.contains(id)) points.emplace_back(id, triangulation.motion(id));
    }
    const Tree expected = spanning_tree(points, asked_simulation->current_time(), Time_side::after);
    EXPECT_EQ(asked.edges(), expected.edges) << "just after " << asked_simulation->current_time();
  };
  look();
  for (int k = 1; Algebraic_number(Rational(k, 3)) < Algebraic_number(until); ++k) {
    while (asked_simulation->step(Rational(k, 3)) > 0) look();
    asked_simulation->advance_to(Rational(k, 3));
    look();
    if (testing::Test::HasFailure()) return;
  }
  asked_simulation->advance_to(until);
  look();

  const auto simulation = make_simulation();
  test::Motion_recorder<Traits> motions(*simulation);
  Kinetic_spanning_tree_2<Traits> tree(*simulation);
  Edges edges = tree.edges();
  const Algebraic_number start = simulation->current_time();
  const Algebraic_number end(until);
  simulation->advance_to(until);
  const auto changes = tree.changes();
  const auto longest = tree.longest_edges();
  const auto least_range = tree.least_connecting_range();
  const auto greatest_range = tree.greatest_connecting_range();
  simulation->advance_to(until + 1);  // to know the motions just after the end
  const auto pieces = motions.pieces();
  ASSERT_FALSE(longest.empty());
  auto next_longest = longest.begin();
  EXPECT_EQ(next_longest->time, start);
  Algebraic_number last = start;
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
  const auto expect_tree = [&](const Algebraic_number& time, Time_side side) {
    const Tree expected = tree_at(pieces, time, side);
    while (
        next_longest + 1 != longest.end() &&
        (side == Time_side::before ? next_longest[1].time < time : next_longest[1].time <= time)) {
      ++next_longest;
    }
    EXPECT_EQ(edges, expected.edges) << "beside " << time;
    EXPECT_EQ(next_longest->edge, expected.longest) << "beside " << time;
    if (!expected.longest) return;
    least = std::min(least, expected.longest_length);
    greatest = std::max(greatest, expected.longest_length);
  };
  for (const auto& [time, removed, added] : changes) {
    EXPECT_LE(last, time);
    EXPECT_LE(time, end);
    if (last < time) expect_tree(simplest_between(last, time), Time_side::after);
    const Edges before = tree_at(pieces, time, Time_side::before).edges;
    const Edges after = tree_at(pieces, time, Time_side::after).edges;
    EXPECT_EQ(removed, without(before, after)) << "at " << time;
    EXPECT_EQ(added, without(after, before)) << "at " << time;
    edges = without(edges, removed);
    edges.insert(edges.end(), added.begin(), added.end());
    std::ranges::sort(edges);
    expect_tree(time, Time_side::after);
    last = time;
    if (testing::Test::HasFailure()) return;
  }
  if (last < end) {
    expect_tree(end, Time_side::before);
    expect_tree(end, Time_side::after);
  }
  for (const auto& [time, edge, length] : longest) {
    EXPECT_EQ(edge, tree_at(pieces, time, Time_side::after).longest);
    if (time == start) continue;
    EXPECT_NE(edge, tree_at(pieces, time, Time_side::before).longest);
  }

  // The extremes of the range are reached, and are no less extreme than the range elsewhere.
  for (const bool is_greatest : {false, true}) {
    const auto& range = is_greatest ? greatest_range : least_range;
    ASSERT_EQ(range.has_value(), greatest > 0);
    if (!range) continue;
    const double found = range->range.to_double();
    if (is_greatest) {
      EXPECT_GE(found, greatest * (1 - 1e-9));
    } else {
      EXPECT_LE(found, least * (1 + 1e-9));
    }
    const double before = tree_at(pieces, range->time, Time_side::before).longest_length;
    const double after = tree_at(pieces, range->time, Time_side::after).longest_length;
    EXPECT_LE(std::min(std::abs(before - found), std::abs(after - found)), 1e-9 * (1 + found));
  }
  EXPECT_EQ(asked.changes().size(), changes.size());
}

// ---- known by construction ----

// Two points at rest, 4 apart, and one that passes between them, always as far from the one as from
// the other: the edge {0, 2} is before {1, 2}.
TEST(Kinetic_spanning_tree_2, of_three_points_changes_where_lengths_are_equal) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{4, 0}, {}, 0}, {{2, 5}, {0, -1}, 0}}, {});
  Kinetic_spanning_tree_2 tree(simulation);
  EXPECT_EQ(tree.edges(), (Edges{{0, 1}, {0, 2}}));
  EXPECT_EQ(tree.connecting_range()->edge, (Edge_ids{0, 2}));
  simulation.advance_to(10.0);
  const auto& changes = tree.changes();
  ASSERT_EQ(changes.size(), 2u);
  const auto is_twelve = [](const Algebraic_number& time) {
    return sign_at(Polynomial{13, -10, 1}, time) == CGAL::ZERO;  // (5 - t)^2 = 12
  };
  EXPECT_TRUE(is_twelve(changes[0].time));
  EXPECT_LT(changes[0].time, Algebraic_number(5.0));
  EXPECT_EQ(changes[0].removed, (Edges{{0, 1}}));
  EXPECT_EQ(changes[0].added, (Edges{{1, 2}}));
  EXPECT_TRUE(is_twelve(changes[1].time));
  EXPECT_GT(changes[1].time, Algebraic_number(5.0));
  EXPECT_EQ(changes[1].removed, (Edges{{1, 2}}));
  EXPECT_EQ(changes[1].added, (Edges{{0, 1}}));
  const auto longest = tree.longest_edges();
  ASSERT_EQ(longest.size(), 3u);
  EXPECT_EQ(longest[1].edge, (Edge_ids{1, 2}));
  EXPECT_EQ(longest[1].time, changes[0].time);
  EXPECT_EQ(longest[2].edge, (Edge_ids{0, 2}));
  EXPECT_EQ(longest[0].length, std::sqrt(29.0));
  EXPECT_EQ(longest[1].length, 4);
  const auto least = tree.least_connecting_range();
  EXPECT_EQ(least->range, Algebraic_number(2.0));
  EXPECT_EQ(least->time, Algebraic_number(5.0));
  EXPECT_EQ(least->edge, (Edge_ids{1, 2}));
  const auto greatest = tree.greatest_connecting_range();
  EXPECT_EQ(sign_at(Polynomial{-29, 0, 1}, greatest->range), CGAL::ZERO);
  EXPECT_EQ(greatest->time, Algebraic_number(0.0));
  EXPECT_EQ(tree.connecting_range()->range, greatest->range);
}

TEST(Kinetic_spanning_tree_2, of_few_points_has_no_longest_edge) {
  Simulation_2<> simulation(std::vector<Linear_motion_2>(), {});
  Kinetic_spanning_tree_2 tree(simulation);
  EXPECT_TRUE(tree.edges().empty());
  EXPECT_FALSE(tree.connecting_range());
  EXPECT_FALSE(tree.greatest_connecting_range());
  simulation.advance_to(1.0);
  simulation.insert({{0, 0}, {}, 0});
  simulation.insert({{3, 4}, {}, 0});
  EXPECT_TRUE(tree.is_edge({0, 1}));
  EXPECT_FALSE(tree.is_edge({0, 7}));
  EXPECT_EQ(tree.connecting_range()->range, Algebraic_number(5.0));
  simulation.advance_to(2.0);
  simulation.erase(0);
  EXPECT_FALSE(tree.connecting_range());
  const auto longest = tree.longest_edges();
  ASSERT_EQ(longest.size(), 3u);
  EXPECT_EQ(longest[1].edge, (Edge_ids{0, 1}));
  EXPECT_EQ(longest[2].edge, std::nullopt);
  EXPECT_EQ(tree.least_connecting_range()->range, Algebraic_number(5.0));
}

// The ranges are 8 up to the time 2, then 2 up to the time 3, and 18 from then on.
TEST(Kinetic_spanning_tree_2, has_extreme_ranges_just_before_and_just_after_a_change) {
  Simulation_2<> simulation({{{0, 0}, {}, 0}, {{2, 0}, {}, 0}, {{10, 0}, {}, 0}}, {});
  simulation.schedule_erase(2, 2);
  simulation.schedule_insert(3, {{20, 0}, {}, 3});
  Kinetic_spanning_tree_2 tree(simulation);
  const auto expect_range = [](const std::optional<Connecting_range>& found, double range,
                               const Edge_ids& edge, double time) {
    ASSERT_TRUE(found);
    EXPECT_EQ(found->range, Algebraic_number(range));
    EXPECT_EQ(found->edge, edge);
    EXPECT_EQ(found->time, Algebraic_number(time));
  };
  simulation.advance_to(2.0);
  expect_range(tree.least_connecting_range(), 2, {0, 1}, 2);
  expect_range(tree.greatest_connecting_range(), 8, {1, 2}, 0);
  simulation.advance_to(3.0);
  expect_range(tree.least_connecting_range(), 2, {0, 1}, 2);
  expect_range(tree.greatest_connecting_range(), 18, {1, 3}, 3);
}

// ---- compared with Kruskal's algorithm ----

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = test::random_motions(8 + 8 * (seed % 3), 10, 1, seed);
    expect_right<Linear_kinetic_traits_2>(run_of(motions), 3);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_of_sixty_points) {
  expect_right<Linear_kinetic_traits_2>(run_of(test::random_motions(60, 20, 1, 7)), 0.5);
}

// Many lengths are equal, at a time or always; points meet.
TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_where_lengths_are_equal) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_right<Linear_kinetic_traits_2>(
        run_of(test::grid_motions(10, 5, 1 + static_cast<int>(seed) % 2, seed)), 4);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_on_a_line) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto motions = test::grid_motions(30, 12, 2, seed);
    std::set<std::pair<double, double>> chosen;
    std::erase_if(motions, [&](Linear_motion_2& m) {
      m.position.y = m.velocity.y = 0;
      return !chosen.emplace(m.position.x, m.velocity.x).second || chosen.size() > 9;
    });
    expect_right<Linear_kinetic_traits_2>(run_of(motions), 4);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_on_accelerated_motions) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto grid = test::polynomial_grid_motions(6, 5, 2, 3, seed);
    const auto random = test::random_polynomial_motions(7, 6, 2, seed);
    expect_right<Polynomial_kinetic_traits_2>(run_of(grid), 1.5);
    expect_right<Polynomial_kinetic_traits_2>(run_of(random), 1.5);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_through_walls_and_collisions) {
  for (const Collision_response& response :
       {Collision_response(collide_elastically), Collision_response(erase_both)}) {
    const auto motions = test::discs_in_a_box(12, 2, 3);
    const auto options = test::discs(test::box_of(12), 1, response);
    expect_right<Linear_kinetic_traits_2>(run_of(motions, options), 2);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_on_tracks_with_gaps) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
    const test::Tracks tracks = test::random_walks(9, seed, 0, fraction);
    const auto stays = stays_of(tracks, {.from = 0, .longest_gap = 2.5});
    expect_right<Linear_kinetic_traits_2>([&] { return simulate_tracks(tracks, stays, 0); }, 12);
  }
}

TEST(Kinetic_spanning_tree_2, is_that_of_all_pairs_through_scheduled_changes) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto make = test::scheduled_changes(9, 7, seed);
    expect_right<Linear_kinetic_traits_2>(make, 5);
  }
}

TEST(Kinetic_spanning_tree_2, of_recorded_pedestrians_is_that_of_all_pairs) {
  const std::filesystem::path path =
      std::filesystem::path(KINETRI_SHARED_DATA) / "crowd" / "students003.txt";
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "no recorded tracks: " << path << " does not exist";
  }
  const Tracks_file file = read_tracks_file(path, Tracks_format::frames, 25);
  std::vector<std::vector<Observation_2>> tracks;
  for (const Track& track : file.tracks) {
    for (tracks.emplace_back(); const auto& [time, place, line] : track.observations) {
      tracks.back().push_back({time, place});
    }
  }
  const double from = tracks.front().front().time;
  const auto stays = stays_of(tracks, {.from = from, .until = from + 12, .longest_gap = 5});
  const auto simulation = simulate_tracks(tracks, stays, from);
  Kinetic_spanning_tree_2 tree(*simulation);
  for (int k = 1; k <= 12; ++k) {
    simulation->advance_to(to_rational(from) + k - Rational(1, 7));
    std::vector<std::pair<Point_id, Linear_motion_2>> points;
    for (Point_id id = 0; id < simulation->triangulation().next_id(); ++id) {
      if (!simulation->triangulation().contains(id)) continue;
      points.emplace_back(id, simulation->triangulation().motion(id));
    }
    const Tree expected = spanning_tree(points, simulation->current_time(), Time_side::after);
    EXPECT_EQ(tree.edges(), expected.edges);
    EXPECT_EQ(tree.connecting_range()->edge, expected.longest);
  }
}

}  // namespace
}  // namespace kinetri::kinetic_spanning_tree_2_test
