// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lives of edges by the triangulation as it is after each step, and exact lengths of ridges.
#ifndef KINETRI_TEST_OBSERVERS_STEPPED_RUN_H
#define KINETRI_TEST_OBSERVERS_STEPPED_RUN_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "kinetri/observers/neighbor_lives.h"
#include "support/brute_force_simulator.h"
#include "support/disc_runs.h"
#include "support/query_oracle.h"

namespace kinetri::test {

/// The points opposite of an edge, sorted; no_point at the hull.
using Opposite = std::array<Point_id, 2>;

template <class Traits>
struct Snapshot {
  Algebraic_number time;
  std::map<Edge_ids, Opposite> edges;
  std::map<Point_id, typename Traits::Motion> motions;
};

template <class Traits>
Snapshot<Traits> snapshot_of(const Kinetic_triangulation_2<Traits>& kinetic) {
  Snapshot<Traits> result{kinetic.current_time(), {}, {}};
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (!kinetic.contains(id)) continue;
    result.motions.emplace(id, kinetic.motion(id));
    const Point_id shown = kinetic.vertex(id)->point().id();
    if (shown != id) result.edges.emplace(Edge_ids{shown, id}, Opposite{no_point, no_point});
  }
  const auto& triangulation = kinetic.triangulation();
  for (const Edge_ids& edge : kinetic.finite_edge_ids()) {
    result.edges.emplace(edge, Opposite{no_point, no_point});
  }
  if (triangulation.dimension() < 2) return result;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    const auto id = [&](auto vertex) {
      return triangulation.is_infinite(vertex) ? no_point : vertex->point().id();
    };
    Opposite opposite = {id(face->vertex(i)), id(triangulation.mirror_vertex(face, i))};
    std::ranges::sort(opposite);
    result.edges[edge_ids(id(face->vertex(triangulation.cw(i))),
                          id(face->vertex(triangulation.ccw(i))))] = opposite;
  }
  return result;
}

/// Whether a quotient of polynomials, excess / square, is negative at a root of the excess, as a
/// limit. The square is never negative.
inline bool is_negative_at(const Real_root& root, const Polynomial& excess,
                           const Polynomial& square) {
  if (sign_at(square, root.value) != CGAL::ZERO) return false;
  const auto roots = real_roots(square);
  const auto same = std::ranges::find(roots, root.value, &Real_root::value);
  if (same->multiplicity != root.multiplicity) return false;  // the limit is zero, or infinite
  const auto next = first_root_after(excess, root.value);
  const Algebraic_number end =
      next ? next->value : Algebraic_number(root.value.interval().upper + 1);
  return excess.sign_at(simplest_between(root.value, end)) == CGAL::NEGATIVE;
}

/// Whether the ridge of the edge is as long as `length` at some time of the closed interval.
template <class Traits>
bool reaches(const Snapshot<Traits>& now, const Edge_ids& edge, double length,
             const Algebraic_number& until) {
  const Opposite& opposite = now.edges.at(edge);
  if (opposite[1] == no_point) return true;
  // The excess of the squared length, times a square; and the latter.
  const auto excess_and_square = [&](const Rational& t) {
    const auto place = [&](Point_id id) { return place_at(now.motions.at(id), t); };
    const auto weight = [&](Point_id id) { return weight_at(now.motions.at(id), t); };
    // The center less the place of the first end, times a denominator; and that.
    const auto center = [&](Point_id id) {
      const auto q = place(edge[1]) - place(edge[0]);
      const auto r = place(id) - place(edge[0]);
      const Rational of_q = q.squared_length() - weight(edge[1]) + weight(edge[0]);
      const Rational of_r = r.squared_length() - weight(id) + weight(edge[0]);
      return std::tuple(Rational(r.y() * of_q - q.y() * of_r),
                        Rational(q.x() * of_r - r.x() * of_q),
                        Rational(2 * CGAL::determinant(q, r)));
    };
    const auto [x1, y1, d1] = center(opposite[0]);
    const auto [x2, y2, d2] = center(opposite[1]);
    const Rational x = x1 * d2 - x2 * d1;
    const Rational y = y1 * d2 - y2 * d1;
    const Rational threshold = to_rational(length) * d1 * d2;
    return std::pair(Rational(x * x + y * y - threshold * threshold), Rational(d1 * d1 * d2 * d2));
  };
  const Polynomial excess =
      interpolate(12, [&](const Rational& t) { return excess_and_square(t).first; });
  const Polynomial square =
      interpolate(12, [&](const Rational& t) { return excess_and_square(t).second; });
  if (excess.is_zero()) return true;
  if (sign_at(excess, now.time) == CGAL::POSITIVE || sign_at(excess, until) == CGAL::POSITIVE ||
      excess.sign_at(simplest_between(now.time, until)) == CGAL::POSITIVE) {
    return true;
  }
  // Where it changes its sign, the quotient is zero or infinite.
  return std::ranges::any_of(real_roots(excess), [&](const Real_root& root) {
    return root.value >= now.time && root.value <= until && !is_negative_at(root, excess, square);
  });
}

/// Steps through a run, and knows its lives.
template <class Traits>
class Stepped_run {
 public:
  explicit Stepped_run(Simulation_2<Traits>& simulation) : simulation_(simulation) { look(); }

  // Looks at the triangulation when that has changed. Points may meet without an event: the caller
  // looks then.
  void step_to(const Algebraic_number& until) {
    while (simulation_.step(until) > 0) look();
    simulation_.advance_to(until);
  }
  void look() {
    Snapshot<Traits> now = snapshot_of(simulation_.triangulation());
    if (!snapshots_.empty() && snapshots_.back().time == now.time) snapshots_.pop_back();
    snapshots_.push_back(std::move(now));
  }

  // In their order; without limits.
  std::vector<Neighbor_life> lives(std::optional<double> threshold) const {
    std::vector<Neighbor_life> result;
    std::map<Edge_ids, Neighbor_life> present;
    const auto end = [&](const Edge_ids& edge, const Algebraic_number& time) {
      present[edge].end = time;
      if (present[edge].begin != time) result.push_back(present[edge]);
      present.erase(edge);
    };
    for (std::size_t i = 0; i < snapshots_.size(); ++i) {
      const auto& now = snapshots_[i];
      std::vector<Edge_ids> gone;
      for (const auto& [edge, life] : present) {
        if (!now.edges.contains(edge)) gone.push_back(edge);
      }
      for (const Edge_ids& edge : gone) end(edge, now.time);
      const Algebraic_number until =
          i + 1 < snapshots_.size() ? snapshots_[i + 1].time : simulation_.current_time();
      for (const auto& [edge, opposite] : now.edges) {
        if (!present.contains(edge)) {
          present[edge] = {edge, now.time, now.time};
          present[edge].is_short = threshold.has_value();
        }
        if (threshold && until != now.time && reaches(now, edge, *threshold, until)) {
          present[edge].is_short = false;
        }
      }
    }
    while (!present.empty()) end(present.begin()->first, simulation_.current_time());
    std::ranges::sort(result, [](const auto& a, const auto& b) {
      return std::tie(a.begin, a.points) < std::tie(b.begin, b.points);
    });
    return result;
  }

 private:
  Simulation_2<Traits>& simulation_;
  std::vector<Snapshot<Traits>> snapshots_;
};

inline void expect_same(const std::vector<Neighbor_life>& actual,
                        const std::vector<Neighbor_life>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].points, expected[i].points) << i;
    EXPECT_EQ(actual[i].begin, expected[i].begin) << i;
    EXPECT_EQ(actual[i].end, expected[i].end) << i;
    EXPECT_EQ(actual[i].is_short, expected[i].is_short)
        << actual[i].points[0] << "-" << actual[i].points[1] << " from "
        << actual[i].begin.to_double() << " to " << actual[i].end.to_double();
  }
}

inline std::size_t number_of_short(const std::vector<Neighbor_life>& lives) {
  return static_cast<std::size_t>(std::ranges::count_if(lives, &Neighbor_life::is_short));
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_OBSERVERS_STEPPED_RUN_H
