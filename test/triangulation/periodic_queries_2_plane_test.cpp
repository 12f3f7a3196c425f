// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries in periodic boxes, compared with queries about copies of the points in the plane.
#include "kinetri/triangulation/periodic_queries_2.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "kinetri/kinetic/image_motion_2.h"
#include "kinetri/triangulation/queries_2.h"
#include "support/kinetic_in_box.h"
#include "support/periodic_runs.h"
#include "support/random_choices.h"

namespace kinetri::periodic_queries_2_plane_test {
namespace {

using test::kinetic_in_box;
using test::text;
using Kinetic = test::Kinetic_in_box;
using Time = Algebraic_number;

// Copies in three cells on each side of the middle one, in the order of images; also at irrational
// times.
TEST(Periodic_queries_2, are_those_about_copies_in_the_plane) {
  constexpr int cells = 3;
  int irrational = 0;
  for (unsigned seed = 1; seed <= test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random_choices random(seed);
    const Periodic_box_2 box = {{{16, 0}, {1, 0}, 0},
                                {{2, 16}, {1, random.integer(0, 1) * 1.0}, 0}};
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 4; ++i) {
      const auto number = [&](int least, int greatest) {
        return static_cast<double>(random.integer(least, greatest));
      };
      motions.push_back({{number(0, 15), number(0, 15)}, {number(-9, 9), number(-9, 9)}, 0});
    }
    std::vector<Periodic_image> images;
    std::vector<Linear_motion_2> copies;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      for (int x = -cells; x <= cells; ++x) {
        for (int y = -cells; y <= cells; ++y) {
          images.push_back({static_cast<Point_id>(i), {x, y}});
          const auto at = [&](Vector_2 p, Vector_2 u, Vector_2 v) -> Vector_2 {
            return {p.x + x * u.x + y * v.x, p.y + x * u.y + y * v.y};
          };
          copies.push_back({at(motions[i].position, box.first().position, box.second().position),
                            at(motions[i].velocity, box.first().velocity, box.second().velocity),
                            0});
        }
      }
    }
    Kinetic kinetic = kinetic_in_box(box, motions);
    Kinetic_delaunay_triangulation_2<> plane(copies);
    constexpr int number = (2 * cells + 1) * (2 * cells + 1);
    for (int step = 0; step < 8; ++step) {
      if (kinetic.step(Time(1)) == 0) break;
      plane.advance_to(kinetic.current_time());
      if (!kinetic.current_time().is_known_rational()) ++irrational;
      const Periodic_queries_2 queries(kinetic);
      const Kinetic_queries_2 expected(plane);
      constexpr std::size_t k = 12;
      const std::vector<Periodic_image> nearest = queries.nearest_neighbors(k);
      const std::vector<Point_id> in_plane_nearest = expected.nearest_neighbors(k);
      for (Point_id id = 0; id < motions.size(); ++id) {
        const Point_id middle = id * number + number / 2;
        EXPECT_EQ(text(queries.nearest_neighbor(id)),
                  text(images[*expected.nearest_neighbor(middle)]));
        std::vector<Periodic_image> k_nearest;
        for (std::size_t i = 0; i < k; ++i) {
          k_nearest.push_back(images[in_plane_nearest[k * middle + i]]);
        }
        const auto first = nearest.begin() + static_cast<std::ptrdiff_t>(k * id);
        EXPECT_EQ(text({first, first + static_cast<std::ptrdiff_t>(k)}), text(k_nearest));
        const auto cell = queries.rounded_voronoi_cell(id);
        const auto in_plane = expected.rounded_voronoi_cell(middle);
        std::vector<Periodic_image> neighbors;
        for (const Point_id u : in_plane.neighbors) neighbors.push_back(images[u]);
        EXPECT_EQ(text(cell.neighbors), text(neighbors));
        EXPECT_EQ(cell.vertices, in_plane.vertices);
      }
      for (int i = 0; i < 10; ++i) {
        const Vector_2 place = {random.integer(0, 63) / 4.0, random.integer(0, 63) / 4.0};
        EXPECT_EQ(text(*queries.nearest_vertex(place)),
                  text(images[*expected.nearest_vertex(place)]));
        const Periodic_location_2 location = queries.locate(place);
        const Location_2 in_plane = expected.locate(place);
        EXPECT_EQ(location.kind, in_plane.kind);
        std::vector<Periodic_image> points;
        for (const Point_id u : in_plane.points) points.push_back(images[u]);
        EXPECT_EQ(text(location.points), text(points));
      }
      const std::vector<double> areas = queries.rounded_voronoi_areas();
      const std::vector<double> positions = queries.rounded_positions(true);
      for (Point_id id = 0; id < motions.size(); ++id) {
        const Vector_2 place = rounded_position(wrapped(motions[id], box, kinetic.current_time()),
                                                kinetic.current_time());
        EXPECT_EQ((Vector_2{positions[2 * id], positions[2 * id + 1]}), place);
      }
      // The area of the box increases. Each cell has at most 12 sides, a perimeter of less than
      // 128, and no position that is 32 away from the point.
      const Time& now = kinetic.current_time();
      now.refine_to_bits(128);
      Rational error = Rational(areas.size()) * 9 * 32 * 128;
      error /= Integer(1) << 53;
      Rational sum;
      for (const double area : areas) sum += to_rational(area);
      EXPECT_GE(sum + error, box.area(now.lower()));
      EXPECT_LE(sum - error, box.area(now.upper()));
    }
  }
  EXPECT_GT(irrational, 5);
}

}  // namespace
}  // namespace kinetri::periodic_queries_2_plane_test
