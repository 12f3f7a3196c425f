// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: Voronoi cells.
#ifndef KINETRI_TRIANGULATION_DETAIL_VORONOI_CELL_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_VORONOI_CELL_IMPL_H

#include <algorithm>
#include <utility>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_left_turn(Vertex_handle p, Vertex_handle q,
                                             Vertex_handle r) const {
  return at_.orientation_2_object()(p->point(), q->point(), r->point()) == CGAL::LEFT_TURN;
}

// The points that may have a side in the cell of `v`: those with an edge to it, or to a point that
// coincides with it. A side longer than zero is on the boundary of an empty circle through its two
// places and no other, and the points in that circle are connected. Sorted counterclockwise from
// the nearest one on; of those in one direction only the nearest, of those the smallest id.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::by_direction(Vertex_handle v) const -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result;
  for (const Point_id there : all_at(v)) {
    for_each_neighbor(kinetic_.vertex(there), [&](Vertex_handle u) {
      if (!coincide(u->point(), v->point())) result.push_back(u);
    });
  }
  if (result.empty()) return result;
  const auto is_nearer = [&](Vertex_handle a, Vertex_handle b) {
    const auto order = compare_distance(v->point(), a->point(), b->point());
    return order != CGAL::EQUAL ? order == CGAL::SMALLER : id(a) < id(b);
  };
  const Vertex_handle nearest = *std::ranges::min_element(result, is_nearer);
  const auto turn = [&](Vertex_handle a, Vertex_handle b) {
    return at_.orientation_2_object()(v->point(), a->point(), b->point());
  };
  // From the direction of the nearest one on, the first half turn, or the second.
  const auto half = [&](Vertex_handle u) {
    const auto side = turn(nearest, u);
    if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN ? 0 : 1;
    return is_strictly_between(nearest->point(), v->point(), u->point()) ? 1 : 0;
  };
  std::vector<std::pair<int, Vertex_handle>> sorted;
  for (const Vertex_handle u : result) sorted.emplace_back(half(u), u);
  std::ranges::sort(sorted, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const auto side = turn(a.second, b.second);
    return side != CGAL::COLLINEAR ? side == CGAL::LEFT_TURN : is_nearer(a.second, b.second);
  });
  const auto repeated =
      std::unique(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
        return a.first == b.first && turn(a.second, b.second) == CGAL::COLLINEAR;
      });
  sorted.erase(repeated, sorted.end());
  result.clear();
  for (const auto& [unused, u] : sorted) result.push_back(u);
  return result;
}

// The intersection of the half planes that the bisectors bound: all of them contain the place of
// `v`, so that a scan as Graham's, by direction, takes those away that bound nothing, or only a
// point: of three neighbors the middle one, if it is not inside the oriented circle through `v` and
// the other two (where these are half a turn apart or more, it always is: each is less than half a
// turn from the next). The nearest point has a side; and so has the first one after a gap of half a
// turn.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::sides(Vertex_handle v) const -> Sides {
  Sides result;
  std::vector<Vertex_handle> candidates = by_direction(v);
  if (candidates.empty()) return result;
  result.is_bounded = true;
  for (std::size_t i = 0; i < candidates.size() && result.is_bounded; ++i) {
    const std::size_t next = (i + 1) % candidates.size();
    if (is_left_turn(v, candidates[i], candidates[next])) continue;
    std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(next),
                candidates.end());
    result.is_bounded = false;
  }
  if (result.is_bounded) candidates.push_back(candidates.front());
  const auto is_redundant = [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
    return at_.side_of_oriented_circle_2_object()(v->point(), a->point(), c->point(), b->point()) !=
           CGAL::ON_POSITIVE_SIDE;
  };
  for (const Vertex_handle u : candidates) {
    auto& across = result.across;
    while (across.size() > 1 && is_redundant(*(across.end() - 2), across.back(), u)) {
      across.pop_back();
    }
    across.push_back(u);
  }
  if (result.is_bounded) result.across.pop_back();
  return result;
}

// The vector from `v` to `u`, turned to the left or to the right.
template <KineticTraits_2 Traits>
Trajectory_2 Kinetic_queries_2<Traits>::ray(Vertex_handle v, Vertex_handle u, bool to_left) const {
  const Trajectory_2 here = v->point().trajectory();
  const Trajectory_2 there = u->point().trajectory();
  const Polynomial x = there.x * here.w - here.x * there.w;
  const Polynomial y = there.y * here.w - here.y * there.w;
  return {to_left ? -y : y, to_left ? x : -x, here.w * there.w};
}

// `center(a, b)` gives the centre of the circle through the places of `v` and of two others, and
// `position` the place on a trajectory.
template <KineticTraits_2 Traits>
template <class Position, class Center, class Evaluate>
Voronoi_cell_2<Position> Kinetic_queries_2<Traits>::cell(Vertex_handle v, Center center,
                                                         Evaluate position) const {
  const Sides sides = this->sides(v);
  const std::size_t n = sides.across.size();
  Voronoi_cell_2<Position> result;
  for (const Vertex_handle u : sides.across) result.neighbors.push_back(all_at(u).front());
  for (std::size_t i = 0; i < (sides.is_bounded ? n : n - std::min<std::size_t>(n, 1)); ++i) {
    const Vertex_handle next = sides.across[(i + 1) % n];
    if (!is_left_turn(v, sides.across[i], next)) continue;  // the two sides of a strip
    result.vertices.push_back(center(sides.across[i], next));
  }
  if (sides.is_bounded || n == 0) return result;
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
  const auto center = [&](Vertex_handle a, Vertex_handle b) {
    return position(
        at_.construct_circumcenter_2_object()(v->point(), a->point(), b->point()).trajectory());
  };
  return cell<Exact_position_2>(v, center, position);
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_VORONOI_CELL_IMPL_H
