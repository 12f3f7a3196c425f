// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs by regions against the plain loop: the same events, with the same numbers and exact times,
// and the same state, however small the regions and whatever the windows.
#include "triangulation/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/motions.h"
#include "support/multiplier.h"
#include "support/region_runs.h"

namespace kinetri::regions_test {
namespace {

using detail::Region_counters;
using test::difference_from_loop;
using test::difference_of_states;
using test::Kinetic_delaunay;
using test::options_of;

TEST(Region_division, has_a_lowest_node_for_two_vertices) {
  for (std::size_t regions = 1; regions <= 128; regions *= 2) {
    detail::Region_division division;
    division.regions = regions;
    // Two vertices in each region.
    for (std::size_t id = 0; id < 2 * regions; ++id) {
      division.owners.push_back(static_cast<std::uint16_t>(id / 2));
    }
    const std::size_t root = division.nodes() - 1;
    const auto path = [&](std::size_t node) {
      std::vector<std::size_t> result = {node};
      while (result.back() != root) result.push_back(division.above(result.back()));
      return result;
    };
    std::vector<std::size_t> below(root + 1);
    for (std::size_t node = 0; node < root; ++node) {
      ++below[division.above(node)];
      EXPECT_EQ(division.level(division.above(node)), division.level(node) + 1);
      EXPECT_EQ(division.level(node) == 0, node < regions);
    }
    for (std::size_t node = regions; node <= root; ++node) {
      EXPECT_EQ(below[node], regions == 1 ? 1u : 2u);
    }
    for (Point_id a = 0; a < 2 * regions; ++a) {
      EXPECT_EQ(division.node_of(a, no_point), root);
      for (Point_id b = 0; b < 2 * regions; ++b) {
        const std::vector<std::size_t> of_a = path(a / 2);
        const std::vector<std::size_t> of_b = path(b / 2);
        EXPECT_EQ(division.node_of(a, b), *std::ranges::find_first_of(of_a, of_b));
      }
    }
  }
}

TEST(Region_division, has_numbers_for_the_flips_of_each_node) {
  for (std::size_t regions = 1; regions <= 128; regions *= 2) {
    detail::Region_division division;
    division.regions = regions;
    std::vector<double> shares;
    for (std::size_t k = 0; k < division.nodes(); ++k) shares.push_back(division.share(k));
    for (const unsigned bits : {12u, 24u}) {
      const detail::Flip_numbers numbers(shares, bits);
      std::size_t next = 0;
      for (std::size_t node = 0; node < division.nodes(); ++node) {
        EXPECT_EQ(numbers.first(node), next);
        ASSERT_GT(numbers.size(node), 0u);
        next += numbers.size(node);
        EXPECT_EQ(numbers.node(numbers.first(node)), node);
        EXPECT_EQ(numbers.node(static_cast<std::uint32_t>(next - 1)), node);
      }
      // A version is a number and one.
      EXPECT_LT(next, std::size_t{1} << bits);
      EXPECT_GT(next, std::size_t{7} << (bits - 3));
    }
  }
}

TEST(Regions, run_random_points_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    const std::size_t n = 30 + 13 * (seed % 60);
    const std::size_t regions = 1 + seed * 7 % 64;
    const double events = seed % 4 == 0 ? 0.02 : 0.2 * (seed % 4) * (seed % 5 + 1);
    ASSERT_EQ(difference_from_loop(test::random_motions(n, 100, 5, seed), {0.5, 1.25},
                                   options_of(regions, events), sum),
              "")
        << "seed " << seed;
  }
  // Else the test would say little.
  EXPECT_GT(sum.by_region, 0u);
  EXPECT_GT(sum.by_union, 0u);
  EXPECT_GT(sum.by_root, 0u);
  EXPECT_GT(sum.rolled_back, 0u);
}

// Long windows and many small regions: flips come too early, and some never come.
TEST(Regions, undo_flips_that_come_too_early) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(50u); ++seed) {
    const std::size_t n = 30 + seed * 37 % 300;
    const auto motions =
        seed % 3 == 2 ? test::grid_motions(n, 60, 50, seed) : test::random_motions(n, 100, 5, seed);
    Kinetic_delaunay plain(motions);
    Kinetic_delaunay kinetic(motions);
    auto run = detail::region_run_of(kinetic, options_of(2 + seed % 63, 0.05 * (1u << (seed % 8))));
    for (const double share : {0.25, 1.0}) {
      const double time = share * (seed % 3 == 2 ? 0.2 : 1);
      plain.advance_to(time);
      run.advance_to(time);
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
    }
    test::add(sum, run.counters());
  }
  EXPECT_GT(sum.rolled_back, 0u);
  EXPECT_GT(sum.truncated, 0u);
}

TEST(Regions, run_points_on_a_grid_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(30u); ++seed) {
    const std::size_t n = 5 + seed % 60;
    ASSERT_EQ(difference_from_loop(test::grid_motions(n, 4 + static_cast<int>(seed % 40), 3, seed),
                                   {1.0, Rational(7, 3), 6.0},
                                   options_of(1 + seed % 9, 0.1 + seed % 3), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Points that leave a corner, and points that come together: many come to the hull and leave it.
TEST(Regions, change_the_hull_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    const auto motions =
        test::random_motions(20 + 9 * (seed % 20), 10, seed % 2 == 0 ? 20 : 5, seed);
    ASSERT_EQ(difference_from_loop(motions, {0.125, 0.75, 2.0}, options_of(1 + seed % 12, 1), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.by_root, 0u);
}

TEST(Regions, run_polynomial_motions_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    const std::size_t n = 40 + 10 * (seed % 12);
    const auto motions = seed % 3 == 2 ? test::polynomial_grid_motions(n, 30, 4, 3, seed)
                                       : test::random_polynomial_motions(n, 100, 5, seed);
    ASSERT_EQ(difference_from_loop<Polynomial_kinetic_traits_2>(motions, {0.5, 2.0},
                                                                options_of(2 + seed % 7, 0.5), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Bounds of times that are so wide that only the exact times tell the order.
TEST(Regions, run_without_filter_as_the_loop_does) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 6; ++seed) {
    ASSERT_EQ(difference_from_loop(test::random_motions(60 + 40 * seed, 100, 5, seed), {0.5, 2.0},
                                   options_of(2 + seed, 2), sum, Linear_kinetic_traits_2::exact()),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// A point that falls through others that rest, and the same elsewhere, a little slower: two events
// are less than the distance of binary64 numbers apart.
TEST(Regions, put_times_in_order_that_bounds_do_not_tell_apart) {
  constexpr double fall = 1 << 30;
  Region_counters sum;
  for (unsigned seed = 0; seed < 6; ++seed) {
    auto motions = test::random_motions(60, 100, 0, seed);
    for (Linear_motion_2& m : motions) {
      m.position = {std::ldexp(std::round(std::ldexp(m.position.x, 20)), -20),
                    std::ldexp(std::round(std::ldexp(m.position.y, 20)), -20)};
    }
    for (std::size_t k = 0; k < 60; ++k) {
      Linear_motion_2 other = motions[k];
      other.position.x += 1024;
      motions.push_back(other);
    }
    motions.push_back({{50, fall + 1}, {0, -(fall + 1)}});
    motions.push_back({{50 + 1024, fall}, {0, -fall}});
    ASSERT_EQ(difference_from_loop(motions, {1.5}, options_of(2 + seed % 2, 4), sum), "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// So fast that bounds of times are wider than slices of a window: flips of one slice belong among
// those of another.
TEST(Regions, put_times_in_order_across_slices) {
  constexpr double fast = std::uint64_t{1} << 38;
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    std::mt19937_64 random(seed);
    const auto whole = [&](int least, int greatest) {
      return static_cast<double>(std::uniform_int_distribution<int>(least, greatest)(random));
    };
    std::vector<Linear_motion_2> motions;
    for (int k = 0; k < 60; ++k) {  // in a square at t = 1
      const Vector_2 velocity = {whole(-127, 127) * fast, whole(-127, 127) * fast};
      motions.push_back({{whole(0, 4095) - velocity.x, whole(0, 4095) - velocity.y}, velocity});
    }
    ASSERT_EQ(difference_from_loop(motions, {1 - std::ldexp(1, -39), 1 + std::ldexp(1, -39), 2},
                                   options_of(2 + 3 * (seed % 4), 0.1), sum),
              "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// A point that reaches the side of the hull at t = 1 and turns back: an instant without an event.
TEST(Regions, leave_a_touch_of_the_hull_to_the_loop) {
  Region_counters sum;
  for (unsigned seed = 0; seed < 8; ++seed) {
    auto motions = test::random_motions(80, 60, 2, seed);
    for (Linear_motion_2& m : motions) m.position.y += 20;
    motions.push_back({{0, 0}, {0, 0}});
    motions.push_back({{10, -10}, {0, 10}});
    motions.push_back({{6, -5}, {-1, 5}});
    ASSERT_EQ(difference_from_loop(motions, {0.5, 2.0}, options_of(1 + seed, 4), sum), "")
        << "seed " << seed;
  }
  EXPECT_GT(sum.truncated_windows, 0u);
}

// Runs by regions one after the other, with changes of points and single events between them.
TEST(Regions, keep_their_division_while_points_change) {
  Region_counters sum;
  // More threads than this machine may have.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    std::mt19937_64 random(seed);
    const auto motions = test::random_motions(150 + 20 * (seed % 12), 100, 5, seed);
    auto others = test::random_motions(400, 100, 5, seed + 100);
    Kinetic_delaunay plain(motions);
    Kinetic_delaunay kinetic(motions);
    kinetic.set_threads(seed % 3 == 0 ? 1 : 4);
    for (unsigned round = 1; round <= 8; ++round) {
      const double time = 0.25 * round;
      auto run = detail::region_run_of(kinetic, options_of(2 + seed % 4, 0.3));
      ASSERT_EQ(plain.advance_to(time), run.advance_to(time));
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed << ", t = " << time;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
      test::add(sum, run.counters());
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> turned;
      for (Point_id id = 0; id < plain.next_id(); ++id) {
        if (!plain.contains(id) || random() % 16 != 0) continue;
        ids.push_back(id);
        turned.push_back(others[id]);
        turned.back().epoch = time;
      }
      if (ids.empty()) continue;
      for (Kinetic_delaunay* k : {&plain, &kinetic}) {
        k->set_motions(ids, turned);
        k->insert(others[300 + round]);
        k->erase(ids.front());
        if (round % 4 == 1) k->step();
        if (round % 4 == 2) k->next_event_time();
      }
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed << ", t = " << time;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
    }
    plain.reverse();
    kinetic.reverse();
    ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Between runs by regions many points turn: each region turns its own.
TEST(Regions, turn_many_points_at_once) {
  // More threads than this machine may have.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t n = 200 + 100 * (seed % 8);
    const auto motions = test::random_motions(n, 10 * std::sqrt(static_cast<double>(n)), 5, seed);
    Kinetic_delaunay plain(motions);
    Kinetic_delaunay kinetic(motions);
    kinetic.set_threads(seed % 4 == 0 ? 1 : 4);
    for (unsigned round = 1; round <= 5; ++round) {
      const double time = 0.25 * round;
      auto run = detail::region_run_of(kinetic, options_of(1 + seed % 6, 0.3));
      plain.advance_to(time);
      run.advance_to(time);
      test::add(sum, run.counters());
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> turned;
      for (Point_id id = 0; id < n; ++id) {
        if (random() % (4 + seed % 5) != 0) continue;
        const Vector_2 velocity = {static_cast<double>(random() % 11) - 5,
                                   static_cast<double>(random() % 11) - 5};
        ids.push_back(id);
        turned.push_back(with_velocity_at(kinetic.motion(id), velocity, time));
      }
      plain.set_motions(ids, turned);
      kinetic.set_motions(ids, turned);
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed << ", t = " << time;
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "") << "seed " << seed;
    }
    ASSERT_EQ(plain.advance_to(3.0), kinetic.advance_to(3.0));
    ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
  }
  EXPECT_GT(sum.windows, 0u);
}

// Between two windows somebody may end the run; then it is that of the plain loop up to there.
TEST(Regions, stop_where_they_may_not_go_on) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto motions = test::random_motions(300, 100, 5, seed);
    Kinetic_delaunay plain(motions);
    Kinetic_delaunay kinetic(motions);
    std::size_t events = 0;
    std::size_t stops = 0;
    std::size_t windows = 0;
    while (kinetic.current_time() < 1.0) {
      auto run = detail::region_run_of(kinetic, options_of(2 + seed, 0.3));
      // The first run begins with seven events one by one.
      const unsigned most = stops == 0 ? 9 : 2 + seed % 2;
      unsigned asked = 0;
      const std::size_t more = run.advance_to(1.0, [&] { return ++asked < most; });
      EXPECT_LE(asked, most);
      windows += run.counters().windows;
      ASSERT_EQ(plain.advance_to(kinetic.current_time()), more);
      ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
      events += more;
      ++stops;
    }
    EXPECT_GT(events, 300u);
    EXPECT_GT(stops, 2u);
    EXPECT_GT(windows, 2u);
  }
}

// One that throws when it is told of a certain event.
class Thrower : public Event_observer {
 public:
  explicit Thrower(std::uint64_t number) : number_(number) {}
  bool looks_at_triangulation() const override { return false; }
  void after_event(const Event& event) override {
    if (event.number == number_) throw std::runtime_error("enough");
  }

 private:
  std::uint64_t number_;
};

TEST(Regions, are_usable_after_an_observer_has_thrown) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto motions = test::random_motions(300, 100, 5, seed);
    Kinetic_delaunay plain(motions);
    Kinetic_delaunay kinetic(motions);
    Thrower thrower(150 + seed);
    kinetic.add_observer(thrower);
    auto run = detail::region_run_of(kinetic, options_of(2 + seed, 0.5));
    EXPECT_THROW(run.advance_to(2.0), std::runtime_error);
    EXPECT_GT(run.counters().windows, 0u);
    plain.advance_to(kinetic.current_time());
    ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
    ASSERT_GT(plain.counters().number_of_events(), 150u + seed);
    plain.advance_to(2.0);
    detail::region_run_of(kinetic, options_of(3, 0.5)).advance_to(2.0);
    ASSERT_EQ(difference_of_states(plain, kinetic), "") << "seed " << seed;
  }
}

// What a snapshot has is enough to go on by regions.
TEST(Regions, go_on_from_a_snapshot) {
  const auto motions = test::random_motions(500, 100, 5, 3);
  Kinetic_delaunay plain(motions);
  Kinetic_delaunay kinetic(motions);
  detail::region_run_of(kinetic, options_of(6, 0.3)).advance_to(0.75);
  Kinetic_delaunay restored = Kinetic_delaunay::restore(kinetic.snapshot());
  detail::region_run_of(restored, options_of(9, 0.3)).advance_to(1.5);
  plain.advance_to(1.5);
  EXPECT_EQ(difference_of_states(plain, restored), "");
}

// So many points that advance_to takes regions.
TEST(Regions, are_taken_with_several_threads_and_many_points) {
  const auto motions = test::random_motions(200'000, 4500, 5, 4);
  Kinetic_delaunay plain(motions);
  Kinetic_delaunay kinetic(motions);
  kinetic.set_threads(2);
  const std::size_t events = plain.advance_to(2.0);
  EXPECT_GT(events, 400'000u);
  EXPECT_EQ(kinetic.advance_to(2.0), events);
  EXPECT_EQ(difference_of_states(plain, kinetic), "");
  EXPECT_NE(plain.counters().rechecks, kinetic.counters().rechecks);  // by regions there are others
}

// Two observers, of which one looks on: the plain loop, with the same events.
class Spectator : public Event_observer {
 public:
  explicit Spectator(const Kinetic_delaunay& kinetic) : kinetic_(kinetic) {}
  void after_event(const Event& event) override {
    are_there = are_there && kinetic_.current_time() == event.time;
  }
  bool are_there = true;

 private:
  const Kinetic_delaunay& kinetic_;
};

TEST(Regions, leave_a_run_to_the_loop_where_somebody_looks_on) {
  Kinetic_delaunay kinetic(test::random_motions(200, 100, 5, 1));
  Spectator spectator(kinetic);
  kinetic.add_observer(spectator);
  auto run = detail::region_run_of(kinetic, options_of(4, 0.5));
  EXPECT_GT(run.advance_to(0.5), 100u);
  EXPECT_EQ(run.counters().windows, 0u);
  EXPECT_TRUE(spectator.are_there);
}

}  // namespace
}  // namespace kinetri::regions_test
