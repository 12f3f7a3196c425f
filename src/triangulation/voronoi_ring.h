// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Voronoi cell of a point without weight, rounded, from the ring of its neighbors in ball
// arithmetic.
#ifndef KINETRI_SRC_TRIANGULATION_VORONOI_RING_H
#define KINETRI_SRC_TRIANGULATION_VORONOI_RING_H

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/triangulation/queries_2.h"
#include "triangulation/ball_positions.h"

namespace kinetri::detail {

/// The vector from a point to the center of the circle through it and two neighbors. None if these
/// are not certainly in counterclockwise order.
template <class Neighbor>
std::optional<Ball_2> circumcenter(const Neighbor& first, const Neighbor& second) {
  const auto& [vertex_a, a, squared_a] = first;
  const auto& [vertex_b, b, squared_b] = second;
  const Ball turn = a.x * b.y - a.y * b.x;
  if (!turn.is_positive()) return std::nullopt;
  const Ball factor = Ball(1) / twice(turn);
  return Ball_2{(squared_a * b.y - squared_b * a.y) * factor,
                (squared_b * a.x - squared_a * b.x) * factor};
}

/// Zero if and only if the three are on one circle through the point, or all four are collinear.
template <class Neighbor>
Ball in_circle(const Neighbor& a, const Neighbor& b, const Neighbor& c) {
  const auto turn = [](const Ball_2& p, const Ball_2& q) { return p.x * q.y - p.y * q.x; };
  return a.squared_distance * turn(b.vector, c.vector) +
         b.squared_distance * turn(c.vector, a.vector) +
         c.squared_distance * turn(a.vector, b.vector);
}

/// The ring: the finite neighbors of a vertex counterclockwise, from infinity to infinity if it
/// is on the hull. Precondition: the dimension is 2, and the points have no weights.
template <KineticTraits_2 Traits>
class Voronoi_ring {
 public:
  using Triangulation = typename Triangulation_at_time<Traits>::Triangulation;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Face_handle = typename Triangulation::Face_handle;
  using Neighbor = typename Ball_positions<Traits>::Neighbor;

  /// The positions must outlive this object. Prefetches.
  Voronoi_ring(const Ball_positions<Traits>& balls, Vertex_handle v)
      : balls_(balls), at_(balls.at()), v_(v) {
    entries_.reserve(10);
    find_entries();
    here_ = balls_.position(v_);
  }

  /// The cell, if each triangle at the point certainly turns left at the time, so that no two of
  /// these points coincide and no two neighbors are in one direction, and if the neighbors
  /// certainly coincide with no other point; else none. The sides are those of positive length; by
  /// continuity none is reversed.
  std::optional<Voronoi_cell_2<Vector_2>> cell() {
    const std::size_t n = entries_.size();
    const std::size_t first = find_neighbors();
    if (!are_alone()) return std::nullopt;
    // The entry `i` after the first, where `i` is at most n.
    const auto at = [&](std::size_t i) -> Entry& {
      const std::size_t k = first + i;
      return entries_[k < n ? k : k - n];
    };
    for (std::size_t i = 0; i < (is_bounded_ ? n : n - 1); ++i) {
      const auto center = circumcenter(at(i).neighbor, at(i + 1).neighbor);
      if (!center) return std::nullopt;
      at(i).center = *center;
    }

    Voronoi_cell_2<Vector_2> result;
    result.neighbors.reserve(n);
    result.vertices.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Entry& u = at(i);
      // The nearest neighbor has a side, and so do neighbors across unbounded sides.
      const bool is_inner = i > 0 && (is_bounded_ || i + 1 < n);
      if (is_inner && has_no_length(at(i - 1), u, at(i + 1))) continue;
      result.neighbors.push_back(at_.id(u.neighbor.vertex));
      if (!is_bounded_ && i + 1 == n) continue;
      result.vertices.push_back(
          balls_.rounded_center(v_, here_, u.neighbor, at(i + 1).neighbor, u.center));
    }
    if (is_bounded_) return result;
    const auto turned = [&](const Neighbor& u, bool to_left) {
      const auto& [x, y] = u.vector;
      const auto vector = rounded(to_left ? Ball_2{-y, x} : Ball_2{y, -x});
      return vector ? *vector : at_.rounded_position(at_.turned_vector(v_, u.vertex, to_left));
    };
    result.rays = {turned(at(0).neighbor, false), turned(at(n - 1).neighbor, true)};
    return result;
  }

 private:
  // A neighbor, and the faces beyond the edges to the neighbors before and after it.
  struct Entry {
    Neighbor neighbor;
    Approximate_place place;
    Face_handle before;
    Face_handle beyond;
    Ball_2 center;  // the vector to that of the circle through it and the next one
  };

  void find_entries() {
    std::optional<std::size_t> infinite;
    Face_handle previous;
    for_each_face_at(at_.triangulation(), v_, [&](Face_handle face, int at_v) {
      const Vertex_handle u = face->vertex(Triangulation::ccw(at_v));
      const Face_handle beyond = face->neighbor(at_v);
      if (at_.triangulation().is_infinite(u)) {
        infinite = entries_.size();
      } else {
        entries_.push_back({{u, {}, {}}, {}, previous, beyond, {}});
      }
      previous = beyond;
      prefetch(u);
      prefetch(beyond);
    });
    is_bounded_ = !infinite;
    // The infinite vertex has no entry.
    if (infinite != 0) entries_.front().before = previous;
    if (!infinite) return;
    std::rotate(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(*infinite),
                entries_.end());
  }

  // Computes the positions of the neighbors. Returns the first side: that of the nearest neighbor,
  // of equally near ones the smallest id, or the side that comes from infinity.
  std::size_t find_neighbors() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      Neighbor& u = entries_[i].neighbor;
      u = balls_.neighbor(here_, u.vertex);
      entries_[i].place = balls_.approximate(u.vertex);
      if (!is_bounded_ || i == 0) continue;
      const Neighbor& nearest = entries_[first].neighbor;
      const auto order = balls_.compare_distance(v_, u, nearest);
      if (order == CGAL::SMALLER ||
          (order == CGAL::EQUAL && at_.id(u.vertex) < at_.id(nearest.vertex))) {
        first = i;
      }
    }
    return first;
  }

  // Whether each point of the ring is certainly apart from its neighbors that are neither `v` nor
  // next to it in the ring. Walks around all points of the ring at once, in both directions, since
  // each step waits for memory.
  bool are_alone() {
    std::vector<std::pair<const Entry*, Vertex_handle>> pairs;
    pairs.reserve(6 * entries_.size());
    const auto step = [&](const Entry& u, Face_handle& face, bool is_clockwise) {
      const int at_u = index_in(face, u.neighbor.vertex);
      const int ccw = Triangulation::ccw(at_u);
      const int cw = Triangulation::cw(at_u);
      const Vertex_handle w = face->vertex(is_clockwise ? ccw : cw);
      face = face->neighbor(is_clockwise ? cw : ccw);
      prefetch(w);
      prefetch(face);
      if (!at_.triangulation().is_infinite(w)) pairs.emplace_back(&u, w);
    };
    for (bool is_done = false; !is_done;) {
      is_done = true;
      for (Entry& u : entries_) {
        if (u.beyond == u.before) continue;
        step(u, u.beyond, true);
        if (u.beyond == u.before) continue;
        step(u, u.before, false);
        is_done = is_done && u.beyond == u.before;
      }
    }
    return std::ranges::all_of(pairs, [&](const auto& pair) {
      return are_apart(pair.first->place, balls_.approximate(pair.second));
    });
  }

  // Whether the side between the two circumcenters of `b`, with the neighbors before and after it,
  // has no length. Precondition: a and b, and b and c, certainly turn left around the point.
  bool has_no_length(const Entry& a, const Entry& b, const Entry& c) const {
    if ((b.center.x - a.center.x).is_nonzero() || (b.center.y - a.center.y).is_nonzero()) {
      return false;
    }
    if (in_circle(a.neighbor, b.neighbor, c.neighbor).is_zero()) return true;
    return at_.side_of_circle(v_, a.neighbor.vertex, c.neighbor.vertex, b.neighbor.vertex) ==
           CGAL::ON_ORIENTED_BOUNDARY;
  }

  const Ball_positions<Traits>& balls_;
  const Triangulation_at_time<Traits>& at_;
  Vertex_handle v_;
  Ball_2 here_;
  std::vector<Entry> entries_;
  bool is_bounded_ = false;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_VORONOI_RING_H
