// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is done by several threads. These tests are a program of their own, which is what runs with
// ThreadSanitizer: scripts/test.sh --preset tsan.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <concepts>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/motions.h"
#include "triangulation/regions.h"

namespace kinetri::triangulation_threads_test {
namespace {

// The result of `make` where oneTBB has `count` threads, on any number of processors.
template <class Make>
auto with_threads(int count, Make make) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(count));
  return tbb::task_arena(count).execute(make);
}

template <class Kinetic>
void expect_same(Kinetic& one, Kinetic& other) {
  EXPECT_EQ(one.certificate_counters(), other.certificate_counters());
  EXPECT_EQ(one.queue_counters(), other.queue_counters());
  EXPECT_EQ(one.next_event_time(), other.next_event_time());
  EXPECT_EQ(one.finite_edge_ids(), other.finite_edge_ids());
}

template <class Traits>
using Kinetic_pair = std::array<std::unique_ptr<Kinetic_delaunay_triangulation_2<Traits>>, 2>;

// Nobody has refined a time yet that is given.
template <class Given>
const Given& unrefined(const Given& given) {
  return given;
}
Algebraic_number unrefined(const Algebraic_number& time) {
  return time.detached();
}

// The triangulation of `given`, motions or a snapshot, made by one thread and by `count`, which
// must be the same. (Edges are handed out by the thousand: there must be more.)
template <class Traits, class... Given>
Kinetic_pair<Traits> made_by_one_and_by(int count, const Given&... given) {
  using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
  const auto make = [&] {
    if constexpr (std::constructible_from<Kinetic, Given...>) {
      return std::make_unique<Kinetic>(unrefined(given)...);
    } else {
      return std::unique_ptr<Kinetic>(new Kinetic(Kinetic::restore(given...)));
    }
  };
  Kinetic_pair<Traits> made = {with_threads(1, make), with_threads(count, make)};
  EXPECT_GT(made[0]->finite_edge_ids().size(), 4096u);
  EXPECT_GT(made[0]->certificate_counters().created, 4096u);
  expect_same(*made[0], *made[1]);
  return made;
}

// Both go on until `until`.
template <class Traits>
void expect_same_future(const Kinetic_pair<Traits>& pair, double until) {
  for (const auto& kinetic : pair) kinetic->advance_to(until);
  EXPECT_GT(pair[0]->counters().number_of_events(), 0u);
  expect_same(*pair[0], *pair[1]);
}

const Algebraic_number& square_root_of_two() {
  static const Algebraic_number number(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  return number;
}

// So many edges that the threads are given some twice.
TEST(Threads, start_a_triangulation_as_one_does) {
  const auto pair = made_by_one_and_by<Linear_kinetic_traits_2>(
      2, test::random_motions(5600, 740, 5, 8), square_root_of_two());
  expect_same_future<Linear_kinetic_traits_2>(pair, 1.45);
}

TEST(Threads, restore_a_triangulation_as_one_does) {
  const Kinetic_delaunay_triangulation_2<> original(test::random_motions(1500, 400, 5, 7),
                                                    square_root_of_two());
  const auto pair = made_by_one_and_by<Linear_kinetic_traits_2>(4, original.snapshot());
  expect_same_future<Linear_kinetic_traits_2>(pair, 1.45);
}

// Exact numbers are made by every thread, and refined at a time that all threads ask for.
TEST(Threads, start_an_exact_triangulation_as_one_does) {
  made_by_one_and_by<Linear_kinetic_traits_2>(4, test::random_motions(1450, 400, 5, 9),
                                              square_root_of_two(),
                                              Linear_kinetic_traits_2::exact());
}

TEST(Threads, start_a_triangulation_of_accelerated_points_as_one_does) {
  const auto pair = made_by_one_and_by<Polynomial_kinetic_traits_2>(
      4, test::random_polynomial_motions(1500, 400, 5, 10), square_root_of_two());
  expect_same_future<Polynomial_kinetic_traits_2>(pair, 1.45);
}

// The filter decides little where everything is cocircular.
TEST(Threads, start_a_triangulation_of_a_lattice_as_one_does) {
  std::vector<Linear_motion_2> motions;
  for (int x = 0; x < 38; ++x) {
    for (int y = 0; y < 38; ++y) {
      motions.push_back({{double(x), double(y)}, {double(x % 3 == 0), double(y % 5 == 0)}, 0});
    }
  }
  made_by_one_and_by<Linear_kinetic_traits_2>(4, motions);
}

// Regions beside one another, whose failures the filter decides or not.
TEST(Threads, run_by_regions_as_the_loop_does) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    using Kinetic = Kinetic_delaunay_triangulation_2<>;
    const auto motions = seed % 2 == 0 ? test::random_motions(1500, 400, 5, seed)
                                       : test::grid_motions(700, 300, 7, seed);
    Kinetic plain(motions);
    Kinetic kinetic(motions);
    detail::Region_options options;
    options.regions = 6 + 5 * seed;
    options.least_events_per_vertex = 0;
    options.most_waste = std::numeric_limits<double>::infinity();
    options.threads = 4;
    auto run = detail::region_run_of(kinetic, options);
    for (const double time : {0.5, 2.0}) {
      EXPECT_EQ(plain.advance_to(time), run.advance_to(time));
      EXPECT_EQ(plain.finite_edge_ids(), kinetic.finite_edge_ids());
      EXPECT_EQ(plain.next_event_time(), kinetic.next_event_time());
    }
    EXPECT_GT(run.counters().by_region, 0u) << "seed " << seed;
  }
}

// What a const function makes when it needs it, it makes for itself: several threads ask one
// object.
TEST(Threads, ask_const_functions_of_one_triangulation) {
  Kinetic_delaunay_triangulation_2<> kinetic(test::random_motions(60, 40, 5, 12));
  kinetic.step();
  const Kinetic_delaunay_triangulation_2<>& shared = kinetic;
  std::vector<std::thread> threads;
  std::array<std::string, 4> answers;
  for (std::string& answer : answers) {
    threads.emplace_back([&answer, &shared] {
      const Algebraic_number soon = shared.current_time().to_double() + 0.25;
      answer = std::to_string(shared.has_event_before(soon)) +
               std::to_string(shared.audit(Audit_level::certificates).passed()) +
               std::to_string(shared.is_valid()) + std::to_string(shared.finite_edge_ids().size()) +
               std::to_string(shared.snapshot().motions.size()) +
               std::to_string(shared.current_time() < soon);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(answers[0], "");
  for (const std::string& answer : answers) EXPECT_EQ(answer, answers[0]);
}

// Two triangulations have nothing in common.
TEST(Threads, run_a_triangulation_each) {
  const auto motions = test::random_motions(100, 100, 5, 11);
  Kinetic_delaunay_triangulation_2<> expected(motions);
  expected.advance_to(2.0);
  EXPECT_GT(expected.counters().number_of_events(), 100u);
  std::vector<std::vector<Edge_ids>> edges(2);
  {
    std::vector<std::jthread> threads;
    for (auto& result : edges) {
      threads.emplace_back([&motions, &result] {
        Kinetic_delaunay_triangulation_2<> kinetic(motions);
        kinetic.advance_to(2.0);
        result = kinetic.finite_edge_ids();
      });
    }
  }
  EXPECT_EQ(edges[0], expected.finite_edge_ids());
  EXPECT_EQ(edges[1], expected.finite_edge_ids());
}

}  // namespace
}  // namespace kinetri::triangulation_threads_test
