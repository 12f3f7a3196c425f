// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points nearest to each point at one time, and the closest pair.
#ifndef KINETRI_SRC_TRIANGULATION_NEAREST_POINTS_H
#define KINETRI_SRC_TRIANGULATION_NEAREST_POINTS_H

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "triangulation/ball_positions.h"

namespace kinetri::detail {

/// Searches at one time, of points or, in a periodic box, of images. Invariant in the plane: seen_,
/// once it is made, has for each point the last point whose search reached it.
template <KineticTraits_2 Traits>
class Nearest_points {
 public:
  using At_time = Triangulation_at_time<Traits>;
  using Vertex = typename At_time::Vertex;
  using Name = typename At_time::Name;
  using Edge_name = typename At_time::Edge_name;
  using Neighbor = typename Ball_positions<Traits>::Neighbor;

  /// The triangulation must outlive this object.
  explicit Nearest_points(const At_time& at) : at_(at), balls_(at) {}

  /// The smallest name of the points nearest to that of `v`, other than that; none if there is no
  /// other point. In a periodic box these are images, those of the point of `v` too.
  // The circle whose diameter joins `v` and a nearest point contains no others, except points that
  // coincide with one of the two; so a neighbor of `v` is at that position. If points coincide with
  // `v`, one of them is a neighbor.
  std::optional<Name> nearest_to(const Vertex& v) const {
    std::vector<Neighbor> nearest;
    double limit = std::numeric_limits<double>::infinity();  // of the distance
    const Ball_2 here = balls_.position(v);
    const Approximate_place near_here = balls_.approximate(v);
    at_.for_each_neighbor(v, [&](Vertex u) {
      if (are_apart(near_here, balls_.approximate(u), limit)) return;
      const Neighbor neighbor = balls_.neighbor(here, u);
      const auto order =
          nearest.empty() ? CGAL::SMALLER : balls_.compare_distance(v, neighbor, nearest.front());
      if (order == CGAL::LARGER) return;
      if (order == CGAL::SMALLER) nearest.clear();
      nearest.push_back(neighbor);
      limit = length_bound(neighbor.squared_distance);
    });
    std::optional<Name> result;
    const auto& hidden = at_.names_hidden_by(v);
    if (!hidden.empty()) result = hidden.front();
    if (!nearest.empty() && !nearest.front().squared_distance.is_nonzero() &&
        at_.coincide(v, nearest.front().vertex)) {
      // What another vertex hides has a greater id than the point of that vertex.
      const std::vector<Name> there = at_.all_at(v);
      const Name& other = there[there[0] == at_.name(v) ? 1 : 0];
      return result ? std::min(*result, other) : other;
    }
    if (!hidden.empty()) return result;
    for (const Neighbor& u : nearest) {
      const Name there = smallest_name_at(u.vertex);
      if (!result || there < *result) result = there;
    }
    return result;
  }

  /// The smallest name of the points at the position of `v`, with its weight.
  // If no neighbor coincides with `v`, no other vertex does. With weights, one that a triangle
  // hides beside the time may.
  Name smallest_name_at(const Vertex& v) const {
    const Approximate_place here = balls_.approximate(v);
    bool is_alone = true;
    at_.for_each_neighbor(
        v, [&](Vertex u) { is_alone = is_alone && are_apart(here, balls_.approximate(u)); });
    at_.for_each_hidden_near(v,
                             [&](const Vertex& h) { is_alone = is_alone && !at_.are_alike(h, v); });
    return is_alone ? at_.name(v) : at_.all_at(v).front();
  }

  /// The k points nearest to each point, other than that, nearest first: those of the point `id`
  /// from k * id on; no_name if there are no more. In a periodic box k images, those of the point
  /// too. Points that coincide for a while are searched for once, together.
  std::vector<Name> nearest_to_each(std::size_t k) {
    std::vector<Name> result(k * at_.kinetic().next_id(), At_time::no_name);
    const auto row = [&](Point_id id) { return std::span(result).subspan(k * id, k); };
    std::vector<Name> own;  // the points of a vertex, if there are several
    std::vector<Name> nearest;
    for (const auto handle : at_.triangulation().finite_vertex_handles()) {
      const Vertex v = {handle};
      const auto& hidden = at_.names_hidden_by(v);
      if (hidden.empty()) {
        find_nearest(v, {}, row(at_.id(v)));
        continue;
      }
      own.assign(1, at_.name(v));
      own.insert(own.end(), hidden.begin(), hidden.end());
      nearest.assign(k + 1, At_time::no_name);
      find_nearest(v, own, nearest);
      for (const Name& one : own) {
        auto near = nearest.begin();
        for (Name& next : row(At_time::id_of(one))) {
          if (*near == one) ++near;
          next = At_time::seen_from(one, *near++);
        }
      }
    }
    return result;
  }

  /// The closest pair, in a periodic box of images, also of one point; of several the first in the
  /// order of names of edges.
  // No other point is in the circle whose diameter joins a closest pair, so the two have an edge;
  // but of several coinciding points not every two have one, and those without a vertex have none.
  std::optional<Edge_name> closest_pair() const {
    std::optional<Edge_name> closest = at_.first_coincident_pair();
    Ball least;
    double limit = closest ? 0 : std::numeric_limits<double>::infinity();  // of the length
    for (const auto& finite_edge : at_.triangulation().finite_edges()) {
      const auto [v, u] = at_.ends(finite_edge);
      if (are_apart(balls_.approximate(v), balls_.approximate(u), limit)) continue;
      const Edge_name edge = At_time::pair_of(at_.name(v), at_.name(u));
      const Ball length = balls_.neighbor(balls_.position(v), u).squared_distance;
      if (closest) {
        const auto known = compare(length, least);
        const auto order = known ? *known : compare_lengths(edge, *closest);
        if (order == CGAL::LARGER || (order == CGAL::EQUAL && *closest < edge)) continue;
      }
      closest = edge;
      least = length;
      limit = length_bound(least);
    }
    if (!closest || least.is_nonzero()) return closest;
    const auto [first, second] = at_.ends_of(*closest);
    if (!at_.coincide(first, second)) return closest;
    const std::vector<Name> there = at_.all_at(first);
    if (there.size() < 2) return closest;
    return std::min(*closest, At_time::pair_of(there[0], there[1]));
  }

 private:
  // Fills `result` with points nearest to `v`, nearest first, as long as there are points: all of
  // `own`, which are points of the vertex, and those of other vertices.
  //
  // Edges connect all points within or on a circle about `v` with `v`: so the next nearest point is
  // a neighbor of one that is known.
  void find_nearest(const Vertex& v, std::span<const Name> own, std::span<Name> result) {
    if constexpr (At_time::is_periodic) {
      seen_.clear();
    } else {
      seen_.resize(at_.kinetic().next_id(), no_point);
    }
    const Ball_2 here = balls_.position(v);
    std::vector<Neighbor> border;  // a heap: the nearest one is at the front
    const auto is_farther = [&](const Neighbor& a, const Neighbor& b) {
      return balls_.compare_distance(v, a, b) == CGAL::LARGER;
    };
    const auto add_neighbors = [&](const Vertex& known) {
      at_.for_each_neighbor(known, [&](const Vertex& u) {
        if (!is_new(u, v)) return;
        border.push_back(balls_.neighbor(here, u));
        std::ranges::push_heap(border, is_farther);
      });
    };
    is_new(v, v);
    add_neighbors(v);
    std::vector<Name> equally_near(own.begin(), own.end());
    const auto take_nearest = [&] {
      std::ranges::pop_heap(border, is_farther);
      const Vertex u = border.back().vertex;
      border.pop_back();
      equally_near.push_back(at_.name(u));
      const auto& hidden = at_.names_hidden_by(u);
      equally_near.insert(equally_near.end(), hidden.begin(), hidden.end());
      add_neighbors(u);
    };
    if (!own.empty()) {
      while (!border.empty() && at_.coincide(v, border.front().vertex)) take_nearest();
    }
    auto next = result.begin();
    for (;;) {
      std::ranges::sort(equally_near);
      for (const Name& u : equally_near) {
        if (next != result.end()) *next++ = u;
      }
      if (next == result.end() || border.empty()) return;
      equally_near.clear();
      const Neighbor nearest = border.front();
      do {
        take_nearest();
      } while (!border.empty() &&
               balls_.compare_distance(v, border.front(), nearest) == CGAL::EQUAL);
    }
  }

  // Whether the search from `v` has not reached `u` before; from now on it has.
  bool is_new(const Vertex& u, const Vertex& v) {
    if constexpr (At_time::is_periodic) {
      return seen_.insert(at_.name(u)).second;
    } else {
      return std::exchange(seen_[at_.id(u)], at_.id(v)) != at_.id(v);
    }
  }

  // Exactly.
  Comparison_result compare_lengths(const Edge_name& a, const Edge_name& b) const {
    // The denominator is positive.
    struct Fraction {
      Polynomial numerator;
      Polynomial denominator;
    };
    const auto squared_length = [&](const Edge_name& edge) -> Fraction {
      const auto [v, u] = at_.ends_of(edge);
      const Trajectory_2 d = at_.vector(v, u);
      return {d.x * d.x + d.y * d.y, d.w * d.w};
    };
    const Fraction of_a = squared_length(a);
    const Fraction of_b = squared_length(b);
    return sign_at(of_a.numerator * of_b.denominator - of_b.numerator * of_a.denominator,
                   at_.time());
  }

  const At_time& at_;
  Ball_positions<Traits> balls_;
  std::conditional_t<At_time::is_periodic, std::set<Name>, std::vector<Point_id>> seen_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_NEAREST_POINTS_H
