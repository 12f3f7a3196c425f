// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation of points in polynomial motion, of all degrees up to 3 in one run:
// against the brute-force simulator, against audits, with and without filters, and against the
// triangulation of linear motion where the points are linear.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/kinetic_runs.h"
#include "support/same_run.h"

namespace kinetri::polynomial_motion_test {
namespace {

using Polynomial_delaunay = Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2>;

void expect_same_run(const std::vector<Polynomial_motion_2>& motions) {
  ASSERT_EQ(test::difference_from_brute_force(motions), "") << test::describe(motions);
}

TEST(Polynomial_motion, random_points_change_in_the_same_way_as_by_brute_force) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(test::random_polynomial_motions(3 + seed % 4, 10, 5, seed));
    if (HasFatalFailure()) return;
  }
}

// Points, size of the grid, greatest derivative, degree.
class Polynomial_motion_on_grids : public testing::TestWithParam<std::tuple<int, int, int, int>> {};

TEST_P(Polynomial_motion_on_grids, changes_in_the_same_way_as_by_brute_force) {
  const auto [points, size, speed, degree] = GetParam();
  const unsigned cases = test::cases(points <= 4 ? 30u : 6u);
  for (unsigned seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(
        test::polynomial_grid_motions(static_cast<std::size_t>(points), size, speed, degree, seed));
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Polynomial_motion_on_grids,
                         testing::Values(std::tuple(2, 3, 1, 3), std::tuple(3, 2, 1, 2),
                                         std::tuple(3, 3, 2, 3), std::tuple(4, 2, 1, 2),
                                         std::tuple(4, 2, 1, 3), std::tuple(4, 4, 2, 3),
                                         std::tuple(5, 3, 1, 2), std::tuple(5, 3, 1, 3),
                                         std::tuple(6, 3, 1, 3)));

TEST(Polynomial_motion, passes_audits_at_every_instant) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Polynomial_delaunay small(test::random_polynomial_motions(30, 30, 5, seed));
    EXPECT_EQ(test::audited_run(small, Algebraic_number(2.5), Audit_level::reference), "");
    EXPECT_GT(small.counters().number_of_events(), 60u);
    Polynomial_delaunay kinetic(test::random_polynomial_motions(60, 60, 5, seed));
    kinetic.advance_to(4.0);
    EXPECT_GT(kinetic.counters().number_of_events(), 200u);
    const Certificate_counters& certificates = kinetic.certificate_counters();
    EXPECT_LT(certificates.exact_decided * 1000, certificates.created);
  }
}

// The events of a run to `until`.
template <class Kinetic>
std::vector<test::Kinetic_event> events_of(Kinetic& kinetic, double until) {
  test::Event_recorder recorder(kinetic);
  kinetic.advance_to(until);
  kinetic.remove_observer(recorder);
  return recorder.events;
}

TEST(Polynomial_motion, has_the_same_events_without_filters) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = seed % 2 == 0 ? test::random_polynomial_motions(30, 30, 5, seed)
                                       : test::polynomial_grid_motions(12, 5, 1, 3, seed);
    Polynomial_delaunay filtered(motions);
    Polynomial_delaunay exact(motions, Algebraic_number(), Polynomial_kinetic_traits_2::exact());
    EXPECT_EQ(test::difference(events_of(filtered, 3), events_of(exact, 3)), "");
    EXPECT_EQ(filtered.finite_edge_ids(), exact.finite_edge_ids());
    EXPECT_EQ(exact.certificate_counters().filter_decided, 0u);
  }
}

TEST(Polynomial_motion, of_linear_points_has_the_events_of_linear_motion) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto lines = seed % 2 == 0 ? test::random_motions(100, 100, 5, seed)
                                     : test::grid_motions(20, 5, 1, seed);
    std::vector<Polynomial_motion_2> motions;
    for (const Linear_motion_2& line : lines) motions.push_back(polynomial_motion(line));
    test::Kinetic_delaunay linear(lines);
    Polynomial_delaunay polynomial(motions);
    EXPECT_EQ(test::difference(events_of(linear, 4), events_of(polynomial, 4)), "");
    EXPECT_EQ(linear.finite_edge_ids(), polynomial.finite_edge_ids());
  }
}

// A point at (x, y) + (0, c) t^power / power!.
Polynomial_motion_2 moving(double x, double y, double c, int power) {
  Polynomial_motion_2 m;
  m.position = {x, y};
  if (power == 1) m.velocity.y = c;
  if (power == 2) m.acceleration.y = c;
  if (power == 3) m.jerk.y = c;
  return m;
}

// Beyond the hull edge between (0, 0) and (4, 0), to and fro: at time 1 (from -1 on) the points of
// the row are on it.
class Touching_hull : public testing::Test {
 protected:
  void expect_audited_run() {
    for (const bool is_mirrored : {false, true}) {
      std::vector<Polynomial_motion_2> motions = {moving(0, 0, 0, 0), moving(4, 0, 0, 0),
                                                  moving(2, 9, 0, 0)};
      for (const Polynomial_motion_2& m : row) {
        motions.push_back(m);
        if (is_mirrored) motions.back().position.x = 4 - m.position.x;
      }
      SCOPED_TRACE(test::describe(motions));
      Polynomial_delaunay kinetic(motions, Algebraic_number(-1.0));
      EXPECT_EQ(test::audited_run(kinetic, Algebraic_number(1.0), Audit_level::reference), "");
      expect_same_run(motions);
      counters = kinetic.counters();
    }
  }
  std::uint64_t count(Event_kind kind) const {
    return counters.events[static_cast<std::size_t>(kind)];
  }

  std::vector<Polynomial_motion_2> row;
  Triangulation_counters counters;
};

TEST_F(Touching_hull, by_one_point_is_no_event) {
  row = {moving(2, 0, 1, 2)};
  expect_audited_run();
  EXPECT_EQ(counters.number_of_events(), 0u);
  EXPECT_EQ(counters.reconstructions, 0u);
}

TEST_F(Touching_hull, with_an_odd_order_of_three_is_an_insertion_or_removal) {
  row = {moving(2, 0, -1, 3)};
  expect_audited_run();
  EXPECT_EQ(count(Event_kind::hull_insert), 1u);
  row = {moving(2, 0, 1, 3)};
  expect_audited_run();
  EXPECT_EQ(count(Event_kind::hull_remove), 1u);
}

// Inner triangles that turn over behind hull triangles that do or do not, with all orders.
TEST_F(Touching_hull, with_others_behind_is_followed) {
  for (const int first : {1, 2, 3}) {
    for (const int second : {1, 2, 3}) {
      for (const int third : {1, 2, 3}) {
        for (const double sign : {-1, 1}) {
          row = {moving(1, 0, sign, first), moving(2, 0, 1, second), moving(3, 0, -sign, third)};
          expect_audited_run();
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(Polynomial_motion, of_points_that_meet_irrationally_is_followed) {
  // Both at x = 2 - t^2 / 2 and at 0 at sqrt(2) ... where t^2 = 2: from left and from right.
  const std::vector<Polynomial_motion_2> motions = {{{1, 0}, {0, 0}, {-1, 0}, {0, 0}, 0},
                                                    {{-1, 0}, {0, 0}, {1, 0}, {0, 0}, 0},
                                                    {{0.25, 5}, {0, 0}, {0, 0}, {0, 0}, 0},
                                                    {{0, -5}, {0, 1}, {0, 0}, {0, 0}, 0},
                                                    {{7, 1}, {0, 0}, {0, 0}, {0, 1}, 0}};
  Polynomial_delaunay kinetic(motions);
  EXPECT_EQ(test::audited_run(kinetic, Algebraic_number(5.0), Audit_level::reference), "");
  expect_same_run(motions);
}

TEST(Polynomial_motion, of_points_that_come_turn_and_go_is_followed) {
  std::mt19937_64 random(12);
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto motions = seed % 2 == 0 ? test::random_polynomial_motions(80, 20, 3, seed)
                                       : test::polynomial_grid_motions(80, 5, 1, 3, seed);
    Polynomial_delaunay kinetic(std::vector(motions.begin(), motions.begin() + 20));
    for (std::size_t i = 20; i < motions.size(); ++i) {
      kinetic.advance_to(Algebraic_number(0.05 * static_cast<double>(i - 20)));
      const auto id = static_cast<Point_id>(random() % kinetic.next_id());
      if (!kinetic.contains(id) || random() % 3 == 0) {
        kinetic.insert(motions[i]);
      } else if (random() % 2 == 0) {
        kinetic.set_motion(id, motions[i]);
      } else {
        kinetic.erase(id);
      }
      const auto level = i % 4 == 0 ? Audit_level::reference : Audit_level::delaunay;
      ASSERT_EQ(test::audit_problem(kinetic, level), "") << i;
    }
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  }
}

}  // namespace
}  // namespace kinetri::polynomial_motion_test
