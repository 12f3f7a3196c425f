// SPDX-License-Identifier: GPL-3.0-or-later
//
// Encounters in periodic boxes, compared with the quadratics of all pairs of images.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "kinetri/observers/encounters.h"
#include "observers/random_runs.h"
#include "support/observed_periodic_run.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_encounters_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_delaunay_triangulation_2<Traits>;
using test::Periodic_run;

Kinetic in_square(double side, const std::vector<Linear_motion_2>& motions) {
  const Periodic_box_2 box({{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0});
  return Kinetic(motions, Algebraic_number(), Traits(box));
}

// ---- by hand ----

TEST(Periodic_encounters, are_those_of_images) {
  // Around the box: they meet across its border.
  Kinetic kinetic = in_square(10, {{{9, 5}, {1, 0}, 0}, {{4, 5}, {0, 0}, 0}});
  Encounters encounters(kinetic, 1);
  kinetic.advance_to(9.0);
  const auto found = encounters.encounters();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].points, (Edge_ids{0, 1}));
  EXPECT_EQ(found[0].offset, (Lattice_offset_2{1, 0}));
  EXPECT_EQ(found[0].begin, Algebraic_number(4.0));
  EXPECT_EQ(found[0].end, Algebraic_number(6.0));
  EXPECT_EQ(found[0].closest, Algebraic_number(5.0));
  EXPECT_EQ(found[0].distance, 0);
}

TEST(Periodic_encounters, of_a_point_with_itself_are_those_of_its_images) {
  // The lattice shrinks from 4 to 1 along x.
  const Periodic_box_2 box({{4, 0}, {-1, 0}, 0}, {{0, 4}, {0, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 1}, 0}}, Algebraic_number(),
                  Traits(box));
  Encounters encounters(kinetic, 3);
  kinetic.advance_to(3.0);
  const auto found = encounters.encounters();
  // The images (1, 0) from time 1 on, (2, 0) from 5/2 on, (3, 0) at 3.
  ASSERT_EQ(found.size(), 3U);
  for (int k = 1; k <= 3; ++k) {
    const Encounter& encounter = found[static_cast<std::size_t>(k - 1)];
    EXPECT_EQ(encounter.points, (Edge_ids{0, 0}));
    EXPECT_EQ(encounter.offset, (Lattice_offset_2{k, 0}));
    EXPECT_EQ(encounter.begin, Algebraic_number(4 - 3.0 / k));
    EXPECT_EQ(encounter.end, Algebraic_number(3.0));
    EXPECT_EQ(encounter.distance, k);
  }
}

TEST(Periodic_encounters, refuse_what_is_no_range) {
  Kinetic kinetic = in_square(10, {{{9, 5}, {1, 0}, 0}});
  EXPECT_PRECONDITION_ERROR(Encounters(kinetic, -1), "the range must be a number of at least 0");
}

// ---- all pairs of images ----

std::vector<Encounter> expected(const Periodic_run& run, double range, double radius = 0) {
  std::vector<Encounter> result;
  run.for_each_pair(range + 2 * radius,
                    [&](const Periodic_edge& pair, const auto& p, const auto& q) {
                      test::add_encounters(p, q, pair, radius, range, false, result);
                    });
  test::sort_encounters(result);
  return result;
}

constexpr std::array<double, 5> ranges = {0, 1, 2, 1.5, 3};

TEST(Periodic_encounters, are_those_of_all_pairs_of_images) {
  std::size_t number = 0;
  std::size_t own = 0;
  std::size_t touches = 0;
  std::size_t several = 0;
  for (unsigned seed = 0; seed < test::cases(120u); ++seed) {
    Periodic_run run(seed);
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed) + ", range " +
                 std::to_string(range));
    Encounters encounters(run.kinetic(), range);
    run.kinetic().advance_to(1.0);
    if (seed % 2 == 0) static_cast<void>(encounters.encounters());
    run.kinetic().advance_to(Periodic_run::end);
    const auto found = encounters.encounters();
    test::expect_equal(found, expected(run, range));
    if (testing::Test::HasFailure()) return;
    number += found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      own += found[i].points[0] == found[i].points[1];
      touches += found[i].begin == found[i].end;
      several += i > 0 && found[i].points == found[i - 1].points;
    }
  }
  EXPECT_GT(number, 1500U);
  EXPECT_GT(own, 80U);
  EXPECT_GT(touches, 25U);
  EXPECT_GT(several, 250U);
}

// A radius that is no short binary64 number: its sums with the range are rounded.
TEST(Periodic_encounters, of_discs_of_one_radius_are_those_of_all_pairs_of_images) {
  std::size_t number = 0;
  std::size_t overlaps = 0;
  for (unsigned seed = 0; seed < test::cases(30u); ++seed) {
    Periodic_run run(seed);
    const double range = ranges[seed % ranges.size()];
    const double radius = seed % 2 == 0 ? 0.5 : 0.1;
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed) + ", range " +
                 std::to_string(range));
    std::vector<Linear_motion_2> motions;
    for (Point_id id = 0; id < run.kinetic().next_id(); ++id) {
      motions.push_back(run.kinetic().motion(id));
    }
    Simulation_options options;
    options.radius = radius;
    Simulation_2<Traits> simulation(motions, options, 0, Traits(run.box()));
    Encounters encounters(simulation, range);
    simulation.advance_to(2.0);
    run.kinetic().advance_to(2.0);
    const auto found = encounters.encounters();
    test::expect_equal(found, expected(run, range, radius));
    if (testing::Test::HasFailure()) return;
    number += found.size();
    overlaps += static_cast<std::size_t>(
        std::ranges::count_if(found, [](const Encounter& e) { return e.gap < 0; }));
  }
  EXPECT_GT(number, 500U);
  EXPECT_GT(overlaps, 50U);
}

// Points that turn, jump, come, go, and coincide with images of others for a while.
TEST(Periodic_encounters, of_points_that_change_are_those_of_all_pairs_of_images) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(30u); ++seed) {
    Periodic_run run(seed);
    const double range = ranges[seed % ranges.size()];
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + Periodic_run::name(seed) + ", range " +
                 std::to_string(range));
    Encounters encounters(run.kinetic(), range);
    while (run.kinetic().current_time() < Algebraic_number(Periodic_run::end)) {
      const int changes = run.integer(0, 3);
      for (int i = 0; i < changes; ++i) run.change();
      hidden += run.kinetic().number_of_hidden_points();
      run.kinetic().advance_to(run.kinetic().current_time().to_double() + 0.5);
      if (run.integer(0, 3) == 0) static_cast<void>(encounters.encounters());
    }
    test::expect_equal(encounters.encounters(), expected(run, range));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hidden, 12U);
}

// ---- cost ----

// Each pair in range, and each edge, is certified about once; so the border costs nothing.
TEST(Periodic_encounters, ask_for_few_certificates) {
  std::vector<double> costs;
  for (const std::size_t n : {200U, 800U}) {
    const double side = 10 * std::sqrt(double(n));
    Kinetic kinetic = in_square(side, test::random_motions(n, side, 5, 1));
    Encounters encounters(kinetic, 12.6);  // about 5 points in range
    const std::size_t events = kinetic.advance_to(1.0);
    const std::size_t number = encounters.encounters().size();
    EXPECT_GT(number, 2 * n);
    costs.push_back(double(encounters.certificate_counters().created) / double(events + number));
  }
  for (const double cost : costs) EXPECT_LT(cost, 4) << "certificates for an event or encounter";
}

}  // namespace
}  // namespace kinetri::periodic_encounters_test
