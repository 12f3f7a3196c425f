// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a field asks of a triangulation at its current time: rounded positions of points, the
// triangle of a position, and its natural neighbors.
#ifndef KINETRI_SRC_TRIANGULATION_FIELD_PRESENT_H
#define KINETRI_SRC_TRIANGULATION_FIELD_PRESENT_H

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "algebra/rounded_quotient.h"
#include "kinetic/rounded_places.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/ball.h"

namespace kinetri::detail {

// Differences of larger coordinates might overflow.
inline constexpr double largest_coordinate = 1e300;

template <class Traits>
class Present {
 public:
  using Kinetic = Kinetic_triangulation_2<Traits>;
  using Topology = typename Kinetic::Triangulation;
  using Face_handle = typename Kinetic::Face_handle;
  using Vertex_handle = typename Kinetic::Vertex_handle;
  using Point_2 = typename Traits::Point_2;

  explicit Present(const Kinetic& kinetic)
      : kinetic_(kinetic),
        time_(ball_of(kinetic.current_time())),
        at_(kinetic.traits().instantaneous_traits({kinetic.current_time(), Time_side::at})),
        after_(kinetic.traits().instantaneous_traits({kinetic.current_time(), Time_side::after})) {}

  // Rounds the positions of all points: then most signs need no exact arithmetic.
  void round_all() {
    places_.resize(kinetic_.next_id());
    balls_.resize(kinetic_.next_id());
    for (const Vertex_handle v : topology().finite_vertex_handles()) {
      const Ball_2& ball = balls_[id(v)] = ball_place(v->point().motion(), time_);
      const Vector_2 p = places_[id(v)] = rounded(v, ball);
      error_ = std::max(error_, 0x1p-53 * size_of(p));
    }
    error_ += std::numeric_limits<double>::denorm_min();
  }

  // A bound for the error of each coordinate. Precondition: round_all was called.
  double error() const { return error_; }

  const Topology& topology() const { return kinetic_.triangulation(); }
  static Point_id id(Vertex_handle v) { return v->point().id(); }

  // The position with each coordinate rounded to nearest.
  Vector_2 place(Vertex_handle v) const {
    return places_.empty() ? rounded(v, ball_place(v->point().motion(), time_)) : places_[id(v)];
  }

  // The ids of the corners in ascending order.
  static std::array<Point_id, 3> ids(Face_handle face) {
    std::array<Point_id, 3> result = {id(face->vertex(0)), id(face->vertex(1)),
                                      id(face->vertex(2))};
    std::ranges::sort(result);
    return result;
  }

  static Point_2 query(const Vector_2& place) {
    typename Traits::Motion motion{};
    motion.position = place;
    return Point_2(motion, no_point);
  }

  bool has_area(Face_handle face) const {
    if (!places_.empty() && certain_orientation(place(face->vertex(0)), place(face->vertex(1)),
                                                place(face->vertex(2)), error_) == CGAL::POSITIVE) {
      return true;
    }
    return at_.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      face->vertex(2)->point()) == CGAL::LEFT_TURN;
  }

  // Whether the position is in the triangle or on its boundary. Precondition: has_area(face).
  bool contains(Face_handle face, const Vector_2& position) const {
    for (int i = 0; i < 3; ++i) {
      if (turn(face, i, position) == CGAL::NEGATIVE) return false;
    }
    return true;
  }

  // The triangle of the position; the default handle if there is none.
  Face_handle triangle_at(const Vector_2& position) const {
    if (topology().dimension() < 2) return Face_handle();
    const Location_2 location = Kinetic_queries_2<Traits>(kinetic_).locate(position);
    if (location.kind == Location_2::Kind::outside_convex_hull) return Face_handle();
    Face_handle start;
    for_each_face_at(topology(), kinetic_.vertex(location.points.front()), [&](Face_handle face) {
      if (topology().is_infinite(face)) return;
      const auto corners = ids(face);
      const auto is_corner = [&](Point_id p) { return std::ranges::count(corners, p) != 0; };
      if (std::ranges::all_of(location.points, is_corner)) start = face;
    });
    return least_around(start, position);
  }

  // The natural neighbors of a position, counterclockwise, from its triangle on.
  void find_neighbors(Face_handle triangle, const Vector_2& position,
                      std::vector<Vertex_handle>& result) {
    result.clear();
    stack_.clear();
    for (int i = 2; i >= 0; --i) stack_.emplace_back(triangle, i);
    while (!stack_.empty()) {
      const auto [face, i] = stack_.back();
      stack_.pop_back();
      const Face_handle next = face->neighbor(i);
      if (!topology().is_infinite(next) && is_in_circle(next, position)) {
        const int j = next->index(face);
        stack_.emplace_back(next, Topology::cw(j));
        stack_.emplace_back(next, Topology::ccw(j));
      } else {
        result.push_back(face->vertex(Topology::ccw(i)));
      }
    }
  }

 private:
  Vector_2 rounded(Vertex_handle v, const Ball_2& ball) const {
    const auto coordinate = [&](const Ball& known, Polynomial Trajectory_2::*axis) {
      if (const auto value = known.rounded()) return *value;
      const Trajectory_2 path = v->point().trajectory();
      return rounded_quotient(path.*axis, path.w, kinetic_.current_time());
    };
    const Vector_2 result = {coordinate(ball.x, &Trajectory_2::x),
                             coordinate(ball.y, &Trajectory_2::y)};
    KINETRI_PRECONDITION(
        size_of(result) <= largest_coordinate,
        "point " + std::to_string(id(v)) + " has a coordinate beyond 1e300 at the current time");
    return result;
  }

  // The side of the edge opposite corner i on which the position is: positive inside.
  Sign turn(Face_handle face, int i, const Vector_2& position) const {
    const Vertex_handle p = face->vertex(Topology::ccw(i));
    const Vertex_handle q = face->vertex(Topology::cw(i));
    if (!places_.empty()) {
      const Sign sign = certain_orientation(place(p), place(q), position, error_);
      if (sign != CGAL::ZERO) return sign;
      // Also decides zero, if coordinates have few bits, as those of pixels usually have.
      const Ball_2& from = balls_[id(p)];
      const Ball_2& to = balls_[id(q)];
      const Ball area = (to.x - from.x) * (Ball(position.y) - from.y) -
                        (to.y - from.y) * (Ball(position.x) - from.x);
      if (area.is_zero()) return CGAL::ZERO;
      if (area.is_nonzero()) return area.is_positive() ? CGAL::POSITIVE : CGAL::NEGATIVE;
    }
    return at_.orientation_2_object()(p->point(), q->point(), query(position));
  }

  // A sign that is certain at the time is also that just after it.
  bool is_in_circle(Face_handle face, const Vector_2& position) const {
    const Vertex_handle p = face->vertex(0);
    const Vertex_handle q = face->vertex(1);
    const Vertex_handle r = face->vertex(2);
    if (!places_.empty()) {
      const Sign sign =
          certain_side_of_oriented_circle(place(p), place(q), place(r), position, error_);
      if (sign != CGAL::ZERO) return sign == CGAL::POSITIVE;
    }
    return after_.side_of_oriented_circle_2_object()(p->point(), q->point(), r->point(),
                                                     query(position)) == CGAL::ON_POSITIVE_SIDE;
  }

  bool is_on_closed_edge(Face_handle face, int i, const Vector_2& position) const {
    if (turn(face, i, position) != CGAL::ZERO) return false;
    const Point_2& p = face->vertex(Topology::ccw(i))->point();
    const Point_2& q = face->vertex(Topology::cw(i))->point();
    const Point_2 here = query(position);
    const auto compare = at_.compare_xy_2_object();
    // All three are collinear.
    const auto from_p = compare(p, here);
    const auto to_q = compare(here, q);
    return from_p == CGAL::EQUAL || to_q == CGAL::EQUAL || from_p == to_q;
  }

  // Of the triangles with a positive area that contain the position, the one with the least ids.
  // Precondition: `start` contains it. Such triangles are connected across edges that contain it
  // (docs/MATH.md, section 10).
  Face_handle least_around(Face_handle start, const Vector_2& position) const {
    std::vector<Face_handle> faces = {start};
    std::unordered_set<Face_handle> seen = {start};
    Face_handle least;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const Face_handle face = faces[k];
      if (has_area(face) && (least == Face_handle() || ids(face) < ids(least))) least = face;
      for (int i = 0; i < 3; ++i) {
        const Face_handle next = face->neighbor(i);
        if (topology().is_infinite(next) || seen.contains(next)) continue;
        if (!is_on_closed_edge(face, i, position)) continue;
        seen.insert(next);
        faces.push_back(next);
      }
    }
    return least;
  }

  const Kinetic& kinetic_;
  Ball time_;
  typename Kinetic::Instantaneous_traits at_;
  typename Kinetic::Instantaneous_traits after_;
  std::vector<Vector_2> places_;  // by id; empty before round_all
  std::vector<Ball_2> balls_;     // the same with more digits
  double error_ = 0;
  std::vector<std::pair<Face_handle, int>> stack_;  // edges of find_neighbors
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_FIELD_PRESENT_H
