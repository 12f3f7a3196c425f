// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/widest_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "observers/random_runs.h"
#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::widest_path_test {
namespace {

using Kinetic = Kinetic_triangulation_2<Linear_kinetic_traits_2>;
using Places = std::vector<test::Static_point>;

Places places_at(const Kinetic& kinetic, const Rational& t) {
  Places result;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    result.push_back(test::place_at(kinetic.motion(id), t));
  }
  return result;
}

// ---- the oracle, which knows no triangulation ----

// Whether the discs about the places, whose diameter has this square, without their rims, separate
// a and b: whether a closed chain of discs that overlap crosses the segment ab an odd number of
// times. Precondition: no place is on the line ab.
bool are_separated(const Places& places, const test::Static_point& a, const test::Static_point& b,
                   const Rational& squared_diameter) {
  // Each place has a parent, and the parity of the crossings on the way to it.
  std::vector<std::pair<std::size_t, bool>> parents(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) parents[i] = {i, false};
  const auto root = [&](std::size_t i) {
    bool is_odd = false;
    while (parents[i].first != i) {
      is_odd = is_odd != parents[i].second;
      i = parents[i].first;
    }
    return std::pair(i, is_odd);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (CGAL::squared_distance(places[i], places[j]) >= squared_diameter) continue;
      const bool crosses =
          CGAL::orientation(a, b, places[i]) != CGAL::orientation(a, b, places[j]) &&
          CGAL::orientation(places[i], places[j], a) != CGAL::orientation(places[i], places[j], b);
      const auto [p, p_is_odd] = root(i);
      const auto [q, q_is_odd] = root(j);
      const bool is_odd = (p_is_odd != q_is_odd) != crosses;
      if (p == q && is_odd) return true;
      if (p != q) parents[p] = {q, is_odd};
    }
  }
  return false;
}

// The square of the greatest diameter of a disc that is clear of all points.
Rational squared_clearance(const Places& places, const test::Static_point& a) {
  Rational least = CGAL::squared_distance(places[0], a);
  for (const auto& place : places)
    least = std::min(least, Rational(CGAL::squared_distance(place, a)));
  return 4 * least;
}

void check_gaps_are_edges(const Kinetic& kinetic, const Widest_path& path) {
  const auto edges = kinetic.finite_edge_ids();
  for (const Edge_ids& gap : path.gaps) EXPECT_TRUE(std::ranges::binary_search(edges, gap));
  EXPECT_EQ(path.narrowest.has_value(), !path.gaps.empty());
}

// A disc a little wider than the way is enclosed; one as wide as the way is not.
TEST(Widest_path, is_as_wide_as_the_widest_disc_that_can_go) {
  int compared = 0;
  for (unsigned seed = 0; seed < test::cases(60u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, 10);
    Kinetic kinetic(test::random_motions(25, 10, 1, seed));
    for (const double time : {0.0, 1.5}) {
      kinetic.advance_to(time);
      const Rational t = to_rational(time);
      const Places places = places_at(kinetic, t);
      // A roomy place of those that are at the left, and one at the right.
      const auto roomy_place = [&](double first_x) {
        Vector_2 best;
        Rational most = -1;
        for (int i = 0; i < 40; ++i) {
          const double x = first_x + place(random) / 2;
          const Vector_2 next = {x, place(random)};
          const Rational room =
              squared_clearance(places, {to_rational(next.x), to_rational(next.y)});
          if (room <= most) continue;
          most = room;
          best = next;
        }
        return best;
      };
      const Vector_2 from = roomy_place(0);
      const Vector_2 to = roomy_place(5);
      const Widest_path path = widest_path(kinetic, from, to);
      check_gaps_are_edges(kinetic, path);
      const test::Static_point a(to_rational(from.x), to_rational(from.y));
      const test::Static_point b(to_rational(to.x), to_rational(to.y));
      const Rational room = std::min(squared_clearance(places, a), squared_clearance(places, b));
      if (path.gaps.empty()) {
        EXPECT_FALSE(are_separated(places, a, b, room));
        continue;
      }
      const auto& [p, q] = *path.narrowest;
      const Rational width = CGAL::squared_distance(places[p], places[q]);
      EXPECT_FALSE(are_separated(places, a, b, std::min(width, room)));
      const Rational wider = width * (1 + scaled_by_power_of_two(1, -40));
      if (wider > room) continue;
      ++compared;
      EXPECT_TRUE(are_separated(places, a, b, wider));
    }
  }
  EXPECT_GT(compared, 10);
}

// ---- by hand ----

// The corners of a square of side 4 about the origin, with a fifth point in the middle of the right
// side, which moves down.
std::vector<Linear_motion_2> pen() {
  return {
      {{-2, -2}, {}, 0}, {{2, -2}, {}, 0}, {{2, 2}, {}, 0}, {{-2, 2}, {}, 0}, {{2, 1}, {0, -1}, 0}};
}

TEST(Widest_path, leads_out_where_the_gap_is_widest) {
  const Kinetic kinetic(pen());
  const Widest_path path = widest_path(kinetic, {0, 0.125}, {9, 0});
  ASSERT_TRUE(path.narrowest);
  EXPECT_EQ(path.around_from.size(), 3u);
  EXPECT_EQ(path.around_to.size(), 1u);
  // Three sides are 4 wide; the last gap is one of them, whichever the way to it is.
  const Edge_ids last = path.gaps.back();
  EXPECT_TRUE(last == (Edge_ids{0, 1}) || last == (Edge_ids{2, 3}) || last == (Edge_ids{0, 3}));
  EXPECT_TRUE(widest_path(kinetic, {9, 0}, {-9, 0}).gaps.empty()) << "around all points";
  EXPECT_TRUE(widest_path(kinetic, {0, 0.125}, {0, 0.125}).gaps.empty());
  EXPECT_PRECONDITION_ERROR(widest_path(kinetic, {std::nan(""), 0}, {0, 0}),
                            "a place is not finite");
  EXPECT_PRECONDITION_ERROR(end_of_path(kinetic, path, -1), "the width is negative or not finite");
}

TEST(Widest_path, of_points_on_a_line_is_without_gaps) {
  const Kinetic kinetic(std::vector<Linear_motion_2>{{{0, 0}, {}, 0}, {{1, 0}, {}, 0}});
  EXPECT_TRUE(widest_path(kinetic, {0.5, 1}, {0.5, -1}).gaps.empty());
}

// Each point has another one at its position, which moves with it.
TEST(Widest_path, is_the_same_if_points_coincide_for_a_while) {
  std::size_t gaps = 0;
  int ends = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto motions = test::random_motions(20, 10, 1, seed);
    const Kinetic single(motions);
    for (std::size_t i = 0; i < 20; ++i) motions.push_back(motions[(7 * i) % 20]);
    const Kinetic kinetic(motions);
    ASSERT_EQ(kinetic.number_of_hidden_points(), 20u);
    for (const Vector_2& to : {Vector_2{6, 5}, Vector_2{-5, 3}}) {
      const Widest_path path = widest_path(kinetic, {3, 4}, to);
      const Widest_path expected = widest_path(single, {3, 4}, to);
      EXPECT_EQ(path.gaps, expected.gaps);
      EXPECT_EQ(path.narrowest, expected.narrowest);
      // Outside of the convex hull it may be any of some edges.
      if (path.around_from.size() == 3 && path.around_to.size() == 3) {
        ++ends;
        EXPECT_EQ(end_of_path(kinetic, path, 0.25), end_of_path(single, expected, 0.25));
      }
      gaps += path.gaps.size();
    }
  }
  EXPECT_GT(gaps, 20u);
  EXPECT_GT(ends, 5);
}

// Two points that approach each other between two that rest: the way between them is as wide as
// their distance, 4 - 2t, and closes at 4 - 2t = width.
TEST(Widest_path, ends_where_a_gap_is_closed) {
  const Kinetic kinetic(std::vector<Linear_motion_2>{
      {{0, 2}, {0, -1}, 0}, {{0, -2}, {0, 1}, 0}, {{-3, 0}, {}, 0}, {{3, 0}, {}, 0}});
  const Widest_path path = widest_path(kinetic, {-1.5, 0.25}, {1.5, 0.25});
  ASSERT_EQ(path.gaps, (std::vector<Edge_ids>{{0, 1}}));
  EXPECT_EQ(path.narrowest, (Edge_ids{0, 1}));
  EXPECT_EQ(end_of_path(kinetic, path, 3), Algebraic_number(0.5));
  EXPECT_EQ(end_of_path(kinetic, path, 4), Algebraic_number(0.0)) << "closed already";
  // The sides of the triangle about (-1.5, 0.25) come to it when (2 - t) / 2 = 0.25.
  EXPECT_EQ(end_of_path(kinetic, path, 0), Algebraic_number(1.5));
  const Kinetic resting(std::vector<Linear_motion_2>{
      {{-2, -2}, {}, 0}, {{2, -2}, {}, 0}, {{2, 2}, {}, 0}, {{-2, 3}, {}, 0}});
  EXPECT_EQ(end_of_path(resting, widest_path(resting, {0, 0.5}, {9, 0}), 1), std::nullopt);
}

}  // namespace
}  // namespace kinetri::widest_path_test
