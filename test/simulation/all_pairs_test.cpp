// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts against an oracle that looks at all pairs: every response, linear and accelerated
// motion, equal discs and discs of sizes from 0 to a million times the smallest that grow and
// shrink, with and without a box, discs apart, and discs that overlap, come, turn and go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/all_pairs_comparison.h"

namespace kinetri::all_pairs_test {
namespace {

/// The numbers of a random motion: of binary64, or small whole ones, which make contacts at one
/// time.
class Numbers {
 public:
  Numbers(bool are_whole, unsigned seed) : are_whole_(are_whole), random_(seed) {}

  double between(int least, int greatest) {
    if (are_whole_) return std::uniform_int_distribution<int>(least, greatest)(random_);
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }
  Vector_2 vector(int size) {
    const double x = between(-size, size);
    return {x, between(-size, size)};
  }

  /// 0 or, of binary64, down to a millionth of the largest.
  double radius(double largest) {
    if (are_whole_) return largest * between(0, 4) / 4;
    if (random_() % 8 == 0) return 0;
    return std::ldexp(largest * between(1, 2) / 2,
                      random_() % 2 == 0 ? 0 : static_cast<int>(between(-19, 0)));
  }
  /// Such that the radius is not negative after the duration.
  double growth(double radius, double duration) {
    if (random_() % 3 == 0) return 0;
    const double result = between(-1, 1) / 8;
    // A radius that changes is rounded down at every contact.
    return radius + result * duration <= radius / 64 ? 0 : result;
  }

 private:
  bool are_whole_;
  std::mt19937_64 random_;
};

template <class Motion>
Motion random_center(Numbers& numbers, int size) {
  const Vector_2 place = numbers.vector(size);
  const Vector_2 velocity = numbers.vector(3);
  if constexpr (std::same_as<Motion, Linear_motion_2>) {
    return {place, velocity, 0};
  } else {
    const Vector_2 acceleration = numbers.vector(2);
    // Of whole numbers some rest, or move with constant velocity.
    const double kind = numbers.between(0, 3);
    const Vector_2 jerk = numbers.vector(2);
    if (kind == 0) return {place, {}, {}, {}, 0};
    if (kind == 1) return {place, {}, acceleration, {}, 0};
    return {place, velocity, acceleration, kind < 2.5 ? Vector_2() : jerk, 0};
  }
}

/// Sizes of random motions: of the square, of the largest disc; and how long they last.
struct Sizes {
  int side;
  double radius;
  double duration;
};

template <class Motion>
Motion random_motion(Numbers& numbers, const Sizes& sizes) {
  if constexpr (HasWeight<Motion>) {
    const auto center = random_motion<typename Motion::Center_motion>(numbers, sizes);
    const double radius = numbers.radius(sizes.radius);
    return {center, radius, numbers.growth(radius, sizes.duration), 0};
  } else {
    return random_center<Motion>(numbers, sizes.side);
  }
}
/// At `time` a point comes, turns, or goes, in turn: the motion begins there at that time.
template <class Motion>
test::All_pairs_change<Motion> random_change(Numbers& numbers, const Sizes& sizes, double time,
                                             std::size_t points, std::size_t number) {
  Motion motion = random_motion<Motion>(numbers, sizes);
  motion.epoch = time;
  // Every third change is an insertion.
  const auto inserted = static_cast<Point_id>(points + number / 3);
  if (number % 3 == 0) return {time, inserted, motion};
  const auto id = static_cast<Point_id>(number % points);
  if (number % 3 == 1) return {time, id, motion};
  return {time, id, std::nullopt};
}

/// The name of the response; whether there is a box, whole numbers, and discs that overlap at the
/// start.
using Case = std::tuple<std::string, bool, bool, bool>;

class All_pairs : public testing::TestWithParam<Case> {
 protected:
  template <class Traits>
  void run(std::size_t points, double until, int seeds) {
    using Motion = typename Traits::Motion;
    const auto& [response, has_box, are_whole, may_overlap] = GetParam();
    test::All_pairs_totals totals;
    std::size_t overlaps = 0;  // pairs at the start
    for (int seed = 1; seed <= test::cases(seeds); ++seed) {
      constexpr int size = 8;
      const Sizes sizes = {size, may_overlap ? 4.0 : 1.5, until};
      Simulation_options options;
      if (!HasWeight<Motion>) options.radius = may_overlap ? 1.5 : 0.75;
      for (const Named_response& named : named_responses) {
        if (named.name == response) options.response = named.response;
      }
      if (has_box) options.box = Box_2{-size, -size, size, size};
      if (has_box && HasWeight<Motion> &&
          (seed % 2 == 0) == are_whole) {  // wide enough for every rim
        options.box = Box_2{-size - 4, -size - 4, size + 4, size + 4};
        options.rim_touches = true;
      }
      Numbers numbers(are_whole, static_cast<unsigned>(seed));
      std::vector<Motion> motions;
      while (motions.size() < points) {
        const auto motion = random_motion<Motion>(numbers, sizes);
        const auto is_refused = [&, is_allowed = may_overlap](const auto& other) {
          const Rational contact =
              test::radius_at(motion, 0, options) + test::radius_at(other, 0, options);
          const bool overlap = CGAL::squared_distance(test::place_at(motion, 0),
                                                      test::place_at(other, 0)) < contact * contact;
          if (overlap && is_allowed) ++overlaps;
          return overlap && !is_allowed;
        };
        if (std::ranges::none_of(motions, is_refused)) motions.push_back(motion);
        // Some coincide for a while.
        if (may_overlap && motions.size() % 4 == 0) motions.push_back(motions[motions.size() - 3]);
      }
      if (HasWeight<Motion>) {
        for (std::size_t i = 0; i < motions.size(); ++i) {
          options.masses.push_back(1 + static_cast<double>(i % 3));
        }
      }
      std::vector<test::All_pairs_change<Motion>> changes;
      for (double time = until / 8; may_overlap && time < until; time += until / 8) {
        changes.push_back(
            random_change<Motion>(numbers, sizes, time, motions.size(), changes.size()));
        auto& motion = changes.back().motion;
        if (!has_box && motion && changes.size() % 4 == 0) motion = motions[changes.size() % 5];
      }
      const std::string problem =
          test::difference_from_all_pairs<Traits>(motions, options, changes, until, totals);
      ASSERT_EQ(problem, "") << "seed " << seed;
    }
    std::printf("%zu runs, %zu contacts, %zu ended pressed, %zu pairs overlapped at the start\n",
                totals.runs, totals.contacts, totals.pressed, overlaps);
    EXPECT_GT(totals.contacts, totals.runs / 3);
  }
};

TEST_P(All_pairs, of_linear_points_have_the_same_contacts) {
  run<Linear_kinetic_traits_2>(14, 5, 3);
}

TEST_P(All_pairs, of_accelerated_points_have_the_same_contacts) {
  run<Polynomial_kinetic_traits_2>(9, 3, 3);
}

TEST_P(All_pairs, of_discs_of_any_size_have_the_same_contacts) {
  run<Disc_kinetic_traits_2>(14, 5, 3);
}

TEST_P(All_pairs, of_accelerated_discs_of_any_size_have_the_same_contacts) {
  run<Polynomial_disc_kinetic_traits_2>(9, 3, 2);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const auto& [response, has_box, are_whole, may_overlap] = info.param;
  std::string result = response;
  result += has_box ? "_in_a_box" : "_in_the_plane";
  result += are_whole ? "_on_a_grid" : "_at_random";
  result += may_overlap ? "_overlapping" : "_apart";
  return result;
}

INSTANTIATE_TEST_SUITE_P(, All_pairs,
                         testing::Combine(testing::Values("log", "swap", "elastic", "stop",
                                                          "remove"),
                                          testing::Bool(), testing::Bool(), testing::Bool()),
                         case_name);

}  // namespace
}  // namespace kinetri::all_pairs_test
