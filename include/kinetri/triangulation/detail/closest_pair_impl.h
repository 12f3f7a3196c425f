// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Kinetic_queries_2: the closest pair.
#ifndef KINETRI_TRIANGULATION_DETAIL_CLOSEST_PAIR_IMPL_H
#define KINETRI_TRIANGULATION_DETAIL_CLOSEST_PAIR_IMPL_H

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/base/check.h"
#include "kinetri/triangulation/queries_2.h"

namespace kinetri {

/// The squared lengths of edges at the time: enclosed by binary64 numbers, and compared exactly.
template <KineticTraits_2 Traits>
class Kinetic_queries_2<Traits>::Lengths {
 public:
  using Interval = CGAL::Interval_nt<>;

  explicit Lengths(const Kinetic_queries_2& queries) : queries_(queries) {
    const Double_interval time = queries.time_.tight_interval();
    const bool is_finite = std::isfinite(time.lower) && std::isfinite(time.upper);
    const Interval t = is_finite ? Interval(time.lower, time.upper) : Interval(0);
    places_.resize(queries.kinetic_.next_id());
    for (const Vertex_handle v : queries.topology().finite_vertex_handles()) {
      const Trajectory_2 path = v->point().trajectory();
      if (is_finite) places_[id(v)] = {value(path.x, path.w, t), value(path.y, path.w, t)};
    }
  }

  /// Contains the squared length of the edge between the two points.
  Double_interval bounds(const Edge_ids& edge) const {
    const auto& [x, y] = places_[edge[0]];
    const auto& [u, v] = places_[edge[1]];
    Double_interval result = {0, std::numeric_limits<double>::infinity()};
    if (!(x && y && u && v)) return result;
    const Interval length = CGAL::square(*x - *u) + CGAL::square(*y - *v);
    if (length.inf() > 0 && length.sup() <= std::numeric_limits<double>::max()) {
      result.lower = length.inf();
    }
    if (length.sup() >= 0) result.upper = length.sup();
    return result;
  }

  Comparison_result compare(const Edge_ids& a, const Edge_ids& b) const {
    const Fraction of_a = squared_length(a);
    const Fraction of_b = squared_length(b);
    return sign_at(of_a.numerator * of_b.denominator - of_b.numerator * of_a.denominator,
                   queries_.time_);
  }

  bool is_zero(const Edge_ids& edge) const {
    return queries_.coincide(queries_.kinetic_.vertex(edge[0])->point(),
                             queries_.kinetic_.vertex(edge[1])->point());
  }

 private:
  /// The denominator is positive.
  struct Fraction {
    Polynomial numerator;
    Polynomial denominator;
  };

  // None where a number is too large for binary64.
  static std::optional<Interval> value(const Polynomial& p, const Polynomial& w,
                                       const Interval& t) {
    KINETRI_ASSERT(w.degree() == 0, "the trajectory of an input point is a polynomial");
    const auto is_finite = [](const Interval& i) {
      return std::isfinite(i.inf()) && std::isfinite(i.sup());
    };
    Interval sum = 0;
    for (int i = p.degree(); i >= 0; --i) {
      const Double_interval term = to_interval(Rational(p[i], w[0]));
      if (!std::isfinite(term.lower) || !std::isfinite(term.upper)) return std::nullopt;
      sum = sum * t + Interval(term.lower, term.upper);
      if (!is_finite(sum)) return std::nullopt;
    }
    return sum;
  }

  Fraction squared_length(const Edge_ids& edge) const {
    const Trajectory_2 p = queries_.kinetic_.vertex(edge[0])->point().trajectory();
    const Trajectory_2 q = queries_.kinetic_.vertex(edge[1])->point().trajectory();
    const Polynomial x = p.x * q.w - q.x * p.w;
    const Polynomial y = p.y * q.w - q.y * p.w;
    const Polynomial w = p.w * q.w;
    return {x * x + y * y, w * w};
  }

  const Kinetic_queries_2& queries_;
  std::vector<std::pair<std::optional<Interval>, std::optional<Interval>>> places_;  // by id
};

// Two points as near as any others are alone in the circle about them, so that they have an edge;
// but of points that coincide not every two have one.
template <KineticTraits_2 Traits>
std::optional<Edge_ids> Kinetic_queries_2<Traits>::closest_pair() const {
  check_is_current();
  const Lengths lengths(*this);
  std::vector<std::pair<Edge_ids, Double_interval>> edges;
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& [face, i] : topology().finite_edges()) {
    const Edge_ids edge =
        edge_ids(id(face->vertex(Topology::cw(i))), id(face->vertex(Topology::ccw(i))));
    const Double_interval bounds = lengths.bounds(edge);
    limit = std::min(limit, bounds.upper);
    edges.emplace_back(edge, bounds);
  }
  std::optional<Edge_ids> closest;
  for (const auto& [edge, bounds] : edges) {
    if (bounds.lower > limit) continue;
    const auto order = closest ? lengths.compare(edge, *closest) : CGAL::SMALLER;
    if (order == CGAL::SMALLER || (order == CGAL::EQUAL && edge < *closest)) closest = edge;
  }
  if (!closest || !lengths.is_zero(*closest)) return closest;
  const std::vector<Point_id> there = all_at(kinetic_.vertex((*closest)[0]));
  return Edge_ids{there[0], there[1]};
}

}  // namespace kinetri

#endif  // KINETRI_TRIANGULATION_DETAIL_CLOSEST_PAIR_IMPL_H
