// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content of a Walkable_area: its constrained Delaunay triangulation, with the given corners,
// unrounded; and trees to find triangles and walls.
#ifndef KINETRI_SRC_OBSERVERS_TRIANGULATED_AREA_H
#define KINETRI_SRC_OBSERVERS_TRIANGULATED_AREA_H

#include <array>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/box_2.h"
#include "observers/well_known_text.h"

namespace kinetri::detail {

/// Rings that do not bound an area.
struct Invalid_area {
  std::string what;  ///< the error, its position, and what was expected
};

/// Immutable.
class Triangulated_area {
 public:
  /// A triangle of the area.
  struct Triangle {
    std::array<Vector_2, 3> corners;  ///< counterclockwise
    /// Across the side opposite to corner i, or `wall`.
    std::array<std::size_t, 3> neighbors;
  };
  static constexpr auto wall = static_cast<std::size_t>(-1);

  /// A side of a triangle on the boundary of the area.
  using Wall = std::array<Vector_2, 2>;

  /// Throws Invalid_area. Precondition: each ring has three positions or more, which are finite.
  explicit Triangulated_area(const std::vector<Rings_of_polygon>& polygons);

  std::size_t number_of_polygons() const { return number_of_polygons_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Box_2& extent() const { return extent_; }
  double area() const { return area_; }

  /// Calls `function` with the index of each triangle whose bounding box meets the closed box.
  template <class Function>
  void for_each_triangle_near(const Box_2& box, Function function) const {
    for (auto i = triangle_tree_.qbegin(boost::geometry::index::intersects(tree_box(box)));
         i != triangle_tree_.qend(); ++i) {
      function(i->second);
    }
  }

  /// Whether `predicate` holds for a wall whose bounding box meets the closed box.
  template <class Predicate>
  bool is_any_wall_near(const Box_2& box, Predicate predicate) const {
    for (auto i = wall_tree_.qbegin(boost::geometry::index::intersects(tree_box(box)));
         i != wall_tree_.qend(); ++i) {
      if (predicate(walls_[i->second])) return true;
    }
    return false;
  }

 private:
  using Tree_point = boost::geometry::model::d2::point_xy<double>;
  using Tree_box = boost::geometry::model::box<Tree_point>;
  using Tree = boost::geometry::index::rtree<std::pair<Tree_box, std::size_t>,
                                             boost::geometry::index::rstar<8>>;

  static Tree_box tree_box(const Box_2& box) {
    return {{box.xmin, box.ymin}, {box.xmax, box.ymax}};
  }
  static Tree_box tree_box(std::span<const Vector_2> places);
  void make_trees();

  std::size_t number_of_polygons_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<Wall> walls_;
  Box_2 extent_;
  double area_ = 0;
  Tree triangle_tree_;
  Tree wall_tree_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_TRIANGULATED_AREA_H
