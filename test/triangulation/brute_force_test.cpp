// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic triangulation of few points against the brute-force simulator, on random input and on
// input so coarse that most instants are degenerate.
#include <gtest/gtest.h>

#include "support/same_run.h"

namespace kinetri::brute_force_test {
namespace {

void expect_same_run(const std::vector<Linear_motion_2>& motions, const Algebraic_number& start) {
  ASSERT_EQ(test::difference_from_brute_force(motions, start), "") << test::describe(motions);
}

TEST(Brute_force, random_points_change_in_the_same_way) {
  for (unsigned seed = 0; seed < test::cases(7u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::size_t n = 3 + seed % 6;
    expect_same_run(test::random_motions(n, 10, 5, seed), Algebraic_number());
    if (HasFatalFailure()) return;
  }
}

TEST(Brute_force, random_points_from_an_irrational_start_change_in_the_same_way) {
  const Polynomial p{-2, 0, 1};
  const Algebraic_number start(p, Rational(1), Rational(2));
  for (unsigned seed = 100; seed < 110; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(test::random_motions(5, 10, 5, seed), start);
    if (HasFatalFailure()) return;
  }
}

TEST(Brute_force, a_triangle_that_turns_over_behind_a_hull_edge_that_is_only_touched_is_seen) {
  // The second point goes down through the line of the first and the third, as the third touches
  // that of the first and the fourth.
  for (const double side : {-1, 1}) {
    std::vector<Linear_motion_2> motions = {{{0, 0}, {0, 0}, 1},
                                            {{side * 1, 0}, {0, -1}, 1},
                                            {{side * 2, 0}, {0, 2}, 1},
                                            {{side * 4, 0}, {side * 2, 4}, 1},
                                            {{side * 1, 90}, {0, 0}, 1}};
    expect_same_run(motions, Algebraic_number());
    motions.push_back({{side * 3, 0}, {0, -1}, 1});
    expect_same_run(motions, Algebraic_number());
  }
}

// Places in a square of few integers, small integer velocities: simultaneous events, collinear
// hulls, points that pass through one another, everything on a line or in one place for an instant.
class Brute_force_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Brute_force_on_grids, degenerate_points_change_in_the_same_way) {
  const auto [points, size, speed] = GetParam();
  const unsigned cases = test::cases(points <= 4 ? 150u : points == 5 ? 60u : 15u);
  for (unsigned seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_run(test::grid_motions(static_cast<std::size_t>(points), size, speed, seed),
                    Algebraic_number());
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Brute_force_on_grids,
                         testing::Values(std::tuple(2, 3, 1), std::tuple(3, 2, 1),
                                         std::tuple(3, 4, 2), std::tuple(4, 2, 1),
                                         std::tuple(4, 3, 1), std::tuple(4, 5, 2),
                                         std::tuple(5, 3, 1), std::tuple(5, 4, 2),
                                         std::tuple(6, 3, 1), std::tuple(6, 5, 2),
                                         std::tuple(7, 3, 1), std::tuple(8, 4, 1)));

}  // namespace
}  // namespace kinetri::brute_force_test
