// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's Delaunay triangulation on moving points at an instant, one-sided instants included.
#include "kinetri/kinetic/instantaneous_traits_2.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <gtest/gtest.h>

#include <concepts>
#include <memory>
#include <ostream>
#include <set>
#include <sstream>
#include <type_traits>

#include "kinetri/events/event.h"
#include "support/brute_force_simulator.h"
#include "support/motions.h"

namespace kinetri::instantaneous_traits_2_test {
namespace {

using Triangulation = CGAL::Delaunay_triangulation_2<Instantaneous_traits_2>;

Algebraic_number square_root_of_two() {
  return Algebraic_number(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
}

std::vector<Moving_point_2> moving_points(const std::vector<Linear_motion_2>& motions) {
  std::vector<Moving_point_2> points;
  for (const Linear_motion_2& m : motions) {
    points.emplace_back(m, static_cast<Point_id>(points.size()));
  }
  return points;
}

Triangulation triangulation_at(const std::vector<Linear_motion_2>& motions, Instant instant) {
  const auto points = moving_points(motions);
  Triangulation result{Instantaneous_traits_2(std::move(instant))};
  result.insert(points.begin(), points.end());
  return result;
}

std::set<Edge_ids> edges_of(const Triangulation& triangulation) {
  std::set<Edge_ids> result;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    result.insert(edge_ids(face->vertex(Triangulation::cw(i))->point().id(),
                           face->vertex(Triangulation::ccw(i))->point().id()));
  }
  return result;
}

TEST(Instant, beside_a_root_has_the_sign_of_the_first_derivative_that_does_not_vanish) {
  const Polynomial cubed = Polynomial{-8, 12, -6, 1};  // (t - 2)^3
  const Polynomial squared = Polynomial{4, -4, 1};     // (t - 2)^2
  const Algebraic_number two(2.0);
  EXPECT_EQ(sign_at(cubed, Instant{two, Time_side::before}), CGAL::NEGATIVE);
  EXPECT_EQ(sign_at(cubed, Instant{two, Time_side::at}), CGAL::ZERO);
  EXPECT_EQ(sign_at(cubed, Instant{two, Time_side::after}), CGAL::POSITIVE);
  EXPECT_EQ(sign_at(squared, Instant{two, Time_side::before}), CGAL::POSITIVE);
  EXPECT_EQ(sign_at(squared, Instant{two, Time_side::after}), CGAL::POSITIVE);
  EXPECT_EQ(sign_at(-squared, Instant{two, Time_side::before}), CGAL::NEGATIVE);
  EXPECT_EQ(sign_at(Polynomial(), Instant{two, Time_side::after}), CGAL::ZERO);
}

TEST(Instantaneous_traits_2, a_triangulation_at_a_rational_instant_is_that_of_the_places) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = test::random_motions(12, 10, 5, seed);
    const Rational t(static_cast<int>(seed), 3);
    const Triangulation triangulation = triangulation_at(motions, {t, Time_side::at});
    ASSERT_TRUE(triangulation.is_valid());
    ASSERT_EQ(edges_of(triangulation), test::edges_at(motions, t));
  }
}

TEST(Instantaneous_traits_2, a_triangulation_at_an_irrational_instant_is_valid) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = test::random_motions(12, 10, 5, seed);
    for (const Time_side side : {Time_side::before, Time_side::at, Time_side::after}) {
      const Triangulation triangulation = triangulation_at(motions, {square_root_of_two(), side});
      ASSERT_TRUE(triangulation.is_valid());
      // No event is anywhere near: the places at a rational time beside it have the same edges.
      const Rational near = to_rational(square_root_of_two().to_double());
      ASSERT_EQ(edges_of(triangulation), test::edges_at(motions, near));
    }
  }
}

// Four points cocircular at time 1, of which one moves through the circle.
const std::vector<Linear_motion_2> crossing = {
    {{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 2}, {0, -1}, 0}};

TEST(Instantaneous_traits_2, the_two_sides_of_an_event_have_the_two_diagonals) {
  const Algebraic_number one(1.0);
  const auto before = edges_of(triangulation_at(crossing, {one, Time_side::before}));
  const auto after = edges_of(triangulation_at(crossing, {one, Time_side::after}));
  EXPECT_TRUE(before.contains({0, 2}));
  EXPECT_FALSE(before.contains({1, 3}));
  EXPECT_TRUE(after.contains({1, 3}));
  EXPECT_FALSE(after.contains({0, 2}));
  EXPECT_TRUE(triangulation_at(crossing, {one, Time_side::at}).is_valid());
}

TEST(Instantaneous_traits_2, points_that_pass_through_one_another_are_one_vertex_only_at_the_time) {
  const std::vector<Linear_motion_2> passing = {
      {{-1, 0}, {1, 0}, 0}, {{1, 0}, {-1, 0}, 0}, {{0, 3}, {0, 0}, 0}, {{0, -3}, {0, 0}, 0}};
  const Algebraic_number one(1.0);
  EXPECT_EQ(triangulation_at(passing, {one, Time_side::before}).number_of_vertices(), 4u);
  EXPECT_EQ(triangulation_at(passing, {one, Time_side::at}).number_of_vertices(), 3u);
  EXPECT_EQ(triangulation_at(passing, {one, Time_side::at}).dimension(), 1);
  EXPECT_EQ(triangulation_at(passing, {one, Time_side::after}).number_of_vertices(), 4u);
  EXPECT_EQ(triangulation_at(passing, {one, Time_side::after}).dimension(), 2);
}

// What CGAL's manual documents of TriangulationTraits_2, of SpatialSortingTraits_2, which it
// refines, and of DelaunayTriangulationTraits_2, with the return types that it gives; and Equal_2,
// which the comparison of triangulations takes.
template <class Traits>
concept Delaunay_triangulation_traits = std::default_initializable<Traits> &&
    std::copyable<Traits> && requires(const Traits& traits, const typename Traits::Point_2& p,
                                      const typename Traits::Line_2& l, std::ostream& out) {
  typename Traits::Point_2;
  typename Traits::Segment_2;
  typename Traits::Triangle_2;
  typename Traits::Line_2;
  typename Traits::Ray_2;
  requires std::default_initializable<typename Traits::Point_2>;
  requires std::copyable<typename Traits::Point_2>;
  // What construct_point_2_object() gives is asked for as Construct_point_2, and so on.
  requires std::same_as<decltype(traits.construct_point_2_object()),
                        typename Traits::Construct_point_2>;
  requires std::same_as<decltype(traits.construct_segment_2_object()),
                        typename Traits::Construct_segment_2>;
  requires std::same_as<decltype(traits.construct_triangle_2_object()),
                        typename Traits::Construct_triangle_2>;
  requires std::same_as<decltype(traits.construct_circumcenter_2_object()),
                        typename Traits::Construct_circumcenter_2>;
  requires std::same_as<decltype(traits.construct_bisector_2_object()),
                        typename Traits::Construct_bisector_2>;
  requires std::same_as<decltype(traits.construct_ray_2_object()),
                        typename Traits::Construct_ray_2>;
  requires std::same_as<decltype(traits.less_x_2_object()), typename Traits::Less_x_2>;
  requires std::same_as<decltype(traits.less_y_2_object()), typename Traits::Less_y_2>;
  requires std::same_as<decltype(traits.compare_x_2_object()), typename Traits::Compare_x_2>;
  requires std::same_as<decltype(traits.compare_y_2_object()), typename Traits::Compare_y_2>;
  requires std::same_as<decltype(traits.compare_xy_2_object()), typename Traits::Compare_xy_2>;
  requires std::same_as<decltype(traits.equal_2_object()), typename Traits::Equal_2>;
  requires std::same_as<decltype(traits.orientation_2_object()), typename Traits::Orientation_2>;
  requires std::same_as<decltype(traits.side_of_oriented_circle_2_object()),
                        typename Traits::Side_of_oriented_circle_2>;
  requires std::same_as<decltype(traits.compare_distance_2_object()),
                        typename Traits::Compare_distance_2>;
  { traits.construct_point_2_object()(p) } -> std::convertible_to<typename Traits::Point_2>;
  { traits.construct_segment_2_object()(p, p) } -> std::same_as<typename Traits::Segment_2>;
  { traits.construct_triangle_2_object()(p, p, p) } -> std::same_as<typename Traits::Triangle_2>;
  { traits.construct_circumcenter_2_object()(p, p, p) } -> std::same_as<typename Traits::Point_2>;
  { traits.construct_bisector_2_object()(p, p) } -> std::same_as<typename Traits::Line_2>;
  { traits.construct_ray_2_object()(p, l) } -> std::same_as<typename Traits::Ray_2>;
  { traits.less_x_2_object()(p, p) } -> std::same_as<bool>;
  { traits.less_y_2_object()(p, p) } -> std::same_as<bool>;
  { traits.compare_x_2_object()(p, p) } -> std::same_as<CGAL::Comparison_result>;
  { traits.compare_y_2_object()(p, p) } -> std::same_as<CGAL::Comparison_result>;
  { traits.compare_xy_2_object()(p, p) } -> std::same_as<CGAL::Comparison_result>;
  { traits.equal_2_object()(p, p) } -> std::same_as<bool>;
  { traits.orientation_2_object()(p, p, p) } -> std::same_as<CGAL::Orientation>;
  { traits.side_of_oriented_circle_2_object()(p, p, p, p) } -> std::same_as<CGAL::Oriented_side>;
  { traits.compare_distance_2_object()(p, p, p) } -> std::same_as<CGAL::Comparison_result>;
  { out << p } -> std::same_as<std::ostream&>;  // is_valid prints points
};
static_assert(Delaunay_triangulation_traits<Instantaneous_traits_2>);
static_assert(Delaunay_triangulation_traits<Basic_instantaneous_traits_2<Polynomial_motion_2>>);

TEST(Instantaneous_traits_2, points_are_compared_lexicographically_at_the_instant) {
  // q passes through p at time 1, on its way to the right and up.
  const Moving_point_2 p({{1, 1}, {0, 0}, 0});
  const Moving_point_2 q({{0, 0}, {1, 1}, 0});
  const Moving_point_2 above({{1, 2}, {0, 0}, 0});
  const auto at = [](double time, Time_side side) {
    return Instantaneous_traits_2({Algebraic_number(time), side});
  };
  for (const Time_side side : {Time_side::before, Time_side::at, Time_side::after}) {
    const Instantaneous_traits_2 traits = at(1.0, side);
    const auto compare = traits.compare_xy_2_object();
    const auto expected = side == Time_side::before ? CGAL::LARGER
                          : side == Time_side::at   ? CGAL::EQUAL
                                                    : CGAL::SMALLER;
    EXPECT_EQ(compare(p, q), expected);
    EXPECT_EQ(compare(q, p), CGAL::opposite(expected));
    EXPECT_EQ(traits.equal_2_object()(p, q), side == Time_side::at);
    // Equal in x: y decides.
    EXPECT_EQ(compare(p, above), CGAL::SMALLER);
    EXPECT_EQ(compare(above, p), CGAL::LARGER);
    EXPECT_FALSE(traits.equal_2_object()(p, above));
  }
}

TEST(Moving_point_2, is_printed_with_its_id_and_motion) {
  std::ostringstream out;
  out << Moving_point_2({{0.5, -1}, {2, 0.25}, 3}, 7) << '\n'
      << Moving_point_2({{0.1, 0}, {0, 0}, 0}) << '\n'
      << Basic_moving_point_2<Polynomial_motion_2>({{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9}, 0) << '\n'
      << Moving_point_2(Trajectory_2({1, 2}, {3}, {0, -1}));
  EXPECT_EQ(out.str(),
            "point 7 (0.5, -1) at time 3, velocity (2, 0.25)\n"
            "point (0.10000000000000001, 0) at time 0, velocity (0, 0)\n"
            "point 0 (1, 2) at time 9, velocity (3, 4), acceleration (5, 6), jerk (7, 8)\n"
            "point ((2*t + 1) / (-t), (3) / (-t))");
  EXPECT_EQ(out.precision(), 6);
}

// Of a triangulation that shows its traits as const, who owns the clock alone sets the instant.
static_assert(!std::copy_constructible<Instant_clock> && !std::is_copy_assignable_v<Instant_clock>);

TEST(Instantaneous_traits_2, copies_follow_their_clock_and_may_outlive_it) {
  auto clock = std::make_unique<Instant_clock>(Instant{Algebraic_number(1.0), Time_side::before});
  const Triangulation triangulation{Instantaneous_traits_2(*clock)};
  const Instantaneous_traits_2 copy(triangulation.geom_traits());
  const Instantaneous_traits_2 fixed(clock->instant());
  // The second point overtakes the first one at t = 2.
  const Moving_point_2 p({{2, 0}, {0, 0}, 0});
  const Moving_point_2 q({{0, 0}, {1, 0}, 0});
  const auto compare = triangulation.geom_traits().compare_x_2_object();
  EXPECT_EQ(compare(p, q), CGAL::LARGER);
  clock->set({Algebraic_number(2.0), Time_side::after});
  EXPECT_EQ(compare(p, q), CGAL::SMALLER);
  EXPECT_EQ(clock->instant().time, Algebraic_number(2.0));
  clock.reset();
  EXPECT_EQ(compare(p, q), CGAL::SMALLER);
  EXPECT_EQ(copy.instant().time, Algebraic_number(2.0));
  EXPECT_EQ(copy.instant().side, Time_side::after);
  EXPECT_EQ(copy.compare_x_2_object()(p, q), CGAL::SMALLER);
  EXPECT_EQ(fixed.instant().time, Algebraic_number(1.0));
  EXPECT_EQ(fixed.compare_x_2_object()(p, q), CGAL::LARGER);
}

TEST(Instantaneous_traits_2, cgal_queries_and_changes_work_at_an_irrational_instant) {
  auto motions = test::random_motions(15, 10, 5, 99);
  const Instant instant{square_root_of_two(), Time_side::after};
  Triangulation triangulation = triangulation_at(motions, instant);
  const Rational near = to_rational(square_root_of_two().to_double());

  const Linear_motion_2 resting{{4, 5}, {0, 0}, 0};
  const Moving_point_2 query(resting);
  const auto nearest = triangulation.nearest_vertex(query);
  Point_id expected = 0;
  for (Point_id id = 1; id < motions.size(); ++id) {
    if (CGAL::compare_distance_to_point(test::place_at(resting, near),
                                        test::place_at(motions[id], near),
                                        test::place_at(motions[expected], near)) == CGAL::SMALLER) {
      expected = id;
    }
  }
  EXPECT_EQ(nearest->point().id(), expected);

  const auto face = triangulation.locate(query);
  ASSERT_FALSE(triangulation.is_infinite(face));
  EXPECT_NE(triangulation.oriented_side(face, query), CGAL::ON_NEGATIVE_SIDE);

  triangulation.remove(nearest);
  EXPECT_TRUE(triangulation.is_valid());
  EXPECT_EQ(triangulation.number_of_vertices(), 14u);
  triangulation.insert(Moving_point_2(motions[expected], expected));
  EXPECT_TRUE(triangulation.is_valid());
  EXPECT_EQ(edges_of(triangulation), edges_of(triangulation_at(motions, instant)));
}

TEST(Instantaneous_traits_2, the_dual_is_the_voronoi_diagram) {
  const auto motions = test::random_motions(10, 10, 5, 3);
  const Rational t(1, 2);
  const Triangulation triangulation = triangulation_at(motions, {t, Time_side::after});
  for (const auto face : triangulation.finite_face_handles()) {
    const Exact_position_2 center = triangulation.dual(face).position(t);
    const test::Static_point expected =
        CGAL::circumcenter(test::place_at(face->vertex(0)->point().motion(), t),
                           test::place_at(face->vertex(1)->point().motion(), t),
                           test::place_at(face->vertex(2)->point().motion(), t));
    EXPECT_EQ(center.x, expected.x());
    EXPECT_EQ(center.y, expected.y());
  }
  int rays = 0;
  for (const auto& edge : triangulation.finite_edges()) {
    const CGAL::Object dual = triangulation.dual(edge);
    if (CGAL::object_cast<Instantaneous_traits_2::Ray_2>(&dual) != nullptr) ++rays;
  }
  int hull = 0;
  auto circulator = triangulation.incident_vertices(triangulation.infinite_vertex());
  const auto done = circulator;
  do ++hull;
  while (++circulator != done);
  EXPECT_EQ(rays, hull);
}

}  // namespace
}  // namespace kinetri::instantaneous_traits_2_test
