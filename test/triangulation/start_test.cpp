// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangulation at the start is that of the exact places, where that of the rounded ones is
// another one: for points a few units in the last place away from degenerate ones.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "kinetri/algebra/real_roots.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::start_test {
namespace {

using test::Kinetic_delaunay;

/// Points of a lattice, each a few units in the last place away, at the time 0 or at `epoch`.
std::vector<Linear_motion_2> near_lattice(int side, double epoch, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> ulps(-2, 2);
  std::uniform_real_distribution<double> component(-1, 1);
  std::vector<Linear_motion_2> result;
  for (int i = 0; i < side * side; ++i) {
    const auto place = [&](int at) {
      double x = 1 + at;
      const int steps = ulps(random);
      for (int k = 0; k < std::abs(steps); ++k) x = std::nextafter(x, steps < 0 ? 0 : 100);
      return x;
    };
    const double x = place(i % side);
    const double y = place(i / side);
    const double vx = component(random);
    const double vy = component(random);
    // Back to the epoch: the place at time 0 is that of the lattice up to rounding.
    result.push_back({{x + vx * epoch, y + vy * epoch}, {vx, vy}, epoch});
  }
  return result;
}

class Start : public testing::TestWithParam<double> {};

TEST_P(Start, of_points_near_a_lattice_is_delaunay) {
  for (unsigned seed = 1; seed <= test::cases(7u); ++seed) {
    for (const int side : {4, 5, 9}) {
      const Kinetic_delaunay kinetic(near_lattice(side, GetParam(), seed), Algebraic_number(0.0));
      ASSERT_EQ(test::audit_problem(kinetic, Audit_level::reference), "")
          << "seed " << seed << ", " << side << " a side";
    }
  }
}

TEST_P(Start, of_points_near_a_lattice_at_an_irrational_time_is_delaunay) {
  const Polynomial two({-2, 0, 1});
  const Algebraic_number start = first_root_after(two, Algebraic_number(0.0))->value;
  for (unsigned seed = 1; seed <= test::cases(5u); ++seed) {
    const Kinetic_delaunay kinetic(near_lattice(5, GetParam() + std::sqrt(2.0), seed), start);
    ASSERT_EQ(test::audit_problem(kinetic, Audit_level::reference), "") << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Epochs, Start, testing::Values(0.0, 1.0 / 3, 1e6 / 3, 1e12 / 3, 1e17 / 3));

// Of all faces, in CGAL's order.
std::vector<std::array<Point_id, 3>> corners(const Kinetic_delaunay& kinetic) {
  std::vector<std::array<Point_id, 3>> result;
  for (const auto face : kinetic.triangulation().all_face_handles()) {
    const auto id = [&](int i) { return face->vertex(i)->point().id(); };
    result.push_back({id(0), id(1), id(2)});
  }
  return result;
}

// The blocks of memory that faces are in come in any order of addresses: here in some orders.
TEST(Start_of_equal_points, has_equal_faces_wherever_they_are_in_memory) {
  const auto motions = test::grid_motions(54, 33, 3, 349);
  std::vector<std::unique_ptr<char[]>> between;
  for (std::size_t k = 1; k <= 40; ++k) {
    const Kinetic_delaunay one(motions);
    between.push_back(std::make_unique<char[]>(37 * k % 5000 + 1));
    const Kinetic_delaunay other(motions);
    ASSERT_EQ(corners(one), corners(other)) << "run " << k;
  }
}

TEST(Start_of_close_points, with_equal_rounded_places_is_delaunay) {
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 40; ++i) {
    // At time 0 all pairs are a hundredth of a unit in the last place apart.
    const double x = 1 + i % 8;
    const double y = 1 + i / 8 + (i * i % 11) / 16.0;
    motions.push_back({{x, y}, {0, 0}, 0});
    motions.push_back({{x + 1e6, y}, {1, 1e-25}, 1e6});
  }
  const Kinetic_delaunay kinetic(motions, Algebraic_number(0.0));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "");
}

}  // namespace
}  // namespace kinetri::start_test
