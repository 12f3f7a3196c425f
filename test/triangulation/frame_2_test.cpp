// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames against what looking at all pairs and triples of exact places says.
#include "kinetri/triangulation/frame_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::frame_2_test {
namespace {

using test::Kinetic_delaunay;
using test::Static_point;
using Edge = std::array<std::size_t, 2>;
using Triangle = std::array<std::size_t, 3>;

// ---- the oracle: all triples ----

// The exact places at the frame's time, by position. Precondition: that time is exact.
template <class Kinetic>
std::vector<Static_point> places(const Kinetic& kinetic, const Frame_2& frame) {
  std::vector<Static_point> result;
  for (const Point_id id : frame.ids) {
    result.push_back(test::place_at(kinetic.motion(id), to_rational(frame.time)));
  }
  return result;
}

// All triangles whose circumscribed circle is empty. Precondition: no four points are cocircular.
std::vector<Triangle> delaunay_triangles(const std::vector<Static_point>& p) {
  std::vector<Triangle> result;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = i + 1; k < p.size(); ++k) {
        if (CGAL::orientation(p[i], p[j], p[k]) != CGAL::LEFT_TURN) continue;
        const bool is_empty = std::ranges::none_of(p, [&](const Static_point& q) {
          return CGAL::side_of_oriented_circle(p[i], p[j], p[k], q) == CGAL::ON_POSITIVE_SIDE;
        });
        if (is_empty) result.push_back({i, j, k});
      }
    }
  }
  std::ranges::sort(result);
  return result;
}

std::vector<Edge> edges_of(const std::vector<Triangle>& triangles) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [p, q] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      edges.insert({std::min(p, q), std::max(p, q)});
    }
  }
  return {edges.begin(), edges.end()};
}

// The edges that have all other points on one side. Precondition: no three points are collinear.
std::vector<Edge> hull_edges(const std::vector<Static_point>& p) {
  std::vector<Edge> result;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      std::set<CGAL::Orientation> sides;
      for (const Static_point& q : p) sides.insert(CGAL::orientation(p[i], p[j], q));
      sides.erase(CGAL::COLLINEAR);
      if (sides.size() == 1) result.push_back({i, j});
    }
  }
  return result;
}

template <class Kinetic>
void expect_right(const Kinetic& kinetic) {
  const Frame_2 frame = frame_of(kinetic);
  const std::vector<Static_point> p = places(kinetic, frame);
  EXPECT_EQ(frame.triangles, delaunay_triangles(p));
  EXPECT_EQ(frame.edges, edges_of(frame.triangles));
  EXPECT_EQ(frame.hull, hull_edges(p));
  ASSERT_EQ(frame.places.size(), p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    // All terms are below 2^10: some units in the last place of that.
    const Rational bound = to_rational(std::ldexp(1.0, -40));
    EXPECT_LT(abs(to_rational(frame.places[i].x) - p[i].x()), bound);
    EXPECT_LT(abs(to_rational(frame.places[i].y) - p[i].y()), bound);
  }
}

// ---- tests ----

TEST(Frame, is_the_triangulation_at_its_time) {
  const auto motions = test::random_motions(24, 100, 10, 5);
  Kinetic_delaunay kinetic(motions);
  for (const double time : {0.0, 0.5, 1.25, 7.0}) {
    kinetic.advance_to(time);
    expect_right(kinetic);
    const Frame_2 frame = frame_of(kinetic);
    EXPECT_EQ(frame.time, time);
    EXPECT_EQ(frame.events, kinetic.counters().events);
    ASSERT_EQ(frame.ids.size(), motions.size());
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_EQ(frame.ids[i], i);
      EXPECT_EQ(frame.velocities[i], motions[i].velocity);
    }
  }
  EXPECT_GT(kinetic.counters().number_of_events(), 20U);
}

TEST(Frame, follows_points_that_accelerate) {
  std::vector<Polynomial_motion_2> motions;
  for (const Linear_motion_2& m : test::random_motions(16, 100, 10, 6)) {
    motions.push_back({m.position, m.velocity, {0.5, -2}, {0, 0.25}, 1});
    motions.back().acceleration.x *= static_cast<double>(motions.size());
  }
  Kinetic_delaunay_triangulation_2<Polynomial_kinetic_traits_2> kinetic(motions);
  kinetic.advance_to(3.0);
  expect_right(kinetic);
  const Frame_2 frame = frame_of(kinetic);
  // vy + ay s + jy s^2 / 2 with s = 3 - 1, of which no digit is lost.
  EXPECT_DOUBLE_EQ(frame.velocities[4].y, motions[4].velocity.y - 3.5);
}

TEST(Frame, names_points_by_their_places_among_those_that_are_there) {
  Kinetic_delaunay kinetic(test::random_motions(12, 100, 10, 7));
  for (const Point_id gone : {0U, 5U, 6U}) kinetic.erase(gone);
  kinetic.insert({{50, 50}, {1, 2}});
  const Frame_2 frame = frame_of(kinetic);
  EXPECT_EQ(frame.ids, (std::vector<Point_id>{1, 2, 3, 4, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(frame.velocities.back(), (Vector_2{1, 2}));
  expect_right(kinetic);
}

TEST(Frame, of_few_or_collinear_points_has_no_triangles) {
  struct Case {
    std::vector<Linear_motion_2> motions;
    std::vector<Edge> edges;
  };
  const std::vector<Case> cases = {
      {{}, {}},
      {{{{1, 2}, {0, 0}}}, {}},
      {{{{1, 2}, {0, 0}}, {{0, 0}, {1, 1}}}, {{0, 1}}},
      {{{{1, 1}, {0, 0}}, {{0, 0}, {0, 0}}, {{2, 2}, {0, 0}}}, {{0, 1}, {0, 2}}}};
  for (const auto& [motions, edges] : cases) {
    const Frame_2 frame = frame_of(Kinetic_delaunay(motions));
    EXPECT_EQ(frame.ids.size(), motions.size());
    EXPECT_EQ(frame.edges, edges);
    EXPECT_EQ(frame.hull, edges);
    EXPECT_TRUE(frame.triangles.empty());
  }
}

// The order of faces in memory is another one there.
TEST(Frame, depends_on_the_state_alone) {
  Kinetic_delaunay kinetic(test::random_motions(40, 100, 10, 8));
  kinetic.advance_to(2.0);
  EXPECT_EQ(frame_of(Kinetic_delaunay::restore(kinetic.snapshot())), frame_of(kinetic));
  std::vector<Linear_motion_2> motions;
  for (Point_id id = 0; id < 40; ++id) motions.push_back(kinetic.motion(id));
  Frame_2 later = frame_of(kinetic);
  later.events = {};
  EXPECT_EQ(frame_of(Kinetic_delaunay(motions, 2.0)), later);
}

TEST(Frame, of_an_irrational_time_is_rounded) {
  // 2 t^2 = 1: at sqrt(1/2) the fourth point reaches the circle of the others.
  Kinetic_delaunay kinetic(std::vector<Linear_motion_2>{
      {{1, 0}, {0, 0}}, {{-1, 0}, {0, 0}}, {{0, -1}, {0, 0}}, {{0, 0}, {1, 1}}});
  kinetic.step();
  EXPECT_EQ(frame_of(kinetic).time, kinetic.current_time().to_double());
  EXPECT_EQ(frame_of(kinetic).places[3].x, frame_of(kinetic).time);
}

// All numbers are multiples of 1/8, with which binary64 is exact.
TEST(Frame, of_a_periodic_box_has_images_within_it) {
  const Periodic_box_2 box({{8, 0}, {0, 0}}, {{1, 8}, {2, 0}});
  for (const std::size_t points : {1U, 2U, 5U, 40U}) {
    std::vector<Linear_motion_2> motions;
    for (std::size_t i = 0; i < points; ++i) {
      const auto k = static_cast<double>(i);
      motions.push_back({{std::fmod(37 * k, 161) / 8 - 4, std::fmod(53 * k, 167) / 8 - 3},
                         {std::fmod(3 * k, 7) / 8, std::fmod(5 * k, 11) / 8 - 0.5}});
    }
    Kinetic_triangulation_2<Periodic_kinetic_traits_2> kinetic(motions, 0,
                                                               Periodic_kinetic_traits_2(box));
    for (const double time : {0.0, 1.0, 7.0}) {
      kinetic.advance_to(time);
      const Frame_2 frame = frame_of(kinetic);
      ASSERT_TRUE(frame.periodic);
      EXPECT_TRUE(frame.hull.empty());
      const auto& [corners, edge_shifts, triangle_shifts] = *frame.periodic;
      const Vector_2 second = rounded_place(box.second(), time);
      const auto edges = kinetic.periodic_edges();
      ASSERT_EQ(frame.edges.size(), 3 * points);
      ASSERT_EQ(edge_shifts.size(), edges.size());
      for (const Vector_2& place : frame.places) {
        EXPECT_TRUE(place.y >= 0 && place.y < 8);
        const double along = place.x - place.y / 8 * corners[3].x;
        EXPECT_TRUE(along >= 0 && along < 8);
      }
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto& [ids, offset] = edges[i];
        EXPECT_EQ(frame.edges[i], (Edge{ids[0], ids[1]}));
        const Vector_2 a = rounded_place(motions[ids[0]], time);
        const Vector_2 b = rounded_place(motions[ids[1]], time);
        EXPECT_EQ(frame.places[ids[1]].x + edge_shifts[i].x - frame.places[ids[0]].x,
                  b.x + offset.x * 8 + offset.y * second.x - a.x);
        EXPECT_EQ(frame.places[ids[1]].y + edge_shifts[i].y - frame.places[ids[0]].y,
                  b.y + offset.y * 8.0 - a.y);
      }
      // The triangles cover the box once.
      ASSERT_EQ(frame.triangles.size(), 2 * points);
      ASSERT_EQ(triangle_shifts.size(), 2 * points);
      double twice = 0;
      for (std::size_t i = 0; i < frame.triangles.size(); ++i) {
        const auto& [a, b, c] = frame.triangles[i];
        EXPECT_TRUE(a <= b && a <= c);
        const auto [to_b, to_c] = triangle_shifts[i];
        const Vector_2& p = frame.places[a];
        const Vector_2 u = {frame.places[b].x + to_b.x - p.x, frame.places[b].y + to_b.y - p.y};
        const Vector_2 v = {frame.places[c].x + to_c.x - p.x, frame.places[c].y + to_c.y - p.y};
        EXPECT_GT(u.x * v.y - u.y * v.x, 0);
        twice += u.x * v.y - u.y * v.x;
      }
      EXPECT_EQ(twice, 2 * 64.0);
      EXPECT_EQ(frame_of(Kinetic_triangulation_2<Periodic_kinetic_traits_2>::restore(
                    kinetic.snapshot(), kinetic.traits())),
                frame);
    }
  }
}

}  // namespace
}  // namespace kinetri::frame_2_test
