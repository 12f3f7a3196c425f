// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest approaches of discs with radii of their own: gaps between rims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/observers/closest_approaches.h"
#include "kinetri/simulation/tracks.h"
#include "support/motions.h"
#include "support/multiplier.h"
#include "support/precondition_error.h"
#include "support/random_walks.h"

namespace kinetri::closest_approaches_discs_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Discs = std::vector<Disc_motion_2>;
using Disc_simulation = Simulation_2<Disc_kinetic_traits_2>;

Simulation_options logging() {
  Simulation_options options;
  options.response = log_contact;
  return options;
}

Disc_motion_2 disc(Vector_2 place, Vector_2 velocity, double radius, double growth = 0) {
  return {{place, velocity, 0}, radius, growth, 0};
}

// ---- the oracle: all pairs, in rational arithmetic ----

// The number sqrt(squared) - subtracted.
struct Root_difference {
  Rational squared;
  Rational subtracted;
};

// The sign of a - b, by squaring.
int compare(const Root_difference& a, const Root_difference& b) {
  const Rational d = a.subtracted - b.subtracted;
  if (d < 0) return -compare(b, a);
  // sqrt(A) against sqrt(B) + d.
  const Rational excess = a.squared - b.squared - d * d;
  if (excess < 0) return -1;
  const Rational left = excess * excess;
  const Rational right = 4 * d * d * b.squared;
  return left < right ? -1 : left > right ? 1 : 0;
}

int compare(const Root_difference& a, const Rational& b) {
  return compare(a, b < 0 ? Root_difference{0, -b} : Root_difference{b * b, 0});
}

// Whether `number` is the binary64 number nearest to the other one.
testing::AssertionResult is_nearest(double number, const Root_difference& exact) {
  const auto middle = [&](double direction) {
    return Rational((to_rational(number) + to_rational(std::nextafter(number, direction))) / 2);
  };
  if (compare(exact, middle(-infinity)) >= 0 && compare(exact, middle(infinity)) <= 0) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << number << " is not nearest to the root of " << exact.squared
                                     << " minus " << exact.subtracted;
}

struct Rational_approach {
  Root_difference gap;
  Rational time;
  Edge_ids points = {no_point, no_point};

  friend bool operator<(const Rational_approach& a, const Rational_approach& b) {
    const int order = compare(a.gap, b.gap);
    if (order != 0) return order < 0;
    return std::tie(a.time, a.points) < std::tie(b.time, b.points);
  }
};

// Of discs that do not grow, where the distance is least.
Rational_approach closest_approach(const Edge_ids& points, const Disc_motion_2& p,
                                   const Disc_motion_2& q, const Rational& from,
                                   const Rational& to) {
  const Rational time = test::time_of_least_distance(p, q, from, to);
  return {{test::squared_distance(p, q, time), to_rational(p.radius) + to_rational(q.radius)},
          time,
          points};
}

Rational_approach closest_of_all_pairs(const Discs& discs, const Rational& until) {
  std::optional<Rational_approach> least;
  for (Point_id i = 0; i < discs.size(); ++i) {
    for (Point_id j = i + 1; j < discs.size(); ++j) {
      const auto approach = closest_approach({i, j}, discs[i], discs[j], 0, until);
      if (!least || approach < *least) least = approach;
    }
  }
  return *least;
}

void expect_equal(const Approach& found, const Rational_approach& expected) {
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.time, Algebraic_number(expected.time));
  EXPECT_TRUE(is_nearest(found.gap, expected.gap));
  EXPECT_TRUE(is_nearest(found.distance, {expected.gap.squared, 0}));
}

// All pairs that ever had an edge.
struct Edge_recorder : Event_observer {
  explicit Edge_recorder(Disc_simulation& simulation) {
    for (const Edge_ids& edge : simulation.triangulation().finite_edge_ids()) edges.insert(edge);
    simulation.add_observer(*this);
  }
  void after_event(const Event& event) override {
    if (event.added) edges.insert(*event.added);
  }

  std::set<Edge_ids> edges;
};

// ---- by hand ----

TEST(Closest_discs, of_two_sizes_are_those_of_the_least_gap_not_of_the_least_distance) {
  // The centers of the small ones are nearer to each other, the rims of the large ones are.
  Disc_simulation simulation({disc({0, 0}, {}, 10), disc({25, 0}, {-1, 0}, 12),
                              disc({0, 100}, {}, 0.5), disc({5, 100}, {-1, 0}, 0.5)},
                             logging());
  Closest_approaches closest(simulation, 2);
  simulation.advance_to(2.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].time, Algebraic_number(2.0));
  EXPECT_EQ(found[0].distance, 23);
  EXPECT_EQ(found[0].gap, 1);
  EXPECT_EQ(found[1].points, (Edge_ids{2, 3}));
  EXPECT_EQ(found[1].gap, 2);
}

TEST(Closest_discs, of_equal_gaps_are_ordered_by_time_and_ids) {
  // Gaps of 1: 3-4-5 and 5-12-13 triangles of different radii, and one that is reached later.
  Disc_simulation simulation(
      {disc({0, 0}, {}, 1), disc({3, 4}, {}, 3), disc({1000, 0}, {}, 4), disc({1005, 12}, {}, 8),
       disc({0, 1000}, {}, 2), disc({10, 1000}, {-1, 0}, 3), disc({1000, 1000}, {}, 0),
       disc({1000, 1001}, {}, 0)},
      logging());
  Closest_approaches closest(simulation, 4);
  simulation.advance_to(4.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 4u);
  const std::vector<Edge_ids> expected = {{0, 1}, {2, 3}, {6, 7}, {4, 5}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].points, expected[i]);
    EXPECT_EQ(found[i].gap, 1);
  }
  EXPECT_EQ(found[3].time, Algebraic_number(4.0));
}

// The two differ by about 10^-21.
TEST(Closest_discs, whose_gaps_round_to_the_same_number_are_in_exact_order) {
  const double above = std::nextafter(3.0, 4.0);
  const auto apart = [&](double x) {
    return Discs{disc({0, 0}, {}, 1), disc({above, x}, {}, 1), disc({100, 0}, {}, 0x1p-40),
                 disc({102, 0}, {}, 1 - 0x1p-40 - 0x1p-52)};
  };
  for (const double x : {0.0, 0x1p-31, 0x1p-34}) {
    const Discs discs = apart(x);
    Disc_simulation simulation(discs, logging());
    Closest_approaches closest(simulation, 1);
    expect_equal(closest.approaches().at(0), closest_of_all_pairs(discs, 0));
  }
}

// The small disc is hidden by the large ones: it has no edge, and is deeper in one of them than any
// two others.
TEST(Closest_discs, that_are_hidden_are_among_them) {
  Disc_simulation simulation({disc({0, 0}, {}, 10), disc({12, 0}, {}, 10), disc({0, 40}, {}, 1),
                              disc({1, -60}, {0, 10}, 4)},
                             logging());
  Edge_recorder recorder(simulation);
  Closest_approaches closest(simulation, 1);
  simulation.advance_to(20.0);
  const auto found = closest.approaches();
  EXPECT_EQ(found.at(0).points, (Edge_ids{0, 3}));
  EXPECT_EQ(found[0].time, Algebraic_number(6.0));
  EXPECT_EQ(found[0].distance, 1);
  EXPECT_EQ(found[0].gap, -13);

  Disc_simulation hidden({disc({0, 0}, {}, 10), disc({12, 0}, {}, 10), disc({12, 40}, {}, 1),
                          disc({0, 40}, {}, 1), disc({1, 0}, {}, 0.25)},
                         logging());
  ASSERT_TRUE(hidden.triangulation().is_hidden(4));
  Closest_approaches from_start(hidden, 4);
  const auto at_start = from_start.approaches();
  ASSERT_EQ(at_start.size(), 4u);
  EXPECT_EQ(at_start[0].points, (Edge_ids{0, 4}));
  EXPECT_EQ(at_start[0].gap, -9.25);
  EXPECT_EQ(at_start[1].points, (Edge_ids{0, 1}));
  // A new motion takes it out; another disc comes in.
  hidden.set_motion(4, disc({1, 0}, {0, 1}, 0.25));
  hidden.insert(disc({0, 0}, {0, -1}, 0.5));
  hidden.advance_to(20.0);
  const auto later = from_start.approaches();
  EXPECT_EQ(later[0].points, (Edge_ids{0, 5}));
  EXPECT_EQ(later[0].gap, -10.5);
}

// Discs 1 and 2 come into contact within disc 0.
TEST(Closest_discs, that_are_hidden_and_touch_are_among_them) {
  Disc_simulation simulation(
      {disc({0, 0}, {}, 10), disc({-3, 0}, {1, 0}, 1), disc({3, 0.5}, {-1, 0}, 1),
       disc({0, 40}, {}, 1), disc({40, -40}, {}, 1), disc({-40, -40}, {}, 1)},
      logging());
  Edge_recorder recorder(simulation);
  Closest_approaches closest(simulation, 3);
  simulation.advance_to(4.0);
  EXPECT_FALSE(recorder.edges.contains({1, 2}));
  const auto found = closest.approaches();
  EXPECT_EQ(found.at(0).points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].gap, -11);
  EXPECT_EQ(found.at(1).points, (Edge_ids{0, 2}));
  EXPECT_EQ(found[1].gap, -10.5);
  EXPECT_EQ(found.at(2).points, (Edge_ids{1, 2}));
  EXPECT_EQ(found[2].time, Algebraic_number(3.0));
  EXPECT_EQ(found[2].gap, -1.5);
}

// Discs 0 and 1 pass through each other inside of disc 2, which hides them.
TEST(Closest_discs, need_no_response) {
  Disc_simulation simulation(
      {disc({-3, 0}, {1, 0}, 1), disc({3, 0}, {-1, 0}, 2), disc({0, 5}, {}, 20)}, {});
  EXPECT_PRECONDITION_ERROR(
      simulation.overlapping_discs(0),
      "overlaps are followed only with a response; log_contact changes nothing");
  Closest_approaches closest(simulation, 3);
  simulation.advance_to(5.0);
  const auto found = closest.approaches();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[2].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[2].time, Algebraic_number(3.0));
  EXPECT_EQ(found[2].gap, -3);
}

// ---- all pairs ----

Discs random_discs(std::size_t number, unsigned seed, double least_radius, double greatest_radius) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> place(0, 40);
  std::uniform_real_distribution<double> velocity(-1, 1);
  std::uniform_real_distribution<double> exponent(std::log2(least_radius),
                                                  std::log2(greatest_radius));
  Discs result;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = place(random);
    const double y = place(random);
    const double vx = velocity(random);
    const double vy = velocity(random);
    result.push_back(disc({x, y}, {vx, vy}, std::exp2(exponent(random))));
  }
  return result;
}

// Without overlaps the pair must have an edge, which section 11 of MATH.md proves. With overlaps it
// need not.
TEST(Closest_discs, begin_with_the_closest_of_all_pairs) {
  struct Case {
    double least_radius;
    double greatest_radius;
    double until;
    double first_radius = 0;  // of the first disc, if it is not 0
  };
  int apart = 0;
  int without_edge = 0;
  for (const auto& [least_radius, greatest_radius, until, first_radius] :
       {Case{0x1p-12, 0x1p-2, 0.125}, Case{0x1p-20, 0.5, 4}, Case{0.125, 2, 20}, Case{2, 8, 20},
        Case{0x1p-18, 4, 1}, Case{0x1p-6, 0.25, 10, 15}}) {
    for (unsigned seed = 0; seed < test::cases(12u); ++seed) {
      SCOPED_TRACE("radii up to " + std::to_string(std::max(greatest_radius, first_radius)) +
                   ", seed " + std::to_string(seed));
      Discs discs = random_discs(30, seed, least_radius, greatest_radius);
      if (first_radius > 0) discs[0] = disc({20, 20}, {0, 0}, first_radius);
      Disc_simulation simulation(discs, logging());
      Edge_recorder recorder(simulation);
      Closest_approaches closest(simulation, 3);
      simulation.advance_to(until / 8);
      ASSERT_EQ(closest.approaches().size(), 3u);  // those to be beaten from then on
      simulation.advance_to(until);
      const auto found = closest.approaches();
      ASSERT_EQ(found.size(), 3u);
      const Rational_approach expected = closest_of_all_pairs(discs, to_rational(until));
      expect_equal(found[0], expected);
      for (std::size_t i : {1u, 2u}) {
        EXPECT_LE(found[i - 1].gap, found[i].gap);
        const auto [a, b] = found[i].points;
        const auto own = closest_approach({a, b}, discs[a], discs[b], 0, to_rational(until));
        EXPECT_TRUE(found[i].time != Algebraic_number(own.time) ||
                    is_nearest(found[i].gap, own.gap));
      }
      const bool has_edge = recorder.edges.contains(expected.points);
      if (compare(expected.gap, Rational(0)) > 0) {
        ++apart;
        EXPECT_TRUE(has_edge);
      } else if (!has_edge) {
        ++without_edge;
      }
    }
  }
  EXPECT_GT(apart, 15);
  EXPECT_GT(without_edge, 5);
}

// Discs on a lattice whose rims nearly touch, of sizes 1 : 10^6; with many equal gaps.
TEST(Closest_discs, on_a_lattice_begin_with_the_closest_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> speed(-1, 1);
    std::uniform_int_distribution<int> size(0, 2);
    Discs discs;
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 5; ++y) {
        const double radius =
            std::vector<double>{1e-6, 0.5, 1}[static_cast<std::size_t>(size(random))];
        const double vx = speed(random);
        discs.push_back(disc({4.0 * x, 4.0 * y}, {vx, static_cast<double>(speed(random))}, radius));
      }
    }
    for (const double until : {0.0, 0.5, 8.0}) {
      Disc_simulation simulation(discs, logging());
      Closest_approaches closest(simulation, 1);
      simulation.advance_to(until);
      expect_equal(closest.approaches().at(0), closest_of_all_pairs(discs, to_rational(until)));
    }
  }
}

// Discs that appear within others, turn and leave. Where they turn they have, by rounding, a new
// place, with which an overlap may begin without a contact.
TEST(Closest_discs, of_tracks_begin_with_the_closest_of_all_pairs) {
  int overlapping = 0;
  for (const double scale : {0x1p-10, 0.25, 2.0}) {
    for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
      SCOPED_TRACE("scale " + std::to_string(scale) + ", seed " + std::to_string(seed));
      const double fraction = seed % 2 == 0 ? 0 : 0x1p-10;
      const test::Tracks tracks = test::random_walks(9, seed, 0, fraction);
      std::mt19937_64 random(seed);
      std::uniform_real_distribution<double> factor(0.125, 1);
      std::vector<double> radii;
      for (std::size_t i = 0; i < tracks.size(); ++i) radii.push_back(scale * factor(random));
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
              if (from >= to) continue;
              const auto approach =
                  closest_approach({i, j}, {motion_after(a, k), radii[stays[i].track], 0, 0},
                                   {motion_after(b, l), radii[stays[j].track], 0, 0},
                                   to_rational(from), to_rational(to));
              if (!least || approach < *least) least = approach;
            }
          }
        }
      }
      const auto simulation = simulate_tracks(tracks, radii, stays, 0, logging(), {});
      Closest_approaches closest(*simulation, 3);
      simulation->advance_to(60.0);
      expect_equal(closest.approaches().at(0), *least);
      if (compare(least->gap, Rational(0)) < 0) ++overlapping;
    }
  }
  EXPECT_GT(overlapping, 20);
}

// ---- radii that grow ----

// The gap at a time, in long double.
long double gap_at(const Disc_motion_2& p, const Disc_motion_2& q, long double t) {
  const auto at = [&](double value, double slope) { return value + slope * t; };
  return std::hypot(at(p.position.x, p.velocity.x) - at(q.position.x, q.velocity.x),
                    at(p.position.y, p.velocity.y) - at(q.position.y, q.velocity.y)) -
         at(p.radius, p.growth) - at(q.radius, q.growth);
}

TEST(Closest_discs, that_grow_are_nearest_where_the_rims_stop_approaching) {
  const auto least = [](double growth, double speed, double until) {
    Disc_simulation simulation({disc({0, 0}, {}, 1, growth), disc({-4, 3}, {speed, 0}, 1)},
                               logging());
    Closest_approaches closest(simulation, 1);
    simulation.advance_to(until);
    return closest.approaches().at(0);
  };
  // The distance is sqrt(9 + (t - 4)^2), whose derivative is 4/5 at t = 8.
  const Approach between = least(0.8, 1, 20);
  EXPECT_NEAR(between.distance, 5, 1e-14);
  EXPECT_NEAR(between.gap, 5 - 2 - 6.4, 1e-15);
  EXPECT_NEAR(between.time.to_double(), 8, 1e-14);
  EXPECT_EQ(least(1, 1, 20).time, Algebraic_number(20.0));    // for ever
  EXPECT_EQ(least(2, 1, 20).time, Algebraic_number(20.0));    // faster than the centers part
  EXPECT_EQ(least(0.5, 0, 20).time, Algebraic_number(20.0));  // at rest
  EXPECT_EQ(least(0, 0, 20).time, Algebraic_number(0.0));     // never changes
  EXPECT_EQ(least(0, 1, 20).time, Algebraic_number(4.0));
  // Shrinking by 1/80: before the centers are nearest.
  const Approach shrinking = least(-0.0125, 1, 20);
  EXPECT_LT(shrinking.time, Algebraic_number(4.0));
  EXPECT_NEAR(shrinking.time.to_double(), 4 - 3 * 0.0125 / std::sqrt(1 - 0.0125 * 0.0125), 1e-14);
  // The rims of two that pass through each other, where the gap is constant from t = 2 on.
  Disc_simulation simulation({disc({0, 0}, {}, 1, 0.5), disc({-2, 0}, {1, 0}, 1, 0.5)}, logging());
  Closest_approaches closest(simulation, 1);
  simulation.advance_to(5.0);
  EXPECT_EQ(closest.approaches().at(0).time, Algebraic_number(2.0));
  EXPECT_EQ(closest.approaches()[0].gap, -4);
}

TEST(Closest_discs, that_grow_begin_with_the_closest_of_all_pairs) {
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Discs discs = random_discs(15, seed, 0x1p-6, seed % 2 == 0 ? 0.25 : 2);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> growth(-0x1p-9, 0.25);
    for (Disc_motion_2& disc : discs) disc.growth = growth(random);
    constexpr double until = 4;
    long double least = infinity;
    Edge_ids least_pair = {no_point, no_point};
    for (Point_id i = 0; i < discs.size(); ++i) {
      for (Point_id j = i + 1; j < discs.size(); ++j) {
        long double lower = 0;
        long double upper = until;
        for (int step = 0; step < 200; ++step) {  // the gap is a convex function
          const long double third = (upper - lower) / 3;
          const bool is_left =
              gap_at(discs[i], discs[j], lower + third) < gap_at(discs[i], discs[j], upper - third);
          (is_left ? upper : lower) = is_left ? upper - third : lower + third;
        }
        const long double gap = gap_at(discs[i], discs[j], lower);
        if (gap >= least) continue;
        least = gap;
        least_pair = {i, j};
      }
    }
    Disc_simulation simulation(discs, logging());
    Closest_approaches closest(simulation, 5);
    simulation.advance_to(until);
    const auto found = closest.approaches();
    EXPECT_EQ(found.at(0).points, least_pair);
    EXPECT_NEAR(found[0].gap, static_cast<double>(least), 1e-14);
    for (const Approach& approach : found) {
      const auto [a, b] = approach.points;
      EXPECT_NEAR(approach.gap,
                  static_cast<double>(gap_at(discs[a], discs[b], approach.time.to_double())),
                  1e-13);
    }
  }
}

}  // namespace
}  // namespace kinetri::closest_approaches_discs_test
