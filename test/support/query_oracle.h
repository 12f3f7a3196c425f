// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries at one time, compared with an oracle that examines all points, pairs, edges and triangles
// in exact arithmetic.
#ifndef KINETRI_TEST_SUPPORT_QUERY_ORACLE_H
#define KINETRI_TEST_SUPPORT_QUERY_ORACLE_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "kinetri/triangulation/queries_2.h"
#include "support/discs.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::test {

inline Static_point static_point(const Vector_2& place) {
  return {to_rational(place.x), to_rational(place.y)};
}

inline Static_point static_point(const Exact_position_2& p) {
  return {p.x, p.y};
}

/// The points of a triangulation at a rational time, and answers by exhaustive search. With
/// weights, powers replace squared distances.
class Query_oracle {
 public:
  template <class Kinetic>
  Query_oracle(const Kinetic& kinetic, const Rational& t) : edges_(kinetic.finite_edge_ids()) {
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (!kinetic.contains(id)) continue;
      places_.emplace(id, place_at(kinetic.motion(id), t));
      weights_.emplace(id, weight_at(kinetic.motion(id), t));
      if (!kinetic.is_hidden(id)) visible_.insert(id);
    }
    find_groups(kinetic, t);
    if (kinetic.triangulation().dimension() == 2) {
      for (const auto face : kinetic.triangulation().finite_face_handles()) {
        std::vector<Point_id> ids;
        for (int i = 0; i < 3; ++i) ids.push_back(face->vertex(i)->point().id());
        std::rotate(ids.begin(), std::ranges::min_element(ids), ids.end());
        triangles_.push_back(ids);
      }
    }
    for (const auto& [a, p] : places_) {
      for (const auto& [b, r] : places_) {
        if (p == r) continue;
        bool bounds = true;
        for (const auto& [c, s] : places_) {
          const auto side = CGAL::orientation(p, r, s);
          if (side != CGAL::COLLINEAR) is_flat_ = false;
          if (side == CGAL::RIGHT_TURN) bounds = false;
        }
        if (bounds) hull_lines_.emplace_back(p, r);
      }
    }
  }

  const std::map<Point_id, Static_point>& places() const { return places_; }
  const std::map<Point_id, Rational>& weights() const { return weights_; }
  const Static_point& place(Point_id id) const { return places_.at(id); }
  const Rational& weight(Point_id id) const { return weights_.at(id); }
  /// The points that coincide with the point at all times, and have its weight, itself included, by
  /// id.
  const std::vector<Point_id>& group(Point_id id) const { return groups_.at(id); }

  /// The power of the position `q` to the point `id`.
  Rational power(const Static_point& q, Point_id id) const {
    return CGAL::squared_distance(q, place(id)) - weight(id);
  }

  std::optional<Point_id> nearest(const Static_point& q) const {
    std::optional<Point_id> result;
    for (const auto& [id, p] : places_) {
      if (!result || power(q, id) < power(q, *result)) result = id;
    }
    return result;
  }

  std::optional<Edge_ids> closest_pair() const {
    std::optional<Edge_ids> result;
    Rational least;
    for (const auto& [a, p] : places_) {
      for (const auto& [b, q] : places_) {
        if (a >= b) continue;
        const Rational length = CGAL::squared_distance(p, q);
        if (result && length >= least) continue;
        result = Edge_ids{a, b};
        least = length;
      }
    }
    return result;
  }

  std::optional<Point_id> nearest_neighbor(Point_id id) const {
    std::optional<Point_id> result;
    for (const auto& [other, p] : places_) {
      if (other == id) continue;
      if (!result ||
          CGAL::compare_distance_to_point(place(id), p, place(*result)) == CGAL::SMALLER) {
        result = other;
      }
    }
    return result;
  }

  /// The k nearest points by distance and id, filled with no_point.
  std::vector<Point_id> nearest_neighbors(Point_id id, std::size_t k) const {
    std::vector<std::pair<Rational, Point_id>> others;
    for (const auto& [other, p] : places_) {
      if (other != id) others.emplace_back(CGAL::squared_distance(place(id), p), other);
    }
    std::ranges::sort(others);
    std::vector<Point_id> result(k, no_point);
    for (std::size_t i = 0; i < std::min(k, others.size()); ++i) result[i] = others[i].second;
    return result;
  }

  Location_2 locate(const Static_point& q) const {
    for (const Point_id id : visible_) {
      if (place(id) == q) return {Location_2::Kind::vertex, {id}};
    }
    for (const Edge_ids& edge : edges_) {
      const auto is_inside = [&](const Static_point& p) {
        return is_strictly_between(place(edge[0]), p, place(edge[1]));
      };
      if (!is_inside(q)) continue;
      if (std::ranges::any_of(visible_, [&](Point_id id) { return is_inside(place(id)); }))
        continue;
      return {Location_2::Kind::edge, {edge[0], edge[1]}};
    }
    for (const auto& face : triangles_) {
      const Static_point& a = place(face[0]);
      const Static_point& b = place(face[1]);
      const Static_point& c = place(face[2]);
      if (CGAL::left_turn(a, b, q) && CGAL::left_turn(b, c, q) && CGAL::left_turn(c, a, q)) {
        return {Location_2::Kind::face, face};
      }
    }
    return {};
  }

  /// Whether a line through two points separates the position strictly from all points. If all
  /// points are collinear: whether the position is not a point and not between two.
  bool is_outside_hull(const Static_point& q) const {
    if (!is_flat_) {
      return std::ranges::any_of(hull_lines_, [&](const auto& line) {
        return CGAL::right_turn(line.first, line.second, q);
      });
    }
    for (const auto& [a, p] : places_) {
      for (const auto& [b, r] : places_) {
        if (p == q || is_strictly_between(p, q, r)) return false;
      }
    }
    return true;
  }

  static bool is_strictly_between(const Static_point& a, const Static_point& b,
                                  const Static_point& c) {
    return a != c && CGAL::are_strictly_ordered_along_line(a, b, c);
  }

  /// A side of a Voronoi cell: the part of the bisector from `source` to `target`; none is
  /// infinity.
  struct Side {
    std::optional<Static_point> source;
    std::optional<Static_point> target;
  };

  /// A cell: its sides by neighbor; without sides, the plane, one position, or empty.
  struct Cell {
    std::map<Point_id, Side> sides = {};
    std::optional<Static_point> position = std::nullopt;
    bool is_empty = false;
  };

  /// The cell of `id`: the part of each bisector to which no other point is nearer. Of neighbors
  /// with the same bisector in one direction the farthest is named, of coinciding ones the first.
  Cell cell(Point_id id) const {
    Cell result;
    bool is_plane = true;
    for (const auto& [other, there] : places_) {
      if (there == place(id)) {
        if (weight(other) > weight(id)) return {.is_empty = true};
        continue;
      }
      is_plane = false;
      const auto side = this->side(id, other);
      if (!side) continue;
      if (side->source && side->source == side->target) {
        result.position = side->source;
        continue;
      }
      const auto vector = there - place(id);
      bool is_named = true;
      for (auto entry = result.sides.begin(); entry != result.sides.end();) {
        const auto known = place(entry->first) - place(id);
        const bool is_same = CGAL::determinant(known, vector) == 0 && known * vector > 0;
        if (is_same && known * known >= vector * vector) is_named = false;
        entry = is_same && is_named ? result.sides.erase(entry) : std::next(entry);
      }
      if (is_named) result.sides.emplace(other, *side);
    }
    if (!result.sides.empty()) result.position = std::nullopt;
    result.is_empty = !is_plane && result.sides.empty() && !result.position;
    return result;
  }

 private:
  // The point a + s d of the bisector of p and u, d to the left of u - p, is at least as near to p
  // as to w if 2 (w - p).(a + s d - p) <= |w - p|^2 + weight of p - weight of w.
  std::optional<Side> side(Point_id id, Point_id other) const {
    const Static_point& p = place(id);
    const auto toward = place(other) - p;
    const auto reach = [&](Point_id w) {
      return Rational((place(w) - p) * (place(w) - p) + weight(id) - weight(w));
    };
    const auto a = p + Rational(reach(other) / (2 * (toward * toward))) * toward;
    const auto d = toward.perpendicular(CGAL::COUNTERCLOCKWISE);
    std::optional<Rational> from;
    std::optional<Rational> to;
    for (const auto& [third, w] : places_) {
      const Rational slope = 2 * ((w - p) * d);
      const Rational rest = reach(third) - 2 * ((w - p) * (a - p));
      if (slope == 0) {
        if (rest < 0) return std::nullopt;
      } else if (slope > 0) {
        const Rational bound = rest / slope;
        if (!to || bound < *to) to = bound;
      } else {
        const Rational bound = rest / slope;
        if (!from || bound > *from) from = bound;
      }
    }
    if (from && to && *from > *to) return std::nullopt;
    Side result;
    if (from) result.source = a + *from * d;
    if (to) result.target = a + *to * d;
    return result;
  }

  // Coordinates and weights that are equal at seven times are equal at all, if their degree is six
  // at most.
  template <class Kinetic>
  void find_groups(const Kinetic& kinetic, const Rational& t) {
    std::map<std::vector<std::pair<Static_point, Rational>>, std::vector<Point_id>> groups;
    for (const auto& [id, unused] : places_) {
      std::vector<std::pair<Static_point, Rational>> samples;
      for (int k = 0; k < 7; ++k) {
        samples.emplace_back(place_at(kinetic.motion(id), Rational(t + k)),
                             weight_at(kinetic.motion(id), Rational(t + k)));
      }
      groups[samples].push_back(id);
    }
    for (const auto& [unused, group] : groups) {
      for (const Point_id id : group) groups_.emplace(id, group);
    }
  }

  std::vector<Edge_ids> edges_;
  std::vector<std::vector<Point_id>> triangles_;
  std::map<Point_id, Static_point> places_;
  std::map<Point_id, Rational> weights_;
  std::map<Point_id, std::vector<Point_id>> groups_;
  std::set<Point_id> visible_;
  std::vector<std::pair<Static_point, Static_point>> hull_lines_;
  bool is_flat_ = true;
};

/// Expects that the cell consists of the sides of the oracle, joined at their ends.
inline void expect_same_cell(const Voronoi_cell_2<Exact_position_2>& cell,
                             const Query_oracle& oracle, Point_id id) {
  const auto [expected, position, is_empty] = oracle.cell(id);
  ASSERT_EQ(cell.is_empty, is_empty);
  std::vector<Point_id> neighbors = cell.neighbors;
  std::ranges::sort(neighbors);
  std::vector<Point_id> expected_neighbors;
  for (const auto& [other, side] : expected) expected_neighbors.push_back(other);
  ASSERT_EQ(neighbors, expected_neighbors);
  const std::size_t n = neighbors.size();
  if (n == 0) {
    EXPECT_FALSE(cell.rays);
    EXPECT_EQ(cell.is_bounded(), is_empty || position);
    ASSERT_EQ(cell.vertices.size(), position ? 1u : 0u);
    if (position) {
      EXPECT_EQ(static_point(cell.vertices[0]), *position);
    }
    return;
  }
  const bool is_bounded = std::ranges::all_of(
      expected, [](const auto& entry) { return entry.second.source && entry.second.target; });
  ASSERT_EQ(cell.is_bounded(), is_bounded);
  ASSERT_EQ(cell.rays.has_value(), !is_bounded);
  const Static_point& here = oracle.place(id);
  if (is_bounded) {
    ASSERT_EQ(cell.vertices.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(static_point(cell.vertices[i]), expected.at(cell.neighbors[i]).target);
      ASSERT_EQ(static_point(cell.vertices[i]), expected.at(cell.neighbors[(i + 1) % n]).source);
    }
    const Point_id first = cell.neighbors.front();
    for (const Point_id other : neighbors) {
      if (other == first) continue;
      const auto order =
          CGAL::compare_distance_to_point(here, oracle.place(other), oracle.place(first));
      EXPECT_TRUE(order == CGAL::LARGER || (order == CGAL::EQUAL && first < other));
    }
    return;
  }
  const Query_oracle::Side& first = expected.at(cell.neighbors.front());
  const Query_oracle::Side& last = expected.at(cell.neighbors.back());
  EXPECT_FALSE(first.source);
  EXPECT_FALSE(last.target);
  if (n == 2 && !first.target) {
    EXPECT_FALSE(last.source);  // a strip
    EXPECT_TRUE(cell.vertices.empty());
  } else {
    ASSERT_EQ(cell.vertices.size(), n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      ASSERT_EQ(static_point(cell.vertices[i]), expected.at(cell.neighbors[i]).target);
      ASSERT_EQ(static_point(cell.vertices[i]), expected.at(cell.neighbors[i + 1]).source);
    }
  }
  const auto right = (oracle.place(cell.neighbors.front()) - here).perpendicular(CGAL::CLOCKWISE);
  const auto left =
      (oracle.place(cell.neighbors.back()) - here).perpendicular(CGAL::COUNTERCLOCKWISE);
  EXPECT_EQ(static_point((*cell.rays)[0]) - Static_point(CGAL::ORIGIN), right);
  EXPECT_EQ(static_point((*cell.rays)[1]) - Static_point(CGAL::ORIGIN), left);
}

/// Expects that the rounded cell is the exact one with each number rounded.
inline void expect_rounded(const Voronoi_cell_2<Vector_2>& rounded,
                           const Voronoi_cell_2<Exact_position_2>& cell) {
  const auto is_rounded = [](const Vector_2& r, const Exact_position_2& p) {
    return r == Vector_2{to_double(p.x), to_double(p.y)};
  };
  EXPECT_EQ(rounded.neighbors, cell.neighbors);
  EXPECT_EQ(rounded.is_empty, cell.is_empty);
  ASSERT_EQ(rounded.vertices.size(), cell.vertices.size());
  for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
    EXPECT_TRUE(is_rounded(rounded.vertices[i], cell.vertices[i]));
  }
  ASSERT_EQ(rounded.rays.has_value(), cell.rays.has_value());
  for (std::size_t i = 0; cell.rays && i < 2; ++i) {
    EXPECT_TRUE(is_rounded((*rounded.rays)[i], (*cell.rays)[i]));
  }
}

/// Checks the rounded positions of all points and, without weights, the nearest neighbors, one by
/// one and all at once, and the k nearest, for k = 3 and for k greater than the number of points.
template <class Queries>
void expect_right_for_all_points(const Queries& queries, Point_id next_id,
                                 const Query_oracle& oracle) {
  constexpr bool has_nearest = requires {
    queries.nearest_neighbors();
  };
  std::vector<Point_id> nearest(next_id, no_point);
  const std::size_t many = std::size_t{next_id} + 1;
  std::vector<Point_id> three(3 * std::size_t{next_id}, no_point);
  std::vector<Point_id> all(many * next_id, no_point);
  if constexpr (has_nearest) {
    nearest = queries.nearest_neighbors();
    three = queries.nearest_neighbors(3);
    all = queries.nearest_neighbors(many);
  }
  const auto row = [](const std::vector<Point_id>& ids, std::size_t k, Point_id id) {
    return std::vector<Point_id>(ids.begin() + static_cast<std::ptrdiff_t>(k * id),
                                 ids.begin() + static_cast<std::ptrdiff_t>(k * (id + 1)));
  };
  const std::vector<double> positions = queries.rounded_positions();
  ASSERT_EQ(nearest.size(), next_id);
  ASSERT_EQ(three.size(), 3 * std::size_t{next_id});
  ASSERT_EQ(all.size(), many * next_id);
  ASSERT_EQ(positions.size(), 2 * std::size_t{next_id});
  for (Point_id id = 0; id < next_id; ++id) {
    SCOPED_TRACE(testing::Message() << "point " << id);
    const double x = positions[2 * std::size_t{id}];
    const double y = positions[2 * std::size_t{id} + 1];
    if (!oracle.places().contains(id)) {
      ASSERT_EQ(nearest[id], no_point);
      ASSERT_EQ(row(three, 3, id), std::vector<Point_id>(3, no_point));
      ASSERT_EQ(row(all, many, id), std::vector<Point_id>(many, no_point));
      ASSERT_TRUE(std::isnan(x) && std::isnan(y));
      continue;
    }
    if constexpr (has_nearest) {
      const auto expected = oracle.nearest_neighbor(id);
      ASSERT_EQ(queries.nearest_neighbor(id), expected);
      ASSERT_EQ(nearest[id], expected.value_or(no_point));
      ASSERT_EQ(row(three, 3, id), oracle.nearest_neighbors(id, 3));
      ASSERT_EQ(row(all, many, id), oracle.nearest_neighbors(id, many));
    }
    ASSERT_EQ(x, to_double(oracle.place(id).x()));
    ASSERT_EQ(y, to_double(oracle.place(id).y()));
  }
}

/// Positions to ask for: points, midpoints of pairs, and positions on a grid and between.
inline std::vector<Vector_2> places_to_ask(const Query_oracle& oracle, std::mt19937_64& random) {
  std::vector<Vector_2> result;
  std::uniform_int_distribution<int> halves(-3, 13);
  for (int i = 0; i < 6; ++i) result.push_back({halves(random) / 2.0, halves(random) / 2.0});
  std::vector<Static_point> points;
  for (const auto& [id, p] : oracle.places()) points.push_back(p);
  if (points.empty()) return result;
  std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
  const auto rounded = [](const Static_point& p) {
    return Vector_2{to_double(p.x()), to_double(p.y())};
  };
  for (int i = 0; i < 4; ++i) {
    const Static_point& a = points[any(random)];
    const Static_point& b = points[any(random)];
    result.push_back(rounded(a));
    result.push_back(rounded(CGAL::midpoint(a, b)));
    result.push_back(rounded(a + Rational(3, 2) * (b - a)));
  }
  std::erase_if(result,
                [](const Vector_2& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  return result;
}

/// Compares all queries at a rational time with the oracle.
template <class Kinetic>
void expect_right_answers(const Kinetic& kinetic, const Algebraic_number& time, const Rational& t,
                          std::mt19937_64& random) {
  const Kinetic_queries_2 queries(kinetic, time);
  const Query_oracle oracle(kinetic, t);
  if constexpr (requires { queries.closest_pair(); }) {
    ASSERT_EQ(queries.closest_pair(), oracle.closest_pair());
  }
  ASSERT_NO_FATAL_FAILURE(expect_right_for_all_points(queries, kinetic.next_id(), oracle));
  for (const Vector_2& place : places_to_ask(oracle, random)) {
    SCOPED_TRACE(testing::Message() << "at " << place.x << ", " << place.y);
    ASSERT_EQ(queries.nearest_vertex(place), oracle.nearest(static_point(place)));
    const Location_2 location = queries.locate(place);
    const Location_2 expected = oracle.locate(static_point(place));
    ASSERT_EQ(location.kind, expected.kind);
    ASSERT_EQ(location.points, expected.points);
    ASSERT_EQ(location.kind == Location_2::Kind::outside_convex_hull,
              oracle.is_outside_hull(static_point(place)));
  }
  const Kinetic_queries_2 rational_queries(kinetic, Algebraic_number(t));
  for (const auto& [id, place] : oracle.places()) {
    SCOPED_TRACE(testing::Message() << "cell of " << id);
    const auto cell = rational_queries.voronoi_cell(id);
    ASSERT_NO_FATAL_FAILURE(expect_same_cell(cell, oracle, id));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(queries.rounded_voronoi_cell(id), cell));
  }
}

/// The value of a time if it is known or easily found to be rational.
inline std::optional<Rational> rational_value(const Algebraic_number& time) {
  const Double_interval interval = time.tight_interval();
  if (interval.lower == interval.upper) return to_rational(interval.lower);
  if (time.is_known_rational()) return time.rational();
  if (time.polynomial().degree() == 1) {
    return Rational(-time.polynomial()[0], time.polynomial()[1]);
  }
  return std::nullopt;
}

/// Asks at the present time, twice between it and the next event, and at the next event while it
/// has not happened, instant by instant. Returns at how many events `ask`, called with a time,
/// could ask.
template <class Triangulation, class Ask>
int ask_along(Triangulation& kinetic, int instants, Ask ask) {
  int events = 0;
  for (int i = 0; i < instants && !testing::Test::HasFatalFailure(); ++i) {
    ask(kinetic.current_time());
    const auto next = kinetic.next_event_time();
    const Algebraic_number end = next ? *next : Rational(kinetic.current_time().upper() + 9);
    const Algebraic_number between = simplest_between(kinetic.current_time(), end);
    ask(between);
    ask(simplest_between(between, end));
    if (!next) break;
    if (ask(*next)) ++events;
    kinetic.step();
  }
  return events;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_QUERY_ORACLE_H
