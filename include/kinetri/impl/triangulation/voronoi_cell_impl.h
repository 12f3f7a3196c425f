// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: Voronoi cells.
#ifndef KINETRI_IMPL_TRIANGULATION_VORONOI_CELL_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_VORONOI_CELL_IMPL_H

#include "kinetri/impl/base/check.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

// The vector from `v` to `u`, turned to the left or to the right.
template <KineticTraits_2 Traits>
Trajectory_2 Kinetic_queries_2<Traits>::ray(Vertex_handle v, Vertex_handle u, bool to_left) const {
  const Trajectory_2 here = v->point().trajectory();
  const Trajectory_2 there = u->point().trajectory();
  const Polynomial x = there.x * here.w - here.x * there.w;
  const Polynomial y = there.y * here.w - here.y * there.w;
  return {to_left ? -y : y, to_left ? x : -x, here.w * there.w};
}

// The centre of the circle, or power circle, through `v` and two others.
template <KineticTraits_2 Traits>
Trajectory_2 Kinetic_queries_2<Traits>::center(Vertex_handle v, Vertex_handle a,
                                               Vertex_handle b) const {
  if constexpr (is_weighted) {
    return at_.construct_weighted_circumcenter_2_object()(v->point(), a->point(), b->point())
        .trajectory();
  } else {
    return at_.construct_circumcenter_2_object()(v->point(), a->point(), b->point()).trajectory();
  }
}

// `center_at(a, b)` gives the place of center(v, a, b), and `position` the place on a trajectory.
template <KineticTraits_2 Traits>
template <class Position, class Center, class Evaluate>
Voronoi_cell_2<Position> Kinetic_queries_2<Traits>::cell(Vertex_handle v, Center center_at,
                                                         Evaluate position) const {
  const Sides sides = this->sides(v);
  Voronoi_cell_2<Position> result;
  result.is_empty = sides.is_empty;
  for (const Vertex_handle u : sides.across) result.neighbors.push_back(id(u));
  for (const auto& [a, b] : sides.corners) result.vertices.push_back(center_at(a, b));
  if (sides.is_bounded || sides.across.empty()) return result;
  // The first side comes from infinity, and the last one goes there.
  result.rays = {position(ray(v, sides.across.front(), false)),
                 position(ray(v, sides.across.back(), true))};
  return result;
}

template <KineticTraits_2 Traits>
Voronoi_cell_2<Exact_position_2> Kinetic_queries_2<Traits>::voronoi_cell(Point_id id) const {
  const Vertex_handle v = vertex(id);
  time_.tight_interval();  // finds out whether it is a binary64 number
  KINETRI_PRECONDITION(time_.is_known_rational(),
                       "at a time that is not known to be rational a Voronoi vertex has no exact "
                       "coordinates; call rounded_voronoi_cell");
  const Rational t = time_.rational();
  const auto position = [&](const Trajectory_2& path) {
    const Rational w = path.w(t);
    return Exact_position_2{path.x(t) / w, path.y(t) / w};
  };
  const auto center_at = [&](Vertex_handle a, Vertex_handle b) {
    return position(center(v, a, b));
  };
  return cell<Exact_position_2>(v, center_at, position);
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_VORONOI_CELL_IMPL_H
