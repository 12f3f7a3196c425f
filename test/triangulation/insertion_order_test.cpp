// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of one line, and nearly all of one line, are inserted with as many predicates as others
// are, but for a factor; and the triangulation at the start of such points is right.
#include "kinetri/impl/triangulation/insertion_order.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::insertion_order_test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using test::Kinetic_delaunay;

std::uint64_t predicates = 0;

// A predicate that counts its calls.
template <class Predicate>
struct Counted : Predicate {
  explicit Counted(const Predicate& predicate) : Predicate(predicate) {}
  template <class... Arguments>
  decltype(auto) operator()(const Arguments&... arguments) const {
    ++predicates;
    return static_cast<const Predicate&>(*this)(arguments...);
  }
};

struct Counting_kernel : Kernel {
  using Compare_x_2 = Counted<Kernel::Compare_x_2>;
  using Compare_y_2 = Counted<Kernel::Compare_y_2>;
  using Compare_xy_2 = Counted<Kernel::Compare_xy_2>;
  using Orientation_2 = Counted<Kernel::Orientation_2>;
  using Less_x_2 = Counted<Kernel::Less_x_2>;
  using Less_y_2 = Counted<Kernel::Less_y_2>;

  Compare_x_2 compare_x_2_object() const { return Compare_x_2({}); }
  Compare_y_2 compare_y_2_object() const { return Compare_y_2({}); }
  Compare_xy_2 compare_xy_2_object() const { return Compare_xy_2({}); }
  Orientation_2 orientation_2_object() const { return Orientation_2({}); }
  Less_x_2 less_x_2_object() const { return Less_x_2({}); }
  Less_y_2 less_y_2_object() const { return Less_y_2({}); }
};

using Counting_delaunay = CGAL::Delaunay_triangulation_2<Counting_kernel>;

// How many predicates the insertion of the points takes.
std::uint64_t predicates_for(std::vector<Point> points) {
  predicates = 0;
  Counting_delaunay triangulation;
  detail::sort_for_insertion(points, Counting_kernel());
  detail::insert_in_order(triangulation, points, std::identity(), [](auto, const Point&) {});
  EXPECT_EQ(triangulation.number_of_vertices(), points.size());
  EXPECT_TRUE(triangulation.is_valid());
  return predicates;
}

std::vector<Point> on_line(std::size_t n, double dx, double dy, std::uint64_t seed) {
  std::vector<Point> result;
  for (std::size_t k = 0; k < n; ++k) {
    result.emplace_back(dx * static_cast<double>(k), dy * static_cast<double>(k));
  }
  std::ranges::shuffle(result, std::mt19937_64(seed));
  return result;
}

// CGAL's own insertion of the first of these takes some 10^7 of them.
TEST(Insertion_order, takes_few_predicates_for_points_of_a_line) {
  constexpr std::size_t n = 4000;
  const auto most = static_cast<std::uint64_t>(n * (4 * std::log2(n) + 40));
  EXPECT_LT(predicates_for(on_line(n, 1, 0, 1)), most);
  EXPECT_LT(predicates_for(on_line(n, 0, 1, 2)), most) << "vertical";
  EXPECT_LT(predicates_for(on_line(n, 1, -2, 3)), most) << "aslant";
  for (const std::size_t others : {1u, 2u, 5u}) {
    std::vector<Point> points = on_line(n, 1, 2, 4);
    for (std::size_t k = 0; k < others; ++k) {
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(700 * k + 1),
                    Point(static_cast<double>(100 * k), -7));
    }
    EXPECT_LT(predicates_for(points), 3 * most) << others << " beside the line";
  }
}

TEST(Insertion_order, is_that_of_cgal_where_points_are_on_no_line) {
  std::mt19937_64 random(5);
  std::vector<Point> points;
  for (int k = 0; k < 3000; ++k) {
    points.emplace_back(static_cast<double>(random() % 50), static_cast<double>(random() % 50));
  }
  std::vector<Point> expected = points;
  CGAL::spatial_sort(expected.begin(), expected.end(), Kernel());
  EXPECT_FALSE(detail::sort_for_insertion(points, Kernel()));
  EXPECT_EQ(points, expected);
}

TEST(Insertion_order, knows_whether_all_are_on_a_line) {
  const auto are_on_line = [](std::vector<Point> points) {
    return detail::sort_for_insertion(points, Kernel());
  };
  EXPECT_TRUE(are_on_line({}));
  EXPECT_TRUE(are_on_line({{1, 2}}));
  EXPECT_TRUE(are_on_line({{1, 2}, {1, 2}, {1, 2}}));
  EXPECT_TRUE(are_on_line({{1, 2}, {1, 2}, {3, 4}, {2, 3}}));
  EXPECT_FALSE(are_on_line({{1, 2}, {1, 2}, {3, 4}, {2, 3}, {2, 4}}));
}

// ---- the start of kinetic triangulations ----

// Points of a line, at rest or in motion along it or with it, in any order.
std::vector<Linear_motion_2> motions_on_line(std::size_t n, const Vector_2& step,
                                             const std::function<Vector_2(std::size_t)>& velocity) {
  std::vector<Linear_motion_2> result;
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = static_cast<double>(k);
    result.push_back({{3 + step.x * at, step.y * at}, velocity(k)});
  }
  std::ranges::shuffle(result, std::mt19937_64(7));
  return result;
}

std::vector<Edge_ids> edges_along(const std::vector<Linear_motion_2>& motions) {
  std::vector<Point_id> order;
  for (std::size_t k = 0; k < motions.size(); ++k) order.push_back(static_cast<Point_id>(k));
  std::ranges::sort(order, {}, [&](Point_id id) {
    return std::pair(motions[id].position.x, motions[id].position.y);
  });
  std::vector<Edge_ids> result;
  for (std::size_t k = 1; k < order.size(); ++k) {
    result.push_back(edge_ids(order[k - 1], order[k]));
  }
  std::ranges::sort(result);
  return result;
}

TEST(Start_of_a_line, has_the_edges_along_it) {
  for (const Vector_2 step : {Vector_2{1, 0}, Vector_2{0, 1}, Vector_2{0.25, -3}}) {
    for (const std::size_t n : {2u, 3u, 15u, 16u, 17u, 300u}) {
      const auto at_rest = motions_on_line(n, step, [](std::size_t) { return Vector_2{}; });
      const auto together = motions_on_line(n, step, [](std::size_t) { return Vector_2{1, -2}; });
      // Apart, along the line.
      const auto along = motions_on_line(n, step, [&](std::size_t k) {
        return Vector_2{step.x * static_cast<double>(k), step.y * static_cast<double>(k)};
      });
      for (const auto& motions : {at_rest, together, along}) {
        Kinetic_delaunay kinetic(motions);
        EXPECT_EQ(kinetic.finite_edge_ids(), edges_along(motions));
        EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "");
        kinetic.advance_to(3.0);
        EXPECT_EQ(kinetic.finite_edge_ids(), edges_along(motions));
        EXPECT_EQ(kinetic.counters().number_of_events(), 0u);
      }
    }
  }
}

TEST(Start_of_a_line, with_points_beside_it_is_delaunay) {
  for (const std::size_t beside : {1u, 2u, 40u}) {
    auto motions = motions_on_line(300, {1, 0}, [](std::size_t) { return Vector_2{}; });
    for (std::size_t k = 0; k < beside; ++k) {
      motions.insert(motions.begin() + static_cast<std::ptrdiff_t>(5 * k),
                     Linear_motion_2{{static_cast<double>(7 * k), 1}, {0, 1}});
    }
    const Kinetic_delaunay kinetic(motions);
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "") << beside;
  }
}

TEST(Start_of_a_line, with_points_in_one_place_is_refused) {
  auto motions = motions_on_line(200, {2, 1}, [](std::size_t) { return Vector_2{}; });
  motions.push_back(motions[17]);
  motions.push_back(motions[3]);
  for (const bool is_one_beside : {false, true}) {
    if (is_one_beside) motions.push_back({{0, 9}, {}});
    try {
      const Kinetic_delaunay kinetic(motions, {}, {}, Coincident_points::refuse);
      FAIL() << "expected an error";
    } catch (const Coincident_trajectories_error& error) {
      EXPECT_TRUE(edge_ids(error.first(), error.second()) == (Edge_ids{17, 200}) ||
                  edge_ids(error.first(), error.second()) == (Edge_ids{3, 201}))
          << error.what();
    }
  }
}

// Discs of a line, some of which hide others.
TEST(Start_of_a_line, of_discs_is_regular) {
  std::mt19937_64 random(11);
  std::size_t hidden = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Disc_motion_2> motions;
    for (const auto& motion :
         motions_on_line(40 + static_cast<std::size_t>(round), {1, 2}, [](std::size_t) {
           return Vector_2{1, 0};
         })) {
      motions.push_back({motion, static_cast<double>(random() % 7) / 2, 0, 0});
    }
    Kinetic_regular_triangulation_2<> kinetic(motions);
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "") << "round " << round;
    hidden += kinetic.number_of_hidden_points();
  }
  EXPECT_GT(hidden, 20u);
}

// All points of a line for an instant, after which it is built anew.
TEST(Start_of_a_line, for_an_instant_is_built_anew) {
  std::vector<Linear_motion_2> motions;
  for (std::size_t k = 0; k < 200; ++k) {
    const auto at = static_cast<double>(k * 37 % 200);
    const double speed = static_cast<double>(k % 7) - 3;
    motions.push_back({{at, -speed}, {0, speed}});  // on a line at time 1
  }
  Kinetic_delaunay kinetic(motions);
  kinetic.advance_to(1.0);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "");
  EXPECT_GT(kinetic.counters().reconstructions, 0u);
}

}  // namespace
}  // namespace kinetri::insertion_order_test
