// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of cells in periodic boxes: against cells of all images in rationals, which sum to the area
// of the box exactly; and, with cutoffs and over time, against the planar areas of copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/observers/cell_areas.h"
#include "kinetri/observers/mean_cell_areas.h"
#include "kinetri/triangulation/periodic_queries_2.h"
#include "support/discs.h"
#include "support/images.h"
#include "support/observed_periodic_run.h"
#include "support/periodic_runs.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_areas_test {
namespace {

using Traits = Periodic_kinetic_traits_2;
using Kinetic = Kinetic_triangulation_2<Traits>;
using Disc_traits = Periodic_disc_kinetic_traits_2;
using Time = Algebraic_number;
using test::Periodic_run;

Rational cross(const test::Static_kernel::Vector_2& a, const test::Static_kernel::Vector_2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The area of the box, exactly.
Rational box_area(const Periodic_box_2& box, const Rational& t) {
  const auto vector = [&](const Linear_motion_2& motion) {
    return test::place_at(motion, t) - CGAL::ORIGIN;
  };
  return cross(vector(box.first()), vector(box.second()));
}

/// The areas of the cells, or power cells, by id: of each triangle of brute force the
/// quadrilaterals at its corners, whose other corners are on its sides and at its center.
template <class AnyKinetic>
std::map<Point_id, Rational> exact_areas(const AnyKinetic& kinetic, const Rational& t) {
  std::map<Point_id, Rational> result;
  Rational sum = 0;
  for (const test::Face& face : test::reference_at(kinetic, t)) {
    std::array<Point_id, 3> ids{};
    std::array<test::Static_point, 3> places;
    std::array<Rational, 3> weights;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [id, x, y] = face[i];
      ids[i] = id;
      const auto& motion = kinetic.motion(id);
      places[i] = test::place_at(
          Image_motion_2{center(motion),
                         {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)},
                         &kinetic.traits().box()},
          t);
      weights[i] = test::weight_at(motion, t);
    }
    // The vector from the corner i to the position on the side to corner k with equal powers.
    const auto foot = [&](std::size_t i, std::size_t k) {
      const auto d = places[k] - places[i];
      const Rational square = d.squared_length();
      return d * Rational((square + weights[i] - weights[k]) / (2 * square));
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      const auto q = places[j] - places[i];
      const auto r = places[k] - places[i];
      const Rational of_q = (q.squared_length() + weights[i] - weights[j]) / 2;
      const Rational of_r = (r.squared_length() + weights[i] - weights[k]) / 2;
      const Rational turn = cross(q, r);
      const test::Static_kernel::Vector_2 middle((of_q * r.y() - of_r * q.y()) / turn,
                                                 (of_r * q.x() - of_q * r.x()) / turn);
      const Rational part = (cross(foot(i, j), middle) + cross(middle, foot(i, k))) / 2;
      result[ids[i]] += part;
      sum += part;
    }
  }
  EXPECT_EQ(sum, box_area(kinetic.traits().box(), t));
  return result;
}

void expect_area(const Cell_area& cell, const Rational& exact, double greatest_error) {
  EXPECT_LE(abs(Rational(to_rational(cell.area) - exact)), to_rational(cell.error))
      << "point " << cell.id << " has " << cell.area << " instead of " << to_double(exact);
  EXPECT_LE(cell.error, greatest_error) << "point " << cell.id;
}

/// Compares all areas with exact ones; returns how many are zero.
template <class AnyKinetic>
std::size_t compare_with_exact_areas(const AnyKinetic& kinetic, const Rational& t) {
  const auto exact = exact_areas(kinetic, t);
  const auto found = cell_areas(kinetic, Cell_limits());
  EXPECT_EQ(found.size(), kinetic.number_of_points());
  std::size_t empty = 0;
  Rational sum = 0;
  Rational error = 0;
  for (const Cell_area& cell : found) {
    const auto area = exact.find(cell.id);
    expect_area(cell, area == exact.end() ? Rational(0) : area->second, 1e-10);
    empty += cell.area == 0;
    sum += to_rational(cell.area);
    error += to_rational(cell.error);
  }
  EXPECT_LE(abs(Rational(sum - box_area(kinetic.traits().box(), t))), error);
  return empty;
}

/// A time up to 2 at which no images of points with small integers coincide, before the box loses
/// its area.
Rational end_of(const Periodic_box_2& box, test::Random& random) {
  const auto collapse = box.collapse_after(Time());
  const double end = collapse ? std::min(2.0, 0.75 * collapse->interval().lower) : 2.0;
  return to_rational(std::floor(end * 64) / 64) * Rational(random(1, 96), 97);
}

TEST(Periodic_areas, are_those_of_all_images) {
  for (unsigned seed = 0; seed < test::cases(60u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const Periodic_box_2 box = test::random_box(random, 3 + static_cast<int>(seed % 4));
    const auto motions = test::random_motions(random, 1 + static_cast<int>(seed % 7), 4);
    Kinetic kinetic(motions, Time(), Traits(box));
    if (kinetic.number_of_hidden_points() > 0) continue;
    const Rational t = end_of(box, random);
    kinetic.advance_to(Time(t));
    EXPECT_EQ(compare_with_exact_areas(kinetic, t), 0U);
    if (HasFailure()) return;
  }
}

TEST(Periodic_areas, of_discs_are_those_of_the_power_cells_of_all_images) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(60u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const Periodic_box_2 box = test::random_box(random, 4 + static_cast<int>(seed % 4));
    std::vector<Disc_motion_2> discs;
    for (const auto& motion : test::random_motions(random, 1 + static_cast<int>(seed % 7), 4)) {
      discs.push_back({motion, static_cast<double>(random(0, 2)), 0, 0});
    }
    Kinetic_triangulation_2<Disc_traits> kinetic(discs, Time(), Disc_traits(box));
    const Rational t = end_of(box, random);
    kinetic.advance_to(Time(t));
    hidden += compare_with_exact_areas(kinetic, t);
    if (HasFailure()) return;
  }
  EXPECT_GT(hidden, 10U);
}

// Also at times at which images coincide, and of points that coincide for a while.
TEST(Periodic_areas, are_those_of_queries_at_degenerate_times) {
  for (unsigned seed = 0; seed < test::cases(60u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Periodic_run run(seed);
    auto& kinetic = run.kinetic();
    for (double time = 0; time <= 2; time += 0.5) {
      kinetic.advance_to(time);
      for (int i = 0; i < 2; ++i) run.change();
      const auto areas = Periodic_queries_2(kinetic).rounded_voronoi_areas();
      for (const Cell_area& cell : cell_areas(kinetic, Cell_limits())) {
        EXPECT_NEAR(cell.area, areas[cell.id], cell.error + 1e-12) << "point " << cell.id;
      }
    }
    if (HasFailure()) return;
  }
}

TEST(Periodic_areas, of_one_point_are_those_of_the_box) {
  // A long shear: the lattice is that of the unit square.
  const Periodic_box_2 box({{1, 0}, {}, 0}, {{0, 1}, {1, 0}, 0});
  Kinetic kinetic(std::vector<Linear_motion_2>{{{7, 3}, {}, 0}}, Time(0x1p20), Traits(box));
  const auto areas = cell_areas(kinetic, Cell_limits());
  ASSERT_EQ(areas.size(), 1U);
  expect_area(areas[0], 1, 1e-12);
  Cell_limits limits;
  limits.cutoff = 0.5;
  EXPECT_NEAR(cell_areas(kinetic, limits)[0].area, std::acos(-1) / 4, 1e-14);
}

constexpr const char* no_walls =
    "a walkable area in a periodic box, whose images have no walls; expected no walkable area";

Kinetic one_point_in(double side) {
  return Kinetic(std::vector<Linear_motion_2>{{{0, 0}, {}, 0}}, Time(), Traits(test::square(side)));
}

TEST(Periodic_areas, refuse_walls_and_lengths_that_are_out_of_range) {
  const Kinetic kinetic = one_point_in(4);
  Cell_limits limits;
  limits.walkable = Walkable_area::from_wkt("POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))");
  EXPECT_PRECONDITION_ERROR(cell_areas(kinetic, limits), no_walls);
  EXPECT_PRECONDITION_ERROR(limits.check(true), no_walls);
  limits.walkable.reset();
  EXPECT_NO_THROW(limits.check(true));
  limits.cutoff = 0;
  EXPECT_PRECONDITION_ERROR(cell_areas(kinetic, limits),
                            "the cutoff is 0.000000; expected a distance between 1e-150 and 1e150");
  EXPECT_PRECONDITION_ERROR(
      cell_areas(one_point_in(0x1p500), Cell_limits()),
      "a Voronoi cell is so large that its area may not be a binary64 number; give lattice vectors "
      "below 1e150");
}

// ---- copies in the plane ----

/// Points in a box, and their copies, which change together.
class Copied_points {
 public:
  static constexpr int most = 4;  // copies on each side

  Copied_points(const Periodic_box_2& box, const std::vector<Linear_motion_2>& motions)
      : box_(box), kinetic_(motions, Time(), Traits(box)), plane_(copies_of(motions), Time()) {
    for (std::size_t i = 0; i < motions.size(); ++i) ids_.push_back(first_copy(i));
  }

  Kinetic& kinetic() { return kinetic_; }
  Kinetic_delaunay_triangulation_2<>& plane() { return plane_; }
  /// The copy in the middle.
  Point_id in_plane(Point_id id) const { return ids_[id] + copies / 2; }

  void advance_to(double time) {
    kinetic_.advance_to(time);
    plane_.advance_to(time);
  }
  void set_motion(Point_id id, const Linear_motion_2& motion) {
    kinetic_.set_motion(id, motion);
    std::vector<Point_id> ids;
    for (Point_id i = 0; i < copies; ++i) ids.push_back(ids_[id] + i);
    plane_.set_motions(ids, copies_of({motion}));
  }
  void insert(const Linear_motion_2& motion) {
    kinetic_.insert(motion);
    ids_.push_back(plane_.insert(std::span<const Linear_motion_2>(copies_of({motion}))));
  }
  void erase(Point_id id) {
    kinetic_.erase(id);
    std::vector<Point_id> ids;
    for (Point_id i = 0; i < copies; ++i) ids.push_back(ids_[id] + i);
    plane_.erase(ids);
  }

 private:
  static constexpr Point_id copies = (2 * most + 1) * (2 * most + 1);

  static Point_id first_copy(std::size_t i) { return static_cast<Point_id>(i) * copies; }
  // Of small integers, so that they are exact.
  std::vector<Linear_motion_2> copies_of(const std::vector<Linear_motion_2>& motions) const {
    std::vector<Linear_motion_2> result;
    for (const Linear_motion_2& motion : motions) {
      const Vector_2 a = rounded_place(box_.first(), motion.epoch);
      const Vector_2 b = rounded_place(box_.second(), motion.epoch);
      const Vector_2& va = box_.first().velocity;
      const Vector_2& vb = box_.second().velocity;
      for (int k = -most; k <= most; ++k) {
        for (int l = -most; l <= most; ++l) {
          Linear_motion_2 copy = motion;
          copy.position.x += k * a.x + l * b.x;
          copy.position.y += k * a.y + l * b.y;
          copy.velocity.x += k * va.x + l * vb.x;
          copy.velocity.y += k * va.y + l * vb.y;
          result.push_back(copy);
        }
      }
    }
    return result;
  }

  Periodic_box_2 box_;
  Kinetic kinetic_;
  Kinetic_delaunay_triangulation_2<> plane_;
  std::vector<Point_id> ids_;  // of the first copy, by id
};

class Random_motion {
 public:
  explicit Random_motion(unsigned seed) : random_(seed) {}
  Linear_motion_2 operator()(double epoch) {
    const auto small = [&](int greatest) { return 0.5 * random_(-greatest, greatest); };
    const double x = small(8);
    const double y = small(8);
    const double vx = small(3);
    return {{x, y}, {vx, small(3)}, epoch};
  }

 private:
  test::Random random_;
};

Periodic_box_2 box_of(unsigned seed) {
  const double shear = seed % 2 == 0 ? 0 : 0.5;
  const double growth = seed % 3 == 0 ? 0 : 0.25;
  return {{{6, 1}, {growth, 0}, 0}, {{-1, 5}, {shear, growth}, 0}};
}

Copied_points random_points(unsigned seed, Random_motion& motion) {
  std::vector<Linear_motion_2> motions;
  for (unsigned i = 0; i <= seed % 5; ++i) motions.push_back(motion(0));
  return {box_of(seed), motions};
}

void change(Copied_points& points, Random_motion& motion, double time) {
  points.insert(motion(time));
  points.set_motion(0, motion(time));
  // To an image of another point, with which it coincides while the box rests.
  Linear_motion_2 there = points.kinetic().motion(0);
  there.position.x += 6;
  there.position.y += 1;
  if (points.kinetic().contains(1)) points.set_motion(1, there);
}

TEST(Periodic_areas, within_a_cutoff_are_those_of_copies) {
  std::size_t cut = 0;
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random_motion motion(seed);
    Copied_points points = random_points(seed, motion);
    for (const double time : {0.0, 0.5, 0.75, 1.25}) {
      points.advance_to(time);
      if (time == 0.5) change(points, motion, time);
      for (const double cutoff : {0.5, 2.0, 3.0, 100.0}) {
        Cell_limits limits;
        limits.cutoff = cutoff;
        const auto expected = cell_areas(points.plane(), limits);
        for (const Cell_area& cell : cell_areas(points.kinetic(), limits)) {
          const auto copy = std::ranges::find(expected, points.in_plane(cell.id), &Cell_area::id);
          ASSERT_NE(copy, expected.end());
          EXPECT_NEAR(cell.area, copy->area, cell.error + copy->error) << "point " << cell.id;
          EXPECT_LE(cell.error, 1e-10);
          cut += cutoff == 2 && cell.area > 0;
        }
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(cut, 100U);
}

TEST(Periodic_mean_areas, are_those_of_copies) {
  for (unsigned seed = 0; seed < test::cases(6u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random_motion motion(seed);
    Copied_points points = random_points(seed, motion);
    Cell_limits far;
    far.cutoff = 100;
    Cell_limits near;
    near.cutoff = 2;
    Mean_cell_areas means(points.kinetic(), Cell_limits());
    Mean_cell_areas near_means(points.kinetic(), near);
    Mean_cell_areas copies(points.plane(), far);
    Mean_cell_areas near_copies(points.plane(), near);
    points.advance_to(0.5);
    change(points, motion, 0.5);
    points.advance_to(1.0);
    points.erase(0);
    points.advance_to(1.25);
    const auto compare = [&](auto& found_by, auto& expected_by) {
      const auto expected = expected_by.means();
      for (const Mean_cell_area& mean : found_by.means()) {
        const auto copy =
            std::ranges::find(expected, points.in_plane(mean.id), &Mean_cell_area::id);
        ASSERT_NE(copy, expected.end());
        EXPECT_EQ(mean.from, copy->from);
        EXPECT_EQ(mean.until, copy->until);
        EXPECT_NEAR(mean.area, copy->area, mean.error + copy->error) << "point " << mean.id;
        EXPECT_LE(mean.error, 1e-3);
      }
    };
    compare(means, copies);
    compare(near_means, near_copies);
    if (HasFailure()) return;
  }
}

// The mean of the area of the box, which is a polynomial in time.
TEST(Periodic_mean_areas, have_the_sum_of_the_box) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const Periodic_box_2 box = box_of(seed);
    std::vector<Disc_motion_2> discs;
    for (const auto& motion : test::random_motions(random, 2 + static_cast<int>(seed % 5), 4)) {
      discs.push_back({motion, 0.5 * random(0, 3), 0, 0});
    }
    Simulation_2<Disc_traits> simulation(discs, {}, 0, Disc_traits(box));
    Mean_cell_areas means(simulation, Cell_limits());
    simulation.advance_to(2.0);
    double sum = 0;
    double error = 0;
    for (const Mean_cell_area& mean : means.means()) {
      sum += mean.area;
      error += mean.error;
    }
    // Simpson's rule is exact for it.
    const auto area = [&](int t) { return to_double(box_area(box, t)); };
    EXPECT_NEAR(sum, (area(0) + 4 * area(1) + area(2)) / 6, error);
    EXPECT_LE(error, 1e-3);
  }
}

TEST(Periodic_mean_areas, refuse_walls) {
  Kinetic kinetic = one_point_in(4);
  Cell_limits limits;
  limits.walkable = Walkable_area::from_wkt("POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))");
  EXPECT_PRECONDITION_ERROR(Mean_cell_areas(kinetic, limits), no_walls);
}

}  // namespace
}  // namespace kinetri::periodic_areas_test
