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
#include "observers/edge_follower.h"
#include "support/brute_force_simulator.h"
#include "support/disc_runs.h"
#include "support/images.h"
#include "support/query_oracle.h"

namespace kinetri::test {

/// The points opposite of an edge as its first end sees them, sorted; at the hull no_point.
template <class Traits>
using Opposite = std::array<detail::Neighbor_name<Traits>, 2>;

template <class Traits>
struct Snapshot {
  using Edge = detail::Edge_name<Traits>;

  Algebraic_number time;
  std::map<Edge, Opposite<Traits>> edges;
  std::map<Point_id, typename Traits::Motion> motions;
  const Periodic_box_2* box = nullptr;

  Static_point place_at(Point_id id, const Rational& t) const {
    return test::place_at(center(motions.at(id)), t);
  }
  Static_point place_at(const Periodic_image& image, const Rational& t) const {
    return test::place_at(Image_motion_2{center(motions.at(image.id)), image.offset, box}, t);
  }
};

/// The link of a point with the one that hides it, of the same place at two times.
template <class Traits>
auto link_of(const Snapshot<Traits>& now, Point_id shown, Point_id id) {
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    for (int x = -9; x <= 9; ++x) {
      for (int y = -9; y <= 9; ++y) {
        const Periodic_image image = {id, {x, y}};
        if (now.place_at(shown, 0) == now.place_at(image, 0) &&
            now.place_at(shown, 1) == now.place_at(image, 1)) {
          return Periodic_edge{{shown, id}, image.offset};
        }
      }
    }
    ADD_FAILURE() << "the image at " << id << " is far away";
    return Periodic_edge();
  } else {
    return Edge_ids{shown, id};
  }
}

template <class Traits>
Snapshot<Traits> snapshot_of(const Kinetic_triangulation_2<Traits>& kinetic) {
  constexpr Opposite<Traits> none = {detail::no_neighbor<Traits>(), detail::no_neighbor<Traits>()};
  Snapshot<Traits> result{kinetic.current_time(), {}, {}};
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id)) result.motions.emplace(id, kinetic.motion(id));
  }
  if constexpr (PeriodicKineticTraits_2<Traits>) result.box = &kinetic.traits().box();
  for (const auto& [id, unused] : result.motions) {
    const Point_id shown = kinetic.vertex(id)->point().id();
    if (shown != id) result.edges.emplace(link_of(result, shown, id), none);
  }
  const auto& triangulation = kinetic.triangulation();
  if constexpr (PeriodicKineticTraits_2<Traits>) {
    for (const auto& edge : triangulation.finite_edges()) {
      const auto& [face, i] = edge;
      const auto corner = [&, f = face, from = triangulation.ccw(i)](int k) {
        return Periodic_image{f->vertex(k)->point().id(), triangulation.offset(f, from, k)};
      };
      const Periodic_image p = corner(triangulation.ccw(i));
      const Periodic_image q = corner(triangulation.cw(i));
      const Periodic_image r = corner(i);
      const auto beyond = triangulation.offset_beyond(edge, triangulation.ccw(i));
      const auto [neighbor, k] = triangulation.mirror(edge);
      const Periodic_image s = {neighbor->vertex(k)->point().id(), *beyond};
      const Periodic_edge name = periodic_edge(p.id, q.id, q.offset);
      const bool is_reversed = name != Periodic_edge{{p.id, q.id}, q.offset};
      const auto seen = [&](const Periodic_image& image) {
        return is_reversed ? detail::seen_from(q, image) : image;
      };
      Opposite<Traits> opposite = {seen(r), seen(s)};
      std::ranges::sort(opposite);
      result.edges.emplace(name, opposite);
    }
  } else {
    for (const Edge_ids& edge : kinetic.finite_edge_ids()) result.edges.emplace(edge, none);
    if (triangulation.dimension() < 2) return result;
    for (const auto& [face, i] : triangulation.finite_edges()) {
      const auto id = [&](auto vertex) {
        return triangulation.is_infinite(vertex) ? no_point : vertex->point().id();
      };
      Opposite<Traits> opposite = {id(face->vertex(i)), id(triangulation.mirror_vertex(face, i))};
      std::ranges::sort(opposite);
      result.edges[edge_ids(id(face->vertex(triangulation.cw(i))),
                            id(face->vertex(triangulation.ccw(i))))] = opposite;
    }
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
bool reaches(const Snapshot<Traits>& now, const detail::Edge_name<Traits>& edge, double length,
             const Algebraic_number& until) {
  const Opposite<Traits>& opposite = now.edges.at(edge);
  if (detail::id_of(opposite[1]) == no_point) return true;
  // The excess of the squared length, times a square; and the latter.
  const auto excess_and_square = [&](const Rational& t) {
    const Point_id first = detail::ids_of(edge)[0];
    const auto second = detail::second_of(edge);
    const auto weight = [&](const auto& point) {
      return weight_at(now.motions.at(detail::id_of(point)), t);
    };
    // The center less the place of the first end, times a denominator; and that.
    const auto center = [&](const auto& third) {
      const auto q = now.place_at(second, t) - now.place_at(first, t);
      const auto r = now.place_at(third, t) - now.place_at(first, t);
      const Rational of_q = q.squared_length() - weight(second) + weight(first);
      const Rational of_r = r.squared_length() - weight(third) + weight(first);
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

/// Steps through a run of a simulation or a triangulation, and knows its lives.
template <class Observed>
class Stepped_run {
 public:
  explicit Stepped_run(Observed& observed) : observed_(observed) { look(); }

  // Looks at the triangulation when that has changed. Points may meet without an event: the caller
  // looks then.
  void step_to(const Algebraic_number& until) {
    while (observed_.step(until) > 0) look();
    observed_.advance_to(until);
  }
  void look() {
    auto now = snapshot_of(detail::triangulation_of(observed_));
    if (!snapshots_.empty() && snapshots_.back().time == now.time) snapshots_.pop_back();
    snapshots_.push_back(std::move(now));
  }

  // In their order; without limits.
  std::vector<Neighbor_life> lives(std::optional<double> threshold) const {
    std::vector<Neighbor_life> result;
    std::map<Edge, Neighbor_life> present;
    const auto end = [&](const Edge& edge, const Algebraic_number& time) {
      present[edge].end = time;
      if (present[edge].begin != time) result.push_back(present[edge]);
      present.erase(edge);
    };
    for (std::size_t i = 0; i < snapshots_.size(); ++i) {
      const auto& now = snapshots_[i];
      std::vector<Edge> gone;
      for (const auto& [edge, life] : present) {
        if (!now.edges.contains(edge)) gone.push_back(edge);
      }
      for (const Edge& edge : gone) end(edge, now.time);
      const Algebraic_number until =
          i + 1 < snapshots_.size() ? snapshots_[i + 1].time : observed_.current_time();
      for (const auto& [edge, opposite] : now.edges) {
        if (!present.contains(edge)) {
          present[edge] = {detail::ids_of(edge), now.time, now.time};
          present[edge].offset = detail::offset_of(edge);
          present[edge].is_short = threshold.has_value();
        }
        if (threshold && until != now.time && reaches(now, edge, *threshold, until)) {
          present[edge].is_short = false;
        }
      }
    }
    while (!present.empty()) end(present.begin()->first, observed_.current_time());
    std::ranges::sort(result, [](const auto& a, const auto& b) {
      return std::tie(a.begin, a.points, a.offset) < std::tie(b.begin, b.points, b.offset);
    });
    return result;
  }

 private:
  using Snapshot_of_it =
      decltype(snapshot_of(detail::triangulation_of(std::declval<const Observed&>())));
  using Edge = typename Snapshot_of_it::Edge;

  Observed& observed_;
  std::vector<Snapshot_of_it> snapshots_;
};

inline void expect_same(const std::vector<Neighbor_life>& actual,
                        const std::vector<Neighbor_life>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].points, expected[i].points) << i;
    EXPECT_EQ(actual[i].offset, expected[i].offset) << i;
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
