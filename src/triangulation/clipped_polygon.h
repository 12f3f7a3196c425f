// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intersections of a polygon with half planes, in binary64 arithmetic, for areas.
#ifndef KINETRI_SRC_TRIANGULATION_CLIPPED_POLYGON_H
#define KINETRI_SRC_TRIANGULATION_CLIPPED_POLYGON_H

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri::detail {

/// The positions whose scalar product with `normal` is at most `bound`.
struct Half_plane {
  Vector_2 normal;  ///< of length 1
  double bound = 0;
};

/// The intersection of a polygon with half planes, by the algorithm of I. E. Sutherland and G. W.
/// Hodgman (Reentrant polygon clipping, Communications of the ACM 17, 1974). If the polygon is not
/// convex, the result may overlap itself along the boundary of a half plane, which does not change
/// its area.
class Clipped_polygon {
 public:
  void assign(std::span<const Vector_2> polygon) {
    vertices_.assign(polygon.begin(), polygon.end());
  }

  bool is_empty() const { return vertices_.empty(); }

  /// The vertices of what is left, in the direction of the polygon.
  std::span<const Vector_2> vertices() const { return vertices_; }

  void clip(const Half_plane& half_plane) {
    const auto beyond = [&](const Vector_2& v) {
      return v.x * half_plane.normal.x + v.y * half_plane.normal.y - half_plane.bound;
    };
    beyond_.clear();
    bool is_cut = false;
    for (const Vector_2& v : vertices_) {
      beyond_.push_back(beyond(v));
      is_cut = is_cut || beyond_.back() > 0;
    }
    if (!is_cut) return;
    clipped_.clear();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const std::size_t next = i + 1 < vertices_.size() ? i + 1 : 0;
      const double here = beyond_[i];
      const double there = beyond_[next];
      if (here <= 0) clipped_.push_back(vertices_[i]);
      if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
        const Vector_2& v = vertices_[i];
        const Vector_2& w = vertices_[next];
        const double part = here / (here - there);
        clipped_.push_back({v.x + part * (w.x - v.x), v.y + part * (w.y - v.y)});
      }
    }
    std::swap(vertices_, clipped_);
  }

  /// The area of what is left; negative if the polygon is clockwise.
  double signed_area() const {
    double sum = 0;
    for (std::size_t i = 2; i < vertices_.size(); ++i) {
      const Vector_2& o = vertices_[0];
      const Vector_2& v = vertices_[i - 1];
      const Vector_2& w = vertices_[i];
      sum += (v.x - o.x) * (w.y - o.y) - (w.x - o.x) * (v.y - o.y);
    }
    return sum / 2;
  }

 private:
  std::vector<Vector_2> vertices_;
  std::vector<Vector_2> clipped_;
  std::vector<double> beyond_;  // of each vertex, the distance beyond the half plane
};

/// Throws Precondition_error if the polygon has fewer than three vertices, or a coordinate that is
/// not finite or beyond 1e150, or is not simple.
void check_polygon(std::span<const Vector_2> polygon);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_CLIPPED_POLYGON_H
