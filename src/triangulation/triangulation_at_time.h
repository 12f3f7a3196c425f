// SPDX-License-Identifier: GPL-3.0-or-later
//
// A kinetic triangulation at one time, for queries: exact predicates at the time and just beside
// it, and connected sets of vertices.
#ifndef KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H
#define KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H

#include <algorithm>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "algebra/rounded_quotient.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/queried_triangulation.h"

namespace kinetri::detail {

/// Precondition: the time is neither before the present one nor after the next event, and the
/// triangulation does not change. So it is embedded just beside the time. Predicates are exact, at
/// the time itself unless stated otherwise, of points or vertices.
template <KineticTraits_2 Traits>
class Triangulation_at_time {
 public:
  using Types = Kinetic_types<Traits>;
  using Kinetic = Queried_triangulation<Traits>;
  using Triangulation = typename Types::Triangulation;
  using Vertex_handle = typename Types::Vertex_handle;
  using Point_2 = typename Types::Point_2;
  using Time = typename Types::Time;
  using Instantaneous_traits = typename Types::Instantaneous_traits;

  static constexpr bool is_weighted = Types::is_weighted;

  Triangulation_at_time(std::unique_ptr<const Kinetic> kinetic, const Time& time)
      : kinetic_(std::move(kinetic)),
        triangulation_(kinetic_->triangulation()),
        time_(time),
        at_(kinetic_->predicates({time, Time_side::at})),
        beside_(kinetic_->predicates(
            {time, time == kinetic_->current_time() ? Time_side::after : Time_side::before})) {}

  const Kinetic& kinetic() const { return *kinetic_; }
  const Triangulation& triangulation() const { return triangulation_; }
  const Time& time() const { return time_; }
  static Point_id id(Vertex_handle v) { return v->point().id(); }
  /// The points that the point hides since they coincide with it for a while, by id. They have no
  /// vertices.
  const std::vector<Point_id>& hidden_by(Point_id shown) const {
    return kinetic_->hidden_by(shown);
  }

  // ---- predicates ----

  const Instantaneous_traits& beside() const { return beside_; }

  CGAL::Orientation orientation(const auto& p, const auto& q, const auto& r) const {
    return at_.orientation_2_object()(point(p), point(q), point(r));
  }
  /// With weights of the power circle.
  CGAL::Oriented_side side_of_circle(const auto& p, const auto& q, const auto& r,
                                     const auto& s) const {
    return at_.side_of_oriented_circle_2_object()(point(p), point(q), point(r), point(s));
  }
  /// The same for collinear points and the power segment of the first two.
  CGAL::Oriented_side side_of_segment(const auto& p, const auto& q, const auto& r) const {
    return at_.power_side_of_oriented_power_circle_2_object()(point(p), point(q), point(r));
  }
  bool coincide(const auto& p, const auto& q) const {
    return at_.compare_x_2_object()(point(p), point(q)) == CGAL::EQUAL &&
           at_.compare_y_2_object()(point(p), point(q)) == CGAL::EQUAL;
  }
  /// Whether the two have one position and, with weights, one weight.
  bool are_alike(const auto& p, const auto& q) const {
    return coincide(p, q) && weight_side(p, q) == CGAL::ON_ORIENTED_BOUNDARY;
  }
  /// Whether p has less weight than q. Precondition: the two coincide.
  bool is_lighter(const auto& p, const auto& q) const {
    return weight_side(p, q) == CGAL::ON_POSITIVE_SIDE;
  }
  bool is_strictly_between(const auto& p, const auto& q, const auto& r) const {
    return orientation(p, q, r) == CGAL::COLLINEAR &&
           at_.collinear_are_strictly_ordered_along_line_2_object()(point(p), point(q), point(r));
  }
  /// How the distance from p to q compares with that from p to r.
  Comparison_result compare_distance(const auto& p, const auto& q, const auto& r) const {
    return at_.compare_distance_2_object()(point(p), point(q), point(r));
  }
  /// Whether the first vertex is nearer to p than the second, or equally near with a smaller id.
  bool is_nearer(const auto& p, Vertex_handle a, Vertex_handle b) const {
    const auto order = compare_distance(p, a, b);
    return order != CGAL::EQUAL ? order == CGAL::SMALLER : id(a) < id(b);
  }
  /// @{
  /// The same as compare_distance, at the time and beside it; with weights of the power of the
  /// position of p to q and r.
  Comparison_result compare_power(const auto& p, const auto& q, const auto& r) const {
    return compare_power(at_, point(p), point(q), point(r));
  }
  Comparison_result compare_power_beside(const auto& p, const auto& q, const auto& r) const {
    return compare_power(beside_, point(p), point(q), point(r));
  }
  /// @}

  // ---- positions ----

  /// The center of the circle, or power circle, through three points.
  Trajectory_2 center(Vertex_handle v, Vertex_handle a, Vertex_handle b) const {
    if constexpr (is_weighted) {
      return at_.construct_weighted_circumcenter_2_object()(v->point(), a->point(), b->point())
          .trajectory();
    } else {
      return at_.construct_circumcenter_2_object()(v->point(), a->point(), b->point()).trajectory();
    }
  }
  static Trajectory_2 vector(Vertex_handle from, Vertex_handle to) {
    const Trajectory_2 here = from->point().trajectory();
    const Trajectory_2 there = to->point().trajectory();
    return {there.x * here.w - here.x * there.w, there.y * here.w - here.y * there.w,
            here.w * there.w};
  }
  /// The vector from one point to another, turned to the left or to the right.
  static Trajectory_2 turned_vector(Vertex_handle from, Vertex_handle to, bool to_left) {
    const Trajectory_2 d = vector(from, to);
    return {to_left ? -d.y : d.y, to_left ? d.x : -d.x, d.w};
  }
  /// The position at the time, each coordinate rounded to nearest.
  Vector_2 rounded_position(const Trajectory_2& path) const {
    return {rounded_quotient(path.x, path.w, time_), rounded_quotient(path.y, path.w, time_)};
  }

  // ---- walks ----

  /// Calls `function` with each finite neighbor, counterclockwise.
  template <class Function>
  void for_each_neighbor(Vertex_handle v, Function function) const {
    detail::for_each_neighbor(triangulation(), v, function);
  }

  /// Calls `function` with each hidden vertex of the faces at `v`; below dimension 2 with all.
  template <class Function>
  void for_each_hidden_near(Vertex_handle v, Function function) const {
    if constexpr (is_weighted) {
      const Triangulation& all = triangulation();
      if (all.number_of_hidden_vertices() == 0) return;
      if (all.dimension() == 2) {
        return for_each_face_at(all, v, [&](auto face) {
          for (const Vertex_handle h : face->vertex_list()) function(h);
        });
      }
      for (auto h = all.hidden_vertices_begin(); h != all.hidden_vertices_end(); ++h) {
        function(Vertex_handle(h));
      }
    }
  }

  /// The vertices that edges connect with `v` within the set of vertices for which belongs(u), then
  /// the hidden vertices of the set in faces at those, perhaps several times.
  template <class Belongs>
  std::vector<Vertex_handle> connected(Vertex_handle v, Belongs belongs) const {
    std::vector<Vertex_handle> result = {v};
    std::unordered_set<Point_id> seen = {id(v)};
    for (std::size_t i = 0; i < result.size(); ++i) {
      for_each_neighbor(result[i], [&](Vertex_handle u) {
        if (seen.insert(id(u)).second && belongs(u)) result.push_back(u);
      });
    }
    const std::size_t visible = result.size();
    for (std::size_t i = 0; i < visible; ++i) {
      for_each_hidden_near(result[i], [&](Vertex_handle h) {
        if (belongs(h)) result.push_back(h);
      });
    }
    return result;
  }

  /// The ids of all vertices that are like `v` (are_alike), in ascending order, `v` included. Edges
  /// connect those with a cell beside the time, if the common cell has an area.
  std::vector<Point_id> all_at(Vertex_handle v) const {
    std::vector<Point_id> result;
    for (const Vertex_handle u : connected(v, [&](Vertex_handle w) { return are_alike(w, v); })) {
      result.push_back(id(u));
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// A visible vertex, probably near the position. Precondition: there is a point.
  Vertex_handle visible_near(const Point_2& position) const {
    const Vertex_handle v = kinetic_->vertex_near(position);
    if constexpr (is_weighted) {
      if (v->is_hidden()) {
        return triangulation().dimension() < 1 ? triangulation().finite_vertex()
                                               : v->face()->vertex(0);
      }
    }
    return v;
  }

 private:
  static const Point_2& point(const Point_2& p) { return p; }
  static const Point_2& point(Vertex_handle v) { return v->point(); }

  CGAL::Oriented_side weight_side(const auto& p, const auto& q) const {
    if constexpr (is_weighted) {
      return at_.power_side_of_oriented_power_circle_2_object()(point(p), point(q));
    } else {
      return CGAL::ON_ORIENTED_BOUNDARY;
    }
  }
  static Comparison_result compare_power(const Instantaneous_traits& instant, const Point_2& p,
                                         const Point_2& q, const Point_2& r) {
    if constexpr (is_weighted) {
      return instant.compare_power_distance_2_object()(p, q, r);
    } else {
      return instant.compare_distance_2_object()(p, q, r);
    }
  }

  std::unique_ptr<const Kinetic> kinetic_;
  const Triangulation& triangulation_;
  Time time_;
  Instantaneous_traits at_;      // the time
  Instantaneous_traits beside_;  // the side of it on which the triangulation is Delaunay
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H
