// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lives of edges in periodic boxes: against the triangulation after each step with exact ridges of
// its quadrilaterals, and against the triangulations of all images by brute force.
#include <CGAL/squared_distance_2.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/observers/neighbor_lives.h"
#include "observers/random_runs.h"
#include "observers/stepped_run.h"
#include "support/observed_periodic_run.h"
#include "support/periodic_runs.h"

namespace kinetri::periodic_neighbor_lives_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using Disc_traits = Periodic_disc_kinetic_traits_2;
using Time = Algebraic_number;
using test::expect_same;
using test::number_of_short;
using test::Periodic_run;
using test::Stepped_run;

// One point: the box becomes narrower, and a diagonal of the rectangle is the third edge, since x y
// decides. It is the other one when the second vector leans to the other side.
TEST(Periodic_neighbor_lives, of_one_point_are_of_its_own_images) {
  const Periodic_box_2 box({{4, 0}, {}, 0}, {{-1, 3}, {1, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Time(), Traits(box));
  Neighbor_lives lives(kinetic, 1.0);
  kinetic.advance_to(2.0);
  const auto found = lives.lives();
  ASSERT_EQ(found.size(), 4U);
  const auto expect_life = [&](std::size_t i, Lattice_offset_2 offset, double begin, double end) {
    EXPECT_EQ(found[i].points, (Edge_ids{0, 0})) << i;
    EXPECT_EQ(found[i].offset, offset) << i;
    EXPECT_EQ(found[i].begin, Time(begin)) << i;
    EXPECT_EQ(found[i].end, Time(end)) << i;
  };
  expect_life(0, {0, 1}, 0, 2);
  expect_life(1, {1, 0}, 0, 2);
  expect_life(2, {1, 1}, 0, 1);
  expect_life(3, {1, -1}, 1, 2);
  EXPECT_EQ(found[2].begins_by, Life_limit::run);
  EXPECT_EQ(found[2].ends_by, Life_limit::exchange);
  EXPECT_EQ(found[3].begins_by, Life_limit::exchange);
  // At the times 0 and 2 the ridge of the diagonal has the length sqrt(2), from (2, 1) to (1, 2).
  EXPECT_EQ(number_of_short(found), 0U);
  const auto exchanges = lives.exchanges();
  ASSERT_EQ(exchanges.size(), 1U);
  EXPECT_EQ(exchanges[0].gained, 2U);
  EXPECT_EQ(exchanges[0].lost, 2U);
  EXPECT_EQ(exchanges[0].short_ones, 0U);
}

// The same with a threshold beyond sqrt(2): both lives of diagonals are short, and so are the
// exchanges at both ends of both.
TEST(Periodic_neighbor_lives, of_one_point_are_short_below_the_threshold) {
  const Periodic_box_2 box({{4, 0}, {}, 0}, {{-1, 3}, {1, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Time(), Traits(box));
  Neighbor_lives lives(kinetic, 1.5);
  kinetic.advance_to(2.0);
  for (const Neighbor_life& life : lives.lives()) {
    EXPECT_EQ(life.is_short, life.offset.x == 1 && life.offset.y != 0);
  }
  EXPECT_EQ(lives.exchanges()[0].short_ones, 4U);
}

TEST(Periodic_neighbor_lives, are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  std::size_t long_ones = 0;
  std::size_t own = 0;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    const double threshold = std::array{0.25, 1.0, 2.0}[seed / 2 % 3];
    Neighbor_lives lives(run.kinetic(), threshold);
    Stepped_run stepped(run.kinetic());
    stepped.step_to(3.0);
    const auto found = lives.lives();
    ASSERT_NO_FATAL_FAILURE(expect_same(found, stepped.lives(threshold)));
    short_ones += number_of_short(found);
    long_ones += found.size() - number_of_short(found);
    for (const Neighbor_life& life : found) own += life.points[0] == life.points[1];
  }
  EXPECT_GT(short_ones, 15U);
  EXPECT_GT(long_ones, 50U);
  EXPECT_GT(own, 30U);
}

// Points that turn, jump, come, go, and coincide with images of others for a while.
TEST(Periodic_neighbor_lives, of_points_that_change_are_those_of_the_triangulation) {
  std::size_t ended_by_points = 0;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed));
    Periodic_run run(seed);
    Neighbor_lives lives(run.kinetic(), 1.0);
    Stepped_run stepped(run.kinetic());
    for (double time = 0; time <= 3; time += 0.5) {
      stepped.step_to(time);
      const int changes = run.integer(0, 3);
      for (int i = 0; i < changes; ++i) run.change();
      stepped.look();
      if (run.integer(0, 2) == 0) static_cast<void>(lives.lives());
    }
    const auto found = lives.lives();
    ASSERT_NO_FATAL_FAILURE(expect_same(found, stepped.lives(1.0)));
    for (const Neighbor_life& life : found) ended_by_points += life.ends_by == Life_limit::point;
  }
  EXPECT_GT(ended_by_points, 20U);
}

TEST(Periodic_neighbor_lives, of_discs_are_those_of_the_triangulation) {
  std::size_t short_ones = 0;
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const Periodic_box_2 box({{7, 0}, {}, 0}, {{1, 8}, {seed % 2 == 0 ? 0.0 : 1.0, 0.25}, 0});
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& motion : test::random_motions(random, 7, 4)) {
      motions.push_back({motion, 0.25 * static_cast<double>(motions.size() % 4)});
    }
    Simulation_2<Disc_traits> simulation(motions, {}, 0, Disc_traits(box));
    Neighbor_lives lives(simulation, 0.5);
    Stepped_run run(simulation);
    run.step_to(1.0);
    const auto found = lives.lives();
    ASSERT_NO_FATAL_FAILURE(expect_same(found, run.lives(0.5)));
    short_ones += number_of_short(found);
  }
  EXPECT_GT(short_ones, 10U);
}

TEST(Periodic_neighbor_lives, of_discs_that_collide_are_those_of_the_triangulation) {
  for (unsigned seed = 0; seed < test::cases(1u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 9; ++i) {
      const double vx = random(-3, 3);
      motions.push_back(
          {{3.0 * (i % 3), 3.0 * (i / 3)}, {vx, static_cast<double>(random(-3, 3))}, 0});
    }
    Simulation_options options;
    options.radius = 0.75;
    options.response = collide_elastically;
    Simulation_2<Traits> simulation(motions, options, 0, Traits(test::square(9)));
    Neighbor_lives lives(simulation, 0.25);
    Stepped_run run(simulation);
    run.step_to(1.5);
    expect_same(lives.lives(), run.lives(0.25));
  }
}

/// The squared lengths of the ridges at a rational time, by brute force.
std::map<Periodic_edge, Rational> squared_ridges(const Kinetic& kinetic, const Rational& t) {
  std::map<Periodic_edge, test::Static_point> first;
  std::map<Periodic_edge, Rational> result;
  for (const test::Face& face : test::reference_at(kinetic, t)) {
    const auto image = [&](std::size_t i) {
      const auto& [id, x, y] = face[i];
      return Image_motion_2{kinetic.motion(id),
                            {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)},
                            &kinetic.traits().box()};
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [p, px, py] = face[i];
      const auto& [q, qx, qy] = face[(i + 1) % 3];
      const Periodic_edge edge = periodic_edge(
          p, q, {static_cast<std::int32_t>(qx - px), static_cast<std::int32_t>(qy - py)});
      // The center less the place of the first end.
      const bool is_reversed =
          edge.ids != Edge_ids{p, q} || edge.offset.x != qx - px || edge.offset.y != qy - py;
      const auto center = CGAL::circumcenter(
          test::place_at(image(0), t), test::place_at(image(1), t), test::place_at(image(2), t));
      const auto relative =
          CGAL::ORIGIN + (center - test::place_at(image(is_reversed ? (i + 1) % 3 : i), t));
      const auto [other, is_new] = first.emplace(edge, relative);
      if (!is_new) result.emplace(edge, CGAL::squared_distance(relative, other->second));
    }
  }
  return result;
}

// Between two events the lives are those of the edges of brute force. No life whose ridge is seen
// to be long is short, and most that are long are seen to be: the others reach the threshold at
// other times.
TEST(Periodic_neighbor_lives, are_those_of_all_images_at_many_times) {
  std::size_t samples = 0;
  std::size_t seen = 0;
  std::size_t unseen = 0;
  std::size_t short_ones = 0;
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const Periodic_box_2 box = test::random_box(random, 3 + static_cast<int>(seed % 3));
    const auto motions = test::random_motions(random, 1 + static_cast<int>(seed % 5), 4);
    Kinetic kinetic(motions, Time(), Traits(box));
    const auto collapse = box.collapse_after(Time());
    const double end = collapse ? std::min(2.0, 0.75 * collapse->interval().lower) : 2.0;
    const double threshold = std::array{0.25, 0.75, 1.5}[seed % 3];
    Neighbor_lives lives(kinetic, threshold);
    std::set<Time> times = {Time(), Time(end)};
    while (kinetic.step(end) > 0) times.insert(kinetic.current_time());
    kinetic.advance_to(end);
    const auto found = lives.lives();
    std::vector<bool> is_seen_long(found.size(), false);
    for (auto time = times.begin(); std::next(time) != times.end(); ++time) {
      const Rational middle = simplest_between(*time, *std::next(time));
      for (const Rational& t : {middle, simplest_between(*time, Time(middle)),
                                simplest_between(Time(middle), *std::next(time))}) {
        if (denominator(t) > 100'000) continue;
        const auto ridges = squared_ridges(kinetic, t);
        std::set<Periodic_edge> edges;
        for (std::size_t i = 0; i < found.size(); ++i) {
          if (found[i].begin >= Time(t) || found[i].end <= Time(t)) continue;
          const Periodic_edge edge = {found[i].points, found[i].offset};
          edges.insert(edge);
          const auto ridge = ridges.find(edge);
          if (ridge == ridges.end()) continue;
          const Rational length = to_rational(threshold);
          if (ridge->second >= length * length) is_seen_long[i] = true;
        }
        // Others may be there while four images are cocircular for that moment.
        std::set<Periodic_edge> expected;
        bool is_degenerate = false;
        for (const auto& [edge, squared] : ridges) {
          expected.insert(edge);
          is_degenerate = is_degenerate || squared == 0;
        }
        if (!is_degenerate || edges.size() != expected.size()) {
          ++samples;
          ASSERT_EQ(edges, expected) << "at " << to_double(t);
        }
      }
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_FALSE(is_seen_long[i] && found[i].is_short) << i;
      seen += is_seen_long[i];
      unseen += !is_seen_long[i] && !found[i].is_short;
      short_ones += found[i].is_short;
    }
  }
  EXPECT_GT(samples, 200U);
  EXPECT_GT(seen, 100U);
  EXPECT_GT(short_ones, 15U);
  EXPECT_LT(10 * unseen, seen);
}

TEST(Periodic_neighbor_lives, count_the_points_of_each_flip) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Periodic_box_2 box({{10, 0}, {}, 0}, {{0, 10}, {2, 0}, 0});
    Kinetic kinetic(test::random_motions(8, 10, 1, seed), Time(), Traits(box));
    Neighbor_lives lives(kinetic);
    test::Recorder recorder;
    kinetic.add_observer(recorder);
    kinetic.advance_to(5.0);
    std::map<Point_id, std::pair<std::size_t, std::size_t>> expected;
    for (const Event& event : recorder.events) {
      ASSERT_EQ(event.kind, Event_kind::flip);
      for (const Point_id id : *event.added) ++expected[id].first;
      for (const Point_id id : *event.removed) ++expected[id].second;
    }
    EXPECT_GT(recorder.events.size(), 20U);
    for (const Point_exchanges& point : lives.exchanges()) {
      EXPECT_EQ(point.gained, expected[point.id].first);
      EXPECT_EQ(point.lost, expected[point.id].second);
    }
  }
}

}  // namespace
}  // namespace kinetri::periodic_neighbor_lives_test
