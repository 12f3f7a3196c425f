// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/coincident_runs.h"

#include <gtest/gtest.h>

#include "support/multiplier.h"
#include "support/random_choices.h"

namespace kinetri::coincident_points_test {
namespace {

template <class Kinetic>
void check_runs() {
  std::size_t twins = 0;
  std::size_t compared = 0;
  const unsigned runs = test::cases(200u);
  for (unsigned seed = 0; seed < runs; ++seed) {
    test::Random_choices random(seed);
    test::Coincident_run<Kinetic, test::Random_choices> run(random);
    ASSERT_EQ(run.problem(12), "") << "seed " << seed;
    twins += run.twins_seen();
    compared += run.compared();
  }
  EXPECT_GT(twins, 10 * runs);
  EXPECT_GT(compared, runs);
}

TEST(Coincident_points, of_the_delaunay_triangulation_are_hidden_by_the_least) {
  check_runs<test::Kinetic_delaunay>();
}

TEST(Coincident_points, of_the_regular_triangulation_are_hidden_by_the_least) {
  check_runs<Kinetic_regular_triangulation_2<>>();
}

}  // namespace
}  // namespace kinetri::coincident_points_test
