// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenarios: the numbers are pinned, so that they are the same on every platform, and have the
// properties that each scenario promises.
#include "kinetri/simulation/scenarios.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/base/error.h"
#include "support/precondition_error.h"

namespace kinetri::scenarios_test {
namespace {

using Motions = std::vector<Linear_motion_2>;

std::tuple<double, double, double, double> numbers(const Linear_motion_2& m) {
  return {m.position.x, m.position.y, m.velocity.x, m.velocity.y};
}

class Each_scenario : public testing::TestWithParam<Scenario> {
 protected:
  Motions make(std::size_t points, std::uint64_t seed = 1) const {
    return make_scenario(GetParam(), {.points = points, .seed = seed});
  }
};

TEST_P(Each_scenario, has_the_number_of_points_asked_for) {
  for (const std::size_t points : {0U, 1U, 2U, 3U, 4U, 5U, 99U, 100U, 101U}) {
    EXPECT_EQ(make(points).size(), points);
  }
}

TEST_P(Each_scenario, is_finite_and_starts_at_time_zero) {
  for (const Linear_motion_2& motion : make(500)) {
    EXPECT_TRUE(is_finite(motion));
    EXPECT_EQ(motion.epoch, 0);
  }
}

TEST_P(Each_scenario, has_no_trajectory_twice) {
  std::set<std::tuple<double, double, double, double>> seen;
  for (const Linear_motion_2& motion : make(2000)) seen.insert(numbers(motion));
  EXPECT_EQ(seen.size(), 2000U);
}

TEST_P(Each_scenario, depends_on_the_seed_only) {
  EXPECT_EQ(make(50, 7), make(50, 7));
  EXPECT_NE(make(50, 7), make(50, 8));
}

INSTANTIATE_TEST_SUITE_P(All, Each_scenario, testing::ValuesIn(all_scenarios),
                         [](const auto& parameter) {
                           std::string result(name(parameter.param));
                           std::replace(result.begin(), result.end(), '-', '_');
                           return result;
                         });

// The expected numbers come from a separate implementation, of the Mersenne Twister too, in Python.
TEST(Scenario, numbers_are_pinned) {
  const Motions uniform = make_scenario(Scenario::uniform, {.points = 100, .seed = 1});
  EXPECT_EQ(uniform[0].position, (Vector_2{0x1.ac67bf2ca6991p+3, 0x1.b480a4e9b6b82p+3}));
  EXPECT_EQ(uniform[99].velocity, (Vector_2{-0x1.7f3e97fb5dfc8p-3, -0x1.6fa9b4c1c37e0p+1}));
  const Motions gaussian = make_scenario(Scenario::gaussian, {.points = 100, .seed = 1});
  EXPECT_EQ(gaussian[99].position, (Vector_2{0x1.5f996337712d6p+6, 0x1.ed043ad4dc868p+3}));
  const Motions constant = make_scenario(Scenario::constant_speed, {.points = 100, .seed = 1});
  EXPECT_EQ(constant[99].velocity, (Vector_2{-0x1.2edf3126b8000p+2, -0x1.9d279dd2c9af8p+0}));
}

TEST(Uniform_scenario, fills_the_square_and_the_velocities) {
  const Motions motions =
      make_scenario(Scenario::uniform, {.points = 10'000, .seed = 2, .side = 8, .speed = 3});
  std::vector<int> cells(64);
  double fastest = 0;
  for (const Linear_motion_2& m : motions) {
    ASSERT_TRUE(m.position.x >= 0 && m.position.x < 8 && m.position.y >= 0 && m.position.y < 8);
    ++cells[static_cast<std::size_t>(m.position.x) * 8 + static_cast<std::size_t>(m.position.y)];
    fastest = std::max({fastest, std::abs(m.velocity.x), std::abs(m.velocity.y)});
  }
  EXPECT_LE(fastest, 3);
  EXPECT_GT(fastest, 2.99);
  // 156 are expected in each; the bounds are five standard deviations away.
  EXPECT_GT(*std::min_element(cells.begin(), cells.end()), 94);
  EXPECT_LT(*std::max_element(cells.begin(), cells.end()), 219);
}

TEST(Uniform_scenario, side_defaults_to_constant_density) {
  for (const Linear_motion_2& m : make_scenario(Scenario::uniform, {.points = 400, .seed = 3})) {
    EXPECT_LT(std::max(m.position.x, m.position.y), 200);
  }
}

TEST(Gaussian_scenario, has_the_moments_and_tails_of_the_normal_distribution) {
  const Motions motions =
      make_scenario(Scenario::gaussian, {.points = 100'000, .seed = 4, .side = 4});
  double sum = 0;
  double squares = 0;
  int beyond_one = 0;
  int beyond_three = 0;
  for (const Linear_motion_2& m : motions) {
    for (const double z : {m.position.x - 2, m.position.y - 2}) {
      sum += z;
      squares += z * z;
      beyond_one += std::abs(z) > 1 ? 1 : 0;
      beyond_three += std::abs(z) > 3 ? 1 : 0;
    }
  }
  // 200 000 standard normal numbers; bounds five standard deviations away.
  EXPECT_NEAR(sum / 200'000, 0, 0.0112);
  EXPECT_NEAR(squares / 200'000, 1, 0.0158);
  EXPECT_NEAR(beyond_one / 200'000.0, 0.317311, 0.0052);
  EXPECT_NEAR(beyond_three / 200'000.0, 0.0026998, 0.00058);
}

Rational squared_speed(const Linear_motion_2& m) {
  const Rational x = to_rational(m.velocity.x);
  const Rational y = to_rational(m.velocity.y);
  return x * x + y * y;
}

TEST(Constant_speed_scenario, speeds_are_exactly_equal) {
  for (const double speed : {5.0, 0.1, 1e-100, 1e100, 1.0 / 3}) {
    const Motions motions =
        make_scenario(Scenario::constant_speed, {.points = 300, .seed = 5, .speed = speed});
    std::set<std::pair<double, double>> directions;
    for (const Linear_motion_2& m : motions) {
      ASSERT_EQ(squared_speed(m), squared_speed(motions[0]));
      directions.emplace(m.velocity.x, m.velocity.y);
    }
    EXPECT_NEAR(std::hypot(motions[0].velocity.x, motions[0].velocity.y) / speed, 1, 1e-6);
    EXPECT_GT(directions.size(), 280U);
  }
}

TEST(Constant_speed_scenario, speed_zero_rests) {
  for (const auto& m : make_scenario(Scenario::constant_speed, {.points = 9, .speed = 0})) {
    EXPECT_EQ(m.velocity, Vector_2{});
  }
}

TEST(One_mover_scenario, only_the_first_point_moves) {
  const Motions motions = make_scenario(Scenario::one_mover, {.points = 50, .seed = 6});
  EXPECT_NE(motions[0].velocity, Vector_2{});
  for (std::size_t i = 1; i < motions.size(); ++i) EXPECT_EQ(motions[i].velocity, Vector_2{});
}

TEST(Lattice_scenario, places_are_the_multiples_of_the_spacing_row_by_row) {
  for (const std::size_t points : {1U, 9U, 10U, 11U, 12U, 13U, 16U}) {
    const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(points)));
    const Motions motions = make_scenario(Scenario::lattice, {.points = points, .spacing = 3});
    for (std::size_t i = 0; i < points; ++i) {
      EXPECT_EQ(motions[i].position, (Vector_2{3.0 * static_cast<double>(i % width),
                                               3.0 * static_cast<double>(i / width)}));
    }
  }
}

TEST(Lattice_scenario, all_velocities_are_whole_numbers_up_to_the_speed) {
  std::set<double> seen;
  for (const auto& m : make_scenario(Scenario::lattice, {.points = 900, .speed = 2.9})) {
    seen.insert({m.velocity.x, m.velocity.y});
  }
  EXPECT_EQ(seen, (std::set<double>{-2, -1, 0, 1, 2}));
}

TEST(Lattice_scenario, movers_are_the_ones_asked_for) {
  for (const std::size_t points : {1U, 2U, 3U, 5U, 9U, 10U, 100U}) {
    const auto movers = [&](Lattice_movers which) {
      const Motions motions =
          make_scenario(Scenario::lattice, {.points = points, .seed = points, .movers = which});
      return std::count_if(motions.begin(), motions.end(),
                           [](const auto& m) { return m.velocity != Vector_2{}; });
    };
    EXPECT_EQ(movers(Lattice_movers::none), 0);
    EXPECT_EQ(movers(Lattice_movers::one), 1);
  }
  const Motions columns =
      make_scenario(Scenario::lattice, {.points = 9, .movers = Lattice_movers::columns});
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(columns[i].velocity, (Vector_2{0, i % 3 == 1 ? 5.0 : 0.0}));
  }
}

TEST(Lattice_jitter_scenario, offsets_are_small_and_random) {
  const Scenario_options options = {.points = 400, .seed = 9, .spacing = 2, .jitter = 0.25};
  const Motions motions = make_scenario(Scenario::lattice_jitter, options);
  std::set<double> offsets;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double x = motions[i].position.x - 2.0 * static_cast<double>(i % 20);
    const double y = motions[i].position.y - 2.0 * static_cast<double>(i / 20);
    EXPECT_LE(std::max(std::abs(x), std::abs(y)), 0.25);
    offsets.insert({x, y});
  }
  EXPECT_GT(offsets.size(), 700U);
}

TEST(Scenario, options_out_of_range_throw) {
  const auto rejects = [](Scenario scenario, const Scenario_options& options, const char* message) {
    EXPECT_PRECONDITION_ERROR(make_scenario(scenario, options), message);
  };
  const char* const bad_side = "the side is out of range; expected a number from 1e-100 to 1e100";
  const char* const bad_spacing =
      "the spacing is out of range; expected a number from 1e-100 to 1e100";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, nan, infinity, 1e101, 1e-101}) {
    rejects(Scenario::uniform, {.side = bad}, bad_side);
    rejects(Scenario::uniform, {.speed = bad},
            "the speed is out of range; expected 0, or a number from 1e-100 to 1e100");
    rejects(Scenario::lattice, {.spacing = bad}, bad_spacing);
    rejects(Scenario::lattice_jitter, {.jitter = bad},
            "the jitter is out of range; expected 0, or a number from 1e-100 to 1e100");
  }
  rejects(Scenario::uniform, {.side = 0}, bad_side);
  rejects(Scenario::lattice, {.spacing = 0}, bad_spacing);
  for (const double bad : {0.5, 1e16}) {
    rejects(Scenario::lattice, {.speed = bad},
            "the speed of a moving lattice is out of range; expected a number from 1 to 2^53");
  }
  rejects(Scenario::uniform, {.points = std::size_t{1} << 32U},
          "a scenario of too many points; expected fewer than 2^32 - 1");
  rejects(static_cast<Scenario>(6), {}, "no such scenario; expected one of all_scenarios");
  EXPECT_NO_THROW(make_scenario(Scenario::lattice, {.speed = 0, .movers = Lattice_movers::none}));
}

TEST(Scenario, names_are_fixed) {
  std::vector<std::string> names;
  for (const Scenario scenario : all_scenarios) names.emplace_back(name(scenario));
  EXPECT_EQ(names, (std::vector<std::string>{"uniform", "gaussian", "constant-speed", "one-mover",
                                             "lattice", "lattice-jitter"}));
  names.clear();
  for (const Lattice_movers movers : all_lattice_movers) names.emplace_back(name(movers));
  EXPECT_EQ(names, (std::vector<std::string>{"none", "one", "columns", "all"}));
}

}  // namespace
}  // namespace kinetri::scenarios_test
