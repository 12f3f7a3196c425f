// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/observers/proximity_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "observers/random_runs.h"
#include "support/brute_force_simulator.h"
#include "support/motions.h"

namespace kinetri::proximity_graphs_test {
namespace {

// ---- the oracle: all triples, by the signs of polynomials just after the time ----

// Of points with the same trajectory only the first counts; the others have an edge with it.

template <class Traits>
class Oracle {
 public:
  using Motion = typename Traits::Motion;

  explicit Oracle(const Kinetic_triangulation_2<Traits>& triangulation)
      : time_(triangulation.current_time()) {
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (!triangulation.contains(id)) continue;
      const Motion& motion = triangulation.motion(id);
      const auto same = std::ranges::find_if(
          motions_, [&](const Motion& other) { return do_coincide(motion, other); });
      if (same != motions_.end()) {
        links_.push_back({ids_[static_cast<std::size_t>(same - motions_.begin())], id});
        continue;
      }
      ids_.push_back(id);
      motions_.push_back(motion);
    }
  }

  std::vector<Edge_ids> gabriel_edges() const {
    return edges([this](const Motion& a, const Motion& b, const Motion& c) {
      return sign([&](const Rational& t) {
               return Rational(squared(a, c, t) + squared(b, c, t) - squared(a, b, t));
             }) == CGAL::POSITIVE;
    });
  }

  std::vector<Edge_ids> relative_neighbor_edges() const {
    return edges([this](const Motion& a, const Motion& b, const Motion& c) {
      const auto is_nearer = [&](const Motion& p, const Motion& q) {
        return sign([&](const Rational& t) {
                 return Rational(squared(p, c, t) - squared(p, q, t));
               }) == CGAL::NEGATIVE;
      };
      return !is_nearer(a, b) || !is_nearer(b, a);
    });
  }

 private:
  static constexpr int degree = std::same_as<Motion, Linear_motion_2> ? 2 : 6;

  // Cubic polynomials that are equal at four times are equal.
  static bool do_coincide(const Motion& a, const Motion& b) {
    bool result = true;
    for (int t = 0; t < 4; ++t) result = result && test::place_at(a, t) == test::place_at(b, t);
    return result;
  }
  static Rational squared(const Motion& p, const Motion& q, const Rational& t) {
    return CGAL::squared_distance(test::place_at(p, t), test::place_at(q, t));
  }
  Sign sign(const std::function<Rational(const Rational&)>& value) const {
    return sign_just_after(test::interpolate(degree, value), time_);
  }
  template <class Allows>
  std::vector<Edge_ids> edges(const Allows& allows) const {
    std::vector<Edge_ids> result = links_;
    for (std::size_t a = 0; a < ids_.size(); ++a) {
      for (std::size_t b = a + 1; b < ids_.size(); ++b) {
        bool is_edge = true;
        for (std::size_t c = 0; c < ids_.size() && is_edge; ++c) {
          if (c != a && c != b) is_edge = allows(motions_[a], motions_[b], motions_[c]);
        }
        if (is_edge) result.push_back({ids_[a], ids_[b]});
      }
    }
    std::ranges::sort(result);
    return result;
  }

  Algebraic_number time_;
  std::vector<Point_id> ids_;
  std::vector<Motion> motions_;
  std::vector<Edge_ids> links_;
};

template <class Traits>
void check(const Kinetic_triangulation_2<Traits>& triangulation) {
  const Oracle<Traits> oracle(triangulation);
  EXPECT_EQ(gabriel_edges(triangulation), oracle.gabriel_edges());
  EXPECT_EQ(relative_neighbor_edges(triangulation), oracle.relative_neighbor_edges());
}

template <class Traits = Linear_kinetic_traits_2>
void run_and_check(const std::vector<typename Traits::Motion>& motions, int steps) {
  Kinetic_triangulation_2<Traits> triangulation(motions);
  check(triangulation);
  for (int step = 0; step < steps && triangulation.step() > 0; ++step) check(triangulation);
}

std::vector<Linear_motion_2> at_rest(const std::vector<Vector_2>& places) {
  std::vector<Linear_motion_2> motions;
  for (const Vector_2& place : places) motions.push_back({place, {}, 0});
  return motions;
}

TEST(Proximity_graphs, of_few_points) {
  for (const auto& places : std::vector<std::vector<Vector_2>>{
           {}, {{0, 0}}, {{0, 0}, {1, 0}}, {{0, 0}, {2, 0}, {1, 0}}, {{0, 0}, {4, 0}, {1, 1}}}) {
    run_and_check(at_rest(places), 0);
  }
}

// On the circle with diameter ab: not in the Gabriel graph. On the boundary of the lune: still
// relative neighbors.
TEST(Proximity_graphs, at_the_boundary) {
  const Kinetic_triangulation_2<Linear_kinetic_traits_2> square(
      at_rest({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const std::vector<Edge_ids> sides = {{0, 1}, {0, 3}, {1, 2}, {2, 3}};
  EXPECT_EQ(gabriel_edges(square), sides);
  EXPECT_EQ(relative_neighbor_edges(square), sides);
  // |ac| = |ab| = 5, |bc| < 5
  const Kinetic_triangulation_2<Linear_kinetic_traits_2> isosceles(
      at_rest({{0, 0}, {5, 0}, {4, 3}}));
  EXPECT_EQ(relative_neighbor_edges(isosceles), (std::vector<Edge_ids>{{0, 1}, {0, 2}, {1, 2}}));
}

// The point 2 is in the lune of 0 and 1 and has an edge to neither of them.
TEST(Proximity_graphs, a_point_in_the_lune_need_not_be_a_neighbor_of_an_end) {
  const std::vector<Linear_motion_2> motions =
      at_rest({{0, 0}, {1, 0}, {0.5, 0.84375}, {-0.0625, 0.3125}, {1.0625, 0.3125}});
  const Kinetic_triangulation_2<Linear_kinetic_traits_2> triangulation(motions);
  const auto edges = triangulation.finite_edge_ids();
  EXPECT_FALSE(std::ranges::binary_search(edges, Edge_ids{0, 2}));
  EXPECT_FALSE(std::ranges::binary_search(edges, Edge_ids{1, 2}));
  EXPECT_TRUE(std::ranges::binary_search(gabriel_edges(triangulation), Edge_ids{0, 1}));
  EXPECT_FALSE(std::ranges::binary_search(relative_neighbor_edges(triangulation), Edge_ids{0, 1}));
  check(triangulation);
}

TEST(Proximity_graphs, of_random_motions_are_those_of_all_triples) {
  for (unsigned seed = 0; seed < test::cases(2u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check(test::random_motions(14, 10, 1, seed), 8);
  }
}

TEST(Proximity_graphs, of_degenerate_motions_are_those_of_all_triples) {
  for (unsigned seed = 0; seed < test::cases(8u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check(test::grid_motions(9, 4, 1, seed), 8);
  }
}

TEST(Proximity_graphs, of_points_at_rest_on_a_grid_are_those_of_all_triples) {
  for (unsigned seed = 0; seed < test::cases(10u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check(test::grid_motions(12, 5, 0, seed), 0);
  }
}

TEST(Proximity_graphs, of_accelerated_motions_are_those_of_all_triples) {
  for (unsigned seed = 0; seed < test::cases(3u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    run_and_check<Polynomial_kinetic_traits_2>(test::polynomial_grid_motions(7, 4, 2, 3, seed), 5);
  }
}

TEST(Proximity_graphs, join_points_that_coincide_for_a_while_with_the_first_of_them) {
  const Kinetic_triangulation_2<Linear_kinetic_traits_2> triangulation(
      at_rest({{0, 0}, {2, 0}, {0, 0}, {2, 0}, {0, 0}}));
  const std::vector<Edge_ids> expected = {{0, 1}, {0, 2}, {0, 4}, {1, 3}};
  EXPECT_EQ(gabriel_edges(triangulation), expected);
  EXPECT_EQ(relative_neighbor_edges(triangulation), expected);
}

TEST(Proximity_graphs, of_points_of_which_some_coincide_are_those_of_all_triples) {
  std::size_t hidden = 0;
  for (unsigned seed = 0; seed < test::cases(15u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motions = test::coincident_motions(3 + seed % 8, seed);
    hidden += Kinetic_triangulation_2<Linear_kinetic_traits_2>(motions).number_of_hidden_points();
    run_and_check(motions, 4);
  }
  EXPECT_GT(hidden, 10U);
}

TEST(Proximity_graphs, of_points_that_come_and_go_are_those_of_all_triples) {
  Kinetic_triangulation_2<Linear_kinetic_traits_2> triangulation(test::grid_motions(8, 4, 1, 7));
  triangulation.advance_to(0.5);
  triangulation.erase(3);
  check(triangulation);
  triangulation.insert({{1.5, 1.25}, {1, 2}, 0.5});
  triangulation.advance_to(0.75);
  check(triangulation);
}

}  // namespace
}  // namespace kinetri::proximity_graphs_test
