// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulations of the torus of points at rest with integer coordinates, and random ones.
#ifndef KINETRI_TEST_SUPPORT_TORUS_POINTS_H
#define KINETRI_TEST_SUPPORT_TORUS_POINTS_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/algebra/number_types.h"
#include "kinetri/base/ids.h"
#include "support/multiplier.h"
#include "support/torus_reference.h"
#include "triangulation/torus_triangulation_impl.h"

namespace kinetri::test::torus {

using Offset = Lattice_offset_2;

using Place = Vector<std::int64_t>;
using Box = test::Box<std::int64_t>;

/// Points at rest with integer coordinates.
class Traits {
 public:
  class Point_2 {
   public:
    Point_2() = default;
    Point_2(Point_id id, const Place& place) : id_(id), place_(place) {}
    Point_id id() const { return id_; }
    const Place& place() const { return place_; }

   private:
    Point_id id_ = no_point;
    Place place_{0, 0};
  };
  using Image_2 = Vector<Integer>;
  struct Orientation_2 {
    CGAL::Orientation operator()(const Image_2& p, const Image_2& q, const Image_2& r) const {
      return static_cast<CGAL::Orientation>(turn(p, q, r));
    }
  };
  struct Side_of_oriented_circle_2 {
    CGAL::Oriented_side operator()(const Image_2& p, const Image_2& q, const Image_2& r,
                                   const Image_2& s) const {
      return static_cast<CGAL::Oriented_side>(in_circle(p, q, r, s));
    }
  };

  Traits() = default;
  explicit Traits(const Box& box) : box_(box) {}

  Image_2 image(const Point_2& point, const Offset& offset) const {
    const auto coordinate = [&](std::int64_t p, std::int64_t a, std::int64_t b) {
      return Integer(p) + Integer(offset.x) * a + Integer(offset.y) * b;
    };
    return {coordinate(point.place().x, box_.first.x, box_.second.x),
            coordinate(point.place().y, box_.first.y, box_.second.y)};
  }
  Orientation_2 orientation_2_object() const { return {}; }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }

 private:
  Box box_;
};

using Torus = detail::Torus_triangulation<Traits>;
using Point = Traits::Point_2;
using Vertex_handle = Torus::Vertex_handle;
using Face_handle = Torus::Face_handle;
using Edge = Torus::Edge;

inline Image image_of(Face_handle face, int i) {
  return {face->vertex(i)->point().id(), Torus::offset(face, i).x, Torus::offset(face, i).y};
}

/// Sorted. A face that is there twice is there twice.
inline std::vector<Face> faces_of(const Torus& torus) {
  std::vector<Face> result;
  for (const Face_handle face : torus.tds().face_handles()) {
    result.push_back(normal_form({image_of(face, 0), image_of(face, 1), image_of(face, 2)}));
  }
  std::ranges::sort(result);
  return result;
}

/// The faces of the Delaunay triangulation by brute force, sorted, each once.
inline std::vector<Face> reference(const Box& box, const std::vector<Point>& points) {
  std::vector<test::Placed_point<std::int64_t>> places;
  for (const Point& point : points) places.emplace_back(point.id(), point.place());
  return test::reference(box, places);
}

inline bool coincide(const Box& box, const Place& p, const Place& q) {
  const std::int64_t area = cross(box.first, box.second);
  return cross(p - q, box.second) % area == 0 && cross(box.first, p - q) % area == 0;
}

// ---- random cases ----

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  std::int64_t operator()(std::int64_t least, std::int64_t greatest) {
    return least + static_cast<std::int64_t>(generator_() %
                                             static_cast<std::uint64_t>(greatest - least + 1));
  }
  std::size_t index(std::size_t size) { return generator_() % size; }

 private:
  std::mt19937_64 generator_;
};

/// On tiny lattices, on which most sets of four images are on a circle; many of them sheared by
/// several times their width.
inline Box random_box(Random& random) {
  const std::int64_t range = std::array{1, 2, 4, 9}[random.index(4)];
  for (;;) {
    Box box{{random(0, range), random(-range, range)}, {random(-range, range), random(0, range)}};
    if (random(0, 2) == 0) {
      const std::int64_t shear = random(-40, 40);
      box.second = {box.second.x + shear * box.first.x, box.second.y + shear * box.first.y};
    }
    if (random(0, 2) == 0) box.first = {box.first.x * random(1, 30), box.first.y};
    if (cross(box.first, box.second) > 0) return box;
  }
}

/// Up to `count` points, some boxes away; fewer if the lattice has less room.
inline std::vector<Point> random_points(Random& random, const Box& box, std::size_t count) {
  std::vector<Point> result;
  for (std::size_t tries = 0; tries < 20 && result.size() < count; ++tries) {
    const Place place{random(-20, 20), random(-20, 20)};
    const auto is_there = [&](const Point& p) { return coincide(box, p.place(), place); };
    if (std::ranges::any_of(result, is_there)) continue;
    result.emplace_back(static_cast<Point_id>(result.size()), place);
  }
  return result;
}

inline Torus torus_of(const Box& box, const std::vector<Point>& points) {
  Torus torus{Traits(box)};
  for (const Point& point : points) {
    EXPECT_EQ(torus.insert(point)->point().id(), point.id());
  }
  return torus;
}

inline std::vector<Edge> edges_of(const Torus& torus) {
  std::vector<Edge> result;
  for (const Face_handle face : torus.tds().face_handles()) {
    for (int i = 0; i < 3; ++i) result.emplace_back(face, i);
  }
  return result;
}

/// Unordered pairs of ids with the offset of the second against the first.
inline std::set<std::tuple<Point_id, Point_id, Offset>> edge_names(const Torus& torus) {
  std::set<std::tuple<Point_id, Point_id, Offset>> result;
  for (const auto& [face, i] : edges_of(torus)) {
    Point_id a = face->vertex(Torus::cw(i))->point().id();
    Point_id b = face->vertex(Torus::ccw(i))->point().id();
    Offset offset = Torus::offset(face, Torus::cw(i), Torus::ccw(i));
    if (b < a || (a == b && offset < Offset{})) {
      std::swap(a, b);
      offset = {-offset.x, -offset.y};
    }
    result.emplace(a, b, offset);
  }
  return result;
}

}  // namespace kinetri::test::torus

#endif  // KINETRI_TEST_SUPPORT_TORUS_POINTS_H
