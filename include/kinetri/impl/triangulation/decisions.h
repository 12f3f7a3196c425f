// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the failure of the certificate of an edge leads to, by exact predicates at its time.
#ifndef KINETRI_IMPL_TRIANGULATION_DECISIONS_H
#define KINETRI_IMPL_TRIANGULATION_DECISIONS_H

#include <algorithm>
#include <cstdint>

#include "kinetri/impl/triangulation/certification.h"
#include "kinetri/impl/triangulation/schedule.h"

namespace kinetri::detail {

enum class Action : std::uint8_t {
  flip,        ///< the edge is flipped
  hide,        ///< a vertex is hidden
  reschedule,  ///< the polynomial only touches zero: a new certificate
  postpone,    ///< another event of the same time must come first
  rebuild,     ///< flips alone are not enough at this time
};

/// Decides failures of edges. docs/MATH.md, sections 5 and 11, proves that these actions lead to
/// the triangulation just after the time.
template <class Traits>
class Kinetic_types<Traits>::Decisions {
 public:
  struct Decision {
    Action action = Action::flip;
    Vertex_handle hidden = {};  ///< which vertex to hide
    bool is_hull_flat = false;  ///< whether a hull triangle is flat and turns over
  };

  /// The certification must outlive this object.
  explicit Decisions(const Certification& certification)
      : certification_(certification),
        topology_(certification.topology()),
        triangulation_(topology_.triangulation()) {}

  /// What to do with an edge whose certificate fails at the time now(), which is within `bounds`.
  /// Precondition: not a coincidence.
  template <class Now>
  Decision decide(const Entry& failure, const Edge_with_mirror& edge, const Double_interval& bounds,
                  const Now& now) const {
    if constexpr (!is_periodic) {
      if (failure.kind == Entry_kind::hull_insert) {
        return decide_at_hull(edge, failure.changes_sign, now());
      }
    }
    if constexpr (is_weighted) {
      if (failure.kind == Entry_kind::flip && !topology_.are_weights_equal()) {
        return decide_inside(edge, failure.changes_sign, bounds, now);
      }
    }
    return {Action::flip};
  }

  /// The orientation of three points just after now(), which is within `bounds`.
  template <class Now>
  Sign turn(const Image_2& p, const Image_2& q, const Image_2& r, const Double_interval& bounds,
            const Now& now) const {
    const Sign certain = certification_.traits().certain_turn(p, q, r, bounds);
    if (certain != CGAL::ZERO) return certain;
    return after(now()).orientation_2_object()(p, q, r);
  }

 private:
  auto at(const Time& time) const {
    return certification_.traits().instantaneous_traits({time, Time_side::at});
  }
  auto after(const Time& time) const {
    return certification_.traits().instantaneous_traits({time, Time_side::after});
  }

  Decision decide_at_hull(const Edge_with_mirror& edge, bool changes_sign, const Time& now) const;
  template <class Now>
  Decision decide_inside(const Edge_with_mirror& edge, bool changes_sign,
                         const Double_interval& bounds, const Now& now) const;
  template <class Now>
  bool turns_left(Face_handle face, const Double_interval& bounds, const Now& now) const;
  bool is_touch(Face_handle face, const Time& now) const;
  bool do_corners_meet(Face_handle face, const Time& now) const;
  bool may_hide_a_turn(const Edge& hull_triangle, const Time& now) const;
  bool are_all_collinear(Face_handle face, const Time& now) const;
  bool can_insert_into_hull(const Edge& hull_triangle, const Time& now) const;
  Vertex_handle hidden_hull_vertex(Face_handle face, const Time& now) const;

  const Certification& certification_;
  const Topology& topology_;
  const Triangulation& triangulation_;
};

// The triangle at a hull edge is flat.
template <class Traits>
auto Kinetic_types<Traits>::Decisions::decide_at_hull(const Edge_with_mirror& edge,
                                                      bool changes_sign, const Time& now) const
    -> Decision {
  const Edge& triangle = topology_.hull_triangle(edge);
  const Face_handle face = triangle.first;
  if (may_hide_a_turn(triangle, now)) return {Action::rebuild};
  if (!changes_sign && is_touch(face, now)) {
    return {do_corners_meet(face, now) ? Action::rebuild : Action::reschedule};
  }
  if constexpr (is_weighted) {
    if (!topology_.are_weights_equal()) {
      const Vertex_handle hidden = hidden_hull_vertex(face, now);
      if (hidden != Vertex_handle()) return {Action::hide, hidden, true};
    }
  }
  const bool can_flip = !are_all_collinear(face, now) && can_insert_into_hull(triangle, now);
  return {can_flip ? Action::flip : Action::rebuild, {}, true};
}

// Four points whose weights differ are on one power circle. The edge is flipped if the
// triangulation stays embedded; else the end at which its quadrilateral is not convex is hidden, if
// it has degree 3; else another event of this time must come first.
//
//          c                      c
//        / | \                  /   \                                                      .
//       /  a  \      ==>       /     \          a is in the triangle b, c, d
//      / / | \ \              /       \                                                    .
//     d ---+--- b            d ------- b        (the edge is any of the three at a)
//
// The quadrilateral is strictly convex just after now if both turns are left turns. But in the
// plane, while several events of one time are executed, c and d may already have an edge.
//
// In a periodic box the faces that change, and those beside them, are examined: what is left turns
// left, and no face beside a change that has turned over loses its entries of this time.
template <class Traits>
template <class Now>
auto Kinetic_types<Traits>::Decisions::decide_inside(const Edge_with_mirror& edge,
                                                     bool changes_sign,
                                                     const Double_interval& bounds,
                                                     const Now& now) const -> Decision {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  const int at_a = Triangulation::cw(i);
  const int at_b = Triangulation::ccw(i);
  const Certificate_points about = certification_.points(edge);
  const auto [b, a, c, d] = about.quadruple();
  const auto beside = [&](Face_handle f, int side) {
    return turns_left(f->neighbor(side), bounds, now);
  };
  if constexpr (is_periodic) {
    if (!turns_left(face, bounds, now) || !turns_left(neighbor, bounds, now) ||
        !beside(face, at_a) || !beside(face, at_b) || !beside(neighbor, Triangulation::ccw(j)) ||
        !beside(neighbor, Triangulation::cw(j))) {
      return {Action::rebuild};
    }
  }
  if (!changes_sign) {
    const auto just_after = after(now());
    if (just_after.power_side_of_oriented_power_circle_2_object()(*b, *a, *c, *d) !=
        CGAL::ON_POSITIVE_SIDE) {
      // A touch. A triangle whose corners, lifted, are on one line now may turn over.
      const bool turns_over = !is_touch(face, now()) || !is_touch(neighbor, now());
      return {turns_over ? Action::rebuild : Action::reschedule};
    }
  }
  const Sign turn_at_a = turn(*d, *a, *c, bounds, now);
  const Sign turn_at_b = turn(*c, *b, *d, bounds, now);
  if (turn_at_a == CGAL::LEFT_TURN && turn_at_b == CGAL::LEFT_TURN) {
    bool is_there = false;
    if constexpr (!is_periodic) {
      is_there = triangulation_.is_edge(face->vertex(i), neighbor->vertex(j));
    }
    if (!is_there) return {Action::flip};
  }
  // Whether beyond both sides, which meet in an end of the edge, there is one face at that end.
  const auto have_third = [&](const Edge& left, const Edge& right) {
    const Edge beyond_left = topology_.with_mirror(left).there;
    const Edge beyond_right = topology_.with_mirror(right).there;
    if (beyond_left.first != beyond_right.first ||
        beyond_right.second != Triangulation::ccw(beyond_left.second)) {
      return false;
    }
    return !is_periodic || beside(beyond_left.first, Triangulation::cw(beyond_left.second));
  };
  if (turn_at_a == CGAL::RIGHT_TURN &&
      have_third(Edge(face, at_b), Edge(neighbor, Triangulation::cw(j)))) {
    return {Action::hide, face->vertex(at_a)};
  }
  if (turn_at_b == CGAL::RIGHT_TURN &&
      have_third(Edge(neighbor, Triangulation::ccw(j)), Edge(face, at_a))) {
    return {Action::hide, face->vertex(at_b)};
  }
  return {Action::postpone};
}

// Whether a triangle makes a left turn just after now.
template <class Traits>
template <class Now>
bool Kinetic_types<Traits>::Decisions::turns_left(Face_handle face, const Double_interval& bounds,
                                                  const Now& now) const {
  return turn(topology_.corner(face, 0), topology_.corner(face, 1), topology_.corner(face, 2),
              bounds, now) == CGAL::LEFT_TURN;
}

// Whether a triangle, flat at this time, makes a left turn just after it.
template <class Traits>
bool Kinetic_types<Traits>::Decisions::is_touch(Face_handle face, const Time& now) const {
  return after(now).orientation_2_object()(topology_.corner(face, 0), topology_.corner(face, 1),
                                           topology_.corner(face, 2)) == CGAL::LEFT_TURN;
}

// Whether two corners of a triangle coincide at this time. Only with different weights, since other
// coinciding points have been removed. They may exchange their order along a side of the hull on
// which all their neighbors are, so that no orientation changes its sign.
template <class Traits>
bool Kinetic_types<Traits>::Decisions::do_corners_meet(Face_handle face, const Time& time) const {
  if (topology_.are_weights_equal()) return false;
  const auto now = at(time);
  const auto meet = [&](int i, int j) {
    const Point_2& p = face->vertex(i)->point();
    const Point_2& q = face->vertex(j)->point();
    return now.compare_x_2_object()(p, q) == CGAL::EQUAL &&
           now.compare_y_2_object()(p, q) == CGAL::EQUAL;
  };
  return meet(0, 1) || meet(1, 2) || meet(2, 0);
}

// Whether the triangle at a hull edge and one beside it are flat at this time and one of the two
// does not turn over: then triangles behind it may turn over although no certificate of a hull edge
// fails.
template <class Traits>
bool Kinetic_types<Traits>::Decisions::may_hide_a_turn(const Edge& hull_triangle,
                                                       const Time& time) const {
  const auto now = at(time);
  const auto& [face, i] = hull_triangle;
  for (const int j : {Triangulation::cw(i), Triangulation::ccw(i)}) {
    const Face_handle beside = face->neighbor(j);
    if (!triangulation_.is_infinite(beside) &&
        now.orientation_2_object()(beside->vertex(0)->point(), beside->vertex(1)->point(),
                                   beside->vertex(2)->point()) == CGAL::COLLINEAR &&
        (is_touch(face, time) || is_touch(beside, time))) {
      return true;
    }
  }
  return false;
}

// Whether all points lie on the line of a triangle that is flat at this time. Usually the first
// point that is tested does not.
template <class Traits>
bool Kinetic_types<Traits>::Decisions::are_all_collinear(Face_handle face, const Time& time) const {
  const auto now = at(time);
  return std::ranges::all_of(triangulation_.finite_vertex_handles(), [&](Vertex_handle v) {
    return face->has_vertex(v) ||
           now.orientation_2_object()(face->vertex(0)->point(), face->vertex(1)->point(),
                                      v->point()) == CGAL::COLLINEAR;
  });
}

// Whether the triangle at a hull edge, flat at this time, can be removed: its apex lies between the
// ends of the edge and is not yet a hull vertex. Otherwise several hull triangles become flat
// together, possibly all triangles.
template <class Traits>
bool Kinetic_types<Traits>::Decisions::can_insert_into_hull(const Edge& hull_triangle,
                                                            const Time& time) const {
  const auto& [face, i] = hull_triangle;
  const Vertex_handle apex = face->vertex(i);
  if (triangulation_.is_edge(apex, triangulation_.infinite_vertex())) return false;
  return at(time).collinear_are_strictly_ordered_along_line_2_object()(
      face->vertex(Triangulation::cw(i))->point(), apex->point(),
      face->vertex(Triangulation::ccw(i))->point());
}

// The vertex between the two hull edges of a triangle that is flat at this time, if the segment of
// its neighbors hides it.
//
//         v
//       /   \                                  v reaches the segment from outside and is above
//      a --- b     ==>     a ----- b           it: it belongs to no other triangle
//       \   /               \     /
//         c                    c
//
template <class Traits>
auto Kinetic_types<Traits>::Decisions::hidden_hull_vertex(Face_handle face, const Time& time) const
    -> Vertex_handle {
  const auto now = at(time);
  for (int i = 0; i < 3; ++i) {
    const int left = Triangulation::ccw(i);
    const int right = Triangulation::cw(i);
    if (triangulation_.is_infinite(face->neighbor(left)) &&
        triangulation_.is_infinite(face->neighbor(right)) &&
        !triangulation_.is_infinite(face->neighbor(i)) &&
        now.collinear_are_strictly_ordered_along_line_2_object()(
            face->vertex(left)->point(), face->vertex(i)->point(), face->vertex(right)->point())) {
      return face->vertex(i);
    }
  }
  return {};
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_DECISIONS_H
