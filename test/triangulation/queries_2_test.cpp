// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries at one time against oracles that look at all points, pairs, edges and triangles at their
// exact places.
#include "kinetri/triangulation/queries_2.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "support/kinetic_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri {
namespace {

using test::Kinetic_delaunay;
using test::Static_kernel;
using test::Static_point;
using Kind = Location_2::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- the oracles ----

Static_point exact(const Vector_2& place) {
  return {to_rational(place.x), to_rational(place.y)};
}

/// The points of a triangulation at a rational time, and what a look at all of them says.
class Oracle {
 public:
  Oracle(const Kinetic_delaunay& kinetic, const Rational& t) : kinetic_(kinetic) {
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id)) places_.emplace(id, test::place_at(kinetic.motion(id), t));
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
  const Static_point& place(Point_id id) const { return places_.at(id); }

  std::optional<Point_id> nearest(const Static_point& q) const {
    std::optional<Point_id> result;
    for (const auto& [id, p] : places_) {
      if (!result || CGAL::compare_distance_to_point(q, p, place(*result)) == CGAL::SMALLER) {
        result = id;
      }
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

  Location_2 locate(const Static_point& q) const {
    for (const auto& [id, p] : places_) {
      if (p == q) return {Kind::vertex, {id}};
    }
    for (const Edge_ids& edge : kinetic_.finite_edge_ids()) {
      const auto is_inside = [&](const Static_point& p) {
        return is_strictly_between(place(edge[0]), p, place(edge[1]));
      };
      if (!is_inside(q)) continue;
      if (std::ranges::any_of(places_,
                              [&](const auto& entry) { return is_inside(entry.second); })) {
        continue;
      }
      return {Kind::edge, {edge[0], edge[1]}};
    }
    for (const auto& face : triangles()) {
      const Static_point& a = place(face[0]);
      const Static_point& b = place(face[1]);
      const Static_point& c = place(face[2]);
      if (CGAL::left_turn(a, b, q) && CGAL::left_turn(b, c, q) && CGAL::left_turn(c, a, q)) {
        return {Kind::face, face};
      }
    }
    return {};
  }

  /// Whether a line through two points has the place strictly on one side, and all points on the
  /// other or on it. If all points are collinear: whether the place is not between two.
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

  /// A side of a Voronoi cell: the part of the bisector from `source` to `target`, where these are
  /// not at infinity.
  struct Side {
    std::optional<Static_point> source;
    std::optional<Static_point> target;
  };

  /// The sides of the cell of `id`, by the point across: of each bisector the part that no other
  /// point is nearer to.
  std::map<Point_id, Side> cell(Point_id id) const {
    std::map<Point_id, Side> result;
    std::set<Static_point> seen = {place(id)};
    for (const auto& [other, there] : places_) {
      if (!seen.insert(there).second) continue;
      if (const auto side = this->side(place(id), there)) result.emplace(other, *side);
    }
    return result;
  }

 private:
  std::vector<std::vector<Point_id>> triangles() const {
    std::vector<std::vector<Point_id>> result;
    if (kinetic_.triangulation().dimension() < 2) return result;
    for (const auto face : kinetic_.triangulation().finite_face_handles()) {
      std::vector<Point_id> ids;
      for (int i = 0; i < 3; ++i) ids.push_back(face->vertex(i)->point().id());
      std::rotate(ids.begin(), std::ranges::min_element(ids), ids.end());
      result.push_back(ids);
    }
    return result;
  }

  // The point m + s d of the bisector of p and u, d to the left of u - p, is as near to p as to w
  // where 2 (w - p).(m + s d - p) <= |w - p|^2.
  std::optional<Side> side(const Static_point& p, const Static_point& u) const {
    const auto m = CGAL::midpoint(p, u);
    const auto d = (u - p).perpendicular(CGAL::COUNTERCLOCKWISE);
    std::optional<Rational> from;
    std::optional<Rational> to;
    for (const auto& [id, w] : places_) {
      const Rational slope = 2 * ((w - p) * d);
      const Rational rest = (w - p) * (w - p) - 2 * ((w - p) * (m - p));
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
    if (from && to && *from >= *to) return std::nullopt;
    Side result;
    if (from) result.source = m + *from * d;
    if (to) result.target = m + *to * d;
    return result;
  }

  const Kinetic_delaunay& kinetic_;
  std::map<Point_id, Static_point> places_;
  std::vector<std::pair<Static_point, Static_point>> hull_lines_;
  bool is_flat_ = true;
};

Static_point point(const Exact_position_2& p) {
  return {p.x, p.y};
}

// The cell must consist of the sides that the oracle has, joined at their ends.
void expect_same_cell(const Voronoi_cell_2<Exact_position_2>& cell, const Oracle& oracle,
                      Point_id id) {
  const auto expected = oracle.cell(id);
  std::vector<Point_id> neighbors = cell.neighbors;
  std::ranges::sort(neighbors);
  std::vector<Point_id> expected_neighbors;
  for (const auto& [other, side] : expected) expected_neighbors.push_back(other);
  ASSERT_EQ(neighbors, expected_neighbors);
  const std::size_t n = neighbors.size();
  if (n == 0) {
    EXPECT_TRUE(cell.vertices.empty() && !cell.rays && !cell.is_bounded());
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
      ASSERT_EQ(point(cell.vertices[i]), expected.at(cell.neighbors[i]).target);
      ASSERT_EQ(point(cell.vertices[i]), expected.at(cell.neighbors[(i + 1) % n]).source);
    }
    const Static_point& first = oracle.place(cell.neighbors.front());
    for (const Point_id other : neighbors) {
      EXPECT_NE(CGAL::compare_distance_to_point(here, oracle.place(other), first), CGAL::SMALLER);
    }
    return;
  }
  const Oracle::Side& first = expected.at(cell.neighbors.front());
  const Oracle::Side& last = expected.at(cell.neighbors.back());
  EXPECT_FALSE(first.source);
  EXPECT_FALSE(last.target);
  if (n == 2 && !first.target) {
    EXPECT_FALSE(last.source);  // a strip
    EXPECT_TRUE(cell.vertices.empty());
  } else {
    ASSERT_EQ(cell.vertices.size(), n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      ASSERT_EQ(point(cell.vertices[i]), expected.at(cell.neighbors[i]).target);
      ASSERT_EQ(point(cell.vertices[i]), expected.at(cell.neighbors[i + 1]).source);
    }
  }
  const auto right = (oracle.place(cell.neighbors.front()) - here).perpendicular(CGAL::CLOCKWISE);
  const auto left =
      (oracle.place(cell.neighbors.back()) - here).perpendicular(CGAL::COUNTERCLOCKWISE);
  EXPECT_EQ(point((*cell.rays)[0]) - Static_point(CGAL::ORIGIN), right);
  EXPECT_EQ(point((*cell.rays)[1]) - Static_point(CGAL::ORIGIN), left);
}

// The rounded cell must be the exact one with each number rounded.
void expect_rounded(const Voronoi_cell_2<Vector_2>& rounded,
                    const Voronoi_cell_2<Exact_position_2>& cell) {
  const auto is_rounded = [](const Vector_2& r, const Exact_position_2& p) {
    return r == Vector_2{to_double(p.x), to_double(p.y)};
  };
  EXPECT_EQ(rounded.neighbors, cell.neighbors);
  ASSERT_EQ(rounded.vertices.size(), cell.vertices.size());
  for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
    EXPECT_TRUE(is_rounded(rounded.vertices[i], cell.vertices[i]));
  }
  ASSERT_EQ(rounded.rays.has_value(), cell.rays.has_value());
  for (std::size_t i = 0; cell.rays && i < 2; ++i) {
    EXPECT_TRUE(is_rounded((*rounded.rays)[i], (*cell.rays)[i]));
  }
}

// Where the points of the triangulation are, or near: the points, middles of pairs, places on grids
// and in between.
std::vector<Vector_2> places_to_ask(const Oracle& oracle, std::mt19937_64& random) {
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

// Everything that can be asked at a rational time, against the oracle.
void expect_right_answers(const Kinetic_delaunay& kinetic, const Algebraic_number& time,
                          const Rational& t, std::mt19937_64& random) {
  const Kinetic_queries_2 queries(kinetic, time);
  const Oracle oracle(kinetic, t);
  ASSERT_EQ(queries.closest_pair(), oracle.closest_pair());
  for (const Vector_2& place : places_to_ask(oracle, random)) {
    SCOPED_TRACE(testing::Message() << "at " << place.x << ", " << place.y);
    ASSERT_EQ(queries.nearest_vertex(place), oracle.nearest(exact(place)));
    const Location_2 location = queries.locate(place);
    const Location_2 expected = oracle.locate(exact(place));
    ASSERT_EQ(location.kind, expected.kind);
    ASSERT_EQ(location.points, expected.points);
    ASSERT_EQ(location.kind == Kind::outside_convex_hull, oracle.is_outside_hull(exact(place)));
  }
  const Kinetic_queries_2 rational_queries(kinetic, Algebraic_number(t));
  for (const auto& [id, place] : oracle.places()) {
    SCOPED_TRACE(testing::Message() << "cell of " << id);
    const auto cell = rational_queries.voronoi_cell(id);
    ASSERT_NO_FATAL_FAILURE(expect_same_cell(cell, oracle, id));
    ASSERT_NO_FATAL_FAILURE(expect_rounded(queries.rounded_voronoi_cell(id), cell));
  }
}

// The value of a time where it is a rational number that is easily found.
std::optional<Rational> rational_value(const Algebraic_number& time) {
  const Double_interval interval = time.tight_interval();
  if (interval.lower == interval.upper) return to_rational(interval.lower);
  if (time.is_known_rational()) return time.rational();
  if (time.polynomial().degree() == 1) {
    return Rational(-time.polynomial()[0], time.polynomial()[1]);
  }
  return std::nullopt;
}

// Asks at the present time, between it and the next event, and at the next event while it has not
// happened, instant by instant. Returns at how many events it could ask.
int ask_along(const std::vector<Linear_motion_2>& motions, int instants, unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << '\n' << test::describe(motions));
  std::mt19937_64 random(seed);
  Kinetic_delaunay kinetic(motions);
  const auto ask = [&](const Algebraic_number& time) {
    const auto t = rational_value(time);
    if (!t || testing::Test::HasFatalFailure()) return false;
    SCOPED_TRACE(testing::Message() << "at the time " << *t);
    expect_right_answers(kinetic, time, *t, random);
    return true;
  };
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

// ---- the tests ----

class Queries_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Queries_on_grids, are_answered_as_by_a_look_at_everything) {
  const auto [points, size, speed] = GetParam();
  const int cases = (points <= 4 ? 15 : points <= 7 ? 5 : 3) * test::multiplier();
  int events = 0;
  for (int seed = 0; seed < cases; ++seed) {
    events += ask_along(test::grid_motions(static_cast<std::size_t>(points), size, speed,
                                           static_cast<unsigned>(seed)),
                        6, static_cast<unsigned>(seed));
    if (HasFatalFailure()) return;
  }
  if (points > 2) {
    EXPECT_GE(events, 4) << "degenerate times with a rational value";
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Queries_on_grids,
                         testing::Values(std::tuple(0, 3, 1), std::tuple(1, 3, 1),
                                         std::tuple(2, 3, 1), std::tuple(3, 2, 1),
                                         std::tuple(4, 3, 1), std::tuple(5, 3, 1),
                                         std::tuple(6, 3, 1), std::tuple(7, 4, 2),
                                         std::tuple(9, 3, 1), std::tuple(11, 4, 1)));

// On lines, so that nothing is ever two-dimensional, or all of it is flat once.
TEST(Queries, of_points_on_a_line_are_answered_as_by_a_look_at_everything) {
  for (unsigned seed = 0; seed < 25u * static_cast<unsigned>(test::multiplier()); ++seed) {
    auto motions = test::grid_motions(2 + seed % 5, seed % 4 == 3 ? 30 : 4, 2, seed);
    std::set<std::pair<double, double>> seen;
    std::erase_if(motions, [&](Linear_motion_2& m) {
      const bool is_flat_for_ever = seed % 2 == 0;
      m.position.y = m.position.x;
      if (is_flat_for_ever) m.velocity.y = m.velocity.x;
      return is_flat_for_ever && !seen.insert({m.position.x, m.velocity.x}).second;
    });
    if (seed % 2 != 0) {
      // All on the line at t = 1, and anywhere before.
      std::set<std::tuple<double, double, double>> trajectories;
      std::erase_if(motions, [&](Linear_motion_2& m) {
        m.epoch = 1;
        return !trajectories.insert({m.position.x, m.velocity.x, m.velocity.y}).second;
      });
    }
    ask_along(motions, 6, seed);
    if (HasFatalFailure()) return;
  }
}

TEST(Queries, of_random_points_are_answered_as_by_a_look_at_everything) {
  for (unsigned seed = 0; seed < 4u * static_cast<unsigned>(test::multiplier()); ++seed) {
    ask_along(test::random_motions(5 + 4 * (seed % 4), 6, 3, seed), 4, seed);
    if (HasFatalFailure()) return;
  }
}

// At t = 1 five points are in one place, with others around.
TEST(Queries, where_points_meet_are_about_their_common_place) {
  const std::vector<Linear_motion_2> motions = {
      {{3, 1}, {-1, 0}},  {{1, 1}, {1, 0}}, {{2, 3}, {0, -2}}, {{2, 1}, {0, 0}}, {{0, -1}, {2, 2}},
      {{-4, -4}, {0, 0}}, {{6, 0}, {0, 0}}, {{0, 7}, {0, 0}},  {{5, 5}, {0, 0}}};
  Kinetic_delaunay kinetic(motions);
  while (*kinetic.next_event_time() < 1.0) kinetic.step();
  std::mt19937_64 random(1);
  const auto ask = [&] {
    expect_right_answers(kinetic, 1.0, 1, random);
    const Kinetic_queries_2 queries(kinetic, 1.0);
    EXPECT_EQ(queries.nearest_vertex({2, 1}), 0u);
    EXPECT_EQ(queries.locate({2, 1}), (Location_2{Kind::vertex, {0}}));
    EXPECT_EQ(queries.closest_pair(), (Edge_ids{0, 1}));
    for (const Point_id id : {1u, 2u, 3u, 4u}) {
      EXPECT_EQ(queries.voronoi_cell(id).neighbors, queries.voronoi_cell(0).neighbors);
    }
  };
  ask();
  kinetic.advance_to(1.0);
  ask();
}

// All points on one line at t = 1, as in a test of the triangulation, and not before or after.
TEST(Queries, where_the_hull_is_flat_are_about_the_line) {
  Kinetic_delaunay kinetic(
      {{{1, 1}, {0, 1}, 0}, {{0, 0}, {1, 0}, 0}, {{2, 0}, {-1, -1}, 0}, {{1, 1}, {0, 0}, 0}});
  std::mt19937_64 random(1);
  for (const bool is_after : {false, true}) {
    if (is_after) kinetic.advance_to(1.0);
    expect_right_answers(kinetic, 1.0, 1, random);
    const Kinetic_queries_2 queries(kinetic, 1.0);
    EXPECT_EQ(queries.locate({1, 0.5}), (Location_2{Kind::edge, {1, 3}}));
    EXPECT_EQ(queries.locate({1, 0}), (Location_2{Kind::vertex, {1}}));
    EXPECT_EQ(queries.locate({1, 2.5}), Location_2{});
    EXPECT_EQ(queries.locate({0.5, 0.5}), Location_2{});
    EXPECT_TRUE(queries.voronoi_cell(1).vertices.empty());
    EXPECT_EQ(queries.voronoi_cell(1).neighbors.size(), 2u);
  }
}

TEST(Queries, of_no_point_have_no_answer) {
  const Kinetic_delaunay kinetic{std::vector<Linear_motion_2>{}};
  const Kinetic_queries_2 queries(kinetic, 7.0);
  EXPECT_EQ(queries.nearest_vertex({0, 0}), std::nullopt);
  EXPECT_EQ(queries.locate({0, 0}), Location_2{});
  EXPECT_EQ(queries.closest_pair(), std::nullopt);
  EXPECT_PRECONDITION_ERROR(queries.neighbors(0), "no point has the id 0; ask contains(id) first");
}

// Of a static triangulation with CGAL's exact predicates, the dual of its faces around a vertex.
TEST(Queries, voronoi_cells_are_those_of_cgals_static_dual) {
  using Static_triangulation = CGAL::Delaunay_triangulation_2<Static_kernel>;
  std::size_t bounded = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(seed % 2 == 0 ? test::random_motions(25, 10, 4, seed)
                                           : test::grid_motions(14, 5, 1, seed));
    kinetic.advance_to(0.25 * seed);
    const Rational t(static_cast<int>(seed), 4);
    const Oracle oracle(kinetic, t);
    Static_triangulation reference;
    for (const auto& [id, p] : oracle.places()) reference.insert(p);
    ASSERT_EQ(reference.dimension(), 2);
    const Kinetic_queries_2 queries(kinetic);
    for (const auto& [id, p] : oracle.places()) {
      const auto v = reference.nearest_vertex(p);
      std::vector<std::optional<Static_point>> centers;
      auto face = reference.incident_faces(v);
      const auto start = face;
      do {
        const auto center = reference.is_infinite(face)
                                ? std::optional<Static_point>()
                                : std::optional<Static_point>(reference.dual(face));
        if (centers.empty() || centers.back() != center) centers.push_back(center);
      } while (++face != start);
      if (centers.size() > 1 && centers.front() == centers.back()) centers.pop_back();
      const auto outside = std::ranges::find(centers, std::optional<Static_point>());
      const auto cell = queries.voronoi_cell(id);
      EXPECT_EQ(cell.is_bounded(), outside == centers.end());
      std::vector<std::optional<Static_point>> vertices;
      for (const auto& x : cell.vertices) vertices.emplace_back(point(x));
      if (outside != centers.end()) {
        std::rotate(centers.begin(), outside, centers.end());
        centers.erase(centers.begin());
      } else {
        ++bounded;
        std::rotate(centers.begin(), std::ranges::find(centers, vertices.front()), centers.end());
      }
      ASSERT_EQ(vertices, centers) << "cell of " << id;
    }
  }
  EXPECT_GT(bounded, 50u);
}

// The corners of a square and its center: four cocircular neighbors of each corner's kind.
TEST(Queries, a_voronoi_cell_has_no_side_without_length) {
  const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}},
                                  {{2, 0}, {0, 0}},
                                  {{2, 2}, {0, 0}},
                                  {{0, 2}, {0, 0}},
                                  {{1, 1}, {0, 0}},
                                  {{4, 0}, {0, 0}}});
  const Kinetic_queries_2 queries(kinetic);
  const auto center = queries.voronoi_cell(4);
  EXPECT_EQ(center.neighbors, (std::vector<Point_id>{0, 1, 2, 3}));
  ASSERT_EQ(center.vertices.size(), 4u);
  const auto corner = queries.voronoi_cell(0);
  EXPECT_EQ(corner.neighbors, (std::vector<Point_id>{1, 4, 3}));
  ASSERT_EQ(corner.vertices.size(), 2u);
  EXPECT_EQ(point(corner.vertices[0]), Static_point(1, 0));
  EXPECT_EQ(point(corner.vertices[1]), Static_point(0, 1));
  const auto rays = queries.rounded_voronoi_cell(0).rays;
  ASSERT_TRUE(rays);
  EXPECT_EQ((*rays)[0], (Vector_2{0, -2}));
  EXPECT_EQ((*rays)[1], (Vector_2{-2, 0}));
}

TEST(Queries, neighbors_are_counterclockwise_and_those_of_all_edges) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(test::random_motions(3 + seed, 10, 4, seed));
    kinetic.advance_to(1.0);
    const Kinetic_queries_2 queries(kinetic);
    const Oracle oracle(kinetic, 1);
    std::set<Edge_ids> edges;
    for (const auto& [id, place] : oracle.places()) {
      const std::vector<Point_id> around = queries.neighbors(id);
      for (const Point_id other : around) edges.insert(edge_ids(id, other));
      // Counterclockwise: only over the last one and the first may there be half a turn or more.
      for (std::size_t i = 0; i + 1 < around.size(); ++i) {
        EXPECT_TRUE(CGAL::left_turn(place, oracle.place(around[i]), oracle.place(around[i + 1])));
      }
      if (CGAL::left_turn(place, oracle.place(around.back()), oracle.place(around.front()))) {
        if (around.size() > 2) {
          EXPECT_EQ(around.front(), *std::ranges::min_element(around));
        }
      }
    }
    EXPECT_EQ(edges, test::edges_of(kinetic));
  }
  const Kinetic_delaunay on_line({{{2, 0}, {0, 0}}, {{4, 0}, {0, 0}}, {{0, 0}, {0, 0}}});
  EXPECT_EQ(Kinetic_queries_2(on_line).neighbors(0), (std::vector<Point_id>{1, 2}));
  EXPECT_EQ(Kinetic_queries_2(on_line).neighbors(1), (std::vector<Point_id>{0}));
}

// ---- irrational times ----

// So near to a time that random input does not tell the two apart, and rational.
Rational rational_near(const Algebraic_number& time) {
  time.refine_to_bits(400);
  return time.lower();
}

TEST(Queries, at_an_irrational_time_are_answered_as_right_beside_it) {
  int asked = 0;
  for (unsigned seed = 0; seed < 10u * static_cast<unsigned>(test::multiplier()); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> anywhere(-2, 12);
    Kinetic_delaunay kinetic(test::random_motions(5 + seed % 10 / 2, 10, 5, seed));
    for (int i = 0; i < 3; ++i) {
      const auto next = kinetic.next_event_time();
      if (!next) break;
      const Rational far = to_rational(1e50);
      // A root of 2 t^2 = a^2 + b^2, between a and b.
      const Rational a = simplest_between(kinetic.current_time(), *next);
      const Rational b = simplest_between(a, *next);
      const Rational square = (a * a + b * b) / 2;
      const Algebraic_number mean(Polynomial{-boost::multiprecision::numerator(square), 0,
                                             boost::multiprecision::denominator(square)},
                                  a, b);
      for (const Algebraic_number& time : {kinetic.current_time(), mean, *next}) {
        if (rational_value(time)) continue;
        ++asked;
        const Kinetic_queries_2 queries(kinetic, time);
        const Oracle oracle(kinetic, rational_near(time));
        EXPECT_EQ(queries.closest_pair(), oracle.closest_pair());
        for (int j = 0; j < 10; ++j) {
          const Vector_2 place = {anywhere(random), anywhere(random)};
          EXPECT_EQ(queries.nearest_vertex(place), oracle.nearest(exact(place)));
          EXPECT_EQ(queries.locate(place), oracle.locate(exact(place)));
        }
        EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(0),
                                  "at a time that is not known to be rational a Voronoi vertex has "
                                  "no exact coordinates; call rounded_voronoi_cell");
        for (const auto& [id, place] : oracle.places()) {
          const auto cell = queries.rounded_voronoi_cell(id);
          // At the time of a flip there is a side less than beside it, whose ends round alike; at
          // that of a hull event, where three points are collinear, a vertex less, which is far.
          std::vector<Vector_2> vertices;
          const auto sides = oracle.cell(id);
          for (const auto& [other, side] : sides) {
            if (!side.target || CGAL::abs(side.target->x()) + CGAL::abs(side.target->y()) > far) {
              continue;
            }
            vertices.push_back({to_double(side.target->x()), to_double(side.target->y())});
          }
          const auto by_coordinates = [](const Vector_2& p, const Vector_2& q) {
            return std::pair(p.x, p.y) < std::pair(q.x, q.y);
          };
          std::ranges::sort(vertices, by_coordinates);
          vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
          auto found = cell.vertices;
          std::ranges::sort(found, by_coordinates);
          EXPECT_EQ(found, vertices) << "cell of " << id;
          EXPECT_TRUE(std::ranges::adjacent_find(found) == found.end());
        }
      }
      kinetic.step();
    }
  }
  EXPECT_GT(asked, 50);
}

// The pair 2-3 is at the distance sqrt(2) t, the pair 0-1 at 2: equal at sqrt(2), where the ids
// decide.
TEST(Queries, a_tie_at_an_irrational_time_is_found) {
  const Kinetic_delaunay kinetic(
      std::vector<Linear_motion_2>{
          {{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{9, 0}, {0, 0}}, {{9, 0}, {1, 1}}},
      Algebraic_number(1.0));
  const Algebraic_number root(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  ASSERT_FALSE(kinetic.has_event_before(2.0));
  EXPECT_EQ(Kinetic_queries_2(kinetic, 1.25).closest_pair(), (Edge_ids{2, 3}));
  EXPECT_EQ(Kinetic_queries_2(kinetic, root).closest_pair(), (Edge_ids{0, 1}));
  EXPECT_EQ(Kinetic_queries_2(kinetic, 1.5).closest_pair(), (Edge_ids{0, 1}));
}

// The pair 2-3 is longer or shorter than 1, the length of the pair 0-1, by 2^-40 t: far less than
// the error of its coordinates in binary64.
TEST(Queries, lengths_that_floating_point_cannot_tell_apart_are_compared_exactly) {
  for (const double difference : {-0x1p-40, 0x1p-40}) {
    const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}},
                                    {{1, 0}, {0, 0}},
                                    {{1e6, 5}, {3, 0}},
                                    {{1e6 + 1, 5}, {3 + difference, 0}}});
    EXPECT_EQ(Kinetic_queries_2(kinetic, 0.1).closest_pair(),
              (difference < 0 ? Edge_ids{2, 3} : Edge_ids{0, 1}));
  }
}

// ---- numbers of any size ----

TEST(Queries, of_tiny_and_huge_coordinates_are_exact) {
  const Kinetic_delaunay kinetic({{{1e300, 0}, {1e10, 0}},
                                  {{-1e300, 1}, {0, 3}},
                                  {{0, 0}, {0, 0}},
                                  {{1e-300, 0}, {0, 0}},
                                  {{0, 3e-300}, {0, 0}},
                                  {{0, 1.7e308}, {0, 0}}});
  std::mt19937_64 random(5);
  expect_right_answers(kinetic, 0.0, 0, random);
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_EQ(queries.closest_pair(), (Edge_ids{2, 3}));
  EXPECT_EQ(queries.nearest_vertex({1e-300, 1e-301}), 3u);
  EXPECT_EQ(queries.nearest_vertex({-1.7e308, 1.7e308}), 5u);
}

// ---- times and other preconditions ----

TEST(Queries, at_a_time_that_is_past_or_beyond_the_next_event_are_refused) {
  // The flip at t = 2 of a test of the triangulation.
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  kinetic.advance_to(0.5);
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic, 0.25),
                            "a query about the past; query a time before the triangulation "
                            "advances beyond it");
  EXPECT_NO_THROW(Kinetic_queries_2(kinetic, 0.5));
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic, 2.0000000000000004),
                            "a query about a time after the next event; call advance_to for that "
                            "time first");
  EXPECT_EQ(Kinetic_queries_2(kinetic, 2.0).neighbors(0), (std::vector<Point_id>{1, 2, 3}));
  kinetic.advance_to(2.0);
  EXPECT_EQ(Kinetic_queries_2(kinetic, 2.0).neighbors(0), (std::vector<Point_id>{1, 3}));
}

TEST(Queries, after_an_event_are_refused_and_after_mere_time_are_not) {
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  const Kinetic_queries_2 queries(kinetic, 1.0);
  kinetic.advance_to(1.5);
  EXPECT_EQ(queries.nearest_vertex({0, 3}), 3u);
  kinetic.advance_to(2.0);
  EXPECT_PRECONDITION_ERROR(
      queries.nearest_vertex({0, 3}),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.locate({0, 3}),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.neighbors(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.voronoi_cell(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.rounded_voronoi_cell(0),
      "the triangulation has changed since these queries were made; make new ones after an event");
  EXPECT_PRECONDITION_ERROR(
      queries.closest_pair(),
      "the triangulation has changed since these queries were made; make new ones after an event");
}

TEST(Queries, of_a_place_that_is_not_finite_or_of_no_point_are_refused) {
  const Kinetic_delaunay kinetic({{{0, 0}, {0, 0}}, {{2, 0}, {0, 0}}, {{9, 5}, {0, 0}}});
  const Kinetic_queries_2 queries(kinetic);
  EXPECT_PRECONDITION_ERROR(queries.nearest_vertex({infinity, 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({0, -infinity}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.locate({std::numeric_limits<double>::quiet_NaN(), 0}),
                            "a place has a coordinate that is not finite");
  EXPECT_PRECONDITION_ERROR(queries.neighbors(3), "no point has the id 3; ask contains(id) first");
  EXPECT_PRECONDITION_ERROR(queries.voronoi_cell(no_point),
                            "no point has the id 4294967295; ask contains(id) first");
  EXPECT_PRECONDITION_ERROR(queries.rounded_voronoi_cell(3),
                            "no point has the id 3; ask contains(id) first");
}

TEST(Queries, of_erased_and_inserted_points_know_them) {
  Kinetic_delaunay kinetic(test::random_motions(12, 10, 3, 5));
  kinetic.advance_to(0.5);
  kinetic.erase(3);
  kinetic.erase(0);
  kinetic.insert({{4, 4}, {1, 1}, 0.5});
  std::mt19937_64 random(9);
  expect_right_answers(kinetic, 0.5, Rational(1, 2), random);
  EXPECT_PRECONDITION_ERROR(Kinetic_queries_2(kinetic).neighbors(3),
                            "no point has the id 3; ask contains(id) first");
}

// has_event_before looks again where next_event_time does, but keeps nothing.
TEST(Has_event_before, agrees_with_the_next_event_time_and_changes_nothing) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = seed % 3 == 0 ? test::grid_motions(6, 3, 1, seed)
                                       : test::random_motions(8 + 2 * seed, 30, 3, seed);
    Kinetic_delaunay asked(motions);
    Kinetic_delaunay undisturbed(motions);
    Kinetic_delaunay known(motions);
    for (int i = 0; i < 25; ++i) {
      const auto next = known.next_event_time();
      if (!next) break;
      EXPECT_FALSE(asked.has_event_before(*next));
      EXPECT_FALSE(asked.has_event_before(asked.current_time()));
      EXPECT_FALSE(asked.has_event_before(simplest_between(asked.current_time(), *next)));
      EXPECT_TRUE(asked.has_event_before(simplest_between(*next, next->upper() + 1)));
      EXPECT_TRUE(asked.has_event_before(next->upper() + 1000));
      EXPECT_FALSE(known.has_event_before(*next));
      EXPECT_TRUE(known.has_event_before(simplest_between(*next, next->upper() + 1)));
      EXPECT_EQ(asked.queue_counters(), undisturbed.queue_counters());
      EXPECT_EQ(asked.certificate_counters(), undisturbed.certificate_counters());
      for (Kinetic_delaunay* kinetic : {&asked, &undisturbed, &known}) kinetic->step();
    }
    EXPECT_EQ(asked.current_time(), undisturbed.current_time());
    EXPECT_EQ(asked.finite_edge_ids(), undisturbed.finite_edge_ids());
    EXPECT_TRUE(asked.audit(Audit_level::certificates).passed());
  }
}

TEST(Has_event_before, of_a_triangulation_that_never_changes_is_never_true) {
  const Kinetic_delaunay kinetic({{{0, 0}, {1, 1}}, {{2, 0}, {1, 1}}, {{0, 5}, {1, 1}}});
  EXPECT_FALSE(kinetic.has_event_before(1e300));
}

}  // namespace
}  // namespace kinetri
