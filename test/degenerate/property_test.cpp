// SPDX-License-Identifier: GPL-3.0-or-later
//
// Properties of random points on grids so small that most instants are degenerate. A failure is
// shrunk to few points and small numbers, and shown as a points file.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <set>
#include <sstream>

#include "support/kinetic_runs.h"
#include "support/same_run.h"
#include "support/transformed_run.h"

namespace kinetri::property_test {
namespace {

using test::Kinetic_delaunay;
using test::Transformation;

// Place and velocity of a point.
using Grid_point = std::array<int, 4>;

rc::Gen<int> integer_in(int low, int high) {
  // rapidcheck's ranges grow with the size; these do not.
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

// Up to `most` points (half of the time that many) with places in a square of `size` integers and
// velocity components of at most `speed`.
rc::Gen<std::vector<Grid_point>> grid_points(int most, int size, int speed) {
  const auto place = integer_in(0, size - 1);
  const auto velocity = integer_in(-speed, speed);
  const auto point = rc::gen::map(
      rc::gen::tuple(place, place, velocity, velocity),
      [](const std::tuple<int, int, int, int>& t) {
        return Grid_point{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t)};
      });
  return rc::gen::map(rc::gen::resize(2 * most, rc::gen::container<std::vector<Grid_point>>(point)),
                      [most](std::vector<Grid_point> points) {
                        if (points.size() > static_cast<std::size_t>(most)) {
                          points.resize(static_cast<std::size_t>(most));
                        }
                        return points;
                      });
}

Linear_motion_2 motion(const Grid_point& p) {
  return {{double(p[0]), double(p[1])}, {double(p[2]), double(p[3])}, 0};
}

// The motions of the points, each trajectory once.
std::vector<Linear_motion_2> distinct_motions(const std::vector<Grid_point>& points) {
  std::set<Grid_point> seen;
  std::vector<Linear_motion_2> motions;
  for (const Grid_point& p : points) {
    if (seen.insert(p).second) motions.push_back(motion(p));
  }
  return motions;
}

// Checks the property, which draws what it needs, for `cases` of them.
template <class Property>
void expect_for_all(int cases, Property property) {
  rc::detail::TestParams parameters;
  parameters.seed = 20240229;
  parameters.maxSuccess = test::cases(cases);
  rc::detail::TestMetadata metadata;
  metadata.id = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto result = rc::detail::checkTestable(property, metadata, parameters);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  FAIL() << text.str();
}

void expect_none(const std::string& problem, const std::vector<Linear_motion_2>& motions) {
  if (!problem.empty()) RC_FAIL(problem + "\n" + test::describe(motions));
}

struct Grid {
  int points;
  int size;
  int speed;
  int cases;

  friend std::ostream& operator<<(std::ostream& out, const Grid& grid) {
    return out << grid.cases << " cases";
  }
};

class Grid_properties : public testing::TestWithParam<Grid> {};

TEST_P(Grid_properties, equals_brute_force_from_every_start) {
  const Grid& grid = GetParam();
  expect_for_all(grid.cases, [&grid] {
    const auto motions = distinct_motions(*grid_points(grid.points, grid.size, grid.speed));
    const Algebraic_number start(Rational(*integer_in(-4, 4), 2));
    expect_none(test::difference_from_brute_force(motions, start), motions);
  });
}

TEST_P(Grid_properties, is_the_same_run_however_it_is_seen) {
  const Grid& grid = GetParam();
  expect_for_all(grid.cases, [&grid] {
    const auto motions = distinct_motions(*grid_points(grid.points, grid.size, grid.speed));
    Transformation by;
    by.reversed = *rc::gen::arbitrary<bool>();
    by.mirrored = *rc::gen::arbitrary<bool>();
    by.transposed = *rc::gen::arbitrary<bool>();
    by.renumbered = *rc::gen::arbitrary<bool>();
    by.shift = *rc::gen::element(0, 0, 1, -7, 1000);
    by.drift = *rc::gen::element(0, 0, 1, -2, 100);
    by.scale = *rc::gen::element(0, 0, 1, -3, 400, -400);
    by.clock = *rc::gen::element(0, 0, 1, -2, 8);
    by.epoch = *rc::gen::element(0, 0, 1, -5, 1024);
    const test::Run_outline outline(motions);
    for (const Transformation& seen : {Transformation(), by}) {
      const std::string problem = test::Transformed_run(motions, seen, outline).problem();
      std::ostringstream text;
      text << problem << ", " << seen;
      expect_none(problem.empty() ? problem : text.str(), motions);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Grids, Grid_properties,
                         testing::Values(Grid{4, 2, 1, 200}, Grid{5, 3, 1, 140}, Grid{6, 3, 1, 80},
                                         Grid{6, 4, 2, 60}, Grid{7, 3, 1, 20}),
                         [](const testing::TestParamInfo<Grid>& grid) {
                           return std::to_string(grid.param.points) + "_points_of_" +
                                  std::to_string(grid.param.size) + "_by_" +
                                  std::to_string(grid.param.size) + "_at_speed_" +
                                  std::to_string(grid.param.speed);
                         });

TEST(Large_grid_properties, passes_audits_with_and_without_filters) {
  expect_for_all(40, [] {
    const auto motions = distinct_motions(*grid_points(20, 5, 1));
    const Algebraic_number until(Rational(*integer_in(0, 8), 2));
    Kinetic_delaunay kinetic(motions);
    Kinetic_delaunay exact(motions, Algebraic_number(), Linear_kinetic_traits_2::exact());
    test::Event_recorder one(kinetic);
    test::Event_recorder other(exact);
    expect_none(test::audited_run(kinetic, until, Audit_level::reference), motions);
    exact.advance_to(until);
    expect_none(test::difference(one.events, other.events), motions);
  });
}

TEST(Large_grid_properties, a_trajectory_that_is_there_twice_is_refused_with_both_ids) {
  expect_for_all(1000, [] {
    const auto points = *grid_points(12, 2, 1);
    std::vector<Linear_motion_2> motions;
    for (const Grid_point& p : points) motions.push_back(motion(p));
    const bool has_twins = distinct_motions(points).size() < motions.size();
    try {
      const Kinetic_delaunay kinetic(motions, {}, {}, Coincident_points::refuse);
      RC_ASSERT(!has_twins);
    } catch (const Coincident_trajectories_error& error) {
      RC_ASSERT(has_twins);
      RC_ASSERT(error.first() < error.second());
      RC_ASSERT(points.at(error.first()) == points.at(error.second()));
    }
  });
}

}  // namespace
}  // namespace kinetri::property_test
