// SPDX-License-Identifier: GPL-3.0-or-later
//
// Several threads ask the predicates of one instant about the same points. ThreadSanitizer says
// whether they race (scripts/test.sh --preset tsan).
#include <CGAL/enum.h>
#include <gtest/gtest.h>

#include <latch>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "kinetri/kinetic/instantaneous_traits_2.h"

namespace kinetri::kinetic_threads_test {
namespace {

// What the predicates and constructions find of every four of the points.
template <class Traits>
std::string findings(const Traits& traits, const std::vector<typename Traits::Point_2>& points) {
  std::ostringstream out;
  for (const auto& p : points) {
    for (const auto& q : points) {
      out << traits.compare_xy_2_object()(p, q) << traits.equal_2_object()(p, q);
      for (const auto& r : points) {
        out << traits.orientation_2_object()(p, q, r)
            << traits.compare_distance_2_object()(p, q, r);
      }
    }
  }
  for (std::size_t i = 0; i + 3 < points.size(); ++i) {
    const auto p = points[i];  // copies share what constructed points are made of
    out << traits.side_of_oriented_circle_2_object()(p, points[i + 1], points[i + 2],
                                                     points[i + 3]);
  }
  out << traits.instant().time.to_double();
  return out.str();
}

// A lattice, some of whose points move, with the center of a circle.
std::vector<Moving_point_2> some_points() {
  std::vector<Moving_point_2> points;
  for (int i = 0; i < 9; ++i) {
    const Linear_motion_2 motion{
        {double(i % 3), double(i / 3)}, {double(i % 2), double(i % 5 == 0)}, 0};
    points.emplace_back(motion, static_cast<Point_id>(i));
  }
  points.push_back(
      Instantaneous_traits_2().construct_circumcenter_2_object()(points[0], points[4], points[5]));
  return points;
}

TEST(Threads, ask_the_predicates_of_one_instant) {
  const auto square_root_of_two = [] {
    return Algebraic_number(Polynomial{-2, 0, 1}, Rational(1), Rational(2));
  };
  for (const Arithmetic arithmetic : {Arithmetic::filtered, Arithmetic::exact_only}) {
    const auto instant = [&] { return Instant{square_root_of_two(), Time_side::after}; };
    const std::string expected =
        findings(Instantaneous_traits_2(instant(), arithmetic), some_points());
    const Instantaneous_traits_2 traits(instant(), arithmetic);
    const std::vector<Moving_point_2> points = some_points();
    constexpr int thread_count = 4;
    std::vector<std::string> found(thread_count);
    std::latch start(thread_count);
    {
      std::vector<std::jthread> threads;
      for (std::string& result : found) {
        threads.emplace_back([&start, &traits, &points, &result] {
          start.arrive_and_wait();
          result = findings(traits, points);
        });
      }
    }
    for (const std::string& result : found) EXPECT_EQ(result, expected);
  }
}

}  // namespace
}  // namespace kinetri::kinetic_threads_test
