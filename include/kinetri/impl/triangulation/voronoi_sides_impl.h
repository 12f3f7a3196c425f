// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: the sides and corners of a Voronoi cell, as intersections of
// half planes. Of each other point there is one, of the positions that are at least as near to v as
// to that point, or have no more power. docs/MATH.md, section 10.
#ifndef KINETRI_IMPL_TRIANGULATION_VORONOI_SIDES_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_VORONOI_SIDES_IMPL_H

#include <algorithm>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_left_turn(Vertex_handle p, Vertex_handle q,
                                             Vertex_handle r) const {
  return at_.orientation_2_object()(p->point(), q->point(), r->point()) == CGAL::LEFT_TURN;
}

// Where the bisector of `v` and `u` lies to the half plane of `w`: positive outside of it, zero on
// its boundary, negative inside. With weights: `w`, lifted, is below the line of the other two.
// Precondition: the three are collinear, and `u` and `w` do not coincide with `v`.
template <KineticTraits_2 Traits>
Sign Kinetic_queries_2<Traits>::beyond_line(Vertex_handle v, Vertex_handle u,
                                            Vertex_handle w) const {
  if constexpr (is_weighted) {
    return at_.power_side_of_oriented_power_circle_2_object()(v->point(), u->point(), w->point());
  } else {
    if (coincide(u->point(), w->point())) return CGAL::ZERO;
    return is_strictly_between(v->point(), w->point(), u->point()) ? CGAL::POSITIVE
                                                                   : CGAL::NEGATIVE;
  }
}

// Whether `w` has all along the bisector of `v` and `u` the same distance, or power, as these.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_on_line(Vertex_handle v, Vertex_handle u,
                                           Vertex_handle w) const {
  if (coincide(w->point(), v->point())) return are_alike(w->point(), v->point());
  return at_.orientation_2_object()(v->point(), u->point(), w->point()) == CGAL::COLLINEAR &&
         beyond_line(v, u, w) == CGAL::ZERO;
}

// ---- which half planes ----

// The cell of `v`. Half planes are taken until they are enough: if no point has a neighbor that has
// not been looked at, of those points that have the same distance (power) as `v` in all of the
// intersection. Then all of that is the cell: of its inner positions, one of these points is
// nearest, since none of its neighbors is nearer.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::sides(Vertex_handle v) const -> Sides {
  std::vector<Vertex_handle> candidates = first_candidates(v);
  std::unordered_set<Point_id> seen = {id(v)};
  std::unordered_set<Point_id> expanded = {id(v)};
  for (const Vertex_handle u : candidates) seen.insert(id(u));
  for (;;) {
    Sides result = intersection(v, candidates);
    const std::size_t before = candidates.size();
    for (std::size_t i = 0; i < before && !result.is_empty; ++i) {
      const Vertex_handle u = candidates[i];
      if (expanded.contains(id(u)) || !is_on_all_of(result, v, u)) continue;
      expanded.insert(id(u));
      for_each_neighbor(u, [&](Vertex_handle w) {
        if (seen.insert(id(w)).second) candidates.push_back(w);
      });
    }
    if (candidates.size() > before) continue;
    for (Vertex_handle& u : result.across) u = named_across(v, u);
    const auto is_before = [&](Vertex_handle a, Vertex_handle b) {
      const auto order = compare_distance(v->point(), a->point(), b->point());
      return order != CGAL::EQUAL ? order == CGAL::SMALLER : id(a) < id(b);
    };
    if (result.is_bounded && !result.across.empty()) {
      const auto first = std::ranges::min_element(result.across, is_before);
      const auto corner = result.corners.begin() + (first - result.across.begin());
      std::rotate(result.corners.begin(), corner, result.corners.end());
      std::rotate(result.across.begin(), first, result.across.end());
    }
    return result;
  }
}

// The neighbors of `v`; of a hidden point the vertices of the triangle, or edge, that hides it: it
// is not below that, so that it is nowhere nearer than all of these.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::first_candidates(Vertex_handle v) const
    -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result;
  if constexpr (is_weighted) {
    if (v->is_hidden()) {
      if (topology().dimension() < 1) return {topology().finite_vertex()};
      for (int i = 0; i <= topology().dimension(); ++i) result.push_back(v->face()->vertex(i));
      return result;
    }
  }
  for_each_neighbor(v, [&](Vertex_handle u) { result.push_back(u); });
  return result;
}

// Whether `u` has the same distance (power) as `v` in the whole cell.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_on_all_of(const Sides& sides, Vertex_handle v,
                                             Vertex_handle u) const {
  if (are_alike(u->point(), v->point())) return true;
  if constexpr (is_weighted) {
    const auto& [across, corners, is_bounded, is_empty] = sides;
    if (coincide(u->point(), v->point())) return false;
    if (across.empty() && !corners.empty()) {
      const auto& [a, b] = corners.front();
      return at_.side_of_oriented_circle_2_object()(v->point(), a->point(), b->point(),
                                                    u->point()) == CGAL::ON_ORIENTED_BOUNDARY;
    }
    if (across.size() == 2 && is_on_line(v, across[0], across[1])) {
      return is_on_line(v, across[0], u);
    }
  }
  return false;
}

// The point that is named as that across the side of `v` and `u`: of those with the same bisector
// in the same direction the farthest, the smallest id. In a place beyond the side, and near to it,
// that one is nearer than the others.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::named_across(Vertex_handle v, Vertex_handle u) const
    -> Vertex_handle {
  if constexpr (!is_weighted) return kinetic_.vertex(all_at(u).front());
  Vertex_handle result = u;
  for (const Vertex_handle w :
       connected_or_hidden(u, [&](Vertex_handle other) { return is_on_line(v, u, other); })) {
    if (coincide(w->point(), v->point()) ||
        is_strictly_between(u->point(), v->point(), w->point())) {
      continue;
    }
    const auto order = compare_distance(v->point(), w->point(), result->point());
    if (order == CGAL::LARGER || (order == CGAL::EQUAL && id(w) < id(result))) result = w;
  }
  return result;
}

// ---- the intersection of half planes ----

// Of those of the candidates.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::intersection(Vertex_handle v,
                                             const std::vector<Vertex_handle>& candidates) const
    -> Sides {
  std::vector<Vertex_handle> elsewhere;
  for (const Vertex_handle u : candidates) {
    if (!coincide(u->point(), v->point())) {
      elsewhere.push_back(u);
    } else if (is_lighter(v->point(), u->point())) {
      return {.is_bounded = true, .is_empty = true};
    }
  }
  if (elsewhere.empty()) return {};
  const bool is_inside = is_inside_own_cell(v, elsewhere);
  std::vector<Vertex_handle> sorted = by_direction(v, elsewhere);
  return is_inside ? sides_around(v, std::move(sorted)) : sides_of_lines(v, sorted);
}

// Whether the place of `v` is inside all half planes, on the boundary of none. Always without
// weights.
template <KineticTraits_2 Traits>
bool Kinetic_queries_2<Traits>::is_inside_own_cell(
    Vertex_handle v, const std::vector<Vertex_handle>& candidates) const {
  if constexpr (!is_weighted) return true;
  return std::ranges::all_of(candidates, [&](Vertex_handle u) {
    return compare_power(at_, v->point(), v->point(), u->point()) == CGAL::SMALLER;
  });
}

// Sorted counterclockwise from the nearest one on; of those in one direction only the one with the
// least half plane, of those the nearest, of those the smallest id.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::by_direction(Vertex_handle v,
                                             const std::vector<Vertex_handle>& candidates) const
    -> std::vector<Vertex_handle> {
  const auto is_nearer = [&](Vertex_handle a, Vertex_handle b) {
    const auto order = compare_distance(v->point(), a->point(), b->point());
    return order != CGAL::EQUAL ? order == CGAL::SMALLER : id(a) < id(b);
  };
  const Vertex_handle nearest = *std::ranges::min_element(candidates, is_nearer);
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
  for (const Vertex_handle u : candidates) sorted.emplace_back(half(u), u);
  std::ranges::sort(sorted, [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const auto side = turn(a.second, b.second);
    if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN;
    const Sign beyond = is_weighted ? beyond_line(v, b.second, a.second) : CGAL::ZERO;
    return beyond != CGAL::ZERO ? beyond == CGAL::POSITIVE : is_nearer(a.second, b.second);
  });
  const auto repeated =
      std::unique(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
        return a.first == b.first && turn(a.second, b.second) == CGAL::COLLINEAR;
      });
  sorted.erase(repeated, sorted.end());
  std::vector<Vertex_handle> result;
  for (const auto& [unused, u] : sorted) result.push_back(u);
  return result;
}

// The intersection, where the place of `v` is inside all half planes: a scan as Graham's, by
// direction, takes those away that bound nothing, or only a point: of three neighbors the middle
// one, if it is not inside the oriented circle through `v` and the other two (where these are half
// a turn apart or more, it always is: each is less than half a turn from the next). It begins with
// one that has a side: the first one after a gap of half a turn, or else, without weights, the
// nearest.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::sides_around(Vertex_handle v,
                                             std::vector<Vertex_handle> candidates) const -> Sides {
  Sides result;
  result.is_bounded = true;
  const auto rotate_to = [&](std::size_t i) {
    std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(i),
                candidates.end());
  };
  for (std::size_t i = 0; i < candidates.size() && result.is_bounded; ++i) {
    const std::size_t next = (i + 1) % candidates.size();
    if (is_left_turn(v, candidates[i], candidates[next])) continue;
    rotate_to(next);
    result.is_bounded = false;
  }
  if (is_weighted && result.is_bounded) {
    std::size_t first = 0;
    for (;; ++first) {
      const auto part = part_of_line(v, candidates[first], candidates);
      if (part && !part->is_one_position) break;
    }
    rotate_to(first);
  }
  if (result.is_bounded) candidates.push_back(candidates.front());
  const auto is_redundant = [&](Vertex_handle a, Vertex_handle b, Vertex_handle c) {
    return at_.side_of_oriented_circle_2_object()(v->point(), a->point(), c->point(), b->point()) !=
           CGAL::ON_POSITIVE_SIDE;
  };
  auto& across = result.across;
  for (const Vertex_handle u : candidates) {
    while (across.size() > 1 && is_redundant(*(across.end() - 2), across.back(), u)) {
      across.pop_back();
    }
    across.push_back(u);
  }
  if (result.is_bounded) across.pop_back();
  for (std::size_t i = 0; i < across.size(); ++i) {
    const Vertex_handle next = across[(i + 1) % across.size()];
    // Not so at infinity, nor between the two sides of a strip.
    if (is_left_turn(v, across[i], next)) result.corners.push_back({across[i], next});
  }
  return result;
}

// The intersection, whatever the half planes are: of the boundary of each the part that is in all
// others. Precondition: the candidates are sorted by direction, and there is one.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::sides_of_lines(Vertex_handle v,
                                               const std::vector<Vertex_handle>& candidates) const
    -> Sides {
  std::vector<std::pair<Vertex_handle, Part_of_line>> parts;
  std::optional<std::array<Vertex_handle, 2>> position;
  for (const Vertex_handle u : candidates) {
    const auto part = part_of_line(v, u, candidates);
    if (part && part->is_one_position) position = {u, part->left};
    if (part && !part->is_one_position) parts.emplace_back(u, *part);
  }
  Sides result;
  result.is_bounded = true;
  if (parts.empty()) {
    if (position) result.corners.push_back(*position);
    result.is_empty = !position;
    return result;
  }
  const auto from_infinity = std::ranges::find_if(
      parts, [](const auto& part) { return part.second.right == Vertex_handle(); });
  if (from_infinity != parts.end()) {
    result.is_bounded = false;
    std::rotate(parts.begin(), from_infinity, parts.end());
  }
  for (const auto& [u, part] : parts) {
    result.across.push_back(u);
    if (part.left != Vertex_handle()) result.corners.push_back({u, part.left});
  }
  return result;
}

// The part of the bisector of `v` and `u` that is in the half planes of the others; none if there
// is nothing. A half plane to the left bounds it on the left. Of two such half planes, the second
// one ends more if the end that the first one makes is outside of it, of which the determinant of
// the three, an in-circle test, tells.
template <KineticTraits_2 Traits>
auto Kinetic_queries_2<Traits>::part_of_line(Vertex_handle v, Vertex_handle u,
                                             const std::vector<Vertex_handle>& others) const
    -> std::optional<Part_of_line> {
  const auto determinant = [&](Vertex_handle a, Vertex_handle b) {
    return at_.side_of_oriented_circle_2_object()(u->point(), a->point(), b->point(), v->point());
  };
  Part_of_line result;
  auto& [right, left, is_one_position] = result;
  for (const Vertex_handle w : others) {
    if (w == u) continue;
    const auto turn = at_.orientation_2_object()(v->point(), u->point(), w->point());
    if (turn == CGAL::COLLINEAR) {
      if (beyond_line(v, u, w) == CGAL::POSITIVE) return std::nullopt;
    } else if (turn == CGAL::LEFT_TURN) {
      if (left == Vertex_handle() || determinant(left, w) == CGAL::ON_NEGATIVE_SIDE) left = w;
    } else {
      if (right == Vertex_handle() || determinant(right, w) == CGAL::ON_POSITIVE_SIDE) right = w;
    }
  }
  if (left == Vertex_handle() || right == Vertex_handle()) return result;
  const auto order = determinant(left, right);
  if (order == CGAL::ON_NEGATIVE_SIDE) return std::nullopt;
  is_one_position = order == CGAL::ON_ORIENTED_BOUNDARY;
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_TRIANGULATION_VORONOI_SIDES_IMPL_H
