// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of Voronoi cells within a region, by cutting each convex part of the region with the
// bisectors of all pairs of points in exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_AREA_ORACLE_H
#define KINETRI_TEST_SUPPORT_AREA_ORACLE_H

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "support/motions.h"
#include "support/query_oracle.h"

namespace kinetri::test {

/// A simple polygon, and convex polygons whose disjoint union it is.
struct Region {
  std::vector<Vector_2> polygon;
  std::vector<std::vector<Vector_2>> convex_parts;
};

/// A position and a weight.
using Weighted_place = std::pair<Static_point, Rational>;

/// The part of a polygon whose points have at most the same power to `p` as to `q`.
inline std::vector<Static_point> nearer_part(const std::vector<Static_point>& polygon,
                                             const Weighted_place& p, const Weighted_place& q) {
  const auto power = [](const Static_point& v, const Weighted_place& r) {
    return Rational(CGAL::squared_distance(v, r.first) - r.second);
  };
  // Positive if v is nearer to q.
  const auto excess = [&](const Static_point& v) { return Rational(power(v, p) - power(v, q)); };
  std::vector<Static_point> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Static_point& v = polygon[i];
    const Static_point& w = polygon[(i + 1) % polygon.size()];
    const Rational at_v = excess(v);
    const Rational at_w = excess(w);
    if (at_v <= 0) result.push_back(v);
    if (at_v * at_w < 0) result.push_back(v + at_v / Rational(at_v - at_w) * (w - v));
  }
  return result;
}

inline Rational exact_area(const std::vector<Static_point>& polygon) {
  Rational sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Static_point& v = polygon[i];
    const Static_point& w = polygon[(i + 1) % polygon.size()];
    sum += v.x() * w.y() - w.x() * v.y();
  }
  return sum / 2;
}

inline Rational exact_area(const Region& region) {
  Rational sum;
  for (const auto& part : region.convex_parts) {
    std::vector<Static_point> vertices;
    for (const Vector_2& v : part) vertices.emplace_back(to_rational(v.x), to_rational(v.y));
    sum += exact_area(vertices);
  }
  return sum;
}

/// The areas by id. Of equal points the first has the cell.
inline std::map<Point_id, Rational> exact_areas(const std::map<Point_id, Weighted_place>& places,
                                                const Region& region) {
  std::map<Point_id, Rational> result;
  std::set<Weighted_place> seen;
  for (const auto& [id, p] : places) {
    Rational& area = result[id];
    if (!seen.insert(p).second) continue;
    for (const auto& part : region.convex_parts) {
      std::vector<Static_point> cell;
      for (const Vector_2& v : part) cell.emplace_back(to_rational(v.x), to_rational(v.y));
      for (const auto& [other, q] : places) {
        if (q != p) cell = nearer_part(cell, p, q);
      }
      area += exact_area(cell);
    }
  }
  return result;
}

/// Divides the area of each point by the number of points that coincide with it for a while, which
/// have no area yet, and gives them as much.
inline void share_areas(std::map<Point_id, Rational>& areas, const Query_oracle& oracle) {
  for (auto& [id, area] : areas) {
    const std::vector<Point_id>& group = oracle.group(id);
    if (id != group.front()) continue;
    area /= static_cast<int>(group.size());
    for (const Point_id other : group) areas.at(other) = area;
  }
}

/// Expects the areas of the exact cells, up to an error on each side of a few units in the last
/// place of `largest`, the largest coordinate of the region and the points.
inline void expect_areas(std::span<const double> areas, const Query_oracle& oracle,
                         const Region& region, double largest) {
  std::map<Point_id, Weighted_place> places;
  for (const auto& [id, p] : oracle.places())
    places.emplace(id, Weighted_place(p, oracle.weight(id)));
  double perimeter = 0;
  for (std::size_t i = 0; i < region.polygon.size(); ++i) {
    const Vector_2& v = region.polygon[i];
    const Vector_2& w = region.polygon[(i + 1) % region.polygon.size()];
    perimeter += std::hypot(w.x - v.x, w.y - v.y);
  }
  const double error = 0x1p-49 * largest * perimeter;
  auto expected = exact_areas(places, region);
  share_areas(expected, oracle);
  double sum = 0;
  std::map<Weighted_place, Point_id> first;
  for (const auto& [id, p] : places) first.emplace(p, id);
  for (Point_id id = 0; id < areas.size(); ++id) {
    SCOPED_TRACE(testing::Message() << "area of " << id);
    sum += areas[id];
    const bool has_cell =
        places.contains(id) && first.at(places.at(id)) == oracle.group(id).front();
    // A power cell may be a segment or a position: then only the error bounds its area.
    if (!has_cell && !(places.contains(id) && expected.at(first.at(places.at(id))) == 0)) {
      ASSERT_EQ(areas[id], 0);
    } else {
      ASSERT_NEAR(areas[id], has_cell ? to_double(expected.at(id)) : 0, error);
    }
  }
  if (!places.empty()) {
    EXPECT_NEAR(sum, to_double(exact_area(region)), error * static_cast<double>(areas.size()));
  }
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_AREA_ORACLE_H
