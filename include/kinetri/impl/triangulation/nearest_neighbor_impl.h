// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: nearest neighbors and the closest pair. Ball arithmetic decides
// most comparisons of distances, also of equal ones where no rounding is needed.
#ifndef KINETRI_IMPL_TRIANGULATION_NEAREST_NEIGHBOR_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_NEAREST_NEIGHBOR_IMPL_H

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/ball.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

namespace detail {

/// How the two numbers compare; none where that is not certain.
inline std::optional<Comparison_result> compare(const Ball& a, const Ball& b) {
  const Ball difference = a - b;
  if (difference.is_positive()) return CGAL::LARGER;
  if ((-difference).is_positive()) return CGAL::SMALLER;
  if (difference.is_zero()) return CGAL::EQUAL;
  return std::nullopt;
}

}  // namespace detail

template <KineticTraits_2 Traits>
detail::Ball_2 Kinetic_queries_2<Traits>::ball_place(Vertex_handle v, const detail::Ball& t) const {
  return detail::ball_place(centre(v->point().motion()), t);
}

// ---- nearest neighbors ----

template <KineticTraits_2 Traits>
detail::Approximate_place Kinetic_queries_2<Traits>::approximate_place(
    Vertex_handle v, const detail::Ball& t) const {
  if (!is_known_well(t)) return {};
  return detail::approximate_place(centre(v->point().motion()), t.high);
}

// The first of all_at(v). Where no neighbor of `v` coincides with it, no other point does.
template <KineticTraits_2 Traits>
Point_id Kinetic_queries_2<Traits>::smallest_id_at(Vertex_handle v, const detail::Ball& t) const {
  const detail::Approximate_place here = approximate_place(v, t);
  bool is_alone = true;
  for_each_neighbor(v, [&](Vertex_handle u) {
    is_alone = is_alone && detail::are_apart(here, approximate_place(u, t));
  });
  return is_alone ? id(v) : all_at(v).front();
}

template <KineticTraits_2 Traits>
Comparison_result Kinetic_queries_2<Traits>::compare_distance(Vertex_handle v, const Neighbor& a,
                                                              const Neighbor& b) const {
  const auto order = detail::compare(a.squared_distance, b.squared_distance);
  return order ? *order : compare_distance(v->point(), a.vertex->point(), b.vertex->point());
}

// A point nearest to `v` is alone, but for those that coincide with it or with `v`, in the circle
// whose diameter joins the two; so that a neighbor of `v` is there. Of points that coincide with
// `v` one is a neighbor.
template <KineticTraits_2 Traits>
std::optional<Point_id> Kinetic_queries_2<Traits>::nearest_neighbor(Vertex_handle v,
                                                                    const detail::Ball& t) const {
  std::vector<Neighbor> nearest;
  double limit = std::numeric_limits<double>::infinity();  // of the distance
  const detail::Ball_2 here = ball_place(v, t);
  const detail::Approximate_place near_here = approximate_place(v, t);
  for_each_neighbor(v, [&](Vertex_handle u) {
    if (detail::are_apart(near_here, approximate_place(u, t), limit)) return;
    const Neighbor neighbor = neighbor_at(here, u, t);
    const auto order =
        nearest.empty() ? CGAL::SMALLER : compare_distance(v, neighbor, nearest.front());
    if (order == CGAL::LARGER) return;
    if (order == CGAL::SMALLER) nearest.clear();
    nearest.push_back(neighbor);
    limit = length_bound(neighbor.squared_distance);
  });
  if (nearest.empty()) return std::nullopt;
  if (!nearest.front().squared_distance.is_nonzero() &&
      coincide(v->point(), nearest.front().vertex->point())) {
    const std::vector<Point_id> there = all_at(v);
    return there[there[0] == id(v) ? 1 : 0];
  }
  Point_id result = no_point;
  for (const Neighbor& u : nearest) result = std::min(result, smallest_id_at(u.vertex, t));
  return result;
}

template <KineticTraits_2 Traits>
std::optional<Point_id> Kinetic_queries_2<Traits>::nearest_neighbor(Point_id id) const requires
    HasNearestNeighbors<Traits> {
  return nearest_neighbor(vertex(id), detail::ball_of(time_));
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::nearest_neighbors() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  const detail::Ball t = detail::ball_of(time_);
  std::vector<Point_id> result(kinetic_.next_id(), no_point);
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    if (const auto nearest = nearest_neighbor(v, t)) result[id(v)] = *nearest;
  }
  return result;
}

// Fills `result` with the points nearest to `v`, in their order. The points within a circle about
// `v`, or on it, are connected with `v` by edges between them: so the nearest point that is not
// known yet is a neighbor of one that is. `seen[u]` is the last point for which `u` was seen.
template <KineticTraits_2 Traits>
void Kinetic_queries_2<Traits>::find_nearest(Vertex_handle v, const detail::Ball& t,
                                             std::vector<Point_id>& seen,
                                             std::span<Point_id> result) const {
  const detail::Ball_2 here = ball_place(v, t);
  std::vector<Neighbor> border;  // a heap: the nearest one is at the front
  const auto is_farther = [&](const Neighbor& a, const Neighbor& b) {
    return compare_distance(v, a, b) == CGAL::LARGER;
  };
  const auto add_neighbors = [&](Vertex_handle known) {
    for_each_neighbor(known, [&](Vertex_handle u) {
      if (std::exchange(seen[id(u)], id(v)) == id(v)) return;
      border.push_back(neighbor_at(here, u, t));
      std::ranges::push_heap(border, is_farther);
    });
  };
  seen[id(v)] = id(v);
  add_neighbors(v);
  std::vector<Point_id> equally_near;
  auto next = result.begin();
  while (next != result.end() && !border.empty()) {
    const Neighbor nearest = border.front();
    equally_near.clear();
    do {
      std::ranges::pop_heap(border, is_farther);
      const Vertex_handle u = border.back().vertex;
      border.pop_back();
      equally_near.push_back(id(u));
      add_neighbors(u);
    } while (!border.empty() && compare_distance(v, border.front(), nearest) == CGAL::EQUAL);
    std::ranges::sort(equally_near);
    for (const Point_id u : equally_near) {
      if (next != result.end()) *next++ = u;
    }
  }
}

template <KineticTraits_2 Traits>
std::vector<Point_id> Kinetic_queries_2<Traits>::nearest_neighbors(std::size_t k) const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  KINETRI_PRECONDITION(k <= no_point, "k is " + std::to_string(k) + "; expected less than 2^32");
  const detail::Ball t = detail::ball_of(time_);
  std::vector<Point_id> result(k * kinetic_.next_id(), no_point);
  std::vector<Point_id> seen(kinetic_.next_id(), no_point);
  for (const Vertex_handle v : topology().finite_vertex_handles()) {
    find_nearest(v, t, seen, std::span(result).subspan(k * id(v), k));
  }
  return result;
}

// ---- the closest pair ----

// Exactly.
template <KineticTraits_2 Traits>
Comparison_result Kinetic_queries_2<Traits>::compare_lengths(const Edge_ids& a,
                                                             const Edge_ids& b) const {
  // The denominator is positive.
  struct Fraction {
    Polynomial numerator;
    Polynomial denominator;
  };
  const auto squared_length = [&](const Edge_ids& edge) -> Fraction {
    const Trajectory_2 p = kinetic_.vertex(edge[0])->point().trajectory();
    const Trajectory_2 q = kinetic_.vertex(edge[1])->point().trajectory();
    const Polynomial x = p.x * q.w - q.x * p.w;
    const Polynomial y = p.y * q.w - q.y * p.w;
    const Polynomial w = p.w * q.w;
    return {x * x + y * y, w * w};
  };
  const Fraction of_a = squared_length(a);
  const Fraction of_b = squared_length(b);
  return sign_at(of_a.numerator * of_b.denominator - of_b.numerator * of_a.denominator, time_);
}

// Two points as near as any others are alone in the circle about them, so that they have an edge;
// but of points that coincide not every two have one.
template <KineticTraits_2 Traits>
std::optional<Edge_ids> Kinetic_queries_2<Traits>::closest_pair() const requires
    HasNearestNeighbors<Traits> {
  check_is_current();
  const detail::Ball t = detail::ball_of(time_);
  std::optional<Edge_ids> closest;
  detail::Ball least;
  double limit = std::numeric_limits<double>::infinity();  // of the length
  for (const auto& [face, i] : topology().finite_edges()) {
    const Vertex_handle v = face->vertex(Topology::cw(i));
    const Vertex_handle u = face->vertex(Topology::ccw(i));
    if (detail::are_apart(approximate_place(v, t), approximate_place(u, t), limit)) continue;
    const Edge_ids edge = edge_ids(id(v), id(u));
    const detail::Ball length = neighbor_at(ball_place(v, t), u, t).squared_distance;
    if (closest) {
      const auto known = detail::compare(length, least);
      const auto order = known ? *known : compare_lengths(edge, *closest);
      if (order == CGAL::LARGER || (order == CGAL::EQUAL && *closest < edge)) continue;
    }
    closest = edge;
    least = length;
    limit = length_bound(least);
  }
  if (!closest || least.is_nonzero() ||
      !coincide(kinetic_.vertex((*closest)[0])->point(), kinetic_.vertex((*closest)[1])->point())) {
    return closest;
  }
  const std::vector<Point_id> there = all_at(kinetic_.vertex((*closest)[0]));
  return Edge_ids{there[0], there[1]};
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_NEAREST_NEIGHBOR_IMPL_H
