// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sides and corners of a Voronoi cell, as an intersection of half planes, one for each other
// point: the positions that are at least as near to the point as to that one, or have at most as
// much power. docs/MATH.md, section 10.
#ifndef KINETRI_SRC_TRIANGULATION_VORONOI_SIDES_H
#define KINETRI_SRC_TRIANGULATION_VORONOI_SIDES_H

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "triangulation/triangulation_at_time.h"

namespace kinetri::detail {

/// The cell of one point: the points across its sides, as in Voronoi_cell_2, and its corners, each
/// given by two points with the same distance, or power, as the point.
template <KineticTraits_2 Traits>
class Voronoi_sides {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Vertex = typename At_time::Vertex;
  using Name = typename At_time::Name;

  /// The triangulation must outlive this object.
  Voronoi_sides(const At_time& at, Vertex v) : at_(at), v_(v) { find(); }

  /// The points across the sides.
  const std::vector<Vertex>& across() const { return sides_.across; }
  /// Whether there is no position in the cell.
  bool is_empty() const { return sides_.is_empty; }
  /// The corners of a bounded cell: at(a, b) of each, as in cell().
  template <class Center>
  auto corners(Center center_at) const {
    std::vector<std::invoke_result_t<Center, Vertex, Vertex>> result;
    for (const auto& [a, b] : sides_.corners) result.push_back(center_at(a, b));
    return result;
  }

  /// The cell. `center_at(a, b)` gives the position of at.center(v, a, b), and `position` that on a
  /// trajectory.
  template <class Position, class Center, class Evaluate>
  Voronoi_cell_2<Position> cell(Center center_at, Evaluate position) const {
    const auto& [across, unused, is_bounded, is_empty] = sides_;
    Voronoi_cell_2<Position> result;
    result.is_empty = is_empty;
    for (const Vertex u : across) result.neighbors.push_back(at_.id(u));
    result.vertices = this->corners(center_at);
    if (is_bounded || across.empty()) return result;
    // The first side comes from infinity, and the last one goes there.
    result.rays = {position(at_.turned_vector(v_, across.front(), false)),
                   position(at_.turned_vector(v_, across.back(), true))};
    return result;
  }

 private:
  struct Sides {
    std::vector<Vertex> across = {};
    std::vector<std::array<Vertex, 2>> corners = {};
    bool is_bounded = false;
    bool is_empty = false;
  };
  // The part of the boundary of a half plane that is in others: a segment, or one position. The
  // points whose half planes end it at its right and its left end, seen from the point; none at
  // infinity.
  struct Part_of_line {
    Vertex right;
    Vertex left;
    bool is_one_position = false;
  };
  static constexpr bool is_weighted = At_time::is_weighted;

  // The side of the bisector with `u` with respect to the half plane of `w`: positive outside, zero
  // on its boundary, negative inside. With weights: `w`, lifted, is below the line of the other
  // two. Precondition: the three points are collinear, and `u` and `w` do not coincide with the
  // point.
  Sign beyond_line(Vertex u, Vertex w) const {
    if constexpr (is_weighted) {
      return at_.side_of_segment(v_, u, w);
    } else {
      if (at_.coincide(u, w)) return CGAL::ZERO;
      return at_.is_strictly_between(v_, w, u) ? CGAL::POSITIVE : CGAL::NEGATIVE;
    }
  }

  // Whether `w` has, along the bisector with `u`, the same distance (power) as the point and `u`.
  bool is_on_line(Vertex u, Vertex w) const {
    if (at_.coincide(w, v_)) return at_.are_alike(w, v_);
    return at_.orientation(v_, u, w) == CGAL::COLLINEAR && beyond_line(u, w) == CGAL::ZERO;
  }

  // ---- which half planes ----

  // Adds half planes until all neighbors have been examined of the points that have the same
  // distance (power) as the point in the whole intersection. Then the intersection is the cell: at
  // its inner positions one of these points is nearest, since no neighbor is nearer.
  void find() {
    std::vector<Vertex> candidates = first_candidates();
    std::set<Name> seen = {at_.name(v_)};
    std::set<Name> expanded = {at_.name(v_)};
    for (const Vertex u : candidates) seen.insert(at_.name(u));
    for (;;) {
      sides_ = intersection(candidates);
      const std::size_t before = candidates.size();
      for (std::size_t i = 0; i < before && !sides_.is_empty; ++i) {
        const Vertex u = candidates[i];
        if (expanded.contains(at_.name(u)) || !is_on_all_sides(u)) continue;
        expanded.insert(at_.name(u));
        at_.for_each_neighbor(u, [&](Vertex w) {
          if (seen.insert(at_.name(w)).second) candidates.push_back(w);
        });
      }
      if (candidates.size() == before) break;
    }
    auto& [across, corners, is_bounded, is_empty] = sides_;
    for (Vertex& u : across) u = named_across(u);
    if (!is_bounded || across.empty()) return;
    const auto first = std::ranges::min_element(
        across, [&](Vertex a, Vertex b) { return at_.is_nearer(v_, a, b); });
    std::rotate(corners.begin(), corners.begin() + (first - across.begin()), corners.end());
    std::rotate(across.begin(), first, across.end());
  }

  // The neighbors; for a hidden point the vertices of the triangle, or edge, that hides it: since
  // it is not below that, it is nowhere nearer than all of these.
  std::vector<Vertex> first_candidates() const {
    if (at_.is_hidden(v_)) return at_.corners_over(v_);
    std::vector<Vertex> result;
    at_.for_each_neighbor(v_, [&](Vertex u) { result.push_back(u); });
    return result;
  }

  // Whether `u` has the same distance (power) as the point in the whole intersection.
  bool is_on_all_sides(Vertex u) const {
    if (at_.are_alike(u, v_)) return true;
    if constexpr (is_weighted) {
      const auto& [across, corners, is_bounded, is_empty] = sides_;
      if (at_.coincide(u, v_)) return false;
      if (across.empty() && !corners.empty()) {
        const auto& [a, b] = corners.front();
        return at_.side_of_circle(v_, a, b, u) == CGAL::ON_ORIENTED_BOUNDARY;
      }
      if (across.size() == 2 && is_on_line(across[0], across[1])) return is_on_line(across[0], u);
    }
    return false;
  }

  // The neighbor across the side of `u`: of the points with the same bisector in the same direction
  // the farthest, then that of the smallest id. At a position just beyond the side, it is nearer
  // than the others.
  Vertex named_across(Vertex u) const {
    if constexpr (!is_weighted) return at_.vertex(at_.all_at(u).front());
    Vertex result = u;
    for (const Vertex w : at_.connected(u, [&](Vertex other) { return is_on_line(u, other); })) {
      if (at_.coincide(w, v_) || at_.is_strictly_between(u, v_, w)) continue;
      const auto order = at_.compare_distance(v_, w, result);
      if (order == CGAL::LARGER || (order == CGAL::EQUAL && at_.name(w) < at_.name(result)))
        result = w;
    }
    return result;
  }

  // ---- the intersection of half planes ----

  Sides intersection(const std::vector<Vertex>& candidates) const {
    std::vector<Vertex> elsewhere;
    for (const Vertex u : candidates) {
      if (!at_.coincide(u, v_)) {
        elsewhere.push_back(u);
      } else if (at_.is_lighter(v_, u)) {
        return {.is_bounded = true, .is_empty = true};
      }
    }
    if (elsewhere.empty()) return {};
    // The position of a point without weight is inside all half planes, on the boundary of none.
    const bool is_inside = !is_weighted || std::ranges::all_of(elsewhere, [&](Vertex u) {
      return at_.compare_power(v_, v_, u) == CGAL::SMALLER;
    });
    std::vector<Vertex> sorted = by_direction(elsewhere);
    return is_inside ? sides_around(std::move(sorted)) : sides_of_lines(sorted);
  }

  // Sorted counterclockwise from the nearest one on; of those in one direction only that with the
  // least half plane, then the nearest, then the smallest id.
  std::vector<Vertex> by_direction(const std::vector<Vertex>& candidates) const {
    const auto is_nearer = [&](Vertex a, Vertex b) { return at_.is_nearer(v_, a, b); };
    const Vertex nearest = *std::ranges::min_element(candidates, is_nearer);
    // From the direction of the nearest one on, the first half turn, or the second.
    const auto half = [&](Vertex u) {
      const auto side = at_.orientation(v_, nearest, u);
      if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN ? 0 : 1;
      return at_.is_strictly_between(nearest, v_, u) ? 1 : 0;
    };
    std::vector<std::pair<int, Vertex>> sorted;
    for (const Vertex u : candidates) sorted.emplace_back(half(u), u);
    std::ranges::sort(sorted, [&](const auto& a, const auto& b) {
      if (a.first != b.first) return a.first < b.first;
      const auto side = at_.orientation(v_, a.second, b.second);
      if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN;
      const Sign beyond = is_weighted ? beyond_line(b.second, a.second) : CGAL::ZERO;
      return beyond != CGAL::ZERO ? beyond == CGAL::POSITIVE : is_nearer(a.second, b.second);
    });
    const auto repeated =
        std::unique(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
          return a.first == b.first && at_.orientation(v_, a.second, b.second) == CGAL::COLLINEAR;
        });
    sorted.erase(repeated, sorted.end());
    std::vector<Vertex> result;
    for (const auto& [unused, u] : sorted) result.push_back(u);
    return result;
  }

  // The intersection, if the position of the point is inside all half planes: Graham's scan by
  // direction removes those that bound nothing, or only a point: of three neighbors the middle one,
  // if it is not inside the oriented circle through the point and the other two (if these are pi or
  // more apart, it always is: each is less than pi from the next). It begins with one that has a
  // side: the first one after a gap of at least pi, or else, without weights, the nearest.
  Sides sides_around(std::vector<Vertex> candidates) const {
    Sides result;
    result.is_bounded = true;
    const auto rotate_to = [&](std::size_t i) {
      std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(i),
                  candidates.end());
    };
    const auto is_left_turn = [&](Vertex a, Vertex b) {
      return at_.orientation(v_, a, b) == CGAL::LEFT_TURN;
    };
    for (std::size_t i = 0; i < candidates.size() && result.is_bounded; ++i) {
      const std::size_t next = (i + 1) % candidates.size();
      if (is_left_turn(candidates[i], candidates[next])) continue;
      rotate_to(next);
      result.is_bounded = false;
    }
    if (is_weighted && result.is_bounded) {
      std::size_t first = 0;
      for (;; ++first) {
        const auto part = part_of_line(candidates[first], candidates);
        if (part && !part->is_one_position) break;
      }
      rotate_to(first);
    }
    if (result.is_bounded) candidates.push_back(candidates.front());
    const auto is_redundant = [&](Vertex a, Vertex b, Vertex c) {
      return at_.side_of_circle(v_, a, c, b) != CGAL::ON_POSITIVE_SIDE;
    };
    auto& across = result.across;
    for (const Vertex u : candidates) {
      while (across.size() > 1 && is_redundant(*(across.end() - 2), across.back(), u)) {
        across.pop_back();
      }
      across.push_back(u);
    }
    if (result.is_bounded) across.pop_back();
    for (std::size_t i = 0; i < across.size(); ++i) {
      const Vertex next = across[(i + 1) % across.size()];
      // False at infinity, and between the two sides of a strip.
      if (is_left_turn(across[i], next)) result.corners.push_back({across[i], next});
    }
    return result;
  }

  // The intersection in general: of the boundary of each half plane the part that is in all others.
  // Precondition: the candidates are sorted by direction, and there is one.
  Sides sides_of_lines(const std::vector<Vertex>& candidates) const {
    std::vector<std::pair<Vertex, Part_of_line>> parts;
    std::optional<std::array<Vertex, 2>> position;
    for (const Vertex u : candidates) {
      const auto part = part_of_line(u, candidates);
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
    const auto from_infinity =
        std::ranges::find_if(parts, [](const auto& part) { return part.second.right == Vertex(); });
    if (from_infinity != parts.end()) {
      result.is_bounded = false;
      std::rotate(parts.begin(), from_infinity, parts.end());
    }
    for (const auto& [u, part] : parts) {
      result.across.push_back(u);
      if (part.left != Vertex()) result.corners.push_back({u, part.left});
    }
    return result;
  }

  // The part of the bisector with `u` that is in the half planes of the others, if there is one. A
  // half plane to the left bounds it on the left. Of two such half planes, the second one is
  // tighter if the end of the first one is outside of it, which an in-circle test decides.
  std::optional<Part_of_line> part_of_line(Vertex u, const std::vector<Vertex>& others) const {
    const auto determinant = [&](Vertex a, Vertex b) { return at_.side_of_circle(u, a, b, v_); };
    Part_of_line result;
    auto& [right, left, is_one_position] = result;
    for (const Vertex w : others) {
      if (w == u) continue;
      const auto turn = at_.orientation(v_, u, w);
      if (turn == CGAL::COLLINEAR) {
        if (beyond_line(u, w) == CGAL::POSITIVE) return std::nullopt;
      } else if (turn == CGAL::LEFT_TURN) {
        if (left == Vertex() || determinant(left, w) == CGAL::ON_NEGATIVE_SIDE) left = w;
      } else {
        if (right == Vertex() || determinant(right, w) == CGAL::ON_POSITIVE_SIDE) right = w;
      }
    }
    if (left == Vertex() || right == Vertex()) return result;
    const auto order = determinant(left, right);
    if (order == CGAL::ON_NEGATIVE_SIDE) return std::nullopt;
    is_one_position = order == CGAL::ON_ORIENTED_BOUNDARY;
    return result;
  }

  const At_time& at_;
  Vertex v_;
  Sides sides_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_VORONOI_SIDES_H
