// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries in periodic boxes at rational times, compared with an oracle.
#include "kinetri/triangulation/periodic_queries_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/kinetic_in_box.h"
#include "support/periodic_query_oracle.h"
#include "support/periodic_runs.h"
#include "support/precondition_error.h"
#include "support/query_oracle.h"
#include "support/random_choices.h"
#include "support/torus_reference.h"

namespace kinetri::periodic_queries_2_test {
namespace {

using test::kinetic_in_box;
using test::text;
using Kinetic = test::Kinetic_in_box;
using Time = Algebraic_number;

/// What degenerate cases there were.
struct Seen {
  int sides_without_length = 0;
  int coincidences = 0;
  int locations[3] = {0, 0, 0};
};

void expect_neighbors(const Kinetic& kinetic, const Periodic_queries_2<>& queries, Point_id id) {
  const std::vector<Periodic_image> neighbors = queries.neighbors(id);
  const auto coincident = kinetic.coincident_points(id);
  if (!coincident.empty() && coincident.front() < id) {
    ASSERT_EQ(neighbors.size(), 1u);
    EXPECT_EQ(neighbors.front().id, coincident.front());
    return;
  }
  ASSERT_GT(neighbors.size(), coincident.size());
  const std::size_t degree = neighbors.size() - coincident.size();
  for (std::size_t i = 0; i < coincident.size(); ++i) {
    EXPECT_EQ(neighbors[degree + i].id, coincident[i]);
  }
  EXPECT_EQ(std::ranges::min_element(neighbors.begin(),
                                     neighbors.begin() + static_cast<std::ptrdiff_t>(degree)),
            neighbors.begin());
  // The faces at the point, each as often as it has the point as a corner.
  std::multiset<test::Face> faces;
  std::multiset<test::Face> expected;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    const auto image = [&](int i) -> test::Image {
      return {face->vertex(i)->point().id(), face->offset(i).x, face->offset(i).y};
    };
    for (int i = 0; i < 3; ++i) {
      if (std::get<0>(image(i)) != id) continue;
      expected.insert(test::normal_form({image(0), image(1), image(2)}));
    }
  }
  for (std::size_t i = 0; i < degree; ++i) {
    const auto image = [&](std::size_t k) -> test::Image {
      const auto& [u, offset] = neighbors[k % degree];
      return {u, offset.x, offset.y};
    };
    faces.insert(test::normal_form({test::Image{id, 0, 0}, image(i), image(i + 1)}));
  }
  EXPECT_EQ(faces, expected);
}

void expect_right_answers(const Kinetic& kinetic, const Rational& t, test::Random_choices& random,
                          Seen& seen) {
  const Periodic_queries_2 queries(kinetic, Time(t));
  const test::Periodic_query_oracle oracle(kinetic, t);
  const std::vector<double> areas = queries.rounded_voronoi_areas();
  const std::vector<double> positions = queries.rounded_positions();
  const std::vector<double> wrapped = queries.rounded_positions(true);
  const std::vector<Periodic_image> nearest = queries.nearest_neighbors();
  const int k = random.integer(0, 9);
  const std::vector<Periodic_image> k_nearest =
      queries.nearest_neighbors(static_cast<std::size_t>(k));
  ASSERT_EQ(k_nearest.size(), static_cast<std::size_t>(k) * kinetic.next_id());
  EXPECT_EQ(queries.closest_pair(), oracle.closest_pair());
  ASSERT_EQ(areas.size(), kinetic.next_id());
  ASSERT_EQ(nearest.size(), kinetic.next_id());
  ASSERT_EQ(wrapped.size(), 2 * kinetic.next_id());
  Rational sum_of_areas;
  std::map<Point_id, std::vector<Point_id>> sharing;  // by the least id at the position
  for (const auto& [id, place] : oracle.given()) {
    SCOPED_TRACE("point " + std::to_string(id));
    EXPECT_EQ(text(queries.nearest_neighbor(id)), text(oracle.nearest_neighbor(id)));
    EXPECT_EQ(nearest[id], queries.nearest_neighbor(id));
    const auto first = k_nearest.begin() + k * static_cast<std::ptrdiff_t>(id);
    EXPECT_EQ(text({first, first + k}), text(oracle.nearest_neighbors(id, k)));
    expect_neighbors(kinetic, queries, id);
    // The hidden ones are at the position.
    const auto coincident = kinetic.coincident_points(id);
    const auto neighbors = queries.neighbors(id);
    for (std::size_t i = 0; i < std::min(coincident.size(), neighbors.size()); ++i) {
      EXPECT_EQ(oracle.place_of(neighbors[neighbors.size() - 1 - i]), place);
      if (coincident.front() < id) break;
    }

    const test::Periodic_query_oracle::Cell expected = oracle.cell(id);
    const auto cell = queries.voronoi_cell(id);
    EXPECT_EQ(text(cell.neighbors), text(expected.cell.neighbors));
    const auto rounded_cell = queries.rounded_voronoi_cell(id);
    EXPECT_EQ(rounded_cell.neighbors, cell.neighbors);
    ASSERT_EQ(cell.vertices.size(), expected.cell.vertices.size());
    ASSERT_EQ(rounded_cell.vertices.size(), cell.vertices.size());
    for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
      const auto& [x, y] = expected.cell.vertices[i];
      EXPECT_EQ(cell.vertices[i].x, x);
      EXPECT_EQ(cell.vertices[i].y, y);
      EXPECT_EQ(rounded_cell.vertices[i], (Vector_2{to_double(x), to_double(y)}));
    }
    if (cell.vertices.size() < neighbors.size() && coincident.empty()) ++seen.sides_without_length;

    const Point_id least = oracle.least_at(id);
    if (least != id && coincident.empty()) ++seen.coincidences;
    if (least == id) {
      sum_of_areas += expected.area;
      const auto share = static_cast<double>(1 + coincident.size());
      const Rational error = abs(Rational(to_rational(areas[id] * share) - expected.area));
      const double bound = (3 + static_cast<double>(cell.vertices.size()) / 2) * 0x1p-53 *
                           expected.radius * expected.perimeter;
      EXPECT_LE(error, to_rational(bound));
      for (const Point_id other : coincident) EXPECT_EQ(areas[other], areas[id]);
    } else if (coincident.empty() || id < coincident.front()) {
      EXPECT_EQ(areas[id], 0);
    }
    EXPECT_EQ(positions[2 * id], to_double(place.x));
    EXPECT_EQ(positions[2 * id + 1], to_double(place.y));
    EXPECT_EQ(wrapped[2 * id], to_double(oracle.wrapped(place).x));
    EXPECT_EQ(wrapped[2 * id + 1], to_double(oracle.wrapped(place).y));
  }
  EXPECT_EQ(sum_of_areas, oracle.given().empty() ? Rational(0) : oracle.area_of_box());
  for (int i = 0; i < 12; ++i) {
    const int range = i < 9 ? 12 : 1000;
    Vector_2 place = {random.integer(-range, range) / 2.0, random.integer(-range, range) / 2.0};
    // At an image, or in the middle between two.
    if (i % 3 == 0 && !oracle.given().empty()) {
      const test::Exact_place& p = oracle.given().begin()->second;
      const test::Exact_place& q = oracle.given().rbegin()->second;
      const Vector_2 middle = {to_double(p.x + q.x) / 2, to_double(p.y + q.y) / 2};
      if (2 * middle.x == std::floor(2 * middle.x) && 2 * middle.y == std::floor(2 * middle.y)) {
        place = middle;
      }
    }
    SCOPED_TRACE("position " + std::to_string(place.x) + ", " + std::to_string(place.y));
    const auto image = queries.nearest_vertex(place);
    EXPECT_EQ(image, oracle.nearest(place));
    const Periodic_location_2 location = queries.locate(place);
    const Periodic_location_2 expected = oracle.locate(place);
    EXPECT_EQ(location.kind, expected.kind);
    EXPECT_EQ(text(location.points), text(expected.points));
    if (image) ++seen.locations[static_cast<int>(location.kind)];
  }
}

Periodic_box_2 random_box(test::Random_choices& random, int range) {
  const int kind = random.integer(0, 3);
  for (;;) {
    const auto number = [&](int greatest) {
      return static_cast<double>(random.integer(-greatest, greatest));
    };
    const Vector_2 a = {number(range), number(range)};
    const Vector_2 b = {number(range), number(range)};
    if (a.x * b.y - a.y * b.x <= 0) continue;
    switch (kind) {
      case 0:  // at rest
        return {{a, {0, 0}, 0}, {b, {0, 0}, 0}};
      case 1:  // grows in proportion
        return {{a, a, 0}, {b, b, 0}};
      case 2:  // shear
        return {{{static_cast<double>(range), 0}, {0, 0}, 0},
                {{0, static_cast<double>(range)}, {static_cast<double>(range), 0}, 0}};
      default:
        return {{a, {number(1), number(1)}, 0}, {b, {number(1), number(1)}, 0}};
    }
  }
}

/// Some are images of others at all times.
std::vector<Linear_motion_2> random_motions(test::Random_choices& random, int number, int range,
                                            const Periodic_box_2& box) {
  std::vector<Linear_motion_2> result;
  for (int i = 0; i < number; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random.integer(-range, range)); };
    Linear_motion_2 motion = {{coordinate(), coordinate()}, {coordinate(), coordinate()}, 0};
    if (i > 0 && random.integer(0, 4) == 0) {
      motion = result[static_cast<std::size_t>(random.integer(0, i - 1))];
      const auto add = [&](int k, const Linear_motion_2& vector) {
        motion.position.x += k * vector.position.x;
        motion.position.y += k * vector.position.y;
        motion.velocity.x += k * vector.velocity.x;
        motion.velocity.y += k * vector.velocity.y;
      };
      add(random.integer(-2, 2), box.first());
      add(random.integer(-2, 2), box.second());
    }
    result.push_back(motion);
  }
  return result;
}

TEST(Periodic_queries_2, are_those_of_an_oracle_at_rational_times) {
  Seen seen;
  int irrational = 0;
  for (unsigned seed = 1; seed <= test::cases(24u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random_choices random(seed);
    const int range = std::array{2, 3, 5}[seed % 3];
    const Periodic_box_2 box = random_box(random, range);
    Kinetic kinetic =
        kinetic_in_box(box, random_motions(random, static_cast<int>(seed % 7), range, box));
    for (int steps = 0; steps < 4; ++steps) {
      const Time now = kinetic.current_time();
      Time end = Time(Rational(now.upper() + 1));
      if (const auto collapse = box.collapse_after(now)) {
        end = std::min(end, Time(simplest_between(now, *collapse)));
      }
      if (const auto next = kinetic.next_event_time()) end = std::min(end, *next);
      std::vector<Rational> at;
      if (now.is_known_rational()) at.push_back(now.rational());
      if (now < end) at.push_back(simplest_between(now, end));
      // The queries may find out that a time is rational.
      const Periodic_queries_2 queries(kinetic, end);
      if (const auto t = test::rational_value(end)) {
        at.push_back(*t);
      } else {
        ++irrational;
        if (kinetic.number_of_points() > 0) {
          EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(0),
                                    "at a time that is not known to be rational a Voronoi vertex "
                                    "has no exact coordinates; call rounded_voronoi_cell");
        }
      }
      for (const Rational& t : at) {
        if (denominator(t) > 10000) continue;
        SCOPED_TRACE("time " + t.str());
        expect_right_answers(kinetic, t, random, seen);
        if (testing::Test::HasFailure()) return;
      }
      if (kinetic.step(end) == 0) break;
    }
  }
  EXPECT_GT(seen.sides_without_length, 50);
  EXPECT_GT(seen.coincidences, 10);
  EXPECT_GT(irrational, 5);
  for (const int number : seen.locations) EXPECT_GT(number, 50);
}

}  // namespace
}  // namespace kinetri::periodic_queries_2_test
